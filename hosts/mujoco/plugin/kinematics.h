/* Kinematics of the positions and velocities that a step has just accepted, while the rest of mjData stays as the step left it. */
#ifndef PONG_CONTACT_KINEMATICS_H
#define PONG_CONTACT_KINEMATICS_H

#include <mujoco/mujoco.h>

/* At the end of a step qpos and qvel are new, and everything that follows from them is that of the step's beginning. MuJoCo's own
 * functions between two steps count on that (mjd_transitionFD would be wrong), so what is computed here is put back by
 * restore_kinematics(). The two are a bracket on the stack of mjData. */
typedef struct saved_kinematics {
    mjtNum *copy;
} saved_kinematics;

saved_kinematics update_kinematics(const mjModel *m, mjData *d);
void restore_kinematics(const mjModel *m, mjData *d, saved_kinematics saved);

#endif
