//! The C interface: names, handles, guards. No physics.
//!
//! The C side is described where C programmers read it: `include/pong.h` is generated from the comments of this
//! crate, `include/README.md` tells calling order, ownership and threads. The files follow the calling order:
//!
//! | file | calls |
//! |---|---|
//! | `version.rs` | version, layout check |
//! | `status.rs`, `message.rs` | status numbers, the last message |
//! | `config.rs`, `world.rs`, `clone.rs` | create, destroy and clone a world |
//! | `phase.rs` | set-up or frames: refuses calls in the wrong phase |
//! | `laws.rs`, `law_types.rs` | force laws by callback |
//! | `models.rs`, `objects.rs`, `pairs.rs`, `interfaces.rs`, `primitives.rs` | set-up and look-up |
//! | `coupling.rs`, `step_plan.rs` | what the host does with wrenches; masses and step, for the check at the seal |
//! | `seal.rs` | end of set-up |
//! | `states.rs`, `frames.rs`, `wrenches.rs`, `contacts.rs`, `report.rs`, `accounts.rs`, `tally.rs` | frames |
//! | `distance.rs` | distance of two movable groups |
//! | `pair_monitor.rs` | begin and end of contact, peaks over several frames |
//! | `workers.rs` | workers, around frames |
//! | `contact_state.rs`, `continuation.rs`, `surfaces.rs`, `user_data.rs` | between frames |
//! | `log.rs` | response logs |
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
mod counters;
pub mod coupling;
pub mod distance;
mod failure;
pub mod frames;
mod guard;
mod handle;
mod host_data;
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
pub mod states;
pub mod status;
pub mod step_plan;
pub mod surfaces;
pub mod tally;
pub mod user_data;
pub mod version;
mod worker;
pub mod workers;
pub mod world;
pub mod wrenches;
