//! Pictures of worlds: by rays, by the exact mode of the pipe, and by the whole pipe.

use std::sync::{Arc, LazyLock};

use ugimage::{Format, LinearFrame, Samples};
use uglight::ColorShift;
use uglorentz::Pieces;
use ugparse::{Options, Source};
use ugphoton::{Channel, Lens, Output, PictureOptions, RayOptions, Shutter};
use ugphysics::Brightness;
use ugscene::{Anchor, ColorValue, MotionOptions, Scene, Tint, VertexId};

use super::generate::MEASURED;
use super::world::{Beam, Lamp, World};

/// Pixels across and down.
pub const SIZE: [u32; 2] = [24, 18];

/// Error of the light between the vertices of the pipe, part of the brightest.
pub const LIGHT_ERROR: f64 = 0.005;

/// A picture of eight by eight pixels, as PFM.
static TEXTURE: LazyLock<Arc<[u8]>> = LazyLock::new(|| {
    let light =
        (0..8 * 8 * 3).flat_map(|at: u32| ((10 + at * 37 % 90) as f32 / 100.0).to_le_bytes());
    b"PF\n8 8\n-1.0\n".iter().copied().chain(light).collect()
});

/// Colours as they are at rest.
pub const UNSHIFTED: ColorShift = ColorShift::NONE;

/// Colours as spectra.
pub const SPECTRA: ColorShift = ColorShift::SPECTRA;

/// Grey stays grey, and its light is multiplied by a power of D.
pub const fn by_law(law: Brightness) -> ColorShift {
    ColorShift::hues(true, law)
}

/// Who draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Renderer {
    /// `ugphoton`
    Rays,
    /// `uglorentz | ugrainbow -xc`
    Exact,
    /// `uglorentz | ugdoppler | ugrainbow`
    Pipe,
}

/// How a world is drawn.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Its scene.
    pub text: String,
    /// Times and anchors.
    pub motion: MotionOptions,
    /// By whom.
    pub renderer: Renderer,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Samples along a side of a pixel.
    pub samples: u32,
    /// How motion changes colours.
    pub shift: ColorShift,
    /// See [`LIGHT_ERROR`].
    pub light_error: f64,
    /// Additional options of `ugphoton`.
    pub rays: RayOptions,
    /// The lens of `ugphoton`.
    pub lens: Lens,
    /// The distance of two eyes.
    pub stereo: Option<f64>,
    /// A part of the picture.
    pub crop: Option<[u32; 4]>,
    /// More than colours.
    pub channels: Vec<Channel>,
}

impl Picture {
    /// By rays with all their light, and one sample a pixel.
    /// Of a lamp with an area that casts shadows another point lights each sample, so pictures with
    /// one have no shadows.
    pub fn new(world: &World, shift: ColorShift) -> Self {
        let mut picture = Self { motion: world.motion(), ..Self::of_scene(world.text(), shift) };
        let has_area = |lamp: &Lamp| matches!(lamp.beam, Some(Beam::Area { .. }));
        picture.rays.shadows = !world.lamps.iter().any(has_area);
        picture
    }

    /// The picture of a scene, as [`Self::new`].
    pub fn of_scene(text: String, shift: ColorShift) -> Self {
        Self {
            text,
            motion: MotionOptions::default(),
            renderer: Renderer::Rays,
            size: SIZE,
            samples: 1,
            shift,
            light_error: LIGHT_ERROR,
            rays: RayOptions { cutoff: 0.0, ..RayOptions::default() },
            lens: Lens::Pinhole,
            stereo: None,
            crop: None,
            channels: Vec::new(),
        }
    }

    /// By another renderer. The pipe knows neither mirrors nor shadows.
    #[must_use]
    pub fn by(self, renderer: Renderer) -> Self {
        Self { renderer, ..self }
    }

    /// Without mirrors, glass and shadows, as the pipe draws.
    #[must_use]
    pub fn like_pipe(mut self) -> Self {
        (self.rays.depth, self.rays.shadows) = (0, false);
        self
    }

    /// A picture of a single pixel.
    #[must_use]
    pub fn of_pixel(self) -> Self {
        Self { size: [1, 1], ..self }
    }

    /// Draws it.
    ///
    /// # Errors
    /// The answer of a program instead.
    pub fn draw(&self) -> Result<Drawn, String> {
        let frame = match self.renderer {
            Renderer::Rays => self.traced(),
            Renderer::Exact => self.exact(),
            Renderer::Pipe => self.piped(),
        };
        let frame = frame.map_err(|error| format!("{error}\n{}", self.described()))?;
        Ok(Drawn { frame, picture: self.clone() })
    }

