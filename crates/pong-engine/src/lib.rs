//! State in, wrench out: the contact engine.
//!
//! A [`World`] is set up (models → objects → pairs), sealed, and then run in frames:
//!
//! | stage of a frame | file | from → to |
//! |---|---|---|
//! | state in | `frame/state_in.rs` | host's states → checked states of the movable groups |
//! | relative | `frame/relative.rs` | states → relative motion of every pair of movable groups |
//! | bounding | `frame/bounding.rs` | trees of bounding volumes → pairs of leaves that may touch |
//! | testers | `frame/testers.rs` | pairs of primitives → interferences |
//! | sharing | `frame/sharing.rs` | interferences of one ball with one surface → weights |
//! | forces | `frame/forces.rs` | contacts → normal and friction forces, new contact state |
//! | reduce | `frame/reduce.rs` | forces → wrenches, summed in key order |
//!
//! *Evaluate* changes nothing that a later call can see; *commit* is the only writer of contact state; *step* is
//! both. The engine never opens a file and never asks the time.

#![forbid(unsafe_code)]

mod account;
pub mod advice;
mod contact;
mod dispatch;
mod error;
mod frame;
mod friction;
mod ids;
mod law;
mod registry;
mod report;
mod running;
mod scene;
mod sealed;
mod sharing;
mod state;
mod world;

pub use account::{Account, PairAccount, Verdict, WrenchUse};
pub use contact::{Contact, ContactSide, Ledger};
pub use dispatch::has_tester;
pub use error::EngineError;
pub use frame::FrictionPreload;
pub use friction::{FrictionForce, FrictionInput, FrictionOutput};
pub use ids::{InterfaceId, ModelId, ObjectId, PairId};
pub use law::{
    CombineError, FrictionProps, NormalForce, NormalInput, NormalProps, PairProps,
    combine as combine_surfaces,
};
pub use pong_threads::{LaneWork, WorkerStart};
pub use registry::Laws;
pub use report::{
    FrameCounts, FrameReport, MemoryReport, Passage, Stage, StageTimes, StatusBits, Tally, Work, WorkTimes,
};
pub use scene::{Config, State, WorkerSettings};
pub use sealed::{MetIn, SealReport, SetupNote, SetupWarning, leave_room_for_small_things, require_memory};
pub use state::StateError;
pub use world::World;
