// What both ways to shade share; the same operations in the same order as surface.rs. Joined after shading.wgsl.

struct ShadeParams {
    sample_count: u32,
    triangle_count: u32,
    pixel_count: u32,
    // 1: light weakens with the square of the distance.
    falls_off: u32,
    background: vec3<f32>,
    ambient: f32,
    falloff_distance: f32,
    // bent_lambert: c. phong: specular, shininess.
    first: f32,
    second: f32,
}

@group(0) @binding(0) var<uniform> params: ShadeParams;
@group(0) @binding(1) var<storage, read> position: array<f32>;
@group(0) @binding(2) var<storage, read> normal: array<f32>;
@group(0) @binding(3) var<storage, read> triangle: array<u32>;
@group(0) @binding(4) var<storage, read> pixel: array<u32>;
@group(0) @binding(5) var<storage, read> sample_state: array<u32>;
@group(0) @binding(6) var<storage, read> visible: array<f32>;
@group(0) @binding(7) var<storage, read> triangles: array<f32>;
@group(0) @binding(8) var<storage, read> triangle_normals: array<f32>;
@group(0) @binding(9) var<storage, read> triangle_albedo: array<f32>;
@group(0) @binding(10) var<storage, read> light: array<f32>;
@group(0) @binding(11) var<storage, read_write> image: array<f32>;
@group(0) @binding(12) var<storage, read_write> counters: array<atomic<u32>>;

struct Surface {
    position: vec3<f32>,
    // Weights of the triangle's corners.
    weights: vec3<f32>,
    // The viewer sees the side from which the corners turn clockwise.
    is_flipped: bool,
    // On the viewer's side.
    geometric_normal: vec3<f32>,
    shading_normal: vec3<f32>,
    toward_light: vec3<f32>,
    albedo: vec3<f32>,
    // Colour of the light times its falloff.
    light: vec3<f32>,
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
    let offset = vec3<f32>(light[0], light[1], light[2]) - surface.position;
    surface.toward_light = unit(offset);
    let albedo = 3u * triangle[row];
    surface.albedo = vec3<f32>(triangle_albedo[albedo], triangle_albedo[albedo + 1u], triangle_albedo[albedo + 2u]);
    surface.light = vec3<f32>(light[4], light[5], light[6]);
    if params.falls_off == 1u {
        let distances = max(length(offset / params.falloff_distance), 1e-6);
        surface.light /= distances * distances;
    }
    return surface;
}

fn store(at: u32, color: vec3<f32>, coverage: f32) {
    image[4u * at] = color.x;
    image[4u * at + 1u] = color.y;
    image[4u * at + 2u] = color.z;
    image[4u * at + 3u] = coverage;
}

// Whether a row is a surface in the picture; counts those outside.
fn is_shaded(row: u32) -> bool {
    if row >= params.sample_count || sample_state[row] == BACKGROUND || triangle[row] >= params.triangle_count {
        return false;
    }
    if pixel[row] >= params.pixel_count {
        atomicAdd(&counters[0], 1u);
        return false;
    }
    return true;
}
