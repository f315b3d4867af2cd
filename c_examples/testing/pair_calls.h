/* Calls for pairs alone: their wrenches, distance, begin and end of contact, peaks. */
#ifndef PAIR_CALLS_H
#define PAIR_CALLS_H

#include "check.h"
#include <math.h>

static inline pong_wrench slide_to(scene *s, double x)
{
    pong_wrench wrench;
    memset(&wrench, 0, sizeof wrench);
    s->states[0].position[0] = x;
    OK(pong_set_states(s->world, s->interfaces, s->states, 3));
    OK(pong_step(s->world));
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &wrench));
    return wrench;
}

/* The ball alone touches the ground: what the ground gives it is its whole wrench, and the pair's. */
static inline void pair_wrenches(scene *s)
{
    const pong_reference_frame common = PONG_REFERENCE_FRAME_COMMON, group = PONG_REFERENCE_FRAME_GROUP;
    const pong_interface_id ball = s->interfaces[0], arm = s->interfaces[1], ground = s->interfaces[2];
    pong_wrench whole, got, none;
    int i;
    memset(&none, 0, sizeof none);
    s->states[0].position[1] = 0.25;
    OK(pong_clear_contact_history(s->world, s->ball)); /* without friction from there */
    whole = slide_to(s, 0.5);
    OK(pong_get_wrench_from(s->world, ball, ground, common, &got));
    TEST(memcmp(&got, &whole, sizeof got) == 0 && got.force[2] > 9.0);
    OK(pong_get_pair_wrench(s->world, s->pair, ball, common, &got));
    TEST(memcmp(&got, &whole, sizeof got) == 0);
    OK(pong_get_wrench(s->world, ball, group, &whole));
    OK(pong_get_pair_wrench(s->world, s->pair, ball, group, &got));
    TEST(memcmp(&got, &whole, sizeof got) == 0);
    OK(pong_get_wrench_from(s->world, arm, ground, common, &got));
    TEST(memcmp(&got, &none, sizeof got) == 0);
    OK(pong_get_wrench_from(s->world, ground, ball, common, &got));
    /* On the ball about the ground's origin: the opposite of what is on the ground. */
    OK(pong_get_pair_wrench(s->world, s->pair, ground, common, &whole));
    for (i = 0; i < 3; i += 1) {
        TEST(fabs(got.force[i] + whole.force[i]) < 1e-12 && fabs(got.moment[i] + whole.moment[i]) < 1e-12);
    }
    TEST(fabs(whole.moment[0] - 0.25 * whole.force[2]) < 1e-9 && fabs(whole.moment[1] + 0.5 * whole.force[2]) < 1e-9);
    REFUSED(pong_get_wrench_from(s->world, ball, ball, common, &got), BAD_VALUE, "the same movable group");
    REFUSED(pong_get_wrench_from(s->world, ball, arm, common, &got), BAD_VALUE, "not paired");
    REFUSED(pong_get_wrench_from(s->world, ball, ground, 2, &got), BAD_VALUE, "`frame` is 2");
    REFUSED(pong_get_wrench_from(s->world, ball, ground, common, NULL), NULL_ARGUMENT, "`wrench`");
    REFUSED(pong_get_pair_wrench(s->world, s->pair, ball, -1, &got), BAD_VALUE, "`frame` is -1");
    REFUSED(pong_get_pair_wrench(s->world, s->pair, ball, common, NULL), NULL_ARGUMENT, "`wrench`");
    s->states[0].position[1] = 0.0;
    OK(pong_clear_contact_history(s->world, s->ball));
}

/* The ball above the ground, deep in it, and groups that are never tested. */
static inline void pair_distances(scene *s)
{
    const pong_interface_id ball = s->interfaces[0], arm = s->interfaces[1], ground = s->interfaces[2];
    const pong_state before = s->states[0];
    pong_distance got;
    memset(&got, 0xff, sizeof got);
    s->states[0].position[0] = 0.5;
    s->states[0].position[1] = 0.25;
    s->states[0].position[2] = 0.75;
    OK(pong_set_states(s->world, s->interfaces, s->states, 3));
    OK(pong_get_distance(s->world, ball, ground, &got));
    TEST(fabs(got.distance - 0.65) < 1e-15 && got.primitives[0] == 0 && got.primitives[1] == 0);
    TEST(got.elements[0] == 0 && got.elements[1] == 0);
    TEST(fabs(got.points[0][0] - 0.5) < 1e-15 && fabs(got.points[0][2] - 0.65) < 1e-15);
    TEST(fabs(got.points[1][1] - 0.25) < 1e-15 && fabs(got.points[1][2]) < 1e-15);
    OK(pong_get_distance(s->world, ground, ball, &got));
    TEST(fabs(got.distance - 0.65) < 1e-15 && fabs(got.points[1][2] - 0.65) < 1e-15);
    s->states[0].position[2] = 0.05;
    OK(pong_set_states(s->world, s->interfaces, s->states, 3));
    OK(pong_get_distance(s->world, ball, ground, &got));
    TEST(got.distance == 0.0);
    REFUSED(pong_get_distance(s->world, ball, ball, &got), BAD_VALUE, "the same movable group");
    REFUSED(pong_get_distance(s->world, ball, arm, &got), BAD_VALUE, "not paired");
    REFUSED(pong_get_distance(s->world, ball, ground, NULL), NULL_ARGUMENT, "`distance`");
    s->states[0] = before;
    OK(pong_set_states(s->world, s->interfaces, s->states, 3));
}

