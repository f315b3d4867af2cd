/* A docking, as the author of a simulation executive would write it.
 *
 * The executive owns the dynamics (docking_dynamics.c) and the clock. The contact engine owns the contacts. Once a
 * frame the two meet: states in, step, wrenches out.
 *
 *     docking                          one docking in real time, 1 kHz
 *     docking --fast                   the same, as fast as it goes
 *     docking --fast --all-corners     every corner of the standard's box of misalignments, as a table
 *     docking --fast --no-latches      the latches stay retracted: the vehicles must part again
 *
 * Exit code: 0 if it went as it must (captured; parted with --no-latches), 1 if not, 2 for a wrong option, 3 if the
 * engine refused a call.
 */
#define _POSIX_C_SOURCE 200112L

#include "docking_dynamics.h"
#include "pong.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define FRAME_NS 1000000L
#define FRAME_S 1e-3

/* --- the engine's side -------------------------------------------------------------------------------------------- */

static void check(pong_status status, const char *call)
{
    if (status != PONG_STATUS_OK) {
        fprintf(stderr, "%s: %s: %s\n", call, pong_status_name(status), pong_last_message());
        exit(3);
    }
}

#define CHECK(call) check((call), #call)

enum { VEHICLE, RING, FIRST_LATCH, TARGET = FIRST_LATCH + LATCHES, PARTS };

typedef struct {
    pong_world *world;
    pong_object_id chaser, target;
    pong_interface_id parts[PARTS]; /* where states go in and wrenches come out */
} contact_scene;

static pong_object_id add_object(pong_world *world, const char *folder, const char *file, const char *name)
{
    char path[1024];
    pong_model_id model;
    pong_object_id object;
    if (snprintf(path, sizeof path, "%s/%s", folder, file) >= (int)sizeof path) {
        fprintf(stderr, "the path of the models is too long\n");
        exit(2);
    }
    CHECK(pong_load_model(world, path, &model));
    CHECK(pong_create_object(world, model, name, &object));
    return object;
}

static vec3 from_array(const double a[3]) { return v3(a[0], a[1], a[2]); }

/* Where the model's author put the latches, in the ring's frame. */
static void place_latches(contact_scene *scene, docking *d)
{
    pong_state ring, latch;
    int i;
    CHECK(pong_get_authored_state(scene->world, scene->parts[RING], &ring));
    d->ring_extension = ring.position[2];
    for (i = 0; i < LATCHES; i++) {
        quat turn;
        CHECK(pong_get_authored_state(scene->world, scene->parts[FIRST_LATCH + i], &latch));
        turn.w = latch.orientation[0];
        turn.x = latch.orientation[1];
        turn.y = latch.orientation[2];
        turn.z = latch.orientation[3];
        place_latch(d, i, sub(from_array(latch.position), from_array(ring.position)), turn);
    }
}

static void open_scene(contact_scene *scene, const char *models, docking *d)
{
    pong_config config = pong_default_config();
    pong_seal_report sealed;
    int i;

    CHECK(PONG_CHECK_ABI());
    config.keep_ledger = 1;
    CHECK(pong_create_world(&config, &scene->world));
    scene->chaser = add_object(scene->world, models, "idss_active.ron", "chaser");
    scene->target = add_object(scene->world, models, "idss_passive.ron", "target");
    CHECK(pong_pair_objects(scene->world, scene->chaser, scene->target, NULL));
    CHECK(pong_find_interface(scene->world, scene->chaser, "", &scene->parts[VEHICLE]));
    CHECK(pong_find_interface(scene->world, scene->chaser, "ring", &scene->parts[RING]));
    for (i = 0; i < LATCHES; i++) {
        char name[16];
        sprintf(name, "latch_%d", i);
        CHECK(pong_find_interface(scene->world, scene->chaser, name, &scene->parts[FIRST_LATCH + i]));
    }
    CHECK(pong_find_interface(scene->world, scene->target, "", &scene->parts[TARGET]));
    CHECK(pong_seal(scene->world, &sealed));
    place_latches(scene, d);
    printf("pong %s: %u pairs of movable groups, room for %u contacts\n", pong_version_string(),
           (unsigned)sealed.group_pairs, (unsigned)sealed.contact_capacity);
}

static pong_state to_state(motion m)
{
    pong_state s = pong_default_state();
    s.position[0] = m.position.x, s.position[1] = m.position.y, s.position[2] = m.position.z;
    s.orientation[0] = m.orientation.w, s.orientation[1] = m.orientation.x;
    s.orientation[2] = m.orientation.y, s.orientation[3] = m.orientation.z;
    s.linear_velocity[0] = m.velocity.x, s.linear_velocity[1] = m.velocity.y, s.linear_velocity[2] = m.velocity.z;
    s.angular_velocity[0] = m.rate.x, s.angular_velocity[1] = m.rate.y, s.angular_velocity[2] = m.rate.z;
    return s;
}

