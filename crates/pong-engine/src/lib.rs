//! State in, wrench out: the contact engine.
//!
//! A [`WorldBuilder`] takes models, Objects and pairs; [`WorldBuilder::seal`] makes a [`World`] of them, which is run in frames:
//!
//! | stage of a frame | file | from → to |
//! |---|---|---|
//! | state in | `frame/input/states.rs` | host's states → checked states of the movable groups |
//! | relative | `frame/input/motion.rs` | states → relative motion of every pair of movable groups |
//! | broad phase | `frame/broad_phase/` | trees of bounding volumes → pairs of leaves that may touch |
//! | narrow phase | `frame/narrow_phase/` | pairs of primitives → interferences |
//! | load sharing | `frame/load_sharing/` | interferences of one ball with one surface → weights |
//! | forces | `frame/forces/` | contacts → normal and friction forces, new contact state |
//! | reduce | `frame/output/reduce.rs` | forces → wrenches, summed in key order |
//!
//! *Evaluate* changes nothing that a later call can see; *commit* is the only writer of contact state; *step* is
//! both. The engine never opens a file and never asks the time.
//!
//! No frame does an invalid operation (∞ − ∞, 0·∞, 0/0, the root of a negative number) or divides by zero, in lanes that nobody
//! looks at included: a host that traps these would see them. Nor does anything overflow, except the wrench that is refused
//! for it. What underflows or is rounded is no fault. A compiler may divide before the branch that keeps a zero out, so such
//! a divisor is one that cannot be zero: `x.max(f64::MIN_POSITIVE)`, or `pong_geometry::divisor`.

#![forbid(unsafe_code)]

mod builder;
mod contact;
mod energy;
mod error;
mod frame;
mod ids;
pub mod inspect;
mod law;
mod report;
mod runtime;
mod scene;
mod seal;
mod sealed;
mod state;
mod world;

pub use builder::{SealError, WorldBuilder};
pub use contact::{Contact, ContactSide, Ledger};
pub use energy::account::{EnergyAccount, PairEnergyAccount, Verdict, WrenchCoupling};
pub use error::EngineError;
pub use frame::FrictionPreload;
pub use frame::narrow_phase::pair_table::has_tester;
pub use ids::{InterfaceId, ModelId, ObjectId, PairId};
pub use law::friction::{FrictionForce, FrictionInput, FrictionOutput};
pub use law::registry::Laws;
pub use law::{
    CombineError, FrictionProps, NormalForce, NormalInput, NormalProps, NormalTangent, PairProps,
    combine as combine_surfaces,
};
pub use pong_threads::{LaneWork, WorkerStart};
pub use report::{
    FrameCounts, FrameReport, MemoryReport, Stage, StageTimes, StatusBits, Tally, TunnellingReport, Work,
    WorkTimes,
};
pub use scene::{Config, Scene, State, WorkerSettings};
pub use seal::{MetIn, SealReport, SetupNote, SetupWarning, leave_room_for_small_things, require_memory};
pub use state::StateError;
pub use world::World;
