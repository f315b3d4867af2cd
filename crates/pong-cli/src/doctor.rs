//! `pong doctor`: real-time properties of the machine.

use crate::terminal::{Outcome, failure, print};
use crate::text::number;
use pong_doctor::{BIN_BOUNDS_US, Finding, Latency, State, examine_this_machine, measure, try_fifo};
use serde::Serialize;
use std::fmt::Write as _;
use std::process::ExitCode;
use std::time::Duration;

/// Reports what this machine grants a real-time program: cores, clocks, limits, priorities, and how late
/// threads wake up.
///
/// Each line has the finding, its meaning and, where something can be better, the cure. Exit status: 0 if the
/// machine could be examined, whatever was found; with --strict 1 if a line has a cure. Measured times are
/// never judged. docs/realtime.md explains the lines.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// One JSON object instead of text.
    #[arg(long)]
    json: bool,
    /// Duration of measuring each kind of waking up, in s; 0 measures nothing.
    #[arg(long, value_name = "S", default_value_t = 1.0, value_parser = seconds)]
    seconds: f64,
    /// Exit status 1 if the machine does not grant something; measured times do not count.
    #[arg(long)]
    strict: bool,
}

/// Longest measurement, s: an hour.
const SECONDS_MAX: f64 = 3600.0;

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if (0.0..=SECONDS_MAX).contains(&seconds) => Ok(seconds),
        _ => Err(format!("must be a number of seconds from 0 to {SECONDS_MAX}")),
    }
}

/// Output of `--json`.
#[derive(Serialize)]
struct Report {
    format: &'static str,
    version: u32,
    pong: &'static str,
    findings: Vec<Finding>,
    /// Upper bounds of the bins of the latencies, in µs; the last bin has none.
    bin_bounds_us: [u64; BIN_BOUNDS_US.len()],
    latencies: Vec<Latency>,
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let fifo = try_fifo();
    let fifo_is_granted = fifo.is_ok();
    let mut report = Report {
        format: "pong-doctor",
        version: 1,
        pong: env!("CARGO_PKG_VERSION"),
        findings: examine_this_machine(fifo),
        bin_bounds_us: BIN_BOUNDS_US,
        latencies: Vec::new(),
    };
    if arguments.seconds > 0.0 {
        let measured = measure(Duration::from_secs_f64(arguments.seconds), fifo_is_granted);
        report.latencies = measured.map_err(|reason| failure(format!("nothing was measured: {reason}")))?;
    }
    let advice = report.findings.iter().filter(|finding| finding.state == State::Advice).count();
    if arguments.json {
        let json = serde_json::to_string_pretty(&report)
            .map_err(|reason| failure(format!("the report cannot be written as JSON: {reason}")))?;
        print(&format!("{json}\n"));
    } else {
        print(&text(&report, advice));
    }
    Ok(if arguments.strict && advice > 0 { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

fn text(report: &Report, advice: usize) -> String {
    let mut text = String::new();
    for finding in &report.findings {
        let mark = match finding.state {
            State::Good => "ok     ",
            State::Advice => "advice ",
            State::Info => "info   ",
            State::Unknown => "unknown",
        };
        let _ = writeln!(text, "{mark} {:<18} {}", finding.name, finding.found);
        let _ = writeln!(text, "{:27}{}", "", finding.meaning);
        if let Some(cure) = finding.cure {
            let _ = writeln!(text, "{:27}Cure: {cure}", "");
        }
    }
    if !report.latencies.is_empty() {
        text.push_str(
            "\nHow late a thread runs, in µs, beside everything that runs now. These times are no verdict: measure again with\n\
             the simulation's load, and with cyclictest for hours.\n\n",
        );
        let _ = writeln!(
            text,
            "{:<29}{:>8}{:>8}{:>9}{:>9}{:>10}",
            "from release to running", "times", "missed", "median", "99 %", "largest"
        );
        for latency in &report.latencies {
            let _ = writeln!(
                text,
                "{:<29}{:>8}{:>8}{:>9}{:>9}{:>10}",
                latency.what,
                latency.samples,
                latency.missed,
                number(latency.median_us),
                number(latency.p99_us),
                number(latency.largest_us)
            );
        }
        text.push('\n');
        report.latencies.iter().for_each(|latency| histogram(&mut text, latency));
    }
    let _ = match advice {
        0 => writeln!(text, "\nThis machine grants everything that was looked at."),
        1 => writeln!(text, "\n1 line with a cure."),
        _ => writeln!(text, "\n{advice} lines with a cure."),
    };
    text
}

/// Bins that are not empty, on one line.
fn histogram(text: &mut String, latency: &Latency) {
    let bins = latency.bins.iter().enumerate().filter(|(_, count)| **count > 0).map(|(bin, count)| {
        match (bin.checked_sub(1).map(|below| BIN_BOUNDS_US[below]), BIN_BOUNDS_US.get(bin)) {
            (None, Some(bound)) => format!("below {bound}: {count}"),
            (Some(from), Some(bound)) => format!("{from} to {bound}: {count}"),
            (from, None) => format!("from {}: {count}", from.unwrap_or_default()),
        }
    });
    let _ = writeln!(text, "{:<29}{}", latency.what, bins.collect::<Vec<_>>().join(", "));
}
