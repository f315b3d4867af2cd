/************************************************************************
PURPOSE: (Calls Pong at the right moments of a Trick simulation.)
LIBRARY DEPENDENCIES: ((pong/src/PongContact.cpp))
************************************************************************/
#include "pong/include/PongContact.hh"

#include "pong_cpp.hpp"
#include "trick/exec_proto.h"
#include "trick/memorymanager_c_intf.h"
#include "trick/message_proto.h"

#include <cstring>
#include <map>
#include <vector>

/* The world and the handles of its ports, which change with every world. */
struct PongContactWorld {
    explicit PongContactWorld(const pong_config &config) : world(config) {}

    pong::World world;
    std::vector<pong_interface_id> interfaces;
    std::vector<pong_state> states;
    std::vector<pong_wrench> wrenches;
};

namespace {

/* Time before a frame at which sleeping workers are woken at the end of a freeze, and for which they then look for work. */
const std::chrono::microseconds UNFREEZE_PREWAKE(2000);

/* Runs what may throw. An error ends the simulation through Trick's own channel, with the message of the library. */
template <class Job>
int guarded(const char *job, Job &&run) {
    try {
        run();
        return 0;
    } catch (const std::exception &error) {
        std::string text = std::string("PongContact::") + job + ": " + error.what();
        message_publish(MSG_ERROR, "%s\n", text.c_str());
        exec_terminate_with_return(1, __FILE__, __LINE__, text.c_str());
        return 1;
    }
}

void copy_state(const PongPort &port, double *out) {
    std::memcpy(out, port.position, sizeof port.position);
    std::memcpy(out + 3, port.orientation, sizeof port.orientation);
    std::memcpy(out + 7, port.linear_velocity, sizeof port.linear_velocity);
    std::memcpy(out + 10, port.angular_velocity, sizeof port.angular_velocity);
}

} // namespace

PongPort::PongPort() : position(), orientation(), linear_velocity(), angular_velocity(), force(), moment() {
    orientation[0] = 1.0;
}

PongContact::PongContact()
    : models("."), port_count(0), pair_count(0), workers(0), fifo_priority(0), contacts(0), flags(0),
      flagged_frames(0), committed(0), committed_state(), committed_wrench(), contact_state(NULL),
      contact_state_bytes(0) {}

void PongContactOwner::destroy() {
    delete world;
    world = NULL;
}

int PongContact::add_port(const std::string &object, const std::string &model, const std::string &group) {
    return guarded("add_port", [&] {
        if (port_count == PONG_PORTS_MAX) {
            throw std::runtime_error(object + ": there is no room for another port; raise PONG_PORTS_MAX");
        }
        PongPort &port = ports[port_count++];
        port.object = object;
        port.model = model;
        port.group = group;
    });
}

int PongContact::add_pair(const std::string &a, const std::string &b) {
    return guarded("add_pair", [&] {
        if (pair_count == PONG_PAIRS_MAX) {
            throw std::runtime_error(a + " and " + b + ": there is no room for another pair; raise PONG_PAIRS_MAX");
        }
        first[pair_count] = a;
        second[pair_count++] = b;
    });
}

/* --- jobs --------------------------------------------------------------------------------------------------------- */

int PongContact::initialize() {
    return guarded("initialize", [&] { build(); });
}

/* Any number of times, at times in any order: the stages of an integrator, and a dynamic event that goes back. */
int PongContact::evaluate() {
    return guarded("evaluate", [&] {
        /* The first stage of a step stands where the last step ended. Its wrench is that of the commit. To evaluate
         * once more would give it again to rounding, but not always to the last bit, because bristles have moved. */
        if (at_committed_states()) {
            for (int i = 0; i < port_count; i++) {
                std::memcpy(ports[i].force, committed_wrench[i], sizeof ports[i].force);
                std::memcpy(ports[i].moment, committed_wrench[i] + 3, sizeof ports[i].moment);
            }
            return;
        }
        send_states();
        owner.world->world.evaluate();
        fetch_wrenches();
    });
}

/* Once per accepted step, in a post_integration job: the only call that changes what Pong remembers. */
int PongContact::commit() {
    return guarded("commit", [&] {
        send_states();
        owner.world->world.commit();
        fetch_wrenches();
        for (int i = 0; i < port_count; i++) {
            copy_state(ports[i], committed_state[i]);
            std::memcpy(committed_wrench[i], ports[i].force, sizeof ports[i].force);
            std::memcpy(committed_wrench[i] + 3, ports[i].moment, sizeof ports[i].moment);
        }
        committed = 1;
        flagged_frames += flags != 0;
    });
}

