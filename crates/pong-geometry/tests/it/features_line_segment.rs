//! Properties of LineSegment–Polyhedron (docs/theory.md, 2.3, "what must come out of it").
//!
//! Degenerate cases: bars exactly parallel to a face, along its normal, over the seam between two pieces, lying on
//! a face's edge.

use crate::common::{
    Random, cuboid, cuboid_corners, hull, hull_with_walls, moved, random_motion, scaled, stretched_hull,
};
use crate::oracle_support;
use crate::oracle_support::{Worst, close_lower_walls, join_pieces};
use pong_geometry::interference::line_segment_polyhedron::line_segment_polyhedron;
use pong_geometry::primitive::{LineSegment, Polyhedron};
use pong_geometry::{Transform, Vec3, Wrench};

fn bar(a: Vec3, b: Vec3) -> LineSegment {
    LineSegment { ends: [a, b] }
}

/// Force and moment about the frame's origin on a bar of stiffness 1, and the stored energy.
fn push(segment: &LineSegment, shapes: &[Polyhedron]) -> (Wrench, f64) {
    let (mut wrench, mut energy) = (Wrench::zero(), 0.0);
    for shape in shapes {
        for contact in line_segment_polyhedron(segment, shape).iter().flatten() {
            wrench += Wrench::of_force_at(contact.normal_b * (0.5 * contact.depth), &contact.deepest_b);
            energy += 0.25 * contact.depth * contact.depth;
        }
    }
    (wrench, energy)
}

fn brick() -> Polyhedron {
    cuboid(Vec3::new(-1.0, -0.8, -0.6), Vec3::new(1.0, 0.8, 0.0))
}

#[test]
fn a_bar_lying_flat_carries_all_of_it() {
    let mut random = Random(601);
    let mut worst = Worst::new("flat bar: force, moment about its middle");
    for _ in 0..3000 {
        let motion = random_motion(&mut random, 2.0);
        let shape = [moved(&brick(), &motion)];
        let angle = random.between(0.0, 6.3);
        let along = Vec3::new(angle.cos(), angle.sin(), 0.0);
        let middle =
            Vec3::new(random.between(-0.5, 0.5), random.between(-0.3, 0.3), -random.between(1e-6, 0.05));
        let half = random.between(0.05, 0.45);
        let segment = bar(middle - along * half, middle + along * half).carried(&motion);
        let (wrench, energy) = push(&segment, &shape);
        let depth = -middle.z;
        let normal = motion.vector(&Vec3::z());
        worst.note((wrench.force - normal * depth).norm(), 1e-14);
        worst.note((wrench.moment - motion.point(&middle).cross(&wrench.force)).norm(), 1e-14);
        worst.note((energy - 0.5 * depth * depth).abs(), 1e-14);
    }
}

/// If energy bounds overflow, every face is tested: the result is the same, scaled.
#[test]
fn a_scene_beyond_all_scenes_is_answered_as_a_small_one() {
    let mut random = Random(613);
    let shapes =
        [brick(), stretched_hull(14, Vec3::new(1.0, 0.8, 0.6)), stretched_hull(40, Vec3::repeat(1.0))];
    for scale in [f64::exp2(280.0), f64::exp2(-280.0)] {
        let large = shapes.each_ref().map(|shape| scaled(shape, scale));
        let mut touching = 0;
        for round in 0..2000 {
            let (shape, large) = (&shapes[round % 3], &large[round % 3]);
            let segment =
                bar(random.direction() * random.unit(), random.direction() * random.between(0.5, 1.5));
            let grown = bar(segment.ends[0] * scale, segment.ends[1] * scale);
            let [near, far] =
                [line_segment_polyhedron(&segment, shape), line_segment_polyhedron(&grown, large)];
            for (near, far) in near.iter().zip(&far) {
                assert_eq!(near.is_some(), far.is_some(), "{segment:?}");
                let (Some(near), Some(far)) = (near, far) else { continue };
                touching += 1;
                assert_eq!((near.depth * scale, near.feature), (far.depth, far.feature), "{segment:?}");
                assert_eq!(
                    (near.normal_b, near.deepest_b * scale),
                    (far.normal_b, far.deepest_b),
                    "{segment:?}"
                );
            }
        }
        assert!(touching > 1000);
    }
    // A short segment in such a solid.
    let short = bar(Vec3::new(0.5, 0.25, -0.25), Vec3::new(0.75, 0.25, -0.25));
    let large = scaled(&brick(), f64::exp2(280.0));
    assert_eq!(line_segment_polyhedron(&short, &large), line_segment_polyhedron(&short, &brick()));
}

