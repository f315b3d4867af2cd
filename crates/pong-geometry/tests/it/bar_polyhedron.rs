//! Capsules and segments on convex solids: the energy against its definition by planes, the wrench against the
//! energy, closed forms, and invariances.

use crate::common::bars::{
    bar as capsule, component, gained_along, least_from, moved, moved_by, normals_around, pushed,
    smooth_slope, stored,
};
use crate::common::{cuboid, random_motion, stretched_hull};
use pong_geometry::bounding::Bounded;
use pong_geometry::interference::bar_polyhedron::{capsule_solid, segment_solid};
use pong_geometry::interference::two_capsules::OverlapContacts;
use pong_geometry::primitive::{Capsule, LineSegment, Polyhedron};
use pong_geometry::{Vec3, Wrench};
use pong_testkit::{Random, assert_near, long_samples};

/// Contacts of A, a segment if it has no radius.
fn contacts(a: &Capsule, b: &Polyhedron) -> OverlapContacts {
    match a.radius > 0.0 {
        true => capsule_solid(a, b, &[]),
        false => segment_solid(&LineSegment { ends: a.ends }, b),
    }
}

/// Energy with a stiffness of 1 N/m.
fn energy(a: &Capsule, b: &Polyhedron) -> f64 {
    stored(&contacts(a, b))
}

/// Force on A and its moment about the origin, with a stiffness of 1 N/m.
fn wrench(a: &Capsule, b: &Polyhedron) -> Wrench {
    pushed(&contacts(a, b))
}

/// Boxes, hulls, a plate and a needle.
fn solids() -> Vec<Polyhedron> {
    let block = |x: f64, y: f64, z: f64| cuboid(Vec3::new(-x, -y, -z), Vec3::new(x, y, z));
    let hull = |count, x, y, z| stretched_hull(count, Vec3::new(x, y, z));
    vec![
        block(0.5, 0.4, 0.3),
        block(0.5, 0.5, 0.04),
        block(0.5, 0.05, 0.06),
        hull(4, 0.5, 0.5, 0.5),
        hull(7, 0.5, 0.4, 0.2),
        hull(40, 0.5, 0.4, 0.3),
    ]
}

/// A random bar near a solid, any length and radius; one in four is a segment, some are along a face or an edge.
fn random_bar(random: &mut Random, b: &Polyhedron) -> Capsule {
    let along = match random.below(4) {
        0 => b.edges[random.below(b.edges.len())].direction,
        1 => {
            let face = random.below(b.faces.len());
            random.across(&b.faces[face].normal)
        }
        _ => random.direction(),
    };
    let (half, radius) = (random.log_between(0.02, 1.0), random.log_between(0.03, 0.5));
    let radius = if random.below(4) == 0 { 0.0 } else { radius };
    let n = random.direction();
    let middle = n * (b.support(&n) + radius * random.between(-1.0, 1.0) - 0.3 * random.unit());
    let at = random.between(-1.0, 1.0);
    Capsule { ends: [middle - along * (half * (1.0 + at)), middle + along * (half * (1.0 - at))], radius }
}

/// Energy on the plane that touches B along the normal `n`.
fn on_plane(a: &Capsule, b: &Polyhedron, n: &Vec3) -> f64 {
    let top = b.support(n) + a.radius;
    a.ends.iter().map(|end| 0.25 * (top - n.dot(end)).max(0.0).powi(2)).sum()
}

/// Least energy on planes, by descent from the best of many directions, of the faces and of the middles of edges.
fn least_on_planes(a: &Capsule, b: &Polyhedron) -> f64 {
    let normals = normals_around(b);
    least_from(normals, 6, (32, 1e-9), |n| on_plane(a, b, n))
}

/// The energy is the least on any plane that has B behind it, and the plane of the contacts stores it.
#[test]
fn the_energy_is_the_least_on_a_plane_with_the_solid_behind_it() {
    let mut random = Random::new(31, 0, 0);
    let (mut touching, mut sharp) = (0, 0);
    for b in solids() {
        for case in 0..long_samples(50, 2000) {
            let a = random_bar(&mut random, &b);
            let (stored, searched) = (energy(&a, &b), least_on_planes(&a, &b));
            // The search may stop above the minimum, in a crease.
            assert!(stored <= searched * (1.0 + 1e-9) + 1e-12, "case {case}: {stored} {searched} {a:?}");
            sharp += usize::from(searched - stored > 1e-3 * searched + 1e-9);
            touching += usize::from(stored > 0.0);
            if let Some(contact) = contacts(&a, &b).iter().flatten().next() {
                let n = contact.interference.normal_b;
                let off = on_plane(&a, &b, &n) - stored;
                assert!(off.abs() <= 1e-12 + 1e-9 * stored, "case {case}: {off:e} of {stored}");
            }
        }
    }
    assert!(touching > long_samples(120, 5000) && sharp < touching / 20, "{touching} {sharp}");
}

