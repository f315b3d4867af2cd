#include "message.h"

#include <mujoco/mujoco.h>
#include <pong.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* A failed compilation reports at most 500 characters to its caller (mj_loadXML, ValueError in Python),
 * including "engine error: plugin->init failed for plugin id 0". */
#define MOST_CHARACTERS 400

int fail(message *m, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(m->text, sizeof m->text, format, arguments);
    va_end(arguments);
    return 0;
}

int fail_by_library(message *m, const char *doing)
{
    return fail(m, "%s: %s", doing, pong_last_message());
}

/* Cuts a long text at the end of a line and gives the number of remaining lines. */
static void shorten(char *text)
{
    size_t lines = 0, end = MOST_CHARACTERS;
    const char *at;
    if (strlen(text) <= MOST_CHARACTERS)
        return;
    while (end > 0 && text[end] != '\n')
        end--;
    if (end == 0)
        end = MOST_CHARACTERS;
    for (at = text + end; *at != '\0'; at++)
        lines += *at == '\n';
    if (lines > 0)
        snprintf(text + end, 80, "\nand %u more lines: `pong check MODEL.ron` shows all", (unsigned)lines);
    else
        memcpy(text + end, "…", sizeof "…");
}

static void compose(char *text, size_t size, const char *instance_name, const char *said)
{
    snprintf(text, size, "pong.contact, instance `%s`: %s", instance_name != NULL ? instance_name : "", said);
}

void warn(const char *instance_name, const char *said)
{
    char text[2200];
    compose(text, sizeof text, instance_name, said);
    shorten(text);
    mju_warning("%s", text);
}

void warn_once(const char *instance_name, const char *said)
{
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    static uint64_t told[256];
    static size_t count;
    char text[2200];
    uint64_t hash = 0xcbf29ce484222325u;
    size_t i;
    int is_new = 1;

    compose(text, sizeof text, instance_name, said);
    for (i = 0; text[i] != '\0'; i++)
        hash = (hash ^ (unsigned char)text[i]) * 0x100000001b3u;
    pthread_mutex_lock(&mutex);
    for (i = 0; i < count && is_new; i++)
        is_new = told[i] != hash;
    if (is_new && count < sizeof told / sizeof told[0])
        told[count++] = hash;
    pthread_mutex_unlock(&mutex);
    if (is_new)
        warn(instance_name, said);
}