/// Least overlap over all directions in which a segment and a convex solid can touch.
fn minimum_translation(segment: &LineSegment, shape: &Polyhedron) -> (f64, Vec3) {
    let along = segment.ends[1] - segment.ends[0];
    let crossings = shape.edges.iter().flat_map(|edge| {
        let n = edge.direction.cross(&along).normalize();
        [n, -n]
    });
    let faces = shape.faces.iter().map(|face| face.normal);
    let overlap = |n: &Vec3| {
        let top = shape.vertices.iter().map(|v| n.dot(&v.position)).fold(f64::NEG_INFINITY, f64::max);
        top - n.dot(&segment.ends[0]).min(n.dot(&segment.ends[1]))
    };
    faces.chain(crossings).map(|n| (overlap(&n), n)).min_by(|a, b| a.0.total_cmp(&b.0)).expect("directions")
}

#[test]
fn a_tip_or_one_crossing_is_the_minimum_translation() {
    let mut random = Random(602);
    let mut worst = Worst::new("single contact: depth and normal of the minimum translation");
    let (mut tips, mut crossings, mut steps) = (0, 0, 0);
    let shape = moved(&brick(), &random_motion(&mut random, 1.0));
    let middle = shape.vertices.iter().map(|v| v.position).sum::<Vec3>() / 8.0;
    let mut rounds = 0;
    while tips < 2000 || crossings < 2000 {
        rounds += 1;
        assert!(rounds < 1_000_000, "{tips} tips, {crossings} crossings: single contacts have become rare");
        let place = middle + random.direction() * random.between(0.3, 1.4);
        let along = random.direction() * random.between(0.1, 1.5);
        let segment = bar(place - along, place + along);
        let contacts = line_segment_polyhedron(&segment, &shape);
        let ([Some(contact), None] | [None, Some(contact)]) = contacts else { continue };
        let (least, normal) = minimum_translation(&segment, &shape);
        // Shallow contacts only: deep inside, the halves of two faces compete.
        if contact.depth > 0.05 {
            continue;
        }
        if contact.feature.is_face() {
            tips += 1;
        } else {
            crossings += 1;
        }
        if (contact.depth - least).abs() > 1e-13 {
            // Allowed differences: a tip over the polygon but nearer to an edge than it is deep, to second
            // order; and a crossing that cuts off a vertex.
            let foot = contact.deepest_b + contact.normal_b * contact.depth;
            let to_vertex =
                shape.vertices.iter().map(|v| (v.position - foot).norm()).fold(f64::INFINITY, f64::min);
            assert!(least < contact.depth);
            if contact.feature.is_face() {
                assert!(least >= contact.depth * contact.normal_b.dot(&normal) - 1e-13);
            } else {
                assert!(to_vertex < 4.0 * contact.depth, "{segment:?}");
            }
            steps += 1;
            continue;
        }
        worst.note((contact.depth - least).abs(), 1e-13);
        worst.note((contact.normal_b - normal).norm(), 1e-10);
    }
    println!("{tips} tips, {crossings} crossings, {steps} beside an edge or vertex");
    assert!(steps * 50 < tips);
}

