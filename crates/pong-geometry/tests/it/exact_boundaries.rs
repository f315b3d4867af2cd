//! Every tester on its own boundaries, in exact numbers: shapes that only touch do not push; shapes an eighth
//! deeper push by an eighth; a centre in a plane is in front of it; each feature has its index.

use crate::common::{cuboid, hull};
use crate::oracle_support::{all_contacts, skin, surface};
use pong_geometry::interference::ellipsoid_polyhedron::ellipsoid_polyhedron;
use pong_geometry::interference::ellipsoid_triangle::ellipsoid_triangle;
use pong_geometry::interference::line_segment_plane::line_segment_plane;
use pong_geometry::interference::line_segment_polyhedron::line_segment_polyhedron;
use pong_geometry::interference::point_ellipsoid::point_ellipsoid;
use pong_geometry::interference::point_plane::point_plane;
use pong_geometry::interference::point_polyhedron::{
    entry_of_line, face_most_along, point_below_face, shallowest_face,
};
use pong_geometry::interference::point_sphere::point_sphere;
use pong_geometry::interference::ray_plane::ray_plane;
use pong_geometry::interference::ray_polyhedron::ray_polyhedron;
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::interference::sphere_plane::sphere_plane;
use pong_geometry::interference::sphere_polyhedron::sphere_polyhedron;
use pong_geometry::interference::sphere_sphere::sphere_sphere;
use pong_geometry::interference::sphere_triangle::sphere_over_face;
use pong_geometry::interference::triangle_features::Standing;
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::{
    Ellipsoid, LineSegment, NO_NEIGHBOR, Plane, Point, Polyhedron, Ray, RayResponse, Sphere, TriangleSet,
};
use pong_geometry::{Mat3, Vec3};

const EIGHTH: f64 = 0.125;
/// Depth that squares of distances of metres still distinguish from zero: 1.8e-12 m.
const LEAST: f64 = 1.0 / (1_u64 << 39) as f64;
/// Some units in the last place of a depth of an eighth of a metre and of a unit vector, because roots round.
const ROUNDING: f64 = 1e-15;

fn at(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3::new(x, y, z)
}

fn ball(center: Vec3, radius: f64) -> Sphere {
    Sphere { center, radius }
}

fn floor() -> Plane {
    Plane { normal: Vec3::z(), offset: 0.0 }
}

/// Box from (−2, −2, −2) to (2, 2, 0): its top is the plane z = 0.
fn block() -> Polyhedron {
    cuboid(at(-2.0, -2.0, -2.0), at(2.0, 2.0, 0.0))
}

/// Tent whose ridge is the x axis from −2 to 2.
fn tent() -> Polyhedron {
    let side = |y: f64, z: f64| [at(-2.0, y, z), at(2.0, y, z)];
    hull(&[side(-2.0, -2.0), side(2.0, -2.0), side(0.0, 0.0)].concat())
}

/// Top of the block as two triangles; all edges but the diagonal are free.
fn sheet() -> TriangleSet {
    let corners = vec![at(-2.0, -2.0, 0.0), at(2.0, -2.0, 0.0), at(2.0, 2.0, 0.0), at(-2.0, 2.0, 0.0)];
    surface(corners, &[[0, 1, 2], [0, 2, 3]])
}

fn deepest(contacts: impl IntoIterator<Item = Interference>) -> Option<f64> {
    contacts.into_iter().map(|contact| contact.depth).reduce(f64::max)
}

fn on_sheet(sphere: &Sphere) -> Option<f64> {
    deepest(all_contacts(sphere, &sheet(), 0.0).into_iter().map(|contact| contact.interference))
}

fn ellipsoid(center: Vec3, semi_axes: Vec3) -> Ellipsoid {
    Ellipsoid { center, axes: Mat3::identity(), semi_axes }
}

