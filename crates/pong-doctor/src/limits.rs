//! Limits of this process: locked memory, SCHED_FIFO, the share of a core.

use crate::{Files, Finding, State};

/// Bits of the capabilities in `/proc/self/status` (include/uapi/linux/capability.h of the kernel).
const CAP_IPC_LOCK: u32 = 14;

pub(crate) fn examine(files: &impl Files, fifo: Result<(), String>) -> Vec<Finding> {
    vec![locked_memory(files), scheduling(files, fifo), share_of_a_core(files)]
}

fn has_capability(files: &impl Files, bit: u32) -> bool {
    let effective = || {
        let status = files.text("/proc/self/status")?;
        let text = status.lines().find_map(|line| line.strip_prefix("CapEff:"))?.trim().to_owned();
        u64::from_str_radix(&text, 16).ok()
    };
    effective().is_some_and(|capabilities| capabilities >> bit & 1 == 1)
}

/// The soft limit of this name in `/proc/self/limits`.
fn soft_limit(files: &impl Files, name: &str) -> Option<String> {
    let limits = files.text("/proc/self/limits")?;
    let row = limits.lines().find_map(|line| line.strip_prefix(name))?;
    row.split_whitespace().next().map(str::to_owned)
}

fn locked_memory(files: &impl Files) -> Finding {
    let name = "locked memory";
    let meaning = "Without locked memory (mlockall) a frame may wait for a page: milliseconds.";
    let cure =
        "ulimit -l unlimited, memlock in /etc/security/limits.conf, or LimitMEMLOCK=infinity in systemd.";
    if has_capability(files, CAP_IPC_LOCK) {
        return Finding::new(name, State::Good, "without limit (CAP_IPC_LOCK)".to_owned(), meaning);
    }
    match soft_limit(files, "Max locked memory").as_deref() {
        None => Finding::unknown(name, "the system does not tell the limit", meaning),
        Some("unlimited") => Finding::new(name, State::Good, "without limit".to_owned(), meaning),
        Some(bytes) => {
            let found = match bytes.parse::<u64>() {
                Ok(bytes) => format!("{} KiB at most", bytes / 1024),
                Err(_) => bytes.to_owned(),
            };
            Finding::judged(name, false, found, meaning, cure)
        }
    }
}

fn scheduling(files: &impl Files, fifo: Result<(), String>) -> Finding {
    let limit = soft_limit(files, "Max realtime priority").unwrap_or_else(|| "unknown".to_owned());
    let found = match &fifo {
        Ok(()) => format!("granted to a thread that asked for it (RLIMIT_RTPRIO is {limit})"),
        Err(why) => format!("refused: {why} (RLIMIT_RTPRIO is {limit})"),
    };
    Finding::judged(
        "SCHED_FIFO",
        fifo.is_ok(),
        found,
        "Without a real-time priority any other thread delays a frame by its time slice: milliseconds.",
        "Give the program CAP_SYS_NICE, rtprio in /etc/security/limits.conf, or LimitRTPRIO=99 in systemd.",
    )
}

fn share_of_a_core(files: &impl Files) -> Finding {
    let name = "real-time share";
    let meaning = "The kernel stops threads of SCHED_FIFO for the rest of each period if they use more than this of a core.";
    let number = |path| files.text(path).and_then(|text| text.parse::<i64>().ok());
    let (runtime, period) =
        (number("/proc/sys/kernel/sched_rt_runtime_us"), number("/proc/sys/kernel/sched_rt_period_us"));
    let cure = "sysctl kernel.sched_rt_runtime_us=-1, if a frame may use all of a core; a thread that never sleeps then blocks \
                its core.";
    match (runtime, period) {
        (Some(-1), _) => Finding::new(name, State::Good, "all of a core".to_owned(), meaning),
        (Some(runtime), Some(period)) if period > 0 => {
            let found = format!("{} µs of {} µs", runtime, period);
            Finding::judged(name, runtime >= period, found, meaning, cure)
        }
        _ => Finding::unknown(name, "the kernel has no such limit, or does not tell", meaning),
    }
}
