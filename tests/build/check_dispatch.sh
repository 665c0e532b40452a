#!/bin/sh
# check_dispatch.sh [--none | --must-report] OBJECT: instructions of AVX are in functions of shortshot_avx2 and in no other
# one, and there are some; --none: in no function at all; --must-report: a control, which has one in another function.
set -eu
mode=check
case $1 in
  --*) mode=${1#--}; shift ;;
esac
# The mnemonics of AVX begin with a v, and nothing else of a plain program does but verr and verw.
found=$(objdump -d --no-show-raw-insn "$1" | awk '
  /^[0-9a-f]+ <.*>:$/ { name = $2 }
  $2 ~ /^v/ && $2 !~ /^ver[rw]$/ { if (name ~ /14shortshot_avx2/) ++inside; else { ++outside; print name > "/dev/stderr" } }
  END { print inside + 0, outside + 0 }')
inside=${found% *}
outside=${found#* }
echo "instructions of AVX: $inside in shortshot_avx2, $outside elsewhere"
case $mode in
  check) [ "$inside" -gt 1000 ] && [ "$outside" -eq 0 ] ;;
  none) [ "$inside" -eq 0 ] && [ "$outside" -eq 0 ] ;;
  must-report) [ "$outside" -gt 0 ] ;;
esac
