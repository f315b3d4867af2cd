/* Everything a host can do wrong that the library can tell: wrong order, stale and foreign ids, NULLs, NaN, buffers
 * that are too small. Each must be an error with a message, and the next good frame as if it had never been. */
#include "testing/check.h"
#include <math.h>

static pong_wrench good_frame(scene *s)
{
    pong_wrench wrench;
    memset(&wrench, 0, sizeof wrench);
    OK(pong_set_states(s->world, s->interfaces, s->states, 3));
    OK(pong_evaluate(s->world));
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_GROUP, &wrench));
    return wrench;
}

static void versions(void)
{
    OK(PONG_CHECK_ABI());
    REFUSED(pong_check_abi(PONG_ABI_VERSION + 1, PONG_LAYOUT_HASH), CONFIG, "compile against");
    REFUSED(pong_check_abi(PONG_ABI_VERSION, PONG_LAYOUT_HASH + 1), CONFIG, "layout");
    TEST(pong_abi_version() == PONG_ABI_VERSION && pong_layout_hash() == PONG_LAYOUT_HASH);
    TEST(strchr(pong_version_string(), '.') != NULL);
    TEST(strcmp(pong_status_name(PONG_STATUS_UNKNOWN_ID), "PONG_STATUS_UNKNOWN_ID") == 0);
    TEST(strcmp(pong_status_name(-7), "unknown status") == 0);
}

static void configurations(void)
{
    pong_world *world = (pong_world *)&world;
    pong_config config;
    memset(&config, 0, sizeof config);
    REFUSED(pong_create_world(&config, &world), CONFIG, "pong_default_config()");
    TEST(world == NULL);
    config = pong_default_config();
    config.struct_size -= 8;
    REFUSED(pong_create_world(&config, &world), CONFIG, "pong_default_config()");
    config = pong_default_config();
    config.abi_version += 1;
    REFUSED(pong_create_world(&config, &world), CONFIG, "pong_default_config()");
    config = pong_default_config();
    config.reserved[3] = 1;
    REFUSED(pong_create_world(&config, &world), CONFIG, "reserved");
    config = pong_default_config();
    config.keep_ledger = 2;
    REFUSED(pong_create_world(&config, &world), BAD_VALUE, "keep_ledger is 2");
    config = pong_default_config();
    config.energy_accounts = 4;
    REFUSED(pong_create_world(&config, &world), BAD_VALUE, "energy_accounts is 4");
    config.energy_accounts = PONG_COUPLING_ZERO_ORDER_HOLD;
    config.delay_frames = 17;
    REFUSED(pong_create_world(&config, &world), BAD_VALUE, "delay_frames is 17; give 0 to 16");
    config.energy_accounts = PONG_COUPLING_STAGES;
    config.delay_frames = 1;
    REFUSED(pong_create_world(&config, &world), BAD_VALUE, "only a wrench that is held can be delayed");
    config = pong_default_config();
    config.report_times = 7;
    REFUSED(pong_create_world(&config, &world), BAD_VALUE, "report_times is 7; give 0 or 1");
    config = pong_default_config();
    config.contact_capacity = (uint64_t)1 << 60;
    REFUSED(pong_create_world(&config, &world), BAD_VALUE, "contact_capacity");
    REFUSED(pong_create_world(NULL, &world), NULL_ARGUMENT, "`config`");
    config = pong_default_config();
    REFUSED(pong_create_world(&config, NULL), NULL_ARGUMENT, "`world`");
    OK(pong_destroy_world(NULL));
}

/* Refused whether or not there are to be workers. */
static void worker_settings(void)
{
    static const uint32_t bad[] = { 65, 1000001, 0, 1000001, 100, 2, 2 };
    static const char *const said[] = { "workers is 65; give 0 to 64", "spin_us is 1000001", "worker_timeout_us is 0; give 1",
                                        "worker_timeout_us is 1000001", "fifo_priority is 100; give 0 to 99",
                                        "pin_workers is 2", "oversubscribe is 2" };
    pong_config cores = pong_default_config();
    pong_world *world;
    int i;
    for (i = 0; i < 7; i += 1) {
        pong_config config = pong_default_config();
        uint32_t *const fields[7] = { &config.workers, &config.spin_us, &config.worker_timeout_us, &config.worker_timeout_us,
                                      &config.fifo_priority, &config.pin_workers, &config.oversubscribe };
        *fields[i] = bad[i];
        REFUSED(pong_create_world(&config, &world), BAD_VALUE, said[i]);
    }
    cores.worker_cores = 2;
    REFUSED(pong_create_world(&cores, &world), BAD_VALUE, "worker_cores is 0x2 but pin_workers is 0");
}

