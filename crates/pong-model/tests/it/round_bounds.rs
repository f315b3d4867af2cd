//! Bounding volumes of round parts and of chains of capsules (cables): they contain the whole body and are
//! tight.

use crate::common;
use nalgebra::UnitQuaternion;
use pong_geometry::Vec3;
use pong_geometry::bounding::{Bounded, Volume};
use pong_model::Model;
use pong_testkit::random::Random;

/// Distance by which rounding may leave a point outside, relative to the coordinates.
const ROUNDING: f64 = 1e-14;
/// Relative amount by which a volume may be larger: every volume has a margin.
const MARGIN: f64 = 1e-11;

/// Round part: ends, radii, and the thickness of a bore, m; a capsule has equal radii and spherical ends.
#[derive(Clone, Copy)]
struct Round {
    kind: &'static str,
    ends: [Vec3; 2],
    radii: [f64; 2],
    thickness: f64,
}

impl Round {
    fn random(random: &mut Random, kind: &'static str) -> Self {
        let size = random.log_between(1e-3, 1e2);
        let from = random.vector(3.0 * size);
        let axis = match random.below(3) {
            0 => random.pick(&[Vec3::x(), Vec3::y(), Vec3::z()]),
            _ => random.direction(),
        };
        let radii = [size * random.log_between(0.01, 1.0), size * random.log_between(0.01, 1.0)];
        let radii = match kind {
            "Capsule" | "Cylinder" => [radii[0]; 2],
            "Cone" if random.chance(0.3) => [0.0, radii[1]],
            _ => radii,
        };
        let ends = [from, from + axis * (size * random.log_between(0.01, 3.0))];
        Self { kind, ends, radii, thickness: size * random.log_between(0.01, 1.0) }
    }

    fn ron(&self, name: &str) -> String {
        let place = |v: &Vec3| format!("({:?}, {:?}, {:?})", v.x, v.y, v.z);
        let ends = format!("({}, {})", place(&self.ends[0]), place(&self.ends[1]));
        let [one, other] = self.radii;
        let kind = self.kind;
        match kind {
            "Capsule" | "Cylinder" => format!("{kind}(name: \"{name}\", ends: {ends}, radius: {one:?})"),
            "Cone" => format!("Cone(name: \"{name}\", ends: {ends}, radii: ({one:?}, {other:?}))"),
            _ => format!(
                "Bore(name: \"{name}\", ends: {ends}, radii: ({one:?}, {other:?}), thickness: {:?})",
                self.thickness
            ),
        }
    }

    /// End circles (spheres for a capsule) whose hull is the body. A bore is dilated by its thickness.
    fn circles(&self) -> [(Vec3, f64); 2] {
        [0, 1].map(|end| (self.ends[end], self.radii[end]))
    }

    /// Radius by which the hull is dilated, m.
    fn around(&self) -> f64 {
        if self.kind == "Bore" { self.thickness } else { 0.0 }
    }

    /// Random point of the body, often on its surface.
    fn place(&self, random: &mut Random) -> Vec3 {
        let axis = (self.ends[1] - self.ends[0]).normalize();
        let (between, inside, behind) = (random.unit(), random.unit(), random.unit());
        let along = random.pick(&[0.0, 1.0, between]);
        let part = random.pick(&[1.0, inside]);
        let circles = self.circles();
        let mixed = |a: (Vec3, f64), b: (Vec3, f64), share: f64| {
            (a.0 + (b.0 - a.0) * share, a.1 + (b.1 - a.1) * share)
        };
        let (center, radius) = mixed(circles[0], circles[1], along);
        let away = if self.kind == "Capsule" { random.direction() } else { random.across(&axis) };
        center + away * (radius * part) + random.direction() * (self.around() * random.pick(&[1.0, behind]))
    }

    /// Maximum of `direction · x` over the body, m.
    fn reach(&self, direction: &Vec3) -> f64 {
        let axis = (self.ends[1] - self.ends[0]).normalize();
        let aside =
            if self.kind == "Capsule" { 1.0 } else { (direction - axis * direction.dot(&axis)).norm() };
        let of_circle = |(center, radius): (Vec3, f64)| direction.dot(&center) + radius * aside;
        self.circles().into_iter().map(of_circle).fold(f64::NEG_INFINITY, f64::max) + self.around()
    }

