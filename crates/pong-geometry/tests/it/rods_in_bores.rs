//! Segments, capsules and cylinders in a bore: depths by an independent search, wrenches as derivatives of
//! the stored energy, the closed form of a pin that takes up its clearance, and invariances.

use crate::bore_support;
use crate::bore_support::{carried, random_bore, rounded, scaled, swapped};
use crate::common::random_motion;
use pong_geometry::bounding::Bounded;
use pong_geometry::interference::Feature;
use pong_geometry::interference::ray_bore::ray_bore;
use pong_geometry::interference::two_capsules::EndContact;
use pong_geometry::interference::two_ended_bore::{
    EndsInBore, RodContacts, capsule_bore, cylinder_bore, segment_bore,
};
use pong_geometry::primitive::{Bore, Capsule, Frustum, LineSegment, Ray, RayResponse};
use pong_geometry::{Quat, Transform, Vec3};
use pong_testkit::{Random, long_samples};
use std::f64::consts::TAU;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Segment,
    Capsule,
    Cylinder,
}

/// Rod in the hole.
#[derive(Clone, Copy, Debug)]
struct Rod {
    kind: Kind,
    ends: [Vec3; 2],
    radius: f64,
}

impl Rod {
    fn touch(&self, bore: &Bore) -> EndsInBore {
        let Self { ends, radius, .. } = *self;
        match self.kind {
            Kind::Segment => segment_bore(&LineSegment { ends }, bore),
            Kind::Capsule => capsule_bore(&Capsule { ends, radius }, bore),
            Kind::Cylinder => cylinder_bore(&Frustum::new(ends, [radius; 2]), bore),
        }
    }

    fn moved(&self, place: impl Fn(Vec3) -> Vec3) -> Self {
        Self { ends: self.ends.map(place), ..*self }
    }

    fn axis(&self) -> Vec3 {
        (self.ends[1] - self.ends[0]).normalize()
    }

    /// Random rod about as wide as the hole, tilted by at most `tilt`, in it or through one of its mouths.
    fn random(random: &mut Random, bore: &Bore, tilt: f64) -> Self {
        let narrow = bore.hole.radii[0].min(bore.hole.radii[1]);
        let kind = [Kind::Segment, Kind::Capsule, Kind::Cylinder][random.below(3)];
        let radius = if kind == Kind::Segment { 0.0 } else { narrow * random.between(0.3, 1.02) };
        let axis = bore.hole.axis;
        let one = random.between(-0.6, 0.9) * bore.hole.length;
        let other = one + random.between(0.2, 1.2) * bore.hole.length;
        let room = (narrow - radius).max(0.0) + 0.05 * narrow;
        let across = |random: &mut Random| {
            let v = random.direction();
            (v - axis * axis.dot(&v)) * random.between(0.0, 1.0)
        };
        let base = across(random) * room;
        let lean = across(random) * tilt * (other - one);
        let sign = if random.below(2) == 0 { 0 } else { 1 };
        let ends = [bore.hole.ends[0] + axis * one + base, bore.hole.ends[0] + axis * other + base + lean];
        Self { kind, ends: [ends[sign], ends[1 - sign]], radius }
    }
}

fn energy(contacts: &EndsInBore) -> f64 {
    let of = |contact: &EndContact| 0.25 * contact.share * contact.interference.depth.powi(2);
    contacts.iter().flatten().flatten().map(of).sum()
}

/// Force and moment about a point, with a stiffness of 1 N/m.
fn wrench(contacts: &EndsInBore, about: &Vec3) -> (Vec3, Vec3) {
    let mut sum = (Vec3::zeros(), Vec3::zeros());
    for EndContact { interference: contact, share } in contacts.iter().flatten().flatten() {
        let force = contact.normal_b * (0.5 * share * contact.depth);
        sum.0 += force;
        sum.1 += (contact.deepest_b - about).cross(&force);
    }
    sum
}

fn deepest(contacts: &RodContacts) -> f64 {
    contacts.iter().flatten().map(|contact| contact.interference.depth).fold(0.0, f64::max)
}

/// Distance of a point behind the wall, extended past the ends, m.
fn behind_wall(bore: &Bore, place: &Vec3) -> f64 {
    let [first, last] = bore.hole.radii;
    let arm = place - bore.hole.ends[0];
    let along = bore.hole.axis.dot(&arm);
    let aside = (arm - bore.hole.axis * along).norm();
    (aside - first - (last - first) * along / bore.hole.length) * bore.hole.wall[1]
}

/// Maximum of a function of an angle, by a fine grid and steps that halve.
fn greatest(of: impl Fn(f64) -> f64) -> f64 {
    let mut at =
        (0..720).map(|i| TAU * f64::from(i) / 720.0).max_by(|a, b| of(*a).total_cmp(&of(*b))).unwrap();
    let mut step = 0.01;
    while step > 1e-10 {
        match [at + step, at - step].into_iter().find(|tried| of(*tried) > of(at)) {
            Some(better) => at = better,
            None => step *= 0.5,
        }
    }
    of(at)
}

fn around(center: Vec3, axis: Vec3, radius: f64) -> impl Fn(f64) -> Vec3 {
    let one = axis.cross(&Vec3::ith(axis.iamin(), 1.0)).normalize();
    let other = axis.cross(&one);
    move |angle| center + (one * angle.cos() + other * angle.sin()) * radius
}

