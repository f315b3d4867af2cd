//! Shortest vector in exact arithmetic, by trying every set of at most three contacts with big integers.

use super::super::SharedContact;
use pong_geometry::Vec3;
use std::cmp::Ordering;

/// All input numbers must be multiples of 2^-`SCALE`.
const SCALE: i32 = 90;

/// Rounds to a multiple of 2^-`SCALE`.
pub(super) fn rounded(x: f64) -> f64 {
    (x * libm::ldexp(1.0, SCALE)).round() * libm::ldexp(1.0, -SCALE)
}

/// A big integer: sign, and digits in base 2^32, lowest first.
#[derive(Clone, Debug)]
struct Whole {
    negative: bool,
    digits: Vec<u32>,
}

impl Whole {
    /// The integer x·2^`SCALE`.
    fn new(x: f64) -> Self {
        let scaled = x.abs() * libm::ldexp(1.0, SCALE);
        assert!(scaled < libm::ldexp(1.0, 120) && scaled.fract() == 0.0, "{x}");
        let value = scaled as u128;
        let digits = (0..4).map(|k| (value >> (32 * k)) as u32).collect();
        Self { negative: x < 0.0, digits }.trimmed()
    }

    fn zero() -> Self {
        Self { negative: false, digits: Vec::new() }
    }

    fn trimmed(mut self) -> Self {
        while self.digits.last() == Some(&0) {
            self.digits.pop();
        }
        self
    }

    fn sign(&self) -> i32 {
        match (self.digits.is_empty(), self.negative) {
            (true, _) => 0,
            (_, true) => -1,
            _ => 1,
        }
    }

    fn times(&self, other: &Self) -> Self {
        let mut digits = vec![0_u32; self.digits.len() + other.digits.len() + 1];
        for (i, &a) in self.digits.iter().enumerate() {
            let mut carry = 0_u64;
            for (j, &b) in other.digits.iter().enumerate() {
                let sum = u64::from(digits[i + j]) + u64::from(a) * u64::from(b) + carry;
                digits[i + j] = sum as u32;
                carry = sum >> 32;
            }
            digits[i + other.digits.len()] = carry as u32;
        }
        Self { negative: self.negative != other.negative, digits }.trimmed()
    }

    fn negated(&self) -> Self {
        Self { negative: !self.negative, digits: self.digits.clone() }
    }

    fn plus(&self, other: &Self) -> Self {
        if self.negative == other.negative {
            let mut digits = Vec::new();
            let mut carry = 0_u64;
            for k in 0..self.digits.len().max(other.digits.len()) + 1 {
                let digit = |of: &Self| u64::from(of.digits.get(k).copied().unwrap_or(0));
                let sum = digit(self) + digit(other) + carry;
                digits.push(sum as u32);
                carry = sum >> 32;
            }
            return Self { negative: self.negative, digits }.trimmed();
        }
        let (large, small) = if self.is_longer(other) { (self, other) } else { (other, self) };
        let mut borrow = 0_i64;
        let mut digits = Vec::new();
        for (k, &digit) in large.digits.iter().enumerate() {
            let rest = i64::from(digit) - i64::from(small.digits.get(k).copied().unwrap_or(0)) - borrow;
            borrow = i64::from(rest < 0);
            digits.push((rest + (borrow << 32)) as u32);
        }
        Self { negative: large.negative, digits }.trimmed()
    }

    fn is_longer(&self, other: &Self) -> bool {
        let order = self.digits.len().cmp(&other.digits.len());
        order.then_with(|| self.digits.iter().rev().cmp(other.digits.iter().rev())) == Ordering::Greater
    }

    /// Value of the four leading digits, and the number of digits below them.
    fn leading(&self) -> (f64, i32) {
        let top = self.digits.len().saturating_sub(4);
        let value = self.digits[top..]
            .iter()
            .rev()
            .fold(0.0, |sum, &digit| sum * libm::ldexp(1.0, 32) + f64::from(digit));
        (if self.negative { -value } else { value }, top as i32)
    }

    fn over(&self, other: &Self) -> f64 {
        let ((a, m), (b, n)) = (self.leading(), other.leading());
        a / b * libm::ldexp(1.0, 32 * (m - n))
    }
}

fn sum(terms: impl Iterator<Item = Whole>) -> Whole {
    terms.fold(Whole::zero(), |sum, term| sum.plus(&term))
}

fn dot(a: &[Whole; 3], b: &[Whole; 3]) -> Whole {
    sum((0..3).map(|axis| a[axis].times(&b[axis])))
}

/// Determinant of a matrix of at most three rows.
fn determinant(rows: &[Vec<Whole>]) -> Whole {
    match rows.len() {
        1 => rows[0][0].clone(),
        size => sum((0..size).map(|column| {
            let without = |row: &Vec<Whole>| {
                row.iter().enumerate().filter(|(k, _)| *k != column).map(|(_, x)| x.clone()).collect()
            };
            let minor: Vec<Vec<Whole>> = rows[1..].iter().map(without).collect();
            let term = rows[0][column].times(&determinant(&minor));
            if column % 2 == 0 { term } else { term.negated() }
        })),
    }
}

/// Shortest t with n·t ≥ δ for all contacts, rounded at the end, the number of contacts that determine it,
/// and their Σ λ/δ.
pub(super) fn shortest(contacts: &[SharedContact]) -> (Vec3, usize, f64) {
    let normals: Vec<[Whole; 3]> =
        contacts.iter().map(|c| std::array::from_fn(|axis| Whole::new(c.normal_b[axis]))).collect();
    let depths: Vec<Whole> = contacts.iter().map(|c| Whole::new(c.depth)).collect();
    let gram: Vec<Vec<Whole>> = normals.iter().map(|a| normals.iter().map(|b| dot(a, b)).collect()).collect();
    let sets = (1..1_usize << contacts.len()).filter(|set| set.count_ones() <= 3);
    for set in sets {
        let members: Vec<usize> = (0..contacts.len()).filter(|k| set >> k & 1 == 1).collect();
        let rows: Vec<Vec<Whole>> =
            members.iter().map(|&i| members.iter().map(|&j| gram[i][j].clone()).collect()).collect();
        let whole = determinant(&rows);
        if whole.sign() == 0 {
            continue;
        }
        // Cramer's rule; the determinant of a regular Gram matrix is positive.
        let lambda = |column: usize| {
            let mut rows = rows.clone();
            rows.iter_mut().zip(&members).for_each(|(row, &i)| row[column] = depths[i].clone());
            determinant(&rows)
        };
        let lambdas: Vec<Whole> = (0..members.len()).map(lambda).collect();
        let clears = |j: usize| {
            let reached = sum(members.iter().zip(&lambdas).map(|(&i, lambda)| lambda.times(&gram[i][j])));
            reached.plus(&depths[j].times(&whole).negated()).sign() >= 0
        };
        if lambdas.iter().all(|lambda| lambda.sign() > 0) && (0..contacts.len()).all(clears) {
            let unit = libm::ldexp(1.0, SCALE);
            let t = |axis: usize| {
                let along = members.iter().zip(&lambdas).map(|(&i, lambda)| lambda.times(&normals[i][axis]));
                sum(along).over(&whole)
            };
            let weights: f64 = members
                .iter()
                .zip(&lambdas)
                .map(|(&i, lambda)| lambda.over(&whole) * unit / contacts[i].depth)
                .sum();
            return (Vec3::from_fn(|axis, _| t(axis)), members.len(), weights);
        }
    }
    panic!("some set clears all contacts: {contacts:?}");
}
