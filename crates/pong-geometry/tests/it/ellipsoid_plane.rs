//! Ellipsoid against plane: the closed form, to 1e-14 of the largest coordinate.

use crate::common::{Random, scaled_ellipsoid};
use pong_geometry::interference::ellipsoid_plane::ellipsoid_plane;
use pong_geometry::primitive::{Ellipsoid, Plane};
use pong_geometry::{Mat3, Vec3};

#[test]
fn closed_form_on_tilted_planes() {
    let mut random = Random(21);
    for _ in 0..10_000 {
        let semi_axes = Vec3::from_fn(|_, _| 10.0_f64.powf(random.between(-4.0, 0.0)));
        let e = Ellipsoid { center: random.direction() * 3.0, axes: random.rotation_matrix(), semi_axes };
        let normal = random.direction();
        let half_width =
            (0..3).map(|i| (semi_axes[i] * e.axes.column(i).dot(&normal)).powi(2)).sum::<f64>().sqrt();
        let depth = half_width * random.between(1e-3, 3.0);
        let plane = Plane { normal, offset: normal.dot(&e.center) - half_width + depth };
        let contact = ellipsoid_plane(&e, &plane).expect("overlap");
        assert!((contact.depth - depth).abs() < 3e-14);
        assert_eq!(contact.normal_b, normal);
        assert!((plane.height(&contact.deepest_b) + depth).abs() < 3e-14);
        let local = e.axes.tr_mul(&(contact.deepest_b - e.center)).component_div(&semi_axes);
        assert!((local.norm() - 1.0).abs() < 1e-11);
        for factor in [1e-4, 1e4] {
            let plane = Plane { normal, offset: plane.offset * factor };
            let big = ellipsoid_plane(&scaled_ellipsoid(&e, factor), &plane).expect("overlap");
            assert!((big.depth - contact.depth * factor).abs() < 3e-14 * factor);
        }
    }
}

#[test]
fn touching_without_overlap_is_no_contact() {
    let e = Ellipsoid {
        center: Vec3::new(0.0, 0.0, 2.0),
        axes: Mat3::identity(),
        semi_axes: Vec3::new(4.0, 3.0, 2.0),
    };
    let plane = |offset| Plane { normal: Vec3::z(), offset };
    assert!(ellipsoid_plane(&e, &plane(0.0)).is_none());
    let contact = ellipsoid_plane(&e, &plane(1e-12)).expect("overlap");
    assert!((contact.depth - 1e-12).abs() < 4e-16);
    assert_eq!(contact.deepest_b, Vec3::zeros());
}
