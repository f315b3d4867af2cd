/* Vectors, quaternions and a small linear solver for docking.c: what a simulation executive brings along anyway. */
#ifndef DOCKING_MATH_H
#define DOCKING_MATH_H

#include <math.h>

#define DEGREE 0.017453292519943295

typedef struct { double x, y, z; } vec3;
typedef struct { double w, x, y, z; } quat; /* Hamilton; turns body components into common ones */

static inline vec3 v3(double x, double y, double z) { vec3 a = {x, y, z}; return a; }
static inline vec3 add(vec3 a, vec3 b) { return v3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline vec3 sub(vec3 a, vec3 b) { return v3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline vec3 scale(vec3 a, double s) { return v3(a.x * s, a.y * s, a.z * s); }
static inline double dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double norm(vec3 a) { return sqrt(dot(a, a)); }

static inline vec3 cross(vec3 a, vec3 b)
{
    return v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline quat quat_times(quat a, quat b)
{
    quat q = {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
              a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
    return q;
}

static inline quat conjugate(quat q) { quat c = {q.w, -q.x, -q.y, -q.z}; return c; }

static inline vec3 rotate(quat q, vec3 a)
{
    vec3 u = v3(q.x, q.y, q.z);
    vec3 t = scale(cross(u, a), 2.0);
    return add(add(a, scale(t, q.w)), cross(u, t));
}

static inline vec3 rotate_back(quat q, vec3 a) { return rotate(conjugate(q), a); }

/* Rotation vector (axis times angle, rad) to quaternion. */
static inline quat quat_exp(vec3 a)
{
    double angle = norm(a);
    double s = angle > 1e-9 ? sin(angle / 2) / angle : 0.5;
    quat q = {cos(angle / 2), a.x * s, a.y * s, a.z * s};
    return q;
}

/* Quaternion to rotation vector, angle below 180 degrees. */
static inline vec3 quat_log(quat q)
{
    double sign = q.w < 0 ? -1.0 : 1.0;
    vec3 u = v3(sign * q.x, sign * q.y, sign * q.z);
    double s = norm(u);
    return scale(u, s > 1e-9 ? 2.0 * atan2(s, sign * q.w) / s : 2.0);
}

static inline quat quat_unit(quat q)
{
    double s = 1.0 / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    quat u = {q.w * s, q.x * s, q.y * s, q.z * s};
    return u;
}

/* Turns by an angular velocity (common frame) over a time. */
static inline quat quat_turned(quat q, vec3 rate, double dt)
{
    return quat_unit(quat_times(quat_exp(scale(rate, dt)), q));
}

/* Solves a x = b for a symmetric positive definite 6x6 matrix, which is overwritten. */
static inline void solve6(double a[6][6], const double b[6], double x[6])
{
    int i, j, k;
    for (i = 0; i < 6; i++) {
        x[i] = b[i];
    }
    for (k = 0; k < 6; k++) {
        for (i = k + 1; i < 6; i++) {
            double f = a[i][k] / a[k][k];
            for (j = k; j < 6; j++) {
                a[i][j] -= f * a[k][j];
            }
            x[i] -= f * x[k];
        }
    }
    for (k = 5; k >= 0; k--) {
        for (j = k + 1; j < 6; j++) {
            x[k] -= a[k][j] * x[j];
        }
        x[k] /= a[k][k];
    }
}

#endif
