/* The calls that the other programs do not make: names, user data, contacts, contact state, surfaces, pairs, energies,
 * limits, threads. */
#include "check.h"
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

static void names(scene *s)
{
    const char *text = "";
    uint32_t index = 9, primitives = 0;
    size_t count = 0;
    pong_object_id object;
    pong_state authored;
    OK(pong_object_name(s->world, s->ball, &text));
    TEST(strcmp(text, "ball") == 0);
    OK(pong_find_object(s->world, "ground", &object));
    TEST(object.bits == s->ground.bits);
    OK(pong_interface_path(s->world, s->interfaces[1], &text));
    TEST(strcmp(text, "ball/arm") == 0);
    OK(pong_interface_object(s->world, s->interfaces[1], &object));
    TEST(object.bits == s->ball.bits);
    OK(pong_primitive_count(s->world, s->interfaces[1], &primitives));
    OK(pong_primitive_path(s->world, s->interfaces[1], 0, &text));
    TEST(primitives == 1 && strcmp(text, "ball/arm/tip") == 0);
    OK(pong_find_primitive(s->world, s->interfaces[1], "ball/arm/tip", &index));
    TEST(index == 0);
    REFUSED(pong_find_primitive(s->world, s->interfaces[1], "tip", &index), UNKNOWN_NAME, "known: ball/arm/tip");
    OK(pong_get_authored_state(s->world, s->interfaces[1], &authored));
    TEST(authored.position[2] == 0.5 && authored.orientation[0] == 1.0);
    OK(pong_surface_count(s->world, s->ball_model, &count));
    OK(pong_surface_name(s->world, s->ball_model, 0, &text));
    TEST(count == 1 && strcmp(text, "rubber") == 0);
    OK(pong_model_warning_count(s->world, s->ball_model, &count));
    TEST(count == 0);
}

static void user_data(scene *s)
{
    uint64_t value = 1;
    OK(pong_get_object_user_data(s->world, s->ball, &value));
    TEST(value == 0);
    OK(pong_set_object_user_data(s->world, s->ball, (uint64_t)-2));
    OK(pong_get_object_user_data(s->world, s->ball, &value));
    TEST(value == (uint64_t)-2);
    OK(pong_set_primitive_user_data(s->world, s->interfaces[1], 0, 42));
    OK(pong_get_primitive_user_data(s->world, s->interfaces[1], 0, &value));
    TEST(value == 42);
    OK(pong_get_primitive_user_data(s->world, s->interfaces[0], 0, &value));
    TEST(value == 0);
}

static pong_wrench slide_to(scene *s, double x)
{
    pong_wrench wrench;
    memset(&wrench, 0, sizeof wrench);
    s->states[0].position[0] = x;
    OK(pong_set_states(s->world, s->interfaces, s->states, 3));
    OK(pong_step(s->world));
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_FRAME_COMMON, &wrench));
    return wrench;
}

static void contacts(scene *s)
{
    pong_contact contact;
    pong_wrench wrench = slide_to(s, 0.0);
    pong_state state;
    size_t count = 0;
    int i;
    OK(pong_contact_count(s->world, &count));
    OK(pong_get_contacts(s->world, &contact, 1, &count));
    TEST(count == 1 && contact.pair.bits == s->pair.bits);
    TEST(contact.a.interface.bits == s->interfaces[0].bits && contact.b.object.bits == s->ground.bits);
    TEST(fabs(contact.depth - 1e-3) < 1e-15 && contact.normal[2] == 1.0 && contact.weight == 1.0);
    TEST(contact.feature_kind == PONG_FEATURE_FACE && contact.feature_index == 0 && contact.sticks == 1);
    for (i = 0; i < 3; i += 1) {
        TEST(contact.force[i] == wrench.force[i]);
    }
    OK(pong_get_state(s->world, s->interfaces[0], &state));
    TEST(memcmp(&state, &s->states[0], sizeof state) == 0);
}

