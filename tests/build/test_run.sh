#!/bin/sh
# test_run.sh RUN DIRECTORY: what ./run does on machines with and without the packages that it needs. The commands that
# would change a machine are replaced by scripts that only write down their arguments.
set -eu
directory=$2
run=$directory/run
stubs=$directory/bin
log=$directory/log
rm -rf "$directory"
mkdir -p "$stubs"
cp "$1" "$run"  # away from the project, so that its programs are not there

stub() {
  printf '#!/bin/sh\n%s\n' "$2" >"$stubs/$1"
  chmod +x "$stubs/$1"
}
for tool in cmake apt-get; do stub $tool "echo $tool \"\$@\" >>'$log'"; done
for tool in sh dirname grep sed nproc env; do ln -s "$(command -v $tool)" "$stubs/$tool"; done
user() { stub id "echo $1"; }
lacks() { stub dpkg-query "case \$4 in $1) exit 1 ;; *) echo installed ;; esac"; }

# attempt CODE: runs the demo on that machine; its program is not there, so that 127 means: went on to it.
attempt() {
  code=0
  : >"$log"
  PATH=$stubs "$run" demo >"$directory/out" 2>&1 || code=$?
}

fail() {
  echo "$1"
  cat "$log"
  exit 1
}
expect() { grep -q -- "$1" "$log" || fail "not done: $1"; }
refuse() { ! grep -q -- "$1" "$log" || fail "done: $1"; }

echo "a machine that has everything: nothing is installed"
lacks nothing
user 1000
attempt
refuse apt-get
expect "cmake --preset default"
expect "cmake --build --preset default .*--target demo"

echo "root, one package missing: it is installed, and only it"
lacks cmake
user 0
attempt
expect "apt-get update"
expect "apt-get install -y --no-install-recommends cmake$"
expect "cmake --build"

echo "a user with sudo"
user 1000
stub sudo "echo sudo >>'$log'; \"\$@\""
attempt
expect sudo
expect "apt-get install"

echo "a user without sudo: told what is missing and how to get it"
rm "$stubs/sudo"
attempt
[ "$code" = 1 ] || fail "exit code $code, not 1"
refuse apt-get
refuse "cmake --"
grep -q "missing: cmake" "$directory/out" || fail "the package is not named"
grep -q "apt-get install .*cmake" "$directory/out" || fail "the command is not named"

echo "help lists the commands, an unknown command is an error"
"$run" help | grep -q "run demo" || fail "no demo in the help"
code=0
"$run" nonsense 2>/dev/null || code=$?
[ "$code" = 2 ] || fail "exit code $code, not 2"