static void joined_models(scene *s, pong_model_id *model)
{
    const char *const paths[] = { "no/such/file.ron", NULL };
    static const double at_rest[2][7] = { { 0, 0, 0, 1, 0, 0, 0 }, { 0, 0, 0, 1, 0, 0, 0 } };
    static const double long_quaternion[1][7] = { { 0, 0, 0, 1, 1, 0, 0 } };
    REFUSED(pong_load_joined_models(s->world, paths, at_rest, 1, "floor", 1, model), MODEL_ERROR, "no/such/file.ron");
    REFUSED(pong_load_joined_models(s->world, paths, NULL, 2, "floor", 1, model), NULL_ARGUMENT, "`paths[i]`");
    REFUSED(pong_load_joined_models(s->world, paths, long_quaternion, 1, "floor", 1, model), BAD_VALUE, "`poses[0]`");
    REFUSED(pong_load_joined_models(s->world, paths, NULL, 0, "floor", 1, model), MODEL_ERROR, "no models to join");
    REFUSED(pong_load_joined_models(s->world, NULL, NULL, 1, "floor", 1, model), NULL_ARGUMENT, "`paths`");
    REFUSED(pong_load_joined_models(s->world, paths, NULL, 1, NULL, 1, model), NULL_ARGUMENT, "`name`");
}

static void models(scene *s)
{
    static const char two_faults[] = "(format: \"pong-model\", version: 1, name: \"x\",\n"
        " surfaces: {\"rubber\": (stiffness: -2)},\n"
        " root: (name: \"x\", surface: \"rubber\", primitives: [\n"
        "  Sphere(name: \"shell\", center: (0, 0, 0), radius: 0)]))";
    pong_model_id model = { 77 };
    REFUSED(load_text(s->world, two_faults, &model), MODEL_ERROR, "text:2:");
    REFUSED(load_text(s->world, two_faults, &model), MODEL_ERROR, "text:4:");
    REFUSED(load_text(s->world, "", &model), MODEL_ERROR, "text:1:");
    REFUSED(pong_load_model_text(s->world, "\xff\xfe", 2, "t", NULL, &model), MODEL_ERROR, "UTF-8");
    REFUSED(pong_load_model_text(s->world, NULL, 0, "t", NULL, &model), NULL_ARGUMENT, "`text`");
    REFUSED(pong_load_model_text(s->world, "()", 2, NULL, NULL, &model), NULL_ARGUMENT, "`name`");
    REFUSED(pong_load_model_text(s->world, "()", (size_t)-1, "t", NULL, &model), BAD_VALUE, "true length");
    REFUSED(pong_load_model(s->world, "no/such/file.ron", &model), MODEL_ERROR, "no/such/file.ron");
    REFUSED(pong_load_model(s->world, NULL, &model), NULL_ARGUMENT, "`path`");
    REFUSED(pong_load_model(s->world, "\xff", &model), BAD_VALUE, "UTF-8");
    REFUSED(pong_load_model(s->world, "x.ron", NULL), NULL_ARGUMENT, "`model`");
    joined_models(s, &model);
    TEST(model.bits == 77);
}

static void names_and_ids(scene *s)
{
    pong_object_id object = { 77 };
    pong_interface_id interface = { 77 };
    pong_model_id no_model = { 0 };
    pong_object_id no_object = { 0 }, wild = { (uint64_t)-1 };
    const char *text = NULL;
    REFUSED(pong_create_object(s->world, s->ball_model, "ball", &object), DUPLICATE, "`ball`");
    REFUSED(pong_create_object(s->world, no_model, "new", &object), UNKNOWN_ID, "model");
    REFUSED(pong_create_object(s->world, s->ball_model, "\xff", &object), BAD_VALUE, "UTF-8");
    REFUSED(pong_pair_objects(s->world, s->ground, s->ball, NULL), DUPLICATE, "`ground`");
    REFUSED(pong_pair_objects(s->world, s->ground, s->ground, NULL), BAD_VALUE, "paired with itself");
    REFUSED(pong_pair_objects(s->world, s->ground, no_object, NULL), UNKNOWN_ID, "object");
    REFUSED(pong_pair_by_name(s->world, "ball", "moon", NULL), UNKNOWN_NAME, "`moon`");
    REFUSED(pong_find_object(s->world, "moon", &object), UNKNOWN_NAME, "known: ball, ground");
    REFUSED(pong_find_interface(s->world, s->ball, "leg", &interface), UNKNOWN_NAME, "ball/leg");
    REFUSED(pong_find_interface(s->world, wild, "", &interface), UNKNOWN_ID, "object");
    REFUSED(pong_object_name(s->world, wild, &text), UNKNOWN_ID, "object");
    REFUSED(pong_interface_path(s->world, interface, &text), UNKNOWN_ID, "interface");
    REFUSED(pong_primitive_path(s->world, s->interfaces[0], 1, &text), UNKNOWN_ID, "primitive 1");
    REFUSED(pong_model_warning(s->world, s->ball_model, 0, &text), UNKNOWN_ID, "warning 0");
    REFUSED(pong_seal_warning(s->world, 9, &text), UNKNOWN_ID, "warning 9");
    REFUSED(pong_surface_name(s->world, s->ball_model, 1, &text), UNKNOWN_ID, "surface 1");
    REFUSED(pong_set_primitive_user_data(s->world, s->interfaces[0], 1, 5), UNKNOWN_ID, "primitive 1");
    REFUSED(pong_set_pair_enabled(s->world, s->pair, 2), BAD_VALUE, "`enabled` is 2");
    TEST(object.bits == 77 && interface.bits == 77 && text == NULL);
}

