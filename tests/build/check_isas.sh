#!/bin/sh
# check_isas.sh NAMESPACE OBJECT...: every function of the library that an object defines must be in the namespace of the
# object's instruction set. Else a linker would keep only one of several, and the program might die of an instruction
# that its CPU does not have.
set -eu

while [ $# -gt 0 ]; do
  names=$(nm --defined-only "$2" | awk '$2 ~ /[TtWwVuDdBb]/ && $3 ~ /9shortshot/ { print $3 }')
  count=$(printf '%s\n' "$names" | grep -c "$1") || { echo "$2 has no function in $1"; exit 1; }
  if others=$(printf '%s\n' "$names" | grep -v "$1"); then
    printf 'not in %s:\n%s\n' "$1" "$others"
    exit 1
  fi
  echo "$count functions in $1"
  shift 2
done
