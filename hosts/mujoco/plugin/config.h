/* Configuration of an instance, from its <config> elements. docs/mujoco.md describes every key. */
#ifndef PONG_CONTACT_CONFIG_H
#define PONG_CONTACT_CONFIG_H

#include "message.h"

#include <mujoco/mujoco.h>
#include <stdint.h>

/* Two texts: `first = second` or `first, second`. */
typedef struct entry {
    const char *first, *second;
} entry;

typedef struct entry_list {
    char *text; /* what the entries point into */
    entry *entries;
    size_t count;
} entry_list;

enum { TEXT_COUNT = 4 };

/* Largest contact_capacity. */
enum { MAX_CAPACITY = 65536 };

/* Largest substeps_max. */
enum { MAX_SUBSTEPS = 1000000 };

/* Reports on the time step, in the order of the words `false`, `true` and `notes`. */
enum { CHECK_OFF, CHECK_WARNINGS, CHECK_WITH_NOTES };

typedef struct contact_config {
    entry_list objects; /* Object, model */
    entry_list pairs;   /* Object, Object */
    entry_list filters; /* group, group: Object/path */
    entry_list bodies;  /* movable group, MuJoCo body */
    const char *folder, *prefix;
    const char *texts[TEXT_COUNT]; /* models written into the MJCF; "" if there is none */
    uint64_t capacity;
    uint32_t substeps_max; /* 0 without the key: contact is evaluated once a step */
    int checks_step; /* CHECK_... */
} contact_config;

extern const char *const contact_attributes[];
extern const int contact_attribute_count;

/* Reads the configuration of an instance. Texts that are not entries remain owned by the model. Returns 1, or
 * 0 with a message; call close_config() in either case. */
int read_config(contact_config *config, const mjModel *m, int instance, message *why);

void close_config(contact_config *config);

/* Model text named by `model` (text1 to text4), or NULL if it names a file. */
const char *inline_text(const contact_config *config, const char *model);

#endif
