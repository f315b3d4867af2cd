/* A host that steps implicitly with the tangent of the contacts: a 12 t chaser docks to a 420 t station.
 *
 * The chaser carries a ring of 200 kg on a spring and a damper along its axis. Three feet of the ring meet the station's
 * face with 1e8 N/m each; from then on latches pull the ring with 3 kN. Free rates are u = (v, w of the chaser, rate of
 * the ring along the axis, v, w of the station): 13. J gives the twists of the groups, J u. Backward Euler is
 *
 *     M (u1 - u) = T J' (W(x1, u1) + f)        x1 = x + T J u1, J': J transposed
 *
 * with W the wrenches of Pong and f all other forces. About the start of the step, with K = -dW/dx and D = -dW/dv of
 * pong_get_tangents(), W(x1, u1) = W - T K u1 - D (u1 - u). Then, with u1 = u + du and J left out,
 *
 *     (M + T D + T^2 K) du = T (W + f - T K u)
 *
 * One evaluation and one linear solution a step. The spring of the ring is treated alike. A contact that begins within a
 * step shows at its end, as in an explicit host. Products of velocities, 1e-6 of these forces, are left out. The explicit
 * host is semi-implicit Euler: the same with K = D = 0.
 *
 *     implicit                       the table of steps
 *     implicit STEP explicit         one run, a line for each 0.1 s; any other word than explicit: implicit
 */
#include "docking_math.h"
#include <pong.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHASER, RING, STATION, GROUPS, FREE = 13, AXIAL = 6 };

