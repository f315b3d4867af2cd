//! A response log as one web page that plays the run: bodies, contacts, forces, plots.
//!
//! The page holds everything it needs, so that it can be mailed, archived and opened from a disk years later. What is
//! drawn comes from `page/`, three.js from `vendor/` (README.md in this crate).
//!
//! | file | is |
//! |---|---|
//! | `thin.rs` | which frames go into the page |
//! | `tables.rs`, `origin.rs` | frames and contacts as columns of numbers |
//! | `shape.rs`, `surface.rs`, `hull.rs` | what bodies look like |
//! | `blob.rs` | columns as text |
//! | `html.rs` | the page |

#![forbid(unsafe_code)]

mod blob;
mod error;
mod html;
mod hull;
mod origin;
mod round;
mod run;
mod shape;
mod surface;
mod tables;
mod thin;

pub use error::ViewError;
pub use run::{Options, Page, page};
