//! Preemption and clock source of the kernel.

use crate::cores::virtual_machine;
use crate::{Files, Finding, State};

pub(crate) fn examine(files: &impl Files) -> Vec<Finding> {
    vec![preemption(files), timer_slack(files), clock_source(files), virtual_machine(files)]
}

/// Preemption model built into the kernel, from `/proc/version`, and the mode selected in a kernel with
/// dynamic preemption.
fn preemption_model(files: &impl Files) -> Option<String> {
    if files.text("/sys/kernel/realtime").as_deref() == Some("1") {
        return Some("PREEMPT_RT".to_owned());
    }
    let version = files.text("/proc/version")?;
    let has = |word| version.split_whitespace().any(|found| found == word);
    // The selected mode is in parentheses: "none voluntary (full)".
    let debug = files.text("/sys/kernel/debug/sched/preempt");
    let in_use = debug.as_deref().and_then(|modes| modes.split_once('(')?.1.split_once(')'));
    let command_line = files.text("/proc/cmdline").unwrap_or_default();
    let told = command_line.split_whitespace().filter_map(|word| word.strip_prefix("preempt=")).next_back();
    let model = if has("PREEMPT_RT") || has("PREEMPT_RT,") {
        "PREEMPT_RT".to_owned()
    } else if has("PREEMPT_DYNAMIC") {
        match in_use.map(|(mode, _)| mode).or(told) {
            Some(mode) => format!("PREEMPT_DYNAMIC, {mode}"),
            None => "PREEMPT_DYNAMIC, in the mode that it was built with".to_owned(),
        }
    } else if has("PREEMPT") {
        "PREEMPT".to_owned()
    } else {
        "not preemptible, or only at chosen places".to_owned()
    };
    Some(model)
}

fn preemption(files: &impl Files) -> Finding {
    let name = "kernel preemption";
    let meaning = "A kernel without PREEMPT_RT finishes some of its own work before it runs a real-time thread: up to milliseconds.";
    match preemption_model(files) {
        None => Finding::unknown(name, "the system does not tell", meaning),
        Some(model) => Finding::judged(
            name,
            model == "PREEMPT_RT",
            model,
            meaning,
            "Install a kernel with PREEMPT_RT (on Debian linux-image-rt-amd64), or boot one with PREEMPT_DYNAMIC with \
             preempt=full.",
        ),
    }
}

fn timer_slack(files: &impl Files) -> Finding {
    let name = "timer slack";
    let meaning = "A sleep of a thread without real-time priority may end this much later, so that the kernel can wake several at \
                   once. Threads of SCHED_FIFO have none.";
    match files.text("/proc/self/timerslack_ns").and_then(|text| text.parse::<u64>().ok()) {
        None => Finding::unknown(name, "the system does not tell", meaning),
        Some(slack) => Finding::new(name, State::Info, format!("{} µs", slack as f64 / 1e3), meaning),
    }
}

fn clock_source(files: &impl Files) -> Finding {
    let name = "clock source";
    let meaning = "A program reads these clocks without a call of the kernel: tsc, kvm-clock, hyperv_clocksource_tsc_page, \
                   arch_sys_counter. Any other costs a microsecond each time.";
    match files.text("/sys/devices/system/clocksource/clocksource0/current_clocksource") {
        None => Finding::unknown(name, "the system does not tell", meaning),
        Some(source) => {
            let quick = ["tsc", "kvm-clock", "hyperv_clocksource_tsc_page", "arch_sys_counter"];
            Finding::judged(
                name,
                quick.contains(&source.as_str()),
                source,
                meaning,
                "Find out in the kernel's messages (dmesg) why it gave up tsc; boot with tsc=reliable only if the hardware is \
                 known to be sound.",
            )
        }
    }
}
