/* Long steps: the wrench of a step follows the contacts in substeps on copies of the bodies (docs/slow_hosts.md). */
#ifndef PONG_CONTACT_SLOW_H
#define PONG_CONTACT_SLOW_H

#include "setup.h"

/* Copies of the bodies of an mjData, and what MuJoCo does with them without contact. */
typedef struct slow_copies {
    pong_slow_host *host;
    mjData *scratch;         /* steps without contact */
    pong_slow_input *inputs; /* one for each movable group */
    mjtNum *inertia;         /* nv x nv: effective inertia of a step, factored */
    mjtNum *springs;         /* 3 x nv x nv: inertia of the constraints that act, damping times the step, a product */
    mjtNum *roots;           /* 6 x nv for each group: its Jacobian times the inverse root of the inertia */
    pong_slow_coupling *couplings; /* of groups that joints connect */
    pong_wrench *wrenches;   /* one for each movable group */
    mjtNum *pushes;          /* 2 x nv: generalised force of these wrenches, and what it accelerates */
    mjtNum *rounds;          /* 4 x nv: acceleration without contact and its error, of this round and of the one before */
} slow_copies;

/* Refuses integrators for which the copies do not know how poses move. */
int refuse_integrator(const mjModel *m, message *why);

/* Creates the copies, if the instance has the key `substeps_max`; `w` is sealed. Returns 1, or 0 with a message; call
 * close_slow() in either case. */
int open_slow(slow_copies *copies, const contact_world *w, const mjModel *m, message *why);

void close_slow(slow_copies *copies);

/* True while open_slow() makes scratch data: their instances have no contact. */
int is_making_scratch(void);

/* Largest state of the slow host of a sealed world, bytes. Returns 1, or 0 with a message. */
int measure_slow(size_t *size, const contact_world *w, message *why);

/* Computes the wrenches to hold over the step that begins with the positions, velocities and forces of `d`. */
pong_status evaluate_slow(slow_copies *copies, const contact_world *w, const mjModel *m, const mjData *d,
                          const pong_state *states);

#endif
