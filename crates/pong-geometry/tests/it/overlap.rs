//! Contact by overlapped volume: moments of the cells against closed forms, derivatives and symmetries.

use crate::common::{Random, cuboid, hull, random_motion, stretched_hull};
use pong_geometry::overlap::{Cell, Field, HalfSpace, Moments, Overlap, Surface, energy_and_wrench};
use pong_geometry::primitive::Polyhedron;
use pong_geometry::{Mat3, Quat, Transform, Twist, Vec3, Wrench};
use pong_testkit::{assert_near, samples};

/// Surface of a polyhedron, moved.
pub fn surface(polyhedron: &Polyhedron, x: &Transform) -> Surface {
    let mut surface = Surface::with_capacity(64);
    surface.add_vertices(polyhedron.vertices.iter().map(|vertex| x.point(&vertex.position)));
    for face in 0..polyhedron.faces.len() {
        surface.add_facet(polyhedron.rim(face).iter().map(|rim| rim.start));
    }
    surface
}

/// Half spaces of a polyhedron.
pub fn half_spaces(polyhedron: &Polyhedron) -> Vec<HalfSpace> {
    let half_space = |face: &pong_geometry::primitive::PolyhedronFace| HalfSpace {
        normal_b: face.normal,
        offset: face.offset,
    };
    polyhedron.faces.iter().map(half_space).collect()
}

fn moved(half_spaces: &[HalfSpace], x: &Transform) -> Vec<HalfSpace> {
    let moved = |half_space: &HalfSpace| {
        let normal = x.rotation * half_space.normal_b;
        HalfSpace { normal_b: normal, offset: half_space.offset + normal.dot(&x.translation) }
    };
    half_spaces.iter().map(moved).collect()
}

/// Cells of a surface in B's frame, at rest.
fn cells<'a>(overlap: &'a mut Overlap, a: &Surface, b: &Field<'_>) -> &'a [Cell] {
    overlap.cells(a, &unmoved(), b, &Twist::zero())
}

/// Energy and wrench about the origin for a modulus of 1, and the moments of all cells about the origin.
fn evaluate(a: &Surface, faces: &[HalfSpace], walls: &[HalfSpace]) -> (f64, Wrench, Moments) {
    let mut overlap = Overlap::with_capacity(64);
    let cells = cells(&mut overlap, a, &Field { faces, walls }).to_vec();
    let reference = overlap.reference_b();
    let (energy, wrench) = energy_and_wrench(&cells, &reference, faces);
    let mut all = Moments::default();
    for moments in cells.iter().map(|cell| cell.moments) {
        all.volume += moments.volume;
        all.first_b += moments.first_b + reference * moments.volume;
        all.second += moments.second
            + reference * moments.first_b.transpose()
            + moments.first_b * reference.transpose()
            + reference * reference.transpose() * moments.volume;
    }
    (energy, wrench, all)
}

/// A moved by a small translation and turned by a small angle about the origin.
fn nudged(x: &Transform, axis: usize, by: f64) -> Transform {
    if axis < 3 {
        let step = Vec3::ith(axis, by);
        return Transform { translation: x.translation + step, rotation: x.rotation };
    }
    let turn = Quat::new(Vec3::ith(axis - 3, by)).to_rotation_matrix();
    let rotation: Mat3 = turn.matrix() * x.rotation;
    Transform { translation: turn * x.translation, rotation }
}

fn bodies(random: &mut Random) -> Polyhedron {
    let size = Vec3::from_fn(|_, _| random.between(0.2, 1.0));
    match random.below(4) {
        0 => cuboid(-size, size),
        1 => stretched_hull(6 + random.below(12), size),
        2 => {
            let sides = 3 + random.below(6);
            let corner = |k: usize, z: f64| {
                let (sin, cos) = (k as f64 / sides as f64 * std::f64::consts::TAU).sin_cos();
                Vec3::new(size.x * cos, size.y * sin, z)
            };
            hull(&(0..sides).flat_map(|k| [corner(k, -size.z), corner(k, size.z)]).collect::<Vec<_>>())
        }
        _ => cuboid(-size, Vec3::new(size.x, size.y, size.z * 0.05)),
    }
}

/// Transform without any motion.
fn unmoved() -> Transform {
    Transform { rotation: Mat3::identity(), translation: Vec3::zeros() }
}

