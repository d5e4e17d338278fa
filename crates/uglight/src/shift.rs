//! How motion changes colours, by either model of colour.

use ugphysics::Brightness;
use ugphysics::spectrum::InfraredRule;
use ugscene::{ColorScale, HueScale, SeenColors};

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

    /// All that motion changes in spectra.
    pub const SPECTRA: Self = Self::spectra(true, true);

    /// The shift of spectra, or of hues with a brightness law (by default that of 1988). `doppler`,
    /// `flux`: wavelengths and brightness change.
    pub fn new(is_spectral: bool, doppler: bool, flux: bool, law: Option<Brightness>) -> Self {
        if is_spectral {
            return Self::spectra(doppler, flux);
        }
        Self::Hues(HueShift {
            doppler,
            law: if flux { law.unwrap_or_default() } else { Brightness::None },
        })
    }

    /// A shift of spectra. `doppler`: wavelengths are divided by D; `flux`: the factor D⁵.
    pub const fn spectra(doppler: bool, flux: bool) -> Self {
        Self::Spectra(SpectralShift { doppler, flux, ..SpectralShift::NONE })
    }

    /// The same with a rule for what surfaces reflect in infrared.
    #[must_use]
    pub fn with_infrared(self, infrared: InfraredRule) -> Self {
        match self {
            Self::Hues(_) => self,
            Self::Spectra(shift) => Self::Spectra(SpectralShift { infrared, ..shift }),
        }
    }

    /// The same with radiances at three wavelengths, nm, in place of red, green and blue; hues stay
    /// as they are.
    #[must_use]
    pub fn sampled(self, nm: [u16; 3]) -> Self {
        match self {
            Self::Hues(_) => self,
            Self::Spectra(shift) => Self::Spectra(SpectralShift { sampled_nm: Some(nm), ..shift }),
        }
    }

    /// What surfaces reflect in infrared.
    pub fn infrared(self) -> InfraredRule {
        match self {
            Self::Hues(_) => InfraredRule::default(),
            Self::Spectra(shift) => shift.infrared,
        }
    }

    /// A shift of hues. `doppler`: wavelengths are divided by D. `law`: the brightness law.
    pub const fn hues(doppler: bool, law: Brightness) -> Self {
        Self::Hues(HueShift { doppler, law })
    }

    /// The shift of hues; none if colours are spectra.
    pub fn of_hues(self) -> HueShift {
        match self {
            Self::Hues(shift) => shift,
            Self::Spectra(_) => HueShift::NONE,
        }
    }

    /// True if colours are spectra.
    pub fn is_spectral(self) -> bool {
        matches!(self, Self::Spectra(_))
    }

    /// The stage of colours that it was applied to. `unit`: of their hues. `lights`: the light
    /// of lamps is in them.
    pub fn seen_colors(self, unit: HueScale, lights: bool) -> SeenColors {
        let scale = match self {
            Self::Hues(shift) => ColorScale::Hues { unit, law: shift.law },
            Self::Spectra(SpectralShift { flux, infrared, .. }) => {
                ColorScale::Spectra { flux, infrared }
            }
        };
        SeenColors { scale, doppler: self.shifts_wavelengths(), lights }
    }

    /// The shift of colours of a stage.
    pub fn of_stage(&SeenColors { scale, doppler, .. }: &SeenColors) -> Self {
        match scale {
            ColorScale::Hues { law, .. } => Self::hues(doppler, law),
            ColorScale::Spectra { flux, infrared } => {
                Self::spectra(doppler, flux).with_infrared(infrared)
            }
        }
    }

    /// True if wavelengths are divided by D.
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
