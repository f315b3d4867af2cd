/* The MuJoCo engine plugin `pong.contact`: passive forces, a sensor and visualization of the contacts.
 * docs/mujoco.md. */
#include "picture.h"
#include "step.h"

#include <string.h>

static int count_state(const mjModel *m, int instance)
{
    int numbers, groups;
    measure_instance(m, instance, &numbers, &groups);
    return numbers;
}

static int count_sensor_data(const mjModel *m, int instance, int sensor)
{
    int numbers, groups;
    (void)sensor;
    measure_instance(m, instance, &numbers, &groups);
    return count_sensor_numbers((size_t)groups);
}

static int init(const mjModel *m, mjData *d, int instance) { return make_host(m, d, instance) != NULL ? 0 : -1; }

static void destroy(mjData *d, int instance) { delete_host(d, instance); }

/* Creates the host only: the contact memory is in plugin_state and has been copied. */
static void copy(mjData *target, const mjModel *m, const mjData *source, int instance)
{
    (void)source;
    find_host(m, target, instance);
}

static void reset(const mjModel *m, mjtNum *state, void *data, int instance)
{
    (void)data;
    memset(state, 0, (size_t)m->plugin_statenum[instance] * sizeof *state);
}

static void apply_wrenches(const contact_host *host, const mjModel *m, mjData *d)
{
    size_t i;
    for (i = 0; i < host->at.group_count; i++) {
        const int body = host->at.bodies[i];
        if (m->body_weldid[body] != 0)
            mj_applyFT(m, d, host->wrenches[i].force, host->wrenches[i].moment, d->xpos + 3 * body, body, d->qfrc_passive);
    }
}

static void write_sensors(const contact_host *host, const mjModel *m, mjData *d)
{
    int sensor;
    size_t i;
    for (sensor = 0; sensor < m->nsensor; sensor++) {
        mjtNum *numbers = d->sensordata + m->sensor_adr[sensor];
        if (m->sensor_type[sensor] != mjSENS_PLUGIN || m->sensor_plugin[sensor] != host->instance)
            continue;
        *numbers++ = host->contact_count;
        *numbers++ = host->flags;
        *numbers++ = host->status;
        for (i = 0; i < host->at.group_count; i++, numbers += 6) {
            mju_copy3(numbers, host->wrenches[i].force);
            mju_copy3(numbers + 3, host->wrenches[i].moment);
        }
    }
}

static void compute(const mjModel *m, mjData *d, int instance, int capability)
{
    contact_host *host = find_host(m, d, instance);
    int done;
    if (host == NULL || host->is_silent)
        return;
    /* Copies follow all forces, which may have changed although no state did. */
    if (host->slow.host != NULL && capability == mjPLUGIN_PASSIVE)
        host->has_result = 0;
    done = evaluate(host, m, d);
    if (capability == mjPLUGIN_PASSIVE && done)
        apply_wrenches(host, m, d);
    if (capability == mjPLUGIN_SENSOR)
        write_sensors(host, m, d);
}

static void advance(const mjModel *m, mjData *d, int instance)
{
    contact_host *host = find_host(m, d, instance);
    if (host != NULL && !host->is_silent)
        commit(host, m, d);
}

static void visualize(const mjModel *m, mjData *d, const mjvOption *options, mjvScene *scene, int instance)
{
    contact_host *host;
    size_t count;
    if (!options->flags[mjVIS_CONTACTPOINT] && !options->flags[mjVIS_CONTACTFORCE])
        return;
    host = find_host(m, d, instance);
    if (host == NULL)
        return;
    count = list_contacts(host, m, d);
    draw_contacts(scene, m, options, host->contacts, count);
}

/* Layouts of mjModel and mjData change with every version of MuJoCo. */
#ifndef PONG_CONTACT_BUILT_FOR
#define PONG_CONTACT_BUILT_FOR mjVERSION_HEADER
#endif

static int versions_fit(void)
{
    if (mj_version() != PONG_CONTACT_BUILT_FOR) {
        mju_warning("pong.contact was built for MuJoCo %d and this is %d: it is not registered; build it with the headers of this "
                    "version, or install its wheel for this version",
                    PONG_CONTACT_BUILT_FOR, mj_version());
        return 0;
    }
    if (PONG_CHECK_ABI() != PONG_STATUS_OK) {
        mju_warning("pong.contact is not registered: %s", pong_last_message());
        return 0;
    }
    return 1;
}

mjPLUGIN_LIB_INIT(pong_contact)
{
    mjpPlugin plugin;
    if (!versions_fit())
        return;
    mjp_defaultPlugin(&plugin);
    plugin.name = "pong.contact";
    plugin.nattribute = contact_attribute_count;
    plugin.attributes = contact_attributes;
    plugin.capabilityflags = mjPLUGIN_PASSIVE | mjPLUGIN_SENSOR;
    plugin.needstage = mjSTAGE_VEL;
    plugin.nstate = count_state;
    plugin.nsensordata = count_sensor_data;
    plugin.init = init;
    plugin.destroy = destroy;
    plugin.copy = copy;
    plugin.reset = reset;
    plugin.compute = compute;
    plugin.advance = advance;
    plugin.visualize = visualize;
    mjp_registerPlugin(&plugin);
}
