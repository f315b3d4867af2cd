//! Cylinders and cones on convex solids: the energy against its definition by planes, the wrench against the energy, closed
//! forms, and invariances.

use crate::common::bars::{component, least_from, normals_around, smooth_slope};
use crate::common::paths::gained;
use crate::common::{cuboid, random_motion, stretched_hull};
use pong_geometry::bounding::Bounded;
use pong_geometry::distance::Solid as Convex;
use pong_geometry::interference::frustum_solid::{PlaceContacts, frustum_solid};
use pong_geometry::interference::round_plane::frustum_plane;
use pong_geometry::primitive::{Frustum, Plane, Polyhedron};
use pong_geometry::{Quat, Transform, Vec3, Wrench};
use pong_testkit::{Random, assert_near, long_samples};

/// Energy with a stiffness of 1 N/m.
fn energy_of(contacts: &PlaceContacts) -> f64 {
    contacts.iter().flatten().map(|contact| 0.25 * contact.depth * contact.depth).sum()
}

fn energy(a: &Frustum, b: &Polyhedron) -> f64 {
    energy_of(&frustum_solid(a, b))
}

/// Force on A and its moment about the origin, with a stiffness of 1 N/m.
fn wrench_of(contacts: &PlaceContacts) -> Wrench {
    let mut sum = Wrench::zero();
    for contact in contacts.iter().flatten() {
        sum += Wrench::of_force_at(contact.normal_b * (0.5 * contact.depth), &contact.deepest_b);
    }
    sum
}

/// Boxes, hulls, a plate, a needle and a prism.
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

/// A random cylinder or cone near a solid; some lie on or stand on a face or an edge.
fn random_frustum(random: &mut Random, b: &Polyhedron, deep: bool) -> Frustum {
    let n = match random.below(4) {
        0 => random.direction(),
        1 => {
            let edge = &b.edges[random.below(b.edges.len())];
            let [one, other] = edge.faces.map(|face| b.faces[face as usize].normal);
            one.lerp(&other, random.unit()).normalize()
        }
        _ => b.faces[random.below(b.faces.len())].normal,
    };
    let tilt = random.direction() * random.pick(&[0.0, 1e-3, 0.03, 0.3]);
    let axis = match random.below(4) {
        0 => random.direction(),
        1 => (n + tilt).normalize(),
        2 => (random.across(&n) + tilt).normalize(),
        _ => (b.edges[random.below(b.edges.len())].direction + tilt).normalize(),
    };
    let length = random.log_between(0.05, 1.5);
    let radius = random.log_between(0.05, 0.5);
    let other = random.pick(&[radius, radius, radius, 0.5 * radius, 0.0, 0.2]);
    let a = Frustum::new([axis * (-0.5 * length), axis * (0.5 * length)], [radius, other]);
    let smallest = radius.max(other).min(length);
    let depth = if deep { random.between(0.0, 0.4) } else { smallest * random.log_between(1e-5, 0.05) };
    // A place of B that is farthest along n, over the lowest part of A.
    let height = |place: &&Vec3| n.dot(place);
    let corners: Vec<Vec3> = b.vertices.iter().map(|vertex| vertex.position).collect();
    let place = *corners.iter().max_by(|one, other| height(one).total_cmp(&height(other))).unwrap();
    let place =
        if random.below(2) == 0 { place } else { place + random.across(&n) * random.between(0.0, 0.6) };
    let touch = a.ends[0].lerp(&a.ends[1], random.unit()) + random.across(&axis) * (radius * random.unit());
    let low = a.support(&-n) + n.dot(&touch);
    let shift = place - touch + n * (low - depth);
    Frustum { ends: a.ends.map(|end| end + shift), ..a }
}

/// Energy on the plane that touches B along the normal `n`.
fn on_plane(a: &Frustum, b: &Polyhedron, n: &Vec3) -> f64 {
    let (top, aside) = (b.support(n), n.cross(&a.axis).norm());
    let square = |depth: f64| depth.max(0.0).powi(2);
    let of_end = |end: usize| {
        let depth = top - n.dot(&a.ends[end]);
        let high = if a.radii[end] > 0.0 { square(depth - a.radii[end] * aside) } else { 0.0 };
        square(depth + a.radii[end] * aside) + high
    };
    0.25 * (of_end(0) + of_end(1))
}

/// Least energy on planes, by descent from the best of many directions, of the faces and of the middles of edges.
fn least_on_planes(a: &Frustum, b: &Polyhedron) -> f64 {
    let normals = normals_around(b).chain([a.axis, -a.axis]);
    least_from(normals, 6, (32, 1e-9), |n| on_plane(a, b, n))
}

