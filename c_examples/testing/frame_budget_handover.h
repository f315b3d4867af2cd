/* Communication time between two cores. */
#ifndef FRAME_BUDGET_HANDOVER_H
#define FRAME_BUDGET_HANDOVER_H

/* Least time that a word takes from the calling thread to a thread on this core and back, ns; 0 if there can be no such
 * thread. */
double hand_over_ns(int core);

#endif
