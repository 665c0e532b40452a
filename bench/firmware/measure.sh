#!/bin/sh
# measure.sh [--quick] [--update-hashes] [--record]: builds and runs what is in this folder on emulated microcontrollers
# and compares it with budgets.json and hashes.json. ./run firmware installs and builds what this needs.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
firmware=$root/bench/firmware
built=$root/build/firmware
quick=
record=
update=
for option; do
  case $option in
    --quick) quick=1 ;;
    --update-hashes) update=--update-hashes ;;
    --record) record=1 ;;
  esac
done

say() { printf '%s\n' "$*" >&2; }
show() { say "+ $*"; "$@"; }

# Nothing of the caller's environment chooses what is measured.
show env -u TARGETS -u CHUNK -u WORKSPACES -u LIBRARY -u B -u QUICK \
  make --no-print-directory -s -j "$(nproc)" -C "$firmware" ${quick:+QUICK=1} || {
  say "error: not built; where the linker refuses an image, its line 'promise: ...' names what is broken"
  exit 1
}
show "$root/build/default/bench/firmware_report" "$built/facts.list" "$firmware/budgets.json" "$firmware/hashes.json" \
  --json "$built/firmware.json" $update
[ -z "$record" ] || show cp "$built/firmware.json" "$root/bench/results/firmware.json"