#[test]
fn a_box_below_a_plane_has_the_moments_of_a_box() {
    let (low, high) = (Vec3::new(-0.3, -0.2, -0.01), Vec3::new(0.1, 0.4, 0.5));
    let ground = [HalfSpace { normal_b: Vec3::z(), offset: 0.0 }];
    let (energy, wrench, all) = evaluate(&surface(&cuboid(low, high), &unmoved()), &ground, &[]);
    let (area, depth) = (0.4 * 0.6, 0.01);
    assert_near(all.volume, area * depth, 1e-13);
    assert_near(energy, area * depth * depth / 2.0, 1e-12);
    assert_near(wrench.force.z, area * depth, 1e-13);
    let expected = Vec3::new(-0.1, 0.1, 0.0).cross(&wrench.force);
    assert!((wrench.moment - expected).norm() < 1e-15, "{} for {expected}", wrench.moment);
    // ∫ x² dV over the lower slab.
    let x2 = (0.1_f64.powi(3) + 0.3_f64.powi(3)) / 3.0 * 0.6 * depth;
    assert_near(all.second[(0, 0)], x2, 1e-12);
    assert_near(all.second[(2, 2)], area * depth.powi(3) / 3.0, 1e-11);
}

#[test]
fn wrench_is_the_derivative_of_the_energy() {
    for index in 0..samples(3_000) {
        let mut random = Random::new(46, 1, index as u64);
        let (a, b) = (bodies(&mut random), bodies(&mut random));
        let faces = half_spaces(&b);
        let x = random_motion(&mut random, 1.2);
        let (energy, wrench, all) = evaluate(&surface(&a, &x), &faces, &[]);
        // A small part of the extent of the overlap: the second derivative of its energy may step, and the
        // third is large.
        let step = (3e-5 * all.volume.cbrt()).clamp(1e-8, 1e-6);
        let scale = wrench.force.norm() + wrench.moment.norm() + energy.sqrt() * 1e-3;
        for axis in 0..6 {
            let at = |by: f64| evaluate(&surface(&a, &nudged(&x, axis, by)), &faces, &[]).0;
            let slope = (at(step) - at(-step)) / (2.0 * step);
            let expected = if axis < 3 { -wrench.force[axis] } else { -wrench.moment[axis - 3] };
            let error = (slope - expected).abs();
            assert!(error <= 1e-6 * scale + 1e-12, "seed {index}, axis {axis}: {slope} for {expected}");
        }
    }
}

#[test]
fn both_fields_divide_the_same_volume() {
    for index in 0..samples(10_000) {
        let mut random = Random::new(46, 2, index as u64);
        let (a, b) = (bodies(&mut random), bodies(&mut random));
        let x = random_motion(&mut random, 1.2);
        let in_b = evaluate(&surface(&a, &x), &half_spaces(&b), &[]).2;
        let in_a = evaluate(&surface(&b, &unmoved()), &moved(&half_spaces(&a), &x), &[]).2;
        assert!((in_a.volume - in_b.volume).abs() < 1e-13, "seed {index}: {} {}", in_a.volume, in_b.volume);
        assert!((in_a.first_b - in_b.first_b).norm() < 1e-13, "seed {index}");
        assert!((in_a.second - in_b.second).norm() < 1e-13, "seed {index}");
    }
}

#[test]
fn equal_boxes_flush_at_every_edge_share_a_slab() {
    // Turned, so that no coordinate is exact.
    let mut random = Random::new(46, 3, 0);
    let b = cuboid(Vec3::repeat(-0.1), Vec3::repeat(0.1));
    for depth in [1e-3, 1e-6, 1e-9] {
        let frame = random_motion(&mut random, 1.0);
        let above = Transform {
            translation: frame.translation + frame.rotation * Vec3::new(0.0, 0.0, 0.2 - depth),
            rotation: frame.rotation,
        };
        let faces = moved(&half_spaces(&b), &frame);
        let (energy, wrench, all) = evaluate(&surface(&b, &above), &faces, &[]);
        let along = frame.rotation.tr_mul(&wrench.force);
        let room = 1e-15 / depth;
        assert_near(all.volume, 0.04 * depth, 1e-12 + room);
        // Within the depth of a side, that side is nearer than the top: F = K·δ·(a − δ)² + K·δ³/3.
        let expected = depth * (0.2 - depth).powi(2) + depth.powi(3) / 3.0;
        assert_near(along.z, expected, 1e-12 + room);
        assert!(along.xy().norm() < 1e-15, "{along}");
        let about = wrench.moment - above.translation.cross(&wrench.force);
        assert!(about.norm() < 1e-15, "{about}");
        let expected = 0.02 * depth * depth;
        assert!(energy > 0.0 && energy < expected * (1.0 + room), "{energy} for {expected}");
    }
}

