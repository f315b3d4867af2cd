//! Scaling by 10⁻⁴ and 10⁴ and rigid motions change only the scale and the frame, for every tester here.
//!
//! Degenerate cases: sizes of 10⁻⁴ and 10⁴ m; places near 0.

use crate::common::{Random, cuboid_corners, hull_with_walls, moved, random_motion, scaled, stretched_hull};
use crate::oracle_support::{Worst, counting_contacts, dented_ball, map_vertices, moved_surface};
use pong_geometry::interference::Interference;
use pong_geometry::interference::line_segment_plane::line_segment_plane;
use pong_geometry::interference::line_segment_polyhedron::line_segment_polyhedron;
use pong_geometry::interference::point_plane::point_plane;
use pong_geometry::interference::point_polyhedron::{follow, point_below_face, shallowest_face};
use pong_geometry::interference::point_sphere::point_sphere;
use pong_geometry::interference::ray_plane::{ray_contact, ray_plane};
use pong_geometry::interference::ray_polyhedron::ray_polyhedron;
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::interference::sphere_plane::sphere_plane;
use pong_geometry::interference::sphere_polyhedron::{sphere_inside_polyhedron, sphere_outside_polyhedron};
use pong_geometry::interference::sphere_sphere::sphere_sphere;
use pong_geometry::primitive::{
    LineSegment, Plane, Point, Polyhedron, Ray, RayResponse, Sphere, TriangleSet,
};
use pong_geometry::{Transform, Vec3};

struct Scene {
    solids: Vec<Polyhedron>,
    mesh: TriangleSet,
    plane: Plane,
    ball: Sphere,
    point: Vec3,
    sphere: Sphere,
    segment: LineSegment,
    ray: Ray,
}

impl Scene {
    fn random(random: &mut Random, solids: &[Polyhedron], mesh: &TriangleSet) -> Self {
        let mut place = |reach: f64| random.direction() * random.between(0.0, reach);
        let (point, center, a, b, origin) = (place(1.0), place(1.6), place(1.5), place(1.5), place(2.0));
        let target = place(0.6);
        Self {
            solids: solids.to_vec(),
            mesh: mesh.clone(),
            plane: Plane { normal: random.direction(), offset: random.between(-0.5, 0.5) },
            ball: Sphere { center: random.direction() * 0.3, radius: random.between(0.2, 0.9) },
            point,
            sphere: Sphere { center, radius: random.between(0.1, 0.8) },
            segment: LineSegment { ends: [a, b] },
            ray: Ray {
                origin,
                direction: (target - origin).normalize(),
                length: random.between(0.5, 4.0),
                reach: Some(random.between(0.0, 0.5)),
                response: RayResponse::Normal,
            },
        }
    }

    fn scaled(&self, s: f64) -> Self {
        let ball = |b: &Sphere| Sphere { center: b.center * s, radius: b.radius * s };
        Self {
            solids: self.solids.iter().map(|p| scaled(p, s)).collect(),
            mesh: map_vertices(&self.mesh, |v| v * s),
            plane: Plane { offset: self.plane.offset * s, ..self.plane },
            ball: ball(&self.ball),
            point: self.point * s,
            sphere: ball(&self.sphere),
            segment: LineSegment { ends: self.segment.ends.map(|e| e * s) },
            ray: Ray {
                origin: self.ray.origin * s,
                length: self.ray.length * s,
                reach: self.ray.reach.map(|r| r * s),
                ..self.ray
            },
        }
    }

    fn moved(&self, x: &Transform) -> Self {
        let normal = x.vector(&self.plane.normal);
        Self {
            solids: self.solids.iter().map(|p| moved(p, x)).collect(),
            mesh: moved_surface(&self.mesh, x),
            plane: Plane { normal, offset: self.plane.offset + normal.dot(&x.translation) },
            ball: self.ball.carried(x),
            point: x.point(&self.point),
            sphere: self.sphere.carried(x),
            segment: self.segment.carried(x),
            ray: self.ray.carried(x),
        }
    }