static void send_states(contact_scene *scene, const docking *d)
{
    pong_state states[PARTS];
    int i;
    states[VEHICLE] = to_state(chaser_port(d));
    states[RING] = to_state(d->ring);
    for (i = 0; i < LATCHES; i++) {
        states[FIRST_LATCH + i] = to_state(latch_motion(d, i));
    }
    states[TARGET] = to_state(target_port(d));
    CHECK(pong_set_states(scene->world, scene->parts, states, PARTS));
}

static wrench from_wrench(const pong_wrench *w)
{
    wrench out;
    out.force = from_array(w->force);
    out.moment = from_array(w->moment);
    return out;
}

static contact_wrenches fetch_wrenches(contact_scene *scene)
{
    pong_wrench wrenches[PARTS];
    contact_wrenches out;
    int i;
    CHECK(pong_get_wrenches(scene->world, scene->parts, PONG_FRAME_COMMON, wrenches, PARTS));
    out.vehicle = from_wrench(&wrenches[VEHICLE]);
    out.ring = from_wrench(&wrenches[RING]);
    for (i = 0; i < LATCHES; i++) {
        out.latch[i] = from_wrench(&wrenches[FIRST_LATCH + i]);
    }
    out.target = from_wrench(&wrenches[TARGET]);
    return out;
}

/* --- cases --------------------------------------------------------------------------------------------------------- */

/* Misalignment and rates of the ring at first contact. */
typedef struct {
    char name[48];
    double speed;            /* closing, m/s */
    double lateral_x, lateral_y, roll, pitch, yaw; /* m and degrees */
    double lateral_rate;     /* away from the axis, m/s */
    double turn_rate;        /* about the same axes as the misalignment and away from alignment, degrees/s */
} docking_case;

static docking_case make_case(const char *name, double speed)
{
    docking_case c;
    memset(&c, 0, sizeof c);
    snprintf(c.name, sizeof c.name, "%s", name);
    c.speed = speed;
    return c;
}

enum { CORNERS = 64 };

/* Corners of the standard's box: 2 closing speeds, 4 directions of the lateral 0.10 m, 2 senses of the roll of 4
 * degrees, 4 directions of the tilt of 4 degrees. */
static docking_case corner(int index)
{
    static const double side[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    static const char *const lateral[4] = {"x+", "x-", "y+", "y-"};
    static const char *const tilt[4] = {"pitch+", "pitch-", "yaw+", "yaw-"};
    int fast = index / 32, l = index / 8 % 4, roll = index / 4 % 2, t = index % 4;
    docking_case c = make_case("", fast ? 0.10 : 0.05);
    snprintf(c.name, sizeof c.name, "%s,%s,roll%s,%s", fast ? "fast" : "slow", lateral[l], roll ? "-" : "+", tilt[t]);
    c.lateral_x = 0.10 * side[l][0];
    c.lateral_y = 0.10 * side[l][1];
    c.roll = roll ? -4.0 : 4.0;
    c.pitch = 4.0 * side[t][0];
    c.yaw = 4.0 * side[t][1];
    return c;
}

static int find_case(const char *name, docking_case *c)
{
    int i;
    if (strcmp(name, "aligned") == 0 || strcmp(name, "slow") == 0) {
        *c = make_case(name, name[0] == 'a' ? 0.10 : 0.05);
        return 1;
    }
    for (i = 0; i < CORNERS; i++) {
        *c = corner(i);
        if (strcmp(c->name, name) == 0) {
            return 1;
        }
    }
    return 0;
}

/* The chaser on its line of approach, with the two ring faces `gap` apart. */
static void approach(docking *d, const docking_case *c, double gap, int moving)
{
    vec3 aside = v3(c->lateral_x, c->lateral_y, 0.0);
    vec3 tilt = scale(v3(c->pitch, c->yaw, c->roll), DEGREE);
    vec3 velocity = v3(0, 0, 0), rate = v3(0, 0, 0);
    if (moving) {
        vec3 sense = v3((c->pitch > 0) - (c->pitch < 0), (c->yaw > 0) - (c->yaw < 0), (c->roll > 0) - (c->roll < 0));
        rate = scale(sense, c->turn_rate * DEGREE);
        velocity = v3(0.0, 0.0, c->speed);
        if (norm(aside) > 0.0) {
            velocity = add(velocity, scale(aside, c->lateral_rate / norm(aside)));
        }
    }
    place_chaser(d, add(aside, v3(0.0, 0.0, -gap)), tilt, velocity, rate);
}

static size_t contacts_at(contact_scene *scene, docking *d, const docking_case *c, double gap)
{
    size_t count;
    approach(d, c, gap, 0);
    send_states(scene, d);
    CHECK(pong_evaluate(scene->world));
    CHECK(pong_contact_count(scene->world, &count));
    return count;
}

/* The gap at which the case's first contact comes: evaluating leaves no trace in the engine, so it may be asked. */
static double first_contact_gap(contact_scene *scene, docking *d, const docking_case *c)
{
    double near_ = 0.45, far_ = 0.45;
    int i;
    while (near_ > -0.05 && contacts_at(scene, d, c, near_) == 0) {
        far_ = near_;
        near_ -= 0.004;
    }
    for (i = 0; i < 12; i++) {
        double middle = 0.5 * (near_ + far_);
        if (contacts_at(scene, d, c, middle) == 0) {
            far_ = middle;
        } else {
            near_ = middle;
        }
    }
    return far_;
}

/* --- the clock ------------------------------------------------------------------------------------------------------ */

static long long now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (long long)t.tv_sec * 1000000000LL + t.tv_nsec;
}

