//! Suggestions of the form "did you mean …?".

/// Maximum number of candidates compared, and then of candidates listed: a file with very many names and a
/// fault at each must not take quadratic time.
const COMPARED: usize = 100;
const LISTED: usize = 20;

/// Candidate nearest to `name`, if it is near enough to be a typing error.
pub(crate) fn nearest<'c>(name: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    let limit = 1 + name.chars().count() / 4;
    let best =
        candidates.into_iter().take(COMPARED).map(|c| (distance(name, c), c)).min_by_key(|(d, _)| *d)?;
    (best.0 <= limit).then_some(best.1)
}

/// Cure for a name that is not among the candidates.
pub(crate) fn cure(name: &str, candidates: &[&str]) -> String {
    cure_among(name, candidates.len(), candidates.iter().copied())
}

/// Cure for a name that is not among `count` candidates, given as an iterator of which only the first ones
/// are used.
pub(crate) fn cure_among<'c>(
    name: &str,
    count: usize,
    candidates: impl Iterator<Item = &'c str> + Clone,
) -> String {
    if let Some(near) = nearest(name, candidates.clone()) {
        return format!("did you mean `{near}`?");
    }
    let listed = candidates.take(LISTED).collect::<Vec<_>>().join(", ");
    match count {
        0 => "there is none to choose from".to_owned(),
        count if count > LISTED => format!("choose from: {listed} and {} more", count - LISTED),
        _ => format!("choose from: {listed}"),
    }
}

/// Edit distance between two names (insert, remove, replace), ignoring case.
fn distance(a: &str, b: &str) -> usize {
    strsim::levenshtein(&a.to_lowercase(), &b.to_lowercase())
}