#[test]
fn the_wrench_is_minus_the_derivative_of_the_energy() {
    const STEP: f64 = 1e-5;
    let mut random = Random::new(32, 0, 0);
    let (mut compared, mut worst) = (0, 0.0_f64);
    for case in 0..long_samples(2000, 60_000) {
        let solids = solids();
        let b = &solids[case % solids.len()];
        let a = random_bar(&mut random, b);
        let found = wrench(&a, b);
        let force = found.force.norm();
        // At a first touch, beside a ridge and where two ways out cost the same.
        let near = [-3.0, 3.0].map(|by| wrench(&moved(&a, &Vec3::zeros(), &Vec3::repeat(by * STEP)), b));
        let bends = near[0].force + near[1].force - found.force * 2.0;
        if force < 1e-3 || bends.norm() > 1e-6 * force {
            continue;
        }
        compared += 1;
        for k in 0..6 {
            let at = |by: f64| energy(&moved_by(&a, k, by), b);
            // Where the place of the load comes into another region, the curvature steps.
            let Some(found_by) = smooth_slope(at, STEP, force) else { continue };
            let part = component(&found, k);
            let off = (part + found_by).abs() / force;
            assert!(off < 1e-6, "case {case}, {k}: {part} {found_by} {a:?}");
            worst = worst.max(off);
        }
    }
    println!("W + ∂U/∂x over the force: {worst:.1e} at most, {compared} poses");
    assert!(compared > long_samples(500, 15_000), "{compared}");
}

/// Along random paths, into the solids and through them included, the work of the wrench is the energy that is stored
/// less: none appears or vanishes.
#[test]
fn paths_gain_and_lose_nothing() {
    let mut random = Random::new(33, 0, 0);
    let solids = solids();
    let (mut touching, mut worst) = (0, 0.0_f64);
    for case in 0..long_samples(200, 100_000) {
        let b = &solids[case % solids.len()];
        let a = random_bar(&mut random, b);
        let (shift, turn) = (random.vector(0.3), random.vector(0.6));
        let Some(gained) = gained_along(&a, &shift, &turn, |a| contacts(a, b)) else { continue };
        assert!(gained < 1e-9, "case {case}: {gained:e} of the largest stored {a:?}");
        worst = worst.max(gained);
        touching += 1;
    }
    println!("{touching} paths, largest gain or loss {worst:.1e} of the largest stored");
    assert!(touching > long_samples(70, 30_000), "{touching}");
}

/// An axis that passes exactly through an edge stores what it stores a little beside: rounding decides nothing.
#[test]
fn an_axis_through_an_edge_is_held_by_it() {
    let mut random = Random::new(35, 0, 0);
    let solids = solids();
    for case in 0..long_samples(600, 6000) {
        let b = &solids[case % solids.len()];
        let edge = &b.edges[random.below(b.edges.len())];
        let push = edge.push.unwrap();
        let [from, to] = edge.vertices.map(|vertex| b.vertices[vertex as usize].position);
        let place = from.lerp(&to, random.between(0.1, 0.9));
        let out = push.normals[0].lerp(&push.normals[1], random.between(0.1, 0.9)).normalize();
        let along = random.across(&out) * random.between(0.2, 1.0);
        let at = random.between(-0.4, 0.4);
        let ends = [place - along * (0.5 + at), place + along * (0.5 - at)];
        let a = Capsule { ends, radius: random.log_between(0.02, 0.2) };
        let stored = energy(&a, b);
        for by in [-1e-9, 1e-9] {
            let beside = energy(&moved(&a, &(out * by), &Vec3::zeros()), b);
            assert!((beside - stored).abs() < 1e-6 * stored, "case {case}: {stored} {beside} {a:?}");
        }
    }
}

/// Flat, on a tip, overhanging, over a rail, across an edge.
#[test]
fn known_cases_carry_what_the_rule_says() {
    let depth = 1e-3;
    let b = cuboid(Vec3::new(-0.5, -0.5, -0.5), Vec3::new(0.5, 0.5, 0.5));
    for radius in [0.0, 0.1] {
        let bar =
            |ends: [[f64; 3]; 2]| capsule(ends.map(|[x, y, z]| [x, y, z + 0.5 + radius - depth]), radius);
        let flat = |from: f64, to: f64| bar([[from, 0.0, 0.0], [to, 0.0, 0.0]]);
        // On the face with both ends, overhanging one side, both sides, and with the middle beyond the edge.
        for (from, to, force) in [(-0.3, 0.4, 1.0), (-0.3, 1.2, 1.0), (-0.9, 1.2, 1.0), (-3.0, 3.0, 1.0)] {
            let found = wrench(&flat(from, to), &b);
            assert_near(found.force.z, force * depth, 1e-12);
            assert!((found.moment.y + force * depth * 0.5 * (from + to)).abs() < 1e-12 * depth, "{found:?}");
        }
        // The middle is 0.2 m beyond the edge, of a length of 1.4 m: x = −1/7.
        let found = wrench(&flat(0.0, 1.4), &b);
        let carried = found.force.norm() / (depth * (1.0 / (1.0 + 4.0 / 49.0)));
        assert!((carried - 1.0).abs() < 0.01, "{carried}");
        // A tip.
        let standing = bar([[0.1, 0.2, 0.0], [0.1, 0.3, 1.0]]);
        assert_near(wrench(&standing, &b).force.z, 0.5 * depth, 1e-12);
        // A rail under the middle, and across its edge.
        let rail = cuboid(Vec3::new(-0.05, -2.0, 0.0), Vec3::new(0.05, 2.0, 0.5));
        assert_near(wrench(&flat(-0.5, 0.5), &rail).force.z, depth, 1e-12);
        let ridge = prism();
        for at in [0.0, 0.3, -0.2] {
            let bar = bar([[at - 0.5, 0.0, 0.0], [at + 0.5, 0.0, 0.0]]);
            let carried = wrench(&bar, &ridge).force.norm() / (depth / (1.0 + 4.0 * at * at));
            assert!((carried - 1.0).abs() < 0.01, "{at}: {carried}");
        }
    }
}

