//! Vertices in a tree of fitted oriented boxes, for support queries and the diameter.
//!
//! A patch of a round body lies flat in its box, so a plane that touches the body there meets few boxes.
//! Checking every vertex against every face then takes about as many steps as there are faces.

use nalgebra::{Matrix3, SymmetricEigen};
use pong_geometry::Vec3;

/// Maximum number of vertices of a leaf.
const LEAF: usize = 16;
/// Number of vertices up to which all pairs are compared.
const FEW: usize = 256;
/// Rounding of a bound, relative to the size of what it bounds.
const ROUNDING: f64 = 1e-12;

/// Box around some of the vertices.
struct Node {
    center: Vec3,
    /// Half-extent vectors of the box.
    half: [Vec3; 3],
    /// Half the box's diagonal.
    radius: f64,
    range: std::ops::Range<usize>,
    /// Index of the second child; the first follows its parent. Zero for a leaf.
    second: usize,
}

/// Vertices and the tree over them.
pub(crate) struct Places {
    /// Positions in leaf order.
    places: Vec<Vec3>,
    /// Original index of each vertex.
    numbers: Vec<u32>,
    nodes: Vec<Node>,
    /// Number of boxes visited since the tree was built.
    #[cfg(test)]
    pub(super) looked: std::cell::Cell<u64>,
}

impl Node {
    /// Extent of the box from its centre along a direction.
    fn reach(&self, direction: &Vec3) -> f64 {
        let [first, second, third] = &self.half;
        first.dot(direction).abs() + second.dot(direction).abs() + third.dot(direction).abs()
    }

    fn bound(&self, normal: &Vec3, offset: f64) -> f64 {
        normal.dot(&self.center) - offset + self.reach(normal) + ROUNDING * self.radius
    }
}

impl Places {
    pub(crate) fn new(points: &[Vec3]) -> Self {
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        let mut nodes = Vec::new();
        grow(points, &mut order, 0, &mut nodes);
        Self {
            places: order.iter().map(|&i| points[i as usize]).collect(),
            numbers: order,
            nodes,
            #[cfg(test)]
            looked: std::cell::Cell::default(),
        }
    }

    /// Highest of the vertices that lie more than `floor` above a plane and are `wanted`: height and index
    /// (ties: lowest index).
    pub(super) fn highest(
        &self,
        (normal, offset): (&Vec3, f64),
        floor: f64,
        wanted: impl Fn(u32) -> bool,
    ) -> Option<(f64, u32)> {
        let mut best: Option<(f64, u32)> = None;
        let mut open = vec![(0, self.nodes[0].bound(normal, offset))];
        while let Some((index, bound)) = open.pop() {
            let node = &self.nodes[index];
            self.look();
            if bound < best.map_or(floor, |(height, _)| height) {
                continue;
            }
            if node.second == 0 {
                for place in node.range.clone() {
                    let height = normal.dot(&self.places[place]) - offset;
                    let number = self.numbers[place];
                    let better = best.is_none_or(|(h, n)| height > h || (height == h && number < n));
                    if height > floor && better && wanted(number) {
                        best = Some((height, number));
                    }
                }
                continue;
            }
            open.extend(self.children(index, (normal, offset)));
        }
        best
    }

    /// Returns `true` if a vertex lies more than `floor` above a plane.
    pub(crate) fn any_above(&self, (normal, offset): (&Vec3, f64), floor: f64) -> bool {
        let mut open = vec![(0, self.nodes[0].bound(normal, offset))];
        while let Some((index, bound)) = open.pop() {
            let node = &self.nodes[index];
            self.look();
            if bound < floor {
                continue;
            }
            if node.second == 0 {
                if self.places[node.range.clone()].iter().any(|place| normal.dot(place) - offset > floor) {
                    return true;
                }
                continue;
            }
            open.extend(self.children(index, (normal, offset)));
        }
        false
    }

    /// Children of a node with their bounds, the more promising one last, because it is visited first.
    fn children(&self, index: usize, (normal, offset): (&Vec3, f64)) -> [(usize, f64); 2] {
        let with_bound = |child: usize| (child, self.nodes[child].bound(normal, offset));
        let (first, second) = (with_bound(index + 1), with_bound(self.nodes[index].second));
        if first.1 < second.1 { [first, second] } else { [second, first] }
    }

    /// Counts a visited box, for tests that measure the work.
    fn look(&self) {
        #[cfg(test)]
        self.looked.set(self.looked.get() + 1);
    }

    /// Largest distance between two vertices.
    pub(super) fn diameter(&self) -> f64 {
        let mut best: f64 = 0.0;
        let mut from = self.places[0];
        // A pair that is far apart from the start leaves little to search.
        for _ in 0..4 {
            let farther =
                |a: &&Vec3, b: &&Vec3| (*a - from).norm_squared().total_cmp(&(*b - from).norm_squared());
            let Some(farthest) = self.places.iter().max_by(farther) else { break };
            best = best.max((farthest - from).norm_squared());
            from = *farthest;
        }
        let mut open = vec![(0, 0)];
        while let Some((a, b)) = open.pop() {
            let (first, second) = (&self.nodes[a], &self.nodes[b]);
            if a != b && farthest_between(first, second) < best {
                continue;
            }
            match (first.second, second.second) {
                (0, 0) => {
                    for p in &self.places[first.range.clone()] {
                        for q in &self.places[second.range.clone()] {
                            best = best.max((p - q).norm_squared());
                        }
                    }
                }
                _ if a == b => {
                    open.extend([(a + 1, a + 1), (first.second, first.second), (a + 1, first.second)])
                }
                (0, other) => open.extend([(a, b + 1), (a, other)]),
                (other, 0) => open.extend([(a + 1, b), (other, b)]),
                (one, other) => {
                    let children = if first.radius > second.radius {
                        [(a + 1, b), (one, b)]
                    } else {
                        [(a, b + 1), (a, other)]
                    };
                    open.extend(children);
                }
            }
        }
        best.sqrt()
    }
}

