//! An instance: a scene in one of the modes of the standard, in either version.
//!
//! Reading a value evaluates, setting one does not: an importer sets numbers one at a time, and a quaternion
//! is of unit length only when all four are set.
//!
//! A refused call leaves the instance unchanged.

use crate::flags::{Flags, Warnings};
use crate::refusal::Refusal;
use crate::unit::Unit;
use crate::variables::{
    Causality, Flag, Input, MOTION_NUMBERS, Parameter, Slot, WRENCH_NUMBERS, motion_numbers,
};
use pong_executive::{ExecutiveError, Pose, Simulation, Twist, Vec3, Wrench};

/// Largest deviation of a quaternion's norm from 1, as in the engine.
const NORM_ERROR_MAX: f64 = 1e-3;

/// Tolerated deviation of a communication step from whole steps of the scene, in steps: more than the
/// rounding of sums of many communication steps, and less than any intended step.
const STEP_TOLERANCE: f64 = 1e-6;

/// Most steps of the scene in one communication step: minutes of work, so that a wrong unit of time is
/// refused at once.
const STEPS_MAX: f64 = 1e8;

/// Interface type: who integrates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    ModelExchange,
    CoSimulation,
}

/// Modes of the standard for both interface types.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    Instantiated,
    Initialization,
    /// Model Exchange.
    Event,
    /// Model Exchange.
    Continuous,
    /// Co-Simulation.
    Step,
    Terminated,
}

impl Mode {
    fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "before initialization",
            Self::Initialization => "in initialization mode",
            Self::Event => "in event mode",
            Self::Continuous => "in continuous-time mode",
            Self::Step => "between communication steps",
            Self::Terminated => "after the end of the simulation",
        }
    }
}

/// Summary of the contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Summary {
    /// Number of contacts, without a unit.
    pub count: f64,
    /// Largest depth, m.
    pub largest_depth: f64,
}

/// Changes made by an event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct EventOutcome {
    pub states_changed: bool,
}

/// An instance.
pub(crate) struct Instance {
    pub(crate) unit: Unit,
    pub(crate) kind: Kind,
    pub(crate) mode: Mode,
    pub(crate) time: f64,
    pub(crate) parameters: Vec<f64>,
    pub(crate) inputs: Vec<f64>,
    pub(crate) states: Vec<f64>,
    pub(crate) rates: Vec<f64>,
    /// True if poses, wrenches and rates belong to the present values.
    pub(crate) is_current: bool,
    /// True if inputs were set that the simulation does not have yet.
    pub(crate) inputs_changed: bool,
    /// Summary of the last evaluation, if it was requested.
    pub(crate) summary: Option<Summary>,
    /// Mean contact wrench on every body over the last communication step; empty if there is none, and then
    /// the present wrenches are used instead.
    pub(crate) means: Vec<Wrench>,
    pub(crate) flags: Flags,
    /// The flags after the next event.
    pub(crate) next_flags: Flags,
    /// Flags already warned of in this run.
    warned: Warnings,
    /// Warnings to be logged.
    pub(crate) warnings: Vec<String>,
    /// Saved instant before a step that may fail.
    undo: Vec<u8>,
}

type Outcome<T = ()> = Result<T, Refusal>;

impl Instance {
    pub fn new(unit: Unit, kind: Kind) -> Self {
        let mut warnings = unit.warnings.clone();
        if kind == Kind::CoSimulation {
            warnings.extend(unit.simulation.step_warnings());
        }
        let states = unit.simulation.state_numbers();
        Self {
            kind,
            mode: Mode::Instantiated,
            time: 0.0,
            parameters: unit.variables.parameter_starts.clone(),
            inputs: unit.variables.input_starts.clone(),
            rates: vec![0.0; states.len()],
            states,
            is_current: false,
            inputs_changed: true,
            summary: None,
            means: Vec::new(),
            flags: Flags::default(),
            next_flags: Flags::default(),
            warned: Warnings::default(),
            warnings,
            undo: Vec::new(),
            unit,
        }
    }

