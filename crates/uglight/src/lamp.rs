//! The lights of a scene, with their colours and places ready to compute with.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use glam::DVec3;
use ugphysics::spectrum::{LightSpectrum, Spectrum};
use ugphysics::{Hsv, length, srgb_encode, unit_or_zero, xyz_to_linear_srgb};
use ugscene::{Beam, ColorId, ColorTable, ColorValue, Light, LightKind, LightMotion, Scene};

use crate::color::shown_light;
use crate::{ColorForm, color_form, hsv, spectrum};

/// The intensity of the ambient light in a scene without lights.
pub const DEFAULT_AMBIENT: f64 = 0.3;

/// The intensity of the directional light from the eye in a scene without lights.
pub const DEFAULT_FROM_EYE: f64 = 0.7;

/// A light of a scene, ready to compute with.
#[derive(Clone, Debug)]
pub struct Lamp {
    /// The kind of light, and its place.
    pub place: LampPlace,
    /// Level of its light on a white surface at normal incidence.
    pub intensity: f64,
    /// Display-encoded red, green and blue, times the intensity. In this form light of several
    /// lamps is added, and multiplies the display-encoded colour of a surface, as in 1988.
    pub color: DVec3,
    /// Linear red, green and blue, times the intensity: it multiplies colours given as light.
    pub linear: DVec3,
    /// True if the light is neither white nor grey.
    pub is_colored: bool,
    /// The spectrum of its colour: `None` for daylight, and where colours are not spectra.
    own_spectrum: Option<LightSpectrum>,
    /// How it moves.
    pub motion: LightMotion,
    /// Radius of a sphere that casts soft shadows; 0 for a point, and for a light without a place.
    pub radius: f64,
    /// How its light falls off with distance; `None` if the level is the same at any distance.
    pub fall_off: Option<FallOff>,
    /// Its distribution over directions (spot) or places (area), in its rest frame.
    pub beam: Beam,
    /// Its colours over own time, if it changes; the colour above is then that at own time 0.
    pub table: Option<Arc<LampTable>>,
    /// The row of the lamp that has this colour for a time, if it is a colour of a [`LampTable`].
    pub color_of: Option<u32>,
    /// Rows of the lamps whose spectra, each with this level, add up to that of this lamp at level
    /// 1. Empty unless it is a mixture.
    pub mixture: Vec<(u32, f64)>,
}

/// The colours of a lamp over own time.
#[derive(Clone, Debug)]
pub struct LampTable {
    table: ColorTable,
    /// The row of [`Lamps`] that holds each colour of the table.
    rows: BTreeMap<ColorId, u32>,
}

impl LampTable {
    /// The rows of the lamps whose light this one sends at an own time, with their shares; the
    /// second may have none.
    pub fn at(&self, own_time: f64) -> [(u32, f64); 2] {
        self.table.at(own_time).parts.map(|(color, share)| (self.rows[&color], share))
    }

    /// The number of the row of the table in effect at an own time, counted over all periods.
    pub fn step(&self, own_time: f64) -> f64 {
        let place = self.table.at(own_time);
        place.cycle * self.table.rows.len() as f64 + place.row as f64
    }

    /// True if the colour jumps at the rows.
    pub fn is_stepped(&self) -> bool {
        self.table.is_stepped
    }
}

/// Light that falls off with the square of the distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FallOff {
    /// The distance at which the level is the intensity, in the rest frame of the lamp.
    reference: f64,
    /// Points nearer than this count as at this distance.
    least: f64,
}

impl FallOff {
    /// The light of a lamp of that radius, whose level is its intensity at the distance
    /// `reference`, above 0. The level is largest at the surface of the lamp; for a point it is
    /// limited to 10¹² times the intensity, so no light is infinite.
    pub fn new(reference: f64, radius: f64) -> Self {
        /// Least distance, in units of the reference distance.
        const LEAST: f64 = 1e-6;
        Self { reference, least: radius.max(LEAST * reference) }
    }

    /// The part of the intensity that arrives at a distance in the rest frame of the lamp:
    /// r₀²/r''². Eq. (P14)
    #[inline]
    pub fn at(self, rest_distance: f64) -> f64 {
        let part = self.reference / rest_distance.max(self.least);
        part * part
    }

