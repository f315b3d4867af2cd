#include "step.h"

#include "config.h"
#include "kinematics.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static mjtNum *state_of(const mjModel *m, const mjData *d, const contact_host *host)
{
    return d->plugin_state + m->plugin_stateadr[host->instance];
}

static const char *name_of(const mjModel *m, const contact_host *host) { return mj_id2name(m, mjOBJ_PLUGIN, host->instance); }

/* ---- failures and limits, reported once per run */

static int fail_step(contact_host *host, const mjModel *m, int status, const char *text)
{
    host->has_result = 0;
    host->status = status;
    host->contact_count = host->flags = 0;
    memset(host->wrenches, 0, host->at.group_count * sizeof *host->wrenches);
    if (!host->warned_failure)
        warn(name_of(m, host), text);
    host->warned_failure = 1;
    return 0;
}

static int fail_step_by_library(contact_host *host, const mjModel *m, int status)
{
    message why;
    fail(&why, "no contact force in this step: %s", pong_last_message());
    return fail_step(host, m, status, why.text);
}

static void tell_limit(message *text, const pong_report *report)
{
    char cause[128], cure[128];
    if ((report->flags & PONG_FLAG_CONTACT_LIMIT) != 0)
        snprintf(cause, sizeof cause, "%u contacts at once are more than contact_capacity allows",
                 (unsigned)report->contacts_wanted);
    else
        snprintf(cause, sizeof cause, "a ball touched one surface in more places than could be shared exactly");
    if (report->advised_capacity <= MAX_CAPACITY)
        snprintf(cure, sizeof cure, "Set contact_capacity to %u", (unsigned)report->advised_capacity);
    else
        snprintf(cure, sizeof cure, "Let fewer primitives touch at once: contact_capacity can be %d at most", MAX_CAPACITY);
    fail(text, "%s; the deepest act. %s", cause, cure);
}

static void warn_of_limits(contact_host *host, const mjModel *m, const pong_report *report)
{
    message text;
    if ((report->flags & (PONG_FLAG_CONTACT_LIMIT | PONG_FLAG_LOAD_SHARING_LIMIT)) != 0 && !host->warned_limit) {
        host->warned_limit = 1;
        tell_limit(&text, report);
        warn(name_of(m, host), text.text);
    }
    if ((report->flags & PONG_FLAG_TUNNELLED) != 0 && !host->warned_tunnelling) {
        host->warned_tunnelling = 1;
        warn(name_of(m, host), "something went right through something else in one step, and no contact acted; shorten the "
                               "timestep, or call mj_resetData() before a jump that is meant");
    }
    if ((report->flags & PONG_FLAG_DEEP_IN_MESH) != 0 && !host->warned_depth) {
        host->warned_depth = 1;
        warn(name_of(m, host), "a solid was deeper in a mesh than its facets push, and the force did not grow as it should; make "
                               "the surfaces stiffer, or divide the mesh by `pong decompose`");
    }
}

/* Warns of steps that the copies could not follow, or for which they were not made. */
static void warn_of_slow(contact_host *host, const mjModel *m, const pong_slow_report *report)
{
    message text;
    if (host->warned_slow || (report->warnings & (PONG_SLOW_SUBSTEP_LIMIT | PONG_SLOW_THETA_MISMATCH)) == 0)
        return;
    host->warned_slow = 1;
    if ((report->warnings & PONG_SLOW_SUBSTEP_LIMIT) != 0)
        fail(&text, "the contacts of a step need %u substeps, and substeps_max is %u: %s. Raise substeps_max or shorten the "
                    "timestep", (unsigned)report->substeps_wanted, (unsigned)host->at.substeps_max,
             (report->warnings & PONG_SLOW_UNRESOLVED) != 0 ? "the wrench is that of one implicit step, without rebound"
                                                            : "rebounds are less accurate");
    else
        fail(&text, "bodies did not move as semi-implicit Euler moves them (theta is %.2f, not 1), and contact may gain "
                    "energy; set positions and velocities only together with mj_resetData()", report->theta_measured);
    warn(name_of(m, host), text.text);
}

