#include "slow.h"

#include "joints.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rounds in which the wrenches of a step are found, and the error of the accelerations at which they end, as a share of those
 * by contact. */
#define ROUNDS_MAX 8
#define ERROR_MAX 1e-4

/* ---- making and deleting */

int refuse_integrator(const mjModel *m, message *why)
{
    const int integrator = m->opt.integrator;
    if (integrator == mjINT_EULER || integrator == mjINT_IMPLICIT || integrator == mjINT_IMPLICITFAST)
        return 1;
    return fail(why, "key `substeps_max`: it needs a wrench that is held over the step, and poses that follow the new velocity; "
                     "set the integrator to Euler, implicit or implicitfast, or leave the key out");
}

static pong_status make_slow(pong_slow_host **host, const contact_world *w)
{
    pong_slow_settings settings = pong_default_slow_settings();
    settings.theta = 1.0;
    settings.substeps_max = w->substeps_max;
    return pong_create_slow_host(w->world, &settings, host);
}

int measure_slow(size_t *size, const contact_world *w, message *why)
{
    pong_slow_host *host;
    pong_status status = make_slow(&host, w);
    if (status == PONG_STATUS_OK)
        status = pong_slow_state_size(host, size);
    if (status != PONG_STATUS_OK)
        fail_by_library(why, "key `substeps_max`");
    pong_destroy_slow_host(host);
    return status == PONG_STATUS_OK;
}

static __thread int making_scratch;

int is_making_scratch(void) { return making_scratch; }

int open_slow(slow_copies *copies, const contact_world *w, const mjModel *m, message *why)
{
    const size_t dofs = (size_t)m->nv, groups = w->group_count;
    if (w->substeps_max == 0)
        return 1;
    if (!refuse_integrator(m, why))
        return 0;
    if (make_slow(&copies->host, w) != PONG_STATUS_OK)
        return fail_by_library(why, "key `substeps_max`");
    making_scratch = 1;
    copies->scratch = mj_makeData(m);
    making_scratch = 0;
    copies->inputs = calloc(groups, sizeof *copies->inputs);
    copies->inertia = malloc((dofs * dofs + 1) * sizeof *copies->inertia);
    copies->roots = malloc((6 * (groups + 1) * dofs + 1) * sizeof *copies->roots);
    copies->couplings = calloc(groups * (groups + 1) / 2 + 1, sizeof *copies->couplings);
    copies->wrenches = calloc(groups, sizeof *copies->wrenches);
    copies->pushes = malloc((2 * dofs + 1) * sizeof *copies->pushes);
    copies->rounds = calloc(4 * dofs + 1, sizeof *copies->rounds);
    copies->springs = malloc((3 * dofs * dofs + 1) * sizeof *copies->springs);
    if (copies->scratch == NULL || copies->inputs == NULL || copies->inertia == NULL || copies->roots == NULL ||
        copies->couplings == NULL || copies->wrenches == NULL || copies->pushes == NULL ||
        copies->springs == NULL || copies->rounds == NULL)
        return fail(why, "no memory for the copies of the key `substeps_max`");
    return 1;
}

void close_slow(slow_copies *copies)
{
    pong_destroy_slow_host(copies->host);
    if (copies->scratch != NULL)
        mj_deleteData(copies->scratch);
    free(copies->inputs);
    free(copies->inertia);
    free(copies->roots);
    free(copies->couplings);
    free(copies->wrenches);
    free(copies->pushes);
    free(copies->springs);
    free(copies->rounds);
    memset(copies, 0, sizeof *copies);
}

/* ---- one step with given wrenches of contact */

/* Generalised force of the wrenches on the groups, with the kinematics of the scratch data. */
static void read_pushes(slow_copies *copies, const contact_world *w, const mjModel *m)
{
    const mjData *d = copies->scratch;
    size_t i;
    mju_zero(copies->pushes, m->nv);
    for (i = 0; i < w->group_count; i++) {
        const pong_wrench *wrench = &copies->wrenches[i];
        mj_applyFT(m, copies->scratch, wrench->force, wrench->moment, d->xpos + 3 * w->bodies[i], w->bodies[i], copies->pushes);
    }
}

/* Steps the scratch data with the pushes, and gives them the mean acceleration of the step at the state of its beginning. */
static void step_with_pushes(slow_copies *copies, const mjModel *m, const mjData *d)
{
    mjData *scratch = copies->scratch;
    int i;
    mj_copyState(m, d, scratch, mjSTATE_INTEGRATION);
    mju_addTo(scratch->qfrc_applied, copies->pushes, m->nv);
    mj_step(m, scratch);
    for (i = 0; i < m->nv; i++)
        scratch->qacc[i] = (scratch->qvel[i] - d->qvel[i]) / m->opt.timestep;
    /* Positions and velocities of the beginning; kinematics, inertia and constraints still are. */
    mju_copy(scratch->qpos, d->qpos, m->nq);
    mju_copy(scratch->qvel, d->qvel, m->nv);
}

