/* Compliance of a body on the joints of its tree, at any pose, for the check of the time step.
 *
 * Compliance: 6x6, by rows, acceleration (linear of the body's origin, then angular) per wrench (force, then moment about the
 * origin), along the body's axes. It is a bound at every pose of the mechanism, in the sense of positive semidefinite matrices:
 *
 * - What hangs below a body, and other branches above it, are left out. They can only make it heavier.
 * - A joint lets the body above turn or slide against this one. Its compliance is replaced by one that is no less at any angle
 *   or travel and is known at all of them: about a hinge the sum of four quarter turns (their sum is that of all turns, whose
 *   terms are of first and second order in the angle, and it holds the first), at a ball joint the trace, along a slide the sum
 *   of both ends of its range (the form is convex in the travel).
 * - Where no such bound is at hand, the joint is left out: a body that is free yields more. */
#ifndef PONG_CONTACT_JOINTS_H
#define PONG_CONTACT_JOINTS_H

#include <mujoco/mujoco.h>
#include <pong.h>

/* Mass, mass centre and inertia of a body with all bodies welded to it, in the body's frame; infinite mass if
 * it does not yield. */
pong_mass mass_of(const mjModel *m, int body);

/* True if a body moves by other joints than its own free one. */
int is_on_joints(const mjModel *m, int body);

/* Compliance and mechanism of a body on joints, without springs. */
pong_joints joints_of(const mjModel *m, int body);

/* Adds bounds of the joint springs and dampers of a body's tree that the integrator evaluates explicitly, by the inverse
 * inertia of joints at the reference pose. */
void add_springs(pong_joints *joints, const mjModel *m, int body);

#endif
