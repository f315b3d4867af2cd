// Pong for C++17: pong.h with owners and exceptions. Thin: every call is one call of pong.h.

#ifndef PONG_CPP_HPP
#define PONG_CPP_HPP

#include "pong.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pong {

/// A call that failed: what() is the message, with the name of the status before it.
class Error : public std::runtime_error {
public:
    explicit Error(pong_status status)
        : std::runtime_error(std::string(pong_status_name(status)) + ": " + pong_last_message()), status_(status) {}

    pong_status status() const noexcept { return status_; }

private:
    pong_status status_;
};

/// Throws unless the call succeeded.
inline void check(pong_status status) {
    if (status != PONG_STATUS_OK) {
        throw Error(status);
    }
}

using ModelId = pong_model_id;
using ObjectId = pong_object_id;
using PairId = pong_pair_id;
using InterfaceId = pong_interface_id;
using Mass = pong_mass;
using Joints = pong_joints;
using StepPlan = pong_step_plan;
using StepCheck = pong_step_check;
using SealReport = pong_seal_report;
using Contact = pong_contact;
using ContactChange = pong_contact_change;
using Distance = pong_distance;
using PairPeaks = pong_pair_peaks;
using SurfaceValues = pong_surface_values;
using SurfaceMore = pong_surface_more;
using SurfaceMotion = pong_surface_motion;
using Continuation = pong_continuation;
using LogOptions = pong_log_options;
using LogReport = pong_log_report;
using Worker = pong_worker;
using Report = pong_report;
using Tally = pong_tally;
using Tangent = pong_tangent;
using ContactTangent = pong_contact_tangent;
using Potential = pong_potential;
using SurfaceSlope = pong_surface_slope;
using SlowSettings = pong_slow_settings;
using SlowInput = pong_slow_input;
using SlowCoupling = pong_slow_coupling;
using SlowReport = pong_slow_report;
using SlowDifference = pong_slow_difference;
using Ledger = pong_ledger;
using EnergyAccount = pong_energy_account;
using PairEnergyAccount = pong_pair_energy_account;
using Vec3 = std::array<double, 3>;

/// State of a movable group; see pong_state for frames and units. Begins at rest at the common origin.
struct State {
    Vec3 position{};
    std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};
    Vec3 linear_velocity{};
    Vec3 angular_velocity{};

    State() = default;
    State(const pong_state& c) {
        copy(c.position, position);
        copy(c.orientation, orientation);
        copy(c.linear_velocity, linear_velocity);
        copy(c.angular_velocity, angular_velocity);
    }

    operator pong_state() const noexcept {
        pong_state c;
        copy(position, c.position);
        copy(orientation, c.orientation);
        copy(linear_velocity, c.linear_velocity);
        copy(angular_velocity, c.angular_velocity);
        return c;
    }

private:
    template <class From, class To>
    static void copy(const From& from, To& to) noexcept {
        for (std::size_t i = 0; i < std::size(from); ++i) {
            to[i] = from[i];
        }
    }
};

/// Wrench on a movable group about its origin.
struct Wrench {
    Vec3 force{};
    Vec3 moment{};

    Wrench() = default;
    Wrench(const pong_wrench& c) noexcept
        : force{c.force[0], c.force[1], c.force[2]}, moment{c.moment[0], c.moment[1], c.moment[2]} {}
};

/// Frame in which a wrench is expressed.
enum class Frame : pong_reference_frame { group = PONG_REFERENCE_FRAME_GROUP, common = PONG_REFERENCE_FRAME_COMMON };

/// Owner of a world. Movable, not copyable; texts that it returns by pointer live as long as it does.
class World {
public:
    explicit World(const pong_config& config = pong_default_config()) {
        check(PONG_CHECK_ABI());
        pong_world* made = nullptr;
        check(pong_create_world(&config, &made));
        world_.reset(made);
    }

    /// Handle for calls that this class does not have.
    pong_world* get() const noexcept { return world_.get(); }

