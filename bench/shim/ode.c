/* ODE for the benchmarks: its collision detection, without its dynamics. */
#include <ode/ode.h>
#include <stdlib.h>
#include <string.h>

enum { BODIES = 2, MOST_CONTACTS = 64 };
enum { SPHERE, CAPSULE, RAY, CYLINDER };

typedef struct {
    dWorldID world;
    dBodyID bodies[BODIES];
    dSpaceID spaces[BODIES];
    dTriMeshDataID mesh;
    dGeomID target, mover;
    int contacts;
    double deepest; /* of the wheels of the last frame */
} scene;

enum { QUADTREE, SWEEP_AND_PRUNE };

/* Two bodies, each with a separate space for its geoms: its kind, its centre, and its extents along each
 * axis. */
scene *pong_ode_new(int space, const double *center, const double *extents)
{
    const int quadtree_depth = 6;
    scene *s = calloc(1, sizeof *s);
    int i;
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
    s->world = dWorldCreate();
    for (i = 0; i < BODIES; i++) {
        s->bodies[i] = dBodyCreate(s->world);
        s->spaces[i] = space == QUADTREE ? dQuadTreeSpaceCreate(0, center, extents, quadtree_depth)
                                         : dSweepAndPruneSpaceCreate(0, dSAP_AXES_XYZ);
    }
    return s;
}

void pong_ode_free(scene *s)
{
    int i;
    if (s->target) dGeomDestroy(s->target);
    if (s->mover) dGeomDestroy(s->mover);
    for (i = 0; i < BODIES; i++) dSpaceDestroy(s->spaces[i]);
    dWorldDestroy(s->world);
    if (s->mesh) dGeomTriMeshDataDestroy(s->mesh);
    free(s);
}

/* --- two bodies of many geoms ------------------------------------------------------------------------------------- */

/* A convex geom on the first body, in its own frame around `center`; the arrays must outlive the scene. */
void pong_ode_add_convex(scene *s, const double *planes, unsigned plane_count, const double *points,
                         unsigned point_count, const unsigned *polygons, const double *center)
{
    dGeomID geom = dCreateConvex(s->spaces[0], planes, plane_count, points, point_count, polygons);
    dGeomSetBody(geom, s->bodies[0]);
    dGeomSetOffsetPosition(geom, center[0], center[1], center[2]);
}

/* A sphere on the second body. */
void pong_ode_add_sphere(scene *s, const double *center, double radius)
{
    dGeomID geom = dCreateSphere(s->spaces[1], radius);
    dGeomSetBody(geom, s->bodies[1]);
    dGeomSetOffsetPosition(geom, center[0], center[1], center[2]);
}

static void near(void *data, dGeomID first, dGeomID second)
{
    dContactGeom contact;
    ((scene *)data)->contacts += dCollide(first, second, 1, &contact, sizeof contact);
}

/* Sets the poses of both bodies (position, quaternion) and returns the number of contacts. */
int pong_ode_frame(scene *s, const double *poses)
{
    int i;
    for (i = 0; i < BODIES; i++, poses += 7) {
        dBodySetPosition(s->bodies[i], poses[0], poses[1], poses[2]);
        dBodySetQuaternion(s->bodies[i], poses + 3);
    }
    s->contacts = 0;
    dSpaceCollide2((dGeomID)s->spaces[0], (dGeomID)s->spaces[1], s, near);
    return s->contacts;
}

/* --- one target, one mover ---------------------------------------------------------------------------------------- */

void pong_ode_target_convex(scene *s, const double *planes, unsigned plane_count, const double *points,
                            unsigned point_count, const unsigned *polygons)
{
    s->target = dCreateConvex(0, planes, plane_count, points, point_count, polygons);
}

/* A triangle mesh; the arrays must outlive the scene. */
void pong_ode_target_mesh(scene *s, const double *vertices, int vertex_count, const unsigned *triangles,
                          int triangle_count)
{
    s->mesh = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(s->mesh, vertices, 3 * sizeof(double), vertex_count, triangles, 3 * triangle_count,
                                3 * sizeof(unsigned));
    s->target = dCreateTriMesh(0, s->mesh, 0, 0, 0);
}

