//! Seams in any pose: a plate or a solid acts the same for any cut and rotation, with vertices in double or
//! single precision, flat or slightly folded (docs/theory.md, 2.2).

use crate::common::*;
use pong_engine::Contact;
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;

const K: f64 = 1e5;

fn steel() -> String {
    surface(K, "")
}

fn single(p: Vec3) -> Vec3 {
    p.map(|x| f64::from(x as f32))
}

fn tuple(p: &Vec3) -> String {
    format!("({:?},{:?},{:?})", p.x, p.y, p.z)
}

fn list(places: &[Vec3]) -> String {
    places.iter().map(tuple).collect::<Vec<_>>().join(",")
}

/// Sums over the contacts of one primitive of A.
struct Push {
    weights: f64,
    force: Vec3,
    deepest: f64,
    /// The largest difference of two normals.
    spread: f64,
    count: usize,
}

fn push(contacts: &[Contact], primitive: u32) -> Push {
    let own: Vec<&Contact> = contacts.iter().filter(|c| c.a.primitive == primitive).collect();
    let spread = own.iter().flat_map(|a| own.iter().map(|b| (a.normal - b.normal).norm()));
    Push {
        weights: own.iter().map(|c| c.weight).sum(),
        force: own.iter().map(|c| c.normal * c.normal_force).sum(),
        deepest: own.iter().map(|c| c.depth).fold(0.0, f64::max),
        spread: spread.fold(0.0, f64::max),
        count: own.len(),
    }
}

/// A ball and an egg, one directly above the other.
fn balls() -> String {
    model(
        "balls",
        &steel(),
        "Sphere(name: \"ball\", center: (0,0,0), radius: 1.0), \
         Ellipsoid(name: \"egg\", center: (0,0,0), semi_axes: (1.2,0.9,1.0), orientation: (0.5,0.1,-0.7,0.5))",
    )
}

/// Places both on the body with the centre at this distance from the origin, randomly rotated. For each,
/// weights and force sum to one, up to the square of the angle between the normals that share.
fn must_weigh_one(rig: &mut Rig, random: &mut Random, center: Vec3, case: &str) -> usize {
    rig.world.clear_contact_history(rig.objects[0]).unwrap();
    let turn = random.rotation();
    rig.place_a(center, turn);
    rig.world.evaluate().unwrap();
    let contacts = rig.world.contacts();
    let mut most = 0;
    for primitive in 0..2 {
        let push = push(&contacts, primitive);
        assert!(push.count > 0, "{case}: nothing carries {primitive} at {center:?}");
        let allowed = 1e-9 + push.spread * push.spread;
        assert!((push.weights - 1.0).abs() <= allowed, "{case}: weights {} {contacts:?}", push.weights);
        let force = push.force.norm() / (0.5 * K * push.deepest);
        assert!((force - 1.0).abs() <= allowed, "{case}: force {force} {contacts:?}");
        most = most.max(push.count);
    }
    most
}

/// A plate of six vertices around one, folded up by an angle at each seam, or of two triangles.
fn plate(random: &mut Random, turn: &Quat, fold: f64, in_single: bool) -> String {
    let rim = if random.unit() < 0.5 { 4 } else { 3 + (random.unit() * 5.0) as usize };
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    if random.unit() < 0.5 {
        let corners = [(-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0)];
        // Folded about the diagonal.
        let height = |(x, y): (f64, f64)| fold * (x - y).abs() / 2.0;
        vertices.extend(corners.map(|c| Vec3::new(c.0, c.1, height(c))));
        triangles.extend(["(0,1,2)".to_owned(), "(0,2,3)".to_owned()]);
    } else {
        vertices.push(Vec3::zeros());
        for k in 0..rim {
            let angle = std::f64::consts::TAU * (k as f64 + random.between(-0.2, 0.2)) / rim as f64;
            let height = fold * random.between(0.7, 1.3);
            vertices.push(Vec3::new(2.0 * angle.cos(), 2.0 * angle.sin(), height));
            triangles.push(format!("(0,{},{})", k + 1, (k + 1) % rim + 1));
        }
    }
    let place = |v: &Vec3| if in_single { single(turn * v) } else { turn * v };
    let vertices: Vec<Vec3> = vertices.iter().map(place).collect();
    let mesh = format!(
        "TriangleMesh(name: \"m\", vertices: [{}], triangles: [{}])",
        list(&vertices),
        triangles.join(",")
    );
    model("plate", &steel(), &mesh)
}

