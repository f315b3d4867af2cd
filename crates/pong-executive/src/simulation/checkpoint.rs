//! The present instant as bytes: all that a simulation needs to go on with the same bits, in this process or
//! another.
//!
//! ```text
//! magic 8 | version 8 | bodies 8 | free bodies 8 | wrenches on their way 8
//! | step, epoch, steps, settled | sums and powers of energies
//! | per free body: FreeState::EXACT_NUMBERS × 8
//! | per body: motion 13 × 8, contact wrench and external wrench 6 × 8 each, led 8, and if it is: since, pose, twist 14 × 8
//! | per wrench on its way and body: 6 × 8
//! | contact state: length 8, block
//! | with long frames: memory of the copies, to the end | checksum 8 (FNV-1a of everything before)
//! ```
//!
//! Little-endian, without pointers. Masses, loads, springs, paths and models are not part of it: they are set-up.

use super::Simulation;
use crate::body::Motion;
use crate::energy::Powers;
use crate::error::{ExecutiveError, Result};
use crate::integrate::{Integrator, long_frame_settings, refused};
use crate::path::Path;
use crate::state::FreeState;
use pong_geometry::{Pose, Quat, Twist, Vec3, Wrench};
use pong_model::Fnv;
use pong_slow::SlowHost;

const MAGIC: &[u8; 8] = b"PONGEXEC";
const VERSION: u64 = 1;
const MOTION_NUMBERS: usize = 13;

impl Simulation {
    /// Appends the present instant, with the contact state of the world, to `out`.
    pub fn save(&self, out: &mut Vec<u8>) {
        let begin = out.len();
        out.extend_from_slice(MAGIC);
        let held: Vec<&Vec<Wrench>> = self.held.waiting.iter().collect();
        let counts = [VERSION, self.system.bodies.len() as u64, self.states.len() as u64, held.len() as u64];
        counts.iter().for_each(|count| word(out, *count));
        numbers(out, [self.step, self.epoch]);
        word(out, self.steps);
        word(out, u64::from(self.settled));
        let Powers { spring_heat, work_in, on_led } = self.powers;
        let contact_work = self.contact_work.unwrap_or_default();
        numbers(out, [self.spring_loss, self.work_in, contact_work, spring_heat, work_in, on_led]);
        self.states.iter().for_each(|state| numbers(out, state.exact_numbers()));
        for (index, body) in self.system.bodies.iter().enumerate() {
            numbers(out, of_motion(&self.system.motions[index]));
            numbers(out, of_wrench(&self.system.contact[index]));
            numbers(out, of_wrench(&self.system.external[index]));
            let led = led_path(&body.motion);
            word(out, u64::from(led.is_some()));
            if let Some((since, pose, twist)) = led {
                numbers(out, [since]);
                numbers(out, of_motion(&(pose, twist)));
            }
        }
        held.into_iter().flatten().for_each(|wrench| numbers(out, of_wrench(wrench)));
        let mut block = Vec::new();
        self.system.world.save_state_packed(&mut block);
        word(out, block.len() as u64);
        out.extend_from_slice(&block);
        if let Some(host) = &self.long_frames.host {
            out.extend(host.save_state());
        }
        let checksum = Fnv::of(&out[begin..]);
        word(out, checksum);
    }

    /// Goes back to an instant saved by a simulation with the same set-up.
    ///
    /// # Errors
    /// Bytes that are damaged, or saved by a simulation with another set-up. The present instant is then
    /// unchanged.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<()> {
        let instant = self
            .read(bytes)
            .map_err(|(cause, cure)| ExecutiveError::invalid("saved instant", cause, cure))?;
        // The engine refuses as a whole, too; nothing after this line can fail.
        let mut copies = None;
        if let (Integrator::LongFrame { substeps_max, delay_frames }, false) =
            (self.integrator, instant.copies.is_empty())
        {
            let settings = long_frame_settings(substeps_max, delay_frames);
            let mut host = SlowHost::new(&self.system.world, settings).map_err(refused)?;
            host.restore_state(instant.copies).map_err(refused)?;
            copies = Some(host);
        }
        self.system.world.restore_state(instant.block)?;
        self.long_frames.begin_anew(copies);
        (self.step, self.epoch, self.steps, self.settled) =
            (instant.step, instant.epoch, instant.steps, instant.settled);
        self.reference = None;
        self.spring_loss = instant.spring_loss;
        self.work_in = instant.work_in;
        self.contact_work = self.contact_work.map(|_| instant.contact_work);
        self.powers = instant.powers;
        self.earlier.clone_from(&instant.states);
        self.states = instant.states;
        for (index, saved) in instant.bodies.into_iter().enumerate() {
            self.system.motions[index] = saved.motion;
            self.system.contact[index] = saved.contact;
            self.system.external[index] = saved.external;
            if let Some((since, (pose, twist))) = saved.led {
                self.system.bodies[index].motion = Motion::Prescribed(Path::Led { since, pose, twist });
            }
        }
        self.held.waiting = instant.held.into();
        Ok(())
    }

    fn read<'b>(&self, bytes: &'b [u8]) -> Result<Instant<'b>, Refusal> {
        let Some((rest, checksum)) = bytes.split_last_chunk::<8>() else { return Err(FOREIGN) };
        if !rest.starts_with(MAGIC) {
            return Err(FOREIGN);
        }
        if Fnv::of(rest) != u64::from_le_bytes(*checksum) {
            return Err(DAMAGED);
        }
        let mut reader = Reader { bytes: &rest[MAGIC.len()..] };
        if reader.word()? != VERSION {
            return Err(("it was written by another version of this library", "save it again with this one"));
        }
        let bodies = self.system.bodies.len();
        if (reader.word()?, reader.word()?) != (bodies as u64, self.states.len() as u64) {
            return Err(OTHER);
        }
        let held = reader.word()?;
        let [step, epoch] = reader.numbers()?;
        let (steps, settled) = (reader.word()?, reader.word()? != 0);
        let [spring_loss, work_in, contact_work, heat, power_in, on_led] = reader.numbers()?;
        let powers = Powers { spring_heat: heat, work_in: power_in, on_led };
        let states = self.states.iter().map(|_| Ok(FreeState::of_exact_numbers(&reader.numbers()?)));
        let states = states.collect::<Result<_, Refusal>>()?;
        let saved = self.system.bodies.iter().map(|body| reader.body(led_path(&body.motion).is_some()));
        let saved = saved.collect::<Result<_, Refusal>>()?;
        let mut waiting = Vec::new();
        for _ in 0..held {
            let wrenches = (0..bodies).map(|_| reader.wrench());
            waiting.push(wrenches.collect::<Result<Vec<_>, Refusal>>()?);
        }
        let length = reader.word()?;
        let has_copies = matches!(self.integrator, Integrator::LongFrame { .. });
        if length > reader.bytes.len() as u64 || (!has_copies && length != reader.bytes.len() as u64) {
            return Err(DAMAGED);
        }
        let (block, copies) = reader.bytes.split_at(length as usize);
        let (bodies, held) = (saved, waiting);
        Ok(Instant {
            step,
            epoch,
            steps,
            settled,
            spring_loss,
            work_in,
            contact_work,
            powers,
            states,
            bodies,
            held,
            block,
            copies,
        })
    }
}

