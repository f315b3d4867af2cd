//! Inertia from momentum: that of simulated tosses with noise, whatever the scene says of inertia and laws; bad input.

use crate::common;
use crate::synthetic::{records, times, tosses};
use pong_fit::{Batch, Data, MomentumSettings, inertia_from_momentum};

/// Poses of tosses of the scene's cube with another inertia.
fn poses(batch: &mut Batch, factor: f64) -> Data {
    let mut starts = tosses(60, 9);
    starts.iter_mut().for_each(|(pose, _)| pose.position.z += 0.1);
    let mut data = records(batch, &[factor], &starts, &times(60, 1.0 / 148.0), 2);
    for row in data.records.iter_mut().flat_map(|record| &mut record.rows) {
        (row.velocity, row.angular_velocity) = (None, None);
    }
    data
}

fn free() -> Vec<String> {
    vec!["body.cube.inertia_factor".to_owned()]
}

#[test]
fn inertia_is_that_of_the_tosses() {
    let scene = common::tossed("momentum");
    let data = poses(&mut Batch::new(&scene, &free(), 2).unwrap(), 1.5);
    let found = inertia_from_momentum(&scene, &data, &MomentumSettings::default()).unwrap();
    assert!(found.touches >= 20, "{found:?}");
    assert!((found.factor / 1.5 - 1.0).abs() < 0.03, "{found:?}");
    assert!((found.inertia - 7e-4 * found.factor).abs() < 1e-12, "{found:?}");
    assert!(found.interval.0 < 1.5 * 7e-4 && 1.5 * 7e-4 < found.interval.1, "{found:?}");
    assert!(found.slopes.0 < found.slopes.1, "{found:?}");
    let page = found.markdown();
    assert!(page.contains("mass: 0.4, inertia: Diagonal(0.00"), "{page}");
}

#[test]
fn what_momentum_cannot_tell_is_refused() {
    let scene = common::tossed("momentum_refused");
    let data = poses(&mut Batch::new(&scene, &free(), 2).unwrap(), 1.0);
    let told = |data: &Data, settings: MomentumSettings| {
        inertia_from_momentum(&scene, data, &settings).unwrap_err().to_string()
    };
    let body = MomentumSettings { body: Some("ground".to_owned()), ..Default::default() };
    assert!(told(&data, body).contains("there is no free body `ground`; name one of: cube"));
    let long = MomentumSettings { flight: 25, ..Default::default() };
    assert!(told(&data, long).contains("two flights of 25 poses in 60 records; give at least 10"));
    let wrong = MomentumSettings { flight: 1, longest: 0, near: 0.1, confidence: 2.0, ..Default::default() };
    assert_eq!(told(&data, wrong).lines().count(), 4);
    let mut millimetres = data.clone();
    for row in millimetres.records.iter_mut().flat_map(|record| &mut record.rows) {
        row.position = row.position.map(|place| place * 1e3);
    }
    assert!(told(&millimetres, MomentumSettings::default()).contains("positions in mm"));
    let rod = common::rod("momentum_rod");
    let error = inertia_from_momentum(&rod, &data, &MomentumSettings::default()).unwrap_err().to_string();
    assert!(error.contains("a flight is no even rotation; identify it with `fit`"), "{error}");
}
