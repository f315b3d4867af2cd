/* The calls that the other programs do not make: names, user data, contacts, contact state, clones, surfaces, pairs, energies,
 * limits, report, workers, threads, models joined of files. */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "crowd.h"
#include "joined_calls.h"
#include "pair_calls.h"
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

static void contacts(scene *s)
{
    pong_contact contact;
    pong_wrench wrench = slide_to(s, 0.0);
    pong_state state;
    pong_contact_tangent tangent;
    double stiffness, damping;
    size_t count = 0;
    int i;
    OK(pong_contact_count(s->world, &count));
    OK(pong_get_contacts(s->world, &contact, 1, &count));
    TEST(count == 1 && contact.pair.bits == s->pair.bits);
    TEST(contact.a.interface.bits == s->interfaces[0].bits && contact.b.object.bits == s->ground.bits);
    TEST(fabs(contact.depth - 1e-3) < 1e-15 && contact.normal[2] == 1.0 && contact.weight == 1.0);
    TEST(contact.feature_kind == PONG_FEATURE_FACE && contact.feature_index == 0 && contact.sticks == 1);
    OK(pong_get_contact_stiffness(s->world, &stiffness, &damping, 1, &count));
    TEST(count == 1 && fabs(stiffness * contact.depth - contact.normal_force) < 1e-9 && damping >= 0.0);
    OK(pong_get_contact_tangents(s->world, &tangent, 1, &count));
    TEST(count == 1 && tangent.normal_stiffness == stiffness && tangent.normal_damping == damping);
    TEST(tangent.tangential_stiffness > 0.0 && tangent.tangential_damping >= 0.0);
    for (i = 0; i < 3; i += 1) {
        TEST(contact.force[i] == wrench.force[i]);
    }
    OK(pong_get_state(s->world, s->interfaces[0], &state));
    TEST(memcmp(&state, &s->states[0], sizeof state) == 0);
}

/* A ball of 10 kN/m on a plane: up against up on both groups, and the same by differences. */
static void tangents(scene *s)
{
    pong_tangent tangent, differences;
    pong_wrench before = slide_to(s, 0.0), after;
    size_t count = 7, k;
    REFUSED(pong_get_tangents(s->world, &tangent, 1, &count), WRONG_PHASE, "before it is committed");
    REFUSED(pong_get_tangents_by_differences(s->world, &tangent, 1, &count), WRONG_PHASE, "before it is committed");
    OK(pong_evaluate(s->world));
    OK(pong_get_tangents(s->world, &tangent, 1, &count));
    TEST(count == 1 && tangent.interfaces[0].bits == s->interfaces[0].bits);
    TEST(tangent.interfaces[1].bits == s->interfaces[2].bits);
    for (k = 0; k < 4; k += 1) {
        TEST(fabs(tangent.stiffness[k / 2][k % 2][6 * 2 + 2] - (k / 2 == k % 2 ? 1e4 : -1e4)) < 1e-6);
    }
    OK(pong_get_tangents_by_differences(s->world, &differences, 1, &count));
    for (k = 0; k < 144; k += 1) {
        size_t i = k / 72, j = k / 36 % 2, at = k % 36;
        TEST(fabs(tangent.stiffness[i][j][at] - differences.stiffness[i][j][at]) < 1.0);
        TEST(fabs(tangent.damping[i][j][at] - differences.damping[i][j][at]) < 1e-3);
    }
    OK(pong_commit(s->world));
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &after));
    TEST(memcmp(&before.force[2], &after.force[2], sizeof after.force[2]) == 0);
}

/* A ground that is left where it is and says that it moves, as a belt would. */
static void standing(scene *s)
{
    pong_interface_id group;
    size_t count = 9;
    int i;
    for (i = 0; i < 3; i += 1) {
        s->states[2].linear_velocity[0] = i == 1 ? 0.2 : 0.0;
        slide_to(s, 0.0);
        OK(pong_find_standing_groups(s->world, 1e-3, &group, 1, &count));
        TEST(count == (i == 1 ? 1u : 0u) && (count == 0 || group.bits == s->interfaces[2].bits));
    }
    REFUSED(pong_find_standing_groups(s->world, 0.0, &group, 1, &count), BAD_VALUE, "step");
}

