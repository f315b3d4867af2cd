#include "docking_dynamics.h"

/* --- set-up ---------------------------------------------------------------------------------------------------- */

void docking_defaults(docking *d)
{
    static const docking zero;
    attenuation capture = {2000.0, 500.0, 200.0, 100.0, 200.0, 60.0};
    attenuation settle = {5000.0, 9000.0, 2000.0, 3500.0, 4000.0, 40000.0};
    int i;

    *d = zero;
    d->chaser.mass = 12000.0;
    d->chaser.inertia_xy = 76000.0;
    d->chaser.inertia_z = 24000.0;
    d->chaser.port = 4.5;
    d->target.mass = 420000.0;
    d->target.inertia_xy = 1.2e8;
    d->target.inertia_z = 1.2e8;
    d->target.port = 20.0;

    d->ring_mass = 57.0;
    d->ring_inertia_xy = 11.0;
    d->ring_inertia_z = 20.0;
    d->ring_extension = 0.300;
    d->capture = capture;
    d->settle = settle;
    d->settle_ramp = 2.0;

    d->latch_mass = 1.0;
    d->latch_preload = 10.0;
    d->latch_k = 300.0;
    d->latch_c = 5.0;
    d->stop_k = 1e5;
    d->stop_c = 300.0;
    for (i = 0; i < LATCHES; i++) {
        d->latches[i].turn.w = 1.0;
        d->latches[i].slide = v3(1.0, 0.0, 0.0);
    }
}

void place_latch(docking *d, int index, vec3 place, quat turn)
{
    latch *l = &d->latches[index];
    l->place = place;
    l->turn = turn;
    l->slide = rotate(turn, v3(1.0, 0.0, 0.0));
}

void place_chaser(docking *d, vec3 offset, vec3 tilt, vec3 velocity, vec3 rate)
{
    quat facing = {0.0, 1.0, 0.0, 0.0};
    quat turn = quat_exp(tilt);
    vec3 along = rotate(turn, v3(0.0, 0.0, 1.0));
    int i;

    d->target.centre.orientation = facing;
    d->target.centre.position = v3(0.0, 0.0, d->target.port);
    d->target.centre.velocity = d->target.centre.rate = v3(0.0, 0.0, 0.0);

    d->ring.position = offset;
    d->ring.orientation = turn;
    d->ring.rate = rate;
    d->ring.velocity = velocity;
    d->chaser.centre.position = sub(offset, scale(along, d->ring_extension + d->chaser.port));
    d->chaser.centre.orientation = turn;
    d->chaser.centre.rate = rate;
    d->chaser.centre.velocity = add(velocity, cross(rate, sub(d->chaser.centre.position, offset)));
    for (i = 0; i < LATCHES; i++) {
        latch *l = &d->latches[i];
        vec3 arm = rotate(turn, l->place);
        l->travel = d->latches_locked ? -0.030 : d->latch_preload / d->stop_k;
        l->speed = dot(rotate(turn, l->slide), add(velocity, cross(rate, arm)));
    }
    d->settling = 0.0;
    d->captured = 0;
    d->lost = d->actuator_work = d->contact_work = 0.0;
    d->attenuation_force = d->attenuation_moment = 0.0;
}

/* --- motion of parts -------------------------------------------------------------------------------------------- */

static motion at_arm(const motion *m, vec3 arm_in_body)
{
    motion out = *m;
    vec3 arm = rotate(m->orientation, arm_in_body);
    out.position = add(m->position, arm);
    out.velocity = add(m->velocity, cross(m->rate, arm));
    return out;
}

motion chaser_port(const docking *d) { return at_arm(&d->chaser.centre, v3(0.0, 0.0, d->chaser.port)); }
motion target_port(const docking *d) { return at_arm(&d->target.centre, v3(0.0, 0.0, d->target.port)); }

/* Speed of a latch along its slide against the ring. */
static double sliding(const docking *d, const latch *l, vec3 *axis)
{
    motion here = at_arm(&d->ring, add(l->place, scale(l->slide, l->travel)));
    *axis = rotate(d->ring.orientation, l->slide);
    return l->speed - dot(*axis, here.velocity);
}

