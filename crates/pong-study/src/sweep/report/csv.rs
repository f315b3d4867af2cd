//! Tables for programs.

use crate::sweep::errors::Quantity;
use crate::sweep::level::motion_name;
use crate::sweep::study::{Answer, Row, Study};
use pong_record::csv_name;
use std::fmt::Write as _;

/// One line per level: its settings, its errors, its times.
pub fn csv(study: &Study) -> String {
    let head = format!("{},median_us,p99_us,spread,on_front,cheapest\n", heading());
    study.rows.iter().enumerate().fold(head, |mut text, (index, row)| {
        let times = row.times.as_ref().map_or(",,".to_owned(), |times| {
            let us = |ns: u64| ns as f64 / 1e3;
            format!("{},{},{}", us(times.median_ns()), us(times.tail_ns()), times.spread())
        });
        let cheapest = study.cheapest == Some(index);
        let _ = writeln!(text, "{},{times},{},{cheapest}", line(study, row), row.on_front);
        text
    })
}

/// The table without times and values derived from them: the same bytes from every run of a study.
pub fn errors_csv(study: &Study) -> String {
    study.rows.iter().fold(heading() + "\n", |text, row| text + &line(study, row) + "\n")
}

fn heading() -> String {
    let names: Vec<&str> = Quantity::ALL.iter().map(|quantity| quantity.name()).collect();
    let levers = "level,integrator,step_s,friction,alternative,bounds,leaf,workers,calls_per_frame";
    format!(
        "{levers},{},worst,position_m,angle_rad,incomplete_steps,diverged_s,same_bits,hash",
        names.join(",")
    )
}

fn line(study: &Study, row: &Row) -> String {
    let level = &row.level;
    let levers = [
        csv_name(&row.name),
        csv_name(&motion_name(level.motion)),
        format!("{:?}", study.plan.frames.frame_s / f64::from(level.steps_per_frame)),
        if level.frictionless { "none" } else { "model" }.to_owned(),
        csv_name(level.alternative.as_deref().unwrap_or("")),
        level.bounds.as_ref().map_or("model", |kind| kind.name()).to_owned(),
        level.leaf.map_or("model".to_owned(), |most| most.to_string()),
        level.workers.to_string(),
        level.calls_per_frame().to_string(),
    ];
    let same = study.same_bits(row).map_or(String::new(), |same| same.to_string());
    let answer = match &row.answer {
        Answer::Diverged { time_s } => format!(",,,,,,,,,{time_s:?},{same},"),
        Answer::Reached { errors, hash, incomplete } => {
            let relative: Vec<String> =
                Quantity::ALL.iter().map(|q| format!("{:?}", errors.of(*q))).collect();
            let worst = errors.worst(&study.of);
            let (position, angle) = (errors.position_m, errors.angle_rad);
            format!(
                "{},{worst:?},{position:?},{angle:?},{incomplete},,{same},{hash:016x}",
                relative.join(",")
            )
        }
    };
    format!("{},{answer}", levers.join(","))
}
