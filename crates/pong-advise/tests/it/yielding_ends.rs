//! Bars, cylinders and cones whose ends yield on convex solids and on triangles (docs/theory.md, 2.8): the stiffness that the
//! adviser assumes against that of shallow contacts in random poses, by differences of the wrench.

use nalgebra::{DMatrix, Matrix3};
use pong_advise::{GroupMass, StepPlan, WrenchCoupling, acting_report, step_report};
use pong_engine::{Config, InterfaceId, State, World};
use pong_geometry::{Quat, Vec3};
use pong_testkit::random::rotation_between;
use pong_testkit::ron::{box_polyhedron, model, place_of, plate_mesh, surface, triangle_mesh};
use pong_testkit::worlds::paired_with_first;
use pong_testkit::{Random, long_samples};

const K: f64 = 1e6;

/// A part with an axis along x from −half to half, with the radius of both ends, m.
struct Part {
    text: String,
    half: f64,
    radii: [f64; 2],
}

impl Part {
    fn random(kind: &str, random: &mut Random) -> Self {
        let (half, radius) = (random.log_between(0.02, 0.8), random.log_between(0.02, 0.3));
        let ends = format!("ends: (({:?},0,0),({half:?},0,0))", -half);
        let other = random.pick(&[0.0, 0.3, 0.8]) * radius;
        let (more, radii) = match kind {
            "LineSegment" => (String::new(), [0.0; 2]),
            "Cone" => (format!(", radii: ({radius:?}, {other:?})"), [radius, other]),
            _ => (format!(", radius: {radius:?}"), [radius; 2]),
        };
        Self { text: format!("{kind}(name: \"a\", {ends}{more})"), half, radii }
    }
}

/// Body below A: its text, its corners, m, and directions in which it has faces, edges and corners.
struct Ground {
    text: String,
    corners: Vec<Vec3>,
    normals: Vec<Vec3>,
    is_of_triangles: bool,
}

/// A box, an octahedron, a box of triangles, a plate and a roof, `scale` times 1 m.
fn grounds(scale: f64) -> Vec<Ground> {
    let half = [0.5, 0.3, 0.2].map(|half| scale * half);
    let corner = |code: usize| Vec3::from_fn(|k, _| if code >> k & 1 == 0 { -half[k] } else { half[k] });
    let corners: Vec<Vec3> = (0..8).map(corner).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let cut = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
    let triangles: Vec<[usize; 3]> = quads.into_iter().flat_map(cut).collect();
    let tip = |i: usize| Vec3::ith(i / 2, if i.is_multiple_of(2) { 0.4 } else { -0.4 }) * scale;
    let tips: Vec<Vec3> = (0..6).map(tip).collect();
    let face = |code: usize| {
        let [x, y, z] = [0, 1, 2].map(|k| 2 * k + (code >> k & 1));
        if code.count_ones().is_multiple_of(2) { [x, y, z] } else { [x, z, y] }
    };
    let faces: Vec<[usize; 3]> = (0..8).map(face).collect();
    let places: Vec<String> = tips.iter().map(place_of).collect();
    let hull = format!("Polyhedron(name: \"b\", vertices: [{}], faces: {faces:?})", places.join(","));
    let roof = |x: f64, y: f64| Vec3::new(x, y, -0.5 * x.abs());
    let flat = |x: f64, y: f64| Vec3::new(x, y, 0.0);
    let rim = [-0.5, 0.0, 0.5].map(|x| [-0.5, 0.5].map(|y| (scale * x, scale * y))).concat();
    let over = |place: &dyn Fn(f64, f64) -> Vec3| rim.iter().map(|(x, y)| place(*x, *y)).collect();
    // Faces, edges and corners of a box.
    let way = |code: usize| Vec3::from_fn(|k, _| (code / [1, 3, 9][k] % 3) as f64 - 1.0);
    let around: Vec<Vec3> = (0..27).filter_map(|code| way(code).try_normalize(0.0)).collect();
    let up: Vec<Vec3> = [-0.5, 0.0, 0.5].map(|x| Vec3::new(x, 0.0, 1.0).normalize()).into();
    let ground = |text, corners: &Vec<Vec3>, normals: &Vec<Vec3>, is_of_triangles| Ground {
        text,
        corners: corners.clone(),
        normals: normals.clone(),
        is_of_triangles,
    };
    vec![
        ground(box_polyhedron("b", [0.0; 3], half, ""), &corners, &around, false),
        ground(hull, &tips, &around, false),
        ground(triangle_mesh("b", &corners, &triangles, ""), &corners, &around, true),
        ground(plate_mesh("b", 4, scale, flat), &over(&flat), &vec![Vec3::z()], true),
        ground(plate_mesh("b", 2, scale, roof), &over(&roof), &up, true),
    ]
}

