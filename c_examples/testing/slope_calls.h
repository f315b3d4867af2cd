/* Incremental potentials, and derivatives of wrenches by the numbers of a surface. */
#ifndef SLOPE_CALLS_H
#define SLOPE_CALLS_H

#include "crowd.h"
#include <math.h>

/* A ball of 10 kN/m on a plane, 1 mm deep: the potential of a step without motion is that of a spring, and the derivative of
 * the force by the stiffness has its sign. */
static void slope_calls(scene *s)
{
    pong_potential potential;
    pong_surface_slope slope;
    pong_wrench wrench;
    pong_surface_values values;
    const char *surface;
    size_t count = 7;
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &wrench));
    OK(pong_get_incremental_potentials(s->world, 1e-2, &potential, 1, &count));
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

#endif
