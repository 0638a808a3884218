/* peer: shadow rays through Embree 3 on the view-samples and triangles of a dump.
 *
 *   peer DIR RUNS [THREADS]
 *
 * DIR holds what `shadowgraph render .. --dump DIR` writes: triangles.npy [T 3 3] f32, light_samples.npy [1 3] f32, and one file
 * each for the ports position [P 3] f32, triangle [P] u32, sample_state [P] u32 and mask [P 1] u32, copied to those names (run.sh
 * does that). Builds a scene over all triangles and asks rtcOccluded16 for every kept view-sample, rays from the
 * view-sample to the light, RUNS times each; prints one line of JSON with median and extreme milliseconds of build, trace and
 * both, wall and processor time, and how many answers differ from the mask.
 * For self hits see peer.h.
 */
#include "peer.h"

enum { BLOCK = 1024 };

static const float *light;
static uint8_t *blocked;

static void *trace(void *unused) {
    (void)unused;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (;;) {
        size_t first = __atomic_fetch_add(&next_block, BLOCK, __ATOMIC_RELAXED);
        if (first >= kept_count) return NULL;
        size_t last = first + BLOCK < kept_count ? first + BLOCK : kept_count;
        for (size_t base = first; base < last; base += PACKET) {
            struct RTCRay16 ray;
            int valid[PACKET] __attribute__((aligned(64)));
            for (size_t lane = 0; lane < PACKET; lane++) {
                size_t at = base + lane < last ? base + lane : base;
                const float *p = positions + 3 * (size_t)kept[at];
                valid[lane] = base + lane < last ? -1 : 0;
                ray.org_x[lane] = p[0], ray.org_y[lane] = p[1], ray.org_z[lane] = p[2];
                ray.dir_x[lane] = light[0] - p[0], ray.dir_y[lane] = light[1] - p[1], ray.dir_z[lane] = light[2] - p[2];
                ray.tnear[lane] = filtered ? 0.0f : 1e-4f, ray.tfar[lane] = 1.0f;
                ray.time[lane] = 0.0f, ray.mask[lane] = ~0u, ray.flags[lane] = 0;
                ray.id[lane] = own[kept[at]];
            }
            rtcOccluded16(valid, scene, &context, &ray);
            for (size_t lane = 0; base + lane < last; lane++) blocked[base + lane] = ray.tfar[lane] < 0.0f;
        }
    }
}

int main(int argc, char **argv) {
    if (argc < 3) fail("usage:", "peer DIR RUNS [THREADS]");
    int runs = atoi(argv[2]), threads = argc > 3 ? atoi(argv[3]) : 2;
    if (runs < 1 || runs > MOST_RUNS || threads < 1 || threads > MOST_THREADS) fail("out of range:", "RUNS or THREADS");
    size_t words, mask_words, samples = load_scene(argv[1]);
    light = (const float *)load(argv[1], "light_samples", &words);
    if (words != 3) fail("one light sample wanted in", argv[1]);
    uint32_t *mask = load(argv[1], "mask", &mask_words);
    if (mask_words != samples) fail("sizes differ in", argv[1]);
    blocked = calloc(kept_count + 1, 1);
    static double millis[4][MOST_RUNS];
    measure(trace, runs, threads, millis);
    size_t count = 0, differ = 0;
    for (size_t i = 0; i < kept_count; i++) count += blocked[i], differ += blocked[i] != (mask[kept[i]] & 1);
    printf("{\"triangles\": %zu, \"rays\": %zu, \"threads\": %d, \"self\": \"%s\", \"blocked\": %zu, \"differ\": %zu",
           triangle_count, kept_count, threads, filtered ? "filter" : "tnear", count, differ);
    print_millis(millis, runs);
    return 0;
}
