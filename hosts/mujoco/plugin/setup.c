#include "setup.h"

#include "joints.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- models, Objects, pairs */

static int load_text(contact_world *w, const contact_config *config, const char *name, const char *text, pong_model_id *id,
                     message *why)
{
    if (*text == '\0')
        return fail(why, "the key `objects` names the model `%s`, but the key `%s` is missing or empty", name, name);
    if (pong_load_model_text(w->world, text, strlen(text), name, *config->folder != '\0' ? config->folder : NULL, id) !=
        PONG_STATUS_OK)
        return fail(why, "%s", pong_last_message());
    return 1;
}

static int load_file(contact_world *w, const contact_config *config, const char *file, pong_model_id *id, message *why)
{
    char path[1024], working_folder[1024];
    const int is_below = *file != '/' && *config->folder != '\0';
    if (snprintf(path, sizeof path, "%s%s%s", is_below ? config->folder : "", is_below ? "/" : "", file) >= (int)sizeof path)
        return fail(why, "the path of the model `%s` is longer than %u characters", file, (unsigned)sizeof path);
    if (pong_load_model(w->world, path, id) == PONG_STATUS_OK)
        return 1;
    /* The plugin cannot know the folder of the MJCF file, so this mistake is likely. */
    if (*path != '/' && access(path, F_OK) != 0 && getcwd(working_folder, sizeof working_folder) != NULL)
        return fail(why, "%s (seen from the working folder `%s`; give the key `dir` as an absolute path)", pong_last_message(),
                    working_folder);
    return fail(why, "%s", pong_last_message());
}

static int load_model(contact_world *w, const contact_config *config, const char *model, pong_model_id *id, message *why)
{
    const char *text = inline_text(config, model);
    return text != NULL ? load_text(w, config, model, text, id, why) : load_file(w, config, model, id, why);
}

static int add_groups(contact_world *w, const char *object_name, pong_object_id object, message *why)
{
    size_t count = 0, i, total;
    void *interfaces, *names;
    pong_list_interfaces(w->world, object, NULL, 0, &count);
    total = w->group_count + count;
    if ((interfaces = realloc(w->interfaces, total * sizeof *w->interfaces)) != NULL)
        w->interfaces = interfaces;
    if ((names = realloc(w->names, total * sizeof *w->names)) != NULL)
        w->names = names;
    if (interfaces == NULL || names == NULL)
        return fail(why, "no memory for the movable groups of `%s`", object_name);
    if (pong_list_interfaces(w->world, object, w->interfaces + w->group_count, count, &count) != PONG_STATUS_OK)
        return fail_by_library(why, object_name);
    for (i = 0; i < count; i++) {
        const char *path = "", *below;
        size_t length;
        char *name;
        pong_interface_path(w->world, w->interfaces[w->group_count], &path);
        /* The root has the name of the Object, as in the tables of `pong run`. */
        below = strchr(path, '/');
        length = strlen(object_name) + (below != NULL ? strlen(below) : 0) + 1;
        name = malloc(length);
        if (name == NULL)
            return fail(why, "no memory for the movable groups of `%s`", object_name);
        snprintf(name, length, "%s%s", object_name, below != NULL ? below : "");
        w->names[w->group_count++] = name;
    }
    return 1;
}

static int add_objects(contact_world *w, const contact_config *config, message *why)
{
    pong_model_id *models = malloc(config->objects.count * sizeof *models);
    size_t i, earlier;
    int done = models != NULL ? 1 : fail(why, "no memory for the models");
    for (i = 0; i < config->objects.count && done; i++) {
        const entry *object = &config->objects.entries[i];
        pong_object_id id;
        /* A model of several Objects is loaded once. */
        for (earlier = 0; earlier < i; earlier++)
            if (strcmp(config->objects.entries[earlier].second, object->second) == 0)
                break;
        if (earlier < i)
            models[i] = models[earlier];
        else
            done = load_model(w, config, object->second, &models[i], why);
        if (done && pong_create_object(w->world, models[i], object->first, &id) != PONG_STATUS_OK)
            done = fail_by_library(why, "key `objects`");
        done = done && add_groups(w, object->first, id, why);
    }
    free(models);
    return done;
}

