//! Colours as seen: made once for each base colour and Doppler factor, and reused.

use rustc_hash::FxHashMap;
use uglight::{HueScale, VertexColor, hsv};
use ugparse::{Color, ColorId, ColorValue, NameId, Scene, UniqueNames};
use ugphysics::{Hsv, hue_to_wavelength, wavelength_to_hue};

use crate::Config;
use crate::lit::Seen;
use crate::notes::{clipped, kept, scaled};

/// The longest visible wavelength, nm: where a relative step of D moves the
/// wavelength most.
const LONGEST_NM: f64 = 780.0;

/// The colours of a scene and what they look like.
pub(crate) struct Palette<'s> {
    scene: &'s mut Scene,
    config: &'s Config,
    /// Colours of the scene before any was added.
    n_given: usize,
    /// Width of a step of ln D; 0 keeps every D apart.
    step: f64,
    made: FxHashMap<Key, ColorId>,
    /// Colours with light in them, by translucency and step of wavelength, saturation and value.
    lit: FxHashMap<[u64; 4], ColorId>,
    bases: FxHashMap<BaseKey, Base>,
    names: UniqueNames,
    largest_value: f64,
}

/// A base colour and the step of D it is seen with.
type Key = (BaseKey, u64);

/// What tells base colours apart.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum BaseKey {
    Named(ColorId),
    White,
    /// Bits of hue, saturation, value and translucency.
    Mixed([u64; 4]),
}

/// A colour at rest.
#[derive(Clone)]
struct Base {
    hsv: Hsv,
    translucency: f64,
    name: String,
}

impl<'s> Palette<'s> {
    pub fn new(scene: &'s mut Scene, config: &'s Config) -> Self {
        let names = scene.colors.iter().map(|color| scene.names.get(color.name)).collect();
        Self {
            n_given: scene.colors.len(),
            // D is taken at the middle of its step, so it is off by half a step at most.
            step: 2.0 * config.tolerance / LONGEST_NM,
            made: FxHashMap::default(),
            lit: FxHashMap::default(),
            bases: FxHashMap::default(),
            names,
            largest_value: 0.0,
            scene,
            config,
        }
    }

    /// Gives vertex `row` the colour that `color` looks like under `doppler`.
    pub fn paint(&mut self, row: usize, color: VertexColor, doppler: f64) {
        let (step, doppler) = self.rounded(doppler);
        let base = key(color);
        let id = match self.made.get(&(base, step)) {
            Some(&id) => id,
            None => {
                let id = self.make(base, color, doppler);
                self.made.insert((base, step), id);
                id
            }
        };
        self.scene.vertices[row].color = Some(id);
    }

    /// Gives vertex `row` a colour that has its light in it already; `color` is that of the surface.
    pub fn paint_lit(&mut self, row: usize, color: VertexColor, seen: Seen) {
        let base = self.base(key(color), color);
        let (key, n_lit) = (self.lit_key(base.translucency, seen), self.lit.len());
        let id = match self.lit.get(&key) {
            Some(&id) => id,
            None => {
                self.largest_value = self.largest_value.max(seen.value);
                let name = self.names.fresh(&format!("{}#lit{}", base.name, n_lit + 1));
                let name = self.scene.names.add(&name);
                let hue = match seen.saturation {
                    0.0 => 0.0,
                    _ if self.config.wavelengths => seen.wavelength_nm,
                    _ => seen.hue,
                };
                let hsv = Hsv { hue, saturation: seen.saturation, value: seen.value };
                let id = self.push(name, hsv, base.translucency);
                self.lit.insert(key, id);
                id
            }
        };
        self.scene.vertices[row].color = Some(id);
    }

    /// Steps as wide as the tolerance: the first colour of a step stands for all. What no eye sees has no step.
    fn lit_key(&self, translucency: f64, seen: Seen) -> [u64; 4] {
        let tolerance = self.config.tolerance;
        let step = |number: f64, width: f64| {
            let number = if tolerance > 0.0 { (number / width).round() } else { number };
            number.to_bits()
        };
        let wavelength = if seen.saturation > 0.0 { seen.wavelength_nm } else { 0.0 };
        [
            translucency.to_bits(),
            step(wavelength, tolerance),
            step(seen.saturation, tolerance / 100.0),
            // Parts of the value, not of 1: the iris may make dark scenes bright.
            step(libm::log(seen.value), tolerance / 100.0),
        ]
    }

    /// The step that D falls in, as a key, and D at its middle. D = 1 is a middle.
    fn rounded(&self, doppler: f64) -> (u64, f64) {
        if self.step == 0.0 {
            return (doppler.to_bits(), doppler);
        }
        let step = (libm::log(doppler) / self.step).round();
        (step.to_bits(), libm::exp(step * self.step))
    }

    /// A colour statement for a base colour under D; the given one if it looks the same.
    fn make(&mut self, key: BaseKey, color: VertexColor, doppler: f64) -> ColorId {
        let base = self.base(key, color);
        let shifts = self.config.doppler && base.hsv.saturation > 0.0 && doppler != 1.0;
        let fades = self.config.flux && self.config.law.factor(doppler) != 1.0;
        let value = if fades { base.hsv.value * self.config.law.factor(doppler) } else { base.hsv.value };
        self.largest_value = self.largest_value.max(value);
        if !shifts
            && !fades
            && let VertexColor::Named(id) = color
        {
            return id;
        }
        let name =
            if shifts || fades { format!("{}#{}", base.name, self.digits(doppler)) } else { base.name };
        let name = self.names.fresh(&name);
        let name = self.scene.names.add(&name);
        let hue = if base.hsv.saturation > 0.0 {
            let wavelength = hue_to_wavelength(base.hsv.hue) / if shifts { doppler } else { 1.0 };
            if self.config.wavelengths {
                wavelength
            } else {
                self.shifted_hue(base.hsv.hue, wavelength, shifts)
            }
        } else {
            0.0
        };
        self.push(name, Hsv { hue, value, ..base.hsv }, base.translucency)
    }