    /// True if light still increases towards the lamp at that distance.
    pub fn is_outside(self, rest_distance: f64) -> bool {
        rest_distance > self.least
    }
}

/// Where a light is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LampPlace {
    /// In all directions: ambient light.
    Everywhere,
    /// At infinity along a unit vector, in the rest frame of the light.
    Afar(DVec3),
    /// At a point, relative to the eye, in the rest frame of the light.
    At(DVec3),
}

/// The lights of a scene, in its order, or the default ones.
#[derive(Clone, Debug)]
pub struct Lamps {
    all: Vec<Lamp>,
    /// True if a light is neither white nor grey.
    pub is_colored: bool,
    /// True if no light has a colour, so that white surfaces reflect daylight.
    pub is_daylight: bool,
}

impl Lamps {
    /// The lights of a scene.
    ///
    /// `eye`: in scene coordinates. `is_spectral`: colours are spectra, those of lamps as well.
    pub fn new(scene: &Scene, eye: DVec3, is_spectral: bool) -> Self {
        let all: Vec<Lamp> =
            scene.lights.iter().map(|light| lamp(scene, light, eye, is_spectral)).collect();
        let is_colored = all.iter().any(|lamp| lamp.is_colored);
        Self {
            all,
            is_colored,
            is_daylight: scene.lights.iter().all(|light| light.color.is_none()),
        }
    }

    /// The same, followed by a lamp for each colour of those that change with own time
    /// ([`Lamp::table`]).
    #[must_use]
    pub fn over_time(mut self, scene: &Scene, eye: DVec3, is_spectral: bool) -> Self {
        for (row, light) in scene.lights.iter().enumerate() {
            let Some(table) = light.color.and_then(|color| scene.table_of(color)) else { continue };
            let mut rows = BTreeMap::new();
            for &(_, color) in &table.rows {
                rows.entry(color).or_insert_with(|| {
                    let light = Light { color: Some(color), ..light.clone() };
                    let lamp = lamp(scene, &light, eye, is_spectral);
                    self.is_colored |= lamp.is_colored;
                    // Scenes have fewer than 2^32 lights.
                    self.all.push(Lamp { color_of: Some(row as u32), ..lamp });
                    self.all.len() as u32 - 1
                });
            }
            self.all[row].table = Some(Arc::new(LampTable { table: table.clone(), rows }));
        }
        self
    }

    /// The same, followed by lamps that are not in the scene.
    #[must_use]
    pub fn and(mut self, others: Vec<Lamp>) -> Self {
        let is_colored = others.iter().any(|lamp| lamp.is_colored);
        self.all.extend(others);
        Self {
            is_colored: self.is_colored || is_colored,
            is_daylight: self.is_daylight && !is_colored,
            ..self
        }
    }

    /// As [`Lamps::new`]; in a scene without lights an ambient light ([`DEFAULT_AMBIENT`]) and one
    /// from the eye ([`DEFAULT_FROM_EYE`]).
    ///
    /// `forward`: unit vector along the view.
    pub fn or_default(scene: &Scene, eye: DVec3, forward: DVec3, is_spectral: bool) -> Self {
        let mut lamps = Self::new(scene, eye, is_spectral);
        if lamps.all.is_empty() {
            let from_eye = Lamp::white(LampPlace::Afar(-forward), DEFAULT_FROM_EYE);
            lamps.all = vec![Lamp::white(LampPlace::Everywhere, DEFAULT_AMBIENT), from_eye];
        }
        lamps
    }
}

impl std::ops::Deref for Lamps {
    type Target = [Lamp];

    fn deref(&self) -> &[Lamp] {
        &self.all
    }
}

/// True if light of the scene has another spectrum than daylight, so that with spectra it
/// multiplies colours wavelength by wavelength.
pub fn has_colored_lamps(scene: &Scene) -> bool {
    let all = |id: ColorId| {
        let rows = scene.table_of(id).map_or(&[][..], |table| &table.rows);
        std::iter::once(id).chain(rows.iter().map(|row| row.1))
    };
    scene.lights.iter().filter_map(|light| light.color).flat_map(all).any(|id| {
        let color = &scene.colors[id.index()];
        let is_source =
            matches!(color.value, ColorValue::Blackbody { .. } | ColorValue::Spectrum { .. });
        is_source || hsv(scene, color).saturation > 0.0
    })
}

