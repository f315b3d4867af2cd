/* What an instance keeps in mjData.plugin_state: everything that the engine remembers between steps, so that whoever saves and
 * restores the state of MuJoCo saves and restores the contacts.
 *
 *     used | key 2 | seen 2 | contacts | flags | checksum 2 | wrenches 6 per movable group | contact state
 *
 * Bit patterns are kept as whole numbers of 32 bits, one in each mjtNum: raw bytes would be denormal numbers or NaNs, which do
 * not survive every host that copies, prints or compares a state. Wrenches are what they are. What is not used is zero.
 *
 * The checksum is of all before the contact state; the contact state has one of its own. */
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

/* How many mjtNum an instance needs. */
int state_length(size_t groups, size_t state_size);

/* Answers 1, or 0 if the numbers are no state of an instance with such sizes, or not as they were written. */
int read_past(contact_past *past, const mjtNum *state, size_t groups, size_t state_size);

void read_wrenches(pong_wrench *wrenches, const mjtNum *state, size_t groups);

/* Answers 1, or 0 if the numbers are no bytes. */
int read_contact_state(unsigned char *bytes, const contact_past *past, const mjtNum *state, size_t groups);

/* Writes all of it; `bytes` has room for `past->used` rounded up to four. */
void write_state(mjtNum *state, const contact_past *past, const pong_wrench *wrenches, size_t groups,
                 const unsigned char *bytes, size_t state_size);

/* Hash of the states of all movable groups; never 0. */
uint64_t hash_states(const pong_state *states, size_t groups);

/* The key of what comes after a commit of such states; never 0. */
uint64_t next_key(uint64_t key, uint64_t seen);

#endif
