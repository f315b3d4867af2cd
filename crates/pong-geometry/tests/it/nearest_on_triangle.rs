//! Nearest point of a triangle surface, and the side of the surface on which a point lies.
//!
//! A point is in front of a convex closed surface exactly if it is outside; for the same surface inside out,
//! if it is inside. Degenerate cases: sharp spikes and thin wedges, at whose edges and tips a single face
//! gives the wrong side.

use crate::common::{Random, hull, random_motion, surface_of, triangle_set};
use pong_geometry::Vec3;
use pong_geometry::interference::nearest_on_triangle::{Place, is_in_front_at, nearest_on_triangle};
use pong_geometry::primitive::TriangleSet;

fn nearest(p: &Vec3, set: &TriangleSet) -> (f64, u32, Place) {
    let all = (0..set.triangles.len() as u32).map(|t| {
        let (square, place) = nearest_on_triangle(p, &set.corners(t));
        (square, t, place)
    });
    all.min_by(|a, b| a.0.total_cmp(&b.0)).expect("triangles")
}

#[test]
fn outside_is_in_front_of_a_closed_convex_surface_and_behind_it_inside_out() {
    let mut random = Random(31);
    let (mut on_edges, mut on_corners, mut one_face_is_wrong) = (0, 0, 0);
    for _ in 0..300 {
        // Tetrahedra, some of them needles and blades.
        let flat = Vec3::from_fn(|_, _| 10_f64.powf(random.between(-2.0, 0.0)));
        let corners: Vec<Vec3> = (0..4).map(|_| random.direction().component_mul(&flat)).collect();
        let solid = hull(&corners);
        if solid.faces.len() < 4 {
            continue;
        }
        let set = surface_of(&solid);
        let turned: Vec<[u32; 3]> =
            set.triangles.iter().map(|t| [t.vertices[0], t.vertices[2], t.vertices[1]]).collect();
        let inside_out = triangle_set(set.vertices.clone(), &turned);
        for _ in 0..100 {
            let p = random.direction().component_mul(&flat) * random.between(0.0, 2.0);
            let (square, triangle, place) = nearest(&p, &set);
            if square < 1e-20 {
                continue;
            }
            let outside = solid.faces.iter().any(|face| face.height(&p) > 0.0);
            assert_eq!(is_in_front_at(&p, &set, triangle, place), outside, "{p:?} {place:?}");
            let (_, other, other_place) = nearest(&p, &inside_out);
            assert_eq!(is_in_front_at(&p, &inside_out, other, other_place), !outside, "{p:?} {place:?}");
            on_edges += usize::from(matches!(place, Place::Edge(_)));
            on_corners += usize::from(matches!(place, Place::Corner(_)));
            let view_height = set.normal(triangle).dot(&(p - set.corners(triangle)[0]));
            one_face_is_wrong += usize::from((view_height >= 0.0) != outside);
        }
    }
    println!(
        "{on_edges} on edges, {on_corners} at corners, {one_face_is_wrong} where one face says the wrong side"
    );
    assert!(on_edges > 1000 && on_corners > 1000 && one_face_is_wrong > 100);
}

/// No point of a fine grid over the triangle is nearer.
#[test]
fn no_place_of_the_triangle_is_nearer() {
    let mut random = Random(32);
    for _ in 0..500 {
        let corners = [0; 3].map(|_| random.direction());
        let p = random.direction() * random.between(0.0, 3.0);
        let (square, _) = nearest_on_triangle(&p, &corners);
        let mut least = f64::INFINITY;
        for (i, j) in (0..=60).flat_map(|i| (0..=60 - i).map(move |j| (i, j))) {
            let (u, v) = (f64::from(i) / 60.0, f64::from(j) / 60.0);
            let place = corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
            least = least.min((p - place).norm_squared());
        }
        assert!(square <= least + 1e-12 && least.sqrt() - square.sqrt() < 0.06, "{square} {least}");
    }
}

/// For a point beyond an edge and over one of its ends, both triangles assign it to the edge, or both to the
/// corner, in any order of vertices and any pose.
#[test]
fn both_triangles_of_an_edge_agree_where_it_ends() {
    let mut random = Random(32);
    let mut on_edge = 0;
    for _ in 0..20_000 {
        let motion = random_motion(&mut random, 1.0);
        let slope = random.between(0.1, 2.0);
        let corners = [
            Vec3::zeros(),
            Vec3::y(),
            Vec3::new(-1.0, random.between(-0.5, 1.5), slope),
            Vec3::new(1.0, random.between(-0.5, 1.5), slope),
        ];
        let [a, b, left, right] = corners.map(|corner| motion.point(&corner));
        // Behind the fold, straight below its end.
        let p = motion.point(&Vec3::new(0.0, 1.0, -random.between(0.01, 1.0)));
        let place_of = |triangle: [Vec3; 3]| nearest_on_triangle(&p, &triangle).1;
        let is_edge = [place_of([a, b, left]), place_of([right, b, a])].map(|place| match place {
            Place::Edge(_) => true,
            Place::Corner(_) => false,
            Place::Face => panic!("{p:?} is over neither face"),
        });
        assert_eq!(is_edge[0], is_edge[1], "{p:?} below {b:?}");
        on_edge += usize::from(is_edge[0]);
    }
    println!("{on_edge} of 20,000 on the edge");
    assert!((4_000..16_000).contains(&on_edge), "rounding decides");
}
