/* A docking, as the author of a simulation executive would write it.
 *
 * The executive owns the dynamics (docking_dynamics.c) and the clock (docking_timing.c). The contact engine owns the
 * contacts. Once a frame the two meet (docking_scene.c): states in, step, wrenches out.
 *
 *     docking                          one docking in real time, 1 kHz
 *     docking --fast                   the same, as fast as it goes
 *     docking --fast --all-corners     every corner of the standard's box of misalignments, as a table
 *     docking --fast --log FOLDER      the same with a response log (docs/response_logs.md)
 *     docking --fast --no-latches      the latches stay retracted: the vehicles must part again
 *
 * Exit code: 0 if it went as it must (captured; parted with --no-latches), 1 if not, 2 for a wrong option, 3 if the
 * engine refused a call.
 */
#include "docking_scene.h"
#include "docking_timing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAME_NS 1000000L
#define FRAME_S 1e-3

/* --- what is watched ------------------------------------------------------------------------------------------------ */

typedef struct {
    int quiet;
    double first_contact, aligned, soft_capture, rest, parted; /* times, s; negative: not yet */
    int latch_holds[LATCHES];
    double rest_since;
    double most_force, most_moment, most_stroke;
    size_t most_contacts;
    size_t incomplete; /* frames whose contacts are not all there, or came too late: pong_report.flags */
    double energy_at_start, energy_least, energy_gain, balance_error; /* J */
    double ledger_work_at_start;
} history;

static void say(const history *h, double time, const char *what, const alignment *a)
{
    if (!h->quiet) {
        printf("%8.3f s  %-26s gap %6.1f mm  lateral %5.1f mm  tilt %5.2f deg  roll %5.2f deg  closing %6.1f mm/s\n", time,
               what, a->gap * 1e3, a->lateral * 1e3, a->tilt / DEGREE, a->roll / DEGREE, a->closing * 1e3);
    }
}

/* Depth of the strikers' back faces behind the passive ring's face, and distance of their inner edges there from the
 * axis, m (models/idss_docking/build.py): where the sensor of a latch says that it holds. */
#define STRIKER_BACK 0.075
#define STRIKER_EDGE 0.528

static void watch_latch(history *h, const docking *d, int i, double time, const alignment *a)
{
    motion port = target_port(d), latch = latch_motion(d, i);
    vec3 tip = rotate_back(port.orientation, sub(latch.position, port.position));
    double radius = sqrt(tip.x * tip.x + tip.y * tip.y), travel = d->latches[i].travel;
    char text[48];
    if (h->latch_holds[i]) {
        if (tip.z > -STRIKER_BACK + 0.010 || radius < STRIKER_EDGE) {
            h->latch_holds[i] = 0;
            sprintf(text, "latch %d LOST its striker", i);
            say(h, time, text, a);
        }
    } else if (travel > -0.001 && tip.z < -STRIKER_BACK && radius > STRIKER_EDGE + 0.002) {
        h->latch_holds[i] = 1;
        sprintf(text, "latch %d snapped", i);
        say(h, time, text, a);
    }
}

static void watch_report(history *h, const contact_scene *scene)
{
    pong_report report;
    CHECK(pong_get_report(scene->world, &report));
    h->incomplete += report.flags != 0;
}

static void watch_energy(history *h, const contact_scene *scene, const docking *d)
{
    pong_ledger ledger;
    double mechanical, balance, total;
    CHECK(pong_get_ledger(scene->world, &ledger));
    mechanical = kinetic_energy(d) + spring_energy(d) - d->actuator_work;
    balance = mechanical + d->lost - d->contact_work - h->energy_at_start;
    total = mechanical + ledger.stored;
    h->balance_error = fmax(h->balance_error, fabs(balance));
    h->energy_least = fmin(h->energy_least, total);
    h->energy_gain = fmax(h->energy_gain, total - h->energy_least);
}

