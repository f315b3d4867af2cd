/* Layout of an instance's mjData.plugin_state: the complete contact memory between steps, so that saving and
 * restoring the state of MuJoCo includes the contacts.
 *
 *     used | key 2 | seen 2 | contacts | flags | checksum 2 | wrenches 6 per movable group | contact state
 *
 * Bit patterns are stored as integers of 32 bits, one per mjtNum: raw bytes would be denormal numbers or
 * NaNs, which not every host preserves when it copies, prints or compares a state. Wrenches are stored as
 * numbers. Unused words are zero.
 *
 * The checksum covers everything before the contact state, which has its own. */
#ifndef PONG_CONTACT_STATE_H
#define PONG_CONTACT_STATE_H

#include <mujoco/mujoco.h>
#include <pong.h>
#include <stddef.h>
#include <stdint.h>

#ifdef mjUSESINGLE
#error "pong.contact needs MuJoCo with double precision: 32 bits do not fit into a float"
#endif

/* The part before the contact state. */
typedef struct contact_past {
    uint64_t key;      /* names the contact state: a chain of hashes of all committed states; 0 if there is no past */
    uint64_t seen;     /* hash of the states of the last commit, whose wrenches these are */
    uint32_t used;     /* bytes of the contact state */
    uint32_t contacts; /* of the last commit */
    uint32_t flags;    /* PONG_FLAG_... of the last commit */
} contact_past;

/* Number of mjtNum of an instance. */
int state_length(size_t groups, size_t state_size);

/* Reads the part before the contact state. Returns 1, or 0 if the numbers are no valid state of an instance
 * with such sizes. */
int read_past(contact_past *past, const mjtNum *state, size_t groups, size_t state_size);

void read_wrenches(pong_wrench *wrenches, const mjtNum *state, size_t groups);

/* Reads the contact state. Returns 1, or 0 if the numbers are no bytes. */
int read_contact_state(unsigned char *bytes, const contact_past *past, const mjtNum *state, size_t groups);

/* Writes the whole state; `bytes` has room for `past->used` rounded up to four. */
void write_state(mjtNum *state, const contact_past *past, const pong_wrench *wrenches, size_t groups,
                 const unsigned char *bytes, size_t state_size);

/* Hash of the states of all movable groups; never 0. */
uint64_t hash_states(const pong_state *states, size_t groups);

/* Key after a commit of such states; never 0. */
uint64_t next_key(uint64_t key, uint64_t seen);

#endif
