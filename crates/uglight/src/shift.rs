//! How motion changes colours, by either model of colour.

use ugphysics::Brightness;

use crate::{HueShift, SpectralShift};

/// How motion changes colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorShift {
    /// A colour is a hue, which stands for one wavelength.
    Hues(HueShift),
    /// A colour is a spectrum.
    Spectra(SpectralShift),
}

impl ColorShift {
    /// Colours stay as they are at rest.
    pub const NONE: Self = Self::Hues(HueShift::NONE);

    /// The shift of spectra, or of hues with a brightness law (by default that of 1988). `doppler`,
    /// `flux`: wavelengths and brightness change.
    #[must_use]
    pub fn new(is_spectral: bool, doppler: bool, flux: bool, law: Option<Brightness>) -> Self {
        if is_spectral {
            return Self::Spectra(SpectralShift { doppler, flux });
        }
        Self::Hues(HueShift { doppler, law: if flux { law.unwrap_or_default() } else { Brightness::None } })
    }

    /// True if wavelengths are divided by D.
    #[must_use]
    pub fn shifts_wavelengths(self) -> bool {
        match self {
            Self::Hues(shift) => shift.doppler,
            Self::Spectra(shift) => shift.doppler,
        }
    }
}

impl Default for ColorShift {
    /// Hues are shifted, and the value is multiplied by D.
    fn default() -> Self {
        Self::Hues(HueShift { doppler: true, law: Brightness::Report })
    }
}