/* ---- states in, contact state in and out */

static void read_states(contact_host *host, const mjModel *m, const mjData *d)
{
    size_t i;
    for (i = 0; i < host->at.group_count; i++) {
        const int body = host->at.bodies[i];
        pong_state *state = &host->states[i];
        mjtNum velocity[6];
        mj_objectVelocity(m, d, mjOBJ_XBODY, body, velocity, 0);
        memcpy(state->position, d->xpos + 3 * body, sizeof state->position);
        memcpy(state->orientation, d->xquat + 4 * body, sizeof state->orientation);
        memcpy(state->angular_velocity, velocity, sizeof state->angular_velocity);
        memcpy(state->linear_velocity, velocity + 3, sizeof state->linear_velocity);
    }
}

/* Restores the world to the memory in the state, if it differs; mostly it does not. */
static int restore_past(contact_host *host, const mjModel *m, const contact_past *past, const mjtNum *state)
{
    const unsigned char *bytes = host->no_past;
    size_t size = host->no_past_size;
    pong_status status;
    if (host->has_key && past->key == host->key)
        return 1;
    if (past->key != 0) {
        if (!read_contact_state(host->bytes, past, state, host->at.group_count))
            return fail_step(host, m, PONG_STATUS_BAD_STATE_BLOCK,
                             "plugin_state holds no contact state of this instance; set a state that this model has saved, or "
                             "call mj_resetData()");
        bytes = host->bytes;
        size = past->used;
    }
    if (host->slow.host != NULL)
        status = pong_restore_slow_state(host->slow.host, bytes, size);
    else
        status = pong_restore_contact_state(host->at.world, bytes, size);
    if (status != PONG_STATUS_OK)
        return fail_step_by_library(host, m, status);
    host->has_key = 1;
    host->key = past->key;
    return 1;
}

static int read_known_past(contact_past *past, contact_host *host, const mjModel *m, const mjtNum *state)
{
    if (m->plugin_statenum[host->instance] == state_length(host->at.group_count, host->at.state_size) &&
        read_past(past, state, host->at.group_count, host->at.state_size))
        return 1;
    return fail_step(host, m, PONG_STATUS_BAD_STATE_BLOCK,
                     "plugin_state is not that of this instance: it was set from another model, its numbers were changed, or the model "
                     "files have changed since the MJCF was compiled; set a state that this model has saved, compile it again, "
                     "or call mj_resetData()");
}

/* Refuses sleep that was enabled after the model was compiled. */
static int refuse_late_sleep(contact_host *host, const mjModel *m)
{
    size_t i;
    if (!(m->opt.enableflags & mjENBL_SLEEP))
        return 1;
    for (i = 0; i < host->at.group_count; i++) {
        int tree = m->body_treeid[host->at.bodies[i]];
        if (tree >= 0 && m->tree_sleep_policy[tree] != mjSLEEP_NEVER && m->tree_sleep_policy[tree] != mjSLEEP_AUTO_NEVER)
            return fail_step(host, m, PONG_STATUS_WRONG_PHASE,
                             "no contact force: sleep was enabled, and bodies that touch may fall asleep; write sleep=\"never\" "
                             "on the roots of their trees, or disable sleep");
    }
    return 1;
}

/* ---- evaluate and commit */

/* Stores the result of the world's evaluation of host->states. */
static int take_result(contact_host *host, const mjModel *m, pong_report *report)
{
    pong_status status = pong_get_wrenches(host->at.world, host->at.interfaces, PONG_REFERENCE_FRAME_COMMON, host->wrenches,
                                           host->at.group_count);
    if (status == PONG_STATUS_OK)
        status = pong_get_report(host->at.world, report);
    if (status != PONG_STATUS_OK)
        return fail_step_by_library(host, m, status);
    host->contact_count = report->contacts;
    host->flags = report->flags;
    host->status = PONG_STATUS_OK;
    return 1;
}

