/* Text of one failure, and MuJoCo's own channel for it. */
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

/* Writes a message; answers 0, so that a function that fails ends with `return fail(…)`. */
int fail(message *m, const char *format, ...) PRINTF_LIKE(2, 3);

/* Writes what `doing` was about, followed by what the library said; answers 0. */
int fail_by_library(message *m, const char *doing);

/* Warns through mju_warning(): "pong.contact, instance `name`: text". */
void warn(const char *instance_name, const char *text);

/* The same, if this process has not been told the same text yet: every mjData of a model would repeat it. */
void warn_once(const char *instance_name, const char *text);

#endif