/* Adds the inertia of a row of the constraint Jacobian with this weight. */
static void add_row(mjtNum *inertia, const mjModel *m, const mjData *d, int row, mjtNum weight)
{
    const int dofs = m->nv, sparse = mj_isSparse(m);
    const mjtNum *values = d->efc_J + (sparse ? d->efc_J_rowadr[row] : row * dofs);
    const int *columns = sparse ? d->efc_J_colind + d->efc_J_rowadr[row] : NULL;
    const int count = sparse ? d->efc_J_rownnz[row] : dofs;
    int i, k;
    for (i = 0; i < count; i++)
        for (k = 0; k < count; k++)
            inertia[(sparse ? columns[i] : i) * dofs + (sparse ? columns[k] : k)] += weight * values[i] * values[k];
}

/* Adds the damping that the integrator treats implicitly, times the step. */
static void add_damping(mjtNum *inertia, const mjModel *m, const mjData *d)
{
    const mjtNum step = m->opt.timestep;
    int i, k;
    if (m->opt.integrator == mjINT_EULER) {
        for (i = 0; i < m->nv && !(m->opt.disableflags & (mjDSBL_EULERDAMP | mjDSBL_DAMPER)); i++)
            inertia[i * m->nv + i] += step * m->dof_damping[i];
        return;
    }
    for (i = 0; i < m->nv; i++)
        for (k = m->D_rowadr[i]; k < m->D_rowadr[i] + m->D_rownnz[i]; k++) {
            /* Half of it on either side of the diagonal. */
            inertia[i * m->nv + m->D_colind[k]] -= 0.5 * step * d->qDeriv[k];
            inertia[m->D_colind[k] * m->nv + i] -= 0.5 * step * d->qDeriv[k];
        }
}

/* Effective inertia of a step: an impulse changes the velocity by its inverse. With the inertia M, the damping of a step B and
 * the constraints that act as springs of inertia K, MuJoCo solves the constraints with M and then integrates with M + B, so
 * that the velocity is (M + B)^-1 M (M + K)^-1 times the impulse. The symmetric part of the inverse of that is taken. */
static void factor_inertia(slow_copies *copies, const mjModel *m)
{
    mjData *d = copies->scratch;
    const int dofs = m->nv, size = dofs * dofs;
    mjtNum *springs = copies->springs, *damping = springs + size, *product = damping + size;
    int row, i, k;
    mju_zero(springs, 2 * size);
    for (row = 0; row < d->nefc; row++)
        if (d->efc_state[row] == mjCNSTRSTATE_QUADRATIC)
            add_row(springs, m, d, row, d->efc_D[row]);
    add_damping(damping, m, d);
    mj_solveM(m, d, product, springs, dofs);
    mju_mulMatMatT(copies->inertia, damping, product, dofs, dofs, dofs);
    mju_copy(product, copies->inertia, size);
    mj_fullM(m, d, copies->inertia);
    mju_addTo(copies->inertia, springs, size);
    mju_addTo(copies->inertia, damping, size);
    mju_copy(springs, copies->inertia, size);
    for (i = 0; i < dofs; i++)
        for (k = 0; k < dofs; k++)
            copies->inertia[i * dofs + k] += 0.5 * (product[i * dofs + k] + product[k * dofs + i]);
    /* The product of two that do not commute may have a negative eigenvalue. */
    if (mju_cholFactor(copies->inertia, dofs, mjMINVAL) < dofs) {
        mju_copy(copies->inertia, springs, size);
        mju_cholFactor(copies->inertia, dofs, mjMINVAL);
    }
}

/* Error of the acceleration without contact that the last round assumed: what the scratch data did beside the pushes, less what
 * was assumed. Returns true if it is small beside the acceleration by contact. */
static int read_error(slow_copies *copies, const mjModel *m)
{
    mjtNum *by_pushes = copies->pushes + m->nv, *assumed = copies->rounds, *error = assumed + m->nv;
    mjtNum most = 0, off = 0;
    int i;
    mju_cholSolve(by_pushes, copies->inertia, copies->pushes, m->nv);
    for (i = 0; i < m->nv; i++) {
        error[i] = copies->scratch->qacc[i] - by_pushes[i] - assumed[i];
        most = mju_max(most, fabs(by_pushes[i]));
        off = mju_max(off, fabs(error[i]));
    }
    return off <= ERROR_MAX * most;
}

