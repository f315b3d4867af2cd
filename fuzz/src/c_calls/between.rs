//! Calls between frames: contact state, pairs, surfaces, clearing of history, workers.

use super::frames::finite;
use super::laws;
use super::session::{Session, Sure, read_text};
use super::set_up::COSTS_MAX;
use pong::clone::pong_clone_world;
use pong::contact_state::{
    pong_contact_state_size, pong_contact_state_used, pong_preload_friction, pong_restore_contact_state,
    pong_save_contact_state,
};
use pong::continuation::{pong_continuation, pong_continue_from, pong_extend_world};
use pong::frames::pong_step;
use pong::ids::{pong_model_id, pong_object_id, pong_pair_id};
use pong::objects::pong_clear_contact_history;
use pong::pairs::pong_set_pair_enabled;
use pong::seal::pong_seal;
use pong::surfaces::{
    pong_get_surface, pong_get_surface_more, pong_set_surface, pong_set_surface_more, pong_surface_count,
    pong_surface_more, pong_surface_name, pong_surface_values,
};
use pong::workers::{pong_prewake, pong_quiesce};
use pong::world::{pong_destroy_world, pong_world};
use std::ffi::c_char;
use std::mem::MaybeUninit;

/// Surfaces of the models, and an unknown one.
const SURFACES: [&str; 6] = ["rubber", "rock", "wall", "own", "foam", "nope"];