    // Set-up: models, Objects and pairs.

    ModelId load_model(const std::string& path) {
        return result<ModelId>([&](ModelId* out) { return pong_load_model(get(), path.c_str(), out); });
    }
    ModelId load_model_text(const std::string& text, const std::string& name, const char* mesh_dir = nullptr) {
        return result<ModelId>([&](ModelId* out) {
            return pong_load_model_text(get(), text.data(), text.size(), name.c_str(), mesh_dir, out);
        });
    }
    void allow_files_below(const std::string& folder) { check(pong_allow_files_below(get(), folder.c_str())); }
    ObjectId create_object(ModelId model, const std::string& name) {
        return result<ObjectId>([&](ObjectId* out) { return pong_create_object(get(), model, name.c_str(), out); });
    }
    ObjectId object(const std::string& name) const {
        return result<ObjectId>([&](ObjectId* out) { return pong_find_object(get(), name.c_str(), out); });
    }
    const char* name(ObjectId object) const {
        return result<const char*>([&](const char** out) { return pong_object_name(get(), object, out); });
    }
    PairId pair(ObjectId a, ObjectId b) {
        return result<PairId>([&](PairId* out) { return pong_pair_objects(get(), a, b, out); });
    }
    PairId pair(const std::string& a, const std::string& b) {
        return result<PairId>([&](PairId* out) { return pong_pair_by_name(get(), a.c_str(), b.c_str(), out); });
    }
    /// Excludes contacts between two groups, each with everything below it, by path or name; an empty one is the whole Object.
    void filter_groups(ObjectId a, const std::string& group_a, ObjectId b, const std::string& group_b) {
        check(pong_filter_groups(get(), a, group_a.c_str(), b, group_b.c_str()));
    }

    // Set-up: Interfaces and primitives.

    InterfaceId interface(ObjectId object, const std::string& path = "") const {
        return result<InterfaceId>([&](InterfaceId* out) { return pong_find_interface(get(), object, path.c_str(), out); });
    }
    std::vector<InterfaceId> interfaces(ObjectId object) const {
        return list<InterfaceId>([&](InterfaceId* out, std::size_t capacity, std::size_t* count) {
            return pong_list_interfaces(get(), object, out, capacity, count);
        });
    }
    const char* path(InterfaceId interface) const {
        return result<const char*>([&](const char** out) { return pong_interface_path(get(), interface, out); });
    }
    std::uint32_t primitive_count(InterfaceId interface) const {
        return result<std::uint32_t>([&](std::uint32_t* out) { return pong_primitive_count(get(), interface, out); });
    }
    const char* primitive_path(InterfaceId interface, std::uint32_t primitive) const {
        return result<const char*>([&](const char** out) { return pong_primitive_path(get(), interface, primitive, out); });
    }
    std::uint32_t find_primitive(InterfaceId interface, const std::string& path) const {
        return result<std::uint32_t>(
            [&](std::uint32_t* out) { return pong_find_primitive(get(), interface, path.c_str(), out); });
    }

    // Set-up: masses and step.

    /// Sets masses for the check that plan_step() requests; no frame reads them.
    void set_mass(InterfaceId interface, const Mass& mass) { check(pong_set_mass(get(), interface, &mass)); }
    /// Sets the response of a group on joints, after its mass. Start from zeros.
    void set_joints(InterfaceId interface, const Joints& joints) { check(pong_set_joints(get(), interface, &joints)); }
    /// Plans the step: start from pong_default_step_plan() and set the step.
    void plan_step(const StepPlan& plan) { check(pong_plan_step(get(), &plan)); }

    // Set-up: seal.

    SealReport seal() {
        return result<SealReport>([&](SealReport* out) { return pong_seal(get(), out); });
    }
    const char* seal_warning(std::size_t index) const {
        return result<const char*>([&](const char** out) { return pong_seal_warning(get(), index, out); });
    }
    const char* seal_note(std::size_t index) const {
        return result<const char*>([&](const char** out) { return pong_seal_note(get(), index, out); });
    }