#define CHECK(call)                                                                                \
    do {                                                                                           \
        if ((call) != PONG_STATUS_OK) {                                                            \
            fprintf(stderr, "%s\n%s\n", #call, pong_last_message());                               \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

/* Two surfaces of 2e8 N/m in series: 1e8 N/m a foot. Origins are mass centres. */
#define HEAD "(format: \"pong-model\", version: 1, surfaces: {\"steel\": (stiffness: 2e8, " \
    "normal: Linear(damping: 2e4), friction: Bristle(mu: 0.3))}, "
static const char chaser_model[] = HEAD "name: \"chaser\", root: (name: \"chaser\", surface: \"steel\", groups: ["
    "(name: \"ring\", movable: true, primitives: [Sphere(name: \"a\", center: (0.6, 0, -0.1), radius: 0.05), "
    "Sphere(name: \"b\", center: (-0.3, 0.52, -0.1), radius: 0.05), "
    "Sphere(name: \"c\", center: (-0.3, -0.52, -0.1), radius: 0.05)])]))";
static const char station_model[] = HEAD "name: \"station\", root: (name: \"station\", surface: \"steel\", "
    "primitives: [Plane(name: \"face\", normal: (0, 0, 1), offset: 5)]))";

static const double mass[GROUPS] = { 12e3, 200.0, 420e3 }, inertia[GROUPS] = { 2e4, 40.0, 3e7 };
static const double spring = 2e4, damper = 4e3, latches = 3e3, reach = 2.0, duration = 3.0;

typedef struct {
    vec3 position[2]; /* of chaser and station */
    quat turn[2];
    double stroke, u[FREE];
    int latched;
} vehicles;

typedef struct {
    double peak; /* largest force of the ring's spring and damper, N */
    int lost;    /* the run left all bounds */
} outcome;

static void put(double *to, vec3 a) { to[0] = a.x, to[1] = a.y, to[2] = a.z; }
static vec3 take(const double *a) { return v3(a[0], a[1], a[2]); }

/* Jacobian from the free rates to the twists of chaser, ring and station. */
static void jacobian(const vehicles *s, double j[18][FREE])
{
    vec3 axis = rotate(s->turn[0], v3(0, 0, 1)), arm = scale(axis, s->stroke - reach);
    int i;
    memset(j, 0, 18 * FREE * sizeof(double));
    for (i = 0; i < 6; i++) {
        j[6 * CHASER + i][i] = j[6 * RING + i][i] = j[6 * STATION + i][7 + i] = 1.0;
    }
    for (i = 0; i < 3; i++) {
        vec3 unit = v3(i == 0, i == 1, i == 2), moved = cross(unit, arm);
        j[6 * RING][3 + i] = moved.x, j[6 * RING + 1][3 + i] = moved.y, j[6 * RING + 2][3 + i] = moved.z;
    }
    j[6 * RING][AXIAL] = axis.x, j[6 * RING + 1][AXIAL] = axis.y, j[6 * RING + 2][AXIAL] = axis.z;
}

static void twists(const vehicles *s, double j[18][FREE], double *twist)
{
    int row, k;
    for (row = 0; row < 18; row++) {
        for (k = 0, twist[row] = 0.0; k < FREE; k++) {
            twist[row] += j[row][k] * s->u[k];
        }
    }
}

static vehicles moved(const vehicles *s, const double *u, double step)
{
    vehicles end = *s;
    int i;
    for (i = 0; i < 2; i++) {
        end.position[i] = add(s->position[i], scale(take(u + 7 * i), step));
        end.turn[i] = quat_turned(s->turn[i], take(u + 7 * i + 3), step);
    }
    end.stroke = s->stroke + step * u[AXIAL];
    memcpy(end.u, u, sizeof end.u);
    return end;
}

static void send(pong_world *world, const pong_interface_id *groups, const vehicles *s)
{
    pong_state states[GROUPS];
    double j[18][FREE], twist[18];
    int g;
    jacobian(s, j);
    twists(s, j, twist);
    for (g = 0; g < GROUPS; g++) {
        quat q = s->turn[g == STATION];
        vec3 arm = rotate(q, v3(0, 0, g == RING ? s->stroke - reach : 0.0));
        states[g] = pong_default_state();
        put(states[g].position, add(s->position[g == STATION], arm));
        states[g].orientation[0] = q.w, states[g].orientation[1] = q.x;
        states[g].orientation[2] = q.y, states[g].orientation[3] = q.z;
        memcpy(states[g].linear_velocity, twist + 6 * g, 3 * sizeof(double));
        memcpy(states[g].angular_velocity, twist + 6 * g + 3, 3 * sizeof(double));
    }
    CHECK(pong_set_states(world, groups, states, GROUPS));
}

/* Solves a x = b by elimination with pivots; x replaces b. */
static void solve(double a[FREE][FREE], double *b)
{
    int i, j, k;
    for (k = 0; k < FREE; k++) {
        int pivot = k;
        for (i = k; i < FREE; i++) {
            pivot = fabs(a[i][k]) > fabs(a[pivot][k]) ? i : pivot;
        }
        for (j = 0; j <= FREE; j++) {
            double *p = j < FREE ? &a[k][j] : &b[k], *q = j < FREE ? &a[pivot][j] : &b[pivot], kept = *p;
            *p = *q, *q = kept;
        }
        for (i = 0; i < FREE; i++) {
            double f = i == k ? 0.0 : a[i][k] / a[k][k];
            for (j = k; j < FREE && f != 0.0; j++) {
                a[i][j] -= f * a[k][j];
            }
            b[i] -= f * b[k];
        }
    }
    for (k = 0; k < FREE; k++) {
        b[k] /= a[k][k];
    }
}

/* Adds step D + step^2 K of all groups that touch to `m`, and -step K times the twists to the wrenches. */
static void add_tangents(pong_world *world, const pong_interface_id *groups, double step, const double *twist,
                         double m[18][18], pong_wrench *w)
{
    pong_tangent all[GROUPS];
    size_t count, n;
    int of[2], g, i, j, k;
    CHECK(pong_get_tangents(world, all, GROUPS, &count));
    for (n = 0; n < count; n++) {
        for (i = 0; i < 2; i++) {
            for (g = 0, of[i] = 0; g < GROUPS; g++) {
                of[i] = all[n].interfaces[i].bits == groups[g].bits ? g : of[i];
            }
        }
        for (i = 0; i < 2; i++) {
            for (j = 0; j < 2; j++) {
                for (k = 0; k < 36; k++) {
                    int row = k / 6, column = k % 6;
                    double spring_part = step * all[n].stiffness[i][j][k];
                    double *wrench = row < 3 ? &w[of[i]].force[row] : &w[of[i]].moment[row - 3];
                    m[6 * of[i] + row][6 * of[j] + column] += step * (all[n].damping[i][j][k] + spring_part);
                    *wrench -= spring_part * twist[6 * of[j] + column];
                }
            }
        }
    }
}

/* Rates at the end of a step, from wrenches and tangents of the frame last evaluated. */
static void accelerate(pong_world *world, const pong_interface_id *groups, const vehicles *s, double step, int implicit,
                       double *u1)
{
    double j[18][FREE], m[18][18] = { { 0 } }, a[FREE][FREE] = { { 0 } }, b[FREE] = { 0 }, twist[18];
    double h = implicit ? step : 0.0;
    pong_wrench w[GROUPS];
    vec3 pull = scale(rotate(s->turn[1], v3(0, 0, -1)), s->latched ? latches : 0.0);
    int row, column, i, k;
    jacobian(s, j);
    CHECK(pong_get_wrenches(world, groups, PONG_REFERENCE_FRAME_COMMON, w, GROUPS));
    w[RING].force[0] += pull.x, w[RING].force[1] += pull.y, w[RING].force[2] += pull.z;
    w[STATION].force[0] -= pull.x, w[STATION].force[1] -= pull.y, w[STATION].force[2] -= pull.z;
    if (implicit) {
        twists(s, j, twist);
        add_tangents(world, groups, step, twist, m, w);
    }
    for (row = 0; row < 18; row++) {
        m[row][row] += row % 6 < 3 ? mass[row / 6] : inertia[row / 6];
        for (k = 0; k < FREE; k++) {
            b[k] += step * j[row][k] * (row % 6 < 3 ? w[row / 6].force[row % 6] : w[row / 6].moment[row % 6 - 3]);
        }
        for (column = 0; column < 18; column++) {
            for (i = 0; i < FREE && m[row][column] != 0.0; i++) {
                for (k = 0; k < FREE; k++) {
                    a[i][k] += j[row][i] * m[row][column] * j[column][k];
                }
            }
        }
    }
    a[AXIAL][AXIAL] += h * (damper + h * spring);
    b[AXIAL] -= step * (spring * s->stroke + (damper + h * spring) * s->u[AXIAL]);
    solve(a, b);
    for (k = 0; k < FREE; k++) {
        u1[k] = s->u[k] + b[k];
    }
}

static pong_interface_id load(pong_world *world, const char *text, const char *name, const char *group)
{
    pong_model_id model;
    pong_object_id object;
    pong_interface_id found;
    CHECK(pong_load_model_text(world, text, strlen(text), name, NULL, &model));
    CHECK(pong_create_object(world, model, name, &object));
    CHECK(pong_find_interface(world, object, group, &found));
    return found;
}

/* A docking from 6 mm before contact, at 0.05 m/s, 5 mm/s aside and tilted by 0.1 degrees. */
static outcome dock(double step, int implicit, int shown)
{
    pong_config config = pong_default_config();
    pong_world *world;
    pong_interface_id groups[GROUPS];
    pong_object_id chaser;
    vehicles s = { { { 0, 0, 0 }, { 0, 0, 0 } }, { { 1, 0, 0, 0 }, { 1, 0, 0, 0 } }, 0, { 0 }, 0 };
    outcome out = { 0, 0 };
    long n, steps = (long)(duration / step + 0.5), each = (long)fmax(0.1 / step + 0.5, 1.0);
    CHECK(pong_create_world(&config, &world));
    groups[CHASER] = load(world, chaser_model, "chaser", "");
    CHECK(pong_find_object(world, "chaser", &chaser));
    CHECK(pong_find_interface(world, chaser, "ring", &groups[RING]));
    groups[STATION] = load(world, station_model, "station", "");
    CHECK(pong_pair_by_name(world, "chaser", "station", NULL));
    CHECK(pong_seal(world, NULL));
    s.position[0].z = 5.0 + reach + 0.15 + 0.006;
    s.turn[0] = quat_exp(v3(0.1 * DEGREE, 0, 0));
    s.u[0] = 0.005, s.u[2] = -0.05;
    for (n = 0; n < steps && !out.lost; n++) {
        double u1[FREE];
        size_t contacts;
        send(world, groups, &s);
        CHECK(pong_evaluate(world));
        CHECK(pong_contact_count(world, &contacts));
        s.latched = s.latched || contacts > 0;
        accelerate(world, groups, &s, step, implicit, u1);
        CHECK(pong_commit(world)); /* of the states evaluated */
        s = moved(&s, u1, step);
        out.peak = fmax(out.peak, fabs(spring * s.stroke + damper * s.u[AXIAL]));
        out.lost = !(fabs(s.stroke) < 0.5 && fabs(s.u[AXIAL]) < 5.0 && norm(take(s.u + 3)) < 0.5);
        if (shown && (n + 1) % each == 0) {
            printf("%7.3f s  stroke %8.4f mm  closing %8.4f mm/s  %u contacts\n", step * (double)(n + 1), s.stroke * 1e3,
                   (s.u[9] - s.u[2]) * 1e3, (unsigned)contacts);
        }
    }
    CHECK(pong_destroy_world(world));
    return out;
}

int main(int argc, char **argv)
{
    static const double steps[] = { 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 0.1, 0.2 };
    double exact, stable[2] = { 0 }, accurate[2] = { 0 };
    size_t i, n;
    CHECK(PONG_CHECK_ABI());
    if (argc == 3) {
        outcome out = dock(atof(argv[1]), strcmp(argv[2], "explicit") != 0, 1);
        printf("peak of the ring's spring and damper: %.1f N%s\n", out.peak, out.lost ? "; the run was lost" : "");
        return out.lost;
    }
    exact = dock(2e-5, 0, 0).peak;
    printf("peak of the ring's spring and damper, N: %.1f at 20 us\n%10s%12s%12s\n", exact, "step, ms", "explicit", "implicit");
    for (n = 0; n < sizeof steps / sizeof steps[0]; n++) {
        printf("%10.1f", steps[n] * 1e3);
        for (i = 0; i < 2; i++) {
            outcome out = dock(steps[n], (int)i, 0);
            printf(out.lost ? "        lost" : "%12.1f", out.peak);
            stable[i] = out.lost ? stable[i] : steps[n];
            accurate[i] = !out.lost && fabs(out.peak / exact - 1.0) < 0.02 ? steps[n] : accurate[i];
        }
        printf("\n");
    }
    printf("largest stable step: explicit %.1f ms, implicit %.1f ms; within 2 %%: %.1f ms, %.1f ms\n", stable[0] * 1e3,
           stable[1] * 1e3, accurate[0] * 1e3, accurate[1] * 1e3);
    return !(stable[1] >= 20.0 * stable[0] && accurate[1] >= 5.0 * accurate[0]);
}
