/* A scene with enough work to be shared out: a pad of points and balls over a floor of blocks and a ramp of triangles,
 * the ball of check.h beside it, and a puck with laws of the host's. */
#ifndef CROWD_H
#define CROWD_H

#include "check.h"

enum { CROWD_ROWS = 20, CROWD_TILES = 4, CROWD_PARTS = 5, CROWD_PAIRS = 3 };

typedef struct crowd {
    pong_world *world;
    pong_model_id pad_model, floor_model, ball_model, puck_model;
    pong_object_id pad, floor, ball, puck;
    pong_pair_id pairs[CROWD_PAIRS]; /* of the floor with pad, ball and puck */
    pong_interface_id parts[CROWD_PARTS]; /* pad, ball, its arm, floor, puck */
    pong_seal_report sealed;
} crowd;

#define CROWD_SURFACE                                                                                          \
    " surfaces: {\"felt\": (stiffness: 2e4, normal: Linear(damping: 20), friction: Bristle(mu: 0.4))},\n"

/* 400 points, 5 cm apart, with a ball of 3 cm and an egg among them. */
static inline void write_pad(char *text, size_t size)
{
    int i, n = snprintf(text, size, "(format: \"pong-model\", version: 1, name: \"pad\",\n" CROWD_SURFACE
                        " root: (name: \"pad\", surface: \"felt\", primitives: [\n"
                        "  Sphere(name: \"ball\", center: (0.01, 0.02, 0.029), radius: 0.03),\n"
                        "  Ellipsoid(name: \"egg\", center: (0.21, 0.12, 0.02), semi_axes: (0.04, 0.03, 0.02)),\n");
    for (i = 0; i < CROWD_ROWS * CROWD_ROWS; i += 1) {
        n += snprintf(text + n, size - (size_t)n, "  Point(name: \"p%d\", position: (%.3f, %.3f, 0)),\n", i,
                      0.05 * (i % CROWD_ROWS) - 0.475, 0.05 * (i / CROWD_ROWS) - 0.475);
    }
    snprintf(text + n, size - (size_t)n, " ]))");
}

/* 16 blocks whose tops make a floor of 1.2 m by 1.2 m at height 0, and two triangles that rise from it. */
static inline void write_floor(char *text, size_t size)
{
    int i, n = snprintf(text, size, "(format: \"pong-model\", version: 1, name: \"floor\",\n" CROWD_SURFACE
                        " root: (name: \"floor\", surface: \"felt\", primitives: [\n"
                        "  Triangle(name: \"up\", vertices: ((-0.2, -0.2, 0), (0.3, -0.2, 0), (0, 0.3, 0.001))),\n"
                        "  Triangle(name: \"down\", vertices: ((0.3, -0.2, 0), (0.4, 0.3, 0), (0, 0.3, 0.001))),\n");
    for (i = 0; i < CROWD_TILES * CROWD_TILES; i += 1) {
        double x = 0.3 * (i % CROWD_TILES) - 0.6, y = 0.3 * (i / CROWD_TILES) - 0.6;
        int k;
        n += snprintf(text + n, size - (size_t)n, "  Polyhedron(name: \"b%d\", vertices: [", i);
        for (k = 0; k < 8; k += 1) {
            n += snprintf(text + n, size - (size_t)n, "(%.1f, %.1f, %d), ", x + 0.3 * (((k + 1) / 2) % 2),
                          y + 0.3 * ((k / 2) % 2), k / 4 - 1);
        }
        n += snprintf(text + n, size - (size_t)n, "], faces: [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], "
                      "[2, 3, 7, 6], [3, 0, 4, 7]]),\n");
    }
    snprintf(text + n, size - (size_t)n, " ]))");
}

#define PUCK_MODEL                                                                                    \
    "(format: \"pong-model\", version: 1, name: \"puck\",\n"                                          \
    " surfaces: {\"skin\": (stiffness: 2e4)},\n"                                                     \
    " pairs: [(surfaces: (\"skin\", \"felt\"), normal: Custom(name: \"press\", parameters: [20]),\n"  \
    "          friction: Custom(name: \"drag\", parameters: [300]))],\n"                             \
    " root: (name: \"puck\", surface: \"skin\", primitives: [\n"                                     \
    "  Sphere(name: \"shell\", center: (0, 0, 0), radius: 0.1)]))"

