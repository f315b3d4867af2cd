//! Values of a contact with a desired depth and restitution.

use super::arguments::Arguments;
use crate::text::number;
use pong_advise::{ContactAdvice, ContactWish, WrenchCoupling, advise_contact, critical_delay};

/// The advice for the desired depth and restitution.
pub(super) fn advice(
    arguments: &Arguments,
    mass: f64,
    step: Option<f64>,
    coupling: WrenchCoupling,
    speed: Option<f64>,
) -> Result<String, String> {
    let speed = speed.ok_or("--speed: a depth follows from the closing speed; give it")?;
    let (Some(depth), Some(restitution)) = (arguments.depth, arguments.restitution) else {
        return Err("--depth: give what is wanted, with --restitution".to_owned());
    };
    let accuracy = arguments.accuracy();
    let wish = ContactWish { mass, speed, depth, restitution, coupling, step, accuracy };
    let advice = advise_contact(&wish).map_err(|error| error.to_string())?;
    Ok(told(arguments, &wish, &advice))
}

fn told(arguments: &Arguments, wish: &ContactWish, advice: &ContactAdvice) -> String {
    let share = 1.0 / f64::from(arguments.contacts);
    let mut text = format!(
        "For {} m at {} m/s and a restitution of {}:\n",
        number(wish.depth),
        number(wish.speed),
        number(wish.restitution)
    );
    let mut line = |what: &str, value: f64, unit: &str| {
        text += &format!("  {what:<22}{} {unit}\n", number(value));
    };
    line("stiffness", advice.stiffness, "N/m");
    line("damping", advice.damping, "N·s/m");
    line("friction stiffness", advice.friction_stiffness, "N/m");
    line("friction damping", advice.friction_damping, "N·s/m");
    line("damping ratio", advice.damping_ratio, "");
    line("largest force", advice.peak_force, "N");
    line("touch to release", advice.duration, "s");
    line("accurate to", advice.accurate_step, "s");
    line("stable to", advice.stable_step, "s");
    line("critical delay", critical_delay(advice.stiffness, advice.damping, wish.mass), "s");
    text += &surface(advice, share, arguments.contacts);
    text += &verdict(wish, advice);
    text
}

/// The values in the notation of model files.
fn surface(advice: &ContactAdvice, share: f64, contacts: u32) -> String {
    let of = match contacts {
        1 => String::new(),
        _ => format!(", for each of {contacts} contacts that act together"),
    };
    format!(
        "  against a rigid partner{of}:\n    \"advised\": (stiffness: {:?}, normal: Linear(damping: {:?}), friction: \
         Bristle(mu: 0.3, stiffness: {:?}, damping: {:?}))\n  two equal surfaces take twice each value\n",
        share * advice.stiffness,
        share * advice.damping,
        share * advice.friction_stiffness,
        share * advice.friction_damping,
    )
}

fn verdict(wish: &ContactWish, advice: &ContactAdvice) -> String {
    let lag = wish.coupling.lag();
    let mut text = String::new();
    if lag > 0.0 {
        text += &format!(
            "  {} N·s/m of the damping make up for a wrench that acts {} frames late: the values are for a step of {} s\n",
            number(advice.stiffness * advice.step * lag),
            number(lag),
            number(advice.step)
        );
    }
    if advice.step <= advice.accurate_step {
        return text;
    }
    let worse = if advice.step >= advice.stable_step { "gains energy" } else { "is off" };
    text + &format!(
        "warning: at a step of {} s the bounce {worse}; shorten the step to {} s, or allow a depth of {} m\n",
        number(advice.step),
        number(advice.accurate_step),
        number(advice.least_depth)
    )
}
