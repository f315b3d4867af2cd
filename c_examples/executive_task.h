/* A task that is released once in a period, by the clock, and what its deadlines came to. */
#ifndef EXECUTIVE_TASK_H
#define EXECUTIVE_TASK_H

#include "docking_timing.h"

#include <stddef.h>

/* System settings of the process and the thread, as requested and as granted, in words. */
typedef struct {
    char memory[160];
    char scheduling[160];
    char core[160];
} grants;

typedef struct {
    int lock_memory; /* 1: no page of the process is ever swapped out or first touched in a frame */
    int fifo;        /* SCHED_FIFO priority, 1 to 99; 0 keeps the usual scheduling */
    int core;        /* the only core that the thread may run on; negative for any */
} real_time_wishes;

/* Asks for the wishes. What is refused is told in the texts, and the program goes on without it. The memory is the
 * process's; priority and core are the calling thread's. */
void become_real_time(const real_time_wishes *wishes, grants *granted);

/* Deadlines of one task: a frame's deadline is the release of the next. */
typedef struct {
    const char *name;
    long long period;      /* ns */
    long long release;     /* of the present frame, ns */
    size_t frames;
    size_t missed;         /* frames that ended after their deadline */
    size_t aged;           /* frames that kept the wrench of an earlier one */
    size_t slips;          /* times that the schedule was given up and begun anew */
    long long slipped;     /* by how much all together, ns */
    long long latest_end;  /* of a frame behind its deadline, ns */
    durations wake, work;  /* from release to start, and from start to end */
} schedule;

void make_schedule(schedule *s, const char *name, long long period, size_t frames);

/* Delay of the clock behind the release of the present frame, if above one period; else 0, ns. A schedule that is late by
 * more than `give_up` periods restarts at the present time: catching up would starve everything else. */
long long behind(schedule *s, int give_up);

/* Notes the end of a frame that began at `start`, and sets the next release. */
void end_frame(schedule *s, long long start);

void print_schedule(schedule *s);
void free_schedule(schedule *s);

#endif
