//! Origin of the page's positions: far from a common origin, single precision would make bodies jitter.

use pong_geometry::Vec3;

/// The view moves along when all bodies travel together more than this many times the size of the scene.
const FAR: f64 = 10.0;

/// The origin of positions.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Origin {
    /// A constant origin.
    Fixed(Vec3),
    /// The position of the body with this index in each frame.
    With(usize, Vec<Vec3>),
}

impl Origin {
    /// Chooses the origin from the positions of all bodies, frame after frame (NaN where unknown), and their
    /// radii, m.
    pub fn choose(places: &[Vec<Vec3>], radii: &[f64]) -> Self {
        let known = |p: &&Vec3| p.iter().all(|x| x.is_finite());
        let all = || places.iter().flatten().filter(known);
        let Some(lead) = (0..radii.len()).find(|&body| places.iter().all(|frame| known(&&frame[body])))
        else {
            return Self::Fixed(all().next().copied().unwrap_or_else(Vec3::zeros));
        };
        let spread =
            places.iter().flat_map(|frame| frame.iter().filter(known).map(|p| (p - frame[lead]).norm()));
        let size = spread.chain(radii.iter().map(|r| 2.0 * r)).fold(0.0, f64::max);
        let travel = (0..radii.len()).map(|body| travel(places.iter().map(|frame| frame[body])));
        if !places.is_empty() && travel.fold(f64::INFINITY, f64::min) > FAR * size {
            return Self::With(lead, places.iter().map(|frame| frame[lead]).collect());
        }
        let (low, high) = bounds(all().copied());
        if all().next().is_none() { Self::Fixed(Vec3::zeros()) } else { Self::Fixed(0.5 * (low + high)) }
    }

    /// The origin in a frame, m.
    pub fn at(&self, frame: usize) -> Vec3 {
        match self {
            Self::Fixed(place) => *place,
            Self::With(_, places) => places[frame],
        }
    }
}

/// Diagonal of the box around a body's path, m; 0 if it has no position.
fn travel(path: impl Iterator<Item = Vec3>) -> f64 {
    let (low, high) = bounds(path.filter(|p| p.iter().all(|x| x.is_finite())));
    if low.x <= high.x { (high - low).norm() } else { 0.0 }
}

fn bounds(places: impl Iterator<Item = Vec3>) -> (Vec3, Vec3) {
    let none = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    places.fold(none, |(low, high), p| (low.inf(&p), high.sup(&p)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(start: Vec3, velocity: Vec3, seconds: usize) -> Vec<Vec3> {
        (0..=seconds).map(|second| start + velocity * second as f64).collect()
    }

    fn frames(paths: &[Vec<Vec3>]) -> Vec<Vec<Vec3>> {
        (0..paths[0].len()).map(|frame| paths.iter().map(|path| path[frame]).collect()).collect()
    }

    #[test]
    fn in_orbit_the_view_travels_along() {
        let radius = Vec3::new(6.8e6, 0.0, 0.0);
        let orbit = Vec3::new(0.0, 7.6e3, 0.0);
        let other = path(radius + Vec3::new(0.0, 5.0, 0.0), orbit - Vec3::new(0.0, 0.05, 0.0), 60);
        let places = frames(&[path(radius, orbit, 60), other]);
        let origin = Origin::choose(&places, &[1.0, 1.0]);
        assert!(matches!(origin, Origin::With(0, _)));
        for (frame, bodies) in places.iter().enumerate() {
            assert!((bodies[1] - origin.at(frame)).norm() < 6.0);
        }
    }

    #[test]
    fn over_ground_the_view_stays() {
        let ground = path(Vec3::new(6.4e6, 0.0, 0.0), Vec3::zeros(), 60);
        let rover = path(Vec3::new(6.4e6, 1.0, 0.0), Vec3::new(0.0, 20.0, 0.0), 60);
        let origin = Origin::choose(&frames(&[ground, rover]), &[0.0, 0.5]);
        let Origin::Fixed(place) = origin else { panic!("{origin:?}") };
        assert!((place - Vec3::new(6.4e6, 600.0, 0.0)).norm() < 10.0);
    }

    #[test]
    fn bodies_that_are_nowhere_count_for_nothing() {
        let nowhere = path(Vec3::repeat(f64::NAN), Vec3::zeros(), 3);
        let one = path(Vec3::new(5.0, 0.0, 0.0), Vec3::zeros(), 3);
        assert_eq!(
            Origin::choose(&frames(&[nowhere.clone(), one]), &[1.0, 1.0]),
            Origin::Fixed(Vec3::new(5.0, 0.0, 0.0))
        );
        assert_eq!(Origin::choose(&frames(&[nowhere]), &[1.0]), Origin::Fixed(Vec3::zeros()));
    }
}
