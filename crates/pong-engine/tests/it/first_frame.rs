//! A ball that touches a triangle surface without contact history: in the first frame, after a clear, and
//! when a pair is switched on. It is pushed to the side where it is, judged by the nearest point of the
//! surface, which an independent search over all triangles confirms.

use crate::common::mesh::{Mesh, SERIES, steel};
use crate::common::*;
use pong_engine::State;
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;
use std::collections::HashMap;

impl Mesh {
    /// A box with each side cut into `cells`² squares of two triangles.
    fn cuboid(half: Vec3, cells: usize) -> Self {
        let mut mesh = Self::new(Vec::new(), Vec::new());
        let mut known: HashMap<[usize; 3], usize> = HashMap::new();
        for (axis, high) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut at = |i: usize, j: usize| {
                let mut place = [0; 3];
                (place[axis], place[u], place[v]) = (if high { cells } else { 0 }, i, j);
                *known.entry(place).or_insert_with(|| {
                    let share = |k: usize| 2.0 * place[k] as f64 / cells as f64 - 1.0;
                    mesh.vertices.push(Vec3::from_fn(|k, _| share(k) * half[k]));
                    mesh.vertices.len() - 1
                })
            };
            for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
                let square = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                let order = if high { [0, 1, 2, 3] } else { [0, 3, 2, 1] };
                let [a, b, c, d] = order.map(|k| square[k]);
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        mesh
    }

    /// A roof over the y axis with its flanks cut into strips.
    fn ridge(slope: f64) -> Self {
        let ys = [-5.0, -1.0, 2.0, 5.0];
        let vertices =
            ys.iter().flat_map(|&y| [-3.0, 0.0, 3.0].map(|x: f64| Vec3::new(x, y, -slope * x.abs())));
        let mut triangles = Vec::new();
        for (row, side) in (0..3).flat_map(|row| [(row, 0), (row, 1)]) {
            let a = 3 * row + side;
            triangles.extend([[a, a + 1, a + 4], [a, a + 4, a + 3]]);
        }
        Self::new(vertices.collect(), triangles)
    }

    /// A floor and a thick shelf above it, joined by a wall: two faces that face up, one above the other.
    fn shelf(gap: f64) -> Self {
        Self::extruded(&[(2.0, 0.0), (0.0, 0.0), (0.0, gap), (2.0, gap), (2.0, gap + 0.1), (-0.5, gap + 0.1)])
    }

    /// A floor and a sheet above part of it that also faces up, joined by walls far away.
    fn sheet_above(gap: f64) -> Self {
        Self::extruded(&[(6.0, 0.0), (-4.0, 0.0), (-4.0, -5.0), (9.0, -5.0), (9.0, gap), (0.0, gap)])
    }

    /// A line in the plane of x and z, extruded along y.
    fn extruded(line: &[(f64, f64)]) -> Self {
        let row = |y: f64| line.iter().map(move |&(x, z)| Vec3::new(x, y, z));
        let count = line.len();
        let strip = |a: usize| [[a, a + count, a + count + 1], [a, a + count + 1, a + 1]];
        Self::new(row(-2.0).chain(row(2.0)).collect(), (0..count - 1).flat_map(strip).collect())
    }

    /// The mesh in other axes, optionally rounded to single precision.
    fn elsewhere(&self, turn: &Quat, shift: &Vec3, single: bool) -> Self {
        let mut mesh = self.turned(turn, shift);
        if single {
            mesh.vertices.iter_mut().for_each(|v| *v = v.map(|x| f64::from(x as f32)));
        }
        mesh
    }

    fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|v| self.vertices[v])
    }

    fn normal(&self, triangle: usize) -> Vec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(&(c - a)).normalize()
    }

    /// Nearest point of the surface, by a search over all triangles, and the sum of the normals around it,
    /// weighted by the triangles' angles there.
    fn nearest(&self, p: &Vec3) -> (Vec3, Vec3) {
        let points: Vec<Vec3> =
            (0..self.triangles.len()).map(|t| nearest_point(p, &self.corners(t))).collect();
        let best = points.iter().min_by(|a, b| (p - **a).norm().total_cmp(&(p - **b).norm())).unwrap();
        let mut normal = Vec3::zeros();
        for (t, q) in points.iter().enumerate().filter(|(_, q)| (**q - best).norm() < 1e-9) {
            let corners = self.corners(t);
            let corner = (0..3).find(|&k| (corners[k] - q).norm() < 1e-9);
            let angle = corner.map_or(std::f64::consts::PI, |k| {
                (corners[(k + 1) % 3] - corners[k]).angle(&(corners[(k + 2) % 3] - corners[k]))
            });
            normal += self.normal(t) * angle;
        }
        (*best, normal.normalize())
    }
}