static void order_before_seal(scene *s)
{
    pong_world *clone = s->world;
    pong_slow_settings settings = pong_default_slow_settings();
    pong_slow_host *host = NULL;
    pong_wrench wrench;
    size_t size;
    pong_worker worker;
    const char *text;
    REFUSED(pong_create_slow_host(s->world, &settings, &host), WRONG_PHASE, "seal the world first");
    TEST(host == NULL);
    REFUSED(pong_clone_world(s->world, &clone), WRONG_PHASE, "seal the world first");
    TEST(clone == NULL);
    clone = s->world;
    REFUSED(pong_extend_world(s->world, &clone), WRONG_PHASE, "seal the world first");
    TEST(clone == NULL);
    REFUSED(pong_prewake(s->world, 100), WRONG_PHASE, "seal");
    REFUSED(pong_quiesce(s->world), WRONG_PHASE, "seal");
    REFUSED(pong_worker_count(s->world, &size), WRONG_PHASE, "seal");
    REFUSED(pong_get_worker(s->world, 0, &worker), WRONG_PHASE, "seal");
    REFUSED(pong_worker_text(s->world, 1, &text), WRONG_PHASE, "seal");
    REFUSED(pong_step(s->world), WRONG_PHASE, "seal");
    REFUSED(pong_evaluate(s->world), WRONG_PHASE, "seal");
    REFUSED(pong_commit(s->world), WRONG_PHASE, "seal");
    REFUSED(pong_commit_pairs(s->world, &s->pair, 1), WRONG_PHASE, "seal");
    REFUSED(pong_clear_contact_history(s->world, s->ball), WRONG_PHASE, "seal");
    REFUSED(pong_contact_state_size(s->world, &size), WRONG_PHASE, "seal");
    REFUSED(pong_contact_state_used(s->world, &size), WRONG_PHASE, "seal");
    REFUSED(pong_save_contact_state(s->world, &size, sizeof size), WRONG_PHASE, "seal");
    REFUSED(pong_restore_contact_state(s->world, &size, sizeof size), WRONG_PHASE, "seal");
    REFUSED(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_GROUP, &wrench), WRONG_PHASE, "evaluate");
}

static void order_after_seal(scene *s)
{
    pong_wrench wrench;
    pong_tangent tangent;
    pong_model_id model;
    pong_object_id object;
    size_t count;
    REFUSED(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_GROUP, &wrench), WRONG_PHASE, "evaluate");
    REFUSED(pong_get_tangents(s->world, &tangent, 1, &count), WRONG_PHASE, "evaluate a frame");
    REFUSED(pong_get_tangents_by_differences(s->world, &tangent, 1, &count), WRONG_PHASE, "evaluate a frame");
    REFUSED(pong_get_complete_tangents(s->world, &tangent, 1, &count), WRONG_PHASE, "evaluate a frame");
    REFUSED(pong_get_incremental_potentials(s->world, 1e-2, NULL, 0, &count), WRONG_PHASE, "evaluate a frame");
    REFUSED(pong_get_surface_slopes(s->world, s->ball_model, "x", "y", NULL, 0, &count), WRONG_PHASE, "evaluate a frame");
    REFUSED(pong_step(s->world), UNSET_STATE, "ball/ball");
    REFUSED(pong_commit(s->world), UNSET_STATE, "ball/ball");
    REFUSED(pong_seal(s->world, NULL), WRONG_PHASE, "before the world is sealed");
    REFUSED(load_text(s->world, BALL_MODEL, &model), WRONG_PHASE, "sealed");
    REFUSED(pong_create_object(s->world, s->ball_model, "late", &object), WRONG_PHASE, "sealed");
    REFUSED(pong_pair_objects(s->world, s->ball, s->ball, NULL), WRONG_PHASE, "sealed");
}

