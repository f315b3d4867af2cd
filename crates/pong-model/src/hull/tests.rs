//! Cost of reading a solid, in visited boxes; no clock is used.

use super::*;

/// Unit sphere with its poles on the third axis: triangles at the poles, quadrilaterals elsewhere.
fn ball(circles: u32, meridians: u32) -> (Vec<Vec3>, Vec<Vec<u32>>) {
    let pi = std::f64::consts::PI;
    let mut vertices = vec![Vec3::z(), -Vec3::z()];
    for circle in 1..circles {
        let (sine, cosine) = libm::sincos(pi * f64::from(circle) / f64::from(circles));
        for meridian in 0..meridians {
            let (y, x) = libm::sincos(2.0 * pi * f64::from(meridian) / f64::from(meridians));
            vertices.push(Vec3::new(sine * x, sine * y, cosine));
        }
    }
    let at = |circle: u32, meridian: u32| 2 + (circle - 1) * meridians + meridian % meridians;
    let mut faces = Vec::new();
    for m in 0..meridians {
        faces.push(vec![0, at(1, m), at(1, m + 1)]);
        faces.push(vec![1, at(circles - 1, m + 1), at(circles - 1, m)]);
        let quadrangle = |c: u32| vec![at(c, m), at(c + 1, m), at(c + 1, m + 1), at(c, m + 1)];
        faces.extend((1..circles - 1).map(quadrangle));
    }
    (vertices, faces)
}

/// Thin triangles at the poles are so nearly coplanar that they are merged again and again, with smaller
/// tolerances. Failed attempts cost little compared with testing every face once.
#[test]
fn a_ball_that_takes_many_attempts_costs_little_more() {
    let (vertices, faces) = ball(40, 1000);
    let active = vec![true; faces.len()];
    let tree = Places::new(&vertices);
    let authored = merge::Faces::new(&vertices, &faces, &active, 2.0);
    let of_attempt = |attempt| faces_of_attempt(attempt, &vertices, &authored, 2.0 * PLANE_TOLERANCE);
    assert!(checks::convex(&vertices, &faces_alone(of_attempt(0)), &tree, 2.0).is_err());
    tree.looked.set(0);
    let mut once = of_attempt(merge::LEVELS + 1);
    for merged in &mut once {
        assert!(merge::support(&vertices, merged, &tree, 2.0 * PLANE_TOLERANCE));
    }
    assert!(checks::convex(&vertices, &faces_alone(once), &tree, 2.0).is_ok());
    let looked_once = tree.looked.replace(0);
    let solid = Solid { vertices: &vertices, tree: &tree, diameter: 2.0, active: &active };
    assert!(solid.convex_faces(&faces).is_ok());
    let looked = tree.looked.get();
    assert!(2 * looked < 3 * looked_once, "{looked} boxes, {looked_once} at every face once");
}
