// Pong: contact dynamics, states in, wrenches out.
//
// Generated from crates/pong-capi by ci/header; do not edit. Calling order, ownership and threads: README.md
// beside this file. C99 and C++11 or later.
//
// Units: SI (m, kg, s, N, J, rad) unless a comment says otherwise.
//
// Frames: states are relative to the common frame, which the host chooses; paired Objects share it. `..._group` and
// `..._b` quantities are along the axes of a movable group. In a contact the normal points from B to A, and forces are
// those on A.
//
// Truth values are int32_t, in settings uint32_t: 0 for no, 1 for yes. As input, any other number is
// PONG_STATUS_BAD_VALUE.
//
// Errors: a call that returns a pong_status changes nothing that a later frame can see if it fails. Any of them may
// return PONG_STATUS_NULL_ARGUMENT, PONG_STATUS_PANIC and, with a world, PONG_STATUS_BUSY; with an id or an index
// PONG_STATUS_UNKNOWN_ID; with a name PONG_STATUS_UNKNOWN_NAME; with a number or text that cannot be
// PONG_STATUS_BAD_VALUE. The comment of a function names the other ones. "Before sealing" and "after sealing" mean
// PONG_STATUS_WRONG_PHASE otherwise.

#ifndef PONG_H
#define PONG_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Status and messages --------------------------------------------------------------------------------- */

/// Outcome of a call. The numbers never change and are never used again for something else.
///
/// A call that fails has changed nothing that a later frame can see; pong_last_message() names the thing, the
/// cause and the remedy.
enum pong_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Done.
    PONG_STATUS_OK = 0,
    /// A pointer that must not be NULL is.
    PONG_STATUS_NULL_ARGUMENT = 1,
    /// An id is zero, stale, or of another world.
    PONG_STATUS_UNKNOWN_ID = 2,
    /// Nothing has this name; the message lists the names there are.
    PONG_STATUS_UNKNOWN_NAME = 3,
    /// The name or the pair is already there.
    PONG_STATUS_DUPLICATE = 4,
    /// The call is not allowed before (or after) sealing, or before a frame.
    PONG_STATUS_WRONG_PHASE = 5,
    /// The scene cannot be sealed; the message lists every reason.
    PONG_STATUS_SEAL_FAILED = 6,
    /// A state is not finite or its quaternion is not of unit length, or a frame's forces or energies are beyond what a
    /// number holds and the frame does not count; the message names the interface.
    PONG_STATUS_BAD_STATE = 7,
    /// A paired movable group has no state yet; the message names the interface.
    PONG_STATUS_UNSET_STATE = 8,
    /// A value that this argument cannot have.
    PONG_STATUS_BAD_VALUE = 9,
    /// The bytes are not a contact state of this world.
    PONG_STATUS_BAD_STATE_BLOCK = 10,
    /// The caller's buffer is too small; the message has the required size.
    PONG_STATUS_BUFFER_TOO_SMALL = 11,
    /// The model has faults; the message has one line for each.
    PONG_STATUS_MODEL_ERROR = 12,
    /// The configuration was not made by pong_default_config(), or header and library differ.
    PONG_STATUS_CONFIG = 13,
    /// A fault inside the library. The world refuses every further call but pong_destroy_world().
    PONG_STATUS_PANIC = 14,
    /// Another call on this world is running: in another thread, or the one that called this law. Nothing was done.
    PONG_STATUS_BUSY = 15,
    /// A law given by callback returned a number that is not finite; the message names the law. The frame does
    /// not count: it is not committed.
    PONG_STATUS_LAW_FAILED = 16,
    /// A response log cannot be written; the message names file and cause.
    PONG_STATUS_LOG_FAILED = 17,
    /// The world is destroyed, but a worker had not ended after a second because the system does not run it.
    /// It ends by itself; until then `user` pointers of laws must live, and the library must not be unloaded.
    PONG_STATUS_WORKER_LEFT = 18,
    /// The system does not give the memory that set-up asks for; the message has its size.
    PONG_STATUS_OUT_OF_MEMORY = 19,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum pong_status pong_status;
#else
typedef int32_t pong_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// Name of a status number as this header spells it; "unknown status" for a number that is none. Lives as long
/// as the library.
const char *pong_status_name(int32_t status);

/// Message of the last call of this thread: empty after a success, never NULL. Valid until this thread's next
/// call; calls of other threads do not touch it. This call and pong_status_name() leave it as it is.
const char *pong_last_message(void);

/* ---- Version --------------------------------------------------------------------------------------------- */

/// Hash of every layout in this header; see PONG_CHECK_ABI().
#define PONG_LAYOUT_HASH 0xa8150a848c11cca7ULL

/// Checks that this header fits the library: call it first.
#define PONG_CHECK_ABI() pong_check_abi(PONG_ABI_VERSION, PONG_LAYOUT_HASH)

/// Number of the binary interface: the N of libpong.so.N.
#define PONG_ABI_VERSION 1

/// Version of the library, "major.minor.patch". Lives as long as the library.
const char *pong_version_string(void);

/// PONG_ABI_VERSION of the library; compare it with that of your header, or use PONG_CHECK_ABI().
uint32_t pong_abi_version(void);

/// Hash of the layout of every struct and of every status number in the library; compare it with
/// PONG_LAYOUT_HASH of the header.
uint64_t pong_layout_hash(void);

/// Checks that header and library fit: call it first, as PONG_CHECK_ABI(). PONG_STATUS_CONFIG if they do not.
/// A header of an earlier release of the same ABI fits.
pong_status pong_check_abi(uint32_t abi_version, uint64_t hash);

/* ---- Set-up: world --------------------------------------------------------------------------------------- */

/// A contact world: models, Objects, pairs and contact state. Opaque.
///
/// Any thread may call it, one at a time; a second call meanwhile returns PONG_STATUS_BUSY. Different worlds
/// are independent.
typedef struct pong_world pong_world;

/// Use of the wrench by the host: PONG_COUPLING_...
typedef uint32_t pong_coupling;

/// The host evaluates the wrench again at every stage of an integrator of higher order (the classic Runge-Kutta
/// method).
#define PONG_COUPLING_STAGES 1
/// The host evaluates the wrench once a step; it gives the velocities with which the bodies then move
/// (semi-implicit Euler).
#define PONG_COUPLING_SEMI_IMPLICIT 2
/// The host evaluates the wrench once a frame and holds it from one commit to the next.
#define PONG_COUPLING_ZERO_ORDER_HOLD 3

/// Settings of a world. Make it with pong_default_config(), change what you like, pass it to
/// pong_create_world().
typedef struct pong_config {
    /// Set by pong_default_config(): size of this struct, bytes.
    uint32_t struct_size;
    /// Set by pong_default_config(): PONG_ABI_VERSION of the library.
    uint32_t abi_version;
    /// Set by pong_default_config(): checked by pong_create_world().
    uint64_t cookie;
    /// Most contacts of a frame; 0 takes an estimate from the scene, at least 256 and at most 65536: the contacts of
    /// all pairs of movable groups, or, if that is less, those of the 16 pairs of each group that have the most. When a
    /// frame has more, the deepest are kept and the report has PONG_FLAG_CONTACT_LIMIT.
    uint64_t contact_capacity;
    /// 1: keeps energies for pong_get_ledger(). 0 (default): does not, and costs nothing.
    uint32_t keep_ledger;
    /// 1: times the stages of a frame and the workers by CLOCK_MONOTONIC, for pong_get_report() and
    /// pong_get_worker(). 0 (default): reads no clock in them.
    uint32_t report_times;
    /// Threads that share a frame's work with the calling one, at most 64; 0 (default) for the calling thread alone.
    /// The results are the same bits for any number. There will be no more than there are cores beside the caller's
    /// in the affinity mask of the thread that seals the world; see `oversubscribe`.
    uint32_t workers;
    /// 1: starts all `workers`, even if there are fewer cores. 0 (default): at most one for each core.
    uint32_t oversubscribe;
    /// Time for which a worker looks for work before it sleeps, us; 50 by default, at most 1000000. Waking a sleeping
    /// one takes tens of us; see pong_prewake().
    uint32_t spin_us;
    /// Time for which the calling thread waits for a worker that does not finish its part of the frame, us; then it
    /// does that work again itself. 1000 by default, 1 to 1000000.
    uint32_t worker_timeout_us;
    /// 1: binds each worker to a core of its own; outcome: pong_get_worker(). 0 (default): binds none. The
    /// calling thread stays as it is: bind it to the first core of its mask, which the workers leave free.
    uint32_t pin_workers;
    /// SCHED_FIFO priority of the workers, 1 to 99; 0 (default) requests none. Outcome: pong_get_worker().
    uint32_t fifo_priority;
    /// With pin_workers: the cores of the workers, bit n for core n, the lowest for the first worker. They may be
    /// outside the affinity mask, and their number is the limit of the workers. 0 (default) for the cores of the
    /// affinity mask after the first.
    uint64_t worker_cores;
    /// PONG_COUPLING_...: keeps energy accounts of contacts and pairs, see pong_get_pair_energy_account().
    /// The coupling is the host's use of wrenches, on which their work depends. Keeps the ledger as well. 0
    /// (default) keeps no accounts and costs nothing.
    pong_coupling energy_accounts;
    /// With PONG_COUPLING_ZERO_ORDER_HOLD: delay of the wrenches in whole frames after the first possible
    /// one, at most 16; 0 by default.
    uint32_t delay_frames;
    /// Zero.
    uint64_t reserved[7];
} pong_config;

/// The default settings: no workers, no energies, capacities by the scene.
struct pong_config pong_default_config(void);

/// Creates a world. It is the caller's: destroy it with pong_destroy_world(). On failure `world` gets NULL. The first call
/// of a process reads the environment variable PONG_SIMD (docs/c_api.md).
pong_status pong_create_world(const struct pong_config *config,
                              struct pong_world **world);

/// Destroys a world and everything it gave out: ids become stale; names, warnings and notes must not be read
/// any more. NULL is allowed and does nothing. No other call on the world may follow. PONG_STATUS_BUSY: a
/// call on it is running, or this is called from inside one of its laws; the world is as it was.
/// PONG_STATUS_WORKER_LEFT: it is destroyed, but a worker that the system does not run was left behind after
/// a second. Closes a log that is running.
pong_status pong_destroy_world(struct pong_world *world);

/* ---- Set-up: models, Objects and pairs ------------------------------------------------------------------- */

/// A model of a world; zero is none. Ids are plain numbers: copy, compare and store them freely. An id of
/// another world, or of a destroyed one, is recognised and refused.
typedef struct pong_model_id {
    /// Set by the library.
    uint64_t bits;
} pong_model_id;

/// An Object: an instance of a model; zero is none.
typedef struct pong_object_id {
    /// Set by the library.
    uint64_t bits;
} pong_object_id;

/// Two Objects that are tested against each other; zero is none.
typedef struct pong_pair_id {
    /// Set by the library.
    uint64_t bits;
} pong_pair_id;

/// An Interface: state in and wrench out of one movable group of one Object; zero is none.
typedef struct pong_interface_id {
    /// Set by the library.
    uint64_t bits;
} pong_interface_id;

/// Loads a model file (UTF-8 path); meshes are looked for beside it. One model serves any number of Objects.
/// Before sealing. PONG_STATUS_MODEL_ERROR: the message has one line for every fault, with file, line and
/// column. PONG_STATUS_OUT_OF_MEMORY, of this and every other call of set-up: the message has the size that
/// was asked for.
pong_status pong_load_model(struct pong_world *world, const char *path, struct pong_model_id *model);

/// Loads a model from `length` bytes of UTF-8 text; it needs no zero byte at its end. Errors call it `name`.
/// Meshes in files of their own are looked for in `mesh_dir`; with NULL they are refused. Otherwise as
/// pong_load_model().
pong_status pong_load_model_text(struct pong_world *world,
                                 const char *text,
                                 size_t length,
                                 const char *name,
                                 const char *mesh_dir,
                                 struct pong_model_id *model);

