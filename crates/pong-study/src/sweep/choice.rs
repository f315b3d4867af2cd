//! Choice of the levels that are worth their time.

/// Frame time and error of a level that reached the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Frame time, in any unit.
    pub time: f64,
    /// Relative error.
    pub error: f64,
}

/// For each point, true if it is on the Pareto front: no other point is as good in both values and better in
/// one.
pub fn front(points: &[Point]) -> Vec<bool> {
    let beats = |a: &Point, b: &Point| {
        a.time <= b.time && a.error <= b.error && (a.time < b.time || a.error < b.error)
    };
    points.iter().map(|point| !points.iter().any(|other| beats(other, point))).collect()
}

/// The point of least time among those whose error is at most the tolerance; of equals the most accurate, then the first.
pub fn cheapest(points: &[Point], tolerance: f64) -> Option<usize> {
    let good = (0..points.len()).filter(|index| points[*index].error <= tolerance);
    good.min_by(|a, b| {
        let (a, b) = (&points[*a], &points[*b]);
        a.time.total_cmp(&b.time).then(a.error.total_cmp(&b.error))
    })
}

/// The value at or below which a share of the values lies (nearest rank); 0 without values.
pub fn percentile(values: &[u64], share: f64) -> u64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable();
    let rank = libm::ceil(share * sorted.len() as f64) as usize;
    sorted.get(rank.saturating_sub(1)).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(table: &[(f64, f64)]) -> Vec<Point> {
        table.iter().map(|&(time, error)| Point { time, error }).collect()
    }

    /// A table made by hand: a staircase, a point above it, one as fast as another but less accurate, two
    /// equal points, one with almost no error.
    #[test]
    fn the_front_of_a_table_made_by_hand() {
        let table = points(&[
            (1.0, 0.50),
            (2.0, 0.10),
            (3.0, 0.20),
            (2.0, 0.11),
            (4.0, 0.05),
            (4.0, 0.05),
            (9.0, 0.0),
            (9.5, f64::INFINITY),
        ]);
        let expected = [true, true, false, false, true, true, true, false];
        assert_eq!(front(&table), expected);
        assert_eq!(front(&[]), [] as [bool; 0]);
    }

    #[test]
    fn the_cheapest_within_a_tolerance() {
        let table = points(&[(1.0, 0.5), (2.0, 0.1), (2.0, 0.02), (5.0, 0.01), (0.5, f64::INFINITY)]);
        assert_eq!(cheapest(&table, 0.5), Some(0));
        assert_eq!(cheapest(&table, 0.1), Some(2));
        assert_eq!(cheapest(&table, 0.01), Some(3));
        assert_eq!(cheapest(&table, 0.009), None);
    }

    #[test]
    fn percentiles_are_by_nearest_rank() {
        let values: Vec<u64> = (1..=200).rev().collect();
        assert_eq!(percentile(&values, 0.5), 100);
        assert_eq!(percentile(&values, 0.99), 198);
        assert_eq!(percentile(&values, 1.0), 200);
        assert_eq!(percentile(&[7], 0.5), 7);
        assert_eq!(percentile(&[], 0.5), 0);
    }
}
