#!/bin/sh
# check_pkg_config.sh PREFIX VERSION COMPILER MAIN PROGRAM: compiles MAIN by what pkg-config says of the installation in
# PREFIX, runs it, and moves the installation and asks once more.
set -eu
fail() { echo "error: $*"; exit 1; }
prefix=$1
moved=$5.moved
export PKG_CONFIG_PATH="$prefix/share/pkgconfig"

pkg-config --validate shortshot
[ "$(pkg-config --modversion shortshot)" = "$2" ] || fail "not version $2"
# shellcheck disable=SC2046  # one word for each flag
"$3" -std=c++17 $(pkg-config --cflags shortshot) "$4" $(pkg-config --libs shortshot) -o "$5"
"$5"

rm -rf "$moved"
mkdir -p "$moved"
cp -r "$prefix/share" "$moved"
PKG_CONFIG_PATH=$moved/share/pkgconfig
[ "$(realpath -m "$(pkg-config --variable=includedir shortshot)")" = "$(realpath "$moved")/include" ] ||
  fail "the paths do not follow the installation"
