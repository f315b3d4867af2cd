//! The C interface: names, handles, guards. No physics.
//!
//! The C side is described where C programmers read it: `include/pong.h` is generated from the comments of this
//! crate, `include/README.md` has calling order, ownership and threads. The header has sections in calling order; the
//! files of each (`tests/it/support/header/sections.rs`):
//!
//! | section of pong.h | files |
//! |---|---|
//! | Status and messages; Version | `status.rs`, `message.rs`; `abi.rs`, `version.rs` |
//! | Set-up | `handle.rs`, `coupling.rs`, `config.rs`, `world.rs`, `ids.rs`, `models.rs`, `objects.rs`, `pairs.rs`, `interfaces.rs`, `primitives.rs`, `step_plan.rs`, `seal.rs` |
//! | Frames | `states.rs`, `frames.rs` |
//! | Results | `wrenches.rs`, `contacts.rs`, `tangents.rs`, `slopes.rs`, `distance.rs`, `pair_monitor.rs` |
//! | Contact state; Changes between frames; Further worlds | `contact_state.rs`; `surfaces.rs`; `clone.rs`, `continuation.rs` |
//! | Response logs; Own force laws; User data | `log.rs`; `law_types.rs`, `laws.rs`; `user_data.rs` |
//! | Workers; Diagnostics | `worker.rs`, `workers.rs`; `report.rs`, `tally.rs`, `accounts.rs` |
//! | Slow hosts | `slow_settings.rs`, `slow_input.rs`, `slow_report.rs`, `slow_host.rs` |
//!
//! `phase.rs` keeps set-up and frames apart: it refuses calls in the wrong phase.
//!
//! Every entry, except those that return a constant, goes through `guard.rs`: a message of its own, one call
//! at a time, no panic into C, the floating-point environment of `pong-fpenv`. Entries of set-up ask for
//! their memory first (`memory.rs`). Pointers are touched in `pointers.rs` alone.
//!
//! # Safety of all entries
//!
//! A pointer is NULL or points to what its type says, for as long as the call runs; a world is one that
//! `pong_create_world` made and `pong_destroy_world` has not destroyed; text ends with a zero byte; an array has
//! as many elements as the caller says; a function may be called as its type says. Everything else is checked.
//! An entry is unsafe as a whole, by this contract: a block `unsafe` around each body would say no more.

#![allow(non_camel_case_types)] // The names are those of pong.h.
#![allow(clippy::missing_safety_doc)] // One contract for all entries, above.
#![allow(unsafe_op_in_unsafe_fn)] // As above.

pub mod abi;
pub mod accounts;
mod advice;
mod clock;
pub mod clone;
pub mod config;
pub mod contact_state;
pub mod contacts;
pub mod continuation;
pub mod coupling;
pub mod distance;
mod failure;
pub mod frames;
mod guard;
mod handle;
pub mod ids;
mod instructions;
pub mod interfaces;
mod law_adapters;
pub mod law_types;
pub mod laws;
pub mod layout;
pub mod log;
pub mod memory;
mod message;
pub mod models;
mod names;
pub mod objects;
pub mod pair_monitor;
pub mod pairs;
mod phase;
mod pointers;
pub mod primitives;
pub mod report;
pub mod seal;
pub mod slopes;
pub mod slow_host;
pub mod slow_input;
pub mod slow_report;
pub mod slow_settings;
pub mod states;
pub mod status;
pub mod step_plan;
pub mod surface_motions;
pub mod surfaces;
pub mod tally;
pub mod tangents;
pub mod user_data;
pub mod version;
mod worker;
pub mod workers;
pub mod world;
pub mod wrenches;
