/* Objects that arrive in a run and leave it: worlds that go on where another one is. */
#include "check.h"

static pong_wrench slide_to(scene *s, double x)
{
    pong_wrench wrench;
    memset(&wrench, 0, sizeof wrench);
    s->states[0].position[0] = x;
    OK(pong_set_states(s->world, s->interfaces, s->states, 3));
    OK(pong_step(s->world));
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &wrench));
    return wrench;
}

/* Numbers that no continuation has. */
static pong_continuation unset_continuation(void)
{
    pong_continuation unset;
    memset(&unset, 0x55, sizeof unset);
    return unset;
}

/* A ball and its arm arrive on the ground on which the first ball slides; then the first goes. */
static void arrivals(scene *s)
{
    pong_world *larger = NULL, *smaller = NULL;
    pong_object_id arrived, alone, object;
    pong_pair_id pair;
    pong_interface_id new_ball[2];
    pong_state places[2];
    pong_wrench mine, its;
    pong_continuation went_on = unset_continuation();
    pong_model_id model;
    pong_config config = pong_default_config();
    uint64_t value = 0;
    size_t count, i;
    memset(&its, 0, sizeof its);
    OK(pong_set_object_user_data(s->world, s->ball, 7));
    slide_to(s, 0.0);
    OK(pong_extend_world(s->world, &larger));
    REFUSED(pong_continue_from(larger, s->world, NULL), WRONG_PHASE, "seal the world first");
    OK(pong_create_object(larger, s->ball_model, "second", &arrived));
    OK(pong_pair_objects(larger, s->ground, arrived, &pair));
    OK(pong_seal(larger, NULL));
    /* The run goes on until the new world is there. */
    slide_to(s, 1e-4);
    OK(pong_continue_from(larger, s->world, &went_on));
    TEST(went_on.objects == 2 && went_on.pairs == 1 && went_on.contacts > 0);
    TEST(went_on.objects_left == 0 && went_on.pairs_left == 0 && went_on.energy_left == 0.0 && went_on.reserved[3] == 0);
    REFUSED(pong_get_wrench(larger, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &its), WRONG_PHASE, "evaluate");
    OK(pong_get_object_user_data(larger, s->ball, &value));
    TEST(value == 7);
    OK(pong_list_interfaces(larger, arrived, new_ball, 2, &count));
    for (i = 0; i < 2; i += 1) {
        places[i] = s->states[i];
        places[i].position[1] += 5.0;
    }
    for (i = 2; i < 20; i += 1) {
        mine = slide_to(s, 1e-4 * (double)i);
        OK(pong_set_states(larger, s->interfaces, s->states, 3));
        OK(pong_set_states(larger, new_ball, places, 2));
        OK(pong_step(larger));
        OK(pong_get_wrench(larger, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &its));
        TEST(memcmp(&mine, &its, sizeof mine) == 0 && mine.force[0] != 0.0);
        OK(pong_get_wrench(larger, new_ball[0], PONG_REFERENCE_FRAME_COMMON, &its));
        TEST(its.force[0] == 0.0 && its.force[2] > 0.0);
    }
    REFUSED(pong_get_wrench(s->world, new_ball[0], PONG_REFERENCE_FRAME_COMMON, &its), UNKNOWN_ID, "interface");

    /* A world of its own, without the first ball. */
    OK(pong_create_world(&config, &smaller));
    OK(load_text(smaller, GROUND_MODEL, &model));
    OK(pong_create_object(smaller, model, "ground", &alone));
    OK(load_text(smaller, BALL_MODEL, &model));
    OK(pong_create_object(smaller, model, "second", &object));
    OK(pong_pair_objects(smaller, alone, object, &pair));
    OK(pong_seal(smaller, NULL));
    went_on = unset_continuation();
    OK(pong_continue_from(smaller, larger, &went_on));
    TEST(went_on.objects == 2 && went_on.objects_left == 1 && went_on.pairs_left == 1 && went_on.contacts_left > 0);
    TEST(went_on.energy_left > 0.0);
    REFUSED(pong_continue_from(smaller, smaller, NULL), BAD_VALUE, "`from` is the world itself");
    REFUSED(pong_continue_from(smaller, NULL, NULL), NULL_ARGUMENT, "`from` is NULL");
    REFUSED(pong_continue_from(NULL, smaller, NULL), NULL_ARGUMENT, "`world` is NULL");
    OK(pong_evaluate(larger));
    REFUSED(pong_continue_from(smaller, larger, NULL), WRONG_PHASE, "commit the frame");
    OK(pong_commit(larger));
    OK(pong_destroy_world(smaller));

    /* Another thing under the same name. */
    OK(pong_create_world(&config, &smaller));
    OK(load_text(smaller, BALL_MODEL, &model));
    OK(pong_create_object(smaller, model, "ground", &object));
    OK(pong_seal(smaller, NULL));
    REFUSED(pong_continue_from(smaller, s->world, NULL), BAD_VALUE, "object `ground`");
    OK(pong_destroy_world(smaller));
    OK(pong_destroy_world(larger));
    REFUSED(pong_extend_world(s->world, NULL), NULL_ARGUMENT, "`extended`");
    REFUSED(pong_extend_world(NULL, &larger), NULL_ARGUMENT, "`world`");
    TEST(larger == NULL);
    OK(pong_set_object_user_data(s->world, s->ball, 0));
}

int main(void)
{
    scene s;
    pong_config config = pong_default_config();
    open_scene(&s, &config);
    seal_scene(&s);
    arrivals(&s);
    OK(pong_destroy_world(s.world));
    return report_failures("arrivals");
}