/* The ball turned by a quarter about x: what pushes up in the common frame pushes along the ball's own y. */
static void frames(scene *s)
{
    pong_wrench group, common;
    pong_contact contact;
    size_t count;
    int i;
    s->states[0].orientation[0] = s->states[0].orientation[1] = sqrt(0.5);
    OK(pong_forget_object(s->world, s->ball)); /* it was turned, it did not roll */
    slide_to(s, 0.0);
    common = slide_to(s, 1e-4);
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_FRAME_GROUP, &group));
    TEST(fabs(common.force[2] - 10.0) < 1e-9 && common.force[0] < -0.1);
    TEST(fabs(group.force[1] - 10.0) < 1e-9 && fabs(group.force[2]) < 1e-9 && group.force[0] == common.force[0]);
    OK(pong_get_contacts(s->world, &contact, 1, &count));
    for (i = 0; i < 3; i += 1) {
        TEST(contact.friction_force[i] + contact.normal_force * contact.normal[i] == contact.force[i]);
    }
    TEST(contact.friction_force[0] < -0.1 && contact.slip_velocity[0] == 0.0 && contact.rate == 0.0);
    TEST(fabs(contact.a.arm[2] + 0.0995) < 1e-9 && fabs(contact.b.arm[2] + 0.0005) < 1e-9);
    s->states[0].orientation[0] = 1.0;
    s->states[0].orientation[1] = 0.0;
    OK(pong_forget_object(s->world, s->ball));
}

static void contact_state(scene *s)
{
    size_t size = 0;
    unsigned char *saved, *again;
    pong_wrench first, second;
    OK(pong_contact_state_size(s->world, &size));
    saved = malloc(size + 1);
    again = malloc(size);
    slide_to(s, 0.0);
    slide_to(s, 1e-4);
    OK(pong_save_contact_state(s->world, saved, size + 1));
    first = slide_to(s, 2e-4);
    TEST(first.force[0] < -0.5);
    slide_to(s, 0.3);
    OK(pong_restore_contact_state(s->world, saved, size));
    OK(pong_save_contact_state(s->world, again, size));
    TEST(memcmp(saved, again, size) == 0);
    second = slide_to(s, 2e-4);
    TEST(memcmp(&first, &second, sizeof first) == 0);
    REFUSED(pong_save_contact_state(s->world, saved, size - 1), BUFFER_TOO_SMALL, "make it larger");
    REFUSED(pong_save_contact_state(s->world, NULL, size), NULL_ARGUMENT, "`buffer`");
    REFUSED(pong_restore_contact_state(s->world, saved, size - 1), BAD_STATE_BLOCK, "bytes");
    REFUSED(pong_restore_contact_state(s->world, NULL, 0), BAD_STATE_BLOCK, "bytes");
    saved[size / 2] ^= 1;
    REFUSED(pong_restore_contact_state(s->world, saved, size), BAD_STATE_BLOCK, "damaged");
    OK(pong_forget_object(s->world, s->ball));
    TEST(slide_to(s, 5e-4).force[0] == 0.0);
    free(saved);
    free(again);
}