/* Number of pairs in the configuration; two Objects without any form one pair. */
static size_t pair_count(const contact_config *config) { return config->pairs.count > 0 ? config->pairs.count : 1; }

static entry pair_at(const contact_config *config, size_t index)
{
    entry both;
    if (config->pairs.count > 0)
        return config->pairs.entries[index];
    both.first = config->objects.entries[0].first;
    both.second = config->objects.entries[1].first;
    return both;
}

/* Splits a text `Object` or `Object/path` into the Object and the path below it. */
static int find_group(contact_world *w, const char *text, pong_object_id *object, const char **path)
{
    const char *slash = strchr(text, '/');
    size_t length = slash != NULL ? (size_t)(slash - text) : strlen(text);
    char *name = malloc(length + 1);
    pong_status found;
    if (name == NULL)
        return 0;
    memcpy(name, text, length);
    name[length] = '\0';
    found = pong_find_object(w->world, name, object);
    free(name);
    *path = slash != NULL ? slash + 1 : "";
    return found == PONG_STATUS_OK;
}

/* Disables contact between two groups. */
static int add_filter(contact_world *w, const entry *groups, message *why)
{
    const char *paths[2];
    pong_object_id objects[2];
    if (!find_group(w, groups->first, &objects[0], &paths[0]) || !find_group(w, groups->second, &objects[1], &paths[1]) ||
        pong_filter_groups(w->world, objects[0], paths[0], objects[1], paths[1]) != PONG_STATUS_OK)
        return fail_by_library(why, "key `filters`");
    return 1;
}

int open_world(contact_world *w, const contact_config *config, message *why)
{
    pong_config settings = pong_default_config();
    size_t i;
    memset(w, 0, sizeof *w);
    settings.contact_capacity = config->capacity;
    w->substeps_max = config->substeps_max;
    if (pong_create_world(&settings, &w->world) != PONG_STATUS_OK)
        return fail_by_library(why, "creating the world");
    if (!add_objects(w, config, why))
        return 0;
    for (i = 0; i < pair_count(config); i++) {
        entry both = pair_at(config, i);
        if (pong_pair_by_name(w->world, both.first, both.second, NULL) != PONG_STATUS_OK)
            return fail_by_library(why, "key `pairs`");
    }
    for (i = 0; i < config->filters.count; i++)
        if (!add_filter(w, &config->filters.entries[i], why))
            return 0;
    w->bodies = malloc(w->group_count * sizeof *w->bodies);
    if (w->bodies == NULL)
        return fail(why, "no memory for the movable groups");
    for (i = 0; i < w->group_count; i++)
        w->bodies[i] = -1;
    return 1;
}

/* ---- bodies */

/* MuJoCo body with a name from the configuration, or -1. `full` receives the full name searched. */
static int find_body(const contact_config *config, const mjModel *m, const char *name, char *full, size_t size)
{
    if (strcmp(name, "world") == 0) {
        snprintf(full, size, "world");
        return 0;
    }
    snprintf(full, size, "%s%s", config->prefix, name);
    return mj_name2id(m, mjOBJ_BODY, full);
}

static const char *body_name_of(const contact_config *config, const char *group)
{
    size_t i;
    for (i = 0; i < config->bodies.count; i++)
        if (strcmp(config->bodies.entries[i].first, group) == 0)
            return config->bodies.entries[i].second;
    return group;
}

/* Writes the names of the movable groups, as many as fit. */
static const char *list_names(const contact_world *w, char *text, size_t size)
{
    size_t i, at = 0;
    text[0] = '\0';
    for (i = 0; i < w->group_count && at + 1 < size; i++)
        at += (size_t)snprintf(text + at, size - at, "%s`%s`", i > 0 ? ", " : "", w->names[i]);
    return text;
}

