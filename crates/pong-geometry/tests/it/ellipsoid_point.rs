//! Point against ellipsoid, and the nearest-point solvers.
//!
//! Degenerate cases: at the centre, on each axis, in each symmetry plane, on the focal curve, equal semi-axes
//! (sphere, prolate, oblate), flat and thin to 1e4, on the surface, just inside it.

use crate::common;
use crate::common::{Random, random_motion, scaled_ellipsoid};
use pong_geometry::interference::ellipsoid_math::{
    nearest_on_ellipse, nearest_on_ellipsoid, second_nearest_on_ellipse, second_nearest_on_ellipsoid,
};
use pong_geometry::interference::point_ellipsoid::point_ellipsoid;
use pong_geometry::primitive::Ellipsoid;
use pong_geometry::{Mat3, Vec3};

/// Sum of two numbers, with twice the precision.
#[derive(Clone, Copy, Debug)]
struct Long(f64, f64);

impl Long {
    fn of(x: f64) -> Self {
        Self(x, 0.0)
    }
    fn add(self, o: Self) -> Self {
        let s = self.0 + o.0;
        let b = s - self.0;
        let e = (self.0 - (s - b)) + (o.0 - b) + self.1 + o.1;
        Self::settled(s, e)
    }
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
    fn mul(self, o: Self) -> Self {
        let p = self.0 * o.0;
        let e = self.0.mul_add(o.0, -p) + (self.0 * o.1 + self.1 * o.0);
        Self::settled(p, e)
    }
    fn div(self, o: Self) -> Self {
        let q1 = self.0 / o.0;
        let r = self.add(o.mul(Self::of(q1)).neg());
        let q2 = r.0 / o.0;
        let r = r.add(o.mul(Self::of(q2)).neg());
        Self::of(q1).add(Self::of(q2)).add(Self::of(r.0 / o.0))
    }
    fn sqrt(self) -> Self {
        if self.0 <= 0.0 {
            return Self::of(0.0);
        }
        let mut x = Self::of(self.0.sqrt());
        for _ in 0..2 {
            x = x.add(self.div(x)).mul(Self::of(0.5));
        }
        x
    }
    fn settled(s: f64, e: f64) -> Self {
        let t = s + e;
        Self(t, e - (t - s))
    }
    fn less(self, o: Self) -> bool {
        let d = self.add(o.neg());
        d.0 < 0.0
    }
}

/// Depth and normal of an inside point by bisection of the secular equation in double-double arithmetic.
///
/// The unknown is `u = t + a_min²`, so that roots near the pole keep their precision.
fn reference(a: &Vec3, y: &Vec3) -> (f64, Vec3) {
    let (ax, yx): (Vec<Long>, Vec<Long>) =
        ((0..3).map(|i| Long::of(a[i])).collect(), (0..3).map(|i| Long::of(y[i])).collect());
    let least = Long::of(a.min()).mul(Long::of(a.min()));
    let gap: Vec<Long> = ax.iter().map(|x| x.mul(*x).add(least.neg())).collect();
    let component = |u: Long, i: usize| {
        if yx[i].0 == 0.0 { Long::of(0.0) } else { ax[i].mul(yx[i]).div(gap[i].add(u)) }
    };
    let sum = |u: Long| {
        (0..3).fold(Long::of(0.0), |s, i| {
            let q = component(u, i);
            s.add(q.mul(q))
        })
    };
    let mut low = Long::of(0.0);
    let mut high = Long::of(a.component_mul(y).norm() * 2.0 + a.min() * a.min());
    for step in 0..420 {
        // Geometric bisection first, to reach roots of any magnitude.
        let middle = if step < 300 && high.0 > 2.0 * low.0 {
            Long::of((low.0.max(high.0 * 1e-30) * high.0).sqrt())
        } else {
            low.add(high).mul(Long::of(0.5))
        };
        if Long::of(1.0).less(sum(middle)) { low = middle } else { high = middle }
    }
    let u = high;
    let q: Vec<Long> = (0..3).map(|i| component(u, i)).collect();
    let g: Vec<Long> = (0..3).map(|i| q[i].div(ax[i])).collect();
    let length = g.iter().fold(Long::of(0.0), |s, x| s.add(x.mul(*x))).sqrt();
    let depth = least.add(u.neg()).mul(length);
    (depth.0, Vec3::new(g[0].div(length).0, g[1].div(length).0, g[2].div(length).0))
}

