#!/usr/bin/env bash
# Hard shadows on random triangles against shadow rays through Embree 3: the same view-samples, two threads each, interleaved.
#
#   docs/bench/embree/run.sh [ROUNDS [COUNT..]]        default: 5 rounds of 1000 10000 100000 1000000 triangles
#
# Ours: list_build, its scan, list_fill, casters and visibility (fused), from the program's own record; every round runs the frame
# five times after a warm-up. Theirs: scene build and rtcOccluded16 over all kept view-samples, five times after a warm-up
# (see peer.c for self hits). A round is one of ours, then one of theirs; the ratio is that of the two medians of a round.
# Printed: median of the rounds, and smallest and largest in brackets. Without Embree 3 or a C compiler it says so and stops.
set -euo pipefail
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
rounds=${1:-5}
shift || true
counts=("$@")
[ ${#counts[@]} -gt 0 ] || counts=(1000 10000 100000 1000000)
size=1024x768
threads=2
for tool in cc jq; do
    command -v "$tool" > /dev/null || { echo "skipped: $tool is not installed"; exit 0; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if ! cc -O3 -o "$work/peer" "$here/peer.c" -lembree3 -lpthread 2> "$work/cc.log"; then
    echo "skipped: Embree 3 is not installed (Debian: apt install libembree-dev)"
    head -3 "$work/cc.log"
    exit 0
fi
program=${SHADOWGRAPH:-}
if [ -z "$program" ]; then
    cargo build --release --quiet --manifest-path "$root/Cargo.toml" -p shadowgraph
    program=${CARGO_TARGET_DIR:-$root/target}/release/shadowgraph
fi

ours() { # count, more arguments: milliseconds of our nodes
    "$program" render "$here/fused.ron" --scene "builtin:random-triangles?count=$1" --size $size --backend cpu \
        --threads $threads --repeat 5 --quiet --json "${@:2}" | jq '
        [.nodes[] | select(.node == ("list_build", "list_scan", "list_fill", "casters", "visibility"))]
        | [.[].millis] | transpose | map(add) | sort | .[length / 2 | floor]'
}
middle() { sort -n | awk '{ v[NR] = $1 } END { printf "%.2f [%.2f..%.2f]", v[int((NR + 1) / 2)], v[1], v[NR] }'; }

printf '%s threads, %s, %s rounds, milliseconds\n' $threads $size "$rounds"
printf '%9s %9s %9s  %-24s %-24s %-24s %s\n' triangles rays differ ours 'Embree build + trace' 'of which build' 'ours / Embree'
for count in "${counts[@]}"; do
    dump=$work/$count
    ours "$count" --dump "$dump" > /dev/null
    for pair in view_samples.position:position view_samples.triangle:triangle \
        sample_filter.sample_state:sample_state visibility.mask:mask; do
        cp "$dump/${pair%%:*}.npy" "$dump/${pair##*:}.npy"
    done
    : > "$work/ours"; : > "$work/theirs"; : > "$work/build"; : > "$work/ratio"
    for _ in $(seq "$rounds"); do
        mine=$(ours "$count")
        peer=$("$work/peer" "$dump" 5 $threads)
        total=$(jq '.total_ms[0]' <<< "$peer")
        echo "$mine" >> "$work/ours"
        echo "$total" >> "$work/theirs"
        jq '.build_ms[0]' <<< "$peer" >> "$work/build"
        awk -v a="$mine" -v b="$total" 'BEGIN { print a / b }' >> "$work/ratio"
    done
    printf '%9s %9s %9s  %-24s %-24s %-24s %s\n' "$count" "$(jq .rays <<< "$peer")" "$(jq .differ <<< "$peer")" \
        "$(middle < "$work/ours")" "$(middle < "$work/theirs")" "$(middle < "$work/build")" "$(middle < "$work/ratio")"
    rm -rf "$dump"
done
