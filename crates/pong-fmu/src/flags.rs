//! Flags of a frame for the importer, and the warnings that belong to them.

use pong_engine::{StatusBits, World};
use pong_executive::{LeftOut, deep_in_mesh_in_words, tunnelling_in_words};

/// Flags that change only at events.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Flags {
    pub touching: bool,
    pub tunnelled: bool,
    pub left_out: bool,
    pub deep_in_mesh: bool,
}

impl Flags {
    /// Adds the flags of a later frame: a warning stays set, and `touching` is that of the later frame.
    pub fn join(&mut self, later: Self) {
        self.touching = later.touching;
        self.tunnelled |= later.tunnelled;
        self.left_out |= later.left_out;
        self.deep_in_mesh |= later.deep_in_mesh;
    }
}

/// Flags already warned of in a run, and the text of the warnings that are still due.
#[derive(Default)]
pub(crate) struct Warnings {
    given: Flags,
    /// The frame of this run that left contacts out with the largest advised capacity.
    left_out: Option<LeftOut>,
    /// The last tunnelling: the primitive and what it passed through.
    tunnelled: Option<String>,
    /// The last solid deep in a mesh: the two bodies.
    deep_in_mesh: Option<String>,
}

impl Warnings {
    /// Flags of the last frame of a world. Keeps the names for a warning that is not given yet.
    pub fn flags_of(&mut self, world: &World) -> Flags {
        let report = world.report();
        self.left_out = self.left_out.max(LeftOut::of(world));
        let flags = Flags {
            touching: report.contacts > 0,
            tunnelled: report.status.contains(StatusBits::TUNNELLED),
            left_out: report.status.leaves_contacts_out(),
            deep_in_mesh: report.status.contains(StatusBits::DEEP_IN_MESH),
        };
        if flags.tunnelled && !self.given.tunnelled {
            self.tunnelled = tunnelling_in_words(world);
        }
        if flags.deep_in_mesh && !self.given.deep_in_mesh {
            self.deep_in_mesh = deep_in_mesh_in_words(world);
        }
        flags
    }

    /// Warnings of flags, each of which is given once in a run. `time` is the present time, s.
    pub fn due(&mut self, flags: Flags, time: f64) -> Vec<String> {
        let mut due = Vec::new();
        let tunnelled = self.tunnelled.as_ref().filter(|_| flags.tunnelled && !self.given.tunnelled);
        due.extend(tunnelled.map(|words| {
            format!(
                "contact: at t = {time} s something went through something else between two steps, {words}; make the \
                 steps shorter, the walls thicker or the surfaces stiffer"
            )
        }));
        let left_out = self.left_out.filter(|_| flags.left_out && !self.given.left_out);
        due.extend(left_out.map(|left_out| {
            format!(
                "contact: at t = {time} s {left_out}; write `contact_capacity: {}` into the scene and make the FMU \
                 again{}",
                left_out.advised,
                left_out.again()
            )
        }));
        let deep = self.deep_in_mesh.as_ref().filter(|_| flags.deep_in_mesh && !self.given.deep_in_mesh);
        due.extend(deep.map(|words| {
            format!(
                "contact: at t = {time} s a solid was deeper in a mesh than its facets push, {words}, and the force did \
                 not grow as it should; make the surfaces stiffer, or divide the mesh by `pong decompose` and make the \
                 FMU again"
            )
        }));
        self.given.join(flags);
        due
    }
}
