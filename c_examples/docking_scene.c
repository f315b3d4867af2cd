#include "docking_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void check(pong_status status, const char *call)
{
    if (status != PONG_STATUS_OK) {
        fprintf(stderr, "%s: %s: %s\n", call, pong_status_name(status), pong_last_message());
        exit(3);
    }
}

static pong_object_id add_object(pong_world *world, const char *folder, const char *file, const char *name)
{
    char path[1024];
    pong_model_id model;
    pong_object_id object;
    if (snprintf(path, sizeof path, "%s/%s", folder, file) >= (int)sizeof path) {
        fprintf(stderr, "the path of the models is too long\n");
        exit(2);
    }
    CHECK(pong_load_model(world, path, &model));
    CHECK(pong_create_object(world, model, name, &object));
    return object;
}

static vec3 from_array(const double a[3]) { return v3(a[0], a[1], a[2]); }

/* Reads the model poses of the latches, in the ring's frame. */
static void place_latches(contact_scene *scene, docking *d)
{
    pong_state ring, latch;
    int i;
    CHECK(pong_get_authored_state(scene->world, scene->parts[RING], &ring));
    d->ring_extension = ring.position[2];
    for (i = 0; i < LATCHES; i++) {
        quat turn;
        CHECK(pong_get_authored_state(scene->world, scene->parts[FIRST_LATCH + i], &latch));
        turn.w = latch.orientation[0];
        turn.x = latch.orientation[1];
        turn.y = latch.orientation[2];
        turn.z = latch.orientation[3];
        place_latch(d, i, sub(from_array(latch.position), from_array(ring.position)), turn);
    }
}

void open_scene(contact_scene *scene, const pong_config *config, const char *models, docking *d)
{
    pong_seal_report sealed;
    int i;

    CHECK(PONG_CHECK_ABI());
    CHECK(pong_create_world(config, &scene->world));
    scene->chaser = add_object(scene->world, models, "idss_active.ron", "chaser");
    scene->target = add_object(scene->world, models, "idss_passive.ron", "target");
    CHECK(pong_pair_objects(scene->world, scene->chaser, scene->target, NULL));
    CHECK(pong_find_interface(scene->world, scene->chaser, "", &scene->parts[VEHICLE]));
    CHECK(pong_find_interface(scene->world, scene->chaser, "ring", &scene->parts[RING]));
    for (i = 0; i < LATCHES; i++) {
        char name[24];
        sprintf(name, "latch_%d", i);
        CHECK(pong_find_interface(scene->world, scene->chaser, name, &scene->parts[FIRST_LATCH + i]));
    }
    CHECK(pong_find_interface(scene->world, scene->target, "", &scene->parts[TARGET]));
    CHECK(pong_seal(scene->world, &sealed));
    place_latches(scene, d);
    printf("pong %s: %u pairs of movable groups, room for %u contacts\n", pong_version_string(),
           (unsigned)sealed.group_pairs, (unsigned)sealed.contact_capacity);
}

pong_state to_state(motion m)
{
    pong_state s = pong_default_state();
    s.position[0] = m.position.x, s.position[1] = m.position.y, s.position[2] = m.position.z;
    s.orientation[0] = m.orientation.w, s.orientation[1] = m.orientation.x;
    s.orientation[2] = m.orientation.y, s.orientation[3] = m.orientation.z;
    s.linear_velocity[0] = m.velocity.x, s.linear_velocity[1] = m.velocity.y, s.linear_velocity[2] = m.velocity.z;
    s.angular_velocity[0] = m.rate.x, s.angular_velocity[1] = m.rate.y, s.angular_velocity[2] = m.rate.z;
    return s;
}

void send_states(contact_scene *scene, const docking *d)
{
    pong_state states[PARTS];
    int i;
    states[VEHICLE] = to_state(chaser_port(d));
    states[RING] = to_state(d->ring);
    for (i = 0; i < LATCHES; i++) {
        states[FIRST_LATCH + i] = to_state(latch_motion(d, i));
    }
    states[TARGET] = to_state(target_port(d));
    CHECK(pong_set_states(scene->world, scene->parts, states, PARTS));
}

