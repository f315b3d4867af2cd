//! `modelDescription.xml` of FMI 2.0.

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
            ("fmiVersion", "2.0"),
            ("modelName", &unit.name),
            ("guid", token),
            ("description", "Contact of rigid bodies"),
            ("generationTool", TOOL),
            ("variableNamingConvention", "structured"),
            ("numberOfEventIndicators", "0"),
        ],
    );
    let common = [
        ("modelIdentifier", identifier),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
    ];
    let exchange =
        [("completedIntegratorStepNotNeeded", "false"), ("providesDirectionalDerivative", "false")];
    let steps = [
        ("canHandleVariableCommunicationStepSize", "true"),
        ("canInterpolateInputs", "false"),
        ("providesDirectionalDerivative", "false"),
    ];
    xml.empty("ModelExchange", &[&common[..], &exchange[..]].concat());
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
        ("Outputs", &structure.outputs),
        ("Derivatives", &structure.derivatives),
        ("InitialUnknowns", &structure.initial),
    ];
    for (name, places) in lists.into_iter().filter(|(_, places)| !places.is_empty()) {
        xml.open(name, &[]);
        for place in places {
            xml.empty("Unknown", &[("index", &(place + 1).to_string())]);
        }
        xml.close(name);
    }
    xml.close("ModelStructure");
    xml.close("fmiModelDescription");
    xml.text
}

/// Variables are counted from 1; a derivative stands behind its state.
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
    xml.open("ScalarVariable", &attributes);
    let start = variable.start.map(|start| format!("{start:?}"));
    let nominal = variable.nominal.map(|nominal| format!("{nominal:?}"));
    let mut typed: Vec<(&str, &str)> = Vec::new();
    if !variable.unit.is_empty() {
        typed.push(("unit", variable.unit));
    }
    typed.extend(nominal.as_deref().map(|nominal| ("nominal", nominal)));
    typed.extend(start.as_deref().map(|start| ("start", start)));
    if matches!(variable.slot, Slot::Rate(_)) {
        typed.push(("derivative", &reference));
    }
    if is_reinitialized(&variable.name, variable.slot) {
        typed.push(("reinit", "true"));
    }
    xml.empty(if variable.is_flag() { "Boolean" } else { "Real" }, &typed);
    xml.close("ScalarVariable");
}
