#!/bin/sh
# check_deb.sh DIRECTORY ROOT VERSION HEADERS: is the one package in DIRECTORY what Debian expects, with all of HEADERS?
# Real dpkg installs it below ROOT, removes it without a trace, and installs it again: the machine's own packages are
# not touched.
set -eu
directory=$1
dpkg_root=$2
version=$3
headers=$4

fail() { echo "error: $*"; exit 1; }
is() { [ "$(dpkg-deb --field "$deb" "$1")" = "$2" ] || fail "$1 is $(dpkg-deb --field "$deb" "$1"), not $2"; }

deb=$directory/libshortshot-dev_${version}_all.deb
[ "$(find "$directory" -maxdepth 1 -name '*.deb')" = "$deb" ] || fail "not one package, of version $version"
is Package libshortshot-dev
is Version "$version"
is Architecture all
is Section libdevel
is Depends ""  # a compiler is all it takes

# Of whatever is no header, each file has its place.
others=$(dpkg-deb --contents "$deb" | sed 's/.* \.//' | grep -v -e '/$' -e '\.hpp$' | sort)
[ "$others" = "/usr/share/cmake/shortshot/shortshotConfig.cmake
/usr/share/cmake/shortshot/shortshotConfigVersion.cmake
/usr/share/cmake/shortshot/shortshotTargets.cmake
/usr/share/doc/libshortshot-dev/copyright
/usr/share/pkgconfig/shortshot.pc
/usr/share/shortshot/package.xml" ] || fail "other files than expected: $others"

rm -rf "$dpkg_root"
mkdir -p "$dpkg_root/var/lib/dpkg/info" "$dpkg_root/var/lib/dpkg/updates" "$dpkg_root/var/log"
: >"$dpkg_root/var/lib/dpkg/status"
in_root() { dpkg --root="$dpkg_root" --force-not-root --force-bad-path --log="$dpkg_root/var/log/dpkg" "$@"; }
in_root --install "$deb"
diff -r --exclude=README.md "$headers" "$dpkg_root/usr/include/shortshot" || fail "other headers than the project's"
in_root --purge libshortshot-dev
[ -z "$(find "$dpkg_root/usr" -type f 2>/dev/null)" ] || fail "files stay behind"
in_root --install "$deb"
