//! Cylinders and cones against each other: closed forms, the least energy over all plates by a search, forces and
//! moments as derivatives of the energy, and invariances.

use crate::common::{fibonacci_sphere, random_motion};
use crate::round_support::Solid;
use pong_geometry::distance::Solid as Convex;
use pong_geometry::interference::two_frusta::{PlateContacts, two_frusta};
use pong_geometry::primitive::Frustum;
use pong_geometry::{Mat3, Quat, Transform, Vec3};
use pong_testkit::{Random, samples};

/// Energy with a stiffness of 1 N/m.
fn energy(contacts: &PlateContacts) -> f64 {
    contacts.iter().flatten().map(|c| 0.25 * c.share * c.interference.depth.powi(2)).sum()
}

/// Force and moment about a point, with a stiffness of 1 N/m.
fn wrench(contacts: &PlateContacts, about: &Vec3) -> (Vec3, Vec3) {
    contacts.iter().flatten().fold((Vec3::zeros(), Vec3::zeros()), |(force, moment), c| {
        let one = c.interference.normal_b * (0.5 * c.share * c.interference.depth);
        (force + one, moment + (c.interference.deepest_b - about).cross(&one))
    })
}

fn random_frustum(random: &mut Random) -> Frustum {
    let one = random.direction() * random.between(0.0, 0.5);
    let other = one + random.direction() * random.between(0.2, 1.5);
    let radius = random.between(0.1, 0.5);
    let tip = random.pick(&[radius, radius, 0.0, 0.5 * radius, 0.1]);
    Frustum::new([one, other], [radius, tip])
}

/// Two bodies that overlap by at most a tenth of the smaller radius, or of which one reaches into the other at random.
fn random_pair(random: &mut Random) -> [Frustum; 2] {
    let (mut a, b) = (random_frustum(random), random_frustum(random));
    let normal = random.direction();
    let depth = random.log_between(1e-5, 0.03);
    let shift = match random.below(6) {
        0 => random.direction() * random.between(0.0, 0.5),
        _ => b.support_point(&normal) - normal * depth - a.support_point(&-normal),
    };
    a.ends = a.ends.map(|end| end + shift);
    [a, b]
}

/// Energy of the best plate along a normal, with a stiffness of 1 N/m, by bisection.
fn plate(a: &Frustum, b: &Frustum, n: &Vec3) -> f64 {
    let heights = |body: &Frustum, sign: f64| {
        let aside = n.cross(&body.axis).norm();
        let place = |end: usize, side: f64| n.dot(&body.ends[end]) + sign * side * body.radii[end] * aside;
        let mut all = vec![place(0, 1.0), place(1, 1.0)];
        all.extend([0, 1].into_iter().filter(|&end| body.radii[end] > 0.0).map(|end| place(end, -1.0)));
        all
    };
    let (of_a, of_b) = (heights(a, -1.0), heights(b, 1.0));
    let sum = |o: f64| {
        let pressed = |over: f64| over.max(0.0);
        let a: f64 = of_a.iter().map(|h| pressed(o - h)).sum();
        a - of_b.iter().map(|h| pressed(h - o)).sum::<f64>()
    };
    let (mut low, mut high) = (-10.0, 10.0);
    for _ in 0..70 {
        let middle = 0.5 * (low + high);
        *(if sum(middle) > 0.0 { &mut high } else { &mut low }) = middle;
    }
    let square = |over: f64| over.max(0.0).powi(2);
    let (a, b) = (of_a.iter().map(|h| square(low - h)), of_b.iter().map(|h| square(h - low)));
    0.5 * (a.sum::<f64>() + b.sum::<f64>())
}

fn energy_by_search(a: &Frustum, b: &Frustum) -> f64 {
    let mut starts: Vec<(f64, Vec3)> =
        fibonacci_sphere(600).into_iter().map(|n| (plate(a, b, &n), n)).collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut least = f64::INFINITY;
    for (_, start) in starts.into_iter().step_by(2).take(10) {
        let (mut n, mut best, mut step) = (start, plate(a, b, &start), 0.05);
        while step > 1e-7 {
            let u = n.cross(&Vec3::ith(n.iamin(), 1.0)).normalize();
            let v = n.cross(&u);
            let tried = (0..8).map(|k| {
                let angle = std::f64::consts::TAU * f64::from(k) / 8.0;
                (n + (u * angle.cos() + v * angle.sin()) * step).normalize()
            });
            match tried.map(|n| (plate(a, b, &n), n)).min_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((value, better)) if value < best => (n, best) = (better, value),
                _ => step *= 0.5,
            }
        }
        least = least.min(best);
    }
    least
}

