/* The process around a world: forks of it, its signals, and calls that come from where they should not. */
#define _GNU_SOURCE /* fork, sigaction, the number of tgkill */
#include "check.h"
#include <dirent.h>
#include <signal.h>
#include <stdint.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static char folder[] = "/tmp/pong_host_process_XXXXXX";

static void path_of(char *path, size_t size, const char *name)
{
    snprintf(path, size, "%s/%s", folder, name);
}

static void pause_ms(long ms)
{
    struct timespec time = { ms / 1000, ms % 1000 * 1000000 };
    nanosleep(&time, NULL);
}

static pong_wrench frame(scene *s, int number)
{
    pong_wrench wrench;
    memset(&wrench, 0, sizeof wrench);
    s->states[0].position[0] = 1e-4 * number;
    s->states[0].position[2] = 0.0995 - 1e-6 * (number % 100);
    OK(pong_set_states(s->world, s->interfaces, s->states, 3));
    OK(pong_step(s->world));
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_GROUP, &wrench));
    return wrench;
}

/* Exit code of a child: 0 if its tests passed. A child that hangs is ended by an alarm. */
static int answer_of(pid_t child)
{
    int status = 0;
    TEST(child > 0 && waitpid(child, &status, 0) == child);
    if (WIFSIGNALED(status)) {
        fprintf(stderr, "the child was ended by signal %d\n", WTERMSIG(status));
        return -1;
    }
    return WEXITSTATUS(status);
}

/* A world with workers and a log is forked: the child computes the same bits alone, is told that the log is not its own,
 * writes nothing into it, may begin another, and ends at once. */
static void forks(uint32_t when_full)
{
    pong_config config = pong_default_config();
    pong_log_options options = pong_default_log_options();
    pong_log_report report;
    scene s;
    pid_t child;
    char log[64], own[64];
    int i;
    path_of(log, sizeof log, when_full == PONG_LOG_WAIT ? "wait" : "lose");
    path_of(own, sizeof own, when_full == PONG_LOG_WAIT ? "own_wait" : "own_lose");
    config.workers = 1;
    config.oversubscribe = 1;
    config.contact_capacity = 16;
    open_scene(&s, &config);
    seal_scene(&s);
    options.when_full = when_full;
    options.buffer_bytes = 1;
    OK(pong_start_log(s.world, log, &options));
    for (i = 0; i < 10; i += 1) {
        frame(&s, i);
        OK(pong_log_frame(s.world, 0.001 * i));
    }
    fflush(NULL);
    child = fork();
    if (child == 0) {
        alarm(60);
        failures = 0;
        /* More than the buffer holds. */
        for (i = 10; i < 2010; i += 1) {
            frame(&s, i);
            OK(pong_log_frame(s.world, 0.001 * i));
        }
        OK(pong_get_log_report(s.world, &report));
        TEST(report.failed == 1 && report.lost == 2000);
        REFUSED(pong_stop_log(s.world, &report), LOG_FAILED, "not to this fork of it");
        options.buffer_bytes = 0;
        OK(pong_start_log(s.world, own, &options));
        OK(pong_log_frame(s.world, 3.0));
        OK(pong_stop_log(s.world, &report));
        TEST(report.frames == 1 && report.lost == 0);
        OK(pong_destroy_world(s.world));
        _exit(failures == 0 ? 0 : 1);
    }
    TEST(answer_of(child) == 0);
    for (i = 10; i < 20; i += 1) {
        frame(&s, i);
        OK(pong_log_frame(s.world, 0.001 * i));
    }
    OK(pong_stop_log(s.world, &report));
    TEST(report.frames == 20 && report.flushed == 20 && report.lost == 0);
    /* A world with a log that nobody stopped is destroyed in the child. */
    path_of(log, sizeof log, when_full == PONG_LOG_WAIT ? "wait2" : "lose2");
    OK(pong_start_log(s.world, log, &options));
    fflush(NULL);
    child = fork();
    if (child == 0) {
        alarm(60);
        failures = 0;
        OK(pong_destroy_world(s.world));
        _exit(failures == 0 ? 0 : 1);
    }
    TEST(answer_of(child) == 0);
    OK(pong_stop_log(s.world, NULL));
    OK(pong_destroy_world(s.world));
}

static pid_t main_thread;
static volatile sig_atomic_t on_main, elsewhere;

static void count(int number)
{
    (void)number;
    if (syscall(SYS_gettid) == main_thread) {
        on_main += 1;
    } else {
        elsewhere += 1;
    }
}

/* Signals to the process are never taken by a thread of the library, also when the host's own thread blocks them to wait
 * for them. */
