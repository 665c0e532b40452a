#!/bin/sh
# check_code_namespace.sh CODE OBJECT...: every function of the library that an object defines must be in the inline
# namespace CODE, which names the flags that the object was compiled with. Else a linker would keep only one of several, and
# the program might die of an instruction that its CPU does not have.
#
# Two kinds of functions are nobody's to name: the standard library's templates over our types, and what the compiler writes
# for types that own memory (constructors, destructors, assignment). The README says what that costs.
set -eu

implicit='(C[12]E|D[012]E|aSE)[^ ]*$'
while [ $# -gt 0 ]; do
  names=$(nm --defined-only "$2" | awk '$2 ~ /[TtWw]/ && $3 ~ /^_Z(N?K?|GVN|TVN?)9shortshot/ { print $3 }')
  count=$(printf '%s\n' "$names" | grep -c "$1") || { echo "$2 has no function in $1"; exit 1; }
  if others=$(printf '%s\n' "$names" | grep -v "$1" | grep -vE "$implicit"); then
    printf 'not in %s:\n%s\n' "$1" "$others" | c++filt
    exit 1
  fi
  echo "$count functions in $1"
  shift 2
done
