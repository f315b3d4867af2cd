//! Worlds, laws, models, Objects, pairs, seal.

use super::host::Host;
use super::laws;
use super::session::{Session, Sure, WORLDS, read_text};
use crate::input::Input;
use pong::abi::PONG_ABI_VERSION;
use pong::config::{pong_config, pong_default_config};
use pong::ids::{pong_model_id, pong_object_id, pong_pair_id};
use pong::interfaces::pong_list_interfaces;
use pong::laws::{pong_register_friction_law, pong_register_normal_law};
use pong::models::{pong_allow_files_below, pong_load_joined_models, pong_load_model, pong_load_model_text};
use pong::objects::pong_create_object;
use pong::pairs::{pong_filter_groups, pong_pair_by_name, pong_pair_objects};
use pong::seal::{pong_seal, pong_seal_note, pong_seal_report, pong_seal_warning};
use pong::version::{pong_check_abi, pong_layout_hash};
use pong::world::{pong_create_world, pong_destroy_world};
use std::ffi::{CString, c_char};

/// Models; the last one is faulty, and the one with laws of the host is [`OWN_LAWS`].
const MODELS: [&str; 5] = [
    include_str!("../../seeds/c_models/ball.ron"),
    include_str!("../../seeds/c_models/solid.ron"),
    include_str!("../../seeds/c_models/own_laws.ron"),
    include_str!("../../seeds/c_models/hunt.ron"),
    include_str!("../../seeds/c_models/faulty.ron"),
];
const OWN_LAWS: usize = 2;
const FAULTY: usize = 4;
/// Names of Objects.
pub const OBJECTS: [&str; 5] = ["a", "b", "c", "a/b", ""];
/// Groups of the models by path and by name, and an unknown one.
const GROUPS: [&str; 6] = ["", "ball/latch", "latch", "shell", "ball/shell", "nope"];
/// Names of laws; the first two are those of the model.
const LAWS: [&str; 4] = ["force", "friction", "other", ""];
/// Most models, Objects and pairs of one world: more would only be slow.
const MOST: usize = 6;
/// Most worlds, seals, logs and threads of one input.
pub const COSTS_MAX: u32 = 8;

