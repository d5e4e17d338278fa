//! Colours of lit surfaces as seen, in the way of 1988: a hue is a wavelength.

use uglight::{Irradiance, Lamp};
use ugphysics::{Hsv, attenuation, hue_to_wavelength, wavelength_to_hue};

use crate::Config;

/// A colour as seen, with its light in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Seen {
    /// In degrees, −60 to 300; as it was written, where nothing shifts it.
    pub hue: f64,
    /// Wavelength in nm, also where the eye sees none. Without meaning if the saturation is 0.
    pub wavelength_nm: f64,
    pub saturation: f64,
    pub value: f64,
}

impl Seen {
    const BLACK: Self = Self { hue: 0.0, wavelength_nm: 0.0, saturation: 0.0, value: 0.0 };

    /// What the eye sees of it.  Eq. (P17)
    fn shown(&self) -> Hsv {
        let color = Hsv { hue: self.hue, saturation: self.saturation, value: self.value };
        color.attenuated(attenuation(self.wavelength_nm))
    }
}

/// What a surface of colour `base` looks like under several lights, seen with the Doppler factor `doppler`.
///
/// Each light is reflected and seen by itself: the surface's colour times the light's, its hue shifted by D_l D and its
/// value changed by the brightness law for both factors (P14). Then they are added, [`mix`].
pub(crate) fn look(base: Hsv, doppler: f64, light: &[Irradiance], lamps: &[Lamp], config: &Config) -> Seen {
    let base_nm = if base.saturation > 0.0 { hue_to_wavelength(base.hue) } else { 0.0 };
    let parts: Vec<Seen> = light
        .iter()
        .map(|part| {
            let lamp = &lamps[part.lamp as usize];
            let flux = if config.flux {
                config.law.irradiance_factor(part.doppler) * config.law.factor(doppler)
            } else {
                1.0
            };
            let (surface, rest_nm) = if lamp.is_colored {
                let surface = reflected(base, lamp);
                (surface, if surface.saturation > 0.0 { hue_to_wavelength(surface.hue) } else { 0.0 })
            } else {
                (Hsv { value: base.value * lamp.color.x, ..base }, base_nm)
            };
            let shift = if config.doppler { part.doppler * doppler } else { 1.0 };
            let wavelength_nm = rest_nm / shift;
            let hue = if shift == 1.0 { surface.hue } else { wavelength_to_hue(wavelength_nm) };
            let value = surface.value * part.level * flux;
            Seen { hue, wavelength_nm, saturation: surface.saturation, value }
        })
        .filter(|seen| seen.value > 0.0)
        .collect();
    mix(&parts)
}

/// The colour of a surface times that of a light, channel by channel, as `ugrainbow` has it.
fn reflected(base: Hsv, lamp: &Lamp) -> Hsv {
    let [red, green, blue] = base.to_rgb();
    Hsv::from_rgb([red * lamp.color.x, green * lamp.color.y, blue * lamp.color.z])
}

/// The sum of colours as display-encoded red, green and blue: so `ugrainbow` adds the levels of lights, and lights
/// at rest give the same picture here and there.
///
/// Colours of one wavelength keep it, seen or not. The hues of others are faded (P17) before they are added, and as the
/// renderer will fade that of the sum, it is made stronger by that; but the sum is not made brighter than it would be
/// without any fading.
fn mix(parts: &[Seen]) -> Seen {
    let Some(first) = parts.first() else { return Seen::BLACK };
    let all: f64 = parts.iter().map(|part| part.value).sum();
    let is_alike =
        |part: &Seen| (part.wavelength_nm, part.saturation) == (first.wavelength_nm, first.saturation);
    if parts.iter().all(is_alike) {
        return Seen { value: all, ..*first };
    }
    let mut sum = [0.0; 3];
    for part in parts {
        sum.iter_mut().zip(part.shown().to_rgb()).for_each(|(sum, channel)| *sum += channel);
    }
    let mixed = Hsv::from_rgb(sum);
    if mixed.value <= 0.0 {
        // Nothing is visible: the strongest light says where it is.
        let strongest =
            parts.iter().fold(*first, |best, part| if part.value > best.value { *part } else { best });
        return Seen { value: all, ..strongest };
    }
    let wavelength_nm = if mixed.saturation > 0.0 { hue_to_wavelength(mixed.hue) } else { 0.0 };
    let Hsv { hue, saturation, value } = mixed.unattenuated(attenuation(wavelength_nm), all);
    Seen { hue, wavelength_nm, saturation, value }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_wavelength(wavelength_nm: f64, value: f64) -> Seen {
        Seen { hue: wavelength_to_hue(wavelength_nm), wavelength_nm, saturation: 1.0, value }
    }

    #[test]
    fn red_and_green_light_make_yellow() {
        let mixed = mix(&[of_wavelength(700.0, 0.4), of_wavelength(546.1, 0.4)]);
        assert!((mixed.hue - 60.0).abs() < 1e-9 && (mixed.value - 0.4).abs() < 1e-9, "{mixed:?}");
    }

    #[test]
    fn light_out_of_sight_adds_nothing_and_is_not_lost() {
        let green = of_wavelength(546.1, 0.4);
        let mixed = mix(&[of_wavelength(250.0, 9.0), green]);
        assert!((mixed.hue - 120.0).abs() < 1e-9 && (mixed.value - 0.4).abs() < 1e-9, "{mixed:?}");
        let dark = mix(&[of_wavelength(250.0, 9.0), of_wavelength(1200.0, 1.0)]);
        assert_eq!((dark.wavelength_nm, dark.value), (250.0, 10.0));
        assert_eq!(dark.shown().value, 0.0);
        assert_eq!(mix(&[]), Seen::BLACK);
    }

    /// As two wavelengths become one, so does their colour; also where the renderer will fade it.
    #[test]
    fn mixing_joins_what_is_not_mixed() {
        for wavelength in [400.0, 420.0, 480.0, 589.0, 720.0, 750.0] {
            let near = mix(&[of_wavelength(wavelength, 0.3), of_wavelength(wavelength * (1.0 + 1e-9), 0.2)]);
            let one = mix(&[of_wavelength(wavelength, 0.3), of_wavelength(wavelength, 0.2)]);
            assert!((near.wavelength_nm - one.wavelength_nm).abs() < 1e-4, "{near:?} {one:?}");
            assert!((near.value - one.value).abs() < 1e-5, "{near:?} {one:?}");
        }
    }
}
