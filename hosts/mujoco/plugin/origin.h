/* One sealed world for all mjData of an mjModel and instance: theirs are its clones. */
#ifndef PONG_CONTACT_ORIGIN_H
#define PONG_CONTACT_ORIGIN_H

#include "setup.h"

typedef struct contact_origin contact_origin;

/* The world of an instance of an mjModel: models, bodies and what the seal found. Nobody evaluates it. Built if there is none for
 * this mjModel as it is now. Answers NULL with a message. */
contact_origin *take_origin(const mjModel *m, int instance, message *why);

/* A clone, which is the caller's, and what it shares with its origin; answers 1, or 0 with a message. Destroy the clone with
 * pong_destroy_world() before the origin is given back. */
int clone_origin(contact_origin *origin, contact_world *w, message *why);

/* The last one that gives it back destroys it. */
void give_back_origin(contact_origin *origin);

/* An mjModel is being compiled at this address: what was built for another that was there is no longer taken. */
void forget_origins(const mjModel *m);

#endif
