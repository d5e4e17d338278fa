//! Colours whose hue stands for a wavelength, as seen in motion (Nguyen 1988).

use glam::DVec3;
use ugphysics::{
    Brightness, Hsv, attenuation, hue_to_wavelength, srgb_decode, srgb_encode, wavelength_to_hue,
};

use crate::color::{encoded_hsv, lit_display};
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
    /// Factor of the linear light that the other numbers stand for, 0 and more. At rest it is 1.
    pub factor: f64,
}

/// The changes by motion in a colour that is a hue: wavelengths by (P11), the brightness by (P12).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HueShift {
    /// Wavelengths are divided by D.
    pub doppler: bool,
    /// The brightness law: the power of D that the brightness is multiplied by.
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
    /// assert!((seen.wavelength_nm - 436.88).abs() < 1e-9);
    /// assert_eq!((seen.value, seen.factor), (0.5, 1.953125));
    /// ```
    pub fn seen(self, rest: HueColor, doppler: f64) -> HueColor {
        let seen = self.brightened(rest, self.law.factor(doppler));
        if self.keeps_wavelength(rest.saturation, doppler) {
            return seen;
        }
        let wavelength_nm = self.wavelength_nm(rest.wavelength_nm, doppler);
        HueColor { hue: wavelength_to_hue(wavelength_nm), wavelength_nm, ..seen }
    }

    /// A colour with its brightness multiplied: its linear light under a law that names a quantity,
    /// else its display-encoded value.  Eq. (P18)
    #[inline]
    pub fn brightened(self, color: HueColor, factor: f64) -> HueColor {
        if self.law.acts_on_light() {
            HueColor { factor: color.factor * factor, ..color }
        } else {
            HueColor { value: color.value * factor, ..color }
        }
    }

    /// The colour of a lamp times its intensity, for the unit in which light is added: linear under
    /// a law that names a quantity, else display-encoded.
    #[inline]
    pub fn color_of(self, lamp: &Lamp) -> DVec3 {
        if self.law.acts_on_light() { lamp.linear } else { lamp.color }
    }

    /// True if a colour of that saturation is seen with the wavelength it has at rest.
    pub fn keeps_wavelength(self, saturation: f64, doppler: f64) -> bool {
        !self.doppler || doppler == 1.0 || saturation == 0.0
    }

    /// A wavelength as seen.  Eq. (P11)
    #[inline]
    pub fn wavelength_nm(self, rest_nm: f64, doppler: f64) -> f64 {
        rest_nm / if self.doppler { doppler } else { 1.0 }
    }

    /// A surface of colour `base` under several lamps, seen with the Doppler factor `doppler`.
    ///
    /// The light of each lamp is reflected and seen by itself: the colour of the surface times that
    /// of the lamp, its wavelength divided by D_l D, its brightness changed by the brightness law
    /// for both factors, (P14). Then the colours are added: as linear light under a law that names
    /// a quantity, else by [`HueColor::sum`].
    pub fn seen_lit(
        self,
        base: HueColor,
        doppler: f64,
        light: &[Irradiance],
        lamps: &[Lamp],
    ) -> HueColor {
        let shift = Self { law: Brightness::None, ..self };
        let parts: Vec<HueColor> = light
            .iter()
            .map(|part| {
                let surface = self.reflected(base, &lamps[part.lamp as usize]);
                let factor = self.law.irradiance_factor(part.doppler) * self.law.factor(doppler);
                let surface = self.brightened(self.brightened(surface, part.level), factor);
                shift.seen(surface, part.doppler * doppler)
            })
            .filter(|seen| seen.value > 0.0 && seen.factor > 0.0)
            .collect();
        if self.law.acts_on_light() {
            HueColor::sum_of_light(&parts)
        } else {
            HueColor::sum(&parts)
        }
    }

    /// Linear light of a surface with the colour of a display under several lamps, if its motion
    /// does not shift it; else `None`. It reflects light that is not shifted by its red, green and
    /// blue (`linear`), other light as the hue `base`. So `None` also if no light is of the first
    /// kind, or if they cannot be added, because the law does not act on light.
    pub fn display_lit(
        self,
        (linear, base): (DVec3, HueColor),
        doppler: f64,
        light: &[Irradiance],
        lamps: &[Lamp],
    ) -> Option<DVec3> {
        let is_shifted = |part: &&Irradiance| self.shifts(part.doppler);
        let n_shifted = light.iter().filter(is_shifted).count();
        let is_hue = n_shifted > 0 && (!self.law.acts_on_light() || n_shifted == light.len());
        if self.shifts(doppler) || is_hue {
            return None;
        }
        let own = light.iter().filter(|part| !is_shifted(part));
        let level = own.map(|part| part.level * self.color_of(&lamps[part.lamp as usize])).sum();
        let lit = self.lit_display(linear, level);
        let seen = |part: &Irradiance| self.seen_lit(base, doppler, &[*part], lamps).light();
        Some(lit + light.iter().filter(is_shifted).map(seen).sum::<DVec3>())
    }

    /// Linear light of a display under levels of red, green and blue, which multiply linear light
    /// under a law that names a quantity, else display-encoded channels.
    pub(crate) fn lit_display(self, linear: DVec3, level: DVec3) -> DVec3 {
        if self.law.acts_on_light() { linear * level } else { lit_display(linear, level) }
    }

    /// True if the Doppler factor changes colours. One that is a product along a path, through
    /// glass in motion for example, is 1 but for rounding.
    pub(crate) fn shifts(self, doppler: f64) -> bool {
        const ROUNDING: f64 = 1e-12;
        (doppler - 1.0).abs() > ROUNDING && self != Self::NONE
    }

    /// The colour of a surface times that of a lamp, channel by channel.
    fn reflected(self, base: HueColor, lamp: &Lamp) -> HueColor {
        let color = self.color_of(lamp);
        if !lamp.is_colored {
            return self.brightened(base, color.x);
        }
        let encoded = base.hsv().to_rgb();
        if !self.law.acts_on_light() {
            let product = DVec3::from_array(encoded) * color;
            return HueColor { factor: base.factor, ..Hsv::from_rgb(product.to_array()).into() };
        }
        // Without its intensity, so that lamps of one colour give colours of one wavelength.
        let (color, intensity) = (color.max(DVec3::ZERO), color.max_element().max(0.0));
        if intensity == 0.0 {
            return HueColor::BLACK;
        }
        let product = DVec3::from_array(encoded.map(srgb_decode)) * (color / intensity);
        let product = Hsv::from_rgb(product.to_array().map(srgb_encode));
        HueColor { factor: base.factor * intensity, ..product.into() }
    }
}