static void sleep_until(long long ns)
{
    struct timespec t;
    t.tv_sec = (time_t)(ns / 1000000000LL);
    t.tv_nsec = (long)(ns % 1000000000LL);
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, NULL) == EINTR) {
    }
}

/* Durations, kept until the end: nothing is allocated while frames run. */
typedef struct {
    float *us;
    size_t count, capacity;
} durations;

static durations make_durations(size_t capacity)
{
    durations d;
    d.us = malloc(capacity * sizeof *d.us);
    d.count = 0;
    d.capacity = capacity;
    if (d.us == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(3);
    }
    /* Touch the pages now, not in a frame. */
    memset(d.us, 0, capacity * sizeof *d.us);
    return d;
}

static void note(durations *d, long long ns)
{
    if (d->count < d->capacity) {
        d->us[d->count++] = (float)ns * 1e-3f;
    }
}

static int by_size(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static void print_durations(const char *what, durations *d)
{
    size_t n = d->count;
    if (n == 0) {
        return;
    }
    qsort(d->us, n, sizeof *d->us, by_size);
    printf("  %-12s p50 %7.1f   p90 %7.1f   p99 %7.1f   p99.9 %7.1f   max %8.1f us\n", what, d->us[n / 2],
           d->us[n - 1 - (n - 1) / 10], d->us[n - 1 - (n - 1) / 100], d->us[n - 1 - (n - 1) / 1000], d->us[n - 1]);
}

/* --- what is watched ------------------------------------------------------------------------------------------------ */

typedef struct {
    int quiet;
    double first_contact, aligned, soft_capture, rest, parted; /* times, s; negative: not yet */
    int latch_holds[LATCHES];
    double rest_since;
    double most_force, most_moment, most_stroke;
    size_t most_contacts;
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
    char text[32];
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
}

/* --- a run ---------------------------------------------------------------------------------------------------------- */

typedef struct {
    const char *models, *csv;
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
    history h;
    long long release;

    /* A new run: what the engine remembers of the last one does not count. */
    CHECK(pong_forget_object(scene->world, scene->chaser));
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
    printf("frames:  %u of %.1f ms, %s, %u deadlines missed\n", (unsigned)frame.count, FRAME_S * 1e3,
           o->fast ? "as fast as they go" : "in real time", (unsigned)misses);
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
    size_t misses = 0;
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
        printf("%-24s %5.2f s %6.2f s %6.2f s %6.2f s %5.0f mm %5.0f N %4.0f Nm %5.0e J %7.0e J  %s\n", c.name,
               h.first_contact, h.aligned, h.soft_capture, h.rest, h.most_stroke * 1e3, h.most_force, h.most_moment,
               h.energy_gain, h.balance_error, verdict(&h));
        fflush(stdout);
    }
    printf("%d of %d as they must\n", good, CORNERS);
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
    fprintf(to, "docking [--models FOLDER] [--fast] [--seconds S] [--csv FILE] [--no-latches]\n"
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
    int code;

    docking_defaults(&d);
    read_options(argc, argv, &o, &c, &d);
    open_scene(&scene, o.models, &d);
    code = o.all_corners ? run_corners(&scene, &d, &o) : run_one(&scene, &d, &c, &o);
    CHECK(pong_destroy_world(scene.world));
    return code;
}
