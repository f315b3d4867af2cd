/* Calls within a step: any number of evaluations, and one commit. */
#ifndef PONG_CONTACT_STEP_H
#define PONG_CONTACT_STEP_H

#include "host.h"

/* Computes wrenches, contact count and flags from the kinematics in mjData and the memory in its
 * plugin_state, without changing the memory. A repeated evaluation uses the stored result. Returns 1; or 0
 * with zero wrenches, after one warning per run. */
int evaluate(contact_host *host, const mjModel *m, const mjData *d);

/* Accepts qpos and qvel of mjData: the only writer of plugin_state. A failed commit leaves the memory as it
 * was. */
void commit(contact_host *host, const mjModel *m, mjData *d);

/* Lists the contacts at qpos and qvel in host->contacts and returns their number. Changes neither memory nor
 * kinematics. */
size_t list_contacts(contact_host *host, const mjModel *m, mjData *d);

#endif
