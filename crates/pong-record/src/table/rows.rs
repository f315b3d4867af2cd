//! The rows of each table. The order of the fields here is the order in the file.

use super::field::Field;
use super::value::Value;

/// A row of a table.
pub trait Row: Copy {
    /// Name of the table and of its file.
    const TABLE: &'static str;
    /// The fields in order.
    const FIELDS: &'static [Field];
    /// Bytes of a row as it is written.
    const SIZE: usize;

    /// Appends the bytes of the row to `out`.
    fn put(&self, out: &mut Vec<u8>);
    /// Reads a row with its fields at these offsets.
    fn get(bytes: &[u8], offsets: &[usize]) -> Self;
    /// The first field, from `first` on, in which two rows differ, with both values in words.
    fn difference(
        &self,
        other: &Self,
        first: usize,
        same: &dyn Fn(&str, f64, f64) -> bool,
    ) -> Option<(&'static str, String, String)>;
    /// Calls back with the name of every field and the largest magnitude in it.
    fn magnitudes(&self, each: &mut dyn FnMut(&'static str, f64));
}

macro_rules! row {
    ($(#[$doc:meta])* $name:ident in $table:literal { $($(#[$field_doc:meta])* $field:ident: $type:ty),* $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct $name {
            $($(#[$field_doc])* pub $field: $type),*
        }

        impl Row for $name {
            const TABLE: &'static str = $table;
            const FIELDS: &'static [Field] = &[$(Field {
                name: stringify!($field),
                kind: <$type as Value>::KIND,
                count: <$type as Value>::COUNT,
                size: <$type as Value>::SIZE,
            }),*];
            const SIZE: usize = 0 $(+ <$type as Value>::SIZE)*;

            fn put(&self, out: &mut Vec<u8>) {
                $(self.$field.put(out);)*
            }

            fn get(bytes: &[u8], offsets: &[usize]) -> Self {
                let mut offsets = offsets.iter();
                $(let $field = Value::get(&bytes[*offsets.next().expect("one for each field")..]);)*
                Self { $($field),* }
            }

            fn difference(
                &self,
                other: &Self,
                first: usize,
                same: &dyn Fn(&str, f64, f64) -> bool,
            ) -> Option<(&'static str, String, String)> {
                let mut index = 0;
                $(
                    let here = |a: f64, b: f64| same(stringify!($field), a, b);
                    if index >= first && !self.$field.agrees(&other.$field, &here) {
                        return Some((stringify!($field), self.$field.words(), other.$field.words()));
                    }
                    index += 1;
                )*
                let _ = index;
                None
            }

            fn magnitudes(&self, each: &mut dyn FnMut(&'static str, f64)) {
                $(each(stringify!($field), self.$field.magnitude());)*
            }
        }
    };
}

row! {
    /// A frame: its number, its time and the range of its contacts.
    FrameRow in "frames" {
        /// Number of the frame, from 0; lost frames leave a gap.
        frame: u64,
        /// Time, s.
        time: f64,
        /// Its first row in the table of contacts.
        first_contact: u64,
        /// Number of its contacts.
        contacts: u32,
        /// Limits that the frame hit, as in [`pong_engine::StatusBits`].
        flags: u32,
        /// Duration of the evaluation, ns; 0 without a clock.
        evaluate_ns: u64,
        /// Kind of commit: one of [`FrameRow::EVALUATED`], [`FrameRow::COMMITTED`],
        /// [`FrameRow::COMMITTED_SOME`].
        committed: u32,
        /// Commits since the previous frame whose frames are not in the log.
        commits_missed: u32,
    }
}

impl FrameRow {
    /// The frame was evaluated and not committed.
    pub const EVALUATED: u32 = 0;
    /// The frame was committed.
    pub const COMMITTED: u32 = 1;
    /// Some of its pairs were committed: an event has the list.
    pub const COMMITTED_SOME: u32 = 2;
}

row! {
    /// The state of a body as the host set it; NaN if it was never set.
    StateRow in "states" {
        /// Position of the group's origin, m.
        position: [f64; 3],
        /// Quaternion (w, x, y, z).
        orientation: [f64; 4],
        /// Velocity of the group's origin, m/s.
        linear_velocity: [f64; 3],
        /// Angular velocity, rad/s.
        angular_velocity: [f64; 3],
    }
}

row! {
    /// The wrench of all contacts on a body, along the common axes.
    WrenchRow in "wrenches" {
        /// Force, N.
        force: [f64; 3],
        /// Moment about the group's origin, N·m.
        moment: [f64; 3],
    }
}

row! {
    /// A contact; vectors along the common axes.
    ContactRow in "contacts" {
        /// Number of its frame.
        frame: u64,
        /// Index in the pairs of the log.
        pair: u32,
        /// Index in the primitives of the log.
        primitive_a: u32,
        /// Index in the primitives of the log.
        primitive_b: u32,
        /// Triangle of a mesh, from 0; 0 otherwise.
        element_a: u32,
        /// Triangle of a mesh, from 0; 0 otherwise.
        element_b: u32,
        /// Feature of B that pushes: 0 face, 1 edge, 2 vertex.
        feature_kind: u32,
        /// Index of that face, edge or vertex.
        feature_index: u32,
        /// End of an elongated body: 0 and 1 at its ends, 2 and above between them.
        end: u32,
        /// 1 if friction sticks.
        sticks: u32,
        /// Point at which the force acts, m.
        point: [f64; 3],
        /// Unit normal from B to A.
        normal: [f64; 3],
        /// Depth, m.
        depth: f64,
        /// Rate of the depth, m/s, positive while closing.
        depth_rate: f64,
        /// Share of the pair's spring, 0 to 1.
        weight: f64,
        /// Normal force, N.
        normal_force: f64,
        /// Friction force on A, N.
        friction_force: [f64; 3],
        /// Tangential velocity of A against B, m/s.
        slip_velocity: [f64; 3],
        /// Stored energy, J.
        stored: f64,
    }
}

row! {
    /// Energies of a frame, J.
    EnergyRow in "energies" {
        /// Kinetic energy.
        kinetic: f64,
        /// Potential energy in gravity.
        potential: f64,
        /// Energy in springs.
        springs: f64,
        /// Energy stored in contacts.
        contacts: f64,
        /// Energy lost in contacts.
        contact_loss: f64,
        /// Energy lost in springs.
        spring_loss: f64,
        /// Work of loads and prescribed bodies.
        work_in: f64,
        /// Balance of all terms, constant in a good run.
        balance: f64,
    }
}

row! {
    /// Tangent of two movable groups that touch in a frame: derivatives of their wrenches on each other, along common
    /// axes. Rows of a matrix: force and moment of the first group, then of the second, about their origins. Columns:
    /// translation and rotation of the first group, then of the second.
    TangentRow in "tangents" {
        /// Number of the frame.
        frame: u64,
        /// Time of the frame, s.
        time: f64,
        /// Index of the first group in the bodies of the log.
        body_a: u32,
        /// Index of the second group.
        body_b: u32,
        /// 1 if central differences gave the matrices.
        by_differences: u32,
        /// −∂W/∂x, N/m, N/rad, N, N·m/rad.
        stiffness: [[f64; 12]; 12],
        /// −∂W/∂v, N·s/m, N·s/rad, N·s, N·m·s/rad.
        damping: [[f64; 12]; 12],
    }
}
