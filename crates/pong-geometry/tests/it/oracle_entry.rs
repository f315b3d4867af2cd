//! Side of entry: the face by which a line enters, how the remembered face follows a point, and which face
//! pushes.
//!
//! Degenerate cases: lines that start on a face, end on an inner wall, run through edges and vertices, along a
//! face; points at the middle of symmetric shapes (ties).

use crate::common;
use crate::common::{
    Random, cuboid, cuboid_corners, hull, hull_with_walls, moved, random_motion, stretched_hull,
};
use crate::oracle_support;
use crate::oracle_support::{Worst, polygon};
use pong_geometry::Vec3;
use pong_geometry::interference::point_polyhedron::{
    entry_of_line, face_most_along, follow, point_below_face, shallowest_face,
};
use pong_geometry::primitive::Polyhedron;

fn shapes(random: &mut Random) -> Vec<Polyhedron> {
    let prism = |count: usize| {
        let corners: Vec<Vec3> = (0..count)
            .flat_map(|k| {
                let angle = std::f64::consts::TAU * k as f64 / count as f64;
                [-0.5, 0.5].map(|z| Vec3::new(angle.cos(), angle.sin(), z))
            })
            .collect();
        common::hull(&corners)
    };
    [
        cuboid(Vec3::new(-0.8, -0.6, -0.5), Vec3::new(0.7, 0.6, 0.4)),
        prism(12),
        stretched_hull(24, Vec3::new(1.0, 0.8, 0.7)),
        hull_with_walls(&cuboid_corners(Vec3::repeat(-0.7), Vec3::repeat(0.6)), &|n, _| n.y > 0.9),
    ]
    .iter()
    .map(|shape| moved(shape, &random_motion(random, 0.3)))
    .collect()
}

/// Point at which stepping along the line first finds itself inside, and the face crossed there.
fn stepped_entry(from: &Vec3, to: &Vec3, shape: &Polyhedron) -> Option<(f64, usize)> {
    let place = |s: f64| from + (to - from) * s;
    if shape.contains(from) {
        return None;
    }
    const STEPS: usize = 4000;
    let inside = (1..=STEPS).find(|&i| shape.contains(&place(i as f64 / STEPS as f64)))?;
    let (mut out, mut within) = ((inside - 1) as f64 / STEPS as f64, inside as f64 / STEPS as f64);
    for _ in 0..60 {
        let middle = 0.5 * (out + within);
        if shape.contains(&place(middle)) {
            within = middle;
        } else {
            out = middle;
        }
    }
    let p = place(0.5 * (out + within));
    // Face whose polygon is nearest to that point, by area.
    let gap = |face: usize| {
        let c = polygon(shape, face);
        (1..c.len() - 1)
            .map(|k| (oracle_support::nearest_on_triangle(&p, &[c[0], c[k], c[k + 1]]) - p).norm())
            .fold(f64::INFINITY, f64::min)
    };
    let face = (0..shape.faces.len()).min_by(|&a, &b| gap(a).total_cmp(&gap(b))).expect("faces");
    Some((0.5 * (out + within), face))
}

#[test]
fn lines_enter_where_stepping_finds_them() {
    let mut random = Random(401);
    let mut worst = Worst::new("entry of a line");
    let shapes = shapes(&mut random);
    let (mut entered, mut missed, mut border) = (0, 0, 0);
    while entered < 2500 {
        let shape = &shapes[(random.bits() % 4) as usize];
        let from = random.direction() * random.between(0.1, 2.0);
        // Half of them end inside, half pass through or miss.
        let to = random.direction() * random.between(0.0, if entered % 2 == 0 { 0.5 } else { 2.0 });
        let expected = stepped_entry(&from, &to, shape);
        let found = entry_of_line(&from, &to, shape);
        match (expected, found) {
            (Some((at, face)), Some(entry)) => {
                entered += 1;
                // An internal face is raised by its tolerance.
                let wall = &shape.faces[entry.face];
                let room = if wall.active { 0.0 } else { shape.planes().wall_slack };
                let early = room / -wall.normal.dot(&(to - from).normalize());
                worst.note(((entry.at - at) * (to - from).norm() + early).abs(), 1e-12);
                if entry.face != face {
                    // The entry lies on an edge.
                    let p = from + (to - from) * at;
                    assert!(shape.height(entry.face, &p).abs() < 1e-9, "{from:?} {to:?}");
                    border += 1;
                }
            }
            (None, None) => missed += 1,
            // Stepping may miss a corner that is cut shorter than a step.
            (None, Some(entry)) => {
                let p = from + (to - from) * (entry.at + 1e-4).min(1.0);
                assert!(!shape.contains(&p) || shape.contains(&from), "{from:?} {to:?} {entry:?}");
                assert!(!shape.contains(&from));
                border += 1;
            }
            (Some(_), None) => panic!("lost: {from:?} {to:?}"),
        }
    }
    println!("{entered} entered, {missed} missed, {border} at the border");
    assert!(missed > 300 && border < 40);
}