static void bad_states(scene *s)
{
    pong_wrench before = good_frame(s), after;
    pong_state states[3];
    pong_interface_id ids[3];
    int round;
    for (round = 0; round < 13; round += 1) {
        memcpy(states, s->states, sizeof states);
        states[0].position[2] = 0.05;
        ((double *)&states[1])[round] = round % 2 == 0 ? NAN : INFINITY;
        REFUSED(pong_set_states(s->world, s->interfaces, states, 3), BAD_STATE, "ball/ball/arm");
    }
    states[1] = s->states[1];
    memset(states[1].orientation, 0, sizeof states[1].orientation);
    REFUSED(pong_set_state(s->world, s->interfaces[1], &states[1]), BAD_STATE, "norm");
    memcpy(ids, s->interfaces, sizeof ids);
    ids[2].bits += 1;
    REFUSED(pong_set_states(s->world, ids, s->states, 3), UNKNOWN_ID, "interfaces[2]");
    REFUSED(pong_set_states(s->world, NULL, s->states, 3), NULL_ARGUMENT, "`interfaces`");
    REFUSED(pong_set_states(s->world, ids, NULL, 3), NULL_ARGUMENT, "`states`");
    REFUSED(pong_set_states(s->world, ids, s->states, (size_t)-1), BAD_VALUE, "true length");
    REFUSED(pong_set_states(s->world, (pong_interface_id *)((char *)ids + 1), s->states, 1), BAD_VALUE, "aligned");
    OK(pong_set_states(s->world, NULL, NULL, 0));
    OK(pong_evaluate(s->world));
    OK(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_GROUP, &after));
    TEST(memcmp(&before, &after, sizeof after) == 0);
}

/* Output arguments must not overlap inputs or other outputs: overlapping ones are refused and left untouched. */
static void shared_memory(scene *s)
{
    union {
        pong_interface_id interfaces[3];
        pong_wrench wrenches[3];
    } both;
    union {
        pong_contact contacts[4];
        size_t count;
    } listed;
    size_t before;
    memcpy(both.interfaces, s->interfaces, sizeof s->interfaces);
    REFUSED(pong_get_wrenches(s->world, both.interfaces, PONG_REFERENCE_FRAME_COMMON, both.wrenches, 3), BAD_VALUE,
            "`interfaces` and `wrenches` share memory");
    TEST(memcmp(both.interfaces, s->interfaces, sizeof s->interfaces) == 0);
    listed.count = before = 77;
    REFUSED(pong_get_contacts(s->world, listed.contacts, 4, &listed.count), BAD_VALUE, "`contacts` and `count`");
    REFUSED(pong_get_contacts(s->world, listed.contacts, 1, (size_t *)&listed.contacts[1] - 1), BAD_VALUE, "share memory");
    TEST(listed.count == before);
    OK(pong_get_contacts(s->world, listed.contacts, 3, (size_t *)&listed.contacts[3]));
}

/* One group with two states in a call: which is meant? Neither is taken. */
static void named_twice(scene *s)
{
    pong_interface_id twice[3];
    pong_state before, after;
    twice[0] = s->interfaces[0];
    twice[1] = s->interfaces[1];
    twice[2] = s->interfaces[0];
    OK(pong_get_state(s->world, twice[0], &before));
    s->states[2].position[0] += 1.0;
    REFUSED(pong_set_states(s->world, twice, s->states, 3), DUPLICATE, "interfaces[0] and interfaces[2] are both `ball`");
    s->states[2].position[0] -= 1.0;
    OK(pong_get_state(s->world, twice[0], &after));
    TEST(memcmp(&before, &after, sizeof after) == 0);
    OK(pong_set_states(s->world, twice, s->states, 2));
    OK(pong_set_states(s->world, twice + 1, s->states + 1, 1));
}