/// Tilting through parallel: short, ending within the face, overhanging on one side, extending on both.
#[test]
fn the_wrench_is_continuous_through_parallel() {
    let mut worst = Worst::new("tilt through parallel: step beyond the slope, over the depth");
    let shape = [brick()];
    let depth = 1e-3;
    for (from, to) in [(-0.02, 0.02), (-0.7, 0.9), (-0.5, 1.6), (-1.7, 0.4), (-1.8, 1.5), (-30.0, 0.3)] {
        for yaw in [0.0, 0.3] {
            let at = |tilt: f64| {
                let along = Vec3::new(f64::cos(yaw), f64::sin(yaw), 0.0);
                let along = (along + Vec3::z() * tilt).normalize();
                // About the middle of the part over the face.
                let middle = Vec3::new(0.5 * (f64::max(from, -1.0) + f64::min(to, 1.0)), 0.0, -depth);
                let pivot = middle - Vec3::new(yaw.cos(), yaw.sin(), 0.0) * middle.x;
                push(&bar(pivot + along * from, pivot + along * to), &shape).0
            };
            let flat = at(0.0);
            assert!((flat.force - Vec3::z() * depth).norm() < 1e-15, "{from} {to}: {flat:?}");
            for power in 4..14 {
                let tilt = 10.0_f64.powi(-power);
                for tilt in [tilt, -tilt] {
                    let turned = at(tilt);
                    // Slope: ends move by the tilt times their distance over the face.
                    let slope = 10.0 * tilt.abs();
                    worst.note((turned.force - flat.force).norm() - slope, depth * 1e-9);
                    worst.note((turned.moment - flat.moment).norm() - slope, depth * 1e-9);
                }
            }
            // No other step nearby: changes of at most second order in the tilt.
            let step = 2e-7;
            let mut before = at(-8e-4);
            for i in -3999..4000 {
                let tilt = f64::from(i) * step;
                let here = at(tilt);
                let allowed = 20.0 * step + 4.0 * tilt * tilt;
                worst.note((here.force - before.force).norm() - allowed, 0.0);
                worst.note((here.moment - before.moment).norm() - allowed, 0.0);
                before = here;
            }
        }
    }
}

#[test]
fn a_bar_that_passes_right_through_does_no_work_along_itself() {
    let mut random = Random(604);
    let mut worst = Worst::new("through: force along the bar, change as it slides");
    let shape = [moved(&brick(), &random_motion(&mut random, 1.0))];
    let middle = shape[0].vertices.iter().map(|v| v.position).sum::<Vec3>() / 8.0;
    let mut count = 0;
    while count < 5000 {
        let along = random.direction();
        let place = middle + random.direction() * random.between(0.0, 0.9);
        let segment = |slide: f64| bar(place + along * (slide - 4.0), place + along * (slide + 4.0));
        let (wrench, energy) = push(&segment(0.0), &shape);
        if energy == 0.0 {
            continue;
        }
        count += 1;
        worst.note(wrench.force.dot(&along).abs(), 1e-13);
        for slide in [-0.5, 1e-3, 0.7] {
            let (other, stored) = push(&segment(slide), &shape);
            worst.note((other.force - wrench.force).norm(), 1e-13);
            worst.note((other.moment - wrench.moment).norm(), 1e-13);
            worst.note((stored - energy).abs(), 1e-13);
        }
    }
}

/// Bar in a pose of six numbers: translation and rotation vector about its middle.
fn posed(rest: &LineSegment, pose: &[f64; 6]) -> LineSegment {
    let turn = Vec3::new(pose[3], pose[4], pose[5]);
    let rotation = nalgebra::Rotation3::new(turn).into_inner();
    rest.carried(&Transform { rotation, translation: Vec3::new(pose[0], pose[1], pose[2]) })
}

/// The force is the derivative of the energy wherever the energy is smooth.
#[test]
fn the_wrench_is_the_slope_of_the_energy() {
    let mut random = Random(605);
    let mut worst = Worst::new("slope of the energy");
    let shape = [brick()];
    let (mut good, mut kinks) = (0, 0);
    while good < 3000 {
        let half = random.between(0.1, 1.6);
        let rest = bar(-random.direction() * half, Vec3::zeros());
        let rest = bar(rest.ends[0], -rest.ends[0]);
        let place = Vec3::from_fn(|_, _| random.between(-1.1, 1.1)).component_mul(&Vec3::new(1.0, 0.8, 0.6));
        let pose = |s: f64, direction: &[Vec3; 2]| {
            let (x, turn) = (place + direction[0] * s, direction[1] * s);
            posed(&rest, &[x.x, x.y, x.z, turn.x, turn.y, turn.z])
        };
        let direction = [random.direction(), random.direction()];
        let (wrench, energy) = push(&pose(0.0, &direction), &shape);
        if energy == 0.0 {
            continue;
        }
        let about_middle = wrench.moment - place.cross(&wrench.force);
        let expected = -(wrench.force.dot(&direction[0]) + about_middle.dot(&direction[1]));
        let h = 1e-6;
        let slopes = [h, -h].map(|s| (push(&pose(s, &direction), &shape).1 - energy) / s);
        if (slopes[0] - slopes[1]).abs() > 1e-4 {
            kinks += 1;
            continue;
        }
        good += 1;
        worst.note((0.5 * (slopes[0] + slopes[1]) - expected).abs(), 1e-8);
    }
    println!("{good} smooth, {kinks} at a kink");
    assert!(kinks < 30);
}