/// Another plate may be found in one pose, where two store nearly equally little.
#[test]
fn the_plate_stores_the_least_energy() {
    let mut random = Random::new(49, 11, 0);
    let (mut touched, mut others, mut worst) = (0, 0, 0.0_f64);
    for case in 0..samples(120) {
        let [a, b] = random_pair(&mut random);
        let expected = energy_by_search(&a, &b);
        let found = energy(&two_frusta(&a, &b));
        touched += usize::from(expected > 1e-14);
        let excess = (found - expected) / (expected + 1e-14);
        worst = worst.max(excess);
        others += usize::from(excess >= 1e-5);
        assert!(excess < 1.0, "case {case}: {found:e} {expected:e} {a:?} {b:?}");
        assert!(excess > -0.02, "case {case}: the search finds no less: {found:e} {expected:e} {a:?} {b:?}");
    }
    println!("{touched} contacts, {others} of another plate, at most {worst:.1e} above the search");
    assert!(touched > samples(120) / 2 && others <= 1);
}

/// On random lines, at four places of each, just apart, farther apart, just in and deep: contacts exactly where the two overlap by the search of
/// Gilbert, Johnson and Keerthi.
#[test]
fn what_overlaps_has_a_plate_and_what_is_apart_has_none() {
    let mut random = Random::new(49, 13, 0);
    let mut tested = 0;
    for case in 0..samples(2500) {
        let (a, b) = (random_frustum(&mut random), random_frustum(&mut random));
        let way = random.direction();
        let at = |far: f64| Frustum { ends: a.ends.map(|end| end + way * far), ..a };
        // Lower bound.
        let distance = |far: f64| {
            let found = Convex::frustum(&at(far)).to(&Convex::frustum(&b));
            found.distance - found.gap
        };
        let (mut inside, mut outside) = (0.0, 6.0);
        if distance(inside) > 0.0 {
            continue;
        }
        for _ in 0..40 {
            let half = 0.5 * (inside + outside);
            *(if distance(half) > 0.0 { &mut outside } else { &mut inside }) = half;
        }
        for depth in [random.log_between(1e-8, 0.03), random.between(0.0, inside)] {
            let stored = energy(&two_frusta(&at(inside - depth), &b));
            assert!(
                stored > 0.0 || depth > inside,
                "case {case}: nothing {depth} m inside: {a:?} {b:?} {way}"
            );
        }
        for gap in [random.log_between(1e-9, 1e-3), random.between(1e-3, 0.3)] {
            let (a, apart) = (at(inside + gap), distance(inside + gap));
            let contacts = two_frusta(&a, &b);
            let told = contacts.iter().flatten().next().is_some();
            assert!(!told || apart < 1e-13, "case {case}: contacts {apart} m apart: {a:?} {b:?}");
        }
        tested += 1;
    }
    assert!(2 * tested > samples(2500), "{tested}");
}

/// With the depth δ and a stiffness of 1 N/m.
#[test]
fn logs_carry_what_their_places_say() {
    const DEPTH: f64 = 1e-3;
    let b = Frustum::new([Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0)], [0.3; 2]);
    let a = |x: f64, y: f64, along: Vec3| {
        let middle = Vec3::new(x, y, 0.5 - DEPTH);
        Frustum::new([middle - along * 0.8, middle + along * 0.8], [0.2; 2])
    };
    let stored = |a: &Frustum, b: &Frustum| energy(&two_frusta(a, b)) / (0.5 * DEPTH * DEPTH);
    let close = |found: f64, expected: f64, slack: f64| {
        assert!((found - expected).abs() < slack, "{found} {expected}");
    };
    // Parallel, and crossed in the middle: the whole spring. Shifted along itself: that of the place between the two
    // middles at which ½ + 2s² + ½ + 2t² is least, s and t measured from the middles in lengths.
    close(stored(&a(0.0, 0.0, Vec3::x()), &b), 1.0, 1e-12);
    let [of_a, of_b] = [1.6_f64, 2.0].map(|length| 2.0 / (length * length));
    close(
        stored(&a(0.1, 0.0, Vec3::x()), &b),
        1.0 / (1.0 + 0.01 * of_a * of_b / (of_a + of_b)),
        DEPTH * DEPTH,
    );
    close(stored(&a(0.0, 0.0, Vec3::y()), &b), 1.0, 1e-12);
    // The middle of A on a place t of B: 1/(½ + (1 − t)² + t²); turning the normal helps by the order of the depth.
    for x in [0.4, 0.9] {
        let t = 0.5 * (x + 1.0_f64);
        close(stored(&a(x, 0.0, Vec3::y()), &b), 1.0 / (0.5 + (1.0 - t).powi(2) + t * t), 4.0 * DEPTH);
    }
    // A drum that stands on a wider one: on both places of its rim, as on a plane.
    let drum = |z: f64, radius: f64| {
        Frustum::new([Vec3::new(0.1, 0.0, z), Vec3::new(0.1, 0.0, z + 1.0)], [radius; 2])
    };
    close(stored(&drum(1.0 - DEPTH, 0.2), &drum(0.0, 0.4)), 1.0, 1e-10);
    // A drum on two rollers: each carries its share along the line of centres.
    let drop = ((0.3 - DEPTH).powi(2) - 0.2 * 0.2).sqrt();
    let roller = |y: f64| Frustum::new([Vec3::new(-1.0, y, -drop), Vec3::new(1.0, y, -drop)], [0.1; 2]);
    let on_rollers = Frustum::new([Vec3::new(-0.8, 0.0, 0.0), Vec3::new(0.8, 0.0, 0.0)], [0.2; 2]);
    let forces = [-0.2, 0.2].map(|y| wrench(&two_frusta(&on_rollers, &roller(y)), &Vec3::zeros()));
    let force = forces[0].0 + forces[1].0;
    let expected = Vec3::z() * (2.0 * DEPTH * drop / (0.3 - DEPTH));
    assert!((force - expected).norm() < 1e-12 * DEPTH, "{force} {expected}");
    assert!((forces[0].1 + forces[1].1).norm() < 1e-12 * DEPTH);
}