#[test]
fn a_small_tilt_turns_back_by_the_second_moment_of_area() {
    let b = cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0));
    let a = cuboid(Vec3::new(-0.2, -0.1, 0.0), Vec3::new(0.2, 0.1, 0.3));
    let (depth, tilt) = (1e-4, 1e-5);
    let turn = Quat::new(Vec3::y() * tilt).to_rotation_matrix();
    let x = Transform { rotation: *turn.matrix(), translation: Vec3::new(0.0, 0.0, 1.0 - depth) };
    let (_, wrench, _) = evaluate(&surface(&a, &x), &half_spaces(&b), &[]);
    let second_moment = 0.2 * 0.4_f64.powi(3) / 12.0;
    let about_foot = wrench.moment - x.translation.cross(&wrench.force);
    assert_near(about_foot.y, -second_moment * tilt, 1e-3);
}

#[test]
fn cutting_the_rigid_body_changes_nothing() {
    for index in 0..samples(3_000) {
        let mut random = Random::new(46, 4, index as u64);
        let b = bodies(&mut random);
        let faces = half_spaces(&b);
        let x = random_motion(&mut random, 1.2);
        let (low, high) = (Vec3::repeat(-0.6), Vec3::new(0.6, 0.4, 0.8));
        let cut = random.between(-0.5, 0.7);
        let whole = evaluate(&surface(&cuboid(low, high), &x), &faces, &[]);
        let upper = evaluate(&surface(&cuboid(Vec3::new(low.x, low.y, cut), high), &x), &faces, &[]);
        let lower = evaluate(&surface(&cuboid(low, Vec3::new(high.x, high.y, cut)), &x), &faces, &[]);
        assert!((whole.0 - upper.0 - lower.0).abs() < 1e-13, "seed {index}");
        assert!((whole.1.force - upper.1.force - lower.1.force).norm() < 1e-13, "seed {index}");
        assert!((whole.1.moment - upper.1.moment - lower.1.moment).norm() < 1e-13, "seed {index}");
    }
}

#[test]
fn pieces_with_walls_have_the_field_of_the_whole_body() {
    for index in 0..samples(3_000) {
        let mut random = Random::new(46, 5, index as u64);
        let a = bodies(&mut random);
        let x = random_motion(&mut random, 1.2);
        let b = cuboid(Vec3::repeat(-0.7), Vec3::repeat(0.7));
        let faces = half_spaces(&b);
        let normal = random.direction();
        let wall = HalfSpace { normal_b: normal, offset: random.between(-0.5, 0.5) };
        let other = HalfSpace { normal_b: -normal, offset: -wall.offset };
        let a = surface(&a, &x);
        let whole = evaluate(&a, &faces, &[]);
        let pieces = [evaluate(&a, &faces, &[wall]), evaluate(&a, &faces, &[other])];
        assert!((whole.0 - pieces[0].0 - pieces[1].0).abs() < 1e-13, "seed {index}");
        let force = pieces[0].1.force + pieces[1].1.force;
        assert!((whole.1.force - force).norm() < 1e-13, "seed {index}");
    }
}

/// Channel of square section, cut from the front: a concave outline with a slot.
fn channel(depth_z: f64) -> Surface {
    let outline = [
        (-0.5, -0.5),
        (0.5, -0.5),
        (0.5, 0.5),
        (0.2, 0.5),
        (0.2, -0.2),
        (-0.2, -0.2),
        (-0.2, 0.5),
        (-0.5, 0.5),
    ]
    .map(|(x, y)| Vec3::new(x, y, 0.0));
    let lift = Vec3::z() * depth_z;
    let count = outline.len() as u32;
    let mut surface = Surface::with_capacity(64);
    surface.add_vertices(outline.iter().copied().chain(outline.iter().map(|corner| corner + lift)));
    surface.add_facet(count..2 * count);
    surface.add_facet((0..count).rev());
    for start in 0..count {
        let end = (start + 1) % count;
        surface.add_facet([start, end, end + count, start + count].into_iter());
    }
    surface
}

