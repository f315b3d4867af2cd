/* Calls of a slow host, for calls.c. */
#ifndef SLOW_CALLS_H
#define SLOW_CALLS_H

#include "check.h"
#include <math.h>

/* Ball and arm as one rigid body that can only rise: an impulse on one lifts both. */
static inline void slow_couplings(scene *s, pong_slow_host *host, pong_slow_input inputs[3])
{
    pong_slow_coupling coupling;
    pong_wrench wrenches[2];
    int i;
    memset(&coupling, 0, sizeof coupling);
    coupling.of = s->interfaces[0];
    coupling.by = s->interfaces[0];
    REFUSED(pong_set_slow_couplings(host, &coupling, 1), BAD_VALUE, "it is one group");
    coupling.by = s->interfaces[2];
    OK(pong_set_slow_couplings(host, &coupling, 1));
    REFUSED(pong_evaluate_slow(host, 0.02, inputs, 3), BAD_VALUE, "is not in joints");
    coupling.by = s->interfaces[1];
    coupling.mobility[14] = 0.5;
    OK(pong_set_slow_couplings(host, &coupling, 1));
    for (i = 0; i < 2; i += 1) {
        inputs[i].dynamics = PONG_DYNAMICS_JOINTED;
        memset(inputs[i].mobility, 0, sizeof inputs[i].mobility);
        inputs[i].mobility[14] = 0.5;
        inputs[i].linear_acceleration[2] = -9.81;
        inputs[i].state.linear_velocity[2] = 0.0;
    }
    /* The ball rests under the weight of both. */
    inputs[0].state.position[2] = 0.1 - 2.0 * 9.81 / 1e4;
    OK(pong_step_slow(host, 0.02, inputs, 3));
    OK(pong_get_slow_wrenches(host, s->interfaces, PONG_REFERENCE_FRAME_GROUP, wrenches, 2));
    TEST(fabs(wrenches[0].force[2] - 2.0 * 9.81) < 1e-6 && wrenches[1].force[2] == 0.0);
    OK(pong_set_slow_couplings(host, NULL, 0));
}

/* The ball dropped from 1 mm in frames of 20 ms: it bounces by the law of its contact, whatever the world does
 * meanwhile; saved and restored before the touch, it has the same wrench. */
static inline void slow_host(scene *s)
{
    pong_slow_settings settings = pong_default_slow_settings();
    pong_slow_host *host;
    pong_slow_input inputs[3];
    pong_slow_report report;
    pong_slow_difference differences[3];
    pong_wrench wrench, before = { { 0, 0, 0 }, { 0, 0, 0 } };
    unsigned char saved[65536];
    size_t size = 0, count = 0;
    double fastest = 0.0, peak = 0.0;
    int i, frame, again;
    memset(inputs, 0, sizeof inputs);
    OK(pong_create_slow_host(s->world, &settings, &host));
    for (i = 0; i < 3; i += 1) {
        inputs[i].interface = s->interfaces[i];
        inputs[i].state = s->states[i];
        inputs[i].dynamics = PONG_DYNAMICS_PRESCRIBED;
    }
    inputs[0].dynamics = PONG_DYNAMICS_FREE;
    inputs[0].mass.mass = 1.0;
    inputs[0].mass.inertia[0] = inputs[0].mass.inertia[1] = inputs[0].mass.inertia[2] = 4e-3;
    inputs[0].linear_acceleration[2] = -9.81;
    inputs[0].state.position[2] = 0.101;
    inputs[1].state.position[2] = 10.0; /* the arm is out of reach */
    for (frame = 0; frame < 20; frame += 1) {
        double *z = &inputs[0].state.position[2], *v = &inputs[0].state.linear_velocity[2];
        /* Frame 2 twice: thrown away, restored, and once more. */
        for (again = frame == 2 ? 2 : 1; again > 0; again -= 1) {
            if (again == 2) {
                OK(pong_save_slow_state(host, saved, sizeof saved, &size));
                OK(pong_evaluate_slow(host, 0.02, inputs, 3));
                OK(pong_commit_slow(host));
                OK(pong_get_slow_wrenches(host, s->interfaces, PONG_REFERENCE_FRAME_COMMON, &before, 1));
                OK(pong_restore_slow_state(host, saved, size));
                continue;
            }
            OK(pong_step_slow(host, 0.02, inputs, 3));
        }
        OK(pong_get_slow_wrenches(host, s->interfaces, PONG_REFERENCE_FRAME_COMMON, &wrench, 1));
        TEST(frame != 2 || memcmp(&wrench, &before, sizeof wrench) == 0);
        OK(pong_get_slow_report(host, &report));
        TEST(report.groups == 3 && report.contacts <= 1 && report.substeps >= 8 && report.warnings % PONG_SLOW_ENERGY_LIMITED == 0);
        TEST(frame == 0 || fabs(report.theta_measured - 1.0) < 1e-6);
        OK(pong_get_slow_differences(host, differences, 3, &count));
        TEST(count == 3 && differences[0].interface.bits == s->interfaces[0].bits);
        TEST(fabs(differences[0].position[2]) < 1e-12 && fabs(differences[0].inserted) < 1e-9);
        *v += 0.02 * (wrench.force[2] - 9.81);
        *z += 0.02 * *v;
        fastest = *v > fastest ? *v : fastest;
        peak = wrench.force[2] > peak ? wrench.force[2] : peak;
    }
    TEST(peak > 9.81 && peak < 30.0 && fastest < 0.14);
    TEST(fabs(wrench.force[2] - 9.81) < 1.0 && fabs(inputs[0].state.position[2] - 0.099) < 5e-4);
    slow_couplings(s, host, inputs);
    OK(pong_destroy_slow_host(host));
}

#endif
