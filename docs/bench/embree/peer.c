/* peer: shadow rays through Embree 3 on the view-samples and triangles of a dump.
 *
 *   peer DIR RUNS [THREADS]
 *
 * DIR holds what `shadowgraph render .. --dump DIR` writes: triangles.npy [T 3 3] f32, light_samples.npy [1 3] f32, and one file
 * each for the ports position [P 3] f32, triangle [P] u32, sample_state [P] u32 and mask [P 1] u32, copied to those names (run.sh
 * does that). Builds a scene over all triangles and asks rtcOccluded16 for every kept view-sample, rays from the
 * view-sample to the light, RUNS times each; prints one line of JSON with median and extreme milliseconds of build, trace and
 * both, wall and processor time, and how many answers differ from the mask.
 *
 * Self hits. By default rays start at tnear = 1e-4 of the way to the light, which is the faster way and the peer's best case.
 * With PEER_SELF=filter they start at 0 and an intersection filter refuses the view-sample's own triangle by its index, as the
 * mask does. What still differs from the mask is rounding of Embree's f32 arithmetic and, by default, contacts nearer than
 * tnear; it is counted, not judged.
 */
#include <embree3/rtcore.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { KEPT = 1, MOST_RUNS = 101, MOST_THREADS = 64, PACKET = 16, BLOCK = 1024 };

static double seconds(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static void fail(const char *what, const char *name) {
    fprintf(stderr, "peer: %s %s\n", what, name);
    exit(1);
}

/* The words of a little-endian .npy file of 4-byte elements; *count is their number. */
static uint32_t *load(const char *folder, const char *name, size_t *count) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.npy", folder, name);
    FILE *file = fopen(path, "rb");
    unsigned char head[12];
    if (!file || fread(head, 1, 10, file) != 10 || memcmp(head, "\x93NUMPY", 6)) fail("cannot read", path);
    size_t skip = head[8] | head[9] << 8;
    if (head[6] > 1) {
        if (fread(head + 10, 1, 2, file) != 2) fail("cut short:", path);
        skip |= (size_t)head[10] << 16 | (size_t)head[11] << 24;
    }
    fseek(file, (long)skip, SEEK_CUR);
    long start = ftell(file);
    fseek(file, 0, SEEK_END);
    *count = (size_t)(ftell(file) - start) / 4;
    fseek(file, start, SEEK_SET);
    uint32_t *words = aligned_alloc(64, (*count * 4 + 127) / 64 * 64);
    if (!words || fread(words, 4, *count, file) != *count) fail("cut short:", path);
    fclose(file);
    return words;
}

static RTCDevice device;
static RTCScene scene;
static const float *triangles, *positions, *light;
static const uint32_t *own, *kept;
static uint8_t *blocked;
static size_t triangle_count, kept_count;
static int filtered;
static size_t next_block;

/* Rows of RTCRayN and RTCHitN, N wide each; the header's own accessors are C++. */
enum { RAY_ID = 10, HIT_PRIMITIVE = 5 };

/* Refuses hits on the triangle that the ray starts from, whose index travels in the ray's id. */
static void refuse_own(const struct RTCFilterFunctionNArguments *args) {
    const uint32_t *from = (const uint32_t *)args->ray + RAY_ID * args->N;
    const uint32_t *met = (const uint32_t *)args->hit + HIT_PRIMITIVE * args->N;
    for (unsigned i = 0; i < args->N; i++)
        if (args->valid[i] == -1 && from[i] == met[i])
            args->valid[i] = 0;
}

static void build(void) {
    scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, triangles, 0, 12, triangle_count * 3);
    uint32_t *index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangle_count);
    for (size_t i = 0; i < triangle_count * 3; i++) index[i] = (uint32_t)i;
    if (filtered) rtcSetGeometryOccludedFilterFunction(geometry, refuse_own);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene);
}

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

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print(const char *name, double *values, int runs) {
    qsort(values, runs, sizeof *values, ascending);
    printf(", \"%s\": [%.3f, %.3f, %.3f]", name, 1e3 * values[runs / 2], 1e3 * values[0], 1e3 * values[runs - 1]);
}

int main(int argc, char **argv) {
    if (argc < 3) fail("usage:", "peer DIR RUNS [THREADS]");
    int runs = atoi(argv[2]), threads = argc > 3 ? atoi(argv[3]) : 2;
    if (runs < 1 || runs > MOST_RUNS || threads < 1 || threads > MOST_THREADS) fail("out of range:", "RUNS or THREADS");
    const char *self = getenv("PEER_SELF");
    filtered = self && !strcmp(self, "filter");
    size_t words, samples, state_words, mask_words;
    triangles = (const float *)load(argv[1], "triangles", &words);
    triangle_count = words / 9;
    light = (const float *)load(argv[1], "light_samples", &words);
    if (words != 3) fail("one light sample wanted in", argv[1]);
    positions = (const float *)load(argv[1], "position", &words);
    own = load(argv[1], "triangle", &samples);
    uint32_t *state = load(argv[1], "sample_state", &state_words), *mask = load(argv[1], "mask", &mask_words);
    if (words != 3 * samples || state_words != samples || mask_words != samples) fail("sizes differ in", argv[1]);
    uint32_t *list = malloc(4 * samples + 4);
    for (size_t i = 0; i < samples; i++)
        if (state[i] == KEPT) list[kept_count++] = (uint32_t)i;
    kept = list;
    blocked = calloc(kept_count + 1, 1);

    char config[64];
    snprintf(config, sizeof config, "threads=%d", threads);
    device = rtcNewDevice(config);
    if (!device) fail("no Embree device with", config);
    static double built[MOST_RUNS], traced[MOST_RUNS], both[MOST_RUNS], processor[MOST_RUNS];
    for (int run = -1; run < runs; run++) { /* the first is not counted: it pays for threads and pages */
        double cpu = seconds(CLOCK_PROCESS_CPUTIME_ID), start = seconds(CLOCK_MONOTONIC);
        build();
        double middle = seconds(CLOCK_MONOTONIC);
        pthread_t worker[MOST_THREADS];
        next_block = 0;
        for (int i = 1; i < threads; i++) pthread_create(worker + i, NULL, trace, NULL);
        trace(NULL);
        for (int i = 1; i < threads; i++) pthread_join(worker[i], NULL);
        double end = seconds(CLOCK_MONOTONIC);
        if (run >= 0) {
            built[run] = middle - start, traced[run] = end - middle, both[run] = end - start;
            processor[run] = seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
        }
        rtcReleaseScene(scene);
    }
    size_t count = 0, differ = 0;
    for (size_t i = 0; i < kept_count; i++) count += blocked[i], differ += blocked[i] != (mask[kept[i]] & 1);
    printf("{\"triangles\": %zu, \"rays\": %zu, \"threads\": %d, \"self\": \"%s\", \"blocked\": %zu, \"differ\": %zu",
           triangle_count, kept_count, threads, filtered ? "filter" : "tnear", count, differ);
    print("build_ms", built, runs), print("trace_ms", traced, runs), print("total_ms", both, runs), print("cpu_ms", processor, runs);
    printf("}\n");
    rtcReleaseDevice(device);
    return 0;
}
