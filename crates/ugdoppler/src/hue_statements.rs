//! Colour statements with hues as seen: one for each colour at rest and quantized Doppler factor.

use rustc_hash::FxHashMap;
use uglight::{ColorForm, HueColor, HueShift, Mixing, RestColor, VertexColor};
use ugphysics::{hue_to_wavelength, srgb_decode, srgb_encode};
use ugscene::{Color, ColorId, ColorValue, HueScale, NameId, Scene, Tint, UniqueNames};

use crate::Config;
use crate::digits::name_as_seen;
use crate::notes::Note;

/// The longest visible wavelength, nm: there a relative step of D changes the wavelength most.
const LONGEST_NM: f64 = 780.0;

/// Writes the colours of vertices into a scene, and reuses statements.
pub(crate) struct HueStatements<'s> {
    scene: &'s mut Scene,
    config: &'s Config,
    shift: HueShift,
    /// How many colours the scene had at first.
    n_given: usize,
    /// Step of the quantization of ln D; 0 for none.
    step: f64,
    /// By row of the colour at rest, quantized D, and whether a colour of a display is on a moving
    /// body.
    made: FxHashMap<(u32, u64, bool), ColorId>,
    /// Colours that include light, by translucency, kind, and quantized wavelength (or hue, of a
    /// display), saturation, value and factor.
    lit: FxHashMap<[u64; 6], ColorId>,
    /// Statements that become red, green and blue of a display in the end.
    displays: Vec<ColorId>,
    /// Colours at rest, and their rows.
    bases: Vec<Base>,
    base_rows: FxHashMap<BaseKey, u32>,
    names: UniqueNames,
    /// See [`HueStatements::intensity`].
    largest: f64,
}

/// Identifies a colour at rest.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum BaseKey {
    Named(ColorId),
    White,
    /// See [`uglight::RestColor::key`].
    Mixed([u64; 5]),
}

/// A colour that includes light, or is written as it is seen.
#[derive(Clone, Copy)]
pub(crate) struct LitColor {
    pub seen: HueColor,
    /// It is written as red, green and blue of a display, of which mixtures are mixtures of light.
    pub is_display: bool,
}

/// A colour at rest.
struct Base {
    given: VertexColor,
    color: HueColor,
    translucency: f64,
    is_display: bool,
    name: String,
}

impl<'s> HueStatements<'s> {
    pub fn new(scene: &'s mut Scene, config: &'s Config, shift: HueShift) -> Self {
        let names = scene.colors.iter().map(|color| scene.names.get(color.name)).collect();
        Self {
            n_given: scene.colors.len(),
            // Rounded to the nearest step, ln D is off by half a step at most.
            step: 2.0 * config.bounded_tolerance() / LONGEST_NM,
            made: FxHashMap::default(),
            lit: FxHashMap::default(),
            displays: Vec::new(),
            bases: Vec::new(),
            base_rows: FxHashMap::default(),
            names,
            largest: 0.0,
            scene,
            shift,
            config,
        }
    }

    /// Gives vertex `row` the colour at rest `color` as seen with `doppler`.
    pub fn set(&mut self, row: usize, color: VertexColor, doppler: f64) {
        let step = self.quantized(doppler);
        let base = self.base(color);
        // On a body at rest D is exactly 1.
        let is_moving =
            self.bases[base as usize].is_display && doppler != 1.0 && self.shift.doppler;
        let key = (base, step.to_bits(), is_moving);
        let id = match self.made.get(&key) {
            Some(&id) => id,
            None => {
                let id = self.make(base, self.doppler_at(step), is_moving);
                self.made.insert(key, id);
                id
            }
        };
        self.scene.vertices[row].color = Some(id);
    }

    /// Gives vertex `row` a colour that includes light already; `color` is that of the surface.
    pub fn set_lit(&mut self, row: usize, color: VertexColor, lit: LitColor) {
        let base = self.base(color);
        let base = &self.bases[base as usize];
        let (key, n_lit) = (self.lit_key(base.translucency, lit), self.lit.len());
        let id = match self.lit.get(&key) {
            Some(&id) => id,
            None => {
                self.largest = self.largest.max(self.intensity(&lit.seen));
                let name = format!("{}#lit{}", base.name, n_lit + 1);
                let name = self.names.add(name, &mut self.scene.names);
                let id = self.push(name, lit, base.translucency);
                self.lit.insert(key, id);
                id
            }
        };
        self.scene.vertices[row].color = Some(id);
    }

