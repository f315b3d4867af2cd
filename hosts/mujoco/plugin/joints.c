#include "joints.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- small matrices */

/* Transform of a twist to another origin and axes: v' = R(v + w x r), w' = R w. R and r belong to the old
 * frame. */
static void make_carrier(mjtNum T[36], const mjtNum R[9], const mjtNum r[3])
{
    /* w x r = -[r] w */
    const mjtNum cross[9] = {0, r[2], -r[1], -r[2], 0, r[0], r[1], -r[0], 0};
    mjtNum turned[9];
    int i, k;
    mju_zero(T, 36);
    mju_mulMatMat(turned, R, cross, 3, 3, 3);
    for (i = 0; i < 3; i++)
        for (k = 0; k < 3; k++) {
            T[6 * i + k] = T[6 * (i + 3) + k + 3] = R[3 * i + k];
            T[6 * i + k + 3] = turned[3 * i + k];
        }
}

/* T Y T', exactly symmetric. */
static void carry(mjtNum out[36], const mjtNum T[36], const mjtNum Y[36])
{
    mjtNum half[36], whole[36];
    int i, k;
    mju_mulMatMat(half, T, Y, 6, 6, 6);
    mju_mulMatMatT(whole, half, T, 6, 6, 6);
    for (i = 0; i < 6; i++)
        for (k = 0; k < 6; k++)
            out[6 * i + k] = 0.5 * (whole[6 * i + k] + whole[6 * k + i]);
}

/* Y moved to a point r, along the same axes. */
static void shift(mjtNum out[36], const mjtNum Y[36], const mjtNum r[3])
{
    static const mjtNum unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    mjtNum T[36];
    make_carrier(T, unit, r);
    carry(out, T, Y);
}

/* ---- masses */

static int is_static(const mjModel *m, int body)
{
    const int top = m->body_weldid[body];
    return top == 0 || m->body_mocapid[top] >= 0;
}

/* Pose of a body in the frame of the body it is welded to, both at the reference pose. */
static void pose_in_weld(const mjModel *m, int body, mjtNum place[3], mjtNum quat[4])
{
    const int top = m->body_weldid[body];
    mju_zero3(place);
    mju_zero4(quat), quat[0] = 1;
    for (; body != top; body = m->body_parentid[body]) {
        mjtNum turned[3], product[4];
        mju_rotVecQuat(turned, place, m->body_quat + 4 * body);
        mju_add3(place, turned, m->body_pos + 3 * body);
        mju_mulQuat(product, m->body_quat + 4 * body, quat);
        mju_copy4(quat, product);
    }
}

/* Adds the inertia of a body's own mass about a point, in the frame of the weld. */
static void add_inertia(mjtNum inertia[9], const mjModel *m, int body, const mjtNum about[3])
{
    mjtNum place[3], quat[4], axes[4], R[9], arm[3], centre[3];
    const mjtNum *principal = m->body_inertia + 3 * body, mass = m->body_mass[body];
    int i, k, j;
    pose_in_weld(m, body, place, quat);
    mju_rotVecQuat(centre, m->body_ipos + 3 * body, quat);
    mju_addTo3(centre, place);
    mju_sub3(arm, centre, about);
    mju_mulQuat(axes, quat, m->body_iquat + 4 * body);
    mju_quat2Mat(R, axes);
    for (i = 0; i < 3; i++)
        for (k = 0; k < 3; k++) {
            for (j = 0; j < 3; j++)
                inertia[3 * i + k] += R[3 * i + j] * principal[j] * R[3 * k + j];
            inertia[3 * i + k] += mass * ((i == k ? mju_dot3(arm, arm) : 0) - arm[i] * arm[k]);
        }
}

pong_mass mass_of(const mjModel *m, int body)
{
    pong_mass mass;
    const int top = m->body_weldid[body];
    mjtNum centre[3] = {0, 0, 0}, inertia[9] = {0}, place[3], quat[4], back[4], own[9], R[9], half[9];
    int other, i;
    memset(&mass, 0, sizeof mass);
    if (is_static(m, body)) {
        mass.mass = INFINITY;
        return mass;
    }
    for (other = 1; other < m->nbody; other++)
        if (m->body_weldid[other] == top) {
            mjtNum at[3];
            pose_in_weld(m, other, place, quat);
            mju_rotVecQuat(at, m->body_ipos + 3 * other, quat);
            mju_addTo3(at, place);
            mju_addToScl3(centre, at, m->body_mass[other]);
            mass.mass += m->body_mass[other];
        }
    mju_scl3(centre, centre, mass.mass > 0 ? 1 / mass.mass : 0);
    for (other = 1; other < m->nbody; other++)
        if (m->body_weldid[other] == top)
            add_inertia(inertia, m, other, centre);
    /* From the frame of the weld into that of the body. */
    pose_in_weld(m, body, place, quat);
    mju_negQuat(back, quat);
    mju_quat2Mat(R, back);
    mju_mulMatMat(half, R, inertia, 3, 3, 3);
    mju_mulMatMatT(own, half, R, 3, 3, 3);
    mju_subFrom3(centre, place);
    mju_rotVecQuat(mass.mass_center, centre, back);
    for (i = 0; i < 3; i++)
        mass.inertia[i] = own[4 * i];
    mass.inertia[3] = own[1], mass.inertia[4] = own[2], mass.inertia[5] = own[5];
    return mass;
}

