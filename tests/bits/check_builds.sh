#!/bin/sh
# check_builds.sh DIRECTORY FOLDER...: compiles hashes.cpp in DIRECTORY with several compilers, flags and instruction sets,
# runs all of them on the FOLDERs of golden vectors, and compares what they print. Exit code 1 if any hash differs; or if
# none does where the library does not keep the compiler from fusing multiplications and additions, because then this
# would not notice any.
# SHORTSHOT_REQUIRE_REAL_DATA, set where changes are merged: nothing may be left out.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)

# check_builds.sh --compile DIRECTORY NAME COMPILER FLAGS...: one of them. Of contradicting flags the last one counts.
# What reads and makes the input is compiled once for each CPU: a NAME that begins with "input_".
if [ "$1" = --compile ]; then
  directory=$2
  program=$2/$3
  name=$3
  shift 3
  echo "$program: $*"
  cd "$root"
  set -- "$@" -std=c++17 -Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion -Werror -Iinclude -Ibench
  case $name in
    input_*)
      exec "$@" -ffp-contract=off -r -o "$program.o" \
        bench/tools/golden/case.cpp bench/tools/golden/array.cpp bench/tools/golden/known_arrays.cpp \
        bench/tools/scene/tabletop.cpp bench/tools/scene/sensor.cpp bench/tools/scene/objects.cpp
      ;;
    *_neon) input=$directory/input_neon.o ;;
    *) input=$directory/input_x86.o ;;
  esac
  exec "$@" -o "$program" tests/bits/hashes.cpp "$input"
fi

directory=$1
shift
rm -rf "$directory"
mkdir -p "$directory"
failed=0

left_out() {
  echo "left out: $1"
  [ -z "${SHORTSHOT_REQUIRE_REAL_DATA:-}" ] || failed=1
}
build() {  # NAME COMPILER FLAGS...
  echo "$*" >>"$directory/builds"
}
input() {  # NAME COMPILER FLAGS...
  echo "$*" >>"$directory/inputs"
}

[ "$(uname -m)" = x86_64 ] || { left_out "same bits of all builds, this is no x86-64"; exit $failed; }
# Where nothing else is said, a plain build uses AVX2 in extract() and other functions for hosts.
input input_x86 g++ -O2
build gcc_sse2 g++ -O2 -DSHORTSHOT_NO_DISPATCH  # what all others are compared with
build gcc_sse2_Os g++ -Os
build gcc_sse2_O3 g++ -O3
build gcc_scalar g++ -O2 -U__SSE2__
build gcc_scalar_Os g++ -Os -U__SSE2__  # the code of microcontrollers
build clang_sse2 clang++ -O2
sanitizers=-fsanitize=address,undefined,float-cast-overflow
build clang_sse2_sanitized clang++ -O1 -g1 $sanitizers -fno-sanitize-recover=all  # the test suites' are for AVX2
if grep -qw avx2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo; then
  build gcc_avx2 g++ -O2 -ffp-contract=fast -mavx2 -mfma
  build clang_avx2 clang++ -O2 -ffp-contract=fast -mavx2 -mfma
  build clang_scalar clang++ -O2 -ffp-contract=fast -mfma -U__SSE2__
  build must_differ g++ -O2 -ffp-contract=fast -mavx2 -mfma -U__FMA__
else
  build clang_scalar clang++ -O2 -U__SSE2__
  left_out "AVX2 and fused multiply-adds, this CPU has no AVX2 or no FMA"
fi
if command -v aarch64-linux-gnu-g++ >/dev/null && command -v qemu-aarch64 >/dev/null; then
  input input_neon aarch64-linux-gnu-g++ -O2
  build gcc_neon aarch64-linux-gnu-g++ -O2 -static  # GCC fuses by default, clang within expressions
  build clang_neon clang++ --target=aarch64-linux-gnu -O2 -static
else
  left_out "NEON, there is no aarch64-linux-gnu-g++ or no qemu-aarch64"
fi
for list in inputs builds; do
  xargs -L 1 -P "$(nproc)" "$0" --compile "$directory" <"$directory/$list"
done

names=$(cut -d ' ' -f 1 "$directory/builds")
for name in $names; do
  emulator=
  case $name in *_neon) emulator=qemu-aarch64 ;; esac
  # Only a program that ran to its end leaves a file of hashes.
  ($emulator "$directory/$name" "$@" >"$directory/$name.out" && mv "$directory/$name.out" "$directory/$name.hashes") &
done
wait

reference=$directory/gcc_sse2.hashes
for name in $names; do
  hashes=$directory/$name.hashes
  if [ ! -s "$hashes" ]; then
    echo "$name: did not run to its end"
    failed=1
    [ -s "$reference" ] || break
    continue
  fi
  different=$(diff "$reference" "$hashes" | sed -n 's/^[<>] \(.*\) .*/\1/p' | sort -u)
  if [ "$name" = must_differ ]; then
    [ -n "$different" ] || failed=1
    echo "$name: $(echo "$different" | grep -c .) hashes differ where multiplications and additions are fused"
  elif [ -n "$different" ]; then
    echo "$different" | sed "s/^/$name: DIFFERENT BITS: /"
    failed=1
  else
    echo "$name: the same $(wc -l <"$hashes") hashes"
  fi
done
exit $failed
