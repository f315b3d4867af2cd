/* Force laws given by callback: the same numbers as the built-in law they copy; a law that misbehaves spoils its own
 * frame and nothing else. */
#include "check.h"
#include <math.h>

#define SURFACE(normal, friction) "surfaces: {\"skin\": (stiffness: 2e4, normal: " normal ", friction: " friction ")}, "
#define HEAD "(format: \"pong-model\", version: 1, "
#define BALL "name: \"ball\", root: (name: \"ball\", surface: \"skin\", primitives: [" \
    "Sphere(name: \"shell\", center: (0, 0, 0), radius: 0.1)]))"
#define GROUND "name: \"ground\", root: (name: \"ground\", surface: \"skin\", primitives: [" \
    "Plane(name: \"floor\", normal: (0, 0, 1), offset: 0)]))"
/* A law of the user's is the pair's own: a table entry says so. */
#define PAIR(normal, friction) "pairs: [(surfaces: (\"skin\", \"skin\"), normal: " normal ", friction: " friction ")], "

typedef struct lab {
    pong_world *world;
    pong_interface_id ball, ground;
    pong_pair_id pair;
    double factor, stored_factor;
    int calls;
    pong_status inner;
} lab;

static double linear(const pong_normal_input *in, void *user)
{
    lab *l = user;
    l->calls += 1;
    TEST(in->parameter_count == 1);
    return l->factor * (in->stiffness * in->depth + in->parameters[0] * in->depth_rate);
}

static double linear_stored(const pong_normal_input *in, void *user)
{
    const lab *l = user;
    return l->stored_factor * (0.5 * in->stiffness * in->depth * in->depth);
}

static double reentrant(const pong_normal_input *in, void *user)
{
    lab *l = user;
    l->inner = pong_step(l->world);
    return in->stiffness * in->depth;
}

/* A spring without a limit; its state is the displacement. */
static void spring(const pong_friction_input *in, double *state, pong_friction_output *out, void *user)
{
    int i;
    (void)user;
    for (i = 0; i < 3; i += 1) {
        state[i] += in->slip_b[i];
        out->force_b[i] = -in->share * in->parameters[0] * state[i];
        out->stored += 0.5 * in->share * in->parameters[0] * state[i] * state[i];
    }
    out->sticks = 1;
}

static void open_lab(lab *l, pong_normal_law law, const char *ball, const char *ground)
{
    pong_config config = pong_default_config();
    pong_model_id model;
    pong_object_id object;
    memset(l, 0, sizeof *l);
    l->factor = l->stored_factor = 1.0;
    OK(pong_create_world(&config, &l->world));
    OK(pong_register_normal_law(l->world, "mine", law, linear_stored, l));
    OK(pong_register_friction_law(l->world, "spring", 3, spring, l));
    OK(load_text(l->world, ball, &model));
    OK(pong_create_object(l->world, model, "ball", &object));
    OK(pong_find_interface(l->world, object, "", &l->ball));
    OK(load_text(l->world, ground, &model));
    OK(pong_create_object(l->world, model, "ground", &object));
    OK(pong_find_interface(l->world, object, "", &l->ground));
    OK(pong_pair_by_name(l->world, "ball", "ground", &l->pair));
    OK(pong_seal(l->world, NULL));
}

static void place(lab *l, double x, double z)
{
    pong_state state = pong_default_state();
    OK(pong_set_state(l->world, l->ground, &state));
    state.position[0] = x;
    state.position[2] = z;
    state.linear_velocity[2] = -0.01;
    OK(pong_set_state(l->world, l->ball, &state));
}

static pong_wrench wrench(lab *l)
{
    pong_wrench w;
    memset(&w, 0, sizeof w);
    OK(pong_get_wrench(l->world, l->ball, PONG_REFERENCE_FRAME_COMMON, &w));
    return w;
}

static const char custom_ball[] = HEAD SURFACE("Custom(name: \"mine\", parameters: [20])", "None")
    PAIR("Custom(name: \"mine\", parameters: [20])", "Custom(name: \"spring\", parameters: [300])") BALL;
static const char custom_ground[] = HEAD SURFACE("Custom(name: \"mine\", parameters: [20])", "None") GROUND;

static void same_as_built_in(void)
{
    lab mine, built_in;
    pong_wrench a, b;
    const char *linear_ball = HEAD SURFACE("Linear(damping: 40)", "None") BALL;
    open_lab(&mine, linear, custom_ball, custom_ground);
    open_lab(&built_in, linear, linear_ball, HEAD SURFACE("Linear(damping: 40)", "None") GROUND);
    place(&mine, 0.0, 0.098);
    place(&built_in, 0.0, 0.098);
    OK(pong_step(mine.world));
    OK(pong_step(built_in.world));
    a = wrench(&mine);
    b = wrench(&built_in);
    TEST(mine.calls > 0 && built_in.calls == 0);
    TEST(memcmp(&a, &b, sizeof a) == 0 && a.force[2] > 20.0);
    /* The spring's displacement grows by what is committed, not by what is evaluated. */
    place(&mine, 0.001, 0.098);
    OK(pong_evaluate(mine.world));
    OK(pong_evaluate(mine.world));
    TEST(fabs(wrench(&mine).force[0] + 0.3) < 1e-9);
    OK(pong_commit(mine.world));
    place(&mine, 0.003, 0.098);
    OK(pong_step(mine.world));
    TEST(fabs(wrench(&mine).force[0] + 0.9) < 1e-9);
    OK(pong_destroy_world(mine.world));
    OK(pong_destroy_world(built_in.world));
}

