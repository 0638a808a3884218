// One workgroup: smallest and largest coordinates of all light samples, then 1 if there are any.

@group(0) @binding(0) var<uniform> counts: vec4<u32>; // light samples
@group(0) @binding(1) var<storage, read> light_samples: array<f32>;
@group(0) @binding(2) var<storage, read_write> light_box: array<f32>;

var<workgroup> low: array<vec3<f32>, 64>;
var<workgroup> high: array<vec3<f32>, 64>;

@compute @workgroup_size(64)
fn find_light_box(@builtin(local_invocation_id) id: vec3<u32>) {
    let first = vec3<f32>(light_samples[0], light_samples[1], light_samples[2]);
    low[id.x] = first;
    high[id.x] = first;
    for (var sample = id.x; sample < counts.x; sample += GROUP) {
        let at = vec3<f32>(light_samples[3u * sample], light_samples[3u * sample + 1u], light_samples[3u * sample + 2u]);
        low[id.x] = min(low[id.x], at);
        high[id.x] = max(high[id.x], at);
    }
    for (var reach = GROUP / 2u; reach > 0u; reach /= 2u) {
        // Orders each half's writes before they are read.
        workgroupBarrier();
        if id.x < reach {
            low[id.x] = min(low[id.x], low[id.x + reach]);
            high[id.x] = max(high[id.x], high[id.x + reach]);
        }
    }
    if id.x == 0u {
        for (var k = 0u; k < 3u; k++) {
            light_box[k] = low[0][k];
            light_box[3u + k] = high[0][k];
        }
        light_box[6] = select(0.0, 1.0, counts.x > 0u);
    }
}
