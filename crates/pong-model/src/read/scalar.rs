//! Numbers, texts, vectors and rotations, each refused with a reason where it makes no sense.

use super::reader::Reader;
use crate::limits::{NumberFault, not_finite, out_of_range};
use crate::ron_tree::{Node, Value};
use pong_geometry::{Quat, Vec3};

/// How far the norm of an authored quaternion may be from 1.
const QUATERNION_NORM_TOLERANCE: f64 = 1e-3;

impl Reader<'_> {
    fn wrong_type<T>(&mut self, node: &Node, path: &str, expected: &str) -> Option<T> {
        let cause = format!("expected {expected}, found {}", node.value.describe());
        self.refuse(node.at, path, "wrong-type", cause, format!("write {expected}"))
    }

    /// Any number, infinite ones and NaN included.
    pub(crate) fn any_number(&mut self, node: &Node, path: &str) -> Option<f64> {
        match node.value {
            Value::Number(value) => Some(value),
            _ => self.wrong_type(node, path, "a number"),
        }
    }

    /// Whether a number has no fault; else it is noted.
    fn has_none(&mut self, at: u32, path: &str, fault: Option<NumberFault>) -> bool {
        let Some((rule, cause, cure)) = fault else { return true };
        self.fault(at, path, rule, cause, cure);
        false
    }

    /// A finite number of any size.
    pub(crate) fn finite(&mut self, node: &Node, path: &str) -> Option<f64> {
        let value = self.any_number(node, path)?;
        self.has_none(node.at, path, not_finite(value)).then_some(value)
    }

    /// A finite number, not beyond [`LARGEST`](crate::LARGEST).
    pub(crate) fn number(&mut self, node: &Node, path: &str) -> Option<f64> {
        let value = self.any_number(node, path)?;
        self.has_none(node.at, path, out_of_range(value)).then_some(value)
    }

    /// A number above zero, not beyond [`LARGEST`](crate::LARGEST).
    pub(crate) fn positive(&mut self, node: &Node, path: &str, what: &str) -> Option<f64> {
        let value = self.number(node, path)?;
        self.above_zero(node, path, what, value)
    }

    pub(crate) fn above_zero(&mut self, node: &Node, path: &str, what: &str, value: f64) -> Option<f64> {
        if value > 0.0 {
            return Some(value);
        }
        let cause = format!("{what} is {value}");
        self.refuse(node.at, path, "not-positive", cause, format!("{what} must be above zero"))
    }

    /// A finite number, zero or above.
    pub(crate) fn not_negative(&mut self, node: &Node, path: &str, what: &str) -> Option<f64> {
        let value = self.number(node, path)?;
        if value >= 0.0 {
            return Some(value);
        }
        let cause = format!("{what} is {value}");
        self.refuse(node.at, path, "negative", cause, format!("{what} must be zero or above"))
    }

    pub(crate) fn text(&mut self, node: &Node, path: &str) -> Option<String> {
        match &node.value {
            Value::Text(text) => Some(text.clone()),
            _ => self.wrong_type(node, path, "a text in quotes"),
        }
    }

    pub(crate) fn boolean(&mut self, node: &Node, path: &str) -> Option<bool> {
        match node.value {
            Value::Bool(value) => Some(value),
            _ => self.wrong_type(node, path, "true or false"),
        }
    }

    /// A list of numbers, finite ones.
    pub(crate) fn numbers(&mut self, node: &Node, path: &str) -> Option<Vec<f64>> {
        match &node.value {
            Value::List(items) => {
                let values: Vec<_> = items.iter().map(|item| self.number(item, path)).collect();
                values.into_iter().collect()
            }
            Value::Rows(rows) if rows.len() == 0 => Some(Vec::new()),
            _ => self.wrong_type(node, path, "a list of numbers"),
        }
    }

    /// Exactly `N` finite numbers in parentheses.
    fn tuple<const N: usize>(&mut self, node: &Node, path: &str, form: &str) -> Option<[f64; N]> {
        match &node.value {
            Value::Numbers(numbers) if numbers.len() == N => {
                let all = numbers.iter().all(|&x| self.has_none(node.at, path, out_of_range(x)));
                all.then(|| std::array::from_fn(|i| numbers[i]))
            }
            Value::Tuple(None, items) if items.len() == N => {
                let values = std::array::from_fn(|i| self.number(&items[i], path));
                if values.iter().any(Option::is_none) {
                    return None;
                }
                Some(values.map(Option::unwrap_or_default))
            }
            _ => self.wrong_type(node, path, form),
        }
    }

    /// `(x, y, z)`.
    pub(crate) fn vector(&mut self, node: &Node, path: &str) -> Option<Vec3> {
        self.tuple::<3>(node, path, "a tuple of three numbers (x, y, z)").map(Vec3::from)
    }

    /// `(a, b)`, neither below zero.
    pub(crate) fn not_negative_pair(&mut self, node: &Node, path: &str, what: &str) -> Option<[f64; 2]> {
        let pair = self.tuple::<2>(node, path, "a tuple of two numbers (at end 0, at end 1)")?;
        if pair.iter().all(|&x| x >= 0.0) {
            return Some(pair);
        }
        let cause = format!("{what} is {}", pair[0].min(pair[1]));
        self.refuse(node.at, path, "negative", cause, "it must be zero or above")
    }

    /// `(true, false)`.
    pub(crate) fn boolean_pair(&mut self, node: &Node, path: &str) -> Option<[bool; 2]> {
        let Value::Tuple(None, items) = &node.value else {
            return self.wrong_type(node, path, "a tuple of two of true and false");
        };
        let [one, other] = &items[..] else {
            return self.wrong_type(node, path, "a tuple of two of true and false");
        };
        let (one, other) = (self.boolean(one, path), self.boolean(other, path));
        Some([one?, other?])
    }

    /// `N` tuples of three numbers.
    pub(crate) fn vectors<const N: usize>(&mut self, node: &Node, path: &str) -> Option<[Vec3; N]> {
        match &node.value {
            Value::Tuple(None, items) if items.len() == N => {
                let values = std::array::from_fn(|i| self.vector(&items[i], path));
                if values.iter().any(Option::is_none) {
                    return None;
                }
                Some(values.map(Option::unwrap_or_default))
            }
            _ => self.wrong_type(node, path, &format!("a tuple of {N} places ((x, y, z), …)")),
        }
    }

    /// A vector that is not zero, made unit.
    pub(crate) fn direction(&mut self, node: &Node, path: &str, what: &str) -> Option<Vec3> {
        let vector = self.vector(node, path)?;
        let largest = vector.amax();
        if largest > 0.0 {
            // Scaled first, so that neither tiny nor huge components spoil the norm.
            return Some((vector / largest).normalize());
        }
        self.refuse(
            node.at,
            path,
            "zero-direction",
            format!("{what} is zero"),
            "give it a length; any will do",
        )
    }

    /// `(w, x, y, z)`, normalised.
    pub(crate) fn rotation(&mut self, node: &Node, path: &str) -> Option<Quat> {
        let [w, x, y, z] = self.tuple::<4>(node, path, "a quaternion (w, x, y, z)")?;
        let quaternion = nalgebra::Quaternion::new(w, x, y, z);
        let norm = quaternion.norm();
        if (norm - 1.0).abs() <= QUATERNION_NORM_TOLERANCE {
            return Some(Quat::new_normalize(quaternion));
        }
        let cause = format!("the norm of the quaternion is {norm}");
        self.refuse(node.at, path, "quaternion-norm", cause, "give w, x, y, z with w² + x² + y² + z² = 1")
    }

    /// The tuple's or struct's name, and the node itself, for values like `Bristle(…)` or `None`.
    pub(crate) fn variant<'n>(&mut self, node: &'n Node, path: &str, expected: &[&str]) -> Option<&'n str> {
        let name = match &node.value {
            Value::Name(name) => Some(name.as_ref()),
            Value::Struct(name, _) | Value::Tuple(name, _) => name.as_deref(),
            _ => None,
        };
        match name {
            Some(name) if expected.contains(&name) => Some(name),
            Some(name) => {
                let cause = format!("`{name}` is not known here");
                self.refuse(node.at, path, "unknown-kind", cause, super::suggest::cure(name, expected))
            }
            None => self.wrong_type(node, path, &format!("one of {}", expected.join(", "))),
        }
    }

    /// The items of a list.
    pub(crate) fn list<'n>(&mut self, node: &'n Node, path: &str) -> Option<&'n [Node]> {
        match &node.value {
            Value::List(items) => Some(items),
            Value::Rows(rows) if rows.len() == 0 => Some(&[]),
            _ => self.wrong_type(node, path, "a list in brackets"),
        }
    }
}