/// Returns `true` if two faces share an edge.
fn adjacent(shape: &Polyhedron, f: usize, g: usize) -> bool {
    let (a, b) = (polygon(shape, f), polygon(shape, g));
    f != g && a.iter().filter(|corner| b.contains(corner)).count() == 2
}

/// Least depth over a face and its active neighbours, and the faces that have it.
fn pushed(p: &Vec3, shape: &Polyhedron, face: usize) -> (f64, Vec<usize>) {
    let depth = |f: usize| shape.faces[f].offset - shape.faces[f].normal.dot(p);
    let candidates =
        (0..shape.faces.len()).filter(|&g| g == face || (adjacent(shape, face, g) && shape.faces[g].active));
    let candidates: Vec<usize> = candidates.collect();
    let least = candidates.iter().map(|&g| depth(g)).fold(f64::INFINITY, f64::min);
    (least, candidates.into_iter().filter(|&g| depth(g) == least).collect())
}

/// Independent implementation of 2.4: while it lowers the depth, move to the active neighbour with n·n' > 0.3
/// of least depth, unless the face that pushes there is deeper.
fn walked(p: &Vec3, shape: &Polyhedron, remembered: usize) -> usize {
    let depth = |f: usize| shape.faces[f].offset - shape.faces[f].normal.dot(p);
    let mut here = remembered;
    loop {
        let mut candidates: Vec<usize> = (0..shape.faces.len())
            .filter(|&g| adjacent(shape, here, g) && shape.faces[g].active)
            .filter(|&g| shape.faces[g].normal.dot(&shape.faces[here].normal) > 0.3)
            .filter(|&g| depth(g) < depth(here))
            .collect();
        candidates.sort_by(|&a, &b| depth(a).total_cmp(&depth(b)).then(a.cmp(&b)));
        match candidates.first() {
            Some(&next) if pushed(p, shape, next).0 <= pushed(p, shape, here).0 => here = next,
            _ => return here,
        }
    }
}

#[test]
fn memory_walks_as_defined() {
    let mut random = Random(402);
    let shapes = shapes(&mut random);
    let (mut walks, mut turns) = (0, 0);
    while walks < 10_000 {
        let shape = &shapes[(random.bits() % 4) as usize];
        let p = random.direction() * random.between(0.0, 0.9);
        let start = (random.bits() % shape.faces.len() as u64) as usize;
        if !shape.contains(&p) || !shape.faces[start].active {
            continue;
        }
        walks += 1;
        let reached = follow(&p, shape, start);
        assert_eq!(reached.face, walked(&p, shape, start));
        turns += usize::from(reached.face != start);
        let (least, faces) = pushed(&p, shape, reached.face);
        assert_eq!((reached.depth, reached.pushes), (least, faces[0]));
        let contact = point_below_face(&p, shape, reached.pushes).expect("inside");
        assert_eq!((contact.normal_b, contact.feature.index()), (shape.faces[faces[0]].normal, faces[0]));
        // The depth after the walk is never less than the plain least depth.
        let least = shallowest_face(&p, shape).expect("active");
        assert!(contact.depth >= -shape.height(least, &p));
        let direction = random.direction();
        let along = face_most_along(&direction, &p, shape).expect("active");
        assert!(shape.faces[along].active);
        let best = shape.faces.iter().filter(|f| f.active).map(|f| f.normal.dot(&direction));
        assert!(shape.faces[along].normal.dot(&direction) >= best.fold(-2.0, f64::max) - 1e-6);
    }
    assert!(turns > 1000);
}