    /// A hue that was not shifted stays as it was written.
    fn shifted_hue(&self, hue: f64, wavelength: f64, shifts: bool) -> f64 {
        if shifts { wavelength_to_hue(wavelength) } else { hue }
    }

    fn push(&mut self, name: NameId, hsv: Hsv, translucency: f64) -> ColorId {
        let value = ColorValue::Hsv { value: hsv.value, hue: hsv.hue, saturation: hsv.saturation };
        self.scene.colors.push(Color { name, value, translucency });
        ColorId::from_index(self.scene.colors.len() - 1)
    }

    fn base(&mut self, key: BaseKey, color: VertexColor) -> Base {
        if let Some(base) = self.bases.get(&key) {
            return base.clone();
        }
        let base = match color {
            VertexColor::Named(id) => {
                let color = &self.scene.colors[id.index()];
                Base {
                    hsv: hsv(self.scene, color, HueScale::Degrees),
                    translucency: color.translucency,
                    name: self.scene.names.get(color.name).to_string(),
                }
            }
            VertexColor::White => {
                let hsv = Hsv { hue: 0.0, saturation: 0.0, value: 1.0 };
                Base { hsv, translucency: 0.0, name: "white".to_string() }
            }
            VertexColor::Mixed { hsv, translucency, .. } => {
                let name = format!("mixed{}", self.bases.len() + 1);
                Base { hsv, translucency, name }
            }
        };
        self.bases.insert(key, base.clone());
        base
    }

    /// D for a name: as many digits as tell the steps apart, `_` for the point.
    fn digits(&self, doppler: f64) -> String {
        let text = if self.step == 0.0 {
            format!("{doppler}")
        } else {
            // Digits behind the point so that a unit of the last is below a step of D.
            let places = (-libm::log10(doppler * self.step)).ceil().clamp(0.0, 20.0);
            format!("{doppler:.*}", places as usize)
        };
        text.replace('.', "_")
    }

    /// Brings values above 1 into range, unless they are to be kept, and the given colours to the scale of the output.
    pub fn finish(mut self) -> Vec<String> {
        if self.config.wavelengths {
            for color in &mut self.scene.colors[..self.n_given] {
                if let ColorValue::Hsv { hue, saturation, .. } = &mut color.value
                    && *saturation > 0.0
                {
                    *hue = hue_to_wavelength(*hue);
                }
            }
        }
        if self.config.iris { self.scale_values() } else { self.clip_values() }
    }

    /// The values that vertices have, times the factor that makes the largest 1. Lights keep theirs: they multiply what is
    /// scaled here.
    fn scale_values(&mut self) -> Vec<String> {
        let largest = self.largest_value;
        if largest == 0.0 || largest == 1.0 {
            return Vec::new();
        }
        let mut is_scaled = vec![false; self.n_given];
        is_scaled.resize(self.scene.colors.len(), true);
        self.made.values().for_each(|id| is_scaled[id.index()] = true);
        self.keep_lights(&is_scaled);
        for (color, _) in self.scene.colors.iter_mut().zip(is_scaled).filter(|(_, is_scaled)| *is_scaled) {
            color.value = match color.value {
                ColorValue::Rgb(rgb) => ColorValue::Rgb(rgb.map(|channel| channel / largest)),
                ColorValue::Hsv { value, hue, saturation } => {
                    ColorValue::Hsv { value: value / largest, hue, saturation }
                }
                ColorValue::Xyz(xyz) => ColorValue::Xyz(xyz.map(|part| part / largest)),
                ColorValue::Blackbody { kelvin, scale } => {
                    ColorValue::Blackbody { kelvin, scale: scale / largest }
                }
                spectrum @ ColorValue::Spectrum { .. } => spectrum,
            };
        }
        vec![scaled(largest)]
    }

    /// Gives lights that share a colour with vertices a copy of it.
    fn keep_lights(&mut self, is_scaled: &[bool]) {
        let mut copies: FxHashMap<ColorId, ColorId> = FxHashMap::default();
        for row in 0..self.scene.lights.len() {
            let Some(id) = self.scene.lights[row].color.filter(|id| is_scaled[id.index()]) else { continue };
            let copy = *copies.entry(id).or_insert_with(|| {
                let color = self.scene.colors[id.index()].clone();
                let name = self.names.fresh(&format!("{}#light", self.scene.names.get(color.name)));
                let name = self.scene.names.add(&name);
                self.scene.colors.push(Color { name, ..color });
                ColorId::from_index(self.scene.colors.len() - 1)
            });
            self.scene.lights[row].color = Some(copy);
        }
    }

    fn clip_values(&mut self) -> Vec<String> {
        if self.largest_value <= 1.0 {
            return Vec::new();
        }
        if self.config.keep {
            return vec![kept(self.largest_value)];
        }
        for color in &mut self.scene.colors[self.n_given..] {
            if let ColorValue::Hsv { value, .. } = &mut color.value {
                *value = value.min(1.0);
            }
        }
        vec![clipped(self.largest_value)]
    }
}

fn key(color: VertexColor) -> BaseKey {
    match color {
        VertexColor::Named(id) => BaseKey::Named(id),
        VertexColor::White => BaseKey::White,
        VertexColor::Mixed { hsv, translucency, .. } => {
            BaseKey::Mixed([hsv.hue, hsv.saturation, hsv.value, translucency].map(f64::to_bits))
        }
    }
}
