//! Operations on eight points, at every instruction-set level, against the scalar formulas: the same bits.

use crate::common::{Random, cuboid, levels, pieces, place_near, stretched_hull};
use pong_geometry::interference::line_segment_polyhedron::line_segment_piece;
use pong_geometry::primitive::{LineSegment, Polyhedron, PolyhedronParts};
use pong_geometry::simd::{self, LANES, Level};
use pong_geometry::{Lanes, Quat, Transform, Vec3};

/// Runs a check at every level that this machine has.
fn at_every_level(check: impl Fn()) {
    let _turn = levels::Turn::wait();
    for level in Level::available() {
        assert_eq!(simd::set_level(level), level);
        check();
    }
}

fn lanes_of(points: &[Vec3; LANES]) -> Lanes {
    let coordinate = |axis: usize| std::array::from_fn(|lane| points[lane][axis]);
    Lanes { x: coordinate(0), y: coordinate(1), z: coordinate(2) }
}

fn bits_of(truth: impl Fn(usize) -> bool) -> u8 {
    (0..LANES).map(|lane| u8::from(truth(lane)) << lane).sum()
}

/// Compares bits; all NaNs count as equal.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// Numbers at which comparisons may go wrong.
const EDGES: [f64; 12] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MIN_POSITIVE,
    5e-324,
    f64::MAX,
    -f64::MAX,
];

fn coordinate(random: &mut Random) -> f64 {
    if random.unit() < 0.3 {
        EDGES[(random.unit() * EDGES.len() as f64) as usize]
    } else {
        random.unit() * 3.0 - 1.5
    }
}

fn points(random: &mut Random) -> [Vec3; LANES] {
    std::array::from_fn(|_| Vec3::from_fn(|_, _| coordinate(random)))
}

fn with_closed_faces(polyhedron: Polyhedron) -> Polyhedron {
    let mut parts: PolyhedronParts = polyhedron.into_parts();
    for face in parts.faces.iter_mut().step_by(2) {
        face.closed = true;
        face.active = false;
    }
    Polyhedron::new(parts)
}

fn polyhedra() -> Vec<Polyhedron> {
    let cube = || cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0));
    let mut all = vec![cube(), with_closed_faces(cube())];
    for vertices in [4, 8, 18, 66] {
        let hull = stretched_hull(vertices, Vec3::new(0.9, 1.1, 0.7));
        all.push(with_closed_faces(hull.clone()));
        all.push(hull);
    }
    all
}

fn transform(random: &mut Random) -> Transform {
    let axis = Vec3::from_fn(|_, _| random.unit() - 0.5);
    let rotation = Quat::from_scaled_axis(axis * 6.0).to_rotation_matrix().into_inner();
    Transform { translation: Vec3::from_fn(|_, _| coordinate(random)), rotation }
}

#[test]
fn carried_points_are_those_of_the_transform() {
    at_every_level(|| {
        let mut random = Random(11);
        for _ in 0..2000 {
            let (x, points) = (transform(&mut random), points(&mut random));
            let carried = lanes_of(&points).carried(&x);
            for (lane, point) in points.iter().enumerate() {
                let expected = x.point(point);
                let found = [carried.x[lane], carried.y[lane], carried.z[lane]];
                assert!(
                    (0..3).all(|axis| same(found[axis], expected[axis])),
                    "{point:?}: {found:?} {expected:?}"
                );
            }
        }
    });
}

#[test]
fn outside_is_what_the_faces_say() {
    at_every_level(|| {
        let mut random = Random(12);
        for polyhedron in polyhedra() {
            for _ in 0..500 {
                let points = points(&mut random);
                let reach = std::array::from_fn(|_| coordinate(&mut random));
                let expected = bits_of(|i| polyhedron.faces.iter().any(|f| f.height(&points[i]) >= reach[i]));
                assert_eq!(polyhedron.lanes_outside(&lanes_of(&points), &reach), expected, "{points:?}");
            }
        }
    });
}

