//! "Did you mean": finds the name most similar to a misspelt one.

/// The largest number of compared names, to limit the time for large meshes.
const MAX_COMPARED: usize = 10_000;

/// Longer words get no suggestion: the time of a comparison grows with the square of the length,
/// and names that people type are shorter.
const MAX_LENGTH: usize = 64;

/// The candidate most similar to `word`: equal except for case, or with one or two typing errors.
/// Ties go to the first candidate; `None` if no candidate is similar.
pub(crate) fn nearest<'n>(
    word: &[u8],
    candidates: impl IntoIterator<Item = &'n [u8]>,
) -> Option<&'n str> {
    let word = std::str::from_utf8(word).ok().filter(|word| word.len() <= MAX_LENGTH)?;
    let most = match word.len() {
        0..=2 => 0,
        3..=5 => 1,
        _ => 2,
    };
    let near = candidates.into_iter().take(MAX_COMPARED).filter_map(|candidate| {
        let candidate = std::str::from_utf8(candidate).ok()?;
        // Names that differ only in their number, `v100` and `v1000`, are not typing errors.
        if stem(candidate) == stem(word) || candidate.len().abs_diff(word.len()) > most {
            return None;
        }
        let same = candidate.eq_ignore_ascii_case(word);
        #[cfg(feature = "report")]
        let distance = if same { 0 } else { strsim::osa_distance(word, candidate) };
        #[cfg(not(feature = "report"))]
        let distance = if same { 0 } else { usize::MAX };
        (distance <= most).then_some((distance, candidate))
    });
    near.min_by_key(|&(distance, _)| distance).map(|(_, candidate)| candidate)
}

fn stem(name: &str) -> &str {
    name.trim_end_matches(|c: char| c.is_ascii_digit())
}