/* Acceleration without contact to assume next. From the second round on the error is carried to zero along the line through the
 * last two rounds (Anderson's method). */
static void correct(slow_copies *copies, const mjModel *m, int round)
{
    const int dofs = m->nv;
    mjtNum *assumed = copies->rounds, *error = assumed + dofs, *before = error + dofs, *error_before = before + dofs;
    mjtNum over = 0, square = 0, share;
    int i;
    for (i = 0; i < dofs && round > 1; i++) {
        const mjtNum change = error[i] - error_before[i];
        over += error[i] * change;
        square += change * change;
    }
    share = square > 0 ? over / square : 0;
    for (i = 0; i < dofs; i++) {
        const mjtNum last = assumed[i] + error[i], one_before = before[i] + error_before[i];
        before[i] = assumed[i];
        error_before[i] = error[i];
        assumed[i] = (1 - share) * last + share * one_before;
    }
}

/* ---- the movable groups */

/* x = L^-1 b for the lower triangle L of a factored matrix. The product of two such x is that with the inverse matrix, without
 * a negative eigenvalue by rounding. */
static void solve_half(mjtNum *x, const mjtNum *factored, const mjtNum *b, int n)
{
    int i;
    for (i = 0; i < n; i++)
        x[i] = (b[i] - mju_dot(factored + i * n, x, i)) / factored[i * n + i];
}

/* Root of the mobility of a group: its Jacobian along its axes times the inverse root of the effective inertia, 6 x nv. Rows
 * in which joints hold the body, up to rounding, are zero. Returns 0 if it does not move. */
static int read_root(slow_copies *copies, const mjModel *m, int body, size_t group, size_t groups)
{
    const mjData *d = copies->scratch;
    const int dofs = m->nv;
    /* The Jacobian takes the place behind the last group. */
    mjtNum *root = copies->roots + 6 * group * dofs, *jacobian = copies->roots + 6 * groups * dofs, squares[6], most = 0;
    int i, moves = 0;
    mj_jac(m, d, jacobian, jacobian + 3 * dofs, d->xpos + 3 * body, body);
    mju_mulMatTMat(root, d->xmat + 9 * body, jacobian, 3, 3, dofs);
    mju_mulMatTMat(root + 3 * dofs, d->xmat + 9 * body, jacobian + 3 * dofs, 3, 3, dofs);
    mju_copy(jacobian, root, 6 * dofs);
    for (i = 0; i < 6; i++) {
        solve_half(root + i * dofs, copies->inertia, jacobian + i * dofs, dofs);
        squares[i] = mju_dot(root + i * dofs, root + i * dofs, dofs);
        most = mju_max(most, squares[i]);
    }
    for (i = 0; i < 6; i++)
        /* Lengths of 1 m: a point 1 um from an axis does not move. */
        if (squares[i] < 1e-12 * most)
            mju_zero(root + i * dofs, dofs);
        else
            moves |= squares[i] > 0;
    return moves;
}

/* Velocity of one group per impulse on another. Returns 0 if the joints between them carry none, up to rounding. */
static int read_mobility(mjtNum A[36], const slow_copies *copies, const mjModel *m, size_t of, size_t by)
{
    const int dofs = m->nv;
    const mjtNum *first = copies->roots + 6 * of * dofs, *second = copies->roots + 6 * by * dofs;
    int i, k, moves = 0;
    mju_mulMatMatT(A, first, second, 6, dofs, 6);
    for (i = 0; i < 6; i++)
        for (k = 0; k < 6; k++)
            moves |= fabs(A[6 * i + k]) > 1e-12 * mju_norm(first + i * dofs, dofs) * mju_norm(second + k * dofs, dofs);
    return moves;
}

/* Returns true for the only group of a rigid body of its own on a free joint that no constraint touches. */
static int is_free_body(const contact_world *w, const mjModel *m, const mjData *d, size_t group, const pong_mass *mass)
{
    const int top = m->body_weldid[w->bodies[group]];
    size_t other;
    for (other = 0; other < w->group_count; other++)
        if (other != group && m->body_weldid[w->bodies[other]] == top)
            return 0;
    return top > 0 && m->body_jntnum[top] == 1 && m->jnt_type[m->body_jntadr[top]] == mjJNT_FREE && d->nefc == 0 &&
           fabs(m->body_subtreemass[top] - mass->mass) <= 1e-12 * mass->mass;
}

