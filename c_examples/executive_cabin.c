#include "executive_cabin.h"

#include "docking_scene.h"

#include <string.h>

/* Six walls, seen from inside; the stiffness suits 2 kg and held wrenches at 100 Hz (docs/advise.md). */
static const char CABIN[] =
    "(format: \"pong-model\", version: 1, name: \"cabin\",\n"
    " surfaces: { \"padding\": (\n"
    "   stiffness: 2000.0, normal: Linear(damping: 40.0, ramp: 1e-3), friction: Bristle(mu: 0.3)) },\n"
    " root: (name: \"cabin\", surface: \"padding\", primitives: [\n"
    "   Plane(name: \"aft\", normal: (0, 0, 1), offset: -1.0),\n"
    "   Plane(name: \"forward\", normal: (0, 0, -1), offset: -1.0),\n"
    "   Plane(name: \"left\", normal: (1, 0, 0), offset: -1.0),\n"
    "   Plane(name: \"right\", normal: (-1, 0, 0), offset: -1.0),\n"
    "   Plane(name: \"floor\", normal: (0, 1, 0), offset: -1.0),\n"
    "   Plane(name: \"roof\", normal: (0, -1, 0), offset: -1.0),\n"
    " ]))";
static const char TOOL[] =
    "(format: \"pong-model\", version: 1, name: \"tool\",\n"
    " surfaces: { \"grip\": (stiffness: inf, friction: Bristle(mu: 0.3)) },\n"
    " root: (name: \"tool\", surface: \"grip\", primitives: [Sphere(name: \"ball\", center: (0, 0, 0), radius: 0.1)]))";

static pong_object_id add_object(pong_world *world, const char *text, size_t length, const char *name)
{
    pong_model_id model;
    pong_object_id object;
    CHECK(pong_load_model_text(world, text, length, name, NULL, &model));
    CHECK(pong_create_object(world, model, name, &object));
    return object;
}

void open_cabin(cabin *c)
{
    pong_config config = pong_default_config();
    pong_object_id walls, tool;

    memset(c, 0, sizeof *c);
    c->tool_mass = 2.0;
    c->tool_inertia = 0.008;
    CHECK(pong_create_world(&config, &c->world));
    walls = add_object(c->world, CABIN, sizeof CABIN - 1, "cabin");
    tool = add_object(c->world, TOOL, sizeof TOOL - 1, "tool");
    CHECK(pong_pair_objects(c->world, walls, tool, NULL));
    CHECK(pong_find_interface(c->world, walls, "", &c->parts[0]));
    CHECK(pong_find_interface(c->world, tool, "", &c->parts[1]));
    CHECK(pong_seal(c->world, NULL));
}

void place_tool(cabin *c, const motion *chaser)
{
    c->tool = *chaser;
    c->tool.position = add(chaser->position, rotate(chaser->orientation, v3(0.2, 0.1, 0.85)));
    c->tool.velocity = add(chaser->velocity, v3(0.05, 0.02, 0.08));
    c->on_cabin.force = c->on_cabin.moment = v3(0.0, 0.0, 0.0);
}

void cabin_frame(cabin *c, const motion *chaser)
{
    pong_state states[2];
    pong_wrench wrenches[2];
    wrench on_tool;

    states[0] = to_state(*chaser);
    states[1] = to_state(c->tool);
    CHECK(pong_set_states(c->world, c->parts, states, 2));
    CHECK(pong_step(c->world));
    CHECK(pong_get_wrenches(c->world, c->parts, PONG_REFERENCE_FRAME_COMMON, wrenches, 2));
    c->on_cabin = from_wrench(&wrenches[0]);
    on_tool = from_wrench(&wrenches[1]);
    c->tool.velocity = add(c->tool.velocity, scale(on_tool.force, CABIN_FRAME_S / c->tool_mass));
    c->tool.rate = add(c->tool.rate, scale(on_tool.moment, CABIN_FRAME_S / c->tool_inertia));
    c->tool.position = add(c->tool.position, scale(c->tool.velocity, CABIN_FRAME_S));
    c->tool.orientation = quat_turned(c->tool.orientation, c->tool.rate, CABIN_FRAME_S);
}
