//! Cost of a communication step through the FMU beside a step of the executive: 8 s of the docking, three
//! times each.
//!
//! cargo bench -p pong-fmu --bench step_cost

#[allow(dead_code, reason = "uses some of it")]
#[path = "../tests/it/support/mod.rs"]
mod support;

use pong_executive::scene::Scene;
use pong_fmu::{Fmi, Options};
use std::path::Path;
use std::time::Instant;
use support::{Importer, OK, make, scratch, unpack};

const STEPS: u32 = 16_000;
/// The step of the scene, s.
const H: f64 = 5e-4;

fn main() {
    let scene =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/idss_docking/scene_soft_capture.ron");
    let unit = unpack(&make(&scene, Fmi::V3, &Options::default()), &scratch("cost"));
    for round in 1..=3 {
        let mut executive = Scene::load(&scene).unwrap().build().unwrap().simulation;
        executive.commit_initial_states().unwrap();
        let begin = Instant::now();
        (0..STEPS).for_each(|_| executive.step().unwrap());
        let direct = begin.elapsed().as_secs_f64() / f64::from(STEPS) * 1e6;

        let mut fmu = Importer::new(&unit, false).unwrap();
        assert_eq!(fmu.begin(0.0), OK);
        let mut wrench = [0.0; 6];
        let names = ["force[1]", "force[2]", "force[3]", "moment[1]", "moment[2]", "moment[3]"];
        let references = names.map(|name| fmu.reference(&format!("target.contact_{name}")));
        let begin = Instant::now();
        for step in 0..STEPS {
            assert_eq!(fmu.do_step(f64::from(step) * H, H), OK);
            wrench = fmu.get_all(references);
        }
        let through = begin.elapsed().as_secs_f64() / f64::from(STEPS) * 1e6;
        let target = executive.bodies().find(|(_, body)| body.name == "target").unwrap().0;
        let own = executive.contact_wrench(target);
        assert_eq!(wrench[..3], *own.force.as_slice());
        let ratio = through / direct;
        println!(
            "round {round}: executive {direct:.2} µs a step, fmi3DoStep {through:.2} µs: {ratio:.2} times"
        );
    }
}