/// The energy is the least on any plane that has B behind it, and the plane of the contacts stores it.
#[test]
fn the_energy_is_the_least_on_a_plane_with_the_solid_behind_it() {
    let mut random = Random::new(61, 0, 0);
    let (mut touching, mut sharp) = (0, 0);
    for b in solids() {
        for case in 0..long_samples(60, 4000) {
            let a = random_frustum(&mut random, &b, case % 3 == 0);
            let (stored, searched) = (energy(&a, &b), least_on_planes(&a, &b));
            // The search may stop above the minimum, in a crease.
            assert!(stored <= searched * (1.0 + 1e-6) + 1e-18, "case {case}: {stored:e} {searched:e} {a:?}");
            sharp += usize::from(searched - stored > 1e-3 * searched + 1e-9);
            touching += usize::from(stored > 0.0);
            if let Some(contact) = frustum_solid(&a, &b).iter().flatten().next() {
                let off = on_plane(&a, &b, &contact.normal_b) - stored;
                assert!(off.abs() <= 1e-15 + 1e-9 * stored, "case {case}: {off:e} of {stored:e}");
            }
        }
    }
    println!("{touching} touch, {sharp} of which the search does not come to the minimum");
    assert!(touching > long_samples(100, 7000) && sharp <= touching / 20, "{touching} {sharp}");
}

/// Body moved by a screw: translation and rotation vector.
fn moved(a: &Frustum, shift: &Vec3, turn: &Vec3) -> Frustum {
    let turn = Quat::from_scaled_axis(*turn);
    Frustum { ends: a.ends.map(|end| turn * end + shift), axis: turn * a.axis, ..*a }
}

/// Body moved along axis `k`, m, or for `k` from 3 on turned about axis `k` − 3, rad.
fn moved_by(a: &Frustum, k: usize, by: f64) -> Frustum {
    let (along, none) = (Vec3::ith(k % 3, by), Vec3::zeros());
    if k < 3 { moved(a, &along, &none) } else { moved(a, &none, &along) }
}

#[test]
fn the_wrench_is_minus_the_derivative_of_the_energy() {
    const STEP: f64 = 1e-5;
    let mut random = Random::new(62, 0, 0);
    let (mut compared, mut beside, mut worst) = (0, 0, 0.0_f64);
    let solids = solids();
    for case in 0..long_samples(2000, 60_000) as usize {
        let b = &solids[case % solids.len()];
        let a = random_frustum(&mut random, b, case % 2 == 0);
        let found = wrench_of(&frustum_solid(&a, b));
        let force = found.force.norm();
        // At a first touch, and where two ways out cost the same.
        let near = [-3.0, 3.0].map(|by| {
            wrench_of(&frustum_solid(&moved(&a, &Vec3::zeros(), &Vec3::repeat(by * STEP)), b)).force
        });
        if force < 1e-3 || (near[0] + near[1] - found.force * 2.0).norm() > 1e-6 * force {
            continue;
        }
        compared += 1;
        for k in 0..6 {
            let at = |by: f64| energy(&moved_by(&a, k, by), b);
            // Where a place begins to touch, the curvature steps.
            let Some(found_by) = smooth_slope(at, STEP, force) else { continue };
            let part = component(&found, k);
            let off = (part + found_by).abs() / force;
            assert!(off < 1e-4, "case {case}, {k}: {part} {found_by} {a:?}");
            beside += usize::from(off > 1e-6);
            worst = worst.max(off);
        }
    }
    println!("W + ∂U/∂x over the force: {worst:.1e} at most, {compared} poses, {beside} above 1e-6");
    let most = compared / 1000;
    assert!(compared > long_samples(200, 6000) as usize && beside <= most, "{compared} {beside}");
}

/// Along random paths, into the solids and through them included, the work of the wrench is the energy that is stored
/// less: none appears or vanishes, but for one path in a thousand at most.
#[test]
fn paths_gain_and_lose_nothing() {
    let mut random = Random::new(63, 0, 0);
    let solids = solids();
    let (mut touching, mut beside, mut worst) = (0, 0, 0.0_f64);
    for case in 0..long_samples(120, 6000) as usize {
        let b = &solids[case % solids.len()];
        let a = random_frustum(&mut random, b, case % 2 == 0);
        let (shift, turn) = (random.vector(0.3), random.vector(0.6));
        let at = |s: f64| frustum_solid(&moved(&a, &(shift * s), &(turn * s)), b);
        let power = |s: f64| {
            let Wrench { force, moment } = wrench_of(&at(s));
            // The screw turns about the origin of A's frame, which is at shift·s.
            force.dot(&shift) + (moment - (shift * s).cross(&force)).dot(&turn)
        };
        let Some(gained) = gained(|s| energy_of(&at(s)), power, 1e-4) else { continue };
        // Deep in, one of two minima that lie close together may be missed.
        assert!(gained < 1e-3, "case {case}: {gained:e} of the largest stored {a:?}");
        if gained >= 1e-9 {
            println!("CASE {case} {gained:e}");
        }
        beside += usize::from(gained >= 1e-9);
        worst = worst.max(gained);
        touching += 1;
    }
    println!("{touching} paths, {beside} gain, at most {worst:.1e} of the largest stored");
    assert!(touching > long_samples(30, 1500) as usize && beside * 1000 <= touching, "{touching} {beside}");
}