/// Mass with random moments that a body of the size 0.3 m can have.
fn random_mass(random: &mut Random) -> GroupMass {
    let mass = random.log_between(0.1, 10.0);
    let points: [Vec3; 3] = [(); 3].map(|()| {
        let size = random.log_between(0.01, 0.5);
        random.vector(size)
    });
    let inertia =
        points.iter().map(|p| (Matrix3::identity() * p.norm_squared() - p * p.transpose()) * mass / 3.0);
    let i = inertia.sum::<Matrix3<f64>>() + Matrix3::identity() * 1e-4 * mass;
    GroupMass {
        inertia: [i.m11, i.m22, i.m33, i.m12, i.m13, i.m23],
        mass_center: random.vector(0.1).into(),
        ..GroupMass::point(mass)
    }
}

fn skew(v: &Vec3) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// Mass matrix of the twist of the group's origin, along common axes.
fn mass_matrix(mass: &GroupMass, turn: &Quat) -> DMatrix<f64> {
    let turn = turn.to_rotation_matrix().into_inner();
    let [xx, yy, zz, xy, xz, yz] = mass.inertia;
    let inertia = turn * Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz) * turn.transpose();
    let lever = skew(&(turn * Vec3::from(mass.mass_center)));
    let mut all = DMatrix::zeros(6, 6);
    all.view_mut((0, 0), (3, 3)).copy_from(&(Matrix3::identity() * mass.mass));
    all.view_mut((0, 3), (3, 3)).copy_from(&(-mass.mass * lever));
    all.view_mut((3, 0), (3, 3)).copy_from(&(mass.mass * lever));
    all.view_mut((3, 3), (3, 3)).copy_from(&(inertia - mass.mass * lever * lever));
    all
}

/// Two bodies in contact.
struct Meeting {
    world: World,
    bodies: [InterfaceId; 2],
    poses: [(Vec3, Quat); 2],
    masses: [GroupMass; 2],
}

impl Meeting {
    /// Evaluates with body `i` moved along, or for `k` from 3 on turned about, axis `k`; returns both wrenches.
    fn moved(&mut self, i: usize, k: usize, by: f64) -> [[f64; 6]; 2] {
        for (body, (position, turn)) in self.poses.iter().enumerate() {
            let (mut position, mut turn) = (*position, *turn);
            if body == i && k < 3 {
                position[k] += by;
            } else if body == i {
                turn = Quat::from_scaled_axis(Vec3::ith(k - 3, by)) * turn;
            }
            let q = turn.quaternion();
            let state =
                State { position: position.into(), orientation: [q.w, q.i, q.j, q.k], ..State::identity() };
            self.world.set_state(self.bodies[body], &state).unwrap();
        }
        self.world.evaluate().unwrap();
        self.bodies.map(|body| {
            let wrench = self.world.wrench_common(body).unwrap();
            let mut all = [0.0; 6];
            all[..3].copy_from_slice(wrench.force.as_slice());
            all[3..].copy_from_slice(wrench.moment.as_slice());
            all
        })
    }

    /// The largest ω² of the contacts by differences of the width `step`, m, and that of `acting_report` in these poses,
    /// 1/s².
    fn rates(&mut self, step: f64, size: f64, plan: &StepPlan) -> [f64; 2] {
        let free: Vec<usize> = (0..2).filter(|i| self.masses[*i].mass.is_finite()).collect();
        let (mut stiffness, mut mass) =
            (DMatrix::zeros(6 * free.len(), 6 * free.len()), DMatrix::zeros(6 * free.len(), 6 * free.len()));
        let told: Vec<_> = self.bodies.into_iter().zip(self.masses).collect();
        let mut assumed = 0.0_f64;
        for (column, i) in free.iter().enumerate() {
            mass.view_mut((6 * column, 6 * column), (6, 6))
                .copy_from(&mass_matrix(&self.masses[*i], &self.poses[*i].1));
            for k in 0..6 {
                let by = if k < 3 { step } else { step / size };
                let [after, before] = [by, -by].map(|by| {
                    let wrenches = self.moved(*i, k, by);
                    assumed = assumed.max(acting_report(&self.world, plan, &told).unwrap().stiffness_rate);
                    wrenches
                });
                for (row, j) in free.iter().enumerate() {
                    for l in 0..6 {
                        stiffness[(6 * row + l, 6 * column + k)] =
                            (before[*j][l] - after[*j][l]) / (2.0 * by);
                    }
                }
            }
        }
        let root = mass.cholesky().unwrap().l().try_inverse().unwrap();
        let even = 0.5 * (&stiffness + stiffness.transpose());
        [(&root * even * root.transpose()).symmetric_eigenvalues().max(), assumed]
    }
}

