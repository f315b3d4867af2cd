/* MuJoCo for the benchmarks. Its library has no function for some of this, and its structs have no stable
 * layout. */
#include <mujoco/mujoco.h>
#include <stdlib.h>

typedef struct {
    mjModel *model;
    mjData *data;
} scene;

void pong_mujoco_free(scene *s)
{
    if (s) {
        mj_deleteData(s->data);
        mj_deleteModel(s->model);
        free(s);
    }
}

/* A scene from MJCF text; NULL with a message if it is refused. */
scene *pong_mujoco_load(const char *xml, char *message, int size)
{
    scene *s = calloc(1, sizeof *s);
    mjSpec *spec = mj_parseXMLString(xml, NULL, message, size);
    s->model = spec ? mj_compile(spec, NULL) : NULL;
    if (spec && !s->model) {
        mju_strncpy(message, mjs_getError(spec), size);
    }
    mj_deleteSpec(spec);
    s->data = s->model ? mj_makeData(s->model) : NULL;
    if (!s->data) {
        pong_mujoco_free(s);
        return NULL;
    }
    mj_kinematics(s->model, s->data);
    return s;
}

/* Fills the height field with heights relative to its greatest height. */
void pong_mujoco_heights(scene *s, const float *heights, int count)
{
    int i;
    for (i = 0; i < count; i++) {
        s->model->hfield_data[i] = heights[i];
    }
}

/* Sets the poses of the bodies (position, quaternion) and returns the number of contacts. */
int pong_mujoco_frame(scene *s, const double *poses, int bodies)
{
    int i, contacts = 0;
    mju_copy(s->data->qpos, poses, 7 * bodies);
    mj_kinematics(s->model, s->data);
    mj_collision(s->model, s->data);
    for (i = 0; i < s->data->ncon; i++) {
        contacts += s->data->contact[i].dist < 0;
    }
    return contacts;
}

/* Depth of the deepest contact of the last frame, zero if there was none. */
double pong_mujoco_deepest(const scene *s)
{
    double deepest = 0;
    int i;
    for (i = 0; i < s->data->ncon; i++) {
        deepest = mju_max(deepest, -s->data->contact[i].dist);
    }
    return deepest;
}

/* Result of a query: depth (0: none), normal from target to mover, point. */
typedef struct {
    double depth, normal[3], point[3];
} answer;

enum { TARGET, MOVER };

static answer narrow(scene *s, mjfCollision collide, int first)
{
    mjPreContact found[mjMAXCONPAIR];
    answer out = {0};
    int i, count = collide(s->model, s->data, found, first, TARGET + MOVER - first, 0);
    for (i = 0; i < count; i++) {
        if (-found[i].dist > out.depth) {
            out.depth = -found[i].dist;
            mju_scl3(out.normal, found[i].normal, first == MOVER ? -1 : 1);
            mju_copy3(out.point, found[i].pos);
        }
    }
    return out;
}

/* Places a geom by its body's pose: position, then quaternion (w, x, y, z). MuJoCo moves a mesh to its own
 * centre and principal axes, so even here a geom has a pose in its body. */
static void place(scene *s, int geom, const double *pose)
{
    double orientation[4], *position = s->data->geom_xpos + 3 * geom;
    mju_rotVecQuat(position, s->model->geom_pos + 3 * geom, pose + 3);
    mju_addTo3(position, pose);
    mju_mulQuat(orientation, pose + 3, s->model->geom_quat + 4 * geom);
    mju_quat2Mat(s->data->geom_xmat + 9 * geom, orientation);
}

/* One query per pair of poses of mover and target, by the function that MuJoCo's own dispatch would call. */
void pong_mujoco_pairs(scene *s, const double *poses, int count, answer *answers)
{
    const int *type = s->model->geom_type;
    /* MuJoCo's functions take the geom of the lesser type first. */
    int first = type[MOVER] <= type[TARGET] ? MOVER : TARGET, i;
    mjfCollision collide = mjCOLLISIONFUNC[type[first]][type[TARGET + MOVER - first]];
    for (i = 0; i < count; i++, poses += 14) {
        place(s, MOVER, poses);
        place(s, TARGET, poses + 7);
        answers[i] = narrow(s, collide, first);
    }
}

/* Distance along a ray to the target, by the function that mj_ray calls for its type; negative for none. */
static double cast(scene *s, const double *origin, const double *direction, double *normal)
{
    const mjModel *m = s->model;
    if (m->geom_type[TARGET] == mjGEOM_MESH) {
        return mj_rayMesh(m, s->data, TARGET, origin, direction, normal);
    }
    return mju_rayGeom(s->data->geom_xpos + 3 * TARGET, s->data->geom_xmat + 9 * TARGET, m->geom_size + 3 * TARGET,
                       origin, direction, m->geom_type[TARGET], normal);
}

/* A ray along z that starts at `start` in the mover's frame, no longer than `length`. */
void pong_mujoco_rays(scene *s, const double *poses, int count, double start, double length, answer *answers)
{
    const double z[3] = {0, 0, 1};
    int i;
    for (i = 0; i < count; i++, poses += 14) {
        double direction[3], origin[3];
        answer out = {0};
        mju_rotVecQuat(direction, z, poses + 3);
        mju_addScl3(origin, poses, direction, start);
        place(s, TARGET, poses + 7);
        out.depth = cast(s, origin, direction, out.normal);
        if (out.depth < 0 || out.depth >= length) {
            out.depth = 0;
        } else {
            mju_addScl3(out.point, origin, direction, out.depth);
        }
        answers[i] = out;
    }
}

const char *pong_mujoco_version(void) { return mj_versionString(); }
