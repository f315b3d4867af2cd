/* Kinematics of the positions and velocities just accepted by a step, while the rest of mjData stays as the
 * step left it. */
#ifndef PONG_CONTACT_KINEMATICS_H
#define PONG_CONTACT_KINEMATICS_H

#include <mujoco/mujoco.h>

/* At the end of a step qpos and qvel are new, and all quantities derived from them are those of the step's
 * beginning. MuJoCo's own functions between two steps rely on that (mjd_transitionFD would be wrong), so
 * restore_kinematics() restores the derived quantities. The two calls are paired on the stack of mjData. */
typedef struct saved_kinematics {
    mjtNum *copy;
} saved_kinematics;

saved_kinematics update_kinematics(const mjModel *m, mjData *d);
void restore_kinematics(const mjModel *m, mjData *d, saved_kinematics saved);

#endif