/// Closed paths over one edge and the faces beside it: the line integral of the work is zero.
#[test]
fn closed_paths_gain_nothing() {
    let mut random = Random(606);
    let mut worst = Worst::new("closed path: gain over the largest stored energy");
    let shape = [brick()];
    let mut paths = 0;
    while paths < 60 {
        let half = random.between(0.2, 1.5);
        let angle = random.between(0.0, 6.3);
        let along = Vec3::new(angle.cos(), angle.sin(), 0.0) * half;
        let rest = bar(-along, along);
        let corner = Vec3::new(random.between(-1.2, 1.2), random.between(-0.9, 0.9), 0.03);
        let waves: Vec<[f64; 6]> = (0..4)
            .map(|_| std::array::from_fn(|i| random.between(-1.0, 1.0) * if i == 2 { 0.04 } else { 0.1 }))
            .collect();
        let at = |u: f64| {
            let phase = u * std::f64::consts::TAU;
            let shapes = [phase.sin(), phase.cos(), (2.0 * phase).sin(), (2.0 * phase).cos()];
            let mut pose: [f64; 6] =
                std::array::from_fn(|i| waves.iter().zip(&shapes).map(|(wave, s)| wave[i] * s).sum::<f64>());
            (0..3).for_each(|i| pose[i] += corner[i]);
            posed(&rest, &pose)
        };
        let (coarse, largest) = work(&at, &shape, 4000);
        if largest < 1e-5 {
            continue;
        }
        paths += 1;
        let (fine, _) = work(&at, &shape, 16_000);
        // Remainder after refinement; the second difference bounds the error of the sum.
        worst.note((fine - (coarse - fine).abs()).max(0.0) / largest, 2e-3);
    }
}

/// Work done on the bar along a path: forces times the mean motion of its two ends, by the midpoint rule.
fn work(at: &dyn Fn(f64) -> LineSegment, shape: &[Polyhedron], steps: usize) -> (f64, f64) {
    let (mut sum, mut largest) = (0.0, 0.0_f64);
    for i in 0..steps {
        let [before, here, after] = [0.0, 0.5, 1.0].map(|s| at((i as f64 + s) / steps as f64));
        let (wrench, energy) = push(&here, shape);
        largest = largest.max(energy);
        if energy > 0.0 {
            let middle = (here.ends[0] + here.ends[1]) * 0.5;
            let travel = [0, 1].map(|end| after.ends[end] - before.ends[end]);
            let along = (here.ends[1] - here.ends[0]) * 0.5;
            let turn = along.cross(&((travel[1] - travel[0]) * 0.5)) / along.norm_squared();
            let moment = wrench.moment - middle.cross(&wrench.force);
            sum += wrench.force.dot(&((travel[0] + travel[1]) * 0.5)) + moment.dot(&turn);
        }
    }
    (sum, largest)
}

fn brick_in_pieces() -> Vec<Polyhedron> {
    let cuts = [-1.0, -0.31, 0.42, 1.0];
    let mut pieces: Vec<Polyhedron> = (0..3)
        .map(|i| {
            let (low, high) = (Vec3::new(cuts[i], -0.8, -0.6), Vec3::new(cuts[i + 1], 0.8, 0.0));
            let wall = |n: &Vec3, d: f64| n.x.abs() > 0.9 && (d.abs() - 1.0).abs() > 1e-9;
            hull_with_walls(&cuboid_corners(low, high), &wall)
        })
        .collect();
    close_lower_walls(&mut pieces);
    join_pieces(&mut pieces);
    pieces
}

