// The influence region of a caster on a face, as influence.rs tells it, in f32 with bounds on its rounding. Joined after light_frame,
// face_light and hull.

// A direction of the hull within this of its size of the plane beside the light says too little.
const BESIDE: f32 = 1e-2;
// Tangent to which view-samples reach where no other face takes them.
const WIDE: f32 = 1e5;
// Lines in groups of four: two groups of planes, six of sides of the hull.
const GROUPS: u32 = 8u;
const PLANE_GROUPS: u32 = 2u;

struct Region {
    touched: bool,
    // First and last column and row of the bounding box.
    first: vec2<u32>,
    last: vec2<u32>,
    // Nearest depth of the caster; none where the light reaches deeper.
    near: f32,
    // Factors that cover the rounding of a depth inside the window, and in border texels.
    rooms: vec2<f32>,
    // One over the largest depth of a view-sample.
    least_q: f32,
    // Window u0, v0, extent of a texel.
    window: vec4<f32>,
    // Rounding of texel borders, texels.
    pad: vec2<f32>,
    // Tangent to which view-samples reach.
    reach: f32,
    // u x + v y + one + slack (1 + |x| + |y|) >= depth / far inside, four lines each.
    groups: u32,
    u: array<vec4<f32>, GROUPS>,
    v: array<vec4<f32>, GROUPS>,
    one: array<vec4<f32>, GROUPS>,
    depth: array<vec4<f32>, PLANE_GROUPS>,
    slack: array<vec4<f32>, PLANE_GROUPS>,
}

// Whether view-samples of the face end at 45 degrees, because other faces look along both ends of both its axes.
fn face_is_closed(face: u32, faces: u32) -> bool {
    var found = vec4<bool>(false);
    for (var other = 0u; other < faces; other++) {
        let axis = light_axis_z(other);
        found |= vec4<bool>(
            all(axis == light_axis_x(face)), all(axis == -light_axis_x(face)),
            all(axis == light_axis_y(face)), all(axis == -light_axis_y(face)));
    }
    return all(found);
}

fn beyond_side(caster: ptr<function, Caster>, normal: vec3<f32>) -> bool {
    let slack = SLACK * sum_of_sizes(normal) * (*caster).far;
    let most = max(dot(normal, (*caster).a), max(dot(normal, (*caster).b), dot(normal, (*caster).c)));
    return most < -slack && most < -body_most(-normal) - slack;
}

fn put_line(region: ptr<function, Region>, place: u32, line: vec3<f32>) {
    (*region).u[place / 4u][place % 4u] = line.x;
    (*region).v[place / 4u][place % 4u] = line.y;
    (*region).one[place / 4u][place % 4u] = line.z;
}