/* The ball turned by a quarter about x: what pushes up in the common frame pushes along the ball's own y. */
static void frames(scene *s)
{
    pong_wrench group, common;
    pong_contact contact;
    size_t count;
    int i;
    s->states[0].orientation[0] = s->states[0].orientation[1] = sqrt(0.5);
    OK(pong_clear_contact_history(s->world, s->ball)); /* it was turned, it did not roll */
    slide_to(s, 0.0);
    common = slide_to(s, 1e-4);
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_GROUP, &group));
    TEST(fabs(common.force[2] - 10.0) < 1e-9 && common.force[0] < -0.1);
    TEST(fabs(group.force[1] - 10.0) < 1e-9 && fabs(group.force[2]) < 1e-9 && group.force[0] == common.force[0]);
    OK(pong_get_contacts(s->world, &contact, 1, &count));
    for (i = 0; i < 3; i += 1) {
        TEST(contact.friction_force[i] + contact.normal_force * contact.normal[i] == contact.force[i]);
    }
    TEST(contact.friction_force[0] < -0.1 && contact.slip_velocity[0] == 0.0 && contact.depth_rate == 0.0);
    TEST(fabs(contact.a.arm[2] + 0.0995) < 1e-9 && fabs(contact.b.arm[2] + 0.0005) < 1e-9);
    s->states[0].orientation[0] = 1.0;
    s->states[0].orientation[1] = 0.0;
    OK(pong_clear_contact_history(s->world, s->ball));
}

static void contact_state(scene *s)
{
    size_t size = 0, used = 0;
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
    OK(pong_contact_state_used(s->world, &used));
    TEST(used < size / 4);
    OK(pong_save_contact_state(s->world, again, used));
    TEST(memcmp(saved, again, used) == 0);
    OK(pong_restore_contact_state(s->world, again, used));
    OK(pong_save_contact_state(s->world, again, size));
    TEST(memcmp(saved, again, size) == 0);
    second = slide_to(s, 2e-4);
    TEST(memcmp(&first, &second, sizeof first) == 0);
    OK(pong_contact_state_used(s->world, &used));
    REFUSED(pong_save_contact_state(s->world, saved, used - 1), BUFFER_TOO_SMALL, "make it larger");
    REFUSED(pong_save_contact_state(s->world, NULL, size), NULL_ARGUMENT, "`buffer`");
    REFUSED(pong_restore_contact_state(s->world, saved, used - 1), BAD_STATE_BLOCK, "bytes");
    REFUSED(pong_restore_contact_state(s->world, saved, size + 1), BAD_STATE_BLOCK, "bytes");
    REFUSED(pong_restore_contact_state(s->world, NULL, 0), BAD_STATE_BLOCK, "bytes");
    saved[used / 2] ^= 1;
    REFUSED(pong_restore_contact_state(s->world, saved, size), BAD_STATE_BLOCK, "damaged");
    OK(pong_clear_contact_history(s->world, s->ball));
    TEST(slide_to(s, 5e-4).force[0] == 0.0);
    free(saved);
    free(again);
}

static void preload(scene *s)
{
    const double force[3] = {-0.25, 0.0, 3.0}, not_finite[3] = {NAN, 0.0, 0.0};
    size_t count = 0;
    pong_wrench wrench;
    slide_to(s, 0.0);
    OK(pong_clear_contact_history(s->world, s->ball));
    OK(pong_preload_friction(s->world, s->pair, force, &count));
    TEST(count == 1);
    OK(pong_step(s->world));
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &wrench));
    TEST(fabs(wrench.force[0] + 0.25) < 1e-12 && fabs(wrench.force[1]) < 1e-12);
    OK(pong_preload_friction(s->world, s->pair, NULL, NULL));
    REFUSED(pong_preload_friction(s->world, s->pair, not_finite, &count), BAD_VALUE, "NaN");
    OK(pong_clear_contact_history(s->world, s->ball));
}

