/* Restores a contact state many times (ci/readers): readers MODEL BALLS TIMES presses the model, so many balls in a row, 1 mm
 * into a plane, saves the contacts, and restores them TIMES times. */
#include "check.h"

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
    OK(pong_create_world(&config, &world));
    OK(pong_load_model(world, argv[1], &models[0]));
    OK(load_text(world, GROUND_MODEL, &models[1]));
    OK(pong_create_object(world, models[0], "balls", &objects[0]));
    OK(pong_create_object(world, models[1], "ground", &objects[1]));
    for (int k = 0; k < 2; k++)
        OK(pong_find_interface(world, objects[k], "", &roots[k]));
    OK(pong_pair_by_name(world, "balls", "ground", NULL));
    OK(pong_seal(world, NULL));

    pong_state states[2] = { pong_default_state(), pong_default_state() };
    states[0].position[2] = 0.039;
    OK(pong_set_states(world, roots, states, 2));
    OK(pong_step(world));
    size_t held = 0, size = 0;
    (void)pong_get_contacts(world, NULL, 0, &held);
    OK(pong_contact_state_used(world, &size));
    void *block = malloc(size);
    OK(pong_save_contact_state(world, block, size));
    for (int turn = atoi(argv[3]); turn > 0; turn--)
        OK(pong_restore_contact_state(world, block, size));
    free(block);
    OK(pong_destroy_world(world));
    TEST(held == (size_t)atoi(argv[2]));
    return report_failures("readers");
}