/// An end in the hole is as deep as the deepest point of its rim, or its tip; an end beyond a mouth is as
/// deep as the circle of the mouth is below its side. Two contacts that share the load are no deeper, and store no
/// less.
#[test]
fn depths_of_rods_are_found_by_a_search_around_circles() {
    let mut random = Random::new(1, 0, 0);
    let (mut rims, mut mouths) = (0, 0);
    for case in 0..3000 {
        let bore = Bore { mouths: [true; 2], ..random_bore(&mut random) };
        // In a wide cone the foot of an end on the wall may lie past a mouth although the end does not.
        if bore.hole.wall[0].abs() > 0.4 {
            continue;
        }
        let rod = Rod::random(&mut random, &bore, 0.2);
        if rod.radius >= bore.hole.radii[0].min(bore.hole.radii[1]) {
            continue;
        }
        let contacts = rod.touch(&bore);
        let same_way = rod.axis().dot(&bore.hole.axis) > 0.0;
        for (end, at_end) in contacts.iter().enumerate() {
            let mouth = if same_way { end } else { 1 - end };
            let along = bore.hole.axis.dot(&(rod.ends[end] - bore.hole.ends[0]));
            let slack = 0.25 * bore.hole.length.max(rod.radius);
            let is_inside = slack < along && along < bore.hole.length - slack;
            let is_outside = [along < -slack, along > bore.hole.length + slack][mouth];
            let circle = around(bore.hole.ends[mouth], bore.hole.axis, bore.hole.radii[mouth]);
            let expected = if is_inside {
                rims += 1;
                match rod.kind {
                    Kind::Cylinder => {
                        let rim = around(rod.ends[end], rod.axis(), rod.radius);
                        greatest(|angle| behind_wall(&bore, &rim(angle)))
                    }
                    _ => rod.radius + behind_wall(&bore, &rod.ends[end]),
                }
            } else if is_outside {
                let apart = |angle: f64| {
                    let arm = circle(angle) - rod.ends[0];
                    let along = rod.axis().dot(&arm);
                    // A pin's side extends past its rims, a capsule ends in spheres.
                    let most = (rod.ends[1] - rod.ends[0]).norm();
                    let along = if rod.kind == Kind::Capsule { along.clamp(0.0, most) } else { along };
                    rod.radius - (arm - rod.axis() * along).norm()
                };
                let crossing = rod.ends[0]
                    + rod.axis() * bore.hole.axis.dot(&(bore.hole.ends[mouth] - rod.ends[0]))
                        / bore.hole.axis.dot(&rod.axis());
                let reaches = (rod.ends[1 - end] - crossing).dot(&(rod.ends[end] - crossing)) < 0.0;
                if !reaches || (crossing - bore.hole.ends[mouth]).norm() > bore.hole.radii[mouth] {
                    continue;
                }
                mouths += 1;
                greatest(apart)
            } else {
                continue;
            };
            let expected =
                if expected - rod.radius * f64::from(u8::from(rod.kind == Kind::Capsule)) < bore.thickness {
                    expected.max(0.0)
                } else {
                    0.0
                };
            let found = deepest(at_end);
            let [one, other] =
                at_end.map(|contact| contact.map_or(0.0, |c| c.share * c.interference.depth.powi(2)));
            let is_shared =
                other > 0.0 && found < expected + 1e-9 && one + other > expected * expected - 1e-9;
            assert!(
                is_shared || (found - expected).abs() < 1e-9,
                "case {case} end {end}: {found} {expected} {bore:?} {rod:?}"
            );
        }
    }
    assert!(rims > 500 && mouths > 300, "{rims} {mouths}");
}

/// The power of the wrench of `contacts` on a rod that begins to move at random, per m/s and rad/s, and the stored energy
/// after a time, s.
fn set_in_motion<'a>(
    random: &mut Random,
    (rod, bore): (&'a Rod, &'a Bore),
    contacts: &EndsInBore,
) -> (f64, impl Fn(f64) -> f64 + 'a) {
    let (velocity, spin, about) = (random.direction(), random.direction(), rod.ends[0]);
    let (force, moment) = wrench(contacts, &about);
    let moved = move |time: f64| {
        let turn = Quat::from_scaled_axis(spin * time);
        energy(&rod.moved(|p| about + turn * (p - about) + velocity * time).touch(bore))
    };
    (force.dot(&velocity) + moment.dot(&spin), moved)
}

/// The wrench is minus the derivative of the stored energy along any motion: frictionless closed paths do no
/// work.
#[test]
fn wrenches_of_rods_derive_from_the_stored_energy() {
    const STEP: f64 = 1e-6;
    let mut random = Random::new(2, 0, 0);
    let (mut compared, mut kinks, mut both) = (0, 0, 0);
    for case in 0..20_000 {
        let bore = random_bore(&mut random);
        let rod = Rod::random(&mut random, &bore, 0.3);
        let contacts = rod.touch(&bore);
        if energy(&contacts) < 1e-6 {
            continue;
        }
        let (power, moved) = set_in_motion(&mut random, (&rod, &bore), &contacts);
        compared += 1;
        both += usize::from(contacts.iter().any(|end| end[0].is_some() && end[1].is_some()));
        let halves = [moved(STEP) - moved(0.0), moved(0.0) - moved(-STEP)].map(|change| change / STEP);
        if (halves[0] - halves[1]).abs() > 1e-4 {
            kinks += 1;
            continue;
        }
        let slope = 0.5 * (halves[0] + halves[1]);
        assert!((power + slope).abs() < 2e-5, "case {case}: {power} {slope} {bore:?} {rod:?} {contacts:?}");
    }
    assert!(compared > 2500 && both > 30 && kinks * 200 < compared, "{compared} {both} {kinks}");
}