    fn scene(&self) -> Result<Scene, String> {
        let source = Source::new("world.ug", self.scene_text());
        let parsed = ugparse::read(&source, &Options::default(), None);
        let mut scene = parsed.map(|parsed| parsed.scene).map_err(words)?;
        scene.textures.iter_mut().for_each(|texture| texture.image.bytes = TEXTURE.clone());
        Ok(scene)
    }

    /// Measured surfaces are spectra: where colours are hues, they are grey.
    fn scene_text(&self) -> String {
        let hue = |text: String, name: &&str| text.replace(name, ".5 .5 .5");
        if self.shift.is_spectral() {
            self.text.clone()
        } else {
            MEASURED.iter().fold(self.text.replace("c_refl", "c_rgb"), hue)
        }
    }

    fn options(&self) -> PictureOptions {
        PictureOptions {
            size: self.size,
            samples: self.samples,
            channels: self.channels.clone(),
            output: Output::Color(Format::Exr),
            ..PictureOptions::default()
        }
    }

    fn traced(&self) -> Result<LinearFrame, String> {
        let config = ugphoton::Config {
            motion: self.motion.clone(),
            shift: self.shift,
            picture: self.options(),
            rays: self.rays,
            lens: self.lens,
            stereo: self.stereo,
            crop: self.crop,
            ..ugphoton::Config::default()
        };
        ugphoton::light(self.scene()?, &config).map_err(words)
    }

    fn seen(&self, pieces: Pieces) -> Result<Scene, String> {
        let MotionOptions { velocity, camera_velocity, time, anchor, in_place, geometry, zero } =
            self.motion.clone();
        let Self { size, light_error, .. } = *self;
        let config = uglorentz::Config {
            velocity,
            camera_velocity,
            time,
            anchor,
            in_place,
            geometry,
            zero,
            size,
            pieces,
            light_error,
            is_for_rays: false,
            ..uglorentz::Config::default()
        };
        uglorentz::apply(self.scene()?, &config).map(|(scene, _)| scene).map_err(words)
    }

    fn exact(&self) -> Result<LinearFrame, String> {
        let config = ugrainbow::Config {
            picture: self.options(),
            exact: Some(self.shift),
            ..ugrainbow::Config::default()
        };
        ugrainbow::light(&self.seen(Pieces::PerEdge(1))?, &config).map_err(words)
    }

    fn piped(&self) -> Result<LinearFrame, String> {
        let colored = self.colored(self.pieces()?)?;
        let config = ugrainbow::Config { picture: self.options(), ..ugrainbow::Config::default() };
        ugrainbow::light(&colored, &config).map_err(words)
    }

    /// For each piece of a face in the pipe, whether light at its corners does not tell the light
    /// between them: a lamp sets in it, that is, lights some of its corners and not others; or
    /// their hues are far apart, at the two ends of the spectrum or on the two sides of grey.
    ///
    /// # Errors
    /// The answer of a program instead.
    pub fn uneven_pieces(&self) -> Result<Vec<bool>, String> {
        let pieces = self.pieces()?;
        let mut is_uneven = self.of_pieces(&pieces, |values| {
            let hues: Vec<f64> = values
                .iter()
                .filter_map(|value| match value {
                    ColorValue::Hsv { tint: Tint::Hue(hue), saturation, .. }
                        if *saturation > 0.0 =>
                    {
                        Some(*hue)
                    }
                    _ => None,
                })
                .collect();
            hues.iter().any(|a| hues.iter().any(|b| (a - b).abs() > 60.0))
        })?;
        for lamp in &pieces.lights {
            let lit = Scene { lights: vec![lamp.clone()], ..pieces.clone() };
            let has_dusk = self.of_pieces(&lit, |values| {
                let is_dark = |value: &ColorValue| match value {
                    ColorValue::Xyz(xyz) => *xyz == [0.0; 3],
                    ColorValue::Hsv { value, .. } => *value == 0.0,
                    _ => false,
                };
                values.iter().any(is_dark) && !values.iter().all(is_dark)
            })?;
            is_uneven.iter_mut().zip(has_dusk).for_each(|(uneven, dusk)| *uneven |= dusk);
        }
        Ok(is_uneven)
    }