    /// The key under which lit colours that differ by less than the tolerance are found: the first
    /// of them stands for all.
    fn lit_key(&self, translucency: f64, LitColor { seen, is_display }: LitColor) -> [u64; 6] {
        let tolerance = self.config.bounded_tolerance();
        let step = |number: f64, width: f64| {
            let number = if tolerance > 0.0 { (number / width).round() } else { number };
            number.to_bits()
        };
        let tint = if is_display { seen.hue } else { seen.wavelength_nm };
        let tint = if seen.saturation > 0.0 { tint } else { 0.0 };
        [
            translucency.to_bits(),
            u64::from(is_display),
            step(tint, tolerance),
            step(seen.saturation, tolerance / 100.0),
            // Relative to the value, since the iris may scale dark scenes up.
            step(libm::log(seen.value), tolerance / 100.0),
            step(libm::log(seen.factor), tolerance / 100.0),
        ]
    }

    /// The number that must not exceed 1: linear light of the largest channel under a law that acts
    /// on linear light, else the value.
    fn intensity(&self, seen: &HueColor) -> f64 {
        if self.shift.law.acts_on_light() { seen.brightest() } else { seen.value }
    }

    /// The step of ln D nearest to that of D; D itself if it is not quantized.
    fn quantized(&self, doppler: f64) -> f64 {
        if self.step == 0.0 { doppler } else { (libm::log(doppler) / self.step).round() }
    }

    /// D at a step. D = 1 stays.
    fn doppler_at(&self, step: f64) -> f64 {
        if self.step == 0.0 { step } else { libm::exp(step * self.step) }
    }

    /// A colour statement for a colour at rest as seen with D; the given one if nothing changes.
    /// `is_moving`: a colour of a display becomes a hue even so, like the others of its body, since
    /// hues and colours of a display are mixed differently downstream.
    fn make(&mut self, base: u32, doppler: f64, is_moving: bool) -> ColorId {
        let base = &self.bases[base as usize];
        let seen = self.shift.seen(base.color, doppler);
        let is_changed = !self.shift.keeps_wavelength(base.color.saturation, doppler)
            || self.shift.law.factor(doppler) != 1.0;
        self.largest = self.largest.max(self.intensity(&seen));
        if let (false, false, VertexColor::Named(id)) = (is_changed, is_moving, base.given) {
            return id;
        }
        let name = if is_changed {
            let step = (self.step != 0.0).then_some(doppler * self.step);
            name_as_seen(&base.name, doppler, step)
        } else {
            base.name.to_string()
        };
        let name = self.names.add(name, &mut self.scene.names);
        let translucency = base.translucency;
        if let (false, VertexColor::Mixed(color)) = (is_changed, base.given)
            && color.form.mixing() == Mixing::Light
        {
            self.scene.colors.push(Color { name, value: color.value(), translucency });
            return ColorId::from_index(self.scene.colors.len() - 1);
        }
        let is_display = !is_changed && base.is_display && !is_moving;
        self.push(name, LitColor { seen, is_display }, translucency)
    }

    /// Adds a colour statement. Greys have no hue, and are written with 0.
    fn push(&mut self, name: NameId, color: LitColor, translucency: f64) -> ColorId {
        let LitColor { seen: color, is_display } = color;
        let tint = match color.saturation {
            0.0 => Tint::new(0.0, self.config.hue_scale()),
            _ if self.config.wavelengths && !is_display => Tint::Wavelength(color.wavelength_nm),
            _ => Tint::Hue(color.hue),
        };
        let HueColor { value, saturation, .. } = color;
        // Products of the largest numbers overflow, and of infinity and 0 are NaN.
        let factor = if color.factor.is_nan() { 0.0 } else { color.factor.min(f64::MAX) };
        let value = ColorValue::Hsv { value, tint, saturation, factor };
        self.scene.colors.push(Color { name, value, translucency });
        let id = ColorId::from_index(self.scene.colors.len() - 1);
        if is_display {
            self.displays.push(id);
        }
        id
    }

    /// The row of a colour at rest.
    fn base(&mut self, given: VertexColor) -> u32 {
        let key = key(given);
        if let Some(&row) = self.base_rows.get(&key) {
            return row;
        }
        let (name, translucency) = match given {
            VertexColor::Named(id) => {
                let color = &self.scene.colors[id.index()];
                (self.scene.names.get(color.name).to_string(), color.translucency)
            }
            VertexColor::White => ("white".to_string(), 0.0),
            VertexColor::Mixed(color) => {
                (format!("mixed{}", self.bases.len() + 1), color.translucency)
            }
        };
        let is_display = given.mixing(self.scene) == Mixing::Display;
        let color = crate::hue_color(self.scene, self.shift, given);
        let base = Base { given, color, translucency, is_display, name };
        // Scenes have fewer than 2^32 vertices.
        let row = self.bases.len() as u32;
        self.bases.push(base);
        self.base_rows.insert(key, row);
        row
    }

