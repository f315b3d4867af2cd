/* One contact world for each mjData and instance. */
#ifndef PONG_CONTACT_HOST_H
#define PONG_CONTACT_HOST_H

#include "origin.h"
#include "slow.h"
#include "state.h"

typedef struct contact_host {
    const mjData *data;
    int instance;
    struct contact_host *next;

    contact_origin *origin;
    contact_world at;             /* a clone of its origin's world; the rest is the origin's */
    int is_silent;                /* of scratch data, which have no contact; the rest is then empty */
    slow_copies slow;             /* empty without the key `substeps_max` */
    pong_state *states;
    unsigned char *bytes;         /* of one contact state */
    unsigned char *no_past;       /* the contact state of a world that has just been sealed */
    size_t no_past_size;
    pong_contact *contacts;       /* of a picture */
    size_t contact_capacity;

    int has_key;                  /* 0 while nobody knows what the world holds */
    uint64_t key;                 /* of the contact state that the world holds now */

    /* Key and states of the last result. */
    int has_result;
    uint64_t result_key, result_seen;
    pong_wrench *wrenches;
    uint32_t contact_count, flags;
    int status;                   /* PONG_STATUS_... of the last evaluation or commit */

    int warned_limit, warned_tunnelling, warned_depth, warned_failure, warned_slow; /* in this run */
} contact_host;

/* Builds the world of an instance for an mjData, replacing an existing one. Returns NULL after a warning. */
contact_host *make_host(const mjModel *m, const mjData *d, int instance);

/* World of an instance for an mjData, created on first use. It is looked up by the address of the mjData,
 * never by mjData.plugin_data: unpickling overwrites that with a pointer of another mjData or of another
 * process. */
contact_host *find_host(const mjModel *m, const mjData *d, int instance);

void delete_host(const mjData *d, int instance);

/* Size of the sensor: number of contacts, PONG_FLAG_..., PONG_STATUS_...; then force and moment on each
 * movable group. */
int count_sensor_numbers(size_t groups);

/* Sizes of the state and number of movable groups of an instance. Returns 0 if it cannot be built; creating
 * the mjData reports the reason. */
int measure_instance(const mjModel *m, int instance, int *state_numbers, int *groups);

#endif