/// Pin of 0.05 to 4 radii, wide or narrow, tilted and shifted in a tight hole, straight or tapered; or a rod through
/// a thin plate, where the hole is as short.
fn tight(random: &mut Random, case: usize) -> (Rod, Bore) {
    let length = [0.05, 0.1, 0.2, 0.5, 1.0, 4.0][case % 6];
    let taper = [0.0, 0.0, 0.05, 0.3, 1.0, 2.0][random.below(6)];
    let (room, through) = (random.between(-0.01, 0.01), case % 4 == 3 && taper == 0.0);
    let (hole, long) = if through { (length, 6.0) } else { (6.0, length) };
    let ends = [Vec3::z() * (-0.5 * hole), Vec3::z() * (0.5 * hole)];
    let wide = 1.0 + room + taper * 0.5 * hole;
    let bore = Bore {
        hole: Frustum::new(ends, [wide, (wide - taper * hole).max(0.0)]),
        thickness: 1.0,
        mouths: [true; 2],
    };
    let tilt = random.log_between(1e-3, (0.3 / length).min(0.5));
    let (sine, cosine) = tilt.sin_cos();
    let toward = random.between(0.0, TAU);
    let axis = Vec3::new(sine * toward.cos(), sine * toward.sin(), cosine);
    let middle = random.direction() * random.log_between(1e-4, 0.05);
    let kind = if through { [Kind::Capsule, Kind::Cylinder][random.below(2)] } else { Kind::Cylinder };
    let x = random_motion(random, 1.0);
    let rod = Rod { kind, ends: [middle - axis * (0.5 * long), middle + axis * (0.5 * long)], radius: 1.0 };
    (rod.moved(|p| x.point(&p)), carried(&bore, &x))
}

/// Greatest depth of a rod's end behind a side of the wall, or of its side behind the mouth on a side.
fn depth_on(rod: &Rod, bore: &Bore, end: usize, mouth: Option<usize>, side: &Vec3) -> f64 {
    let [along, aside] = bore.hole.wall;
    match mouth {
        None => {
            let outward = bore.hole.axis * along + side * aside;
            let rim = rod.radius * outward.cross(&rod.axis()).norm();
            outward.dot(&(rod.ends[end] - bore.hole.ends[0])) - aside * bore.hole.radii[0] + rim
        }
        Some(mouth) => {
            let circle = bore.hole.radii[mouth] * side.cross(&bore.hole.axis).norm();
            rod.radius + side.dot(&(rod.ends[end] - bore.hole.ends[mouth])) - circle
        }
    }
}

/// Moved by u across the hole (or itself, at a mouth) and smaller by w, an end is clear on every side, touches where it
/// has contacts, and |u|²/B + w²/A is what it stores: so no other u and w that clear it store less.
#[test]
fn an_end_yields_by_the_least_that_clears_every_side() {
    let mut random = Random::new(10, 0, 0);
    let (mut shared, mut alone, mut narrow) = ([0; 2], 0, 0);
    for case in 0..6000 {
        let (rod, bore) = tight(&mut random, case);
        for (end, contacts) in rod.touch(&bore).iter().enumerate() {
            let Some(first) = contacts[0] else { continue };
            let is_wall = first.interference.feature == Feature::face(0);
            let mouth = (!is_wall).then(|| first.interference.feature.index());
            let about = if is_wall { bore.hole.axis } else { rod.axis() };
            let across = |v: &Vec3| v - about * about.dot(v);
            // What leaves the hole as a whole is no matter of sides.
            if across(&first.interference.normal_b).norm() < 1e-6 {
                continue;
            }
            let shrinks = if is_wall { bore.hole.wall[0].powi(2).max(0.5) } else { 0.5 };
            let (mut moved, mut smaller, mut stored) = (Vec3::zeros(), 0.0, 0.0);
            for EndContact { interference: contact, share } in contacts.iter().flatten() {
                let load = share * contact.depth;
                assert!(load > 0.0 && contact.depth > 0.0, "case {case}: {contacts:?}");
                moved -= across(&contact.normal_b).normalize() * (load * (1.0 - shrinks));
                smaller += load * shrinks;
                stored += load * contact.depth;
            }
            let most = deepest(contacts);
            let again = moved.norm_squared() / (1.0 - shrinks) + smaller * smaller / shrinks;
            assert!(
                (again - stored).abs() < 1e-9 * stored + 1e-15,
                "case {case}: {again} {stored} {contacts:?}"
            );
            let around = around(Vec3::zeros(), about, 1.0);
            for step in 0..360 {
                let side = around(TAU * f64::from(step) / 360.0);
                let left = depth_on(&rod, &bore, end, mouth, &side) - moved.dot(&side) - smaller;
                assert!(
                    left < 1e-7 * most + 1e-14,
                    "case {case} {end}: {left:e} of {most:e}, {rod:?} {bore:?}"
                );
            }
            match contacts[1] {
                Some(second) => {
                    shared[usize::from(!is_wall)] += 1;
                    let cosine = first.interference.normal_b.dot(&second.interference.normal_b);
                    narrow += usize::from(cosine > 0.0);
                }
                None => alone += 1,
            }
        }
    }
    assert!(shared[0] > 500 && shared[1] > 100 && alone > 500 && narrow > 200, "{shared:?} {alone} {narrow}");
}