/* ---- compliances */

static void free_compliance(mjtNum Y[36], const pong_mass *mass)
{
    const double *i = mass->inertia, *c = mass->mass_center;
    const mjtNum inertia[9] = {i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2]}, back[3] = {-c[0], -c[1], -c[2]};
    mjtNum at_centre[36] = {0}, root[9], column[3];
    int k, j;
    mju_copy(root, inertia, 9);
    for (k = 0; k < 3; k++)
        at_centre[7 * k] = 1 / mass->mass;
    /* Angular rows stay zero for a body without inertia, as for an unknown one. */
    if (mju_cholFactor(root, 3, DBL_MIN) == 3)
        for (k = 0; k < 3; k++) {
            const mjtNum unit[3] = {k == 0, k == 1, k == 2};
            mju_cholSolve(column, root, unit, 3);
            for (j = 0; j < 3; j++)
                at_centre[6 * (j + 3) + k + 3] = column[j];
        }
    shift(Y, at_centre, back);
}

/* Two directions that make a right-handed frame with a unit vector. */
static void complete(mjtNum frame[9], const mjtNum axis[3])
{
    const mjtNum unit[3] = {fabs(axis[0]) < 0.5, fabs(axis[0]) >= 0.5, 0};
    mju_copy3(frame + 6, axis);
    mju_cross(frame, unit, axis);
    mju_normalize3(frame);
    mju_cross(frame + 3, axis, frame);
}

/* Part of a joint: its own frame, the rows that it holds, and a bound of the compliance above it, in that
 * frame. */
typedef struct joint_part {
    mjtNum frame[9], anchor[3];
    int held[6]; /* along the frame's axes: linear x, y, z, angular x, y, z */
    mjtNum above[36];
} joint_part;

