//! Single contacts against the formulas of docs/theory.md, 2 to 4, evaluated here by hand.

use crate::common::*;
use pong_engine::State;
use pong_geometry::{Quat, Vec3};

/// Stiffness 3 : 1, so A yields a quarter of the depth.
fn unequal(friction: &str) -> (String, String) {
    let soft = surface(1e5, &format!("normal: Linear(damping: 160.0), {friction}"));
    let hard = surface(3e5, &format!("normal: Linear(damping: 480.0), {friction}"));
    (
        model("tip", &hard, "Point(name: \"p\", position: (0.5,0,0))"),
        model("floor", &soft, "Plane(name: \"f\", normal: (0,0,1), offset: 0.2)"),
    )
}

#[test]
fn the_force_acts_where_the_two_surfaces_meet() {
    let (a, b) = unequal("friction: None");
    let mut rig = Rig::new(&a, &b);
    // Quarter turn about z: the tip is at (0, 0.5) from the group's origin; 4 mm deep.
    let turn = Quat::from_axis_angle(&Vec3::z_axis(), std::f64::consts::FRAC_PI_2);
    rig.place_a(Vec3::new(1.0, 2.0, 0.196), turn);
    rig.world.step().unwrap();
    let contact = rig.world.contacts()[0];
    assert!((contact.depth - 4e-3).abs() < 1e-15);
    assert!((contact.normal_force - 7.5e4 * 4e-3).abs() < 1e-9);
    // c = a + n·s_A·δ with s_A = k_B/(k_A + k_B) = 1/4.
    assert!((contact.point - Vec3::new(1.0, 2.5, 0.197)).norm() < 1e-15, "{:?}", contact.point);
    let moment = rig.world.wrench(rig.interfaces[0]).unwrap().moment;
    // In the group's own frame the arm is (0.5, 0, …) and the force points up: moment −0.5·F about y.
    assert!((moment - Vec3::new(0.0, -150.0, 0.0)).norm() < 1e-9, "{moment:?}");
}

#[test]
fn damping_opposes_the_approach_and_never_pulls() {
    let (a, b) = unequal("friction: None");
    // c = 480/16 + 160·9/16 N·s/m.
    let damping = 120.0;
    for (closing, spin, tilt) in
        [(0.5, 0.0, 0.0), (-0.5, 0.0, 0.0), (0.3, 1.0, 0.0), (0.3, 0.0, 2.0), (-9.0, 0.0, 0.0)]
    {
        let mut rig = Rig::new(&a, &b);
        let position = Vec3::new(-0.5, 0.3, 0.196);
        let velocity = Vec3::new(7.0, -3.0, 2.0 - closing);
        // The floor moves as well, and tilts about the x axis through its own origin.
        let tip = moving(position, Quat::identity(), velocity, Vec3::new(0.0, spin, 0.0));
        let floor =
            moving(Vec3::zeros(), Quat::identity(), Vec3::new(7.0, -3.0, 2.0), Vec3::new(tilt, 0.0, 0.0));
        rig.place([tip, floor]);
        rig.world.step().unwrap();
        // At c = (0, 0.3, 0.197), by ω × r: A's point −0.5·spin along z, B's 0.3·tilt.
        let rate = closing + 0.5 * spin + 0.3 * tilt;
        let contact = rig.world.contacts()[0];
        assert!((contact.depth_rate - rate).abs() < 1e-12, "{} {rate}", contact.depth_rate);
        let expected = (300.0 + damping * rate).max(0.0);
        assert!((contact.normal_force - expected).abs() < 1e-9, "{closing}: {}", contact.normal_force);
    }
}

