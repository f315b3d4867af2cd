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

    /// Appends the bytes of the row.
    fn put(&self, out: &mut Vec<u8>);
    /// Reads a row whose fields begin at these offsets.
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
    /// A frame: its number, its time, where its contacts are.
    FrameRow in "frames" {
        /// Number of the frame, from 0; a gap is frames that were lost.
        frame: u64,
        /// Time, s.
        time: f64,
        /// Its first row in the table of contacts.
        first_contact: u64,
        /// How many rows there.
        contacts: u32,
        /// What the frame left out, as in [`pong_engine::StatusBits`].
        flags: u32,
        /// Duration of the evaluation, ns; 0 without a clock.
        evaluate_ns: u64,
        /// What became of the frame: one of [`FrameRow::EVALUATED`], [`FrameRow::COMMITTED`],
        /// [`FrameRow::COMMITTED_SOME`].
        committed: u32,
        /// Commits since the frame before that belong to no frame of the log.
        commits_missed: u32,
    }
}

impl FrameRow {
    /// The frame was evaluated and not committed.
    pub const EVALUATED: u32 = 0;
    /// The frame was committed.
    pub const COMMITTED: u32 = 1;
    /// Some pairs of it were committed: an event tells which.
    pub const COMMITTED_SOME: u32 = 2;
}

row! {
    /// The state of a body as the host set it; NaN if it never did.
    StateRow in "states" {
        /// Of the group's origin, m.
        position: [f64; 3],
        /// Quaternion (w, x, y, z).
        orientation: [f64; 4],
        /// Of the group's origin, m/s.
        linear_velocity: [f64; 3],
        /// rad/s.
        angular_velocity: [f64; 3],
    }
}

row! {
    /// The wrench of all contacts on a body, along the common axes.
    WrenchRow in "wrenches" {
        /// N.
        force: [f64; 3],
        /// About the group's origin, N·m.
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
        /// What of B pushes: 0 face, 1 edge, 2 vertex.
        feature_kind: u32,
        /// Which face, edge or vertex.
        feature_index: u32,
        /// Of a body with two ends: 0 and 1 at its ends, 2 and above between them.
        end: u32,
        /// 1 if friction sticks.
        sticks: u32,
        /// Where the force acts, m.
        point: [f64; 3],
        /// Unit normal from B to A.
        normal: [f64; 3],
        /// m.
        depth: f64,
        /// m/s, positive while closing.
        depth_rate: f64,
        /// Share of the pair's spring, 0 to 1.
        weight: f64,
        /// N.
        normal_force: f64,
        /// On A, N.
        friction_force: [f64; 3],
        /// Of A against B, m/s.
        slip_velocity: [f64; 3],
        /// J.
        stored: f64,
    }
}

row! {
    /// Energies of a frame, J.
    EnergyRow in "energies" {
        /// Of motion.
        kinetic: f64,
        /// In gravity.
        potential: f64,
        /// In springs.
        springs: f64,
        /// Stored in contacts.
        contacts: f64,
        /// Lost in contacts.
        contact_loss: f64,
        /// Lost in springs.
        spring_loss: f64,
        /// Work of loads and prescribed bodies.
        work_in: f64,
        /// All terms: what a good run keeps.
        balance: f64,
    }
}