    /// Resets to a new instance of the same unit.
    pub fn reset(&mut self) -> Outcome {
        let parameters = self.unit.variables.parameter_starts.clone();
        self.set_surfaces(&parameters)?;
        self.unit.simulation.restore(&self.unit.begin).map_err(of_simulation)?;
        self.parameters = parameters;
        self.inputs.clone_from(&self.unit.variables.input_starts);
        self.states = self.unit.simulation.state_numbers();
        (self.mode, self.time) = (Mode::Instantiated, 0.0);
        (self.is_current, self.inputs_changed, self.summary) = (false, true, None);
        self.means.clear();
        (self.flags, self.next_flags, self.warned) = Default::default();
        Ok(())
    }

    /// Refuses a call that belongs to other modes.
    pub fn expect_mode(&self, call: &str, modes: &[Mode]) -> Outcome {
        if modes.contains(&self.mode) {
            return Ok(());
        }
        let wanted: Vec<&str> = modes.iter().map(|mode| mode.name()).collect();
        Err(Refusal::error(format!(
            "{call}: the instance is {}; call it {}",
            self.mode.name(),
            wanted.join(" or ")
        )))
    }

    // ---- Values

    /// A number of type Real or Float64.
    pub fn number(&mut self, reference: u32) -> Outcome<f64> {
        let slot = self.slot(reference, false)?;
        if !matches!(slot, Slot::Time | Slot::Parameter(_) | Slot::Input(_) | Slot::State(_)) {
            self.evaluate()?;
        }
        if let Slot::State(_) = slot {
            self.start_values()?;
        }
        let simulation = &self.unit.simulation;
        Ok(match slot {
            Slot::Time => self.time,
            Slot::Parameter(place) => self.parameters[place],
            Slot::Input(place) => self.inputs[place],
            Slot::State(place) => self.current_states()[place],
            Slot::Rate(place) => self.rates[place],
            Slot::Motion(body, number) => motion_numbers(simulation, body)[number],
            Slot::Wrench(body, number) => component(&simulation.contact_wrench(body), number),
            Slot::MeanWrench(body, number) => {
                let mean = self.means.get(body.index()).copied();
                component(&mean.unwrap_or_else(|| simulation.contact_wrench(body)), number)
            }
            Slot::Count => self.summary().count,
            Slot::LargestDepth => self.summary().largest_depth,
            Slot::Flag(_) => unreachable!("flags were refused"),
        })
    }

    /// A Boolean.
    pub fn flag(&mut self, reference: u32) -> Outcome<bool> {
        let slot = self.slot(reference, true)?;
        if self.mode == Mode::Initialization {
            self.evaluate()?;
            self.flags = self.frame_flags();
        }
        Ok(match slot {
            Slot::Flag(Flag::Touching) => self.flags.touching,
            Slot::Flag(Flag::Tunnelled) => self.flags.tunnelled,
            Slot::Flag(Flag::LeftOut) => self.flags.left_out,
            Slot::Flag(Flag::DeepInMesh) => self.flags.deep_in_mesh,
            _ => unreachable!("only flags are left"),
        })
    }

    /// Sets numbers: all of them or, if one is refused, none.
    pub fn set_numbers(&mut self, references: &[u32], values: &[f64]) -> Outcome {
        for (reference, value) in references.iter().zip(values) {
            self.check_settable(*reference, *value)?;
        }
        for (reference, value) in references.iter().zip(values) {
            let slot = self.slot(*reference, false)?;
            let place = match slot {
                Slot::Parameter(place) => &mut self.parameters[place],
                Slot::Input(place) => &mut self.inputs[place],
                _ => unreachable!("refused above"),
            };
            if place.to_bits() == value.to_bits() {
                continue;
            }
            *place = *value;
            self.inputs_changed |= matches!(slot, Slot::Input(_));
            // Between communication steps outputs are those of the last step, whatever inputs are set for the
            // next.
            self.is_current &= self.mode == Mode::Step;
        }
        Ok(())
    }

