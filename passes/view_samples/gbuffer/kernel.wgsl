// Takes view-samples from a host's textures.

@group(0) @binding(0) var<uniform> size: vec4<u32>; // pixels, columns, 0, 0
@group(0) @binding(1) var gbuffer_position: texture_2d<f32>;
@group(0) @binding(2) var gbuffer_normal: texture_2d<f32>;
@group(0) @binding(3) var gbuffer_triangle: texture_2d<u32>;
@group(0) @binding(4) var<storage, read_write> position: array<f32>;
@group(0) @binding(5) var<storage, read_write> normal: array<f32>;
@group(0) @binding(6) var<storage, read_write> triangle: array<u32>;
@group(0) @binding(7) var<storage, read_write> pixel: array<u32>;

@compute @workgroup_size(64)
fn gbuffer(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.x {
        return;
    }
    let texel = vec2<u32>(index % size.y, index / size.y);
    var p = vec3<f32>(0.0);
    var n = vec3<f32>(0.0);
    let seen = textureLoad(gbuffer_triangle, texel, 0).x;
    if seen != NO_TRIANGLE {
        p = textureLoad(gbuffer_position, texel, 0).xyz;
        n = textureLoad(gbuffer_normal, texel, 0).xyz;
    }
    for (var axis = 0u; axis < 3u; axis++) {
        position[3u * index + axis] = p[axis];
        normal[3u * index + axis] = n[axis];
    }
    triangle[index] = seen;
    pixel[index] = index;
}
