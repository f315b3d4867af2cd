//! Line segments: only the faces that may decide are asked; the answer is that of asking all of them one by one, in the same
//! bits, at every level of instructions.
//!
//! Degenerate cases: segments in the plane of a face, along an edge, through vertices, with ends within rounding of these,
//! with coordinates of single precision; pieces with inner walls.

mod common;

use common::{
    Random, cuboid, cuboid_corners, fibonacci_sphere, hull_with_walls, moved, random_motion, stretched_hull,
};
use pong_geometry::Vec3;
use pong_geometry::interference::line_segment_polyhedron::line_segment_piece;
use pong_geometry::primitive::{LineSegment, Polyhedron, PolyhedronFace};
use pong_geometry::simd::{Level, set_level};

/// The same piece with a face far beyond everything: where a number is as large as its offset, all faces are asked.
fn asked_one_by_one(piece: &Polyhedron) -> Polyhedron {
    let mut parts = piece.clone().into_parts();
    parts.faces.push(PolyhedronFace {
        normal: Vec3::x(),
        offset: 1e70,
        active: true,
        closed: false,
        first_rim: 0,
        rim_count: 0,
    });
    Polyhedron::new(parts)
}

fn pieces(random: &mut Random) -> Vec<Polyhedron> {
    let box_corners = cuboid_corners(Vec3::repeat(-1.0), Vec3::repeat(1.0));
    let mut all = vec![
        cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0)),
        hull_with_walls(&box_corners, &|normal, _| normal.x > 0.9),
        hull_with_walls(&box_corners, &|normal, _| normal.x > 0.9 || normal.y < -0.9),
        hull_with_walls(&fibonacci_sphere(18), &|normal, _| normal.x > 0.7),
    ];
    all.extend([4, 8, 12, 18, 25, 66].map(|vertices| stretched_hull(vertices, Vec3::new(1.0, 0.8, 0.6))));
    let turned: Vec<_> = all.iter().map(|piece| moved(piece, &random_motion(random, 0.5))).collect();
    all.extend(turned);
    all
}

fn place(random: &mut Random, piece: &Polyhedron) -> Vec3 {
    let [a, b, c] = [(); 3].map(|()| {
        let vertex = (random.unit() * piece.vertices.len() as f64) as usize;
        piece.vertices[vertex].position
    });
    let along_edge = a + (b - a) * random.between(-0.5, 1.5);
    let in_plane = along_edge + (c - a) * random.between(-0.5, 1.0);
    match (random.unit() * 6.0) as u32 {
        0 => Vec3::from_fn(|_, _| random.between(-1.5, 1.5)),
        1 => Vec3::from_fn(|_, _| f64::from(random.between(-1.5, 1.5) as f32)),
        2 => Vec3::from_fn(|_, _| random.between(-6.5, 6.5).round() * 0.25),
        3 => along_edge,
        4 => in_plane,
        _ => a + Vec3::from_fn(|_, _| random.between(-1e-9, 1e-9)),
    }
}

#[test]
fn the_answer_is_that_of_all_faces() {
    for level in Level::available() {
        set_level(level);
        let mut random = Random(31);
        let mut contacts = 0;
        for piece in pieces(&mut random) {
            let all = asked_one_by_one(&piece);
            for _ in 0..2000 {
                let segment = LineSegment { ends: [place(&mut random, &piece), place(&mut random, &piece)] };
                let found = line_segment_piece(&segment, &piece);
                assert_eq!(found, line_segment_piece(&segment, &all), "{}: {:?}", level.name(), segment.ends);
                contacts += found.iter().flatten().count();
            }
        }
        assert!(contacts > 10_000, "contacts: {contacts}");
    }
    set_level(Level::best());
}
