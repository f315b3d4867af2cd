//! Energy accounts against closed forms: energy that bodies gave to contacts, got back, and lost. A contact
//! that returns more than it received is reported, and no other is.

use crate::common::drop::Drop;
use crate::common::scenes;
use crate::common::stage::Scene;
use crate::common::*;
use pong_engine::*;
use pong_geometry::{Quat, Vec3};
use pong_testkit::samples::is_full;
use std::f64::consts::PI;

const USES: [WrenchCoupling; 5] = [
    WrenchCoupling::Stages,
    WrenchCoupling::SemiImplicit,
    WrenchCoupling::ZeroOrderHold { delay_frames: 0 },
    WrenchCoupling::ZeroOrderHold { delay_frames: 1 },
    WrenchCoupling::ZeroOrderHold { delay_frames: 3 },
];

/// Sixteen phases of first touch of 1 kg at 1 m/s with ω = 100 rad/s.
fn drops(coupling: WrenchCoupling, omega_step: f64, damping: f64) -> impl Iterator<Item = Drop> {
    (0..16).map(move |phase| {
        let step = omega_step / 100.0;
        let start = [step * (f64::from(phase) + 0.5) / 16.0, -1.0];
        Drop { mass: 1.0, stiffness: 1e4, damping, gravity: 0.0, start, step, coupling }
    })
}

/// The work of a held wrench over the displacement is the mass's energy gain, to rounding, for any delay. So
/// is the work by the trapezoidal rule for semi-implicit Euler.
#[test]
fn work_is_what_the_mass_gained() {
    for coupling in USES.into_iter().filter(|coupling| *coupling != WrenchCoupling::Stages) {
        for damping in [0.0, 30.0] {
            for drop in drops(coupling, 0.1, damping) {
                let landed = drop.run(1000);
                assert!(landed.left, "{drop:?}");
                let (gained, work) = (landed.after - landed.before, landed.account.total.net_work());
                assert!((gained - work).abs() < 1e-13, "{drop:?}: {gained} J, {work} J");
            }
        }
    }
}

/// V28: the rebound of an undamped contact with a held wrench is e = exp(πωT/4) on average over the phase of
/// touch. The account agrees, and reports every such contact. For short steps the energy created is
/// ½·k·T·∫v²dt = ½·m·v²·πωT/2, and 1 + 2n times that for a delay of n frames, to first order in ωT.
#[test]
fn an_undamped_contact_that_is_held_gains_energy() {
    for (delay_frames, omega_step, tolerance) in
        [(0, 0.01, 0.01), (0, 0.1, 0.09), (1, 0.01, 0.05), (2, 0.005, 0.05)]
    {
        let (mut made, mut excess) = (0.0, 0.0);
        for drop in drops(WrenchCoupling::ZeroOrderHold { delay_frames }, omega_step, 0.0) {
            let landed = drop.run(2000);
            let account = landed.account;
            assert_eq!(
                (account.episodes, account.episodes_gained, account.episodes_unresolved),
                (1, 1, 0),
                "{drop:?}"
            );
            assert!(account.gains_energy());
            assert_eq!(account.excess, account.worst_excess);
            assert!((account.excess - (landed.after - landed.before)).abs() < 1e-13);
            made += account.total.hold_error / 16.0;
            excess += account.excess / 16.0;
        }
        let expected = 0.5 * PI * omega_step / 2.0 * f64::from(1 + 2 * delay_frames);
        assert!(
            (made / expected - 1.0).abs() < tolerance,
            "late {delay_frames}, ωT {omega_step}: {made} {expected}"
        );
        if delay_frames == 0 {
            let expected = 0.5 * ((0.5 * PI * omega_step).exp() - 1.0);
            assert!((excess / expected - 1.0).abs() < 0.02, "ωT {omega_step}: {excess} {expected}");
        }
    }
}

