//! Settings of a world.

use crate::abi::PONG_ABI_VERSION;
use crate::coupling::{self, PONG_COUPLING_ZERO_ORDER_HOLD, pong_coupling};
use crate::failure::{Failure, Outcome};
use crate::status::pong_status;
use pong_engine::{Config, WorkerSettings, WrenchCoupling};
use std::time::Duration;

/// Marks a configuration made by pong_default_config().
const COOKIE: u64 = 0x706f_6e67_2d63_6667;

/// Settings of a world. Make it with pong_default_config(), change what you like, pass it to
/// pong_create_world().
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_config {
    /// Set by pong_default_config(): size of this struct, bytes.
    pub struct_size: u32,
    /// Set by pong_default_config(): PONG_ABI_VERSION of the library.
    pub abi_version: u32,
    /// Set by pong_default_config(): checked by pong_create_world().
    pub cookie: u64,
    /// Most contacts of a frame; 0 takes an estimate from the scene, at least 256 and at most 65536: the contacts of
    /// all pairs of movable groups, or, if that is less, those of the 16 pairs of each group that have the most. When a
    /// frame has more, the deepest are kept and the report has PONG_FLAG_CONTACT_LIMIT.
    pub contact_capacity: u64,
    /// 1: keeps energies for pong_get_ledger(). 0 (default): does not, and costs nothing.
    pub keep_ledger: u32,
    /// 1: times the stages of a frame and the workers by CLOCK_MONOTONIC, for pong_get_report() and
    /// pong_get_worker(). 0 (default): reads no clock in them.
    pub report_times: u32,
    /// Threads that share a frame's work with the calling one, at most 64; 0 (default) for the calling thread alone.
    /// The results are the same bits for any number. There will be no more than there are cores beside the caller's
    /// in the affinity mask of the thread that seals the world; see `oversubscribe`.
    pub workers: u32,
    /// 1: starts all `workers`, even if there are fewer cores. 0 (default): at most one for each core.
    pub oversubscribe: u32,
    /// Time for which a worker looks for work before it sleeps, us; 50 by default, at most 1000000. Waking a sleeping
    /// one takes tens of us; see pong_prewake().
    pub spin_us: u32,
    /// Time for which the calling thread waits for a worker that does not finish its part of the frame, us; then it
    /// does that work again itself. 1000 by default, 1 to 1000000.
    pub worker_timeout_us: u32,
    /// 1: binds each worker to a core of its own; outcome: pong_get_worker(). 0 (default): binds none. The
    /// calling thread stays as it is: bind it to the first core of its mask, which the workers leave free.
    pub pin_workers: u32,
    /// SCHED_FIFO priority of the workers, 1 to 99; 0 (default) requests none. Outcome: pong_get_worker().
    pub fifo_priority: u32,
    /// With pin_workers: the cores of the workers, bit n for core n, the lowest for the first worker. They may be
    /// outside the affinity mask, and their number is the limit of the workers. 0 (default) for the cores of the
    /// affinity mask after the first.
    pub worker_cores: u64,
    /// PONG_COUPLING_...: keeps energy accounts of contacts and pairs, see pong_get_pair_energy_account().
    /// The coupling is the host's use of wrenches, on which their work depends. Keeps the ledger as well. 0
    /// (default) keeps no accounts and costs nothing.
    pub energy_accounts: pong_coupling,
    /// With PONG_COUPLING_ZERO_ORDER_HOLD: delay of the wrenches in whole frames after the first possible
    /// one, at most 16; 0 by default.
    pub delay_frames: u32,
    /// Zero.
    pub reserved: [u64; 7],
}

/// The default settings: no workers, no energies, capacities by the scene.
#[unsafe(no_mangle)]
pub extern "C" fn pong_default_config() -> pong_config {
    pong_config {
        struct_size: size_of::<pong_config>() as u32,
        abi_version: PONG_ABI_VERSION,
        cookie: COOKIE,
        contact_capacity: 0,
        keep_ledger: 0,
        report_times: 0,
        workers: 0,
        oversubscribe: 0,
        spin_us: 50,
        worker_timeout_us: 1000,
        pin_workers: 0,
        fifo_priority: 0,
        worker_cores: 0,
        energy_accounts: 0,
        delay_frames: 0,
        reserved: [0; 7],
    }
}

/// Checked settings of a configuration.
pub(crate) struct Wanted {
    pub engine: Config,
    /// True if the engine gets a clock.
    pub times: bool,
}