/// Along any path inside a hull the depth grows by no more than the length of the path: a step of the walk
/// never raises it.
#[test]
fn along_a_path_the_depth_never_steps_up() {
    let mut random = Random(404);
    let (mut frames, mut turned, mut stayed) = (0, 0, 0);
    while frames < 200_000 {
        let corners: Vec<Vec3> = (0..8).map(|_| random.direction() * random.between(0.5, 1.0)).collect();
        let hull = common::hull(&corners);
        let step = random.between(1e-4, 0.05);
        let mut p = corners.iter().sum::<Vec3>() / 8.0;
        let mut heading = random.direction();
        // As in a commit: the next frame starts from the new face.
        let first = follow(&p, &hull, (random.bits() % hull.faces.len() as u64) as usize);
        let (mut memory, mut depth) = (first.face, first.depth);
        for _ in 0..200 {
            heading = (heading + random.direction() * 0.3).normalize();
            let next = p + heading * step;
            if !hull.contains(&next) {
                heading = -heading;
                continue;
            }
            p = next;
            let reached = follow(&p, &hull, memory);
            assert!(reached.depth <= depth + step + 1e-14, "{corners:?} {p:?}: {depth} {reached:?}");
            turned += usize::from(reached.face != memory);
            stayed += usize::from(reached.face != shallowest_face(&p, &hull).expect("active"));
            (memory, depth) = (reached.face, reached.depth);
            frames += 1;
        }
    }
    println!("{frames} frames, memory moved in {turned}, held back from the least deep face in {stayed}");
    assert!(turned > 1000 && stayed > 1000);
}

/// Through a thin plate: a point that entered from above is still pushed up when it is past the middle.
#[test]
fn memory_never_goes_round_a_sharp_rim() {
    let plate = cuboid(Vec3::new(-1.0, -1.0, -0.01), Vec3::new(1.0, 1.0, 0.01));
    let face = |n: Vec3| plate.faces.iter().position(|f| f.normal.dot(&n) > 0.9).expect("face");
    let (top, bottom) = (face(Vec3::z()), face(-Vec3::z()));
    let mut random = Random(403);
    for _ in 0..1000 {
        let p =
            Vec3::new(random.between(-0.9, 0.9), random.between(-0.9, 0.9), random.between(-0.0099, 0.0099));
        let (above, below) = (follow(&p, &plate, top), follow(&p, &plate, bottom));
        assert_eq!((above.face, above.pushes, below.pushes), (top, top, bottom));
    }
    // Near the rim the side may push, the opposite face may not: the remembered face stays.
    let p = Vec3::new(0.999, 0.0, -0.009);
    let reached = follow(&p, &plate, top);
    assert_eq!((reached.face, reached.pushes), (top, face(Vec3::x())));
}

/// On a twelve-sided prism the remembered face follows over any number of facets in one step.
#[test]
fn memory_follows_a_faceted_curve() {
    let shape = shapes(&mut Random(0)).swap_remove(1);
    let middle = shape.vertices.iter().map(|v| v.position).sum::<Vec3>() / shape.vertices.len() as f64;
    let rims: Vec<usize> = (0..shape.faces.len()).filter(|&f| shape.faces[f].rim_count == 4).collect();
    assert_eq!(rims.len(), 12);
    for &start in &rims {
        for &goal in &rims {
            if shape.faces[start].normal.dot(&shape.faces[goal].normal) < -0.9 {
                continue;
            }
            let p = middle + shape.faces[goal].normal * 0.9;
            assert_eq!(follow(&p, &shape, start).face, goal);
        }
    }
}