/// Largest distance between two vertices; by comparing all pairs if there are few.
pub(crate) fn diameter(places: &[Vec3], tree: &Places) -> f64 {
    if places.len() > FEW {
        return tree.diameter();
    }
    let mut largest: f64 = 0.0;
    for (index, a) in places.iter().enumerate() {
        for b in &places[index + 1..] {
            largest = largest.max((a - b).norm_squared());
        }
    }
    largest.sqrt()
}

/// Upper bound of the squared distance between a point of one box and a point of the other.
fn farthest_between(a: &Node, b: &Node) -> f64 {
    let between = b.center - a.center;
    let distance = between.norm();
    let both = a.radius + b.radius;
    if distance <= both {
        return (distance + both) * (distance + both) * (1.0 + ROUNDING);
    }
    let direction = between / distance;
    let along = distance + a.reach(&direction) + b.reach(&direction);
    (along * along + both * both) * (1.0 + ROUNDING)
}

/// Adds the box of some vertices, and recursively of both halves of them.
fn grow(points: &[Vec3], order: &mut [u32], start: usize, nodes: &mut Vec<Node>) {
    let (node, longest) = fitted(points, order, start..start + order.len());
    let index = nodes.len();
    nodes.push(node);
    if order.len() <= LEAF {
        return;
    }
    let middle = order.len() / 2;
    let along = |i: &u32| longest.dot(&points[*i as usize]);
    order.select_nth_unstable_by(middle, |a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
    let (low, high) = order.split_at_mut(middle);
    grow(points, low, start, nodes);
    nodes[index].second = nodes.len();
    grow(points, high, start + middle, nodes);
}

/// Box around vertices along their principal axes, and the axis of largest extent.
fn fitted(points: &[Vec3], order: &[u32], range: std::ops::Range<usize>) -> (Node, Vec3) {
    let count = order.len() as f64;
    // Scaled, so that squares do not overflow.
    let first = points[order[0] as usize];
    let from_first = |i: &u32| points[*i as usize] - first;
    let size = order.iter().map(|i| from_first(i).amax()).fold(f64::MIN_POSITIVE, f64::max);
    let mean = order.iter().map(|i| from_first(i) / size).sum::<Vec3>() / count;
    let spread = order.iter().fold(Matrix3::zeros(), |sum, i| {
        let from_mean = from_first(i) / size - mean;
        sum + from_mean * from_mean.transpose()
    });
    let axes = SymmetricEigen::new(spread / count).eigenvectors;
    let mut center = first;
    let mut half = [Vec3::zeros(); 3];
    for (axis, half) in half.iter_mut().enumerate() {
        let axis: Vec3 = axes.column(axis).into_owned();
        let reach = order.iter().map(|i| axis.dot(&from_first(i)));
        let (low, high) = reach.fold((0.0_f64, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        center += axis * (0.5 * (low + high));
        // Enlarged for the rounding of the axes and of the centre.
        *half = axis * (0.5 * (high - low) + ROUNDING * size);
    }
    let longest = half.iter().max_by(|a, b| a.norm().total_cmp(&b.norm())).copied().unwrap_or_default();
    let radius = half.iter().map(Vec3::norm_squared).sum::<f64>().sqrt();
    (Node { center, half, radius, range, second: 0 }, longest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on an ellipsoid, with single-precision coordinates, far from the origin.
    fn egg(count: usize) -> Vec<Vec3> {
        let place = |k: usize| {
            let (height, turn) = (1.0 - (2 * k + 1) as f64 / count as f64, 2.399_963 * k as f64);
            let round = (1.0 - height * height).sqrt();
            let place = Vec3::new(3.0 * round * libm::cos(turn) + 9.0, 2.0 * round * libm::sin(turn), height);
            place.map(|x| f64::from(x as f32))
        };
        (0..count).map(place).collect()
    }

    #[test]
    fn the_tree_finds_what_trying_all_finds() {
        for count in [1, 2, 17, 300, 1111] {
            let points = egg(count);
            let tree = Places::new(&points);
            let pairs = points.iter().flat_map(|a| points.iter().map(move |b| (a - b).norm_squared()));
            assert_eq!(tree.diameter(), pairs.fold(0.0, f64::max).sqrt(), "{count}");
            for normal in points.iter().map(|p| (p - Vec3::new(8.0, 1.0, 0.3)).normalize()) {
                let offset = normal.dot(&Vec3::new(9.0, 0.1, 0.2));
                let heights = points.iter().zip(0..).map(|(p, i)| (normal.dot(p) - offset, i));
                let highest = |floor, odd| {
                    let above = heights.clone().filter(|(h, i)| *h > floor && i % 2 >= odd);
                    above.max_by(|a: &(f64, u32), b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))
                };
                assert_eq!(tree.highest((&normal, offset), 0.4, |_| true), highest(0.4, 0), "{count}");
                assert_eq!(tree.highest((&normal, offset), 0.0, |i| i % 2 == 1), highest(0.0, 1), "{count}");
                for floor in [-1.0, 0.0, 0.4, 1.5, 3.0] {
                    let above = heights.clone().any(|(height, _)| height > floor);
                    assert_eq!(tree.any_above((&normal, offset), floor), above, "{count} {floor}");
                }
            }
        }
    }
}
