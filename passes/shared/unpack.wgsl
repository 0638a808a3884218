// Masks in view order from what is known in list order.
struct Numbers {
    samples: u32,
    cells: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> list_offset: array<u32>;
@group(0) @binding(2) var<storage, read> list_entries: array<u32>;
@group(0) @binding(3) var<storage, read> blocked: array<u32>;
@group(0) @binding(4) var<storage, read_write> mask: array<u32>;

@compute @workgroup_size(64)
fn unpack(@builtin(global_invocation_id) id: vec3<u32>) {
    let total = list_offset[numbers.cells];
    let entry = linear_index(id);
    if entry < total {
        mask[list_entries[entry]] = blocked[entry];
    }
}
