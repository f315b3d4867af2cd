//! The state of an instance as bytes: FMUstate, in memory or serialised. They hold no pointer.
//!
//! ```text
//! magic 8 | version 8 | token 8 + n | kind, mode, current, changed, flags 8 | time 8
//! | parameters, inputs, states, rates, mean wrenches: count 8 and numbers | summary 16 | saved instant of the simulation
//! | checksum 8 (FNV-1a of everything before)
//! ```

use crate::flags::Flags;
use crate::instance::{Instance, Kind, Mode, Summary};
use crate::refusal::Refusal;
use pong_executive::{Vec3, Wrench};
use pong_model::Fnv;

const MAGIC: &[u8; 8] = b"PONGFMUS";
const VERSION: u64 = 2;
const MODES: [Mode; 6] =
    [Mode::Instantiated, Mode::Initialization, Mode::Event, Mode::Continuous, Mode::Step, Mode::Terminated];

impl Instance {
    /// Appends the state to `out`.
    pub fn save(&mut self, out: &mut Vec<u8>) {
        // Contacts are not saved, so their summary must be computed now.
        let summary = if self.is_current { self.summary() } else { Summary::default() };
        out.clear();
        out.extend_from_slice(MAGIC);
        word(out, VERSION);
        word(out, self.unit.token.len() as u64);
        out.extend_from_slice(self.unit.token.as_bytes());
        let mode = MODES.iter().position(|mode| *mode == self.mode).expect("all modes are listed");
        out.extend([u8::from(self.kind == Kind::CoSimulation), mode as u8]);
        out.extend([u8::from(self.is_current), u8::from(self.inputs_changed)]);
        out.extend([bits(self.flags), bits(self.next_flags), 0, 0]);
        word(out, self.time.to_bits());
        for numbers in [&self.parameters, &self.inputs, &self.states, &self.rates] {
            word(out, numbers.len() as u64);
            numbers.iter().for_each(|number| word(out, number.to_bits()));
        }
        let means = self.means.iter().flat_map(|mean| mean.force.iter().chain(&mean.moment));
        word(out, 6 * self.means.len() as u64);
        means.for_each(|number| word(out, number.to_bits()));
        word(out, summary.count.to_bits());
        word(out, summary.largest_depth.to_bits());
        self.unit.simulation.save(out);
        let checksum = Fnv::of(out);
        word(out, checksum);
    }

    /// Restores a state saved by an instance of the same FMU and kind.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let state = self
            .read(bytes)
            .map_err(|(cause, cure)| Refusal::error(format!("FMU state: {cause}; {cure}")))?;
        self.set_surfaces(&state.parameters)?;
        if let Err(error) = self.unit.simulation.restore(state.simulation) {
            let own = self.parameters.clone();
            self.set_surfaces(&own)?;
            return Err(Refusal::error(format!("FMU state: {error}")));
        }
        (self.mode, self.time) = (state.mode, state.time);
        (self.is_current, self.inputs_changed) = (state.is_current, state.inputs_changed);
        (self.flags, self.next_flags) = (state.flags, state.next_flags);
        self.summary = state.is_current.then_some(state.summary);
        (self.parameters, self.inputs) = (state.parameters, state.inputs);
        (self.states, self.rates, self.means) = (state.states, state.rates, state.means);
        Ok(())
    }

    /// Checks that a state is one of this FMU, whole and undamaged.
    pub fn check_state(&self, bytes: &[u8]) -> Result<(), Refusal> {
        let read =
            self.read(bytes).map_err(|(cause, cure)| Refusal::error(format!("FMU state: {cause}; {cure}")));
        read.map(|_| ())
    }

    fn read<'b>(&self, bytes: &'b [u8]) -> Result<State<'b>, Fault> {
        let Some((rest, checksum)) = bytes.split_last_chunk::<8>() else { return Err(FOREIGN) };
        let Some(rest) = rest.strip_prefix(MAGIC) else { return Err(FOREIGN) };
        if Fnv::of(&bytes[..bytes.len() - 8]) != u64::from_le_bytes(*checksum) {
            return Err(DAMAGED);
        }
        let mut reader = Reader { bytes: rest };
        if reader.word()? != VERSION {
            return Err(("it was saved by another version of the library", "save it again with this one"));
        }
        let length = reader.word()?;
        if reader.take(usize::try_from(length).map_err(|_| DAMAGED)?)? != self.unit.token.as_bytes() {
            return Err(("it is of another FMU, or of one made from other files", "use a state of this FMU"));
        }
        let [kind, mode, is_current, inputs_changed, flags, next_flags, ..] = reader.word()?.to_le_bytes();
        if (kind == 1) != (self.kind == Kind::CoSimulation) {
            let cause = "it is of the other kind of FMU (Model Exchange or Co-Simulation)";
            return Err((cause, "use a state of an instance of this kind"));
        }
        let mode = *MODES.get(usize::from(mode)).ok_or(DAMAGED)?;
        let time = f64::from_bits(reader.word()?);
        let parameters = reader.numbers(self.parameters.len())?;
        let inputs = reader.numbers(self.inputs.len())?;
        let states = reader.numbers(self.states.len())?;
        let rates = reader.numbers(self.rates.len())?;
        let means = reader.wrenches(self.unit.simulation.bodies().len())?;
        let [count, largest_depth] = [reader.word()?, reader.word()?].map(f64::from_bits);
        Ok(State {
            mode,
            time,
            is_current: is_current == 1,
            inputs_changed: inputs_changed == 1,
            flags: of_bits(flags),
            next_flags: of_bits(next_flags),
            parameters,
            inputs,
            states,
            rates,
            means,
            summary: Summary { count, largest_depth },
            simulation: reader.bytes,
        })
    }
}

