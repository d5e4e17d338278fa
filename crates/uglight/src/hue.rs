//! Colours whose hue stands for a wavelength, as seen in motion (Nguyen 1988).

use ugphysics::{Brightness, Hsv, attenuation, hue_to_wavelength, wavelength_to_hue};

use crate::{Irradiance, Lamp};

/// A display-encoded colour made of white and of light of one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HueColor {
    /// In degrees, −60 to 300; exactly as it was written if nothing shifts it.
    pub hue: f64,
    /// Wavelength in nm, which may be outside of the visible range. Meaningless if the saturation
    /// is 0.
    pub wavelength_nm: f64,
    /// 0 white … 1 light of one wavelength.
    pub saturation: f64,
    /// 0 and more.
    pub value: f64,
}

/// What motion changes in a colour that is a hue: wavelengths by (P11), the value by (P12).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HueShift {
    /// Wavelengths are divided by D.
    pub doppler: bool,
    /// The brightness law: the power of D that the value is multiplied by.
    pub law: Brightness,
}

impl HueShift {
    /// Colours stay as they are at rest.
    pub const NONE: Self = Self { doppler: false, law: Brightness::None };

    /// A colour at rest, as seen with the Doppler factor `doppler`.  Eq. (P11), (P12)
    ///
    /// ```
    /// use ugphysics::{Brightness, Hsv};
    /// use uglight::{HueColor, HueShift};
    ///
    /// let green = HueColor::from(Hsv { hue: 120.0, saturation: 1.0, value: 0.5 });
    /// let seen = HueShift { doppler: true, law: Brightness::Photon }.seen(green, 1.25);
    /// assert!((seen.wavelength_nm - 436.88).abs() < 1e-9 && seen.value == 0.9765625);
    /// ```
    #[must_use]
    pub fn seen(self, rest: HueColor, doppler: f64) -> HueColor {
        let value = self.value(rest.value, doppler);
        if self.keeps_wavelength(rest.saturation, doppler) {
            return HueColor { value, ..rest };
        }
        let wavelength_nm = self.wavelength_nm(rest.wavelength_nm, doppler);
        HueColor { hue: wavelength_to_hue(wavelength_nm), wavelength_nm, value, ..rest }
    }

    /// True if a colour of that saturation is seen with the wavelength it has at rest.
    #[must_use]
    pub fn keeps_wavelength(self, saturation: f64, doppler: f64) -> bool {
        !self.doppler || doppler == 1.0 || saturation == 0.0
    }

    /// A wavelength as seen.  Eq. (P11)
    #[must_use]
    #[inline]
    pub fn wavelength_nm(self, rest_nm: f64, doppler: f64) -> f64 {
        rest_nm / if self.doppler { doppler } else { 1.0 }
    }

    /// A value as seen.  Eq. (P12)
    #[must_use]
    #[inline]
    pub fn value(self, rest: f64, doppler: f64) -> f64 {
        rest * self.law.factor(doppler)
    }

    /// A surface of colour `base` under several lamps, seen with the Doppler factor `doppler`.
    ///
    /// The light of each lamp is reflected and seen by itself: the colour of the surface times that
    /// of the lamp, its wavelength divided by D_l D, its value changed by the brightness law for
    /// both factors, (P14). Then the colours are added, [`HueColor::sum`].
    #[must_use]
    pub fn seen_lit(self, base: Hsv, doppler: f64, light: &[Irradiance], lamps: &[Lamp]) -> HueColor {
        let base = HueColor::from(base);
        let parts: Vec<HueColor> = light
            .iter()
            .map(|part| {
                let lamp = &lamps[part.lamp as usize];
                let surface = if lamp.is_colored {
                    HueColor::from(reflected(base.hsv(), lamp))
                } else {
                    HueColor { value: base.value * lamp.color.x, ..base }
                };
                let factor = self.law.irradiance_factor(part.doppler) * self.law.factor(doppler);
                let value = surface.value * part.level * factor;
                let shift = Self { law: Brightness::None, ..self };
                shift.seen(HueColor { value, ..surface }, part.doppler * doppler)
            })
            .filter(|seen| seen.value > 0.0)
            .collect();
        HueColor::sum(&parts)
    }
}

/// The colour of a surface times that of a lamp, channel by channel.
fn reflected(base: Hsv, lamp: &Lamp) -> Hsv {
    let [red, green, blue] = base.to_rgb();
    Hsv::from_rgb([red * lamp.color.x, green * lamp.color.y, blue * lamp.color.z])
}

