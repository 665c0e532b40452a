#!/bin/sh
# count_names.sh INCLUDE AT_MOST: how many different names stand in namespace shortshot itself, types and code, for
# everybody who writes `using namespace shortshot`? Counted in the headers' text: declarations at a namespace's own level.
set -eu
# shellcheck disable=SC2016  # the program's own $
names=$(find "$1/shortshot" -name '*.hpp' -exec awk '
  FNR == 1 { inside = 0 }
  /^namespace shortshot \{$/ { inside = 1; next }
  /^}  \/\/ namespace shortshot$/ { inside = 0; next }
  !inside { next }
  /^(template|\/\/|#|}| |inline namespace|$)/ { next }
  {
    line = $0
    gsub(/\[\[[^]]*\]\]/, "", line); gsub(/SHORTSHOT_INLINE/, "", line)
    sub(/^ +/, "", line)
    if (match(line, /^(struct|class|enum class|using|inline constexpr [a-z:_0-9]+) +[A-Za-z_0-9]+/)) {
      n = split(substr(line, RSTART, RLENGTH), word, " "); print word[n]
    } else if (match(line, /[A-Za-z_0-9]+(\(|;)/)) {
      name = substr(line, RSTART, RLENGTH - 1); if (name !~ /^(namespace|static_assert)$/) print name
    }
  }' {} + | LC_ALL=C sort -u)
count=$(printf '%s\n' "$names" | grep -c .)
echo "$count names in shortshot, at most $2"
[ "$count" -le "$2" ] || { printf '%s\n' "$names"; exit 1; }
[ "$count" -gt 60 ]  # less would mean that nothing is counted