impl From<Hsv> for HueColor {
    fn from(Hsv { hue, saturation, value }: Hsv) -> Self {
        let wavelength_nm = if saturation > 0.0 { hue_to_wavelength(hue) } else { 0.0 };
        Self { hue, wavelength_nm, saturation, value, factor: 1.0 }
    }
}

impl HueColor {
    /// The hue, saturation and value that a display shows of linear red, green and blue: channels
    /// below 0 are clipped, those above 1 are kept.
    pub fn of_display(linear: DVec3) -> Self {
        encoded_hsv(linear).into()
    }

    const BLACK: Self =
        Self { hue: 0.0, wavelength_nm: 0.0, saturation: 0.0, value: 0.0, factor: 1.0 };

    fn hsv(&self) -> Hsv {
        Hsv { hue: self.hue, saturation: self.saturation, value: self.value }
    }

    /// True if a renderer fades it as a hue, because it stands for a wavelength near the ends of
    /// the visible range.  Eq. (P17)
    pub fn is_faded(&self) -> bool {
        self.saturation > 0.0 && attenuation(self.wavelength_nm) < 1.0
    }

    /// Its brightness without attenuation: linear light of its largest channel.
    pub fn brightest(&self) -> f64 {
        self.factor * srgb_decode(self.value)
    }

    /// Linear red, green and blue as a renderer draws it.  Eq. (P17)
    pub fn light(&self) -> DVec3 {
        let decode = |channel: f64| self.factor * srgb_decode(channel);
        let [red, green, blue] = self.attenuated().to_rgb();
        let first = decode(red);
        // Decoding is slow, and the channels of greys are equal.
        let [second, third] =
            [green, blue].map(|channel| if channel == red { first } else { decode(channel) });
        DVec3::new(first, second, third)
    }

