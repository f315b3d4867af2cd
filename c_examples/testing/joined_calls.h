/* Models joined of files. A program that includes this defines _XOPEN_SOURCE for mkdtemp. */
#ifndef JOINED_CALLS_H
#define JOINED_CALLS_H

#include "check.h"
#include <math.h>
#include <unistd.h>

/* Two slabs of one file, which share no vertex, become one model: a ball on their seam has the force of one surface, and
 * twice that if the model does not declare one. */
static inline void joined_models(void)
{
    static const char slab[] = "(format: \"pong-model\", version: 1, name: \"slab\", surfaces: {\"rough\": (stiffness: inf)},\n"
        " root: (name: \"slab\", surface: \"rough\", primitives: [TriangleMesh(name: \"top\",\n"
        "  vertices: [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], triangles: [(0, 1, 2), (0, 2, 3)])]))";
    static const double poses[2][7] = { { -1, 0, 0, 1, 0, 0, 0 }, { 1, 0.5, 0, 0, 0, 0, 1 } };
    char folder[] = "/tmp/pong_joined_XXXXXX", path[64];
    const char *paths[2] = { path, path };
    pong_config config = pong_default_config();
    double forces[2] = { 0.0, 0.0 };
    FILE *file;
    int one_surface;
    TEST(mkdtemp(folder) != NULL);
    snprintf(path, sizeof path, "%s/slab.ron", folder);
    file = fopen(path, "w");
    TEST(file != NULL && fputs(slab, file) >= 0 && fclose(file) == 0);
    for (one_surface = 0; one_surface < 2; one_surface += 1) {
        pong_world *world = NULL;
        pong_model_id models[2];
        pong_object_id objects[2];
        pong_interface_id roots[2];
        pong_state states[2];
        pong_wrench wrench;
        const char *text = "";
        int i;
        OK(pong_create_world(&config, &world));
        OK(load_text(world, BALL_MODEL, &models[0]));
        OK(pong_load_joined_models(world, paths, poses, 2, "floor", one_surface, &models[1]));
        OK(pong_create_object(world, models[0], "ball", &objects[0]));
        OK(pong_create_object(world, models[1], "floor", &objects[1]));
        OK(pong_pair_objects(world, objects[0], objects[1], NULL));
        for (i = 0; i < 2; i += 1) {
            OK(pong_find_interface(world, objects[i], "", &roots[i]));
            states[i] = pong_default_state();
        }
        OK(pong_primitive_path(world, roots[1], 1, &text));
        TEST(strcmp(text, "floor/slab_2/top") == 0);
        OK(pong_seal(world, NULL));
        states[0].position[1] = 0.2;
        states[0].position[2] = 0.099;
        OK(pong_set_states(world, roots, states, 2));
        {
            pong_interface_id arm;
            pong_state far = pong_default_state();
            far.position[2] = 9.0;
            OK(pong_find_interface(world, objects[0], "arm", &arm));
            OK(pong_set_states(world, &arm, &far, 1));
        }
        OK(pong_step(world));
        OK(pong_get_wrench(world, roots[0], PONG_REFERENCE_FRAME_GROUP, &wrench));
        forces[one_surface] = wrench.force[2];
        OK(pong_destroy_world(world));
    }
    TEST(fabs(forces[1] - 20.0) < 1e-9 && fabs(forces[0] - 40.0) < 1e-9);
    TEST(remove(path) == 0 && rmdir(folder) == 0);
}

#endif
