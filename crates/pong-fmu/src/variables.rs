//! The variables of an FMU: a table for writing the description and finding values. A value reference is an
//! index in the table.

use crate::names::structured;
use crate::surfaces::{Factor, ScaledSurface};
use pong_executive::{BodyId, Motion, RigidBody, Simulation};

/// Number of values of a motion: position, orientation (w, x, y, z), linear velocity, angular velocity.
pub(crate) const MOTION_NUMBERS: usize = 13;
/// Number of values of a wrench: force, moment.
pub(crate) const WRENCH_NUMBERS: usize = 6;

/// Role of a variable for the importer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub(crate) enum Causality {
    Independent,
    Parameter,
    Input,
    Output,
    Local,
}

/// Location of the value of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Slot {
    Time,
    /// Index in [`Variables::parameters`].
    Parameter(usize),
    /// Index in [`Variables::inputs`].
    Input(usize),
    /// Index of a continuous state.
    State(usize),
    /// Derivative of that state.
    Rate(usize),
    /// Pose and twist of a body.
    Motion(BodyId, usize),
    /// Contact wrench on a body.
    Wrench(BodyId, usize),
    /// Mean contact wrench over the last communication step.
    MeanWrench(BodyId, usize),
    /// Number of contacts.
    Count,
    LargestDepth,
    /// A Boolean.
    Flag(Flag),
}

/// Flags that change only at events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flag {
    Touching,
    Tunnelled,
    LeftOut,
    DeepInMesh,
}

/// Meaning of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Parameter {
    /// A number of the initial motion of a body.
    Start(BodyId, usize),
    /// A factor of a surface: index of the scaled surface, index of the factor, and the factor.
    Scale(usize, usize, Factor),
}

/// Meaning of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Input {
    /// A number of the motion of a body.
    Motion(BodyId, usize),
    /// A number of the wrench applied to a free body.
    Applied(BodyId, usize),
}

/// One variable.
#[derive(Clone, Debug)]
pub(crate) struct Variable {
    pub name: String,
    pub description: String,
    /// Unit; empty if it has none.
    pub unit: &'static str,
    pub causality: Causality,
    pub slot: Slot,
    /// Start value of parameters and inputs, in the variable's unit.
    pub start: Option<f64>,
    /// Nominal value of states, in the variable's unit.
    pub nominal: Option<f64>,
}

/// All variables of a scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct Variables {
    pub list: Vec<Variable>,
    pub parameters: Vec<Parameter>,
    pub parameter_starts: Vec<f64>,
    pub inputs: Vec<Input>,
    pub input_starts: Vec<f64>,
    /// Nominal values of the continuous states.
    pub nominals: Vec<f64>,
}

/// Parts of a motion: name, length, unit, description.
const MOTION: [(&str, usize, &str, &str); 4] = [
    ("position", 3, "m", "Position of the origin of"),
    ("orientation", 4, "", "Orientation (quaternion w, x, y, z; group to common components) of"),
    ("linear_velocity", 3, "m/s", "Velocity of the origin of"),
    ("angular_velocity", 3, "rad/s", "Angular velocity along the common axes of"),
];
const STATE: [(&str, usize, &str, &str, &str); 4] = [
    ("mass_center", 3, "m", "m/s", "Mass centre of"),
    ("velocity", 3, "m/s", "m/s2", "Velocity of the mass centre of"),
    ("orientation", 4, "", "1/s", "Orientation (quaternion w, x, y, z; group to common components) of"),
    (
        "angular_momentum",
        3,
        "kg.m2/s",
        "N.m",
        "Angular momentum about the mass centre, along the common axes, of",
    ),
];

impl Variables {
    /// The variables of a scene; bodies moved by the importer are already marked as led.
    pub fn new(
        simulation: &Simulation,
        inputs: &[BodyId],
        surfaces: &[ScaledSurface],
        step_means: bool,
    ) -> Self {
        let mut variables = Self::default();
        variables.add("time".to_owned(), "Time".to_owned(), "s", Causality::Independent, Slot::Time, None);
        let mut flag = |name: &str, what: &str, slot| {
            variables.add(format!("contact.{name}"), what.to_owned(), "", Causality::Output, slot, None);
        };
        flag("touching", "Whether anything touches; changes at an event", Slot::Flag(Flag::Touching));
        flag(
            "tunnelled",
            "Whether something went through something else in the last step",
            Slot::Flag(Flag::Tunnelled),
        );
        flag(
            "left_out",
            "Whether contacts were left out of the last step because the contact capacity is too small",
            Slot::Flag(Flag::LeftOut),
        );
        flag(
            "deep_in_mesh",
            "Whether a solid was deeper in a mesh than its facets push in the last step",
            Slot::Flag(Flag::DeepInMesh),
        );
        flag("count", "Number of contacts; no integer, for those change at events alone", Slot::Count);
        let depth = "Largest depth of a contact";
        variables.add(
            "contact.largest_depth".to_owned(),
            depth.to_owned(),
            "m",
            Causality::Output,
            Slot::LargestDepth,
            None,
        );
        for (id, body) in simulation.bodies() {
            variables.add_body(simulation, id, body, (inputs.contains(&id), step_means));
        }
        variables.add_states(simulation);
        for (place, surface) in surfaces.iter().enumerate() {
            for (number, (factor, what, value)) in surface.factors.iter().enumerate() {
                let name = format!("surface.{}.{}", structured(&surface.path), <&str>::from(factor));
                let description = format!(
                    "Factor on the {what}, of surface `{}`, which is {value} in the model",
                    surface.path
                );
                variables.add_parameter(name, description, "", Parameter::Scale(place, number, *factor), 1.0);
            }
        }
        variables
    }