static void signals(void)
{
    pong_config config = pong_default_config();
    struct sigaction action;
    sigset_t one, before, after;
    const struct timespec long_enough = {5, 0};
    char log[64];
    scene s;
    int i;
    main_thread = (pid_t)syscall(SYS_gettid);
    memset(&action, 0, sizeof action);
    action.sa_handler = count;
    sigaction(SIGUSR1, &action, NULL);
    memset(&before, 0, sizeof before);
    memset(&after, 0, sizeof after);
    pthread_sigmask(SIG_BLOCK, NULL, &before);
    path_of(log, sizeof log, "signals");
    config.workers = 2;
    config.oversubscribe = 1;
    open_scene(&s, &config);
    seal_scene(&s);
    OK(pong_start_log(s.world, log, NULL));
    pthread_sigmask(SIG_BLOCK, NULL, &after);
    TEST(memcmp(&before, &after, sizeof before) == 0);
    sigemptyset(&one);
    sigaddset(&one, SIGUSR1);
    pthread_sigmask(SIG_BLOCK, &one, NULL);
    for (i = 0; i < 5; i += 1) {
        kill(getpid(), SIGUSR1);
        frame(&s, i);
        OK(pong_log_frame(s.world, 0.001 * i));
        pause_ms(10);
        /* One that another thread has taken never comes. */
        TEST(sigtimedwait(&one, NULL, &long_enough) == SIGUSR1);
    }
    pthread_sigmask(SIG_UNBLOCK, &one, NULL);
    TEST(elsewhere == 0);
    OK(pong_stop_log(s.world, NULL));
    OK(pong_destroy_world(s.world));
}

static volatile sig_atomic_t held, hold;

static void stand_still(int number)
{
    (void)number;
    held = 1;
    while (hold) {
        pause_ms(1);
    }
}

/* A worker that the system does not run (here: kept in a handler) does not keep the world from its end. */
static void worker_that_does_not_run(void)
{
    pong_config config = pong_default_config();
    struct sigaction action;
    DIR *tasks = opendir("/proc/self/task");
    struct dirent *entry;
    long worker = 0;
    scene s;
    config.workers = 1;
    config.oversubscribe = 1;
    open_scene(&s, &config);
    seal_scene(&s);
    frame(&s, 0);
    while (tasks != NULL && (entry = readdir(tasks)) != NULL) {
        /* Ids wrap around, so the worker's may be below that of the process. */
        long id = atol(entry->d_name);
        worker = id > 0 && id != (long)getpid() ? id : worker;
    }
    TEST(tasks != NULL && worker != 0);
    closedir(tasks);
    memset(&action, 0, sizeof action);
    action.sa_handler = stand_still;
    /* The library's threads do not block SIGTRAP, which reports a fault of the thread itself. */
    sigaction(SIGTRAP, &action, NULL);
    hold = 1;
    syscall(SYS_tgkill, getpid(), worker, SIGTRAP);
    while (!held) {
        pause_ms(1);
    }
    REFUSED(pong_destroy_world(s.world), WORKER_LEFT, "1 of its workers had not ended in time");
    hold = 0;
    pause_ms(100);
}

static pong_status destroyed;

static double destroying(const pong_normal_input *in, void *user)
{
    pong_world *const *world = user;
    destroyed = pong_destroy_world(*world);
    return in->stiffness * in->depth;
}

#define DISC(name, kind)                                                                                             \
    "(format: \"pong-model\", version: 1, name: \"" name "\", surfaces: {\"s\": (stiffness: 1e4, normal: "            \
    "Custom(name: \"mine\"))}, root: (name: \"" name "\", surface: \"s\", primitives: [" kind "]))"

/* A law that destroys its own world is refused, and the frame goes on. */
static void destroyed_from_inside(void)
{
    pong_config config = pong_default_config();
    pong_model_id models[2];
    pong_object_id objects[2];
    pong_interface_id roots[2];
    pong_state states[2] = { { { 0, 0, 0 }, { 0, 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } } };
    pong_wrench wrench;
    pong_world *world;
    OK(pong_create_world(&config, &world));
    OK(pong_register_normal_law(world, "mine", destroying, NULL, &world));
    OK(load_text(world, DISC("ball", "Sphere(name: \"b\", center: (0, 0, 0), radius: 0.1)"), &models[0]));
    OK(load_text(world, DISC("ground", "Plane(name: \"p\", normal: (0, 0, 1), offset: 0)"), &models[1]));
    OK(pong_create_object(world, models[0], "ball", &objects[0]));
    OK(pong_create_object(world, models[1], "ground", &objects[1]));
    OK(pong_pair_objects(world, objects[0], objects[1], NULL));
    OK(pong_find_interface(world, objects[0], "", &roots[0]));
    OK(pong_find_interface(world, objects[1], "", &roots[1]));
    OK(pong_seal(world, NULL));
    states[0] = states[1] = pong_default_state();
    states[0].position[2] = 0.099;
    OK(pong_set_states(world, roots, states, 2));
    OK(pong_step(world));
    TEST(destroyed == PONG_STATUS_BUSY);
    OK(pong_get_wrench(world, roots[0], PONG_REFERENCE_FRAME_COMMON, &wrench));
    TEST(wrench.force[2] > 4.9 && wrench.force[2] < 5.1);
    OK(pong_destroy_world(world));
}

int main(void)
{
    char command[80];
    TEST(mkdtemp(folder) != NULL);
    forks(PONG_LOG_DROP);
    forks(PONG_LOG_WAIT);
    signals();
    worker_that_does_not_run();
    destroyed_from_inside();
    snprintf(command, sizeof command, "rm -r %s", folder);
    TEST(system(command) == 0);
    return report_failures("host_process");
}