/// Loads `count` model files that never move relative to each other as one model, as `pong join` does: the root of
/// each becomes a group of the new root, and with `one_surface` other than 0 flush faces of the root's rigid body are one
/// surface. `poses` has the place of each root in the frame of the new one: the position in m, and the quaternion
/// (w, x, y, z). NULL leaves all roots in one place. A file may be named several times. Errors call the new model
/// `name`. Before sealing. PONG_STATUS_MODEL_ERROR: a file has faults, or they cannot be joined.
/// PONG_STATUS_BAD_VALUE: a number is not finite, or a quaternion has not the length 1 within 1e-3.
pong_status pong_load_joined_models(struct pong_world *world,
                                    const char *const *paths,
                                    const double (*poses)[7],
                                    size_t count,
                                    const char *name,
                                    int32_t one_surface,
                                    struct pong_model_id *model);

/// Lets models loaded from now on also read meshes from `folder` (UTF-8 path) and the folders below it. Without
/// it a mesh that lies outside the model's own folder, through a link, is refused. Before sealing; may be
/// called for several folders.
pong_status pong_allow_files_below(struct pong_world *world,
                                   const char *folder);

/// Number of warnings that loading a model gave: a valid model may still have something that its author should
/// know.
pong_status pong_model_warning_count(const struct pong_world *world,
                                     struct pong_model_id model,
                                     size_t *count);

/// Returns a warning of a model; `index` counts from 0. The text lives as long as the world.
pong_status pong_model_warning(const struct pong_world *world,
                               struct pong_model_id model,
                               size_t index,
                               const char **warning);

/// Creates an Object from a model, under a name of its own. Objects of one model are independent. Before
/// sealing. PONG_STATUS_DUPLICATE: the name is taken.
pong_status pong_create_object(struct pong_world *world,
                               struct pong_model_id model,
                               const char *name,
                               struct pong_object_id *object);

/// Finds the Object with this name.
pong_status pong_find_object(const struct pong_world *world, const char *name, struct pong_object_id *object);

/// Returns the name of an Object. The text lives as long as the world.
pong_status pong_object_name(const struct pong_world *world, struct pong_object_id object, const char **name);

/// Declares that two Objects may touch. The movable groups of an Object that is paired with itself are tested
/// against each other. Before sealing. `pair` may be NULL. PONG_STATUS_DUPLICATE: they are a pair already.
pong_status pong_pair_objects(struct pong_world *world,
                              struct pong_object_id a,
                              struct pong_object_id b,
                              struct pong_pair_id *pair);

/// As pong_pair_objects(), by the names of the Objects.
pong_status pong_pair_by_name(struct pong_world *world,
                              const char *a,
                              const char *b,
                              struct pong_pair_id *pair);

/// Excludes contacts between two groups, each with everything below it, at no cost in a frame. The groups may
/// be movable or not, and belong to two Objects or to one (`a` and `b` alike). A group is named by its path
/// in the model (`root/arm/tip`), its path below the root (`arm/tip`) or its bare name where only one group
/// has it; an empty path is the whole Object. Before sealing; the Objects may be paired before or later.
pong_status pong_filter_groups(struct pong_world *world,
                               struct pong_object_id a,
                               const char *group_a,
                               struct pong_object_id b,
                               const char *group_b);

/* ---- Set-up: Interfaces and primitives ------------------------------------------------------------------- */

/// Finds the Interface of a movable group: by its path in the model, "root/arm/latch"; by its bare name where
/// only one movable group of the model has it; "" for the root.
pong_status pong_find_interface(const struct pong_world *world,
                                struct pong_object_id object,
                                const char *path,
                                struct pong_interface_id *interface);

/// Lists all Interfaces of an Object, the root's first: copies the first `capacity`; `count` gets their number.
/// PONG_STATUS_BUFFER_TOO_SMALL if not all fit. With capacity 0 `interfaces` may be NULL.
pong_status pong_list_interfaces(const struct pong_world *world,
                                 struct pong_object_id object,
                                 struct pong_interface_id *interfaces,
                                 size_t capacity,
                                 size_t *count);

/// Returns the path of an Interface's movable group in its model. The text lives as long as the world.
pong_status pong_interface_path(const struct pong_world *world,
                                struct pong_interface_id interface,
                                const char **path);

/// Returns the Object that an Interface belongs to.
pong_status pong_interface_object(const struct pong_world *world,
                                  struct pong_interface_id interface,
                                  struct pong_object_id *object);

/// Number of primitives of a movable group; a mesh is one.
pong_status pong_primitive_count(const struct pong_world *world,
                                 struct pong_interface_id interface,
                                 uint32_t *count);

/// Returns the path of a primitive in its model. The text lives as long as the world.
pong_status pong_primitive_path(const struct pong_world *world,
                                struct pong_interface_id interface,
                                uint32_t primitive,
                                const char **path);

/// Finds the index of the primitive with this path in its model.
pong_status pong_find_primitive(const struct pong_world *world,
                                struct pong_interface_id interface,
                                const char *path,
                                uint32_t *primitive);

/* ---- Set-up: masses and step ----------------------------------------------------------------------------- */
/* Optional: checks whether the host's step is short enough. No frame reads masses or plan. */

/// Mass properties of a movable group, for the step adviser and for slow hosts: no frame of a world reads them.
typedef struct pong_mass {
    /// Mass, kg; for the step adviser INFINITY if the group does not yield (fixed, or on a prescribed path).
    double mass;
    /// Inertia about the mass centre along the axes of the group frame, kg m^2: Ixx, Iyy, Izz, Ixy, Ixz, Iyz,
    /// the products as elements of the tensor itself (Ixy = minus the integral of x y dm). All zero, for
    /// the step adviser alone, if it is not known: lever arms are then left out.
    double inertia[6];
    /// The mass centre in the group frame, m.
    double mass_center[3];
} pong_mass;

/// Response of a movable group on joints to a wrench at one pose of its mechanism, for the step adviser
/// alone. Make it with zeros and set what is known.
typedef struct pong_joints {
    /// Acceleration (linear of the group's origin, then angular) per wrench (force, then moment about the origin), by rows,
    /// along the axes of the group frame: J M^-1 J^T of a mechanism with the mass matrix M.
    double inverse_inertia[36];
    /// Upper bound of the largest eigenvalue of M^-1 K of the host's springs on the mechanism, 1/s^2; 0
    /// without springs.
    double spring_rate;
    /// Upper bound of the largest eigenvalue of M^-1 C of the host's dampers on the mechanism, 1/s; 0 without
    /// dampers.
    double damper_rate;
    /// Groups with the same number share joints: a push on one moves the others.
    uint32_t mechanism;
    /// Zero.
    uint32_t reserved;
} pong_joints;

/// The host's step and its use of the wrench. Make it with pong_default_step_plan() and change what you like.
typedef struct pong_step_plan {
    /// The step or frame, s; must be set.
    double step;
    /// Use of the wrench: one of PONG_COUPLING_...; PONG_COUPLING_ZERO_ORDER_HOLD by default.
    pong_coupling wrench_coupling;
    /// With PONG_COUPLING_ZERO_ORDER_HOLD: delay of the wrench in whole frames after the first possible one,
    /// at most 100; 0 by default.
    uint32_t delay_frames;
    /// Speed at which things touch, m/s; 0 (default) if it is not known. Laws whose stiffness or damping follows the
    /// depth are judged at the depth that this speed makes.
    double closing_speed;
    /// Largest relative error of the depth of a bounce against its closed form; 0.05 by default. 0 in both
    /// accuracies: warn only of contacts that gain energy.
    double depth_within;
    /// Largest relative error of the rebound of a bounce against its closed form; 0.02 by default.
    double rebound_within;
    /// Zero.
    uint64_t reserved[4];
} pong_step_plan;

/// Stability of the contacts of one frame at the planned step.
typedef struct pong_step_check {
    /// Contacts with at least one movable body that yields.
    uint64_t contacts;
    /// Contacts whose masses or laws are not known.
    uint64_t not_judged;
    /// The longest step at which they are surely stable together, s; 0 if there is none, infinite if nothing acts.
    double stable_step;
    /// Stiffness over mass of the stiffest mode, 1/s^2: the square of its frequency in rad/s.
    double stiffness_rate;
    /// Damping over mass of the most damped mode, 1/s.
    double damping_rate;
} pong_step_check;

/// The default plan: held wrenches, depth within 5 % and rebound within 2 %. Its step is 0 and must be set.
struct pong_step_plan pong_default_step_plan(void);

/// Sets the mass properties of a movable group, for the check that pong_plan_step() requests. Before sealing. A
/// hinged body gets its own mass and inertia, as if it were free; that is on the safe side, and
/// pong_set_joints() gives a sharp limit.
pong_status pong_set_mass(struct pong_world *world,
                          struct pong_interface_id interface,
                          const struct pong_mass *mass);

/// Sets the response of a movable group on joints, in addition to its mass of pong_set_mass(), which must be
/// set first. Before sealing for the check of pong_plan_step(), and as often as the pose changes for
/// pong_check_step().
pong_status pong_set_joints(struct pong_world *world,
                            struct pong_interface_id interface,
                            const struct pong_joints *joints);

/// Makes the seal check every contact against the host's step, by the masses of pong_set_mass(). Contacts for
/// which the step is too long, or which cannot be judged, appear in pong_seal_warning(); those for which it may
/// be too long, if enough contacts act at once, in pong_seal_note(). Before sealing.
pong_status pong_plan_step(struct pong_world *world,
                           const struct pong_step_plan *plan);

/* ---- Set-up: seal ---------------------------------------------------------------------------------------- */

/// Result of sealing.
typedef struct pong_seal_report {
    /// Pairs of movable groups that will be tested.
    uint64_t group_pairs;
    /// Most contacts of a frame.
    uint64_t contact_capacity;
    /// Size of the largest contact state that can be saved, bytes.
    uint64_t contact_state_size;
    /// Number of warnings: see pong_seal_warning().
    uint64_t warning_count;
    /// Workers that were started, which may be fewer than the configuration asks for: see pong_get_worker().
    uint64_t workers;
    /// Number of notes: see pong_seal_note().
    uint64_t note_count;
    /// The longest step at which no contact by itself gains energy, s; infinite if nothing that yields can be touched, 0
    /// if no step is stable or none was planned (pong_plan_step()).
    double stable_step;
    /// The step up to which the scene is surely stable for any set of simultaneous contacts, s; infinite or 0
    /// as above.
    double surely_stable_step;
    /// Zero in this version.
    uint64_t reserved[4];
} pong_seal_report;

/// Ends set-up: checks that everything that may meet can be tested and combined, sizes and takes all memory of
/// the frames, and starts the workers. `report` may be NULL. PONG_STATUS_SEAL_FAILED,
/// PONG_STATUS_OUT_OF_MEMORY: the world is still in set-up, and the message lists every reason.
pong_status pong_seal(struct pong_world *world,
                      struct pong_seal_report *report);

/// Returns a warning of the seal: a probable mistake in the set-up, or a contact that gains energy at the
/// planned step. `index` counts from 0. The text lives as long as the world.
pong_status pong_seal_warning(const struct pong_world *world, size_t index, const char **warning);

/// Returns a note of the seal: something that may, but need not, go wrong at the planned step if enough
/// contacts act at once. `index` counts from 0. The text lives as long as the world.
pong_status pong_seal_note(const struct pong_world *world, size_t index, const char **note);

/* ---- Frames ---------------------------------------------------------------------------------------------- */
/* Each frame: set states, step, get wrenches; or evaluate at stages and commit at the end. */

/// State of a movable group, relative to and expressed in the common frame: any frame that paired Objects share.
typedef struct pong_state {
    /// Position of the group's origin in the common frame, m.
    double position[3];
    /// Quaternion (w, x, y, z), Hamilton, that takes group components to common components. Normalised on entry;
    /// refused if its norm is off by more than 1e-3.
    double orientation[4];
    /// Velocity of the group's origin, m/s, along common axes.
    double linear_velocity[3];
    /// Angular velocity, rad/s, along common axes.
    double angular_velocity[3];
} pong_state;