static void not_a_number(void)
{
    lab l;
    pong_wrench w;
    pong_contact contact;
    pong_report before, after;
    size_t count;
    open_lab(&l, linear, custom_ball, custom_ground);
    place(&l, 0.0, 0.098);
    OK(pong_step(l.world));
    OK(pong_get_report(l.world, &before));
    l.factor = NAN;
    place(&l, 0.0, 0.097);
    REFUSED(pong_step(l.world), LAW_FAILED, "`mine`");
    REFUSED(pong_commit(l.world), LAW_FAILED, "`mine`");
    REFUSED(pong_get_wrench(l.world, l.ball, PONG_REFERENCE_FRAME_GROUP, &w), LAW_FAILED, "`mine`");
    REFUSED(pong_get_contacts(l.world, &contact, 1, &count), LAW_FAILED, "`mine`");
    place(&l, 0.0, 0.0965);
    REFUSED(pong_commit(l.world), LAW_FAILED, "`mine`");
    OK(pong_get_report(l.world, &after));
    TEST(before.commits == 1 && after.commits == 1);
    l.factor = 1.0;
    OK(pong_step(l.world));
    TEST(wrench(&l).force[2] > 35.0);
    OK(pong_destroy_world(l.world));
}

/* A frame that overflows by a law's fault is the law's, and the next one is not. */
static void beyond_numbers(void)
{
    lab l;
    open_lab(&l, linear, custom_ball, custom_ground);
    l.factor = 1e303;
    l.stored_factor = INFINITY;
    place(&l, 0.0, 0.098);
    REFUSED(pong_step(l.world), LAW_FAILED, "`mine`");
    l.factor = l.stored_factor = 1.0;
    place(&l, 0.0, 0.0981);
    OK(pong_step(l.world));
    OK(pong_destroy_world(l.world));
}

/* A preload is a commit: of a spoilt frame there is none. */
static void preloaded(void)
{
    lab l;
    pong_report report;
    size_t used, before;
    open_lab(&l, linear, custom_ball, custom_ground);
    place(&l, 0.0, 0.098);
    OK(pong_contact_state_used(l.world, &before));
    l.factor = NAN;
    REFUSED(pong_evaluate(l.world), LAW_FAILED, "`mine`");
    REFUSED(pong_preload_friction(l.world, l.pair, NULL, NULL), LAW_FAILED, "`mine`");
    place(&l, 0.0, 0.0985);
    REFUSED(pong_preload_friction(l.world, l.pair, NULL, NULL), LAW_FAILED, "`mine`");
    OK(pong_contact_state_used(l.world, &used));
    TEST(used == before);
    l.factor = 1.0;
    place(&l, 0.0, 0.0981);
    OK(pong_preload_friction(l.world, l.pair, NULL, NULL));
    OK(pong_step(l.world));
    OK(pong_get_report(l.world, &report));
    TEST(report.commits == 2);
    OK(pong_destroy_world(l.world));
}

static void from_inside(void)
{
    lab l;
    open_lab(&l, reentrant, custom_ball, custom_ground);
    place(&l, 0.0, 0.098);
    OK(pong_step(l.world));
    TEST(l.inner == PONG_STATUS_BUSY);
    OK(pong_destroy_world(l.world));
}

static void registration(void)
{
    pong_world *world;
    pong_model_id model;
    pong_object_id object;
    pong_config config = pong_default_config();
    OK(pong_create_world(&config, &world));
    REFUSED(pong_register_normal_law(world, "mine", NULL, NULL, NULL), NULL_ARGUMENT, "`force`");
    REFUSED(pong_register_normal_law(world, NULL, linear, NULL, NULL), NULL_ARGUMENT, "`name`");
    REFUSED(pong_register_friction_law(world, "spring", 3, NULL, NULL), NULL_ARGUMENT, "`law`");
    REFUSED(pong_register_friction_law(world, "spring", 65, spring, NULL), BAD_VALUE, "at most 64");
    OK(pong_register_friction_law(world, "spring", 3, spring, NULL));
    REFUSED(pong_register_friction_law(world, "spring", 3, spring, NULL), DUPLICATE, "`spring`");
    OK(load_text(world, custom_ball, &model));
    OK(pong_create_object(world, model, "ball", &object));
    OK(load_text(world, custom_ground, &model));
    OK(pong_create_object(world, model, "ground", &object));
    OK(pong_pair_by_name(world, "ball", "ground", NULL));
    REFUSED(pong_seal(world, NULL), SEAL_FAILED, "`mine`");
    OK(pong_register_normal_law(world, "mine", linear, NULL, NULL));
    OK(pong_seal(world, NULL));
    REFUSED(pong_register_normal_law(world, "late", linear, NULL, NULL), WRONG_PHASE, "sealed");
    OK(pong_destroy_world(world));
}

int main(void)
{
    registration();
    same_as_built_in();
    not_a_number();
    beyond_numbers();
    preloaded();
    from_inside();
    return report_failures("laws");
}