static int evaluate_world(contact_host *host, const mjModel *m)
{
    pong_report report;
    pong_status status = pong_set_states(host->at.world, host->at.interfaces, host->states, host->at.group_count);
    if (status == PONG_STATUS_OK)
        status = pong_evaluate(host->at.world);
    if (status != PONG_STATUS_OK)
        return fail_step_by_library(host, m, status);
    return take_result(host, m, &report);
}

static int compute_contacts(contact_host *host, const mjModel *m, const contact_past *past, const mjtNum *state)
{
    return restore_past(host, m, past, state) && evaluate_world(host, m);
}

/* Stores the result of the slow host's evaluation. */
static int take_slow_result(contact_host *host, const mjModel *m)
{
    pong_slow_report report;
    pong_status status = pong_get_slow_wrenches(host->slow.host, host->at.interfaces, PONG_REFERENCE_FRAME_COMMON, host->wrenches,
                                                host->at.group_count);
    if (status == PONG_STATUS_OK)
        status = pong_get_slow_report(host->slow.host, &report);
    if (status != PONG_STATUS_OK)
        return fail_step_by_library(host, m, status);
    host->contact_count = report.contacts;
    host->flags = report.flags;
    host->status = PONG_STATUS_OK;
    warn_of_slow(host, m, &report);
    return 1;
}

static int compute_slow(contact_host *host, const mjModel *m, const mjData *d, const contact_past *past, const mjtNum *state)
{
    pong_status status;
    if (!restore_past(host, m, past, state))
        return 0;
    status = evaluate_slow(&host->slow, &host->at, m, d, host->states);
    return status == PONG_STATUS_OK ? take_slow_result(host, m) : fail_step_by_library(host, m, status);
}

static void keep_result(contact_host *host, uint64_t key, uint64_t seen)
{
    host->has_result = 1;
    host->result_key = key;
    host->result_seen = seen;
}

int evaluate(contact_host *host, const mjModel *m, const mjData *d)
{
    const mjtNum *state = state_of(m, d, host);
    contact_past past;
    uint64_t seen;
    if (!refuse_late_sleep(host, m) || !read_known_past(&past, host, m, state))
        return 0;
    read_states(host, m, d);
    seen = hash_states(host->states, host->at.group_count);
    if (host->has_result && host->result_key == past.key && host->result_seen == seen)
        return 1;
    if (host->slow.host != NULL) {
        if (!compute_slow(host, m, d, &past, state))
            return 0;
    } else if (past.key != 0 && past.seen == seen) {
        /* The states are those of the last commit, so its wrenches apply. They are also more accurate where
         * friction has just slipped, and those of `pong run`. */
        read_wrenches(host->wrenches, state, host->at.group_count);
        host->contact_count = past.contacts;
        host->flags = past.flags;
        host->status = PONG_STATUS_OK;
    } else if (!compute_contacts(host, m, &past, state)) {
        return 0;
    }
    keep_result(host, past.key, seen);
    return 1;
}

static void begin_run(contact_host *host, const contact_past *past)
{
    if (past->key == 0)
        host->warned_limit = host->warned_tunnelling = host->warned_depth = host->warned_failure = host->warned_slow = 0;
}

/* Commits host->states and writes the new contact memory to the state. */
static void commit_states(contact_host *host, const mjModel *m, mjtNum *state)
{
    contact_past past;
    pong_report report;
    pong_status status;
    size_t used;

    if (!read_known_past(&past, host, m, state) || !restore_past(host, m, &past, state))
        return;
    begin_run(host, &past);
    status = pong_set_states(host->at.world, host->at.interfaces, host->states, host->at.group_count);
    if (status == PONG_STATUS_OK)
        status = pong_commit(host->at.world);
    if (status != PONG_STATUS_OK) {
        fail_step_by_library(host, m, status);
        return;
    }
    host->has_key = 0;
    if (take_result(host, m, &report) && pong_contact_state_used(host->at.world, &used) == PONG_STATUS_OK &&
        pong_save_contact_state(host->at.world, host->bytes, used) == PONG_STATUS_OK) {
        past.seen = hash_states(host->states, host->at.group_count);
        past.key = next_key(past.key, past.seen);
        past.used = (uint32_t)used;
        past.contacts = host->contact_count;
        past.flags = host->flags;
        memset(host->bytes + used, 0, sizeof(uint32_t));
        write_state(state, &past, host->wrenches, host->at.group_count, host->bytes, host->at.state_size);
        host->has_key = 1;
        host->key = past.key;
        keep_result(host, past.key, past.seen);
        warn_of_limits(host, m, &report);
    }
}