static void bad_tangents(scene *s)
{
    pong_contact_tangent contact;
    pong_tangent tangent;
    size_t count = 77;
    REFUSED(pong_get_contact_tangents(s->world, NULL, 0, &count), BUFFER_TOO_SMALL, "there are 1");
    TEST(count == 1);
    REFUSED(pong_get_contact_tangents(s->world, NULL, 1, &count), NULL_ARGUMENT, "`tangents`");
    REFUSED(pong_get_contact_tangents(s->world, &contact, 1, NULL), NULL_ARGUMENT, "`count`");
    REFUSED(pong_get_contact_tangents(s->world, (pong_contact_tangent *)&count, 1, &count), BAD_VALUE, "share memory");
    OK(pong_evaluate(s->world));
    count = 77;
    REFUSED(pong_get_tangents(s->world, NULL, 0, &count), BUFFER_TOO_SMALL, "there are 1");
    TEST(count == 1);
    REFUSED(pong_get_tangents(s->world, NULL, 1, &count), NULL_ARGUMENT, "`tangents`");
    REFUSED(pong_get_tangents(s->world, &tangent, 1, NULL), NULL_ARGUMENT, "`count`");
    REFUSED(pong_get_tangents(NULL, &tangent, 1, &count), NULL_ARGUMENT, "`world`");
    count = 77;
    REFUSED(pong_get_tangents_by_differences(s->world, NULL, 0, &count), BUFFER_TOO_SMALL, "there are 1");
    TEST(count == 1);
    REFUSED(pong_get_tangents_by_differences(s->world, NULL, 1, &count), NULL_ARGUMENT, "`tangents`");
    REFUSED(pong_get_tangents_by_differences(s->world, &tangent, 1, NULL), NULL_ARGUMENT, "`count`");
    REFUSED(pong_get_complete_tangents(s->world, NULL, 1, &count), NULL_ARGUMENT, "`tangents`");
    REFUSED(pong_get_complete_tangents(s->world, &tangent, 1, NULL), NULL_ARGUMENT, "`count`");
}

/* Inputs of a frame in which the ball falls at the arm's side and the ground stands. */
static void slow_inputs(const scene *s, pong_slow_input *inputs)
{
    int i;
    memset(inputs, 0, 3 * sizeof *inputs);
    for (i = 0; i < 3; i += 1) {
        inputs[i].interface = s->interfaces[i];
        inputs[i].state = s->states[i];
        inputs[i].dynamics = i == 0 ? PONG_DYNAMICS_FREE : i == 1 ? PONG_DYNAMICS_JOINTED : PONG_DYNAMICS_PRESCRIBED;
        inputs[i].mass.mass = 1.0;
        inputs[i].mass.inertia[0] = inputs[i].mass.inertia[1] = inputs[i].mass.inertia[2] = 1e-3;
        inputs[i].mobility[6 * 2 + 2] = 0.5;
    }
}

static void bad_slow_settings(scene *s)
{
    pong_slow_settings settings = pong_default_slow_settings();
    pong_slow_host *host = (pong_slow_host *)s;
    REFUSED(pong_create_slow_host(NULL, &settings, &host), NULL_ARGUMENT, "`world`");
    TEST(host == NULL);
    REFUSED(pong_create_slow_host(s->world, NULL, &host), NULL_ARGUMENT, "`settings`");
    REFUSED(pong_create_slow_host(s->world, &settings, NULL), NULL_ARGUMENT, "`host`");
    settings.theta = 1.5;
    REFUSED(pong_create_slow_host(s->world, &settings, &host), BAD_VALUE, "`theta`: it is 1.5");
    settings = pong_default_slow_settings();
    settings.substeps_max = 0;
    REFUSED(pong_create_slow_host(s->world, &settings, &host), BAD_VALUE, "`substeps_max`: it is 0");
    settings = pong_default_slow_settings();
    settings.delay_frames = 1025;
    REFUSED(pong_create_slow_host(s->world, &settings, &host), BAD_VALUE, "`delay_frames`: it is 1025");
    settings = pong_default_slow_settings();
    settings.reserved[3] = 1;
    REFUSED(pong_create_slow_host(s->world, &settings, &host), BAD_VALUE, "reserved");
    TEST(host == NULL);
}

