/* The frame budget: the docking of docking.c at 1 kHz through the C interface, alone and with one worker, as fast as it
 * goes and paced by the clock.
 *
 *     frame_budget [--seconds S] [--models FOLDER]
 *
 * Percentiles and missed deadlines are printed and decide nothing: on a machine that others use they tell more of the
 * others. What noise cannot move decides: a frame that asks for memory makes the program fail, and the last line is the
 * least time of a step over the least time of a fixed loop, measured in turns, for ci/frame_budget to compare.
 */
#define _GNU_SOURCE
#include "docking_scene.h"
#include "docking_timing.h"
#include "sealed_frames_counter.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAME_NS 1000000L
#define FRAME_S 1e-3
/* Long enough for a sleeping worker to be up, short against a frame. */
#define PREWAKE_NS 100000L

typedef struct {
    const char *models;
    double seconds;
} options;

/* One scene, one way to run it. */
typedef struct {
    contact_scene scene;
    docking d;
    docking most; /* as it was when there were most contacts */
    size_t most_contacts;
    durations step, frame;
    size_t misses;
    unsigned long memory_calls;
} budget;

static void begin(budget *b, const options *o, uint32_t workers)
{
    pong_config config = pong_default_config();
    docking_case c;
    memset(b, 0, sizeof *b);
    config.workers = workers;
    config.pin_workers = workers > 0;
    docking_defaults(&b->d);
    open_scene(&b->scene, &config, o->models, &b->d);
    find_case("slow,y+,roll+,pitch+", &c);
    approach(&b->d, &c, first_contact_gap(&b->scene, &b->d, &c) + 0.002, 1);
    b->most = b->d;
}

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

/* Until shortly before the frame, then awake: that is what a worker that does not sleep is for. */
static void wait_for(budget *b, long long release)
{
    sleep_until(release - PREWAKE_NS);
    CHECK(pong_prewake(b->scene.world, 2 * PREWAKE_NS / 1000));
    while (now_ns() < release) {
    }
}

static void one_frame(budget *b, long long release)
{
    contact_wrenches contact;
    size_t contacts;
    docking before = b->d;
    long long start = now_ns(), stepping, stepped, end;
    send_states(&b->scene, &b->d);
    stepping = now_ns();
    CHECK(pong_step(b->scene.world));
    stepped = now_ns();
    contact = fetch_wrenches(&b->scene);
    docking_step(&b->d, &contact, FRAME_S);
    end = now_ns();
    note(&b->step, stepped - stepping);
    note(&b->frame, end - start);
    b->misses += end - (release == 0 ? start : release) > FRAME_NS;
    CHECK(pong_contact_count(b->scene.world, &contacts));
    if (contacts > b->most_contacts) {
        b->most_contacts = contacts;
        b->most = before;
    }
}

static void run(budget *b, const options *o, int paced)
{
    long frames = (long)(o->seconds / FRAME_S + 0.5), n;
    long long release = now_ns();
    unsigned long before;
    b->step = make_durations((size_t)frames);
    b->frame = make_durations((size_t)frames);
    before = allocations() + frees();
    for (n = 0; n < frames; n++) {
        release += FRAME_NS;
        if (paced) {
            wait_for(b, release);
        }
        one_frame(b, paced ? release : 0);
    }
    b->memory_calls = allocations() + frees() - before;
}

static void print_run(budget *b, uint32_t workers, int paced)
{
    const char *text;
    pong_worker worker;
    printf("%u workers, %s: %u frames, %u past their deadline, at most %u contacts, %lu calls for memory\n",
           (unsigned)workers, paced ? "paced at 1 kHz" : "as fast as it goes", (unsigned)b->frame.count,
           (unsigned)b->misses, (unsigned)b->most_contacts, b->memory_calls);
    if (workers > 0) {
        CHECK(pong_worker_text(b->scene.world, 1, &text));
        CHECK(pong_get_worker(b->scene.world, 1, &worker));
        printf("  %s; %u blocks in the last shared round\n", text, (unsigned)worker.blocks);
    }
    print_durations("pong_step", &b->step);
    print_durations("whole frame", &b->frame);
}

