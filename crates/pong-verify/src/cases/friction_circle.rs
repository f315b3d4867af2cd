//! V18: friction is isotropic.

use crate::case::{Case, Failure, Outcome};
use crate::measure::{bisect, radians};
use crate::row::Row;
use crate::scene::{Bristle, Duo, at, point_mass, with_friction};
use pong_engine::{Contact, InterfaceId, State, World};
use pong_executive::{Integrator, Load, Vec3};

pub const V18: Case = Case {
    id: "V18",
    title: "Friction circle",
    set_up: "One point, depth 1 mm at 1e5 N/m (100 N), μ_k = 0.4, μ_s = 0.5, drawn along 360 directions; then turned by \
             0° to 359° while slipping and drawn on for 25 p_k; then pulled by 0.999 and 1.001 of μ_s·N.",
    source: "break-away at μ_s·N in every direction; slip force μ_k·N against the motion",
    rows,
};

const STIFFNESS: f64 = 1e5;
const DEPTH: f64 = 1e-3;
const PRESS: f64 = STIFFNESS * DEPTH;
const MU_K: f64 = 0.4;
const MU_S: f64 = 0.5;
const TANGENTIAL: f64 = 5e4;
/// Displacement at which the bristle slips, m.
const P_K: f64 = MU_K * PRESS / TANGENTIAL;

fn duo(damping: f64) -> Result<Duo, Failure> {
    let excess = MU_S / MU_K - 1.0;
    with_friction(
        Duo::new("point_rough", "ground_rough")?.mover(|s| s.stiffness = STIFFNESS)?,
        &Bristle { mu: MU_K, excess, stiffness: TANGENTIAL, damping },
    )
}

/// A point led over the ground.
struct Drawn {
    world: World,
    point: InterfaceId,
}

impl Drawn {
    fn new() -> Result<Self, Failure> {
        let (mut world, [point, ground]) = duo(0.0)?.world()?;
        world.set_state(ground, &State::identity())?;
        let mut drawn = Self { world, point };
        drawn.place(Vec3::zeros(), Vec3::zeros())?;
        drawn.world.commit()?;
        Ok(drawn)
    }

    fn place(&mut self, place: Vec3, velocity: Vec3) -> Result<Contact, Failure> {
        let position = [place.x, place.y, -DEPTH];
        let state = State { position, linear_velocity: velocity.into(), ..State::identity() };
        self.world.set_state(self.point, &state)?;
        self.world.evaluate()?;
        self.world.contacts().first().copied().ok_or_else(|| "the point does not touch".into())
    }
}

fn heading(degrees: usize) -> Vec3 {
    let (sine, cosine) = libm::sincos(radians(degrees as f64));
    Vec3::new(cosine, sine, 0.0)
}

fn rows() -> Outcome {
    let (mut least, mut most, mut off) = (f64::INFINITY, 0.0_f64, 0.0_f64);
    for degrees in 0..360 {
        let along = heading(degrees);
        let mut drawn = Drawn::new()?;
        let mut error = None;
        let reach = bisect(0.0, 2e-3, |way| match drawn.place(along * way, along * 1e-3) {
            Ok(contact) => contact.sticks,
            Err(failure) => {
                error = Some(failure);
                false
            }
        });
        if let Some(error) = error {
            return Err(error);
        }
        // Just before break-away.
        let force = drawn.place(along * (reach * (1.0 - 1e-14)), along * 1e-3)?.friction_force;
        (least, most) = (least.min(force.norm()), most.max(force.norm()));
        off = off.max((force.normalize() + along).norm());
    }
    let mut rows = vec![
        Row::relative("break-away force, least of 360", "N", MU_S * PRESS, least, 1e-9),
        Row::relative("break-away force, most of 360", "N", MU_S * PRESS, most, 1e-9),
        Row::below("break-away force, direction off the pull", "rad", off, 1e-9),
    ];
    rows.extend(after_turns()?);
    rows.extend(pulled()?);
    Ok(rows)
}

fn after_turns() -> Result<Vec<Row>, Failure> {
    let (mut off, mut length) = (0.0_f64, 0.0_f64);
    for turn in 0..360 {
        let mut drawn = Drawn::new()?;
        let mut place = Vec3::zeros();
        for (degrees, ways) in [(37, 3), (37 + turn, 25)] {
            let along = heading(degrees);
            for _ in 0..ways * 20 {
                place += along * (P_K / 20.0);
                drawn.place(place, along)?;
                drawn.world.commit()?;
            }
        }
        let along = heading(37 + turn);
        let force = drawn.place(place, along)?.friction_force;
        off = off.max((force.normalize() + along).norm());
        length = length.max((force.norm() / (MU_K * PRESS) - 1.0).abs());
    }
    Ok(vec![
        Row::below("slip force after a turn, direction off the motion", "rad", off, 1e-9),
        Row::below("slip force after a turn, length off μ_k·N", "", length, 1e-9),
    ])
}

/// Pulls in 360 directions with a force that grows over half a second and then stays.
fn pulled() -> Result<Vec<Row>, Failure> {
    let [mut held, mut slid] = [0, 0];
    for degrees in 0..360 {
        for (share, count) in [(0.999, &mut held), (1.001, &mut slid)] {
            let body = point_mass(1.0).at(at(Vec3::z() * -DEPTH));
            let mut run = duo(440.0)?.on_ground((Integrator::SemiImplicitEuler, 1e-3), body)?;
            let pull = heading(degrees) * (share * MU_S * PRESS);
            let press = Vec3::z() * -PRESS;
            run.sim.add_load(Load::force_over_time(run.body, move |time| {
                let s = (2.0 * time).min(1.0);
                pull * (s * s * (3.0 - 2.0 * s)) + press
            }))?;
            run.sim.run_for(0.8)?;
            let slips = !run.contact()?.sticks && run.velocity().norm() > 1e-3;
            *count += usize::from(slips == (share > 1.0));
        }
    }
    Ok(vec![
        Row::count("directions that hold 0.999 μ_s·N", 360, held),
        Row::count("directions that slide at 1.001 μ_s·N", 360, slid),
    ])
}