/// Short pins in tight holes, and rods through thin plates: the wrench is minus the derivative of U.
#[test]
fn wrenches_of_short_pins_derive_from_the_stored_energy() {
    let mut random = Random::new(11, 0, 0);
    let (mut compared, mut shared, mut kinks, mut worst) = (0, 0, 0, 0.0_f64);
    for case in 0..20_000 {
        let (rod, bore) = tight(&mut random, case);
        let contacts = rod.touch(&bore);
        let most = deepest(&contacts[0]).max(deepest(&contacts[1]));
        if most < 1e-4 {
            continue;
        }
        let step = 1e-3 * most;
        let (power, moved) = set_in_motion(&mut random, (&rod, &bore), &contacts);
        let slope = |step: f64| (moved(step) - moved(-step)) / (2.0 * step);
        let (near, nearer) = (slope(step), slope(0.5 * step));
        compared += 1;
        shared += usize::from(contacts.iter().any(|end| end[1].is_some()));
        // Where the energy has a kink or a step (docs/theory.md, 2.8, limits), or U begins to be shared.
        if (near - nearer).abs() > 1e-5 * most {
            kinks += 1;
            continue;
        }
        let off = (power + nearer + (nearer - near) / 3.0).abs() / most;
        worst = worst.max(off);
        assert!(off < 5e-5, "case {case}: {off:e} {power} {nearer} {bore:?} {rod:?} {contacts:?}");
    }
    eprintln!("{compared} poses, {shared} shared, {kinks} kinks, off by {worst:e} of the depth");
    assert!(compared > 8000 && shared > 3000 && kinks * 20 < compared, "{compared} {shared} {kinks}");
}

/// Wrenches of short pins are continuous where a second place begins to carry load, where a pin gets too large for its
/// tapered hole as it slides in, and where its tilt passes through zero: half the step of the path, half the change.
#[test]
fn short_pins_share_and_get_stuck_without_a_jump() {
    let mut random = Random::new(12, 0, 0);
    let (mut begins, mut sticks) = (0, 0);
    for case in 0..60 {
        let taper = [0.0, 0.05, 0.3][case % 3];
        let hole = Frustum::new([Vec3::z() * -3.0, Vec3::z() * 3.0], [1.0 + 3.0 * taper, 1.0 - 3.0 * taper]);
        let bore = Bore { hole, thickness: 1.0, mouths: [true; 2] };
        let length = [0.05, 0.2, 1.0][random.below(3)];
        let size = random.log_between(2e-3, 0.03);
        let wider = if taper == 0.0 { 3e-3 } else { 0.5 * taper * size };
        // End 0 is as wide as the hole in the middle of its path, or nearly.
        let radius = 1.0 + 0.5 * taper * length + wider * random.between(-1.0, 1.0);
        let way = [random.direction() * size, random.direction() * size];
        let lean = [random.direction() * 3.0 * size, random.direction() * 3.0 * size];
        let pose = |time: f64| {
            let at = |[one, other]: [Vec3; 2]| one * (TAU * time).sin() + other * (2.0 * TAU * time).sin();
            let (middle, turn) = (at(way), Quat::from_scaled_axis(at(lean)));
            let ends = [-0.5 * length, 0.5 * length].map(|z| middle + turn * (Vec3::z() * z));
            Rod { kind: Kind::Cylinder, ends, radius }
        };
        let changes = |count: u32| {
            let wrenches: Vec<_> = (0..=count)
                .map(|i| {
                    let rod = pose(f64::from(i) / f64::from(count));
                    wrench(&[rod.touch(&bore)[0], [None; 2]], &rod.ends[0])
                })
                .collect();
            let change =
                |pair: &[(Vec3, Vec3)]| (pair[1].0 - pair[0].0).norm() + (pair[1].1 - pair[0].1).norm();
            wrenches.windows(2).map(change).fold(0.0, f64::max)
        };
        let (coarse, fine) = (changes(2000), changes(8000));
        assert!(fine <= 0.4 * coarse, "case {case}: {fine:e} {coarse:e}");
        let poses = (0..400).map(|i| pose(f64::from(i) / 400.0));
        let touched: Vec<_> = poses.map(|rod| (rod.touch(&bore)[0], rod)).collect();
        let is_shared =
            |(contacts, _): &(RodContacts, Rod)| contacts[0].is_some().then(|| contacts[1].is_some());
        let states: Vec<bool> = touched.iter().filter_map(is_shared).collect();
        begins += states.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let is_stuck = |(_, rod): &(RodContacts, Rod)| radius > 1.0 - taper * rod.ends[0].z;
        sticks += touched.windows(2).filter(|pair| is_stuck(&pair[0]) != is_stuck(&pair[1])).count();
    }
    assert!(begins > 50 && sticks > 30, "{begins} {sticks}");
}

