//! Forms of the tables.

/// Named value `Name(field: …)`: a primitive or a law.
#[derive(Debug)]
pub struct Kind<T: 'static> {
    /// Variant that the name stands for.
    pub tag: T,
    /// Name in a file.
    pub name: &'static str,
    /// Fields in the order of writing; of a primitive without `name` and `surface`.
    pub fields: &'static [Field],
}

impl<T> Kind<T> {
    /// Fields of the struct that is the value of this field; empty if there is none.
    pub fn nested(&self, field: &str) -> &'static [Field] {
        self.fields.iter().find(|f| f.name == field).map_or(&[], |f| f.value.fields())
    }
}

/// Field of a struct.
#[derive(Debug)]
pub struct Field {
    /// Name in a file.
    pub name: &'static str,
    /// Type of the value.
    pub value: Type,
    /// Unit, as in `m` or `N/m`; empty for a value without one.
    pub unit: &'static str,
    /// Meaning of a field that is left out.
    pub default: FieldDefault,
}

/// Meaning of a field that is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldDefault {
    /// It must not be left out.
    Required,
    /// Value of the same effect, written as in a file.
    Value(&'static str),
    /// A value that depends on others or the absence of one, in words.
    Words(&'static str),
}

/// Type of a field.
#[derive(Clone, Copy, Debug)]
pub enum Type {
    /// Finite number.
    Number,
    /// Number above zero.
    Positive,
    /// Number from zero.
    NotNegative,
    /// Number above zero, or `inf`.
    Stiffness,
    /// Number above zero within the range of stiffnesses.
    FiniteStiffness,
    /// 1.0 or 1.5.
    Exponent,
    /// Number above 0 and at most 1.
    Restitution,
    /// Whole number from 1.
    Whole,
    /// `true` or `false`.
    Boolean,
    /// `(true, false)`.
    BooleanPair,
    /// Text in quotation marks.
    Text,
    /// Two texts.
    TextPair,
    /// Three numbers.
    Vector,
    /// Three numbers that are not all zero.
    Direction,
    /// Three numbers above zero.
    SemiAxes,
    /// Unit quaternion (w, x, y, z).
    Rotation,
    /// Two vectors.
    VectorPair,
    /// Three vectors.
    VectorTriple,
    /// Two numbers from zero.
    Radii,
    /// List of numbers.
    Numbers,
    /// List of whole numbers from 0.
    Indices,
    /// List of vectors.
    Vertices,
    /// List of three indices each, in parentheses.
    Triangles,
    /// List of lists of indices.
    Faces,
    /// One of these names.
    Word(&'static [&'static str]),
    /// Kind of bounding volume; `Custom` with the name of a registered kind.
    Bound,
    /// Normal law.
    NormalLaw,
    /// Friction law.
    FrictionLaw,
    /// Fields in parentheses.
    Record(&'static [Field]),
    /// Map from a name to the fields in parentheses.
    Map(&'static [Field]),
    /// List of the fields in parentheses.
    List(&'static [Field]),
    /// Pairs of names of groups.
    Filters,
    /// Group.
    Group,
    /// List of groups.
    Groups,
    /// List of primitives.
    Primitives,
}

impl Type {
    /// Name for tools and tables.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Number => "number",
            Self::Positive => "positive",
            Self::NotNegative => "not_negative",
            Self::Stiffness => "stiffness",
            Self::FiniteStiffness => "finite_stiffness",
            Self::Exponent => "exponent",
            Self::Restitution => "restitution",
            Self::Whole => "whole",
            Self::Boolean => "boolean",
            Self::BooleanPair => "booleans",
            Self::Text => "text",
            Self::TextPair => "texts",
            Self::Vector => "vector",
            Self::Direction => "direction",
            Self::SemiAxes => "semi_axes",
            Self::Rotation => "rotation",
            Self::VectorPair => "vectors2",
            Self::VectorTriple => "vectors3",
            Self::Radii => "radii",
            Self::Numbers => "numbers",
            Self::Indices => "indices",
            Self::Vertices => "vertices",
            Self::Triangles => "triangles",
            Self::Faces => "faces",
            Self::Word(_) => "word",
            Self::Bound => "bound",
            Self::NormalLaw => "normal_law",
            Self::FrictionLaw => "friction_law",
            Self::Record(_) => "record",
            Self::Map(_) => "map",
            Self::List(_) => "list",
            Self::Filters => "filters",
            Self::Group => "group",
            Self::Groups => "groups",
            Self::Primitives => "primitives",
        }
    }

    /// Fields of the struct, or of each struct in the map or list; empty for other types and for groups.
    pub fn fields(&self) -> &'static [Field] {
        match self {
            Self::Record(fields) | Self::Map(fields) | Self::List(fields) => fields,
            _ => &[],
        }
    }

    /// Returns `true` if its numbers are written without a decimal point.
    pub fn is_whole(&self) -> bool {
        matches!(self, Self::Whole | Self::Indices | Self::Triangles | Self::Faces)
    }
}
