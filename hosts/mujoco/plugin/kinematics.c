#include "kinematics.h"

#include <string.h>

typedef struct array {
    mjtNum *numbers;
    size_t count;
} array;

enum { ARRAY_COUNT = 19 };

/* Lists all arrays that mj_kinematics(), mj_comPos() and mj_comVel() write. */
static void list_arrays(array arrays[ARRAY_COUNT], const mjModel *m, mjData *d)
{
    const size_t bodies = (size_t)m->nbody, joints = (size_t)m->njnt, geoms = (size_t)m->ngeom;
    const size_t sites = (size_t)m->nsite, dofs = (size_t)m->nv;
    const array all[ARRAY_COUNT] = {
        {d->xpos, 3 * bodies},        {d->xquat, 4 * bodies},     {d->xmat, 9 * bodies},
        {d->xipos, 3 * bodies},       {d->xiquat, 4 * bodies},    {d->ximat, 9 * bodies},
        {d->xanchor, 3 * joints},     {d->xaxis, 3 * joints},     {d->geom_xpos, 3 * geoms},
        {d->geom_xquat, 4 * geoms},   {d->geom_xmat, 9 * geoms},  {d->site_xpos, 3 * sites},
        {d->site_xquat, 4 * sites},   {d->site_xmat, 9 * sites},  {d->subtree_com, 3 * bodies},
        {d->cinert, 10 * bodies},     {d->cdof, 6 * dofs},        {d->cvel, 6 * bodies},
        {d->cdof_dot, 6 * dofs},
    };
    memcpy(arrays, all, sizeof all);
}

saved_kinematics update_kinematics(const mjModel *m, mjData *d)
{
    saved_kinematics saved;
    array arrays[ARRAY_COUNT];
    size_t i, total = 0;
    mjtNum *at;

    list_arrays(arrays, m, d);
    for (i = 0; i < ARRAY_COUNT; i++)
        total += arrays[i].count;
    mj_markStack(d);
    saved.copy = at = mj_stackAllocNum(d, total);
    for (i = 0; i < ARRAY_COUNT; i++) {
        memcpy(at, arrays[i].numbers, arrays[i].count * sizeof *at);
        at += arrays[i].count;
    }
    mj_kinematics(m, d);
    mj_comPos(m, d);
    mj_comVel(m, d);
    return saved;
}

void restore_kinematics(const mjModel *m, mjData *d, saved_kinematics saved)
{
    array arrays[ARRAY_COUNT];
    size_t i;
    list_arrays(arrays, m, d);
    for (i = 0; i < ARRAY_COUNT; i++) {
        memcpy(arrays[i].numbers, saved.copy, arrays[i].count * sizeof *saved.copy);
        saved.copy += arrays[i].count;
    }
    mj_freeStack(d);
}