static void watch(history *h, docking *d, const contact_scene *scene, size_t contacts, double time)
{
    alignment a = align(d);
    int i, held = 1;

    h->most_contacts = contacts > h->most_contacts ? contacts : h->most_contacts;
    h->most_force = fmax(h->most_force, d->attenuation_force);
    h->most_moment = fmax(h->most_moment, d->attenuation_moment);
    h->most_stroke = fmax(h->most_stroke, a.stroke);
    if (h->first_contact < 0 && contacts > 0) {
        h->first_contact = time;
        say(h, time, "first contact", &a);
    }
    if (h->aligned < 0 && h->first_contact >= 0 && a.gap < 0.05 && a.lateral < 0.010 && a.tilt < DEGREE &&
        fabs(a.roll) < DEGREE) {
        h->aligned = time;
        say(h, time, "petals aligned", &a);
    }
    for (i = 0; i < LATCHES; i++) {
        watch_latch(h, d, i, time, &a);
        held = held && h->latch_holds[i];
    }
    if (held && h->soft_capture < 0) {
        h->soft_capture = time;
        d->captured = 1;
        say(h, time, "SOFT CAPTURE", &a);
    }
    if (h->soft_capture >= 0 && !held && h->rest < 0) {
        h->parted = h->parted < 0 ? time : h->parted;
    }
    if (a.drift > 1e-3 || a.turning > 0.02 * DEGREE) {
        h->rest_since = time;
    }
    if (held && h->rest < 0 && time - h->rest_since > 2.0) {
        h->rest = time;
        say(h, time, "at rest", &a);
    }
    if (h->parted < 0 && h->first_contact >= 0 && !held && contacts == 0 && a.closing < 0.0 && a.gap > 0.40) {
        h->parted = time;
        say(h, time, "PARTED", &a);
    }
    watch_energy(h, scene, d);
    watch_report(h, scene);
}

/* --- a run ---------------------------------------------------------------------------------------------------------- */

typedef struct {
    const char *models, *csv, *log;
    int fast, all_corners, rates;
    double seconds;
} options;

static void write_row(FILE *csv, double time, const docking *d, size_t contacts, double step_us)
{
    alignment a = align(d);
    fprintf(csv, "%.3f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.3f,%.3f,%.6f,%.6f,%.6f,%u,%.2f\n", time, a.gap, a.lateral,
            a.tilt / DEGREE, a.roll / DEGREE, a.stroke, a.closing, a.vehicle_tilt / DEGREE, d->attenuation_force,
            d->attenuation_moment, d->latches[0].travel, d->latches[1].travel, d->latches[2].travel, (unsigned)contacts,
            step_us);
}

static FILE *open_csv(const char *path)
{
    FILE *csv = path == NULL ? NULL : fopen(path, "w");
    if (path != NULL && csv == NULL) {
        fprintf(stderr, "cannot write %s\n", path);
        exit(2);
    }
    if (csv != NULL) {
        fprintf(csv, "time_s,gap_m,lateral_m,tilt_deg,roll_deg,stroke_m,closing_m_s,vehicle_tilt_deg,"
                     "attenuation_force_n,attenuation_moment_nm,latch0_m,latch1_m,latch2_m,contacts,step_us\n");
    }
    return csv;
}

static void open_log(contact_scene *scene, const options *o, const docking_case *c)
{
    pong_log_options log = pong_default_log_options();
    if (o->log == NULL) {
        return;
    }
    log.name = c->name;
    log.step = FRAME_S;
    log.commits_per_frame = 1;
    log.when_full = o->fast ? PONG_LOG_WAIT : PONG_LOG_DROP;
    CHECK(pong_start_log(scene->world, o->log, &log));
}

static void close_log(contact_scene *scene, const options *o, durations *logging)
{
    pong_log_report report;
    if (o->log == NULL) {
        return;
    }
    CHECK(pong_stop_log(scene->world, &report));
    printf("log:     %u frames in %s, %u lost; %.0f bytes per frame, at most %u kB waited for the disk\n",
           (unsigned)report.flushed, o->log, (unsigned)report.lost, (double)report.bytes / (double)report.flushed,
           (unsigned)(report.buffer_peak / 1000));
    print_durations("pong_log_frame", logging);
    free(logging->us);
}

static history fresh_history(const docking *d, int quiet)
{
    history h;
    memset(&h, 0, sizeof h);
    h.quiet = quiet;
    h.first_contact = h.aligned = h.soft_capture = h.rest = h.parted = -1.0;
    h.energy_at_start = h.energy_least = kinetic_energy(d) + spring_energy(d);
    return h;
}

/* Runs a case to its end: at rest, parted, or out of time. */
static history run(contact_scene *scene, docking *d, const docking_case *c, const options *o, durations *step,
                   durations *frame, size_t *misses)
{
    double gap = first_contact_gap(scene, d, c);
    long frames = (long)(o->seconds / FRAME_S + 0.5), n;
    FILE *csv = open_csv(o->csv);
    durations logging = { 0 };
    history h;
    long long release;

    if (o->log != NULL) {
        logging = make_durations((size_t)frames + 1);
    }
    open_log(scene, o, c);
    /* A new run: what the engine remembers of the last one does not count. */
    CHECK(pong_clear_contact_history(scene->world, scene->chaser));
    approach(d, c, gap + 0.002, 1);
    h = fresh_history(d, o->all_corners);
    release = now_ns();
    for (n = 0; n < frames; n++) {
        contact_wrenches contact;
        size_t contacts;
        long long start = now_ns(), stepping, stepped, end;

        send_states(scene, d);
        stepping = now_ns();
        CHECK(pong_step(scene->world));
        stepped = now_ns();
        contact = fetch_wrenches(scene);
        CHECK(pong_contact_count(scene->world, &contacts));
        if (o->log != NULL) {
            long long before = now_ns();
            CHECK(pong_log_frame(scene->world, (double)n * FRAME_S));
            note(&logging, now_ns() - before);
        }
        watch(&h, d, scene, contacts, (double)n * FRAME_S);
        docking_step(d, &contact, FRAME_S);
        end = now_ns();

        note(step, stepped - stepping);
        note(frame, end - start);
        release += FRAME_NS;
        if (o->fast) {
            *misses += end - start > FRAME_NS;
        } else {
            *misses += end > release;
            sleep_until(release);
        }
        if (csv != NULL && n % 10 == 0) {
            write_row(csv, (double)n * FRAME_S, d, contacts, (double)(stepped - stepping) * 1e-3);
        }
        if (h.rest >= 0 || h.parted >= 0) {
            break;
        }
    }
    if (csv != NULL) {
        fclose(csv);
    }
    close_log(scene, o, &logging);
    return h;
}

