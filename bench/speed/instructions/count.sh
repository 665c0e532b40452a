#!/bin/sh
# count.sh BUILD [--update]: counts each stage's instructions by callgrind and compares them with expected.json beside this
# file, or writes that file. BUILD is where the program was built.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
program=$1/bench/instructions
counts=$program.callgrind

show() { printf '+ %s\n' "$*" >&2; "$@"; }

case ${2-} in
  '') verdict=check ;;
  --update) verdict=update ;;
  *) printf 'unknown option: %s\n' "$2" >&2; exit 2 ;;
esac
show valgrind -q --tool=callgrind --instr-atstart=no --combine-dumps=yes --callgrind-out-file="$counts" "$program" count
show "$program" $verdict "$counts" "$here/expected.json"