/// The whole life of a bristle under a point dragged along x, against the formulas of section 4.
#[test]
fn a_dragged_point_sticks_then_slips_then_sticks_again() {
    let friction = "friction: Bristle(mu: 0.5, static_excess: 0.4, stiffness: 4e4, damping: 0.0)";
    let (a, b) = unequal(friction);
    let mut rig = Rig::new(&a, &b);
    let (load, k_t) = (300.0, 2e4);
    let (hold, drag) = (0.7 * load, 0.5 * load);
    let mut pull = |x: f64, v: f64| {
        let state = moving(Vec3::new(x, 0.0, 0.196), Quat::identity(), Vec3::new(v, 0.0, 0.0), Vec3::zeros());
        rig.place([state, State::identity()]);
        rig.world.step().unwrap();
        let contact = rig.world.contacts()[0];
        (contact.friction_force.x, contact.sticks)
    };
    assert_eq!(pull(0.0, 0.1), (0.0, true));
    for x in [0.002, 0.006, 0.0104] {
        let (force, sticks) = pull(x, 0.1);
        assert!((force + k_t * x).abs() < 1e-9 && sticks, "{x}: {force}");
    }
    assert!(k_t * 0.0106 > hold);
    for x in [0.0106, 0.02, 0.05] {
        let (force, sticks) = pull(x, 0.1);
        assert!((force + drag).abs() < 1e-9 && !sticks, "{x}: {force}");
    }
    // Reversed by 1 mm: sticks at once and unloads along its spring.
    let (force, sticks) = pull(0.049, -0.1);
    assert!((force + drag - k_t * 1e-3).abs() < 1e-9 && sticks, "{force}");
    let (force, _) = pull(0.030, -0.1);
    assert!(force > 0.0, "{force}");
}

/// Both c_t in series, as c is: 120·√⅔ N·s/m, at first touch, before the bristle has moved.
#[test]
fn friction_has_the_damping_ratio_of_the_normal_law() {
    let (a, b) = unequal("friction: Bristle(mu: 50)");
    let mut rig = Rig::new(&a, &b);
    let state = moving(Vec3::new(0.0, 0.0, 0.196), Quat::identity(), Vec3::new(0.3, 0.0, 0.0), Vec3::zeros());
    rig.place([state, State::identity()]);
    rig.world.step().unwrap();
    let force = rig.world.contacts()[0].friction_force;
    let expected = -0.3 * 120.0 * (2.0_f64 / 3.0).sqrt();
    assert!((force - Vec3::new(expected, 0.0, 0.0)).norm() < 1e-12, "{force:?}");
}

#[test]
fn friction_damping_is_cut_to_the_limit() {
    let friction = "friction: Bristle(mu: 0.5, stiffness: 4e4, damping: 400.0)";
    let (a, b) = unequal(friction);
    // c_t by squared shares of k_t: ¼ + ¼ of 400.
    for (speed, expected) in [(0.1, -20.0), (0.5, -100.0), (5.0, -150.0)] {
        let mut rig = Rig::new(&a, &b);
        let state =
            moving(Vec3::new(0.0, 0.0, 0.196), Quat::identity(), Vec3::new(speed, 0.0, 0.0), Vec3::zeros());
        rig.place([state, State::identity()]);
        rig.world.step().unwrap();
        let force = rig.world.contacts()[0].friction_force;
        assert!((force - Vec3::new(expected, 0.0, 0.0)).norm() < 1e-9, "{speed}: {force:?}");
    }
}

/// If the load falls, the bristle shrinks at once: the force never exceeds the limit at the current load.
#[test]
fn a_falling_load_shrinks_the_bristle() {
    let friction = "friction: Bristle(mu: 0.5, stiffness: 4e4)";
    let (a, b) = unequal(friction);
    let mut rig = Rig::new(&a, &b);
    let mut at_depth = |x: f64, depth: f64| {
        rig.place_a(Vec3::new(x, 0.0, 0.2 - depth), Quat::identity());
        rig.world.step().unwrap();
        rig.world.contacts()[0].friction_force.x
    };
    at_depth(0.0, 4e-3);
    assert!((at_depth(0.005, 4e-3) + 100.0).abs() < 1e-9);
    // μ·F = 0.5·75 N.
    assert!((at_depth(0.005, 1e-3) + 37.5).abs() < 1e-9);
    // It does not recover with the load.
    assert!((at_depth(0.005, 4e-3) + 37.5).abs() < 1e-9);
}