    fn check_settable(&self, reference: u32, value: f64) -> Outcome {
        self.slot(reference, false)?;
        let variable = self.unit.variables.at(reference).expect("it has a slot");
        let name = &variable.name;
        match variable.causality {
            Causality::Parameter => {
                let modes = [Mode::Instantiated, Mode::Initialization];
                self.expect_mode(&format!("parameter `{name}`"), &modes)?;
            }
            Causality::Input if self.mode == Mode::Terminated => {
                self.expect_mode(&format!("input `{name}`"), &[Mode::Step, Mode::Event, Mode::Continuous])?;
            }
            Causality::Input => {}
            Causality::Independent | Causality::Output | Causality::Local => {
                return Err(Refusal::error(format!(
                    "`{name}`: it cannot be set; set parameters and inputs{}",
                    if variable.causality == Causality::Local { ", and states all at once" } else { "" }
                )));
            }
        }
        if !value.is_finite() {
            return Err(Refusal::discard(format!("`{name}`: it is set to {value}; give a finite number")));
        }
        if let Slot::Parameter(place) = variable.slot
            && let Parameter::Scale(..) = self.unit.variables.parameters[place]
            && value <= 0.0
        {
            return Err(Refusal::discard(format!(
                "`{name}`: it is set to {value}; give a factor above zero"
            )));
        }
        Ok(())
    }

    fn slot(&self, reference: u32, wants_flag: bool) -> Outcome<Slot> {
        let Some(variable) = self.unit.variables.at(reference) else {
            return Err(Refusal::error(format!(
                "value reference {reference}: no variable has it; take those of modelDescription.xml, 0 to {}",
                self.unit.variables.list.len() - 1
            )));
        };
        if variable.is_flag() != wants_flag {
            return Err(Refusal::error(format!(
                "`{}`: it is {}; use the function of that type",
                variable.name,
                if variable.is_flag() { "a Boolean" } else { "a floating-point number" }
            )));
        }
        Ok(variable.slot)
    }

    // ---- Initialization

    /// Sets the start time of the simulation.
    pub fn set_start(&mut self, time: f64) -> Outcome {
        self.expect_mode("start time", &[Mode::Instantiated])?;
        if !time.is_finite() {
            return Err(Refusal::error(format!("start time: it is {time} s; give a finite time")));
        }
        (self.time, self.is_current) = (time, false);
        Ok(())
    }

    pub fn enter_initialization(&mut self) -> Outcome {
        self.expect_mode("EnterInitializationMode", &[Mode::Instantiated])?;
        self.mode = Mode::Initialization;
        Ok(())
    }

    /// Commits the initial state.
    pub fn exit_initialization(&mut self) -> Outcome {
        self.expect_mode("ExitInitializationMode", &[Mode::Initialization])?;
        self.prepare()?;
        let simulation = &mut self.unit.simulation;
        match self.kind {
            Kind::ModelExchange => {
                simulation.accept_states(self.time, &self.states, &mut self.rates).map_err(of_simulation)?;
            }
            Kind::CoSimulation => simulation.commit_initial_states().map_err(of_simulation)?,
        }
        (self.is_current, self.summary) = (true, None);
        self.flags = self.frame_flags();
        self.next_flags = self.flags;
        self.mode = match self.kind {
            Kind::ModelExchange => Mode::Event,
            Kind::CoSimulation => Mode::Step,
        };
        self.warn_of(self.flags);
        Ok(())
    }

    /// Sets the simulation up again from the present parameters and inputs.
    fn prepare(&mut self) -> Outcome {
        let parameters = std::mem::take(&mut self.parameters);
        let prepared = self.prepare_with(&parameters);
        self.parameters = parameters;
        prepared
    }

