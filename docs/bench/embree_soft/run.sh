#!/usr/bin/env bash
# Soft shadows against shadow rays through Embree 3: the same view-samples and light samples, two threads each, interleaved.
#
#   docs/bench/embree_soft/run.sh SCENES [ROUNDS [FILTER [PASS]]]
#
# SCENES: a folder of .glb files with views.json, in which every view has a sphere light. FILTER: a regular expression on
# scene/view, default all. PASS: the pass of stage visibility, default that of soft.ron. Environment: SAMPLES (256), SIZE (512x512),
# RUNS of ours a round (3), SHADOWGRAPH (the program; built when unset).
# Ours: casters and visibility, from the program's own record, median of RUNS after a warm-up; its build is that of the same view as
# one pixel with one light sample, where next to nothing else is done. Theirs: scene build and rtcOccluded16 for every kept view-sample
# and light sample, once after a warm-up (see peer.c). A round is one of ours, then one of theirs; figures are medians of the rounds,
# in milliseconds; a ratio is theirs / ours of one round, `trace` without and `total` with the builds on both sides.
set -euo pipefail
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
scenes=${1:?a folder with .glb files and views.json}
rounds=${2:-1}
filter=${3:-.}
pass=${4:-}
samples=${SAMPLES:-256}
size=${SIZE:-512x512}
runs=${RUNS:-3}
threads=2
for tool in cc jq; do
    command -v "$tool" > /dev/null || { echo "skipped: $tool is not installed"; exit 0; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if ! cc -O3 -o "$work/embree" "$here/peer.c" -lembree3 -lpthread 2> "$work/cc.log"; then
    echo "skipped: Embree 3 is not installed (Debian: apt install libembree-dev)"
    head -3 "$work/cc.log"
    exit 0
fi
program=${SHADOWGRAPH:-}
if [ -z "$program" ]; then
    cargo build --release --quiet --manifest-path "$root/Cargo.toml" -p shadowgraph
    program=${CARGO_TARGET_DIR:-$root/target}/release/shadowgraph
fi

ours() { # scene, view, size, samples, more arguments: milliseconds of our nodes
    "$program" render "$here/soft.ron" --scene "$scenes/$1.glb" --views "$scenes/views.json" --view "$2" --size "$3" \
        --light-samples "$4" --backend cpu --threads $threads --quiet --json ${pass:+--swap visibility=$pass} "${@:5}" | jq '
        [.nodes[] | select(.node == ("casters", "visibility"))] | [.[].millis] | transpose | map(add) | sort | .[length / 2 | floor]'
}
middle() { sort -n | awk '{ v[NR] = $1 } END { if (NR) printf "%.2f", v[int((NR + 1) / 2)] }'; }

printf '%s threads, %s, %s light samples, %s rounds, load %s\n' $threads "$size" "$samples" "$rounds" "$(cut -d' ' -f1 /proc/loadavg)"
printf '%-28s %9s %8s %9s | %8s %8s %8s | %8s %8s %8s | %7s %7s\n' scene/view triangles penumbra differ \
    'ours' build trace embree build trace total trace
jq -r '.scenes | to_entries[] | .key as $scene | .value.views[] | "\($scene) \(.name)"' "$scenes/views.json" |
    while read -r scene view; do
        grep -Eq "$filter" <<< "$scene/$view" || continue
        dump=$work/dump
        ours "$scene" "$view" "$size" "$samples" --dump "$dump" > /dev/null < /dev/null
        for pair in view_samples.position:position view_samples.triangle:triangle \
            sample_filter.sample_state:sample_state visibility.mask:mask; do
            mv "$dump/${pair%%:*}.npy" "$dump/${pair##*:}.npy"
        done
        for column in mine build peer peer_build ratio trace; do : > "$work/$column"; done
        for _ in $(seq "$rounds"); do
            mine=$(ours "$scene" "$view" "$size" "$samples" --repeat "$runs" < /dev/null)
            build=$(ours "$scene" "$view" 1x1 1 --repeat "$runs" < /dev/null)
            peer=$("$work/embree" "$dump" 1 $threads)
            total=$(jq '.total_ms[0]' <<< "$peer")
            theirs=$(jq '.build_ms[0]' <<< "$peer")
            echo "$mine" >> "$work/mine"; echo "$build" >> "$work/build"
            echo "$total" >> "$work/peer"; echo "$theirs" >> "$work/peer_build"
            awk -v a="$mine" -v b="$total" 'BEGIN { print b / a }' >> "$work/ratio"
            awk -v a="$mine" -v c="$build" -v b="$total" -v d="$theirs" 'BEGIN { print (b - d) / (a > c ? a - c : 0.001) }' >> "$work/trace"
        done
        a=$(middle < "$work/mine"); c=$(middle < "$work/build"); b=$(middle < "$work/peer"); d=$(middle < "$work/peer_build")
        printf '%-28s %9s %8s %9s | %8.1f %8.1f %8.1f | %8.1f %8.1f %8.1f | %6.2fx %6.2fx\n' "$scene/$view" \
            "$(jq .triangles <<< "$peer")" "$(jq .penumbra <<< "$peer")" "$(jq .differ <<< "$peer")" \
            "$a" "$c" "$(awk -v a="$a" -v c="$c" 'BEGIN { print a - c }')" \
            "$b" "$d" "$(awk -v a="$b" -v c="$d" 'BEGIN { print a - c }')" \
            "$(middle < "$work/ratio")" "$(middle < "$work/trace")"
        echo "$scene $(middle < "$work/ratio") $(middle < "$work/trace")" >> "$work/all"
        rm -rf "$dump"
    done
[ -s "$work/all" ] || { echo "no view matches $filter"; exit 1; }
for column in 2 3; do
    name=$([ $column = 2 ] && echo 'with builds' || echo 'without builds')
    sponza=$(awk -v c=$column '/^sponza/ { print $c }' "$work/all" | middle)
    least=$(awk -v c=$column '{ print $c }' "$work/all" | sort -n | head -1)
    echo "$name: median of all views $(awk -v c=$column '{ print $c }' "$work/all" | middle)x, of Sponza's ${sponza:--}x, least ${least}x"
done