#[test]
fn a_concave_solid_is_the_sum_of_its_pieces() {
    let boxes = [((-0.5, -0.5), (0.5, -0.2)), ((-0.5, -0.2), (-0.2, 0.5)), ((0.2, -0.2), (0.5, 0.5))];
    let whole = channel(0.4);
    for index in 0..samples(3_000) {
        let mut random = Random::new(46, 6, index as u64);
        let x = random_motion(&mut random, 0.8);
        let faces = moved(&half_spaces(&bodies(&mut random)), &x);
        let got = evaluate(&whole, &faces, &[]);
        let (mut energy, mut force) = (0.0, Vec3::zeros());
        for ((x0, y0), (x1, y1)) in boxes {
            let piece = cuboid(Vec3::new(x0, y0, 0.0), Vec3::new(x1, y1, 0.4));
            let piece = evaluate(&surface(&piece, &unmoved()), &faces, &[]);
            energy += piece.0;
            force += piece.1.force;
        }
        assert!((got.0 - energy).abs() < 1e-13, "seed {index}: {} for {energy}", got.0);
        assert!((got.1.force - force).norm() < 1e-13, "seed {index}");
    }
}

#[test]
fn the_wrench_is_continuous_through_aligned_poses() {
    let b = cuboid(Vec3::repeat(-0.1), Vec3::repeat(0.1));
    let faces = half_spaces(&b);
    for index in 0..samples(3_000) {
        let mut random = Random::new(46, 7, index as u64);
        // Faces, edges and corners that coincide.
        let step = Vec3::from_fn(|_, _| random.pick(&[-0.2, -0.1, 0.0, 0.1, 0.2]));
        let angle = random.pick(&[0.0, 0.25, 0.5]) * std::f64::consts::PI;
        let axis = Vec3::ith(random.below(3), angle);
        let x = Transform { rotation: *Quat::new(axis).to_rotation_matrix().matrix(), translation: step };
        let here = evaluate(&surface(&b, &x), &faces, &[]).1;
        let by = 1e-9;
        let near = nudged(&nudged(&x, random.below(3), by), 3 + random.below(3), by);
        let there = evaluate(&surface(&b, &near), &faces, &[]).1;
        let change = (here.force - there.force).norm();
        assert!(change < 0.2 * by, "seed {index}: {change}");
    }
}

#[test]
fn scale_and_distance_change_only_the_units() {
    for index in 0..samples(1_000) {
        let mut random = Random::new(46, 8, index as u64);
        let (a, b) = (bodies(&mut random), bodies(&mut random));
        let x = random_motion(&mut random, 1.0);
        let here = evaluate(&surface(&a, &x), &half_spaces(&b), &[]);
        let frame = random_motion(&mut random, 1e3);
        let both =
            Transform { rotation: frame.rotation * x.rotation, translation: frame.point(&x.translation) };
        let there = evaluate(&surface(&a, &both), &moved(&half_spaces(&b), &frame), &[]);
        let force = frame.rotation.tr_mul(&there.1.force);
        assert!((force - here.1.force).norm() < 1e-11, "seed {index}");
        assert!((there.0 - here.0).abs() < 1e-11, "seed {index}");
    }
}

#[test]
fn solids_that_do_not_overlap_have_no_cells() {
    let b = cuboid(Vec3::repeat(-0.1), Vec3::repeat(0.1));
    let faces = half_spaces(&b);
    let mut overlap = Overlap::with_capacity(16);
    for step in [Vec3::x() * 0.2, Vec3::new(0.2, 0.2, 0.0), Vec3::repeat(0.2), Vec3::z() * 3.0] {
        let x = Transform { rotation: Mat3::identity(), translation: step };
        let cells = cells(&mut overlap, &surface(&b, &x), &Field { faces: &faces, walls: &[] });
        assert!(cells.is_empty(), "{step}: {cells:?}");
    }
    assert!(cells(&mut overlap, &Surface::default(), &Field { faces: &faces, walls: &[] }).is_empty());
}

