//! Slow hosts against closed forms, energies and runs in short steps.

mod bounce;
mod rig;
