//! Studies of a ball on the ground.

mod closed_forms;
mod common;
mod logs;
mod resume;