/// Overlapping bodies are pushed, and others are not.
#[test]
fn contacts_are_where_the_two_overlap() {
    let mut random = Random::new(64, 0, 0);
    let solids = solids();
    let mut touching = 0;
    for case in 0..long_samples(1500, 60_000) as usize {
        let b = &solids[case % solids.len()];
        let a = random_frustum(&mut random, b, case % 2 == 0);
        let other = Convex::polyhedron(b, &Transform::identity());
        let apart = Convex::frustum(&a).to(&other).distance;
        let stored = energy(&a, b);
        assert!(apart == 0.0 || stored == 0.0, "case {case}: {apart} {stored} {a:?}");
        let smaller = Frustum::new(a.ends, a.radii.map(|radius| radius * (1.0 - 1e-6)));
        let overlaps = Convex::frustum(&smaller).to(&other).distance == 0.0;
        assert!(!overlaps || stored > 0.0, "case {case}: {a:?}");
        touching += usize::from(overlaps);
    }
    assert!(touching > long_samples(300, 12_000) as usize, "{touching}");
}

/// Where no edge is near, the contacts are those of a plane.
#[test]
fn on_the_middle_of_a_box_it_is_a_plane() {
    let mut random = Random::new(65, 0, 0);
    let b = cuboid(Vec3::new(-5.0, -5.0, -5.0), Vec3::new(5.0, 5.0, 0.0));
    let plane = Plane { normal: Vec3::z(), offset: 0.0 };
    for case in 0..1000 {
        let axis = if case % 3 == 0 { Vec3::z() } else { random.direction() };
        let radius = random.between(0.05, 0.5);
        let radii = [radius, random.pick(&[radius, 0.5 * radius, 0.0])];
        let a = Frustum::new([Vec3::zeros(), axis * random.between(0.1, 1.0)], radii);
        let low = a.support(&-Vec3::z()) - random.log_between(1e-5, 0.3);
        let a = Frustum { ends: a.ends.map(|end| end + Vec3::new(random.unit(), random.unit(), low)), ..a };
        let (found, expected) = (frustum_solid(&a, &b), frustum_plane(&a, &plane));
        let [found, expected] = [found, expected].map(|contacts| wrench_of(&contacts));
        let off = (found.force - expected.force).norm() + (found.moment - expected.moment).norm();
        assert!(off <= 1e-15 + 1e-12 * expected.force.norm(), "case {case}: {off:e} {a:?}");
    }
}