fn random_semi_axes(random: &mut Random, aspect_exponent: f64) -> Vec3 {
    Vec3::from_fn(|_, _| 10.0_f64.powf(random.between(-aspect_exponent, 0.0)))
}

#[test]
fn random_points_agree_with_long_arithmetic() {
    let mut random = Random(11);
    let (mut worst_depth, mut worst_normal, mut worst_relative) = (0.0_f64, 0.0_f64, 0.0_f64);
    for case in 0..20_000 {
        let a = random_semi_axes(&mut random, if case % 2 == 0 { 1.0 } else { 4.0 });
        let share = match case % 5 {
            0 => 1.0 - 10.0_f64.powf(random.between(-9.0, 0.0)),
            1 => 10.0_f64.powf(random.between(-9.0, 0.0)),
            _ => random.unit(),
        };
        let mut y = random.direction().component_mul(&a) * share;
        if case % 7 == 0 {
            y[case % 3] *= 1e-9;
        }
        let foot = nearest_on_ellipsoid(&a, &y);
        let (depth, normal) = reference(&a, &y);
        // Near the surface only the rounding of the point matters: measured against the smallest semi-axis.
        worst_depth = worst_depth.max((foot.depth - depth).abs() / a.min());
        if share < 0.99 {
            worst_relative = worst_relative.max((foot.depth - depth).abs() / depth);
        }
        let error = (Vec3::from(foot.normal) - normal).norm();
        // Two normals as close as the rounding of the depth allows are indistinguishable at the focal curve.
        let gap = normal.dot(&y);
        let honest = a.component_mul(&normal).norm() - gap;
        assert!((honest - depth).abs() < 1e-12 * a.max(), "the reference is stationary");
        worst_normal = worst_normal.max(error);
        assert!(error < 1e-6, "case {case}: a {a:?} y {y:?} normal {:?} reference {normal:?}", foot.normal);
    }
    println!(
        "depth/a_min {worst_depth:e}, depth relative (below 99 %) {worst_relative:e}, normal {worst_normal:e}"
    );
    assert!(worst_depth < 1e-11);
    assert!(worst_relative < 1e-11);
}

#[test]
fn moderate_aspects_reach_twelve_digits() {
    let mut random = Random(12);
    let (mut worst_depth, mut worst_normal) = (0.0_f64, 0.0_f64);
    for _ in 0..20_000 {
        let a = random_semi_axes(&mut random, 1.0);
        let y = random.direction().component_mul(&a) * random.between(0.0, 0.999);
        let foot = nearest_on_ellipsoid(&a, &y);
        let (depth, normal) = reference(&a, &y);
        worst_depth = worst_depth.max((foot.depth - depth).abs() / depth.max(1e-3 * a.max()));
        worst_normal = worst_normal.max((Vec3::from(foot.normal) - normal).norm());
    }
    println!("depth {worst_depth:e}, normal {worst_normal:e}");
    assert!(worst_depth < 1e-12);
}

#[test]
fn spheres_and_equal_axes() {
    let mut random = Random(13);
    for _ in 0..1000 {
        let y = random.direction() * random.between(0.01, 1.9);
        let foot = nearest_on_ellipsoid(&Vec3::repeat(2.0), &y);
        assert!((foot.depth - (2.0 - y.norm())).abs() < 4e-16 * 2.0);
        assert!((Vec3::from(foot.normal) - y.normalize()).norm() < 1e-15);
        assert!(second_nearest_on_ellipsoid(&Vec3::repeat(2.0), &y).is_none());
        // Oblate: compared with the ellipse in the half plane through the axis.
        let foot = nearest_on_ellipsoid(&Vec3::new(2.0, 2.0, 0.7), &Vec3::new(y.x, y.y, 0.3 * y.z));
        let flat = nearest_on_ellipse([2.0, 0.7], [(y.x * y.x + y.y * y.y).sqrt(), 0.3 * y.z]);
        assert!((foot.depth - flat.depth).abs() < 1e-14);
    }
}

