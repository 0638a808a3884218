// Exclusive scan by runs: one invocation walks `run` entries in turn. Joined after the prelude.

struct ScanSize {
    // Entries to scan.
    count: u32,
    // Entries of one invocation.
    run: u32,
}

@group(0) @binding(0) var<uniform> size: ScanSize;
@group(0) @binding(1) var<storage, read> lengths: array<u32>;
@group(0) @binding(2) var<storage, read_write> offsets: array<u32>;
// Written by scan_sum (sum of each run), read by scan_add (start of each run), unused by scan_top.
@group(0) @binding(3) var<storage, read_write> blocks: array<u32>;

const TOP_GROUP: u32 = 256u;
var<workgroup> partial: array<u32, TOP_GROUP>;

fn run_sum(first: u32, end: u32) -> u32 {
    var sum = 0u;
    for (var i = first; i < end; i++) {
        sum += lengths[i];
    }
    return sum;
}

// Writes the offsets of a run that starts at `start`, and the total after the last entry of all.
fn write_run(first: u32, end: u32, start: u32) {
    var running = start;
    for (var i = first; i < end; i++) {
        offsets[i] = running;
        running += lengths[i];
    }
    if end == size.count {
        offsets[size.count] = running;
    }
}

@compute @workgroup_size(64)
fn scan_sum(@builtin(global_invocation_id) id: vec3<u32>) {
    let first = linear_index(id) * size.run;
    if first >= size.count {
        return;
    }
    blocks[first / size.run] = run_sum(first, min(first + size.run, size.count));
}

@compute @workgroup_size(64)
fn scan_add(@builtin(global_invocation_id) id: vec3<u32>) {
    let first = linear_index(id) * size.run;
    if first >= size.count {
        return;
    }
    write_run(first, min(first + size.run, size.count), blocks[first / size.run]);
}

// The topmost level: one workgroup for everything.
@compute @workgroup_size(TOP_GROUP)
fn scan_top(@builtin(local_invocation_index) lane: u32) {
    let first = min(lane * size.run, size.count);
    let end = min(first + size.run, size.count);
    partial[lane] = run_sum(first, end);
    // Every lane's sum must be there before lane 0 adds them up.
    workgroupBarrier();
    if lane == 0u {
        var running = 0u;
        for (var i = 0u; i < TOP_GROUP; i++) {
            let sum = partial[i];
            partial[i] = running;
            running += sum;
        }
    }
    // The starts must be there before any lane writes its run.
    workgroupBarrier();
    // Empty runs at the end all write the same total.
    write_run(first, end, partial[lane]);
}