fn lamp(scene: &Scene, statement: &Light, eye: DVec3, is_spectral: bool) -> Lamp {
    let place = match statement.kind {
        LightKind::Ambient => LampPlace::Everywhere,
        // Divided first: the square of a large component may be too large.
        LightKind::Directional(toward) => {
            LampPlace::Afar((toward / toward.abs().max_element()).normalize_or_zero())
        }
        LightKind::Local { position, .. } => LampPlace::At(position - eye),
    };
    let (radius, reference, beam) = match statement.kind {
        LightKind::Local { radius, reference, beam, .. } => (radius, reference, beam),
        _ => (0.0, None, Beam::Even),
    };
    let fall_off = reference.map(|reference| FallOff::new(reference, radius));
    let motion = statement.motion;
    let white = Lamp { motion, radius, fall_off, beam, ..Lamp::white(place, statement.intensity) };
    let Some(id) = statement.color else { return white };
    let color = &scene.colors[id.index()];
    let shown = hsv(scene, color);
    let encoded = shown.to_rgb();
    let linear = match color_form(scene, color) {
        ColorForm::Light(light) => light,
        _ => shown_light(shown),
    };
    Lamp {
        color: DVec3::from_array(encoded) * statement.intensity,
        linear: linear * statement.intensity,
        is_colored: shown.saturation > 0.0,
        own_spectrum: is_spectral.then(|| LightSpectrum::new(&spectrum(scene, color).0)),
        ..white
    }
}

impl Lamp {
    /// A white light that rests with whatever it lights.
    pub fn white(place: LampPlace, intensity: f64) -> Lamp {
        let color = DVec3::splat(intensity);
        let motion = LightMotion::WithWhatItLights;
        let (own_spectrum, fall_off) = (None, None);
        Lamp {
            place,
            intensity,
            color,
            linear: color,
            is_colored: false,
            own_spectrum,
            motion,
            radius: 0.0,
            fall_off,
            beam: Beam::Even,
            table: None,
            color_of: None,
            mixture: Vec::new(),
        }
    }

    /// A light at infinity. `toward`: a unit vector; `linear`: red, green and blue of its light on
    /// a white surface across it; `spectrum`: that of its light, where colours are spectra; of a
    /// black body the colour is that of the spectrum.
    pub fn afar(
        toward: DVec3,
        linear: DVec3,
        spectrum: &Spectrum,
        motion: LightMotion,
        is_spectral: bool,
    ) -> Lamp {
        let intensity = linear.max_element();
        let white = Lamp { motion, ..Lamp::white(LampPlace::Afar(toward), intensity) };
        if intensity <= 0.0 {
            return white;
        }
        let linear = match spectrum.is_surface() {
            false => {
                intensity * DVec3::from(xyz_to_linear_srgb(spectrum.shifted(1.0))).max(DVec3::ZERO)
            }
            true => linear,
        };
        let encoded = (linear / linear.max_element()).to_array().map(srgb_encode);
        Lamp {
            color: DVec3::from(encoded) * intensity,
            linear,
            is_colored: Hsv::from_rgb(encoded).saturation > 0.0,
            own_spectrum: is_spectral.then(|| LightSpectrum::new(spectrum)),
            ..white
        }
    }

    /// The same with the [parts](Self::mixture) of its spectrum.
    pub fn mixed_of(self, mixture: Vec<(u32, f64)>) -> Lamp {
        Self { mixture, ..self }
    }

    /// Its spectrum: daylight filtered by its colour, or the black body or samples that its colour
    /// is.
    pub fn spectrum(&self) -> &LightSpectrum {
        static DAYLIGHT: LazyLock<LightSpectrum> =
            LazyLock::new(|| LightSpectrum::new(&Spectrum::from_linear_srgb([1.0; 3])));
        self.own_spectrum.as_ref().unwrap_or(&DAYLIGHT)
    }

