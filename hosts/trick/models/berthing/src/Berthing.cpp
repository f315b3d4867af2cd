/************************************************************************
PURPOSE: (The jobs of a simulation with contact.)
LIBRARY DEPENDENCIES: ((berthing/src/Berthing.cpp))
************************************************************************/
#include "berthing/include/Berthing.hh"

#include "trick/exec_proto.h"
#include "trick/integrator_c_intf.h"

#include <cmath>
#include <cstring>

namespace {

const int BODIES = 2;

void set3(double out[3], double x, double y, double z) {
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

void set_diagonal(double out[3][3], double x, double y, double z) {
    const double diagonal[3] = {x, y, z};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out[i][j] = i == j ? diagonal[i] : 0.0;
        }
    }
}

void send(const RigidBody &body, PongPort &port) {
    std::memcpy(port.position, body.position, sizeof port.position);
    std::memcpy(port.orientation, body.orientation, sizeof port.orientation);
    std::memcpy(port.linear_velocity, body.linear_velocity, sizeof port.linear_velocity);
    std::memcpy(port.angular_velocity, body.angular_velocity, sizeof port.angular_velocity);
}

/* Third row of the rotation from group to common components: how far a group vector reaches along the common z. */
double rise(const double q[4], double x, double y, double z) {
    return 2.0 * (q[1] * q[3] - q[0] * q[2]) * x + 2.0 * (q[2] * q[3] + q[0] * q[1]) * y +
           (1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2])) * z;
}

} // namespace

Berthing::Berthing() : cut_at_touch(0), touch_time(-1.0), integrations_back(0), gap() {}

/* The numbers of scene/scene.ron: `pong run` computes the same. */
int Berthing::default_data() {
    payload.mass = 500.0;
    set_diagonal(payload.inertia, 60.0, 70.0, 80.0);
    set3(payload.mass_center, 0.02, -0.01, 0.6);
    set3(payload.thrust, 0.0, 0.0, -150.0);
    set3(payload.position, 0.1, -0.05, 0.006);
    payload.orientation[0] = 0.99995;
    set3(payload.orientation + 1, 0.008, -0.006, 0.0);
    set3(payload.linear_velocity, 0.03, 0.02, -0.05);
    set3(payload.angular_velocity, 0.0, 0.0, 0.05);

    platform.mass = 4000.0;
    set_diagonal(platform.inertia, 1400.0, 1400.0, 2700.0);
    set3(platform.mass_center, 0.0, 0.0, -0.05);

    contact.models = "../scene";
    contact.add_port("payload", "payload.ron", "");
    contact.add_port("platform", "platform.ron", "");
    contact.add_pair("payload", "platform");
    return 0;
}

int Berthing::initialize() {
    if (payload.initialize() != 0 || platform.initialize() != 0) {
        exec_terminate_with_return(1, __FILE__, __LINE__,
                                   "Berthing: mass and inertia of a body must be positive; check the input file");
        return 1;
    }
    touch_time = -1.0;
    gap.mode = Decreasing;
    gap.error_tol = 1e-9;
    reset_regula_falsi(0.0, &gap);
    if (contact.initialize() != 0) {
        return 1;
    }
    /* Contacts that there are at the start have a past from the first frame on. */
    return accept();
}

void Berthing::exchange() {
    send(payload, contact.ports[0]);
    send(platform, contact.ports[1]);
}

/* A derivative job: any number of times in a step, and with a dynamic event at times that go back. */
int Berthing::derivatives() {
    exchange();
    contact.evaluate();
    payload.clear_wrench();
    platform.clear_wrench();
    payload.add_wrench(contact.ports[0].force, contact.ports[0].moment);
    platform.add_wrench(contact.ports[1].force, contact.ports[1].moment);
    return 0;
}

int Berthing::integrate() {
    RigidBody *const bodies[BODIES] = {&payload, &platform};
    double numbers[RIGID_BODY_NUMBERS], rates[RIGID_BODY_NUMBERS];
    integrations_back += get_intermediate_step() == 0 && get_integ_dt() < 0.0;
    for (int b = 0; b < BODIES; b++) {
        bodies[b]->get_numbers(numbers);
        bodies[b]->derivatives(rates);
        for (int i = 0; i < RIGID_BODY_NUMBERS; i++) {
            load_indexed_state(b * RIGID_BODY_NUMBERS + i, numbers[i]);
            load_indexed_deriv(b * RIGID_BODY_NUMBERS + i, rates[i]);
        }
    }
    const int pass = ::integrate();
    for (int b = 0; b < BODIES; b++) {
        for (int i = 0; i < RIGID_BODY_NUMBERS; i++) {
            numbers[i] = unload_indexed_state(b * RIGID_BODY_NUMBERS + i);
        }
        bodies[b]->set_numbers(numbers);
        if (pass == 0) {
            bodies[b]->end_step();
        }
    }
    return pass;
}

/* Height of the lowest foot above the platform's face while that is level, as it is until the first touch, m. */
double Berthing::feet_gap() const {
    const double radius = 0.05, side = 0.4330127018922193;
    const double feet[3][2] = {{0.5, 0.0}, {-0.25, side}, {-0.25, -side}};
    double lowest = INFINITY;
    for (int i = 0; i < 3; i++) {
        const double center = payload.position[2] + rise(payload.orientation, feet[i][0], feet[i][1], radius);
        lowest = std::fmin(lowest, center - radius - platform.position[2]);
    }
    return lowest;
}

/* A dynamic_event job. Trick steps back and forth until the root is found; nothing of that reaches a commit. */
double Berthing::touch() {
    if (!cut_at_touch || touch_time >= 0.0) {
        return BIG_TGO;
    }
    const double now = get_integ_time();
    gap.error = feet_gap();
    const double to_go = regula_falsi(now, &gap);
    if (to_go == 0.0) {
        touch_time = now;
        set3(payload.thrust, 0.0, 0.0, 0.0);
        reset_regula_falsi(now, &gap);
    }
    return to_go;
}

/* A post_integration job: the step is accepted, events included. */
int Berthing::accept() {
    exchange();
    return contact.commit();
}