/// Point of a triangle nearest to another point, by its seven regions.
fn nearest_point(p: &Vec3, [a, b, c]: &[Vec3; 3]) -> Vec3 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let gram = solved(ab.dot(&ab), ab.dot(&ac), ac.dot(&ac), ab.dot(&ap), ac.dot(&ap));
    if gram.0 >= 0.0 && gram.1 >= 0.0 && gram.0 + gram.1 <= 1.0 {
        return a + ab * gram.0 + ac * gram.1;
    }
    let on = |a: &Vec3, b: &Vec3| {
        let share = (p - a).dot(&(b - a)) / (b - a).norm_squared();
        a + (b - a) * share.clamp(0.0, 1.0)
    };
    let sides = [on(a, b), on(b, c), on(c, a)];
    *sides.iter().min_by(|a, b| (p - **a).norm().total_cmp(&(p - **b).norm())).unwrap()
}

/// Solves a symmetric system of two equations.
fn solved(xx: f64, xy: f64, yy: f64, x: f64, y: f64) -> (f64, f64) {
    let determinant = xx * yy - xy * xy;
    ((yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant)
}

fn ball(semi_axes: &Vec3) -> String {
    let text = if semi_axes.x == semi_axes.y && semi_axes.y == semi_axes.z {
        format!("Sphere(name: \"s\", center: (0,0,0), radius: {:?})", semi_axes.x)
    } else {
        let [x, y, z] = [semi_axes.x, semi_axes.y, semi_axes.z];
        format!("Ellipsoid(name: \"s\", center: (0,0,0), semi_axes: ({x:?},{y:?},{z:?}))")
    };
    model("ball", &steel(), &text)
}

/// Heights of the ball's centre above each face that pushes it, m.
fn heights(rig: &Rig, center: &Vec3) -> Vec<f64> {
    let faces = rig.world.contacts_iter().filter(|c| c.feature.is_face());
    faces.map(|c| c.normal.dot(&(center - c.point)) - 0.5 * c.depth).collect()
}

#[derive(Default, Debug)]
struct Tally {
    in_front: usize,
    touching: usize,
    pushed_from_behind: usize,
    wrong_force: usize,
    behind: usize,
}

/// Places a ball at random points near a mesh, and lets it stay, drift and return.
fn set_down(mesh: &Mesh, semi_axes: Vec3, poses: usize, convex: bool, random: &mut Random) -> Tally {
    let mut rig = Rig::new(&ball(&semi_axes), &mesh.text());
    let mut tally = Tally::default();
    let radius = semi_axes.min();
    for pose in 0..poses {
        let [a, b, c] = mesh.corners((random.unit() * mesh.triangles.len() as f64) as usize);
        let (u, v) = (random.unit(), random.unit());
        let place = a + (b - a) * (u * (1.0 - v)) + (c - a) * (u * v);
        let center = place + random.vector(radius);
        let (nearest, normal) = mesh.nearest(&center);
        let distance = (center - nearest).norm();
        let in_front = mesh.two_sided || normal.dot(&(center - nearest)) > 0.0;
        if distance < 1e-6 || (!mesh.two_sided && normal.dot(&(center - nearest)).abs() < 1e-6 * distance) {
            continue;
        }
        let turn = random.rotation();
        // The whole scene is rotated.
        let (frame, shift) = (random.rotation(), random.vector(2.0));
        let base = at(shift, frame);
        let state = |center: &Vec3| at(frame * center + shift, frame * turn);
        match pose % 3 {
            0 => rig.world.clear_contact_history(rig.objects[0]).unwrap(),
            1 => rig.world.clear_contact_history(rig.objects[1]).unwrap(),
            _ => {
                rig.world.set_pair_enabled(rig.pair, false).unwrap();
                rig.world.step().unwrap();
                rig.world.set_pair_enabled(rig.pair, true).unwrap();
            }
        }
        if !in_front {
            tally.behind += 1;
            continue;
        }
        tally.in_front += 1;
        // Placed, kept, and drifting slightly.
        let drift = random.vector(1e-3 * distance);
        for (step, center) in [center, center, center + drift, center + drift * 2.0].into_iter().enumerate() {
            rig.place([state(&center), base]);
            rig.world.step().unwrap();
            let from_behind = heights(&rig, &(frame * center + shift)).iter().any(|height| *height < -1e-9);
            tally.pushed_from_behind += usize::from(from_behind);
            if convex && step < 2 && semi_axes.max() == radius {
                let depth = radius - distance;
                let expected = if depth > 0.0 {
                    (center - nearest) * (SERIES * depth / distance)
                } else {
                    Vec3::zeros()
                };
                let got = frame.inverse() * rig.wrench(0).force;
                tally.touching += usize::from(depth > 0.0);
                tally.wrong_force += usize::from((got - expected).norm() > 1e-6 * SERIES);
            }
        }
    }
    tally
}

fn check(name: &str, mesh: &Mesh, poses: usize, convex: bool, random: &mut Random) {
    let (turn, shift) = (random.rotation(), random.vector(1.0));
    for (single, semi_axes) in
        [(false, Vec3::repeat(1.0)), (true, Vec3::repeat(0.5)), (true, Vec3::new(0.4, 1.0, 0.7))]
    {
        // In single precision flat faces are slightly folded, and a ball on two of them is pushed by both.
        let mesh = mesh.elsewhere(&turn, &shift, single);
        let tally = set_down(&mesh, semi_axes, poses, convex && !single, random);
        println!("{name}, {} triangles, semi-axes {semi_axes:?}: {tally:?}", mesh.triangles.len());
        assert!(tally.in_front > poses / 10, "{name}: {tally:?}");
        assert_eq!((tally.pushed_from_behind, tally.wrong_force), (0, 0), "{name}: {tally:?}");
    }
}

#[test]
fn no_ball_is_pushed_from_behind_that_is_set_down_in_front() {
    let mut random = Random(21);
    for two_sided in [true, false] {
        let square = [(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
        let square = Mesh { two_sided, ..Mesh::new(square.to_vec(), vec![[0, 1, 2], [0, 2, 3]]) };
        check("square", &square, 300, two_sided, &mut random);
    }
    for (cells, thickness) in [1, 4].into_iter().flat_map(|cells| [(cells, None), (cells, Some(3.0))]) {
        let plate = Mesh { thickness, ..Mesh::cuboid(Vec3::new(2.0, 3.0, 0.05), cells) };
        check("plate", &plate, 300, true, &mut random);
        let cube = Mesh { thickness, ..Mesh::cuboid(Vec3::repeat(0.7), cells) };
        check("cube", &cube, 300, true, &mut random);
    }
    let fine = Mesh { thickness: Some(3.0), ..Mesh::cuboid(Vec3::new(2.0, 3.0, 0.05), 41) };
    let tally = set_down(&fine, Vec3::repeat(1.0), 20, true, &mut random);
    println!("plate, {} triangles: {tally:?}", fine.triangles.len());
    assert!(tally.touching > 10 && (tally.pushed_from_behind, tally.wrong_force) == (0, 0), "{tally:?}");
    for slope in [0.2, 4.0 / 3.0, 5.0] {
        let ridge = Mesh { thickness: Some(6.0), ..Mesh::ridge(slope) };
        check("ridge", &ridge, 300, false, &mut random);
    }
    check("shelf", &Mesh { thickness: Some(2.0), ..Mesh::shelf(0.6) }, 300, false, &mut random);
}

/// A ball that rolls on a floor under a sheet of the same surface gets behind that sheet, but not through it:
/// only the floor pushes it, although the sheet is as level as the floor.
#[test]
fn no_ball_that_rolls_under_a_sheet_is_pushed_by_its_back() {
    /// Single-precision corners, some 10 m from the origin, have errors of 1e-6 m.
    const SINGLE: f64 = 1e-5;
    let mut random = Random(24);
    for trial in 0..60 {
        let (turn, shift) = (random.rotation(), random.vector(1.0));
        let mesh = Mesh::sheet_above(0.7).elsewhere(&turn, &shift, trial % 2 == 1);
        let mut rig = Rig::new(&ball(&Vec3::repeat(0.5)), &mesh.text());
        let height = random.between(0.4, 0.49);
        let mut at_x =
            |low: f64, high: f64| Vec3::new(random.between(low, high), random.between(-1.4, 1.4), height);
        let (before, under) = (at_x(-3.0, -0.6), at_x(0.6, 5.0));
        for place in [before, before, under, under] {
            let center = turn * place + shift;
            rig.place([at(center, random.rotation()), State::identity()]);
            rig.world.step().unwrap();
            let force = turn.inverse() * rig.wrench(0).force;
            let expected = Vec3::z() * (SERIES * (0.5 - height));
            assert!((force - expected).norm() < SINGLE * SERIES, "{trial}: {force:?}, not {expected:?}");
        }
    }
}

/// In the plane of a two-sided sheet, a centre counts as on its front.
#[test]
fn a_centre_in_a_two_sided_sheet_is_pushed_to_the_front_alone() {
    let square = [(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
    let sheet = Mesh { two_sided: true, ..Mesh::new(square.to_vec(), vec![[0, 1, 2], [0, 2, 3]]) };
    let mut rig = Rig::new(&ball(&Vec3::repeat(1.0)), &sheet.text());
    let mut random = Random(22);
    for _ in 0..50 {
        let (frame, shift) = (random.rotation(), random.vector(2.0));
        let place = Vec3::new(random.between(-3.0, 3.0), random.between(-3.0, 3.0), 0.0);
        rig.world.clear_contact_history(rig.objects[0]).unwrap();
        for height in [0.0, 0.0, 1e-3, 0.1] {
            let center = frame * (place + Vec3::z() * height) + shift;
            rig.place([at(center, frame), at(shift, frame)]);
            rig.world.step().unwrap();
            let force = frame.inverse() * rig.wrench(0).force;
            let expected = Vec3::z() * (SERIES * (1.0 - height));
            assert!((force - expected).norm() < 1e-6 * SERIES, "{height}: {force:?}");
        }
    }
}

/// Inside a closed mesh a ball is pushed out through the nearest face, as before.
#[test]
fn a_ball_set_down_inside_is_pushed_out() {
    let cube = Mesh { thickness: Some(2.0), ..Mesh::cuboid(Vec3::repeat(1.0), 3) };
    let mut rig = Rig::new(&ball(&Vec3::repeat(0.25)), &cube.text());
    let mut random = Random(23);
    for _ in 0..50 {
        let center = random.vector(0.95);
        rig.world.clear_contact_history(rig.objects[0]).unwrap();
        for _ in 0..2 {
            rig.place([at(center, Quat::identity()), State::identity()]);
            rig.world.step().unwrap();
            let below = 1.0 - center.amax();
            let force = rig.wrench(0).force;
            assert!((force.norm() - SERIES * (0.25 + below)).abs() < 1e-6 * SERIES, "{center:?}: {force:?}");
            assert!(force.dot(&center) > 0.0);
        }
    }
}

/// A ball that crosses the ridge of a roof in one step, from above one flank to below the other, came from
/// the front.
#[test]
fn a_ball_that_dives_over_a_ridge_is_pushed_back() {
    let ridge = Mesh { thickness: Some(1.0), ..Mesh::ridge(0.5) };
    let mut rig = Rig::new(&ball(&Vec3::repeat(0.1)), &ridge.text());
    for place in [Vec3::new(-0.3, 0.3, 0.2), Vec3::new(-0.1, 0.3, 0.02), Vec3::new(0.15, 0.3, -0.1)] {
        rig.place([at(place, Quat::identity()), State::identity()]);
        rig.world.step().unwrap();
    }
    let normal = Vec3::new(0.5, 0.0, 1.0).normalize();
    let depth = 0.1 - normal.dot(&Vec3::new(0.15, 0.0, -0.1));
    let force = rig.wrench(0).force;
    assert!((force - normal * (SERIES * depth)).norm() < 1e-6 * SERIES, "{force:?}");
}