/// Moved together, rotated about either's own axis, ends exchanged, rounded to f32 or not, scaled: nothing
/// changes.
#[test]
fn no_pose_no_naming_of_ends_and_no_scale_changes_what_rods_feel() {
    let mut random = Random::new(3, 0, 0);
    let (mut compared, mut loose) = (0, 0);
    for case in 0..3000 {
        let bore = random_bore(&mut random);
        let bore = if case % 2 == 0 { bore } else { rounded(&bore) };
        let rod = Rod::random(&mut random, &bore, 0.3);
        let about = bore.hole.ends[0];
        let expected = wrench(&rod.touch(&bore), &about);
        let mut close = |(force, moment): (Vec3, Vec3), what: &str| {
            let off = (force - expected.0).norm() + (moment - expected.1).norm();
            assert!(off < 1e-9, "{what} {case}: {off:e} {bore:?} {rod:?}");
            compared += 1;
            loose += usize::from(off > 1e-12);
        };
        let x = random_motion(&mut random, 2.0);
        let (force, moment) =
            wrench(&rod.moved(|p| x.point(&p)).touch(&carried(&bore, &x)), &x.point(&about));
        close((x.rotation.tr_mul(&force), x.rotation.tr_mul(&moment)), "moved");
        let turned = |axis: &Vec3, place: &Vec3, angle: f64| {
            let turn = Quat::from_scaled_axis(axis * angle).to_rotation_matrix().into_inner();
            Transform { rotation: turn, translation: place - turn * place }
        };
        let own = turned(&bore.hole.axis, &about, random.between(0.0, 6.0));
        close(wrench(&rod.touch(&carried(&bore, &own)), &about), "the bore turned about its own axis");
        let spun = turned(&rod.axis(), &rod.ends[0], random.between(0.0, 6.0));
        close(
            wrench(&rod.moved(|p| spun.point(&p)).touch(&bore), &about),
            "the rod turned about its own axis",
        );
        close(wrench(&rod.touch(&swapped(&bore)), &about), "ends of B exchanged");
        let exchanged = Rod { ends: [rod.ends[1], rod.ends[0]], ..rod };
        close(wrench(&exchanged.touch(&bore), &about), "ends of A exchanged");
        for factor in [1e-6, 1e6] {
            let of_size = Rod { radius: rod.radius * factor, ..rod.moved(|p| p * factor) };
            let (force, moment) = wrench(&of_size.touch(&scaled(&bore, factor)), &(about * factor));
            close((force / factor, moment / factor.powi(2)), "scaled");
        }
    }
    assert!(loose * 50 < compared, "{loose} of {compared} are off by more than 1e-12");
}

/// Pin in a hole from z = 0 down, its middle in the middle of the hole, tilted towards a perpendicular
/// direction.
fn pin_in_hole(diameter: f64, length: f64, tilt: f64, toward: f64) -> Rod {
    let axis = Vec3::new(tilt.sin() * toward.cos(), tilt.sin() * toward.sin(), tilt.cos());
    Rod {
        kind: Kind::Cylinder,
        ends: [axis * (-0.5 * length), axis * (0.5 * length)],
        radius: 0.5 * diameter,
    }
}

fn straight_hole(diameter: f64, length: f64) -> Bore {
    let ends = [Vec3::z() * (-0.5 * length), Vec3::z() * (0.5 * length)];
    Bore { hole: Frustum::new(ends, [0.5 * diameter; 2]), thickness: diameter, mouths: [true; 2] }
}

/// A pin of diameter d and length L in a hole of diameter D touches at two points, on opposite sides, exactly
/// when L·sin θ + d·cos θ = D: in the hole with its two rims; through it, with L the length of the hole, with
/// both mouths.
#[test]
fn a_pin_touches_in_two_places_exactly_when_its_tilt_takes_up_the_clearance() {
    let mut random = Random::new(4, 0, 0);
    for _ in 0..200 {
        let diameter = random.between(0.01, 0.1);
        let hole = diameter * (1.0 + random.between(1e-4, 0.05));
        let length = diameter * random.between(1.0, 4.0);
        let clears = |tilt: f64| length * tilt.sin() + diameter * tilt.cos() < hole;
        let (mut low, mut high) = (0.0, 0.5);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if clears(middle) { &mut low } else { &mut high }) = middle;
        }
        let toward = random.between(0.0, TAU);
        // For a pin through a hole the mouths act as the rims, with the roles of the diameters exchanged.
        let through = |tilt: f64| length * tilt.sin() + diameter < hole * tilt.cos();
        let (mut from, mut to) = (0.0, 0.5);
        for _ in 0..60 {
            let middle = 0.5 * (from + to);
            *(if through(middle) { &mut from } else { &mut to }) = middle;
        }
        for (tilt, bore, long) in [
            (low, straight_hole(hole, 3.0 * length), length),
            (from, straight_hole(hole, length), 3.0 * length),
        ] {
            let apart = pin_in_hole(diameter, long, tilt * (1.0 - 1e-9), toward).touch(&bore);
            assert_eq!(apart.iter().flatten().flatten().count(), 0, "{apart:?}");
            let contacts = pin_in_hole(diameter, long, tilt * (1.0 + 1e-6), toward).touch(&bore);
            let [Some(one), Some(other)] = [contacts[0][0], contacts[1][0]] else { panic!("{contacts:?}") };
            assert_eq!(contacts.iter().flatten().flatten().count(), 2);
            let [one, other] = [one.interference, other.interference];
            assert!(one.normal_b.dot(&other.normal_b) < -0.999_999);
            assert!((one.depth - other.depth).abs() < 1e-12);
            // Rotated about its own axis, or tilted towards another side, it is the same pin.
            let depth = |toward: f64| {
                deepest(&pin_in_hole(diameter, long, tilt * (1.0 + 1e-3), toward).touch(&bore)[0])
            };
            assert!((depth(toward) - depth(0.0)).abs() < 1e-14 && (depth(1.0) - depth(0.0)).abs() < 1e-14);
        }
    }
}