wrench from_wrench(const pong_wrench *w)
{
    wrench out;
    out.force = from_array(w->force);
    out.moment = from_array(w->moment);
    return out;
}

contact_wrenches fetch_wrenches(contact_scene *scene)
{
    pong_wrench wrenches[PARTS];
    contact_wrenches out;
    int i;
    CHECK(pong_get_wrenches(scene->world, scene->parts, PONG_REFERENCE_FRAME_COMMON, wrenches, PARTS));
    out.vehicle = from_wrench(&wrenches[VEHICLE]);
    out.ring = from_wrench(&wrenches[RING]);
    for (i = 0; i < LATCHES; i++) {
        out.latch[i] = from_wrench(&wrenches[FIRST_LATCH + i]);
    }
    out.target = from_wrench(&wrenches[TARGET]);
    return out;
}

/* --- cases --------------------------------------------------------------------------------------------------------- */

docking_case make_case(const char *name, double speed)
{
    docking_case c;
    memset(&c, 0, sizeof c);
    snprintf(c.name, sizeof c.name, "%s", name);
    c.speed = speed;
    return c;
}

docking_case corner(int index)
{
    static const double side[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    static const char *const lateral[4] = {"x+", "x-", "y+", "y-"};
    static const char *const tilt[4] = {"pitch+", "pitch-", "yaw+", "yaw-"};
    int fast = index / 32, l = index / 8 % 4, roll = index / 4 % 2, t = index % 4;
    docking_case c = make_case("", fast ? 0.10 : 0.05);
    snprintf(c.name, sizeof c.name, "%s,%s,roll%s,%s", fast ? "fast" : "slow", lateral[l], roll ? "-" : "+", tilt[t]);
    c.lateral_x = 0.10 * side[l][0];
    c.lateral_y = 0.10 * side[l][1];
    c.roll = roll ? -4.0 : 4.0;
    c.pitch = 4.0 * side[t][0];
    c.yaw = 4.0 * side[t][1];
    return c;
}

int find_case(const char *name, docking_case *c)
{
    int i;
    if (strcmp(name, "aligned") == 0 || strcmp(name, "slow") == 0) {
        *c = make_case(name, name[0] == 'a' ? 0.10 : 0.05);
        return 1;
    }
    for (i = 0; i < CORNERS; i++) {
        *c = corner(i);
        if (strcmp(c->name, name) == 0) {
            return 1;
        }
    }
    return 0;
}

void approach(docking *d, const docking_case *c, double gap, int moving)
{
    vec3 aside = v3(c->lateral_x, c->lateral_y, 0.0);
    vec3 tilt = scale(v3(c->pitch, c->yaw, c->roll), DEGREE);
    vec3 velocity = v3(0, 0, 0), rate = v3(0, 0, 0);
    if (moving) {
        vec3 sense = v3((c->pitch > 0) - (c->pitch < 0), (c->yaw > 0) - (c->yaw < 0), (c->roll > 0) - (c->roll < 0));
        rate = scale(sense, c->turn_rate * DEGREE);
        velocity = v3(0.0, 0.0, c->speed);
        if (norm(aside) > 0.0) {
            velocity = add(velocity, scale(aside, c->lateral_rate / norm(aside)));
        }
    }
    place_chaser(d, add(aside, v3(0.0, 0.0, -gap)), tilt, velocity, rate);
}

static size_t contacts_at(contact_scene *scene, docking *d, const docking_case *c, double gap)
{
    size_t count;
    approach(d, c, gap, 0);
    send_states(scene, d);
    CHECK(pong_evaluate(scene->world));
    CHECK(pong_contact_count(scene->world, &count));
    return count;
}

double first_contact_gap(contact_scene *scene, docking *d, const docking_case *c)
{
    double near_ = 0.45, far_ = 0.45;
    int i;
    while (near_ > -0.05 && contacts_at(scene, d, c, near_) == 0) {
        far_ = near_;
        near_ -= 0.004;
    }
    for (i = 0; i < 12; i++) {
        double middle = 0.5 * (near_ + far_);
        if (contacts_at(scene, d, c, middle) == 0) {
            far_ = middle;
        } else {
            near_ = middle;
        }
    }
    return far_;
}
