/* A real-time executive around the contact engine, to copy from.
 *
 * There are two worlds at two rates: the docking of docking.c at 1 kHz, and a tool that floats in the chaser's cabin at
 * 100 Hz. Each has a thread. The clock releases the fast one, which releases the slow one. Memory is locked, SCHED_FIFO
 * and a core are used if asked for, and every deadline is accounted for. A frame that is late already keeps the wrench
 * of an earlier one, for at most three frames. docs/realtime.md explains.
 *
 *     executive --lock --fifo 40 --core 1     10 s in real time
 *     executive --rehearse                    each frame is evaluated 0.1 ms before as well, for warm caches
 *     executive --fast                        the same without the clock
 *     executive --fast --save end             ... and a checkpoint of its end
 *     executive --save-at 2 --save two        a checkpoint of 2 s, taken in a frame
 *     executive --restart two --fast          from there on, to the same bits
 *     executive --fast --late 500,3           the frames 500, 501 and 502 pass for late
 *
 * Exit code: 0 if the run came to its end, 2 for a wrong option or file, 3 if engine or system refused a call.
 */
#include "executive_checkpoint.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *models, *save, *restart;
    int fast;
    double seconds, save_at;
    run_options run;
} options;

static void usage(FILE *to)
{
    fprintf(to, "executive [--models FOLDER] [--seconds S] [--fast] [--late FIRST,COUNT]\n"
                "          [--lock] [--fifo PRIORITY] [--core N] [--workers N] [--rehearse]\n"
                "          [--save FILE] [--save-at S] [--restart FILE]\n");
}

static void refuse(const char *option, const char *why)
{
    fprintf(stderr, "%s: %s\n", option, why);
    usage(stderr);
    exit(2);
}

static const char *text(int argc, char **argv, int *i)
{
    if (*i + 1 >= argc) {
        refuse(argv[*i], "needs a value behind it");
    }
    return argv[++*i];
}

static double number(int argc, char **argv, int *i, double least, double most)
{
    const char *option = argv[*i], *written = text(argc, argv, i);
    char *end, why[80];
    double value = strtod(written, &end);
    if (end == written || *end != '\0' || !(value >= least && value <= most)) {
        sprintf(why, "needs a number from %g to %g", least, most);
        refuse(option, why);
    }
    return value;
}

/* A time as a frame at which both worlds rest. */
static long frame_of(const char *option, double seconds)
{
    long frame = RATIO * (long)(seconds / (FRAME_S * RATIO) + 0.5);
    if (fabs((double)frame * FRAME_S - seconds) > 1e-9) {
        refuse(option, "needs a whole number of slow frames of 10 ms");
    }
    return frame;
}

static void read_options(int argc, char **argv, options *o)
{
    int i;
    memset(o, 0, sizeof *o);
    o->models = "models/idss_docking";
    o->seconds = 10.0;
    o->save_at = -1.0;
    o->run.wishes.core = -1;
    for (i = 1; i < argc; i++) {
        const char *a = argv[i];
        if (strcmp(a, "--models") == 0) {
            o->models = text(argc, argv, &i);
        } else if (strcmp(a, "--seconds") == 0) {
            o->seconds = number(argc, argv, &i, 0.01, 1e4);
        } else if (strcmp(a, "--fast") == 0) {
            o->fast = 1;
        } else if (strcmp(a, "--late") == 0) {
            if (sscanf(text(argc, argv, &i), "%ld,%ld", &o->run.late_first, &o->run.late_count) != 2) {
                refuse(a, "needs the first frame and how many, as 500,3");
            }
        } else if (strcmp(a, "--lock") == 0) {
            o->run.wishes.lock_memory = 1;
        } else if (strcmp(a, "--fifo") == 0) {
            o->run.wishes.fifo = (int)number(argc, argv, &i, 1.0, 99.0);
        } else if (strcmp(a, "--core") == 0) {
            o->run.wishes.core = (int)number(argc, argv, &i, 0.0, 1023.0);
        } else if (strcmp(a, "--workers") == 0) {
            o->run.workers = (int)number(argc, argv, &i, 0.0, 64.0);
        } else if (strcmp(a, "--rehearse") == 0) {
            o->run.rehearse = 1;
        } else if (strcmp(a, "--save") == 0) {
            o->save = text(argc, argv, &i);
        } else if (strcmp(a, "--save-at") == 0) {
            o->save_at = number(argc, argv, &i, 0.0, 1e4);
        } else if (strcmp(a, "--restart") == 0) {
            o->restart = text(argc, argv, &i);
        } else if (strcmp(a, "--help") == 0) {
            usage(stdout);
            exit(0);
        } else {
            refuse(a, "no such option");
        }
    }
    if (o->run.late_count > 0 && !o->fast) {
        refuse("--late", "only with --fast: in real time the clock says which frames are late");
    }
    if (o->run.rehearse && o->fast) {
        refuse("--rehearse", "not with --fast: without the clock there is no time before a frame");
    }
    if (o->save_at >= 0.0 && o->save == NULL) {
        refuse("--save-at", "needs --save FILE as well");
    }
    o->run.end = frame_of("--seconds", o->seconds);
}

