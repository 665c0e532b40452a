#!/bin/sh
# check_symbols.sh OBJECT: does compiled code keep the kernel's promises? Prints a line "broken: PROMISE (what)" for each
# broken one; exit code 1 if there is any.
# check_symbols.sh --image PROGRAM: the same for a linked program, of whose symbols all are looked at: there is no other
# code, but also what start-up and the compiler's own library are made of.
# check_symbols.sh --must-report PROMISE OBJECT: exit code 0 if that promise is reported as broken, else 1.
# NM and OBJDUMP name other tools than the host's, for cross-compiled objects.
set -eu
LC_ALL=C
export LC_ALL

if [ "$1" = --must-report ]; then
  report=$("$0" "$3") && { echo "nothing is reported for $3"; exit 1; }
  printf '%s\n' "$report"
  printf '%s\n' "$report" | grep -q "^broken: $2 ("
  exit
fi

symbols=-u
if [ "$1" = --image ]; then
  symbols=-p
  shift
fi
object=$1
report=
[ -r "$object" ] || { echo "there is no $object"; exit 2; }

# broken PROMISE WHAT...: nothing if there is no WHAT.
broken() {
  promise=$1
  shift
  for what; do
    report="${report}broken: $promise ($what)
"
  done
}

# What the object takes from elsewhere. memset and memcpy (and ARM's own names for them) are all that it may, and how the
# compiler counts leading zeros where the CPU cannot.
for symbol in $("${NM:-nm}" $symbols "$object" | awk '{ print $NF }'); do
  case $symbol in
    memset | memcpy | __aeabi_memset* | __aeabi_memclr* | __aeabi_memcpy* | __clzsi2) ;;
    _Zn* | _Zd[la]* | malloc | calloc | realloc | free | aligned_alloc) broken "no heap" "$symbol" ;;
    __cxa_guard_*) broken "no function-local statics" "$symbol" ;;
    __cxa_*exception* | __cxa_throw* | __cxa_rethrow* | __cxa_*catch* | __gxx_personality* | _Unwind* | \
      __aeabi_unwind* | _ZSt*__throw_*) broken "no exceptions" "$symbol" ;;
    _ZTI* | _ZTV* | _ZTS* | __dynamic_cast) broken "no RTTI" "$symbol" ;;
    *printf* | puts | putchar | fputs | fputc | fwrite | _ZNSo* | _ZSt4cout | _ZSt4cerr) broken "no printing" "$symbol" ;;
    __aeabi_d* | __aeabi_*2d | __*df[23] | __truncdfsf2 | __float*df | __fix*df*)
      broken "no double" "$symbol" ;;
    *) [ $symbols = -p ] || broken "no calls to other code" "$symbol" ;;
  esac
done

# Sections with something in them.
for section in $("${OBJDUMP:-objdump}" -h "$object" | awk '$1 ~ /^[0-9]+$/ && $3 !~ /^0+$/ { print $2 }'); do
  case $section in
    .init_array* | .ctors* | .preinit_array*) broken "no static initializers" "$section" ;;
    .data | .data.*) broken "no writable constants" "$section" ;;
    .gcc_except_table* | .ARM.extab*) broken "no exceptions" "$section" ;;
  esac
done

# Instructions that compute in double: SSE2 and AVX, x87, AArch64, ARM's VFP. Moves and bit operations are not among them.
doubles=$("${OBJDUMP:-objdump}" -d --no-show-raw-insn "$object" | awk -F '\t' '
  { name = $2; sub(/ .*/, "", name); operands = $2 " " $3; sub(/[#<].*/, "", operands) }  # no addresses
  name ~ /^v?(add|sub|mul|div|sqrt|max|min|u?comi|cmp[a-z]*|round|hadd|hsub|dp|addsub)[sp]d$/ ||
  name ~ /^vfn?m(add|sub|addsub|subadd)[0-9]*[sp]d$/ ||
  name ~ /^v?cvtt?[a-z0-9]*[sp]d/ ||
  name ~ /^fi?(add|sub|mul|div|ld|sqrt|st)[a-z0-9]*$/ && operands ~ /st[(]|[(]%/ ||
  name ~ /^(f|s|u)[a-z]+$/ && operands ~ /[ ,](d[0-9]+|v[0-9]+\.2d)(,|$| )/ && name ~ /add|sub|mul|div|sqrt|cvt|cmp|mla|mls/ ||
  name ~ /^v.*\.f64/ && name !~ /^v(mov|ldr|str)/ { print name }' | sort -u)
# shellcheck disable=SC2086  # one word for each instruction
broken "no double" $doubles

# Instructions that round a product and a sum once, for both: AVX, AArch64, RISC-V, ARM's VFP (whose vmla rounds twice).
# Even where the product is exact and they change nothing, so that this needs no judgement.
fused=$("${OBJDUMP:-objdump}" -d --no-show-raw-insn "$object" | awk -F '\t' '
  { name = $2; sub(/ .*/, "", name) }
  name ~ /^vfn?m(add|sub|addsub|subadd)[0-9]*[sp][sd]$/ || name ~ /^fn?m(add|sub|la|ls)([.][sd])?$/ ||
  name ~ /^vfn?m[as]\./ { print name }' | sort -u)
# shellcheck disable=SC2086  # one word for each instruction
broken "no fused multiply-add" $fused

if [ -n "$report" ]; then
  printf '%s' "$report"
  exit 1
fi
echo "kept: no heap, exceptions, RTTI, printing, double, fused multiply-add, static initializers, function-local statics," \
  "writable constants"
