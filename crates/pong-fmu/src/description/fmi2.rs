//! `modelDescription.xml` of FMI 2.0.

use super::common::{Structure, TOOL, write_categories, write_experiment, write_units, write_variables};
use super::xml::Xml;
use crate::unit::Unit;

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
    // Variables are numbered from 1, and a rate follows its state, so the number of the state is the index of
    // the rate.
    write_variables(
        &mut xml,
        unit,
        |rate| rate,
        |xml, variable, general, typed| {
            xml.open("ScalarVariable", general);
            xml.empty(if variable.is_flag() { "Boolean" } else { "Real" }, typed);
            xml.close("ScalarVariable");
        },
    );
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
