//! `modelDescription.xml` of FMI 3.0.

use super::common::{
    Structure, TOOL, causality_name, is_reinitialized, variability, write_categories, write_experiment,
    write_units,
};
use super::xml::Xml;
use crate::unit::Unit;
use crate::variables::{Slot, Variable};

pub(super) fn describe(unit: &Unit, identifier: &str, token: &str) -> String {
    let mut xml = Xml::new();
    xml.open(
        "fmiModelDescription",
        &[
            ("fmiVersion", "3.0"),
            ("modelName", &unit.name),
            ("instantiationToken", token),
            ("description", "Contact of rigid bodies"),
            ("generationTool", TOOL),
            ("variableNamingConvention", "structured"),
        ],
    );
    let step = format!("{:?}", unit.simulation.step_length());
    let common = [
        ("modelIdentifier", identifier),
        ("canGetAndSetFMUState", "true"),
        ("canSerializeFMUState", "true"),
        ("providesDirectionalDerivatives", "false"),
    ];
    let steps = [
        ("canHandleVariableCommunicationStepSize", "true"),
        ("fixedInternalStepSize", step.as_str()),
        ("hasEventMode", "false"),
    ];
    xml.empty("ModelExchange", &[&common[..], &[("needsCompletedIntegratorStep", "true")]].concat());
    xml.empty("CoSimulation", &[&common[..], &steps[..]].concat());
    write_units(&mut xml);
    write_categories(&mut xml);
    write_experiment(&mut xml, unit);
    xml.open("ModelVariables", &[]);
    for (place, variable) in unit.variables.list.iter().enumerate() {
        write_variable(&mut xml, place, variable);
    }
    xml.close("ModelVariables");
    let structure = Structure::new(&unit.variables);
    xml.open("ModelStructure", &[]);
    let lists = [
        ("Output", &structure.outputs),
        ("ContinuousStateDerivative", &structure.derivatives),
        ("InitialUnknown", &structure.initial),
    ];
    for (name, places) in lists {
        for place in places {
            xml.empty(name, &[("valueReference", &place.to_string())]);
        }
    }
    xml.close("ModelStructure");
    xml.close("fmiModelDescription");
    xml.text
}

/// A derivative stands behind its state.
fn write_variable(xml: &mut Xml, place: usize, variable: &Variable) {
    let reference = place.to_string();
    let (varies, initial) = variability(variable.causality, variable.is_flag());
    let mut attributes = vec![
        ("name", variable.name.as_str()),
        ("valueReference", &reference),
        ("description", &variable.description),
        ("causality", causality_name(variable.causality)),
        ("variability", varies),
    ];
    attributes.extend(initial.map(|initial| ("initial", initial)));
    let start = variable.start.map(|start| format!("{start:?}"));
    let nominal = variable.nominal.map(|nominal| format!("{nominal:?}"));
    let state = (place.max(1) - 1).to_string();
    if !variable.unit.is_empty() {
        attributes.push(("unit", variable.unit));
    }
    attributes.extend(nominal.as_deref().map(|nominal| ("nominal", nominal)));
    attributes.extend(start.as_deref().map(|start| ("start", start)));
    if matches!(variable.slot, Slot::Rate(_)) {
        attributes.push(("derivative", &state));
    }
    if is_reinitialized(&variable.name, variable.slot) {
        attributes.push(("reinit", "true"));
    }
    xml.empty(if variable.is_flag() { "Boolean" } else { "Float64" }, &attributes);
}