/// Cause and cure.
type Fault = (&'static str, &'static str);

const FOREIGN: Fault = ("the bytes are no state of an FMU of Pong", "hand in what was saved or serialised");
const DAMAGED: Fault = ("the bytes are damaged (length or checksum)", "use another copy");

struct State<'b> {
    mode: Mode,
    time: f64,
    is_current: bool,
    inputs_changed: bool,
    flags: Flags,
    next_flags: Flags,
    parameters: Vec<f64>,
    inputs: Vec<f64>,
    states: Vec<f64>,
    rates: Vec<f64>,
    means: Vec<Wrench>,
    summary: Summary,
    simulation: &'b [u8],
}

fn bits(flags: Flags) -> u8 {
    let Flags { touching, tunnelled, left_out, deep_in_mesh } = flags;
    u8::from(touching) | u8::from(tunnelled) << 1 | u8::from(left_out) << 2 | u8::from(deep_in_mesh) << 3
}

fn of_bits(bits: u8) -> Flags {
    Flags {
        touching: bits & 1 != 0,
        tunnelled: bits & 2 != 0,
        left_out: bits & 4 != 0,
        deep_in_mesh: bits & 8 != 0,
    }
}

fn word(out: &mut Vec<u8>, value: u64) {
    out.extend_from_slice(&value.to_le_bytes());
}

struct Reader<'b> {
    bytes: &'b [u8],
}

impl<'b> Reader<'b> {
    fn take(&mut self, length: usize) -> Result<&'b [u8], Fault> {
        let (taken, rest) = self.bytes.split_at_checked(length).ok_or(DAMAGED)?;
        self.bytes = rest;
        Ok(taken)
    }

    fn word(&mut self) -> Result<u64, Fault> {
        let (first, rest) = self.bytes.split_first_chunk::<8>().ok_or(DAMAGED)?;
        self.bytes = rest;
        Ok(u64::from_le_bytes(*first))
    }

    /// Reads the wrenches: none, or one for each body.
    fn wrenches(&mut self, bodies: usize) -> Result<Vec<Wrench>, Fault> {
        let is_empty = self.bytes.starts_with(&[0; 8]);
        let numbers = self.numbers(if is_empty { 0 } else { 6 * bodies })?;
        let (sixes, _) = numbers.as_chunks::<6>();
        let wrench =
            |&[a, b, c, d, e, f]: &[f64; 6]| Wrench { force: Vec3::new(a, b, c), moment: Vec3::new(d, e, f) };
        Ok(sixes.iter().map(wrench).collect())
    }

    fn numbers(&mut self, count: usize) -> Result<Vec<f64>, Fault> {
        if self.word()? != count as u64 {
            return Err(("it has other variables", "use a state of this FMU"));
        }
        (0..count).map(|_| self.word().map(f64::from_bits)).collect()
    }
}
