// A ray an invocation: neighbours share a view-sample and a word of its mask. Joined after predicate.wgsl and threaded.wgsl.

struct RayParams {
    sample_count: u32,
    light_count: u32,
    // Words of a view-sample's mask, and the one that this dispatch answers.
    row_words: u32,
    word: u32,
    // Most steps of a ray.
    steps: u32,
    zero: u32,
}

@group(0) @binding(0) var<uniform> size: RayParams;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> light_samples: array<f32>;
@group(0) @binding(3) var<storage, read> position: array<f32>;
@group(0) @binding(4) var<storage, read> triangle: array<u32>;
@group(0) @binding(5) var<storage, read> sample_state: array<u32>;
@group(0) @binding(6) var<storage, read> bvh_nodes: array<vec4<u32>>;
@group(0) @binding(7) var<storage, read> bvh_order: array<u32>;
// Rays of a word set their bits in any order; the next dispatch sees them all.
@group(0) @binding(8) var<storage, read_write> mask: array<atomic<u32>>;
@group(0) @binding(9) var<storage, read_write> counters: array<atomic<u32>>; // unfinished

fn opaque_zero() -> u32 {
    return size.zero;
}

fn position_of(row: u32) -> vec3<f32> {
    return vec3<f32>(position[3u * row], position[3u * row + 1u], position[3u * row + 2u]);
}

fn light_sample(light: u32) -> vec3<f32> {
    return vec3<f32>(light_samples[3u * light], light_samples[3u * light + 1u], light_samples[3u * light + 2u]);
}

// A power of two that brings `largest` to 1..2, or as near to it as f32 can.
fn unit_scale(largest: f32) -> f32 {
    return bitcast<f32>((254u - min((bitcast<u32>(largest) >> 23u) & 0xffu, 253u)) << 23u);
}

// Whether the segment from `start` along `along` meets the closed triangle after its start and not after its end.
fn meets(caster: u32, start: vec3<f32>, along: vec3<f32>, scale: f32) -> bool {
    let p = triangle_corner(caster, 0u);
    let q = triangle_corner(caster, 1u);
    let r = triangle_corner(caster, 2u);
    let a = (p - start) * scale;
    let b = (q - start) * scale;
    let c = (r - start) * scale;
    let height = dot(a, cross((q - p) * scale, (r - p) * scale));
    let turn = sign(height);
    let scaled = along * (scale * turn);
    let sides = vec3<f32>(dot(scaled, cross(a, b)), dot(scaled, cross(b, c)), dot(scaled, cross(c, a)));
    return turn != 0.0 && all(sides >= vec3<f32>(0.0)) && sides.x + sides.y + sides.z >= abs(height);
}

// Starts every mask: none blocked, but all for a view-sample facing away.
@compute @workgroup_size(64)
fn bvh_rays_start(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index < size.sample_count * size.row_words {
        let state = sample_state[index / size.row_words];
        atomicStore(&mask[index], select(0xffffffffu, 0u, state == BACKGROUND || state == KEPT));
    }
}

@compute @workgroup_size(64)
fn bvh_rays(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    let row = index / 32u;
    let light = size.word * 32u + index % 32u;
    if row >= size.sample_count || light >= size.light_count || sample_state[row] != KEPT {
        return;
    }
    let start = position_of(row);
    let end = light_sample(light);
    let along = end - start;
    let largest = max(max(abs(along.x), abs(along.y)), abs(along.z));
    let scale = unit_scale(largest);
    let inverse = reciprocal(along);
    let own = triangle[row];
    // A step visits a node or a triangle, so that rays which go together count together: either the next node, or one of the
    // triangles from `place` to `last` of the leaf before it.
    var node = 0u;
    var place = 0u;
    var last = 0u;
    var blocked = false;
    for (var step = 0u; step <= size.steps; step++) {
        if place < last {
            let caster = bvh_order[place];
            place += 1u;
            if caster != own && meets(caster, start, along, scale) {
                // Exact as two floats are, and only for hits.
                if own == NO_TRIANGLE || predicate_admits(own, caster, end) {
                    blocked = true;
                    break;
                }
            }
        } else if node == BVH_END {
            break;
        } else if step == size.steps {
            atomicAdd(&counters[0], 1u);
        } else {
            let low = bvh_nodes[2u * node];
            let high = bvh_nodes[2u * node + 1u];
            if segment_enters(bitcast<vec3<f32>>(low.xyz), bitcast<vec3<f32>>(high.xyz), start, inverse) {
                if high.w == 0u {
                    node += 1u;
                } else {
                    place = high.w >> LEAF_BITS;
                    last = place + (high.w & ((1u << LEAF_BITS) - 1u));
                    node = low.w;
                }
            } else {
                node = low.w;
            }
        }
    }
    if blocked {
        atomicOr(&mask[row * size.row_words + size.word], 1u << (light % 32u));
    }
}