/// Slipping, then reversed under a quarter of the load: the bristle is cut at once to the kinetic limit of
/// that load. The static limit applies only once the force is below the kinetic one, so sticking again causes
/// no jump.
#[test]
fn what_sticks_again_under_less_load_holds_no_more_than_that_load_allows() {
    let friction = "friction: Bristle(mu: 0.5, static_excess: 0.4, stiffness: 4e4, damping: 0.0)";
    let (a, b) = unequal(friction);
    let mut rig = Rig::new(&a, &b);
    let mut pull = |x: f64, depth: f64, v: f64| {
        let velocity = Vec3::new(v, 0.0, 0.0);
        let state = moving(Vec3::new(x, 0.0, 0.2 - depth), Quat::identity(), velocity, Vec3::zeros());
        rig.place([state, State::identity()]);
        rig.world.step().unwrap();
        let contact = rig.world.contacts()[0];
        (contact.friction_force.x, contact.sticks)
    };
    pull(0.0, 4e-3, 0.1);
    // Standing still is no reversal.
    for (x, v) in [(0.05, 0.1), (0.051, 0.0)] {
        let (force, sticks) = pull(x, 4e-3, v);
        assert!((force + 150.0).abs() < 1e-9 && !sticks, "{force}");
    }
    // Back by 1 mm the bristle would pull with 130 N; μ_k·F = 0.5·75 N.
    let (force, sticks) = pull(0.050, 1e-3, -0.1);
    assert!((force + 37.5).abs() < 1e-9 && sticks, "{force}");
    // From there it unloads along its spring, k_t = 2e4 N/m, and holds up to μ_s·F = 0.7·75 N the other way.
    for (x, expected) in [(0.049, -17.5), (0.0456, 50.5)] {
        let (force, sticks) = pull(x, 1e-3, -0.1);
        assert!((force - expected).abs() < 1e-9 && sticks, "{force}");
    }
}

/// A bristle stores ½·K·p² at every load, and nothing beyond its limit.
#[test]
fn a_bristle_stores_half_its_stiffness_times_its_square() {
    let (a, b) = unequal("friction: Bristle(mu: 0.5, stiffness: 4e4)");
    let mut rig = Rig::new(&a, &b);
    let normal = 0.5 * 7.5e4 * 4e-3 * 4e-3;
    for (x, bristle) in [(0.0, 0.0), (1e-3, 1e-3), (5e-3, 5e-3), (0.02, 7.5e-3)] {
        rig.place_a(Vec3::new(x, 0.0, 0.196), Quat::identity());
        rig.world.step().unwrap();
        let stored = rig.world.contacts()[0].stored;
        assert!((stored - normal - 0.5 * 2e4 * bristle * bristle).abs() < 1e-12, "{x}: {stored} J");
    }
}

/// With μ = 0 the bristle force is zero for any displacement, and nothing becomes NaN.
#[test]
fn a_bristle_without_a_coefficient_holds_nothing() {
    let (a, b) = unequal("friction: Bristle(mu: 0.0, stiffness: 4e4, damping: 100.0)");
    let mut rig = Rig::new(&a, &b);
    for (x, v) in [(0.0, 0.0), (0.01, 0.1), (0.01, 0.0), (0.01, 0.0), (0.0, -0.1), (0.0, 0.0)] {
        let velocity = Vec3::new(v, 0.0, 0.0);
        let state = moving(Vec3::new(x, 0.0, 0.196), Quat::identity(), velocity, Vec3::zeros());
        rig.place([state, State::identity()]);
        rig.world.step().unwrap();
        assert_eq!(rig.world.contacts()[0].friction_force, Vec3::zeros(), "{x}");
    }
}

/// F_t = −μ·F_n·v/max(|v|, v_ε), against the tangential motion, without memory of earlier frames.
#[test]
fn coulomb_friction_follows_its_formula() {
    let coulomb = |mu: f64| format!("friction: Coulomb(mu: {mu:?}, slip_speed: 0.02)");
    let tip = model("tip", &surface(3e5, &coulomb(0.3)), "Point(name: \"p\", position: (0.5,0,0))");
    let floor = surface(1e5, &coulomb(0.6));
    let floor = model("floor", &floor, "Plane(name: \"f\", normal: (0,0,1), offset: 0.2)");
    let mut rig = Rig::new(&tip, &floor);
    let direction = Vec3::new(0.6, -0.8, 0.0);
    for (speed, share) in [(0.3, 1.0), (0.005, 0.25), (0.02, 1.0), (0.0, 0.0), (0.019, 0.95), (7.0, 1.0)] {
        let position = Vec3::new(-0.5, 0.0, 0.196);
        let state = moving(position, Quat::identity(), direction * speed, Vec3::zeros());
        rig.place([state, State::identity()]);
        rig.world.step().unwrap();
        let contact = rig.world.contacts()[0];
        // Harmonic mean of 0.3 and 0.6, and 300 N.
        let expected = direction * (-0.4 * 300.0 * share);
        assert!((contact.friction_force - expected).norm() < 1e-9, "{speed}: {:?}", contact.friction_force);
        assert_eq!(contact.sticks, speed < 0.02, "{speed}");
    }
}