impl Session<'_> {
    /// Creates a world ready for frames, or nothing: random sequences seldom get that far.
    pub fn prologue(&mut self, kind: u8) {
        if kind > 0 {
            // Without bytes every argument is valid.
            let bytes = std::mem::replace(&mut self.input, Input::new(&[]));
            self.good_scene(kind);
            self.input = bytes;
        }
    }

    fn good_scene(&mut self, kind: u8) {
        let mut config = pong_default_config();
        // Small blocks of contact state, and some scenes with too many contacts.
        config.contact_capacity = [16, 4, 32, 64][usize::from(kind) % 4];
        config.keep_ledger = u32::from(kind.is_multiple_of(2));
        config.energy_accounts = u32::from(kind) % 4;
        config.delay_frames = u32::from(kind == 7);
        self.create(&config, Sure::Right);
        let (models, pairs): (&[usize], &[(usize, usize)]) = match kind {
            1 => (&[0, 1], &[(0, 1)]),
            2 => (&[0, 0, 1], &[(0, 1), (1, 2), (2, 2)]),
            3 | 4 => (&[OWN_LAWS, OWN_LAWS], &[(0, 1)]),
            5 => (&[3, 3], &[(0, 1), (0, 0)]),
            6 => (&[1, 1], &[(0, 1), (0, 0)]),
            _ => (&[0], &[(0, 0)]),
        };
        let user = self.host().expect("just made").behaviour.user();
        let world = self.host().expect("just made").world;
        // SAFETY: here and below: living worlds, places and texts, as the safety contract of all entries says.
        self.call("register", Sure::Right, || unsafe {
            pong_register_normal_law(world, c"force".as_ptr(), Some(laws::normal), None, user)
        });
        self.call("register", Sure::Right, || unsafe {
            pong_register_friction_law(world, c"friction".as_ptr(), 2, Some(laws::friction), user)
        });
        for (index, model) in models.iter().enumerate() {
            self.load_text(MODELS[*model], Sure::Right);
            self.host().expect("just made").own_laws |= *model == OWN_LAWS;
            let id = *self.host().and_then(|host| host.ids.models.last()).expect("just loaded");
            let name = CString::new(format!("object {index}")).expect("no zero");
            self.create_object(id, name.as_ptr(), Sure::Right);
        }
        for (a, b) in pairs {
            let [a, b] = [a, b].map(|index| self.host().expect("just made").ids.objects[*index]);
            let mut pair = pong_pair_id { bits: 0 };
            self.call("pair", Sure::Right, || unsafe { pong_pair_objects(world, a, b, &mut pair) });
            self.host().expect("just made").ids.pairs.push(pair);
        }
        self.good_plan(kind);
        self.seal(Sure::Right);
        for index in 0..self.host().expect("just made").ids.interfaces.len() {
            self.set_near(index);
        }
    }

    pub fn set_up(&mut self) {
        match self.input.below(10) {
            0 => self.create_any(),
            1 => self.register(),
            2 | 3 => self.load(),
            4 | 5 => self.create_any_object(),
            6 => self.pair(),
            7 => self.seal_any(),
            8 => self.filter(),
            _ => self.seal_warning(),
        }
    }

    pub fn switch_world(&mut self) {
        let wanted = self.input.below(WORLDS);
        let empty = self.input.chance(32);
        if empty || self.hosts()[wanted].is_some() {
            self.current = wanted;
        }
    }

    pub fn end_world(&mut self) {
        if !self.input.chance(64) {
            // SAFETY: NULL is allowed.
            self.call("destroy", Sure::Right, || unsafe { pong_destroy_world(std::ptr::null_mut()) });
        } else {
            self.destroy();
            // The host continues with another world, if it has one.
            let other = self.hosts().iter().position(Option::is_some);
            self.current = other.unwrap_or(self.current);
        }
    }

    pub fn destroy(&mut self) {
        let current = self.current;
        let Some(host) = self.hosts()[current].take() else { return };
        // SAFETY: the world lives, and no other reference to it is left.
        self.call("destroy", Sure::Right, || unsafe { pong_destroy_world(host.world) });
        self.stale = host.ids.clone();
    }

    fn create_any(&mut self) {
        let mut config = pong_default_config();
        let mut sure = Sure::Right;
        if self.input.chance(128) {
            config.contact_capacity = self.input.one_of(&[1, 2, 16, 300, 5000, (1 << 24) + 1, u64::MAX]);
            sure = sure.only_if(config.contact_capacity < 1 << 24);
        }
        if self.input.chance(32) {
            config.workers = self.input.one_of(&[1, 2, 3, 64, 65, u32::MAX]);
            config.oversubscribe = u32::from(config.workers < 3);
            sure = sure.only_if(config.workers <= 64);
        }
        if self.input.chance(32) {
            config.spin_us = self.input.one_of(&[0, 1, 1_000_000, 1_000_001, u32::MAX]);
            sure = sure.only_if(config.spin_us <= 1_000_000);
        }
        if self.input.chance(32) {
            config.worker_timeout_us = self.input.one_of(&[0, 1, 1_000_000, 1_000_001, u32::MAX]);
            sure = sure.only_if((1..=1_000_000).contains(&config.worker_timeout_us));
        }
        if self.input.chance(32) {
            config.keep_ledger = self.input.one_of(&[1, 1, 1, 2, u32::MAX]);
            config.report_times = self.input.one_of(&[1, 1, 1, 2, u32::MAX]);
            sure = sure.only_if(config.keep_ledger == 1 && config.report_times == 1);
        }
        if self.input.chance(32) {
            config.energy_accounts = self.input.one_of(&[1, 2, 3, 3, 4, u32::MAX]);
            config.delay_frames = self.input.one_of(&[0, 0, 1, 16, 17, u32::MAX]);
            let late = config.delay_frames;
            sure = sure.only_if(
                config.energy_accounts <= 3 && (late == 0 || (config.energy_accounts == 3 && late <= 16)),
            );
        }
        if self.input.chance(16) {
            config.pin_workers = self.input.one_of(&[1, 2]);
            config.worker_cores = self.input.one_of(&[1, u64::MAX, 1 << 63]);
            config.fifo_priority = self.input.one_of(&[0, 1, 99, 100, u32::MAX]);
            sure = sure.only_if(config.pin_workers == 1 && config.fifo_priority < 100);
        }
        if self.input.chance(16) {
            match self.input.below(4) {
                0 => config.cookie ^= 1,
                1 => config.struct_size ^= 8,
                2 => config.abi_version ^= 1,
                _ => {
                    let place = self.input.below(config.reserved.len());
                    config.reserved[place] = 1;
                }
            }
            sure = Sure::Wrong;
        }
        self.alone &= config.workers == 0;
        self.create(&config, sure);
    }

    fn create(&mut self, config: &pong_config, sure: Sure) {
        if self.costs >= COSTS_MAX {
            return;
        }
        self.costs += 1;
        self.destroy();
        let place = self.place();
        let nothing = self.input.chance(4);
        let given = if nothing { std::ptr::null() } else { std::ptr::from_ref(config) };
        let sure = sure.and(place.sure).only_if(!nothing);
        if self.call("create", sure, || unsafe { pong_create_world(given, place.pointer) }) {
            let current = self.current;
            self.hosts()[current] = Some(Box::new(Host::new(place.get())));
        } else if place.sure == Sure::Right && !self.is_again() {
            assert!(place.get().is_null(), "a world that was not made");
        }
    }

    fn register(&mut self) {
        let (world, sure) = self.world();
        let sealed = self.host().is_some_and(|host| host.sealed);
        let name = self.text(&LAWS);
        let user = self.host().map_or(std::ptr::null_mut(), |host| host.behaviour.user());
        let has_law = !self.input.chance(8);
        let sure = sure.and(name.sure).and(Sure::Unknown).only_if(!sealed && has_law);
        if self.input.chance(128) {
            let [force, stored] = [has_law, self.input.chance(128)]
                .map(|given| given.then_some(laws::normal as unsafe extern "C" fn(_, _) -> f64));
            self.call("register", sure, || unsafe {
                pong_register_normal_law(world, name.pointer(), force, stored, user)
            });
        } else {
            // The law writes one number.
            let length = self.input.one_of(&[1, 2, 64, 65, usize::MAX]);
            let law = has_law.then_some(laws::friction as unsafe extern "C" fn(_, _, _, _));
            self.call("register", sure.only_if(length <= 64), || unsafe {
                pong_register_friction_law(world, name.pointer(), length, law, user)
            });
        }
    }

    fn load(&mut self) {
        if self.input.chance(24) {
            return self.load_path();
        }
        let which = self.input.below(MODELS.len());
        let sealed = self.host().is_none_or(|host| host.sealed);
        let room = self.host().is_some_and(|host| host.ids.models.len() < MOST);
        if !room && !sealed {
            return;
        }
        if let Some(host) = self.host() {
            host.own_laws |= which == OWN_LAWS;
        }
        let sure = Sure::Right.only_if(!sealed && which != FAULTY);
        match self.input.chance(40) {
            false => self.load_text(MODELS[which], sure),
            true => {
                if let Some(host) = self.host() {
                    host.own_laws = true; // Changed text may name them.
                    host.extreme = true;
                }
                let mut text = MODELS[which].as_bytes().to_vec();
                for _ in 0..=self.input.below(4) {
                    let at = usize::from(u16::from_le_bytes(self.input.bytes())) % text.len();
                    text[at] = self.input.byte();
                }
                self.load_bytes(&text, Sure::Unknown.only_if(!sealed));
            }
        }
    }

    fn load_text(&mut self, text: &str, sure: Sure) {
        self.load_bytes(text.as_bytes(), sure);
    }

    fn load_bytes(&mut self, text: &[u8], sure: Sure) {
        let (world, known) = self.world();
        let place = self.place();
        let sure = sure.and(known).and(place.sure);
        let (name, folder) = (c"model.ron", std::ptr::null());
        let (pointer, length) = match self.input.byte() {
            255 => (std::ptr::null(), text.len()),
            254 => (text.as_ptr(), usize::MAX),
            253 => (text.as_ptr(), 0),
            _ => (text.as_ptr(), text.len()),
        };
        let sure = sure.only_if(pointer == text.as_ptr() && length == text.len());
        let done = self.call("load text", sure, || unsafe {
            pong_load_model_text(world, pointer.cast(), length, name.as_ptr(), folder, place.pointer)
        });
        if done {
            self.host().expect("it has a world").ids.models.push(place.get());
        }
    }

    fn load_path(&mut self) {
        let (world, known) = self.world();
        let place = self.place();
        let folder = crate::files::folder().display().to_string();
        let below = self.text(&["", "/nowhere", "missing", &folder, "."]);
        let sure = known.and(Sure::Unknown);
        self.call("allow files below", sure, || unsafe { pong_allow_files_below(world, below.pointer()) });
        let path = self.text(&["", "/", "missing.ron", "/dev/null", &folder, "/proc/self/mem", "."]);
        let sure = Sure::Wrong.and(known);
        self.call("load", sure, || unsafe { pong_load_model(world, path.pointer(), place.pointer) });
        let (paths, name) = ([path.pointer(); 2], c"joined");
        self.call("load joined", sure, || unsafe {
            let count = paths.len();
            pong_load_joined_models(
                world,
                paths.as_ptr(),
                std::ptr::null(),
                count,
                name.as_ptr(),
                1,
                place.pointer,
            )
        });
    }

    fn create_any_object(&mut self) {
        let (model, known) = self.id(|ids| &ids.models, |bits| pong_model_id { bits });
        let name = self.text(&OBJECTS);
        let (sealed, full) =
            self.host().map_or((true, false), |host| (host.sealed, host.ids.objects.len() >= MOST));
        if !full {
            let sure = known.and(name.sure).and(Sure::Unknown).only_if(!sealed);
            self.create_object(model, name.pointer(), sure);
        }
    }

    fn create_object(&mut self, model: pong_model_id, name: *const c_char, sure: Sure) {
        let (world, known) = self.world();
        let place = self.place::<pong_object_id>();
        let sure = sure.and(known).and(place.sure);
        if !self
            .call("create object", sure, || unsafe { pong_create_object(world, model, name, place.pointer) })
        {
            return;
        }
        let object = place.get();
        let mut interfaces = vec![pong::ids::pong_interface_id { bits: 0 }; 4];
        let mut count = 0;
        let done = self.call("list interfaces", Sure::Right, || unsafe {
            pong_list_interfaces(world, object, interfaces.as_mut_ptr(), interfaces.len(), &mut count)
        });
        assert!(done && (1..=4).contains(&count) || self.is_again(), "{count} Interfaces");
        let host = self.host().expect("it has a world");
        host.ids.objects.push(object);
        host.ids.interfaces.extend(&interfaces[..count]);
        host.set.resize(host.ids.interfaces.len(), false);
    }

    fn pair(&mut self) {
        let (world, known) = self.world();
        let sealed = self.host().is_none_or(|host| host.sealed);
        let place = self.place::<pong_pair_id>();
        // The output argument of a pair's id is optional.
        let optional = place.pointer.is_null() || place.sure == Sure::Right;
        let sure = known.and(Sure::Unknown).only_if(!sealed && optional);
        let done = if self.input.chance(128) {
            let [a, b] = [0; 2].map(|_| self.id(|ids| &ids.objects, |bits| pong_object_id { bits }));
            self.call("pair", sure.and(a.1).and(b.1), || unsafe {
                pong_pair_objects(world, a.0, b.0, place.pointer)
            })
        } else {
            let [a, b] = [0; 2].map(|_| self.text(&OBJECTS));
            self.call("pair by name", sure.and(a.sure).and(b.sure), || unsafe {
                pong_pair_by_name(world, a.pointer(), b.pointer(), place.pointer)
            })
        };
        if done && !place.pointer.is_null() {
            self.host().expect("it has a world").ids.pairs.push(place.get());
        }
    }

    /// Filters the pair of two groups, known or unknown.
    fn filter(&mut self) {
        let (world, known) = self.world();
        let sealed = self.host().is_none_or(|host| host.sealed);
        let [a, b] = [0; 2].map(|_| self.id(|ids| &ids.objects, |bits| pong_object_id { bits }));
        let [group_a, group_b] = [0; 2].map(|_| self.text(&GROUPS));
        let sure =
            known.and(a.1).and(b.1).and(group_a.sure).and(group_b.sure).and(Sure::Unknown).only_if(!sealed);
        self.call("filter groups", sure, || unsafe {
            pong_filter_groups(world, a.0, group_a.pointer(), b.0, group_b.pointer())
        });
    }

    fn seal_any(&mut self) {
        let sealed = self.host().is_none_or(|host| host.sealed);
        if self.costs < COSTS_MAX {
            self.seal(Sure::Unknown.only_if(!sealed));
        }
    }

    fn seal(&mut self, sure: Sure) {
        self.costs += 1;
        let (world, known) = self.world();
        let place = self.place::<pong_seal_report>();
        let optional = place.pointer.is_null() || place.sure == Sure::Right;
        let sure = sure.and(known).only_if(optional);
        if !self.call("seal", sure, || unsafe { pong_seal(world, place.pointer) }) {
            return;
        }
        let host = self.host().expect("it has a world");
        host.sealed = true;
        if !place.pointer.is_null() {
            let report = place.get();
            (host.contact_capacity, host.state_size) =
                (report.contact_capacity, report.contact_state_size as usize);
            let steps = [report.stable_step, report.surely_stable_step];
            assert!(steps.into_iter().all(|step| step >= 0.0) && steps[1] <= steps[0], "steps of {steps:?}");
        }
    }

    fn seal_warning(&mut self) {
        let (world, known) = self.world();
        let place = self.place::<*const c_char>();
        let index = self.input.one_of(&[0, 1, 1000, usize::MAX]);
        let sure = known.and(place.sure).and(Sure::Unknown).only_if(index < 1000);
        if self.call("seal warning", sure, || unsafe { pong_seal_warning(world, index, place.pointer) }) {
            read_text(place.get());
        }
        let place = self.place::<*const c_char>();
        let sure = known.and(place.sure).and(Sure::Unknown).only_if(index < 1000);
        if self.call("seal note", sure, || unsafe { pong_seal_note(world, index, place.pointer) }) {
            read_text(place.get());
        }
        self.plan_any();
        let (version, hash) = (
            self.input.one_of(&[PONG_ABI_VERSION, PONG_ABI_VERSION, PONG_ABI_VERSION - 1, u32::MAX]),
            self.input.chance(128),
        );
        let sure = Sure::Right.only_if(version == PONG_ABI_VERSION && hash);
        let given = if hash { pong_layout_hash() } else { 7 };
        self.call("check abi", sure, || pong_check_abi(version, given));
    }
}