impl From<Hsv> for HueColor {
    fn from(Hsv { hue, saturation, value }: Hsv) -> Self {
        let wavelength_nm = if saturation > 0.0 { hue_to_wavelength(hue) } else { 0.0 };
        Self { hue, wavelength_nm, saturation, value }
    }
}

impl HueColor {
    const BLACK: Self = Self { hue: 0.0, wavelength_nm: 0.0, saturation: 0.0, value: 0.0 };

    fn hsv(&self) -> Hsv {
        Hsv { hue: self.hue, saturation: self.saturation, value: self.value }
    }

    /// The colour as a renderer draws it: faded where the eye sees little.  Eq. (P17)
    #[must_use]
    pub fn attenuated(&self) -> Hsv {
        self.hsv().attenuated(attenuation(self.wavelength_nm))
    }

    /// The sum of colours as display-encoded red, green and blue: so renderers add the light of
    /// several lamps, and lamps at rest give the same picture either way.
    ///
    /// Colours of one wavelength keep it, visible or not. The hues of others are attenuated (P17)
    /// before they are added. As the renderer will attenuate the sum again, the sum is amplified to
    /// compensate, but never beyond the value it would have without any attenuation.
    #[must_use]
    pub fn sum(parts: &[Self]) -> Self {
        let Some(first) = parts.first() else { return Self::BLACK };
        let all: f64 = parts.iter().map(|part| part.value).sum();
        let is_alike =
            |part: &Self| (part.wavelength_nm, part.saturation) == (first.wavelength_nm, first.saturation);
        if parts.iter().all(is_alike) {
            return Self { value: all, ..*first };
        }
        let mut sum = [0.0; 3];
        for part in parts {
            sum.iter_mut().zip(part.attenuated().to_rgb()).for_each(|(sum, channel)| *sum += channel);
        }
        let mixed = Hsv::from_rgb(sum);
        if mixed.value <= 0.0 {
            // Nothing is visible. The wavelength of the strongest part is kept: another shift may
            // bring it into view.
            let strongest =
                parts.iter().fold(*first, |best, part| if part.value > best.value { *part } else { best });
            return Self { value: all, ..strongest };
        }
        let wavelength_nm = Self::from(mixed).wavelength_nm;
        let Hsv { hue, saturation, value } = mixed.unattenuated(attenuation(wavelength_nm), all);
        Self { hue, wavelength_nm, saturation, value }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_wavelength(wavelength_nm: f64, value: f64) -> HueColor {
        HueColor { hue: wavelength_to_hue(wavelength_nm), wavelength_nm, saturation: 1.0, value }
    }

    #[test]
    fn red_and_green_light_make_yellow() {
        let mixed = HueColor::sum(&[of_wavelength(700.0, 0.4), of_wavelength(546.1, 0.4)]);
        assert!((mixed.hue - 60.0).abs() < 1e-9 && (mixed.value - 0.4).abs() < 1e-9, "{mixed:?}");
    }

    #[test]
    fn light_out_of_sight_adds_nothing_and_is_not_lost() {
        let green = of_wavelength(546.1, 0.4);
        let mixed = HueColor::sum(&[of_wavelength(250.0, 9.0), green]);
        assert!((mixed.hue - 120.0).abs() < 1e-9 && (mixed.value - 0.4).abs() < 1e-9, "{mixed:?}");
        let dark = HueColor::sum(&[of_wavelength(250.0, 9.0), of_wavelength(1200.0, 1.0)]);
        assert_eq!((dark.wavelength_nm, dark.value), (250.0, 10.0));
        assert_eq!(dark.attenuated().value, 0.0);
        assert_eq!(HueColor::sum(&[]), HueColor::BLACK);
    }

    /// As two wavelengths become one, so does their colour; also where the renderer will fade it.
    #[test]
    fn mixing_joins_what_is_not_mixed() {
        for wavelength in [400.0, 420.0, 480.0, 589.0, 720.0, 750.0] {
            let near = HueColor::sum(&[
                of_wavelength(wavelength, 0.3),
                of_wavelength(wavelength * (1.0 + 1e-9), 0.2),
            ]);
            let one = HueColor::sum(&[of_wavelength(wavelength, 0.3), of_wavelength(wavelength, 0.2)]);
            assert!((near.wavelength_nm - one.wavelength_nm).abs() < 1e-4, "{near:?} {one:?}");
            assert!((near.value - one.value).abs() < 1e-5, "{near:?} {one:?}");
        }
    }
}
