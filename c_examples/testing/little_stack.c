/* A host whose threads have little stack: set-up and frames keep to half of what docs/c_api.md says that they need, "Stack".
 * Each stage runs on a thread whose stack was painted before, and the paint that is left tells how much it took. */
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#include "crowd.h"

#include <pthread.h>
#include <sys/mman.h>

enum {
    STACK = 1024 * 1024,
    PAINT = 0xA5,
    /* Half of what the manual tells hosts to give: bytes. */
    FRAMES_MOST = 64 * 1024,
    MODELS_MOST = 256 * 1024,
    KINDS = 12,
    /* Movable groups of an Object: its root and one of each kind. */
    BODIES = KINDS + 1
};

static const char *const KIND_TEXTS[KINDS] = {
    "Point(name: \"p\", position: (0, 0, 0))",
    "LineSegment(name: \"p\", ends: ((-0.1, 0, 0), (0.1, 0.02, 0.01)))",
    "Ray(name: \"p\", origin: (0, 0, 0.05), direction: (0.1, 0, -1), length: 0.1)",
    "Sphere(name: \"p\", center: (0, 0, 0), radius: 0.05)",
    "Ellipsoid(name: \"p\", center: (0, 0, 0), semi_axes: (0.05, 0.06, 0.04))",
    "Triangle(name: \"p\", vertices: ((-0.1, -0.1, 0), (0.1, -0.1, 0), (0, 0.1, 0.001)), thickness: 0.05)",
    "Polyhedron(name: \"p\", vertices: [(-0.1, -0.1, -0.1), (0.1, -0.1, -0.1), (0, 0.1, -0.1), (0, 0, 0.02)],"
    " faces: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])",
    "Plane(name: \"p\", normal: (0.1, 0, 1), offset: 0)",
    "Capsule(name: \"p\", ends: ((0, 0, 0), (0.1, 0, 0)), radius: 0.04)",
    "Cylinder(name: \"p\", ends: ((0, 0, 0), (0, 0, 0.1)), radius: 0.04)",
    "Cone(name: \"p\", ends: ((0, 0, 0), (0, 0, 0.1)), radii: (0.04, 0.01))",
    "Bore(name: \"p\", ends: ((0, 0, 0), (0, 0, -0.1)), radii: (0.045, 0.045))",
};

/* A body of every kind, with so many primitives each. */
static void write_kinds(char *text, size_t size, int each)
{
    int i, k, n = snprintf(text, size, "(format: \"pong-model\", version: 1, name: \"kinds\",\n" CROWD_SURFACE
                           " root: (name: \"kinds\", surface: \"felt\", groups: [\n");
    for (i = 0; i < KINDS; i += 1) {
        n += snprintf(text + n, size - (size_t)n, "  (name: \"k%d\", movable: true, groups: [\n", i);
        for (k = 0; k < each; k += 1) {
            n += snprintf(text + n, size - (size_t)n,
                          "   (name: \"g%d\", pose: (position: (0.00%d, 0, 0)), primitives: [%s]),\n", k, k, KIND_TEXTS[i]);
        }
        n += snprintf(text + n, size - (size_t)n, "  ]),\n");
    }
    snprintf(text + n, size - (size_t)n, " ]))");
}

/* Groups in groups, as deep as texts may be. */
static void write_deep(char *text, size_t size)
{
    int i, depth = 61, n = snprintf(text, size, "(format: \"pong-model\", version: 1, name: \"deep\",\n" CROWD_SURFACE
                                    " root: (name: \"deep\", surface: \"felt\", ");
    for (i = 0; i < depth; i += 1) {
        n += snprintf(text + n, size - (size_t)n, "groups: [(name: \"g%d\", ", i);
    }
    n += snprintf(text + n, size - (size_t)n, "primitives: [Point(name: \"p\", position: (0, 0, 0))]");
    for (i = 0; i < depth; i += 1) {
        n += snprintf(text + n, size - (size_t)n, ")]");
    }
    snprintf(text + n, size - (size_t)n, "))");
}

/* Data shared by the stages. */
typedef struct run {
    crowd crowd;
    pong_world *kinds;
    pong_interface_id bodies[2 * BODIES];
    size_t touching;
    unsigned char *block;
    size_t block_size;
} run;

static void load_deep(run *r)
{
    static char text[16 * 1024];
    pong_model_id model;
    write_deep(text, sizeof text);
    OK(load_text(r->kinds, text, &model));
}

static void load_kinds(run *r)
{
    static char text[64 * 1024];
    pong_model_id models[2];
    pong_object_id objects[2];
    size_t count;
    write_kinds(text, sizeof text, 1);
    OK(load_text(r->kinds, text, &models[0]));
    write_kinds(text, sizeof text, 10);
    OK(load_text(r->kinds, text, &models[1]));
    OK(pong_create_object(r->kinds, models[0], "one", &objects[0]));
    OK(pong_create_object(r->kinds, models[1], "ten", &objects[1]));
    OK(pong_pair_objects(r->kinds, objects[0], objects[0], NULL));
    OK(pong_pair_objects(r->kinds, objects[0], objects[1], NULL));
    OK(pong_list_interfaces(r->kinds, objects[0], r->bodies, BODIES, &count));
    TEST(count == BODIES);
    OK(pong_list_interfaces(r->kinds, objects[1], r->bodies + BODIES, BODIES, &count));
    TEST(count == BODIES);
}

