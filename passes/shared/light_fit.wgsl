// Fits a light frame to view-samples; the same steps in the same order as light_fit.rs.

struct FitSize {
    sample_count: u32,
    light_count: u32,
    invocations: u32,
    face_count: u32,
    largest_tangent: f32,
    pad: f32,
    nearest: f32,
    unused: u32,
}

@group(0) @binding(0) var<uniform> size: FitSize;
@group(0) @binding(1) var<storage, read> position: array<f32>;
@group(0) @binding(2) var<storage, read> sample_state: array<u32>;
@group(0) @binding(3) var<storage, read> light_samples: array<f32>;
// Six words a group, zero at first: largest keys of -a, -b, -c, a, b, c. Group 0 holds directions, group 1 + f the (u, v,
// depth) of face f. Kernels only raise them, so no order is needed within a dispatch; a later dispatch sees the result.
@group(0) @binding(4) var<storage, read_write> reduction: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read_write> light_frame: array<f32>;

const FIT_WORDS: u32 = 6u;

struct Bounds {
    low: vec3<f32>,
    high: vec3<f32>,
    is_empty: bool,
}

// Unsigned keys in the order of the floats; 0 is below all of them.
fn key_of(value: f32) -> u32 {
    let bits = bitcast<u32>(value);
    return select(bits | 0x80000000u, ~bits, bits >= 0x80000000u);
}

fn value_of(key: u32) -> f32 {
    return bitcast<f32>(select(~key, key & 0x7fffffffu, key >= 0x80000000u));
}

// A plain look first: most values raise nothing, and atomics are dear.
fn raise(word: u32, value: f32) {
    let key = key_of(value);
    if key > atomicLoad(&reduction[word]) {
        atomicMax(&reduction[word], key);
    }
}

fn raise_bounds(group: u32, bounds: Bounds) {
    for (var axis = 0u; axis < 3u; axis++) {
        raise(group * FIT_WORDS + axis, -bounds.low[axis]);
        raise(group * FIT_WORDS + 3u + axis, bounds.high[axis]);
    }
}

fn bounds_of(group: u32) -> Bounds {
    var bounds = Bounds(vec3<f32>(0.0), vec3<f32>(0.0), atomicLoad(&reduction[group * FIT_WORDS]) == 0u);
    if !bounds.is_empty {
        for (var axis = 0u; axis < 3u; axis++) {
            bounds.low[axis] = -value_of(atomicLoad(&reduction[group * FIT_WORDS + axis]));
            bounds.high[axis] = value_of(atomicLoad(&reduction[group * FIT_WORDS + 3u + axis]));
        }
    }
    return bounds;
}

fn bounds_with(bounds: Bounds, values: vec3<f32>) -> Bounds {
    if bounds.is_empty {
        return Bounds(values, values, false);
    }
    return Bounds(min(bounds.low, values), max(bounds.high, values), false);
}

fn position_of(sample: u32) -> vec3<f32> {
    return vec3<f32>(position[3u * sample], position[3u * sample + 1u], position[3u * sample + 2u]);
}

fn light_sample(light: u32) -> vec3<f32> {
    return vec3<f32>(light_samples[3u * light], light_samples[3u * light + 1u], light_samples[3u * light + 2u]);
}

// The one light sample, or the mean of them.
fn origin_of_light() -> vec3<f32> {
    if size.light_count == 0u {
        return vec3<f32>(0.0);
    }
    let first = light_sample(0u);
    var sum = vec3<f32>(0.0);
    for (var light = 0u; light < size.light_count; light++) {
        sum += light_sample(light) - first;
    }
    return first + sum / f32(size.light_count);
}

fn largest_component(vector: vec3<f32>) -> f32 {
    return max(max(abs(vector.x), abs(vector.y)), abs(vector.z));
}

// Unit vector along `towards`; straight down where that has no direction.
fn direction_of(towards: vec3<f32>) -> vec3<f32> {
    let largest = largest_component(towards);
    if !(largest > 0.0) || largest > 3e38 {
        return vec3<f32>(0.0, -1.0, 0.0);
    }
    let scaled = towards / largest;
    return scaled / sqrt(light_dot(scaled, scaled));
}

fn store_vector(face: u32, word: u32, vector: vec3<f32>) {
    let start = face * FACE_WORDS + word;
    light_frame[start] = vector.x;
    light_frame[start + 1u] = vector.y;
    light_frame[start + 2u] = vector.z;
}