/* A clone goes on to the same bits, then its own way. */
static void clones(scene *s)
{
    pong_world *clone = NULL, *nothing = s->world;
    pong_wrench mine, its;
    uint64_t value = 0;
    size_t i;
    const char *text = "";
    memset(&its, 0, sizeof its);
    OK(pong_set_object_user_data(s->world, s->ball, 7));
    slide_to(s, 0.0);
    OK(pong_clone_world(s->world, &clone));
    REFUSED(pong_get_wrench(clone, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &its), WRONG_PHASE, "evaluate");
    OK(pong_get_object_user_data(clone, s->ball, &value));
    TEST(value == 7);
    OK(pong_object_name(clone, s->ball, &text));
    TEST(strcmp(text, "ball") == 0);
    for (i = 1; i < 20; i += 1) {
        mine = slide_to(s, 1e-4 * (double)i);
        OK(pong_set_states(clone, s->interfaces, s->states, 3));
        OK(pong_step(clone));
        OK(pong_get_wrench(clone, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &its));
        TEST(memcmp(&mine, &its, sizeof mine) == 0 && mine.force[0] < 0.0);
    }
    OK(pong_clear_contact_history(clone, s->ball));
    OK(pong_step(clone));
    OK(pong_get_wrench(clone, s->interfaces[0], PONG_REFERENCE_FRAME_COMMON, &its));
    mine = slide_to(s, 1e-4 * 19.0);
    TEST(mine.force[0] < its.force[0]);
    OK(pong_destroy_world(clone));
    TEST(slide_to(s, 1e-4 * 20.0).force[0] < 0.0);
    REFUSED(pong_clone_world(s->world, NULL), NULL_ARGUMENT, "`clone`");
    REFUSED(pong_clone_world(NULL, &nothing), NULL_ARGUMENT, "`world`");
    TEST(nothing == NULL);
    OK(pong_set_object_user_data(s->world, s->ball, 0));
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
    /* Two of 1.7e308 N/m, or of 5e-324, are no springs in series. */
    changed.stiffness = 1.7e308;
    REFUSED(pong_set_surface(s->world, s->ball_model, "rubber", &changed), BAD_VALUE, "1e-100 and 1e100 N/m");
    changed.stiffness = 5e-324;
    REFUSED(pong_set_surface(s->world, s->ball_model, "rubber", &changed), BAD_VALUE, "1e-100 and 1e100 N/m");
    changed = values;
    changed.friction_stiffness = 1.7e308;
    REFUSED(pong_set_surface(s->world, s->ball_model, "rubber", &changed), BAD_VALUE, "1e-100 and 1e100 N/m");
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

static void more_values_of_surfaces(scene *s)
{
    pong_surface_more values, changed;
    OK(pong_get_surface_more(s->world, s->ball_model, "rubber", &values));
    TEST(values.foundation == 0.0 && values.area == 0.0 && values.rolling == 0.0 && values.spinning == 0.0);
    changed = values;
    changed.rolling = 1e-3;
    changed.foundation = 1e7;
    OK(pong_set_surface_more(s->world, s->ball_model, "rubber", &changed));
    OK(pong_get_surface_more(s->world, s->ball_model, "rubber", &values));
    TEST(values.rolling == 1e-3 && values.foundation == 1e7);
    values.area = 0.01;
    REFUSED(pong_set_surface_more(s->world, s->ball_model, "rubber", &values), BAD_VALUE, "not both");
    values.area = 0.0;
    values.spinning = -1.0;
    REFUSED(pong_set_surface_more(s->world, s->ball_model, "rubber", &values), BAD_VALUE, "friction values");
    REFUSED(pong_get_surface_more(s->world, s->ball_model, "rubber", NULL), NULL_ARGUMENT, "`values`");
    changed.rolling = changed.foundation = 0.0;
    OK(pong_set_surface_more(s->world, s->ball_model, "rubber", &changed));
}

/* This world was sealed without a motion of a surface. */
static void surfaces_at_rest(scene *s)
{
    pong_surface_motion motion;
    OK(pong_get_surface_motion(s->world, s->interfaces[0], &motion));
    TEST(motion.linear_velocity[0] == 0.0 && motion.belt_travel[2] == 0.0);
    motion.linear_velocity[0] = 1.0;
    REFUSED(pong_set_surface_motions(s->world, &s->interfaces[0], &motion, 1), BAD_VALUE, "before the seal");
    OK(pong_set_surface_motions(s->world, NULL, NULL, 0));
}

/* The arm's tip lies in the ground as deep as the ball; what is kept apart has no contact, in a clone as well. */
static void filters(void)
{
    pong_config config = pong_default_config();
    size_t count = 9;
    int kept_apart;
    for (kept_apart = 0; kept_apart < 2; kept_apart += 1) {
        scene s;
        pong_world *clone = NULL;
        pong_seal_report sealed;
        open_scene(&s, &config);
        s.states[1].position[2] = -0.101;
        if (kept_apart) {
            REFUSED(pong_filter_groups(s.world, s.ball, "leg", s.ground, ""), UNKNOWN_NAME, "`ball/leg`");
            REFUSED(pong_filter_groups(s.world, s.ball, NULL, s.ground, ""), NULL_ARGUMENT, "group_a");
            REFUSED(pong_filter_groups(s.world, s.ball, "body", s.ball, "body"), BAD_VALUE, "one rigid body");
            OK(pong_filter_groups(s.world, s.ball, "arm", s.ground, ""));
            REFUSED(pong_filter_groups(s.world, s.ground, "ground", s.ball, "ball/arm"), DUPLICATE, "already there");
        }
        OK(pong_seal(s.world, &sealed));
        TEST(sealed.group_pairs == (kept_apart ? 1u : 2u) && sealed.warning_count == 0);
        OK(pong_clone_world(s.world, &clone));
        OK(pong_set_states(s.world, s.interfaces, s.states, 3));
        OK(pong_set_states(clone, s.interfaces, s.states, 3));
        OK(pong_step(s.world));
        OK(pong_step(clone));
        OK(pong_contact_count(s.world, &count));
        TEST(count == (kept_apart ? 1u : 2u));
        OK(pong_contact_count(clone, &count));
        TEST(count == (kept_apart ? 1u : 2u));
        REFUSED(pong_filter_groups(s.world, s.ball, "body", s.ground, ""), WRONG_PHASE, "");
        OK(pong_destroy_world(clone));
        OK(pong_destroy_world(s.world));
    }
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

/* A world with the plan and the ball's mass; what does not yield is told too. */
static pong_seal_report planned(scene *s, const pong_step_plan *plan, double mass, double inertia)
{
    pong_config config = pong_default_config();
    pong_seal_report sealed;
    pong_mass ball = {0}, fixed = {0};
    int i;
    open_scene(s, &config);
    ball.mass = mass;
    for (i = 0; i < 3; i += 1) {
        ball.inertia[i] = inertia;
    }
    fixed.mass = INFINITY;
    OK(pong_set_mass(s->world, s->interfaces[0], &ball));
    OK(pong_set_mass(s->world, s->interfaces[1], &fixed));
    OK(pong_set_mass(s->world, s->interfaces[2], &fixed));
    OK(pong_plan_step(s->world, plan));
    OK(pong_seal(s->world, &sealed));
    return sealed;
}

/* A slide along the normal that carries 4 kg holds the step of a free ball of 4 kg, whatever the mass of the ball itself is. */
static void joints(void)
{
    double limits[2];
    int on_slide;
    for (on_slide = 0; on_slide < 2; on_slide += 1) {
        pong_config config = pong_default_config();
        pong_step_plan plan = pong_default_step_plan();
        pong_seal_report sealed;
        pong_mass ball = {0}, fixed = {0};
        pong_joints slide = {0};
        scene s;
        open_scene(&s, &config);
        plan.step = 1e-3;
        ball.mass = on_slide ? 1.0 : 4.0;
        fixed.mass = INFINITY;
        slide.inverse_inertia[2 * 6 + 2] = 0.25;
        REFUSED(pong_set_joints(s.world, s.interfaces[0], &slide), BAD_VALUE, "pong_set_mass()");
        OK(pong_set_mass(s.world, s.interfaces[0], &ball));
        OK(pong_set_mass(s.world, s.interfaces[1], &fixed));
        OK(pong_set_mass(s.world, s.interfaces[2], &fixed));
        if (on_slide) {
            slide.inverse_inertia[2 * 6 + 1] = 0.1;
            REFUSED(pong_set_joints(s.world, s.interfaces[0], &slide), BAD_VALUE, "not symmetric");
            slide.inverse_inertia[2 * 6 + 1] = 0.0;
            slide.reserved = 1;
            REFUSED(pong_set_joints(s.world, s.interfaces[0], &slide), BAD_VALUE, "reserved");
            slide.reserved = 0;
            OK(pong_set_joints(s.world, s.interfaces[0], &slide));
        }
        OK(pong_plan_step(s.world, &plan));
        OK(pong_seal(s.world, &sealed));
        limits[on_slide] = sealed.stable_step;
        OK(pong_destroy_world(s.world));
    }
    TEST(limits[0] > 0.0 && fabs(limits[1] / limits[0] - 1.0) < 1e-9);
}

/* Two surfaces of 2e4 N/m and 40 N s/m are 1e4 N/m and 20 N s/m: held over a frame they gain energy beyond 2 c/k = 4 ms. */
static void certain_steps(void)
{
    const double steps[2] = {5e-3, 3e-3};
    int i;
    for (i = 0; i < 2; i += 1) {
        scene s;
        pong_step_plan plan = pong_default_step_plan();
        pong_seal_report sealed;
        const char *warning = "";
        plan.step = steps[i];
        plan.depth_within = plan.rebound_within = 0.0;
        sealed = planned(&s, &plan, 100.0, 0.0);
        TEST(sealed.warning_count == (i == 0 ? 1 : 0) && sealed.note_count == 0);
        if (i == 0) {
            OK(pong_seal_warning(s.world, 0, &warning));
            TEST(strstr(warning, "longest stable step is 4.000e-3 s") != NULL);
        }
        REFUSED(pong_seal_note(s.world, 0, &warning), UNKNOWN_ID, "note 0: there are 0");
        REFUSED(pong_plan_step(s.world, &plan), WRONG_PHASE, "sealed");
        REFUSED(pong_set_mass(s.world, s.interfaces[0], NULL), NULL_ARGUMENT, "`mass`");
        OK(pong_destroy_world(s.world));
    }
}

/* Friction of 2/3 k at the skin of a ball of 1 kg and 2/5 m r^2 finds 2/7 kg: with semi-implicit Euler that may be too
 * quick for a step that the normal spring bears. k T^2/m + 2 c T/m = 4 with k 7/3 1e4 N/m and c 7/2 sqrt(2/3) 20 N s/m, the
 * damping that a bristle has by default beside a linear law. */
static void possible_steps(void)
{
    scene s;
    pong_step_plan plan = pong_default_step_plan();
    pong_seal_report sealed;
    pong_step_check acting;
    const char *warning = "";
    const double k = 7e4 / 3.0, c = 70.0 * sqrt(2.0 / 3.0);
    const double surely = 4.0 / (c + sqrt(c * c + 4.0 * k));
    plan.step = 1.01 * surely;
    plan.wrench_coupling = PONG_COUPLING_SEMI_IMPLICIT;
    plan.depth_within = plan.rebound_within = 0.0;
    sealed = planned(&s, &plan, 1.0, 0.4 * 0.1 * 0.1);
    TEST(sealed.warning_count == 1 && sealed.note_count == 0);
    /* The bound takes normal and friction together, so it is below the limit of the quicker of the two. */
    TEST(sealed.surely_stable_step < surely && sealed.surely_stable_step > 0.8 * surely && sealed.stable_step < surely);
    OK(pong_seal_warning(s.world, 0, &warning));
    TEST(strstr(warning, "gains energy") != NULL && strstr(warning, "longest stable step is 1.087e-2 s") != NULL);
    OK(pong_destroy_world(s.world));
    plan.step = 0.99 * sealed.surely_stable_step;
    sealed = planned(&s, &plan, 1.0, 0.4 * 0.1 * 0.1);
    TEST(sealed.warning_count == 0 && sealed.note_count == 0);
    REFUSED(pong_check_step(s.world, &acting), WRONG_PHASE, "frame");
    OK(pong_set_states(s.world, s.interfaces, s.states, 3));
    OK(pong_step(s.world));
    OK(pong_check_step(s.world, &acting));
    TEST(acting.contacts == 1 && acting.not_judged == 0);
    /* 1 mm deep the lever is that much shorter than the radius, on either side. */
    TEST(fabs(acting.stable_step / surely - 1.0) < 0.02 && fabs(acting.stiffness_rate / k - 1.0) < 0.02);
    TEST(fabs(acting.damping_rate / c - 1.0) < 0.02);
    s.states[0].position[2] = 1.0;
    OK(pong_set_states(s.world, s.interfaces, s.states, 3));
    OK(pong_step(s.world));
    OK(pong_check_step(s.world, &acting));
    TEST(acting.contacts == 0 && isinf(acting.stable_step));
    OK(pong_destroy_world(s.world));
}

/* A model whose springs in series leave the range of numbers is not loaded. */
static void stiffness_limits(void)
{
    scene s;
    pong_config config = pong_default_config();
    pong_model_id model;
    const char *text = "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {\"s\": (stiffness: 1.7e308)},\n"
                       " root: (name: \"m\", surface: \"s\", primitives: [Point(name: \"p\", position: (0, 0, 0))]))";
    open_scene(&s, &config);
    REFUSED(load_text(s.world, text, &model), MODEL_ERROR, "surfaces/s: [stiffness-range] the stiffness is 1.7e308");
    REFUSED(load_text(s.world, text, &model), MODEL_ERROR, "give 1e-100 to 1e100 N/m");
    OK(pong_destroy_world(s.world));
}

static void refused_plans(void)
{
    scene s;
    pong_config config = pong_default_config();
    pong_step_plan plan = pong_default_step_plan();
    pong_mass mass = {-1.0, {0}, {0}};
    pong_step_check acting;
    pong_seal_report sealed;
    open_scene(&s, &config);
    REFUSED(pong_plan_step(s.world, &plan), BAD_VALUE, "step");
    plan.step = 1e-3;
    plan.wrench_coupling = 7;
    REFUSED(pong_plan_step(s.world, &plan), BAD_VALUE, "coupling is 7");
    plan.wrench_coupling = PONG_COUPLING_SEMI_IMPLICIT;
    plan.delay_frames = 1;
    REFUSED(pong_plan_step(s.world, &plan), BAD_VALUE, "delay_frames");
    plan.delay_frames = 0;
    plan.closing_speed = NAN;
    REFUSED(pong_plan_step(s.world, &plan), BAD_VALUE, "closing speed");
    plan.closing_speed = 0.0;
    plan.depth_within = 0.0;
    REFUSED(pong_plan_step(s.world, &plan), BAD_VALUE, "accuracies");
    plan = pong_default_step_plan();
    plan.step = 1e-3;
    plan.reserved[0] = 1;
    REFUSED(pong_plan_step(s.world, &plan), BAD_VALUE, "reserved");
    REFUSED(pong_plan_step(s.world, NULL), NULL_ARGUMENT, "`plan`");
    REFUSED(pong_check_step(s.world, &acting), WRONG_PHASE, "no step is planned");
    REFUSED(pong_set_mass(s.world, s.interfaces[2], &mass), BAD_VALUE, "mass of `ground/ground`");
    mass.mass = 1.0;
    mass.inertia[3] = 1.0;
    REFUSED(pong_set_mass(s.world, s.interfaces[2], &mass), BAD_VALUE, "inertia");
    mass.inertia[3] = 0.0;
    mass.mass_center[1] = NAN;
    REFUSED(pong_set_mass(s.world, s.interfaces[2], &mass), BAD_VALUE, "mass centre");
    /* Nothing of that counts. */
    OK(pong_seal(s.world, &sealed));
    TEST(sealed.warning_count == 0 && sealed.note_count == 0);
    TEST(sealed.stable_step == 0.0 && sealed.surely_stable_step == 0.0);
    OK(pong_destroy_world(s.world));
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
    TEST(report.advised_capacity == 2 && strcmp(pong_flag_name(report.flags), "contact limit") == 0);
    TEST(report.contacts_peak >= 1 && report.contacts_peak <= report.contacts_capacity);
    TEST(strcmp(pong_flag_name(PONG_FLAG_LOAD_SHARING_LIMIT), "load sharing limit") == 0);
    TEST(strcmp(pong_flag_name(0), "unknown limit") == 0 && strcmp(pong_flag_name(3), "unknown limit") == 0);
    OK(pong_get_ledger(s.world, &ledger));
    TEST(fabs(ledger.stored - 0.5 * 1e4 * 0.005 * 0.005) < 1e-9);
    OK(pong_destroy_world(s.world));
}

/* The tip of the arm is led into the ground and out, each wrench held for a frame. */
static void accounts(void)
{
    scene s;
    pong_config config = pong_default_config();
    pong_energy_account all, contacts[4];
    pong_pair_energy_account pair;
    const char *remedy;
    size_t count, listed, i;
    double depth;
    config.energy_accounts = PONG_COUPLING_ZERO_ORDER_HOLD;
    open_scene(&s, &config);
    OK(pong_seal(s.world, NULL));
    OK(pong_pair_energy_account_count(s.world, &count));
    TEST(count == 2);
    s.states[0].position[2] = 1.0; /* the ball is out of the way */
    /* In and out again by the same way: every wrench is that of the place before, and so does more on the way out. */
    for (i = 0; i <= 20; i += 1) {
        depth = i <= 10 ? 5e-4 * (double)i : 5e-4 * (double)(20 - i);
        s.states[1].position[2] = -0.1 - depth + 1e-6;
        OK(pong_set_states(s.world, s.interfaces, s.states, 3));
        OK(pong_step(s.world));
        OK(pong_contact_count(s.world, &listed));
        OK(pong_get_contact_energy_accounts(s.world, contacts, 4, &count));
        TEST(count == listed);
    }
    OK(pong_get_energy_account(s.world, &all));
    TEST(all.verdict == PONG_VERDICT_GAINED && all.work_out > all.work_in && all.work_in > 0.0);
    TEST(fabs(all.hold_error - (all.work_out - all.work_in) - all.damping_loss - all.friction_loss) < 1e-12);
    TEST(all.hold_error > 0.0 && all.stored == 0.0 && all.inserted == 0.0 && all.resolution == 0.0);
    OK(pong_pair_energy_account_count(s.world, &count));
    for (i = 0, listed = 0; i < count; i += 1) {
        OK(pong_get_pair_energy_account(s.world, i, &pair));
        if (pair.gains_energy) {
            listed += 1;
            TEST(pair.episodes == 1 && pair.episodes_gained == 1 && !pair.in_contact && pair.stiffness > 0.0);
            TEST(pair.excess > 0.0 && pair.excess == pair.worst_excess && pair.total.work_out == all.work_out);
            OK(pong_pair_remedy(s.world, i, &remedy));
            TEST(strstr(remedy, "shorten the step") != NULL && strstr(remedy, "c > k") != NULL);
        }
    }
    TEST(listed == 1);
    OK(pong_destroy_world(s.world));
}

static unsigned tested(const crowd *c, uint32_t what, const char *a, const char *b, unsigned *met)
{
    pong_tally tally;
    size_t count = 0, i;
    unsigned sum = 0;
    *met = 0;
    OK(pong_tally_count(c->world, &count));
    for (i = 0; i < count; i += 1) {
        OK(pong_get_tally(c->world, i, &tally));
        TEST(tally.tested > 0);
        if (tally.what == what && (a == NULL || (strcmp(tally.kind_a, a) == 0 && strcmp(tally.kind_b, b) == 0))) {
            sum += tally.tested;
            *met += tally.met;
        }
    }
    return sum;
}

/* Time in every part of the work: the sum of the calling thread's and the workers'. */
static void work_by_thread(const crowd *c, const pong_report *report, int timed)
{
    size_t threads, thread, part;
    OK(pong_worker_count(c->world, &threads));
    threads += 1;
    for (part = 0; part < 4; part += 1) {
        uint64_t sum = 0;
        for (thread = 0; thread < threads; thread += 1) {
            pong_worker worker;
            OK(pong_get_worker(c->world, thread, &worker));
            sum += worker.work_ns[part];
        }
        TEST(sum == report->work_ns[part] && pong_work_name(part)[0] != '\0');
        TEST((sum > 0) == (timed != 0));
    }
}

static void counts_and_times(const crowd *c, int timed)
{
    pong_report report;
    unsigned met;
    uint64_t sum = 0;
    size_t i;
    OK(pong_get_report(c->world, &report));
    TEST(tested(c, PONG_TALLY_VOLUMES, NULL, NULL, &met) == report.volumes_tested && report.volumes_tested > 0);
    TEST(met <= report.volumes_tested);
    TEST(tested(c, PONG_TALLY_PRIMITIVES, NULL, NULL, &met) == report.primitives_tested);
    TEST(tested(c, PONG_TALLY_PRIMITIVES, "Point", "Polyhedron", &met) >= 400 && met >= 400);
    TEST(report.flags == 0 && report.advised_capacity == 0 && report.contacts > 400);
    TEST(report.contacts_peak >= report.contacts && report.contacts_peak <= report.contacts_capacity);
    TEST(report.contacts_capacity >= c->sealed.contact_capacity && report.boxes_tested > 0);
    TEST((report.arena_peak > 0 || c->sealed.workers > 0) && report.arena_peak <= report.arena_capacity);
    TEST(report.scratch_peak <= report.scratch_capacity);
    for (i = 0; i < 8; i += 1) {
        sum += report.stage_ns[i];
        TEST(pong_stage_name(i)[0] != '\0' || report.stage_ns[i] == 0);
    }
    TEST((report.stage_ns[PONG_STAGE_CONTACTS] > 0) == timed && (sum > 0) == timed);
    TEST(report.evaluate_ns > 0 && report.commit_ns > 0);
    TEST(strcmp(pong_work_name(PONG_WORK_FORCES), "forces") == 0 && pong_work_name(4)[0] == '\0');
    work_by_thread(c, &report, timed);
    TEST(strcmp(pong_stage_name(PONG_STAGE_COMMIT), "commit") == 0 && pong_stage_name(99)[0] == '\0');
}

/* Four frames that touch, all hands; the wrench on the pad at the end. */
static pong_wrench crowd_frames(crowd *c)
{
    pong_state states[CROWD_PARTS];
    pong_wrench wrench;
    long frame;
    memset(&wrench, 0, sizeof wrench);
    for (frame = 13; frame < 17; frame += 1) {
        crowd_states(frame, states);
        OK(pong_prewake(c->world, 200));
        OK(pong_set_states(c->world, c->parts, states, CROWD_PARTS));
        OK(pong_step(c->world));
    }
    OK(pong_get_wrench(c->world, c->parts[0], PONG_REFERENCE_FRAME_COMMON, &wrench));
    OK(pong_quiesce(c->world));
    return wrench;
}

/* The highest core of the mask is one that most machines do not have: either answer must be told. */
static void workers(void)
{
    crowd alone, crew, far_away;
    pong_config config = pong_default_config();
    pong_wrench a, b;
    pong_worker worker;
    unsigned blocks;
    size_t count = 9;
    const char *text = "";
    open_crowd(&alone, &config);
    a = crowd_frames(&alone);
    counts_and_times(&alone, 0);
    OK(pong_worker_count(alone.world, &count));
    OK(pong_get_worker(alone.world, 0, &worker));
    TEST(count == 0 && alone.sealed.workers == 0 && worker.blocks == 0 && worker.busy_ns == 0);

    config.workers = 2;
    config.oversubscribe = 1;
    config.report_times = 1;
    open_crowd(&crew, &config);
    b = crowd_frames(&crew);
    counts_and_times(&crew, 1);
    TEST(memcmp(&a, &b, sizeof a) == 0 && a.force[2] > 100.0);
    OK(pong_worker_count(crew.world, &count));
    TEST(count == 2 && crew.sealed.workers == 2);
    OK(pong_get_worker(crew.world, 0, &worker));
    TEST(worker.index == 0 && worker.core_grant == PONG_GRANT_NOT_ASKED && worker.blocks > 0 && worker.busy_ns > 0);
    blocks = worker.blocks;
    OK(pong_get_worker(crew.world, 2, &worker));
    TEST(worker.index == 2 && worker.core_grant == PONG_GRANT_NOT_ASKED && worker.fifo_grant == PONG_GRANT_NOT_ASKED);
    blocks += worker.blocks;
    OK(pong_get_worker(crew.world, 1, &worker));
    TEST(blocks + worker.blocks > 1);
    REFUSED(pong_get_worker(crew.world, 3, &worker), UNKNOWN_ID, "worker 3: there are 2");
    OK(pong_worker_text(crew.world, 1, &text));
    TEST(strstr(text, "worker 1") != NULL && strstr(text, "not asked for") != NULL);

    config.workers = 1;
    config.pin_workers = 1;
    config.worker_cores = (uint64_t)1 << 63;
    config.fifo_priority = 1;
    open_crowd(&far_away, &config);
    b = crowd_frames(&far_away);
    TEST(memcmp(&a, &b, sizeof a) == 0);
    OK(pong_get_worker(far_away.world, 1, &worker));
    OK(pong_worker_text(far_away.world, 1, &text));
    TEST(worker.core == 63 && worker.core_grant != PONG_GRANT_NOT_ASKED && worker.fifo_priority == 1);
    TEST(worker.fifo_grant != PONG_GRANT_NOT_ASKED);
    TEST((strstr(text, "63 refused") != NULL) == (worker.core_grant == PONG_GRANT_REFUSED));
    OK(pong_destroy_world(alone.world));
    OK(pong_destroy_world(crew.world));
    OK(pong_destroy_world(far_away.world));
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
    tangents(&s);
    pair_wrenches(&s);
    pair_distances(&s);
    pair_monitor(&s);
    standing(&s);
    frames(&s);
    contact_state(&s);
    preload(&s);
    clones(&s);
    surfaces(&s);
    more_values_of_surfaces(&s);
    surfaces_at_rest(&s);
    pairs_and_rates(&s);
    threads(&s);
    OK(pong_destroy_world(s.world));
    filters();
    joined_models();
    joints();
    certain_steps();
    possible_steps();
    refused_plans();
    stiffness_limits();
    energies_and_limits();
    accounts();
    workers();
    return report_failures("calls");
}