#[test]
fn degenerate_lines_and_ties() {
    let shape = cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0));
    let middle = Vec3::zeros();
    assert_eq!(shallowest_face(&middle, &shape), Some(0), "a tie goes to the lowest face");
    for face in 0..6 {
        assert_eq!(follow(&middle, &shape, face).face, face, "no walk without gain");
    }
    // Through an edge and a vertex: one of the faces there, at the intersection.
    for from in [Vec3::new(2.0, 2.0, 0.0), Vec3::repeat(2.0), Vec3::new(1.0, 2.0, 0.0), Vec3::repeat(1.0)] {
        let entry = entry_of_line(&from, &middle, &shape).expect("enters");
        let p = from * (1.0 - entry.at);
        assert!(shape.height(entry.face, &p).abs() < 1e-15, "{from:?}");
    }
    // A start on a face counts as outside. A line that starts inside, ends on the surface or slides along it
    // does not enter.
    let top = shape.faces.iter().position(|f| f.normal.z > 0.9);
    assert_eq!(entry_of_line(&Vec3::z(), &middle, &shape).map(|e| (e.face, e.at)), top.map(|f| (f, 0.0)));
    assert_eq!(entry_of_line(&(Vec3::z() * 0.5), &middle, &shape), None);
    assert_eq!(entry_of_line(&(Vec3::z() * 2.0), &Vec3::z(), &shape), None);
    assert_eq!(entry_of_line(&Vec3::z(), &Vec3::new(0.5, 0.0, 1.0), &shape), None);
    assert_eq!(entry_of_line(&middle, &middle, &shape), None);
    // Without any active face.
    let walls = hull_with_walls(&cuboid_corners(Vec3::repeat(-1.0), Vec3::repeat(1.0)), &|_, _| true);
    assert_eq!(
        (shallowest_face(&middle, &walls), face_most_along(&Vec3::x(), &middle, &walls)),
        (None, None)
    );
}

/// Equally deep below two faces: the lower one pushes, and the remembered face moves to the lower one.
#[test]
fn ties_go_to_the_lower_face() {
    let cube = cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0));
    // The floor and the top have four sides each with a normal along an axis, and four more beside: ten
    // faces.
    let rim = [(1.0, 0.4), (0.4, 1.0), (-0.4, 1.0), (-1.0, 0.4)].map(|(x, y)| Vec3::new(x, y, 1.0));
    let corners: Vec<Vec3> =
        rim.iter().flat_map(|p| [*p, -p, Vec3::new(p.x, p.y, -1.0), Vec3::new(-p.x, -p.y, 1.0)]).collect();
    let prism = hull(&corners);
    assert_eq!(prism.faces.len(), 10);
    let z = Vec3::z();
    let of_cube = [(Vec3::x(), Vec3::y()), (z, Vec3::x()), (-Vec3::y(), z)].map(|two| (&cube, two));
    let of_prism = [(z, Vec3::x()), (-z, Vec3::x()), (z, -Vec3::y())].map(|two| (&prism, two));
    for (solid, (a, b)) in of_cube.into_iter().chain(of_prism) {
        let p = (a + b) * 0.5;
        let tied: Vec<usize> =
            (0..solid.faces.len()).filter(|&f| solid.faces[f].height(&p) == -0.5).collect();
        assert_eq!(tied.len(), 2);
        for &reached in &tied {
            assert_eq!(follow(&p, solid, reached).pushes, tied[0]);
        }
    }
    // A tall prism of eight sides around z, seen from its middle: both ways from the top, and from the
    // bottom, to the side are equally short. Rotated and mirrored, so that its faces come in other orders.
    let outline = [(0.5, 3.0), (1.0, 2.5), (1.0, -2.5), (0.5, -3.0)];
    let frames = [(Vec3::x(), Vec3::y()), (Vec3::y(), -Vec3::x()), (Vec3::y(), Vec3::x())];
    for (e_x, e_y) in frames {
        let at = |x: f64, y: f64, z: f64| e_x * x + e_y * y + Vec3::z() * z;
        let corners = outline
            .iter()
            .flat_map(|&(x, y)| [(x, -9.0), (x, 9.0), (-x, -9.0), (-x, 9.0)].map(|(x, z)| at(x, y, z)));
        let prism = common::hull(&corners.collect::<Vec<_>>());
        let face = |n: Vec3| prism.faces.iter().position(|f| f.normal.dot(&n) > 0.99).expect("face");
        for start in [1.0, -1.0] {
            let slopes = [1.0, -1.0].map(|x| face(at(x, start, 0.0).normalize()));
            let heights = slopes.map(|slope| prism.faces[slope].height(&Vec3::zeros()));
            assert_eq!(heights[0], heights[1]);
            let side = if slopes[0] < slopes[1] { 1.0 } else { -1.0 };
            let reached = follow(&Vec3::zeros(), &prism, face(at(0.0, start, 0.0)));
            assert_eq!(reached.face, face(at(side, 0.0, 0.0)));
        }
    }
}