#[test]
fn at_the_centre_the_first_smallest_axis_is_taken() {
    for (a, expected) in [
        (Vec3::new(3.0, 1.0, 2.0), Vec3::y()),
        (Vec3::new(1.0, 1.0, 2.0), Vec3::x()),
        (Vec3::new(2.0, 1.0, 1.0), Vec3::y()),
        (Vec3::new(1.0, 1.0, 1.0), Vec3::x()),
        (Vec3::new(1.0, 1e4, 1e-4), Vec3::z()),
    ] {
        let foot = nearest_on_ellipsoid(&a, &Vec3::zeros());
        assert_eq!(Vec3::from(foot.normal), expected);
        assert_eq!(foot.depth, a.min());
    }
}

#[test]
fn on_axes_and_symmetry_planes() {
    let a = Vec3::new(3.0, 1.0, 2.0);
    // On the longest axis the end is nearest beyond the centre of curvature at 3 − 1/3.
    let foot = nearest_on_ellipsoid(&a, &Vec3::new(-2.9, 0.0, 0.0));
    assert!((foot.depth - 0.1).abs() < 1e-15);
    assert_eq!(Vec3::from(foot.normal), -Vec3::x());
    // Before it, the nearest point is off the axis, in the plane of the longest and the shortest.
    let foot = nearest_on_ellipsoid(&a, &Vec3::new(1.0, 0.0, 0.0));
    assert!(foot.normal[1] > 0.0 && foot.normal[2] == 0.0);
    let x: f64 = 9.0 / 8.0;
    let depth = ((x - 1.0).powi(2) + (1.0 - x * x / 9.0)).sqrt();
    assert!((foot.depth - depth).abs() < 1e-15);
    // On the shortest axis.
    for y in [-0.9, -1e-9, 1e-300, 0.4, 0.999] {
        let foot = nearest_on_ellipsoid(&a, &Vec3::new(0.0, y, 0.0));
        assert!((foot.depth - (1.0 - y.abs())).abs() < 1e-15, "{y}");
        assert!((foot.normal[1].abs() - 1.0).abs() < 1e-15 && foot.normal[1] * y > 0.0);
    }
    // On the middle axis and beyond its centre of curvature at 2 − 1/2.
    let foot = nearest_on_ellipsoid(&a, &Vec3::new(0.0, 0.0, 1.75));
    assert!((foot.depth - 0.25).abs() < 1e-15);
}

/// Beyond the ellipse of the centres of curvature the nearest point lies in the plane perpendicular to the
/// shortest axis, as for the ellipse in that plane; the other minimum does not exist.
#[test]
fn in_the_plane_across_the_shortest_axis_near_the_rim() {
    /// Some units in the last place of half widths of metres, m: two roots are compared.
    const ROUNDING: f64 = 4e-15;
    let a = Vec3::new(3.0, 2.0, 1.0);
    let mut beyond = 0;
    for (x, y) in (0..48).flat_map(|i| (0..32).map(move |j| (f64::from(i) / 16.0, f64::from(j) / 16.0))) {
        let inside = x * x / 9.0 + y * y / 4.0 < 1.0;
        // Values aᵢ·yᵢ/(aᵢ² − 1), neither of which may exceed 1 by itself.
        let (u, v) = (3.0 * x / 8.0, 2.0 * y / 3.0);
        if !inside || u * u + v * v <= 1.0 {
            continue;
        }
        beyond += usize::from(u < 1.0 && v < 1.0);
        let place = Vec3::new(x, -y, 0.0);
        let foot = nearest_on_ellipsoid(&a, &place);
        let flat = nearest_on_ellipse([3.0, 2.0], [x, -y]);
        assert!((foot.depth - flat.depth).abs() < ROUNDING, "{place:?}: {foot:?} {flat:?}");
        assert_eq!(foot.normal[2], 0.0);
        assert_eq!(second_nearest_on_ellipsoid(&a, &place), None, "{place:?}");
    }
    assert!(beyond > 50);
}