/// Contact of a point without a remembered side.
fn point_inside(p: &Vec3, block: &Polyhedron) -> Option<Interference> {
    let face = shallowest_face(p, block).filter(|_| block.contains(p))?;
    point_below_face(p, block, face)
}

/// Depth of a body lowered by a distance from where it touches.
type Lowered<'a> = (&'a str, &'a dyn Fn(f64) -> Option<f64>);

#[test]
fn what_touches_does_not_push_and_what_is_deeper_does() {
    let depth = |contact: Option<Interference>| contact.map(|contact| contact.depth);
    let bar = |low: f64| LineSegment { ends: [at(-0.5, 0.0, -low), at(0.5, 0.0, 1.0 - low)] };
    let pairs: [Lowered<'_>; 19] = [
        ("point, plane", &|d| depth(point_plane(&Point { position: at(0.5, 0.25, -d) }, &floor()))),
        ("point, sphere", &|d| {
            depth(point_sphere(&Point { position: at(1.0 - d, 0.0, 0.0) }, &ball(Vec3::zeros(), 1.0)))
        }),
        ("point, ellipsoid", &|d| {
            depth(point_ellipsoid(&at(0.0, 0.0, 0.5 - d), &ellipsoid(Vec3::zeros(), at(1.0, 2.0, 0.5))))
        }),
        ("point, polyhedron", &|d| depth(point_inside(&at(0.5, 0.25, -d), &block()))),
        ("line segment, plane", &|d| deepest(line_segment_plane(&bar(d), &floor()).into_iter().flatten())),
        ("line segment, polyhedron", &|d| {
            deepest(line_segment_polyhedron(&bar(d), &block()).into_iter().flatten())
        }),
        ("sphere, plane", &|d| depth(sphere_plane(&ball(at(0.5, 0.25, 1.0 - d), 1.0), &floor()))),
        ("sphere, sphere", &|d| {
            depth(sphere_sphere(&ball(at(3.0 - d, 0.0, 0.0), 2.0), &ball(Vec3::zeros(), 1.0)))
        }),
        ("sphere, face", &|d| depth(sphere_polyhedron(&ball(at(0.5, 0.25, 1.0 - d), 1.0), &block()))),
        // Distances 3-4-5 and 1-2-2 from an edge and a corner.
        ("sphere, edge", &|d| depth(sphere_polyhedron(&ball(at(2.75, 0.5, 1.0), 1.25 + d), &block()))),
        ("sphere, ridge", &|d| depth(sphere_polyhedron(&ball(at(1.5, 0.0, 1.0 - d), 1.0), &tent()))),
        ("sphere, corner", &|d| depth(sphere_polyhedron(&ball(at(3.0, 4.0, 2.0), 3.0 + d), &block()))),
        ("sphere, triangle", &|d| on_sheet(&ball(at(0.5, 0.25, 1.0 - d), 1.0))),
        ("sphere, over one face", &|d| {
            let contact = sphere_over_face(&ball(at(0.5, 0.25, 1.0 - d), 1.0), &sheet(), 0)?;
            Some(contact.interference.depth)
        }),
        ("sphere, free edge", &|d| on_sheet(&ball(at(2.75, 0.5, 1.0), 1.25 + d))),
        ("sphere, free corner", &|d| on_sheet(&ball(at(3.0, 4.0, 2.0), 3.0 + d))),
        ("sphere, free edge, centre in the plane", &|d| on_sheet(&ball(at(3.0, 0.5, 0.0), 1.0 + d))),
        ("ellipsoid, polyhedron", &|d| {
            depth(ellipsoid_polyhedron(&ellipsoid(at(0.5, 0.25, 0.5 - d), at(1.0, 0.75, 0.5)), &block()))
        }),
        ("ellipsoid, triangle", &|d| {
            let mut found = Vec::new();
            for triangle in 0..2 {
                let above = ellipsoid(at(0.5, 0.25, 0.5 - d), at(1.0, 0.75, 0.5));
                ellipsoid_triangle(&above, &sheet(), triangle, 0.0, &mut |contact| {
                    found.push(contact.interference)
                });
            }
            deepest(found)
        }),
    ];
    for (name, lowered) in pairs {
        assert_eq!(lowered(0.0), None, "{name}: only touches");
        assert_eq!(lowered(-EIGHTH), None, "{name}: apart");
        assert!(lowered(LEAST).is_some_and(|depth| depth > 0.0), "{name}: the least depth");
        let depth = lowered(EIGHTH).unwrap_or_else(|| panic!("{name}: an eighth deep and no contact"));
        assert!((depth - EIGHTH).abs() < ROUNDING, "{name}: {depth}");
    }
}

