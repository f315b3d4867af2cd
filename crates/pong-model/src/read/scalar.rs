//! Numbers, texts, vectors and rotations; invalid ones are refused with a reason.

use super::reader::Reader;
use crate::limits::{NumberFault, not_finite, out_of_range};
use crate::ron_tree::{Node, Value};
use crate::schema::{self, Kind};
use pong_geometry::{Quat, Vec3};

/// Largest deviation from 1 of the norm of an authored quaternion.
const QUATERNION_NORM_TOLERANCE: f64 = 1e-3;

impl Reader<'_> {
    fn wrong_type<T>(&mut self, node: &Node, path: &str, expected: &str) -> Option<T> {
        let cause = format!("expected {expected}, found {}", node.value.describe());
        self.refuse(node.at, path, "wrong-type", cause, format!("write {expected}"))
    }

    /// Reads any number, including infinity and NaN.
    pub(crate) fn any_number(&mut self, node: &Node, path: &str) -> Option<f64> {
        match node.value {
            Value::Number(value) => Some(value),
            _ => self.wrong_type(node, path, "a number"),
        }
    }

    /// Returns `true` if a number has no fault; otherwise reports the fault.
    fn has_none(&mut self, at: u32, path: &str, fault: Option<NumberFault>) -> bool {
        let Some((rule, cause, cure)) = fault else { return true };
        self.fault(at, path, rule, cause, cure);
        false
    }

    /// Reads a finite number of any size.
    pub(crate) fn finite(&mut self, node: &Node, path: &str) -> Option<f64> {
        let value = self.any_number(node, path)?;
        self.has_none(node.at, path, not_finite(value)).then_some(value)
    }

    /// Reads a finite number within ±[`LARGEST`](crate::LARGEST).
    pub(crate) fn number(&mut self, node: &Node, path: &str) -> Option<f64> {
        let value = self.any_number(node, path)?;
        self.has_none(node.at, path, out_of_range(value)).then_some(value)
    }

    /// Reads a positive number up to [`LARGEST`](crate::LARGEST).
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

    /// Reads a non-negative number up to [`LARGEST`](crate::LARGEST).
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

    /// Reads a list of finite numbers.
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

    /// Reads exactly `N` finite numbers in parentheses.
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

    /// Reads `(x, y, z)`.
    pub(crate) fn vector(&mut self, node: &Node, path: &str) -> Option<Vec3> {
        self.tuple::<3>(node, path, "a tuple of three numbers (x, y, z)").map(Vec3::from)
    }

    /// Reads `(a, b)`, both non-negative.
    pub(crate) fn not_negative_pair(&mut self, node: &Node, path: &str, what: &str) -> Option<[f64; 2]> {
        let pair = self.tuple::<2>(node, path, "a tuple of two numbers (at end 0, at end 1)")?;
        if pair.iter().all(|&x| x >= 0.0) {
            return Some(pair);
        }
        let cause = format!("{what} is {}", pair[0].min(pair[1]));
        self.refuse(node.at, path, "negative", cause, "it must be zero or above")
    }

    /// Reads `(true, false)`.
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

    /// Reads `N` tuples of three numbers.
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

    /// Reads a non-zero vector and normalises it.
    pub(crate) fn direction(&mut self, node: &Node, path: &str, what: &str) -> Option<Vec3> {
        let vector = self.vector(node, path)?;
        let largest = vector.amax();
        if largest > 0.0 {
            // Scaled first, so that tiny or huge components do not spoil the norm.
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

    /// Reads a quaternion `(w, x, y, z)` and normalises it.
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

    /// Name of a tuple or struct, or the name itself, for values like `Bristle(…)` or `None`.
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

    /// Kind of a named value.
    pub(crate) fn kind<T>(
        &mut self,
        node: &Node,
        path: &str,
        kinds: &'static [Kind<T>],
    ) -> Option<&'static Kind<T>> {
        let name = self.variant(node, path, &schema::names(kinds))?;
        kinds.iter().find(|kind| kind.name == name)
    }

    /// Items of a list.
    pub(crate) fn list<'n>(&mut self, node: &'n Node, path: &str) -> Option<&'n [Node]> {
        match &node.value {
            Value::List(items) => Some(items),
            Value::Rows(rows) if rows.len() == 0 => Some(&[]),
            _ => self.wrong_type(node, path, "a list in brackets"),
        }
    }
}