#[test]
fn plates_in_any_pose_carry_like_one_plane() {
    let mut random = Random(51);
    let mut shared = 0;
    for round in 0..2500 {
        let turn = random.rotation();
        let fold = if round % 2 == 0 { 0.0 } else { 10.0_f64.powf(random.between(-9.0, -3.0)) };
        let in_single = round % 4 >= 2;
        let mut rig = Rig::new(&balls(), &plate(&mut random, &turn, fold, in_single));
        for pose in 0..8 {
            // Directly over the seams and the vertex, within the range where the fold lets both sides push,
            // and anywhere.
            let beside = [0.0, 0.3 * fold, 0.05][pose % 3];
            let along = if pose < 4 { random.between(-0.3, 0.3) } else { 0.0 };
            let height = random.between(0.5, 0.86);
            let place = Vec3::new(along, along, height)
                + random.vector(beside).component_mul(&Vec3::new(1.0, 1.0, 0.0));
            let case = format!("round {round}, fold {fold:e}, single precision {in_single}");
            shared += usize::from(must_weigh_one(&mut rig, &mut random, turn * place, &case) > 1);
        }
    }
    println!("{shared} of 20000 poses shared");
    assert!(shared > 1000, "{shared}");
}

/// Boxes that abut at planes through the middle: cut once, twice or three times, in any order.
struct Cut {
    /// Corners of the pieces, low and high.
    pieces: Vec<[Vec3; 2]>,
    axes: usize,
}

impl Cut {
    fn new(axes: usize, random: &mut Random) -> Self {
        let mut pieces: Vec<[Vec3; 2]> = (0..1_usize << axes)
            .map(|side| {
                let is_cut = |axis: usize| axis < axes;
                let is_high = |axis: usize| side >> axis & 1 == 1;
                let low = |axis, _| if is_cut(axis) && is_high(axis) { 0.0 } else { -1.0 };
                let high = |axis, _| if is_cut(axis) && !is_high(axis) { 0.0 } else { 1.0 };
                [Vec3::from_fn(low), Vec3::from_fn(high)]
            })
            .collect();
        for k in (1..pieces.len()).rev() {
            pieces.swap(k, (random.unit() * (k + 1) as f64) as usize);
        }
        Self { pieces, axes }
    }

    fn model(&self, turn: &Quat, in_single: bool) -> String {
        let piece = |(index, [low, high]): (usize, &[Vec3; 2])| {
            let corner =
                |k: usize| Vec3::from_fn(|axis, _| if k >> axis & 1 == 1 { high[axis] } else { low[axis] });
            let place = |v: Vec3| if in_single { single(turn * v) } else { turn * v };
            let corners: Vec<Vec3> = (0..8).map(|k| place(corner(k))).collect();
            // The faces look along -z, z, -y, y, -x, x.
            let is_wall = |face: &usize| {
                let axis = 2 - face / 2;
                axis < self.axes && if face.is_multiple_of(2) { low[axis] == 0.0 } else { high[axis] == 0.0 }
            };
            let walls: Vec<String> = (0..6).filter(is_wall).map(|face| face.to_string()).collect();
            format!(
                "Polyhedron(name: \"p{index}\", vertices: [{}], faces: [[0,2,3,1],[4,5,7,6],[0,1,5,4],[2,6,7,3],\
                 [0,4,6,2],[1,3,7,5]], inactive_faces: [{}])",
                list(&corners),
                walls.join(",")
            )
        };
        let pieces: Vec<String> = self.pieces.iter().enumerate().map(piece).collect();
        model("cut", &steel(), &pieces.join(","))
    }
}

#[test]
fn abutting_boxes_in_any_pose_carry_like_one_plane() {
    let mut random = Random(52);
    let mut shared = 0;
    for round in 0..600 {
        let turn = random.rotation();
        let in_single = round % 2 == 1;
        let body = Cut::new(1 + round % 2, &mut random).model(&turn, in_single);
        let mut rig = Rig::new(&balls(), &body);
        for pose in 0..8 {
            // On the top, over the internal face between two pieces or the line between four.
            let beside = [0.0, 1e-12, 0.05][pose % 3];
            let along = if pose < 4 { random.between(-0.2, 0.2) } else { 0.0 };
            let place = Vec3::new(0.0, along, 1.0 + random.between(0.5, 0.86)) + random.vector(beside);
            let case = format!("round {round}, single precision {in_single}");
            shared += usize::from(must_weigh_one(&mut rig, &mut random, turn * place, &case) > 1);
        }
    }
    println!("{shared} of 4800 poses shared");
}

