//! Bounding volumes never miss: whenever two bodies have a common point, their volumes overlap.
//!
//! Degenerate cases among the random ones: points, needles and plates without volume; rotations that leave axes
//! parallel, to the last bit or nearly; bodies far from their frame's origin; volumes that share one point of
//! their surfaces; edges that cross while nearly parallel; a volume against one 1e8 times its size.

use crate::bounding_support::{
    KINDS, Random, corner, extreme_of, fitted_bodies, meeting, tricky_direction, tricky_rotation,
};
use pong_geometry::Vec3;
use pong_geometry::bounding::{Bounded, Volume, VolumeTests};

const TRIALS: usize = 150_000;

#[test]
fn bodies_that_share_a_point_have_volumes_that_overlap() {
    let mut random = Random(1);
    let bodies = fitted_bodies(&mut random, 600);
    let tests = VolumeTests::default();
    for (i, kind_a) in KINDS.iter().enumerate() {
        for (j, kind_b) in KINDS.iter().enumerate() {
            for trial in 0..TRIALS {
                let (a, b) = (&bodies[random.below(bodies.len())], &bodies[random.below(bodies.len())]);
                let rotation = tricky_rotation(&mut random);
                let (in_a, in_b) = if random.below(4) == 0 {
                    (a.body.inside(&mut random), b.body.inside(&mut random))
                } else {
                    // They touch from outside: only the common point keeps them from being disjoint.
                    let n_b = tricky_direction(&mut random);
                    (a.body.extreme(&-rotation.tr_mul(&n_b)), b.body.extreme(&n_b))
                };
                let x_ba = meeting(rotation, &in_a, &in_b);
                assert!(
                    tests.overlap(&a.volumes[i], &b.volumes[j], &x_ba),
                    "{kind_a:?} {kind_b:?} trial {trial}: {:?} {:?} {x_ba:?}",
                    a.volumes[i],
                    b.volumes[j]
                );
            }
        }
    }
}

/// Two boxes around their origins touch where an edge of one crosses an edge of the other. The boxes have no
/// margin, so the test itself has to be right.
#[test]
fn crossing_edges_touch_however_nearly_parallel() {
    let mut random = Random(2);
    let tests = VolumeTests::default();
    for trial in 0..4 * TRIALS {
        let scale = random.log_between(1e-4, 1e4);
        let mut sizes = || Vec3::from_fn(|_, _| scale * random.log_between(1e-8, 1.0));
        let (half_a, half_b) = (sizes(), sizes());
        let rotation = tricky_rotation(&mut random);
        let (i, j) = (random.below(3), random.below(3));
        let mut n_b = Vec3::ith(i, 1.0).cross(&rotation.column(j));
        if n_b.norm() == 0.0 {
            n_b = Vec3::ith((i + 1) % 3, 1.0);
        }
        let corners = |half: &Vec3| (0..8).map(|c| corner(c, half)).collect::<Vec<_>>();
        let mut in_a = extreme_of(&corners(&half_a), &-rotation.tr_mul(&n_b));
        let mut in_b = extreme_of(&corners(&half_b), &n_b);
        in_a[j] = half_a[j] * random.between(-1.0, 1.0);
        in_b[i] = half_b[i] * random.between(-1.0, 1.0);
        let x_ba = meeting(rotation, &in_a, &in_b);
        let a = Volume::Aabb { center: Vec3::zeros(), half: half_a };
        let b = Volume::Aabb { center: Vec3::zeros(), half: half_b };
        assert!(tests.overlap(&a, &b, &x_ba), "trial {trial}: {a:?} {b:?} {x_ba:?}");
    }
}

#[test]
fn parents_overlap_whatever_touches_a_child() {
    let mut random = Random(3);
    let bodies = fitted_bodies(&mut random, 60);
    let tests = VolumeTests::default();
    let ext = pong_geometry::extension::Extensions::new();
    for parent_kind in &KINDS {
        for _ in 0..300 {
            let children: Vec<_> =
                (0..1 + random.below(5)).map(|_| &bodies[random.below(bodies.len())]).collect();
            let volumes: Vec<&dyn Bounded> = children
                .iter()
                .map(|child| &child.volumes[random.below(child.volumes.len())] as &dyn Bounded)
                .collect();
            let parent = pong_geometry::bounding::fit(parent_kind, &volumes, &ext).expect("finite children");
            for _ in 0..100 {
                let (other, rotation, n_b) = (
                    &bodies[random.below(bodies.len())],
                    tricky_rotation(&mut random),
                    tricky_direction(&mut random),
                );
                let in_a = &children[random.below(children.len())].body.extreme(&-rotation.tr_mul(&n_b));
                let x_ba = meeting(rotation, in_a, &other.body.extreme(&n_b));
                for volume in &other.volumes {
                    assert!(tests.overlap(&parent, volume, &x_ba));
                    assert!(tests.overlap(volume, &parent, &x_ba.inverse()));
                }
            }
        }
    }
}

#[test]
fn a_pose_that_is_not_a_number_overlaps() {
    let mut random = Random(4);
    let bodies = fitted_bodies(&mut random, 4);
    let tests = VolumeTests::default();
    let nowhere = meeting(tricky_rotation(&mut random), &Vec3::repeat(f64::NAN), &Vec3::zeros());
    for a in &bodies[0].volumes {
        for b in &bodies[1].volumes {
            assert!(tests.overlap(a, b, &nowhere));
        }
    }
}