/* --- the ratio -------------------------------------------------------------------------------------------------------- */

enum { POINTS = 1024, PLANES = 16, ROUNDS = 2000, DOCKING_FRAMES = 3000 };

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

/* Heights of points over planes, the highest of each: the kind of work that a step does, out of the cache. */
static double reference(void)
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

/* The same frame over and over, the one with most contacts of the first 3 s: all that varies is the machine. */
static double ratio_of_minima(const options *o, uint32_t workers)
{
    budget b;
    long long least_step = FRAME_NS * 1000LL, least_reference = FRAME_NS * 1000LL;
    double sum = 0.0;
    int round;
    begin(&b, o, workers);
    bind_to_first_core();
    for (round = 0; round < DOCKING_FRAMES; round++) {
        one_frame(&b, 0);
    }
    lay_out_reference();
    send_states(&b.scene, &b.most);
    for (round = 0; round < ROUNDS; round++) {
        long long start = now_ns(), middle, end;
        sum += reference();
        middle = now_ns();
        CHECK(pong_step(b.scene.world));
        end = now_ns();
        least_reference = middle - start < least_reference ? middle - start : least_reference;
        least_step = end - middle < least_step ? end - middle : least_step;
    }
    printf("  with %u contacts: least pong_step %.1f us, least reference loop %.1f us (sum %.6g)\n",
           (unsigned)b.most_contacts, (double)least_step * 1e-3, (double)least_reference * 1e-3, sum);
    CHECK(pong_destroy_world(b.scene.world));
    return (double)least_step / (double)least_reference;
}

/* --- main ------------------------------------------------------------------------------------------------------------- */

/* Returns how many calls for memory the frames made. */
static unsigned long measure(const options *o, uint32_t workers, double *ratio)
{
    cpu_set_t mask;
    unsigned long memory_calls = 0;
    int paced;
    sched_getaffinity(0, sizeof mask, &mask);
    *ratio = 0.0;
    for (paced = 0; paced < 2; paced++) {
        budget b;
        size_t started;
        begin(&b, o, workers);
        CHECK(pong_worker_count(b.scene.world, &started));
        if (started < workers) {
            printf("%u workers: left out, there is no core for them\n", (unsigned)workers);
            CHECK(pong_destroy_world(b.scene.world));
            return memory_calls;
        }
        bind_to_first_core();
        run(&b, o, paced);
        print_run(&b, workers, paced);
        memory_calls += b.memory_calls;
        CHECK(pong_destroy_world(b.scene.world));
        sched_setaffinity(0, sizeof mask, &mask);
        free(b.step.us);
        free(b.frame.us);
    }
    *ratio = ratio_of_minima(o, workers);
    sched_setaffinity(0, sizeof mask, &mask);
    return memory_calls;
}

int main(int argc, char **argv)
{
    options o = { "models/idss_docking", 5.0 };
    double alone, with_worker;
    unsigned long memory_calls;
    int i;
    for (i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--seconds") == 0 && i + 1 < argc) {
            o.seconds = strtod(argv[++i], NULL);
        } else if (strcmp(argv[i], "--models") == 0 && i + 1 < argc) {
            o.models = argv[++i];
        } else {
            fprintf(stderr, "frame_budget [--seconds S] [--models FOLDER]\n");
            return 2;
        }
    }
    if (!(o.seconds >= FRAME_S && o.seconds < 1e4)) {
        fprintf(stderr, "--seconds: give 0.001 to 10000\n");
        return 2;
    }
    memory_calls = measure(&o, 0, &alone);
    memory_calls += measure(&o, 1, &with_worker);
    if (with_worker > 0.0) {
        printf("ratio of minima with 1 worker: %.3f\n", with_worker);
    }
    printf("ratio of minima: %.3f\n", alone);
    if (memory_calls > 0) {
        printf("frames asked for memory: %lu calls\n", memory_calls);
    }
    return memory_calls == 0 ? 0 : 1;
}