/// On internal faces between pieces, lines where four meet and the point where eight do: one contact, as deep
/// as in the whole box.
#[test]
fn a_point_where_pieces_meet_has_one_contact() {
    let mut random = Random(53);
    let movers = model(
        "movers",
        &steel(),
        "Point(name: \"p\", position: (0,0,0)), Sphere(name: \"s\", center: (0,0,0), radius: 0.1)",
    );
    for round in 0..600 {
        let turn = random.rotation();
        let in_single = round % 2 == 1;
        let cut = Cut::new(1 + round % 3, &mut random);
        let mut rig = Rig::new(&movers, &cut.model(&turn, in_single));
        for pose in 0..60 {
            // At each cut: exactly on it, off by rounding, or far from it.
            let beside = |axis: usize, random: &mut Random| match (axis < cut.axes, pose % 4) {
                (true, 0 | 1) => 0.0,
                (true, 2) => random.between(-3e-16, 3e-16),
                (true, _) if random.unit() < 0.5 => 0.0,
                _ => random.between(-0.95, 0.95),
            };
            let place = Vec3::from_fn(|axis, _| beside(axis, &mut random));
            let depth = 1.0 - place.amax();
            rig.world.clear_contact_history(rig.objects[0]).unwrap();
            rig.place_a(turn * place, random.rotation());
            rig.world.evaluate().unwrap();
            let contacts = rig.world.contacts();
            let case =
                format!("round {round}, cut {} times, single precision {in_single}, {place:?}", cut.axes);
            // Single precision moves the faces by its rounding.
            let tolerance = if in_single { 1e-6 } else { 1e-14 };
            for (primitive, expected) in [(0, depth), (1, depth + 0.1)] {
                let own: Vec<&Contact> = contacts.iter().filter(|c| c.a.primitive == primitive).collect();
                let weights: f64 = own.iter().map(|c| c.weight).sum();
                assert!((weights - 1.0).abs() < 1e-9, "{case}: {contacts:?}");
                assert!(primitive == 1 || own.len() == 1, "{case}: {contacts:?}");
                let off = own.iter().map(|c| (c.depth - expected).abs()).fold(0.0, f64::max);
                assert!(off < tolerance, "{case}: off by {off:e} {contacts:?}");
            }
        }
    }
}

/// The tip of a bar that stands upright on the line where four pieces meet, or beside it, is in one of them.
#[test]
fn a_tip_where_pieces_meet_is_in_one_of_them() {
    let mut random = Random(54);
    for round in 0..200 {
        let turn = random.rotation();
        let body = Cut::new(2, &mut random).model(&turn, round % 2 == 1);
        // Upright along that line, or leaning into one of the pieces.
        let lean = if round % 4 < 2 { Vec3::new(0.3, 0.2, 3.0) } else { Vec3::new(0.0, 0.0, 3.0) };
        let (a, b) = (Vec3::zeros(), turn * lean);
        let bar = format!("LineSegment(name: \"b\", ends: ({},{}))", tuple(&a), tuple(&b));
        let mut rig = Rig::new(&model("bar", &steel(), &bar), &body);
        for pose in 0..20 {
            let beside = if pose % 2 == 0 { Vec3::zeros() } else { random.vector(2e-16) };
            let height = random.between(0.5, 0.99);
            rig.world.clear_contact_history(rig.objects[0]).unwrap();
            rig.place_a(turn * (Vec3::z() * height + beside), Quat::identity());
            rig.world.evaluate().unwrap();
            let contacts = rig.world.contacts();
            let [tip] = &contacts[..] else { panic!("round {round}, pose {pose}: {contacts:?}") };
            let off = tip.depth - (1.0 - height);
            assert!(tip.end == 0 && off.abs() < 1e-6 && tip.weight == 0.5, "round {round}: {tip:?}");
        }
    }
}

