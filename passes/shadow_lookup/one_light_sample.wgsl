// The bindings of lookups for one light sample, and what becomes of their share.

struct LookupParams {
    sample_count: u32,
    face_count: u32,
    side: u32,
    kernel: u32,
    bias_constant: f32,
    bias_slope: f32,
    normal_offset: f32,
}

@group(0) @binding(0) var<uniform> lookup: LookupParams;
@group(0) @binding(1) var depth_map: texture_depth_2d_array;
@group(0) @binding(2) var<storage, read> light_frame: array<f32>;
@group(0) @binding(3) var<storage, read> position: array<f32>;
@group(0) @binding(4) var<storage, read> normal: array<f32>;
@group(0) @binding(5) var<storage, read> sample_state: array<u32>;
@group(0) @binding(6) var<storage, read_write> mask: array<u32>;
@group(0) @binding(7) var<storage, read_write> visible: array<f32>;

// Writes one view-sample's share and mask.
fn lookup_write(row: u32, kernel: u32) {
    if row >= lookup.sample_count {
        return;
    }
    let state = sample_state[row];
    var share = 1.0;
    var bits = 0u;
    if state == KEPT {
        let at = vec3<f32>(position[3u * row], position[3u * row + 1u], position[3u * row + 2u]);
        let n = vec3<f32>(normal[3u * row], normal[3u * row + 1u], normal[3u * row + 2u]);
        let placed = lookup_place(at, n, 0u);
        share = lookup_share(placed, placed.point.face, kernel);
        bits = select(0u, 1u, share < 0.5);
    } else if state != BACKGROUND {
        share = 0.0;
        bits = 0xffffffffu;
    }
    visible[row] = share;
    mask[row] = bits;
}