#[test]
fn rays_end_before_their_length_and_begin_behind_their_reach() {
    let sheet = sheet();
    let hits = |ray: &Ray| {
        let reach = ray.reach.unwrap_or(0.0);
        let triangles = (0..2).find_map(|triangle| ray_triangle(ray, &sheet, triangle, reach));
        [ray_plane(ray, &floor()), triangles, ray_polyhedron(ray, &block())]
            .map(|hit| hit.map(|hit| hit.distance))
    };
    let ray = |height: f64, length: f64, reach: f64| Ray {
        origin: at(0.5, 0.25, height),
        direction: -Vec3::z(),
        length,
        reach: Some(reach),
        response: RayResponse::Normal,
    };
    assert_eq!(hits(&ray(1.0, 1.0, 0.0)), [None; 3], "ends on the surface");
    assert_eq!(hits(&ray(1.0, 1.0 + EIGHTH, 0.0)), [Some(1.0); 3]);
    assert_eq!(hits(&ray(0.0, 1.0, 0.0)), [None; 3], "begins on the surface, without reach");
    assert_eq!(hits(&ray(-0.25, 1.0, 0.25)), [None; 3], "as far behind as it reaches");
    assert_eq!(hits(&ray(-0.25, 1.0, 0.25 + EIGHTH)), [Some(-0.25); 3]);
    let from_surface = ray_polyhedron(&ray(0.0, 1.0, 0.25), &block()).map(|hit| hit.distance.to_bits());
    assert_eq!(from_surface, Some(0.0_f64.to_bits()), "without a sign");
    let turned = |direction: Vec3| Ray { direction, ..ray(-1.0, 4.0, 2.0) };
    assert_eq!(hits(&turned(Vec3::z()))[..2], [None; 2], "from behind");
    let along = Ray { origin: at(-4.0, 0.25, 0.0), ..turned(Vec3::x()) };
    assert_eq!(hits(&along), [None; 3], "in the surface");
}

/// A line through an edge enters by the lower of its faces. A line that only touches the edge does not enter,
/// and one that ends on an internal face does if that face is closed.
#[test]
fn lines_enter_by_the_lower_face_and_not_where_they_only_touch() {
    let mut block = block();
    let face_of = |normal: Vec3| block.faces.iter().position(|face| face.normal == normal).unwrap();
    let [front, side, top] = [Vec3::x(), Vec3::y(), Vec3::z()].map(face_of);
    let entry = |block: &Polyhedron, from: Vec3, to: Vec3| {
        entry_of_line(&from, &to, block).map(|entry| (entry.face, entry.at))
    };
    let middle = at(0.0, 0.0, -1.0);
    assert_eq!(entry(&block, at(4.0, 4.0, -1.0), middle), Some((front.min(side), 0.5)), "through an edge");
    assert_eq!(entry(&block, at(4.0, 0.0, -1.0), at(0.0, 4.0, -1.0)), None, "touches an edge");
    let most_along = |p: Vec3| face_most_along(&at(1.0, 1.0, 0.0), &p, &block);
    assert_eq!(most_along(middle), Some(front.min(side)));
    assert_eq!(most_along(at(0.1, 0.0, -1.0)), Some(front), "of faces equally along the less deep");
    assert_eq!(most_along(at(0.0, 0.1, -1.0)), Some(side), "of faces equally along the less deep");
    assert_eq!(point_below_face(&Vec3::zeros(), &block, top), None, "on the face");

    let onto_top = |block: &Polyhedron, end: f64| entry(block, at(0.0, 0.0, 2.0), at(0.0, 0.0, end));
    assert_eq!(onto_top(&block, 0.0), None);
    block.change(|parts| (parts.faces[top].active, parts.faces[top].closed) = (false, true));
    // An internal face is raised by its tolerance.
    let entered = onto_top(&block, 0.0).expect("through the wall");
    assert!(entered.0 == top && entered.1 < 1.0 && entered.1 > 1.0 - 1e-5, "{entered:?}");
    assert_eq!(onto_top(&block, 1.0), None, "ends above");
}