/* Each refused frame leaves nothing behind: the state is the same bytes afterwards. */
static void bad_slow_inputs(scene *s, pong_slow_host *host)
{
    pong_slow_input inputs[4];
    slow_inputs(s, inputs);
    inputs[3] = inputs[0];
    REFUSED(pong_step_slow(NULL, 0.01, inputs, 3), NULL_ARGUMENT, "`host`");
    REFUSED(pong_step_slow(host, 0.01, NULL, 3), NULL_ARGUMENT, "`inputs`");
    REFUSED(pong_step_slow(host, 0.0, inputs, 3), BAD_VALUE, "length of the frame: it is 0 s");
    REFUSED(pong_step_slow(host, NAN, inputs, 3), BAD_VALUE, "length of the frame");
    REFUSED(pong_step_slow(host, 0.01, inputs, 2), BAD_VALUE, "mass of `ground/ground`: it is missing");
    REFUSED(pong_step_slow(host, 0.01, NULL, 0), BAD_VALUE, "it is missing");
    REFUSED(pong_step_slow(host, 0.01, inputs, 4), BAD_VALUE, "given twice");
    inputs[0].mass.mass = 0.0;
    REFUSED(pong_step_slow(host, 0.01, inputs, 3), BAD_VALUE, "mass of `ball/ball`: it is 0 kg");
    slow_inputs(s, inputs);
    inputs[0].mass.inertia[1] = 0.0;
    REFUSED(pong_step_slow(host, 0.01, inputs, 3), BAD_VALUE, "inertia of `ball/ball`");
    slow_inputs(s, inputs);
    inputs[1].mobility[6 * 2 + 2] = -0.5;
    REFUSED(pong_step_slow(host, 0.01, inputs, 3), BAD_VALUE, "mobility of `ball/ball/arm`");
    slow_inputs(s, inputs);
    inputs[2].dynamics = 0;
    REFUSED(pong_step_slow(host, 0.01, inputs, 3), BAD_VALUE, "inputs[2].dynamics: it is 0");
    slow_inputs(s, inputs);
    inputs[1].reserved = 1;
    REFUSED(pong_step_slow(host, 0.01, inputs, 3), BAD_VALUE, "inputs[1].reserved");
    slow_inputs(s, inputs);
    inputs[0].linear_acceleration[2] = INFINITY;
    REFUSED(pong_step_slow(host, 0.01, inputs, 3), BAD_VALUE, "acceleration of `ball/ball`");
    slow_inputs(s, inputs);
    inputs[0].state.orientation[0] = 2.0;
    REFUSED(pong_step_slow(host, 0.01, inputs, 3), BAD_STATE, "norm");
    slow_inputs(s, inputs);
    inputs[0].interface.bits += 7;
    REFUSED(pong_step_slow(host, 0.01, inputs, 3), UNKNOWN_ID, "interface");
}

static void bad_slow_results(scene *s, pong_slow_host *host)
{
    pong_slow_difference differences[3];
    pong_slow_report report;
    pong_wrench wrench;
    unsigned char state[65536];
    size_t size, count = 77;
    REFUSED(pong_get_slow_wrenches(host, s->interfaces, 9, &wrench, 1), BAD_VALUE, "`frame` is 9");
    REFUSED(pong_get_slow_wrenches(host, s->interfaces, PONG_REFERENCE_FRAME_COMMON, NULL, 1), NULL_ARGUMENT, "`wrenches`");
    REFUSED(pong_get_slow_report(NULL, &report), NULL_ARGUMENT, "`host`");
    REFUSED(pong_get_slow_report(host, NULL), NULL_ARGUMENT, "`report`");
    REFUSED(pong_get_slow_differences(host, NULL, 0, &count), BUFFER_TOO_SMALL, "there are 3");
    TEST(count == 3);
    REFUSED(pong_get_slow_differences(host, NULL, 3, &count), NULL_ARGUMENT, "`differences`");
    REFUSED(pong_get_slow_differences(host, differences, 3, NULL), NULL_ARGUMENT, "`count`");
    REFUSED(pong_slow_state_size(host, NULL), NULL_ARGUMENT, "`size`");
    OK(pong_slow_state_size(host, &count));
    OK(pong_save_slow_state(host, state, sizeof state, &size));
    TEST(size > 1000 && size <= count);
    REFUSED(pong_save_slow_state(host, state, size - 1, NULL), BUFFER_TOO_SMALL, "make it larger");
    REFUSED(pong_save_slow_state(host, NULL, size, &size), NULL_ARGUMENT, "`buffer`");
    REFUSED(pong_restore_slow_state(host, state, size - 1), BAD_STATE_BLOCK, "damaged");
    REFUSED(pong_restore_slow_state(host, NULL, size), NULL_ARGUMENT, "`buffer`");
    state[100] ^= 1;
    REFUSED(pong_restore_slow_state(host, state, size), BAD_STATE_BLOCK, "nothing was restored");
    REFUSED(pong_restore_slow_state(host, state, 0), BAD_STATE_BLOCK, "damaged");
}

