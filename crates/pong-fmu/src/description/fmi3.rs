//! `modelDescription.xml` of FMI 3.0.

use super::common::{Structure, TOOL, write_categories, write_experiment, write_units, write_variables};
use super::xml::Xml;
use crate::unit::Unit;

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
    // A rate follows its state.
    write_variables(
        &mut xml,
        unit,
        |rate| rate.saturating_sub(1),
        |xml, variable, general, typed| {
            xml.empty(if variable.is_flag() { "Boolean" } else { "Float64" }, &[general, typed].concat());
        },
    );
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