/// A bar that lies flat below the seams of pieces is carried only by its two tips, also if single precision
/// turns the seams into slight ridges.
#[test]
fn a_bar_below_seams_is_carried_by_its_tips() {
    let mut random = Random(55);
    for round in 0..300 {
        let turn = random.rotation();
        let body = Cut::new(1 + round % 2, &mut random).model(&turn, round % 3 != 0);
        let half = Vec3::new(random.between(0.1, 0.6), random.between(-0.3, 0.3), 0.0);
        let bar =
            format!("LineSegment(name: \"b\", ends: ({},{}))", tuple(&(turn * -half)), tuple(&(turn * half)));
        let mut rig = Rig::new(&model("bar", &steel(), &bar), &body);
        for pose in 0..20 {
            let depth = random.between(1e-3, 0.1);
            let along = if pose % 2 == 0 { 0.0 } else { random.between(-0.05, 0.05) };
            rig.world.clear_contact_history(rig.objects[0]).unwrap();
            rig.place_a(turn * Vec3::new(along, along, 1.0 - depth), Quat::identity());
            rig.world.evaluate().unwrap();
            let contacts = rig.world.contacts();
            let [first, second] = &contacts[..] else { panic!("round {round}, pose {pose}: {contacts:?}") };
            assert!((first.end, second.end) == (0, 1), "round {round}: {contacts:?}");
            let off = (first.depth - depth).abs().max((second.depth - depth).abs());
            assert!(off < 1e-6, "round {round}: {contacts:?}");
        }
    }
}

/// A roof whose ridge lies in the internal face between its halves; optionally each half is cut once more,
/// across the ridge.
fn roof(cuts: &[f64]) -> String {
    let mut pieces = Vec::new();
    for (number, ends) in cuts.windows(2).enumerate() {
        let (near, far) = (ends[0], ends[1]);
        for side in [-1.0, 1.0] {
            let corners = [(side, 0.0), (0.0, 0.0), (0.0, 0.5)];
            let places: Vec<Vec3> =
                [near, far].iter().flat_map(|&y| corners.map(|(x, z)| Vec3::new(x, y, z))).collect();
            // Bottom, internal face, slope, then the two ends.
            let mut faces =
                vec![vec![0, 1, 4, 3], vec![1, 2, 5, 4], vec![2, 0, 3, 5], vec![0, 2, 1], vec![3, 4, 5]];
            if side < 0.0 {
                faces.iter_mut().for_each(|face| face.reverse());
            }
            let mut walls = vec!["1"];
            walls.extend((number > 0).then_some("3"));
            walls.extend((number + 2 < cuts.len()).then_some("4"));
            pieces.push(format!(
                "Polyhedron(name: \"p{number}{side}\", vertices: [{}], faces: {faces:?}, inactive_faces: [{}])",
                list(&places),
                walls.join(",")
            ));
        }
    }
    model("roof", &steel(), &pieces.join(","))
}

/// Beside a ridge at which an internal face ends, a point just outside the body has no contact, although the
/// slope of the piece beyond the internal face would extend above it.
#[test]
fn beyond_a_wall_that_ends_in_a_ridge_there_is_no_contact() {
    let tip = model("tip", &steel(), "Point(name: \"p\", position: (0,0,0))");
    for cuts in [&[-1.0, 1.0][..], &[-1.0, 0.1, 1.0]] {
        let mut rig = Rig::new(&tip, &roof(cuts));
        // Clearly beside the internal face and within its slack; above the slope, and below it.
        let aside =
            [(1e-7, 1e-8), (1e-12, 1e-13)].into_iter().flat_map(|(x, above)| [(x, above), (-x, above)]);
        let places = aside.flat_map(|(x, above)| [(x, above, false), (x, -above, true)]);
        for (x, above, inside) in places {
            // The slopes fall by half of the horizontal distance.
            let z = 0.5 - 0.5 * f64::abs(x) + above;
            rig.world.clear_contact_history(rig.objects[0]).unwrap();
            rig.place_a(Vec3::new(x, 0.1, z), Quat::identity());
            rig.world.evaluate().unwrap();
            assert_eq!(rig.world.contact_count(), usize::from(inside), "{cuts:?} {x:e} {inside}");
        }
    }
}