/* The contact state becomes an array in Trick's memory, so that Trick writes it with everything else. */
int PongContact::checkpoint() {
    return guarded("checkpoint", [&] {
        const std::vector<unsigned char> bytes = owner.world->world.save_contact_state();
        if (contact_state != NULL) {
            TMM_delete_var_a(contact_state);
        }
        contact_state = static_cast<unsigned char *>(TMM_declare_var_1d("unsigned char", int(bytes.size())));
        if (contact_state == NULL) {
            throw std::runtime_error("Trick has no memory for the contact state");
        }
        contact_state_bytes = (unsigned int)bytes.size();
        std::memcpy(contact_state, bytes.data(), bytes.size());
    });
}

/* Trick has read the numbers of the checkpoint. The world is built by the same calls as before, then given its past. */
int PongContact::restart() {
    return guarded("restart", [&] {
        build();
        if (contact_state != NULL) {
            const std::vector<unsigned char> bytes(contact_state, contact_state + contact_state_bytes);
            owner.world->world.restore_contact_state(bytes);
        }
    });
}

int PongContact::freeze() {
    return guarded("freeze", [&] {
        if (owner.world != NULL) {
            owner.world->world.quiesce();
        }
    });
}

int PongContact::unfreeze() {
    return guarded("unfreeze", [&] {
        if (owner.world != NULL) {
            owner.world->world.prewake(UNFREEZE_PREWAKE);
        }
    });
}

int PongContact::shutdown() {
    owner.destroy();
    return 0;
}

/* --- the world ---------------------------------------------------------------------------------------------------- */

void PongContact::build() {
    shutdown();
    pong_config config = pong_default_config();
    config.workers = workers;
    config.pin_workers = workers > 0;
    config.fifo_priority = fifo_priority;
    owner.world = new PongContactWorld(config);

    std::map<std::string, pong_model_id> loaded;
    std::map<std::string, pong_object_id> objects;
    for (int i = 0; i < port_count; i++) {
        const PongPort &port = ports[i];
        if (loaded.count(port.model) == 0) {
            loaded[port.model] = owner.world->world.load_model(models + "/" + port.model);
        }
        if (objects.count(port.object) == 0) {
            objects[port.object] = owner.world->world.create_object(loaded[port.model], port.object);
        }
        owner.world->interfaces.push_back(owner.world->world.interface(objects[port.object], port.group));
    }
    for (int i = 0; i < pair_count; i++) {
        owner.world->world.pair(first[i], second[i]);
    }
    const pong::SealReport sealed = owner.world->world.seal();
    for (size_t i = 0; i < sealed.warning_count; i++) {
        message_publish(MSG_WARNING, "PongContact: %s\n", owner.world->world.seal_warning(i));
    }
    for (size_t i = 1; i <= sealed.workers; i++) {
        message_publish(MSG_INFO, "PongContact: %s\n", owner.world->world.worker_text(i));
    }
    owner.world->states.resize(port_count, pong_default_state());
    owner.world->wrenches.resize(port_count);
}

void PongContact::send_states() {
    if (owner.world == NULL) {
        throw std::runtime_error("there is no world; call initialize() in an initialization job of the S_define, and "
                                 "restart() in a restart job");
    }
    for (int i = 0; i < port_count; i++) {
        const PongPort &port = ports[i];
        pong_state &state = owner.world->states[i];
        std::memcpy(state.position, port.position, sizeof state.position);
        std::memcpy(state.orientation, port.orientation, sizeof state.orientation);
        std::memcpy(state.linear_velocity, port.linear_velocity, sizeof state.linear_velocity);
        std::memcpy(state.angular_velocity, port.angular_velocity, sizeof state.angular_velocity);
    }
    const std::vector<pong_state> &states = owner.world->states;
    owner.world->world.set_states(owner.world->interfaces.data(), states.data(), states.size());
}

void PongContact::fetch_wrenches() {
    std::vector<pong_wrench> &wrenches = owner.world->wrenches;
    owner.world->world.wrenches(owner.world->interfaces.data(), pong::Frame::common, wrenches.data(), wrenches.size());
    for (int i = 0; i < port_count; i++) {
        std::memcpy(ports[i].force, wrenches[i].force, sizeof ports[i].force);
        std::memcpy(ports[i].moment, wrenches[i].moment, sizeof ports[i].moment);
    }
    const pong::Report report = owner.world->world.report();
    contacts = report.contacts;
    flags = report.flags;
}

bool PongContact::at_committed_states() const {
    for (int i = 0; i < port_count && committed; i++) {
        double present[PONG_STATE_NUMBERS];
        copy_state(ports[i], present);
        if (std::memcmp(present, committed_state[i], sizeof present) != 0) {
            return false;
        }
    }
    return committed != 0;
}