    // Frames.

    void set_state(InterfaceId interface, const State& state) {
        const pong_state c = state;
        check(pong_set_state(get(), interface, &c));
    }
    /// All states in one call: `n` ids and as many states of pong.h.
    void set_states(const InterfaceId* interfaces, const pong_state* states, std::size_t n) {
        check(pong_set_states(get(), interfaces, states, n));
    }
    /// Motions of surfaces along themselves in one call: `n` ids and as many motions.
    void set_surface_motions(const InterfaceId* interfaces, const SurfaceMotion* motions, std::size_t n) {
        check(pong_set_surface_motions(get(), interfaces, motions, n));
    }
    SurfaceMotion surface_motion(InterfaceId interface) const {
        return result<SurfaceMotion>([&](SurfaceMotion* out) { return pong_get_surface_motion(get(), interface, out); });
    }
    State authored_state(InterfaceId interface) const {
        return result<pong_state>([&](pong_state* out) { return pong_get_authored_state(get(), interface, out); });
    }
    void evaluate() { check(pong_evaluate(get())); }
    void commit() { check(pong_commit(get())); }
    void commit(const std::vector<PairId>& pairs) { check(pong_commit_pairs(get(), pairs.data(), pairs.size())); }
    void step() { check(pong_step(get())); }

    // Results: wrenches.

    /// All wrenches in one call: `n` ids and room for as many wrenches of pong.h.
    void wrenches(const InterfaceId* interfaces, Frame frame, pong_wrench* out, std::size_t n) const {
        check(pong_get_wrenches(get(), interfaces, static_cast<pong_reference_frame>(frame), out, n));
    }
    Wrench wrench(InterfaceId interface, Frame frame = Frame::group) const {
        return result<pong_wrench>([&](pong_wrench* out) {
            return pong_get_wrench(get(), interface, static_cast<pong_reference_frame>(frame), out);
        });
    }
    /// Wrench on one movable group from its contacts with another alone: pong_get_wrench_from().
    Wrench wrench_from(InterfaceId interface, InterfaceId from, Frame frame = Frame::group) const {
        return result<pong_wrench>([&](pong_wrench* out) {
            return pong_get_wrench_from(get(), interface, from, static_cast<pong_reference_frame>(frame), out);
        });
    }
    /// Wrench on the Object that was named first in a pair from the other, about a movable group of either: pong_get_pair_wrench().
    Wrench pair_wrench(PairId pair, InterfaceId about, Frame frame = Frame::group) const {
        return result<pong_wrench>([&](pong_wrench* out) {
            return pong_get_pair_wrench(get(), pair, about, static_cast<pong_reference_frame>(frame), out);
        });
    }

    // Results: contacts.

    std::size_t contact_count() const {
        return result<std::size_t>([&](std::size_t* out) { return pong_contact_count(get(), out); });
    }
    /// Writes to the caller's memory, with room for `capacity`; returns the number of contacts. Allocates
    /// nothing.
    std::size_t contacts(Contact* out, std::size_t capacity) const {
        return result<std::size_t>([&](std::size_t* count) { return pong_get_contacts(get(), out, capacity, count); });
    }
    /// Writes to a vector that is used again: with SealReport::contact_capacity reserved, it allocates
    /// nothing.
    void contacts(std::vector<Contact>& out) const {
        out.resize(contact_count());
        contacts(out.data(), out.size());
    }
    /// Returns a new vector: allocates.
    std::vector<Contact> contacts() const {
        return list<Contact>([&](Contact* out, std::size_t capacity, std::size_t* count) {
            return pong_get_contacts(get(), out, capacity, count);
        });
    }
    /// Stiffness (N/m) and damping (N s/m) of the contacts of the last frame along their normals, in the order of contacts().
    std::vector<std::pair<double, double>> contact_stiffness() const {
        std::vector<double> stiffness(result<std::size_t>([&](std::size_t* out) { return pong_contact_count(get(), out); }));
        std::vector<double> damping(stiffness.size());
        std::size_t count = 0;
        check(pong_get_contact_stiffness(get(), stiffness.data(), damping.data(), stiffness.size(), &count));
        std::vector<std::pair<double, double>> all(count);
        for (std::size_t i = 0; i < count; ++i) {
            all[i] = {stiffness[i], damping[i]};
        }
        return all;
    }
    /// Stiffness and damping of the contacts of the last frame, in the order of contacts(). Allocates.
    std::vector<ContactTangent> contact_tangents() const {
        return list<ContactTangent>([&](ContactTangent* out, std::size_t capacity, std::size_t* count) {
            return pong_get_contact_tangents(get(), out, capacity, count);
        });
    }
    /// Checks the planned step against the contacts of the last frame: pong_check_step(). Allocates.
    StepCheck check_step() const {
        return result<StepCheck>([&](StepCheck* out) { return pong_check_step(get(), out); });
    }