static void surfaces(scene *s)
{
    pong_surface_values values, changed;
    pong_wrench before = slide_to(s, 0.0), after;
    OK(pong_get_surface(s->world, s->ball_model, "rubber", &values));
    TEST(values.normal_law == PONG_NORMAL_LINEAR && values.friction_law == PONG_FRICTION_BRISTLE);
    TEST(values.stiffness == 2e4 && values.damping == 40.0 && values.friction == 0.5);
    changed = values;
    changed.stiffness = INFINITY;
    OK(pong_set_surface(s->world, s->ball_model, "rubber", &changed));
    after = slide_to(s, 0.0);
    TEST(fabs(after.force[2] - 2.0 * before.force[2]) < 1e-9);
    changed.stiffness = -1.0;
    REFUSED(pong_set_surface(s->world, s->ball_model, "rubber", &changed), BAD_VALUE, "`rubber`");
    changed = values;
    changed.damping = NAN;
    REFUSED(pong_set_surface(s->world, s->ball_model, "rubber", &changed), BAD_VALUE, "`rubber`");
    changed = values;
    changed.normal_law = PONG_NORMAL_HUNT_CROSSLEY;
    REFUSED(pong_set_surface(s->world, s->ball_model, "rubber", &changed), BAD_VALUE, "laws may not");
    REFUSED(pong_set_surface(s->world, s->ball_model, "steel", &values), UNKNOWN_NAME, "known: rubber");
    REFUSED(pong_get_surface(s->world, s->ball_model, "rubber", NULL), NULL_ARGUMENT, "`values`");
    OK(pong_set_surface(s->world, s->ball_model, "rubber", &values));
    after = slide_to(s, 0.0);
    TEST(memcmp(&before, &after, sizeof after) == 0);
}

static void pairs_and_rates(scene *s)
{
    size_t count = 9;
    OK(pong_set_pair_enabled(s->world, s->pair, 0));
    TEST(slide_to(s, 0.0).force[2] == 0.0);
    OK(pong_contact_count(s->world, &count));
    TEST(count == 0);
    OK(pong_set_pair_enabled(s->world, s->pair, 1));
    slide_to(s, 0.0);
    s->states[0].position[0] = 1e-4;
    OK(pong_set_states(s->world, s->interfaces, s->states, 3));
    OK(pong_commit_pairs(s->world, &s->pair, 1));
    TEST(slide_to(s, 1e-4).force[0] < -0.1);
}

static void energies_and_limits(void)
{
    scene s;
    pong_config config = pong_default_config();
    pong_seal_report sealed;
    pong_report report;
    pong_ledger ledger;
    config.keep_ledger = 1;
    config.contact_capacity = 1;
    open_scene(&s, &config);
    OK(pong_seal(s.world, &sealed));
    TEST(sealed.group_pairs == 2 && sealed.contact_capacity == 1 && sealed.warning_count == 0);
    s.states[1].position[2] = -0.105; /* the tip of the arm, 5 mm deep; deeper than the ball */
    OK(pong_set_states(s.world, s.interfaces, s.states, 3));
    OK(pong_step(s.world));
    OK(pong_get_report(s.world, &report));
    TEST(report.flags == PONG_FLAG_CONTACT_LIMIT && report.contacts == 1 && report.contacts_wanted == 2);
    TEST(report.peak_contacts_wanted == 2 && report.evaluations == 1 && report.commits == 1);
    OK(pong_get_ledger(s.world, &ledger));
    TEST(fabs(ledger.stored - 0.5 * 1e4 * 0.005 * 0.005) < 1e-9);
    OK(pong_destroy_world(s.world));
}

static void *another_thread(void *world)
{
    TEST(pong_last_message()[0] == '\0');
    REFUSED(pong_find_object(world, "from the other thread", NULL), NULL_ARGUMENT, "`object`");
    return NULL;
}

static void threads(scene *s)
{
    pthread_t thread;
    pong_object_id object;
    REFUSED(pong_find_object(s->world, "moon", &object), UNKNOWN_NAME, "`moon`");
    pthread_create(&thread, NULL, another_thread, s->world);
    pthread_join(thread, NULL);
    TEST(strstr(pong_last_message(), "`moon`") != NULL);
}

int main(void)
{
    scene s;
    pong_config config = pong_default_config();
    open_scene(&s, &config);
    seal_scene(&s);
    names(&s);
    user_data(&s);
    contacts(&s);
    frames(&s);
    contact_state(&s);
    surfaces(&s);
    pairs_and_rates(&s);
    threads(&s);
    OK(pong_destroy_world(s.world));
    energies_and_limits();
    return report_failures("calls");
}
