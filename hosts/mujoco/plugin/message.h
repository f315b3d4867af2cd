/* Text of one failure, and its report through MuJoCo's own channel. */
#ifndef PONG_CONTACT_MESSAGE_H
#define PONG_CONTACT_MESSAGE_H

#if defined(__GNUC__)
#define PRINTF_LIKE(text, first) __attribute__((format(printf, text, first)))
#else
#define PRINTF_LIKE(text, first)
#endif

typedef struct message {
    char text[2048];
} message;

/* Writes a message and returns 0, so that a failing function ends with `return fail(…)`. */
int fail(message *m, const char *format, ...) PRINTF_LIKE(2, 3);

/* Writes the activity `doing`, followed by the library's message, and returns 0. */
int fail_by_library(message *m, const char *doing);

/* Warns through mju_warning(): "pong.contact, instance `name`: text". */
void warn(const char *instance_name, const char *text);

/* As warn(), once per text and process: every mjData of a model would repeat it. */
void warn_once(const char *instance_name, const char *text);

#endif
