/* What the peers share: reading .npy dumps, an Embree scene over all triangles that can refuse own triangles, and figures.
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

enum { KEPT = 1, MOST_RUNS = 101, MOST_THREADS = 64, PACKET = 16 };

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
static const float *triangles, *positions;
static const uint32_t *own, *kept;
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

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print(const char *name, double *values, int runs) {
    qsort(values, runs, sizeof *values, ascending);
    printf(", \"%s\": [%.3f, %.3f, %.3f]", name, 1e3 * values[runs / 2], 1e3 * values[0], 1e3 * values[runs - 1]);
}

/* Triangles, positions, own triangles and kept view-samples of a dump; their number of rows. */
static size_t load_scene(const char *folder) {
    size_t words, samples, states;
    triangles = (const float *)load(folder, "triangles", &words);
    triangle_count = words / 9;
    positions = (const float *)load(folder, "position", &words);
    own = load(folder, "triangle", &samples);
    uint32_t *state = load(folder, "sample_state", &states);
    if (words != 3 * samples || states != samples) fail("sizes differ in", folder);
    uint32_t *list = malloc(4 * samples + 4);
    for (size_t i = 0; i < samples; i++)
        if (state[i] == KEPT) list[kept_count++] = (uint32_t)i;
    kept = list;
    const char *self = getenv("PEER_SELF");
    filtered = self && !strcmp(self, "filter");
    return samples;
}

/* Builds the scene and traces, `runs` times after one that is not counted: it pays for threads and pages. */
static void measure(void *(*trace)(void *), int runs, int threads, double (*millis)[MOST_RUNS]) {
    char config[64];
    snprintf(config, sizeof config, "threads=%d", threads);
    device = rtcNewDevice(config);
    if (!device) fail("no Embree device with", config);
    for (int run = -1; run < runs; run++) {
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
            millis[0][run] = middle - start, millis[1][run] = end - middle, millis[2][run] = end - start;
            millis[3][run] = seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
        }
        rtcReleaseScene(scene);
    }
    rtcReleaseDevice(device);
}

/* The figures of `measure`, after the opening of a line of JSON. */
static void print_millis(double (*millis)[MOST_RUNS], int runs) {
    print("build_ms", millis[0], runs), print("trace_ms", millis[1], runs), print("total_ms", millis[2], runs), print("cpu_ms", millis[3], runs);
    printf("}\n");
}