    /// The colour as a renderer draws it, without its factor: faded where the eye sees little.
    /// Eq. (P17)
    pub fn attenuated(&self) -> Hsv {
        self.hsv().attenuated(attenuation(self.wavelength_nm))
    }

    /// The sum of colours as display-encoded red, green and blue: so renderers add the light of
    /// several lamps, and lamps at rest give the same picture either way.
    ///
    /// Colours of one wavelength keep it, visible or not. The hues of others are attenuated (P17)
    /// before they are added. As the renderer will attenuate the sum again, the sum is amplified to
    /// compensate, but never beyond the value it would have without any attenuation.
    pub fn sum(parts: &[Self]) -> Self {
        let Some(first) = parts.first() else { return Self::BLACK };
        let all: f64 = parts.iter().map(|part| part.value).sum();
        let is_alike = |part: &Self| {
            (part.wavelength_nm, part.saturation) == (first.wavelength_nm, first.saturation)
        };
        if parts.iter().all(is_alike) {
            return Self { value: all, ..*first };
        }
        let mut sum = [0.0; 3];
        for part in parts {
            sum.iter_mut()
                .zip(part.attenuated().to_rgb())
                .for_each(|(sum, channel)| *sum += channel);
        }
        let mixed = Hsv::from_rgb(sum);
        if mixed.value <= 0.0 {
            return Self { value: all, ..Self::strongest(parts, first, |part| part.value) };
        }
        Self { factor: first.factor, ..Self::amplified(mixed, all) }
    }

    /// The sum of colours as linear light.
    ///
    /// As in [`HueColor::sum`], colours of one wavelength keep it, and a mixture is amplified to
    /// compensate the attenuation of its own wavelength.
    pub fn sum_of_light(parts: &[Self]) -> Self {
        let Some(first) = parts.first() else { return Self::BLACK };
        let is_alike = |part: &Self| Self { factor: first.factor, ..*part } == *first;
        if parts.iter().all(is_alike) {
            return Self { factor: parts.iter().map(|part| part.factor).sum(), ..*first };
        }
        let light: DVec3 = parts.iter().map(Self::light).sum();
        let all: f64 = parts.iter().map(Self::brightest).sum();
        let most = light.max_element();
        if most <= 0.0 {
            let strongest = Self::strongest(parts, first, Self::brightest);
            return Self { factor: all / srgb_decode(strongest.value), ..strongest };
        }
        let mixed = Hsv::from_rgb((light / most).to_array().map(srgb_encode));
        Self { factor: most, ..Self::amplified(mixed, srgb_encode(all / most)) }
    }

    /// The first of the strongest parts, where nothing is visible: its wavelength is kept, since
    /// another shift may bring it into view.
    fn strongest(parts: &[Self], first: &Self, strength: impl Fn(&Self) -> f64) -> Self {
        parts
            .iter()
            .fold(*first, |best, part| if strength(part) > strength(&best) { *part } else { best })
    }

    /// A mixture that looks like `mixed` after it was attenuated. `limit`: of its value.
    fn amplified(mixed: Hsv, limit: f64) -> Self {
        let wavelength_nm = Self::from(mixed).wavelength_nm;
        let Hsv { hue, saturation, value } = mixed.unattenuated(attenuation(wavelength_nm), limit);
        Self { hue, wavelength_nm, saturation, value, factor: 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_wavelength(wavelength_nm: f64, value: f64) -> HueColor {
        HueColor {
            hue: wavelength_to_hue(wavelength_nm),
            wavelength_nm,
            saturation: 1.0,
            value,
            factor: 1.0,
        }
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
            let one =
                HueColor::sum(&[of_wavelength(wavelength, 0.3), of_wavelength(wavelength, 0.2)]);
            assert!((near.wavelength_nm - one.wavelength_nm).abs() < 1e-4, "{near:?} {one:?}");
            assert!((near.value - one.value).abs() < 1e-5, "{near:?} {one:?}");
        }
    }
}