    fn prepare_with(&mut self, parameters: &[f64]) -> Outcome {
        self.set_surfaces(parameters)?;
        let simulation = &mut self.unit.simulation;
        simulation.restore(&self.unit.begin).map_err(of_simulation)?;
        let variables = &self.unit.variables;
        let is_nominal = parameters == variables.parameter_starts && self.inputs == variables.input_starts;
        simulation.set_time(self.time).map_err(of_simulation)?;
        let mut place = 0;
        while let Some(Parameter::Start(body, _)) = variables.parameters.get(place) {
            let numbers = &parameters[place..place + MOTION_NUMBERS];
            if numbers != &variables.parameter_starts[place..place + MOTION_NUMBERS] {
                let found = simulation.bodies().nth(body.index());
                let thing = format!("start of `{}`", found.map_or("", |(_, body)| body.name.as_str()));
                let (pose, twist) = motion(numbers, &thing)?;
                simulation.set_motion(*body, pose, twist).map_err(of_simulation)?;
            }
            place += MOTION_NUMBERS;
        }
        self.inputs_changed = true;
        self.apply_inputs(self.time)?;
        let simulation = &mut self.unit.simulation;
        // The scene's preloads hold for the nominal initial state.
        let at_the_start = is_nominal && self.time == 0.0;
        if !at_the_start && !self.unit.preload.is_empty() {
            let objects: Vec<_> = simulation.world().scene().objects().collect();
            for object in objects {
                let cleared = simulation.world_mut().clear_contact_history(object);
                cleared.map_err(|error| Refusal::error(error.to_string()))?;
            }
            for (pair, preload) in &self.unit.preload {
                simulation.preload_friction(*pair, preload).map_err(of_simulation)?;
            }
        }
        self.states = simulation.state_numbers();
        Ok(())
    }

    /// Sets the surfaces of the world from the parameters.
    pub(crate) fn set_surfaces(&mut self, parameters: &[f64]) -> Outcome {
        let scales: Vec<f64> = self
            .unit
            .variables
            .parameters
            .iter()
            .zip(parameters)
            .filter(|(parameter, _)| matches!(parameter, Parameter::Scale(..)))
            .map(|(_, scale)| *scale)
            .collect();
        let mut rest = scales.as_slice();
        for surface in &self.unit.surfaces {
            let (own, others) = rest.split_at(surface.factors.len());
            rest = others;
            let set = surface.set(self.unit.simulation.world_mut(), own);
            set.map_err(|error| Refusal::discard(format!("surface `{}`: {error}", surface.path)))?;
        }
        Ok(())
    }

    /// Before the simulation runs, computes states from parameters.
    fn start_values(&mut self) -> Outcome {
        match self.mode {
            Mode::Instantiated | Mode::Initialization if !self.is_current => self.prepare(),
            _ => Ok(()),
        }
    }

    // ---- Evaluation

    /// Brings poses, wrenches and rates up to date with the present values. Nothing is committed.
    pub fn evaluate(&mut self) -> Outcome {
        if self.is_current {
            return Ok(());
        }
        match self.mode {
            Mode::Instantiated | Mode::Initialization => self.prepare()?,
            Mode::Event | Mode::Continuous => self.apply_inputs(self.time)?,
            Mode::Step | Mode::Terminated => {}
        }
        let simulation = &mut self.unit.simulation;
        self.summary = None;
        simulation.try_states(self.time, &self.states, &mut self.rates).map_err(of_trial)?;
        self.is_current = true;
        Ok(())
    }

    /// Applies the inputs: motions of bodies moved by the importer, and wrenches. In Model Exchange the
    /// importer gives motions for every instant; in Co-Simulation a body keeps its given twist between
    /// communication points.
    fn apply_inputs(&mut self, time: f64) -> Outcome {
        let is_exchange = self.kind == Kind::ModelExchange;
        let Self { unit: Unit { simulation, variables, .. }, inputs, .. } = self;
        let mut place = 0;
        while let Some(input) = variables.inputs.get(place) {
            match input {
                Input::Motion(body, _) => {
                    let numbers = &inputs[place..place + MOTION_NUMBERS];
                    // A body that is already in its prescribed motion needs no second commit.
                    if is_exchange || motion_numbers(simulation, *body) != numbers {
                        let name = &variables.list[motion_name(variables, place)].name;
                        let (pose, twist) = motion(numbers, &format!("inputs `{name}` and those behind it"))?;
                        simulation.lead(*body, time, pose, twist).map_err(of_trial)?;
                    }
                    place += MOTION_NUMBERS;
                }
                Input::Applied(..) if !self.inputs_changed => place += WRENCH_NUMBERS,
                Input::Applied(body, _) => {
                    let [fx, fy, fz, mx, my, mz] = inputs[place..place + WRENCH_NUMBERS] else {
                        unreachable!("inputs come in sixes");
                    };
                    let wrench = Wrench { force: Vec3::new(fx, fy, fz), moment: Vec3::new(mx, my, mz) };
                    simulation.set_external_wrench(*body, wrench).map_err(of_trial)?;
                    place += WRENCH_NUMBERS;
                }
            }
        }
        self.inputs_changed = false;
        Ok(())
    }

