//! Colour as seen.

use ugphysics::Brightness;

use crate::config::Exact;
use crate::palette::{Palette, Swatch};

/// What motion does to the colours of a picture.
#[derive(Clone, Copy)]
pub struct Motion<'a> {
    exact: Exact,
    palette: &'a Palette,
}

impl<'a> Motion<'a> {
    /// As asked for.
    pub fn new(exact: Exact, palette: &'a Palette) -> Self {
        Self { exact, palette }
    }

    /// True if colours of bodies that move stay as they are.
    pub fn keeps_colors(&self) -> bool {
        !self.exact.doppler && self.exact.law == Brightness::None
    }

    /// The wavelength of a colour at rest, for [`Motion::seen`].
    pub fn wavelength_nm(&self, rest: &Swatch) -> f64 {
        if self.exact.doppler && !rest.is_grey() { self.palette.wavelength_nm(rest) } else { 0.0 }
    }

    /// What a colour at rest is seen as under a Doppler factor; `rest_nm` is its wavelength.  Eq. (P11), (P12), (P18)
    ///
    /// A colour given as light stays; a face that moves has none ([`super::look::Look`]).
    pub fn seen(&self, rest: &Swatch, rest_nm: f64, doppler: f64) -> Swatch {
        if rest.light.is_some() {
            return *rest;
        }
        let seen = Swatch { value: rest.value * self.exact.law.factor(doppler), ..*rest };
        if self.exact.doppler && !rest.is_grey() && doppler != 1.0 {
            self.palette.shifted(&seen, rest_nm / doppler)
        } else {
            seen
        }
    }
}
