#!/bin/sh
# check_reference.sh ROOT MADE SCRATCH: does the API reference that make.sh has put into MADE show what it must, and nothing
# else? Does make.sh fail where docstrings are missing, and say of what?
set -eu
root=$1
html=$2/html
scratch=$3
fail() { echo "$1"; exit 1; }

! find "$html" -name '*detail*' | grep . || fail "pages of what is nobody's"
! grep -rlE 'v0_[0-9]|SHORTSHOT_(TYPES|CODE|INLINE)|gnu::' "$html" --include='namespace*.html' --include='group__*.html' \
  --include='struct*.html' --include='class*.html' || fail "pages with inline namespaces or attributes"
grep -q 'for firmware, too' "$html"/structshortshot_1_1CloudView.html || fail "a type of kernel.hpp is not marked"
! grep -q 'for firmware, too' "$html"/structshortshot_1_1Features.html || fail "a type for hosts is marked as one of kernel.hpp"
grep -q 'class="fragment"' "$html"/structshortshot_1_1extend_1_1Signal.html || fail "an example in a docstring is no code"

rm -rf "$scratch"
mkdir -p "$scratch/packaging"
cp -r "$root/include" "$scratch"
cp -r "$root/packaging/reference" "$scratch/packaging"
cd "$scratch"

# forget HEADER DOCSTRING NAME: takes a docstring of one line away; what has lost it, must be reported.
expected=
forget() {
  line=$(grep -n "//.*$2" "include/shortshot/$1" | cut -d: -f1)
  [ -n "$line" ] || fail "no docstring '$2' in $1"
  sed -i "${line}s,///.*,//," "include/shortshot/$1"
  expected="$expected $1:$line:$3"
}
forget cloud/read.hpp 'The normal of point' normal                  # a function
forget cloud/cloud.hpp 'A position, in the cloud' Point             # a type
forget cloud/cloud.hpp '< number of points' size                    # a member
forget descriptor/descriptor.hpp '< of points, 96 values' Ssh96     # an alias
forget search/offer.hpp 'To be returned by a search' outcome        # a template
! packaging/reference/make.sh >log 2>&1 || fail "docstrings are missing, and nothing fails"
cat log
for place in $expected; do
  name=${place##*:}
  file=${place%%:*}
  line=${place#*:}
  line=${line%:*}
  # The declaration stands in the next line, behind a template's head, or in the same one.
  grep -qE "/$file:($line|$((line + 1))|$((line + 2))): .*\b$name\b.* is not documented" log || fail "not reported: $file:$line: $name"
done
