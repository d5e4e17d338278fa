//! Irradiance by lamps that rest with what they light.

use glam::DVec3;
use ugphysics::Brightness;
use ugscene::{LightKind, Scene};

use crate::{Irradiance, Lamp, LampPlace, Lamps, has_colored_lamps, light_names};

/// The lights of a scene, each at rest with the face it lights: the rule of 1988.
///
/// A light level is the irradiance relative to the one that shows white as white. It is computed in
/// the rest frame of a face, with rest positions (P4) and rest normals, so a moving face is lit as
/// if it stood still. Local lights are points, without a fall-off with distance.
///
/// The level multiplies the value of a hue, which is display-encoded, as in 1988; or linear light:
/// a colour given as light, and every colour under a law that names a quantity. So every light has
/// its colour in both forms.
#[derive(Clone, Debug)]
pub struct Lighting {
    /// All ambient lights together.
    ambient: Lamp,
    /// All others.
    lamps: Vec<Lamp>,
    /// All lamps, if one is neither white nor grey, or has a spectrum other than that of daylight.
    colored: Option<Lamps>,
    /// Levels multiply linear light, of hues as well: the law of the picture names a quantity, see
    /// [`Brightness::acts_on_light`].
    pub acts_on_light: bool,
}

impl Lighting {
    /// The lights of the scene, or the default ones, see [`Lamps::or_default`].
    ///
    /// `eye`: in scene coordinates. `forward`: unit vector along the view. `law`: the brightness
    /// law of hues, which determines whether levels multiply their linear light. `is_spectral`:
    /// colours are spectra.
    pub fn new(
        scene: &Scene,
        eye: DVec3,
        forward: DVec3,
        law: Brightness,
        is_spectral: bool,
    ) -> Self {
        let all = Lamps::or_default(scene, eye, forward, is_spectral);
        let (ambient, lamps): (Vec<Lamp>, Vec<Lamp>) =
            all.iter().cloned().partition(|lamp| lamp.place == LampPlace::Everywhere);
        let mut sum = Lamp::white(LampPlace::Everywhere, 0.0);
        sum.color = ambient.iter().map(|lamp| lamp.color).sum();
        sum.linear = ambient.iter().map(|lamp| lamp.linear).sum();
        let is_colored = if is_spectral { has_colored_lamps(scene) } else { all.is_colored };
        let colored = is_colored.then_some(all);
        Self { ambient: sum, lamps, colored, acts_on_light: law.acts_on_light() }
    }

    /// True if a light is neither white nor grey, so that levels differ between red, green and
    /// blue; or, where colours are spectra, if a light has a spectrum other than that of daylight.
    #[inline]
    pub fn is_colored(&self) -> bool {
        self.colored.is_some()
    }

    /// The lamps of a scene with a [coloured](Self::is_colored) light.
    #[inline]
    pub fn colored_lamps(&self) -> Option<&Lamps> {
        self.colored.as_ref()
    }

    /// The contributions of lamps. The other arguments: as of [`Lighting::level`].
    pub fn irradiances(
        lamps: &Lamps,
        point: DVec3,
        normal: DVec3,
        shift: DVec3,
    ) -> Vec<Irradiance> {
        let irradiance = |(row, lamp): (usize, &Lamp)| Irradiance {
            lamp: row as u32,
            level: lamp.level_at_rest(point, normal, shift),
            doppler: 1.0,
        };
        lamps.iter().enumerate().map(irradiance).filter(|part| part.level > 0.0).collect()
    }

    /// True if the level depends on the position and normal of a face.
    #[inline]
    pub fn needs_geometry(&self) -> bool {
        !self.lamps.is_empty()
    }

    /// True if the level depends on the position of a point of a face.
    #[inline]
    pub fn needs_places(&self) -> bool {
        self.lamps.iter().any(|lamp| matches!(lamp.place, LampPlace::At(_)))
    }

    /// Light level of a surface at a point, for red, green and blue.
    ///
    /// `point`: relative to the eye, in the rest frame of the surface. `normal`: unit vector
    /// on the side that is seen, or zero for a surface without one.
    /// `shift`: of lamps for the body of the surface, see [`ugscene::RestFrames::lamp_shift`].
    /// `is_light`: of a colour given as light. Levels are linear for those, and for hues if the
    /// lighting [acts on light](Self::acts_on_light); otherwise they multiply display-encoded
    /// values. Level = Σ ambient + Σ intensity · max(0, n·l).
    #[inline]
    pub fn level(&self, point: DVec3, normal: DVec3, shift: DVec3, is_light: bool) -> DVec3 {
        // Two loops, each with its colour inlined, because this runs for every corner of the scene.
        if is_light || self.acts_on_light {
            self.sum(point, normal, shift, |lamp| lamp.linear)
        } else {
            self.sum(point, normal, shift, |lamp| lamp.color)
        }
    }

    #[inline]
    fn sum(
        &self,
        point: DVec3,
        normal: DVec3,
        shift: DVec3,
        scale: impl Fn(&Lamp) -> DVec3,
    ) -> DVec3 {
        let lit =
            |sum: DVec3, lamp: &Lamp| sum + scale(lamp) * lamp.level_at_rest(point, normal, shift);
        self.lamps.iter().fold(scale(&self.ambient), lit)
    }

    /// The contribution of every light to the level, with its name ([`light_names`]). All ambient
    /// lights together are one, called `ambient` unless it is a single one with a name.
    ///
    /// `scene`: that of the lights. The others: as of [`Lighting::level`].
    pub fn parts(
        &self,
        scene: &Scene,
        point: DVec3,
        normal: DVec3,
        shift: DVec3,
        is_light: bool,
    ) -> Vec<(String, DVec3)> {
        let is_linear = is_light || self.acts_on_light;
        let scale = |lamp: &Lamp| if is_linear { lamp.linear } else { lamp.color };
        let is_ambient = |row: usize| {
            scene.lights.get(row).map_or(row == 0, |light| light.kind == LightKind::Ambient)
        };
        let names = light_names(scene).into_iter().enumerate();
        let (ambient, others): (Vec<_>, Vec<_>) = names.partition(|(row, _)| is_ambient(*row));
        let ambient = match &ambient[..] {
            [(row, name)] if scene.lights.get(*row).is_some_and(|light| light.name.is_some()) => {
                name
            }
            _ => "ambient",
        };
        let part =
            |(lamp, (_, name))| (name, scale(lamp) * lamp.level_at_rest(point, normal, shift));
        let others = self.lamps.iter().zip(others).map(part);
        std::iter::once((ambient.to_owned(), scale(&self.ambient))).chain(others).collect()
    }
}