    /// Clips or scales values above 1, unless they are kept, and converts the colours that the
    /// scene had at first to the scale of the output. Returns what to tell the user.
    pub fn finish(mut self) -> Vec<Note> {
        if self.config.wavelengths {
            for color in &mut self.scene.colors[..self.n_given] {
                color.value = match color.value {
                    ColorValue::Hsv { value, tint: Tint::Hue(hue), saturation, factor }
                        if saturation > 0.0 =>
                    {
                        let tint = Tint::Wavelength(hue_to_wavelength(hue));
                        ColorValue::Hsv { value, tint, saturation, factor }
                    }
                    // A grey may have any hue.
                    other => other.with_tint_in(HueScale::Wavelengths),
                };
            }
        }
        let notes = if self.config.iris { self.scale_values() } else { self.clip_values() };
        for id in self.displays {
            let color = RestColor::new(self.scene, Some(id));
            let form = ColorForm::Display(color.linear());
            self.scene.colors[id.index()].value = RestColor { form, ..color }.value();
        }
        notes
    }

    /// Divides the values of vertices by the largest. Those of lights stay, for they multiply what
    /// is scaled here.
    fn scale_values(&mut self) -> Vec<Note> {
        let largest = self.largest;
        let is_linear = self.shift.law.acts_on_light();
        let scaled_channel = |channel: f64| srgb_encode(srgb_decode(channel) / largest).min(1.0);
        if largest == 0.0 || largest == 1.0 {
            return Vec::new();
        }
        let mut is_scaled = vec![false; self.n_given];
        is_scaled.resize(self.scene.colors.len(), true);
        self.made.values().for_each(|id| is_scaled[id.index()] = true);
        self.keep_lights(&is_scaled);
        for (color, _) in
            self.scene.colors.iter_mut().zip(is_scaled).filter(|(_, is_scaled)| *is_scaled)
        {
            color.value = match color.value {
                ColorValue::Rgb(rgb) if is_linear => ColorValue::Rgb(rgb.map(scaled_channel)),
                ColorValue::Rgb(rgb) => ColorValue::Rgb(rgb.map(|channel| channel / largest)),
                ColorValue::Hsv { value, tint, saturation, factor } if is_linear => {
                    ColorValue::Hsv { value, tint, saturation, factor: factor / largest }
                }
                ColorValue::Hsv { value, tint, saturation, factor } => {
                    ColorValue::Hsv { value: value / largest, tint, saturation, factor }
                }
                ColorValue::Xyz(xyz) => ColorValue::Xyz(xyz.map(|part| part / largest)),
                ColorValue::Blackbody { kelvin, scale } => {
                    ColorValue::Blackbody { kelvin, scale: scale / largest }
                }
                spectrum @ ColorValue::Spectrum { .. } => spectrum,
            };
        }
        vec![Note::Scaled(largest)]
    }

    /// Gives lights that share a colour with vertices a copy of it, which is not scaled.
    fn keep_lights(&mut self, is_scaled: &[bool]) {
        let mut copies: FxHashMap<ColorId, ColorId> = FxHashMap::default();
        for row in 0..self.scene.lights.len() {
            let Some(id) = self.scene.lights[row].color.filter(|id| is_scaled[id.index()]) else {
                continue;
            };
            let copy = *copies.entry(id).or_insert_with(|| {
                let color = self.scene.colors[id.index()].clone();
                let name = format!("{}#light", self.scene.names.get(color.name));
                let name = self.names.add(name, &mut self.scene.names);
                self.scene.colors.push(Color { name, ..color });
                ColorId::from_index(self.scene.colors.len() - 1)
            });
            self.scene.lights[row].color = Some(copy);
        }
    }

    fn clip_values(&mut self) -> Vec<Note> {
        if self.largest <= 1.0 {
            return Vec::new();
        }
        if self.config.keep {
            return vec![Note::Kept(self.largest)];
        }
        let is_linear = self.shift.law.acts_on_light();
        for color in &mut self.scene.colors[self.n_given..] {
            if let ColorValue::Hsv { value, factor, .. } = &mut color.value {
                if is_linear {
                    *factor = factor.min(1.0 / srgb_decode(*value));
                } else {
                    *value = value.min(1.0);
                }
            }
        }
        vec![Note::Clipped(self.largest)]
    }
}

fn key(color: VertexColor) -> BaseKey {
    match color {
        VertexColor::Named(id) => BaseKey::Named(id),
        VertexColor::White => BaseKey::White,
        VertexColor::Mixed(color) => BaseKey::Mixed(color.key()),
    }
}
