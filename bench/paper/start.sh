#!/bin/sh
# start.sh EXPERIMENT ...: the program that ./run paper has built; registration beside FPFH of PCL and of Open3D where
# these are installed, which nobody needs for the rest.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)

say() { printf '%s\n' "$*" >&2; }
show() { say "+ $*"; "$@"; }
at_root() { say "+ $*"; (cd "$root" && "$@") >&2; }
installed() { dpkg-query -W -f '${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed; }

# build_fpfh LIBRARY: false where it is not installed, or cannot be built, which cmake says.
build_fpfh() {
  if ! installed "lib$1-dev"; then
    say "FPFH of $1 is left out: lib$1-dev is not installed"
    return 1
  fi
  at_root cmake --preset peers &&
    at_root cmake --build --preset peers --parallel "$(nproc 2>/dev/null || echo 2)" --target "fpfh_$1"
}

libraries="pcl open3d"
case " $* " in
  *" --quick "*) libraries="" ;;
esac
if [ "${1-}" = registration ]; then
  [ -n "$libraries" ] || say "FPFH is left out: --quick"
  for library in $libraries; do
    if build_fpfh "$library"; then set -- "$@" --peer "fpfh-$library=$root/build/peers/bench/fpfh_$library"; fi
  done
fi
show "$root/build/default/bench/paper" "$@"