    /// Extent along the axis and largest distance from it, m.
    fn extent(&self) -> (f64, f64) {
        let axis = (self.ends[1] - self.ends[0]).normalize();
        let widest = self.radii[0].max(self.radii[1]) + self.around();
        (self.reach(&axis) + self.reach(&-axis), widest)
    }
}

const KINDS: [&str; 4] = ["Capsule", "Cylinder", "Cone", "Bore"];
const BOUNDS: [&str; 3] = ["Aabb", "Sphere", "Obb"];

/// Model with the parts in one leaf, in a group that is rotated and moved in its body.
fn model(parts: &[Round], bound: &str, pose: &(Vec3, UnitQuaternion<f64>)) -> Model {
    let (at, turn) = pose;
    let parts: Vec<_> = parts.iter().enumerate().map(|(i, part)| part.ron(&format!("p{i}"))).collect();
    common::load(&format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1) }},
         root: (name: \"r\", surface: \"s\", bound: {bound}, groups: [(name: \"g\", bound: {bound},
           pose: (position: ({:?}, {:?}, {:?}), orientation: ({:?}, {:?}, {:?}, {:?})), primitives: [{}])]))",
        at.x,
        at.y,
        at.z,
        turn.w,
        turn.i,
        turn.j,
        turn.k,
        parts.join(",\n")
    ))
}

fn some_pose(random: &mut Random) -> (Vec3, UnitQuaternion<f64>) {
    (random.vector(5.0), random.orientation())
}

