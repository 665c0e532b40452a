#!/bin/sh
# check_include_order.sh INCLUDE [AT_MOST]: the folders of the library include each other one way only, in the order below,
# and are tied by AT_MOST arrows from folder to folder. INCLUDE is the folder "include" of a clone. Includes of a folder's
# own files are free; the files beside the folders are of two kinds, those that everybody may include and the umbrellas.
set -eu

# check_include_order.sh --control INCLUDE DIRECTORY: does this notice a wrong include in a copy of the tree?
if [ "$1" = --control ]; then
  while read -r file line; do
    rm -rf "$3"
    cp -R "$2" "$3"
    echo "#include $line" >>"$3/shortshot/$file"
    place=include/shortshot/$file:$(grep -c '' "$3/shortshot/$file"):
    if "$0" "$3" >"$3/out"; then
      echo "not noticed: $place $line"
      exit 1
    fi
    grep -F "$place" "$3/out" || { echo "not named: $place"; cat "$3/out"; exit 1; }
  done <<'END'
base/math.hpp "../recognition/match.hpp"
search/brute.hpp <shortshot/frame/frame.hpp>
kernel/describe.hpp "../kernel.hpp"
status.hpp "base/math.hpp"
store/binary.hpp "../attic/old.hpp"
END
  "$0" "$2" 1 | grep -F "more than 1 arrows"
  exit
fi

cd "$1"
# shellcheck disable=SC2016  # the program's own $
find shortshot -name '*.hpp' | LC_ALL=C sort | xargs awk -v at_most="${2:-70}" '
  BEGIN {
    count = split("foundation base cloud color search frame descriptor kernel dispatch batch store recognition umbrella", names, " ")
    for (i = 1; i <= count; ++i) rank[names[i]] = i
    split("config.hpp version.hpp status.hpp macros_off.hpp macros_on.hpp", foundation, " ")
    split("kernel.hpp self_check.hpp shortshot.hpp", umbrellas, " ")
    for (i in foundation) folder_of["shortshot/" foundation[i]] = "foundation"
    for (i in umbrellas) folder_of["shortshot/" umbrellas[i]] = "umbrella"
  }

  function offend(what) { print "include/" FILENAME ":" FNR ": " what; ++offenders }

  # The folder of shortshot/FOLDER/NAME, or the kind of shortshot/NAME.
  function folder(path, part) {
    if (path in folder_of) return folder_of[path]
    return split(path, part, "/") > 2 ? part[2] : path
  }

  # The path of an include as it stands in a file of the library, or nothing if it is of another library.
  function included(line, path) {
    if (line !~ /"/ && line !~ /<shortshot\//) return ""
    path = line
    gsub(/^[^"<]*["<]|[">].*$/, "", path)
    if (line !~ /"/) return path
    path = substr(FILENAME, 1, match(FILENAME, /[^\/]*$/) - 1) path
    while (sub(/[^\/]+\/\.\.\//, "", path)) continue
    return path
  }

  FNR == 1 && !(folder(FILENAME) in rank) { offend("its place in the order is not known") }

  /^[ \t]*#[ \t]*include/ {
    path = included($0)
    if (path == "") next
    from = folder(FILENAME)
    to = folder(path)
    if (from == to) next
    ++files[from " -> " to]
    if (!(to in rank)) {
      offend("includes " path ", whose place in the order is not known")
    } else if (rank[to] > rank[from]) {
      offend(from " comes before " to " and must not include " path)
    }
  }

  END {
    for (arrow in files) { ++arrows; lines += files[arrow] }
    print arrows + 0 " arrows from folder to folder, by " lines + 0 " includes"
    if (arrows > at_most) {
      print "more than " at_most " arrows:"
      for (arrow in files) print "  " arrow
    }
    exit offenders > 0 || arrows > at_most || arrows == 0
  }'