/// State at rest at the common origin, along the common axes.
struct pong_state pong_default_state(void);

/// Sets the states of `n` movable groups in one call: all of them or, if any is refused, none. Groups that are
/// not named keep their state. With n = 0 the arrays may be NULL. In set-up and in frames.
/// PONG_STATUS_BAD_STATE: a number is not finite or beyond 1e100, or a quaternion is not of unit length.
/// PONG_STATUS_DUPLICATE: a group is named twice.
pong_status pong_set_states(struct pong_world *world,
                            const struct pong_interface_id *interfaces,
                            const struct pong_state *states,
                            size_t n);

/// Sets the state of one movable group. In set-up and in frames. PONG_STATUS_BAD_STATE as for
/// pong_set_states().
pong_status pong_set_state(struct pong_world *world,
                           struct pong_interface_id interface,
                           const struct pong_state *state);

/// Copies the state last set for a movable group, its quaternion normalised. PONG_STATUS_UNSET_STATE if there
/// is none.
pong_status pong_get_state(const struct pong_world *world,
                           struct pong_interface_id interface,
                           struct pong_state *state);

/// Motion of the surface of a movable group along itself, in the frame of the group, as of a belt, a track or a
/// turntable. The shape of the group does not move by it; only friction sees it. At a point p of the surface with the
/// outward unit normal n, the surface moves relative to the group at linear + angular x p + belt x n, of which the
/// part in the contact plane counts. The travels are the integrals of the velocities over time since any instant that
/// the host chooses: they are to the velocities what poses are to twists. Bristles follow the travels.
typedef struct pong_surface_motion {
    /// Velocity of the whole surface, m/s: a belt that is seen from one side.
    double linear_velocity[3];
    /// Angular velocity of the surface about the group's origin, rad/s: a turntable.
    double angular_velocity[3];
    /// Axis of the rollers of a belt that runs around the group, times its speed, m/s: along x above and against x
    /// below for the axis y.
    double belt_velocity[3];
    /// Integral of linear_velocity over time, m.
    double linear_travel[3];
    /// Integral of angular_velocity over time, rad.
    double angular_travel[3];
    /// Integral of belt_velocity over time, m.
    double belt_travel[3];
} pong_surface_motion;

/// Sets the motions of the surfaces of `n` movable groups in one call: all of them or, if any is refused, none. They
/// last until they are set again; before the first call no surface moves. Set them as states are set, for every
/// evaluation for which they differ. The world must know before the seal that surfaces may move: set one in set-up,
/// with zeros if need be. With n = 0 the arrays may be NULL. In set-up and in frames. PONG_STATUS_BAD_VALUE: no motion
/// was set in set-up. PONG_STATUS_BAD_STATE: a number is not finite or beyond 1e100. PONG_STATUS_DUPLICATE: a group is
/// named twice.
pong_status pong_set_surface_motions(struct pong_world *world,
                                     const struct pong_interface_id *interfaces,
                                     const struct pong_surface_motion *motions,
                                     size_t n);

/// Copies the motion of the surface of a movable group, as it was set last; zero if it was never set.
pong_status pong_get_surface_motion(const struct pong_world *world,
                                    struct pong_interface_id interface,
                                    struct pong_surface_motion *motion);

/// Copies the pose that the model's author gave a movable group, at rest, relative to the frame of the root
/// group: an initial state. It is the identity for the root.
pong_status pong_get_authored_state(const struct pong_world *world,
                                    struct pong_interface_id interface,
                                    struct pong_state *state);

/// Computes contacts and wrenches from the states and the committed contact state. Affects no later evaluate or
/// commit: integrators call it any number of times, at times in any order. A frame that reached a limit
/// succeeds; its report has a flag. After sealing. PONG_STATUS_UNSET_STATE: a paired group has no state.
/// PONG_STATUS_LAW_FAILED, PONG_STATUS_BAD_STATE: the frame does not count.
pong_status pong_evaluate(struct pong_world *world);

/// Accepts the states presently set: writes the contact state of the frame, which is evaluated first if the
/// last evaluation used other states. Nothing else writes contact state in a frame: call it once per accepted
/// step, never from a stage of an integrator. Errors as for pong_evaluate(); nothing is committed then.
pong_status pong_commit(struct pong_world *world);

/// As pong_commit(), for `n` pairs only: the others keep their last committed state. For executives that run
/// several rates. With n = 0 `pairs` may be NULL.
pong_status pong_commit_pairs(struct pong_world *world, const struct pong_pair_id *pairs, size_t n);

/// Evaluates and commits, for executives that call once a frame. Errors as for pong_evaluate().
pong_status pong_step(struct pong_world *world);

/* ---- Results: wrenches ----------------------------------------------------------------------------------- */

/// Frame in which a wrench is expressed: PONG_REFERENCE_FRAME_GROUP or PONG_REFERENCE_FRAME_COMMON.
typedef int32_t pong_reference_frame;

/// Along the axes of the movable group.
#define PONG_REFERENCE_FRAME_GROUP 0
/// Along the axes of the common frame.
#define PONG_REFERENCE_FRAME_COMMON 1

/// Wrench that the contacts put on a movable group. The moment is about the group's origin in either frame.
typedef struct pong_wrench {
    /// Force, N.
    double force[3];
    /// Moment about the group's origin, N m.
    double moment[3];
} pong_wrench;

/// Copies the wrenches of the last frame on `n` movable groups, N and N m, about the origin of each and along
/// the axes that `frame` names. The arrays must not share memory; with n = 0 they may be NULL.
/// PONG_STATUS_WRONG_PHASE before the first frame; PONG_STATUS_LAW_FAILED after a frame that a law spoilt.
pong_status pong_get_wrenches(const struct pong_world *world,
                              const struct pong_interface_id *interfaces,
                              pong_reference_frame frame,
                              struct pong_wrench *wrenches,
                              size_t n);

/// Copies the wrench of the last frame on one movable group. Errors as for pong_get_wrenches().
pong_status pong_get_wrench(const struct pong_world *world,
                            struct pong_interface_id interface,
                            pong_reference_frame frame,
                            struct pong_wrench *wrench);

/// Copies the wrench of the last frame on the movable group `interface` from its contacts with the movable
/// group `from` alone, about the origin of `interface`. Over all groups that `interface` can touch, these add
/// up to pong_get_wrench(), to rounding. Zero where the two do not touch, their pair is off or a filter keeps
/// them apart. It is summed in this call, so frames pay nothing; allocates nothing. PONG_STATUS_BAD_VALUE: both
/// are the same group, or their Objects are not paired. Otherwise errors as for pong_get_wrenches().
pong_status pong_get_wrench_from(const struct pong_world *world,
                                 struct pong_interface_id interface,
                                 struct pong_interface_id from,
                                 pong_reference_frame frame,
                                 struct pong_wrench *wrench);

/// Copies the wrench of the last frame of a pair of Objects: the sum over all its contacts, on the Object that
/// was named first in the pair from the other, about the origin of `about`, a movable group of either Object.
/// PONG_REFERENCE_FRAME_GROUP: along the axes of `about`. The Object named second receives the opposite about
/// the same point. Zero where the two do not touch or the pair is off. It is summed in this call, so frames pay
/// nothing; allocates nothing. PONG_STATUS_BAD_VALUE: `about` is of neither Object, or an Object is paired with
/// itself: call pong_get_wrench_from() for two of its groups. Otherwise errors as for pong_get_wrenches().
pong_status pong_get_pair_wrench(const struct pong_world *world,
                                 struct pong_pair_id pair,
                                 struct pong_interface_id about,
                                 pong_reference_frame frame,
                                 struct pong_wrench *wrench);

/* ---- Results: contacts ----------------------------------------------------------------------------------- */

/// Kind of a feature of a primitive: PONG_FEATURE_...
typedef uint32_t pong_feature_kind;

/// `feature_kind` of a face, or of a surface as a whole.
#define PONG_FEATURE_FACE 0
/// `feature_kind` of an edge.
#define PONG_FEATURE_EDGE 1
/// `feature_kind` of a vertex.
#define PONG_FEATURE_VERTEX 2

/// One side of a contact.
typedef struct pong_contact_side {
    /// The Object.
    struct pong_object_id object;
    /// The movable group.
    struct pong_interface_id interface;
    /// The primitive: an index within the movable group, see pong_primitive_path().
    uint32_t primitive;
    /// The triangle of a mesh, counted from its first; 0 otherwise.
    uint32_t element;
    /// Lever arm from the group's origin to the point of the contact, m, along common axes.
    double arm[3];
} pong_contact_side;

/// One contact. Vectors are expressed in the common frame; forces are those on A, B receives the opposite at the
/// same place.
typedef struct pong_contact {
    /// The pair of Objects.
    struct pong_pair_id pair;
    /// Side A: the primitive whose kind the tester names first.
    struct pong_contact_side a;
    /// Side B.
    struct pong_contact_side b;
    /// Feature of B that pushes: PONG_FEATURE_FACE, PONG_FEATURE_EDGE or PONG_FEATURE_VERTEX.
    pong_feature_kind feature_kind;
    /// Index of that feature among those of its kind.
    uint32_t feature_index;
    /// End of an elongated body: 0 and 1 at its ends, 2 and above between them; 0 for other bodies.
    /// Contacts of solids have bit 31 set, forces against rolling and spinning bit 30: see docs/c_api.md.
    uint32_t end;
    /// 1: friction sticks. 0: it slips, or there is none.
    int32_t sticks;
    /// Point at which the force acts, m.
    double point[3];
    /// Unit normal from B to A.
    double normal[3];
    /// Depth of penetration, m, positive.
    double depth;
    /// Rate of the depth, m/s, positive while closing.
    double depth_rate;
    /// Weight, 0 to 1: the share of the pair's spring that this contact carries.
    /// For a cell of two solids, its area, m2; 0 for the contacts that carry their friction.
    double weight;
    /// Normal force, N, never negative.
    double normal_force;
    /// Friction force on A, N, tangential.
    double friction_force[3];
    /// Total force on A, N.
    double force[3];
    /// Tangential velocity of A against B, m/s.
    double slip_velocity[3];
    /// Energy stored in the normal spring and in friction, J.
    double stored;
} pong_contact;

/// Copies the number of contacts of the last frame; 0 before the first.
pong_status pong_contact_count(const struct pong_world *world, size_t *count);

/// Copies the contacts of the last frame, always in the same order for the same frame: the first `capacity`;
/// `count` gets their number. None before the first frame. PONG_STATUS_BUFFER_TOO_SMALL if not all fit; the
/// contact capacity of the seal report is always enough. With capacity 0 `contacts` may be NULL.
/// PONG_STATUS_LAW_FAILED after a frame that a law spoilt.
pong_status pong_get_contacts(const struct pong_world *world,
                              struct pong_contact *contacts,
                              size_t capacity,
                              size_t *count);

/// Lists movable groups in contact whose pose stayed the same, bit for bit, from one commit to the next, though
/// their velocity would have moved them within `step`, the time between the two, s: copies the first
/// `capacity`; `count` gets their number.
///
/// Friction by bristles follows poses, so a belt that is to carry needs a pose that moves, or Coulomb friction,
/// which uses velocities alone. Call it right after pong_step() or pong_commit(); at other times the list is
/// empty. A frame that is committed twice, as in a pause, is listed too. PONG_STATUS_BUFFER_TOO_SMALL if not
/// all fit. With capacity 0 `groups` may be NULL. Allocates.
pong_status pong_find_standing_groups(const struct pong_world *world,
                                      double step,
                                      struct pong_interface_id *groups,
                                      size_t capacity,
                                      size_t *count);

/// Derivatives of the normal force of each contact of the last frame by its depth (`stiffness`, N/m) and by
/// its depth rate (`damping`, N s/m), with the weight of the contact, in the order of pong_get_contacts():
/// the first `capacity` of both are written, `count` gets their number. Zero where the force is cut off at
/// zero; not a number (NaN) for a normal law of the host's. After pong_set_surface() they follow the new
/// values, but the contacts are still those of the frame: evaluate first. PONG_STATUS_BUFFER_TOO_SMALL if not
/// all fit. With capacity 0 both arrays may be NULL.
pong_status pong_get_contact_stiffness(const struct pong_world *world,
                                       double *stiffness,
                                       double *damping,
                                       size_t capacity,
                                       size_t *count);

