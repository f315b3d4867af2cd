#define _GNU_SOURCE

#include "executive_run.h"

#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Waking a sleeping worker takes tens of microseconds, and so does a frame whose code and data are not in the caches: this
 * long before the frame both are done, ns. */
#define AHEAD_NS 100000LL
/* A schedule that is this many frames behind begins anew. */
enum { GIVE_UP = 20 };
/* Stack of a task's thread, all of it locked: bytes. */
#define STACK (1024 * 1024)

/* --- a frame of the fast world ----------------------------------------------------------------------------------- */

/* States in, step, wrenches out; or, if the frame is late already, the wrench of an earlier frame. */
static void contact_of_frame(simulation *sim, int late, schedule *s)
{
    pong_report report;
    if (late && sim->age < AGE_MAX) {
        sim->age += 1;
        s->aged += 1;
        return;
    }
    send_states(&sim->scene, &sim->dynamics);
    CHECK(pong_step(sim->scene.world));
    sim->contact = fetch_wrenches(&sim->scene);
    sim->age = 0;
    CHECK(pong_get_report(sim->scene.world, &report));
    sim->flagged += report.flags != 0;
    sim->most_contacts = report.contacts > sim->most_contacts ? report.contacts : sim->most_contacts;
}

static void fast_frame(simulation *sim, int late, schedule *s)
{
    contact_wrenches all;
    motion port = chaser_port(&sim->dynamics);
    vec3 arm = sub(sim->dynamics.chaser.centre.position, port.position);

    contact_of_frame(sim, late, s);
    /* The tool pushes the cabin at the mass centre; the dynamics take the vehicle's wrench at its port. */
    all = sim->contact;
    all.vehicle.force = add(all.vehicle.force, sim->on_cabin.force);
    all.vehicle.moment = add(all.vehicle.moment, add(sim->on_cabin.moment, cross(arm, sim->on_cabin.force)));
    docking_step(&sim->dynamics, &all, FRAME_S);
    sim->frame += 1;
}

/* --- without the clock ------------------------------------------------------------------------------------------- */

void run_without_clock(simulation *sim, const run_options *o, schedule *fast, schedule *slow, at_rest hook,
                       void *context)
{
    for (;;) {
        long long start = now_ns();
        fast->release = start;
        if (sim->frame % RATIO == 0) {
            /* The wrench of the slow world's last frame acts from now on. */
            sim->on_cabin = sim->cabin.on_cabin;
            hook(sim, context);
            if (sim->frame == o->end) {
                return;
            }
            slow->release = start = now_ns();
            cabin_frame(&sim->cabin, &sim->dynamics.chaser.centre);
            end_frame(slow, start);
            fast->release = start = now_ns();
        }
        fast_frame(sim, sim->frame >= o->late_first && sim->frame < o->late_first + o->late_count, fast);
        end_frame(fast, start);
    }
}

/* --- by the clock ------------------------------------------------------------------------------------------------ */

/* Between the two tasks. The fast one asks for a frame and, RATIO frames later, takes what came of it. */
typedef struct {
    pthread_mutex_t mutex; /* held for a copy, never for a frame; the holder inherits the priority of who waits */
    sem_t asked;
    int frames_due;        /* of the slow world; 0 while it rests */
    int stop;
    motion chaser;
} mailbox;

typedef struct {
    simulation *sim;
    const run_options *options;
    schedule *fast, *slow;
    at_rest hook;
    void *context;
    mailbox mail;
    int frames_missed;     /* slow frames that were due while the slow world was still at work */
    grants fast_grants, slow_grants;
} tasks;

static void refuse_to_go_on(const char *what, int error)
{
    fprintf(stderr, "%s: %s\n", what, strerror(error));
    exit(3);
}

/* Takes the result of the last slow frame and asks for the next one. If the slow world is late, its last wrench stays,
 * and it computes the frames that it missed after this one. */
static void exchange(tasks *t)
{
    mailbox *mail = &t->mail;
    int resting;
    pthread_mutex_lock(&mail->mutex);
    resting = mail->frames_due == 0;
    pthread_mutex_unlock(&mail->mutex);
    if (!resting) {
        t->frames_missed += 1;
        t->slow->aged += 1;
        return;
    }
    t->sim->on_cabin = t->sim->cabin.on_cabin;
    if (t->frames_missed == 0) {
        t->hook(t->sim, t->context);
    }
    if (t->sim->frame == t->options->end) {
        return;
    }
    pthread_mutex_lock(&mail->mutex);
    mail->chaser = t->sim->dynamics.chaser.centre;
    mail->frames_due = 1 + t->frames_missed;
    t->slow->release = now_ns();
    pthread_mutex_unlock(&mail->mutex);
    t->frames_missed = 0;
    sem_post(&mail->asked);
}