/// A line in the plane of an internal face enters the piece for which the face is closed.
#[test]
fn a_line_along_a_closed_wall_enters() {
    let plain = block();
    let middle = at(0.0, 0.0, -1.0);
    for (wall, entry) in (0..6).flat_map(|wall| (0..6).map(move |entry| (wall, entry))) {
        let [across, along] = [wall, entry].map(|face| plain.faces[face].normal);
        if across.dot(&along) != 0.0 {
            continue;
        }
        let to = middle - across * plain.height(wall, &middle);
        let from = to - along * (2.0 * plain.height(entry, &to));
        let enters = |block: &Polyhedron| entry_of_line(&from, &to, block);
        assert_eq!(enters(&plain), None);
        let mut block = plain.clone();
        block.change(|parts| (parts.faces[wall].active, parts.faces[wall].closed) = (false, true));
        assert_eq!(enters(&block).map(|found| (found.face, found.at)), Some((entry, 0.5)));
    }
}

/// An ellipsoid nearer to an internal face than to the top is pushed out by the top: internal faces never
/// push.
#[test]
fn an_ellipsoid_beside_a_wall_is_pushed_by_the_top() {
    let mut block = block();
    let wall = block.faces.iter().position(|face| face.normal == Vec3::x()).unwrap();
    block.change(|parts| parts.faces[wall].active = false);
    let contact =
        ellipsoid_polyhedron(&ellipsoid(at(1.75, 0.25, -0.25), at(0.125, 0.75, 0.375)), &block).unwrap();
    assert_eq!((contact.normal_b, contact.depth), (Vec3::z(), 0.625));
}

/// A centre behind a face by exactly the thickness is too deep; in the plane it is in front, also with zero
/// thickness.
#[test]
fn a_centre_in_the_plane_is_in_front() {
    let sheet = sheet();
    let standings = |height: f64, thickness: f64| {
        let found = all_contacts(&ball(at(0.5, 0.25, height), 1.0), &sheet, thickness);
        found.iter().map(|contact| (contact.standing, contact.interference.depth)).collect::<Vec<_>>()
    };
    assert_eq!(standings(0.0, 0.0), [(Standing::Front, 1.0)]);
    assert_eq!(standings(-0.25, 0.25), []);
    assert_eq!(standings(-0.25, 0.25 + EIGHTH), [(Standing::Behind, 1.25)]);
    let over_face = |height: f64| sphere_over_face(&ball(at(0.5, 0.25, height), 1.0), &sheet, 0);
    assert_eq!(over_face(0.0).map(|contact| contact.standing), Some(Standing::Front));
    // Beyond a free edge: a centre in the plane is pushed along the plane, below not at all.
    let beside = |height: f64| all_contacts(&ball(at(2.5, 0.5, height), 1.0), &sheet, 0.0);
    let normals: Vec<_> = beside(0.0).iter().map(|contact| contact.interference.normal_b).collect();
    assert_eq!(normals, [Vec3::x()]);
    assert!(beside(-EIGHTH).is_empty());
}

