/* A mechanism in MuJoCo with Pong's contact, stepped by the clock or as fast as it goes, and what its deadlines came to. */
#ifndef MACHINE_H
#define MACHINE_H

#include "executive_task.h"
#include "numbers.h"

#include <mujoco/mujoco.h>

/* Exit codes of the programs. */
enum { AS_PREDICTED = 0, OTHERWISE = 1, WRONG_USE = 2, REFUSED = 3, UNFINISHED = 4 };

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

/* Reads the arguments of a program; ends it if they are wrong. */
void read_options(run_options *o, int argc, char **argv);

/* FOLDER/machine.xml and FOLDER/numbers.txt, at rest but for the velocities in `qvel`. Goes into the folder: the plugin
 * seeks the models from there. */
void open_machine(machine *m, const run_options *o);
void close_machine(machine *m);

/* Addresses of a joint in qpos and qvel, and numbers of other things; they end the program if there is none of the name. */
int place_of(const machine *m, const char *joint);
int speed_of(const machine *m, const char *joint);
int id_of(const machine *m, mjtObj kind, const char *name);

/* Sets the controls of a step; 0 when the run is over. */
typedef int (*sequence)(machine *m, void *state);

/* Steps until the sequence is over (1) or the seconds of the options have passed (0). Prints what the deadlines came to, and
 * writes qpos and qvel as they lie in memory into the file of the option --end. */
int run_machine(machine *m, const run_options *o, sequence control, void *state);

#endif
