#!/bin/sh
# test_fuzz.sh FUZZ DIRECTORY: what tests/fuzz/fuzz.sh says of harnesses, which are replaced by scripts: one that finds
# nothing, one that finds something, and one that dies before it has begun.
set -eu
directory=$2
rm -rf "$directory"
mkdir -p "$directory/build/tests/fuzz" "$directory/corpus/calm" "$directory/corpus/found" "$directory/corpus/dead"
cp "$1" "$directory/fuzz.sh"  # beside a corpus of our own

harness() {
  printf '#!/bin/sh\n%s\n' "$2" >"$directory/build/tests/fuzz/fuzz_$1"
  chmod +x "$directory/build/tests/fuzz/fuzz_$1"
}
harness calm 'echo "stat::number_of_executed_units: 12"; echo "stat::new_units_added:  3"'
harness found 'echo "artifact_prefix; Test unit written to /somewhere/found-crash-1"; exit 77'
harness dead 'exit 1'

fail() {
  echo "$1"
  cat "$directory/out"
  exit 1
}
fuzz() {
  code=0
  "$directory/fuzz.sh" "$directory/build" "$@" >"$directory/out" 2>&1 || code=$?
}
says() { grep -q -- "$1" "$directory/out" || fail "not said: $1"; }

echo "nothing found: figures, and success"
fuzz 1 calm
[ "$code" = 0 ] || fail "exit code $code, not 0"
says "^calm: 12 executions, 3 new units, 0 findings$"

echo "a finding among others: its path, and failure"
fuzz 1 calm found
[ "$code" = 1 ] || fail "exit code $code, not 1"
says "^calm: 12 executions"
says "^finding: /somewhere/found-crash-1$"

echo "findings of before are no findings of now"
fuzz 1 calm
[ "$code" = 0 ] || fail "exit code $code, not 0"

echo "a harness that ends by itself: its output, and failure"
fuzz 1
[ "$code" = 1 ] || fail "exit code $code, not 1"
says "^finding: .*/dead.log$"

echo "no such harness, no such time"
for arguments in "1 nobody" "soon calm"; do
  # shellcheck disable=SC2086  # a time and a name
  fuzz $arguments
  [ "$code" = 2 ] || fail "exit code $code, not 2"
done