    /// All contacts, in a fixed order.
    fn contacts(&self) -> Vec<Option<Interference>> {
        let point = Point { position: self.point };
        let mut all = vec![
            point_plane(&point, &self.plane),
            point_sphere(&point, &self.ball),
            sphere_plane(&self.sphere, &self.plane),
            sphere_sphere(&self.sphere, &self.ball),
            ray_plane(&self.ray, &self.plane).map(|hit| ray_contact(&self.ray, &hit)),
        ];
        all.extend(line_segment_plane(&self.segment, &self.plane));
        for solid in &self.solids {
            for p in [self.point, self.sphere.center] {
                let inside = solid.contains(&p);
                let least = shallowest_face(&p, solid).filter(|_| inside);
                all.push(least.and_then(|face| point_below_face(&p, solid, face)));
                let walked = (0..solid.faces.len())
                    .find(|&f| inside && solid.faces[f].active)
                    .map(|f| follow(&p, solid, f).pushes);
                all.push(walked.and_then(|face| point_below_face(&p, solid, face)));
                let ball = Sphere { center: p, ..self.sphere };
                all.push(match least {
                    Some(face) => Some(sphere_inside_polyhedron(&ball, solid, face)),
                    None => sphere_outside_polyhedron(&ball, solid),
                });
            }
            all.extend(line_segment_polyhedron(&self.segment, solid));
            all.push(ray_polyhedron(&self.ray, solid).map(|hit| ray_contact(&self.ray, &hit)));
        }
        all.extend(counting_contacts(&self.sphere, &self.mesh, 0.1).into_iter().map(Some));
        for t in 0..self.mesh.triangles.len() as u32 {
            all.extend(ray_triangle(&self.ray, &self.mesh, t, 0.0).map(|h| Some(ray_contact(&self.ray, &h))));
        }
        all
    }
}

fn scenes(seed: u64, count: usize) -> Vec<Scene> {
    let mut random = Random(seed);
    let walled =
        hull_with_walls(&cuboid_corners(Vec3::new(-0.8, -0.6, -0.5), Vec3::new(0.7, 0.6, 0.4)), &|n, _| {
            n.x > 0.9
        });
    let solids =
        [moved(&walled, &random_motion(&mut random, 0.1)), stretched_hull(16, Vec3::new(1.0, 0.8, 0.6))];
    let mesh = dented_ball(5, 7, 0.2, &mut random);
    (0..count).map(|_| Scene::random(&mut random, &solids, &mesh)).collect()
}

/// Largest difference of two lists after the second is transformed back by `back`; `None` if the kinds of
/// contacts differ.
fn difference(a: &Scene, b: &Scene, back: &dyn Fn(&Interference) -> Interference) -> Option<f64> {
    let (first, second) = (a.contacts(), b.contacts());
    let same = first.len() == second.len()
        && first.iter().zip(&second).all(|(x, y)| x.map(|c| c.feature) == y.map(|c| c.feature));
    same.then(|| {
        let pairs = first.iter().flatten().zip(second.iter().flatten());
        pairs
            .map(|(x, y)| {
                let y = back(y);
                let turn = (x.normal_b - y.normal_b).norm() * x.depth.abs().min(1.0);
                (x.depth - y.depth).abs().max(turn).max((x.deepest_b - y.deepest_b).norm() * x.depth)
            })
            .fold(0.0, f64::max)
    })
}

#[test]
fn scaling_scales() {
    let mut worst = Worst::new("scaling by 1e±4, relative");
    for scene in scenes(801, 1500) {
        for s in [1e-4, 1e4] {
            let back =
                |c: &Interference| Interference { depth: c.depth / s, deepest_b: c.deepest_b / s, ..*c };
            // The thickness of a triangle scales with its body.
            let other = scene.scaled(s);
            let error = difference_scaled(&scene, &other, s, &back);
            worst.note(error, 1e-10);
        }
    }
}

/// [`difference`] without the mesh, whose thickness does not scale.
fn difference_scaled(a: &Scene, b: &Scene, s: f64, back: &dyn Fn(&Interference) -> Interference) -> f64 {
    let without_mesh =
        |scene: &Scene| Scene { mesh: TriangleSet::default(), solids: scene.solids.clone(), ..*scene };
    let solids = difference(&without_mesh(a), &without_mesh(b), back).expect("the same contacts");
    let meshes = [a, b].map(|scene| {
        let scale = if std::ptr::eq(scene, a) { 1.0 } else { s };
        counting_contacts(&scene.sphere, &scene.mesh, 0.1 * scale)
    });
    assert_eq!(meshes[0].len(), meshes[1].len());
    let on_mesh = meshes[0].iter().zip(&meshes[1]).map(|(x, y)| {
        let y = back(y);
        assert_eq!(x.feature, y.feature);
        (x.depth - y.depth).abs().max((x.normal_b - y.normal_b).norm() * x.depth)
    });
    on_mesh.fold(solids, f64::max)
}

#[test]
fn rigid_motions_move() {
    let mut worst = Worst::new("rigid motion");
    let mut random = Random(803);
    let mut other_features = 0;
    for scene in scenes(802, 3000) {
        let x = random_motion(&mut random, 3.0);
        let inverse = x.inverse();
        let back = |c: &Interference| Interference {
            normal_b: inverse.vector(&c.normal_b),
            deepest_b: inverse.point(&c.deepest_b),
            ..*c
        };
        match difference(&scene, &scene.moved(&x), &back) {
            Some(error) => worst.note(error, 1e-12),
            // A tie of two faces of a bar (one crossing, both tips out) may fall either way.
            None => other_features += 1,
        }
    }
    assert!(other_features < 30, "{other_features}");
}
