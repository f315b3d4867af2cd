/* Time of one pair of convex geoms in ODE, for solids_pairs.py. */
#include <ode/ode.h>
#include <time.h>

enum { MOST_CONTACTS = 64 };

static dGeomID made[2];

/* Two boxes with these edges, m. */
void boxes(const double *edges)
{
    int i;
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
    for (i = 0; i < 2; i++) made[i] = dCreateBox(0, edges[0], edges[1], edges[2]);
}

/* Two equal convex geoms; the arrays must outlive them. */
void hulls(const double *planes, unsigned plane_count, const double *points, unsigned point_count,
           const unsigned *polygons)
{
    int i;
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
    for (i = 0; i < 2; i++) made[i] = dCreateConvex(0, planes, plane_count, points, point_count, polygons);
}

/* Sets both poses (position, quaternion) and collides, for each of `count` pairs of poses in turn. Writes the number of
 * contacts of each pair and returns the processor time of all, s. */
double collide(const double *poses, int count, int *contacts)
{
    dContactGeom found[MOST_CONTACTS];
    struct timespec start, end;
    int i, k;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &start);
    for (i = 0; i < count; i++) {
        for (k = 0; k < 2; k++, poses += 7) {
            dGeomSetPosition(made[k], poses[0], poses[1], poses[2]);
            dGeomSetQuaternion(made[k], poses + 3);
        }
        contacts[i] = dCollide(made[0], made[1], MOST_CONTACTS, found, sizeof found[0]);
    }
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    return (end.tv_sec - start.tv_sec) + 1e-9 * (end.tv_nsec - start.tv_nsec);
}
