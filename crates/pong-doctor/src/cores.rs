//! Processors: number, shared cores, isolation, clock rates, idle states.

use crate::{CpuSet, Files, Finding, State};
use std::collections::BTreeSet;

const CPU: &str = "/sys/devices/system/cpu";
/// Exit latency from which waking up is a visible part of a frame of 1 ms, µs.
const IDLE_EXIT_LATENCY_MAX_US: u64 = 20;
/// Upper bound of the kernel's number of idle states (`CPUIDLE_STATE_MAX` is 10).
const IDLE_STATES_MAX: usize = 16;

pub(crate) fn examine(files: &impl Files) -> Vec<Finding> {
    let online = listed(files, &format!("{CPU}/online")).unwrap_or_default();
    let allowed = allowed(files).unwrap_or_else(|| online.clone());
    vec![
        cores(files, &online, &allowed),
        siblings(files, &allowed),
        isolated(files, &allowed),
        without_tick(files),
        governor(files, &allowed),
        idle_states(files, &allowed),
    ]
}

fn listed(files: &impl Files, path: &str) -> Option<CpuSet> {
    CpuSet::parse(&files.text(path)?)
}

/// The processors that this process may use.
fn allowed(files: &impl Files) -> Option<CpuSet> {
    let status = files.text("/proc/self/status")?;
    CpuSet::parse(status.lines().find_map(|line| line.strip_prefix("Cpus_allowed_list:"))?)
}

/// The sets of processors that share a core, one for each core of `cpus`.
fn by_core(files: &impl Files, cpus: &CpuSet) -> Option<BTreeSet<String>> {
    let on_core = |cpu| {
        let all = listed(files, &format!("{CPU}/cpu{cpu}/topology/thread_siblings_list"))?;
        Some(all.intersection(cpus).to_string())
    };
    cpus.iter().map(on_core).collect()
}

fn cores(files: &impl Files, online: &CpuSet, allowed: &CpuSet) -> Finding {
    let on = match by_core(files, online) {
        Some(cores) => format!(" on {} cores", cores.len()),
        None => String::new(),
    };
    let found = format!(
        "{} logical processors{on} ({online}); this process may use {} ({allowed})",
        online.len(),
        allowed.len()
    );
    Finding::judged(
        "cores",
        allowed.len() > 1,
        found,
        "A real-time thread wants a core of its own, beside one for the rest of the system; each worker wants one more.",
        "Start the program with more cores: taskset -c, AllowedCPUs= in systemd, --cpuset-cpus of a container.",
    )
}

fn siblings(files: &impl Files, allowed: &CpuSet) -> Finding {
    let name = "SMT siblings";
    let meaning =
        "Two logical processors of one core slow each other down, by times that nobody can foresee.";
    let Some(cores) = by_core(files, allowed) else {
        return Finding::unknown(name, "the system does not tell which processors share a core", meaning);
    };
    let shared: Vec<_> = cores.into_iter().filter(|core| core.contains([',', '-'])).collect();
    let found = match shared.as_slice() {
        [] => "no two processors of this process share a core".to_owned(),
        shared => format!("these share a core: {}", shared.join(" and ")),
    };
    Finding::judged(
        name,
        shared.is_empty(),
        found,
        meaning,
        "echo off > /sys/devices/system/cpu/smt/control, or leave one of two siblings without work.",
    )
}

fn isolated(files: &impl Files, allowed: &CpuSet) -> Finding {
    let meaning = "The scheduler puts no other thread on isolated cores.";
    let at_boot = listed(files, &format!("{CPU}/isolated"));
    let by_cpuset = listed(files, "/sys/fs/cgroup/cpuset.cpus.isolated");
    if at_boot.is_none() && by_cpuset.is_none() {
        return Finding::unknown("isolated cores", "the system does not tell", meaning);
    }
    let isolated = at_boot.unwrap_or_default().union(&by_cpuset.unwrap_or_default());
    let found = match isolated.is_empty() {
        true => "none".to_owned(),
        false => format!("{isolated}; of these this process may use {}", isolated.intersection(allowed)),
    };
    Finding::judged(
        "isolated cores",
        !isolated.is_empty(),
        found,
        meaning,
        "Boot with isolcpus=managed_irq,domain,LIST, or use a cpuset with cpuset.cpus.partition=isolated; then bind threads \
         there.",
    )
}

fn without_tick(files: &impl Files) -> Finding {
    let name = "cores without tick";
    let meaning = "On these cores (nohz_full) the kernel does not interrupt a thread that runs alone.";
    match listed(files, &format!("{CPU}/nohz_full")) {
        None => Finding::unknown(name, "the kernel has no nohz_full", meaning),
        Some(cpus) => Finding::judged(
            name,
            !cpus.is_empty(),
            cpus.to_string(),
            meaning,
            "Boot with nohz_full=LIST rcu_nocbs=LIST.",
        ),
    }
}

fn governor(files: &impl Files, allowed: &CpuSet) -> Finding {
    let name = "frequency governor";
    let meaning = "A core that changes its frequency computes the same frame in times that differ by a factor of two or more.";
    let of_cpu = |cpu| files.text(&format!("{CPU}/cpu{cpu}/cpufreq/scaling_governor"));
    let governors: BTreeSet<_> = allowed.iter().filter_map(of_cpu).collect();
    if governors.is_empty() {
        return Finding::unknown(
            name,
            "the kernel does not set frequencies: firmware or a host does",
            meaning,
        );
    }
    let found = governors.iter().map(String::as_str).collect::<Vec<_>>().join(", ");
    Finding::judged(name, found == "performance", found, meaning, "cpupower frequency-set -g performance")
}

/// The longest exit latency of an enabled idle state, µs.
fn idle_exit_latency_us(files: &impl Files, cpu: usize) -> Option<u64> {
    let state = |index| {
        let folder = format!("{CPU}/cpu{cpu}/cpuidle/state{index}");
        let latency: u64 = files.text(&format!("{folder}/latency"))?.parse().ok()?;
        let is_disabled = files.text(&format!("{folder}/disable")).is_some_and(|text| text == "1");
        Some(if is_disabled { 0 } else { latency })
    };
    (0..IDLE_STATES_MAX).map_while(state).max()
}

fn idle_states(files: &impl Files, allowed: &CpuSet) -> Finding {
    let name = "idle states";
    let meaning =
        "A core that sleeps deeply takes this long to wake up, before the first instruction of a frame.";
    match allowed.iter().filter_map(|cpu| idle_exit_latency_us(files, cpu)).max() {
        None => Finding::unknown(name, "the kernel tells of none: firmware or a host decides", meaning),
        Some(latency) => Finding::judged(
            name,
            latency <= IDLE_EXIT_LATENCY_MAX_US,
            format!("up to {latency} µs to wake up from the deepest one"),
            meaning,
            "Keep /dev/cpu_dma_latency open with a 0 written to it while the simulation runs, or boot with idle=poll.",
        ),
    }
}

/// Finding about a virtual machine.
pub(crate) fn virtual_machine(files: &impl Files) -> Finding {
    let name = "virtual machine";
    let meaning = "On a virtual machine the host decides when a processor runs; nothing below can promise more than the host.";
    let Some(info) = files.text("/proc/cpuinfo") else {
        return Finding::unknown(name, "the system does not tell", meaning);
    };
    let flags = info.lines().find(|line| line.starts_with("flags")).unwrap_or_default();
    match flags.split_whitespace().any(|flag| flag == "hypervisor") {
        true => Finding::new(name, State::Info, "yes".to_owned(), meaning),
        false => Finding::new(name, State::Good, "no".to_owned(), meaning),
    }
}