/// The threshold is c > k·T·(½ + n): twice that loses energy in every phase of touch, half of it gains in
/// every one.
#[test]
fn damping_beyond_the_remedy_loses_and_below_it_gains() {
    for delay_frames in 0..3 {
        let coupling = WrenchCoupling::ZeroOrderHold { delay_frames };
        let omega_step = 0.01;
        let needed = 1e4 * (omega_step / 100.0) * (0.5 + f64::from(delay_frames));
        for (factor, gained) in [(2.0, 0), (0.5, 1)] {
            for drop in drops(coupling, omega_step, factor * needed) {
                let account = drop.run(2000).account;
                assert_eq!(account.episodes_gained, gained, "{drop:?}");
                assert_eq!(account.gains_energy(), gained == 1);
                assert_eq!((account.episodes, account.episodes_unresolved), (1, 0));
                let limit = drop.damping / (1e4 * (0.5 + f64::from(delay_frames)));
                let told = account.remedy();
                assert!(told.contains(&format!("at steps below {limit:.3e} s")), "{told}");
                assert!(told.contains(&format!("k·dt·{}", 0.5 + f64::from(delay_frames))), "{told}");
            }
        }
    }
}

/// One bounce of a host that evaluates at stages: the contact receives ½mv², and 1 − e² of that is lost, with
/// e of the law without pull.
#[test]
fn a_bounce_takes_its_kinetic_energy_and_loses_what_restitution_says() {
    let zeta = 0.2_f64;
    let s = (1.0 - zeta * zeta).sqrt();
    let e = (-(zeta / s) * (2.0 * zeta * s).atan2(2.0 * zeta * zeta - 1.0)).exp();
    let (mut taken, mut lost) = (0.0, 0.0);
    for drop in drops(WrenchCoupling::Stages, 0.002, 2.0 * zeta * 100.0) {
        let account = drop.run(5000).account;
        taken += account.total.work_in / 16.0;
        lost += account.total.damping_loss / 16.0;
        assert_eq!(
            (account.episodes_gained, account.episodes_unresolved, account.total.hold_error),
            (0, 0, 0.0)
        );
        assert_eq!(account.total.friction_loss, 0.0);
    }
    assert!((taken / 0.5 - 1.0).abs() < 2e-3, "{taken}");
    assert!((lost / (0.5 * (1.0 - e * e)) - 1.0).abs() < 2e-3, "{lost}");
}

/// Without damping, the accounts of a host that evaluates at stages are undecided, and never report a certain
/// gain or loss.
#[test]
fn an_elastic_bounce_at_stages_is_left_open() {
    for drop in drops(WrenchCoupling::Stages, 0.05, 0.0) {
        let account = drop.run(1000).account;
        assert_eq!(
            (account.episodes, account.episodes_unresolved, account.episodes_gained),
            (1, 1, 0),
            "{drop:?}"
        );
    }
}

/// A point on a rigid plane; no friction if μ is zero.
fn point_and_ground(mu: f64) -> [String; 2] {
    let friction =
        if mu > 0.0 { format!("friction: Bristle(mu: {mu:?}, stiffness: 1e5)") } else { String::new() };
    let rigid = friction.replace(", stiffness: 1e5", "");
    [
        model("tip", &surface(1e5, &friction), "Point(name: \"p\", position: (0,0,0))"),
        model("ground", &surface(f64::INFINITY, &rigid), "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"),
    ]
}

/// A point pressed with N and dragged by s loses μ·N·s to friction, less the share for stretching its bristle
/// to break-away, and nothing to damping.
#[test]
fn friction_heat_of_a_sliding_point_is_mu_n_s() {
    let [tip, ground] = point_and_ground(0.4);
    for coupling in USES {
        let config = Config { accounts: Some(coupling), ..Config::default() };
        let mut rig = Rig::with_config(config, &tip, &ground);
        let (depth, speed) = (1e-3, 0.5);
        for i in 0..=2000 {
            let x = 1e-4 * f64::from(i);
            let place = Vec3::new(x, 0.0, -depth);
            rig.place([moving(place, Quat::identity(), Vec3::x() * speed, Vec3::zeros()), State::identity()]);
            rig.world.step().unwrap();
        }
        let account = rig.world.account();
        let contact = rig.world.contacts()[0];
        let (normal, bristle) = (contact.normal_force, 0.4 * contact.normal_force / 1e5);
        // It stretches the bristle over its length, and slides from there.
        let heat = 0.4 * normal * (0.2 - bristle);
        assert!((account.friction_loss / heat - 1.0).abs() < 1e-3, "{} {heat}", account.friction_loss);
        assert!(account.damping_loss.abs() < 1e-15 * heat, "{}", account.damping_loss);
        assert!(
            (account.inserted - 0.5 * 1e5 * depth * depth).abs() < 1e-15,
            "begun inside: {}",
            account.inserted
        );
        assert_eq!(account.verdict(), Verdict::Dissipated);
        assert!(account.imbalance().abs() < 1e-12);
        assert_eq!(rig.world.contact_accounts().count(), 1);
    }
}

