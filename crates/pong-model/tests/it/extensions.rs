//! Kinds of primitives and volumes that a user adds.

use crate::common::model_of;
use pong_geometry::Vec3;
use pong_geometry::bounding::{CustomVolume, Volume};
use pong_geometry::primitive::CustomPrimitive;
use pong_model::Extensions;
use std::any::Any;
use std::sync::Arc;

#[derive(Debug)]
struct Torus(f64, f64);

impl CustomPrimitive for Torus {
    fn kind_name(&self) -> &str {
        "torus"
    }
    fn support(&self, d: &Vec3) -> f64 {
        self.0 * d.x.hypot(d.y) + self.1
    }
    fn as_any(&self) -> &dyn Any {
        self
    }
}

#[derive(Debug)]
struct Everything;

impl CustomVolume for Everything {
    fn kind_name(&self) -> &str {
        "everything"
    }
    fn as_any(&self) -> &dyn Any {
        self
    }
}

fn extensions() -> Extensions {
    let mut ext = Extensions::new();
    ext.add_primitive(
        "torus",
        Arc::new(|parameters| match parameters {
            [large, small] => Ok(Arc::new(Torus(*large, *small)) as Arc<dyn CustomPrimitive>),
            _ => Err(format!("a torus has two radii, not {}", parameters.len())),
        }),
    );
    ext.add_volume("everything", Arc::new(|_| Arc::new(Everything)));
    ext
}

fn rule(text: &str) -> (&'static str, u32) {
    let errors = pong_model::parse(text, "test.ron", None, &extensions()).expect_err("a fault");
    assert_eq!(errors.0.len(), 1, "{errors}");
    (errors.0[0].rule, errors.0[0].line)
}

#[test]
fn a_registered_primitive_is_made_and_bounded() {
    let text = model_of("Custom(name: \"ring\", kind: \"torus\", parameters: [2.0, 0.5])");
    let model = pong_model::parse(&text, "test.ron", None, &extensions()).expect("a good model");
    let body = &model.bodies[0];
    assert!(body.customs[0].as_any().downcast_ref::<Torus>().is_some());
    let Volume::Aabb { half, .. } = body.tree.nodes[0].volume else { panic!() };
    assert!((half - Vec3::new(2.5, 2.5, 0.5)).norm() < 1e-9, "{half}");
    let other = text.replace("0.5]", "0.25]");
    let other = pong_model::parse(&other, "test.ron", None, &extensions()).expect("a good model");
    assert_ne!(model.hash, other.hash, "the parameters decide the numbers");
}

#[test]
fn a_registered_volume_is_fitted() {
    let text = model_of("Point(name: \"p\", position: (0,0,0))")
        .replace("surface:", "bound: Custom(\"everything\"), surface:");
    let model = pong_model::parse(&text, "test.ron", None, &extensions()).expect("a good model");
    assert!(
        matches!(&model.bodies[0].tree.nodes[0].volume, Volume::Custom(v) if v.kind_name() == "everything")
    );
}

#[test]
fn what_a_factory_refuses_is_told() {
    assert_eq!(
        rule(&model_of("Custom(name: \"ring\", kind: \"torus\", parameters: [2.0])")),
        ("custom-parameters", 3)
    );
}

#[test]
fn a_custom_primitive_knows_no_pose() {
    let text = "(format: \"pong-model\", version: 1, name: \"m\", surfaces: { \"s\": (stiffness: 1) },\n\
        root: (name: \"root\", surface: \"s\", groups: [(name: \"g\", pose: (position: (1,0,0)), primitives: [\n\
        Custom(name: \"ring\", kind: \"torus\", parameters: [2.0, 0.5])])]))";
    assert_eq!(rule(text), ("custom-under-pose", 3));
}

#[test]
fn a_fitter_that_returns_another_kind_is_told() {
    let mut ext = extensions();
    ext.add_volume("liar", Arc::new(|_| Arc::new(Everything)));
    let text = model_of("Point(name: \"p\", position: (0,0,0))")
        .replace("surface:", "bound: Custom(\"liar\"), surface:");
    let errors = pong_model::parse(&text, "test.ron", None, &ext).expect_err("a fault");
    assert_eq!(errors.0[0].rule, "bound");
}