#[test]
fn a_moved_surface_and_a_moving_field_agree() {
    for index in 0..samples(1_000) {
        let mut random = Random::new(46, 9, index as u64);
        let (a, b) = (bodies(&mut random), bodies(&mut random));
        let x = random_motion(&mut random, 1.2);
        let faces = half_spaces(&b);
        let field = Field { faces: &faces, walls: &[] };
        let mut overlap = Overlap::with_capacity(64);
        let at_rest = cells(&mut overlap, &surface(&a, &x), &field).to_vec();
        let velocity = Twist { linear: random.direction(), angular: random.direction() };
        let moving = overlap.cells(&surface(&a, &unmoved()), &x, &field, &velocity).to_vec();
        assert_eq!(at_rest.len(), moving.len(), "seed {index}");
        for (rest, cell) in at_rest.iter().zip(&moving) {
            assert_eq!((rest.face, rest.moments), (cell.face, cell.moments), "seed {index}");
            let face = &faces[cell.face];
            assert_eq!(face.depth(&cell.deepest_b), cell.deepest, "seed {index}");
            // The rate is affine and the cell contains its centroid.
            let centroid = overlap.reference_b() + cell.moments.centroid();
            let rate = -face.normal_b.dot(&velocity.at(&centroid));
            assert!(cell.least_rate <= rate + 1e-9, "seed {index}: {} {rate}", cell.least_rate);
            assert!(cell.deepest >= face.depth(&centroid) - 1e-9, "seed {index}");
        }
        let shares = overlap.share_volume(&surface(&a, &unmoved()), &x, &field);
        assert_eq!(shares, !moving.is_empty(), "seed {index}");
        let apart = Overlap::apart(&surface(&a, &unmoved()), &x, &field);
        assert!(!(apart && shares), "seed {index}");
    }
}

#[test]
fn a_tilting_box_leaves_at_one_edge() {
    let a = surface(&cuboid(Vec3::new(-1.0, -1.0, -0.1), Vec3::new(1.0, 1.0, 1.0)), &unmoved());
    let ground = [HalfSpace { normal_b: Vec3::z(), offset: 0.0 }];
    let velocity = Twist { linear: Vec3::z() * -0.5, angular: Vec3::y() * 2.0 };
    let mut overlap = Overlap::with_capacity(8);
    let cells = overlap.cells(&a, &unmoved(), &Field { faces: &ground, walls: &[] }, &velocity);
    // v_z = −½ − 2x, so the depth rate is ½ + 2x.
    assert_near(cells[0].least_rate, -1.5, 1e-15);
    assert_near(cells[0].deepest, 0.1, 1e-15);
    assert_eq!(cells[0].deepest_b.z, -0.1);
}

#[test]
fn two_halves_of_a_cut_have_one_boundary_and_the_whole_volume() {
    for index in 0..samples(3_000) {
        let mut random = Random::new(46, 10, index as u64);
        let x = random_motion(&mut random, 1.0);
        let whole = if index % 2 == 0 { surface(&bodies(&mut random), &x) } else { channel(0.4) };
        let wall = HalfSpace { normal_b: random.direction(), offset: random.between(-0.6, 0.6) };
        let parts = [whole.cut_by(&wall), whole.cut_by(&wall.opposite())];
        let [inner, outer] = &parts;
        for vertex in inner.vertices().iter().filter(|vertex| !whole.vertices().contains(vertex)) {
            assert!(outer.vertices().contains(vertex), "seed {index}: {vertex}");
        }
        let reference = Vec3::new(0.1, 0.2, 0.3);
        let of = |part: &Surface| part.moments(&reference);
        let (low, high) = whole.bounds();
        let room = 1e-14 * (high - low).product().max(1e-3);
        let sum = of(inner).volume + of(outer).volume;
        assert!((sum - of(&whole).volume).abs() < room, "seed {index}: {sum}");
        let first = of(inner).first_b + of(outer).first_b;
        assert!((first - of(&whole).first_b).norm() < 10.0 * room, "seed {index}");
        let second = of(inner).second + of(outer).second;
        assert!((second - of(&whole).second).norm() < 10.0 * room, "seed {index}");
        parts.iter().for_each(|part| assert!(is_closed(part), "seed {index}"));
    }
}

/// Every directed edge of a closed surface has as many opposite ones.
fn is_closed(surface: &Surface) -> bool {
    let mut count = std::collections::BTreeMap::new();
    for [start, end] in surface.facets().flatten() {
        *count.entry((*start.min(end), *start.max(end))).or_insert(0) += if start < end { 1 } else { -1 };
    }
    count.values().all(|count| *count == 0)
}

