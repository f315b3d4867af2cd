//! Documentation page of an FMU: its purpose and its variables.

use super::xml::escaped;
use crate::unit::Unit;

const HEAD: &str = "<!DOCTYPE html>
<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Contact of rigid bodies</title>
<style>body{font-family:sans-serif;max-width:60em;margin:2em auto}td,th{text-align:left;padding:0 1em 0 0}</style></head><body>
";

/// `documentation/index.html`.
pub(crate) fn page(unit: &Unit) -> String {
    let inputs = unit.input_bodies();
    let moved = match inputs.is_empty() {
        true => "The FMU moves all bodies.".to_owned(),
        false => format!("The importer moves these bodies: {}.", inputs.join(", ")),
    };
    let mut text = format!(
        "{HEAD}<h1>{}</h1>\n<p>Contact of rigid bodies, by Pong {}. {}</p>\n<p>All units are SI. Vectors are along the axes of \
         the common frame. Quaternions are w, x, y, z and take components of a group to common components. Wrenches are about \
         the origin of the group.</p>\n<p>Model Exchange: call CompletedIntegratorStep after every step that is accepted; \
         friction remembers nothing otherwise. Co-Simulation: the step inside is {:?} s; use communication steps that are whole \
         multiples of it.</p>\n<table><tr><th>variable</th><th>is</th><th>unit</th><th>start</th><th></th></tr>\n",
        escaped(&unit.name),
        env!("CARGO_PKG_VERSION"),
        escaped(&moved),
        unit.simulation.step_length(),
    );
    for variable in &unit.variables.list {
        text += &format!(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            escaped(&variable.name),
            <&str>::from(variable.causality),
            variable.unit,
            variable.start.map_or_else(String::new, |start| format!("{start:?}")),
            escaped(&variable.description),
        );
    }
    text + "</table></body></html>\n"
}
