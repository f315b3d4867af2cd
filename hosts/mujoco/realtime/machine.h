/* A mechanism in MuJoCo with Pong's contact, stepped in real time or as fast as possible, with statistics of
 * its deadlines. */
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

/* Reads the arguments of a program; exits if they are wrong. */
void read_options(run_options *o, int argc, char **argv);

/* Opens FOLDER/machine.xml and FOLDER/numbers.txt, at rest except for the velocities in `qvel`. Changes to
 * the folder, because the plugin searches the models from there. */
void open_machine(machine *m, const run_options *o);
void close_machine(machine *m);

/* Addresses of a joint in qpos and qvel, and indices of other elements; exits if there is none of the name. */
int place_of(const machine *m, const char *joint);
int speed_of(const machine *m, const char *joint);
int id_of(const machine *m, mjtObj kind, const char *name);

/* Sets the controls of a step; returns 0 when the run is over. */
typedef int (*sequence)(machine *m, void *state);

/* Steps until the sequence is over (returns 1) or the seconds of the options have passed (returns 0). Prints
 * the statistics of the deadlines, and writes qpos and qvel in binary into the file of the option --end. */
int run_machine(machine *m, const run_options *o, sequence control, void *state);

#endif
