# What the headline and bench/paper/README.md need of reports of `./run paper registration DATA...`:
#   jq -s -f bench/results/registration.jq REPORT.json... > bench/results/registration.json
# A set's rows are those of all reports, each descriptor's of the first that has it. Times are left out: those of several
# threads, or of a machine that others keep busy, are not for comparison.
[.[].sections[] | . as $section | .tables[] | select(.name | endswith("_registration"))
  | {set: $section.heading, pairs: ($section.text | capture("^(?<n>[0-9]+) pairs").n | tonumber), rows}]
| group_by(.set)
| map({set: .[0].set, pairs: .[0].pairs, rows: ([.[].rows[]] | reduce .[] as $row ([];
    if any(.[]; .descriptor == $row.descriptor) then . else . + [$row | del(.microseconds)] end))})
