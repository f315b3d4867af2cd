#include "host.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* ---- making and deleting */

static void close_host(contact_host *host)
{
    close_slow(&host->slow);
    free(host->states);
    free(host->wrenches);
    free(host->bytes);
    free(host->no_past);
    free(host->contacts);
    pong_destroy_world(host->at.world);
    give_back_origin(host->origin);
    free(host);
}

/* Keeps the state of copies that have no history. */
static int keep_slow_start(contact_host *host, message *why)
{
    host->no_past = malloc(host->at.state_size);
    if (host->no_past == NULL)
        return fail(why, "no memory for %u bytes of contact state", (unsigned)host->at.state_size);
    if (pong_save_slow_state(host->slow.host, host->no_past, host->at.state_size, &host->no_past_size) != PONG_STATUS_OK)
        return fail_by_library(why, "state of the copies");
    return 1;
}

/* Allocates the memory for steps, and the contact state without history. */
static int take_memory(contact_host *host, message *why)
{
    const size_t groups = host->at.group_count, room = host->at.state_size + sizeof(uint32_t);
    host->states = malloc(groups * sizeof *host->states);
    host->wrenches = malloc(groups * sizeof *host->wrenches);
    host->bytes = malloc(room);
    if (host->states == NULL || host->wrenches == NULL || host->bytes == NULL)
        return fail(why, "no memory for %u bytes of contact state", (unsigned)room);
    if (host->slow.host != NULL)
        return keep_slow_start(host, why);
    if (pong_contact_state_used(host->at.world, &host->no_past_size) != PONG_STATUS_OK)
        return fail_by_library(why, "contact state");
    host->no_past = malloc(host->no_past_size);
    if (host->no_past == NULL)
        return fail(why, "no memory for %u bytes of contact state", (unsigned)host->no_past_size);
    if (pong_save_contact_state(host->at.world, host->no_past, host->no_past_size) != PONG_STATUS_OK)
        return fail_by_library(why, "contact state");
    return 1;
}

int count_sensor_numbers(size_t groups) { return 3 + 6 * (int)groups; }

/* Refuses changed files: MuJoCo sized its arrays when the model was compiled, perhaps long ago and into a
 * binary file. */
static int refuse_changed_files(const contact_host *host, const mjModel *m, int instance, message *why)
{
    int sensor, fits = m->plugin_statenum[instance] == state_length(host->at.group_count, host->at.state_size);
    for (sensor = 0; sensor < m->nsensor; sensor++)
        if (m->sensor_type[sensor] == mjSENS_PLUGIN && m->sensor_plugin[sensor] == instance)
            fits = fits && m->sensor_dim[sensor] == count_sensor_numbers(host->at.group_count);
    return fits ? 1
                : fail(why, "the model files are not those that this mjModel was compiled with: they have other movable groups or "
                            "surfaces now; compile the MJCF again");
}

int measure_instance(const mjModel *m, int instance, int *state_numbers, int *groups)
{
    contact_config config;
    contact_world w;
    message ignored;
    int done;
    memset(&w, 0, sizeof w);
    /* This function is called when a model is compiled. */
    forget_origins(m);
    done = read_config(&config, m, instance, &ignored) && open_world(&w, &config, &ignored) && 
           seal_world(&w, &config, NULL, &ignored) && (w.substeps_max == 0 || measure_slow(&w.state_size, &w, &ignored));
    *groups = (int)w.group_count;
    *state_numbers = done ? state_length(w.group_count, w.state_size) : 0;
    close_world(&w);
    close_config(&config);
    return done;
}

/* ---- the table of all worlds of the process */

enum { BUCKETS = 256 };
static contact_host *buckets[BUCKETS];
static pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;

static contact_host **bucket_of(const mjData *d, int instance)
{
    uintptr_t bits = (uintptr_t)d / 64 + (uintptr_t)instance;
    return &buckets[(bits ^ bits >> 8 ^ bits >> 16) % BUCKETS];
}

static contact_host *look_up(const mjData *d, int instance)
{
    contact_host *host;
    pthread_rwlock_rdlock(&lock);
    for (host = *bucket_of(d, instance); host != NULL; host = host->next)
        if (host->data == d && host->instance == instance)
            break;
    pthread_rwlock_unlock(&lock);
    return host;
}

static contact_host *take_out(const mjData *d, int instance)
{
    contact_host **place, *host;
    pthread_rwlock_wrlock(&lock);
    for (place = bucket_of(d, instance); (host = *place) != NULL; place = &host->next)
        if (host->data == d && host->instance == instance) {
            *place = host->next;
            break;
        }
    pthread_rwlock_unlock(&lock);
    return host;
}

contact_host *make_host(const mjModel *m, const mjData *d, int instance)
{
    message why;
    contact_host **place, *host = calloc(1, sizeof *host);
    delete_host(d, instance);
    if (host == NULL) {
        warn(mj_id2name(m, mjOBJ_PLUGIN, instance), "no memory");
        return NULL;
    }
    host->is_silent = is_making_scratch();
    host->origin = host->is_silent ? NULL : take_origin(m, instance, &why);
    if (!host->is_silent && (host->origin == NULL || !clone_origin(host->origin, &host->at, &why) ||
        !open_slow(&host->slow, &host->at, m, &why) || !take_memory(host, &why) ||
        !refuse_changed_files(host, m, instance, &why))) {
        warn(mj_id2name(m, mjOBJ_PLUGIN, instance), why.text);
        close_host(host);
        return NULL;
    }
    host->has_key = 1;
    host->data = d;
    host->instance = instance;
    pthread_rwlock_wrlock(&lock);
    place = bucket_of(d, instance);
    host->next = *place;
    *place = host;
    pthread_rwlock_unlock(&lock);
    return host;
}

contact_host *find_host(const mjModel *m, const mjData *d, int instance)
{
    contact_host *host = look_up(d, instance);
    return host != NULL ? host : make_host(m, d, instance);
}

void delete_host(const mjData *d, int instance)
{
    contact_host *host = take_out(d, instance);
    if (host != NULL)
        close_host(host);
}
