/* A host that calls once in a frame of 50 ms and holds the wrench: a vehicle of 12 t meets a station of 420 t on a contact of
 * 1e8 N/m, which lasts 34 ms. Three runs by semi-implicit Euler for each damping:
 *
 *     fine   pong_step() every 10 us: the exact motion
 *     held   pong_step() every 50 ms, the wrench held over the frame
 *     slow   pong_step_slow() every 50 ms: follows the contact with short substeps, and keeps the rebound and the energy
 *
 *     slow_host            the table; 0 if the rebounds of slow are within 2 % of fine and it gains no energy
 */
#include <math.h>
#include <pong.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { VEHICLE, STATION, BODIES };

#define CHECK(call)                                                                                \
    do {                                                                                           \
        if ((call) != PONG_STATUS_OK) {                                                            \
            fprintf(stderr, "%s\n%s\n", #call, pong_last_message());                               \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

/* Two surfaces of 2e8 N/m in series. Origins are mass centres. */
#define HEAD "(format: \"pong-model\", version: 1, surfaces: {\"steel\": (stiffness: 2e8, " \
    "normal: Linear(damping: %g), friction: None)}, "
static const char *const models[BODIES] = {
    HEAD "name: \"vehicle\", root: (name: \"vehicle\", surface: \"steel\", "
         "primitives: [Sphere(name: \"probe\", center: (0, 0, -1.5), radius: 0.5)]))",
    HEAD "name: \"station\", root: (name: \"station\", surface: \"steel\", "
         "primitives: [Plane(name: \"face\", normal: (0, 0, 1), offset: 5)]))",
};
static const char *const names[BODIES] = { "vehicle", "station" };
static const double mass[BODIES] = { 12e3, 420e3 }, inertia[BODIES] = { 2e4, 3e7 };
static const double fine = 1e-5, frame = 0.05, duration = 2.0, speed = 0.05, stiffness = 1e8, reach = 7.0;

typedef struct {
    pong_world *world;
    pong_slow_host *slow; /* NULL in the runs without it */
    pong_interface_id group[BODIES];
    double z[BODIES], v[BODIES]; /* along the normal of the face, which is all that moves */
} scene;

typedef struct {
    double rebound; /* speed apart over speed of approach */
    double energy;  /* largest energy of motion and contact over that of the start */
    double force;   /* largest force, N */
    unsigned substeps, warnings;
} outcome;

static scene set_up(double damping, double gap, int slow)
{
    scene s = { NULL, NULL, { { 0 }, { 0 } }, { 0, 0 }, { -speed, 0 } };
    pong_config config = pong_default_config();
    int b;
    s.z[VEHICLE] = reach + gap;
    CHECK(pong_create_world(&config, &s.world));
    for (b = 0; b < BODIES; b++) {
        char text[512];
        pong_model_id model;
        pong_object_id object;
        sprintf(text, models[b], damping);
        CHECK(pong_load_model_text(s.world, text, strlen(text), names[b], NULL, &model));
        CHECK(pong_create_object(s.world, model, names[b], &object));
        CHECK(pong_find_interface(s.world, object, "", &s.group[b]));
    }
    CHECK(pong_pair_by_name(s.world, "vehicle", "station", NULL));
    CHECK(pong_seal(s.world, NULL));
    if (slow) {
        pong_slow_settings settings = pong_default_slow_settings();
        settings.theta = 1.0; /* semi-implicit Euler */
        CHECK(pong_create_slow_host(s.world, &settings, &s.slow));
    }
    return s;
}

/* The wrenches to hold over the next frame: of the contacts as they are, or of the slow host. */
static void contact(scene *s, double step, pong_wrench *wrenches)
{
    pong_slow_input inputs[BODIES];
    int b;
    memset(inputs, 0, sizeof inputs);
    for (b = 0; b < BODIES; b++) {
        pong_slow_input *input = &inputs[b];
        input->interface = s->group[b];
        input->state = pong_default_state();
        input->state.position[2] = s->z[b];
        input->state.linear_velocity[2] = s->v[b];
        input->dynamics = PONG_DYNAMICS_FREE;
        input->mass.mass = mass[b];
        input->mass.inertia[0] = input->mass.inertia[1] = input->mass.inertia[2] = inertia[b];
        /* Nothing but contact accelerates them. */
    }
    if (s->slow != NULL) {
        CHECK(pong_step_slow(s->slow, step, inputs, BODIES));
        CHECK(pong_get_slow_wrenches(s->slow, s->group, PONG_REFERENCE_FRAME_COMMON, wrenches, BODIES));
        return;
    }
    for (b = 0; b < BODIES; b++) {
        CHECK(pong_set_state(s->world, s->group[b], &inputs[b].state));
    }
    CHECK(pong_step(s->world));
    CHECK(pong_get_wrenches(s->world, s->group, PONG_REFERENCE_FRAME_COMMON, wrenches, BODIES));
}

static double energy(const scene *s)
{
    double depth = fmax(reach - (s->z[VEHICLE] - s->z[STATION]), 0.0);
    return 0.5 * (mass[0] * s->v[0] * s->v[0] + mass[1] * s->v[1] * s->v[1] + stiffness * depth * depth);
}

static outcome run(double damping, double gap, double step, int slow)
{
    scene s = set_up(damping, gap, slow);
    outcome out = { 0, 0, 0, 0, 0 };
    double start = energy(&s);
    long n, steps = (long)(duration / step + 0.5);
    int b;
    for (n = 0; n < steps; n++) {
        pong_wrench wrenches[BODIES];
        contact(&s, step, wrenches);
        for (b = 0; b < BODIES; b++) {
            s.v[b] += step * wrenches[b].force[2] / mass[b];
            s.z[b] += step * s.v[b];
        }
        out.force = fmax(out.force, wrenches[VEHICLE].force[2]);
        out.energy = fmax(out.energy, energy(&s) / start);
        if (s.slow != NULL) {
            pong_slow_report report;
            CHECK(pong_get_slow_report(s.slow, &report));
            out.substeps = report.substeps > out.substeps ? report.substeps : out.substeps;
            out.warnings |= report.warnings & ~(unsigned)PONG_SLOW_ENERGY_LIMITED;
        }
    }
    out.rebound = (s.v[VEHICLE] - s.v[STATION]) / speed;
    CHECK(pong_destroy_slow_host(s.slow));
    CHECK(pong_destroy_world(s.world));
    return out;
}

int main(void)
{
    /* Damping of each surface, N s/m: damping ratios 0, 0.1 and 0.2 of the contact. */
    static const double dampings[] = { 0.0, 4.32e5, 8.64e5 };
    double worst = 0.0, most = 0.0;
    unsigned warnings = 0;
    size_t d, phase;
    CHECK(PONG_CHECK_ABI());
    printf("%8s%8s | %8s | %8s%10s | %8s%10s%10s\n", "damping", "phase", "fine", "held", "energy", "slow", "energy",
           "substeps");
    for (d = 0; d < sizeof dampings / sizeof dampings[0]; d++) {
        for (phase = 0; phase < 4; phase++) {
            /* The touch falls a quarter of a frame later each time. */
            double gap = speed * frame * (4.0 + 0.25 * (double)phase);
            outcome exact = run(dampings[d], gap, fine, 0), held = run(dampings[d], gap, frame, 0);
            outcome slow = run(dampings[d], gap, frame, 1);
            printf("%8.0e%8.2f | %8.4f | %8.3f%10.1f | %8.4f%10.4f%10u\n", dampings[d], 0.25 * (double)phase,
                   exact.rebound, held.rebound, held.energy, slow.rebound, slow.energy, slow.substeps);
            worst = fmax(worst, fabs(slow.rebound - exact.rebound));
            most = fmax(most, slow.energy);
            warnings |= slow.warnings;
        }
    }
    printf("slow: rebound off by %.4f at most, energy at most %.5f of the start, warnings %u\n", worst, most, warnings);
    return !(worst < 0.02 && most < 1.002 && warnings == 0);
}