/// Checks the planned step against the contacts of the last frame, with their actual lever arms and normals.
/// Allocates. PONG_STATUS_WRONG_PHASE: no step was planned before the seal, or there is no frame.
pong_status pong_check_step(const struct pong_world *world, struct pong_step_check *check);

/* ---- Results: tangents ----------------------------------------------------------------------------------- */

/// Derivatives of the wrenches that two movable groups put on each other.
///
/// x is a pose: translation of the group's origin, m, and rotation vector, rad. v is a twist: velocity of the
/// origin, m/s, and angular velocity, rad/s. W is a wrench: force, N, and moment about the group's origin, N m. All of
/// them are along common axes. A matrix has 6 rows, one for each number of W, and 6 columns, one for each number of x
/// or v; row r and column c are number 6 r + c.
typedef struct pong_tangent {
    /// The two movable groups, in the order of pong_contact_change.
    struct pong_interface_id interfaces[2];
    /// `stiffness[i][j]` is minus the derivative of W of group i by x of group j, N/m, N/rad, N and N m/rad. A spring
    /// that pushes back has a positive diagonal.
    double stiffness[2][2][36];
    /// `damping[i][j]` is minus the derivative of W of group i by v of group j, N s/m, N s/rad, N s and N m s/rad.
    double damping[2][2][36];
} pong_tangent;

/// Stiffness and damping of one contact, its weight included.
typedef struct pong_contact_tangent {
    /// Derivative of the normal force by the depth, N/m; zero where the force is cut off at zero.
    double normal_stiffness;
    /// Derivative of the normal force by the depth rate, N s/m; zero where the force is cut off at zero.
    double normal_damping;
    /// Stiffness of the bristle while it sticks, N/m; zero while it slips and for laws without a bristle.
    double tangential_stiffness;
    /// Damping of the bristle while it sticks, N s/m; zero while it slips and for laws without a bristle.
    double tangential_damping;
} pong_contact_tangent;

/// Copies the derivatives of the wrenches of the last frame for every two movable groups that touch, in closed form and
/// always in the same order: the first `capacity`; `count` gets their number. They are those of what pong_evaluate()
/// computes from the committed contact state, with the contacts of the frame: turning normals, moving places, weights,
/// sticking and slipping friction included. The matrices are not symmetric where friction or damping acts. See
/// docs/theory.md, 7. A frame pays nothing. Allocates.
///
/// PONG_STATUS_WRONG_PHASE: call it between pong_evaluate() and the commit. PONG_STATUS_BAD_VALUE: a contact has
/// derivatives that are not known in closed form, such as that of two solids or of a law of the host's; the message
/// names it, and pong_get_complete_tangents() has them. PONG_STATUS_BUFFER_TOO_SMALL if not all fit;
/// `group_pairs` of the seal report is always enough. With capacity 0 `tangents` may be NULL.
pong_status pong_get_tangents(const struct pong_world *world,
                              struct pong_tangent *tangents,
                              size_t capacity,
                              size_t *count);

/// As pong_get_tangents(), by central differences, for every law and every kind of contact: two evaluations for each of
/// the 12 numbers of pose and twist of each group that touches. The width of a difference is 1e-4 of the least depth of
/// the group's contacts. Contacts that begin or end within that width, and friction that begins to slip, spoil the
/// result. The states and the frame are those of before. Allocates.
///
/// PONG_STATUS_WRONG_PHASE: call it between pong_evaluate() and the commit. Otherwise errors as for pong_evaluate() at
/// the states in between; after PONG_STATUS_LAW_FAILED the frame does not count. PONG_STATUS_BUFFER_TOO_SMALL if not all
/// fit. With capacity 0 `tangents` may be NULL.
pong_status pong_get_tangents_by_differences(struct pong_world *world,
                                             struct pong_tangent *tangents,
                                             size_t capacity,
                                             size_t *count);

/// As pong_get_tangents() for the pairs of groups whose contacts all have derivatives in closed form, and as
/// pong_get_tangents_by_differences() for the others, in the same order. Allocates.
///
/// Errors as for pong_get_tangents_by_differences().
pong_status pong_get_complete_tangents(struct pong_world *world,
                                       struct pong_tangent *tangents,
                                       size_t capacity,
                                       size_t *count);

/// Copies stiffness and damping of each contact of the last frame, in the order of pong_get_contacts(): the first
/// `capacity`; `count` gets their number. All four are not a number (NaN) for a law of the host's, for contacts of
/// solids and for forces against rolling and spinning. After pong_set_surface() they follow the new values, but the
/// contacts are still those of the frame: evaluate first. PONG_STATUS_BUFFER_TOO_SMALL if not all fit; the contact
/// capacity of the seal report is always enough. With capacity 0 `tangents` may be NULL.
pong_status pong_get_contact_tangents(const struct pong_world *world,
                                      struct pong_contact_tangent *tangents,
                                      size_t capacity,
                                      size_t *count);

/// Incremental potential of the contacts of two movable groups.
typedef struct pong_potential {
    /// The two movable groups, in the order of pong_contact_change.
    struct pong_interface_id interfaces[2];
    /// Energy that the contacts add, J.
    double energy;
    /// Minus its derivatives by the poses of both groups: force, N, and moment about the group's origin, N m, along common
    /// axes.
    struct pong_wrench wrenches[2];
    /// Its second derivatives without the turning of normals and levers: `stiffness[i][j]` as in pong_tangent. The whole is
    /// symmetric and has no negative eigenvalue while no damper pulls.
    double stiffness[2][2][36];
} pong_potential;

/// Derivatives of the wrenches that two movable groups put on each other, by a number of a surface.
typedef struct pong_surface_slope {
    /// The two movable groups, in the order of pong_contact_change.
    struct pong_interface_id interfaces[2];
    /// Derivatives of the wrenches on both, N and N m over the unit of the number, about the group's origin, along common
    /// axes.
    struct pong_wrench wrenches[2];
} pong_surface_slope;

/// Copies the incremental potential of a step of length `step`, s, for every two movable groups that touch, always in the
/// same order: the first `capacity`; `count` gets their number. A host that finds the end of its step as the minimum of an
/// energy sets poses, evaluates, adds these energies, wrenches and second derivatives to its own, and commits the end that
/// it has found. The step starts at the last commit. The wrenches are not those of pong_get_wrenches(): the limit of
/// friction follows the load at the start, and damping the depth gained in the step over its length. See docs/theory.md, 7.
/// Allocates.
///
/// PONG_STATUS_WRONG_PHASE: call it between pong_evaluate() and the commit. PONG_STATUS_BAD_VALUE: `step` is not positive
/// and finite, or a contact is of two solids, has a law of the host or a resistance to rolling or spinning, or no unique
/// derivative. PONG_STATUS_BUFFER_TOO_SMALL if not all fit; `group_pairs` of the seal report is always enough. With capacity
/// 0 `potentials` may be NULL.
pong_status pong_get_incremental_potentials(const struct pong_world *world,
                                            double step,
                                            struct pong_potential *potentials,
                                            size_t capacity,
                                            size_t *count);

/// Copies the derivatives of the wrenches of the last frame by a number of a surface of a model, for every two movable
/// groups that touch, always in the same order: the first `capacity`; `count` gets their number. `number` is named as in
/// the model format: "stiffness", "normal.damping", "friction.mu" and so on. Poses and contact state are held. By
/// differences: two evaluations, three for a number that is zero. Surface and frame are those of before. Allocates.
///
/// PONG_STATUS_WRONG_PHASE: call it between pong_evaluate() and the commit. PONG_STATUS_UNKNOWN_NAME: the model has no such
/// surface, or the surface does not give the number. Otherwise errors as for pong_evaluate(); after PONG_STATUS_LAW_FAILED
/// the frame does not count. PONG_STATUS_BUFFER_TOO_SMALL if not all fit; `group_pairs` of the seal report is always
/// enough. With capacity 0 `slopes` may be NULL.
pong_status pong_get_surface_slopes(struct pong_world *world,
                                    struct pong_model_id model,
                                    const char *surface,
                                    const char *number,
                                    struct pong_surface_slope *slopes,
                                    size_t capacity,
                                    size_t *count);

/* ---- Results: distance ----------------------------------------------------------------------------------- */

/// Primitive number that names no primitive.
#define PONG_NO_PRIMITIVE UINT32_MAX

/// Distance of two movable groups a and b, with their nearest primitives, that of a first.
typedef struct pong_distance {
    /// Smallest distance of two primitives that have a contact test with each other, m: 0 if such overlap, infinite if there
    /// are none.
    double distance;
    /// Nearest points, m, in the common frame. If primitives overlap, some points near; zero if the distance is infinite.
    double points[2][3];
    /// The primitives: indices within the movable groups, see pong_primitive_path(). PONG_NO_PRIMITIVE if the distance is
    /// infinite.
    uint32_t primitives[2];
    /// Elements within the primitives: a mesh's triangles, from 0; 0 for all other kinds.
    uint32_t elements[2];
} pong_distance;

/// Distance of two movable groups at the states set last; no frame is needed. Primitives count that have a contact test with one
/// of the other group and that no filter keeps apart; a pair that is off has a distance too. Triangles count without their
/// thickness. Computed when it is asked for: a frame pays nothing; allocates nothing. PONG_STATUS_BAD_VALUE: both are the same
/// group, their Objects are not paired, or a bore or a primitive of a host's kind is in the way, which has no convex solid.
/// PONG_STATUS_WRONG_PHASE: the world is not sealed. PONG_STATUS_UNSET_STATE: the state of one was never set.
pong_status pong_get_distance(const struct pong_world *world,
                              struct pong_interface_id a,
                              struct pong_interface_id b,
                              struct pong_distance *distance);

/* ---- Results: begin, end and peaks of contact ------------------------------------------------------------ */

/// Begin or end of contact between two movable groups.
typedef struct pong_contact_change {
    /// The pair of Objects.
    struct pong_pair_id pair;
    /// The two movable groups: first that of the Object that was named first in the pair. In an Object paired with itself, the
    /// one with the lower id.
    struct pong_interface_id interfaces[2];
    /// 1: contact begins. 0: it ends.
    int32_t begins;
    /// Zero.
    uint32_t reserved;
} pong_contact_change;

/// Contact between two movable groups over a window of several frames.
typedef struct pong_pair_peaks {
    /// The pair of Objects.
    struct pong_pair_id pair;
    /// The two movable groups, in the order of pong_contact_change.
    struct pong_interface_id interfaces[2];
    /// Largest sum of the normal forces of all their contacts in a frame of the window, N.
    double peak_normal_force;
    /// Mean over the window, frames without contact included, of the wrench on the first group from the second: about the
    /// origin of the first group, wherever it was, along the axes of the common frame. Times `window`, it is the impulse.
    struct pong_wrench mean;
    /// Time of the frames in which they touched, s.
    double contact_time;
    /// Length of the window, s: the sum of the steps observed in it.
    double window;
    /// Number of begins of contact in the window.
    uint32_t begins;
    /// Number of its ends.
    uint32_t ends;
    /// 1: they touch in the frame last observed. 0: they do not.
    int32_t touches;
    /// Zero.
    uint32_t reserved;
} pong_pair_peaks;

/// Starts the pair monitor of a world: takes memory for every pair of movable groups, so that later calls take
/// none. Called again, it begins anew. After sealing; a clone has no monitor. A world without a monitor pays
/// nothing.
pong_status pong_start_pair_monitor(struct pong_world *world);

