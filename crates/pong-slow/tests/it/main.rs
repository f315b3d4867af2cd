//! Slow hosts against closed forms, energies and runs in short steps.

mod block;
mod bounce;
mod calls;
mod coupled;
mod crowded;
mod dispersed;
mod hinge;
mod late;
mod rig;