#[test]
fn pieces_share_the_halves() {
    let mut random = Random(607);
    let mut worst = Worst::new("pieces: wrench of a shallow bar against that of the whole");
    let (pieces, whole) = (brick_in_pieces(), [brick()]);
    let mut crossing = 0;
    for round in 0..10_000 {
        let depth = random.between(1e-4, 0.02);
        let yaw = random.between(0.0, 6.3);
        let tilt = if round % 2 == 0 { 0.0 } else { random.between(-0.4, 0.4) * depth };
        let along = Vec3::new(yaw.cos(), yaw.sin(), tilt) * random.between(0.05, 0.5);
        let mut middle = Vec3::new(random.between(-0.45, 0.45), random.between(-0.25, 0.25), -depth);
        if round % 7 == 0 {
            middle.x = -0.31;
        }
        let segment = bar(middle - along, middle + along);
        let (one, energy) = push(&segment, &whole);
        let (many, shared) = push(&segment, &pieces);
        let ends = pieces.iter().map(|p| line_segment_polyhedron(&segment, p).iter().flatten().count());
        let counts: Vec<usize> = ends.collect();
        assert!(counts.iter().sum::<usize>() <= 2, "{counts:?}");
        crossing += usize::from(counts.iter().filter(|c| **c == 1).count() == 2);
        worst.note((one.force - many.force).norm() / depth, 1e-12);
        worst.note((one.moment - many.moment).norm() / depth, 1e-12);
        worst.note((energy - shared).abs() / (depth * depth), 1e-12);
    }
    assert!(crossing > 2000);
}

/// A bar inside an internal face, parallel to it: one piece alone carries it.
#[test]
fn a_bar_within_an_inner_wall_is_carried_once() {
    let pieces = brick_in_pieces();
    for x in [-0.31, 0.42] {
        for step in -3..=3 {
            let x = oracle_support::nudge(x, step);
            let segment = bar(Vec3::new(x, -0.3, -1e-3), Vec3::new(x, 0.4, -1e-3));
            let (wrench, energy) = push(&segment, &pieces);
            assert!((wrench.force - Vec3::z() * 1e-3).norm() < 1e-17, "{x}: {wrench:?}");
            assert!((energy - 5e-7).abs() < 1e-20);
        }
    }
}

/// Both faces of an edge that a bar crosses claim the same crossing. The end that is farther out carries it,
/// whatever the order of the faces.
#[test]
fn an_edge_is_carried_by_the_end_that_reaches_farther_out() {
    let mut random = Random(614);
    let mut crossed = [0, 0];
    for _ in 0..2000 {
        let mut corners = cuboid_corners(Vec3::new(-1.0, -0.8, -0.6), Vec3::new(1.0, 0.8, 0.0));
        let motion = random_motion(&mut random, 2.0);
        // Over the edge between the top and the side at x = 1.
        let depth = random.between(0.01, 0.1);
        let place = Vec3::new(1.0 - depth, random.between(-0.3, 0.3), -depth);
        let along = Vec3::new(1.0, random.between(-0.5, 0.5), -1.0).normalize();
        let reach = [random.between(0.5, 0.8), random.between(0.5, 0.8)];
        let segment = bar(place - along * reach[0], place + along * reach[1]).carried(&motion);
        let farther = usize::from(reach[1] > reach[0]);
        for _ in 0..4 {
            for i in (1..corners.len()).rev() {
                corners.swap(i, (random.bits() % (i as u64 + 1)) as usize);
            }
            let shape = moved(&hull(&corners), &motion);
            let contacts = line_segment_polyhedron(&segment, &shape);
            assert!(contacts[farther].is_some() && contacts[1 - farther].is_none(), "{contacts:?}");
            let turned = bar(segment.ends[1], segment.ends[0]);
            let contacts = line_segment_polyhedron(&turned, &shape);
            assert!(contacts[farther].is_none() && contacts[1 - farther].is_some(), "{contacts:?}");
            crossed[farther] += 1;
        }
    }
    assert!(crossed.iter().all(|count| *count > 1000));
}

/// A bar in a face, or with a tip on an edge, only touches: nothing carries it, in spite of rounding.
#[test]
fn a_bar_that_only_touches_is_not_carried() {
    let mut random = Random(615);
    for round in 0..3000 {
        let motion = random_motion(&mut random, 2.0);
        let shape = moved(&brick(), &motion);
        let y = random.between(-0.5, 0.5);
        let segment = match round % 3 {
            0 => bar(Vec3::new(-0.5, y, 0.0), Vec3::new(0.5, y, 0.0)),
            1 => bar(Vec3::new(-0.5, y, 0.0), Vec3::new(1.5, y, 0.0)),
            _ => bar(Vec3::new(1.0, y, 0.0), Vec3::new(0.5, y, 0.5)),
        };
        let (wrench, _) = push(&segment.carried(&motion), &[shape]);
        assert!(wrench.force.norm() < 1e-14, "round {round}: {wrench:?}");
    }
}

