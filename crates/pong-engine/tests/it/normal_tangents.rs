//! Stiffness and damping of contacts, against closed forms and against the forces of neighbouring states.

use crate::common::own_kinds;
use crate::common::*;
use pong_engine::{Config, State, WorldBuilder};
use pong_geometry::{Quat, Vec3};
use pong_model::Extensions;

const LAWS: [&str; 9] = [
    "normal: Linear(damping: 300.0)",
    "normal: Linear(damping: 300.0, ramp: 5e-3)",
    "normal: Linear(damping: 300.0, ramp: 1e-3)",
    "normal: HuntCrossley(dissipation: 0.7, exponent: 1.0)",
    "normal: HuntCrossley(dissipation: 0.7, exponent: 1.5)",
    "normal: PowerLaw(exponent: 1.0, damping_exponent: 0.6, damping: 3e4)",
    "normal: PowerLaw(exponent: 1.5, damping_exponent: 0.25, damping: 2e3)",
    "normal: PowerLaw(exponent: 1.5, damping_exponent: 0.5, damping: 2e3)",
    "normal: PowerLaw(exponent: 1.5, damping_exponent: 1.0, damping: 4e4)",
];

/// A tip on a floor, with equal surfaces.
fn rig(law: &str) -> Rig {
    let rest = format!("{law}, friction: None");
    Rig::new(
        &model("tip", &surface(2e5, &rest), "Point(name: \"p\", position: (0.5,0,0))"),
        &model("floor", &surface(2e5, &rest), "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"),
    )
}

impl Rig {
    /// Normal force and tangent of the tip at this depth and closing rate.
    fn pressed(&mut self, depth: f64, rate: f64) -> (f64, f64, f64) {
        let tip =
            moving(Vec3::new(1.0, 2.0, -depth), Quat::identity(), Vec3::new(0.3, 0.0, -rate), Vec3::zeros());
        self.place([tip, State::identity()]);
        self.world.evaluate().unwrap();
        let tangent = self.world.normal_tangents().next().unwrap().unwrap();
        (self.world.contacts()[0].normal_force, tangent.stiffness, tangent.damping)
    }
}

#[test]
fn a_tangent_is_the_slope_of_the_force() {
    for law in LAWS {
        let mut rig = rig(law);
        for (depth, rate) in [(2e-3, 0.0), (2e-3, 0.2), (4e-3, -0.1), (7e-3, 0.5), (3e-4, 0.05)] {
            let (_, stiffness, damping) = rig.pressed(depth, rate);
            // Central differences: their error is a third derivative, 1e-8 of the value at a step of 1e-4 of
            // the depth.
            let (by_depth, by_rate) = (1e-4 * depth, 1e-3);
            let slope = |up: f64, down: f64, width: f64| (up - down) / (2.0 * width);
            let seen = [
                (
                    stiffness,
                    slope(
                        rig.pressed(depth + by_depth, rate).0,
                        rig.pressed(depth - by_depth, rate).0,
                        by_depth,
                    ),
                ),
                (
                    damping,
                    slope(
                        rig.pressed(depth, rate + by_rate).0,
                        rig.pressed(depth, rate - by_rate).0,
                        by_rate,
                    ),
                ),
            ];
            for (told, slope) in seen {
                assert!(
                    (told - slope).abs() < 1e-6 * told.abs().max(1.0),
                    "{law} {depth} {rate}: {told} {slope}"
                );
            }
        }
    }
}

#[test]
fn closed_forms() {
    // Two springs of 2e5 in series: 1e5 N/m; likewise two dampers of 300 N·s/m: 150.
    assert_eq!(rig(LAWS[0]).pressed(2e-3, 0.2).1, 1e5);
    assert!((rig(LAWS[0]).pressed(2e-3, 0.2).2 - 150.0).abs() < 1e-10);
    // The slope of the power law's damper is nearly unbounded here.
    let touching = rig(LAWS[6]).pressed(1e-300, 0.2);
    assert!(touching.1.is_finite() && touching.2.is_finite(), "{touching:?}");
    // A force that is cut at zero, at fast separation, has no slope.
    assert_eq!(rig(LAWS[0]).pressed(1e-3, -9.0), (0.0, 0.0, 0.0));
}

#[test]
fn shares_of_one_spring_add_up_to_it_and_none_is_told_of_a_law_of_the_hosts() {
    // A segment that lies flat: half a spring at each end.
    let own = surface(2e5, "normal: Linear(damping: 300.0), friction: None");
    let mut rig = Rig::new(
        &model("rod", &own, "LineSegment(name: \"l\", ends: ((-0.5,0,0), (0.5,0,0)))"),
        &model("floor", &own, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"),
    );
    rig.place_a(Vec3::new(1.0, 2.0, -2e-3), Quat::identity());
    rig.world.evaluate().unwrap();
    let told: Vec<f64> = rig.world.normal_tangents().map(|tangent| tangent.unwrap().stiffness).collect();
    assert_eq!(told, [5e4, 5e4]);
    assert_eq!(rig.world.normal_tangents().count(), rig.world.contact_count());

    let own = surface(2e5, "normal: Custom(name: \"quadratic\", parameters: [1e9]), friction: None");
    let mut builder = WorldBuilder::with_extensions(Config::default(), Extensions::new(), own_kinds::laws());
    let texts = [
        model("tip", &own, "Point(name: \"p\", position: (0,0,0))"),
        model("floor", &own, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"),
    ];
    let models = texts.map(|text| load(&mut builder, &text));
    let objects =
        [("a", models[0]), ("b", models[1])].map(|(name, id)| builder.create_object(id, name).unwrap());
    builder.pair(objects[0], objects[1]).unwrap();
    let tip = builder.scene().interface(objects[0], "").unwrap();
    let floor = builder.scene().interface(objects[1], "").unwrap();
    let (mut world, _) = builder.seal().unwrap();
    let deep = at(Vec3::new(0.0, 0.0, -1e-3), Quat::identity());
    world.set_states(&[(tip, deep), (floor, State::identity())]).unwrap();
    world.evaluate().unwrap();
    assert_eq!(world.normal_tangents().collect::<Vec<_>>(), [None]);
}