impl pong_config {
    /// Returns the engine's settings, if the struct was made by this library and every value is allowed.
    pub(crate) fn check(&self) -> Outcome<Wanted> {
        self.check_origin()?;
        let contact_capacity = match self.contact_capacity {
            0 => None,
            _ => Some(within(
                "contact_capacity",
                self.contact_capacity,
                0,
                MOST_CONTACTS,
                "0 for the default",
            )?),
        };
        let engine = Config {
            contact_capacity: contact_capacity.map(|wanted| wanted as usize),
            ledger: switch("keep_ledger", self.keep_ledger)?,
            accounts: self.accounts()?,
            workers: self.worker_settings()?,
            // pong_set_surface_motions() in set-up makes it true.
            moving_surfaces: false,
        };
        Ok(Wanted { engine, times: switch("report_times", self.report_times)? })
    }

    fn check_origin(&self) -> Outcome {
        let expected = pong_default_config();
        let made_here = (self.cookie, self.struct_size, self.abi_version)
            == (expected.cookie, expected.struct_size, expected.abi_version);
        let cause = match (made_here, self.reserved == expected.reserved) {
            (true, true) => return Ok(()),
            (true, false) => "has values in its reserved fields",
            (false, _) => "was not filled in by pong_default_config()",
        };
        let message = format!(
            "config: it {cause}; start from pong_default_config() and change only what is documented"
        );
        Err(Failure::new(pong_status::Config, message))
    }

    fn accounts(&self) -> Outcome<Option<WrenchCoupling>> {
        let most = WrenchCoupling::DELAY_FRAMES_MAX.into();
        let late = within("delay_frames", self.delay_frames.into(), 0, most, "0 by default")? as u32;
        let wrench_coupling = coupling::of_number(self.energy_accounts, late);
        if wrench_coupling.is_none() && self.energy_accounts != 0 {
            let given = self.energy_accounts;
            let message =
                format!("config: energy_accounts is {given}; give PONG_COUPLING_..., or 0 for none");
            return Err(Failure::new(pong_status::BadValue, message));
        }
        if late > 0 && self.energy_accounts != PONG_COUPLING_ZERO_ORDER_HOLD {
            let message = format!(
                "config: delay_frames is {late} but energy_accounts is {}; only a wrench that is held can be delayed: set energy_accounts to PONG_COUPLING_ZERO_ORDER_HOLD or delay_frames to 0",
                self.energy_accounts
            );
            return Err(Failure::new(pong_status::BadValue, message));
        }
        Ok(wrench_coupling)
    }

    /// Checks the settings of workers even when there are none, so that a wrong value is found at once.
    fn worker_settings(&self) -> Outcome<Option<WorkerSettings>> {
        let most = pong_threads::MAX_WORKERS as u64;
        let workers =
            within("workers", self.workers.into(), 0, most, "0 for the calling thread alone")? as usize;
        let spin = within("spin_us", self.spin_us.into(), 0, MOST_US, "50 by default")?;
        let worker_timeout =
            within("worker_timeout_us", self.worker_timeout_us.into(), 1, MOST_US, "1000 by default")?;
        let priority = within("fifo_priority", self.fifo_priority.into(), 0, 99, "0 for no SCHED_FIFO")?;
        let pin = switch("pin_workers", self.pin_workers)?;
        let oversubscribe = switch("oversubscribe", self.oversubscribe)?;
        if self.worker_cores != 0 && !pin {
            let message = format!(
                "config: worker_cores is {:#x} but pin_workers is 0; set pin_workers to 1 or worker_cores to 0",
                self.worker_cores
            );
            return Err(Failure::new(pong_status::BadValue, message));
        }
        let settings = WorkerSettings {
            workers,
            oversubscribe,
            spin: Duration::from_micros(spin),
            worker_timeout: Duration::from_micros(worker_timeout),
            pin,
            cores: (0..64).filter(|core| self.worker_cores >> core & 1 == 1).collect(),
            fifo_priority: u8::try_from(priority).ok().filter(|priority| *priority > 0),
            clock: None, // The world's own, see report_times.
        };
        Ok((workers > 0).then_some(settings))
    }
}

/// Upper limit: a larger value is more likely a typing error than a scene, and its memory is not available.
const MOST_CONTACTS: u64 = 1 << 24;

/// Longest time of a setting, us: a larger value is more likely a wrong unit.
const MOST_US: u64 = 1_000_000;

/// Refuses a value of the configuration outside `least..=most`.
fn within(name: &str, value: u64, least: u64, most: u64, or: &str) -> Outcome<u64> {
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    let message = format!("config: {name} is {value}; give {least} to {most} ({or})");
    Err(Failure::new(pong_status::BadValue, message))
}

fn switch(name: &str, value: u32) -> Outcome<bool> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Failure::new(pong_status::BadValue, format!("config: {name} is {other}; give 0 or 1"))),
    }
}
