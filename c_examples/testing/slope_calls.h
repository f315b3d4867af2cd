/* Derivatives of wrenches by poses, twists and the numbers of a surface; incremental potentials. */
#ifndef SLOPE_CALLS_H
#define SLOPE_CALLS_H

#include "pair_calls.h"
#include <math.h>

/* A ball of 10 kN/m on a plane, 1 mm deep: the potential of a long step without motion is that of a spring, and the derivative of
 * the force by the stiffness has its sign. */
static inline void slope_calls(scene *s)
{
    pong_potential potential;
    pong_surface_slope slope;
    pong_wrench wrench;
    pong_surface_values values;
    const char *surface;
    size_t count = 7;
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &wrench));
    OK(pong_get_incremental_potentials(s->world, 1e6, &potential, 1, &count));
    TEST(count == 1 && potential.interfaces[1].bits == s->interfaces[2].bits);
    TEST(fabs(potential.energy - 0.5 * 1e4 * 1e-6) < 1e-4 * potential.energy);
    TEST(fabs(potential.wrenches[0].force[2] - 1e4 * 1e-3) < 1e-6 && potential.stiffness[0][0][14] > 0.0);
    REFUSED(pong_get_incremental_potentials(s->world, 0.0, &potential, 1, &count), BAD_VALUE, "positive");
    REFUSED(pong_get_incremental_potentials(s->world, 1e-2, &potential, 0, &count), BUFFER_TOO_SMALL, "potentials");
    OK(pong_surface_name(s->world, s->ball_model, 0, &surface));
    OK(pong_get_surface(s->world, s->ball_model, surface, &values));
    OK(pong_get_surface_slopes(s->world, s->ball_model, surface, "stiffness", &slope, 1, &count));
    TEST(count == 1 && slope.interfaces[0].bits == s->interfaces[0].bits && slope.wrenches[0].force[2] > 0.0);
    TEST(slope.wrenches[0].force[2] * values.stiffness <= wrench.force[2] * (1.0 + 1e-6));
    TEST(slope.wrenches[0].force[2] == -slope.wrenches[1].force[2]);
    REFUSED(pong_get_surface_slopes(s->world, s->ball_model, surface, "colour", &slope, 1, &count), UNKNOWN_NAME, "stiffness");
    REFUSED(pong_get_surface_slopes(s->world, s->ball_model, "x", "stiffness", &slope, 1, &count), UNKNOWN_NAME, "surface");
}

/* A ball of 10 kN/m on a plane: up against up on both groups, and the same by differences. */
static inline void tangents(scene *s)
{
    pong_tangent tangent, complete, differences;
    pong_wrench before = slide_to(s, 0.0), after;
    size_t count = 7, k;
    REFUSED(pong_get_tangents(s->world, &tangent, 1, &count), WRONG_PHASE, "before it is committed");
    REFUSED(pong_get_tangents_by_differences(s->world, &tangent, 1, &count), WRONG_PHASE, "before it is committed");
    REFUSED(pong_get_complete_tangents(s->world, &complete, 1, &count), WRONG_PHASE, "before it is committed");
    OK(pong_evaluate(s->world));
    OK(pong_get_tangents(s->world, &tangent, 1, &count));
    TEST(count == 1 && tangent.interfaces[0].bits == s->interfaces[0].bits);
    TEST(tangent.interfaces[1].bits == s->interfaces[2].bits);
    for (k = 0; k < 4; k += 1) {
        TEST(fabs(tangent.stiffness[k / 2][k % 2][6 * 2 + 2] - (k / 2 == k % 2 ? 1e4 : -1e4)) < 1e-6);
    }
    REFUSED(pong_get_complete_tangents(s->world, &complete, 0, &count), BUFFER_TOO_SMALL, "there are 1");
    OK(pong_get_complete_tangents(s->world, &complete, 1, &count));
    TEST(count == 1 && memcmp(&complete, &tangent, sizeof complete) == 0);
    OK(pong_get_tangents_by_differences(s->world, &differences, 1, &count));
    for (k = 0; k < 144; k += 1) {
        size_t i = k / 72, j = k / 36 % 2, at = k % 36;
        TEST(fabs(tangent.stiffness[i][j][at] - differences.stiffness[i][j][at]) < 1.0);
        TEST(fabs(tangent.damping[i][j][at] - differences.damping[i][j][at]) < 1e-3);
    }
    slope_calls(s);
    OK(pong_commit(s->world));
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &after));
    TEST(memcmp(&before.force[2], &after.force[2], sizeof after.force[2]) == 0);
}

#endif
