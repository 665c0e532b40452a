#!/bin/sh
# fuzz.sh BUILD SECONDS [NAME...]: runs the harnesses fuzz_NAME of BUILD, all of them by default, for SECONDS each, as
# many at a time as there are cores. They begin with tests/fuzz/corpus/NAME and with what they found new before, which is
# kept in BUILD/corpus/NAME. Exit code 1 if there is a finding: its path is the last thing said.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)

say() { printf '%s\n' "$*" >&2; }

# fuzz.sh --one BUILD SECONDS NAME: one of them.
if [ "$1" = --one ]; then
  build=$2
  name=$4
  log=$build/findings/$name.log
  mkdir -p "$build/corpus/$name"
  code=0
  "$build/tests/fuzz/fuzz_$name" -max_total_time="$3" -print_final_stats=1 -max_len=2048 -timeout=20 \
    -malloc_limit_mb=256 -artifact_prefix="$build/findings/$name-" "$build/corpus/$name" "$here/corpus/$name" \
    >"$log" 2>&1 || code=$?
  figure() { sed -n "s/^stat::$1: *//p" "$log"; }
  findings=$(sed -n 's/.*Test unit written to //p' "$log")
  say "$name: $(figure number_of_executed_units) executions, $(figure new_units_added) new units," \
    "$(printf '%s' "$findings" | grep -c '') findings"
  [ "$code" -ne 0 ] || exit 0
  tail -n 40 "$log" >&2
  printf '%s\n' "${findings:-$log}" >>"$build/findings/list"
  exit 1
fi

build=$1
seconds=$2
shift 2
case $seconds in '' | *[!0-9]*) say "not a number of seconds: $seconds"; exit 2 ;; esac
if [ $# -eq 0 ]; then
  cd "$here/corpus"
  set -- *
fi
for name; do
  [ -x "$build/tests/fuzz/fuzz_$name" ] || { say "no such harness: $name"; exit 2; }
done
mkdir -p "$build/findings"
rm -f "$build/findings/list"
printf '%s\n' "$@" | xargs -P "$(nproc)" -n 1 "$here/fuzz.sh" --one "$build" "$seconds" || :
[ -e "$build/findings/list" ] || exit 0
sed 's/^/finding: /' "$build/findings/list" >&2
exit 1