static void slow_host(scene *s)
{
    pong_slow_settings settings = pong_default_slow_settings();
    pong_slow_host *host = NULL;
    pong_slow_input inputs[3];
    pong_wrench wrench;
    unsigned char before[65536], after[65536];
    size_t size, again;
    bad_slow_settings(s);
    OK(pong_create_slow_host(s->world, &settings, &host));
    REFUSED(pong_commit_slow(host), WRONG_PHASE, "evaluate a frame first");
    REFUSED(pong_get_slow_wrenches(host, s->interfaces, PONG_REFERENCE_FRAME_COMMON, &wrench, 1), WRONG_PHASE, "evaluate");
    slow_inputs(s, inputs);
    OK(pong_step_slow(host, 0.01, inputs, 3));
    OK(pong_save_slow_state(host, before, sizeof before, &size));
    OK(pong_evaluate_slow(host, 0.01, inputs, 3));
    bad_slow_inputs(s, host);
    REFUSED(pong_commit_slow(host), WRONG_PHASE, "evaluate a frame first");
    bad_slow_results(s, host);
    OK(pong_save_slow_state(host, after, sizeof after, &again));
    TEST(size == again && memcmp(before, after, size) == 0);
    OK(pong_destroy_slow_host(host));
    OK(pong_destroy_slow_host(NULL));
}

static void bad_results(scene *s)
{
    pong_wrench wrench;
    pong_contact contact;
    pong_tally tally;
    pong_pair_energy_account pair_account;
    double number = 0.0;
    pong_worker worker;
    const char *text;
    pong_interface_id wild = { 12345 };
    pong_pair_id no_pair = { 0 };
    size_t count = 77;
    good_frame(s);
    named_twice(s);
    good_frame(s);
    REFUSED(pong_get_wrench(s->world, s->interfaces[0], 2, &wrench), BAD_VALUE, "`frame` is 2");
    REFUSED(pong_get_wrench(s->world, s->interfaces[0], PONG_REFERENCE_FRAME_GROUP, NULL), NULL_ARGUMENT, "`wrench`");
    REFUSED(pong_get_wrenches(s->world, &wild, PONG_REFERENCE_FRAME_COMMON, &wrench, 1), UNKNOWN_ID, "interfaces[0]");
    shared_memory(s);
    REFUSED(pong_get_wrenches(s->world, NULL, PONG_REFERENCE_FRAME_COMMON, &wrench, 1), NULL_ARGUMENT, "`interfaces`");
    REFUSED(pong_get_wrenches(s->world, &wild, PONG_REFERENCE_FRAME_COMMON, NULL, 1), NULL_ARGUMENT, "`wrenches`");
    OK(pong_get_wrenches(s->world, NULL, PONG_REFERENCE_FRAME_COMMON, NULL, 0));
    REFUSED(pong_get_contacts(s->world, NULL, 0, &count), BUFFER_TOO_SMALL, "there are 1");
    TEST(count == 1);
    REFUSED(pong_get_contacts(s->world, &contact, 1, NULL), NULL_ARGUMENT, "`count`");
    REFUSED(pong_get_contacts(s->world, NULL, 1, &count), NULL_ARGUMENT, "`contacts`");
    OK(pong_get_contacts(s->world, &contact, 1, &count));
    REFUSED(pong_get_contact_stiffness(s->world, &number, NULL, 1, &count), NULL_ARGUMENT, "`damping`");
    REFUSED(pong_get_contact_stiffness(s->world, NULL, &number, 1, &count), NULL_ARGUMENT, "`stiffness`");
    REFUSED(pong_get_contact_stiffness(s->world, &number, &number, 1, &count), BAD_VALUE, "`damping`");
    REFUSED(pong_get_contact_stiffness(s->world, NULL, NULL, 0, NULL), NULL_ARGUMENT, "`count`");
    bad_tangents(s);
    REFUSED(pong_get_report(s->world, NULL), NULL_ARGUMENT, "`report`");
    REFUSED(pong_tally_count(s->world, NULL), NULL_ARGUMENT, "`count`");
    REFUSED(pong_get_tally(s->world, 0, NULL), NULL_ARGUMENT, "`tally`");
    REFUSED(pong_get_tally(s->world, 99, &tally), UNKNOWN_ID, "tally 99");
    REFUSED(pong_worker_count(s->world, NULL), NULL_ARGUMENT, "`count`");
    REFUSED(pong_get_worker(s->world, 0, NULL), NULL_ARGUMENT, "`worker`");
    REFUSED(pong_get_worker(s->world, 1, &worker), UNKNOWN_ID, "worker 1: there are 0");
    REFUSED(pong_worker_text(s->world, 1, NULL), NULL_ARGUMENT, "`text`");
    REFUSED(pong_worker_text(s->world, 0, &text), UNKNOWN_ID, "worker 0");
    REFUSED(pong_get_ledger(s->world, NULL), NULL_ARGUMENT, "`ledger`");
    REFUSED(pong_get_energy_account(s->world, NULL), NULL_ARGUMENT, "`account`");
    REFUSED(pong_pair_energy_account_count(s->world, NULL), NULL_ARGUMENT, "`count`");
    REFUSED(pong_get_pair_energy_account(s->world, 0, NULL), NULL_ARGUMENT, "`account`");
    REFUSED(pong_get_pair_energy_account(s->world, 0, &pair_account), UNKNOWN_ID, "pair account 0");
    REFUSED(pong_pair_remedy(s->world, 0, NULL), NULL_ARGUMENT, "`remedy`");
    REFUSED(pong_pair_remedy(s->world, 0, &text), UNKNOWN_ID, "pair account 0");
    REFUSED(pong_get_contact_energy_accounts(s->world, NULL, 0, NULL), NULL_ARGUMENT, "`count`");
    OK(pong_get_contact_energy_accounts(s->world, NULL, 0, &count));
    TEST(count == 0);
    REFUSED(pong_commit_pairs(s->world, &no_pair, 1), UNKNOWN_ID, "pair");
    REFUSED(pong_commit_pairs(s->world, NULL, 1), NULL_ARGUMENT, "`pairs`");
    OK(pong_commit_pairs(s->world, NULL, 0));
}

