#include "origin.h"

#include "slow.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

struct contact_origin {
    const mjModel *model; /* NULL once it is forgotten */
    int instance;
    uint64_t print;       /* of what the world was built from, as far as mjModel has it */
    size_t takers;
    contact_world at;
    contact_origin *next;
};

static contact_origin *origins;
/* Held while a world is built or cloned: a world takes one call at a time. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* ---- building */

/* Refuses sleep: sleeping bodies are neither moved nor woken by forces of a plugin. */
static int refuse_sleep(const contact_world *w, const mjModel *m, message *why)
{
    size_t i;
    if (!(m->opt.enableflags & mjENBL_SLEEP))
        return 1;
    for (i = 0; i < w->group_count; i++) {
        int tree = m->body_treeid[w->bodies[i]];
        int policy = tree >= 0 ? m->tree_sleep_policy[tree] : mjSLEEP_NEVER;
        if (policy != mjSLEEP_NEVER && policy != mjSLEEP_AUTO_NEVER)
            return fail(why, "sleep is enabled and the body `%s` may fall asleep: contact would neither move nor wake it; write "
                             "sleep=\"never\" on the body at the root of its tree, or disable sleep",
                        mj_id2name(m, mjOBJ_BODY, w->bodies[i]));
    }
    return 1;
}

static int build_world(contact_world *w, const mjModel *m, int instance, message *why)
{
    contact_config config;
    int done = read_config(&config, m, instance, why) && open_world(w, &config, why) && bind_bodies(w, &config, m, why) &&
               refuse_double_pairs(w, &config, m, instance, why) && refuse_sleep(w, m, why) &&
               (w->substeps_max == 0 || refuse_integrator(m, why)) &&
               (config.checks_step == CHECK_OFF || w->substeps_max > 0 || plan_step(w, m, why)) &&
               seal_world(w, &config, mj_id2name(m, mjOBJ_PLUGIN, instance), why) &&
               (w->substeps_max == 0 || measure_slow(&w->state_size, w, why));
    close_config(&config);
    return done;
}

/* ---- fingerprint of the source */

static void mix(uint64_t *print, const void *bytes, size_t size)
{
    const unsigned char *byte = bytes;
    size_t i;
    for (i = 0; i < size; i++)
        *print = (*print ^ byte[i]) * 0x100000001b3u; /* FNV-1a */
}

/* Hashes the joints, for the check of the step. */
static void mix_joints(uint64_t *print, const mjModel *m)
{
    const size_t bodies = (size_t)m->nbody, joints = (size_t)m->njnt, dofs = (size_t)m->nv;
    mix(print, m->body_pos, 3 * bodies * sizeof *m->body_pos);
    mix(print, m->body_quat, 4 * bodies * sizeof *m->body_quat);
    mix(print, m->jnt_pos, 3 * joints * sizeof *m->jnt_pos);
    mix(print, m->jnt_axis, 3 * joints * sizeof *m->jnt_axis);
    mix(print, m->jnt_range, 2 * joints * sizeof *m->jnt_range);
    mix(print, m->jnt_limited, joints * sizeof *m->jnt_limited);
    mix(print, m->jnt_stiffness, joints * sizeof *m->jnt_stiffness);
    mix(print, m->dof_damping, dofs * sizeof *m->dof_damping);
    mix(print, m->dof_invweight0, dofs * sizeof *m->dof_invweight0);
    mix(print, &m->opt.disableflags, sizeof m->opt.disableflags);
}

/* Hosts change an mjModel in place: masses, the step, names. Then the world is built again, with its checks
 * and warnings. */
static uint64_t print_of(const mjModel *m)
{
    const size_t bodies = (size_t)m->nbody;
    uint64_t print = 0xcbf29ce484222325u;
    mix(&print, m->plugin_attr, (size_t)m->npluginattr);
    mix(&print, m->names, (size_t)m->nnames);
    mix(&print, &m->opt.timestep, sizeof m->opt.timestep);
    mix(&print, &m->opt.integrator, sizeof m->opt.integrator);
    mix(&print, &m->opt.enableflags, sizeof m->opt.enableflags);
    mix(&print, m->tree_sleep_policy, (size_t)m->ntree * sizeof *m->tree_sleep_policy);
    mix(&print, m->body_weldid, bodies * sizeof *m->body_weldid);
    mix(&print, m->body_mocapid, bodies * sizeof *m->body_mocapid);
    mix(&print, m->body_mass, bodies * sizeof *m->body_mass);
    mix(&print, m->body_inertia, 3 * bodies * sizeof *m->body_inertia);
    mix(&print, m->body_ipos, 3 * bodies * sizeof *m->body_ipos);
    mix(&print, m->body_iquat, 4 * bodies * sizeof *m->body_iquat);
    mix_joints(&print, m);
    return print;
}

/* ---- reference counting */

static contact_origin *find_or_build(const mjModel *m, int instance, message *why)
{
    const uint64_t print = print_of(m);
    contact_origin *origin;
    for (origin = origins; origin != NULL; origin = origin->next)
        if (origin->model == m && origin->instance == instance && origin->print == print)
            return origin;
    origin = calloc(1, sizeof *origin);
    if (origin == NULL) {
        fail(why, "no memory for a world");
        return NULL;
    }
    if (!build_world(&origin->at, m, instance, why)) {
        close_world(&origin->at);
        free(origin);
        return NULL;
    }
    origin->model = m;
    origin->instance = instance;
    origin->print = print;
    origin->next = origins;
    origins = origin;
    return origin;
}

contact_origin *take_origin(const mjModel *m, int instance, message *why)
{
    contact_origin *origin;
    pthread_mutex_lock(&lock);
    origin = find_or_build(m, instance, why);
    if (origin != NULL)
        origin->takers++;
    pthread_mutex_unlock(&lock);
    return origin;
}

int clone_origin(contact_origin *origin, contact_world *w, message *why)
{
    pong_status status;
    pthread_mutex_lock(&lock);
    *w = origin->at;
    status = pong_clone_world(origin->at.world, &w->world);
    pthread_mutex_unlock(&lock);
    return status == PONG_STATUS_OK ? 1 : fail_by_library(why, "cloning the world");
}

void give_back_origin(contact_origin *origin)
{
    contact_origin **place;
    if (origin == NULL)
        return;
    pthread_mutex_lock(&lock);
    if (--origin->takers == 0) {
        for (place = &origins; *place != origin; place = &(*place)->next)
            ;
        *place = origin->next;
        close_world(&origin->at);
        free(origin);
    }
    pthread_mutex_unlock(&lock);
}

void forget_origins(const mjModel *m)
{
    contact_origin *origin;
    pthread_mutex_lock(&lock);
    for (origin = origins; origin != NULL; origin = origin->next)
        if (origin->model == m)
            origin->model = NULL;
    pthread_mutex_unlock(&lock);
}
