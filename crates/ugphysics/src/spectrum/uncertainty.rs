//! How far the assumed reflectance of a colour can be trusted.

/// D, and the mean ΔE*ab between measured surfaces and the reflectance that is assumed for their
/// colour: of the kinds of surfaces for which it is small, and of those for which it is large (10 %
/// of the kinds are beyond each).  docs/physics/reflectance.py
const MEASURED: [[f64; 3]; 8] = [
    [1.0, 0.0, 0.0],
    [1.05, 0.4, 3.1],
    [1.1, 0.3, 5.2],
    [1.2, 0.9, 7.9],
    [1.3, 1.9, 10.4],
    [1.5, 3.6, 11.9],
    [2.0, 4.3, 15.2],
    [2.5, 4.4, 16.2],
];

/// The range of ΔE*ab, with white as bright as white, by which measured surfaces of a colour differ
/// in motion from the reflectance that (P20) assumes for it. `None` for factors for which nothing
/// was measured.
///
/// ```
/// use ugphysics::spectrum::assumed_difference;
///
/// assert_eq!(assumed_difference(1.0), Some([0.0, 0.0]));
/// assert_eq!(assumed_difference(1.3), Some([1.9, 10.4]));
/// // What is ultraviolet at rest was not measured.
/// assert_eq!(assumed_difference(0.8), None);
/// ```
pub fn assumed_difference(doppler: f64) -> Option<[f64; 2]> {
    let next = MEASURED.iter().position(|row| row[0] >= doppler)?;
    let Some(row) = next.checked_sub(1) else {
        return (doppler == 1.0).then_some([0.0; 2]);
    };
    let [[from, low, high], [to, next_low, next_high]] = [MEASURED[row], MEASURED[next]];
    let part = (doppler - from) / (to - from);
    Some([low + part * (next_low - low), high + part * (next_high - high)])
}