/// Lying, standing, overhanging, across an edge, on a corner.
#[test]
fn known_cases_carry_what_the_rule_says() {
    const DEPTH: f64 = 1e-5;
    let block = cuboid(Vec3::new(-0.5, -0.5, -0.5), Vec3::new(0.5, 0.5, 0.0));
    let force = |a: &Frustum, b: &Polyhedron| wrench_of(&frustum_solid(a, b)).force.norm() / DEPTH;
    let (radius, half) = (0.2, 0.4);
    let lying = |from: f64, to: f64, turn: f64| {
        let axis = Vec3::new(turn.cos(), turn.sin(), 0.0);
        Frustum::new([from, to].map(|at| axis * at + Vec3::z() * (radius - DEPTH)), [radius; 2])
    };
    // On the face; overhanging one side, both sides.
    for (from, to) in [(-0.3, 0.4), (-0.3, 1.2), (-0.9, 1.2)] {
        assert_near(force(&lying(from, to, 0.0), &block), 1.0, 1e-9);
    }
    // Across a ridge: in the middle and beside it, and at an end.
    let corners = [(-0.5, -0.5), (0.5, -0.5), (0.0, 0.0)];
    let ridge = crate::common::hull(&[-1.0, 1.0].map(|y| corners.map(|(x, z)| Vec3::new(x, y, z))).concat());
    for at in [0.0, 0.1, 0.4] {
        for turn in [0.0, 0.4] {
            let share = 0.5 + at;
            let spread = share * share + (1.0 - share) * (1.0 - share);
            let found = force(&lying(-half - 2.0 * half * at, half - 2.0 * half * at, turn), &ridge);
            assert!((found * 2.0 * spread - 1.0).abs() < 1e-3, "{at}, {turn}: {found}");
        }
    }
    // A rim alone, and standing: with the middle over the face, past an edge, on an apex.
    let leaning = Vec3::new(0.3, 0.2, 1.0).normalize();
    let low = 0.2 * leaning.z.mul_add(-leaning.z, 1.0).sqrt();
    let rim =
        Frustum::new([Vec3::z() * (low - DEPTH), Vec3::z() * (low - DEPTH) + leaning * 0.5], [radius; 2]);
    assert_near(force(&rim, &block), 0.5, 1e-9);
    let standing = |x: f64, y: f64| {
        let foot = Vec3::new(x, y, -DEPTH);
        Frustum::new([foot, foot + Vec3::z() * 0.5], [radius; 2])
    };
    for (x, y) in [(0.0, 0.0), (0.4, 0.1), (0.45, 0.45), (0.5 - 1e-9, 0.0)] {
        assert_near(force(&standing(x, y), &block), 1.0, 1e-9);
    }
    let apex = crate::common::hull(&[
        Vec3::zeros(),
        Vec3::new(-0.5, -0.5, -0.5),
        Vec3::new(0.5, -0.5, -0.5),
        Vec3::new(0.0, 0.5, -0.5),
    ]);
    for past in [0.25, 0.5, 0.75] {
        let expected = 1.0 / (1.0 + past * past);
        for found in [
            force(&standing(0.5 + past * radius, 0.1), &block),
            force(&standing(0.6 * past * radius, 0.8 * past * radius), &apex),
        ] {
            assert!((found - expected).abs() < 1e-3, "{past}: {found} {expected}");
        }
    }
}

/// A standing drum pushed over an edge, and tilted through standing while it overhangs: force and moment do not step.
#[test]
fn a_standing_drum_over_an_edge_has_no_step() {
    let block = cuboid(Vec3::new(-0.5, -0.5, -0.5), Vec3::new(0.5, 0.5, 0.0));
    let drum = |x: f64, tilt: f64| {
        let foot = Vec3::new(x, 0.1, -1e-3);
        let axis = Vec3::new(tilt, 0.3 * tilt, 1.0).normalize();
        Frustum::new([foot, foot + axis * 0.5], [0.2; 2])
    };
    let paths: [&dyn Fn(f64) -> Frustum; 4] =
        [&|s| drum(0.5 + 0.15 * s, 0.0), &|s| drum(0.5 + 0.15 * s, 1e-3), &|s| drum(0.45, 0.01 * s), &|s| {
            drum(0.55, 0.01 * s)
        }];
    for (index, path) in paths.iter().enumerate() {
        let largest = [2_000, 20_000].map(|parts| {
            let at = |k: i32| wrench_of(&frustum_solid(&path(f64::from(k) / f64::from(parts)), &block));
            let step = |k: i32| {
                let (one, other) = (at(k), at(k + 1));
                (one.force - other.force).norm() + (one.moment - other.moment).norm()
            };
            (-parts..parts).map(step).fold(0.0, f64::max)
        });
        // Ten times finer steps change ten times less.
        assert!(largest[0] > 0.0 && largest[1] < 0.2 * largest[0], "{index}: {largest:?}");
    }
}

/// Moved together, with ends exchanged, scaled: nothing changes.
#[test]
fn no_pose_and_no_naming_changes_anything() {
    let mut random = Random::new(66, 0, 0);
    let solids = solids();
    for case in 0..long_samples(600, 10_000) as usize {
        let b = &solids[case % solids.len()];
        let a = random_frustum(&mut random, b, case % 2 == 0);
        let stored = energy(&a, b);
        let [one, other] = a.ends;
        let swapped = Frustum::new([other, one], [a.radii[1], a.radii[0]]);
        let x = random_motion(&mut random, 2.0);
        let mut twins = vec![energy(&swapped, b), energy(&a.carried(&x), &crate::common::moved(b, &x))];
        for factor in [1e-6, 1e6] {
            let scaled = Frustum::new(a.ends.map(|end| end * factor), a.radii.map(|radius| radius * factor));
            twins.push(energy(&scaled, &crate::common::scaled(b, factor)) / (factor * factor));
        }
        for (which, energy) in twins.into_iter().enumerate() {
            let off = (energy - stored).abs();
            assert!(
                off <= 1e-9 * stored + 1e-20 + 1e-15 * stored.sqrt(),
                "case {case}, {which}: {energy:e} {stored:e} {a:?}"
            );
        }
    }
}