/* A capsule or a cylinder along z; a capsule's length is between the centres of its ends. */
void pong_ode_target_round(scene *s, int kind, double radius, double length)
{
    s->target = kind == CAPSULE ? dCreateCapsule(0, radius, length) : dCreateCylinder(0, radius, length);
}

/* Radius and length of the mover; rays have no radius. */
void pong_ode_mover(scene *s, int kind, double radius, double length)
{
    switch (kind) {
    case SPHERE: s->mover = dCreateSphere(0, radius); break;
    case CAPSULE: s->mover = dCreateCapsule(0, radius, length); break;
    default: s->mover = dCreateRay(0, length);
    }
}

/* Target and mover are boxes with these edges. */
void pong_ode_boxes(scene *s, const double *edges)
{
    s->target = dCreateBox(0, edges[0], edges[1], edges[2]);
    s->mover = dCreateBox(0, edges[0], edges[1], edges[2]);
}

void pong_ode_mover_convex(scene *s, const double *planes, unsigned plane_count, const double *points,
                           unsigned point_count, const unsigned *polygons)
{
    s->mover = dCreateConvex(0, planes, plane_count, points, point_count, polygons);
}

/* Places the mover at each wheel's pose in turn and returns the number of contacts. */
int pong_ode_wheels(scene *s, const double *poses, int count)
{
    dContactGeom found[MOST_CONTACTS];
    int i, k, contacts = 0;
    s->deepest = 0;
    for (i = 0; i < count; i++, poses += 7) {
        int of_wheel;
        dGeomSetPosition(s->mover, poses[0], poses[1], poses[2]);
        dGeomSetQuaternion(s->mover, poses + 3);
        of_wheel = dCollide(s->mover, s->target, MOST_CONTACTS, found, sizeof found[0]);
        for (k = 0; k < of_wheel; k++) {
            if (found[k].depth > s->deepest) s->deepest = found[k].depth;
        }
        contacts += of_wheel;
    }
    return contacts;
}

/* Depth of the deepest contact of the wheels of the last frame. */
double pong_ode_deepest(const scene *s) { return s->deepest; }

/* Result of a query: depth (0: none), normal from target to mover, point. */
typedef struct {
    double depth, normal[3], point[3];
} answer;

static answer deepest(scene *s)
{
    dContactGeom found[MOST_CONTACTS];
    answer out;
    int i, count = dCollide(s->mover, s->target, MOST_CONTACTS, found, sizeof found[0]);
    memset(&out, 0, sizeof out);
    for (i = 0; i < count; i++) {
        if (found[i].depth > out.depth) {
            out.depth = found[i].depth;
            memcpy(out.normal, found[i].normal, sizeof out.normal);
            memcpy(out.point, found[i].pos, sizeof out.point);
        }
    }
    return out;
}

/* Position, then quaternion (w, x, y, z). */
static void place(dGeomID geom, const double *pose)
{
    dGeomSetPosition(geom, pose[0], pose[1], pose[2]);
    dGeomSetQuaternion(geom, pose + 3);
}

/* One query per pair of poses of mover and target. */
void pong_ode_pairs(scene *s, const double *poses, int count, answer *answers)
{
    int i;
    for (i = 0; i < count; i++, poses += 14) {
        place(s->mover, poses);
        place(s->target, poses + 7);
        answers[i] = deepest(s);
    }
}

/* A ray along z that starts at `start` in the mover's frame. */
void pong_ode_rays(scene *s, const double *poses, int count, double start, answer *answers)
{
    int i;
    for (i = 0; i < count; i++, poses += 14) {
        dMatrix3 r;
        dQtoR(poses + 3, r);
        dGeomRaySet(s->mover, poses[0] + start * r[2], poses[1] + start * r[6], poses[2] + start * r[10], r[2], r[6],
                    r[10]);
        place(s->target, poses + 7);
        answers[i] = deepest(s);
    }
}