    pub(crate) fn summary(&mut self) -> Summary {
        *self.summary.get_or_insert_with(|| {
            let mut summary = Summary::default();
            for contact in self.unit.simulation.world().contacts_iter() {
                summary.count += 1.0;
                summary.largest_depth = contact.depth.max(summary.largest_depth);
            }
            summary
        })
    }

    fn frame_flags(&mut self) -> Flags {
        self.warned.flags_of(self.unit.simulation.world())
    }

    /// Warns, once in a run, of missed contacts.
    fn warn_of(&mut self, flags: Flags) {
        self.warnings.extend(self.warned.due(flags, self.time));
    }

    // ---- Model Exchange

    /// The states for the importer. In Co-Simulation they are those of the executive.
    fn current_states(&self) -> std::borrow::Cow<'_, [f64]> {
        match (self.kind, self.mode) {
            (Kind::CoSimulation, Mode::Step | Mode::Terminated) => {
                self.unit.simulation.state_numbers().into()
            }
            _ => (&self.states[..]).into(),
        }
    }

    pub fn set_time(&mut self, time: f64) -> Outcome {
        self.expect_mode("SetTime", &[Mode::Event, Mode::Continuous])?;
        if !time.is_finite() {
            return Err(Refusal::error(format!("SetTime: the time is {time} s; give a finite time")));
        }
        self.is_current &= time == self.time;
        self.time = time;
        Ok(())
    }

    pub fn set_states(&mut self, states: &[f64]) -> Outcome {
        self.expect_mode("SetContinuousStates", &[Mode::Event, Mode::Continuous])?;
        self.check_count("SetContinuousStates", states.len())?;
        if self.states.iter().zip(states).any(|(old, new)| old.to_bits() != new.to_bits()) {
            self.states.copy_from_slice(states);
            self.is_current = false;
        }
        Ok(())
    }

    pub fn check_count(&self, call: &str, count: usize) -> Outcome {
        if count == self.states.len() {
            return Ok(());
        }
        let own = self.states.len();
        Err(Refusal::error(format!(
            "{call}: {count} continuous states are given or wanted; the unit has {own}"
        )))
    }

    pub fn states(&mut self) -> Outcome<&[f64]> {
        self.start_values()?;
        Ok(&self.states)
    }

    pub fn rates(&mut self) -> Outcome<&[f64]> {
        self.evaluate()?;
        Ok(&self.rates)
    }

    pub fn enter_event_mode(&mut self) -> Outcome {
        self.expect_mode("EnterEventMode", &[Mode::Continuous, Mode::Event])?;
        self.mode = Mode::Event;
        Ok(())
    }

    pub fn enter_continuous_mode(&mut self) -> Outcome {
        self.expect_mode("EnterContinuousTimeMode", &[Mode::Event])?;
        self.mode = Mode::Continuous;
        Ok(())
    }

    /// Commits the step. Returns true if an event must follow: contact began or ended, or a quaternion has
    /// left unit length.
    pub fn completed_step(&mut self) -> Outcome<bool> {
        self.expect_mode("CompletedIntegratorStep", &[Mode::Continuous])?;
        if !self.is_current {
            self.apply_inputs(self.time)?;
        }
        self.summary = None;
        let accepted = self.unit.simulation.accept_states(self.time, &self.states, &mut self.rates);
        self.is_current = accepted.is_ok();
        accepted.map_err(of_trial)?;
        self.next_flags = self.frame_flags();
        self.warn_of(self.next_flags);
        Ok(self.next_flags != self.flags
            || self.quaternions().any(|q| (norm(&q) - 1.0).abs() > NORM_ERROR_MAX))
    }

    fn quaternions(&self) -> impl Iterator<Item = [f64; 4]> + '_ {
        let states = self.states.as_chunks::<{ Simulation::STATE_NUMBERS }>().0;
        states.iter().map(|state| [state[6], state[7], state[8], state[9]])
    }

    /// Handles an event: flags change, quaternions are normalised.
    pub fn update_discrete_states(&mut self) -> Outcome<EventOutcome> {
        self.expect_mode("update of discrete states", &[Mode::Event])?;
        if let Some(place) = self.quaternions().position(|q| !is_direction(&q)) {
            let body = self.unit.simulation.free_bodies().nth(place);
            let found = body.and_then(|id| self.unit.simulation.bodies().nth(id.index()));
            return Err(Refusal::discard(format!(
                "states of `{}`: the quaternion has no direction; set one of unit length (w, x, y, z)",
                found.map_or("", |(_, body)| body.name.as_str())
            )));
        }
        self.flags = self.next_flags;
        let mut states_changed = false;
        for state in self.states.as_chunks_mut::<{ Simulation::STATE_NUMBERS }>().0 {
            let quaternion = &mut state[6..10];
            let length = norm(quaternion);
            if (length - 1.0).abs() > NORM_ERROR_MAX {
                quaternion.iter_mut().for_each(|part| *part /= length);
                (states_changed, self.is_current) = (true, false);
            }
        }
        Ok(EventOutcome { states_changed })
    }

    // ---- Co-Simulation

    /// Advances the executive of the scene to the end of a communication step.
    pub fn do_step(&mut self, from: f64, length: f64) -> Outcome {
        self.expect_mode("DoStep", &[Mode::Step])?;
        if !(length >= 0.0 && length.is_finite()) {
            return Err(Refusal::error(format!(
                "DoStep: the step is {length} s; give a finite time from zero up"
            )));
        }
        let tolerance = STEP_TOLERANCE * self.unit.simulation.step_length() + f64::EPSILON * self.time.abs();
        let begins_here = (from - self.time).abs() <= tolerance;
        if !begins_here {
            return Err(Refusal::error(format!(
                "DoStep: it begins at {from} s, and the instance is at {} s; go on from there, or restore a state of that time",
                self.time
            )));
        }
        let step = self.unit.simulation.step_length();
        if length / step > STEPS_MAX {
            return Err(Refusal::error(format!(
                "DoStep: {length} s are more than {STEPS_MAX:e} steps of the scene ({step} s); give a shorter communication step"
            )));
        }
        self.undo.clear();
        self.unit.simulation.save(&mut self.undo);
        let inputs_changed = self.inputs_changed;
        match self.advance(from + length) {
            Ok((flags, means)) => {
                self.time = from + length;
                self.means = means;
                (self.is_current, self.summary) = (true, None);
                (self.flags, self.next_flags) = (flags, flags);
                self.warn_of(flags);
                Ok(())
            }
            Err(refusal) => {
                self.unit.simulation.restore(&self.undo).map_err(of_simulation)?;
                self.inputs_changed = inputs_changed;
                Err(refusal)
            }
        }
    }

    /// Advances to a time; returns flags and mean wrenches of the communication step.
    fn advance(&mut self, target: f64) -> Outcome<(Flags, Vec<Wrench>)> {
        // The summary of the instant before the step must be taken before contacts are computed anew.
        self.summary();
        if self.inputs_changed {
            self.apply_inputs(self.unit.simulation.time())?;
        }
        let step = self.unit.simulation.step_length();
        let left = (target - self.unit.simulation.time()) / step;
        let whole = (left + STEP_TOLERANCE).floor().max(0.0) as u64;
        let mut flags = Flags::default();
        let mut impulses = Impulses::default();
        for _ in 0..whole {
            self.one_step(&mut flags, &mut impulses)?;
        }
        let rest = target - self.unit.simulation.time();
        if rest > STEP_TOLERANCE * step {
            self.unit.simulation.set_step(rest).map_err(of_simulation)?;
            let stepped = self.one_step(&mut flags, &mut impulses);
            self.unit.simulation.set_step(step).map_err(of_simulation)?;
            stepped?;
        } else if whole == 0 {
            // Too short for a step: evaluate, so that the importer still sees the effect of its inputs.
            self.unit.simulation.commit_initial_states().map_err(of_trial)?;
            flags = self.frame_flags();
        }
        Ok((flags, impulses.means()))
    }

    fn one_step(&mut self, flags: &mut Flags, impulses: &mut Impulses) -> Outcome {
        self.unit.simulation.step().map_err(of_trial)?;
        if self.unit.step_means {
            impulses.add(&self.unit.simulation);
        }
        let now = self.frame_flags();
        flags.join(now);
        Ok(())
    }

    pub fn terminate(&mut self) -> Outcome {
        self.expect_mode("Terminate", &[Mode::Event, Mode::Continuous, Mode::Step])?;
        self.mode = Mode::Terminated;
        Ok(())
    }
}

