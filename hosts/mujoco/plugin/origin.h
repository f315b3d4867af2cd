/* One sealed world for an mjModel and instance, cloned for each mjData. */
#ifndef PONG_CONTACT_ORIGIN_H
#define PONG_CONTACT_ORIGIN_H

#include "setup.h"

typedef struct contact_origin contact_origin;

/* World of an instance of an mjModel: models, bodies and the report of the seal. It is never evaluated. Built
 * if there is none for the present state of this mjModel. Returns NULL with a message. */
contact_origin *take_origin(const mjModel *m, int instance, message *why);

/* Creates a clone, owned by the caller, which shares data with its origin; returns 1, or 0 with a message.
 * Destroy the clone with pong_destroy_world() before the origin is given back. */
int clone_origin(contact_origin *origin, contact_world *w, message *why);

/* Releases a reference; the last one destroys the origin. */
void give_back_origin(contact_origin *origin);

/* Marks origins at this address as outdated: another mjModel is being compiled there. */
void forget_origins(const mjModel *m);

#endif
