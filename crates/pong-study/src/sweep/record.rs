//! Record of a run for comparison: motion and wrenches on a grid of instants, and sums over every step.

use pong_executive::{Simulation, Vec3};

/// Number of values of a body at an instant: force, moment, position, orientation (w, x, y, z).
pub(crate) const VALUES: usize = 13;

/// Record of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Record {
    pub bodies: usize,
    /// Instants of the grid in a frame.
    pub per_frame: u32,
    /// [`VALUES`] numbers for each body at each instant, the first included.
    pub rows: Vec<f64>,
    /// ∫ wrench dt of each body, by the trapezoid rule over every step: force, then moment.
    pub impulses: Vec<[f64; 6]>,
    /// ∫ |force| dt and ∫ |moment| dt of each body.
    pub efforts: Vec<[f64; 2]>,
    /// Largest force and largest moment on each body over every step.
    pub peaks: Vec<[f64; 2]>,
    /// Kinetic, potential and spring energy at the end less that at the start, J.
    pub energy_change: f64,
    /// The largest of kinetic energy, energy in springs and change of energy on the grid, J.
    pub energy_scale: f64,
    /// Steps in which the engine hit a limit.
    pub incomplete: u64,
}

impl Record {
    /// A record without rows for this number of bodies.
    pub fn empty(bodies: usize, per_frame: u32) -> Self {
        Self {
            bodies,
            per_frame,
            impulses: vec![[0.0; 6]; bodies],
            efforts: vec![[0.0; 2]; bodies],
            peaks: vec![[0.0; 2]; bodies],
            ..Self::default()
        }
    }

    /// Adds the wrenches of a body at the ends of an interval to its sums; `half` is half its length, s.
    pub fn add(&mut self, body: usize, before: &[f64; 6], now: &[f64; 6], half: f64) {
        for (sum, (a, b)) in self.impulses[body].iter_mut().zip(before.iter().zip(now)) {
            *sum += half * (a + b);
        }
        for (place, sum) in self.efforts[body].iter_mut().enumerate() {
            *sum += half * (size(before, place) + size(now, place));
        }
    }

    /// Updates the peaks of a body.
    pub fn peak(&mut self, body: usize, now: &[f64; 6]) {
        let peaks = self.peaks[body].iter_mut().enumerate();
        peaks.for_each(|(place, peak)| *peak = peak.max(size(now, place)));
    }

    /// Number of instants of the grid.
    pub fn instants(&self) -> usize {
        self.rows.len() / (VALUES * self.bodies).max(1)
    }

    /// The numbers of a body at an instant.
    pub fn row(&self, instant: usize, body: usize) -> &[f64] {
        let start = (instant * self.bodies + body) * VALUES;
        &self.rows[start..start + VALUES]
    }

    /// A hash of every bit (FNV-1a).
    pub fn hash(&self) -> u64 {
        let mut hash = pong_model::Fnv::default();
        let mut numbers = |values: &[f64]| values.iter().for_each(|x| hash.word(x.to_bits()));
        numbers(&self.rows);
        self.impulses.iter().for_each(|values| numbers(values));
        self.efforts.iter().for_each(|values| numbers(values));
        self.peaks.iter().for_each(|values| numbers(values));
        numbers(&[self.energy_change, self.energy_scale]);
        hash.word(self.incomplete);
        hash.value()
    }
}

pub(crate) fn vector(values: &[f64]) -> Vec3 {
    Vec3::new(values[0], values[1], values[2])
}

/// Builds a [`Record`] step by step.
pub(crate) struct Recorder {
    record: Record,
    step: f64,
    last: Vec<[f64; 6]>,
    energy: f64,
}

impl Recorder {
    /// Records the first instant.
    pub fn new(simulation: &Simulation, per_frame: u32) -> Self {
        let bodies = simulation.bodies().len();
        let record = Record::empty(bodies, per_frame);
        let step = simulation.step_length();
        let mut recorder = Self { record, step, last: Vec::new(), energy: energy(simulation) };
        recorder.last = simulation.bodies().map(|(id, _)| six(simulation, id)).collect();
        recorder.peaks();
        recorder.instant(simulation);
        recorder
    }

    /// Records the end of a step.
    pub fn step(&mut self, simulation: &Simulation) {
        let half = 0.5 * self.step;
        for (id, _) in simulation.bodies() {
            let (body, now) = (id.index(), six(simulation, id));
            let before = std::mem::replace(&mut self.last[body], now);
            self.record.add(body, &before, &now, half);
        }
        self.peaks();
        self.record.incomplete += u64::from(!simulation.world().report().status.is_complete());
    }

    fn peaks(&mut self) {
        for (body, now) in self.last.iter().enumerate() {
            self.record.peak(body, now);
        }
    }

    /// Records an instant of the grid.
    pub fn instant(&mut self, simulation: &Simulation) {
        for (id, _) in simulation.bodies() {
            let pose = simulation.pose(id);
            let q = pose.orientation.quaternion();
            self.record.rows.extend(self.last[id.index()]);
            self.record.rows.extend(pose.position.iter());
            self.record.rows.extend([q.w, q.i, q.j, q.k]);
        }
        let now = simulation.energy();
        self.record.energy_change = energy(simulation) - self.energy;
        let sizes = [now.kinetic, now.springs, self.record.energy_change].map(f64::abs);
        self.record.energy_scale = sizes.into_iter().fold(self.record.energy_scale, f64::max);
    }

    /// Returns the record.
    pub fn finish(self) -> Record {
        self.record
    }
}

fn energy(simulation: &Simulation) -> f64 {
    let energy = simulation.energy();
    energy.kinetic + energy.potential + energy.springs
}

fn six(simulation: &Simulation, id: pong_executive::BodyId) -> [f64; 6] {
    let wrench = simulation.contact_wrench(id);
    let (f, m) = (wrench.force, wrench.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

/// Norm of the force (0) or of the moment (1).
fn size(six: &[f64; 6], place: usize) -> f64 {
    vector(&six[3 * place..]).norm()
}