/// Observes the frame that was committed last; it stands for `step`, the time since the commit before, s. Call
/// it once after each pong_step(), pong_commit() or pong_commit_pairs(), before the next evaluation. Allocates
/// nothing.
///
/// Two movable groups touch in a frame that lists a contact of theirs; after a commit of some pairs, all
/// contacts of the frame count. Begins and ends come from the comparison with the frame observed before,
/// whatever became of the contact state in between, so those of two groups alternate. The first frame begins
/// all its contacts. A pair that is switched off ends with the next commit. A cleared history changes nothing
/// where groups go on touching. After a restored contact state the next frame is compared with the last one
/// observed.
///
/// PONG_STATUS_WRONG_PHASE: there is no monitor, or the last frame is not committed or was observed already.
pong_status pong_observe_pairs(struct pong_world *world,
                               double step);

/// Copies begins and ends of contact from the frame observed before to the one observed last, always in the
/// same order: by pairs of Objects, then by groups. Copies the first `capacity`; `count` gets their number.
/// PONG_STATUS_BUFFER_TOO_SMALL if not all fit; `group_pairs` of the seal report is always enough. With
/// capacity 0 `changes` may be NULL. PONG_STATUS_WRONG_PHASE without a monitor.
pong_status pong_get_contact_changes(const struct pong_world *world,
                                     struct pong_contact_change *changes,
                                     size_t capacity,
                                     size_t *count);

/// Begins another window: pong_get_pair_peaks() then covers the frames observed from now on. Groups that touch
/// go on touching. PONG_STATUS_WRONG_PHASE without a monitor.
pong_status pong_begin_peak_window(struct pong_world *world);

/// Copies peak normal force and mean wrench of all movable groups that touched in the window, or whose contact
/// ended in it, in the order of pong_get_contact_changes(): the first `capacity`; `count` gets their number.
/// PONG_STATUS_BUFFER_TOO_SMALL if not all fit; `group_pairs` of the seal report is always enough. With
/// capacity 0 `peaks` may be NULL. PONG_STATUS_WRONG_PHASE without a monitor.
pong_status pong_get_pair_peaks(const struct pong_world *world,
                                struct pong_pair_peaks *peaks,
                                size_t capacity,
                                size_t *count);

/* ---- Contact state --------------------------------------------------------------------------------------- */

/// Size of the largest contact state that this world can save, bytes; fixed when the world is sealed. A buffer
/// of this size is always large enough. After sealing.
pong_status pong_contact_state_size(const struct pong_world *world,
                                    size_t *size);

/// Size of the present contact state when saved, bytes. It grows and shrinks with the contacts of the last
/// commit, and is mostly far below pong_contact_state_size(). After sealing.
pong_status pong_contact_state_used(const struct pong_world *world, size_t *size);

/// Saves the committed contact state into the caller's buffer of `size` bytes, pong_contact_state_used() or
/// more. The first pong_contact_state_used() bytes are the contact state; the rest, up to
/// pong_contact_state_size(), becomes zero. The bytes hold no pointer: write them to a file, keep them, compare
/// them. To save often and fast give a buffer of pong_contact_state_used() bytes. After sealing.
/// PONG_STATUS_BUFFER_TOO_SMALL: the message has the size.
pong_status pong_save_contact_state(const struct pong_world *world,
                                    void *buffer,
                                    size_t size);

/// Restores a contact state that was saved by this world or by one built by the same calls: the bytes that
/// saving used, or more of the buffer, up to pong_contact_state_size(). The states of the movable groups are
/// the host's and are not part of it. After sealing. PONG_STATUS_BAD_STATE_BLOCK: the world keeps the contact
/// state it had.
pong_status pong_restore_contact_state(struct pong_world *world, const void *buffer, size_t size);

/// Accepts the states presently set, as pong_commit(), and preloads the bristles between the two Objects of a
/// pair: for the first frame of a run, and after pong_clear_contact_history(). With `force` NULL, contacts that
/// slide are preloaded to their kinetic friction, against their present motion, as after a long slide.
/// Otherwise friction holds `force`, N, three numbers along the common axes, on the Object that was named first
/// in the pair: as much of it as lies in the contact planes and as sticks. `count`, which may be NULL, gets the
/// number of bristles that were set; contacts without a bristle or without load have none. After sealing.
/// Errors as for pong_commit(). Allocates: not in frames.
pong_status pong_preload_friction(struct pong_world *world,
                                  struct pong_pair_id pair,
                                  const double *force,
                                  size_t *count);

/// Clears the contact state of an Object, after a teleport or a reset: its contacts begin anew, with bristles
/// at zero. After sealing.
pong_status pong_clear_contact_history(struct pong_world *world, struct pong_object_id object);

/* ---- Changes between frames ------------------------------------------------------------------------------ */

/// Switches a pair on (1, as it begins) or off (0), before or after sealing. A pair that is off has no
/// contacts. Both drop the contact state of the pair at once: bristles begin anew, as after
/// pong_clear_contact_history(). Switching to the present setting does nothing.
///
/// Wrenches and contacts stay those of the last frame until the next evaluation, so evaluate before the
/// wrenches are read again. pong_commit() and pong_step() evaluate by themselves; pong_log_frame() is refused
/// until then. A log records the switch by itself.
pong_status pong_set_pair_enabled(struct pong_world *world, struct pong_pair_id pair, int32_t enabled);

/// Kind of a normal force law: PONG_NORMAL_...
typedef int32_t pong_normal_kind;

/// F = k d + c d', with a ramp: d is the depth, k the stiffness, c the damping.
#define PONG_NORMAL_LINEAR 0
/// F = k d (1 + chi d').
#define PONG_NORMAL_HUNT_CROSSLEY 1
/// F = k d^(3/2) (1 + chi d').
#define PONG_NORMAL_HUNT_CROSSLEY_HERTZ 2
/// A law given by callback; its parameters stay as the model gives them.
#define PONG_NORMAL_CUSTOM 3
/// Law of the surface it meets, for a rigid surface that names none. It stays rigid.
#define PONG_NORMAL_INHERITED 4
/// F = k d + c d^q d', with the q of the model file.
#define PONG_NORMAL_POWER_LAW 5
/// F = k d^(3/2) + c d^q d', with the q of the model file.
#define PONG_NORMAL_POWER_LAW_HERTZ 6

/// Kind of a friction law: PONG_FRICTION_...
typedef int32_t pong_friction_kind;

/// No friction.
#define PONG_FRICTION_NONE 0
/// Bristle with reset.
#define PONG_FRICTION_BRISTLE 1
/// Regularised Coulomb friction.
#define PONG_FRICTION_COULOMB 2
/// A law given by callback; its parameters stay as the model gives them.
#define PONG_FRICTION_CUSTOM 3
/// Law of the surface it meets, for a rigid surface that names none. It stays rigid.
#define PONG_FRICTION_INHERITED 4

/// The values of a surface. Get them, change some, set them: laws may not change. Values that the surface's
/// laws do not use are 0 when got and ignored when set. No value but a rigid stiffness is beyond 1e100.
typedef struct pong_surface_values {
    /// Normal law of the surface: PONG_NORMAL_...
    pong_normal_kind normal_law;
    /// Friction law of the surface: PONG_FRICTION_...
    pong_friction_kind friction_law;
    /// Normal stiffness, N/m (N/m^1.5 with PONG_NORMAL_..._HERTZ), 1e-100 to 1e100; infinite means rigid.
    double stiffness;
    /// Linear, power law: damping, N s/m (N s/m^(1+q) with the power law).
    double damping;
    /// Linear: depth over which the damping sets in, m; 0 means at once.
    double ramp;
    /// Hunt-Crossley: chi, s/m.
    double dissipation;
    /// Bristle, Coulomb: kinetic friction coefficient.
    double friction;
    /// Bristle: a, so that the static coefficient is (1 + a) times the kinetic one.
    double friction_static_excess;
    /// Bristle: tangential stiffness, N/m, 1e-100 to 1e100; 0 takes two thirds of the normal stiffness.
    double friction_stiffness;
    /// Bristle: tangential damping, N s/m. When read, it is the damping that acts, also where the model
    /// leaves it to the normal law; once set, it no longer follows that law.
    double friction_damping;
    /// Coulomb: slip speed at which the full force is reached, m/s.
    double friction_slip_speed;
} pong_surface_values;

/// Values of a surface that pong_surface_values does not have. Get them, change some, set them.
typedef struct pong_surface_more {
    /// Foundation modulus of solids, N/m^3: the pressure for each metre of depth; 0 for none.
    double foundation;
    /// Area to which the stiffness belongs, m^2; 0 for none.
    double area;
    /// Bristle: rolling resistance, m: the moment of a rolling contact over its normal force. Ignored by other laws.
    double rolling;
    /// Bristle: spinning resistance, m, likewise.
    double spinning;
} pong_surface_more;

/// Number of surfaces of a model.
pong_status pong_surface_count(const struct pong_world *world, struct pong_model_id model, size_t *count);

/// Returns the name of a surface of a model; `index` counts from 0. The text lives as long as the world.
pong_status pong_surface_name(const struct pong_world *world,
                              struct pong_model_id model,
                              size_t index,
                              const char **name);

/// Copies the present values of a surface, named as in the model.
pong_status pong_get_surface(const struct pong_world *world,
                             struct pong_model_id model,
                             const char *surface,
                             struct pong_surface_values *values);

/// Sets the values of a surface for all Objects of a model, from the next evaluation on, before or after
/// sealing. Allocates: between frames, not in them. PONG_STATUS_BAD_VALUE: another law than the surface has, or
/// a value outside its range.
pong_status pong_set_surface(struct pong_world *world,
                             struct pong_model_id model,
                             const char *surface,
                             const struct pong_surface_values *values);

/// Copies the present further values of a surface, named as in the model.
pong_status pong_get_surface_more(const struct pong_world *world,
                                  struct pong_model_id model,
                                  const char *surface,
                                  struct pong_surface_more *values);

/// Sets the further values of a surface for all Objects of a model, as pong_set_surface() sets the others.
/// PONG_STATUS_BAD_VALUE: a value outside its range.
pong_status pong_set_surface_more(struct pong_world *world,
                                  struct pong_model_id model,
                                  const char *surface,
                                  const struct pong_surface_more *values);

/* ---- Further worlds -------------------------------------------------------------------------------------- */

/// Clones a sealed world as it stands: with its states, pairs, surfaces, contact state and user data, and the
/// same ids. It takes a fraction of the time of loading and sealing again. From here on both are independent;
/// given the same calls, they give the same bits. The clone has memory and workers of its own; it has computed
/// no frame yet and has no log and no monitor. Both call the same laws: the `user` data of a law must live as
/// long as either. The clone is the caller's: destroy it with pong_destroy_world(). On failure `clone` gets
/// NULL. After sealing.
pong_status pong_clone_world(const struct pong_world *world,
                             struct pong_world **clone);

/// Objects, pairs and contacts that pong_continue_from() took over, and those left in the other world.
typedef struct pong_continuation {
    /// Objects in both worlds.
    uint64_t objects;
    /// Pairs of them that continue.
    uint64_t pairs;
    /// Pushing contacts that continue.
    uint64_t contacts;
    /// Objects of the other world alone.
    uint64_t objects_left;
    /// Pairs of those, left behind with their contact state and energy accounts.
    uint64_t pairs_left;
    /// Pushing contacts of those pairs.
    uint64_t contacts_left;
    /// Energy stored in them, J. The ledger counts it as dissipated.
    double energy_left;
    /// Zero in this version.
    uint64_t reserved[4];
} pong_continuation;

/// Makes a world in set-up with everything that a sealed one was made of, and with the states, pairs, surface
/// values and user data that it has now: load and create what arrives, pair it, seal, and call
/// pong_continue_from(). Models are shared, not loaded again. Ids of the sealed world are ids of this one; ids of
/// what is added belong to this one alone, and must not be used in another world extended from the same one. The
/// sealed world may run on meanwhile. Both call the same laws: the `user` data of a law must live as long as
/// either. Masses and step plan are taken over. The world is the caller's: destroy it with pong_destroy_world().
/// On failure `extended` gets NULL. PONG_STATUS_WRONG_PHASE before the seal.
pong_status pong_extend_world(const struct pong_world *world,
                              struct pong_world **extended);

