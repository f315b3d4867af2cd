/* From nothing to the first wrench: a rubber ball of 0.1 m radius pressed 1 mm into the ground.
 *
 *     cc -std=c99 minimal.c -I../include -L../target/debug -lpong -o minimal
 */
#include <pong.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(call)                                                                                 \
    do {                                                                                            \
        pong_status status = (call);                                                                \
        if (status != PONG_STATUS_OK) {                                                             \
            fprintf(stderr, "%s: %s\n%s\n", #call, pong_status_name(status), pong_last_message());  \
            exit(1);                                                                                \
        }                                                                                           \
    } while (0)

/* Each of the two surfaces has 20 kN/m; in series the pair has 10 kN/m. */
#define HEAD "(format: \"pong-model\", version: 1, surfaces: {\"rubber\": (stiffness: 2e4)}, "
static const char ball_model[] = HEAD "name: \"ball\", root: (name: \"ball\", surface: \"rubber\", "
    "primitives: [Sphere(name: \"shell\", center: (0, 0, 0), radius: 0.1)]))";
static const char ground_model[] = HEAD "name: \"ground\", root: (name: \"ground\", surface: \"rubber\", "
    "primitives: [Plane(name: \"floor\", normal: (0, 0, 1), offset: 0)]))";

static pong_interface_id create(pong_world *world, const char *text, const char *name)
{
    pong_model_id model;
    pong_object_id object;
    pong_interface_id root;
    CHECK(pong_load_model_text(world, text, strlen(text), name, NULL, &model));
    CHECK(pong_create_object(world, model, name, &object));
    CHECK(pong_find_interface(world, object, "", &root));
    return root;
}

int main(void)
{
    pong_config config = pong_default_config();
    pong_world *world;
    CHECK(PONG_CHECK_ABI());
    CHECK(pong_create_world(&config, &world));
    pong_interface_id roots[2] = { create(world, ball_model, "ball"), create(world, ground_model, "ground") };
    CHECK(pong_pair_by_name(world, "ball", "ground", NULL));
    CHECK(pong_seal(world, NULL));

    pong_state states[2] = { pong_default_state(), pong_default_state() };
    pong_wrench wrenches[2];
    states[0].position[2] = 0.099;
    CHECK(pong_set_states(world, roots, states, 2));
    CHECK(pong_step(world));
    CHECK(pong_get_wrenches(world, roots, PONG_REFERENCE_FRAME_COMMON, wrenches, 2));
    printf("force on the ball: %.3f N up\n", wrenches[0].force[2]);
    CHECK(pong_destroy_world(world));
    return 0;
}