/* Commits the frame of the slow host that was evaluated for the states in host->states. */
static void commit_slow(contact_host *host, const mjModel *m, mjtNum *state)
{
    const uint64_t seen = hash_states(host->states, host->at.group_count);
    contact_past past;
    pong_status status;
    size_t used;
    if (!read_known_past(&past, host, m, state))
        return;
    begin_run(host, &past);
    if (!host->has_result || host->result_key != past.key || host->result_seen != seen) {
        fail_step(host, m, PONG_STATUS_WRONG_PHASE,
                  "no contact was computed for the beginning of this step; step with mj_step(), or mj_step1() and mj_step2()");
        return;
    }
    status = pong_commit_slow(host->slow.host);
    host->has_key = 0;
    if (status == PONG_STATUS_OK)
        status = pong_save_slow_state(host->slow.host, host->bytes, host->at.state_size, &used);
    if (status != PONG_STATUS_OK) {
        fail_step_by_library(host, m, status);
        return;
    }
    past.seen = seen;
    past.key = next_key(past.key, seen);
    past.used = (uint32_t)used;
    past.contacts = host->contact_count;
    past.flags = host->flags;
    memset(host->bytes + used, 0, sizeof(uint32_t));
    write_state(state, &past, host->wrenches, host->at.group_count, host->bytes, host->at.state_size);
    host->has_key = 1;
    host->key = past.key;
    host->has_result = 0;
}

void commit(contact_host *host, const mjModel *m, mjData *d)
{
    saved_kinematics saved;
    if (!refuse_late_sleep(host, m))
        return;
    if (host->slow.host != NULL) {
        /* The kinematics are those of the beginning of the step, for which the frame was computed. */
        read_states(host, m, d);
        commit_slow(host, m, state_of(m, d, host));
        return;
    }
    saved = update_kinematics(m, d);
    read_states(host, m, d);
    commit_states(host, m, state_of(m, d, host));
    restore_kinematics(m, d, saved);
}

/* Grows the contact list for a picture. */
static int make_room(contact_host *host, size_t count)
{
    void *contacts;
    if (count <= host->contact_capacity)
        return 1;
    contacts = realloc(host->contacts, count * sizeof *host->contacts);
    if (contacts == NULL)
        return 0;
    host->contacts = contacts;
    host->contact_capacity = count;
    return 1;
}

size_t list_contacts(contact_host *host, const mjModel *m, mjData *d)
{
    const mjtNum *state = state_of(m, d, host);
    saved_kinematics saved;
    contact_past past;
    size_t count = 0;
    host->has_result = 0;
    if (!refuse_late_sleep(host, m) || !read_known_past(&past, host, m, state))
        return 0;
    /* After a step the memory is that of its end, so the positions must be too: with those of the beginning,
     * all bristles would appear relieved. */
    saved = update_kinematics(m, d);
    read_states(host, m, d);
    restore_kinematics(m, d, saved);
    /* With copies the world has no memory of its own: its bristles are drawn relieved. */
    if (host->slow.host != NULL ? !evaluate_world(host, m) : !compute_contacts(host, m, &past, state))
        return 0;
    if (pong_contact_count(host->at.world, &count) != PONG_STATUS_OK || !make_room(host, count))
        return 0;
    return pong_get_contacts(host->at.world, host->contacts, count, &count) == PONG_STATUS_OK ? count : 0;
}
