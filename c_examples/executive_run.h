/* The simulation: two worlds at two rates, and the two ways to run them. */
#ifndef EXECUTIVE_RUN_H
#define EXECUTIVE_RUN_H

#include "docking_scene.h"
#include "executive_cabin.h"
#include "executive_task.h"

/* The fast world: the docking, at 1 kHz. The slow one comes every RATIO frames. */
#define FRAME_S 1e-3
enum { RATIO = 10 };

/* A wrench is used for at most this many frames after its own: then contact is computed again, late or not. */
enum { AGE_MAX = 3 };

/* Everything that a run computes. What is not a world or a handle goes into a checkpoint. */
typedef struct {
    long frame;               /* of the fast world; time is frame * FRAME_S */
    docking dynamics;
    contact_wrenches contact; /* of the fast world */
    int age;                  /* how many frames old that is */
    wrench on_cabin;          /* of the slow world, held for RATIO frames */
    contact_scene scene;
    cabin cabin;
    size_t flagged;           /* frames with a flag in pong_report */
    size_t most_contacts;
} simulation;

typedef struct {
    long end;                 /* run until this frame; a multiple of RATIO */
    long late_first, late_count; /* without the clock: these frames pass for late */
    int workers;
    int rehearse;             /* in real time: evaluate each frame shortly before its release as well */
    real_time_wishes wishes;  /* of the fast task; the slow one has a priority below */
} run_options;

/* Called at a frame at which neither world is in a call: the place for checkpoints. */
typedef void (*at_rest)(simulation *sim, void *context);

/* As fast as it goes, on the calling thread. The numbers are those of a run in real time without late frames. */
void run_without_clock(simulation *sim, const run_options *o, schedule *fast, schedule *slow, at_rest hook,
                       void *context);

/* By the clock: a thread for each world. */
void run_in_real_time(simulation *sim, const run_options *o, schedule *fast, schedule *slow, at_rest hook,
                      void *context);

#endif