/// Cause and cure.
type Refusal = (&'static str, &'static str);

const FOREIGN: Refusal = ("the bytes are no saved instant", "hand in what was saved");
const DAMAGED: Refusal = ("the bytes are damaged (length or checksum)", "use another copy");
const OTHER: Refusal =
    ("it was saved with other bodies", "restore it in a simulation that was set up in the same way");

/// Instant read from the bytes, before anything is changed.
struct Instant<'b> {
    step: f64,
    epoch: f64,
    steps: u64,
    settled: bool,
    spring_loss: f64,
    work_in: f64,
    contact_work: f64,
    powers: Powers,
    states: Vec<FreeState>,
    bodies: Vec<SavedBody>,
    held: Vec<Vec<Wrench>>,
    block: &'b [u8],
    /// Memory of the copies of long frames; empty without.
    copies: &'b [u8],
}

struct SavedBody {
    motion: (Pose, Twist),
    contact: Wrench,
    external: Wrench,
    led: Option<(f64, (Pose, Twist))>,
}

fn led_path(motion: &Motion) -> Option<(f64, Pose, Twist)> {
    match motion {
        Motion::Prescribed(Path::Led { since, pose, twist }) => Some((*since, *pose, *twist)),
        _ => None,
    }
}

fn of_motion((pose, twist): &(Pose, Twist)) -> [f64; MOTION_NUMBERS] {
    let (p, q, v, w) = (&pose.position, &pose.orientation, &twist.linear, &twist.angular);
    [p.x, p.y, p.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z, w.x, w.y, w.z]
}

fn of_wrench(wrench: &Wrench) -> [f64; 6] {
    let (f, m) = (&wrench.force, &wrench.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

fn word(out: &mut Vec<u8>, value: u64) {
    out.extend_from_slice(&value.to_le_bytes());
}

fn numbers<const N: usize>(out: &mut Vec<u8>, values: [f64; N]) {
    values.iter().for_each(|value| word(out, value.to_bits()));
}

struct Reader<'b> {
    bytes: &'b [u8],
}

impl Reader<'_> {
    fn word(&mut self) -> Result<u64, Refusal> {
        let (first, rest) = self.bytes.split_first_chunk::<8>().ok_or(DAMAGED)?;
        self.bytes = rest;
        Ok(u64::from_le_bytes(*first))
    }

    fn numbers<const N: usize>(&mut self) -> Result<[f64; N], Refusal> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = f64::from_bits(self.word()?);
        }
        Ok(values)
    }

    fn wrench(&mut self) -> Result<Wrench, Refusal> {
        let [a, b, c, d, e, f] = self.numbers()?;
        Ok(Wrench { force: Vec3::new(a, b, c), moment: Vec3::new(d, e, f) })
    }

    /// The quaternion is not normalised: that could change its bits.
    fn motion(&mut self) -> Result<(Pose, Twist), Refusal> {
        let [x, y, z, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz] = self.numbers::<MOTION_NUMBERS>()?;
        let orientation = Quat::new_unchecked(nalgebra::Quaternion::new(qw, qx, qy, qz));
        let pose = Pose { position: Vec3::new(x, y, z), orientation };
        Ok((pose, Twist { linear: Vec3::new(vx, vy, vz), angular: Vec3::new(wx, wy, wz) }))
    }

    fn body(&mut self, is_led: bool) -> Result<SavedBody, Refusal> {
        let (motion, contact, external) = (self.motion()?, self.wrench()?, self.wrench()?);
        let led = match (self.word()?, is_led) {
            (0, false) => None,
            (1, true) => {
                let [since] = self.numbers()?;
                Some((since, self.motion()?))
            }
            _ => return Err(OTHER),
        };
        Ok(SavedBody { motion, contact, external, led })
    }
}
