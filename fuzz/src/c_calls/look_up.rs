//! Names, paths, counts, user data: queries that are valid at any time.

use super::session::{Session, Sure, read_text};
use super::set_up::OBJECTS;
use pong::ids::{pong_interface_id, pong_model_id, pong_object_id};
use pong::interfaces::{
    pong_find_interface, pong_get_authored_state, pong_interface_object, pong_interface_path,
    pong_list_interfaces,
};
use pong::models::{pong_model_warning, pong_model_warning_count};
use pong::objects::{pong_find_object, pong_object_name};
use pong::primitives::{pong_find_primitive, pong_primitive_count, pong_primitive_path};
use pong::report::{pong_flag_name, pong_stage_name, pong_work_name};
use pong::states::pong_state;
use pong::status::{pong_last_message, pong_status_name};
use pong::tally::{pong_get_tally, pong_tally, pong_tally_count};
use pong::user_data::{
    pong_get_object_user_data, pong_get_primitive_user_data, pong_set_object_user_data,
    pong_set_primitive_user_data,
};
use pong::version::{pong_abi_version, pong_version_string};
use pong::workers::{pong_get_worker, pong_worker, pong_worker_count, pong_worker_text};
use std::ffi::c_char;

/// Paths of groups and primitives of the models, and unknown ones.
const PATHS: [&str; 9] =
    ["", "ball", "ball/latch", "latch", "arm", "ball/shell/sphere", "solid/sheet/sheet", "/", "nope"];

