/* The frame budget: a stretch of a run (frame_budget_replay.h) again and again through the C interface, so that the time of
 * the engine's frame alone is measured. ci/frame_budget records the stretches and runs this program.
 *
 *     frame_budget MOTION [--workers N] [--paced S]
 *
 * With --paced the frames first keep the clock at 1 kHz for so long. Percentiles and missed deadlines are printed and decide
 * nothing: on a machine that others use they tell more of the others. What noise cannot move decides: a frame that asks for
 * memory makes the program fail, and the last line is the ratio of least times that ci/frame_budget compares. With a worker
 * the hand-over is how long a word takes to its core and back, the longer of before and after.
 *
 * Exit code: 0, 1 if a frame asked for memory, 2 for a wrong option or file, 3 if engine or system refused a call, 4 if
 * there is no core for a worker.
 */
#define _GNU_SOURCE
#include "docking_scene.h"
#include "docking_timing.h"
#include "frame_budget_handover.h"
#include "frame_budget_replay.h"
#include "sealed_frames_counter.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAME_NS 1000000L
/* Long enough for a sleeping worker to be up, short against a frame. */
#define PREWAKE_NS 100000L
/* Long against a frame: a worker that has woken up is there for the next frames. */
#define AWAKE_US 1000
#define PRIORITY 20

/* The first core of the mask is the caller's; the workers take those behind it. */
static void bind_to_first_core(void)
{
    cpu_set_t mask, first;
    int core;
    if (sched_getaffinity(0, sizeof mask, &mask) != 0) {
        return;
    }
    for (core = 0; core < CPU_SETSIZE; core++) {
        if (CPU_ISSET(core, &mask)) {
            CPU_ZERO(&first);
            CPU_SET(core, &first);
            sched_setaffinity(0, sizeof first, &first);
            return;
        }
    }
}

/* So that other programs do not keep a worker from its core for the whole measurement. Where it is refused, the run is told to
 * be without it. After the seal: what a thread starts inherits its priority. */
static void ask_for_priority(void)
{
    struct sched_param p;
    memset(&p, 0, sizeof p);
    p.sched_priority = PRIORITY;
    if (sched_setscheduler(0, SCHED_FIFO, &p) != 0) {
        printf("  SCHED_FIFO refused\n");
    }
}

static unsigned long memory_calls(void) { return allocations() + frees(); }

/* --- paced ---------------------------------------------------------------------------------------------------------- */

/* Until shortly before the frame, then awake: that is what a worker that does not sleep is for. */
static void wait_for(replay *r, long long release)
{
    sleep_until(release - PREWAKE_NS);
    CHECK(pong_prewake(r->world, 2 * PREWAKE_NS / 1000));
    while (now_ns() < release) {
    }
}

/* Frames released by the clock; the deadline of each is the release of the next. Returns its calls for memory. */
static unsigned long run_paced(replay *r, double seconds)
{
    size_t frames = (size_t)(seconds * 1e9 / FRAME_NS + 0.5), n, missed = 0;
    durations took = make_durations(frames);
    unsigned long before = memory_calls(), calls;
    long long release = now_ns() + FRAME_NS;
    for (n = 0; n < frames; n++, release += FRAME_NS) {
        long long start, end;
        size_t frame = n % r->frames;
        wait_for(r, release);
        start = now_ns();
        if (frame == 0) {
            rewind_replay(r);
        }
        replay_frame(r, frame);
        end = now_ns();
        note(&took, end - start);
        missed += end - release > FRAME_NS;
    }
    calls = memory_calls() - before;
    printf("  paced at 1 kHz: %u frames, %u past their deadline\n", (unsigned)frames, (unsigned)missed);
    print_durations("frame", &took);
    free(took.us);
    return calls;
}

/* --- the ratio ------------------------------------------------------------------------------------------------------ */

enum { POINTS = 1024, PLANES = 16, LEAST_ROUNDS = 40 };
#define LEAST_NS 2000000000LL

static double points[POINTS][3], planes[PLANES][4];

static void lay_out_reference(void)
{
    int i, k;
    for (i = 0; i < POINTS; i++) {
        for (k = 0; k < 3; k++) {
            points[i][k] = (double)((i * 37 + k * 101) % 257) / 257.0;
        }
    }
    for (i = 0; i < PLANES; i++) {
        for (k = 0; k < 4; k++) {
            planes[i][k] = (double)((i * 53 + k * 29) % 61) / 61.0 - 0.5;
        }
    }
}

/* Heights of points over planes, the highest of each: the kind of work that a frame does, out of the cache. On its own and
 * aligned, so that its time does not depend on what stands around it. */
__attribute__((noinline, aligned(64))) static double reference(void)
{
    double sum = 0.0;
    int i, k;
    for (i = 0; i < POINTS; i++) {
        double highest = -1e9;
        for (k = 0; k < PLANES; k++) {
            double height = planes[k][0] * points[i][0] + planes[k][1] * points[i][1] + planes[k][2] * points[i][2] -
                            planes[k][3];
            highest = height > highest ? height : highest;
        }
        sum += highest;
    }
    return sum;
}

typedef struct {
    long long *of_frame, *of_reference;
    double frames_us, references_us;
    unsigned long frames, shared; /* in how many of the frames a worker did a part */
} least_times;