/// Distance of a point outside a volume, m; not positive inside.
fn outside(volume: &Volume, x: &Vec3) -> f64 {
    match volume {
        Volume::Aabb { center, half } => ((x - center).abs() - half).max(),
        Volume::Obb { center, axes, half } => (axes.tr_mul(&(x - center)).abs() - half).max(),
        Volume::Sphere { center, radius } => (x - center).norm() - radius,
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_place_of_a_round_part_is_inside_its_volumes() {
    for (stream, kind) in KINDS.into_iter().enumerate() {
        for index in 0..60 {
            let mut random = Random::new(71, stream as u64, index);
            let part = Round::random(&mut random, kind);
            let pose = some_pose(&mut random);
            for bound in BOUNDS {
                let model = model(&[part], bound, &pose);
                let body = &model.bodies[0];
                for _ in 0..200 {
                    let x = pose.0 + pose.1 * part.place(&mut random);
                    for node in &body.tree.nodes {
                        let over = outside(&node.volume, &x);
                        let size =
                            x.norm() + part.reach(&Vec3::x()).abs() + pose.0.norm() + part.ends[0].norm();
                        assert!(over <= ROUNDING * size, "{kind} {index} in {bound}: outside by {over:e} m");
                    }
                    let (low, high) = body.tree.batches[0].boxes.bounds(0);
                    assert!(low <= x && x <= high, "{kind} {index}: {x} outside of its box {low} {high}");
                }
            }
        }
    }
}

/// The axis-aligned box has the size of the body, up to rounding. The sphere is at most 1.16 times the lower
/// bound (half the diameter), and the oriented box at most 1 % larger than the box along the part's own axis.
#[test]
fn volumes_of_a_round_part_are_tight() {
    for (stream, kind) in KINDS.into_iter().enumerate() {
        for index in 0..60 {
            let mut random = Random::new(72, stream as u64, index);
            let part = Round::random(&mut random, kind);
            let pose = some_pose(&mut random);
            let volume = |bound| model(&[part], bound, &pose).bodies[0].tree.nodes[1].volume.clone();
            let size = part.ends[0].norm() + part.reach(&Vec3::x()).abs() + pose.0.norm();
            for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
                for direction in [axis, -axis] {
                    let exact = part.reach(&(pose.1.inverse() * direction)) + pose.0.dot(&direction);
                    let got = volume("Aabb").support(&direction);
                    assert!(
                        (0.0..=MARGIN * size).contains(&(got - exact + ROUNDING * size)),
                        "{kind} {index}: box {got} for {exact}"
                    );
                }
            }
            let Volume::Sphere { radius, .. } = volume("Sphere") else { panic!() };
            // For a bore: the volume around the hole, plus the thickness.
            let hole = Round { thickness: 0.0, ..part };
            let (least, behind) = (half_diameter(&hole), if kind == "Bore" { part.thickness } else { 0.0 });
            assert!(radius <= 1.16 * least + behind, "{kind} {index}: sphere {}", radius / least);
            let Volume::Obb { half, .. } = volume("Obb") else { panic!() };
            let own = own_box(&part);
            assert!(half.product() <= 1.01 * own, "{kind} {index}: turned box {}", half.product() / own);
        }
    }
}

/// Half of the largest distance between two points of the body, m: no enclosing sphere is smaller.
fn half_diameter(part: &Round) -> f64 {
    let circles = part.circles();
    let ball = part.kind == "Capsule";
    let apart = |(a, ra): (Vec3, f64), (b, rb): (Vec3, f64)| {
        let between = (a - b).norm();
        if ball { between + ra + rb } else { (between * between + (ra + rb) * (ra + rb)).sqrt() }
    };
    let pairs = circles.iter().flat_map(|&one| circles.iter().map(move |&other| apart(one, other)));
    0.5 * pairs.fold(0.0, f64::max)
}

/// Product of the half extents of the box along the axis of the part, m³.
fn own_box(part: &Round) -> f64 {
    let (length, widest) = part.extent();
    widest * widest * 0.5 * length
}

/// Cable of capsules along an arc, each beginning where the previous one ends.
fn cable(count: usize, radius: f64) -> Vec<Round> {
    let knot = |i: usize| {
        let along = i as f64 / count as f64 - 0.5;
        Vec3::new(2.0 * along, 0.6 * (1.0 - 4.0 * along * along), 0.1 * along)
    };
    let link = |i: usize| [knot(i), knot(i + 1)];
    let part = |i| Round { kind: "Capsule", ends: link(i), radii: [radius; 2], thickness: 0.0 };
    (0..count).map(part).collect()
}

/// One volume around the whole chain contains it; the axis-aligned box is exact, sphere and oriented box are
/// close to the minimum.
#[test]
fn one_volume_bounds_a_whole_cable() {
    for index in 0..20 {
        let mut random = Random::new(73, 0, index);
        let cable = cable(40, 0.01);
        let pose = some_pose(&mut random);
        let reach = |direction: &Vec3| {
            let inner = pose.1.inverse() * direction;
            let most = cable.iter().map(|link| link.reach(&inner)).fold(f64::NEG_INFINITY, f64::max);
            most + pose.0.dot(direction)
        };
        for bound in BOUNDS {
            let model = model(&cable, bound, &pose);
            let volume = &model.bodies[0].tree.nodes[0].volume;
            for _ in 0..2000 {
                let link = random.below(cable.len());
                let x = pose.0 + pose.1 * cable[link].place(&mut random);
                assert!(outside(volume, &x) <= ROUNDING * 10.0, "{bound} {index}: {}", outside(volume, &x));
            }
            match volume {
                Volume::Aabb { .. } => {
                    for d in [Vec3::x(), -Vec3::x(), Vec3::y(), -Vec3::y(), Vec3::z(), -Vec3::z()] {
                        assert!((volume.support(&d) - reach(&d)).abs() <= 10.0 * MARGIN);
                    }
                }
                // Half of the chord of 2.0025 m plus the radius.
                Volume::Sphere { radius, .. } => assert!(*radius <= 1.05 * (0.5 * 4.01_f64.sqrt() + 0.01)),
                // The arc lies in a plane: 2.0025 m along the chord, 0.6 m high.
                Volume::Obb { half, .. } => {
                    let least = (0.5 * 4.01_f64.sqrt() + 0.01) * (0.3 + 0.01) * 0.01;
                    assert!(half.product() <= 1.3 * least, "{index}: {}", half.product() / least);
                }
                other => panic!("{other:?}"),
            }
        }
    }
}
