//! State in, wrench out: the contact engine.
//!
//! A [`WorldBuilder`] takes models, Objects and pairs; [`WorldBuilder::seal`] makes a [`World`] of them,
//! which computes frames:
//!
//! | stage of a frame | file | from → to |
//! |---|---|---|
//! | state in | `frame/input/mod.rs` | host's states → checked states of the movable groups |
//! | relative | `frame/input/relative.rs` | states → relative motion of every pair of movable groups |
//! | broad phase | `frame/broad_phase/` | trees of bounding volumes → pairs of leaves that may touch |
//! | narrow phase | `frame/narrow_phase/` | pairs of primitives → contact candidates |
//! | load sharing | `frame/load_sharing/` | candidates of one element with one surface → weights |
//! | forces | `frame/forces/` | contacts → normal and friction forces, new contact state |
//! | reduce | `frame/output/reduce.rs` | forces → wrenches, summed in key order |
//!
//! *Evaluate* has no effect on later calls; *commit* is the only writer of contact state; *step* is both. The
//! engine never opens a file and never reads a clock.
//!
//! No frame does an invalid operation (∞ − ∞, 0·∞, 0/0, the root of a negative number) or divides by zero,
//! not even in unused lanes, because a host may trap these. Nor does anything overflow, except a wrench that
//! is then refused. Underflow and inexact results are no fault. A compiler may divide before the branch that
//! excludes a zero, so such a divisor must be one that cannot be zero: `x.max(f64::MIN_POSITIVE)`, or
//! `pong_geometry::divisor`.

#![forbid(unsafe_code)]

/// Text of the README, whose example runs with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

mod builder;
mod contact;
mod distance;
mod energy;
mod error;
mod frame;
mod ids;
pub mod inspect;
mod law;
mod pair_monitor;
mod report;
mod runtime;
mod scene;
mod seal;
mod state;
mod tangent;
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
    CombineError, ContactTangent, FrictionProps, NormalForce, NormalInput, NormalProps, NormalTangent,
    PairProps, combine as combine_surfaces,
};
pub use pair_monitor::{ContactChange, PairMonitor, PairPeaks};
pub use pong_threads::{ThreadWork, WorkerStart};
pub use report::{
    DeepInMeshReport, FrameCounts, FrameReport, MemoryReport, Stage, StageTimes, StatusBits, Tally,
    TunnellingReport, Work, WorkTimes,
};
pub use scene::{Config, Scene, State, SurfaceMotion, WorkerSettings};
pub use seal::{MetIn, SealReport, SetupNote, SetupWarning};
pub use state::StateError;
pub use tangent::{PairPotential, PairTangent, TangentMatrix};
pub use world::{Continuation, GroupDistance, NearestPrimitive, SurfaceSlope, World};
