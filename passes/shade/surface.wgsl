// What is seen at a view-sample; the same operations in the same order as surface.rs. Joined after numbers and shading.

@group(0) @binding(1) var<storage, read> position: array<f32>;
@group(0) @binding(2) var<storage, read> normal: array<f32>;
@group(0) @binding(3) var<storage, read> triangle: array<u32>;
@group(0) @binding(4) var<storage, read> triangles: array<f32>;
@group(0) @binding(5) var<storage, read> triangle_normals: array<f32>;

struct Surface {
    position: vec3<f32>,
    // Weights of the triangle's corners.
    weights: vec3<f32>,
    // The viewer sees the side from which the corners turn clockwise.
    is_flipped: bool,
    // On the viewer's side.
    geometric_normal: vec3<f32>,
    shading_normal: vec3<f32>,
}

// Whether a row lies on a triangle.
fn is_surface(row: u32) -> bool {
    return row < numbers.sample_count && triangle[row] < numbers.triangle_count;
}

fn surface_at(row: u32) -> Surface {
    let first = 9u * triangle[row];
    let a = vec3<f32>(triangles[first], triangles[first + 1u], triangles[first + 2u]);
    let b = vec3<f32>(triangles[first + 3u], triangles[first + 4u], triangles[first + 5u]);
    let c = vec3<f32>(triangles[first + 6u], triangles[first + 7u], triangles[first + 8u]);
    var surface: Surface;
    surface.position = vec3<f32>(position[3u * row], position[3u * row + 1u], position[3u * row + 2u]);
    surface.weights = corner_weights(a, b, c, surface.position);
    surface.geometric_normal = vec3<f32>(normal[3u * row], normal[3u * row + 1u], normal[3u * row + 2u]);
    surface.is_flipped = shading_dot(face_normal(a, b, c), surface.geometric_normal) < 0.0;
    var smooth_normal = vec3<f32>(0.0);
    for (var k = 0u; k < 3u; k++) {
        let at = first + 3u * k;
        smooth_normal += surface.weights[k]
            * vec3<f32>(triangle_normals[at], triangle_normals[at + 1u], triangle_normals[at + 2u]);
    }
    smooth_normal = unit(smooth_normal);
    surface.shading_normal = select(smooth_normal, -smooth_normal, surface.is_flipped);
    if all(smooth_normal == vec3<f32>(0.0)) {
        surface.shading_normal = surface.geometric_normal;
    }
    return surface;
}
