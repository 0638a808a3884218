// Projection onto the light frame; the same operations in the same order as light_frame.rs.
// The kernel that joins this piece declares `var<storage, read> light_frame: array<f32>` (read_write serves too).

struct LightPoint {
    face: u32,
    u: f32,
    v: f32,
    // Along the face's axis; not above zero: the point cannot be placed.
    depth: f32,
}

fn light_vector(face: u32, word: u32) -> vec3<f32> {
    let start = face * FACE_WORDS + word;
    return vec3<f32>(light_frame[start], light_frame[start + 1u], light_frame[start + 2u]);
}

fn light_origin(face: u32) -> vec3<f32> {
    return light_vector(face, 0u);
}

// Whether any kept view-sample falls in the face.
fn light_valid(face: u32) -> bool {
    return light_frame[face * FACE_WORDS + 3u] > 0.5;
}

fn light_axis_x(face: u32) -> vec3<f32> {
    return light_vector(face, 4u);
}

fn light_axis_y(face: u32) -> vec3<f32> {
    return light_vector(face, 8u);
}

fn light_axis_z(face: u32) -> vec3<f32> {
    return light_vector(face, 12u);
}

// Window u0, v0, du, dv.
fn light_window(face: u32) -> vec4<f32> {
    let start = face * FACE_WORDS;
    return vec4<f32>(
        light_frame[start + 7u], light_frame[start + 11u], light_frame[start + 15u], light_frame[start + 16u]);
}

// Smallest and largest depth of the face's view-samples.
fn light_depth_range(face: u32) -> vec2<f32> {
    let start = face * FACE_WORDS;
    return vec2<f32>(light_frame[start + 17u], light_frame[start + 18u]);
}

fn light_dot(a: vec3<f32>, b: vec3<f32>) -> f32 {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// A face's place and axes, for loops that would fetch them again and again.
struct LightFace {
    index: u32,
    origin: vec3<f32>,
    axis_x: vec3<f32>,
    axis_y: vec3<f32>,
    axis_z: vec3<f32>,
}

fn light_face(index: u32) -> LightFace {
    return LightFace(
        index, light_origin(index), light_axis_x(index), light_axis_y(index), light_axis_z(index));
}

// A point as one face sees it.
fn light_see(face: LightFace, position: vec3<f32>) -> LightPoint {
    var point = LightPoint(face.index, 0.0, 0.0, 0.0);
    let offset = position - face.origin;
    let depth = light_dot(face.axis_z, offset);
    if depth > 0.0 {
        point.u = light_dot(face.axis_x, offset) / depth;
        point.v = light_dot(face.axis_y, offset) / depth;
        point.depth = depth;
    }
    return point;
}

// The one of `count` faces from `first` on whose axis the point lies furthest along; of equals the lowest.
fn light_face_of(position: vec3<f32>, first: u32, count: u32) -> u32 {
    var best = first;
    var best_depth = 0.0;
    for (var face = first; face < first + count; face++) {
        let depth = light_dot(light_axis_z(face), position - light_origin(face));
        if depth > best_depth {
            best = face;
            best_depth = depth;
        }
    }
    return best;
}

// The point as that face sees it.
fn light_project_from(position: vec3<f32>, first: u32, count: u32) -> LightPoint {
    return light_see(light_face(light_face_of(position, first, count)), position);
}

// The same among all faces.
fn light_project(position: vec3<f32>, face_count: u32) -> LightPoint {
    return light_project_from(position, 0u, face_count);
}

// Column and row of (u, v) in a window of side x side texels, clamped: border texels reach to infinity.
fn light_texel(face: u32, u: f32, v: f32, side: u32) -> vec2<u32> {
    let window = light_window(face);
    let last = f32(side) - 1.0;
    let column = clamp(floor((u - window.x) / window.z * f32(side)), 0.0, last);
    let row = clamp(floor((v - window.y) / window.w * f32(side)), 0.0, last);
    return vec2<u32>(u32(column), u32(row));
}

// Cell of a placed point.
fn light_cell(point: LightPoint, side: u32) -> u32 {
    let texel = light_texel(point.face, point.u, point.v, side);
    return (point.face * side + texel.y) * side + texel.x;
}

// How far rounding may have moved a projected point in u and in v, see `uv_pad` in light_frame.rs.
fn light_uv_pad(u: f32, v: f32) -> f32 {
    return 1e-6 * (1.0 + u * u + v * v);
}