/// A random part that lies, stands or leans on a face, an edge or a corner of a ground, by no more than a ten-thousandth of
/// its smallest length deep, with random masses. `None` where another rule holds.
fn meeting(kind: &str, ground: &Ground, random: &mut Random) -> Option<(Meeting, [f64; 2])> {
    let part = Part::random(kind, random);
    let n = ground.normals[random.below(ground.normals.len())];
    let n = if random.chance(0.3) { (n + random.direction() * 0.3).normalize() } else { n };
    let tilt = random.direction() * random.pick(&[0.0, 1e-5, 1e-3, 0.03, 0.3]);
    let axis = match random.below(4) {
        0 => random.direction(),
        1 => (n + tilt).normalize(),
        _ => (random.across(&n) + tilt).normalize(),
    };
    let aside = n.cross(&axis).norm();
    // On triangles a standing drum has a rule of its own.
    if ground.is_of_triangles && matches!(kind, "Cylinder" | "Cone") && aside < 0.05 {
        return None;
    }
    let radius = part.radii[0].max(part.radii[1]);
    let depth = radius.min(part.half).max(0.01) * random.log_between(1e-6, 1e-4);
    let below = |end: usize| if kind == "Capsule" { part.radii[end] } else { part.radii[end] * aside };
    let along = part.half * axis.dot(&n);
    let low = (-along - below(0)).min(along - below(1));
    let height = |corner: &Vec3| n.dot(corner);
    let top = *ground.corners.iter().max_by(|a, b| height(a).total_cmp(&height(b)))?;
    let touch = axis * (part.half * random.between(-1.0, 1.0))
        + random.across(&axis) * (part.radii[0] * random.unit());
    let inward = random.pick(&[0.0, 0.5, 1.0]) * random.unit();
    let place = top.lerp(&Vec3::zeros(), inward) - touch;
    let position = place + n * (n.dot(&top) - depth - low - n.dot(&place));
    let texts = [
        model("a", &surface(K, "friction: None"), &part.text),
        model("b", &surface(f64::INFINITY, "friction: None"), &ground.text),
    ];
    let (world, _, bodies) = paired_with_first(Config::default(), &[&texts[0], &texts[1]]);
    let mut masses = [random_mass(random), random_mass(random)];
    if let Some(fixed) = random.pick(&[Some(0), Some(1), None]) {
        masses[fixed] = GroupMass::immovable();
    }
    let poses = [(position, rotation_between(&Vec3::x(), &axis)), (Vec3::zeros(), Quat::identity())];
    Some((Meeting { world, bodies: [bodies[0], bodies[1]], poses, masses }, [depth, part.half + radius]))
}

/// No motion of the two bodies meets more stiffness than the adviser assumes, before they touch and when they do, and of most
/// contacts it assumes no more than there is.
#[test]
fn shallow_contacts_are_within_the_bounds() {
    let plan = StepPlan { accuracy: None, ..StepPlan::new(1e-6, WrenchCoupling::SemiImplicit) };
    for kind in ["LineSegment", "Capsule", "Cylinder", "Cone"] {
        let (mut steps, mut before, mut acting) = (0, Vec::new(), Vec::new());
        for (which, ground) in [1.0, 0.2].into_iter().flat_map(grounds).enumerate() {
            // Triangles push no line segment.
            if kind == "LineSegment" && ground.is_of_triangles {
                continue;
            }
            for case in 0..long_samples(200, 1000) as u64 {
                let mut random = Random::new(71, which as u64, case);
                let Some((mut meeting, [depth, size])) = meeting(kind, &ground, &mut random) else {
                    continue;
                };
                let told: Vec<_> = meeting.bodies.into_iter().zip(meeting.masses).collect();
                let sure = step_report(&meeting.world, &plan, &told).unwrap().surely_stable_step();
                let [found, assumed] = meeting.rates(1e-3 * depth, size, &plan);
                // Apart, or over a border deeper than meant.
                if assumed == 0.0 || meeting.world.contacts_iter().any(|contact| contact.depth > 2.0 * depth)
                {
                    continue;
                }
                // A wrench that steps has no stiffness.
                let [again, _] = meeting.rates(2e-4 * depth, size, &plan);
                if (again - found).abs() > 0.02 * found {
                    steps += 1;
                    continue;
                }
                before.push(found / (2.0 / sure).powi(2));
                acting.push(found / assumed);
                let (before, acting) = (before[before.len() - 1], acting[acting.len() - 1]);
                // The force times its lever is not counted.
                assert!(before < 1.01 && acting < 1.01, "{kind} on {which}, case {case}: {before}, {acting}");
            }
        }
        acting.sort_by(f64::total_cmp);
        let median = acting[acting.len() / 2];
        let most = [&before, &acting].map(|all| all.iter().copied().fold(0.0, f64::max));
        println!("{kind}: {} touch, {steps} step, {most:.3?}, median {median:.3}", acting.len());
        assert!(acting.len() * 10 >= long_samples(200, 2000) && median > 0.9, "{kind}");
        assert!(5 * steps <= acting.len(), "{kind}");
    }
}
