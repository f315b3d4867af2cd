//! The calls of a frame.

use super::session::{Session, Sure};
use crate::count;
use pong::contacts::{
    pong_contact, pong_contact_count, pong_find_standing_groups, pong_get_contact_stiffness,
    pong_get_contacts,
};
use pong::distance::{PONG_NO_PRIMITIVE, pong_distance, pong_get_distance};
use pong::frames::{pong_commit, pong_commit_pairs, pong_evaluate, pong_step};
use pong::ids::{pong_interface_id, pong_pair_id};
use pong::pair_monitor::{
    pong_begin_peak_window, pong_contact_change, pong_get_contact_changes, pong_get_pair_peaks,
    pong_observe_pairs, pong_pair_peaks, pong_start_pair_monitor,
};
use pong::report::{pong_get_ledger, pong_get_report, pong_ledger, pong_report};
use pong::states::{pong_default_state, pong_get_state, pong_set_state, pong_set_states, pong_state};
use pong::surface_motions::{pong_get_surface_motion, pong_set_surface_motions, pong_surface_motion};
use pong::world::pong_world;
use pong::wrenches::{
    pong_get_pair_wrench, pong_get_wrench, pong_get_wrench_from, pong_get_wrenches, pong_wrench,
};

/// Largest number in a valid state.
const LARGEST: f64 = 1e100;