/// The owner of an edge is the lower of its two triangles, which gives the edge's index; vertices have the
/// indices of the set.
#[test]
fn edges_and_vertices_are_told_by_their_numbers() {
    let block = skin(&block());
    let middle = at(0.0, 0.0, -1.0);
    let (mut edges, mut vertices) = (0, 0);
    for (index, triangle) in block.triangles.iter().enumerate() {
        let corners = block.corners(index as u32);
        for k in 0..3 {
            let neighbor = triangle.neighbors[k];
            let sum = block.normal(index as u32) + block.normal(neighbor);
            if neighbor == NO_NEIGHBOR || (index as u32) > neighbor || sum.norm() > 1.9 {
                continue;
            }
            let center = 0.5 * (corners[k] + corners[(k + 1) % 3]) + sum * EIGHTH;
            let found = all_contacts(&ball(center, 0.5), &block, 0.0);
            let told: Vec<_> = found.iter().map(|c| (c.interference.feature, c.standing)).collect();
            assert_eq!(told, [(Feature::edge(3 * index + k), Standing::Front)]);
            assert!((found[0].interference.normal_b - sum.normalize()).norm() < ROUNDING, "{found:?}");
            edges += 1;
        }
    }
    // On a vertex itself the mean of the normals decides.
    for (index, vertex) in block.vertices.iter().enumerate() {
        let out = (vertex - middle).map(f64::signum);
        for distance in [EIGHTH, 0.0] {
            let found = all_contacts(&ball(vertex + out * distance, 0.5), &block, 0.0);
            let of_vertex: Vec<_> =
                found.iter().filter(|c| c.interference.feature == Feature::vertex(index)).collect();
            assert_eq!(of_vertex.len(), 1, "vertex {index}: {found:?}");
            assert!(of_vertex[0].interference.normal_b.dot(&out) > 1.4, "{found:?}");
        }
        vertices += 1;
    }
    assert_eq!((edges, vertices), (12, 8));
}

/// A feature consists of its kind and its index, and is ordered by them.
#[test]
fn features_differ_by_kind_and_index() {
    let last = (1 << 30) - 1;
    let mut all = Vec::new();
    for make in [Feature::face, Feature::edge, Feature::vertex] {
        for index in [0, 1, 2, 5, last] {
            let feature = make(index);
            assert_eq!(feature.index(), index);
            assert_eq!(feature.is_face(), feature == Feature::face(index));
            all.push(feature);
        }
    }
    assert!(all.is_sorted_by(|a, b| a < b), "{all:?}");
    assert_eq!(Feature::WHOLE, Feature::face(0));
}

/// Two faces folded to 53° about the y axis, their fronts inside the fold. A centre below the fold and in
/// front of one of them is outside, and nothing pushes; a centre behind both within the thickness is pushed
/// by both, whichever comes first.
#[test]
fn below_a_sharp_fold_only_what_is_behind_both_faces_is_pushed() {
    let rows = [-1.0, 1.0].map(|y| [at(-0.5, y, 1.0), at(0.0, y, 0.0), at(0.5, y, 1.0)]);
    let set = surface(rows.concat(), &[[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4]]);
    assert!(set.normal(1).x > 0.8 && set.normal(2).x < -0.8, "the fronts face each other");
    let standings = |x: f64, z: f64| {
        let found = all_contacts(&ball(at(x, 0.25, z), 0.5), &set, 0.5);
        found.iter().map(|contact| (contact.interference.feature, contact.standing)).collect::<Vec<_>>()
    };
    for x in [0.125, -0.125] {
        assert_eq!(standings(x, -0.125), [], "below the fold, in front of one face");
    }
    let both = [1, 2].map(|face| (Feature::face(face), Standing::Behind));
    assert_eq!(standings(0.0, -0.125), both);
    assert!(standings(0.0, 0.5).iter().all(|(_, standing)| *standing == Standing::Front));
}