impl Session<'_> {
    pub fn between_frames(&mut self) {
        match self.input.below(10) {
            0 => self.save(),
            1 | 2 => self.restore(),
            3 => self.forget(),
            4 => self.switch_pair(),
            5 | 6 => self.surface(),
            7 => self.wake(),
            8 => self.clone_world(),
            _ => self.preload(),
        }
    }

    /// Changes the behaviour of this world's laws.
    pub fn change_laws(&mut self) {
        let kind = self.input.below(laws::KINDS as usize) as u8;
        if let Some(host) = self.host() {
            host.behaviour.set(kind);
            // The next evaluation decides whether the present frame is valid.
            host.has_frame = false;
        }
    }

    /// Clones the world with its memory, runs a frame in the clone and destroys it.
    fn clone_world(&mut self) {
        let (world, known) = self.world();
        let sealed = self.host().is_some_and(|host| host.sealed);
        if sealed && self.costs >= COSTS_MAX {
            return;
        }
        self.costs += u32::from(sealed);
        let place = self.place();
        let sure = known.and(place.sure).only_if(sealed);
        // SAFETY: here and below: living worlds, places and texts, as the safety contract of all entries says.
        if !self.call("clone", sure, || unsafe { pong_clone_world(world, place.pointer) }) {
            return;
        }
        let clone = place.get();
        let blocks = [world, clone].map(|world| self.saved(world));
        assert!(blocks[0] == blocks[1], "a clone remembers something else");
        // A law that calls its own world back would call the first one, which is not in a call.
        if self.host().is_some_and(|host| !host.behaviour.calls_back()) {
            self.call("step", Sure::Unknown, || unsafe { pong_step(clone) });
        }
        self.call("destroy", Sure::Right, || unsafe { pong_destroy_world(clone) });
        self.extend_world(world);
    }

    /// A world of the same Objects that goes on where this one is, remembers the same, takes a frame and is destroyed.
    fn extend_world(&mut self, world: *mut pong_world) {
        let mut extended = std::ptr::null_mut();
        // SAFETY: here and below: living worlds and places, as the safety contract of all entries says.
        if !self.call("extend", Sure::Right, || unsafe { pong_extend_world(world, &mut extended) }) {
            return;
        }
        let nothing = std::ptr::null_mut();
        self.call("continue", Sure::Wrong, || unsafe { pong_continue_from(extended, world, nothing) });
        if self.call("seal", Sure::Unknown, || unsafe { pong_seal(extended, std::ptr::null_mut()) }) {
            for wrong in [extended, nothing.cast()] {
                self.call("continue", Sure::Wrong, || unsafe {
                    pong_continue_from(extended, wrong, nothing)
                });
            }
            let mut report = MaybeUninit::<pong_continuation>::uninit();
            // Refused while a frame is not committed.
            let place = report.as_mut_ptr();
            if self.call("continue", Sure::Unknown, || unsafe { pong_continue_from(extended, world, place) })
            {
                // SAFETY: written by a success.
                let report = unsafe { report.assume_init() };
                assert!(report.objects_left == 0 && report.contacts_left == 0 && report.energy_left == 0.0);
                let saved = [world, extended].map(|world| self.saved(world));
                assert!(saved[0] == saved[1], "a world that goes on remembers something else");
                if self.host().is_some_and(|host| !host.behaviour.calls_back()) {
                    self.call("step", Sure::Unknown, || unsafe { pong_step(extended) });
                }
            }
        }
        self.call("destroy", Sure::Right, || unsafe { pong_destroy_world(extended) });
    }

    /// The contact state of a sealed world.
    fn saved(&mut self, world: *mut pong_world) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: here and below: living worlds and places, as the safety contract of all entries says.
        self.call("used", Sure::Right, || unsafe { pong_contact_state_used(world, &mut size) });
        let mut block = vec![0_u8; size];
        let pointer = block.as_mut_ptr().cast();
        self.call("save", Sure::Right, || unsafe { pong_save_contact_state(world, pointer, size) });
        block
    }

    fn save(&mut self) {
        let (world, known) = self.world();
        let sealed = self.host().is_some_and(|host| host.sealed);
        let (mut needed, mut most) = (0, 0);
        let sure = known.only_if(sealed);
        // SAFETY: here and below: living worlds, places and texts, as the safety contract of all entries says.
        self.call("size", sure, || unsafe { pong_contact_state_size(world, &mut most) });
        self.call("used", sure, || unsafe { pong_contact_state_used(world, &mut needed) });
        if !self.may_copy(needed) {
            return;
        }
        let size = match self.input.below(4) {
            0 => needed / 2,
            1 => needed + 64,
            _ => needed,
        };
        let mut block = vec![0xA5_u8; size];
        let pointer = if self.input.chance(6) { std::ptr::null_mut() } else { block.as_mut_ptr() };
        let sure = sure.unless(needed == 0).only_if(size >= needed && (!pointer.is_null() || needed == 0));
        let done =
            self.call("save", sure, || unsafe { pong_save_contact_state(world, pointer.cast(), size) });
        if done {
            let (behind, beyond) = block[needed..].split_at(size.min(most) - needed);
            assert!(behind.iter().all(|byte| *byte == 0), "not cleared behind the block");
            assert!(beyond.iter().all(|byte| *byte == 0xA5), "written beyond the largest block");
            block.truncate(needed);
            let words =
                block.chunks_exact(8).map(|word| u64::from_le_bytes(word.try_into().expect("8 bytes")));
            self.note(words);
            self.host().expect("it has a world").saved = Some(block);
        }
    }

    fn restore(&mut self) {
        let (world, known) = self.world();
        let sealed = self.host().is_some_and(|host| host.sealed);
        let saved = self.host().and_then(|host| host.saved.as_ref().map(Vec::len)).unwrap_or(0);
        if !self.may_copy(saved) {
            return;
        }
        let saved = self.host().and_then(|host| host.saved.clone());
        let (mut block, mut sure) = match saved {
            Some(block) => (block, known.only_if(sealed)),
            None => (self.input.slice(40).to_vec(), known.and(Sure::Wrong)),
        };
        if self.input.chance(100) {
            let at = usize::from(u16::from_le_bytes(self.input.bytes()));
            match self.input.below(3) {
                0 => block.truncate(at % block.len().max(1)),
                1 => block.extend([1; 7]),
                _ => {
                    let at = at % block.len().max(1);
                    block.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 0x10);
                }
            }
            sure = sure.and(Sure::Wrong);
        }
        let (pointer, size) = match self.input.byte() {
            255 => (std::ptr::null(), block.len().max(1)),
            254 => (block.as_ptr(), usize::MAX),
            _ => (block.as_ptr(), block.len()),
        };
        let sure = sure.only_if(!pointer.is_null() && size == block.len());
        self.call("restore", sure, || unsafe { pong_restore_contact_state(world, pointer.cast(), size) });
    }

    fn forget(&mut self) {
        let (world, known) = self.world();
        let (object, good) = self.id(|ids| &ids.objects, |bits| pong_object_id { bits });
        let sealed = self.host().is_some_and(|host| host.sealed);
        let sure = known.and(good).only_if(sealed);
        self.call("forget", sure, || unsafe { pong_clear_contact_history(world, object) });
    }

    /// Preloads contacts; the scene decides whether there are any and whether their forces are finite.
    fn preload(&mut self) {
        let (world, known) = self.world();
        let (pair, good) = self.id(|ids| &ids.pairs, |bits| pong_pair_id { bits });
        let sealed = self.host().is_some_and(|host| host.sealed);
        let force = [self.input.number(), self.input.number(), self.input.number()];
        let force = if self.input.chance(128) { std::ptr::null() } else { force.as_ptr() };
        let mut count = 0;
        let sure = known.and(good).and(Sure::Unknown).only_if(sealed);
        if self.call("preload", sure, || unsafe { pong_preload_friction(world, pair, force, &mut count) })
            && let Some(host) = self.host()
        {
            host.has_frame = false;
        }
    }

    fn switch_pair(&mut self) {
        let (world, known) = self.world();
        let (pair, good) = self.id(|ids| &ids.pairs, |bits| pong_pair_id { bits });
        let enabled = self.input.one_of(&[0, 1, 1, 1, 2, -1, i32::MIN]);
        let sure = known.and(good).only_if(enabled == 0 || enabled == 1);
        self.call("switch pair", sure, || unsafe { pong_set_pair_enabled(world, pair, enabled) });
    }

    fn surface(&mut self) {
        let (world, known) = self.world();
        let (model, good) = self.id(|ids| &ids.models, |bits| pong_model_id { bits });
        let name = self.text(&SURFACES);
        let mut count = 0;
        let sure = known.and(good);
        self.call("surfaces", sure, || unsafe { pong_surface_count(world, model, &mut count) });
        let place = self.place::<*const c_char>();
        let index = self.input.one_of(&[0, 1, 1000, usize::MAX]);
        let named = sure.and(place.sure).and(Sure::Unknown).only_if(index < 1000);
        if self.call("name", named, || unsafe { pong_surface_name(world, model, index, place.pointer) }) {
            read_text(place.get());
        }
        let place = self.place::<pong_surface_values>();
        let got = sure.and(name.sure).and(place.sure).and(Sure::Unknown);
        if !self.call("get surface", got, || unsafe {
            pong_get_surface(world, model, name.pointer(), place.pointer)
        }) {
            return;
        }
        let mut values = place.get();
        let good = self.change(&mut values);
        let sure = Sure::Unknown.only_if(good);
        self.call("set surface", sure, || unsafe { pong_set_surface(world, model, name.pointer(), &values) });
        let place = self.place::<pong_surface_more>();
        let got = place.sure.and(Sure::Unknown);
        if self.call("get surface more", got, || unsafe {
            pong_get_surface_more(world, model, name.pointer(), place.pointer)
        }) {
            let mut more = place.get();
            match self.input.below(4) {
                0 => more.foundation = self.input.number(),
                1 => more.area = self.input.number(),
                2 => more.rolling = self.input.number(),
                _ => more.spinning = self.input.number(),
            }
            let sure = Sure::Unknown;
            self.call("set surface more", sure, || unsafe {
                pong_set_surface_more(world, model, name.pointer(), &more)
            });
        }
    }

    /// Changes values. Returns whether any of them is certainly invalid.
    fn change(&mut self, values: &mut pong_surface_values) -> bool {
        match self.input.below(4) {
            0 => {
                let number = self.input.number();
                let numbers = [
                    &mut values.stiffness,
                    &mut values.damping,
                    &mut values.ramp,
                    &mut values.dissipation,
                    &mut values.friction,
                    &mut values.friction_static_excess,
                    &mut values.friction_stiffness,
                    &mut values.friction_damping,
                    &mut values.friction_slip_speed,
                ];
                let which = self.input.below(numbers.len());
                *numbers.into_iter().nth(which).expect("one of them") = number;
                let linear = values.normal_law == 0;
                let power_law = matches!(values.normal_law, 5 | 6);
                // Others may belong to a law that the surface does not have.
                match which {
                    0 => (1e-100..=1e100).contains(&number) || number == f64::INFINITY,
                    1 | 2 if linear => (0.0..=1e100).contains(&number),
                    1 if power_law => (0.0..=1e100).contains(&number),
                    _ => true,
                }
            }
            1 => {
                values.normal_law = self.input.one_of(&[0, 1, 2, 3, 4, 5, 6, -1]);
                (0..=6).contains(&values.normal_law)
            }
            2 => {
                values.friction_law = self.input.one_of(&[0, 1, 2, 3, 4, -1]);
                (0..4).contains(&values.friction_law)
            }
            _ => {
                values.stiffness = [1e3, 1e5, 1e7, f64::INFINITY][self.input.below(4)];
                values.friction = self.input.small(0.25).abs();
                finite([values.friction].iter(), "friction");
                true
            }
        }
    }

    fn wake(&mut self) {
        let (world, known) = self.world();
        let sealed = self.host().is_some_and(|host| host.sealed);
        let sure = known.only_if(sealed);
        let time = self.input.one_of(&[0, 1, 200, 2000, u64::MAX]);
        self.call("prewake", sure.and(Sure::Unknown), || unsafe { pong_prewake(world, time) });
        self.call("quiesce", sure, || unsafe { pong_quiesce(world) });
    }
}
