#include "config.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

const char *const contact_attributes[] = {"objects", "pairs", "bodies", "dir",   "prefix",           "text1",
                                          "text2",   "text3", "text4",  "check_step", "contact_capacity", "filters",
                                          "substeps_max"};
const int contact_attribute_count = sizeof contact_attributes / sizeof contact_attributes[0];

/* Contact capacity of a frame if the MJCF gives none: the state of a contact takes 160 bytes in every mjData
 * and every copy of its state, and the worst case of a scene may be thousands. */
#define DEFAULT_CAPACITY 64

static char *trim(char *text)
{
    char *end = text + strlen(text);
    while (*text != '\0' && strchr(" \t\r\n", *text) != NULL)
        text++;
    while (end > text && strchr(" \t\r\n", end[-1]) != NULL)
        end--;
    *end = '\0';
    return text;
}

/* Reads `FIRST <separator> SECOND; …`. */
static int read_entries(entry_list *list, const char *key, const char *value, char separator, message *why)
{
    size_t most = 1, length = strlen(value);
    char *at, *next;
    const char *scan;

    for (scan = value; *scan != '\0'; scan++)
        most += *scan == ';';
    list->text = malloc(length + 1);
    list->entries = malloc(most * sizeof *list->entries);
    if (list->text == NULL || list->entries == NULL)
        return fail(why, "no memory for the key `%s`", key);
    memcpy(list->text, value, length + 1);

    for (at = list->text; at != NULL; at = next) {
        char *split, *whole;
        next = strchr(at, ';');
        if (next != NULL)
            *next++ = '\0';
        whole = trim(at);
        if (*whole == '\0')
            continue;
        split = strchr(whole, separator);
        if (split == NULL || strchr(split + 1, separator) != NULL)
            return fail(why, "key `%s`: the entry `%s` is not of the form `FIRST %c SECOND`; entries are separated by `;`", key,
                        whole, separator);
        *split = '\0';
        list->entries[list->count].first = trim(whole);
        list->entries[list->count].second = trim(split + 1);
        if (*list->entries[list->count].first == '\0' || *list->entries[list->count].second == '\0')
            return fail(why, "key `%s`: an entry has an empty side; write `FIRST %c SECOND`", key, separator);
        list->count++;
    }
    return 1;
}

static const char *value_of(const mjModel *m, int instance, const char *key)
{
    const char *value = mj_getPluginConfig(m, instance, key);
    return value != NULL ? value : "";
}

static int read_capacity(contact_config *config, const char *value, message *why)
{
    char *end;
    unsigned long number;
    config->capacity = DEFAULT_CAPACITY;
    if (*value == '\0')
        return 1;
    errno = 0;
    number = strtoul(value, &end, 10);
    if (errno != 0 || *end != '\0' || *value == '-' || number < 1 || number > MAX_CAPACITY)
        return fail(why, "key `contact_capacity`: `%s` is no whole number from 1 to %d", value, MAX_CAPACITY);
    config->capacity = number;
    return 1;
}

static int read_substeps(contact_config *config, const char *value, message *why)
{
    char *end;
    unsigned long number;
    config->substeps_max = 0;
    if (*value == '\0')
        return 1;
    errno = 0;
    number = strtoul(value, &end, 10);
    if (errno != 0 || *end != '\0' || *value == '-' || number < 1 || number > MAX_SUBSTEPS)
        return fail(why, "key `substeps_max`: `%s` is no whole number from 1 to %d", value, MAX_SUBSTEPS);
    config->substeps_max = (uint32_t)number;
    return 1;
}

static int read_check_step(contact_config *config, const char *value, message *why)
{
    static const char *const words[] = {"false", "true", "notes"};
    int i;
    config->checks_step = CHECK_WARNINGS;
    if (*value == '\0')
        return 1;
    for (i = 0; i < 3; i++)
        if (strcmp(value, words[i]) == 0) {
            config->checks_step = i;
            return 1;
        }
    return fail(why, "key `check_step`: `%s` is none of `true`, `notes` and `false`", value);
}

int read_config(contact_config *config, const mjModel *m, int instance, message *why)
{
    static const char *const text_keys[TEXT_COUNT] = {"text1", "text2", "text3", "text4"};
    int i;
    memset(config, 0, sizeof *config);
    config->folder = value_of(m, instance, "dir");
    config->prefix = value_of(m, instance, "prefix");
    for (i = 0; i < TEXT_COUNT; i++)
        config->texts[i] = value_of(m, instance, text_keys[i]);
    if (!read_capacity(config, value_of(m, instance, "contact_capacity"), why) ||
        !read_substeps(config, value_of(m, instance, "substeps_max"), why) ||
        !read_check_step(config, value_of(m, instance, "check_step"), why) ||
        !read_entries(&config->objects, "objects", value_of(m, instance, "objects"), '=', why) ||
        !read_entries(&config->pairs, "pairs", value_of(m, instance, "pairs"), ',', why) ||
        !read_entries(&config->filters, "filters", value_of(m, instance, "filters"), ',', why) ||
        !read_entries(&config->bodies, "bodies", value_of(m, instance, "bodies"), '=', why))
        return 0;
    if (config->objects.count == 0)
        return fail(why, "the key `objects` is missing: it says which Objects there are and their models, "
                         "`ball = ball.ron; ground = ground.ron`");
    if (config->pairs.count == 0 && config->objects.count != 2)
        return fail(why, "the key `pairs` is missing: with %u Objects it says which may touch, `ball, ground; …`",
                    (unsigned)config->objects.count);
    return 1;
}

static void close_entries(entry_list *list)
{
    free(list->entries);
    free(list->text);
}

void close_config(contact_config *config)
{
    close_entries(&config->objects);
    close_entries(&config->pairs);
    close_entries(&config->filters);
    close_entries(&config->bodies);
    memset(config, 0, sizeof *config);
}

const char *inline_text(const contact_config *config, const char *model)
{
    if (strncmp(model, "text", 4) == 0 && model[4] >= '1' && model[4] < '1' + TEXT_COUNT && model[5] == '\0')
        return config->texts[model[4] - '1'];
    return NULL;
}
