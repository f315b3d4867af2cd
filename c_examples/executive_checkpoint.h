/* Checkpoints of a run: the executive's own numbers, and the contact states of both worlds. */
#ifndef EXECUTIVE_CHECKPOINT_H
#define EXECUTIVE_CHECKPOINT_H

#include "executive_run.h"

/* A checkpoint in memory, which a frame can fill: all of it is taken before the run. */
typedef struct {
    unsigned char *bytes;
    size_t capacity, size; /* size 0: nothing taken yet */
} checkpoint;

void make_checkpoint(checkpoint *c, const simulation *sim);

/* Copies everything. No memory is taken, no file is touched: for a frame, while no other thread is in a call. */
void take_checkpoint(checkpoint *c, const simulation *sim);

/* For other threads than those of the frames. They end the program with 2 if the file cannot be used. */
void write_checkpoint(const checkpoint *c, const char *path);
void read_checkpoint(checkpoint *c, const char *path);

/* Makes a simulation whose worlds were made by the same calls continue from there. */
void restart_from(const checkpoint *c, simulation *sim);

#endif