#[test]
fn at_the_focal_curve_the_depth_stays_exact() {
    // Centre of curvature of the end of the long axis.
    let a = Vec3::new(2.0, 1.0, 1.5);
    for step in [-1e-3, -1e-8, -1e-15, 0.0, 1e-15, 1e-8, 1e-3] {
        for off in [1e-30, 1e-18, 1e-12, 1e-8, 1e-4] {
            let y = Vec3::new(1.5 + step, off, 0.0);
            let foot = nearest_on_ellipsoid(&a, &y);
            let (depth, _) = reference(&a, &y);
            assert!((foot.depth - depth).abs() < 4e-15, "{step} {off}: {} {depth}", foot.depth);
        }
    }
}

#[test]
fn outside_points_have_their_distance() {
    let mut random = Random(14);
    for _ in 0..5000 {
        let a = random_semi_axes(&mut random, 2.0);
        let y = random.direction().component_mul(&a) * random.between(1.0, 30.0);
        let foot = nearest_on_ellipsoid(&a, &y);
        let (x, n) = (Vec3::from(foot.point), Vec3::from(foot.normal));
        assert!((x.component_div(&a).norm() - 1.0).abs() < 1e-14);
        assert!((x - y).cross(&n).norm() < 1e-11 * (x - y).norm().max(1e-3));
        assert!((foot.depth + (x - y).norm()).abs() < 1e-13 * y.norm());
    }
}

/// Local minima of the distance from inside or beyond along the inner normal, by scanning the parameter.
fn ellipse_minima(a: [f64; 2], y: [f64; 2]) -> Vec<f64> {
    let overlap = |angle: f64| {
        let (s, c) = angle.sin_cos();
        (a[0] * c).hypot(a[1] * s) - c * y[0] - s * y[1]
    };
    const COUNT: usize = 40_000;
    let at = |k: usize| overlap((k % COUNT) as f64 * std::f64::consts::TAU / COUNT as f64);
    let mut minima = Vec::new();
    for k in 0..COUNT {
        let (before, here, after) = (at(k + COUNT - 1), at(k), at(k + 1));
        if here <= before && here < after {
            // Parabola through three samples.
            let bend = before - 2.0 * here + after;
            minima.push(here - (after - before).powi(2) / (8.0 * bend));
        }
    }
    minima
}

#[test]
fn both_minima_of_an_ellipse_are_found() {
    let mut random = Random(15);
    let mut seconds = 0;
    for _ in 0..400 {
        let a = [random.between(0.2, 1.0), random.between(0.2, 1.0)];
        let y = [random.between(-1.2, 1.2), random.between(-1.2, 1.2)];
        let mut found = vec![nearest_on_ellipse(a, y).depth];
        found.extend(second_nearest_on_ellipse(a, y).map(|foot| foot.depth));
        seconds += found.len() - 1;
        found.sort_by(f64::total_cmp);
        let mut scanned = ellipse_minima(a, y);
        scanned.sort_by(f64::total_cmp);
        assert_eq!(found.len(), scanned.len(), "a {a:?} y {y:?}: {found:?} {scanned:?}");
        for (f, s) in found.iter().zip(&scanned) {
            assert!((f - s).abs() < 1e-9, "a {a:?} y {y:?}: {found:?} {scanned:?}");
        }
    }
    println!("{seconds} second minima");
    assert!(seconds > 20);
}

#[test]
fn the_second_minimum_is_a_local_minimum_and_there_is_no_third() {
    let mut random = Random(16);
    let mut seconds = 0;
    for _ in 0..300 {
        let a = random_semi_axes(&mut random, 0.6);
        let y = random.direction().component_mul(&a) * random.between(0.0, 1.2);
        let overlap = |n: &Vec3| a.component_mul(n).norm() - n.dot(&y);
        let mut known = vec![nearest_on_ellipsoid(&a, &y).normal];
        known.extend(second_nearest_on_ellipsoid(&a, &y).map(|foot| foot.normal));
        seconds += known.len() - 1;
        for start in common::fibonacci_sphere(60) {
            // Steepest descent with halving steps from every side ends in one of the known minima.
            let mut n = start;
            let mut step = 0.3;
            let mut value = overlap(&n);
            for _ in 0..4000 {
                let widened = a.component_mul(&a).component_mul(&n) / a.component_mul(&n).norm();
                let gradient = widened - y;
                let tangent = gradient - n * gradient.dot(&n);
                let next = (n - tangent * step).normalize();
                let next_value = overlap(&next);
                if next_value < value {
                    n = next;
                    value = next_value;
                    step *= 1.5;
                } else {
                    step *= 0.4;
                }
                if step < 1e-16 {
                    break;
                }
            }
            let reached = known
                .iter()
                .map(|k| overlap(&Vec3::from(*k)) - value)
                .fold(f64::INFINITY, |m, d| m.min(d.abs()));
            // Descent may stop early in a flat valley, but must never end below a known minimum.
            let least = known.iter().map(|k| overlap(&Vec3::from(*k))).fold(f64::INFINITY, f64::min);
            assert!(value > least - 1e-12);
            let is_stuck = reached > 1e-6;
            assert!(!is_stuck, "a {a:?} y {y:?} from {start:?}: {value} at {n:?}, known {known:?}");
        }
    }
    println!("{seconds} second minima");
    assert!(seconds > 30);
}