impl Session<'_> {
    pub fn call_of_a_frame(&mut self) {
        match self.input.below(18) {
            0..=3 => self.move_one(),
            4 => self.set_many(),
            5 => self.set_any(),
            6..=8 => self.frame("step", |world| unsafe { pong_step(world) }),
            9 => self.frame("evaluate", |world| unsafe { pong_evaluate(world) }),
            10 => self.frame("commit", |world| unsafe { pong_commit(world) }),
            11 => self.commit_pairs(),
            12 => match self.input.below(4) {
                0 => self.wrench(),
                1 => self.wrench_from(),
                2 => self.distance(),
                _ => self.pair_wrench(),
            },
            13 => self.contacts(),
            14 if self.input.chance(128) => self.monitor(),
            14 => self.report(),
            15 => self.accounts(),
            16 if self.input.chance(128) => self.set_surface_motion(),
            16 => self.standing_groups(),
            _ => self.get_state(),
        }
    }

    fn move_one(&mut self) {
        let count = self.host().map_or(0, |host| host.ids.interfaces.len());
        if count > 0 {
            let index = self.input.byte() as usize % count;
            self.set_near(index);
        }
    }

    /// Sets a valid state near the origin, where others are.
    pub fn set_near(&mut self, index: usize) {
        let state = self.near();
        let Some(host) = self.host() else { return };
        let (world, id) = (host.world, host.ids.interfaces[index]);
        // SAFETY: here and below: living worlds, places and texts, as the safety contract of all entries says.
        if self.call("set state", Sure::Right, || unsafe { pong_set_state(world, id, &state) }) {
            self.host().expect("it has a world").set[index] = true;
        }
    }

    pub fn near(&mut self) -> pong_state {
        let mut state = pong_default_state();
        state.position = [(); 3].map(|()| self.input.small(0.3));
        let turn = self.input.byte();
        if turn < 128 {
            let half = f64::from(turn) / 64.0;
            let norm = (1.0 + 2.0 * half * half).sqrt();
            state.orientation = [1.0 / norm, half / norm, 0.0, half / norm];
        }
        let fast = self.input.small(0.25);
        state.linear_velocity = [fast, -fast, fast * 0.5];
        state.angular_velocity = [0.0, fast, 0.0];
        state
    }

    /// Any numbers. Returns whether they form a valid state.
    fn any_state(&mut self) -> (pong_state, Sure) {
        let mut state = self.near();
        for _ in 0..=self.input.below(3) {
            let number = self.input.number();
            match self.input.below(13) {
                at @ 0..=2 => state.position[at] = number,
                at @ 3..=5 => state.linear_velocity[at - 3] = number,
                at @ 6..=8 => state.angular_velocity[at - 6] = number,
                at => state.orientation[at - 9] = number,
            }
        }
        let numbers = [state.position, state.linear_velocity, state.angular_velocity];
        let good = |x: &f64| x.is_finite() && x.abs() <= LARGEST;
        let norm = state.orientation.iter().map(|x| x * x).sum::<f64>().sqrt();
        let sure = match (numbers.iter().flatten().all(good), (norm - 1.0).abs()) {
            (true, 0.0..0.9e-3) => Sure::Right,
            (false, _) | (_, 1.1e-3..) => Sure::Wrong,
            (_, off) if off.is_nan() => Sure::Wrong,
            _ => Sure::Unknown,
        };
        (state, sure)
    }

    fn set_any(&mut self) {
        let (world, known) = self.world();
        let (id, good) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let (state, fit) = self.any_state();
        let nothing = self.input.chance(4);
        let pointer = if nothing { std::ptr::null() } else { std::ptr::from_ref(&state) };
        let sure = known.and(good).and(fit).only_if(!nothing);
        if self.call("set state", sure, || unsafe { pong_set_state(world, id, pointer) }) {
            self.was_set(id);
        }
    }

    fn was_set(&mut self, id: pong_interface_id) {
        let Some(host) = self.host() else { return };
        if let Some(index) = host.ids.interfaces.iter().position(|known| *known == id) {
            host.set[index] = true;
        }
    }

    fn set_many(&mut self) {
        let (world, known) = self.world();
        let mut sure = known;
        let (mut ids, mut states) = (Vec::new(), Vec::new());
        for _ in 0..self.input.below(5) {
            let (id, good) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
            let (state, fit) =
                if self.input.chance(64) { self.any_state() } else { (self.near(), Sure::Right) };
            sure = sure.and(good).and(fit);
            ids.push(id);
            states.push(state);
        }
        // An impossible length, or a NULL array.
        let (count, at) = match self.input.byte() {
            255 => (usize::MAX, ids.as_ptr()),
            254 if !ids.is_empty() => (ids.len(), std::ptr::null()),
            253 => (isize::MAX as usize / 8, ids.as_ptr()),
            252 if !ids.is_empty() => (1, ids.as_ptr().cast::<u8>().wrapping_add(1).cast()),
            _ => (ids.len(), ids.as_ptr()),
        };
        let named_once = (1..ids.len()).all(|place| !ids[..place].contains(&ids[place]));
        let sure = sure.only_if(count == ids.len() && at == ids.as_ptr() && named_once);
        if self.call("set states", sure, || unsafe { pong_set_states(world, at, states.as_ptr(), count) }) {
            ids.into_iter().for_each(|id| self.was_set(id));
        }
    }

    fn set_surface_motion(&mut self) {
        let (world, known) = self.world();
        let (id, good) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let mut motion = pong_surface_motion::default();
        for part in [&mut motion.linear_velocity, &mut motion.belt_velocity, &mut motion.angular_travel] {
            part[self.input.below(3)] = if self.input.chance(16) { self.input.number() } else { 0.1 };
        }
        let sure = known.and(good).and(Sure::Unknown);
        self.call("set surface motions", sure, || unsafe {
            pong_set_surface_motions(world, &id, &motion, 1)
        });
        let place = self.place::<pong_surface_motion>();
        let sure = known.and(good).and(place.sure);
        self.call("get surface motion", sure, || unsafe {
            pong_get_surface_motion(world, id, place.pointer)
        });
    }

    fn get_state(&mut self) {
        let (world, known) = self.world();
        let (id, good) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let place = self.place::<pong_state>();
        let set = self.host().is_some_and(|host| {
            host.ids.interfaces.iter().zip(&host.set).any(|(known, set)| *known == id && *set)
        });
        let sure = known.and(good).and(place.sure).only_if(set || good == Sure::Unknown);
        if self.call("get state", sure, || unsafe { pong_get_state(world, id, place.pointer) }) {
            finite(place.get().position.iter().chain(&place.get().orientation), "state");
        }
    }

    fn frame(
        &mut self,
        name: &str,
        call: impl Fn(*mut pong::world::pong_world) -> pong::status::pong_status,
    ) {
        let (world, known) = self.world();
        let ready = self.host().is_some_and(|host| host.is_ready());
        let sealed = self.host().is_some_and(|host| host.sealed);
        let sure = known.unless(!ready).only_if(sealed);
        if self.call(name, sure, || call(world)) {
            count::frame();
            self.look_at_frame();
        }
    }

    fn commit_pairs(&mut self) {
        let (world, known) = self.world();
        let sealed = self.host().is_some_and(|host| host.sealed);
        let ready = self.host().is_some_and(|host| host.is_ready());
        let mut sure = known.unless(!ready).only_if(sealed);
        let mut pairs = Vec::new();
        for _ in 0..self.input.below(4) {
            let (id, good) = self.id(|ids| &ids.pairs, |bits| pong_pair_id { bits });
            sure = sure.and(good);
            pairs.push(id);
        }
        let count = if self.input.chance(4) { usize::MAX / 8 } else { pairs.len() };
        let sure = sure.only_if(count == pairs.len());
        if self.call("commit pairs", sure, || unsafe { pong_commit_pairs(world, pairs.as_ptr(), count) }) {
            self.look_at_frame();
        }
    }

    /// Checks that all wrenches of a successful frame are finite.
    fn look_at_frame(&mut self) {
        let Some(host) = self.host() else { return };
        host.has_frame = true;
        let (world, ids) = (host.world, host.ids.interfaces.clone());
        let nothing = pong_wrench { force: [0.0; 3], moment: [0.0; 3] };
        let mut wrenches = vec![nothing; ids.len()];
        let frame = i32::from(ids.len() % 2 == 1);
        let done = self.call("get wrenches", Sure::Right, || unsafe {
            pong_get_wrenches(world, ids.as_ptr(), frame, wrenches.as_mut_ptr(), ids.len())
        });
        if done {
            let numbers = || wrenches.iter().flat_map(|wrench| wrench.force.iter().chain(&wrench.moment));
            finite(numbers(), "wrench");
            self.note(numbers().map(|x| x.to_bits()));
        }
    }

    fn wrench(&mut self) {
        let (world, known) = self.world();
        let (id, good) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let place = self.place::<pong_wrench>();
        let frame = self.input.one_of(&[0, 1, 0, 1, 2, -1, i32::MAX]);
        let own_laws = self.host().is_some_and(|host| host.own_laws);
        let has_frame = self.host().is_some_and(|host| host.has_frame);
        let sure = known.and(good).and(place.sure).unless(own_laws || !has_frame);
        let sure = sure.only_if(frame == 0 || frame == 1);
        if self.call("get wrench", sure, || unsafe { pong_get_wrench(world, id, frame, place.pointer) }) {
            finite(place.get().force.iter().chain(&place.get().moment), "wrench");
        }
    }

    fn standing_groups(&mut self) {
        let (world, known) = self.world();
        let step = self.input.number();
        let mut groups = [pong_interface_id { bits: 0 }; 4];
        let capacity = self.input.below(5);
        let place = self.place::<usize>();
        let sure = known.and(place.sure).and(Sure::Unknown);
        if self.call("standing groups", sure, || unsafe {
            pong_find_standing_groups(world, step, groups.as_mut_ptr(), capacity, place.pointer)
        }) {
            let found = place.get();
            assert!(found <= capacity, "{found} standing groups where {capacity} fit");
            let known = self.host().expect("it has a world").ids.interfaces.clone();
            assert!(groups[..found].iter().all(|group| known.contains(group)), "an unknown group stands");
        }
    }

    fn monitor(&mut self) {
        let (world, known) = self.world();
        let sealed = self.host().is_some_and(|host| host.sealed);
        let sure = known.only_if(sealed);
        match self.input.below(5) {
            0 => drop(self.call("start monitor", sure, || unsafe { pong_start_pair_monitor(world) })),
            1 => {
                let step = self.input.number();
                let sure = sure.and(Sure::Unknown).only_if(step > 0.0 && step <= LARGEST);
                self.call("observe", sure, || unsafe { pong_observe_pairs(world, step) });
            }
            2 => {
                let sure = sure.and(Sure::Unknown);
                self.call("begin window", sure, || unsafe { pong_begin_peak_window(world) });
            }
            3 => self.changes(world, sure),
            _ => self.peaks(world, sure),
        }
    }

    fn changes(&mut self, world: *mut pong_world, sure: Sure) {
        let capacity = self.input.below(4);
        let mut changes = Vec::<pong_contact_change>::with_capacity(capacity);
        let place = self.place::<usize>();
        let sure = sure.and(place.sure).and(Sure::Unknown);
        let done = self.call("changes", sure, || unsafe {
            pong_get_contact_changes(world, changes.as_mut_ptr(), capacity, place.pointer)
        });
        if done {
            assert!(place.get() <= capacity, "{} changes where {capacity} fit", place.get());
            // SAFETY: the call succeeded, so so many were written.
            unsafe { changes.set_len(place.get()) };
            assert!(changes.iter().all(|change| change.pair.bits != 0 && (0..2).contains(&change.begins)));
        }
    }

    fn peaks(&mut self, world: *mut pong_world, sure: Sure) {
        let capacity = self.input.below(4);
        let mut peaks = Vec::<pong_pair_peaks>::with_capacity(capacity);
        let place = self.place::<usize>();
        let sure = sure.and(place.sure).and(Sure::Unknown);
        let done = self.call("peaks", sure, || unsafe {
            pong_get_pair_peaks(world, peaks.as_mut_ptr(), capacity, place.pointer)
        });
        if done {
            assert!(place.get() <= capacity, "{} peaks where {capacity} fit", place.get());
            // SAFETY: the call succeeded, so so many were written.
            unsafe { peaks.set_len(place.get()) };
            assert!(peaks.iter().all(|peaks| peaks.peak_normal_force >= 0.0 && peaks.window > 0.0));
        }
    }

    fn wrench_from(&mut self) {
        let (world, known) = self.world();
        let (on, good) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let (from, also) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let place = self.place::<pong_wrench>();
        let frame = self.input.one_of(&[0, 1, 0, 1, 2, -1, i32::MAX]);
        // Groups of Objects that are not paired are refused.
        let sure = known.and(good).and(also).and(place.sure).and(Sure::Unknown);
        let sure = sure.only_if((frame == 0 || frame == 1) && on != from);
        let done = self.call("get wrench from", sure, || unsafe {
            pong_get_wrench_from(world, on, from, frame, place.pointer)
        });
        if done {
            finite(place.get().force.iter().chain(&place.get().moment), "wrench from");
        }
    }

    fn pair_wrench(&mut self) {
        let (world, known) = self.world();
        let (pair, good) = self.id(|ids| &ids.pairs, |bits| pong_pair_id { bits });
        let (about, also) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let place = self.place::<pong_wrench>();
        let frame = self.input.one_of(&[0, 1, 0, 1, 2, -1, i32::MAX]);
        // So is a point of reference on a third Object, and an Object that is paired with itself.
        let sure = known.and(good).and(also).and(place.sure).and(Sure::Unknown);
        let sure = sure.only_if(frame == 0 || frame == 1);
        let done = self.call("get pair wrench", sure, || unsafe {
            pong_get_pair_wrench(world, pair, about, frame, place.pointer)
        });
        if done {
            finite(place.get().force.iter().chain(&place.get().moment), "pair wrench");
        }
    }

    fn distance(&mut self) {
        let (world, known) = self.world();
        let (a, good) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let (b, also) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let place = self.place::<pong_distance>();
        // Groups without a state, and those with bores, are refused too.
        let sure = known.and(good).and(also).and(place.sure).and(Sure::Unknown).only_if(a != b);
        let done =
            self.call("get distance", sure, || unsafe { pong_get_distance(world, a, b, place.pointer) });
        if done {
            let found = place.get();
            assert!(found.distance >= 0.0, "{found:?}");
            let is_near = found.distance < f64::INFINITY;
            assert!(found.primitives.iter().all(|one| (*one != PONG_NO_PRIMITIVE) == is_near), "{found:?}");
            finite(found.points.iter().flatten(), "nearest points");
        }
    }

    fn contacts(&mut self) {
        let (world, known) = self.world();
        let own_laws = self.host().is_some_and(|host| host.own_laws);
        let mut there = 0;
        let counted = self.call("contact count", known.unless(own_laws), || unsafe {
            pong_contact_count(world, &mut there)
        });
        let capacity = match self.input.below(4) {
            0 => there / 2,
            1 => 0,
            _ => there,
        };
        let mut contacts = Vec::<pong_contact>::with_capacity(capacity);
        let place = self.place::<usize>();
        let sure = known.and(place.sure).unless(own_laws || !counted).only_if(capacity >= there);
        let done = self.call("get contacts", sure, || unsafe {
            pong_get_contacts(world, contacts.as_mut_ptr(), capacity, place.pointer)
        });
        if !done {
            return;
        }
        assert!(place.get() <= capacity, "{} contacts where {capacity} fit", place.get());
        // SAFETY: the call succeeded, so this many were written.
        unsafe { contacts.set_len(place.get()) };
        for contact in &contacts {
            let vectors =
                [contact.point, contact.normal, contact.friction_force, contact.force, contact.slip_velocity];
            let numbers =
                [contact.depth, contact.depth_rate, contact.weight, contact.normal_force, contact.stored];
            finite(vectors.iter().flatten().chain(&numbers), "contact");
            assert!((0.0..=1.0).contains(&contact.weight) && contact.normal_force >= 0.0, "{contact:?}");
            assert!(contact.feature_kind <= 2 && contact.end <= 1, "{contact:?}");
        }
        let mut slopes = [vec![0.0; contacts.len()], vec![0.0; contacts.len()]];
        let [stiffness, damping] = &mut slopes;
        let mut listed = 0;
        let sure = known.unless(own_laws);
        if self.call("contact stiffness", sure, || unsafe {
            let (stiffness, damping) = (stiffness.as_mut_ptr(), damping.as_mut_ptr());
            pong_get_contact_stiffness(world, stiffness, damping, contacts.len(), &mut listed)
        }) {
            assert_eq!(listed, contacts.len());
            if !own_laws {
                finite(slopes.iter().flatten(), "contact stiffness");
            }
        }
        self.tangents(world, known, &contacts);
    }

    fn report(&mut self) {
        let (world, known) = self.world();
        let place = self.place::<pong_report>();
        if self.call("report", known.and(place.sure), || unsafe { pong_get_report(world, place.pointer) }) {
            let report = place.get();
            assert!(report.contacts <= report.contacts_wanted && report.flags <= 7, "{report:?}");
        }
        let place = self.place::<pong_ledger>();
        if self.call("ledger", known.and(place.sure), || unsafe { pong_get_ledger(world, place.pointer) }) {
            let ledger = place.get();
            finite([ledger.stored, ledger.work, ledger.dissipated].iter(), "ledger");
        }
    }
}

/// Checks that the library returns only finite numbers.
pub fn finite<'a>(mut numbers: impl Iterator<Item = &'a f64> + Clone, what: &str) {
    let all: Vec<f64> = numbers.clone().copied().collect();
    assert!(numbers.all(|x| x.is_finite()), "{what} of {all:?}");
}
