/* The clock of the examples, and durations. */
#ifndef DOCKING_TIMING_H
#define DOCKING_TIMING_H

#include <stddef.h>

/* Time by CLOCK_MONOTONIC, ns. */
long long now_ns(void);
void sleep_until(long long ns);

/* Durations, kept until the end: nothing is allocated while frames run. */
typedef struct {
    float *us;
    size_t count, capacity;
} durations;

durations make_durations(size_t capacity);
void note(durations *d, long long ns);

/* Percentiles in one line; sorts the durations. */
void print_durations(const char *what, durations *d);

#endif