motion latch_motion(const docking *d, int index)
{
    const latch *l = &d->latches[index];
    vec3 axis;
    double speed = sliding(d, l, &axis);
    motion m = at_arm(&d->ring, add(l->place, scale(l->slide, l->travel)));
    m.velocity = add(m.velocity, scale(axis, speed));
    m.orientation = quat_times(m.orientation, l->turn);
    return m;
}

/* --- forces ------------------------------------------------------------------------------------------------------ */

static attenuation present(const docking *d)
{
    const attenuation *a = &d->capture, *b = &d->settle;
    double s = d->settling;
    attenuation p;
    p.axial_k = a->axial_k + s * (b->axial_k - a->axial_k);
    p.axial_c = a->axial_c + s * (b->axial_c - a->axial_c);
    p.lateral_k = a->lateral_k + s * (b->lateral_k - a->lateral_k);
    p.lateral_c = a->lateral_c + s * (b->lateral_c - a->lateral_c);
    p.turning_k = a->turning_k + s * (b->turning_k - a->turning_k);
    p.turning_c = a->turning_c + s * (b->turning_c - a->turning_c);
    return p;
}

/* Displacement and rotation of the ring from its place on the vehicle, in the common frame; `axis` is the
 * vehicle's. */
static void stretch(const docking *d, vec3 *displacement, vec3 *rotation, vec3 *axis)
{
    motion port = chaser_port(d);
    *axis = rotate(port.orientation, v3(0.0, 0.0, 1.0));
    *displacement = sub(sub(d->ring.position, port.position), scale(*axis, d->ring_extension));
    *rotation = rotate(port.orientation, quat_log(quat_times(conjugate(port.orientation), d->ring.orientation)));
}

/* Scales a vector differently along an axis and across it: a*across + (along - across)*axis*(axis.a). */
static vec3 by_axis(vec3 a, vec3 axis, double along, double across)
{
    return add(scale(a, across), scale(axis, (along - across) * dot(axis, a)));
}

/* Force of spring and stop on a latch along its slide, and what of it is lost per second. */
static double latch_force(const docking *d, double travel, double speed, double *lost_power)
{
    double damping = -d->latch_c * speed;
    double force = d->latch_preload - d->latch_k * travel + damping;
    *lost_power = -damping * speed;
    if (travel > 0.0) {
        double push = d->stop_k * travel + d->stop_c * speed;
        if (push > 0.0) {
            force -= push;
            *lost_power += (push - d->stop_k * travel) * speed;
        } else {
            *lost_power += -d->stop_k * travel * speed;
        }
    }
    return force;
}

/* --- one step ---------------------------------------------------------------------------------------------------- */

static void push_vehicle(vehicle *v, vec3 force, vec3 moment, vec3 at, double dt)
{
    motion *c = &v->centre;
    vec3 w, torque, gyro, turn;
    torque = add(moment, cross(sub(at, c->position), force));
    w = rotate_back(c->orientation, c->rate);
    torque = rotate_back(c->orientation, torque);
    gyro = cross(w, v3(v->inertia_xy * w.x, v->inertia_xy * w.y, v->inertia_z * w.z));
    torque = sub(torque, gyro);
    turn = v3(torque.x / v->inertia_xy, torque.y / v->inertia_xy, torque.z / v->inertia_z);
    c->velocity = add(c->velocity, scale(force, dt / v->mass));
    c->rate = add(c->rate, scale(rotate(c->orientation, turn), dt));
}

static void move(motion *m, double dt)
{
    m->position = add(m->position, scale(m->velocity, dt));
    m->orientation = quat_turned(m->orientation, m->rate, dt);
}

/* Inertia of the ring about its origin in the common frame, with that of the latches across their slides, which
 * the ring has to carry along: rows and columns are velocity, then angular rate. */
