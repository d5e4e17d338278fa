//! Daylight seen with a Doppler factor, weighted by the standard observer.

use std::ops::Range;

use crate::spectrum::cie_1931::{CIE_1931, FIRST_NM};
use crate::spectrum::daylight::daylight;
use crate::spectrum::dot::DOT_GROUP;
use crate::spectrum::infrared;
use crate::spectrum::observer::weighted_sums;
use crate::spectrum::ranges::{CURVE_NM, N_LEVELS, N_NM};

/// Daylight seen with a Doppler factor, weighted by the observer: white has Y = 1 at rest.
#[derive(Clone, Debug)]
pub(crate) struct WeightedDaylight {
    /// X, Y, Z of the light emitted below 380 nm.
    pub ultraviolet: [f64; 3],
    /// X, then Y, then Z of the light at each infrared level of a reflectance.
    pub infrared: [[f64; N_LEVELS]; 3],
    /// X, then Y, then Z of the light emitted at 380…780 nm, where a curve is 1 at a nanometre and
    /// falls to 0 at the next.
    pub inside: [[f64; N_NM]; 3],
    /// The nanometres of `inside` with light, in whole groups of [`dot`]: without the zeros its
    /// sums are the same to the bit.
    pub used: Range<usize>,
}

impl WeightedDaylight {
    pub fn new(doppler: f64) -> Self {
        let (ultraviolet, infrared) = ([0.0; 3], [[0.0; N_LEVELS]; 3]);
        let inside = [[0.0; N_NM]; 3];
        let mut light = Self { ultraviolet, infrared, inside, used: 0..0 };
        let scale = 1.0 / white_luminance();
        for (row, weights) in CIE_1931.iter().enumerate() {
            let seen_nm = (FIRST_NM + row) as f64;
            let level = daylight(seen_nm * doppler) * scale;
            let xyz = weights.map(|weight| weight * level);
            let emitted_nm = seen_nm * doppler;
            if emitted_nm < CURVE_NM[0] {
                light.ultraviolet.iter_mut().zip(xyz).for_each(|(sum, part)| *sum += part);
            } else if emitted_nm > CURVE_NM[1] {
                let shares = infrared::parts(emitted_nm);
                for (levels, part) in light.infrared.iter_mut().zip(xyz) {
                    levels.iter_mut().zip(shares).for_each(|(level, share)| *level += share * part);
                }
            } else {
                let at = emitted_nm - CURVE_NM[0];
                let node = (at as usize).min(N_NM - 2);
                let behind = at - node as f64;
                for (channel, part) in light.inside.iter_mut().zip(xyz) {
                    channel[node] += (1.0 - behind) * part;
                    channel[node + 1] += behind * part;
                }
            }
        }
        let is_lit = |nm: &usize| light.inside.iter().any(|channel| channel[*nm] != 0.0);
        if let (Some(first), Some(last)) = ((0..N_NM).find(is_lit), (0..N_NM).rfind(is_lit)) {
            let end = (last + 1).next_multiple_of(DOT_GROUP).min(N_NM);
            light.used = first / DOT_GROUP * DOT_GROUP..end;
        }
        light
    }
}

/// Σ S ȳ of daylight S, computed once.
pub(crate) fn white_luminance() -> f64 {
    static SUM: std::sync::OnceLock<f64> = std::sync::OnceLock::new();
    *SUM.get_or_init(|| weighted_sums(|_, nm| daylight(nm))[1])
}
