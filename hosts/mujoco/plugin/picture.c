#include "picture.h"

#include <string.h>

static mjvGeom *next_geom(mjvScene *scene, int type, const float colour[4])
{
    mjvGeom *geom;
    if (scene->ngeom >= scene->maxgeom)
        return NULL;
    geom = &scene->geoms[scene->ngeom++];
    mjv_initGeom(geom, type, NULL, NULL, NULL, colour);
    geom->category = mjCAT_DECOR;
    geom->objtype = mjOBJ_UNKNOWN;
    geom->objid = -1;
    return geom;
}

static void connect(mjvScene *scene, int type, double width, const double from[3], const double to[3], const float colour[4])
{
    mjvGeom *geom = next_geom(scene, type, colour);
    if (geom != NULL)
        mjv_connector(geom, type, width, from, to);
}

/* End of a line from a point along a vector. */
static void end_of(double end[3], const double point[3], const double along[3], double scale)
{
    int i;
    for (i = 0; i < 3; i++)
        end[i] = point[i] + scale * along[i];
}

void draw_contacts(mjvScene *scene, const mjModel *m, const mjvOption *options, const pong_contact *contacts, size_t count)
{
    static const float sticks[4] = {0.1f, 0.7f, 0.2f, 1.0f}, slips[4] = {0.9f, 0.2f, 0.1f, 1.0f};
    const double size = m->stat.meansize, length = m->vis.map.force / m->stat.meanmass;
    size_t i;
    for (i = 0; i < count; i++) {
        const pong_contact *contact = &contacts[i];
        const float *colour = contact->sticks ? sticks : slips;
        const double half = 0.5 * size * m->vis.scale.contactheight;
        double from[3], to[3];
        if (options->flags[mjVIS_CONTACTPOINT]) {
            end_of(from, contact->point, contact->normal, -half);
            end_of(to, contact->point, contact->normal, half);
            connect(scene, mjGEOM_CYLINDER, size * m->vis.scale.contactwidth, from, to, colour);
        }
        if (options->flags[mjVIS_CONTACTFORCE]) {
            end_of(to, contact->point, contact->force, length);
            connect(scene, mjGEOM_ARROW, size * m->vis.scale.forcewidth, contact->point, to, m->vis.rgba.contactforce);
        }
    }
}