static void ring_inertia(const docking *d, double m[6][6])
{
    vec3 axes[3], arm[LATCHES], slide[LATCHES];
    int i, j, k;
    axes[0] = v3(1, 0, 0);
    axes[1] = v3(0, 1, 0);
    axes[2] = v3(0, 0, 1);
    for (k = 0; k < LATCHES; k++) {
        arm[k] = rotate(d->ring.orientation, d->latches[k].place);
        slide[k] = rotate(d->ring.orientation, d->latches[k].slide);
    }
    for (i = 0; i < 6; i++) {
        for (j = 0; j < 6; j++) {
            m[i][j] = 0.0;
        }
    }
    for (i = 0; i < 3; i++) {
        vec3 z = rotate(d->ring.orientation, axes[2]);
        vec3 column = by_axis(axes[i], z, d->ring_inertia_z, d->ring_inertia_xy);
        m[i][i] = d->ring_mass;
        m[3][3 + i] = column.x;
        m[4][3 + i] = column.y;
        m[5][3 + i] = column.z;
    }
    for (k = 0; k < LATCHES; k++) {
        for (j = 0; j < 6; j++) {
            vec3 v = j < 3 ? axes[j] : cross(axes[j - 3], arm[k]);
            vec3 p = scale(sub(v, scale(slide[k], dot(slide[k], v))), d->latch_mass);
            vec3 l = cross(arm[k], p);
            m[0][j] += p.x;
            m[1][j] += p.y;
            m[2][j] += p.z;
            m[3][j] += l.x;
            m[4][j] += l.y;
            m[5][j] += l.z;
        }
    }
}

static double power(const wrench *w, const motion *m)
{
    return dot(w->force, m->velocity) + dot(w->moment, m->rate);
}

static double contact_power(const docking *d, const contact_wrenches *c)
{
    motion port = chaser_port(d), target = target_port(d);
    double sum = power(&c->vehicle, &port) + power(&c->ring, &d->ring) + power(&c->target, &target);
    int i;
    for (i = 0; i < LATCHES; i++) {
        motion m = latch_motion(d, i);
        sum += power(&c->latch[i], &m);
    }
    return sum;
}