/// Prism along y with its sharp edge at z = 0.5.
fn prism() -> Polyhedron {
    let corners = [(-0.5, 0.0), (0.5, 0.0), (0.0, 0.5)];
    let ends = [-1.0, 1.0].map(|y| corners.map(|(x, z)| Vec3::new(x, y, z)));
    crate::common::hull(&ends.concat())
}

/// A bar that tilts through lying flat: overhanging neither side, one side and both sides of a block, and passing out
/// over an edge, force and moment do not step.
#[test]
fn the_wrench_is_continuous_through_lying_flat() {
    let b = cuboid(Vec3::new(-0.5, -0.5, -0.5), Vec3::new(0.5, 0.5, 0.5));
    for (from, to) in [(-0.3, 0.4), (-0.3, 1.2), (-1.0, 1.0), (-0.7, 1.3), (0.1, 1.2)] {
        for radius in [0.0, 0.1] {
            let height = 0.5 + radius - 1e-3;
            let a = capsule([[from, 0.1, height], [to, 0.1, height]], radius);
            let at = |angle: f64| wrench(&moved(&a, &Vec3::zeros(), &(Vec3::y() * angle)), &b);
            let (mut steps, mut last) = ([0.0_f64; 2], at(-1e-5));
            for (index, fine) in [2e-8, 2e-9].into_iter().enumerate() {
                for step in -500..=500 {
                    let now = at(f64::from(step) * fine);
                    if step > -500 {
                        let step = (now.force - last.force).norm() + (now.moment - last.moment).norm();
                        steps[index] = steps[index].max(step);
                    }
                    last = now;
                }
            }
            // Ten times finer steps change ten times less.
            assert!(steps[0] > 0.0 && steps[1] < 0.2 * steps[0], "{from} {to} {radius}: {steps:?}");
        }
    }
}

/// Moved together, with ends exchanged, scaled: nothing changes.
#[test]
fn no_pose_and_no_naming_changes_anything() {
    let mut random = Random::new(34, 0, 0);
    for (case, b) in solids().iter().cycle().take(long_samples(1000, 10_000) as usize).enumerate() {
        let a = random_bar(&mut random, b);
        let found = wrench(&a, b);
        let size = found.force.norm().max(1e-3);
        // Rounding chooses between two ways out that cost the same.
        let x = random_motion(&mut random, 2.0);
        let mut twins = vec![("ends exchanged", {
            let swapped = Capsule { ends: [a.ends[1], a.ends[0]], ..a };
            (energy(&swapped, b), wrench(&swapped, b))
        })];
        let turned = crate::common::moved(b, &x);
        let Wrench { force, moment } = wrench(&a.carried(&x), &turned);
        let back = x.rotation.transpose();
        let moved = Wrench { force: back * force, moment: back * (moment - x.translation.cross(&force)) };
        twins.push(("moved", (energy(&a.carried(&x), &turned), moved)));
        for factor in [1e-6, 1e6] {
            let large = crate::common::scaled(b, factor);
            let scaled = Capsule { ends: a.ends.map(|end| end * factor), radius: a.radius * factor };
            let Wrench { force, moment } = wrench(&scaled, &large);
            let wrench = Wrench { force: force / factor, moment: moment / (factor * factor) };
            twins.push(("scaled", (energy(&scaled, &large) / (factor * factor), wrench)));
        }
        let stored = energy(&a, b);
        for (what, (energy, other)) in twins {
            assert!((energy - stored).abs() <= 1e-9 * stored, "case {case}, {what}: {energy} {stored} {a:?}");
            let off = (other.force - found.force).norm() + (other.moment - found.moment).norm();
            let tied = case % 6 < 3 && off > 0.1 * size;
            assert!(off < 1e-6 * size || tied, "case {case}, {what}: {off:e} of {size} {a:?}");
        }
    }
}