/// Solid whose top slopes down beyond an edge at x = 0.
fn roof(slope: f64) -> Polyhedron {
    let drop = 2.0 * slope.tan();
    let outline = [(-2.0, 0.0), (0.0, 0.0), (2.0, -drop), (2.0, -4.0), (-2.0, -4.0)];
    let corners: Vec<Vec3> =
        outline.iter().flat_map(|&(x, z)| [-1.0, 1.0].map(|y| Vec3::new(x, y, z))).collect();
    hull(&corners)
}

/// Flat on the slope, overhanging the ridge: all of kδ, as over the square edge of a box.
#[test]
fn a_flat_bar_overhanging_an_obtuse_edge_carries_all_of_it() {
    for degrees in [10.0_f64, 30.0, 60.0] {
        let slope = degrees.to_radians();
        let (normal, along) =
            (Vec3::new(slope.sin(), 0.0, slope.cos()), Vec3::new(slope.cos(), 0.0, -slope.sin()));
        let base = Vec3::new(0.0, 0.1, 0.0) - normal * 0.01;
        let (wrench, _) = push(&bar(base - along * 0.5, base + along), &[roof(slope)]);
        assert!((wrench.force - normal * 0.01).norm() < 1e-12, "{degrees}°: {wrench:?}");
    }
}

/// Steep bar whose tip is 0.25 m below the slope: it is unaffected when its line passes the ridge.
#[test]
fn energy_is_continuous_where_a_line_passes_an_obtuse_edge() {
    let shape = [roof(30_f64.to_radians())];
    let along = Vec3::new(0.5, 0.01, -0.75_f64.sqrt());
    let at = |z: f64| push(&bar(Vec3::z() * z - along, Vec3::z() * z + along * 0.5), &shape).1;
    let (above, below) = (at(1e-6), at(-1e-6));
    assert!((above - below).abs() < 1e-5, "{above:e} above, {below:e} below");
}

/// Prism of six sides, with a face on top at z = 0 from x = −0.5 to 0.5.
fn hexagon() -> Polyhedron {
    let corners: Vec<Vec3> = (0..6)
        .flat_map(|i| {
            let angle = std::f64::consts::PI / 3.0 * f64::from(i);
            [-1.0, 1.0].map(|y| Vec3::new(angle.cos(), y, angle.sin() - 0.75_f64.sqrt()))
        })
        .collect();
    hull(&corners)
}

/// Tilting through parallel on a face between obtuse edges: all of kδ at parallel and no step near it,
/// whether the bar ends within the face, overhangs one edge or both, or digs into the neighbour's side.
#[test]
fn the_wrench_is_continuous_through_parallel_between_obtuse_edges() {
    let shape = [hexagon()];
    let depth = 1e-3;
    let mut worst = Worst::new("tilt between obtuse edges: step beyond the slope, over the depth");
    for (from, to) in [(-0.2, 0.3), (-0.4, 0.8), (-0.9, 0.3), (-1.5, 1.2), (-0.501, 0.4)] {
        for yaw in [0.0, 0.2] {
            let at = |tilt: f64| {
                let along = (Vec3::new(f64::cos(yaw), f64::sin(yaw), 0.0) + Vec3::z() * tilt).normalize();
                push(&bar(along * from - Vec3::z() * depth, along * to - Vec3::z() * depth), &shape)
            };
            let (flat, stored) = at(0.0);
            assert!((flat.force - Vec3::z() * depth).norm() < 1e-15, "{from} {to}: {flat:?}");
            assert!((stored - 0.5 * depth * depth).abs() < 1e-18);
            let step = 1e-7;
            let mut before = at(-5e-4);
            for i in -4999..5000 {
                let here = at(f64::from(i) * step);
                let allowed = 10.0 * step;
                worst.note((here.0.force - before.0.force).norm() - allowed, depth * 1e-9);
                worst.note((here.0.moment - before.0.moment).norm() - allowed, depth * 1e-9);
                worst.note((here.1 - before.1).abs() - allowed * depth, 0.0);
                before = here;
            }
        }
    }
}