int bind_bodies(contact_world *w, const contact_config *config, const mjModel *m, message *why)
{
    char full[512], known[300];
    size_t i, k;
    for (i = 0; i < config->bodies.count; i++) {
        for (k = 0; k < w->group_count; k++)
            if (strcmp(w->names[k], config->bodies.entries[i].first) == 0)
                break;
        if (k == w->group_count)
            return fail(why, "key `bodies`: there is no movable group `%s`; there are %s", config->bodies.entries[i].first,
                        list_names(w, known, sizeof known));
        for (k = 0; k < i; k++)
            if (strcmp(config->bodies.entries[k].first, config->bodies.entries[i].first) == 0)
                return fail(why, "key `bodies`: `%s` is there twice; leave one out", config->bodies.entries[i].first);
    }
    for (i = 0; i < w->group_count; i++) {
        const char *name = body_name_of(config, w->names[i]);
        w->bodies[i] = find_body(config, m, name, full, sizeof full);
        if (w->bodies[i] < 0)
            return fail(why, "the movable group `%s` belongs to the MuJoCo body `%s`, which is not in the model; give a body this "
                             "name, or write `%s = BODY` in the key `bodies`%s",
                        w->names[i], full, w->names[i],
                        *config->prefix != '\0' ? " (the key `prefix` is put before the name)" : "");
    }
    return 1;
}

/* Identity of a pair for the check of duplicates: Objects, bodies of their roots, models. */
typedef struct pair_signature {
    const contact_config *config;
    const char *names[2];
    int bodies[2];
    const char *models[2];
} pair_signature;

static void sign_pair(pair_signature *signature, const contact_config *config, const mjModel *m, entry both)
{
    char full[512];
    int side;
    size_t i;
    signature->config = config;
    signature->names[0] = both.first, signature->names[1] = both.second;
    for (side = 0; side < 2; side++) {
        const char *name = signature->names[side];
        signature->bodies[side] = find_body(config, m, body_name_of(config, name), full, sizeof full);
        signature->models[side] = "";
        for (i = 0; i < config->objects.count; i++)
            if (strcmp(config->objects.entries[i].first, name) == 0)
                signature->models[side] = config->objects.entries[i].second;
        if (inline_text(config, signature->models[side]) != NULL)
            signature->models[side] = inline_text(config, signature->models[side]);
    }
}

/* True if an Object of the world `w` (a side of `p`) and an Object of the same model (a side of `q`) move
 * with the same bodies. */
static int same_bodies(const contact_world *w, const mjModel *m, const pair_signature *p, int side, const pair_signature *q, int other)
{
    char group[512], full[512];
    size_t i, length = strlen(p->names[side]);
    if (p->bodies[side] != q->bodies[other] || strcmp(p->models[side], q->models[other]) != 0)
        return 0;
    for (i = 0; i < w->group_count; i++) {
        if (strncmp(w->names[i], p->names[side], length) != 0 || w->names[i][length] != '/')
            continue;
        snprintf(group, sizeof group, "%s%s", q->names[other], w->names[i] + length);
        if (find_body(q->config, m, body_name_of(q->config, group), full, sizeof full) != w->bodies[i])
            return 0;
    }
    return 1;
}

static int same_pair(const contact_world *w, const mjModel *m, const pair_signature *p, const pair_signature *q)
{
    int swapped;
    for (swapped = 0; swapped < 2; swapped++)
        if (same_bodies(w, m, p, 0, q, swapped) && same_bodies(w, m, p, 1, q, 1 - swapped))
            return 1;
    return 0;
}

