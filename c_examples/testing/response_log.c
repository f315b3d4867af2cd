/* Response logs from C: what is refused, that frames take no memory while they are logged, that the files hold what the
 * world gave, that lost frames are counted.
 *
 *     response_log [FOLDER]      leaves its logs in FOLDER; without one it removes them
 */
#define _XOPEN_SOURCE 700
#include "check.h"
#include "sealed_frames_counter.h"

#include <ftw.h>
#include <math.h>
#include <time.h>
#include <unistd.h>

enum { FRAMES = 3000, BODIES = 3 };

static char folder[512];

static const char *inside(const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* The ball slides, sticks and hops. */
static void place(scene *s, long n)
{
    double t = 0.01 * (double)n;
    s->states[0].position[0] = 0.003 * sin(2.0 * t);
    s->states[0].position[2] = 0.099 + 0.003 * sin(7.0 * t);
    s->states[0].linear_velocity[0] = 0.006 * cos(2.0 * t);
    s->states[0].linear_velocity[2] = 0.021 * cos(7.0 * t);
    OK(pong_set_states(s->world, s->interfaces, s->states, BODIES));
}

static void refusals(void)
{
    scene s;
    pong_config config = pong_default_config();
    pong_log_options options = pong_default_log_options();
    pong_log_report report;
    pong_world *other = NULL;
    open_scene(&s, &config);
    REFUSED(pong_start_log(s.world, inside("early"), NULL), WRONG_PHASE, "seal the world first");
    seal_scene(&s);
    REFUSED(pong_log_frame(s.world, 0.0), WRONG_PHASE, "pong_start_log()");
    REFUSED(pong_get_log_report(s.world, &report), WRONG_PHASE, "there is none");
    REFUSED(pong_stop_log(s.world, NULL), WRONG_PHASE, "there is none");
    REFUSED(pong_start_log(s.world, NULL, NULL), NULL_ARGUMENT, "`folder`");
    REFUSED(pong_start_log(s.world, "/dev/null/log", NULL), LOG_FAILED, "/dev/null/log: cannot be written");
    options.when_full = 7;
    REFUSED(pong_start_log(s.world, inside("wrong"), &options), BAD_VALUE, "when_full is 7");
    options = pong_default_log_options();
    options.flush_ms = 0;
    REFUSED(pong_start_log(s.world, inside("wrong"), &options), BAD_VALUE, "flush_ms is 0");
    memset(&options, 0, sizeof options);
    REFUSED(pong_start_log(s.world, inside("wrong"), &options), CONFIG, "pong_default_log_options()");
    OK(pong_start_log(s.world, inside("refusals"), NULL));
    OK(pong_clone_world(s.world, &other));
    REFUSED(pong_continue_from(s.world, other, NULL), WRONG_PHASE, "a log of this one is running");
    OK(pong_destroy_world(other));
    REFUSED(pong_start_log(s.world, inside("second"), NULL), WRONG_PHASE, "one is running");
    REFUSED(pong_log_frame(s.world, 0.0), WRONG_PHASE, "after it was evaluated");
    OK(pong_step(s.world));
    REFUSED(pong_log_frame(s.world, nan("")), BAD_VALUE, "the time is NaN");
    place(&s, 1);
    REFUSED(pong_log_frame(s.world, 0.0), WRONG_PHASE, "before states, pairs or surfaces change");
    OK(pong_step(s.world));
    OK(pong_log_frame(s.world, 0.0));
    OK(pong_set_pair_enabled(s.world, s.pair, 0));
    REFUSED(pong_log_frame(s.world, 0.0), WRONG_PHASE, "before states, pairs or surfaces change");
    OK(pong_stop_log(s.world, &report));
    TEST(report.frames == 1 && report.flushed == 1 && report.lost == 0 && report.failed == 0);
    REFUSED(pong_start_log(s.world, inside("refusals"), NULL), LOG_FAILED, "holds a log already");
    options = pong_default_log_options();
    options.overwrite = 1;
    OK(pong_start_log(s.world, inside("refusals"), &options));
    /* Destroying the world closes the log. */
    OK(pong_destroy_world(s.world));
}

/* Everything that a log takes note of, once in a while. */
static void change(scene *s, long n)
{
    if (n % 500 == 250) {
        OK(pong_clear_contact_history(s->world, s->ball));
    }
    if (n % 700 == 300 || n % 700 == 310) {
        OK(pong_set_pair_enabled(s->world, s->pair, n % 700 == 310));
    }
}

static void commit(scene *s, long n)
{
    OK(pong_evaluate(s->world));
    if (n % 700 == 500 || n % 700 == 510) {
        /* After the evaluation: the commit evaluates anew. */
        OK(pong_set_pair_enabled(s->world, s->pair, n % 700 == 510));
    }
    if (n % 5 == 1) {
        OK(pong_commit_pairs(s->world, &s->pair, 1));
    } else if (n % 5 == 2) {
        OK(pong_commit_pairs(s->world, NULL, 0));
    } else if (n % 5 != 3) {
        OK(pong_commit(s->world));
    }
}

/* Row `row` of the table of wrenches as NumPy would read it; fails unless the header tells `rows` rows. */
static void read_wrenches(long rows, long row, double wrenches[BODIES][6])
{
    char header[2048], shape[64];
    unsigned char head[10];
    size_t length;
    FILE *file = fopen(inside("frames/wrenches.npy"), "rb");
    TEST(file != NULL && fread(head, 1, sizeof head, file) == sizeof head && memcmp(head, "\x93NUMPY\x01", 7) == 0);
    length = head[8] + 256u * head[9];
    TEST(length < sizeof header && (length + sizeof head) % 64 == 0 && fread(header, 1, length, file) == length);
    header[length] = '\0';
    snprintf(shape, sizeof shape, "'shape': (%ld, %d)", rows, BODIES);
    TEST(strstr(header, shape) != NULL && strstr(header, "('moment', '<f8', (3,))") != NULL);
    TEST(fseek(file, row * (long)sizeof(double[BODIES][6]), SEEK_CUR) == 0);
    TEST(fread(wrenches, sizeof(double[BODIES][6]), 1, file) == 1);
    fclose(file);
}

static void frames(void)
{
    static pong_wrench seen[FRAMES][BODIES];
    scene s;
    pong_config config = pong_default_config();
    pong_log_options options = pong_default_log_options();
    pong_log_report report;
    struct timespec pause = { 0, 50000000 };
    unsigned long allocated, freed, contacts = 0;
    size_t count;
    long n;
    double wrenches[BODIES][6];
    config.contact_capacity = 64;
    open_scene(&s, &config);
    seal_scene(&s);
    options.name = "ball";
    options.step = 0.01;
    options.flush_ms = 10;
    options.commits_per_frame = 1;
    OK(pong_start_log(s.world, inside("frames"), &options));
    /* The thread of the log has begun. */
    nanosleep(&pause, NULL);
    allocated = allocations();
    freed = frees();
    for (n = 0; n < FRAMES; n += 1) {
        change(&s, n);
        place(&s, n);
        commit(&s, n);
        OK(pong_get_wrenches(s.world, s.interfaces, PONG_REFERENCE_FRAME_COMMON, seen[n], BODIES));
        OK(pong_log_frame(s.world, 0.01 * (double)n));
        OK(pong_get_log_report(s.world, &report));
        OK(pong_contact_count(s.world, &count));
        contacts += count;
    }
    allocated = allocations() - allocated;
    freed = frees() - freed;
    TEST(allocated == 0 && freed == 0);
    TEST(contacts > FRAMES / 4);
    OK(pong_stop_log(s.world, &report));
    TEST(report.frames == FRAMES && report.flushed == FRAMES && report.lost == 0 && report.events_lost == 0);
    TEST(report.bytes > 0 && report.buffer_peak > 0 && report.buffer_peak < report.buffer_size);
    printf("%d frames with %lu contacts: %lu allocations, %lu frees, %.0f bytes per frame\n", FRAMES, contacts, allocated,
           freed, (double)report.bytes / FRAMES);
    for (n = 0; n < FRAMES; n += 299) {
        read_wrenches(FRAMES, n, wrenches);
        TEST(memcmp(wrenches, seen[n], sizeof wrenches) == 0);
    }
    OK(pong_destroy_world(s.world));
}

/* Two frames fit; many are logged at once. */
static void losses(void)
{
    scene s;
    pong_config config = pong_default_config();
    pong_log_options options = pong_default_log_options();
    pong_log_report report;
    long n;
    config.contact_capacity = 64;
    open_scene(&s, &config);
    seal_scene(&s);
    options.buffer_bytes = 1;
    OK(pong_start_log(s.world, inside("losses"), &options));
    place(&s, 0);
    OK(pong_step(s.world));
    for (n = 0; n < 20000; n += 1) {
        OK(pong_log_frame(s.world, 0.0));
    }
    OK(pong_stop_log(s.world, &report));
    TEST(report.frames == 20000 && report.lost > 0 && report.flushed == 20000 - report.lost && report.failed == 0);
    printf("a buffer that is too small: %lu of 20000 frames lost\n", (unsigned long)report.lost);
    options.when_full = PONG_LOG_WAIT;
    options.overwrite = 1;
    OK(pong_start_log(s.world, inside("losses"), &options));
    for (n = 0; n < 2000; n += 1) {
        OK(pong_log_frame(s.world, 0.0));
    }
    OK(pong_stop_log(s.world, &report));
    TEST(report.lost == 0 && report.flushed == 2000);
    OK(pong_destroy_world(s.world));
}

static int remove_it(const char *path, const struct stat *status, int kind, struct FTW *walk)
{
    (void)status, (void)kind, (void)walk;
    return remove(path);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        snprintf(folder, sizeof folder, "%s", argv[1]);
    } else {
        const char *temporary = getenv("TMPDIR");
        snprintf(folder, sizeof folder, "%s/response_log_XXXXXX", temporary == NULL ? "/tmp" : temporary);
        TEST(mkdtemp(folder) != NULL);
    }
    refusals();
    frames();
    losses();
    if (argc <= 1) {
        TEST(nftw(folder, remove_it, 16, FTW_DEPTH | FTW_PHYS) == 0);
    }
    return report_failures("response_log");
}
