#!/bin/sh
# make.sh [OUTPUT]: the API reference, OUTPUT/html/index.html (build/docs), from the headers of the clone that this file is
# in. Fails where a name has no docstring, naming file, line and name.
set -eu
cd "$(dirname -- "$0")/../.."
output=${1:-build/docs}
case $output in -*) echo "make.sh: unknown option: $output" >&2; exit 2 ;; esac

# What kernel.hpp includes, as `cloud/cloud.hpp`, by the text alone.
closure() {
  seen=
  while [ $# -gt 0 ]; do
    file=$1
    shift
    case " $seen " in *" $file "*) continue ;; esac
    seen="$seen $file"
    # shellcheck disable=SC2046  # a word for each header
    set -- "$@" $(sed -n 's|^#include "\(.*\)"|'"$(dirname "$file")"'/\1|p' "include/$file" |
      sed -E ':a; s|[^/.]+/\.\./||; ta')
  done
  echo "$seen"
}

SHORTSHOT_FIRMWARE=$(closure shortshot/kernel.hpp)
SHORTSHOT_VERSION=$(sed -n 's/^#define SHORTSHOT_VERSION_[MP][A-Z]* //p' include/shortshot/version.hpp | paste -sd.)
export SHORTSHOT_FIRMWARE SHORTSHOT_VERSION
mkdir -p "$output"
(cat packaging/reference/Doxyfile && echo "OUTPUT_DIRECTORY = $output") | doxygen -
