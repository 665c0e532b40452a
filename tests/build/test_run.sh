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
for tool in cmake ctest apt-get; do stub $tool "echo $tool \"\$@\" >>'$log'"; done
for tool in sh dirname grep sed nproc env find sort date; do ln -s "$(command -v $tool)" "$stubs/$tool"; done
user() { stub id "echo $1"; }
lacks() { stub dpkg-query "case \$4 in $1) exit 1 ;; *) echo installed ;; esac"; }

# attempt ARGUMENTS: runs a command on that machine. The programs that it builds are not there, so that 127 means: went on
# to one.
attempt() {
  code=0
  : >"$log"
  PATH=$stubs "$run" "$@" >"$directory/out" 2>&1 || code=$?
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
attempt demo
refuse apt-get
expect "cmake --preset default"
expect "cmake --build --preset default .*--target demo"

echo "root, one package missing: it is installed, and only it"
lacks cmake
user 0
attempt demo
expect "apt-get update"
expect "apt-get install -y --no-install-recommends cmake$"
expect "cmake --build"

echo "a user with sudo"
user 1000
stub sudo "echo sudo >>'$log'; \"\$@\""
attempt demo
expect sudo
expect "apt-get install"

echo "a user without sudo: told what is missing and how to get it"
rm "$stubs/sudo"
attempt demo
[ "$code" = 1 ] || fail "exit code $code, not 1"
refuse apt-get
refuse "cmake --"
grep -q "missing: cmake" "$directory/out" || fail "the package is not named"
grep -q "apt-get install .*cmake" "$directory/out" || fail "the command is not named"

echo "one file of tests: what it needs is installed, and nothing but it is built"
mkdir -p "$directory/tests/unit/descriptor" "$directory/tests/unit/store" "$directory/tests/bench/paper"
for test in unit/descriptor/test_voting bench/paper/test_twice unit/store/test_twice; do
  : >"$directory/tests/$test.cpp"
done
user 0
lacks "libembree-dev | doctest-dev"
attempt unit test_voting
[ "$code" = 127 ] || fail "exit code $code, not 127"
expect "apt-get install -y --no-install-recommends doctest-dev$"
expect "cmake --preset default -DSHORTSHOT_REQUIRE_ALL_TESTS=OFF$"
expect "cmake --build .*--target unit_tests.test_voting$"

echo "a machine that Open3D is not made for: it is left out, said so, and the other peers are compared"
user 0
lacks libopen3d-dev
stub apt-get "echo apt-get \"\$@\" >>'$log'; case \$1 in install) exit 100 ;; esac"
attempt peers
[ "$code" = 127 ] || fail "exit code $code, not 127"
grep -q "Open3D is left out" "$directory/out" || fail "nothing is said of Open3D"
expect "cmake --build --preset peers"
stub apt-get "echo apt-get \"\$@\" >>'$log'"

echo "registration: FPFH of what is installed is compared, of the others it is left out, said so; --quick leaves out both"
mkdir -p "$directory/bench/paper"
cp "$(dirname "$1")/bench/paper/start.sh" "$directory/bench/paper"
lacks libopen3d-dev
attempt paper registration data
[ "$code" = 127 ] || fail "exit code $code, not 127"
expect "cmake --build --preset peers .*--target fpfh_pcl$"
refuse "fpfh_open3d"
grep -q "FPFH of open3d is left out: libopen3d-dev" "$directory/out" || fail "nothing is said of Open3D's FPFH"
grep -q "paper registration data --peer fpfh-pcl=" "$directory/out" || fail "PCL's FPFH is not compared"
attempt paper registration --quick data
refuse "fpfh_"

echo "a name that no file of tests has, or several have: the files are named"
for name in otin twice ''; do
  attempt unit $name
  [ "$code" = 2 ] || fail "exit code $code, not 2"
  refuse "cmake --"
  grep -q "twice" "$directory/out" || fail "no file is named"
done

echo "steps are counted, and timed in the end, also of a failure"
lacks nothing
attempt test -L unit
grep -q "^step 1 of 2: GCC: build$" "$directory/out" || fail "step 1 is not announced"
tail -n 1 "$directory/out" | grep -qE "^steps: GCC: build [0-9]+ s, GCC: tests [0-9]+ s$" || fail "steps are not timed"
[ "$code" = 0 ] || fail "exit code $code, not 0"
stub ctest "exit 8"
attempt test
tail -n 1 "$directory/out" | grep -qE "^steps: GCC: build [0-9]+ s, GCC: tests [0-9]+ s$" || fail "steps are not timed"
[ "$code" = 8 ] || fail "exit code $code, not 8"

echo "help lists the commands, an unknown command is an error"
"$run" help | grep -q "run demo" || fail "no demo in the help"
code=0
"$run" nonsense 2>/dev/null || code=$?
[ "$code" = 2 ] || fail "exit code $code, not 2"
