// The camera's twenty words; the same operations as camera.rs, in f32.
// The kernel that joins this piece declares `var<storage, read> camera: array<f32>`.

fn camera_eye() -> vec3<f32> {
    return vec3<f32>(camera[0], camera[1], camera[2]);
}

fn camera_right() -> vec3<f32> {
    return vec3<f32>(camera[4], camera[5], camera[6]);
}

fn camera_up() -> vec3<f32> {
    return vec3<f32>(camera[8], camera[9], camera[10]);
}

fn camera_forward() -> vec3<f32> {
    return vec3<f32>(camera[12], camera[13], camera[14]);
}

// Tangents of half the horizontal and vertical angle.
fn camera_tan() -> vec2<f32> {
    return vec2<f32>(camera[7], camera[11]);
}

// Along the centre of pixel (column, row), one unit deep; not of unit length.
fn camera_ray(column: u32, row: u32) -> vec3<f32> {
    let across = (2.0 * f32(column) + 1.0) / camera[16] - 1.0;
    let upwards = 1.0 - (2.0 * f32(row) + 1.0) / camera[17];
    return camera_forward() + across * camera[7] * camera_right() + upwards * camera[11] * camera_up();
}
