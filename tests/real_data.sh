#!/bin/sh
# real_data.sh PROGRAMS RESULTS: the tools on real recordings, which cannot be part of the project; where they lie beside it,
# in ../shared, they are used. SHORTSHOT_REQUIRE_REAL_DATA, set where changes are merged, makes their absence an error.
# PROGRAMS is where the tools were built, RESULTS a folder for what the experiments write.
set -eu
shared=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)/../shared
programs=$1
results=$2

show() { printf '+ %s\n' "$*" >&2; "$@"; }

if [ ! -d "$shared" ]; then
  echo "real-data checks skipped: no ../shared"
  [ -z "${SHORTSHOT_REQUIRE_REAL_DATA:-}" ] || { echo "error: SHORTSHOT_REQUIRE_REAL_DATA is set"; exit 1; }
  exit 0
fi
show "$programs/golden" "$shared"/golden/*/
show "$programs/demo" --check "$shared"/data/mosd_scenes/*.pcd
show "$programs/demo" --check "$shared"/data/kinect_tombari/models_color/*.ply
for experiment in matching recognition ablation; do
  rm -rf "${results:?}/$experiment"  # results of another version
  show "$programs/paper" $experiment --quick --check --out "$results/$experiment" "$shared/data"
done
rm -rf "${results:?}/tradeoff"
show "$programs/tradeoff" draw --quick --check --out "$results/tradeoff" "$shared/data"
echo "real-data checks passed"