/// A ball that rolls straight stretches no bristle; one that spins in place feels no torque about the normal.
#[test]
fn rolling_and_drilling_are_free() {
    let rough = surface(1e5, "friction: Bristle(mu: 0.8)");
    let rigid = "\"s\": (stiffness: inf, friction: Bristle(mu: 0.8))";
    let ball = model("ball", rigid, "Sphere(name: \"s\", center: (0,0,0), radius: 0.25)");
    let floor = model("floor", &rough, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    let mut rolling = Rig::new(&ball, &floor);
    let mut drilling = Rig::new(&ball, &floor);
    // The ball's surface is rigid, so the contact is at its lowest point, 0.25 m below the centre.
    let (rate, height) = (20.0, 0.249);
    for step in 0..2000 {
        let t = 1e-3 * f64::from(step);
        let roll = Quat::from_axis_angle(&Vec3::y_axis(), rate * t);
        let velocity = Vec3::new(0.25 * rate, 0.0, 0.0);
        let state =
            moving(Vec3::new(0.25 * rate * t, 0.0, height), roll, velocity, Vec3::new(0.0, rate, 0.0));
        rolling.place([state, State::identity()]);
        let spin = Quat::from_axis_angle(&Vec3::z_axis(), rate * t);
        let turning = Vec3::new(0.0, 0.0, rate);
        drilling
            .place([moving(Vec3::new(0.0, 0.0, height), spin, Vec3::zeros(), turning), State::identity()]);
        for rig in [&mut rolling, &mut drilling] {
            rig.world.step().unwrap();
            let wrench = rig.wrench(0);
            assert!(
                wrench.force.xy().norm() < 1e-9 && wrench.moment.norm() < 1e-9,
                "step {step}: {wrench:?}"
            );
        }
    }
}

/// A bristle survives the transition from facet to facet of a faceted roller: the block on top keeps its
/// grip.
#[test]
fn a_bristle_crosses_facets() {
    let rough = surface(1e5, "friction: Bristle(mu: 0.5)");
    let ball = model("ball", &rough, "Sphere(name: \"s\", center: (0,0,0), radius: 0.1)");
    // A gentle ridge of 5°: two facets that meet at x = 0.
    let slope = 5.0_f64.to_radians().tan();
    let ridge = format!(
        "TriangleMesh(name: \"m\", vertices: [(-1,-1,{z}),(0,-1,0),(1,-1,{z}),(-1,1,{z}),(0,1,0),(1,1,{z})], \
         triangles: [(0,1,4),(0,4,3),(1,2,5),(1,5,4)])",
        z = -slope
    );
    let ridge = model("ridge", &rough, &ridge);
    let mut rig = Rig::new(&ball, &ridge);
    let mut hold = f64::NAN;
    for step in 0..=40 {
        // Dragged over the ridge without rolling, 0.2 mm per step, always 1 mm deep below the current facet.
        let x = 2e-4 * f64::from(step - 20);
        let angle = slope.atan();
        let height = if x.abs() < 0.1 * angle.sin() { 0.099 } else { 0.0 };
        assert!(height > 0.0);
        rig.place_a(Vec3::new(x, 0.0, height), Quat::identity());
        rig.world.step().unwrap();
        let force: Vec3 = rig.world.contacts().iter().map(|c| c.friction_force).sum();
        let normal: f64 = rig.world.contacts().iter().map(|c| c.normal_force).sum();
        if step == 20 {
            hold = force.norm();
        }
        if step > 20 {
            assert!(force.norm() >= 0.98 * hold.min(0.5 * normal), "step {step}: {force:?}, held {hold}");
        }
    }
    assert!(hold > 20.0);
}

/// From one face of a solid to the next, where the normal jumps by 20°: the bristle keeps its stretch.
#[test]
fn a_bristle_crosses_the_ridge_of_a_solid() {
    let rough = surface(1e5, "friction: Bristle(mu: 50.0, stiffness: 1e4)");
    let tip = model("tip", &rough, "Point(name: \"p\", position: (0,0,0))");
    let slope = 10.0_f64.to_radians();
    let ridge = format!(
        "Polyhedron(name: \"ridge\", vertices: [(-1,-1,-1),(1,-1,-1),(1,1,-1),(-1,1,-1),(-1,-1,{z:?}),(0,-1,0),(1,-1,{z:?}),\
         (-1,1,{z:?}),(0,1,0),(1,1,{z:?})], faces: [[0,3,2,1],[4,5,8,7],[5,6,9,8],[0,1,6,5,4],[2,3,7,8,9],[0,4,7,3],[1,2,9,6]])",
        z = -slope.tan()
    );
    let mut rig = Rig::new(&tip, &model("ridge", &rough, &ridge));
    for step in 0..=40 {
        // 1 mm deep, 0.2 mm per step up one face and down the other.
        let x = 2e-4 * f64::from(step) - 3.9e-3;
        let z = -x.abs() * slope.tan() - 1e-3 / slope.cos();
        rig.place_a(Vec3::new(x, 0.0, z), Quat::identity());
        rig.world.step().unwrap();
        let contact = rig.world.contacts()[0];
        let lean = if x < 0.0 { -slope } else { slope };
        assert!((contact.normal - Vec3::new(lean.sin(), 0.0, lean.cos())).norm() < 1e-12, "{step}");
        // Each step stretches the bristle by its length along the face; across the ridge a little is lost.
        let expected = 0.5e4 * 2e-4 / slope.cos() * f64::from(step);
        let force = contact.friction_force.norm();
        let lost = if x < 0.0 { 1e-9 } else { 0.1 };
        assert!((force - expected).abs() < lost, "step {step}: {force} N, not {expected}");
    }
}

/// A bar that lies flat is one spring: each end carries half of the stiffness, the damping and the bristle.
#[test]
fn the_two_ends_of_a_bar_share_one_spring_and_one_bristle() {
    let friction = "friction: Bristle(mu: 0.5, stiffness: 4e4)";
    let (_, floor) = unequal(friction);
    let hard = surface(3e5, &format!("normal: Linear(damping: 480.0), {friction}"));
    let bar = model("bar", &hard, "LineSegment(name: \"l\", ends: ((-0.3,0,0),(0.3,0,0)))");
    let mut rig = Rig::new(&bar, &floor);
    let sink = Vec3::new(0.0, 0.0, -0.1);
    for x in [0.0, 1e-3] {
        let place = moving(Vec3::new(x, 0.0, 0.196), Quat::identity(), sink, Vec3::zeros());
        rig.place([place, State::identity()]);
        rig.world.step().unwrap();
    }
    let contacts = rig.world.contacts();
    assert_eq!(contacts.len(), 2);
    for contact in &contacts {
        assert!((contact.normal_force - 0.5 * (300.0 + 120.0 * 0.1)).abs() < 1e-9);
        assert!((contact.friction_force.x + 0.5 * 2e4 * 1e-3).abs() < 1e-9, "{:?}", contact.friction_force);
    }
}

/// Two facets of a shallow groove carry a ball together: one bristle's stiffness along the groove, not two.
#[test]
fn facets_less_than_sixty_degrees_apart_share_one_bristle() {
    let rough = surface(1e5, "friction: Bristle(mu: 2.0, stiffness: 4e4)");
    let ball = model("ball", &rough, "Sphere(name: \"s\", center: (0,0,0), radius: 0.1)");
    let slope = 20.0_f64.to_radians();
    let groove = format!(
        "TriangleMesh(name: \"m\", vertices: [(-1,-1,{z}),(0,-1,0),(1,-1,{z}),(-1,1,{z}),(0,1,0),(1,1,{z})], \
         triangles: [(0,1,4),(0,4,3),(1,2,5),(1,5,4)])",
        z = slope.tan()
    );
    let groove = model("groove", &rough, &groove);
    let mut rig = Rig::new(&ball, &groove);
    // 1 mm deep in both flanks.
    let height = 0.099 / slope.cos();
    for y in [0.0, 1e-3] {
        rig.place_a(Vec3::new(0.0, y, height), Quat::identity());
        rig.world.step().unwrap();
    }
    assert_eq!(rig.world.contact_count(), 2);
    let along: f64 = rig.world.contacts().iter().map(|c| c.friction_force.y).sum();
    assert!((along + 2e4 * 1e-3).abs() < 1e-9, "{along}");
    // And one normal spring: the shortest vector that clears both flanks is 1 mm / cos 20° straight up.
    let up = rig.wrench(0).force.z;
    assert!((up - 5e4 * 1e-3 / slope.cos()).abs() < 1e-9, "{up}");
}

/// Over a round body the bristle rotates with the contact plane, and friction stays in it.
#[test]
fn a_bristle_stays_in_the_contact_plane() {
    let rough = surface(1e5, "friction: Bristle(mu: 5.0, stiffness: 1e4)");
    let ball = model("ball", &rough, "Sphere(name: \"s\", center: (0,0,0), radius: 0.1)");
    let mut rig = Rig::new(&ball, &ball);
    let mut last = 0.0;
    for step in 0..=100 {
        // Around the other ball by 0.2 rad without rolling, always 1 mm deep.
        let angle = 2e-3 * f64::from(step);
        let outward = Vec3::new(angle.sin(), 0.0, angle.cos());
        rig.place_a(outward * 0.199, Quat::identity());
        rig.world.step().unwrap();
        let contact = rig.world.contacts()[0];
        assert!((contact.normal - outward).norm() < 1e-12);
        let lean = contact.friction_force.dot(&outward).abs();
        assert!(lean <= 1e-12 * (1.0 + contact.friction_force.norm()), "step {step}: leans by {lean}");
        last = contact.friction_force.norm();
    }
    // Each step stretches the bristle by the displacement of the centre along the plane; nothing is lost.
    let expected = 0.5e4 * 0.199 * 0.2;
    assert!((last / expected - 1.0).abs() < 1e-2, "{last} {expected}");
}

/// Force of a point 4 mm deep that closes at 0.5 m/s, with equal surfaces.
fn force_of(surface_values: &str) -> f64 {
    pressed(surface_values, 4e-3, 0.5).0
}

/// Normal force and stored energy of a point, with equal surfaces.
fn pressed(surface_values: &str, depth: f64, closing: f64) -> (f64, f64) {
    let alike = surface(2e5, surface_values);
    let tip = model("tip", &alike, "Point(name: \"p\", position: (0,0,0))");
    let floor = model("floor", &alike, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    let mut rig = Rig::new(&tip, &floor);
    let velocity = Vec3::new(0.0, 0.0, -closing);
    let tip = moving(Vec3::new(0.0, 0.0, -depth), Quat::identity(), velocity, Vec3::zeros());
    rig.place([tip, State::identity()]);
    rig.world.step().unwrap();
    let contact = rig.world.contacts()[0];
    (contact.normal_force, contact.stored)
}

#[test]
fn every_normal_law_follows_its_formula() {
    // In series k = 1e5; dampers c/2; S(¼) = 3/16 − 2/64.
    let (elastic, damping) = (400.0, 60.0 * 0.5);
    let ramp = 3.0 / 16.0 - 2.0 / 64.0;
    assert!((force_of("normal: Linear(damping: 120.0)") - (elastic + damping)).abs() < 1e-9);
    assert!(
        (force_of("normal: Linear(damping: 120.0, ramp: 0.016)") - (elastic + ramp * damping)).abs() < 1e-9
    );
    assert!((force_of("normal: Linear(damping: 120.0, ramp: 0.003)") - (elastic + damping)).abs() < 1e-9);
    let factor = 1.0 + 0.8 * 0.5;
    let linear = force_of("normal: HuntCrossley(dissipation: 0.8, exponent: 1.0)");
    assert!((linear - elastic * factor).abs() < 1e-9);
    // Half of the depth in each surface: k·(δ/2)^(3/2) with k = 2e5.
    let hertz = force_of("normal: HuntCrossley(dissipation: 0.8, exponent: 1.5)");
    assert!((hertz - 2e5 * 2e-3_f64.powf(1.5) * factor).abs() < 1e-9);
    // Two dampers that take half of depth and rate each: 2·c·½^(2 + q)·δ^q·δ'.
    for q in [0.0_f64, 0.25, 0.5, 0.6, 1.0, 1.5] {
        let law = format!("normal: PowerLaw(exponent: 1.5, damping_exponent: {q:?}, damping: 900.0)");
        let damped = 2.0 * 900.0 * 0.5_f64.powf(2.0 + q) * 4e-3_f64.powf(q) * 0.5;
        assert!((force_of(&law) / (2e5 * 2e-3_f64.powf(1.5) + damped) - 1.0).abs() < 1e-12, "{q}");
    }
    // A damping exponent of zero is the linear law, bit for bit.
    assert_eq!(
        force_of("normal: PowerLaw(exponent: 1.0, damping_exponent: 0.0, damping: 120.0)"),
        force_of("normal: Linear(damping: 120.0)")
    );
}

/// On a rigid floor, with q = p, the law is Hunt and Crossley's with χ = c/k.
#[test]
fn a_power_law_with_equal_exponents_is_that_of_hunt_and_crossley() {
    for exponent in ["1.0", "1.5"] {
        for (depth, rate) in [(1e-4, 0.5), (4e-3, -0.3), (4e-3, 0.0), (2e-3, -5.0)] {
            let on_rigid = |law: &str| {
                let soft = surface(2e5, &format!("normal: {law}, friction: None"));
                let mut rig = Rig::new(
                    &model("tip", &soft, "Point(name: \"p\", position: (0,0,0))"),
                    &model(
                        "floor",
                        "\"s\": (stiffness: inf)",
                        "Plane(name: \"f\", normal: (0,0,1), offset: 0)",
                    ),
                );
                let tip = moving(
                    Vec3::new(0.0, 0.0, -depth),
                    Quat::identity(),
                    Vec3::new(0.0, 0.0, -rate),
                    Vec3::zeros(),
                );
                rig.place([tip, State::identity()]);
                rig.world.step().unwrap();
                rig.world.contacts()[0].normal_force
            };
            let own = on_rigid(&format!(
                "PowerLaw(exponent: {exponent}, damping_exponent: {exponent}, damping: 1.6e5)"
            ));
            let hunt = on_rigid(&format!("HuntCrossley(dissipation: 0.8, exponent: {exponent})"));
            assert!((own - hunt).abs() <= 1e-14 * hunt, "{exponent} {depth} {rate}: {own} {hunt}");
            // The force drops to zero and never pulls.
            assert_eq!(hunt == 0.0, rate == -5.0);
        }
    }
}

/// The stored energy of every law is the integral of its static force: its slope is that force, and it is
/// zero at depth zero.
#[test]
fn every_law_stores_the_integral_of_its_force() {
    for law in [
        "normal: Linear(damping: 120.0)",
        "normal: Linear(damping: 120.0, ramp: 0.016)",
        "normal: HuntCrossley(dissipation: 0.8, exponent: 1.0)",
        "normal: HuntCrossley(dissipation: 0.8, exponent: 1.5)",
        "normal: PowerLaw(exponent: 1.0, damping_exponent: 0.6, damping: 900.0)",
        "normal: PowerLaw(exponent: 1.5, damping_exponent: 1.0, damping: 900.0)",
    ] {
        for depth in [1e-4, 4e-3] {
            let (force, stored) = pressed(law, depth, 0.0);
            let small = 1e-3 * depth;
            let rise = pressed(law, depth + small, 0.0).1 - pressed(law, depth - small, 0.0).1;
            assert!((rise / (2.0 * small * force) - 1.0).abs() < 1e-6, "{law}");
            assert!(pressed(law, 1e-3 * depth, 0.0).1 < 1e-5 * stored, "{law}");
            // Damping stores nothing.
            assert_eq!(pressed(law, depth, 0.5).1, stored, "{law}");
        }
    }
}