/// A coaxial pin with clearance touches nothing; if too large it is loaded on opposite sides without a net
/// force. Off the axis or slightly tilted, the wrench grows continuously from zero, in every direction.
/// A pin that is too large leaves a hole by the way of its lowest place along the hole, to rounding, however small its
/// tilt.
#[test]
fn a_pin_that_leaves_a_hole_is_as_deep_as_its_lowest_place() {
    let mut random = Random::new(7, 0, 0);
    for _ in 0..500 {
        let (tilt, toward) = (random.log_between(1e-11, 1e-3), random.between(0.0, TAU));
        let (radius, inside) = (random.between(0.06, 0.1), random.log_between(1e-4, 1e-3));
        let pin = pin_in_hole(2.0 * radius, 0.2, tilt, toward);
        let to_mouth = Vec3::z() * (0.5 - inside) - pin.ends[0];
        let turn = random_motion(&mut random, 0.5);
        let placed = pin.moved(|place| turn.point(&(place + to_mouth)));
        let hole = carried(&straight_hole(0.1, 1.0), &turn);
        let depth = deepest(&placed.touch(&hole)[0]);
        assert!((depth - (inside + radius * tilt.sin())).abs() < 2e-15, "{tilt:e}: {depth} {inside}");
    }
}

#[test]
fn a_pin_that_is_too_large_is_held_in_the_middle() {
    let bore = straight_hole(0.1, 0.2);
    for length in [0.15, 0.3] {
        let free = pin_in_hole(0.1 - 1e-6, length, 0.0, 0.0).touch(&bore);
        assert_eq!(energy(&free), 0.0);
        let pin = pin_in_hole(0.1 + 2e-5, length, 0.0, 0.0);
        let contacts = pin.touch(&bore);
        assert_eq!(contacts.iter().flatten().flatten().count(), 4);
        assert!(
            contacts
                .iter()
                .flatten()
                .flatten()
                .all(|contact| (contact.interference.depth - 1e-5).abs() < 1e-15)
        );
        let (force, moment) = wrench(&contacts, &Vec3::zeros());
        assert!(force.norm() < 1e-16 && moment.norm() < 1e-16, "{force} {moment}");
        let mut random = Random::new(5, 0, 0);
        for _ in 0..500 {
            let (shift, turn) = (random.direction() * 1e-9, random.direction() * 1e-9);
            let rotated = Quat::from_scaled_axis(turn);
            let (force, moment) = wrench(&pin.moved(|p| rotated * p + shift).touch(&bore), &Vec3::zeros());
            let off = force.norm() + moment.norm();
            assert!(off < 1e-8, "{off:e}");
        }
    }
}

/// A rod flat on the wall carries kδ, whatever overhangs.
#[test]
fn a_rod_that_lies_flat_in_a_hole_carries_its_spring() {
    let mut random = Random::new(6, 0, 0);
    let depth = 1e-4;
    for _ in 0..500 {
        let x = random_motion(&mut random, 2.0);
        let bore = straight_hole(0.2, 1.0);
        let angle = random.between(0.0, TAU);
        for (kind, radius) in [(Kind::Segment, 0.0), (Kind::Capsule, 0.03), (Kind::Cylinder, 0.03)] {
            for (from, to) in [(-0.3, 0.2), (-0.8, 0.3), (-0.2, 0.9), (-0.7, 0.9)] {
                let side = Vec3::new(angle.cos(), angle.sin(), 0.0);
                let at = |z: f64| x.point(&(side * (0.1 - radius + depth) + Vec3::z() * z));
                let rod = Rod { kind, ends: [at(from), at(to)], radius };
                let (force, moment) = wrench(&rod.touch(&carried(&bore, &x)), &x.point(&Vec3::zeros()));
                let force = x.rotation.tr_mul(&force);
                assert!((force + side * depth).norm() < 1e-12, "{kind:?} {from} {to}: {force}");
                let middle = 0.5 * (f64::max(from, -0.5) + f64::min(to, 0.5));
                let lever = x.rotation.tr_mul(&moment).dot(&side.cross(&Vec3::z())) / depth;
                assert!((lever - middle).abs() < 1e-9, "{kind:?} {from} {to}: {lever} {middle}");
            }
        }
    }
}