    // Results: tangents.

    /// Derivatives of the wrenches for every two movable groups that touch: pong_get_tangents(). Between evaluate() and
    /// commit(). Allocates.
    std::vector<Tangent> tangents() const {
        std::vector<Tangent> all(contact_count());
        all.resize(result<std::size_t>(
            [&](std::size_t* count) { return pong_get_tangents(get(), all.data(), all.size(), count); }));
        return all;
    }
    /// As tangents(), by central differences: pong_get_tangents_by_differences(). Allocates.
    std::vector<Tangent> tangents_by_differences() {
        std::vector<Tangent> all(contact_count());
        all.resize(result<std::size_t>([&](std::size_t* count) {
            return pong_get_tangents_by_differences(get(), all.data(), all.size(), count);
        }));
        return all;
    }

    /// As tangents() where the closed form is known, and by differences elsewhere: pong_get_complete_tangents(). Allocates.
    std::vector<Tangent> complete_tangents() {
        std::vector<Tangent> all(contact_count());
        all.resize(result<std::size_t>(
            [&](std::size_t* count) { return pong_get_complete_tangents(get(), all.data(), all.size(), count); }));
        return all;
    }
    /// Energies of a step of length `step` as functions of its end: pong_get_incremental_potentials(). Between evaluate() and
    /// commit(). Allocates.
    std::vector<Potential> incremental_potentials(double step) const {
        std::vector<Potential> all(contact_count());
        all.resize(result<std::size_t>([&](std::size_t* count) {
            return pong_get_incremental_potentials(get(), step, all.data(), all.size(), count);
        }));
        return all;
    }
    /// Derivatives of the wrenches by a number of a surface: pong_get_surface_slopes(). Between evaluate() and commit().
    /// Allocates.
    std::vector<SurfaceSlope> surface_slopes(ModelId model, const std::string& surface, const std::string& number) {
        std::vector<SurfaceSlope> all(contact_count());
        all.resize(result<std::size_t>([&](std::size_t* count) {
            return pong_get_surface_slopes(
                get(), model, surface.c_str(), number.c_str(), all.data(), all.size(), count);
        }));
        return all;
    }

    // Results: distance.

    /// Distance of two movable groups, with their nearest primitives: pong_get_distance().
    Distance distance(InterfaceId a, InterfaceId b) const {
        return result<pong_distance>([&](pong_distance* out) { return pong_get_distance(get(), a, b, out); });
    }

    // Results: begin, end and peaks of contact.

    /// Starts the pair monitor, or begins it anew: pong_start_pair_monitor(). Allocates.
    void start_pair_monitor() { check(pong_start_pair_monitor(get())); }
    /// Observes the frame last committed, once after each commit; `step` is the time since the commit before, s.
    void observe_pairs(double step) { check(pong_observe_pairs(get(), step)); }
    /// Begins and ends of contact in the frame observed last. Allocates.
    std::vector<ContactChange> contact_changes() const {
        return list<ContactChange>([&](ContactChange* out, std::size_t capacity, std::size_t* count) {
            return pong_get_contact_changes(get(), out, capacity, count);
        });
    }
    void begin_peak_window() { check(pong_begin_peak_window(get())); }
    /// Peaks and means of the window. Allocates.
    std::vector<PairPeaks> pair_peaks() const {
        return list<PairPeaks>([&](PairPeaks* out, std::size_t capacity, std::size_t* count) {
            return pong_get_pair_peaks(get(), out, capacity, count);
        });
    }