#[test]
fn mirrored_minima_on_the_plane_across_the_shortest_axis() {
    let a = Vec3::new(2.0, 0.5, 1.0);
    let y = Vec3::new(0.3, 0.0, -0.1);
    let first = nearest_on_ellipsoid(&a, &y);
    let second = second_nearest_on_ellipsoid(&a, &y).expect("a mirror image");
    assert_eq!(first.depth, second.depth);
    assert_eq!(first.normal[1], -second.normal[1]);
    assert!(first.normal[1] > 0.0);
    // With two equal shortest axes there is a circle of nearest points, and no second minimum.
    for a in [Vec3::new(2.0, 0.5, 0.5), Vec3::repeat(0.5)] {
        assert_eq!(second_nearest_on_ellipsoid(&a, &Vec3::new(0.1, 0.0, 0.0)), None);
    }
}

#[test]
fn contacts_move_and_scale_with_the_scene() {
    let mut random = Random(17);
    for _ in 0..2000 {
        let e = Ellipsoid {
            center: random.direction(),
            axes: random.rotation_matrix(),
            semi_axes: random_semi_axes(&mut random, 1.0),
        };
        let inside = e.axes * random.direction().component_mul(&e.semi_axes) * random.between(0.0, 0.95);
        let p = e.center + inside;
        let contact = point_ellipsoid(&p, &e).expect("inside");
        assert_eq!(contact.deepest_b, p);
        let surface = p + contact.normal_b * contact.depth;
        let unit = e.axes.tr_mul(&(surface - e.center)).component_div(&e.semi_axes).norm();
        assert!((unit - 1.0).abs() < 1e-9);
        for factor in [1e-4, 1e4] {
            let big = point_ellipsoid(&(p * factor), &scaled_ellipsoid(&e, factor)).expect("inside");
            assert!((big.depth - contact.depth * factor).abs() < 1e-10 * contact.depth * factor);
            assert!((big.normal_b - contact.normal_b).norm() < 1e-9);
        }
        let x = random_motion(&mut random, 3.0);
        let far = point_ellipsoid(&x.point(&p), &e.carried(&x)).expect("inside");
        assert!((far.depth - contact.depth).abs() < 1e-13);
        let outside = e.center + inside / unit_radius(&e, &inside) * 1.0001;
        assert!(point_ellipsoid(&outside, &e).is_none());
    }
}

fn unit_radius(e: &Ellipsoid, v: &Vec3) -> f64 {
    e.axes.tr_mul(v).component_div(&e.semi_axes).norm()
}

#[test]
fn grazing_points_come_in_without_a_step() {
    let e = Ellipsoid { center: Vec3::zeros(), axes: Mat3::identity(), semi_axes: Vec3::new(1.0, 0.5, 0.25) };
    let surface = Vec3::new(0.6, 0.5 * 0.64, 0.25 * 0.48);
    let normal = Vec3::new(0.6, 0.64 / 0.5, 0.48 / 0.25).normalize();
    for depth in [1e-3, 1e-6, 1e-9, 1e-12] {
        let contact = point_ellipsoid(&(surface - normal * depth), &e).expect("inside");
        assert!((contact.depth - depth).abs() < 1e-15);
        assert!((contact.normal_b - normal).norm() < 1e-14);
    }
    assert!(point_ellipsoid(&(surface + normal * 1e-15), &e).is_none_or(|contact| contact.depth < 1e-15));
}
