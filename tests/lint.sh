#!/bin/sh
# lint.sh: formatting, clang-tidy, shell scripts, and the project's own rules. ./run lint installs what it needs.
set -eu
cd "$(dirname -- "$0")/.."

say() { printf '%s\n' "$*" >&2; }
fail() { say "error: $*"; exit 1; }

# Files of the project, committed or about to be: project_files PATTERN...
project_files() { git ls-files --cached --others --exclude-standard -- "$@"; }

# refuse WHAT: fails if there is anything on standard input, which lists the places of WHAT.
refuse() {
  if found=$(grep .); then
    printf '%s\n' "$found"
    fail "$1"
  fi
  say "ok: no $1"
}

# Lines with a pattern in the files named on standard input: search PATTERN.
search() { LC_ALL=C xargs grep -nIP "$1" || :; }

# The headers' code without comments, each line after its place. Constexpr helpers that compute in double while compiling
# are left out: srgb.hpp's tables, and Radius::from_double().
header_code() {
  # shellcheck disable=SC2016  # the program's own $
  project_files 'include/*.hpp' | xargs awk '
    FNR == 1 { helper = 0 }
    { sub(/\/\/.*/, "") }
    /constexpr .* (nth_root|log_series|srgb_power|from_double)\(/ { helper = 1; match($0, /^ */); indent = RLENGTH }
    !helper { print FILENAME ":" FNR ": " $0 }
    helper && /^ *}$/ { match($0, /^ */); if (RLENGTH == indent) helper = 0 }'
}

[ -n "$(project_files run)" ] || fail "lint asks git for the project's files, and this is no clone"
project_files ':!*.bin' ':!tests/bench/clouds' | search '[^\x00-\x7F]' | refuse "character outside of ASCII"
project_files ':!*.bin' | search '/(work|tmp|home)/' | refuse "path of some machine"
header_code | grep -E ':.*\bdouble\b' | refuse "double in the headers"
header_code | grep -E ':.*(\bprintf|<iostream>|<cstdio>|\babort\(|\bthrow\b|\bnew\b)' |
  grep -vE "/replace_file\.hpp:.*(<cstdio>)" |  # saves and loads files
  refuse "printing, aborting, throwing or allocating in the headers"
header_code | grep -E '# *define +' | grep -vE '# *define +SHORTSHOT_' |
  grep -v '/kernel_for_avx2\.hpp:.*define shortshot shortshot_avx2 ' |  # while it reads the kernel once more
  refuse "macro without the prefix SHORTSHOT_"
project_files run .ci/run '*.sh' '*.hpp' '*.cpp' '*.h' '*.c' '*.cmake' '*CMakeLists.txt' ':!single_include/shortshot.hpp' |
  xargs wc -l | awk '$2 != "total" && $1 > 300' | refuse "file of more than 300 lines"

say "+ shellcheck, for every shell script"
project_files run .ci/run '*.sh' | xargs shellcheck
say "+ clang-format-14 --dry-run -Werror, for every C++ and C file"
project_files '*.hpp' '*.cpp' 'single_include/*.h' 'tests/*.c' ':!single_include/shortshot.hpp' | xargs clang-format-14 --dry-run -Werror
say "+ clang-tidy-14, for the library and for the kernel alone"
printf '%s\n' whole_library kernel_object |
  xargs -I '{}' -P 2 clang-tidy-14 --quiet 'tests/build/{}.cpp' -- -std=c++17 -Iinclude -isystem /usr/include/eigen3
say "lint passed"
