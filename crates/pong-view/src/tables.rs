//! The frames of a log as columns.

use crate::ViewError;
use crate::blob::{Blob, Column};
use crate::origin::Origin;
use crate::thin::Thinning;
use pong_geometry::Vec3;
use pong_record::{ContactRow, Frame, FrameRow, Log, Run, StateRow, WrenchRow};
use serde::Serialize;

/// All frames that are kept, in reading order.
#[derive(Default)]
pub(crate) struct Frames {
    pub rows: Vec<FrameRow>,
    states: Vec<Vec<StateRow>>,
    wrenches: Vec<Vec<WrenchRow>>,
    contacts: Vec<ContactRow>,
    /// Largest force (N), moment (N·m) and depth (m) of each body since the previous kept frame; empty if
    /// none was left out.
    peaks: Vec<Vec<[f64; 3]>>,
}

/// Columns of the frames. Vectors along the common axes, positions relative to the origin of their frame.
#[derive(Debug, Serialize)]
pub(crate) struct FrameColumns {
    /// Number of the frame in its log.
    number: Column,
    /// Time, s.
    time: Column,
    flags: Column,
    /// Duration of the evaluation, s; 0 without a clock.
    evaluation: Column,
    /// First contact of each frame, and one more for the end.
    first_contact: Column,
    /// Position, m, by frame and body.
    position: Column,
    /// Quaternion (w, x, y, z).
    orientation: Column,
    /// Force, N.
    force: Column,
    /// Moment about the body's origin, N·m.
    moment: Column,
    /// Peaks of force, moment and depth, where frames were left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    peaks: Option<Column>,
}

/// Columns of the contacts.
#[derive(Debug, Serialize)]
pub(crate) struct ContactColumns {
    pair: Column,
    primitive_a: Column,
    primitive_b: Column,
    element_a: Column,
    element_b: Column,
    /// Bit 0 sticks, bits 2 and 3 kind of feature.
    flags: Column,
    /// Code of the end of a segment, of a cell or of the friction of solids (docs/c_api.md).
    end: Column,
    feature: Column,
    point: Column,
    normal: Column,
    depth: Column,
    rate: Column,
    weight: Column,
    normal_force: Column,
    friction: Column,
    slip: Column,
}

impl Frames {
    /// Reads the frames that are kept, and the peaks of the others.
    pub fn read(log: &mut Log, thinning: &Thinning) -> Result<Self, ViewError> {
        let (mut frames, mut frame) = (Self::default(), Frame::default());
        let bodies = log.run().bodies.len();
        let mut peaks = vec![[0.0; 3]; bodies];
        for index in 0..thinning.frames {
            log.read(index, &mut frame)?;
            if thinning.every > 1 {
                raise(&mut peaks, &frame, log.run());
            }
            if thinning.keeps(index) {
                frames.take(&frame);
                if thinning.every > 1 {
                    frames.peaks.push(std::mem::replace(&mut peaks, vec![[0.0; 3]; bodies]));
                }
            }
        }
        Ok(frames)
    }

    /// Positions of all bodies, frame after frame, m.
    pub fn places(&self) -> Vec<Vec<Vec3>> {
        self.states
            .iter()
            .map(|states| states.iter().map(|state| Vec3::from(state.position)).collect())
            .collect()
    }

    pub fn contact_count(&self) -> usize {
        self.contacts.len()
    }

    /// True if the times of the frames always increase.
    pub fn times_increase(&self) -> bool {
        self.rows.windows(2).all(|rows| rows[0].time < rows[1].time)
    }

    fn take(&mut self, frame: &Frame) {
        self.rows.push(frame.row);
        self.states.push(frame.states.clone());
        self.wrenches.push(frame.wrenches.clone());
        self.contacts.extend(&frame.contacts);
    }

    pub fn columns(&self, origin: &Origin, blob: &mut Blob) -> FrameColumns {
        let states = || self.states.iter().flatten();
        let wrenches = || self.wrenches.iter().flatten();
        let counts = self.rows.iter().map(|row| row.contacts);
        let ends = counts.scan(0, |end, count| {
            *end += count;
            Some(*end)
        });
        let positions = self.states.iter().enumerate().flat_map(|(frame, states)| {
            let at = origin.at(frame);
            states.iter().flat_map(move |state| local(&state.position, &at))
        });
        FrameColumns {
            number: blob.f64s(self.rows.iter().map(|row| row.frame as f64)),
            time: blob.f64s(self.rows.iter().map(|row| row.time)),
            flags: blob.u32s(self.rows.iter().map(|row| row.flags)),
            evaluation: blob.f32s(self.rows.iter().map(|row| row.evaluate_ns as f64 * 1e-9)),
            first_contact: blob.u32s(std::iter::once(0).chain(ends)),
            position: blob.f32s(positions),
            orientation: blob.f32s(states().flat_map(|state| state.orientation)),
            force: blob.f32s(wrenches().flat_map(|wrench| wrench.force)),
            moment: blob.f32s(wrenches().flat_map(|wrench| wrench.moment)),
            peaks: (!self.peaks.is_empty())
                .then(|| blob.f32s(self.peaks.iter().flatten().flatten().copied())),
        }
    }

    pub fn contact_columns(&self, origin: &Origin, blob: &mut Blob) -> ContactColumns {
        let all = || self.contacts.iter();
        let frames = self.rows.iter().enumerate();
        let origins =
            frames.flat_map(|(frame, row)| std::iter::repeat_n(origin.at(frame), row.contacts as usize));
        let flags = |c: &ContactRow| u8::from(c.sticks != 0) | (c.feature_kind.min(3) as u8) << 2;
        ContactColumns {
            pair: blob.u32s(all().map(|c| c.pair)),
            primitive_a: blob.u32s(all().map(|c| c.primitive_a)),
            primitive_b: blob.u32s(all().map(|c| c.primitive_b)),
            element_a: blob.u32s(all().map(|c| c.element_a)),
            element_b: blob.u32s(all().map(|c| c.element_b)),
            flags: blob.u8s(all().map(flags)),
            end: blob.u32s(all().map(|c| c.end)),
            feature: blob.u32s(all().map(|c| c.feature_index)),
            point: blob.f32s(all().zip(origins).flat_map(|(c, at)| local(&c.point, &at))),
            normal: blob.f32s(all().flat_map(|c| c.normal)),
            depth: blob.f32s(all().map(|c| c.depth)),
            rate: blob.f32s(all().map(|c| c.depth_rate)),
            weight: blob.f32s(all().map(|c| c.weight)),
            normal_force: blob.f32s(all().map(|c| c.normal_force)),
            friction: blob.f32s(all().flat_map(|c| c.friction_force)),
            slip: blob.f32s(all().flat_map(|c| c.slip_velocity)),
        }
    }
}

fn local(place: &[f64; 3], origin: &Vec3) -> [f64; 3] {
    [place[0] - origin.x, place[1] - origin.y, place[2] - origin.z]
}

/// Raises the peaks of all bodies to the values of a frame.
fn raise(peaks: &mut [[f64; 3]], frame: &Frame, run: &Run) {
    for (peaks, wrench) in peaks.iter_mut().zip(&frame.wrenches) {
        peaks[0] = peaks[0].max(Vec3::from(wrench.force).norm());
        peaks[1] = peaks[1].max(Vec3::from(wrench.moment).norm());
    }
    for contact in &frame.contacts {
        for primitive in [contact.primitive_a, contact.primitive_b] {
            let peak = &mut peaks[run.primitives[primitive as usize].body][2];
            *peak = peak.max(contact.depth);
        }
    }
}