static int worker_took_part(const replay *r)
{
    pong_worker worker;
    return r->workers > 0 && pong_get_worker(r->world, 1, &worker) == PONG_STATUS_OK && worker.blocks > 0;
}

static long long lesser(long long known, long long now) { return known == 0 || now < known ? now : known; }

/* The stretch over and over, a reference loop before each frame. What is left of a frame in the round in which nobody
 * disturbed it is its least time; the ratio is that of the sums of least times, so every frame of the stretch counts. */
static unsigned long measure_ratio(replay *r, least_times *least)
{
    size_t frame;
    int round;
    long long began;
    double sum = 0.0;
    durations took = make_durations(r->frames * LEAST_ROUNDS);
    unsigned long before, calls;
    memset(least, 0, sizeof *least);
    least->of_frame = calloc(r->frames, sizeof *least->of_frame);
    least->of_reference = calloc(r->frames, sizeof *least->of_reference);
    if (least->of_frame == NULL || least->of_reference == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(3);
    }
    lay_out_reference();
    before = memory_calls();
    began = now_ns();
    for (round = 0; round < LEAST_ROUNDS || now_ns() - began < LEAST_NS; round++) {
        rewind_replay(r);
        for (frame = 0; frame < r->frames; frame++) {
            long long start, middle, end;
            CHECK(pong_prewake(r->world, AWAKE_US));
            start = now_ns();
            sum += reference();
            middle = now_ns();
            replay_frame(r, frame);
            end = now_ns();
            note(&took, end - middle);
            least->of_reference[frame] = lesser(least->of_reference[frame], middle - start);
            least->of_frame[frame] = lesser(least->of_frame[frame], end - middle);
            least->frames += 1;
            least->shared += worker_took_part(r);
        }
    }
    calls = memory_calls() - before;
    for (frame = 0; frame < r->frames; frame++) {
        least->frames_us += (double)least->of_frame[frame] * 1e-3;
        least->references_us += (double)least->of_reference[frame] * 1e-3;
    }
    printf("  as fast as it goes: %d rounds of %u frames (mean of the loops %.6g)\n", round, (unsigned)r->frames,
           sum / round / (double)r->frames);
    print_durations("frame", &took);
    free(took.us);
    free(least->of_frame);
    free(least->of_reference);
    return calls;
}

static void print_scene(const replay *r)
{
    pong_report report;
    CHECK(pong_get_report(r->world, &report));
    printf("  %u movable groups, at most %u contacts\n", (unsigned)r->group_count,
           (unsigned)report.peak_contacts_wanted);
}

/* From the calling thread to the core of the worker and back. While it rests: both would spin there. */
static double to_worker_ns(const replay *r)
{
    pong_worker worker;
    if (r->workers == 0) {
        return 0.0;
    }
    CHECK(pong_quiesce(r->world));
    CHECK(pong_get_worker(r->world, 1, &worker));
    return hand_over_ns((int)worker.core);
}

/* --- main ----------------------------------------------------------------------------------------------------------- */

static void print_worker(const replay *r, const least_times *least, double hand_over)
{
    const char *text;
    CHECK(pong_worker_text(r->world, 1, &text));
    printf("hand-over: %.0f ns\n", hand_over);
    printf("  %s; it did a part of %.0f %% of the frames\n", text, 100.0 * (double)least->shared / (double)least->frames);
}

static int measure(const char *file, uint32_t workers, double paced)
{
    replay r;
    least_times least;
        double frames, before, after;
    unsigned long calls = 0;
    pong_config config = pong_default_config();
    config.workers = workers;
    config.pin_workers = workers > 0;
    config.fifo_priority = workers > 0 ? PRIORITY : 0;
    open_replay(&r, file, config);
    if (r.workers < workers) {
        printf("  left out: there is no core for %u workers\n", (unsigned)workers);
        return 4;
    }
    bind_to_first_core();
    ask_for_priority();
    if (paced > 0.0) {
        calls += run_paced(&r, paced);
    }
    before = to_worker_ns(&r);
    calls += measure_ratio(&r, &least);
    after = to_worker_ns(&r);
    print_scene(&r);
    if (workers > 0) {
        print_worker(&r, &least, before > after ? before : after);
    }
    frames = (double)r.frames;
    close_replay(&r);
    if (calls > 0) {
        printf("  frames asked for memory: %lu calls\n", calls);
    }
    printf("  least times: frames %.2f us, loops %.2f us\n", least.frames_us / frames,
           least.references_us / frames);
    printf("ratio of least times: %.3f\n", least.frames_us / least.references_us);
    return calls == 0 ? 0 : 1;
}

int main(int argc, char **argv)
{
    const char *file = NULL;
    unsigned long workers = 0;
    double paced = 0.0;
    int i;
    for (i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--workers") == 0 && i + 1 < argc) {
            workers = strtoul(argv[++i], NULL, 10);
        } else if (strcmp(argv[i], "--paced") == 0 && i + 1 < argc) {
            paced = strtod(argv[++i], NULL);
        } else if (argv[i][0] != '-' && file == NULL) {
            file = argv[i];
        } else {
            file = NULL;
            break;
        }
    }
    if (file == NULL || workers > 64 || !(paced >= 0.0 && paced < 1e4)) {
        fprintf(stderr, "frame_budget MOTION [--workers N] [--paced S]\n");
        return 2;
    }
    return measure(file, (uint32_t)workers, paced);
}
