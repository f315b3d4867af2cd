#define _GNU_SOURCE

#include "executive_task.h"

#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

/* More than a frame uses of the stack (docs/c_api.md: 128 KiB and what the host needs); touched before the first. */
#define STACK_TOUCHED (256 * 1024)

static void touch_stack(void)
{
    volatile unsigned char stack[STACK_TOUCHED];
    size_t i;
    for (i = 0; i < sizeof stack; i += 1024) {
        stack[i] = 0;
    }
}

void become_real_time(const real_time_wishes *wishes, grants *granted)
{
    struct sched_param parameter;
    cpu_set_t cores;
    int refused;

    strcpy(granted->memory, "not locked: not asked for");
    strcpy(granted->scheduling, "as usual: SCHED_FIFO not asked for");
    strcpy(granted->core, "any: none asked for");
    if (wishes->lock_memory) {
        if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) {
            strcpy(granted->memory, "locked");
        } else {
            sprintf(granted->memory, "NOT locked: %.60s; raise the limit of locked memory (ulimit -l)",
                    strerror(errno));
        }
        touch_stack();
    }
    if (wishes->core >= 0) {
        CPU_ZERO(&cores);
        CPU_SET((size_t)wishes->core, &cores);
        refused = pthread_setaffinity_np(pthread_self(), sizeof cores, &cores);
        if (refused == 0) {
            sprintf(granted->core, "%d", wishes->core);
        } else {
            sprintf(granted->core, "any: core %d refused: %.60s", wishes->core, strerror(refused));
        }
    }
    if (wishes->fifo > 0) {
        memset(&parameter, 0, sizeof parameter);
        parameter.sched_priority = wishes->fifo;
        refused = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter);
        if (refused == 0) {
            sprintf(granted->scheduling, "SCHED_FIFO priority %d", wishes->fifo);
        } else {
            sprintf(granted->scheduling, "as usual: SCHED_FIFO priority %d refused: %.40s; see docs/realtime.md",
                    wishes->fifo, strerror(refused));
        }
    }
}

void make_schedule(schedule *s, const char *name, long long period, size_t frames)
{
    memset(s, 0, sizeof *s);
    s->name = name;
    s->period = period;
    s->wake = make_durations(frames);
    s->work = make_durations(frames);
}

long long behind(schedule *s, int give_up)
{
    long long late = now_ns() - s->release;
    if (late > give_up * s->period) {
        s->slips += 1;
        s->slipped += late;
        s->release += late;
        return 0;
    }
    return late > s->period ? late : 0;
}

void end_frame(schedule *s, long long start)
{
    long long end = now_ns(), deadline = s->release + s->period;
    note(&s->wake, start > s->release ? start - s->release : 0);
    note(&s->work, end - start);
    s->frames += 1;
    if (end > deadline) {
        s->missed += 1;
        s->latest_end = end - deadline > s->latest_end ? end - deadline : s->latest_end;
    }
    s->release = deadline;
}

void print_schedule(schedule *s)
{
    printf("%s: %u frames of %.1f ms; %u deadlines missed, the worst by %.3f ms; %u frames with an aged wrench; "
           "%u slips of %.1f ms in all\n",
           s->name, (unsigned)s->frames, (double)s->period * 1e-6, (unsigned)s->missed, (double)s->latest_end * 1e-6,
           (unsigned)s->aged, (unsigned)s->slips, (double)s->slipped * 1e-6);
    print_durations("wakes after", &s->wake);
    print_durations("works for", &s->work);
}

void free_schedule(schedule *s)
{
    free(s->wake.us);
    free(s->work.us);
}