impl Session<'_> {
    pub fn look_up(&mut self) {
        match self.input.below(12) {
            0 => self.find_object(),
            1 => self.object_name(),
            2 => self.find_interface(),
            3 => self.list_interfaces(),
            4 => self.interface_text(),
            5 => self.primitive(),
            6 => self.find_primitive(),
            7 => self.warnings(),
            8 => self.object_data(),
            9 => self.primitive_data(),
            10 => self.tally(),
            _ => self.worker(),
        }
    }

    fn object(&mut self) -> (pong_object_id, Sure) {
        self.id(|ids| &ids.objects, |bits| pong_object_id { bits })
    }

    fn interface(&mut self) -> (pong_interface_id, Sure) {
        self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits })
    }

    fn index(&mut self) -> u32 {
        self.input.one_of(&[0, 1, 2, 3, 4, 1000, i32::MAX as u32, u32::MAX])
    }

    fn find_object(&mut self) {
        let (world, known) = self.world();
        let name = self.text(&OBJECTS);
        let place = self.place();
        let sure = known.and(name.sure).and(place.sure).and(Sure::Unknown);
        // SAFETY: here and below: living worlds, places and texts, as the safety contract of all entries says.
        self.call("find object", sure, || unsafe { pong_find_object(world, name.pointer(), place.pointer) });
        let number = self.input.byte();
        read_text(pong_status_name(i32::from(number) - 100));
        read_text(pong_flag_name(number.into()));
        read_text(pong_stage_name(number.into()));
        read_text(pong_work_name(number.into()));
        read_text(pong_version_string());
        read_text(pong_last_message());
        assert_eq!(pong_abi_version(), pong::version::PONG_ABI_VERSION);
    }

    fn object_name(&mut self) {
        let (world, known) = self.world();
        let (object, good) = self.object();
        let place = self.place::<*const c_char>();
        let sure = known.and(good).and(place.sure);
        if self.call("object name", sure, || unsafe { pong_object_name(world, object, place.pointer) }) {
            read_text(place.get());
        }
    }

    fn find_interface(&mut self) {
        let (world, known) = self.world();
        let (object, good) = self.object();
        let path = self.text(&PATHS);
        let place = self.place();
        let sure = known.and(good).and(path.sure).and(place.sure).and(Sure::Unknown);
        self.call("find interface", sure, || unsafe {
            pong_find_interface(world, object, path.pointer(), place.pointer)
        });
    }

    fn list_interfaces(&mut self) {
        let (world, known) = self.world();
        let (object, good) = self.object();
        let place = self.place::<usize>();
        let capacity = self.input.below(4);
        let mut list = Vec::<pong_interface_id>::with_capacity(capacity);
        // An impossible length is refused, like a NULL array.
        let (pointer, length) = match self.input.byte() {
            255 => (list.as_mut_ptr(), usize::MAX),
            254 => (std::ptr::null_mut(), 3),
            _ => (list.as_mut_ptr(), capacity),
        };
        let sure = known.and(good).and(place.sure).and(Sure::Unknown);
        let sure = sure.only_if(length != usize::MAX && !pointer.is_null());
        let done = self.call("list interfaces", sure, || unsafe {
            pong_list_interfaces(world, object, pointer, length, place.pointer)
        });
        assert!(!done || place.get() <= capacity, "{} Interfaces where {capacity} fit", place.get());
    }

    fn interface_text(&mut self) {
        let (world, known) = self.world();
        let (interface, good) = self.interface();
        let place = self.place::<*const c_char>();
        let sure = known.and(good).and(place.sure);
        if self.call("path", sure, || unsafe { pong_interface_path(world, interface, place.pointer) }) {
            read_text(place.get());
        }
        let place = self.place();
        let sure = known.and(good).and(place.sure);
        self.call("object", sure, || unsafe { pong_interface_object(world, interface, place.pointer) });
        let place = self.place::<pong_state>();
        let sure = known.and(good).and(place.sure);
        self.call("authored state", sure, || unsafe {
            pong_get_authored_state(world, interface, place.pointer)
        });
    }

    fn primitive(&mut self) {
        let (world, known) = self.world();
        let (interface, good) = self.interface();
        let mut count = 0;
        let sure = known.and(good);
        if !self.call("count", sure, || unsafe { pong_primitive_count(world, interface, &mut count) }) {
            return;
        }
        let index = self.index();
        let place = self.place::<*const c_char>();
        let sure = sure.and(place.sure).only_if(index < count);
        let done = self
            .call("path", sure, || unsafe { pong_primitive_path(world, interface, index, place.pointer) });
        if done {
            read_text(place.get());
        }
    }

    fn find_primitive(&mut self) {
        let (world, known) = self.world();
        let (interface, good) = self.interface();
        let path = self.text(&PATHS);
        let place = self.place();
        let sure = known.and(good).and(path.sure).and(place.sure).and(Sure::Unknown);
        self.call("find primitive", sure, || unsafe {
            pong_find_primitive(world, interface, path.pointer(), place.pointer)
        });
    }

    fn warnings(&mut self) {
        let (world, known) = self.world();
        let (model, good) = self.id(|ids| &ids.models, |bits| pong_model_id { bits });
        let mut count = 0;
        let sure = known.and(good);
        self.call("warnings", sure, || unsafe { pong_model_warning_count(world, model, &mut count) });
        let index = self.index() as usize;
        let place = self.place::<*const c_char>();
        let sure = sure.and(place.sure).only_if(index < count);
        if self.call("warning", sure, || unsafe { pong_model_warning(world, model, index, place.pointer) }) {
            read_text(place.get());
        }
    }

    fn object_data(&mut self) {
        let (world, known) = self.world();
        let (object, good) = self.object();
        let sure = known.and(good);
        let number = u64::from(self.input.byte());
        let place = self.place::<u64>();
        let set = self.call("set data", sure, || unsafe { pong_set_object_user_data(world, object, number) });
        let sure = sure.and(place.sure);
        let got =
            self.call("data", sure, || unsafe { pong_get_object_user_data(world, object, place.pointer) });
        assert!(!(set && got) || place.get() == number, "user data came back as {}", place.get());
    }

    fn primitive_data(&mut self) {
        let (world, known) = self.world();
        let (interface, good) = self.interface();
        let (index, number) = (self.index(), u64::from(self.input.byte()));
        let sure = known.and(good).and(Sure::Unknown).only_if(index < 1000);
        let place = self.place::<u64>();
        let set = self.call("set data", sure, || unsafe {
            pong_set_primitive_user_data(world, interface, index, number)
        });
        let sure = sure.and(place.sure);
        let got = self.call("data", sure, || unsafe {
            pong_get_primitive_user_data(world, interface, index, place.pointer)
        });
        assert!(!(set && got) || place.get() == number, "user data came back as {}", place.get());
    }

    fn tally(&mut self) {
        let (world, known) = self.world();
        let mut count = 0;
        let counted = self.call("tallies", known, || unsafe { pong_tally_count(world, &mut count) });
        let index = self.index() as usize;
        let place = self.place::<pong_tally>();
        let sure = known.and(place.sure).unless(!counted).only_if(index < count || !counted);
        if self.call("tally", sure, || unsafe { pong_get_tally(world, index, place.pointer) }) {
            let tally = place.get();
            assert!(tally.kind_a.contains(&0) && tally.kind_b.contains(&0), "a name without an end");
        }
    }

    fn worker(&mut self) {
        let (world, known) = self.world();
        let sealed = self.host().is_some_and(|host| host.sealed);
        let mut count = 0;
        let sure = known.only_if(sealed);
        self.call("workers", sure, || unsafe { pong_worker_count(world, &mut count) });
        let lane = self.index() as usize;
        let place = self.place::<pong_worker>();
        let sure = sure.and(place.sure);
        let inside = sure.only_if(lane <= count);
        self.call("worker", inside, || unsafe { pong_get_worker(world, lane, place.pointer) });
        let place = self.place::<*const c_char>();
        let inside = known.and(place.sure).and(Sure::Unknown).only_if(sealed && lane < 1000 && lane > 0);
        if self.call("worker text", inside, || unsafe { pong_worker_text(world, lane, place.pointer) }) {
            read_text(place.get());
        }
    }
}
