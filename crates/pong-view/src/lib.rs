//! A response log as one web page that plays the run: bodies, contacts, forces, plots.
//!
//! The page is self-contained, so that it can be mailed, archived and opened from a disk years later. The
//! drawing scripts are in `page/`, three.js is in `vendor/` (README.md in this crate).
//!
//! | file | is |
//! |---|---|
//! | `thin.rs` | choice of the frames for the page |
//! | `tables.rs`, `origin.rs` | frames and contacts as columns of numbers |
//! | `shape.rs`, `surface.rs`, `hull.rs` | drawings of bodies |
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
