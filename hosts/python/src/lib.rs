//! `pong._pong`: the engine, its scenes, logs and cases for Python (docs/python.md).
//!
//! | file | holds |
//! |---|---|
//! | `errors.rs` | the exceptions: one for each family of errors, each with the library's message |
//! | `arrays.rs` | states and wrenches as NumPy arrays |
//! | `contacts.rs` | contacts as a structured NumPy array |
//! | `ids.rs` | models, Objects, pairs and Interfaces of a world, and their forms as arguments |
//! | `model.rs` | models |
//! | `authored.rs`, `written.rs`, `shapes.rs`, `joined.rs` | model files as data, their text and schema, checks of single shapes, joined files: python/pong/model.py |
//! | `distance.rs` | distance of two movable groups |
//! | `tangents.rs` | derivatives of wrenches and of the forces of contacts |
//! | `slow_host.rs` | wrenches for hosts that call once in a long frame |
//! | `pair_monitor.rs` | begin and end of contact, peaks over several frames |
//! | `setup.rs`, `builder.rs` | state and calls of a set-up |
//! | `sealed.rs`, `world.rs`, `world_slopes.rs` | state and calls of a sealed world: frames, derivatives of wrenches |
//! | `frame_report.rs`, `recording.rs` | reports of frames and logs of them |
//! | `scene.rs`, `simulation.rs`, `run.rs` | scenes in the built-in executive |
//! | `log.rs` | check of a log before NumPy maps its tables |
//! | `replay.rs`, `trade.rs`, `tune.rs` | logs compared, speed against accuracy, bounds and leaves |
//! | `fit.rs`, `batch.rs` | parameters from measured data; many short runs in one call |
//! | `advice.rs`, `verify.rs` | stiffness and damping for a wanted bounce; cases with known answers |

mod advice;
mod arrays;
mod authored;
mod batch;
mod builder;
mod contacts;
mod distance;
mod dynamics;
mod errors;
mod fit;
mod frame_report;
mod ids;
mod joined;
mod log;
mod model;
mod pair_monitor;
mod recording;
mod replay;
mod run;
mod scene;
mod sealed;
mod setup;
mod shapes;
mod simulation;
mod slow_host;
mod tangents;
mod trade;
mod tune;
mod verify;
mod world;
mod world_slopes;
mod written;

use pyo3::PyClass;
use pyo3::prelude::*;

/// Adds a class. Python aligns the memory of objects to 16 bytes, and PyO3 places the value there unchecked:
/// values of stricter alignment (a world is aligned to cache lines) must be boxed.
fn add_class<T: PyClass>(module: &Bound<'_, PyModule>) -> PyResult<()> {
    const { assert!(align_of::<T>() <= 16, "the class must box what it holds") };
    module.add_class::<T>()
}

#[pymodule]
fn _pong(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    errors::register(module)?;
    module.add("CONTACT_DTYPE", contacts::dtype(module.py())?)?;
    add_class::<model::Model>(module)?;
    add_class::<ids::AddedModel>(module)?;
    add_class::<ids::Object>(module)?;
    add_class::<ids::Pair>(module)?;
    add_class::<ids::Interface>(module)?;
    add_class::<setup::WorldBuilder>(module)?;
    add_class::<sealed::World>(module)?;
    add_class::<frame_report::FrameReport>(module)?;
    add_class::<distance::Distance>(module)?;
    add_class::<pair_monitor::ContactChange>(module)?;
    add_class::<pair_monitor::PairPeaks>(module)?;
    add_class::<tangents::Tangent>(module)?;
    add_class::<tangents::Potential>(module)?;
    add_class::<tangents::SurfaceSlope>(module)?;
    add_class::<slow_host::SlowHost>(module)?;
    add_class::<slow_host::SlowReport>(module)?;
    add_class::<scene::Scene>(module)?;
    add_class::<simulation::Simulation>(module)?;
    add_class::<run::Run>(module)?;
    add_class::<batch::Batch>(module)?;
    add_class::<batch::BatchRuns>(module)?;
    add_class::<fit::Fit>(module)?;
    add_class::<fit::FitParameter>(module)?;
    add_class::<fit::MomentumInertia>(module)?;
    add_class::<replay::Replay>(module)?;
    add_class::<trade::Trade>(module)?;
    add_class::<trade::Level>(module)?;
    add_class::<tune::Tuned>(module)?;
    add_class::<verify::Case>(module)?;
    add_class::<verify::Row>(module)?;
    module.add_function(wrap_pyfunction!(verify::verify, module)?)?;
    module.add_function(wrap_pyfunction!(advice::advise_contact, module)?)?;
    module.add_function(wrap_pyfunction!(replay::replay, module)?)?;
    module.add_function(wrap_pyfunction!(trade::trade, module)?)?;
    module.add_function(wrap_pyfunction!(tune::tune, module)?)?;
    module.add_function(wrap_pyfunction!(fit::identify, module)?)?;
    module.add_function(wrap_pyfunction!(fit::momentum_inertia, module)?)?;
    module.add_function(wrap_pyfunction!(log::check_log, module)?)?;
    module.add_function(wrap_pyfunction!(authored::read_authored, module)?)?;
    module.add_function(wrap_pyfunction!(authored::parse_authored, module)?)?;
    module.add_function(wrap_pyfunction!(written::write_authored, module)?)?;
    module.add_function(wrap_pyfunction!(joined::join_models, module)?)?;
    module.add_function(wrap_pyfunction!(written::model_schema, module)?)?;
    module.add_function(wrap_pyfunction!(shapes::check_polyhedron, module)?)?;
    module.add_function(wrap_pyfunction!(shapes::check_triangles, module)?)?;
    Ok(())
}
