#!/bin/sh
# draw.sh BUILD ARGUMENT...: instructions counted by callgrind, then the map. ARGUMENTs are those of `tradeoff draw` or,
# with "merge" before them, of `tradeoff merge`. BUILD is where the program was built.
set -eu
build=$1
program=$build/bench/tradeoff
shift

show() { printf '+ %s\n' "$*" >&2; "$@"; }

command=draw
quick=
draws=yes
case ${1-} in
  merge) command=merge; shift ;;
esac
for argument; do
  case $argument in
    -h | --help) show "$program" $command --help; exit ;;
    --quick) quick=--quick ;;
    --shard | --shard=*) draws= ;;  # nothing is drawn before all are merged
  esac
done
if [ -n "$draws" ]; then
  counts=$build/tradeoff$quick.callgrind
  # shellcheck disable=SC2086
  [ -n "$(find "$counts" -newer "$program" 2>/dev/null)" ] || show valgrind -q --tool=callgrind --instr-atstart=no --combine-dumps=yes \
    --callgrind-out-file="$counts" "$program" count $quick
  set -- "$@" --instructions "$counts"
fi
show "$program" $command "$@"
