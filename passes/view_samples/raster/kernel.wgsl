// Position and normal of each pixel from the number of its triangle.

@group(0) @binding(0) var<uniform> size: vec4<u32>; // pixels, columns, 0, 0
@group(0) @binding(1) var ids: texture_2d<u32>;
@group(0) @binding(2) var<storage, read> triangles: array<f32>;
@group(0) @binding(3) var<storage, read> camera: array<f32>;
@group(0) @binding(4) var<storage, read_write> position: array<f32>;
@group(0) @binding(5) var<storage, read_write> normal: array<f32>;
@group(0) @binding(6) var<storage, read_write> triangle: array<u32>;
@group(0) @binding(7) var<storage, read_write> pixel: array<u32>;

fn corner_of(id: u32, corner: u32) -> vec3<f32> {
    let word = 9u * id + 3u * corner;
    return vec3<f32>(triangles[word], triangles[word + 1u], triangles[word + 2u]);
}

fn largest_component(vector: vec3<f32>) -> f32 {
    return max(max(abs(vector.x), abs(vector.y)), abs(vector.z));
}

// By bits: compilers may take it that no float is infinite or none.
fn is_finite(vector: vec3<f32>) -> bool {
    return all((bitcast<vec3<u32>>(vector) & vec3<u32>(0x7f800000u)) != vec3<u32>(0x7f800000u));
}

fn store(index: u32, seen: u32, p: vec3<f32>, n: vec3<f32>) {
    for (var axis = 0u; axis < 3u; axis++) {
        position[3u * index + axis] = p[axis];
        normal[3u * index + axis] = n[axis];
    }
    triangle[index] = seen;
    pixel[index] = index;
}

@compute @workgroup_size(64)
fn raster_resolve(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.x {
        return;
    }
    let column = index % size.y;
    let row = index / size.y;
    let seen = textureLoad(ids, vec2<u32>(column, row), 0).x;
    if seen == NO_TRIANGLE {
        store(index, NO_TRIANGLE, vec3<f32>(0.0), vec3<f32>(0.0));
        return;
    }
    let a = corner_of(seen, 0u);
    let ab = corner_of(seen, 1u) - a;
    let ac = corner_of(seen, 2u) - a;
    let ray = camera_ray(column, row);
    // Weights of the edges (Moeller and Trumbore 1997): an error in them moves the point within the triangle's plane, where
    // an error in a distance along the ray would lift it off.
    let to_eye = camera_eye() - a;
    let across = cross(ray, ac);
    let volume = dot(ab, across);
    var weights = vec2<f32>(dot(to_eye, across), dot(ray, cross(to_eye, ab))) / volume;
    // A triangle seen almost from its edge makes that error large: the point stays within the triangle all the same.
    weights = max(weights, vec2<f32>(0.0));
    weights /= max(weights.x + weights.y, 1.0);
    let p = a + weights.x * ab + weights.y * ac;
    // Scaled, so that the squares of small edges do not vanish.
    let scale = max(largest_component(ab), largest_component(ac));
    let n = cross(ab / scale, ac / scale);
    if !is_finite(p) || !(dot(n, n) > 0.0) || !is_finite(n) {
        // Seen from its edge, or without area, as far as f32 can tell: there is no point to ask about.
        store(index, NO_TRIANGLE, vec3<f32>(0.0), vec3<f32>(0.0));
        return;
    }
    store(index, seen, p, normalize(n) * select(1.0, -1.0, dot(n, ray) > 0.0));
}
