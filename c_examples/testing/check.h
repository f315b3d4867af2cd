/* Shared parts of the test programs: checks that report their location, and a small scene. */
#ifndef CHECK_H
#define CHECK_H

#include <pong.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

/* One cause may show in every frame; twenty lines of it are enough. */
static void fail(void)
{
    failures += 1;
    if (failures == 20) {
        fprintf(stderr, "and so on\n");
        exit(1);
    }
}

#define TEST(condition) test((condition) ? 1 : 0, #condition, __FILE__, __LINE__)
#define OK(call) expect((call), PONG_STATUS_OK, "", #call, __FILE__, __LINE__)
/* The call is refused with this status, and the message holds this text. */
#define REFUSED(call, status, text) expect((call), PONG_STATUS_##status, text, #call, __FILE__, __LINE__)

static void test(int holds, const char *what, const char *file, int line)
{
    if (!holds) {
        fprintf(stderr, "%s:%d: not so: %s\n", file, line, what);
        fail();
    }
}

static void expect(pong_status got, pong_status wanted, const char *text, const char *what, const char *file, int line)
{
    const char *message = pong_last_message();
    int said = wanted == PONG_STATUS_OK ? message[0] == '\0' : message[0] != '\0' && strstr(message, text) != NULL;
    if (got != wanted || !said) {
        fprintf(stderr, "%s:%d: %s\n  got %s, wanted %s with \"%s\"\n  message: %s\n", file, line, what,
                pong_status_name(got), pong_status_name(wanted), text, message);
        fail();
    }
}

/* A ball with an arm that carries a tip, over a ground with one surface of its own. */
#define BALL_MODEL                                                                                    \
    "(format: \"pong-model\", version: 1, name: \"ball\",\n"                                          \
    " surfaces: {\"rubber\": (stiffness: 2e4, normal: Linear(damping: 40), friction: Bristle(mu: 0.5))},\n" \
    " root: (name: \"ball\", surface: \"rubber\", groups: [\n"                                        \
    "  (name: \"body\", primitives: [Sphere(name: \"shell\", center: (0, 0, 0), radius: 0.1)]),\n"    \
    "  (name: \"arm\", movable: true, pose: (position: (0, 0, 0.5)),\n"                               \
    "   primitives: [Point(name: \"tip\", position: (0, 0, 0.1))])]))"
#define GROUND_MODEL                                                                                  \
    "(format: \"pong-model\", version: 1, name: \"ground\",\n"                                        \
    " surfaces: {\"rubber\": (stiffness: 2e4, normal: Linear(damping: 40), friction: Bristle(mu: 0.5))},\n" \
    " root: (name: \"ground\", surface: \"rubber\",\n"                                                \
    "  primitives: [Plane(name: \"floor\", normal: (0, 0, 1), offset: 0)]))"

typedef struct scene {
    pong_world *world;
    pong_model_id ball_model, ground_model;
    pong_object_id ball, ground;
    pong_pair_id pair;
    /* Ball, its arm, ground. */
    pong_interface_id interfaces[3];
    pong_state states[3];
} scene;

static inline pong_status load_text(pong_world *world, const char *text, pong_model_id *model)
{
    return pong_load_model_text(world, text, strlen(text), "text", NULL, model);
}

/* Everything but the seal. */
static inline void open_scene(scene *s, const pong_config *config)
{
    size_t count = 0;
    memset(s, 0, sizeof *s);
    OK(pong_create_world(config, &s->world));
    OK(load_text(s->world, BALL_MODEL, &s->ball_model));
    OK(load_text(s->world, GROUND_MODEL, &s->ground_model));
    OK(pong_create_object(s->world, s->ball_model, "ball", &s->ball));
    OK(pong_create_object(s->world, s->ground_model, "ground", &s->ground));
    OK(pong_pair_objects(s->world, s->ball, s->ground, &s->pair));
    OK(pong_list_interfaces(s->world, s->ball, s->interfaces, 2, &count));
    TEST(count == 2);
    OK(pong_find_interface(s->world, s->ground, "", &s->interfaces[2]));
    s->states[0] = s->states[1] = s->states[2] = pong_default_state();
    s->states[0].position[2] = 0.099;
    s->states[1].position[2] = 0.599;
}

static inline void seal_scene(scene *s)
{
    OK(pong_seal(s->world, NULL));
    OK(pong_set_states(s->world, s->interfaces, s->states, 3));
}

static inline int report_failures(const char *program)
{
    if (failures == 0) {
        printf("%s: passed\n", program);
    }
    return failures == 0 ? 0 : 1;
}

#endif