/* --- the run ----------------------------------------------------------------------------------------------------- */

static void open_simulation(simulation *sim, const options *o)
{
    pong_config config = pong_default_config();
    docking_case slow_corner;
    double gap;

    memset(sim, 0, sizeof *sim);
    docking_defaults(&sim->dynamics);
    config.workers = (uint32_t)o->run.workers;
    config.pin_workers = o->run.workers > 0;
    config.fifo_priority = (uint32_t)(o->run.workers > 0 ? o->run.wishes.fifo : 0);
    open_scene(&sim->scene, &config, o->models, &sim->dynamics);
    open_cabin(&sim->cabin);
    find_case("slow,y+,roll+,pitch+", &slow_corner);
    gap = first_contact_gap(&sim->scene, &sim->dynamics, &slow_corner);
    approach(&sim->dynamics, &slow_corner, gap + 0.002, 1);
    place_tool(&sim->cabin, &sim->dynamics.chaser.centre);
}

typedef struct {
    checkpoint *into;
    long frame;
} save_request;

static void save_in_frame(simulation *sim, void *context)
{
    save_request *request = context;
    if (request->into->size == 0 && sim->frame >= request->frame) {
        take_checkpoint(request->into, sim);
    }
}

static void print_end(const simulation *sim)
{
    alignment a = align(&sim->dynamics);
    vec3 tool = sub(sim->cabin.tool.position, sim->dynamics.chaser.centre.position);
    printf("at %.2f s: gap %.6f m, lateral %.6f m, tilt %.4f deg; tool at %.6f %.6f %.6f m in the cabin\n",
           (double)sim->frame * FRAME_S, a.gap, a.lateral, a.tilt / DEGREE, tool.x, tool.y, tool.z);
    printf("contacts: at most %u; %u frames with a flag\n", (unsigned)sim->most_contacts, (unsigned)sim->flagged);
}

int main(int argc, char **argv)
{
    static simulation sim;
    options o;
    checkpoint file;
    save_request request;
    schedule fast, slow;

    read_options(argc, argv, &o);
    open_simulation(&sim, &o);
    make_checkpoint(&file, &sim);
    if (o.restart != NULL) {
        read_checkpoint(&file, o.restart);
        restart_from(&file, &sim);
        file.size = 0;
        if (sim.frame >= o.run.end) {
            refuse("--restart", "the checkpoint is later than the end; give --seconds");
        }
    }
    request.into = &file;
    request.frame = o.save_at >= 0.0 ? frame_of("--save-at", o.save_at) : o.run.end;
    make_schedule(&fast, "fast", (long long)(FRAME_S * 1e9), (size_t)(o.run.end - sim.frame));
    make_schedule(&slow, "slow", (long long)(CABIN_FRAME_S * 1e9), (size_t)(o.run.end - sim.frame) / RATIO);
    if (o.fast) {
        run_without_clock(&sim, &o.run, &fast, &slow, save_in_frame, &request);
    } else {
        run_in_real_time(&sim, &o.run, &fast, &slow, save_in_frame, &request);
    }
    print_schedule(&fast);
    print_schedule(&slow);
    print_end(&sim);
    if (o.save != NULL && file.size > 0) {
        write_checkpoint(&file, o.save);
    }
    free_schedule(&fast);
    free_schedule(&slow);
    free(file.bytes);
    CHECK(pong_destroy_world(sim.cabin.world));
    CHECK(pong_destroy_world(sim.scene.world));
    return 0;
}