    /// The part of its intensity that arrives at a distance in its rest frame: 1 unless its light
    /// falls off, or depends on the direction. `leaving`: the unit vector in which it left the
    /// lamp. `beam`: its own, in the axes of this vector.
    #[inline]
    pub fn part_at(&self, rest_distance: f64, leaving: DVec3, beam: Beam) -> f64 {
        let part = self.fall_off.map_or(1.0, |fall_off| fall_off.at(rest_distance));
        match beam {
            Beam::Even => part,
            Beam::Spot { axis, degrees: [angle, edge] } => {
                let axis = unit_or_zero(axis);
                // The angle between unit vectors, exact for small ones, too.
                let off = 2.0 * libm::atan2((leaving - axis).length(), (leaving + axis).length());
                let inside = angle - off.to_degrees();
                let x = if edge > 0.0 {
                    (inside / edge).clamp(0.0, 1.0)
                } else {
                    f64::from(inside >= 0.0)
                };
                part * x * x * (3.0 - 2.0 * x)
            }
            Beam::Area([u, v]) => part * unit_or_zero(u.cross(v)).dot(leaving).max(0.0),
        }
    }

    /// The place on its parallelogram at a part of each edge; its position for other lamps.
    pub fn place_on(&self, [part, other]: [f64; 2]) -> LampPlace {
        match (self.place, self.beam) {
            (LampPlace::At(place), Beam::Area([u, v])) => {
                LampPlace::At(place + (part - 0.5) * u + (other - 0.5) * v)
            }
            (place, _) => place,
        }
    }

    /// The places that stand for the whole lamp, with their shares: nodes of Gauss–Legendre
    /// quadrature, three along each edge of a parallelogram.
    pub fn places(&self) -> impl Iterator<Item = (LampPlace, f64)> {
        const NODES: [(f64, f64); 3] = [
            (0.112_701_665_379_258_3, 5.0 / 18.0),
            (0.5, 8.0 / 18.0),
            (0.887_298_334_620_741_7, 5.0 / 18.0),
        ];
        let is_area = self.is_area();
        let nodes = NODES.into_iter().flat_map(|one| NODES.map(|other| (one, other)));
        let nodes = nodes.take(if is_area { 9 } else { 0 });
        let of_area = nodes.map(|((u, one), (v, other))| (self.place_on([u, v]), one * other));
        of_area.chain((!is_area).then_some((self.place, 1.0)))
    }

    /// A place of it as a body sees it. `shift`: of lamps that rest with what they light, see
    /// [`ugscene::RestFrames::lamp_shift`].
    #[inline]
    pub fn shifted(&self, place: LampPlace, shift: DVec3) -> LampPlace {
        match (place, self.motion) {
            (LampPlace::At(place), LightMotion::WithWhatItLights) => LampPlace::At(place + shift),
            (place, _) => place,
        }
    }

    /// The irradiance of a surface that rests with the lamp, as a part of the lamp's intensity:
    /// max(0, n·l), times the fall-off of the lamp, or 1 for ambient light.
    ///
    /// `point`: of the surface, relative to the eye. `normal`: unit vector on the side that is
    /// seen, or zero for a surface without one. `shift`: see [`Lamp::shifted`].
    #[inline]
    pub fn level_at_rest(&self, point: DVec3, normal: DVec3, shift: DVec3) -> f64 {
        if self.is_area() {
            let level = |place| self.level_from(self.shifted(place, shift), point, normal);
            return self.places().map(|(place, share)| share * level(place)).sum();
        }
        self.level_from(self.shifted(self.place, shift), point, normal)
    }

    /// As [`Lamp::level_at_rest`], from a place of the lamp as the body of the surface sees it.
    #[inline]
    pub fn level_from(&self, place: LampPlace, point: DVec3, normal: DVec3) -> f64 {
        let toward = match place {
            LampPlace::Everywhere => return 1.0,
            LampPlace::Afar(toward) => toward,
            LampPlace::At(place) => unit_or_zero(place - point),
        };
        let level = normal.dot(toward).max(0.0);
        match place {
            LampPlace::At(place) if level > 0.0 && !self.is_even() => {
                level * self.part_at(length(place - point), -toward, self.beam)
            }
            _ => level,
        }
    }

    /// True if it shines from a parallelogram.
    pub fn is_area(&self) -> bool {
        matches!(self.beam, Beam::Area(_))
    }

    /// True if the same light arrives at any distance and in any direction.
    fn is_even(&self) -> bool {
        self.fall_off.is_none() && self.beam == Beam::Even
    }
}