static void bound_hinge(joint_part *part)
{
    mjtNum sum[36] = {0};
    int turn;
    for (turn = 0; turn < 4; turn++) {
        static const mjtNum quarters[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, none[3] = {0, 0, 0};
        const mjtNum c = quarters[turn][0], s = quarters[turn][1], R[9] = {c, s, 0, -s, c, 0, 0, 0, 1};
        mjtNum T[36], turned[36];
        make_carrier(T, R, none);
        carry(turned, T, part->above);
        mju_addTo(sum, turned, 36);
    }
    mju_copy(part->above, sum, 36);
    part->held[5] = 0;
}

static void bound_ball(joint_part *part)
{
    const mjtNum trace = part->above[0] + part->above[7] + part->above[14];
    int i;
    mju_zero(part->above, 36);
    for (i = 0; i < 3; i++) {
        part->above[7 * i] = trace;
        part->held[i + 3] = 0;
    }
}

/* Bounds a slide; returns 0 where its travel is unbounded and the body above turns. */
static int bound_slide(joint_part *part, const mjModel *m, int joint)
{
    const mjtNum *range = m->jnt_range + 2 * joint, reference = m->qpos0[m->jnt_qposadr[joint]];
    mjtNum sum[36] = {0};
    int turns = 0, i;
    for (i = 3; i < 6; i++)
        turns |= part->above[7 * i] > 0;
    part->held[2] = 0;
    if (!turns)
        return 1;
    if (!m->jnt_limited[joint])
        return 0;
    for (i = 0; i < 2; i++) {
        const mjtNum along[3] = {0, 0, range[i] - reference};
        mjtNum moved[36];
        shift(moved, part->above, along);
        mju_addTo(sum, moved, 36);
    }
    mju_copy(part->above, sum, 36);
    return 1;
}

/* Y - Y N'(N (Y + above) N')^-1 N Y with the held rows N, all in the frame of the joint. */
static void hold(mjtNum Y[36], const joint_part *part)
{
    mjtNum inner[36], rows[36], solved[6];
    int list[6], count = 0, i, k, j;
    for (i = 0; i < 6; i++)
        if (part->held[i])
            list[count++] = i;
    for (i = 0; i < count; i++) {
        mju_copy(rows + 6 * i, Y + 6 * list[i], 6);
        for (k = 0; k < count; k++)
            inner[count * i + k] = Y[6 * list[i] + list[k]] + part->above[6 * list[i] + list[k]];
    }
    /* A body without inertia stays free. */
    if (mju_cholFactor(inner, count, DBL_MIN) < count)
        return;
    for (j = 0; j < 6; j++) {
        mjtNum column[6];
        for (i = 0; i < count; i++)
            column[i] = rows[6 * i + j];
        mju_cholSolve(solved, inner, column, count);
        for (k = 0; k < 6; k++)
            for (i = 0; i < count; i++)
                Y[6 * k + j] -= rows[6 * i + k] * solved[i];
    }
}

/* The only joint of a body, with the compliance above it in the body's axes at its origin. Returns 0 if no
 * bound is known. */
static int read_joint(joint_part *part, const mjModel *m, int body, const mjtNum above[36])
{
    const int joint = m->body_jntadr[body], type = m->jnt_type[joint];
    mjtNum T[36];
    int i;
    if (m->body_jntnum[body] != 1 || type == mjJNT_FREE)
        return 0;
    mju_copy3(part->anchor, m->jnt_pos + 3 * joint);
    complete(part->frame, m->jnt_axis + 3 * joint);
    for (i = 0; i < 6; i++)
        part->held[i] = 1;
    make_carrier(T, part->frame, part->anchor);
    carry(part->above, T, above);
    if (type == mjJNT_HINGE)
        bound_hinge(part);
    else if (type == mjJNT_BALL)
        bound_ball(part);
    else
        return bound_slide(part, m, joint);
    return 1;
}

/* Compliance of the first body of a weld. */
static void compliance_of(mjtNum Y[36], const mjModel *m, int body)
{
    const pong_mass mass = mass_of(m, body);
    const int parent = m->body_parentid[body];
    mjtNum of_parent[36], above[36] = {0}, T[36], R[9], back[9], place[3], inverse[4], joined[36];
    joint_part part;
    if (is_static(m, body)) {
        mju_zero(Y, 36);
        return;
    }
    free_compliance(Y, &mass);
    if (!is_static(m, parent)) {
        mjtNum origin[3], quat[4], own[4];
        compliance_of(of_parent, m, m->body_weldid[parent]);
        pose_in_weld(m, parent, origin, quat);
        mju_rotVecQuat(place, m->body_pos + 3 * body, quat);
        mju_addTo3(place, origin);
        mju_mulQuat(own, quat, m->body_quat + 4 * body);
        mju_negQuat(inverse, own);
        mju_quat2Mat(R, inverse);
        make_carrier(T, R, place);
        carry(above, T, of_parent);
    }
    if (!read_joint(&part, m, body, above))
        return;
    make_carrier(T, part.frame, part.anchor);
    carry(joined, T, Y);
    hold(joined, &part);
    /* Back to the origin of the body. */
    mju_transpose(back, part.frame, 3, 3);
    mju_mulMatVec3(place, part.frame, part.anchor);
    mju_scl3(place, place, -1);
    make_carrier(T, back, place);
    carry(Y, T, joined);
}

int is_on_joints(const mjModel *m, int body)
{
    const int top = m->body_weldid[body], tree = m->body_treeid[top];
    if (is_static(m, body) || tree < 0)
        return 0;
    return m->tree_dofnum[tree] != 6 || m->body_jntnum[top] != 1 || m->jnt_type[m->body_jntadr[top]] != mjJNT_FREE;
}

pong_joints joints_of(const mjModel *m, int body)
{
    pong_joints joints;
    mjtNum Y[36], T[36], R[9], place[3], quat[4], inverse[4];
    memset(&joints, 0, sizeof joints);
    compliance_of(Y, m, m->body_weldid[body]);
    pose_in_weld(m, body, place, quat);
    mju_negQuat(inverse, quat);
    mju_quat2Mat(R, inverse);
    make_carrier(T, R, place);
    carry(joints.inverse_inertia, T, Y);
    joints.mechanism = (uint32_t)m->body_treeid[m->body_weldid[body]];
    return joints;
}

/* ---- springs */

static int damps_explicitly(const mjModel *m)
{
    switch (m->opt.integrator) {
    case mjINT_IMPLICIT:
    case mjINT_IMPLICITFAST:
        return 0;
    case mjINT_EULER:
        return (m->opt.disableflags & mjDSBL_EULERDAMP) != 0;
    default:
        return 1;
    }
}

void add_springs(pong_joints *joints, const mjModel *m, int body)
{
    const int tree = m->body_treeid[m->body_weldid[body]];
    int dof;
    for (dof = 0; dof < m->nv; dof++)
        if (m->dof_treeid[dof] == tree) {
            const mjtNum yields = m->dof_invweight0[dof];
            joints->spring_rate += m->jnt_stiffness[m->dof_jntid[dof]] * yields;
            if (damps_explicitly(m))
                joints->damper_rate += m->dof_damping[dof] * yields;
        }
}
