//! Line segments: only the faces that may decide are tested; the result is bit-identical to that of testing
//! all faces one by one, at every instruction-set level.
//!
//! Degenerate cases: segments in the plane of a face, along an edge, through vertices, with ends within
//! rounding of these, with coordinates of single precision; pieces with internal faces.

use crate::common::{Random, levels, pieces, place_near};
use pong_geometry::Vec3;
use pong_geometry::interference::line_segment_polyhedron::line_segment_piece;
use pong_geometry::primitive::{LineSegment, Polyhedron, PolyhedronFace};
use pong_geometry::simd::{Level, set_level};

/// Piece with an additional face at an enormous distance, whose immoderate offset forces the test of all
/// faces one by one.
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

#[test]
fn the_answer_is_that_of_all_faces() {
    let _turn = levels::Turn::wait();
    for level in Level::available() {
        set_level(level);
        let mut random = Random(31);
        let mut contacts = 0;
        for piece in pieces(&mut random) {
            let all = asked_one_by_one(&piece);
            for _ in 0..2000 {
                let segment =
                    LineSegment { ends: [place_near(&mut random, &piece), place_near(&mut random, &piece)] };
                let found = line_segment_piece(&segment, &piece);
                assert_eq!(found, line_segment_piece(&segment, &all), "{}: {:?}", level.name(), segment.ends);
                contacts += found.iter().flatten().count();
            }
        }
        assert!(contacts > 10_000, "contacts: {contacts}");
    }
}
