/* peer: shadow rays to every light sample through Embree 3, on the view-samples and triangles of a dump.
 *
 *   peer DIR RUNS [THREADS]
 *
 * DIR holds triangles.npy [T 3 3] f32, light_samples.npy [L 3] f32, position.npy [P 3] f32, triangle.npy [P] u32,
 * sample_state.npy [P] u32 and mask.npy [P ceil(L/32)] u32, as run.sh leaves them. Builds a scene over all triangles and asks
 * rtcOccluded16 for every kept view-sample and light sample, sixteen light samples of one view-sample a packet, coherent, in the order of
 * the view-samples' rows. Prints one line of JSON with median and extreme milliseconds of build, trace and both, wall and processor
 * time, and how many answers differ from the mask. For self hits see ../embree/peer.h.
 */
#include "../embree/peer.h"

enum { BLOCK = 64 };

static const float *lights;
static size_t light_count, words_each;
static uint32_t *blocked;

static void *trace(void *unused) {
    (void)unused;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (;;) {
        size_t first = __atomic_fetch_add(&next_block, BLOCK, __ATOMIC_RELAXED);
        if (first >= kept_count) return NULL;
        size_t last = first + BLOCK < kept_count ? first + BLOCK : kept_count;
        for (size_t at = first; at < last; at++) {
            const float *p = positions + 3 * (size_t)kept[at];
            uint32_t *words = blocked + at * words_each;
            memset(words, 0, 4 * words_each);
            for (size_t base = 0; base < light_count; base += PACKET) {
                struct RTCRay16 ray;
                int valid[PACKET] __attribute__((aligned(64)));
                for (size_t lane = 0; lane < PACKET; lane++) {
                    size_t sample = base + lane < light_count ? base + lane : base;
                    const float *light = lights + 3 * sample;
                    valid[lane] = base + lane < light_count ? -1 : 0;
                    ray.org_x[lane] = p[0], ray.org_y[lane] = p[1], ray.org_z[lane] = p[2];
                    ray.dir_x[lane] = light[0] - p[0], ray.dir_y[lane] = light[1] - p[1], ray.dir_z[lane] = light[2] - p[2];
                    ray.tnear[lane] = filtered ? 0.0f : 1e-4f, ray.tfar[lane] = 1.0f;
                    ray.time[lane] = 0.0f, ray.mask[lane] = ~0u, ray.flags[lane] = 0;
                    ray.id[lane] = own[kept[at]];
                }
                rtcOccluded16(valid, scene, &context, &ray);
                uint32_t bits = 0;
                for (size_t lane = 0; lane < PACKET && base + lane < light_count; lane++)
                    bits |= (uint32_t)(ray.tfar[lane] < 0.0f) << lane;
                words[base / 32] |= bits << base % 32;
            }
        }
    }
}

int main(int argc, char **argv) {
    if (argc < 3) fail("usage:", "peer DIR RUNS [THREADS]");
    int runs = atoi(argv[2]), threads = argc > 3 ? atoi(argv[3]) : 2;
    if (runs < 1 || runs > MOST_RUNS || threads < 1 || threads > MOST_THREADS) fail("out of range:", "RUNS or THREADS");
    size_t words, mask_words, samples = load_scene(argv[1]);
    lights = (const float *)load(argv[1], "light_samples", &words);
    light_count = words / 3;
    words_each = (light_count + 31) / 32;
    uint32_t *mask = load(argv[1], "mask", &mask_words);
    if (mask_words != samples * words_each) fail("sizes differ in", argv[1]);
    blocked = calloc(kept_count * words_each + 1, 4);
    static double millis[4][MOST_RUNS];
    measure(trace, runs, threads, millis);
    size_t count = 0, differ = 0, penumbra = 0;
    for (size_t i = 0; i < kept_count; i++) {
        size_t mine = 0;
        for (size_t word = 0; word < words_each; word++) {
            uint32_t theirs = blocked[i * words_each + word], ours = mask[kept[i] * words_each + word];
            mine += __builtin_popcount(ours);
            count += __builtin_popcount(theirs), differ += __builtin_popcount(theirs ^ ours);
        }
        penumbra += mine > 0 && mine < light_count;
    }
    printf("{\"triangles\": %zu, \"rays\": %zu, \"threads\": %d, \"self\": \"%s\", \"blocked\": %zu, \"differ\": %zu, \"penumbra\": %.4f",
           triangle_count, kept_count * light_count, threads, filtered ? "filter" : "tnear", count, differ,
           kept_count ? (double)penumbra / (double)kept_count : 0.0);
    print_millis(millis, runs);
    return 0;
}
