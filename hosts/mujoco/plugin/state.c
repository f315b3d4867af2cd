#include "state.h"

#include <string.h>

enum { USED, KEY, SEEN = KEY + 2, CONTACTS = SEEN + 2, FLAGS, CHECKSUM, WRENCHES = CHECKSUM + 2 };
enum { WRENCH_NUMBERS = 6, WORD_BYTES = 4 };

static size_t words(size_t bytes) { return (bytes + WORD_BYTES - 1) / WORD_BYTES; }

static size_t bytes_at(size_t groups) { return WRENCHES + WRENCH_NUMBERS * groups; }

int state_length(size_t groups, size_t state_size) { return (int)(bytes_at(groups) + words(state_size)); }

/* A word of 32 bits, if the number is an integer in range. */
static int read_word(uint32_t *word, mjtNum number)
{
    if (!(number >= 0 && number <= 4294967295.0) || number != (mjtNum)(uint32_t)number)
        return 0;
    *word = (uint32_t)number;
    return 1;
}

static int read_two(uint64_t *bits, const mjtNum *numbers)
{
    uint32_t low, high;
    if (!read_word(&low, numbers[0]) || !read_word(&high, numbers[1]))
        return 0;
    *bits = (uint64_t)high << 32 | low;
    return 1;
}

static void write_two(mjtNum *numbers, uint64_t bits)
{
    numbers[0] = (mjtNum)(bits & 0xffffffffu);
    numbers[1] = (mjtNum)(bits >> 32);
}

/* The finaliser of SplitMix64: every bit of the input reaches every bit of the output. */
static uint64_t mix(uint64_t x)
{
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

static uint64_t hash_number(uint64_t hash, mjtNum number)
{
    uint64_t bits;
    number += 0; /* -0 and 0 are one number */
    memcpy(&bits, &number, sizeof bits);
    return mix(hash ^ bits) + 0x9e3779b97f4a7c15u;
}

static uint64_t checksum(const mjtNum *state, size_t groups)
{
    uint64_t hash = 0;
    size_t i;
    for (i = 0; i < bytes_at(groups); i++)
        if (i != CHECKSUM && i != CHECKSUM + 1)
            hash = hash_number(hash, state[i]);
    return hash;
}

int read_past(contact_past *past, const mjtNum *state, size_t groups, size_t state_size)
{
    uint64_t sum;
    /* Reset data are all zero. */
    return read_two(&sum, state + CHECKSUM) && (sum == 0 || sum == checksum(state, groups)) &&
           read_two(&past->key, state + KEY) && read_two(&past->seen, state + SEEN) && read_word(&past->used, state[USED]) &&
           read_word(&past->contacts, state[CONTACTS]) && read_word(&past->flags, state[FLAGS]) && past->used <= state_size &&
           (sum != 0 || past->key == 0);
}

void read_wrenches(pong_wrench *wrenches, const mjtNum *state, size_t groups)
{
    size_t i;
    for (i = 0; i < groups; i++) {
        memcpy(wrenches[i].force, state + WRENCHES + WRENCH_NUMBERS * i, sizeof wrenches[i].force);
        memcpy(wrenches[i].moment, state + WRENCHES + WRENCH_NUMBERS * i + 3, sizeof wrenches[i].moment);
    }
}

int read_contact_state(unsigned char *bytes, const contact_past *past, const mjtNum *state, size_t groups)
{
    const mjtNum *numbers = state + bytes_at(groups);
    size_t i, count = words(past->used);
    for (i = 0; i < count; i++) {
        uint32_t word;
        if (!read_word(&word, numbers[i]))
            return 0;
        memcpy(bytes + WORD_BYTES * i, &word, WORD_BYTES);
    }
    return 1;
}

void write_state(mjtNum *state, const contact_past *past, const pong_wrench *wrenches, size_t groups,
                 const unsigned char *bytes, size_t state_size)
{
    mjtNum *numbers = state + bytes_at(groups);
    uint32_t before;
    size_t i, count = words(past->used), most = words(state_size);
    /* Words used before and unused now become zero; if their number is invalid, all words do. */
    size_t dirty = read_word(&before, state[USED]) && words(before) <= most ? words(before) : most;

    state[USED] = past->used;
    write_two(state + KEY, past->key);
    write_two(state + SEEN, past->seen);
    state[CONTACTS] = past->contacts;
    state[FLAGS] = past->flags;
    for (i = 0; i < groups; i++) {
        memcpy(state + WRENCHES + WRENCH_NUMBERS * i, wrenches[i].force, sizeof wrenches[i].force);
        memcpy(state + WRENCHES + WRENCH_NUMBERS * i + 3, wrenches[i].moment, sizeof wrenches[i].moment);
    }
    write_two(state + CHECKSUM, checksum(state, groups));
    for (i = 0; i < count; i++) {
        uint32_t word;
        memcpy(&word, bytes + WORD_BYTES * i, WORD_BYTES);
        numbers[i] = word;
    }
    for (i = count; i < dirty; i++)
        numbers[i] = 0;
}

uint64_t hash_states(const pong_state *states, size_t groups)
{
    uint64_t hash = 0x9e3779b97f4a7c15u, bits;
    const unsigned char *bytes = (const unsigned char *)states;
    size_t i;
    for (i = 0; i < groups * sizeof *states; i += sizeof bits) {
        memcpy(&bits, bytes + i, sizeof bits);
        hash = mix(hash ^ bits) + 0x9e3779b97f4a7c15u;
    }
    return hash != 0 ? hash : 1;
}

uint64_t next_key(uint64_t key, uint64_t seen)
{
    uint64_t next = mix(key + 0x9e3779b97f4a7c15u) ^ mix(seen);
    next = mix(next);
    return next != 0 ? next : 1;
}