/// Continues the run of another world, `from`, in `world`; both are sealed. Common Objects (those of equal name)
/// and their pairs take over states, switched pairs, surface values and contact state. Contacts between them
/// continue as if no Object had been added or removed: their wrenches are bit-identical, as long as nothing else
/// touches these Objects. So do the totals of the ledger and the energy accounts of these pairs. Objects that
/// only `world` has keep their states, pairs and surfaces, and their contacts start without history. Objects
/// that only `from` has are left behind; `continuation`, which may be NULL, counts them. All earlier contact
/// state of `world` is dropped, and it has no results before its next frame. `from` is unchanged. Allocates:
/// call it between frames.
///
/// PONG_STATUS_BAD_VALUE if contacts would not continue unchanged: an Object of the same name has another model,
/// Objects were created or paired in another order, a pair is missing, filters differ, energies are kept
/// otherwise, or there is too little room. PONG_STATUS_WRONG_PHASE: a frame of either world was evaluated and
/// not committed, or `world` has a log. `world` is unchanged then.
pong_status pong_continue_from(struct pong_world *world,
                               const struct pong_world *from,
                               struct pong_continuation *continuation);

/* ---- Response logs --------------------------------------------------------------------------------------- */

/// Behaviour of a log whose buffer is full: PONG_LOG_...
typedef uint32_t pong_log_when_full;

/// `when_full`: frames for which there is no room are left out of the log as a whole, counted and marked.
#define PONG_LOG_DROP 0
/// `when_full`: pong_log_frame() waits until there is room: for unattended runs.
#define PONG_LOG_WAIT 1

/// Options of a log. Make it with pong_default_log_options(), change what you like, pass it to
/// pong_start_log().
typedef struct pong_log_options {
    /// Set by pong_default_log_options(): size of this struct, bytes.
    uint32_t struct_size;
    /// Set by pong_default_log_options(): PONG_ABI_VERSION of the library.
    uint32_t abi_version;
    /// Set by pong_default_log_options(): checked by pong_start_log().
    uint64_t cookie;
    /// Name of the run, UTF-8; NULL (default) for the name of the folder. Read during pong_start_log() only.
    const char *name;
    /// Step of the host's integrator, s, for readers of the log; 0 (default) if it varies.
    double step;
    /// Most bytes that may wait for the disk; raised to the size of the largest frame. 0 (default) for 16
    /// MiB.
    uint64_t buffer_bytes;
    /// Time between two flushes, ms; 1000 by default. A run that is cut off keeps what was flushed.
    uint32_t flush_ms;
    /// Behaviour when the disk is slower than the run: PONG_LOG_DROP (default) or PONG_LOG_WAIT. A disk that
    /// accepts nothing for 30 s has failed.
    pong_log_when_full when_full;
    /// 1: replaces a log that lies in the folder. 0 (default): such a folder is refused.
    uint32_t overwrite;
    /// Number of commits that each logged frame stands for, for readers of the log; 0 (default) if that
    /// varies.
    uint32_t commits_per_frame;
    /// Zero.
    uint64_t reserved[8];
} pong_log_options;

/// Progress of a log.
typedef struct pong_log_report {
    /// Frames logged, lost ones included.
    uint64_t frames;
    /// Frames flushed to the files: a run that is cut off now keeps them.
    uint64_t flushed;
    /// Frames that are not and will not be in the log.
    uint64_t lost;
    /// Changes between frames that are not in the log; it cannot be replayed exactly beyond them.
    uint64_t events_lost;
    /// Bytes of the rows flushed.
    uint64_t bytes;
    /// Largest number of bytes that waited for the disk.
    uint64_t buffer_peak;
    /// Number of bytes that may wait for the disk.
    uint64_t buffer_size;
    /// 1: the files cannot be written any more, and every frame from then on is lost; pong_stop_log()
    /// returns the cause. 0: not so.
    uint32_t failed;
    /// Zero in this version.
    uint32_t reserved_flags;
    /// Zero in this version.
    uint64_t reserved[4];
} pong_log_report;

/// The default options, as their comments say.
struct pong_log_options pong_default_log_options(void);

/// Begins a response log (docs/response_logs.md) of a sealed world in a folder (UTF-8 path), which is created
/// if it does not exist. `options` may be NULL for the defaults. The log may begin at any time: it starts
/// with the contact state of the world. Model files are copied; they must be unchanged since they were
/// loaded. Takes memory, files and a thread. PONG_STATUS_LOG_FAILED: the folder cannot be written or holds a
/// log, or a model has changed. PONG_STATUS_OUT_OF_MEMORY: the system does not have the memory for the
/// buffer. The log belongs to this process: a fork of it logs nothing into it.
pong_status pong_start_log(struct pong_world *world,
                           const char *folder,
                           const struct pong_log_options *options);

/// Logs the frame last evaluated, with this time (s): states, wrenches and contacts. Call it after the commit
/// of the frame (pong_step() or pong_commit()) and before states change: once per commit, if the log is to be
/// replayed exactly. Takes no memory, touches no file and does not wait, unless `when_full` says so. A call
/// whose frame is lost succeeds; the frame is counted: see pong_get_log_report(). PONG_STATUS_WRONG_PHASE:
/// there is no log, or states, pairs or surfaces have changed since the frame.
pong_status pong_log_frame(struct pong_world *world, double time);

/// Copies the progress of the log. PONG_STATUS_WRONG_PHASE: there is no log.
pong_status pong_get_log_report(const struct pong_world *world, struct pong_log_report *report);

/// Writes the rest and closes the log. Waits for the disk until it has accepted nothing for 30 s; a log that
/// has already failed for that reason closes at once. `report` may be NULL. PONG_STATUS_LOG_FAILED: the files
/// could not be written to the end; the message has the cause and where the log ends. It is closed all the
/// same. pong_destroy_world() closes a log too, without a report. PONG_STATUS_WRONG_PHASE: there is no log.
pong_status pong_stop_log(struct pong_world *world, struct pong_log_report *report);

/* ---- Own force laws -------------------------------------------------------------------------------------- */
/* Registered before models that name them are loaded. */

/// Input of a normal force law.
typedef struct pong_normal_input {
    /// Depth, m; positive.
    double depth;
    /// Rate of the depth, m/s, positive while closing.
    double depth_rate;
    /// Stiffness of the pair of surfaces, N/m.
    double stiffness;
    /// The law's parameters as the model gives them; valid during the call.
    const double *parameters;
    /// Number of parameters.
    size_t parameter_count;
} pong_normal_input;

/// Input of a friction law. Vectors are expressed in the frame of B's movable group and lie in the present
/// contact plane.
typedef struct pong_friction_input {
    /// Present normal force, N; positive.
    double normal_force;
    /// Unit normal, from B to A.
    double normal_b[3];
    /// Tangential displacement of A against B since the last commit, m; in the step in which a contact
    /// begins, since the touch.
    double slip_b[3];
    /// Tangential velocity of A against B, m/s.
    double slip_velocity_b[3];
    /// Share of the pair's friction that this contact carries, 0 to 1: scale stiffness and damping by it.
    double share;
    /// Tangential stiffness of the pair, N/m.
    double stiffness;
    /// The law's parameters as the model gives them; valid during the call.
    const double *parameters;
    /// Number of parameters.
    size_t parameter_count;
    /// 1: the contact stuck at the last commit or is new. 0: it slipped.
    int32_t stuck;
    /// Zero.
    int32_t reserved;
} pong_friction_input;

/// Output of a friction law. It is all zero when the law is called.
typedef struct pong_friction_output {
    /// Force on A, N, in the frame of B's movable group. A part along the normal is removed.
    double force_b[3];
    /// Energy stored in the law's state, J; for the ledger.
    double stored;
    /// 1: the contact sticks. 0: it slips.
    int32_t sticks;
    /// Leave it zero.
    int32_t reserved;
} pong_friction_output;

/// A normal force law, or the energy it stores: returns N, or J. See pong_register_normal_law().
typedef double (*pong_normal_law)(const struct pong_normal_input *input, void *user);

/// A friction law. `state` holds the numbers that the law keeps for this contact, as committed (zero for a new
/// contact), and takes the new ones, which count only if the host commits; vectors in it are the law's to turn with
/// the normal. See pong_register_friction_law().
typedef void (*pong_friction_law)(const struct pong_friction_input *input,
                                  double *state,
                                  struct pong_friction_output *output,
                                  void *user);

/// Adds a normal force law that models then name as Custom(name: "...", parameters: [...]). Before sealing.
///
/// `force` returns the force of a whole contact in N (negative counts as 0), `stored` the energy stored at this
/// depth in J; with NULL for `stored` none is stored, and the ledger takes all of it as dissipated. Both must
/// be pure (same input, same answer) and may be called from any thread and from several at once; they must not
/// throw, jump out or call this world. `user` is passed to them unchanged and must live as long as the world.
/// PONG_STATUS_DUPLICATE: there is a normal law of this name.
pong_status pong_register_normal_law(struct pong_world *world,
                                     const char *name,
                                     pong_normal_law force,
                                     pong_normal_law stored,
                                     void *user);

/// Adds a friction law that keeps `state_len` numbers per contact (at most 64) as contact state. The same rules
/// as for pong_register_normal_law().
pong_status pong_register_friction_law(struct pong_world *world,
                                       const char *name,
                                       size_t state_len,
                                       pong_friction_law law,
                                       void *user);

/* ---- User data ------------------------------------------------------------------------------------------- */

/// Keeps a number of the host's with an Object: an index, a pointer. The engine never reads it. May allocate.
pong_status pong_set_object_user_data(struct pong_world *world,
                                      struct pong_object_id object,
                                      uint64_t user_data);

/// Copies the number kept with an Object; 0 if none was set.
pong_status pong_get_object_user_data(const struct pong_world *world,
                                      struct pong_object_id object,
                                      uint64_t *user_data);

/// Keeps a number of the host's with a primitive of one Object. The engine never reads it. May allocate.
pong_status pong_set_primitive_user_data(struct pong_world *world,
                                         struct pong_interface_id interface,
                                         uint32_t primitive,
                                         uint64_t user_data);

/// Copies the number kept with a primitive; 0 if none was set.
pong_status pong_get_primitive_user_data(const struct pong_world *world,
                                         struct pong_interface_id interface,
                                         uint32_t primitive,
                                         uint64_t *user_data);

/* ---- Workers --------------------------------------------------------------------------------------------- */

/// Outcome of a request to the system: PONG_GRANT_...
typedef uint32_t pong_grant;

/// Outcome of a request that the configuration does not make.
#define PONG_GRANT_NOT_ASKED 0
/// Outcome: requested and granted.
#define PONG_GRANT_GRANTED 1
/// Outcome: requested and refused; pong_worker_text() has the reason.
#define PONG_GRANT_REFUSED 2

/// Placement of a worker, and its share of the last frame.
typedef struct pong_worker {
    /// Thread: 0 is the calling thread, 1 the first worker.
    uint32_t index;
    /// Outcome of binding it to a core: PONG_GRANT_...
    pong_grant core_grant;
    /// The core that was requested; 0 if none was.
    uint32_t core;
    /// Outcome of requesting SCHED_FIFO: PONG_GRANT_...
    pong_grant fifo_grant;
    /// The priority that was requested; 0 if none was.
    uint32_t fifo_priority;
    /// Blocks of work done in the last round of work that was shared out. A frame with too little work to
    /// share has none, and the number stays that of an earlier frame.
    uint32_t blocks;
    /// With report_times: time spent on them, ns; else 0.
    uint64_t busy_ns;
    /// With report_times: time of this thread in each part of the last frame's contacts, ns, at
    /// PONG_WORK_...; else 0. All rounds of the frame together; for the calling thread including what it did
    /// by itself.
    uint64_t work_ns[4];
} pong_worker;

/// Wakes the workers shortly before a frame (some 100 us): they look for its work until it comes or
/// `at_most_us`, us, have passed. For hosts whose frames are further apart than the workers' spin_us. Does
/// nothing without workers. After sealing.
pong_status pong_prewake(struct pong_world *world, uint64_t at_most_us);

