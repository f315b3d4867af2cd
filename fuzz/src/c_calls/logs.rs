//! Response logs.

use super::session::{Session, Sure};
use super::set_up::COSTS_MAX;
use crate::files;
use pong::log::{
    pong_default_log_options, pong_get_log_report, pong_log_frame, pong_log_report, pong_start_log,
    pong_stop_log,
};

/// Folders below the folder of the process.
const FOLDERS: [&str; 2] = ["log_1", "log_2"];
/// Cost of a log, in units of a world.
const COST: u32 = 4;

impl Session<'_> {
    pub fn log(&mut self) {
        match self.input.below(8) {
            0 => self.start(),
            1..=4 => self.log_frame(),
            5 => self.log_report(),
            6 => self.stop(),
            _ => self.log_frame(),
        }
    }

    fn start(&mut self) {
        if self.costs >= COSTS_MAX {
            return;
        }
        self.costs += COST;
        // Files change between two runs of one input.
        self.alone = false;
        let (world, known) = self.world();
        let sealed = self.host().is_some_and(|host| host.sealed);
        let folders: Vec<String> = FOLDERS
            .iter()
            .map(|name| files::folder().join(name).display().to_string())
            .chain(["/dev/null".to_owned(), "/proc/none".to_owned(), String::new()])
            .collect();
        let names: Vec<&str> = folders.iter().map(String::as_str).collect();
        let folder = self.text(&names);
        // Other texts name paths outside of the folder.
        let ours = folder
            .text
            .as_ref()
            .is_none_or(|text| names.iter().any(|name| text.as_bytes() == name.as_bytes()));
        if !ours && folder.sure != Sure::Wrong {
            return;
        }
        let mut options = pong_default_log_options();
        options.overwrite = self.input.one_of(&[1, 1, 1, 0, 2]);
        options.when_full = self.input.one_of(&[0, 1, 0, 1, 2]);
        options.buffer_bytes = self.input.one_of(&[0, 1, 4096, 1 << 20]);
        options.flush_ms = self.input.one_of(&[1000, 1, 0, u32::MAX]);
        options.step = self.input.number();
        let nameless = self.input.chance(200);
        options.name = if nameless { std::ptr::null() } else { c"run \"1\"\n".as_ptr() };
        let forged = self.input.chance(8);
        options.cookie ^= u64::from(forged);
        let sure = Sure::Unknown
            .and(known)
            .and(folder.sure)
            .only_if(sealed && !forged && options.overwrite < 2 && options.when_full < 2);
        // SAFETY: here and below: living worlds, places and texts, as the safety contract of all entries says.
        if self.call("start log", sure, || unsafe { pong_start_log(world, folder.pointer(), &options) }) {
            self.host().expect("it has a world").logging = true;
        }
    }

    fn log_frame(&mut self) {
        let (world, known) = self.world();
        let logging = self.host().is_some_and(|host| host.logging);
        let time = self.input.number();
        let sure = known.and(Sure::Unknown).only_if(logging && time.is_finite());
        self.call("log frame", sure, || unsafe { pong_log_frame(world, time) });
    }

    fn log_report(&mut self) {
        let (world, known) = self.world();
        let place = self.place::<pong_log_report>();
        let sure = known.and(place.sure).and(Sure::Unknown);
        if self.call("log report", sure, || unsafe { pong_get_log_report(world, place.pointer) }) {
            let report = place.get();
            assert!(report.flushed + report.lost <= report.frames, "{report:?}");
        }
    }

    fn stop(&mut self) {
        let (world, known) = self.world();
        let logging = self.host().is_some_and(|host| host.logging);
        let place = self.place::<pong_log_report>();
        let sure = known.and(Sure::Unknown).only_if(logging);
        if self.call("stop log", sure, || unsafe { pong_stop_log(world, place.pointer) }) {
            self.host().expect("it has a world").logging = false;
        }
    }
}

/// Removes the folders of logs.
pub fn remove_folders() {
    for name in FOLDERS {
        let folder = files::folder().join(name);
        if folder.exists() {
            let _ = std::fs::remove_dir_all(folder);
        }
    }
}