#[test]
fn the_wrench_is_the_derivative_of_the_energy() {
    const STEP: f64 = 1e-6;
    let mut random = Random::new(49, 12, 0);
    let (mut tested, mut kinks, mut worst) = (0, 0, 0.0_f64);
    for case in 0..samples(2000) {
        let [a, b] = random_pair(&mut random);
        let contacts = two_frusta(&a, &b);
        let about = (a.ends[0] + a.ends[1]) * 0.5;
        let (force, moment) = wrench(&contacts, &about);
        let scale = force.norm();
        // The step must be small against the depth.
        if scale < 1e-3 {
            continue;
        }
        let moved = |x: Transform| {
            let to_origin = Transform { rotation: Mat3::identity(), translation: -about };
            let back = Transform { rotation: Mat3::identity(), translation: about };
            energy(&two_frusta(&a.carried(&to_origin).carried(&x).carried(&back), &b))
        };
        for index in 0..6 {
            let at = |step: f64| {
                let vector = Vec3::ith(index % 3, step);
                moved(if index < 3 {
                    Transform { rotation: Mat3::identity(), translation: vector }
                } else {
                    let rotation = Quat::from_scaled_axis(vector).to_rotation_matrix();
                    Transform { rotation: *rotation.matrix(), translation: Vec3::zeros() }
                })
            };
            let narrow = (at(-STEP) - at(STEP)) / (2.0 * STEP);
            let wide = (at(-2.0 * STEP) - at(2.0 * STEP)) / (4.0 * STEP);
            if (narrow - wide).abs() > 1e-4 * scale {
                kinks += 1;
                continue;
            }
            let expected = if index < 3 { force[index] } else { moment[index - 3] };
            worst = worst.max((narrow - expected).abs() / scale);
            tested += 1;
            assert!(
                (narrow - expected).abs() < 1e-5 * scale,
                "case {case}, {index}: {narrow} {expected} {a:?} {b:?}"
            );
        }
    }
    println!("{tested} derivatives, worst {worst:.1e} of the force; {kinks} at kinks");
    assert!(tested > samples(2000) && 50 * kinks < tested, "{tested} {kinks}");
}

/// Exchanged, moved, turned about their own axes and scaled the two bodies have the same energy and force. The search
/// for the plate begins at normals of the first body, so that of two nearly equal plates another one may be found.
#[test]
fn exchanging_moving_turning_and_scaling_change_nothing() {
    let mut random = Random::new(49, 13, 0);
    let (mut ties, mut others) = (0, 0);
    for case in 0..samples(3000) {
        let [a, b] = random_pair(&mut random);
        let contacts = two_frusta(&a, &b);
        let (force, _) = wrench(&contacts, &Vec3::zeros());
        let stored = energy(&contacts);
        if stored == 0.0 {
            continue;
        }
        let mut close = |name: &str, found: f64| {
            let apart = (found / stored - 1.0).abs();
            others += usize::from(apart >= 1e-7);
            assert!(apart < 0.5, "case {case}, {name}: {found:e} {stored:e} {a:?} {b:?}");
        };
        let back = two_frusta(&b, &a);
        close("exchanged", energy(&back));
        let sum = wrench(&back, &Vec3::zeros()).0 + force;
        // Where two plates store equally little, which one counts is a matter of rounding.
        ties += usize::from(sum.norm() >= 1e-6 * force.norm());
        let x = random_motion(&mut random, 3.0);
        close("moved", energy(&two_frusta(&a.carried(&x), &b.carried(&x))));
        let swapped = |frustum: &Frustum| match Solid::Frustum(*frustum).swapped() {
            Solid::Frustum(frustum) => frustum,
            Solid::Capsule(_) => unreachable!(),
        };
        close("ends exchanged", energy(&two_frusta(&swapped(&a), &swapped(&b))));
        let factor = random.log_between(1e-6, 1e6);
        let scaled = |f: &Frustum| Frustum::new(f.ends.map(|end| end * factor), f.radii.map(|r| r * factor));
        close("scaled", energy(&two_frusta(&scaled(&a), &scaled(&b))) / (factor * factor));
    }
    println!("{ties} other forces, {others} of {} energies of another plate", 4 * samples(3000));
    assert!(ties * 1000 <= samples(3000) && others * 1000 <= 4 * samples(3000), "{ties} {others}");
}