/// On a closed path friction loses μ·N·s and nothing is gained; without friction nothing is gained or lost.
#[test]
fn closed_paths_return_nothing() {
    for friction in [0.4, 0.0] {
        let [tip, ground] = point_and_ground(friction);
        let config = Config { accounts: Some(WrenchCoupling::Stages), ..Config::default() };
        let mut rig = Rig::with_config(config, &tip, &ground);
        let (radius, depth) = (0.01, 1e-3);
        let (mut laps, steps) = (Vec::new(), 4000);
        for i in 0..=3 * steps {
            let turn = 2.0 * PI * f64::from(i) / f64::from(steps);
            let place = Vec3::new(
                radius * turn.cos(),
                radius * turn.sin(),
                -depth * (1.0 + 0.5 * (2.0 * turn).sin()),
            );
            let along = Vec3::new(-turn.sin(), turn.cos(), 0.0);
            rig.place([moving(place, Quat::identity(), along, Vec3::zeros()), State::identity()]);
            rig.world.step().unwrap();
            if i % steps == 0 {
                laps.push(rig.world.account());
            }
        }
        let lap = laps[3].net_work() - laps[2].net_work();
        // The load is the mean over the circle; the bristle turns with the path.
        let expected = -friction * 1e5 * depth * 2.0 * PI * radius;
        assert!((lap - expected).abs() < 5e-3 * expected.abs() + 1e-12, "{lap} {expected}");
        assert!(lap < 1e-12);
        assert_eq!(laps[3].verdict(), Verdict::Dissipated);
    }
}

/// Energy of bodies that the host places inside each other is inserted, not created; clearing the history
/// removes it again.
#[test]
fn what_begins_inside_was_inserted() {
    for coupling in USES {
        let config = Config { accounts: Some(coupling), ..Config::default() };
        let [tip, ground] = point_and_ground(0.4);
        let mut rig = Rig::with_config(config, &tip, &ground);
        let stand = |rig: &mut Rig, z: f64| {
            rig.place_a(Vec3::z() * z, Quat::identity());
            rig.world.step().unwrap();
        };
        stand(&mut rig, -1e-3);
        let inserted = 0.05;
        let account = rig.world.pair_accounts().next().unwrap();
        assert!((account.total.inserted - inserted).abs() < 1e-15 && account.in_contact, "{account:?}");
        assert_eq!((account.total.stored, account.total.work_in), (account.total.inserted, 0.0));
        let config = Config { accounts: Some(coupling), ..Config::default() };
        let mut other = Rig::with_config(config, &tip, &ground);
        stand(&mut other, -1e-3);
        other.world.clear_contact_history(other.objects[0]).unwrap();
        assert!(other.world.account().inserted.abs() < 1e-15);
        // Moved out slowly, the contact returns what was inserted, to the accuracy of the work rule.
        for i in 0..200 {
            stand(&mut rig, -1e-3 + 1.001e-5 * f64::from(i));
        }
        let account = rig.world.pair_accounts().next().unwrap();
        assert!((account.total.work_out / inserted - 1.0).abs() < 0.1, "{account:?}");
        assert!(account.total.imbalance().abs() < 1e-12);
        assert_eq!(account.episodes, 1);
        // Inserted energy does not count as created, and the episode has ended.
        assert!(account.worst_excess < 0.1 * inserted, "{account:?}");
        assert_eq!(account.episode, EnergyAccount::default());
    }
}

fn with_accounts(mut scene: Scene, coupling: WrenchCoupling) -> Scene {
    scene.accounts = Some(coupling);
    scene
}