    // Contact state.

    /// Present size of the contact state, bytes.
    std::size_t contact_state_used() const {
        return result<std::size_t>([&](std::size_t* out) { return pong_contact_state_used(get(), out); });
    }
    /// Writes to the caller's memory of `size` bytes, at least contact_state_used(). Allocates nothing.
    void save_contact_state(unsigned char* out, std::size_t size) const {
        check(pong_save_contact_state(get(), out, size));
    }
    /// Writes to a vector that is used again: with SealReport::contact_state_size reserved, it allocates
    /// nothing.
    void save_contact_state(std::vector<unsigned char>& out) const {
        out.resize(contact_state_used());
        save_contact_state(out.data(), out.size());
    }
    /// Returns a new vector: allocates.
    std::vector<unsigned char> save_contact_state() const {
        std::vector<unsigned char> bytes;
        save_contact_state(bytes);
        return bytes;
    }
    void restore_contact_state(const unsigned char* bytes, std::size_t size) {
        check(pong_restore_contact_state(get(), bytes, size));
    }
    void restore_contact_state(const std::vector<unsigned char>& bytes) {
        restore_contact_state(bytes.data(), bytes.size());
    }
    /// Preloads friction as after a long slide: pong_preload_friction(). Returns the number of bristles that were set.
    std::size_t preload_sliding(PairId pair) {
        return result<std::size_t>([&](std::size_t* out) { return pong_preload_friction(get(), pair, nullptr, out); });
    }
    /// Preloads friction that holds a force on the Object named first, N, along the common axes.
    std::size_t preload_holding(PairId pair, const Vec3& force) {
        return result<std::size_t>([&](std::size_t* out) { return pong_preload_friction(get(), pair, force.data(), out); });
    }
    void clear_contact_history(ObjectId object) { check(pong_clear_contact_history(get(), object)); }

    // Changes between frames.

    void set_pair_enabled(PairId pair, bool enabled) { check(pong_set_pair_enabled(get(), pair, enabled ? 1 : 0)); }
    SurfaceValues surface(ModelId model, const std::string& name) const {
        return result<SurfaceValues>(
            [&](SurfaceValues* out) { return pong_get_surface(get(), model, name.c_str(), out); });
    }
    void set_surface(ModelId model, const std::string& name, const SurfaceValues& values) {
        check(pong_set_surface(get(), model, name.c_str(), &values));
    }
    SurfaceMore surface_more(ModelId model, const std::string& name) const {
        return result<SurfaceMore>(
            [&](SurfaceMore* out) { return pong_get_surface_more(get(), model, name.c_str(), out); });
    }
    void set_surface_more(ModelId model, const std::string& name, const SurfaceMore& values) {
        check(pong_set_surface_more(get(), model, name.c_str(), &values));
    }

    // Further worlds.

    /// Clones this sealed world as it stands; both are independent from here on. See pong_clone_world().
    World clone() const {
        World made(nullptr);
        pong_world* world = nullptr;
        check(pong_clone_world(get(), &world));
        made.world_.reset(world);
        return made;
    }
    /// Returns a world in set-up with everything that this sealed one was made of, with the same ids: add what arrives, seal it,
    /// and call continue_from(). See pong_extend_world().
    World extended() const {
        World made(nullptr);
        pong_world* world = nullptr;
        check(pong_extend_world(get(), &world));
        made.world_.reset(world);
        return made;
    }
    /// Continues the run of another world: the contacts of Objects that both have go on. See pong_continue_from().
    Continuation continue_from(const World& other) {
        return result<Continuation>([&](Continuation* out) { return pong_continue_from(get(), other.get(), out); });
    }