/* Prepares for the release. A rehearsal is an evaluation whose results are not read: it loads the data of the frame into the
 * caches of its cores, and changes nothing that the frame can see. */
static void get_ready(const tasks *t)
{
    if (t->options->workers > 0 || t->options->rehearse) {
        sleep_until(t->fast->release - AHEAD_NS);
    }
    if (t->options->workers > 0) {
        CHECK(pong_prewake(t->sim->scene.world, 2 * AHEAD_NS / 1000));
    }
    if (t->options->rehearse) {
        send_states(&t->sim->scene, &t->sim->dynamics);
        CHECK(pong_evaluate(t->sim->scene.world));
    }
}

static void *fast_task(void *argument)
{
    tasks *t = argument;
    schedule *s = t->fast;
    become_real_time(&t->options->wishes, &t->fast_grants);
    s->release = now_ns() + s->period;
    for (;;) {
        long long start;
        get_ready(t);
        sleep_until(s->release);
        start = now_ns();
        if (t->sim->frame % RATIO == 0) {
            exchange(t);
            if (t->sim->frame >= t->options->end) {
                return NULL;
            }
        }
        fast_frame(t->sim, behind(s, GIVE_UP) > 0, s);
        end_frame(s, start);
    }
}

static void *slow_task(void *argument)
{
    tasks *t = argument;
    mailbox *mail = &t->mail;
    real_time_wishes wishes = t->options->wishes;
    wishes.fifo = wishes.fifo > 1 ? wishes.fifo - 1 : wishes.fifo;
    become_real_time(&wishes, &t->slow_grants);
    for (;;) {
        motion chaser;
        long long start;
        int due, stop;
        while (sem_wait(&mail->asked) != 0 && errno == EINTR) {
        }
        start = now_ns();
        pthread_mutex_lock(&mail->mutex);
        chaser = mail->chaser;
        due = mail->frames_due;
        stop = mail->stop;
        pthread_mutex_unlock(&mail->mutex);
        if (stop) {
            return NULL;
        }
        for (; due > 0; due--) {
            cabin_frame(&t->sim->cabin, &chaser);
        }
        end_frame(t->slow, start);
        pthread_mutex_lock(&mail->mutex);
        mail->frames_due = 0;
        pthread_mutex_unlock(&mail->mutex);
    }
}

static pthread_t start_task(void *(*body)(void *), tasks *t)
{
    pthread_attr_t attributes;
    pthread_t thread;
    int error;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK);
    error = pthread_create(&thread, &attributes, body, t);
    if (error != 0) {
        refuse_to_go_on("a task's thread cannot be started", error);
    }
    pthread_attr_destroy(&attributes);
    return thread;
}

void run_in_real_time(simulation *sim, const run_options *o, schedule *fast, schedule *slow, at_rest hook,
                      void *context)
{
    static tasks t;
    pthread_mutexattr_t inherit;
    pthread_t fast_thread, slow_thread;

    memset(&t, 0, sizeof t);
    t.sim = sim;
    t.options = o;
    t.fast = fast;
    t.slow = slow;
    t.hook = hook;
    t.context = context;
    pthread_mutexattr_init(&inherit);
    pthread_mutexattr_setprotocol(&inherit, PTHREAD_PRIO_INHERIT);
    pthread_mutex_init(&t.mail.mutex, &inherit);
    pthread_mutexattr_destroy(&inherit);
    if (sem_init(&t.mail.asked, 0, 0) != 0) {
        refuse_to_go_on("a semaphore", errno);
    }
    slow_thread = start_task(slow_task, &t);
    fast_thread = start_task(fast_task, &t);
    pthread_join(fast_thread, NULL);
    pthread_mutex_lock(&t.mail.mutex);
    t.mail.stop = 1;
    pthread_mutex_unlock(&t.mail.mutex);
    sem_post(&t.mail.asked);
    pthread_join(slow_thread, NULL);
    sem_destroy(&t.mail.asked);
    pthread_mutex_destroy(&t.mail.mutex);
    printf("memory:  %s\nfast:    scheduling %s, core %s\nslow:    scheduling %s, core %s\n", t.fast_grants.memory,
           t.fast_grants.scheduling, t.fast_grants.core, t.slow_grants.scheduling, t.slow_grants.core);
}