/// Lets the workers sleep at once, as in a freeze. The next frame wakes them. Does nothing without workers.
/// After sealing.
pong_status pong_quiesce(struct pong_world *world);

/// Number of workers that were started, which may be fewer than the configuration requests. After sealing.
pong_status pong_worker_count(const struct pong_world *world, size_t *count);

/// Copies the placement of a worker and its share of the last frame. `index` is 1 to pong_worker_count(), or 0
/// for the calling thread. After sealing.
pong_status pong_get_worker(const struct pong_world *world,
                            size_t index,
                            struct pong_worker *worker);

/// Returns the placement of a worker in words: its core and priority, or why it does not have them. `index` is
/// 1 to pong_worker_count(). The text lives as long as the world. After sealing.
pong_status pong_worker_text(const struct pong_world *world,
                             size_t index,
                             const char **text);

/* ---- Diagnostics: report --------------------------------------------------------------------------------- */

/// Limits that a frame reached: a sum of PONG_FLAG_...
typedef uint32_t pong_flags;

/// The frame had more contacts than the world's capacity: the deepest were kept.
#define PONG_FLAG_CONTACT_LIMIT 1
/// A sphere had more contacts with one surface than could be shared exactly: the deepest were shared.
#define PONG_FLAG_LOAD_SHARING_LIMIT 2
/// A contact was missed: a body passed right through another one since the last commit, or came out on the far
/// side of the one that pushed it back. Remedy: shorter frames, a thicker wall or a stiffer surface. Before an
/// intended jump call pong_clear_contact_history().
#define PONG_FLAG_TUNNELLED 4
/// A solid was deeper in a mesh that is not convex than the regions below its facets: the force no longer grew as it
/// should. Remedy: stiffer surfaces, a thicker mesh or one with longer edges, or convex pieces (`pong decompose`).
/// `pong check` prints the least depth of the regions of each mesh.
#define PONG_FLAG_DEEP_IN_MESH 8

/// `stage_ns` of states in and relative motion.
#define PONG_STAGE_INPUT 0
/// `stage_ns` of bounding volumes, testers, sharing and forces, on the calling thread and the workers.
#define PONG_STAGE_CONTACTS 1
/// `stage_ns` of putting contacts in order and keeping to the limits.
#define PONG_STAGE_ORDER 2
/// `stage_ns` of the energies, if they are kept.
#define PONG_STAGE_ENERGY 3
/// `stage_ns` of the wrenches.
#define PONG_STAGE_OUTPUT 4
/// `stage_ns` of the contact state, if the frame was committed.
#define PONG_STAGE_COMMIT 5

/// `work_ns` of laying out the work, bounding volumes and boxes.
#define PONG_WORK_BROAD_PHASE 0
/// `work_ns` of contact tests.
#define PONG_WORK_NARROW_PHASE 1
/// `work_ns` of load sharing: which contacts count, and their weights.
#define PONG_WORK_LOAD_SHARING 2
/// `work_ns` of normal and friction forces.
#define PONG_WORK_FORCES 3

/// Counts, times, memory use and flags of the last frame.
typedef struct pong_report {
    /// Limits that the last frame hit, PONG_FLAG_...; 0 if none. See pong_flag_name().
    pong_flags flags;
    /// Contacts listed.
    uint32_t contacts;
    /// Contacts before the limit was applied: the capacity to ask for after PONG_FLAG_CONTACT_LIMIT.
    uint32_t contacts_wanted;
    /// Largest `contacts_wanted` of any frame of this world.
    uint32_t peak_contacts_wanted;
    /// Pairs of bounding volumes tested.
    uint64_t volumes_tested;
    /// Pairs of leaves whose contents were tested.
    uint64_t leaf_pairs;
    /// Tests of a box with the eight boxes of a node below a leaf.
    uint64_t boxes_tested;
    /// Pairs of primitives tested. By kind: pong_get_tally().
    uint64_t primitives_tested;
    /// Evaluations since the world was made, including those made by a step or a commit.
    uint64_t evaluations;
    /// Commits since the world was made.
    uint64_t commits;
    /// Duration of the last evaluation, ns.
    uint64_t evaluate_ns;
    /// Duration of the last commit, ns, without an evaluation made by it.
    uint64_t commit_ns;
    /// With report_times: duration of each stage of the last frame, ns, at PONG_STAGE_...; else zero.
    uint64_t stage_ns[8];
    /// With report_times: processor time in each part of the work of PONG_STAGE_CONTACTS, ns, at PONG_WORK_..., the calling
    /// thread's and the workers' together: with workers the sum may be more than the stage took. By thread:
    /// pong_get_worker().
    uint64_t work_ns[4];
    /// The contact_capacity to ask for after a limit was hit in the last frame; 0 if none was. After
    /// PONG_FLAG_LOAD_SHARING_LIMIT alone it is twice the present one, and may have to be doubled again.
    uint64_t advised_capacity;
    /// Largest number of contacts that a frame of this world had to hold, including contacts that have ended
    /// and are only remembered.
    uint64_t contacts_peak;
    /// Number of contacts that there is room for: more than the contact capacity.
    uint64_t contacts_capacity;
    /// Largest memory that the testers of one part of a frame needed, bytes.
    uint64_t arena_peak;
    /// Memory available to them, bytes.
    uint64_t arena_capacity;
    /// Largest memory that sharing among the contacts of one surface needed, bytes.
    uint64_t scratch_peak;
    /// Memory available to it, bytes.
    uint64_t scratch_capacity;
    /// Rounds of work since the world was sealed that the calling thread did by itself because a worker did
    /// not come back in time. The results are the same; the frame takes longer.
    uint64_t worker_timeouts;
    /// Zero in this version.
    uint64_t reserved[3];
} pong_report;

/// Copies counts, times, memory and flags of the last frame; before the first all zero, except the capacities.
pong_status pong_get_report(const struct pong_world *world,
                            struct pong_report *report);

/// Meaning of a flag of the report, in words: "contact limit", "load sharing limit", "tunnelled", "deep in mesh";
/// "unknown limit" for a number that is no single flag. Lives as long as the library.
const char *pong_flag_name(pong_flags flag);

/// Name of a stage, PONG_STAGE_...: "input", "contacts", "order", "energy", "output", "commit"; empty for an
/// index of `stage_ns` that has no stage. Lives as long as the library.
const char *pong_stage_name(size_t stage);

/// Name of a part of the contacts' work, PONG_WORK_...: "broad phase", "narrow phase", "load sharing",
/// "forces"; empty for an index outside `work_ns`. Lives as long as the library.
const char *pong_work_name(size_t work);

/// Kind of the tests of a tally: PONG_TALLY_...
typedef uint32_t pong_tally_kind;

/// `what` of a tally of tests of the models' bounding volumes.
#define PONG_TALLY_VOLUMES 0
/// `what` of a tally of contact tests.
#define PONG_TALLY_PRIMITIVES 1

/// Tests of one kind against another in the last frame.
typedef struct pong_tally {
    /// Kind of the tests: PONG_TALLY_...
    pong_tally_kind what;
    /// Tests.
    uint32_t tested;
    /// For volumes, tests that did not find the two apart; the others were rejected. For primitives, contacts
    /// found; one test may find several.
    uint32_t met;
    /// Zero.
    uint32_t reserved;
    /// Name of A's kind, as models write it.
    char kind_a[16];
    /// Name of B's kind.
    char kind_b[16];
} pong_tally;

/// Number of tallies of the last frame: pairs of kinds with at least one test. It may differ from frame to
/// frame; 0 before the first.
pong_status pong_tally_count(const struct pong_world *world, size_t *count);

/// Copies a tally of the last frame; `index` counts from 0. Bounding volumes come first, then primitives,
/// always in the same order of kinds. The numbers are the same for any number of workers.
pong_status pong_get_tally(const struct pong_world *world, size_t index, struct pong_tally *tally);

/* ---- Diagnostics: energies ------------------------------------------------------------------------------- */

/// Energies of all contacts of a world, at the last commit.
typedef struct pong_ledger {
    /// Stored in normal springs and friction, J.
    double stored;
    /// Work done on the bodies since the world began, J, by the trapezoid rule between commits.
    double work;
    /// Energy that left the contacts for good since the world began, J: −work − stored. Forgotten energy
    /// counts as lost; energy that the host put in, by a contact that it set up or by a preload, counts as
    /// negative.
    double dissipated;
} pong_ledger;

/// Copies the energies at the last commit; work and dissipation are zero unless the configuration has
/// keep_ledger.
pong_status pong_get_ledger(const struct pong_world *world, struct pong_ledger *ledger);

/// Verdict on an energy account: PONG_VERDICT_...
typedef uint32_t pong_verdict;

/// `verdict`: less energy came out than went in.
#define PONG_VERDICT_DISSIPATED 0
/// `verdict`: as much energy came out as went in, as far as the accounts can tell.
#define PONG_VERDICT_UNRESOLVED 1
/// `verdict`: more energy came out than went in.
#define PONG_VERDICT_GAINED 2

/// Energies, J. To rounding  work_in + inserted + hold_error = work_out + stored + damping_loss + friction_loss.
typedef struct pong_energy_account {
    /// Energy that the bodies gave: work of the wrench on them, where it was negative.
    double work_in;
    /// Energy that the bodies got back: work of the wrench on them, where it was positive.
    double work_out;
    /// Energy stored without work: where the host put bodies into each other, less what it cleared. For a
    /// contact that began while its pair was already in contact: energy taken over from another contact.
    double inserted;
    /// Error of holding the wrench: its work less that of the force as it would have followed the motion.
    double hold_error;
    /// Stored in normal springs and friction now.
    double stored;
    /// Lost in normal damping.
    double damping_loss;
    /// Lost in friction.
    double friction_loss;
    /// Uncertainty of `work_out - work_in`, rounding apart; 0 except with PONG_COUPLING_STAGES.
    double resolution;
    /// Verdict: PONG_VERDICT_...
    pong_verdict verdict;
    /// Zero.
    uint32_t reserved;
} pong_energy_account;

/// Accounts of two movable groups. A contact episode lasts from their first contact until they no longer
/// touch and no delayed wrench is pending.
typedef struct pong_pair_energy_account {
    /// The pair of Objects.
    struct pong_pair_id pair;
    /// The two movable groups.
    struct pong_interface_id interfaces[2];
    /// Since the world began.
    struct pong_energy_account total;
    /// Account of the contact episode in progress; zero if there is none.
    struct pong_energy_account episode;
    /// 1: an episode is in progress. 0: none is.
    int32_t in_contact;
    /// 1: an episode, over or not, has gained energy; remedy: pong_pair_remedy(). 0: none has.
    int32_t gains_energy;
    /// Episodes that have ended.
    uint64_t episodes;
    /// Ended episodes that gained energy.
    uint64_t episodes_gained;
    /// Ended episodes whose accounts leave it open.
    uint64_t episodes_unresolved;
    /// Energy gained in all episodes together, J.
    double excess;
    /// Most energy gained in one episode, J.
    double worst_excess;
    /// Stiffness of the stiffest contact that the two can have, N/m; 0 if it depends on the depth.
    double stiffness;
    /// Damping of that contact, N s/m.
    double damping;
} pong_pair_energy_account;

/// Copies the accounts of all pairs together at the last commit; zero unless the configuration has
/// energy_accounts.
pong_status pong_get_energy_account(const struct pong_world *world, struct pong_energy_account *account);

/// Number of pairs of movable groups for which accounts are kept; 0 unless the configuration has
/// energy_accounts.
pong_status pong_pair_energy_account_count(const struct pong_world *world, size_t *count);

/// Copies the accounts of a pair of movable groups at the last commit, always in the same order; `index` counts
/// from 0.
pong_status pong_get_pair_energy_account(const struct pong_world *world,
                                         size_t index,
                                         struct pong_pair_energy_account *account);

/// Returns a remedy for a pair of movable groups that gains energy, in words with the numbers of the pair;
/// `index` as for pong_get_pair_energy_account(). The text lives until the next call of this function for the
/// world.
pong_status pong_pair_remedy(const struct pong_world *world, size_t index, const char **remedy);

