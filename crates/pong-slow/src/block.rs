//! Memory between frames as bytes: one flat block without pointers.
//!
//! | bytes | are |
//! |---|---|
//! | 8 | `pongslow` |
//! | 8 each | version, hash of the scene, number of bodies, length of the contact state |
//! | 8 each | length of the last frame, squared rate |
//! | per body | axes, length of the queue, unspent work, offset (7), held back (6), predicted (7 + 6), given (7 + 6), queue (6 each) |
//! | | the contact state of the engine |
//! | 8 | hash of all before |
//!
//! Numbers are little-endian.

use crate::chart::Axes;
use crate::error::SlowError;
use crate::memory::{KeptBody, Memory};
use nalgebra::{Quaternion, UnitQuaternion, Vector6};
use pong_geometry::{Pose, Vec3};
use pong_model::Fnv;
use std::collections::VecDeque;

const MAGIC: &[u8; 8] = b"pongslow";
const VERSION: u64 = 1;

/// Size of the largest block, bytes, with this number of bodies, this delay and this largest contact state.
pub(crate) fn size_max(bodies: usize, delay_frames: u32, contact: usize) -> usize {
    const HEADER_AND_HASH: usize = 8 * 8;
    const BODY: usize = 8 * (3 + 3 * (7 + 6));
    const IMPULSE: usize = 8 * 6;
    HEADER_AND_HASH + bodies * (BODY + IMPULSE * delay_frames as usize) + contact
}

/// Writes a block.
pub(crate) fn write(memory: &Memory, contact: &[u8], scene: u64) -> Vec<u8> {
    let mut out = MAGIC.to_vec();
    for word in [VERSION, scene, memory.bodies.len() as u64, contact.len() as u64] {
        out.extend(word.to_le_bytes());
    }
    numbers(&mut out, &[memory.length, memory.rate_square]);
    for body in &memory.bodies {
        for word in [u64::from(body.axes == Axes::Group), body.queue.len() as u64] {
            out.extend(word.to_le_bytes());
        }
        numbers(&mut out, &[body.unspent]);
        for (pose, six) in [
            (&body.offset, &body.held_back),
            (&body.predicted, &body.predicted_velocity),
            (&body.given, &body.given_velocity),
        ] {
            let q = pose.orientation.coords;
            numbers(&mut out, pose.position.as_slice());
            numbers(&mut out, &[q.w, q.x, q.y, q.z]);
            numbers(&mut out, six.as_slice());
        }
        body.queue.iter().for_each(|impulse| numbers(&mut out, impulse.as_slice()));
    }
    out.extend(contact);
    out.extend(Fnv::of(&out).to_le_bytes());
    out
}

fn numbers(out: &mut Vec<u8>, numbers: &[f64]) {
    numbers.iter().for_each(|number| out.extend(number.to_le_bytes()));
}

/// Reads a block of a scene with this hash and number of bodies.
pub(crate) fn read(bytes: &[u8], scene: u64, bodies: usize) -> Result<(Memory, Vec<u8>), SlowError> {
    let refused = |cause: &str| SlowError::BadState { cause: cause.to_owned() };
    let damaged = || refused("it is damaged or cut short; save it again");
    let (all, hash) = bytes.split_last_chunk::<8>().ok_or_else(damaged)?;
    if all.get(..8) != Some(MAGIC) {
        return Err(refused("it does not begin with `pongslow`; give bytes that `save_state` returned"));
    }
    if u64::from_le_bytes(*hash) != Fnv::of(all) {
        return Err(damaged());
    }
    let mut input = Input { bytes: &all[8..] };
    let [version, of_scene, count, contact] = input.words().ok_or_else(damaged)?;
    if version != VERSION {
        return Err(refused(&format!(
            "it has version {version}, and this release reads version {VERSION}; restore it with the release that saved it"
        )));
    }
    if of_scene != scene {
        return Err(refused("it is of another scene; build the world by the same calls"));
    }
    if count != 0 && count != bodies as u64 {
        return Err(damaged());
    }
    let [length, rate_square] = input.numbers().ok_or_else(damaged)?;
    let mut memory = Memory { length, rate_square, bodies: Vec::new() };
    for _ in 0..count {
        memory.bodies.push(input.body().ok_or_else(damaged)?);
    }
    if input.bytes.len() as u64 != contact {
        return Err(damaged());
    }
    Ok((memory, input.bytes.to_vec()))
}

/// Bytes that are still to be read.
struct Input<'b> {
    bytes: &'b [u8],
}

impl Input<'_> {
    fn words<const N: usize>(&mut self) -> Option<[u64; N]> {
        let mut words = [0; N];
        for word in &mut words {
            let (head, rest) = self.bytes.split_first_chunk::<8>()?;
            *word = u64::from_le_bytes(*head);
            self.bytes = rest;
        }
        Some(words)
    }

    fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        Some(self.words::<N>()?.map(f64::from_bits))
    }

    fn pose(&mut self) -> Option<Pose> {
        let [x, y, z, w, i, j, k] = self.numbers()?;
        // The bits that were saved: normalising again could change the last one.
        let orientation = UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k));
        Some(Pose { position: Vec3::new(x, y, z), orientation })
    }

    fn six(&mut self) -> Option<Vector6<f64>> {
        self.numbers::<6>().map(Vector6::from)
    }

    fn body(&mut self) -> Option<KeptBody> {
        let [axes, queued] = self.words()?;
        let axes = if axes == 0 { Axes::Common } else { Axes::Group };
        let [unspent] = self.numbers()?;
        let (offset, held_back) = (self.pose()?, self.six()?);
        let (predicted, predicted_velocity) = (self.pose()?, self.six()?);
        let (given, given_velocity) = (self.pose()?, self.six()?);
        let queue: VecDeque<_> = (0..queued).map(|_| self.six()).collect::<Option<_>>()?;
        Some(KeptBody {
            axes,
            offset,
            held_back,
            unspent,
            predicted,
            predicted_velocity,
            given,
            given_velocity,
            queue,
        })
    }
}