static const char *verdict(const history *h)
{
    if (h->parted >= 0) {
        return h->soft_capture >= 0 ? "LOST AFTER CAPTURE" : "parted";
    }
    if (h->rest >= 0) {
        return "captured, at rest";
    }
    return h->soft_capture >= 0 ? "captured, still moving" : "not captured in time";
}

static int went_well(const history *h, int locked)
{
    return locked ? h->parted >= 0 && h->soft_capture < 0 : h->rest >= 0 && h->parted < 0;
}

static int run_one(contact_scene *scene, docking *d, const docking_case *c, const options *o)
{
    durations step = make_durations((size_t)(o->seconds / FRAME_S) + 1);
    durations frame = make_durations(step.capacity);
    size_t misses = 0;
    history h;
    pong_ledger ledger;

    printf("case %s: closing %.3f m/s, lateral %.3f %.3f m, pitch %.1f, yaw %.1f, roll %.1f deg, latches %s\n", c->name,
           c->speed, c->lateral_x, c->lateral_y, c->pitch, c->yaw, c->roll, d->latches_locked ? "retracted" : "armed");
    h = run(scene, d, c, o, &step, &frame, &misses);
    CHECK(pong_get_ledger(scene->world, &ledger));
    printf("verdict: %s\n", verdict(&h));
    printf("loads:   attenuation at most %.0f N and %.0f N m, stroke %.0f mm, at most %u contacts\n", h.most_force,
           h.most_moment, h.most_stroke * 1e3, (unsigned)h.most_contacts);
    printf("energy:  %.3f J at start; now %.3f J moving and in springs; %.3f J lost in dampers, %.3f J in contact, "
           "%.3f J from actuators\n",
           h.energy_at_start, kinetic_energy(d) + spring_energy(d), d->lost, -d->contact_work, d->actuator_work);
    printf("         ledger of the engine: work %.3f J, stored %.3f J, dissipated %.3f J\n", ledger.work, ledger.stored,
           ledger.dissipated);
    printf("         account open by at most %.1e J; largest rise of the total %.1e J\n", h.balance_error, h.energy_gain);
    printf("frames:  %u of %.1f ms, %s, %u deadlines missed, %u incomplete\n", (unsigned)frame.count, FRAME_S * 1e3,
           o->fast ? "as fast as they go" : "in real time", (unsigned)misses, (unsigned)h.incomplete);
    print_durations("pong_step", &step);
    print_durations("whole frame", &frame);
    free(step.us);
    free(frame.us);
    return went_well(&h, d->latches_locked) ? 0 : 1;
}

static int run_corners(contact_scene *scene, docking *d, const options *o)
{
    durations step = make_durations((size_t)(o->seconds / FRAME_S + 1) * CORNERS);
    durations frame = make_durations(step.capacity);
    size_t misses = 0, incomplete = 0;
    int i, good = 0;

    printf("%-24s %7s %8s %8s %8s %8s %7s %7s %7s %9s  %s\n", "case", "contact", "aligned", "latched", "at rest",
           "stroke", "force", "moment", "gain", "account", "verdict");
    for (i = 0; i < CORNERS; i++) {
        docking_case c = corner(i);
        history h;
        c.lateral_rate = o->rates ? 0.04 : 0.0;
        c.turn_rate = o->rates ? 0.2 : 0.0;
        h = run(scene, d, &c, o, &step, &frame, &misses);
        good += went_well(&h, d->latches_locked);
        incomplete += h.incomplete;
        printf("%-24s %5.2f s %6.2f s %6.2f s %6.2f s %5.0f mm %5.0f N %4.0f Nm %5.0e J %7.0e J  %s\n", c.name,
               h.first_contact, h.aligned, h.soft_capture, h.rest, h.most_stroke * 1e3, h.most_force, h.most_moment,
               h.energy_gain, h.balance_error, verdict(&h));
        fflush(stdout);
    }
    printf("%d of %d as they must; %u frames incomplete\n", good, CORNERS, (unsigned)incomplete);
    printf("frames:  %u, %u longer than %.1f ms\n", (unsigned)frame.count, (unsigned)misses, FRAME_S * 1e3);
    print_durations("pong_step", &step);
    print_durations("whole frame", &frame);
    free(step.us);
    free(frame.us);
    return good == CORNERS ? 0 : 1;
}

