#define _POSIX_C_SOURCE 200112L

#include "docking_timing.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

long long now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (long long)t.tv_sec * 1000000000LL + t.tv_nsec;
}

void sleep_until(long long ns)
{
    struct timespec t;
    t.tv_sec = (time_t)(ns / 1000000000LL);
    t.tv_nsec = (long)(ns % 1000000000LL);
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, NULL) == EINTR) {
    }
}

durations make_durations(size_t capacity)
{
    durations d;
    d.us = malloc(capacity * sizeof *d.us);
    d.count = 0;
    d.capacity = capacity;
    if (d.us == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(3);
    }
    /* Touch the pages now, not in a frame. */
    memset(d.us, 0, capacity * sizeof *d.us);
    return d;
}

void note(durations *d, long long ns)
{
    if (d->count < d->capacity) {
        d->us[d->count++] = (float)ns * 1e-3f;
    }
}

static int by_size(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

void print_durations(const char *what, durations *d)
{
    size_t n = d->count;
    if (n == 0) {
        return;
    }
    qsort(d->us, n, sizeof *d->us, by_size);
    printf("  %-12s p50 %7.1f   p90 %7.1f   p99 %7.1f   p99.9 %7.1f   max %8.1f us\n", what, d->us[n / 2],
           d->us[n - 1 - (n - 1) / 10], d->us[n - 1 - (n - 1) / 100], d->us[n - 1 - (n - 1) / 1000], d->us[n - 1]);
}
