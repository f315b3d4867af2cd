//! Bounding sphere. Its radius is exact for its centre: the distance of the farthest point of all shapes. The
//! centre is close to that of the minimum sphere.

use super::bounded::{largest, representatives};
use super::volume::{Bounded, Volume};
use crate::Vec3;

/// Returns the smallest sphere found around the shapes, without margin. `box_center` is the centre of the
/// shapes' axis-aligned box.
pub(super) fn fit_sphere(things: &[&dyn Bounded], box_center: &Vec3) -> Volume {
    let points = representatives(things);
    let radius_about = |center: &Vec3| largest(things.iter().map(|thing| thing.farthest(center)));
    let mut best = Ball { center: *box_center, radius: radius_about(box_center) };
    best.take_if_smaller(drawn_to_farthest(&points, *box_center), &radius_about);
    best.refine(&radius_about);
    Volume::Sphere { center: best.center, radius: best.radius }
}

struct Ball {
    center: Vec3,
    radius: f64,
}

impl Ball {
    fn take_if_smaller(&mut self, center: Vec3, radius_about: &impl Fn(&Vec3) -> f64) -> bool {
        let radius = radius_about(&center);
        let smaller = radius < self.radius;
        if smaller {
            *self = Self { center, radius };
        }
        smaller
    }

    /// Moves the centre along the axes by smaller and smaller steps while the radius shrinks. The radius is
    /// measured around the shapes themselves, because their representative points do not cover curved
    /// surfaces.
    fn refine(&mut self, radius_about: &impl Fn(&Vec3) -> f64) {
        const HALVINGS: usize = 12;
        let mut step = 0.125 * self.radius;
        for _ in 0..HALVINGS {
            for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
                if !self.take_if_smaller(self.center + axis * step, radius_about) {
                    self.take_if_smaller(self.center - axis * step, radius_about);
                }
            }
            step *= 0.5;
        }
    }
}

fn farthest_point<'a>(points: &'a [Vec3], from: &Vec3) -> Option<&'a Vec3> {
    let distance = |p: &Vec3| (p - from).norm_squared();
    points.iter().reduce(|far, p| if distance(p) > distance(far) { p } else { far })
}

/// Returns the approximate centre of the minimum sphere around points. In step k the centre moves by 1/(k+1)
/// of the way to the farthest point (Bădoiu and Clarkson 2003). The first steps, which are large, are
/// skipped, because the start is close already.
fn drawn_to_farthest(points: &[Vec3], start: Vec3) -> Vec3 {
    (10..150).fold(start, |center, k| match farthest_point(points, &center) {
        Some(far) => center + (far - center) / f64::from(k + 1),
        None => center,
    })
}