/* --- options --------------------------------------------------------------------------------------------------------- */

static void usage(FILE *to)
{
    fprintf(to, "docking [--models FOLDER] [--fast] [--seconds S] [--csv FILE] [--log FOLDER] [--no-latches]\n"
                "        [--all-corners] [--rates] [--case NAME]\n"
                "        [--speed M/S] [--lateral X Y] [--pitch DEG] [--yaw DEG] [--roll DEG]\n"
                "cases: aligned, slow, and corners as slow,x+,roll-,pitch+ or fast,y-,roll+,yaw-\n");
}

static void refuse(const char *option, const char *why)
{
    fprintf(stderr, "%s: %s\n", option, why);
    usage(stderr);
    exit(2);
}

static double number(int argc, char **argv, int *i)
{
    const char *option = argv[*i];
    char *end;
    double value;
    if (*i + 1 >= argc) {
        refuse(option, "needs a number behind it");
    }
    value = strtod(argv[++*i], &end);
    if (end == argv[*i] || *end != '\0' || !isfinite(value)) {
        refuse(option, "needs a finite number");
    }
    return value;
}

static const char *text(int argc, char **argv, int *i)
{
    if (*i + 1 >= argc) {
        refuse(argv[*i], "needs a text behind it");
    }
    return argv[++*i];
}

static void read_options(int argc, char **argv, options *o, docking_case *c, docking *d)
{
    int i;
    memset(o, 0, sizeof *o);
    o->models = "models/idss_docking";
    o->seconds = 150.0;
    *c = make_case("aligned", 0.10);
    for (i = 1; i < argc; i++) {
        const char *a = argv[i];
        if (strcmp(a, "--models") == 0) {
            o->models = text(argc, argv, &i);
        } else if (strcmp(a, "--fast") == 0) {
            o->fast = 1;
        } else if (strcmp(a, "--seconds") == 0) {
            o->seconds = number(argc, argv, &i);
        } else if (strcmp(a, "--csv") == 0) {
            o->csv = text(argc, argv, &i);
        } else if (strcmp(a, "--log") == 0) {
            o->log = text(argc, argv, &i);
        } else if (strcmp(a, "--no-latches") == 0) {
            d->latches_locked = 1;
        } else if (strcmp(a, "--all-corners") == 0) {
            o->all_corners = 1;
        } else if (strcmp(a, "--rates") == 0) {
            o->rates = 1;
        } else if (strcmp(a, "--case") == 0) {
            if (!find_case(text(argc, argv, &i), c)) {
                refuse(argv[i], "no such case");
            }
        } else if (strcmp(a, "--speed") == 0) {
            c->speed = number(argc, argv, &i);
        } else if (strcmp(a, "--lateral") == 0) {
            c->lateral_x = number(argc, argv, &i);
            c->lateral_y = number(argc, argv, &i);
        } else if (strcmp(a, "--pitch") == 0) {
            c->pitch = number(argc, argv, &i);
        } else if (strcmp(a, "--yaw") == 0) {
            c->yaw = number(argc, argv, &i);
        } else if (strcmp(a, "--roll") == 0) {
            c->roll = number(argc, argv, &i);
        } else if (strcmp(a, "--help") == 0) {
            usage(stdout);
            exit(0);
        } else {
            refuse(a, "no such option");
        }
    }
    if (o->rates) {
        c->lateral_rate = 0.04;
        c->turn_rate = 0.2;
    }
    if (o->log != NULL && o->all_corners) {
        refuse("--log", "holds one run, not all corners");
    }
    if (!(o->seconds > 0.0 && o->seconds < 1e5)) {
        refuse("--seconds", "needs more than 0 and less than 1e5");
    }
}

int main(int argc, char **argv)
{
    docking d;
    docking_case c;
    options o;
    contact_scene scene;
    pong_config config = pong_default_config();
    int code;

    docking_defaults(&d);
    read_options(argc, argv, &o, &c, &d);
    config.keep_ledger = 1;
    open_scene(&scene, &config, o.models, &d);
    code = o.all_corners ? run_corners(&scene, &d, &o) : run_one(&scene, &d, &c, &o);
    CHECK(pong_destroy_world(scene.world));
    return code;
}