static void no_world(void)
{
    pong_interface_id interface = { 0 };
    pong_state state = pong_default_state();
    pong_wrench wrench;
    size_t size;
    pong_worker worker;
    pong_tally tally;
    const char *text;
    REFUSED(pong_seal(NULL, NULL), NULL_ARGUMENT, "`world`");
    REFUSED(pong_set_states(NULL, &interface, &state, 1), NULL_ARGUMENT, "`world`");
    REFUSED(pong_prewake(NULL, 100), NULL_ARGUMENT, "`world`");
    REFUSED(pong_quiesce(NULL), NULL_ARGUMENT, "`world`");
    REFUSED(pong_worker_count(NULL, &size), NULL_ARGUMENT, "`world`");
    REFUSED(pong_get_worker(NULL, 0, &worker), NULL_ARGUMENT, "`world`");
    REFUSED(pong_worker_text(NULL, 1, &text), NULL_ARGUMENT, "`world`");
    REFUSED(pong_tally_count(NULL, &size), NULL_ARGUMENT, "`world`");
    REFUSED(pong_get_tally(NULL, 0, &tally), NULL_ARGUMENT, "`world`");
    REFUSED(pong_step(NULL), NULL_ARGUMENT, "`world`");
    REFUSED(pong_evaluate(NULL), NULL_ARGUMENT, "`world`");
    REFUSED(pong_commit(NULL), NULL_ARGUMENT, "`world`");
    REFUSED(pong_get_wrench(NULL, interface, PONG_REFERENCE_FRAME_GROUP, &wrench), NULL_ARGUMENT, "`world`");
    REFUSED(pong_contact_count(NULL, &size), NULL_ARGUMENT, "`world`");
    REFUSED(pong_contact_state_size(NULL, &size), NULL_ARGUMENT, "`world`");
}

/* Ids of a world that is gone, used in a living one that was built by the same calls. */
static void stale_ids(scene *s)
{
    scene gone;
    pong_config config = pong_default_config();
    pong_wrench wrench;
    open_scene(&gone, &config);
    OK(pong_destroy_world(gone.world));
    REFUSED(pong_set_state(s->world, gone.interfaces[0], &s->states[0]), UNKNOWN_ID, "interface");
    REFUSED(pong_get_wrench(s->world, gone.interfaces[0], PONG_REFERENCE_FRAME_GROUP, &wrench), UNKNOWN_ID, "interface");
    REFUSED(pong_clear_contact_history(s->world, gone.ball), UNKNOWN_ID, "object");
    REFUSED(pong_set_pair_enabled(s->world, gone.pair, 0), UNKNOWN_ID, "pair");
    REFUSED(pong_set_object_user_data(s->world, gone.ball, 1), UNKNOWN_ID, "object");
}

int main(void)
{
    scene s;
    pong_config config = pong_default_config();
    pong_wrench first, last;
    versions();
    configurations();
    worker_settings();
    no_world();
    open_scene(&s, &config);
    models(&s);
    names_and_ids(&s);
    order_before_seal(&s);
    OK(pong_seal(s.world, NULL));
    order_after_seal(&s);
    first = good_frame(&s);
    TEST(first.force[2] > 9.9 && first.force[2] < 10.1);
    bad_states(&s);
    bad_results(&s);
    slow_host(&s);
    stale_ids(&s);
    last = good_frame(&s);
    TEST(memcmp(&first, &last, sizeof first) == 0);
    OK(pong_destroy_world(s.world));
    return report_failures("misuse");
}