static int refuse_double(const contact_world *w, const contact_config *mine, const contact_config *other, const char *other_name,
                         const mjModel *m, message *why)
{
    size_t i, k;
    for (i = 0; i < pair_count(mine); i++)
        for (k = 0; k < (mine == other ? i : pair_count(other)); k++) {
            pair_signature p, q;
            sign_pair(&p, mine, m, pair_at(mine, i));
            sign_pair(&q, other, m, pair_at(other, k));
            if (same_pair(w, m, &p, &q))
                return fail(why, "the pair `%s, %s` is the pair `%s, %s` of the instance `%s`: the same bodies with the same "
                                 "models, so the contact force would act twice; leave one of the two out",
                            pair_at(mine, i).first, pair_at(mine, i).second, pair_at(other, k).first, pair_at(other, k).second,
                            other_name != NULL ? other_name : "");
        }
    return 1;
}

int refuse_double_pairs(const contact_world *w, const contact_config *config, const mjModel *m, int instance, message *why)
{
    int other, done = refuse_double(w, config, config, mj_id2name(m, mjOBJ_PLUGIN, instance), m, why);
    for (other = 0; other < instance && done; other++) {
        contact_config theirs;
        message ignored;
        if (m->plugin[other] != m->plugin[instance])
            continue;
        if (read_config(&theirs, m, other, &ignored))
            done = refuse_double(w, config, &theirs, mj_id2name(m, mjOBJ_PLUGIN, other), m, why);
        close_config(&theirs);
    }
    return done;
}

/* ---- step, seal */

/* Sets mass and joints of the body of a movable group; the springs of a tree with the first of its groups. */
static int tell_body(contact_world *w, const mjModel *m, size_t group)
{
    const int body = w->bodies[group];
    pong_mass mass = mass_of(m, body);
    pong_joints joints;
    size_t i;
    int is_first = 1;
    if (pong_set_mass(w->world, w->interfaces[group], &mass) != PONG_STATUS_OK)
        return 0;
    if (!is_on_joints(m, body))
        return 1;
    joints = joints_of(m, body);
    for (i = 0; i < group; i++)
        is_first = is_first && m->body_treeid[w->bodies[i]] != m->body_treeid[body];
    if (is_first)
        add_springs(&joints, m, body);
    return pong_set_joints(w->world, w->interfaces[group], &joints) == PONG_STATUS_OK;
}

int plan_step(contact_world *w, const mjModel *m, message *why)
{
    pong_step_plan plan = pong_default_step_plan();
    size_t i;
    plan.step = m->opt.timestep;
    plan.wrench_coupling = m->opt.integrator == mjINT_RK4 ? PONG_COUPLING_STAGES : PONG_COUPLING_SEMI_IMPLICIT;
    /* Warn only of contacts that gain energy; accuracy is the task of `pong advise`. */
    plan.depth_within = plan.rebound_within = 0;
    for (i = 0; i < w->group_count; i++)
        if (!tell_body(w, m, i))
            return fail(why, "%s; or leave the check out: key `check_step`, value `false`", pong_last_message());
    if (pong_plan_step(w->world, &plan) != PONG_STATUS_OK)
        return fail(why, "%s; or leave the check out: key `check_step`, value `false`", pong_last_message());
    return 1;
}

int seal_world(contact_world *w, const contact_config *config, const char *instance_name, message *why)
{
    pong_seal_report report;
    size_t i;
    if (pong_seal(w->world, &report) != PONG_STATUS_OK)
        return fail(why, "%s", pong_last_message());
    w->state_size = (size_t)report.contact_state_size;
    for (i = 0; i < report.warning_count && instance_name != NULL; i++) {
        const char *text;
        if (pong_seal_warning(w->world, i, &text) == PONG_STATUS_OK)
            warn_once(instance_name, text);
    }
    for (i = 0; i < report.note_count && instance_name != NULL && config->checks_step == CHECK_WITH_NOTES; i++) {
        const char *text;
        if (pong_seal_note(w->world, i, &text) == PONG_STATUS_OK)
            warn_once(instance_name, text);
    }
    return 1;
}

void close_world(contact_world *w)
{
    size_t i;
    for (i = 0; i < w->group_count; i++)
        free(w->names[i]);
    free(w->names);
    free(w->interfaces);
    free(w->bodies);
    pong_destroy_world(w->world);
    memset(w, 0, sizeof *w);
}
