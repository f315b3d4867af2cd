//! Common parts of the descriptions of both versions.

use super::xml::Xml;
use crate::unit::Unit;
use crate::variables::{Causality, Slot, Variable, Variables};

pub(super) const TOOL: &str = concat!("Pong ", env!("CARGO_PKG_VERSION"));
/// Relative tolerance proposed for solvers with step control: contact depths are small against positions.
const TOLERANCE: &str = "1e-8";

/// Counts of inputs, outputs, parameters and continuous states.
pub(crate) fn counts(unit: &Unit) -> [usize; 4] {
    let variables = &unit.variables;
    let of = |causality| variables.list.iter().filter(|variable| variable.causality == causality).count();
    [of(Causality::Input), of(Causality::Output), of(Causality::Parameter), variables.nominals.len()]
}

/// Categories of messages, with their purpose.
const LOG_CATEGORIES: [(&str, &str); 5] = [
    ("logEvents", "What an instance does; only if logging is on"),
    ("logStatusWarning", "What the author of scene and models should know"),
    ("logStatusDiscard", "Values or steps that were refused; others may succeed"),
    ("logStatusError", "Calls and files that were refused"),
    ("logStatusFatal", "Faults inside the library"),
];

/// Units by the exponents of their base units.
const UNITS: [(&str, &[(&str, &str)]); 10] = [
    ("s", &[("s", "1")]),
    ("1/s", &[("s", "-1")]),
    ("m", &[("m", "1")]),
    ("m/s", &[("m", "1"), ("s", "-1")]),
    ("m/s2", &[("m", "1"), ("s", "-2")]),
    ("rad/s", &[("rad", "1"), ("s", "-1")]),
    ("N", &[("kg", "1"), ("m", "1"), ("s", "-2")]),
    ("N.m", &[("kg", "1"), ("m", "2"), ("s", "-2")]),
    ("kg.m2/s", &[("kg", "1"), ("m", "2"), ("s", "-1")]),
    ("rad", &[("rad", "1")]),
];

pub(super) fn write_units(xml: &mut Xml) {
    xml.open("UnitDefinitions", &[]);
    for (name, exponents) in UNITS {
        xml.open("Unit", &[("name", name)]);
        xml.empty("BaseUnit", exponents);
        xml.close("Unit");
    }
    xml.close("UnitDefinitions");
}

pub(super) fn write_categories(xml: &mut Xml) {
    xml.open("LogCategories", &[]);
    for (name, description) in LOG_CATEGORIES {
        xml.empty("Category", &[("name", name), ("description", description)]);
    }
    xml.close("LogCategories");
}

pub(super) fn write_experiment(xml: &mut Xml, unit: &Unit) {
    let (stop, step) = (format!("{:?}", unit.duration), format!("{:?}", unit.simulation.step_length()));
    let attributes =
        [("startTime", "0.0"), ("stopTime", &stop), ("tolerance", TOLERANCE), ("stepSize", &step)];
    // A scene that only evaluates its initial state has no time span.
    xml.empty("DefaultExperiment", if unit.duration > 0.0 { &attributes } else { &attributes[2..] });
}

/// Writes the variables. `write` gets the common attributes of a variable, and those that FMI 2.0 writes at
/// its type. `state_of_rate` maps the index of a rate to the reference of its state in the attribute
/// `derivative`.
pub(super) fn write_variables(
    xml: &mut Xml,
    unit: &Unit,
    state_of_rate: fn(usize) -> usize,
    write: fn(&mut Xml, &Variable, Attributes<'_>, Attributes<'_>),
) {
    xml.open("ModelVariables", &[]);
    for (place, variable) in unit.variables.list.iter().enumerate() {
        let number = |value: Option<f64>| value.map(|value| format!("{value:?}"));
        let (start, nominal) = (number(variable.start), number(variable.nominal));
        let (reference, state) = (place.to_string(), state_of_rate(place).to_string());
        let (varies, initial) = variability(variable.causality, variable.is_flag());
        let mut general = vec![
            ("name", variable.name.as_str()),
            ("valueReference", &reference),
            ("description", &variable.description),
            ("causality", variable.causality.into()),
            ("variability", varies),
        ];
        general.extend(initial.map(|initial| ("initial", initial)));
        let mut typed = Vec::new();
        typed.extend((!variable.unit.is_empty()).then_some(("unit", variable.unit)));
        typed.extend(nominal.as_deref().map(|nominal| ("nominal", nominal)));
        typed.extend(start.as_deref().map(|start| ("start", start)));
        typed.extend(matches!(variable.slot, Slot::Rate(_)).then_some(("derivative", state.as_str())));
        typed.extend(is_reinitialized(&variable.name, variable.slot).then_some(("reinit", "true")));
        write(xml, variable, &general, &typed);
    }
    xml.close("ModelVariables");
}

/// Attributes of an element: names and values.
type Attributes<'a> = &'a [(&'a str, &'a str)];

/// Values of `variability` and, where it must be given, `initial`.
fn variability(causality: Causality, is_flag: bool) -> (&'static str, Option<&'static str>) {
    match causality {
        Causality::Independent | Causality::Input => ("continuous", None),
        Causality::Parameter => ("fixed", Some("exact")),
        Causality::Output if is_flag => ("discrete", Some("calculated")),
        Causality::Output | Causality::Local => ("continuous", Some("calculated")),
    }
}

/// Indices of the variables that the structure lists: outputs, derivatives, and variables calculated in
/// initialization.
pub(super) struct Structure {
    pub outputs: Vec<usize>,
    pub derivatives: Vec<usize>,
    pub initial: Vec<usize>,
}

impl Structure {
    pub fn new(variables: &Variables) -> Self {
        let places = |wanted: &dyn Fn(Slot, Causality) -> bool| {
            let list = variables.list.iter().enumerate();
            list.filter(|(_, v)| wanted(v.slot, v.causality)).map(|(place, _)| place).collect::<Vec<_>>()
        };
        Self {
            outputs: places(&|_, causality| causality == Causality::Output),
            derivatives: places(&|slot, _| matches!(slot, Slot::Rate(_))),
            initial: places(&|_, causality| matches!(causality, Causality::Output | Causality::Local)),
        }
    }
}

/// True if an event may reinitialise a state: quaternions are normalised.
fn is_reinitialized(name: &str, slot: Slot) -> bool {
    matches!(slot, Slot::State(_)) && name.contains(".state.orientation[")
}
