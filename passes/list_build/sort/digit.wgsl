// One digit of a least-significant-digit radix sort. One invocation walks `run` pairs in turn, so equal digits keep their
// order; counters are stored digit by digit, so that their scan gives each run its place within each digit.

struct DigitSize {
    // Pairs.
    count: u32,
    // Pairs of one invocation.
    run: u32,
    // Invocations.
    runs: u32,
    // Lowest bit of the digit; 0: the first digit, and view-samples are still in view order.
    shift: u32,
}

@group(0) @binding(0) var<uniform> size: DigitSize;
@group(0) @binding(1) var<storage, read> keys: array<u32>;
@group(0) @binding(2) var<storage, read> order: array<u32>;
// Written by sort_count; their scan is read by sort_scatter.
@group(0) @binding(3) var<storage, read_write> counters: array<u32>;
@group(0) @binding(4) var<storage, read_write> keys_sorted: array<u32>;
@group(0) @binding(5) var<storage, read_write> order_sorted: array<u32>;

const DIGIT_BITS: u32 = 4u;
const DIGITS: u32 = 1u << DIGIT_BITS;

fn digit_of(key: u32) -> u32 {
    return (key >> size.shift) & (DIGITS - 1u);
}

@compute @workgroup_size(64)
fn sort_count(@builtin(global_invocation_id) id: vec3<u32>) {
    let own = linear_index(id);
    if own >= size.runs {
        return;
    }
    var counts: array<u32, DIGITS>;
    let first = own * size.run;
    for (var i = first; i < min(first + size.run, size.count); i++) {
        counts[digit_of(keys[i])] += 1u;
    }
    for (var digit = 0u; digit < DIGITS; digit++) {
        counters[digit * size.runs + own] = counts[digit];
    }
}

@compute @workgroup_size(64)
fn sort_scatter(@builtin(global_invocation_id) id: vec3<u32>) {
    let own = linear_index(id);
    if own >= size.runs {
        return;
    }
    var next: array<u32, DIGITS>;
    for (var digit = 0u; digit < DIGITS; digit++) {
        next[digit] = counters[digit * size.runs + own];
    }
    let first = own * size.run;
    for (var i = first; i < min(first + size.run, size.count); i++) {
        let key = keys[i];
        let digit = digit_of(key);
        let to = next[digit];
        next[digit] = to + 1u;
        keys_sorted[to] = key;
        if size.shift == 0u {
            order_sorted[to] = i;
        } else {
            order_sorted[to] = order[i];
        }
    }
}
