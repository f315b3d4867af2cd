//! Tests of the executive: motion, scenes and checkpoints.

mod advice;
mod checkpoint;
mod common;
mod contact;
mod drums_over_edges;
mod exchange;
mod free_flight;
mod long_frames;
mod modes;
mod moving_surfaces;
mod resistance;
mod rolling;
mod scene_faults;
mod scene_format;
mod solids;
mod solids_jams;
mod solids_joints;
mod solids_scenes;
mod springs;
mod step_sums;
