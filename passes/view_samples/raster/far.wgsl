// The largest depth of any corner in front of the eye: the scale of the depth buffer.

@group(0) @binding(0) var<uniform> size: vec4<u32>; // triangles, invocations, 0, 0
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> camera: array<f32>;
// Bits of a float that is not negative, zero at first: such bits are in the order of the floats.
@group(0) @binding(3) var<storage, read_write> farthest: atomic<u32>;

@compute @workgroup_size(64)
fn raster_far(@builtin(global_invocation_id) id: vec3<u32>) {
    let first = linear_index(id);
    if first >= size.y {
        return;
    }
    var depth = 0.0;
    for (var triangle = first; triangle < size.x; triangle += size.y) {
        for (var corner = 0u; corner < 3u; corner++) {
            let word = 9u * triangle + 3u * corner;
            let position = vec3<f32>(triangles[word], triangles[word + 1u], triangles[word + 2u]);
            depth = max(depth, dot(camera_forward(), position - camera_eye()));
        }
    }
    atomicMax(&farthest, bitcast<u32>(depth));
}
