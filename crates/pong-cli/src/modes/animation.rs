//! Shape of a mode as a response log: the bodies swing about the state, with an amplitude for the eye and without contact.

use super::arguments::Arguments;
use crate::terminal::{Failure, print};
use crate::text::number;
use pong_advise::Mode;
use pong_executive::scene::{BuiltScene, Scene};
use pong_executive::{Linearised, Motion, Pose, Quat, Simulation, Twist};
use pong_record::{ModelSource, RecordOptions, Recorder};
use std::f64::consts::TAU;

/// Number of frames in a period.
const FRAMES: u32 = 48;
/// Number of periods in the log.
const PERIODS: u32 = 4;
/// Time of a period in the log, s, whatever the frequency.
const PERIOD: f64 = 2.0;
/// Largest displacement in the log, over the largest distance of a contact from a mass centre.
const AMPLITUDE: f64 = 0.1;
/// That distance if nothing touches, m.
const REACH: f64 = 0.5;

/// Writes the log.
pub(super) fn write(
    arguments: &Arguments,
    scene: &Scene,
    built: &BuiltScene,
    (linear, mode): (&Linearised, &Mode),
) -> Result<(), Failure> {
    let Some(folder) = &arguments.log else { return Ok(()) };
    // A log begins before the first frame of its world.
    let mut player = scene.build()?;
    // Contacts at an amplitude for the eye would be far too deep.
    let pairs: Vec<_> = player.simulation.world().scene().pairs().map(|(pair, _)| pair).collect();
    for pair in pairs {
        player.simulation.world_mut().set_pair_enabled(pair, false)?;
    }
    let options = RecordOptions {
        name: format!("{}, {}", built.name, title(mode)),
        writer: concat!("pong modes ", env!("CARGO_PKG_VERSION")).to_owned(),
        commits_per_frame: Some(1),
        overwrite: arguments.overwrite,
        ..RecordOptions::default()
    };
    let models: Vec<_> = player.model_files.iter().cloned().map(ModelSource::File).collect();
    let mut log = Recorder::start(player.simulation.world(), folder, &models, &options)?;
    let scale = scale(&built.simulation, linear, mode);
    for frame in 0..=FRAMES * PERIODS {
        let phase = f64::from(frame) / f64::from(FRAMES);
        place(&mut player.simulation, &built.simulation, (linear, mode), scale * (TAU * phase).sin())?;
        player.simulation.commit_initial_states()?;
        log.evaluated();
        log.committed();
        log.record(player.simulation.world(), phase * PERIOD, 0, None)?;
    }
    log.finish()?;
    print(&format!(
        "{}: {}, in slow motion ({} s a period), largest displacement {} m; play it with `pong view {}`\n",
        folder.display(),
        title(mode),
        number(PERIOD),
        number(scale * largest(&built.simulation, linear, mode)),
        folder.display()
    ));
    Ok(())
}

fn title(mode: &Mode) -> String {
    if mode.frequency > 0.0 {
        format!("mode of {} Hz", number(mode.frequency))
    } else {
        "rigid mode".to_owned()
    }
}

/// Places all bodies at the state plus the shape times an amplitude.
fn place(
    player: &mut Simulation,
    state: &Simulation,
    (linear, mode): (&Linearised, &Mode),
    amplitude: f64,
) -> Result<(), Failure> {
    for (body, known) in state.bodies() {
        let mut pose = state.pose(body);
        if let Some(free) = linear.bodies.iter().position(|free| *free == body) {
            let arm = linear.system.bodies()[free].arm;
            let shape = &mode.shape[free];
            let turn = Quat::from_scaled_axis(shape.rotation * amplitude);
            let center = pose.position + arm + shape.translation * amplitude;
            pose = Pose { position: center - turn * arm, orientation: turn * pose.orientation };
        }
        if !matches!(known.motion, Motion::Prescribed(_)) {
            player.set_motion(body, pose, Twist::zero())?;
        }
    }
    Ok(())
}

/// Factor from the shape to the largest displacement in the log.
fn scale(state: &Simulation, linear: &Linearised, mode: &Mode) -> f64 {
    let reach = reaches(state, linear).into_iter().fold(0.0, f64::max);
    AMPLITUDE * reach / largest(state, linear, mode).max(f64::MIN_POSITIVE)
}

/// Largest displacement of a contact in the shape, m.
fn largest(state: &Simulation, linear: &Linearised, mode: &Mode) -> f64 {
    let displacement = mode
        .shape
        .iter()
        .zip(reaches(state, linear))
        .map(|(shape, reach)| shape.translation.norm() + reach * shape.rotation.norm());
    displacement.fold(0.0, f64::max)
}

/// Largest distance of a contact from the mass centre of each free body, m.
fn reaches(state: &Simulation, linear: &Linearised) -> Vec<f64> {
    let contacts = state.world().contacts();
    let reach = |free: usize| {
        let body = linear.bodies[free];
        let interface = state.bodies().find(|(known, _)| *known == body).and_then(|(_, body)| body.interface);
        let sides = contacts.iter().flat_map(|contact| [&contact.a, &contact.b]);
        let own = sides.filter(|side| Some(side.interface) == interface);
        let arm = linear.system.bodies()[free].arm;
        let far = own.map(|side| (side.arm - arm).norm()).fold(0.0, f64::max);
        if far > 0.0 { far } else { REACH }
    };
    (0..linear.bodies.len()).map(reach).collect()
}