/// A segment that leans into the wall of a hole is pushed by the feature nearest to its tip, the wall, as
/// long as the mouth is farther away; its slope, and the point where its axis would pass the mouth, do not
/// matter.
#[test]
fn a_tip_that_leans_into_the_wall_is_pushed_by_the_wall() {
    let mut random = Random::new(8, 0, 0);
    for case in 0..500 {
        let x = random_motion(&mut random, 2.0);
        let bore = straight_hole(0.2, 1.0);
        let angle = random.between(0.0, TAU);
        let side = Vec3::new(angle.cos(), angle.sin(), 0.0);
        let depth = random.between(1e-4, 5e-3);
        let own = depth * random.between(1.1, 10.0);
        let (toward_mouth, lean) = (if case % 2 == 0 { 1.0 } else { -1.0 }, random.between(0.05, 2.0));
        let tip = side * (0.1 + depth) + Vec3::z() * (toward_mouth * (0.5 - own));
        let axis = side * lean + Vec3::z() * toward_mouth;
        let ends = [tip - axis * (0.1 / lean), tip].map(|end| x.point(&end));
        let rod = Rod { kind: Kind::Segment, ends, radius: 0.0 };
        let found: Vec<_> =
            rod.touch(&carried(&bore, &x)).into_iter().flatten().flatten().map(|c| c.interference).collect();
        assert_eq!(found.len(), 1, "{case}: {found:?}");
        assert!((found[0].depth - depth).abs() < 1e-12, "{case}: {} not {depth}, {own}", found[0].depth);
        assert!((x.rotation.tr_mul(&found[0].normal_b) + side).norm() < 1e-9, "{case}: {found:?}");
    }
}

/// Energy and wrench are continuous while rods slide out through a mouth, tilt, turn in it and return, with
/// their axes in the hole or, for segments, behind the wall.
#[test]
fn rods_pass_mouths_without_a_jump() {
    let mut random = Random::new(7, 0, 0);
    let (mut touched, mut jumps) = (0, 0);
    let cases = long_samples(45, 150);
    for case in 0..cases {
        let bore = straight_hole(0.2, 1.0);
        let kind = [Kind::Segment, Kind::Capsule, Kind::Cylinder][case % 3];
        let radius = if kind == Kind::Segment { 0.0 } else { 0.05 };
        let depth = 1e-3;
        // A rim that is also tilted across the wall does have a step, proportional to the tilt squared
        // (docs/theory.md, 2.8).
        let most_skew = if kind == Kind::Cylinder { 0.01 } else { 0.15 };
        let (lean, skew) = (random.between(-0.15, 0.15), random.between(-most_skew, most_skew));
        let axis = Vec3::new(lean, skew, 1.0).normalize();
        let pose = |share: f64| {
            // The end moves from 10 mm inside to 10 mm outside the mouth, at the wall.
            let tip = Vec3::new(0.1 - radius + depth, 0.0, 0.5 - 0.01 + 0.02 * share);
            Rod { kind, ends: [tip - axis * 0.7, tip], radius }
        };
        // Only of the end that passes: in a leaning rod the other one is much deeper.
        let of_end = |rod: Rod| energy(&[[None; 2], rod.touch(&bore)[1]]);
        const STEPS: u32 = 20_000;
        let energies: Vec<f64> = (0..=STEPS).map(|i| of_end(pose(f64::from(i) / f64::from(STEPS)))).collect();
        let most = energies.iter().copied().fold(0.0, f64::max);
        touched += usize::from(most > 0.0);
        let jump = energies.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        jumps += usize::from(jump > 1e-3 * most);
    }
    assert!(touched * 15 > cases * 14 && jumps == 0, "{jumps} of {touched}");
}

/// The energy is continuous while rods are pulled out of the hole, however deep in the wall: at the end their
/// depth is their distance inside.
#[test]
fn rods_leave_the_hole_without_a_jump() {
    let mut random = Random::new(8, 0, 0);
    let mut touched = 0;
    for case in 0..60 {
        let bore = straight_hole(0.2, 1.0);
        let kind = [Kind::Segment, Kind::Capsule, Kind::Cylinder][case % 3];
        let radius = if kind == Kind::Segment { 0.0 } else { 0.05 };
        let depth = 1e-3;
        let lean = if kind == Kind::Cylinder { 0.0 } else { random.between(-0.02, 0.02) };
        let axis = Vec3::new(lean, 0.0, 1.0).normalize();
        let outward = if random.below(2) == 0 { 1.0 } else { -1.0 };
        let pose = |share: f64| {
            let tip = Vec3::new(0.1 - radius + depth, 0.0, outward * (0.5 - 0.01 + 0.02 * share));
            let ends = [tip, tip + axis * (0.7 * outward)];
            Rod { kind, ends: if case % 2 == 0 { ends } else { [ends[1], ends[0]] }, radius }
        };
        const STEPS: u32 = 20_000;
        let energies: Vec<f64> =
            (0..=STEPS).map(|i| energy(&pose(f64::from(i) / f64::from(STEPS)).touch(&bore))).collect();
        let most = energies.iter().copied().fold(0.0, f64::max);
        let jump = energies.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        touched += usize::from(most > 0.0);
        assert!(jump <= 5e-3 * most, "{kind:?} {lean}: {jump:e} of {most:e}");
        // A capsule ends in a sphere, which stays at the edge for longer.
        assert!(kind == Kind::Capsule || energies[STEPS as usize] == 0.0);
    }
    assert!(touched > 50, "{touched}");
}

