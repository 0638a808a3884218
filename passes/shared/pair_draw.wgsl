// Pairs from fragments; joined after fan.wgsl.
struct Numbers {
    face: u32,
    side: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> fans: array<f32>;
@group(0) @binding(2) var<storage, read> list_length: array<u32>;
@group(0) @binding(3) var<storage, read> list_far: array<f32>;
@group(0) @binding(4) var<storage, read_write> pair_cell: array<u32>;
@group(0) @binding(5) var<storage, read_write> pair_slot: array<u32>;
@group(0) @binding(6) var<storage, read_write> pair_caster: array<u32>;
@group(0) @binding(7) var<storage, read_write> caster_length: array<atomic<u32>>;
// Pairs.
@group(0) @binding(8) var<storage, read_write> counters: array<atomic<u32>>;

@fragment
fn pair(vertex: Vertex) {
    let cell = fragment_cell(vertex, numbers.face, numbers.side);
    if list_length[cell] == 0u {
        return;
    }
    if !fragment_counts(vertex, numbers.side, list_far[cell]) {
        return;
    }
    let slot = atomicAdd(&caster_length[cell], 1u);
    // The count goes on past the capacity: it is what would have been needed.
    let place = atomicAdd(&counters[0], 1u);
    if place < arrayLength(&pair_cell) {
        pair_cell[place] = cell;
        pair_slot[place] = slot;
        pair_caster[place] = vertex.triangle;
    }
}
