/* Restores a contact state many times (ci/readers): readers MODEL BALLS TIMES presses the model, so many balls in a row, 1 mm
 * into a plane, saves the contacts, and restores them TIMES times. */
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

static const char ground[] = "(format: \"pong-model\", version: 1, name: \"ground\", surfaces: {\"s\": (stiffness: 1e6)}, "
    "root: (name: \"ground\", surface: \"s\", primitives: [Plane(name: \"p\", normal: (0, 0, 1), offset: 0)]))";

int main(int argc, char **argv)
{
    if (argc != 4)
        return 2;
    pong_config config = pong_default_config();
    config.contact_capacity = 200000;
    pong_world *world;
    pong_model_id models[2];
    pong_object_id objects[2];
    pong_interface_id roots[2];
    CHECK(pong_create_world(&config, &world));
    CHECK(pong_load_model(world, argv[1], &models[0]));
    CHECK(pong_load_model_text(world, ground, strlen(ground), "ground", NULL, &models[1]));
    CHECK(pong_create_object(world, models[0], "balls", &objects[0]));
    CHECK(pong_create_object(world, models[1], "ground", &objects[1]));
    for (int k = 0; k < 2; k++)
        CHECK(pong_find_interface(world, objects[k], "", &roots[k]));
    CHECK(pong_pair_by_name(world, "balls", "ground", NULL));
    CHECK(pong_seal(world, NULL));

    pong_state states[2] = { pong_default_state(), pong_default_state() };
    states[0].position[2] = 0.039;
    CHECK(pong_set_states(world, roots, states, 2));
    CHECK(pong_step(world));
    size_t held = 0, size = 0;
    (void)pong_get_contacts(world, NULL, 0, &held);
    CHECK(pong_contact_state_used(world, &size));
    void *block = malloc(size);
    CHECK(pong_save_contact_state(world, block, size));
    for (int turn = atoi(argv[3]); turn > 0; turn--)
        CHECK(pong_restore_contact_state(world, block, size));
    free(block);
    CHECK(pong_destroy_world(world));
    if (held != (size_t)atoi(argv[2])) {
        fprintf(stderr, "%zu contacts are held\n", held);
        return 1;
    }
    return 0;
}