void docking_step(docking *d, const contact_wrenches *contact, double dt)
{
    attenuation a = present(d);
    motion vehicle_at_ring, port = chaser_port(d), target = target_port(d);
    vec3 displacement, rotation, axis, spring, spring_moment, damper, damper_moment, old_slip, old_turn;
    vec3 force = contact->ring.force, moment = contact->ring.moment;
    double m[6][6], rhs[6], twist[6], latch_impulse[LATCHES];
    double power_before = contact_power(d, contact);
    int i, j;

    /* The attenuation's springs at the present place. */
    stretch(d, &displacement, &rotation, &axis);
    spring = scale(by_axis(displacement, axis, a.axial_k, a.lateral_k), -1.0);
    spring_moment = scale(rotation, -a.turning_k);
    vehicle_at_ring = d->chaser.centre;
    vehicle_at_ring.velocity = add(d->chaser.centre.velocity,
                                   cross(d->chaser.centre.rate, sub(d->ring.position, d->chaser.centre.position)));

    /* The latches: free along their slides; all else that acts on them goes to the ring. */
    for (i = 0; i < LATCHES; i++) {
        latch *l = &d->latches[i];
        vec3 slide, on_ring = contact->latch[i].force, arm;
        double lost_power, along, own, speed = sliding(d, l, &slide);
        arm = rotate(d->ring.orientation, add(l->place, scale(l->slide, l->travel)));
        latch_impulse[i] = 0.0;
        if (!d->latches_locked) {
            along = dot(slide, contact->latch[i].force);
            own = latch_force(d, l->travel, speed, &lost_power);
            on_ring = sub(on_ring, scale(slide, along + own));
            latch_impulse[i] = (along + own) * dt;
            d->lost += lost_power * dt;
        }
        force = add(force, on_ring);
        moment = add(moment, add(contact->latch[i].moment, cross(arm, on_ring)));
    }

    /* The ring: dampers implicit in its own new velocity, because it is light against what they brake. */
    old_slip = sub(d->ring.velocity, vehicle_at_ring.velocity);
    old_turn = sub(d->ring.rate, d->chaser.centre.rate);
    ring_inertia(d, m);
    for (i = 0; i < 6; i++) {
        double v[6];
        v[0] = d->ring.velocity.x, v[1] = d->ring.velocity.y, v[2] = d->ring.velocity.z;
        v[3] = d->ring.rate.x, v[4] = d->ring.rate.y, v[5] = d->ring.rate.z;
        rhs[i] = 0.0;
        for (j = 0; j < 6; j++) {
            rhs[i] += m[i][j] * v[j];
        }
    }
    {
        vec3 drag = by_axis(vehicle_at_ring.velocity, axis, a.axial_c, a.lateral_c);
        vec3 turn_drag = scale(d->chaser.centre.rate, a.turning_c);
        vec3 unit[3], total = add(add(force, spring), drag), total_moment;
        total_moment = add(add(moment, spring_moment), turn_drag);
        unit[0] = v3(1, 0, 0);
        unit[1] = v3(0, 1, 0);
        unit[2] = v3(0, 0, 1);
        rhs[0] += dt * total.x, rhs[1] += dt * total.y, rhs[2] += dt * total.z;
        rhs[3] += dt * total_moment.x, rhs[4] += dt * total_moment.y, rhs[5] += dt * total_moment.z;
        for (i = 0; i < 3; i++) {
            vec3 column = scale(by_axis(unit[i], axis, a.axial_c, a.lateral_c), dt);
            m[0][i] += column.x;
            m[1][i] += column.y;
            m[2][i] += column.z;
            m[3 + i][3 + i] += dt * a.turning_c;
        }
    }
    solve6(m, rhs, twist);
    d->ring.velocity = v3(twist[0], twist[1], twist[2]);
    d->ring.rate = v3(twist[3], twist[4], twist[5]);
    damper = scale(by_axis(sub(d->ring.velocity, vehicle_at_ring.velocity), axis, a.axial_c, a.lateral_c), -1.0);
    damper_moment = scale(sub(d->ring.rate, d->chaser.centre.rate), -a.turning_c);

    /* The vehicles: contact on their ports, and the attenuation's reaction where it holds the ring. */
    {
        vec3 reaction = scale(add(spring, damper), -1.0);
        vec3 reaction_moment = scale(add(spring_moment, damper_moment), -1.0);
        d->attenuation_force = norm(reaction);
        d->attenuation_moment = norm(reaction_moment);
        push_vehicle(&d->chaser, contact->vehicle.force, contact->vehicle.moment, port.position, dt);
        push_vehicle(&d->chaser, reaction, reaction_moment, d->ring.position, dt);
        push_vehicle(&d->target, contact->target.force, contact->target.moment, target.position, dt);
    }
    for (i = 0; i < LATCHES; i++) {
        latch *l = &d->latches[i];
        if (d->latches_locked) {
            motion here = at_arm(&d->ring, add(l->place, scale(l->slide, l->travel)));
            l->speed = dot(rotate(d->ring.orientation, l->slide), here.velocity);
        } else {
            l->speed += latch_impulse[i] / d->latch_mass;
        }
    }

    /* Account: what dampers took and contact gave, by the mean of the velocities before and after. */
    {
        motion now = d->chaser.centre;
        vec3 slip, turn;
        now.velocity = add(now.velocity, cross(now.rate, sub(d->ring.position, now.position)));
        slip = scale(add(old_slip, sub(d->ring.velocity, now.velocity)), 0.5);
        turn = scale(add(old_turn, sub(d->ring.rate, now.rate)), 0.5);
        d->lost -= dt * (dot(damper, slip) + dot(damper_moment, turn));
        d->contact_work += dt * 0.5 * (power_before + contact_power(d, contact));
    }

    for (i = 0; i < LATCHES; i++) {
        vec3 slide;
        double speed = sliding(d, &d->latches[i], &slide);
        d->latches[i].travel += dt * (d->latches_locked ? 0.0 : speed);
    }
    move(&d->ring, dt);
    move(&d->chaser.centre, dt);
    move(&d->target.centre, dt);

    /* After soft capture the actuators stiffen; what that puts into stretched springs is work of theirs. */
    if (d->captured && d->settling < 1.0) {
        double before = spring_energy(d);
        d->settling = fmin(1.0, d->settling + dt / d->settle_ramp);
        d->actuator_work += spring_energy(d) - before;
    }
}

