/* A stretch of a run, replayed: the models, Objects and pairs of a contact world, and the states of its movable groups in each
 * frame. ci/frame_budget.py writes the file from a response log:
 *
 *     capacity COUNT
 *     model FILE
 *     object MODEL NAME        MODEL counts the models from 0
 *     pair NAME NAME
 *     group NAME PATH          in the order of the states
 *     frames COUNT             behind this line: for each frame a pong_state of each group, as it lies in memory
 */
#ifndef FRAME_BUDGET_REPLAY_H
#define FRAME_BUDGET_REPLAY_H

#include <pong.h>
#include <stddef.h>

enum { MOST_MODELS = 64, MOST_GROUPS = 256 };

typedef struct {
    pong_world *world;
    pong_interface_id groups[MOST_GROUPS];
    pong_wrench wrenches[MOST_GROUPS];
    size_t group_count, frames, workers;
    pong_state *states;
    /* The contact state after the first frame: each round begins with it. */
    void *begin;
    size_t begin_size;
} replay;

/* A sealed world that has had the first frame. Exits with a message if anything is wrong. */
void open_replay(replay *r, const char *file, pong_config config);
void close_replay(replay *r);

/* Back to the state after the first frame; allocates nothing. */
void rewind_replay(replay *r);

/* A frame of the engine as a host calls it: states in, evaluate and commit, wrenches out. */
void replay_frame(replay *r, size_t frame);

#endif