fn influence_region(caster: ptr<function, Caster>, face: u32, faces: u32, side: u32, quad: bool) -> Region {
    var region: Region;
    region.touched = false;
    let axis_x = light_axis_x(face);
    let axis_y = light_axis_y(face);
    let axis_z = light_axis_z(face);
    let window = light_window(face);
    region.reach = select(WIDE, 1.00002, face_is_closed(face, faces));
    region.window = vec4<f32>(window.xy, window.zw / f32(side));
    let inner = max(abs(window.xy), abs(window.xy + window.zw));
    region.pad = light_uv_pad(inner.x, inner.y) / region.window.zw + 2e-3;
    region.rooms = 1.0 + 1e-6 * (2.0 + vec2<f32>(inner.x + inner.y, 2.0 * region.reach));

    // Beyond one of the face's sides, and further beyond than the light.
    let wide = region.reach * axis_z;
    var sides_inwards = array<vec3<f32>, 5>(wide + axis_x, wide - axis_x, wide + axis_y, wide - axis_y, axis_z);
    for (var k = 0u; k < 5u; k++) {
        if beyond_side(caster, sides_inwards[k]) {
            return region;
        }
    }
    let depths = vec3<f32>(dot(axis_z, (*caster).a), dot(axis_z, (*caster).b), dot(axis_z, (*caster).c));
    let room = ERROR * (*caster).far;
    let near = min(depths.x, min(depths.y, depths.z)) - room;
    let face_far = light_depth_range(face).y * region.rooms.y;
    region.near = select(-1.0, near, near > body_most(axis_z) + room);
    if region.near > face_far {
        return region;
    }
    region.touched = true;
    region.least_q = 1.0 / face_far;
    region.first = vec2<u32>(0u);
    region.last = vec2<u32>(side - 1u);

    // Planes; what is not there bounds nothing.
    for (var group = 0u; group < GROUPS; group++) {
        region.u[group] = vec4<f32>(0.0);
        region.v[group] = vec4<f32>(0.0);
        region.one[group] = vec4<f32>(1.0);
    }
    for (var k = 0u; k < PLANES; k++) {
        let plane = (*caster).planes[k];
        if all(plane.xyz == vec3<f32>(0.0)) {
            continue;
        }
        let n = vec3<f32>(dot(plane.xyz, axis_x), dot(plane.xyz, axis_y), dot(plane.xyz, axis_z));
        put_line(&region, k, n);
        region.depth[k / 4u][k % 4u] = plane.w;
        // The size of the turned normal is up to sqrt(3) of the normal's own, which is one.
        region.slack[k / 4u][k % 4u] = 1.75 * SLACK + (*caster).blunt[k];
    }
    region.groups = PLANE_GROUPS;

    // The hull of the projections onto the plane at the largest depth.
    let depth = max(face_far, max(depths.x, max(depths.y, depths.z)));
    let sides = body.sides;
    var points: Points;
    var pad = 0.0;
    var low = vec2<f32>(3e38);
    var high = vec2<f32>(-3e38);
    for (var corner = 0u; corner < 3u; corner++) {
        let place = select(select((*caster).c, (*caster).b, corner == 1u), (*caster).a, corner == 0u);
        let cone = cone_through(place);
        let at = vec3<f32>(dot(axis_x, place), dot(axis_y, place), dot(axis_z, place));
        let left = max(depth - at.z, 0.0) / depth;
        let share = left + ERROR * sum_of_sizes(place) / depth;
        for (var k = 0u; k < sides; k++) {
            let world = cone_ray(cone, k);
            let ray = vec3<f32>(dot(axis_x, world), dot(axis_y, world), dot(axis_z, world));
            let size = sum_of_sizes(ray);
            let stray = cone.stray + ERROR * sum_of_sizes(world);
            let z = ray.z - stray;
            if !cone.any || z <= BESIDE * size {
                return region;
            }
            let point = at.xy / depth + ray.xy * (left / ray.z);
            points.at[corner * sides + k] = point;
            low = min(low, point);
            high = max(high, point);
            let rounding = 1.0 + abs(point.x) + abs(point.y) + sum_of_sizes(place) / depth + share * size / z;
            pad = max(pad, 2.0 * ERROR * rounding + share * stray / z * (1.0 + size / z));
        }
    }
    let largest = max(abs(low), abs(high)) + pad;
    let slack = SLACK * (1.0 + dot(largest, largest)) + pad;
    let box_low = (low - slack - window.xy) / region.window.zw - region.pad;
    let box_high = (high + slack - window.xy) / region.window.zw + region.pad;
    if any(high + slack < vec2<f32>(-region.reach)) || any(low - slack > vec2<f32>(region.reach)) {
        region.touched = false;
        return region;
    }
    let end = vec2<f32>(f32(side) - 1.0);
    region.first = vec2<u32>(clamp(floor(box_low), vec2<f32>(0.0), end));
    region.last = vec2<u32>(clamp(floor(box_high), vec2<f32>(0.0), end));
    if quad || any(region.last - region.first < vec2<u32>(2u)) {
        return region;
    }
    var hull = hull_of_three(&points, sides);
    // More corners than points are doubles by rounding; without a side the region is only larger.
    let lines = min(hull.count, MOST_POINTS);
    for (var k = 0u; k < lines; k++) {
        let a = hull.at[k];
        let b = hull.at[select(k + 1u, 0u, k + 1u == hull.count)];
        let n = vec2<f32>(a.y - b.y, b.x - a.x);
        // Measured against all points, so that no direction is wrong.
        var least = 3e38;
        for (var point = 0u; point < 3u * sides; point++) {
            least = min(least, dot(n, points.at[point]));
        }
        least -= (abs(n.x) + abs(n.y)) * pad;
        let size = abs(n.x) + abs(n.y) + abs(least);
        if abs(n.x) + abs(n.y) > 1e-5 * size {
            put_line(&region, 4u * PLANE_GROUPS + k, vec3<f32>(n, -least) / size);
        }
    }
    region.groups = PLANE_GROUPS + (lines + 3u) / 4u;
    return region;
}