    // Response logs.

    void start_log(const std::string& folder, const LogOptions& options = pong_default_log_options()) {
        check(pong_start_log(get(), folder.c_str(), &options));
    }
    /// Logs a frame; call it after the commit and before states change. `time` in s.
    void log_frame(double time) { check(pong_log_frame(get(), time)); }
    LogReport log_report() const {
        return result<LogReport>([&](LogReport* out) { return pong_get_log_report(get(), out); });
    }
    LogReport stop_log() {
        return result<LogReport>([&](LogReport* out) { return pong_stop_log(get(), out); });
    }

    // Own force laws.

    void register_normal_law(const char* name, pong_normal_law force, pong_normal_law stored, void* user) {
        check(pong_register_normal_law(get(), name, force, stored, user));
    }
    void register_friction_law(const char* name, std::size_t numbers, pong_friction_law law, void* user) {
        check(pong_register_friction_law(get(), name, numbers, law, user));
    }

    // User data: numbers of the host's that the engine never reads.

    void set_user_data(ObjectId object, std::uint64_t data) { check(pong_set_object_user_data(get(), object, data)); }
    void set_user_data(InterfaceId interface, std::uint32_t primitive, std::uint64_t data) {
        check(pong_set_primitive_user_data(get(), interface, primitive, data));
    }
    std::uint64_t user_data(ObjectId object) const {
        return result<std::uint64_t>([&](std::uint64_t* out) { return pong_get_object_user_data(get(), object, out); });
    }
    std::uint64_t user_data(InterfaceId interface, std::uint32_t primitive) const {
        return result<std::uint64_t>(
            [&](std::uint64_t* out) { return pong_get_primitive_user_data(get(), interface, primitive, out); });
    }

    // Workers.

    void prewake(std::chrono::microseconds at_most) {
        check(pong_prewake(get(), at_most.count() < 0 ? 0 : static_cast<std::uint64_t>(at_most.count())));
    }
    void quiesce() { check(pong_quiesce(get())); }
    std::size_t worker_count() const {
        return result<std::size_t>([&](std::size_t* out) { return pong_worker_count(get(), out); });
    }
    /// Index 0 is the calling thread, 1 to worker_count() are the workers.
    Worker worker(std::size_t index) const {
        return result<Worker>([&](Worker* out) { return pong_get_worker(get(), index, out); });
    }
    const char* worker_text(std::size_t index) const {
        return result<const char*>([&](const char** out) { return pong_worker_text(get(), index, out); });
    }

    // Diagnostics: report.

    Report report() const {
        return result<Report>([&](Report* out) { return pong_get_report(get(), out); });
    }
    std::vector<Tally> tallies() const {
        std::vector<Tally> all(result<std::size_t>([&](std::size_t* out) { return pong_tally_count(get(), out); }));
        for (std::size_t i = 0; i < all.size(); ++i) {
            check(pong_get_tally(get(), i, &all[i]));
        }
        return all;
    }

    // Diagnostics: energies.

    Ledger ledger() const {
        return result<Ledger>([&](Ledger* out) { return pong_get_ledger(get(), out); });
    }
    /// Accounts of all contacts together; zero unless the configuration has energy_accounts.
    EnergyAccount energy_account() const {
        return result<EnergyAccount>([&](EnergyAccount* out) { return pong_get_energy_account(get(), out); });
    }
    /// Accounts of all pairs of movable groups.
    std::vector<PairEnergyAccount> pair_energy_accounts() const {
        std::vector<PairEnergyAccount> all(
            result<std::size_t>([&](std::size_t* out) { return pong_pair_energy_account_count(get(), out); }));
        for (std::size_t i = 0; i < all.size(); ++i) {
            check(pong_get_pair_energy_account(get(), i, &all[i]));
        }
        return all;
    }
    /// Remedy for a pair (an index in pair_energy_accounts()) that gains energy.
    std::string pair_remedy(std::size_t pair) const {
        return result<const char*>([&](const char** out) { return pong_pair_remedy(get(), pair, out); });
    }
    /// Accounts of the contacts of the last frame, in the order of contacts().
    std::vector<EnergyAccount> contact_energy_accounts() const {
        return list<EnergyAccount>([&](EnergyAccount* out, std::size_t capacity, std::size_t* count) {
            return pong_get_contact_energy_accounts(get(), out, capacity, count);
        });
    }

private:
    explicit World(std::nullptr_t) noexcept {}

