// Boxes of a tree as threaded.rs tells; the kernel declares `bvh_nodes: array<vec4<u32>>`, two a node.

const BVH_END: u32 = 0xffffffffu;
const LEAF_BITS: u32 = 3u;
const SLAB_ERROR: f32 = 6e-7;

// Reciprocals of a direction; a component of zero counts as one too small to leave a slab it starts in.
fn reciprocal(along: vec3<f32>) -> vec3<f32> {
    return 1.0 / select(along, vec3<f32>(1e-37), abs(along) < vec3<f32>(1e-37));
}

// Whether the segment from `start`, 0 at its start and 1 at its end, may meet the box.
fn segment_enters(low: vec3<f32>, high: vec3<f32>, start: vec3<f32>, inverse: vec3<f32>) -> bool {
    let a = (low - start) * inverse;
    let b = (high - start) * inverse;
    let nearer = min(a, b);
    let further = max(a, b);
    let near = max(max(nearer.x, nearer.y), nearer.z);
    let far = min(min(further.x, further.y), further.z);
    let early = near * select(1.0 + SLAB_ERROR, 1.0 - SLAB_ERROR, near >= 0.0);
    let late = far * select(1.0 - SLAB_ERROR, 1.0 + SLAB_ERROR, far >= 0.0);
    return early <= late && late >= 0.0 && early <= 1.0;
}
