/* A host with little memory: under every limit of its address space set-up either succeeds or is refused with the size that
 * it asked for. It never ends the process, and it succeeds where there is enough. */
#define _GNU_SOURCE /* fork, setrlimit */
#include "check.h"
#include <sys/resource.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[] = "/tmp/pong_little_memory_XXXXXX";

/* Size of the process, bytes. */
static unsigned long long size_now(void)
{
    unsigned long long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file == NULL || fscanf(file, "%llu", &pages) != 1) {
        pages = 0;
    }
    fclose(file);
    return pages * (unsigned long long)sysconf(_SC_PAGESIZE);
}

/* Exit codes of the child beside the number of the stage that it reached. */
enum { ABORTED = 100, WRONG = 99 };

/* A call that may be refused for want of memory, and for nothing else; the message must tell the size. */
#define STAGE(call)                                                                                                       \
    do {                                                                                                                  \
        pong_status stage_status_ = (call);                                                                               \
        if (stage_status_ == PONG_STATUS_OUT_OF_MEMORY && strstr(pong_last_message(), " bytes") != NULL) {                \
            return stage;                                                                                                 \
        }                                                                                                                 \
        if (stage_status_ != PONG_STATUS_OK) {                                                                            \
            fprintf(stderr, "%s: %s: %s\n", #call, pong_status_name(stage_status_), pong_last_message());                 \
            return WRONG;                                                                                                 \
        }                                                                                                                 \
        stage += 1;                                                                                                       \
    } while (0)

/* A scene with 60 movable groups that are paired with each other, a mesh of 1,600 triangles, and a log. */
static int set_up(const char *arms, const char *mesh, unsigned workers)
{
    pong_config config = pong_default_config();
    pong_log_options options = pong_default_log_options();
    pong_model_id models[2];
    pong_object_id objects[2];
    pong_world *world;
    char log[64];
    int stage = 0;
    snprintf(log, sizeof log, "%s/log", folder);
    config.workers = workers;
    config.oversubscribe = 1;
    config.contact_capacity = 20000;
    options.overwrite = 1;
    STAGE(pong_create_world(&config, &world));
    STAGE(load_text(world, arms, &models[0]));
    STAGE(load_text(world, mesh, &models[1]));
    STAGE(pong_create_object(world, models[0], "arms", &objects[0]));
    STAGE(pong_create_object(world, models[1], "mesh", &objects[1]));
    STAGE(pong_pair_objects(world, objects[0], objects[0], NULL));
    STAGE(pong_pair_objects(world, objects[0], objects[1], NULL));
    STAGE(pong_seal(world, NULL));
    STAGE(pong_start_log(world, log, &options));
    STAGE(pong_stop_log(world, NULL));
    STAGE(pong_destroy_world(world));
    return stage;
}

enum { ALL = 11 };

/* Stage that set-up reaches with this much additional address space. */
static int with(unsigned long long bytes, const char *arms, const char *mesh, unsigned workers)
{
    int status;
    pid_t child;
    fflush(NULL);
    child = fork();
    if (child == 0) {
        struct rlimit limit;
        limit.rlim_cur = limit.rlim_max = size_now() + bytes;
        setrlimit(RLIMIT_AS, &limit);
        _exit(set_up(arms, mesh, workers));
    }
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) {
        fprintf(stderr, "%llu bytes: ended by signal %d\n", bytes, WTERMSIG(status));
        return ABORTED;
    }
    return WEXITSTATUS(status);
}

static void write_arms(char *text, size_t size)
{
    int i, n = snprintf(text, size, "(format: \"pong-model\", version: 1, name: \"arms\", surfaces: {\"s\": (stiffness: 1e4)},\n"
                        " root: (name: \"arms\", surface: \"s\", groups: [\n");
    for (i = 0; i < 60; i += 1) {
        n += snprintf(text + n, size - (size_t)n, "  (name: \"a%d\", movable: true, primitives: [Sphere(name: \"b\", "
                      "center: (0, 0, %d), radius: 0.1)]),\n", i, i);
    }
    snprintf(text + n, size - (size_t)n, " ]))");
}

static void write_mesh(char *text, size_t size)
{
    int i, n = snprintf(text, size, "(format: \"pong-model\", version: 1, name: \"mesh\", surfaces: {\"s\": (stiffness: 1e4)},\n"
                        " root: (name: \"mesh\", surface: \"s\", primitives: [\n  TriangleMesh(name: \"m\", vertices: [");
    for (i = 0; i < 29 * 29; i += 1) {
        n += snprintf(text + n, size - (size_t)n, "(%d, %d, 0), ", i % 29, i / 29);
    }
    n += snprintf(text + n, size - (size_t)n, "],\n   triangles: [");
    for (i = 0; i < 28 * 28; i += 1) {
        int a = i % 28 + 29 * (i / 28);
        n += snprintf(text + n, size - (size_t)n, "(%d, %d, %d), (%d, %d, %d), ", a, a + 1, a + 30, a, a + 30, a + 29);
    }
    snprintf(text + n, size - (size_t)n, "]),\n ]))");
}

int main(void)
{
    static char arms[16 * 1024], mesh[96 * 1024];
    unsigned workers;
    char command[80];
    TEST(mkdtemp(folder) != NULL);
    write_arms(arms, sizeof arms);
    write_mesh(mesh, sizeof mesh);
    for (workers = 0; workers < 2; workers += 1) {
        unsigned long long bytes;
        int reached = 0, most = 0, stages = 0;
        /* From nothing to plenty, a tenth more each time; finely where the small things are. */
        for (bytes = 4096; bytes < (1ULL << 30) && most < ALL; bytes += bytes < (1 << 21) ? 40960 : bytes / 10) {
            reached = with(bytes, arms, mesh, workers);
            TEST(reached != ABORTED && reached != WRONG);
            stages += reached > most;
            most = reached > most && reached <= ALL ? reached : most;
        }
        /* Everything in the end, and refusals of more than one kind on the way. */
        TEST(most == ALL);
        TEST(stages >= 4);
    }
    snprintf(command, sizeof command, "rm -r %s", folder);
    TEST(system(command) == 0);
    return report_failures("little_memory");
}
