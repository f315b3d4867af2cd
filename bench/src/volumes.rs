//! One pair of bounding volumes per query: every pair of kinds, overlapping and apart.

use crate::pairs::place;
use crate::random::{Random, rotation};
use pong_geometry::bounding::{Volume, VolumeTests};
use pong_geometry::{Pose, Transform, Vec3};

/// Two volumes and their relative poses.
pub struct VolumePair {
    /// Volume in its own frame; transformed to B.
    pub a: Volume,
    /// Volume in its own frame.
    pub b: Volume,
    /// True if they overlap, by construction.
    pub overlap: bool,
    /// Poses of A's frame in B's.
    pub transforms: Vec<Transform>,
}

impl VolumePair {
    /// All pairs of kinds, each overlapping and apart, at `count` random poses.
    pub fn all(count: usize) -> Vec<Self> {
        let mut random = Random(0x766f_6c75);
        let mut out = Vec::new();
        for a in kinds(&mut random) {
            for b in kinds(&mut random) {
                for overlap in [true, false] {
                    let transforms = (0..count).map(|_| pose(&mut random, &a, &b, overlap)).collect();
                    out.push(Self { a: a.clone(), b: b.clone(), overlap, transforms });
                }
            }
        }
        out
    }

    /// Name such as `Aabb-Sphere`.
    pub fn name(&self) -> String {
        format!("{}-{}", self.a.kind_name(), self.b.kind_name())
    }

    /// Number of poses that test as overlapping.
    pub fn met(&self, tests: &VolumeTests) -> usize {
        self.transforms.iter().filter(|x_ba| tests.overlap(&self.a, &self.b, x_ba)).count()
    }
}

/// One volume of each bounded kind, near the origin.
fn kinds(random: &mut Random) -> Vec<Volume> {
    let mut shape = || (random.direction() * 0.05, Vec3::from_fn(|_, _| random.between(0.2, 0.5)));
    let [(c, h), (d, k), (e, r)] = [shape(), shape(), shape()];
    let axes = rotation(random).to_rotation_matrix().into_inner();
    let mut all = vec![
        Volume::Aabb { center: c, half: h },
        Volume::Sphere { center: e, radius: r.x },
        Volume::Obb { center: d, axes, half: k },
        Volume::Unbounded,
    ];
    all.retain(is_benched);
    all
}

/// True if the kind has a test to measure. Lists every kind: a new one must be added to [`kinds`].
fn is_benched(volume: &Volume) -> bool {
    match volume {
        Volume::Aabb { .. } | Volume::Sphere { .. } | Volume::Obb { .. } => true,
        // Constant answer, and the user's own test.
        Volume::Unbounded | Volume::Custom(_) => false,
    }
}

/// A pose on a random line from coincident centres to where the test separates them.
fn pose(random: &mut Random, a: &Volume, b: &Volume, overlap: bool) -> Transform {
    let (orientation, line) = (rotation(random), random.direction());
    let tests = VolumeTests::default();
    let at = |along: f64| Pose { position: line * along, orientation };
    place(random, overlap, at, |x_ba| tests.overlap(a, b, x_ba)).transform()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points in a volume and on its surface.
    fn points(volume: &Volume, random: &mut Random) -> Vec<Vec3> {
        let mut cube = || Vec3::from_fn(|_, _| random.between(-1.0, 1.0));
        let point = |v: Vec3| match volume {
            Volume::Aabb { center, half } => center + half.component_mul(&v),
            Volume::Sphere { center, radius } => center + v * (radius / v.norm().max(1.0)),
            Volume::Obb { center, axes, half } => center + axes * half.component_mul(&v),
            _ => unreachable!("has a size"),
        };
        (0..4000).map(|_| point(cube())).collect()
    }

    fn holds(volume: &Volume, p: &Vec3) -> bool {
        let within = |v: Vec3, half: &Vec3| (half - v.abs()).min() >= 0.0;
        match volume {
            Volume::Aabb { center, half } => within(p - center, half),
            Volume::Sphere { center, radius } => (p - center).norm() <= *radius,
            Volume::Obb { center, axes, half } => within(axes.tr_mul(&(p - center)), half),
            _ => unreachable!("has a size"),
        }
    }

    #[test]
    fn all_nine_pairs_are_there_and_overlap_or_not_as_made() {
        let all = VolumePair::all(64);
        assert_eq!(all.len(), 18);
        let tests = VolumeTests::default();
        for pair in &all {
            assert_eq!(pair.met(&tests), if pair.overlap { 64 } else { 0 }, "{}", pair.name());
        }
    }

    #[test]
    fn what_is_apart_shares_no_point() {
        let mut random = Random(7);
        for pair in VolumePair::all(4).iter().filter(|pair| !pair.overlap) {
            for x_ba in &pair.transforms {
                let carried = points(&pair.a, &mut random).into_iter().map(|p| x_ba.point(&p));
                assert_eq!(carried.filter(|p| holds(&pair.b, p)).count(), 0, "{}", pair.name());
            }
        }
    }
}