/* --- energies and alignment --------------------------------------------------------------------------------------- */

static double vehicle_energy(const vehicle *v)
{
    vec3 w = rotate_back(v->centre.orientation, v->centre.rate);
    double turning = v->inertia_xy * (w.x * w.x + w.y * w.y) + v->inertia_z * w.z * w.z;
    return 0.5 * (v->mass * dot(v->centre.velocity, v->centre.velocity) + turning);
}

double kinetic_energy(const docking *d)
{
    double m[6][6], v[6], sum = vehicle_energy(&d->chaser) + vehicle_energy(&d->target);
    int i, j;
    ring_inertia(d, m);
    v[0] = d->ring.velocity.x, v[1] = d->ring.velocity.y, v[2] = d->ring.velocity.z;
    v[3] = d->ring.rate.x, v[4] = d->ring.rate.y, v[5] = d->ring.rate.z;
    for (i = 0; i < 6; i++) {
        for (j = 0; j < 6; j++) {
            sum += 0.5 * v[i] * m[i][j] * v[j];
        }
    }
    for (i = 0; i < LATCHES; i++) {
        sum += 0.5 * d->latch_mass * d->latches[i].speed * d->latches[i].speed;
    }
    return sum;
}

double spring_energy(const docking *d)
{
    attenuation a = present(d);
    vec3 displacement, rotation, axis;
    double sum, stroke;
    int i;
    stretch(d, &displacement, &rotation, &axis);
    stroke = dot(axis, displacement);
    sum = a.axial_k * stroke * stroke + a.lateral_k * (dot(displacement, displacement) - stroke * stroke);
    sum = 0.5 * (sum + a.turning_k * dot(rotation, rotation));
    for (i = 0; i < LATCHES; i++) {
        double s = d->latches[i].travel;
        if (!d->latches_locked) {
            sum += 0.5 * d->latch_k * s * s - d->latch_preload * s;
            sum += s > 0.0 ? 0.5 * d->stop_k * s * s : 0.0;
        }
    }
    return sum;
}

alignment align(const docking *d)
{
    motion port = chaser_port(d), target = target_port(d);
    vec3 away = rotate(target.orientation, v3(0.0, 0.0, 1.0)); /* from the target towards the chaser */
    vec3 ring_axis = rotate(d->ring.orientation, v3(0.0, 0.0, 1.0));
    vec3 vehicle_axis = rotate(port.orientation, v3(0.0, 0.0, 1.0));
    vec3 offset = sub(d->ring.position, target.position), drift = sub(port.velocity, target.velocity);
    vec3 displacement, rotation, axis, turn;
    quat mated = {0.0, 1.0, 0.0, 0.0}; /* the target's port seen from a mated ring */
    alignment a;

    a.gap = dot(away, offset);
    a.lateral = norm(sub(offset, scale(away, a.gap)));
    a.tilt = norm(cross(ring_axis, away));
    turn = quat_log(quat_times(quat_times(mated, conjugate(target.orientation)), d->ring.orientation));
    a.roll = turn.z;
    stretch(d, &displacement, &rotation, &axis);
    a.stroke = -dot(axis, displacement);
    a.closing = -dot(away, drift);
    drift = sub(drift, cross(target.rate, sub(port.position, target.position)));
    a.drift = norm(drift);
    a.turning = norm(sub(d->chaser.centre.rate, d->target.centre.rate));
    a.vehicle_tilt = norm(cross(vehicle_axis, away));
    return a;
}