/// A straight hole cut in two holds a rod like the whole hole: inside, through the seam, and with a rim
/// exactly in the seam.
#[test]
fn a_hole_in_two_pieces_is_one() {
    let mut random = Random::new(9, 0, 0);
    let mut touched = 0;
    for case in 0..2000 {
        let ends = [Vec3::zeros(), Vec3::z()];
        let last = [0.25, 0.3][case % 2];
        let cut = 0.5;
        let middle = 0.25 + (last - 0.25) * cut;
        let piece = |ends: [Vec3; 2], radii: [f64; 2], mouths: [bool; 2]| Bore {
            hole: Frustum::new(ends, radii),
            thickness: 0.2,
            mouths,
        };
        let whole = piece(ends, [0.25, last], [true; 2]);
        let pieces = [
            piece([ends[0], Vec3::z() * cut], [0.25, middle], [true, false]),
            piece([Vec3::z() * cut, ends[1]], [middle, last], [false, true]),
        ];
        let mut rod = Rod::random(&mut random, &whole, 0.1);
        if case % 4 == 0 && last == 0.25 && rod.kind != Kind::Cylinder {
            rod.ends[0].z = cut;
        }
        let (force, moment) = wrench(&rod.touch(&whole), &Vec3::zeros());
        let sum = pieces.map(|piece| wrench(&rod.touch(&piece), &Vec3::zeros()));
        let off = (sum[0].0 + sum[1].0 - force).norm() + (sum[0].1 + sum[1].1 - moment).norm();
        assert!(off < 1e-12, "case {case}: {off:e} {whole:?} {rod:?}");
        touched += usize::from(force.norm() > 0.0);
    }
    assert!(touched > 150, "{touched}");
}

/// Separation of two shapes along the best of many directions.
fn gap(random: &mut Random, a: &dyn Bounded, b: &dyn Bounded) -> f64 {
    let directions = (0..60).map(|_| random.direction());
    directions.map(|d| -a.support(&d) - b.support(&-d)).fold(f64::NEG_INFINITY, f64::max)
}

/// Random rod whose line passes through the plane of a mouth, in it or around it, and that may end before.
fn ends_near_a_mouth(random: &mut Random, bore: &Bore) -> [Vec3; 2] {
    let mouth = random.below(2);
    let [one, other] = bore_support::across(bore);
    let (angle, radius) =
        (random.between(0.0, TAU), bore.hole.radii[mouth] + bore.thickness * random.between(-0.5, 1.2));
    let through = bore.hole.ends[mouth] + (one * angle.cos() + other * angle.sin()) * radius;
    let along = random.direction();
    let ends = [random.between(-0.3, 1.2), random.between(0.3, 3.0)]
        .map(|way| through + along * (way * bore.thickness));
    let first = random.below(2);
    [ends[first], ends[1 - first]]
}

/// All shapes that a bore pushes, and all rays that hit it, reach into its bounds: rods in any pose, and rays
/// that begin behind the wall.
#[test]
fn nothing_that_a_bore_pushes_is_outside_its_bounds() {
    let mut random = Random(31);
    let (mut pushed, mut hit) = ([0; 3], 0);
    for trial in 0..60_000 {
        let bore = random_bore(&mut random);
        let place = |random: &mut Random| bore.hole.ends[0] + random.direction() * random.between(0.0, 2.5);
        let ends = if trial % 2 == 0 {
            [place(&mut random), place(&mut random)]
        } else {
            ends_near_a_mouth(&mut random, &bore)
        };
        let kind = [Kind::Segment, Kind::Capsule, Kind::Cylinder][trial % 3];
        let radius = if kind == Kind::Segment { 0.0 } else { random.between(0.05, 0.6) };
        let rod = Rod { kind, ends, radius };
        if energy(&rod.touch(&bore)) > 0.0 {
            pushed[trial % 3] += 1;
            let (capsule, pin) = (Capsule { ends, radius }, Frustum::new(ends, [radius; 2]));
            let body: &dyn Bounded = if kind == Kind::Cylinder { &pin } else { &capsule };
            let gap = gap(&mut random, body, &bore);
            assert!(gap < 1e-9, "trial {trial}: {gap}, {rod:?} {bore:?}");
        }
        // Along the wall, slightly outwards or not.
        let direction = (bore.hole.axis * random.between(-1.0, 1.0) + random.direction() * 0.3).normalize();
        let ray = Ray {
            origin: place(&mut random),
            direction,
            length: random.between(0.1, 1.0),
            reach: None,
            response: RayResponse::Axial,
        };
        if ray_bore(&ray, &bore).is_some() {
            hit += 1;
            let gap = gap(&mut random, &ray, &bore);
            assert!(gap < 1e-9, "trial {trial}: {gap}, {ray:?} {bore:?}");
        }
    }
    assert!(pushed.iter().all(|count| *count > 1000) && hit > 1000, "{pushed:?} {hit}");
}