    fn add(
        &mut self,
        name: String,
        description: String,
        unit: &'static str,
        causality: Causality,
        slot: Slot,
        start: Option<f64>,
    ) {
        self.list.push(Variable { name, description, unit, causality, slot, start, nominal: None });
    }

    fn add_parameter(
        &mut self,
        name: String,
        description: String,
        unit: &'static str,
        parameter: Parameter,
        start: f64,
    ) {
        let slot = Slot::Parameter(self.parameters.len());
        self.parameters.push(parameter);
        self.parameter_starts.push(start);
        self.add(name, description, unit, Causality::Parameter, slot, Some(start));
    }

    fn add_input(&mut self, name: String, description: String, unit: &'static str, input: Input, start: f64) {
        let slot = Slot::Input(self.inputs.len());
        self.inputs.push(input);
        self.input_starts.push(start);
        self.add(name, description, unit, Causality::Input, slot, Some(start));
    }

    fn add_body(
        &mut self,
        simulation: &Simulation,
        id: BodyId,
        body: &RigidBody,
        (is_input, step_means): (bool, bool),
    ) {
        let path = structured(&body.name);
        let start = motion_numbers(simulation, id);
        let mut number = 0;
        for (part, length, unit, what) in MOTION {
            for index in 1..=length {
                let (name, what) = (format!("{path}.{part}[{index}]"), format!("{what} `{}`", body.name));
                if is_input {
                    self.add_input(name, what, unit, Input::Motion(id, number), start[number]);
                } else {
                    self.add(name, what, unit, Causality::Output, Slot::Motion(id, number), None);
                }
                number += 1;
            }
        }
        let forces = |about: &str| {
            [
                ("force", "N", format!("{about} force on")),
                ("moment", "N.m", format!("{about} moment about the origin of")),
            ]
        };
        for (block, (part, unit, what)) in forces("Contact").into_iter().enumerate() {
            for index in 0..3 {
                let name = format!("{path}.contact_{part}[{}]", index + 1);
                let what = format!("{what} `{}`, along the common axes", body.name);
                self.add(name, what, unit, Causality::Output, Slot::Wrench(id, 3 * block + index), None);
            }
        }
        let means = forces("Mean contact").into_iter().enumerate().filter(|_| step_means);
        for (block, (part, unit, what)) in means {
            for index in 0..3 {
                let name = format!("{path}.mean_contact_{part}[{}]", index + 1);
                let what =
                    format!("{what} `{}` over the last communication step, along the common axes", body.name);
                self.add(name, what, unit, Causality::Output, Slot::MeanWrench(id, 3 * block + index), None);
            }
        }
        let Motion::Free(_) = &body.motion else { return };
        for (block, (part, unit, what)) in forces("Applied").into_iter().enumerate() {
            for index in 0..3 {
                let name = format!("{path}.applied_{part}[{}]", index + 1);
                let what =
                    format!("{what} `{}`, along the common axes, beside the loads of the scene", body.name);
                self.add_input(name, what, unit, Input::Applied(id, 3 * block + index), 0.0);
            }
        }
        let mut number = 0;
        for (part, length, unit, what) in MOTION {
            for index in 1..=length {
                let what = format!("{what} `{}` at the start", body.name);
                let name = format!("{path}.start.{part}[{index}]");
                self.add_parameter(name, what, unit, Parameter::Start(id, number), start[number]);
                number += 1;
            }
        }
    }

    /// Adds the states, each followed by its derivative.
    fn add_states(&mut self, simulation: &Simulation) {
        for id in simulation.free_bodies() {
            let body = simulation.bodies().nth(id.index()).expect("a free body is a body").1;
            let path = structured(&body.name);
            // Angular momentum at one radian a second; the other states are of order one.
            let momentum = body.mass().map_or(1.0, |mass| mass.inertia.amax());
            for (part, length, unit, rate_unit, what) in STATE {
                for index in 1..=length {
                    let name = format!("{path}.state.{part}[{index}]");
                    let what = format!("{what} `{}`", body.name);
                    let (place, nominal) =
                        (self.nominals.len(), if part == "angular_momentum" { momentum } else { 1.0 });
                    self.nominals.push(nominal);
                    let rate = (format!("der({name})"), format!("Rate of change: {what}"));
                    self.add(name, what, unit, Causality::Local, Slot::State(place), None);
                    self.list.last_mut().expect("just added").nominal = Some(nominal);
                    self.add(rate.0, rate.1, rate_unit, Causality::Local, Slot::Rate(place), None);
                }
            }
        }
    }

    /// The variable of a value reference.
    pub fn at(&self, reference: u32) -> Option<&Variable> {
        self.list.get(reference as usize)
    }
}

impl Variable {
    pub fn is_flag(&self) -> bool {
        matches!(self.slot, Slot::Flag(_))
    }
}

/// Present pose and twist of a body in the simulation.
pub(crate) fn motion_numbers(simulation: &Simulation, body: BodyId) -> [f64; MOTION_NUMBERS] {
    let (pose, twist) = (simulation.pose(body), simulation.twist(body));
    let (p, q, v, w) = (&pose.position, &pose.orientation, &twist.linear, &twist.angular);
    [p.x, p.y, p.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z, w.x, w.y, w.z]
}
