// The convex hull of three convex polygons in linear time, as hull.rs tells it: chains of each polygon are sorted by x, so merging
// sorts all points, and a scan there and back drops every turn to the right.
const MOST_POINTS: u32 = 24u;
// Rounding may leave a point on both chains.
const HULL_ROOM: u32 = 48u;

struct Points {
    at: array<vec2<f32>, HULL_ROOM>,
    count: u32,
}

fn is_before(a: vec2<f32>, b: vec2<f32>) -> bool {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}

fn turn_at(a: vec2<f32>, b: vec2<f32>, c: vec2<f32>) -> f32 {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Points start, .. start + count - 1, a convex polygon, from left to right.
fn sort_polygon(points: ptr<function, Points>, start: u32, count: u32, into: ptr<function, Points>) {
    var first = 0u;
    for (var k = 1u; k < count; k++) {
        first = select(first, k, is_before((*points).at[start + k], (*points).at[start + first]));
    }
    (*into).at[start] = (*points).at[start + first];
    var up = (first + 1u) % count;
    var down = (first + count - 1u) % count;
    for (var k = 1u; k < count; k++) {
        let a = (*points).at[start + up];
        let b = (*points).at[start + down];
        if is_before(a, b) {
            (*into).at[start + k] = a;
            up = (up + 1u) % count;
        } else {
            (*into).at[start + k] = b;
            down = (down + count - 1u) % count;
        }
    }
}

// Merges the sorted runs [0, middle) and [middle, end) of `points` into `into`.
fn merge_runs(points: ptr<function, Points>, middle: u32, end: u32, into: ptr<function, Points>) {
    var i = 0u;
    var j = middle;
    for (var k = 0u; k < end; k++) {
        let a = (*points).at[min(i, HULL_ROOM - 1u)];
        let b = (*points).at[min(j, HULL_ROOM - 1u)];
        if j == end || (i < middle && is_before(a, b)) {
            (*into).at[k] = a;
            i++;
        } else {
            (*into).at[k] = b;
            j++;
        }
    }
}

// Corners of the hull of three polygons of `sides` points each, counter-clockwise from the left; the first is not repeated.
fn hull_of_three(points: ptr<function, Points>, sides: u32) -> Points {
    var sorted: Points;
    var merged: Points;
    let all = 3u * sides;
    for (var k = 0u; k < 3u; k++) {
        sort_polygon(points, k * sides, sides, &sorted);
    }
    merge_runs(&sorted, sides, 2u * sides, &merged);
    for (var k = 2u * sides; k < all; k++) {
        merged.at[k] = sorted.at[k];
    }
    merge_runs(&merged, 2u * sides, all, &sorted);

    // There along the lower side, back along the upper: steps count up to the last point, then down.
    var hull: Points;
    var count = 0u;
    var least = 2u;
    for (var step = 0u; step < 2u * all - 1u; step++) {
        let point = sorted.at[select(step, 2u * all - 2u - step, step >= all)];
        if step == all {
            least = count + 1u;
        }
        while count >= least && turn_at(hull.at[count - 2u], hull.at[count - 1u], point) <= 0.0 {
            count--;
        }
        hull.at[count] = point;
        count++;
    }
    hull.count = count - 1u;
    return hull;
}