#[test]
fn a_reach_of_exactly_the_height_is_outside() {
    let cube = cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0));
    at_every_level(|| {
        let x = [1.25, 1.0, 0.0, 2.0, f64::NAN, f64::INFINITY, 1.25, -1.25];
        let reach = [0.25, 0.0, 0.0, 1.5, 0.0, 1.0, 0.250_000_1, 0.25];
        let lanes = Lanes { x, ..Lanes::ORIGIN };
        assert_eq!(cube.lanes_outside(&lanes, &reach), 0b1010_0011);
    });
}

/// Ends of eight segments.
fn ends_of(segments: &[LineSegment; LANES]) -> [Lanes; 2] {
    [0, 1].map(|end: usize| lanes_of(&std::array::from_fn(|lane| segments[lane].ends[end])))
}

#[test]
fn segments_kept_out_are_those_above_one_of_the_first_faces() {
    at_every_level(|| {
        let mut random = Random(21);
        for polyhedron in polyhedra().into_iter().chain(pieces(&mut random)) {
            let slack = polyhedron.planes().wall_slack;
            for round in 0..500 {
                let near = |random: &mut Random| std::array::from_fn(|_| place_near(random, &polyhedron));
                let (from, to) = match round % 2 {
                    0 => (points(&mut random), points(&mut random)),
                    _ => (near(&mut random), near(&mut random)),
                };
                let expected = bits_of(|i| {
                    polyhedron.faces.iter().take(32).any(|face| {
                        let limit = if face.active { 0.0 } else { slack };
                        face.height(&from[i]) >= limit && face.height(&to[i]) >= limit
                    })
                });
                let ends = [lanes_of(&from), lanes_of(&to)];
                assert_eq!(polyhedron.lanes_kept_out(&ends), expected, "{from:?} {to:?}");
            }
        }
    });
}

#[test]
fn segments_kept_out_have_no_contact() {
    at_every_level(|| {
        let mut random = Random(22);
        let (mut kept_out, mut touch) = (0, 0);
        for piece in pieces(&mut random) {
            for _ in 0..1000 {
                let segments: [LineSegment; LANES] = std::array::from_fn(|_| LineSegment {
                    ends: [place_near(&mut random, &piece), place_near(&mut random, &piece)],
                });
                let out = piece.lanes_kept_out(&ends_of(&segments));
                for (lane, segment) in segments.iter().enumerate() {
                    let touches = line_segment_piece(segment, &piece).iter().any(Option::is_some);
                    let is_out = out >> lane & 1 == 1;
                    assert!(!(is_out && touches), "{:?}", segment.ends);
                    kept_out += u32::from(is_out);
                    touch += u32::from(touches);
                }
            }
        }
        assert!(kept_out > 1000 && touch > 1000, "kept out {kept_out}, touch {touch}");
    });
}

#[test]
fn inside_is_what_the_faces_say() {
    at_every_level(|| {
        let mut random = Random(13);
        let mut on_closed = 0;
        for polyhedron in polyhedra() {
            for _ in 0..500 {
                let points = points(&mut random);
                let contains = |i: usize| {
                    polyhedron.faces.iter().all(|f| {
                        let height = f.height(&points[i]);
                        height < 0.0 || (f.closed && height == 0.0)
                    })
                };
                let expected = bits_of(contains);
                on_closed += bits_of(|i| contains(i) && points[i].amax() == 1.0).count_ones();
                assert_eq!(polyhedron.lanes_contain(&lanes_of(&points)), expected, "{points:?}");
            }
        }
        assert!(on_closed > 10, "points on closed faces: {on_closed}");
    });
}

#[test]
fn a_level_that_the_machine_lacks_is_not_chosen() {
    let _turn = levels::Turn::wait();
    assert!(simd::set_level(Level::Avx512) <= Level::best());
    assert_eq!(simd::level_name(), simd::level().name());
}
