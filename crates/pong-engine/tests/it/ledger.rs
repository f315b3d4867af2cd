//! The ledger of a world: work, stored energy and losses balance for anything that a host does between
//! frames, and pairs committed one by one have the same ledger as in worlds of their own.

use crate::common::{Rig, at, load, model, moving, surface};
use pong_engine::*;
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;

const FEET: usize = 3;

fn foot() -> String {
    let friction = "normal: Linear(damping: 40), friction: Bristle(mu: 0.4, static_excess: 0.2, stiffness: 7e4, damping: 5)";
    model("foot", &surface(1e5, friction), "Sphere(name: \"s\", center: (0, 0, 0), radius: 0.1)")
}

fn floor() -> String {
    model("floor", "\"s\": (stiffness: inf)", "Plane(name: \"f\", normal: (0, 0, 1), offset: 0)")
}

/// A tilted floor, and feet that come down on it, rub and leave, each at its own pace.
struct Dance {
    q: Quat,
    origin: Vec3,
}

impl Dance {
    fn floor(&self) -> State {
        at(self.origin, self.q)
    }

    fn foot(&self, foot: usize, time: f64) -> State {
        let pace = 3.0 + foot as f64;
        let place = |t: f64| {
            Vec3::new(0.3 * foot as f64 + 2e-3 * (7.0 * t).sin(), 1e-3 * t, 0.1 - 1e-3 * (pace * t).sin())
        };
        let speed = |t: f64| Vec3::new(1.4e-2 * (7.0 * t).cos(), 1e-3, -1e-3 * pace * (pace * t).cos());
        // It comes from above.
        let t = time - 0.2;
        moving(self.origin + self.q * place(t), self.q, self.q * speed(t), Vec3::zeros())
    }
}

/// A floor paired with each of this many feet.
fn world_of(feet: usize) -> (World, Vec<InterfaceId>) {
    let mut builder = WorldBuilder::new(Config { ledger: true, ..Config::default() });
    let models = [floor(), foot()].map(|text| load(&mut builder, &text));
    let floor = builder.create_object(models[0], "floor").unwrap();
    let mut groups = vec![builder.scene().interface(floor, "").unwrap()];
    for index in 0..feet {
        let foot = builder.create_object(models[1], &format!("foot {index}")).unwrap();
        builder.pair(floor, foot).unwrap();
        groups.push(builder.scene().interface(foot, "").unwrap());
    }
    (builder.seal().unwrap().0, groups)
}

fn pairs_of(world: &World) -> Vec<PairId> {
    world.scene().pairs().map(|(pair, _)| pair).collect()
}

fn unbalanced(ledger: &Ledger) -> f64 {
    (ledger.stored + ledger.work + ledger.dissipated).abs()
}

/// Work on the bodies, stored energy and losses sum to zero, with cleared history, switched pairs and
/// preloads. Cleared energy counts as dissipated, and a preload does no work.
#[test]
fn it_balances_whatever_a_host_does() {
    let mut random = Random(11);
    let dance = Dance { q: random.rotation(), origin: random.vector(3.0) };
    let (mut world, groups) = world_of(FEET);
    let pairs = pairs_of(&world);
    world.set_state(groups[0], &dance.floor()).unwrap();
    let (mut largest, mut forgotten, mut preloaded) = (0.0_f64, 0, 0);
    for frame in 0..600 {
        for foot in 0..FEET {
            world.set_state(groups[foot + 1], &dance.foot(foot, 2e-3 * f64::from(frame))).unwrap();
        }
        let pair = pairs[random.below(FEET)];
        match random.below(8) {
            0 => world.commit_pairs(&[pair]).unwrap(),
            1 => {
                let before = world.ledger();
                let (_, [_, object]) = world.scene().pairs().nth(random.below(FEET)).unwrap();
                world.clear_contact_history(object).unwrap();
                let (dropped, lost) =
                    (before.stored - world.ledger().stored, world.ledger().dissipated - before.dissipated);
                assert!((dropped - lost).abs() <= 1e-12 * before.stored, "{dropped} {lost}");
                forgotten += usize::from(dropped > 0.0);
            }
            2 => {
                world.step().unwrap();
                let before = world.ledger();
                let load =
                    FrictionPreload::Holding(dance.q * Vec3::new(random.between(-20.0, 20.0), 5.0, 0.0));
                preloaded += world.preload_friction(pair, &load).unwrap();
                assert_eq!(world.ledger().work, before.work);
            }
            3 => {
                let enabled = world.pair_enabled(pair).unwrap();
                world.set_pair_enabled(pair, !enabled).unwrap();
            }
            _ => {
                world.step().unwrap();
            }
        }
        let ledger = world.ledger();
        largest = largest.max(ledger.work.abs()).max(ledger.stored);
        assert!(unbalanced(&ledger) <= 1e-12 * largest, "frame {frame}: {ledger:?}");
    }
    assert!(forgotten > 10 && preloaded > 10 && largest > 0.01, "{forgotten} {preloaded} {largest}");
}