static inline double press(const pong_normal_input *in, void *user)
{
    (void)user;
    return in->stiffness * in->depth + in->parameters[0] * in->depth_rate;
}

/* A spring without a limit; its state is the displacement. */
static inline void drag(const pong_friction_input *in, double *state, pong_friction_output *out, void *user)
{
    int i;
    (void)user;
    for (i = 0; i < 3; i += 1) {
        state[i] += in->slip_b[i];
        out->force_b[i] = -in->share * in->parameters[0] * state[i];
    }
    out->sticks = 1;
}

static inline void open_crowd(crowd *c, const pong_config *config)
{
    static char text[64 * 1024];
    size_t count = 0;
    memset(c, 0, sizeof *c);
    OK(pong_create_world(config, &c->world));
    OK(pong_register_normal_law(c->world, "press", press, NULL, NULL));
    OK(pong_register_friction_law(c->world, "drag", 3, drag, NULL));
    write_pad(text, sizeof text);
    OK(load_text(c->world, text, &c->pad_model));
    write_floor(text, sizeof text);
    OK(load_text(c->world, text, &c->floor_model));
    OK(load_text(c->world, BALL_MODEL, &c->ball_model));
    OK(load_text(c->world, PUCK_MODEL, &c->puck_model));
    OK(pong_create_object(c->world, c->pad_model, "pad", &c->pad));
    OK(pong_create_object(c->world, c->floor_model, "floor", &c->floor));
    OK(pong_create_object(c->world, c->ball_model, "ball", &c->ball));
    OK(pong_create_object(c->world, c->puck_model, "puck", &c->puck));
    OK(pong_pair_objects(c->world, c->pad, c->floor, &c->pairs[0]));
    OK(pong_pair_objects(c->world, c->ball, c->floor, &c->pairs[1]));
    OK(pong_pair_objects(c->world, c->puck, c->floor, &c->pairs[2]));
    OK(pong_find_interface(c->world, c->pad, "", &c->parts[0]));
    OK(pong_list_interfaces(c->world, c->ball, &c->parts[1], 2, &count));
    OK(pong_find_interface(c->world, c->floor, "", &c->parts[3]));
    OK(pong_find_interface(c->world, c->puck, "", &c->parts[4]));
    OK(pong_seal(c->world, &c->sealed));
}

/* States of a frame: the pad slides and comes and goes every 32 frames, 3 mm deep to 1 mm clear; so does the ball, every
 * 20, with the tip of its arm half the time, and the puck. Six frames of
 * 24 all are far above. */
static inline void crowd_states(long frame, pong_state states[CROWD_PARTS])
{
    int i, beat = (int)(frame % 32), ball_beat = (int)(frame % 20);
    for (i = 0; i < CROWD_PARTS; i += 1) {
        states[i] = pong_default_state();
    }
    states[0].position[0] = 1e-4 * (double)(frame % 100);
    states[0].position[2] = 1e-3 - 2.5e-4 * (beat < 16 ? beat : 32 - beat);
    states[0].linear_velocity[0] = 0.1;
    states[0].linear_velocity[2] = beat < 16 ? -0.25 : 0.25;
    states[1].position[1] = 2e-4 * (double)(frame % 50);
    states[1].position[2] = 0.1005 - 1e-4 * ball_beat;
    states[1].linear_velocity[1] = 0.2;
    states[4].position[0] = -0.3 + 1e-4 * (double)(frame % 40);
    states[4].position[2] = 0.1005 - 1e-4 * ball_beat;
    states[2].position[0] = 0.2;
    states[2].position[2] = frame % 40 < 20 ? -0.101 : 0.5;
    for (i = 0; frame % 24 >= 18 && i < CROWD_PARTS; i += 1) {
        states[i].position[2] += i == 3 ? 0.0 : 1.0;
    }
}

#endif