fn store_axes(face: u32, origin: vec3<f32>, axis_x: vec3<f32>, axis_y: vec3<f32>, axis_z: vec3<f32>) {
    store_vector(face, 0u, origin);
    store_vector(face, 4u, axis_x);
    store_vector(face, 8u, axis_y);
    store_vector(face, 12u, axis_z);
}

fn store_window(face: u32, low: vec2<f32>, extent: vec2<f32>) {
    let start = face * FACE_WORDS;
    light_frame[start + 7u] = low.x;
    light_frame[start + 11u] = low.y;
    light_frame[start + 15u] = extent.x;
    light_frame[start + 16u] = extent.y;
}

fn store_depth_range(face: u32, near: f32, far: f32) {
    let start = face * FACE_WORDS;
    light_frame[start + 17u] = near;
    light_frame[start + 18u] = far;
    light_frame[start + 19u] = 0.0;
}

fn store_valid(face: u32, valid: bool) {
    light_frame[face * FACE_WORDS + 3u] = select(0.0, 1.0, valid);
}

// A single face at `origin` that looks along `towards`, with the widest window and no view-samples.
fn look(origin: vec3<f32>, towards: vec3<f32>) {
    let axis_z = direction_of(towards);
    let across = abs(axis_z);
    var axis = 0u;
    for (var other = 1u; other < 3u; other++) {
        if across[other] < across[axis] - 1e-3 {
            axis = other;
        }
    }
    var world_axis = vec3<f32>(0.0);
    world_axis[axis] = 1.0;
    let axis_x = direction_of(world_axis - axis_z * axis_z[axis]);
    store_axes(0u, origin, axis_x, cross(axis_z, axis_x), axis_z);
    store_valid(0u, false);
    store_window(0u, vec2<f32>(-size.largest_tangent), vec2<f32>(2.0 * size.largest_tangent));
    store_depth_range(0u, 1.0, 2.0);
}

// Bounds of directions, scaled so that the largest component is 1, of every `invocations`-th view-sample from `first` on.
fn reduce_directions(first: u32) {
    let origin = light_vector(0u, 0u);
    var bounds = Bounds(vec3<f32>(0.0), vec3<f32>(0.0), true);
    for (var sample = first; sample < size.sample_count; sample += size.invocations) {
        if sample_state[sample] == KEPT {
            let offset = position_of(sample) - origin;
            let largest = largest_component(offset);
            if largest > 0.0 {
                bounds = bounds_with(bounds, offset / largest);
            }
        }
    }
    if !bounds.is_empty {
        raise_bounds(0u, bounds);
    }
}

// Bounds of (u, v, depth) of the same view-samples on a single face; returns how many cannot be placed.
fn reduce_window(first: u32) -> u32 {
    let face = light_face(0u);
    var bounds = Bounds(vec3<f32>(0.0), vec3<f32>(0.0), true);
    var behind = 0u;
    for (var sample = first; sample < size.sample_count; sample += size.invocations) {
        if sample_state[sample] == KEPT {
            let point = light_see(face, position_of(sample));
            if point.depth > 0.0 {
                bounds = bounds_with(bounds, vec3<f32>(point.u, point.v, point.depth));
            } else {
                behind += 1u;
            }
        }
    }
    if !bounds.is_empty {
        raise_bounds(1u, bounds);
    }
    return behind;
}

fn fit_depth(face: u32, bounds: Bounds) {
    store_depth_range(face, bounds.low.z * (1.0 - size.pad), min(bounds.high.z * (1.0 + size.pad), 3.4e38));
}

fn fit_window(face: u32, bounds: Bounds) {
    let limit = vec2<f32>(size.largest_tangent);
    let low = clamp(bounds.low.xy, -limit, limit);
    let high = clamp(bounds.high.xy, -limit, limit);
    let furthest = max(abs(low), abs(high));
    let pad = size.pad * (high - low) + 4.0 * light_uv_pad(furthest.x, furthest.y);
    store_window(face, low - pad, high - low + 2.0 * pad);
}

// Window, near and far from the bounds of the face's view-samples; as they were, and not valid, when there are none.
fn fit(face: u32) {
    let bounds = bounds_of(1u + face);
    store_valid(face, !bounds.is_empty);
    if !bounds.is_empty {
        fit_window(face, bounds);
        fit_depth(face, bounds);
    }
}