/* The ball comes up, down and stays, in windows of three frames. */
static inline void pair_monitor(scene *s)
{
    pong_contact_change change, none;
    pong_pair_peaks peaks;
    size_t count = 9;
    int i;
    memset(&peaks, 0, sizeof peaks);
    memset(&change, 0, sizeof change);
    none = change;
    REFUSED(pong_observe_pairs(s->world, 1e-3), WRONG_PHASE, "pong_start_pair_monitor()");
    REFUSED(pong_get_contact_changes(s->world, &change, 1, &count), WRONG_PHASE, "pong_start_pair_monitor()");
    REFUSED(pong_get_pair_peaks(s->world, &peaks, 1, &count), WRONG_PHASE, "pong_start_pair_monitor()");
    REFUSED(pong_begin_peak_window(s->world), WRONG_PHASE, "pong_start_pair_monitor()");
    OK(pong_start_pair_monitor(s->world));
    for (i = 0; i < 6; i += 1) {
        s->states[0].position[2] = i % 3 == 1 ? 0.101 : (i == 5 ? 0.097 : 0.099);
        OK(pong_clear_contact_history(s->world, s->ball)); /* ends no contact */
        slide_to(s, 0.0);
        OK(pong_observe_pairs(s->world, i % 3 == 2 ? 2e-3 : 1e-3));
        change = none;
        OK(pong_get_contact_changes(s->world, &change, 1, &count));
        TEST(count == (i == 3 ? 0u : 1u));
        if (count == 1) {
            TEST(change.pair.bits == s->pair.bits && change.begins == (i % 3 == 1 ? 0 : 1) && change.reserved == 0);
            TEST(change.interfaces[0].bits == s->interfaces[0].bits && change.interfaces[1].bits == s->interfaces[2].bits);
            REFUSED(pong_get_contact_changes(s->world, NULL, 0, &count), BUFFER_TOO_SMALL, "there are 1");
            TEST(count == 1);
        }
        REFUSED(pong_observe_pairs(s->world, 1e-3), WRONG_PHASE, "once after each commit");
        if (i % 3 == 2) {
            OK(pong_get_pair_peaks(s->world, &peaks, 1, &count));
            TEST(count == 1 && peaks.pair.bits == s->pair.bits && peaks.touches == 1 && peaks.ends == 1);
            TEST(peaks.begins == (i == 2 ? 2u : 1u) && fabs(peaks.window - 4e-3) < 1e-15);
            TEST(fabs(peaks.contact_time - 3e-3) < 1e-15);
            TEST(fabs(peaks.peak_normal_force - (i == 2 ? 10.0 : 30.0)) < 1e-9);
            TEST(fabs(peaks.mean.force[2] - (i == 2 ? 7.5 : 17.5)) < 1e-9);
            REFUSED(pong_get_pair_peaks(s->world, NULL, 0, &count), BUFFER_TOO_SMALL, "there are 1");
            OK(pong_begin_peak_window(s->world));
            OK(pong_get_pair_peaks(s->world, NULL, 0, &count));
            TEST(count == 0);
        }
    }
    REFUSED(pong_observe_pairs(s->world, 0.0), BAD_VALUE, "the step is 0 s");
    /* Anew: what touches begins. */
    OK(pong_start_pair_monitor(s->world));
    s->states[0].position[2] = 0.099;
    OK(pong_clear_contact_history(s->world, s->ball));
    slide_to(s, 0.0);
    OK(pong_observe_pairs(s->world, 1e-3));
    OK(pong_get_contact_changes(s->world, &change, 1, &count));
    TEST(count == 1 && change.begins == 1);
}

#endif