/// A ray through the fold of a two-sided sheet whose faces both lie on one side of it hits the face that
/// hides the other, as neighbouring rays do, for any rotation and either order of the triangles.
#[test]
fn a_ray_through_a_fold_meets_the_face_in_front() {
    let probe =
        model("probe", &steel(), "Ray(name: \"r\", origin: (-0.3,0.1,0), direction: (1,0,0), length: 0.5)");
    let mut random = Random(31);
    let mut hits = 0;
    for case in 0..100 {
        // The face that leans towards the origin of the ray is in front.
        let (behind, between) = (random.between(0.2, 1.5), random.between(0.2, 1.4));
        let leans = [behind + between, behind];
        let turn = if case % 2 == 0 { Quat::identity() } else { random.rotation() };
        let faces = leans.map(|angle| Vec3::new(angle.cos(), 0.0, angle.sin()));
        let ends = [Vec3::new(0.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
        let places = [
            ends[0],
            ends[1],
            ends[0] + faces[0],
            ends[1] + faces[0],
            ends[0] + faces[1],
            ends[1] + faces[1],
        ];
        let places = places.map(|place| turn * place);
        let normal = Vec3::new(-leans[0].sin(), 0.0, leans[0].cos());
        for order in ["(0,1,2),(1,3,2),(0,5,1),(0,4,5)", "(0,4,5),(0,5,1),(0,1,2),(1,3,2)"] {
            let mesh = format!(
                "TriangleMesh(name: \"m\", vertices: [{}], triangles: [{order}], two_sided: true)",
                list(&places)
            );
            let mut rig = Rig::new(&probe, &model("sheet", &steel(), &mesh));
            rig.place_a(Vec3::zeros(), turn);
            rig.world.evaluate().unwrap();
            let contacts = rig.world.contacts();
            // Rounding may let the ray pass on the side where there is no face.
            assert!(contacts.len() <= 1, "{case} {leans:?}: {contacts:?}");
            for contact in contacts {
                let off = (contact.normal - turn * normal).norm();
                assert!(off < 1e-9, "{case} {leans:?} {order}: {:?}", contact.normal);
                assert!(
                    (contact.depth - 0.2 * leans[0].sin()).abs() < 1e-9,
                    "{case} {leans:?}: {}",
                    contact.depth
                );
                hits += 1;
            }
        }
    }
    assert!(hits > 100, "only {hits} rays meet the fold");
}

/// A ball whose centre lies in the plane of a two-sided triangle, beyond an edge or a vertex of its rim, is
/// pushed once, as a ball slightly above or below is.
#[test]
fn a_rim_of_two_sides_pushes_once() {
    let ball = model("ball", &steel(), "Sphere(name: \"ball\", center: (0,0,0), radius: 0.3)");
    for corners in ["(-1,0,0),(1,0,0),(0,-1,0)", "(0,-1,0),(1,0,0),(-1,0,0)"] {
        let mesh = format!(
            "TriangleMesh(name: \"m\", vertices: [{corners}], triangles: [(0,1,2)], two_sided: true)"
        );
        let mut rig = Rig::new(&ball, &model("sheet", &steel(), &mesh));
        for (x, y, normal) in
            [(0.1, 0.05, Vec3::y()), (1.05, 0.0, Vec3::x()), (1.03, 0.04, Vec3::new(0.6, 0.8, 0.0))]
        {
            for z in [0.0, 1e-12, -1e-12] {
                rig.world.clear_contact_history(rig.objects[0]).unwrap();
                rig.place_a(Vec3::new(x, y, z), Quat::identity());
                rig.world.evaluate().unwrap();
                let force = rig.wrench(0).force;
                assert!(
                    (force - normal * (0.5 * K * 0.25)).norm() < 1e-5,
                    "{corners} {x} {y} {z:e}: {force:?}"
                );
            }
        }
    }
}

/// In the wedge behind a valley, between the prisms of its two faces, a centre farther from the line than the
/// thickness is behind neither face, in either order of the faces; a nearer one is behind both.
#[test]
fn the_wedge_behind_a_valley_ends_at_the_thickness() {
    let ball = model("ball", &steel(), "Sphere(name: \"ball\", center: (0,0,0), radius: 0.4)");
    // Rotated, so that the boxes of the ball and of both faces overlap.
    let turn = Quat::from_axis_angle(&Vec3::y_axis(), 0.8);
    let corners = [(0.0, -9.0, 0.0), (0.0, 9.0, 0.0), (-9.0, 0.0, 4.5), (9.0, 0.0, 4.5)];
    let corners = list(&corners.map(|(x, y, z)| turn * Vec3::new(x, y, z)));
    for order in ["(0,1,2),(1,0,3)", "(1,0,3),(0,1,2)"] {
        // Slopes of one to two: the prisms end at twice the depth below the line.
        let mesh = format!("TriangleMesh(name: \"m\", vertices: [{corners}], triangles: [{order}])");
        let mut rig = Rig::new(&ball, &model("valley", &steel(), &mesh));
        for (z, count) in [(-0.39, 2), (-0.41, 0)] {
            rig.world.clear_contact_history(rig.objects[0]).unwrap();
            rig.place_a(turn * Vec3::new(0.01, 0.0, z), Quat::identity());
            rig.world.evaluate().unwrap();
            assert_eq!(rig.world.contact_count(), count, "{order} {z}");
        }
    }
}