/// A world whose pairs are committed at different rates has the ledger of separate worlds with one pair each.
#[test]
fn pairs_book_alone_what_they_book_together() {
    let mut random = Random(5);
    let dance = Dance { q: random.rotation(), origin: random.vector(3.0) };
    let (mut together, groups) = world_of(FEET);
    let pairs = pairs_of(&together);
    let mut alone: Vec<_> = (0..FEET).map(|_| world_of(1)).collect();
    together.set_state(groups[0], &dance.floor()).unwrap();
    alone.iter_mut().for_each(|(world, groups)| world.set_state(groups[0], &dance.floor()).unwrap());
    for frame in 0..600 {
        let mut accepted = Vec::new();
        for (foot, (world, groups_alone)) in alone.iter_mut().enumerate() {
            let state = dance.foot(foot, 2e-3 * f64::from(frame));
            together.set_state(groups[foot + 1], &state).unwrap();
            if (frame as usize).is_multiple_of(foot + 1) {
                accepted.push(pairs[foot]);
                world.set_state(groups_alone[1], &state).unwrap();
                world.step().unwrap();
            }
        }
        // Two pairs committed together may be committed by one call or by two.
        let (first, rest) = accepted.split_at(1);
        together.commit_pairs(first).unwrap();
        together.commit_pairs(rest).unwrap();
        let sum = |of: fn(&Ledger) -> f64| alone.iter().map(|(world, _)| of(&world.ledger())).sum::<f64>();
        let ledger = together.ledger();
        let scale = sum(|ledger| ledger.work.abs()).max(1e-6);
        for (one, sum) in [
            (ledger.stored, sum(|ledger| ledger.stored)),
            (ledger.work, sum(|ledger| ledger.work)),
            (ledger.dissipated, sum(|ledger| ledger.dissipated)),
        ] {
            assert!((one - sum).abs() < 1e-11 * scale, "frame {frame}: {one} {sum}");
        }
    }
    assert!(together.ledger().work < -1e-3, "{:?}", together.ledger());
}

/// Accounts book a preload as inserted by the host: they still balance, an elastic ball at rest loses
/// nothing, and one that is unloaded and lifted off has gained nothing.
#[test]
fn accounts_know_a_preload() {
    let elastic = "friction: Bristle(mu: 0.5, stiffness: 1e5)";
    let ball = model("ball", &surface(1e5, elastic), "Sphere(name: \"s\", center: (0, 0, 0), radius: 0.1)");
    let mut random = Random(8);
    for coupling in [WrenchCoupling::SemiImplicit, WrenchCoupling::ZeroOrderHold { delay_frames: 0 }] {
        let config = Config { ledger: true, accounts: Some(coupling), ..Config::default() };
        let mut rig = Rig::with_config(config, &ball, &floor());
        let q = random.rotation();
        let go = |rig: &mut Rig, along: f64, height: f64| {
            rig.place([at(q * Vec3::new(along, 0.0, 0.1 + height), q), at(Vec3::zeros(), q)]);
            rig.world.step().unwrap();
            let account = rig.world.account();
            let in_and_out = account.work_in + account.inserted + account.hold_error - account.work_out;
            let rest = account.stored + account.damping_loss + account.friction_loss;
            assert!((in_and_out - rest).abs() < 1e-12, "{account:?}");
            account
        };
        // Between two touches, the trapezoidal rule is exact for a force linear in the displacement.
        for i in 0..=11 {
            go(&mut rig, 0.0, 1e-4 * f64::from(1 - i));
        }
        let before = rig.world.account();
        assert_eq!(
            rig.world
                .preload_friction(rig.pair, &FrictionPreload::Holding(q * Vec3::new(30.0, 0.0, 0.0)))
                .unwrap(),
            1
        );
        let inserted = rig.world.account().inserted - before.inserted;
        assert!((inserted / (0.5 * 30.0 * 30.0 / 1e5) - 1.0).abs() < 1e-9, "{inserted}");
        let rests = go(&mut rig, 0.0, -1e-3);
        assert!((rests.damping_loss - before.damping_loss).abs() < 1e-12, "{rests:?}");
        assert!((rests.friction_loss - before.friction_loss).abs() < 1e-12, "{rests:?}");
        // Friction holds +x on the ball; the ball follows, and the bristle is empty.
        for i in 1..=10 {
            go(&mut rig, 3e-5 * f64::from(i), -1e-3);
        }
        for i in -10..=1 {
            go(&mut rig, 3e-4, 1e-4 * f64::from(i));
        }
        let [pair] = rig.world.pair_accounts().collect::<Vec<_>>()[..] else { panic!("one pair") };
        assert_eq!(pair.episodes, 1);
        if coupling == WrenchCoupling::SemiImplicit {
            assert_eq!((pair.episodes_gained, pair.gains_energy()), (0, false), "{pair:?}");
        }
    }
}
