//! Places that are the same up to a distance.

use std::collections::HashMap;

use glam::DVec3;

/// The least distance of different places, relative to the greatest coordinate.
const ROUNDING: f64 = 1e-9;

/// For each place, the row of the first that is no farther from it than `same` along each axis, or
/// than rounding.
pub fn spots(places: &[DVec3], same: f64) -> Vec<usize> {
    let reach = places.iter().map(|place| place.abs().max_element()).fold(0.0, f64::max);
    let same = same.max(ROUNDING * reach);
    // The cast saturates.
    let cell = |place: DVec3| (place / (2.0 * same)).floor().to_array().map(|x| x as i64);
    // Only looked up, so its order does not matter.
    let mut known: HashMap<[i64; 3], usize> = HashMap::new();
    let spot = |(row, &place): (usize, &DVec3)| {
        let ends = [cell(place - same), cell(place + same)];
        let near = (0..8).map(|corner| [0, 1, 2].map(|axis| ends[corner >> axis & 1][axis]));
        let is_same = |&first: &usize| (places[first] - place).abs().max_element() <= same;
        let first = near.filter_map(|cell| known.get(&cell).copied()).find(is_same);
        first.unwrap_or_else(|| {
            known.insert(cell(place), row);
            row
        })
    };
    places.iter().enumerate().map(spot).collect()
}
