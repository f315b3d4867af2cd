//! Fields of a model, its surfaces, pairs of surfaces and groups.

use super::types::{Field, FieldDefault, Type};

/// Required field.
pub(super) const fn required(name: &'static str, value: Type, unit: &'static str) -> Field {
    Field { name, value, unit, default: FieldDefault::Required }
}

/// Field whose default is written here as in a file.
pub(super) const fn optional(
    name: &'static str,
    value: Type,
    unit: &'static str,
    default: &'static str,
) -> Field {
    Field { name, value, unit, default: FieldDefault::Value(default) }
}

/// Field whose default is described in words.
pub(super) const fn described(
    name: &'static str,
    value: Type,
    unit: &'static str,
    words: &'static str,
) -> Field {
    Field { name, value, unit, default: FieldDefault::Words(words) }
}

/// Fields of a file.
pub const MODEL: &[Field] = &[
    required("format", Type::Text, ""),
    required("version", Type::Whole, ""),
    required("name", Type::Text, ""),
    optional("entry_memory", Type::Boolean, "", "true"),
    required("surfaces", Type::Map(SURFACE), ""),
    optional("pairs", Type::List(PAIR), "", "[]"),
    optional("filters", FILTERS, "", "[]"),
    required("root", Type::Group, ""),
];

/// Type of the table of groups that never touch.
pub const FILTERS: Type = Type::Filters;

/// Fields of a surface.
pub const SURFACE: &[Field] = &[
    required("stiffness", Type::Stiffness, "N/m or N/m^1.5"),
    described("foundation", Type::FiniteStiffness, "N/m^3", "`stiffness` over `area`"),
    described("area", Type::Positive, "m^2", "a sixth of the outer area of each solid"),
    described("normal", Type::NormalLaw, "", "`Linear`; rigid: that of the other surface"),
    described("friction", Type::FrictionLaw, "", "`None`; rigid: that of the other surface"),
];

/// Fields of an entry for a pair of surfaces.
pub const PAIR: &[Field] = &[
    required("surfaces", Type::TextPair, ""),
    described("stiffness", Type::FiniteStiffness, "N/m or N/m^1.5", "that of the two in series"),
    described("normal", Type::NormalLaw, "", "that of the two surfaces"),
    described("friction", Type::FrictionLaw, "", "that of the two surfaces"),
];

/// Kinds of contact of a group: `Solid` shapes touch by the volume that they share, `Marked` ones where points,
/// segments and round parts meet faces.
pub const CONTACTS: &[&str] = &["Marked", "Solid"];

/// Fields of a group.
pub const GROUP: &[Field] = &[
    required("name", Type::Text, ""),
    described("movable", Type::Boolean, "", "`false`; root: `true`"),
    described("pose", Type::Record(POSE), "", "that of the group above"),
    described("bound", Type::Bound, "", "`Aabb` if movable, limited or above a volume, otherwise `Above`"),
    described("leaf_size", Type::Whole, "", "no limit"),
    described("surface", Type::Text, "", "that of the group above"),
    described("contact", Type::Word(CONTACTS), "", "that of the group above; root: `Marked`"),
    described("one_surface", Type::Boolean, "", "that of the group above; movable: `false`"),
    described("groups", Type::Groups, "", "none: the group holds primitives"),
    described("primitives", Type::Primitives, "", "none: the group holds groups"),
];

/// Fields of the pose of a group.
pub const POSE: &[Field] = &[
    optional("position", Type::Vector, "m", "(0.0, 0.0, 0.0)"),
    optional("orientation", Type::Rotation, "", "(1.0, 0.0, 0.0, 0.0)"),
];

/// Fields that every primitive has, before those of its kind.
pub const PRIMITIVE: &[Field] =
    &[required("name", Type::Text, ""), described("surface", Type::Text, "", "that of the group above")];
