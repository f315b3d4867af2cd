/************************************************************************
PURPOSE: (Newton and Euler for one rigid body.)
LIBRARY DEPENDENCIES: ((berthing/src/RigidBody.cpp))
************************************************************************/
#include "berthing/include/RigidBody.hh"

#include <cmath>

namespace {

/* Below this angle (rad) quotients that lose digits are replaced by their series. */
const double SMALL_ANGLE = 0.05;

void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void multiply(const double m[3][3], const double a[3], double out[3]) {
    for (int i = 0; i < 3; i++) {
        out[i] = dot(m[i], a);
    }
}

/* Turns group components into common ones; with `sense` -1 the other way. */
void rotate(const double q[4], const double a[3], double out[3], double sense = 1.0) {
    const double u[3] = {sense * q[1], sense * q[2], sense * q[3]};
    double t[3], s[3];
    cross(u, a, t);
    for (int i = 0; i < 3; i++) {
        t[i] *= 2.0;
    }
    cross(u, t, s);
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] + q[0] * t[i] + s[i];
    }
}

/* Quaternion of a rotation vector (axis times angle). */
void exponential(const double vector[3], double q[4]) {
    const double half = 0.5 * std::sqrt(dot(vector, vector)), square = half * half;
    const double ratio = half < SMALL_ANGLE
        ? 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)))
        : std::sin(half) / half;
    q[0] = std::cos(half);
    for (int i = 0; i < 3; i++) {
        q[i + 1] = 0.5 * ratio * vector[i];
    }
}

void product(const double a[4], const double b[4], double out[4]) {
    out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    out[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    out[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    out[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

void normalize(double q[4]) {
    const double norm = std::sqrt(q[0] * q[0] + dot(q + 1, q + 1));
    for (int i = 0; i < 4; i++) {
        q[i] /= norm;
    }
}

/* Rate of a rotation vector whose body turns with `rate`, both along fixed axes. */
void rotation_vector_rate(const double turn[3], const double rate[3], double out[3]) {
    const double angle = std::sqrt(dot(turn, turn)), square = angle * angle;
    const double second = angle < SMALL_ANGLE
        ? 1.0 / 12.0 + square / 720.0 + square * square / 30240.0
        : (1.0 - 0.5 * angle * std::cos(0.5 * angle) / std::sin(0.5 * angle)) / square;
    double once[3], twice[3];
    cross(turn, rate, once);
    cross(turn, once, twice);
    for (int i = 0; i < 3; i++) {
        out[i] = rate[i] - 0.5 * once[i] + second * twice[i];
    }
}

bool invert(const double m[3][3], double out[3][3]) {
    double columns[3][3];
    for (int i = 0; i < 3; i++) {
        cross(m[(i + 1) % 3], m[(i + 2) % 3], columns[i]);
    }
    const double determinant = dot(m[0], columns[0]);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out[i][j] = columns[j][i] / determinant;
        }
    }
    return determinant > 0.0;
}

} // namespace

RigidBody::RigidBody()
    : mass(), inertia(), mass_center(), thrust(), position(), orientation(), linear_velocity(), angular_velocity(),
      center(), velocity(), momentum(), attitude(), turn(), force(), moment(), inverse_inertia() {
    orientation[0] = 1.0;
}

/* From the motion of the group frame to the state. Returns 1 if mass or inertia are not positive. */
int RigidBody::initialize() {
    double arm[3], swing[3], spin[3], group_momentum[3];
    if (!(mass > 0.0) || !invert(inertia, inverse_inertia)) {
        return 1;
    }
    normalize(orientation);
    rotate(orientation, mass_center, arm);
    cross(angular_velocity, arm, swing);
    rotate(orientation, angular_velocity, spin, -1.0);
    multiply(inertia, spin, group_momentum);
    rotate(orientation, group_momentum, momentum);
    for (int i = 0; i < 3; i++) {
        center[i] = position[i] + arm[i];
        velocity[i] = linear_velocity[i] + swing[i];
        turn[i] = 0.0;
    }
    for (int i = 0; i < 4; i++) {
        attitude[i] = orientation[i];
    }
    update_motion();
    return 0;
}

/* Computes the motion of the group frame, for the contact engine and for displays. */
void RigidBody::update_motion() {
    double step[4], spin[3], rate[3], group_momentum[3], arm[3], swing[3];
    exponential(turn, step);
    product(step, attitude, orientation);
    rotate(orientation, momentum, group_momentum, -1.0);
    multiply(inverse_inertia, group_momentum, spin);
    rotate(orientation, spin, rate);
    rotate(orientation, mass_center, arm);
    cross(rate, arm, swing);
    for (int i = 0; i < 3; i++) {
        angular_velocity[i] = rate[i];
        position[i] = center[i] - arm[i];
        linear_velocity[i] = velocity[i] - swing[i];
    }
}

void RigidBody::clear_wrench() {
    rotate(orientation, thrust, force);
    moment[0] = moment[1] = moment[2] = 0.0;
}

/* A force and a moment about the group's origin, along common axes. */
void RigidBody::add_wrench(const double added_force[3], const double added_moment[3]) {
    double arm[3], lever[3];
    rotate(orientation, mass_center, arm);
    cross(arm, added_force, lever);
    for (int i = 0; i < 3; i++) {
        force[i] += added_force[i];
        moment[i] += added_moment[i] - lever[i];
    }
}

void RigidBody::derivatives(double out[RIGID_BODY_NUMBERS]) const {
    double turn_rate[3];
    rotation_vector_rate(turn, angular_velocity, turn_rate);
    for (int i = 0; i < 3; i++) {
        out[i] = velocity[i];
        out[3 + i] = force[i] / mass;
        out[6 + i] = turn_rate[i];
        out[9 + i] = moment[i];
    }
}

void RigidBody::get_numbers(double out[RIGID_BODY_NUMBERS]) const {
    for (int i = 0; i < 3; i++) {
        out[i] = center[i];
        out[3 + i] = velocity[i];
        out[6 + i] = turn[i];
        out[9 + i] = momentum[i];
    }
}

void RigidBody::set_numbers(const double in[RIGID_BODY_NUMBERS]) {
    for (int i = 0; i < 3; i++) {
        center[i] = in[i];
        velocity[i] = in[3 + i];
        turn[i] = in[6 + i];
        momentum[i] = in[9 + i];
    }
    update_motion();
}

/* The last pass of an integration: the orientation that was reached is where the next step starts. */
void RigidBody::end_step() {
    normalize(orientation);
    for (int i = 0; i < 4; i++) {
        attitude[i] = orientation[i];
    }
    turn[0] = turn[1] = turn[2] = 0.0;
    update_motion();
}