    struct Destroy {
        void operator()(pong_world* world) const noexcept { pong_destroy_world(world); }
    };

    template <class T, class Call>
    static T result(Call&& call) {
        T out{};
        check(std::forward<Call>(call)(&out));
        return out;
    }

    template <class T, class Call>
    static std::vector<T> list(Call&& call) {
        std::size_t count = 0;
        const pong_status status = call(nullptr, 0, &count);
        if (status != PONG_STATUS_BUFFER_TOO_SMALL) {
            check(status);
        }
        std::vector<T> all(count);
        check(call(all.data(), all.size(), &count));
        return all;
    }

    std::unique_ptr<pong_world, Destroy> world_;
};

/// Owner of a slow host: contact for a host that calls once in a long frame. See pong_create_slow_host().
class SlowHost {
public:
    explicit SlowHost(const World& world, const SlowSettings& settings = pong_default_slow_settings()) {
        pong_slow_host* made = nullptr;
        check(pong_create_slow_host(world.get(), &settings, &made));
        host_.reset(made);
    }

    /// Handle for calls that this class does not have.
    pong_slow_host* get() const noexcept { return host_.get(); }

    /// Couplings of jointed groups for the frames evaluated from now on, in place of those before.
    void set_couplings(const std::vector<SlowCoupling>& couplings) {
        check(pong_set_slow_couplings(get(), couplings.data(), couplings.size()));
    }
    /// Computes the wrenches to hold over a frame of `length`, s; `inputs` of every movable group.
    void evaluate(double length, const std::vector<SlowInput>& inputs) {
        check(pong_evaluate_slow(get(), length, inputs.data(), inputs.size()));
    }
    void commit() { check(pong_commit_slow(get())); }
    /// evaluate() and commit().
    void step(double length, const std::vector<SlowInput>& inputs) {
        check(pong_step_slow(get(), length, inputs.data(), inputs.size()));
    }
    /// Wrench to hold over the last frame: along common axes for a free body, along the group's for a jointed one.
    Wrench wrench(InterfaceId interface, Frame frame) const {
        pong_wrench out;
        check(pong_get_slow_wrenches(get(), &interface, static_cast<pong_reference_frame>(frame), &out, 1));
        return out;
    }
    SlowReport report() const {
        SlowReport out;
        check(pong_get_slow_report(get(), &out));
        return out;
    }
    /// Differences of the host from the prediction, for each movable group. Allocates.
    std::vector<SlowDifference> differences() const {
        std::vector<SlowDifference> all(report().groups);
        std::size_t count = 0;
        check(pong_get_slow_differences(get(), all.data(), all.size(), &count));
        return all;
    }
    /// All that is kept between frames, as bytes. Allocates.
    std::vector<unsigned char> save() const {
        std::size_t size = 0;
        check(pong_slow_state_size(get(), &size));
        std::vector<unsigned char> state(size);
        check(pong_save_slow_state(get(), state.data(), state.size(), &size));
        state.resize(size);
        return state;
    }
    void restore(const std::vector<unsigned char>& state) {
        check(pong_restore_slow_state(get(), state.data(), state.size()));
    }

private:
    struct Destroy {
        void operator()(pong_slow_host* host) const noexcept { pong_destroy_slow_host(host); }
    };

    std::unique_ptr<pong_slow_host, Destroy> host_;
};

} // namespace pong

#endif