/* Worlds and their models. */
static void set_up(run *r)
{
    pong_config config = pong_default_config();
    config.contact_capacity = 4096;
    OK(pong_create_world(&config, &r->kinds));
    load_kinds(r);
    config.workers = 1;
    config.oversubscribe = 1;
    open_crowd(&r->crowd, &config);
}

static void seal(run *r)
{
    pong_world *clone;
    OK(pong_seal(r->kinds, NULL));
    OK(pong_clone_world(r->kinds, &clone));
    OK(pong_destroy_world(clone));
    OK(pong_contact_state_size(r->kinds, &r->block_size));
    r->block = malloc(r->block_size);
}

/* Everything within everything, in another way each time. */
static void place(run *r, int frame)
{
    int i;
    for (i = 0; i < 2 * BODIES; i += 1) {
        pong_state state = pong_default_state();
        double turn = 0.3 * i + 0.05 * frame, scale = 1 / (1 + turn * turn);
        state.position[0] = 0.03 * ((i * 7 + frame) % 5 - 2);
        state.position[1] = 0.03 * ((i * 5 + frame) % 7 - 3);
        state.position[2] = 0.02 * ((i * 3 + frame) % 5 - 2);
        state.orientation[0] = scale * (1 - turn * turn);
        state.orientation[1] = scale * 2 * turn * 0.6;
        state.orientation[3] = scale * 2 * turn * 0.8;
        OK(pong_set_state(r->kinds, r->bodies[i], &state));
    }
}

static void frames(run *r)
{
    int frame;
    for (frame = 0; frame < 40; frame += 1) {
        pong_state states[CROWD_PARTS];
        pong_wrench wrench;
        pong_report report;
        size_t count;
        place(r, frame);
        OK(pong_evaluate(r->kinds));
        OK(pong_step(r->kinds));
        OK(pong_get_report(r->kinds, &report));
        OK(pong_get_wrench(r->kinds, r->bodies[0], PONG_REFERENCE_FRAME_COMMON, &wrench));
        OK(pong_contact_count(r->kinds, &count));
        r->touching += count;
        OK(pong_save_contact_state(r->kinds, r->block, r->block_size));
        OK(pong_restore_contact_state(r->kinds, r->block, r->block_size));
        crowd_states(frame, states);
        OK(pong_set_states(r->crowd.world, r->crowd.parts, states, CROWD_PARTS));
        OK(pong_prewake(r->crowd.world, 100));
        OK(pong_step(r->crowd.world));
    }
}

static void end(run *r)
{
    OK(pong_destroy_world(r->crowd.world));
    OK(pong_destroy_world(r->kinds));
}

typedef struct stage {
    void (*work)(run *);
    run *with;
} stage;

static void *run_stage(void *argument)
{
    const stage *s = argument;
    s->work(s->with);
    return NULL;
}

/* Runs a stage on a thread of its own; answers the bytes of stack that were written to, the thread's own included. */
static size_t stack_of(void (*work)(run *), run *r)
{
    stage s;
    pthread_attr_t attributes;
    pthread_t thread;
    size_t left = 0;
    unsigned char *stack = mmap(NULL, STACK, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    TEST(stack != MAP_FAILED);
    memset(stack, PAINT, STACK);
    s.work = work;
    s.with = r;
    TEST(pthread_attr_init(&attributes) == 0);
    TEST(pthread_attr_setstack(&attributes, stack, STACK) == 0);
    TEST(pthread_create(&thread, &attributes, run_stage, &s) == 0);
    TEST(pthread_join(thread, NULL) == 0);
    pthread_attr_destroy(&attributes);
    while (left < STACK && stack[left] == PAINT) {
        left += 1;
    }
    munmap(stack, STACK);
    return STACK - left;
}

int main(void)
{
    static run r;
    size_t loading, deep, sealing, framing, ending;
    loading = stack_of(set_up, &r);
    deep = stack_of(load_deep, &r);
    sealing = stack_of(seal, &r);
    framing = stack_of(frames, &r);
    ending = stack_of(end, &r);
    printf("stack, KiB: models %zu, the deepest text %zu, seal and clone %zu, frames %zu, end %zu\n", loading / 1024,
           deep / 1024, sealing / 1024, framing / 1024, ending / 1024);
    printf("contacts in 40 frames: %zu\n", r.touching);
    TEST(r.touching > 1000);
    TEST(deep <= MODELS_MOST && loading <= MODELS_MOST);
    TEST(sealing <= FRAMES_MOST && framing <= FRAMES_MOST && ending <= FRAMES_MOST);
    free(r.block);
    return report_failures("little_stack");
}
