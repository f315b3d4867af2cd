/* What happens in a step: evaluations, any number of them, and one commit. */
#ifndef PONG_CONTACT_STEP_H
#define PONG_CONTACT_STEP_H

#include "host.h"

/* Wrenches, contact count and flags for the kinematics as they are in mjData and the past in its plugin_state. Changes no past.
 * What was computed last is not computed again. Answers 1; or 0 with zero wrenches, after one warning in a run. */
int evaluate(contact_host *host, const mjModel *m, const mjData *d);

/* Accepts qpos and qvel as they are in mjData: the only writer of plugin_state. A commit that fails leaves the past as it was. */
void commit(contact_host *host, const mjModel *m, mjData *d);

/* Lists the contacts at qpos and qvel in host->contacts, and answers how many there are. Changes no past and no kinematics. */
size_t list_contacts(contact_host *host, const mjModel *m, mjData *d);

#endif
