/* Set-up of a sealed world, whose movable groups are MuJoCo bodies, from a configuration. */
#ifndef PONG_CONTACT_SETUP_H
#define PONG_CONTACT_SETUP_H

#include "config.h"

#include <pong.h>

typedef struct contact_world {
    pong_world *world;
    size_t group_count;
    pong_interface_id *interfaces; /* in the order of `objects`, and of pong_list_interfaces() in each */
    char **names;                  /* of the groups: `chaser`, `chaser/ring` */
    int *bodies;                   /* MuJoCo body of each group; all -1 before bind_bodies() */
    uint32_t substeps_max;         /* of a step with copies; 0 without them */
    size_t state_size;             /* largest state between steps, bytes; 0 before the seal */
} contact_world;

/* Creates the world with its models, Objects and pairs. Returns 1, or 0 with a message; call close_world() in
 * either case. */
int open_world(contact_world *w, const contact_config *config, message *why);

/* Finds the MuJoCo body of each movable group. */
int bind_bodies(contact_world *w, const contact_config *config, const mjModel *m, message *why);

/* Refuses a pair of Objects whose models and bodies equal those of another pair, of this instance or of one
 * before it: its force would act twice. */
int refuse_double_pairs(const contact_world *w, const contact_config *config, const mjModel *m, int instance, message *why);

/* Gives the world the masses of the bodies and the step, so that its seal warns of contacts for which the
 * step is too long. */
int plan_step(contact_world *w, const mjModel *m, message *why);

/* Seals the world. Reports the warnings of the seal through MuJoCo if `instance_name` is not NULL. */
int seal_world(contact_world *w, const contact_config *config, const char *instance_name, message *why);

void close_world(contact_world *w);

#endif