    /// For each face of a scene whether something holds of the colours of its corners.
    fn of_pieces(
        &self,
        scene: &Scene,
        holds: impl Fn(&[ColorValue]) -> bool,
    ) -> Result<Vec<bool>, String> {
        let colored = self.colored(scene.clone())?;
        let value = |corner: &VertexId| {
            let color = colored.vertices[corner.index()].color;
            color.map(|color| colored.colors[color.index()].value)
        };
        let of_face = |face: &ugscene::Face| {
            let corners = colored.contours.corners(face.contours.clone());
            holds(&corners.iter().filter_map(value).collect::<Vec<_>>())
        };
        Ok(colored.faces.iter().map(of_face).collect())
    }

    fn pieces(&self) -> Result<Scene, String> {
        self.seen(Pieces::UpTo(uglorentz::DEFAULT_ERROR))
    }

    fn colored(&self, seen: Scene) -> Result<Scene, String> {
        let config = ugdoppler::Config {
            shift: self.shift,
            light: true,
            // Textures are drawn without it.
            keep: seen.textures.is_empty(),
            tolerance: 0.0,
            ..ugdoppler::Config::default()
        };
        ugdoppler::apply(seen, &config).map(|(scene, _)| scene).map_err(words)
    }

    /// The command line and the scene, to draw the picture by hand.
    pub fn described(&self) -> String {
        let mut motion = format!("-ti {}", self.motion.time);
        if let Some(Anchor::Point(point)) = self.motion.anchor {
            motion += &format!(" -an {} {} {}", point.x, point.y, point.z);
        } else if let Some(anchor) = self.motion.anchor {
            motion += &format!(" -an {anchor:?}").to_lowercase();
        }
        if self.motion.in_place {
            motion += " -in";
        }
        let [width, height] = self.size;
        let picture = format!("-sz {width} {height} -aa {} -dt exr", self.samples);
        let shift = match self.shift {
            ColorShift::Spectra(_) => "-sp".to_owned(),
            UNSHIFTED => "--no-doppler --no-flux".to_owned(),
            ColorShift::Hues(shift) => format!("-br {}", shift.law.name()),
        };
        let keep = if self.shift.is_spectral() { "" } else { "-hd " };
        let command = match self.renderer {
            Renderer::Rays => {
                format!("ugphoton {motion} {shift} {picture}{}", self.of_rays())
            }
            Renderer::Exact => {
                format!("uglorentz -sd 1 {motion} | ugrainbow -xc {shift} {picture}")
            }
            Renderer::Pipe => {
                let percent = 100.0 * self.light_error;
                format!(
                    "uglorentz -sl {percent} {motion} | ugdoppler -li {keep}{shift} | ugrainbow {picture}"
                )
            }
        };
        format!("{{ {command} }}\n{}", self.scene_text())
    }

    fn of_rays(&self) -> String {
        let mut words = format!(" -rd {} -rc {}", self.rays.depth, self.rays.cutoff);
        for (is_given, word) in
            [(!self.rays.shadows, " --no-shadows"), (self.rays.fresnel, " --fresnel")]
        {
            words += if is_given { word } else { "" };
        }
        if let Shutter::Film { distance } = self.rays.shutter {
            words += &format!(" --film-shutter {distance}");
        }
        words += &match self.lens {
            Lens::Pinhole => String::new(),
            Lens::Panorama => " -pan".to_owned(),
            Lens::Fisheye { angle } => format!(" -fish {}", angle.to_degrees()),
            Lens::Cube => " -cube".to_owned(),
        };
        if let Some(distance) = self.stereo {
            words += &format!(" -stereo {distance}");
        }
        if let Some(crop) = self.crop {
            words += &format!(" -crop {}", crop.map(|number| number.to_string()).join(" "));
        }
        words
    }
}

fn words(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// A picture that was drawn.
#[derive(Clone, Debug)]
pub struct Drawn {
    frame: LinearFrame,
    /// How.
    pub picture: Picture,
}

impl Drawn {
    /// Linear red, green and blue, row by row.
    pub fn light(&self) -> Vec<[f32; 3]> {
        self.frame.pixels().iter().map(|&pixel| self.frame.light_of(pixel)).collect()
    }

    /// The numbers of faces from 1, 0 where nothing is seen.
    pub fn ids(&self) -> &[u32] {
        let plane = self.frame.planes().iter().find(|plane| plane.name == "id");
        match plane.map(|plane| &plane.samples) {
            Some(Samples::Whole(ids)) => ids,
            _ => &[],
        }
    }

    /// A channel of real numbers; empty if the picture has none of this name.
    pub fn channel(&self, name: &str) -> &[f32] {
        let plane = self.frame.planes().iter().find(|plane| plane.name == name);
        match plane.map(|plane| &plane.samples) {
            Some(Samples::Float(numbers)) => numbers,
            _ => &[],
        }
    }
}
