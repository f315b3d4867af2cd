/* Nanoseconds of a frame through the C interface: set states of two Objects, step, read wrenches. Compared
 * with frame.py. */
#include "pong.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define CHECK(call)                                                                                                    \
    do {                                                                                                               \
        if ((call) != PONG_STATUS_OK) {                                                                                       \
            fprintf(stderr, "%s: %s\n", #call, pong_last_message());                                                     \
            exit(1);                                                                                                   \
        }                                                                                                              \
    } while (0)

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

/* MODEL_A MODEL_B HEIGHT FRAMES: best of ten runs of FRAMES frames, A above B. */
int main(int count, char **arguments) {
    if (count != 5)
        return 2;
    pong_config config = pong_default_config();
    pong_world *world;
    pong_model_id model;
    pong_object_id objects[2];
    pong_interface_id roots[2];
    pong_state states[2] = {{.orientation = {1, 0, 0, 0}}, {.orientation = {1, 0, 0, 0}}};
    pong_wrench wrenches[2];
    const char *names[2] = {"a", "b"};
    CHECK(pong_create_world(&config, &world));
    for (int i = 0; i < 2; i++) {
        CHECK(pong_load_model(world, arguments[1 + i], &model));
        CHECK(pong_create_object(world, model, names[i], &objects[i]));
        CHECK(pong_find_interface(world, objects[i], "", &roots[i]));
    }
    CHECK(pong_pair_by_name(world, "a", "b", NULL));
    CHECK(pong_seal(world, NULL));
    const int frames = atoi(arguments[4]);
    double best = 1e300;
    for (int repeat = 0; repeat < 10; repeat++) {
        double begin = now();
        for (int frame = 0; frame < frames; frame++) {
            /* A different state in each frame: setting the same one again costs nothing. */
            states[0].position[2] = atof(arguments[3]) + 1e-9 * (frame % 1000);
            CHECK(pong_set_states(world, roots, states, 2));
            CHECK(pong_step(world));
            CHECK(pong_get_wrenches(world, roots, PONG_REFERENCE_FRAME_COMMON, wrenches, 2));
        }
        double took = (now() - begin) / frames;
        best = took < best ? took : best;
    }
    printf("%.0f %.17g\n", best, wrenches[0].force[2]);
    pong_destroy_world(world);
    return 0;
}
