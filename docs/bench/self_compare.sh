#!/usr/bin/env bash
# How often `compare` calls a graph different from itself: N comparisons, each with an order of timings of its own.
#
#     cargo build --release
#     docs/bench/self_compare.sh 50 hard_fused --scene builtin:columns --size 48x36 --seconds 6
#
# Prints a row for each run (seed, blocks, ratio, interval, verdict of the whole frame, nodes called faster or slower) and the count. A
# run of fewer than 15 blocks can give no verdict and proves nothing: give it more --seconds or a smaller picture.
# Exit status 1: some run called the graph different, or proves nothing. PROGRAM names another build.
set -euo pipefail
cd "$(dirname "$0")/../.."
program="${PROGRAM:-target/release/shadowgraph}"
count="${1:?how many comparisons}"
shift

echo "| run | blocks | B / A | interval | verdict | nodes called different |"
echo "|---|---|---|---|---|---|"
different=0
nodes=0
short=0
for run in $(seq "$count"); do
    row=$("$program" compare "$@" --no-truth --quiet --json --seed "$run" | jq -r '
        def short: . * 10000 | round / 10000;
        .timing as $t | $t.frame as $f
        | [$t.nodes[] | select(.summary.verdict == "faster" or .summary.verdict == "slower")
            | "\(.node) \(.summary.verdict)"] as $nodes
        | [($f.blocks_count | tostring), ($f.ratio | short | tostring),
           "\($f.interval.low | short) .. \($f.interval.high | short)", $f.verdict, ($nodes | join(", "))]
        | join(" | ")')
    echo "| $run | $row |"
    [ "${row%% *}" -ge 15 ] || short=$((short + 1))
    case "$row" in *"| faster |"* | *"| slower |"*) different=$((different + 1)) ;; esac
    case "$row" in *"| ") ;; *) nodes=$((nodes + 1)) ;; esac
done
echo
echo "$different of $count runs called the graph faster or slower than itself; $nodes of $count had a node that was called so;"
echo "$short of $count had too few blocks for a verdict"
[ "$different" -eq 0 ] && [ "$short" -eq 0 ]
