//! The map between hue and wavelength, fast enough for every sample of a picture.

use std::sync::LazyLock;

use ugphysics::{CONTROL_POINTS, RED_END_NM, VIOLET_END_NM, hue_to_wavelength, wavelength_to_hue};

/// Intervals of the map.
const INTERVALS: usize = CONTROL_POINTS.len() - 1;

/// Cells of the inverse in each of them.
const CELLS: usize = 128;

/// Hue of the first point, degrees, and from one to the next.
const FIRST: f64 = CONTROL_POINTS[0].hue_deg;
const STEP: f64 = 60.0 / CELLS as f64;

/// The map between hue and wavelength in both directions, tabulated.  Eq. (P16)
pub struct HueTable {
    /// For each interval the longest wavelength, and the cubic's coefficients behind it.
    cubics: [[f64; 5]; INTERVALS],
    /// Wavelengths and their slopes by hue, a step apart.
    points: Vec<[f64; 2]>,
}

static TABLE: LazyLock<HueTable> = LazyLock::new(HueTable::new);

impl HueTable {
    /// The map.
    pub fn get() -> &'static Self {
        &TABLE
    }

    fn new() -> Self {
        let point = |point: usize| {
            let hue = FIRST + point as f64 * STEP;
            [hue_to_wavelength(hue), slope(hue)]
        };
        Self {
            cubics: std::array::from_fn(cubic),
            points: (0..=CELLS * INTERVALS).map(point).collect(),
        }
    }

    /// Like [`wavelength_to_hue`], up to rounding.
    #[inline]
    pub fn hue(&self, wavelength_nm: f64) -> f64 {
        let wavelength_nm = wavelength_nm.clamp(VIOLET_END_NM, RED_END_NM);
        let inner = CONTROL_POINTS[1..INTERVALS].iter();
        let interval: usize =
            inner.map(|point| usize::from(wavelength_nm < point.wavelength_nm)).sum();
        let [red, a, b, c, d] = self.cubics[interval];
        let t = wavelength_nm - red;
        a + t * (b + t * (c + t * d))
    }

    /// Like [`hue_to_wavelength`], within 10⁻⁹ nm.
    ///
    /// The map is a cubic in each interval. Its inverse is approximated by a cubic Hermite curve in
    /// each of many cells, none of which crosses the end of an interval, and refined by one step of
    /// Newton's method.
    #[inline]
    pub fn wavelength_nm(&self, hue_deg: f64) -> f64 {
        let place = (hue_deg - FIRST) * (1.0 / STEP);
        // Conversions of 32 bits take fewer instructions.
        let s = place - f64::from(place as u32);
        let cell = place as u32 as usize;
        if !(place >= 0.0 && cell + 1 < self.points.len()) {
            return hue_to_wavelength(hue_deg);
        }
        let [[a, slope_a], [b, slope_b]] = [self.points[cell], self.points[cell + 1]];
        let rest = 1.0 - s;
        let near = a
            + s * s * (3.0 - 2.0 * s) * (b - a)
            + s * rest * STEP * (rest * slope_a - s * slope_b);
        let [red, a, b, c, d] = self.cubics[cell / CELLS];
        let t = near - red;
        near - (a + t * (b + t * (c + t * d)) - hue_deg) / (b + t * (2.0 * c + t * 3.0 * d))
    }
}

/// The Hermite curve of an interval as a polynomial in the wavelength less that of its red end.
fn cubic(interval: usize) -> [f64; 5] {
    let [red, violet] = [CONTROL_POINTS[interval], CONTROL_POINTS[interval + 1]];
    let span = violet.wavelength_nm - red.wavelength_nm;
    let chord = (violet.hue_deg - red.hue_deg) / span;
    let second = (3.0 * chord - 2.0 * red.slope - violet.slope) / span;
    let third = (red.slope + violet.slope - 2.0 * chord) / (span * span);
    [red.wavelength_nm, red.hue_deg, red.slope, second, third]
}

/// dλ/dH, nm a degree: a difference so small that rounding and curvature are below 10⁻⁷.
fn slope(hue_deg: f64) -> f64 {
    const HALF_NM: f64 = 1e-5;
    let middle = hue_to_wavelength(hue_deg);
    let ends = [middle - HALF_NM, middle + HALF_NM].map(|end| end.clamp(VIOLET_END_NM, RED_END_NM));
    let [from, to] = ends.map(wavelength_to_hue);
    (ends[1] - ends[0]) / (to - from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_are_those_of_the_map() {
        let hues = HueTable::get();
        for step in 0..=100_000 {
            let part = f64::from(step) / 1e5;
            let (hue, nm) = (FIRST + 360.0 * part, 370.0 + 420.0 * part);
            let (ours, exact) = (hues.wavelength_nm(hue), hue_to_wavelength(hue));
            assert!((ours - exact).abs() < 1e-9, "{hue} degrees: {ours}, not {exact}");
            let (ours, exact) = (hues.hue(nm), wavelength_to_hue(nm));
            assert!((ours - exact).abs() < 1e-10, "{nm} nm: {ours}, not {exact}");
        }
        for hue in [-75.0, 310.0, 359.0, 700.0] {
            assert_eq!(hues.wavelength_nm(hue), hue_to_wavelength(hue));
        }
    }
}