/// Index of an input in the list of variables.
fn motion_name(variables: &crate::variables::Variables, place: usize) -> usize {
    let found = variables.list.iter().position(|variable| variable.slot == Slot::Input(place));
    found.expect("every input is a variable")
}

/// Contact wrenches on all bodies, integrated over the steps of a communication step.
#[derive(Default)]
struct Impulses {
    /// Time, s.
    time: f64,
    of_bodies: Vec<Wrench>,
}

impl Impulses {
    /// Adds the last step.
    fn add(&mut self, simulation: &Simulation) {
        self.time += simulation.step_length();
        self.of_bodies.resize(simulation.bodies().len(), Wrench::zero());
        for ((id, _), sum) in simulation.bodies().zip(&mut self.of_bodies) {
            let impulse = simulation.contact_impulse(id).unwrap_or_else(Wrench::zero);
            sum.force += impulse.force;
            sum.moment += impulse.moment;
        }
    }

    fn means(mut self) -> Vec<Wrench> {
        for sum in &mut self.of_bodies {
            sum.force /= self.time;
            sum.moment /= self.time;
        }
        self.of_bodies
    }
}

fn component(wrench: &Wrench, number: usize) -> f64 {
    if number < 3 { wrench.force[number] } else { wrench.moment[number - 3] }
}

/// True if a quaternion can be normalised.
fn is_direction(quaternion: &[f64]) -> bool {
    let length = norm(quaternion);
    length > 0.0 && length.is_finite()
}

fn norm(quaternion: &[f64]) -> f64 {
    quaternion.iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// Pose and twist from thirteen numbers.
fn motion(numbers: &[f64], thing: &str) -> Outcome<(Pose, Twist)> {
    let length = norm(&numbers[3..7]);
    let is_unit = (length - 1.0).abs() <= NORM_ERROR_MAX;
    if !is_unit {
        return Err(Refusal::discard(format!(
            "{thing}: the quaternion has norm {length}; give a unit quaternion (w, x, y, z)"
        )));
    }
    let vector = |at: usize| Vec3::from_column_slice(&numbers[at..at + 3]);
    let pose = Pose::new(vector(0), [numbers[3], numbers[4], numbers[5], numbers[6]]);
    Ok((pose, Twist { linear: vector(7), angular: vector(10) }))
}

fn of_simulation(error: ExecutiveError) -> Refusal {
    Refusal::error(error.to_string())
}

/// Refusal of states; a retry with other values or a shorter step may succeed.
fn of_trial(error: ExecutiveError) -> Refusal {
    Refusal::discard(error.to_string())
}