/// Every scene of the series, for every use of the wrench (in a quick run for one each): the accounts balance, their sum
/// is the ledger, and all answers are the same as without accounts.
#[test]
fn accounts_close_and_change_no_answer() {
    for (use_number, coupling) in USES.into_iter().enumerate() {
        for (number, (scene, plain)) in scenes::all().into_iter().zip(scenes::all()).enumerate() {
            // A short run has one use for each scene; the bowl, which takes longer than all others, has one in any run.
            let has_one = !is_full() || scene.name == "bowl";
            if has_one && number % USES.len() != use_number {
                continue;
            }
            let (scene, frames) = (with_accounts(scene, coupling), plain.frames.min(30));
            let (mut stage, mut plain) = (scene.set_up(None), plain.set_up(None));
            let mut forgotten = false;
            for frame in 0..frames {
                assert_eq!(
                    stage.step(frame).answers,
                    plain.step(frame).answers,
                    "{}, frame {frame}",
                    scene.name
                );
                let world = &stage.world;
                let (all, ledger) = (world.account(), world.ledger());
                let size = all.work_in + all.work_out + all.inserted.abs() + all.stored + 1e-9;
                assert!(all.imbalance().abs() < 1e-11 * size, "{}: {all:?}", scene.name);
                for account in world.contact_accounts().chain(world.pair_accounts().map(|pair| pair.episode))
                {
                    assert!(account.imbalance().abs() < 1e-11 * size, "{}: {account:?}", scene.name);
                }
                assert_eq!(world.contact_accounts().count(), world.contacts().len());
                // Work along the motion and losses agree with the ledger, which does not include cleared
                // history.
                forgotten |= (scene.forgets)(frame).is_some()
                    || (0..scene.pairs.len()).any(|p| !(scene.is_on)(frame, p));
                assert!(
                    (all.net_work() - all.hold_error - ledger.work).abs() < 1e-11 * size,
                    "{}",
                    scene.name
                );
                if !forgotten {
                    let lost = all.damping_loss + all.friction_loss - all.inserted;
                    assert!(
                        (lost - ledger.dissipated).abs() < 1e-11 * size,
                        "{}: {lost} {ledger:?}",
                        scene.name
                    );
                }
            }
        }
    }
}

/// Accounts are part of the contact state: saved and restored with it, and equal for any number of workers.
#[test]
fn accounts_are_part_of_the_contact_state() {
    let numbers = |world: &World| {
        let pairs: Vec<_> =
            world.pair_accounts().map(|pair| (pair.total, pair.episode, pair.episodes)).collect();
        (pairs, world.contact_accounts().collect::<Vec<_>>())
    };
    let scene = with_accounts(scenes::all().remove(0), WrenchCoupling::ZeroOrderHold { delay_frames: 2 });
    let settings = WorkerSettings { workers: 3, oversubscribe: true, ..WorkerSettings::default() };
    let (mut alone, mut crew, mut resumed) =
        (scene.set_up(None), scene.set_up(Some(settings)), scene.set_up(None));
    for frame in 0..60 {
        let answer = alone.step(frame);
        assert_eq!(answer, crew.step(frame), "frame {frame}");
        assert_eq!(numbers(&alone.world), numbers(&crew.world), "frame {frame}");
        match frame {
            0..30 => {}
            30 => {
                resumed.prepare(frame);
                resumed.world.restore_state(&alone.saved()).unwrap();
            }
            _ => {
                assert_eq!(answer, resumed.step(frame), "frame {frame}");
                assert_eq!(numbers(&alone.world), numbers(&resumed.world), "frame {frame}");
            }
        }
    }
    assert!(alone.world.account().hold_error != 0.0 && alone.world.contact_count() > 0);
}

/// Without accounts there are no values, and the contact state is smaller; a delay beyond the maximum is
/// refused.
#[test]
fn accounts_are_kept_on_request_alone() {
    let [tip, ground] = point_and_ground(0.4);
    let size = |accounts| {
        let rig = Rig::with_config(Config { accounts, ..Config::default() }, &tip, &ground);
        assert_eq!(rig.world.pair_accounts().count(), usize::from(accounts.is_some()));
        assert_eq!(
            (rig.world.scene().wrench_coupling(), rig.world.scene().keeps_ledger()),
            (accounts, accounts.is_some())
        );
        rig.world.state_size()
    };
    assert!(size(None) < size(Some(WrenchCoupling::Stages)));
    let builder = WorldBuilder::new(Config {
        accounts: Some(WrenchCoupling::ZeroOrderHold { delay_frames: 17 }),
        ..Config::default()
    });
    let error = builder.seal().err().unwrap().to_string();
    assert!(error.contains("17 frames late") && error.contains("at most 16"), "{error}");
}
