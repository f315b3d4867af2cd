/* A mechanism in MuJoCo with Pong's contact, stepped in real time or as fast as possible, with statistics of
 * its deadlines. */
#ifndef MACHINE_H
#define MACHINE_H

#include "executive_task.h"
#include "numbers.h"

#include <mujoco/mujoco.h>

/* Exit codes of the programs. */
enum { AS_PREDICTED = 0, OTHERWISE = 1, WRONG_USE = 2, REFUSED = 3, UNFINISHED = 4 };

enum { MOST_PHASES = 16 };

typedef struct {
    const char *folder, *end;
    int fast;
    double seconds;
    real_time_wishes wishes;
} run_options;

typedef struct {
    mjModel *model;
    mjData *data;
    numbers numbers;
    const double *sensed; /* numbers of the plugin's sensor, docs/mujoco.md */
    int flags;
} machine;

/* Addresses of a joint in qpos and qvel, and indices of other elements; exits if there is none of the name. */
int place_of(const machine *m, const char *joint);
int speed_of(const machine *m, const char *joint);
int id_of(const machine *m, mjtObj kind, const char *name);

/* The phases that a sequencer goes through. */
typedef struct {
    const char *const *names;
    int now;
    double since;             /* begin of the present phase, s */
    double unmet;             /* when the condition of `has_held` last did not hold, s */
    double ends[MOST_PHASES]; /* s; -1 for a phase that has not ended */
} phases;

void begin_phases(phases *p, const char *const *names, int first);

/* Ends the present phase and enters another one. */
void enter_phase(phases *p, const machine *m, int phase);

/* True if a condition, tested at every step of a phase, has held for more than `seconds`. */
int has_held(phases *p, const machine *m, int holds, double seconds);

/* Prints the ends of the first `count` phases, as far as they have ended. */
void print_ends(const phases *p, int count);

/* A program that runs a machine by a sequencer. */
typedef struct {
    void *sequencer;
    const phases *phases;
    void (*open)(void *sequencer, const machine *m);
    int (*control)(machine *m, void *sequencer); /* sets the controls of a step; returns 0 when the run is over */
    int (*judge)(const void *sequencer, const machine *m); /* prints the outcome; returns the exit code */
} program;

/* Steps until the program is over or the seconds of the options have passed. Prints the statistics of the deadlines and the
 * outcome, and writes qpos and qvel in binary into the file of the option --end. Returns the exit code. */
int run_program(const program *p, int argc, char **argv);

#endif