/// Copies the accounts of the contacts of the last frame, each since the contact began, in the order of
/// pong_get_contacts(): the first `capacity`; `count` gets their number, which is 0 unless the configuration
/// has energy_accounts. PONG_STATUS_BUFFER_TOO_SMALL if not all fit. With capacity 0 `accounts` may be NULL.
pong_status pong_get_contact_energy_accounts(const struct pong_world *world,
                                             struct pong_energy_account *accounts,
                                             size_t capacity,
                                             size_t *count);

/* ---- Slow hosts ------------------------------------------------------------------------------------------ */
/* Optional: for hosts that call once in a long frame and hold the wrench. See docs/slow_hosts.md. */

/// Settings of a slow host. Make it with pong_default_slow_settings() and change what you like.
typedef struct pong_slow_settings {
    /// Position rule theta of the host, a fraction of 0 to 1: x1 = x0 + T v0 + theta T^2 a. 1 (default) for
    /// semi-implicit Euler, 0.5 for Runge-Kutta with the wrench held, 0 for explicit Euler.
    double theta;
    /// Substeps per radian of the fastest vibration on the contacts, 1/rad, 2 to 1e6; 12 by default.
    double substeps_per_radian;
    /// Largest number of substeps in a frame, at least 1; 20000 by default. It bounds the time of a frame: one that
    /// needs more has PONG_SLOW_SUBSTEP_LIMIT in its report.
    uint32_t substeps_max;
    /// Whole frames by which the host applies the wrench later than it could, at most 1024; 0 by default.
    uint32_t delay_frames;
    /// Zero.
    uint64_t reserved[4];
} pong_slow_settings;

/// The default settings of a slow host.
struct pong_slow_settings pong_default_slow_settings(void);

/// Answer of a movable group to an impulse: PONG_DYNAMICS_...; 0 is none of them and refused.
typedef uint32_t pong_dynamics;

/// A free rigid body with `mass`. It holds the wrench along common axes.
#define PONG_DYNAMICS_FREE 1
/// A body that joints hold, with `mobility`. It holds the wrench along the axes of the group, which turn with it.
#define PONG_DYNAMICS_JOINTED 2
/// A body that contact does not move: the ground, or a body on a prescribed path.
#define PONG_DYNAMICS_PRESCRIBED 3

/// State and dynamics of one movable group at the start of a frame of a slow host. Make it with zeros and set what its
/// dynamics need.
typedef struct pong_slow_input {
    /// The movable group.
    struct pong_interface_id interface;
    /// State at the start of the frame, as for pong_set_states().
    struct pong_state state;
    /// One of PONG_DYNAMICS_...; must be set.
    pong_dynamics dynamics;
    /// Zero.
    uint32_t reserved;
    /// With PONG_DYNAMICS_FREE: mass and inertia, both positive, and mass centre.
    struct pong_mass mass;
    /// With PONG_DYNAMICS_JOINTED: velocity of the group's origin (linear, then angular) per impulse (linear, then
    /// angular, about the origin) as the joints let it move, 1/kg, 1/(kg m) and 1/(kg m^2), by rows, along the axes of
    /// the group. Symmetric, without negative eigenvalues; singular where joints hold.
    double mobility[36];
    /// Acceleration without contact, m/s^2, along common axes: of the mass centre of a free body, otherwise of the
    /// group's origin, with the centripetal part. Gravity, thrusters and forces of joints are in it.
    double linear_acceleration[3];
    /// Angular acceleration without contact, rad/s^2, along common axes.
    double angular_acceleration[3];
} pong_slow_input;

/// Velocity that an impulse on one jointed group gives another one, because joints connect them.
typedef struct pong_slow_coupling {
    /// The group that moves.
    struct pong_interface_id of;
    /// The group that gets the impulse.
    struct pong_interface_id by;
    /// Velocity of the origin of `of` (linear, then angular), along its axes, per impulse on `by` (linear, then angular,
    /// about its origin), along the axes of `by`; 1/kg, 1/(kg m) and 1/(kg m^2), by rows. That of `by` per impulse on
    /// `of` is the transpose.
    double mobility[36];
} pong_slow_coupling;

/// Warnings of a frame of a slow host: a sum of PONG_SLOW_....
typedef uint32_t pong_slow_warnings;

/// The contacts needed more substeps than `substeps_max`.
#define PONG_SLOW_SUBSTEP_LIMIT 1
/// The substeps were too few to follow the contacts at all. The wrench is that of one implicit step, which gains no
/// energy and gives no rebound.
#define PONG_SLOW_UNRESOLVED 2
/// A body left what it touched and touched something else within the frame. The host sees the mean of both.
#define PONG_SLOW_MET_ANOTHER 4
/// theta as measured from the motion differs from the setting by more than 0.1: energy is gained without bound.
#define PONG_SLOW_THETA_MISMATCH 8
/// The velocity nearest to the copies would have had too much energy, and was reduced.
#define PONG_SLOW_ENERGY_LIMITED 16

/// Report of the last frame of a slow host.
typedef struct pong_slow_report {
    /// Substeps taken.
    uint32_t substeps;
    /// Substeps that the contacts need.
    uint32_t substeps_wanted;
    /// Evaluations of the engine, those of the substeps included.
    uint32_t evaluations;
    /// Sum of PONG_SLOW_....
    pong_slow_warnings warnings;
    /// Sum of PONG_FLAG_... of all substeps.
    pong_flags flags;
    /// Contacts of the copies at the end of the frame.
    uint32_t contacts;
    /// Number of movable groups: that of the entries of pong_get_slow_differences().
    uint32_t groups;
    /// Zero.
    uint32_t reserved_flags;
    /// Largest rate of the contacts in the frame, rad/s; 0 if nothing touched.
    double rate;
    /// The fraction theta as the motion since the last frame shows it; not a number (NaN) without acceleration.
    double theta_measured;
    /// Sum of the inserted energies of all groups, J.
    double inserted;
    /// Zero.
    uint64_t reserved[4];
} pong_slow_report;

/// Difference between what the host did and what the last frame predicted, for one movable group. With delay frames
/// both are carried forward to the time at which the wrench of this frame acts.
typedef struct pong_slow_difference {
    /// The movable group.
    struct pong_interface_id interface;
    /// Found minus predicted leading position, m (docs/theory.md, 9): of the mass centre of a free body along common
    /// axes, of the origin of a jointed one along the axes of the group.
    double position[3];
    /// Found minus predicted orientation as a rotation vector, rad, along the same axes.
    double rotation[3];
    /// Found minus predicted linear velocity, m/s, along the same axes.
    double linear_velocity[3];
    /// Found minus predicted angular velocity, rad/s, along the same axes.
    double angular_velocity[3];
    /// Energy that this difference inserted, J. 0 in the first frame.
    double inserted;
} pong_slow_difference;

/// Contact for a host that calls once in a long frame: a clone of a world, in which copies of the bodies follow the
/// contacts with short substeps. Opaque. Threads as for a world.
typedef struct pong_slow_host pong_slow_host;

/// Makes a slow host of a clone of a sealed world, with the same ids, surfaces, pairs and contact state. Later changes of
/// the world do not reach it, and the world may be destroyed before it; `user` data of laws must live as long. It is
/// the caller's: destroy it with pong_destroy_slow_host(). On failure `host` gets NULL. After sealing.
pong_status pong_create_slow_host(const struct pong_world *world,
                                  const struct pong_slow_settings *settings,
                                  struct pong_slow_host **host);

/// Destroys a slow host. NULL is allowed and does nothing. No other call on it may follow. PONG_STATUS_BUSY and
/// PONG_STATUS_WORKER_LEFT as for pong_destroy_world().
pong_status pong_destroy_slow_host(struct pong_slow_host *host);

/// Sets the couplings of jointed groups for the frames that are evaluated from now on: all `n` of them, in place of those of
/// the last call. Groups that are not coupled do not move by the impulses of each other. Give them anew where the joints
/// have moved. With n = 0 `couplings` may be NULL.
///
/// PONG_STATUS_BAD_VALUE: a coupling of a group with itself, given twice, or not finite; the couplings stay as they were.
/// That its groups are not jointed, or that the whole mobility has a negative eigenvalue, says pong_evaluate_slow().
pong_status pong_set_slow_couplings(struct pong_slow_host *host,
                                    const struct pong_slow_coupling *couplings,
                                    size_t n);

/// Computes the wrenches to hold over a frame of `length`, s: the time until the next call. `inputs` has one entry for
/// each movable group of the world, in any order. Affects no later evaluate or commit; after a failure there is no frame
/// to commit. Allocates.
///
/// PONG_STATUS_BAD_VALUE: the length is not positive; a group is missing or given twice; dynamics are none of
/// PONG_DYNAMICS_...; a mass is not positive, an inertia not positive definite, a mobility not symmetric or with a
/// negative eigenvalue; an acceleration is not finite. PONG_STATUS_BAD_STATE as for pong_set_states().
/// PONG_STATUS_LAW_FAILED: the frame does not count.
pong_status pong_evaluate_slow(struct pong_slow_host *host,
                               double length,
                               const struct pong_slow_input *inputs,
                               size_t n);

/// Accepts the frame that was evaluated last: the only call that changes what is kept between frames.
/// PONG_STATUS_WRONG_PHASE if there is none.
pong_status pong_commit_slow(struct pong_slow_host *host);

/// pong_evaluate_slow() and pong_commit_slow(), for hosts that call once a frame. Errors as for pong_evaluate_slow();
/// nothing is committed then.
pong_status pong_step_slow(struct pong_slow_host *host,
                           double length,
                           const struct pong_slow_input *inputs,
                           size_t n);

/// Copies the wrenches to hold of the last frame on `n` movable groups, N and N m, about the origin of each, for the
/// orientation at the start of the frame. Take PONG_REFERENCE_FRAME_COMMON for a free body, which holds the wrench along
/// these axes, and PONG_REFERENCE_FRAME_GROUP for a jointed one. The arrays must not share memory; with n = 0 they may be
/// NULL. PONG_STATUS_WRONG_PHASE before the first frame.
pong_status pong_get_slow_wrenches(const struct pong_slow_host *host,
                                   const struct pong_interface_id *interfaces,
                                   pong_reference_frame frame,
                                   struct pong_wrench *wrenches,
                                   size_t n);

/// Copies the report of the last frame; before the first all zero, and theta_measured not a number.
pong_status pong_get_slow_report(const struct pong_slow_host *host, struct pong_slow_report *report);

/// Copies, for each movable group, what the host did otherwise than the last frame had predicted, in the order of the
/// world: the first `capacity`; `count` gets their number, which is 0 before the first frame.
/// PONG_STATUS_BUFFER_TOO_SMALL if not all fit. With capacity 0 `differences` may be NULL.
pong_status pong_get_slow_differences(const struct pong_slow_host *host,
                                      struct pong_slow_difference *differences,
                                      size_t capacity,
                                      size_t *count);

/// Size of the largest state that this slow host can save, bytes. It never changes.
pong_status pong_slow_state_size(const struct pong_slow_host *host, size_t *size);

/// Saves all that a slow host keeps between frames, the contact state and the wrenches on their way included, into the
/// caller's buffer of `size` bytes; `used`, which may be NULL, gets the number of bytes written. A buffer of
/// pong_slow_state_size() bytes is always large enough. The bytes hold no pointer. Allocates.
/// PONG_STATUS_BUFFER_TOO_SMALL: the message has the size.
pong_status pong_save_slow_state(const struct pong_slow_host *host,
                                 void *buffer,
                                 size_t size,
                                 size_t *used);

/// Restores a state that was saved by this slow host or by one of a world built by the same calls: exactly the bytes
/// that saving wrote. PONG_STATUS_BAD_STATE_BLOCK: it is damaged or of another scene; the slow host keeps the state it
/// had. Allocates.
pong_status pong_restore_slow_state(struct pong_slow_host *host,
                                    const void *buffer,
                                    size_t size);

#ifdef __cplusplus
}  /* extern "C" */
#endif

#endif  /* PONG_H */