static void read_acceleration(pong_slow_input *input, const mjModel *m, const mjData *d, int body)
{
    mjtNum both[6];
    mj_objectAcceleration(m, d, mjOBJ_XBODY, body, both, 0);
    memcpy(input->angular_acceleration, both, sizeof input->angular_acceleration);
    memcpy(input->linear_acceleration, both + 3, sizeof input->linear_acceleration);
    /* MuJoCo lets the world rise instead of gravity act. */
    if (!(m->opt.disableflags & mjDSBL_GRAVITY))
        mju_addTo3(input->linear_acceleration, m->opt.gravity);
}

/* Moves the acceleration from the origin to the mass centre. */
static void move_acceleration(pong_slow_input *input, const mjData *d, int body)
{
    const double *turning = input->state.angular_velocity;
    mjtNum arm[3], speed[3], part[3];
    mju_mulMatVec3(arm, d->xmat + 9 * body, input->mass.mass_center);
    mju_cross(part, input->angular_acceleration, arm);
    mju_addTo3(input->linear_acceleration, part);
    mju_cross(speed, turning, arm);
    mju_cross(part, turning, speed);
    mju_addTo3(input->linear_acceleration, part);
}

static void read_input(slow_copies *copies, const contact_world *w, const mjModel *m, size_t group)
{
    const mjData *d = copies->scratch;
    pong_slow_input *input = &copies->inputs[group];
    const int body = w->bodies[group];
    input->mass = mass_of(m, body);
    read_acceleration(input, m, d, body);
    if (isinf(input->mass.mass)) {
        input->dynamics = PONG_DYNAMICS_PRESCRIBED;
    } else if (is_free_body(w, m, d, group, &input->mass)) {
        input->dynamics = PONG_DYNAMICS_FREE;
        move_acceleration(input, d, body);
    } else if (read_root(copies, m, body, group, w->group_count)) {
        input->dynamics = PONG_DYNAMICS_JOINTED;
        read_mobility(input->mobility, copies, m, group, group);
    } else {
        input->dynamics = PONG_DYNAMICS_PRESCRIBED;
    }
}

/* Number of couplings of groups that joints connect. */
static size_t read_couplings(slow_copies *copies, const contact_world *w, const mjModel *m)
{
    size_t of, by, count = 0;
    for (of = 0; of < w->group_count; of++)
        for (by = of + 1; by < w->group_count; by++) {
            pong_slow_coupling *next = &copies->couplings[count];
            if (copies->inputs[of].dynamics != PONG_DYNAMICS_JOINTED || copies->inputs[by].dynamics != PONG_DYNAMICS_JOINTED)
                continue;
            next->of = w->interfaces[of];
            next->by = w->interfaces[by];
            count += read_mobility(next->mobility, copies, m, of, by) != 0;
        }
    return count;
}

/* Evaluates with what the scratch data tell. */
static pong_status evaluate_frame(slow_copies *copies, const contact_world *w, const mjModel *m, const pong_state *states)
{
    pong_status status;
    size_t i;
    mju_copy(copies->scratch->qacc, copies->rounds, m->nv);
    mj_rnePostConstraint(m, copies->scratch);
    for (i = 0; i < w->group_count; i++) {
        copies->inputs[i].interface = w->interfaces[i];
        copies->inputs[i].state = states[i];
        read_input(copies, w, m, i);
    }
    status = pong_set_slow_couplings(copies->host, copies->couplings, read_couplings(copies, w, m));
    if (status == PONG_STATUS_OK)
        status = pong_evaluate_slow(copies->host, m->opt.timestep, copies->inputs, w->group_count);
    if (status == PONG_STATUS_OK)
        status = pong_get_slow_wrenches(copies->host, w->interfaces, PONG_REFERENCE_FRAME_COMMON, copies->wrenches, w->group_count);
    return status;
}

pong_status evaluate_slow(slow_copies *copies, const contact_world *w, const mjModel *m, const mjData *d,
                          const pong_state *states)
{
    pong_status status;
    int round;
    mju_zero(copies->pushes, m->nv);
    step_with_pushes(copies, m, d);
    factor_inertia(copies, m);
    mju_copy(copies->rounds, copies->scratch->qacc, m->nv);
    status = evaluate_frame(copies, w, m, states);
    /* The effective inertia is not all: damping makes the answer of constraints lopsided, and a wrench may lift a joint off its
     * limit. So the step is tried with the wrenches, until it ends where they were made for. */
    for (round = 1; round < ROUNDS_MAX && status == PONG_STATUS_OK; round++) {
        read_pushes(copies, w, m);
        /* Nothing touches: the step is the one that was made already. */
        if (mju_norm(copies->pushes, m->nv) == 0)
            break;
        step_with_pushes(copies, m, d);
        if (read_error(copies, m))
            break;
        correct(copies, m, round);
        status = evaluate_frame(copies, w, m, states);
    }
    return status;
}