#[test]
fn a_surface_knows_its_area_and_bounds() {
    let whole = channel(0.4);
    // Outline 1 × 1 with a slot of 0.4 × 0.7.
    assert_near(whole.area(), 2.0 * (1.0 - 0.28) + 0.4 * (4.0 + 1.4), 1e-14);
    assert_eq!(whole.bounds(), (Vec3::new(-0.5, -0.5, 0.0), Vec3::new(0.5, 0.5, 0.4)));
}

/// Case of the file of known answers.
#[derive(Default)]
struct Known {
    name: String,
    vertices: Vec<Vec3>,
    surface: Surface,
    faces: Vec<HalfSpace>,
    walls: Vec<HalfSpace>,
    /// Face, volume, first and second moment (xx yy zz xy xz yz) of each cell.
    cells: Vec<[f64; 11]>,
    /// Energy, force and moment.
    answer: Vec<f64>,
    /// Relative change of the answer by the rounding of the input.
    rounding: f64,
}

fn known_answers() -> Vec<Known> {
    let mut cases: Vec<Known> = Vec::new();
    for line in include_str!("overlap_cases.txt").lines().filter(|line| !line.starts_with('#')) {
        let (tag, rest) = line.split_once(' ').expect("a tag and values");
        if tag == "case" {
            cases.push(Known { name: rest.to_owned(), ..Known::default() });
            continue;
        }
        let values: Vec<f64> = rest.split(' ').map(|value| value.parse().expect("a number")).collect();
        let half_space = || HalfSpace { normal_b: Vec3::from_column_slice(&values[..3]), offset: values[3] };
        let case = cases.last_mut().expect("a case");
        match tag {
            "v" => case.vertices.push(Vec3::from_column_slice(&values)),
            "f" => case.surface.add_facet(values.iter().map(|index| *index as u32)),
            "p" => case.faces.push(half_space()),
            "w" => case.walls.push(half_space()),
            "c" => case.cells.push(values.try_into().expect("a cell")),
            "u" => case.answer = values,
            _ => case.rounding = values[0],
        }
    }
    for case in &mut cases {
        case.surface.add_vertices(case.vertices.iter().copied());
    }
    cases
}

/// `overlap_cases.txt` was computed by another method, exactly.
#[test]
fn known_answers_agree() {
    for case in known_answers() {
        let mut overlap = Overlap::with_capacity(64);
        let cells =
            cells(&mut overlap, &case.surface, &Field { faces: &case.faces, walls: &case.walls }).to_vec();
        let at = overlap.reference_b();
        let volume: f64 = case.cells.iter().map(|cell| cell[1]).sum();
        let far = case.vertices.iter().map(Vec3::norm).fold(0.0, f64::max);
        let bound = volume * (10.0 * case.rounding).max(1e-12);
        let close = |got: f64, expected: f64, unit: f64, of: &str| {
            assert!((got - expected).abs() <= bound * unit, "{}, {of}: {got} for {expected}", case.name);
        };
        for cell in &cells {
            let face = cell.face as f64;
            let expected = case.cells.iter().find(|known| known[0] == face).map_or([0.0; 11], |known| *known);
            let Moments { volume, first_b: m, second } = cell.moments;
            close(volume, expected[1], 1.0, "volume");
            let first = m + at * volume;
            (0..3).for_each(|axis| close(first[axis], expected[2 + axis], far, "first moment"));
            let about = second + at * m.transpose() + m * at.transpose() + at * at.transpose() * volume;
            let axes = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
            for (axes, expected) in axes.iter().zip(&expected[5..]) {
                close(about[*axes], *expected, far * far, "second moment");
            }
        }
        let found = |face: f64| cells.iter().any(|cell| cell.face as f64 == face);
        let missed = case.cells.iter().filter(|known| !found(known[0])).map(|known| known[1]);
        close(missed.sum(), 0.0, 1.0, "cells that were not found");
        let (energy, wrench) = energy_and_wrench(&cells, &at, &case.faces);
        close(energy, case.answer[0], far, "energy");
        (0..3).for_each(|axis| close(wrench.force[axis], case.answer[1 + axis], 1.0, "force"));
        (0..3).for_each(|axis| close(wrench.moment[axis], case.answer[4 + axis], far, "moment"));
    }
}
