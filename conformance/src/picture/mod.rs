//! Pictures of given scenes, and measurements in them.
//!
//! A case consists of a scene in `conformance/scenes/`, which has a camera, and the size of the
//! picture. The measurements do not depend on lights, the kind of colours, or anti-aliasing.

mod camera;
mod colours;
mod cube;
mod depth;
mod edge;
mod export;
mod mistaken;
mod pixels;
mod sphere;

use std::fmt;

use image::{ImageFormat, RgbImage};
use serde_json::{Value, json};
use ugparse::{Options, Source};
use ugphoton::{ColorShift, Lens};
use ugrainbow::PictureOptions;
use ugscene::Scene;

use crate::compare::refuse_lossy;
use crate::mistakes;
use camera::Sight;
pub use export::{cameras, objects};
pub use mistaken::{lines, recognized};

/// A case of the suite: a picture to be drawn and measured.
#[derive(Debug)]
pub struct PictureCase {
    /// Its name, one word.
    pub name: &'static str,
    /// Topic and description.
    pub about: &'static str,
    /// The scene, in UniGrafix.
    pub scene: &'static str,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// A pinhole, or an equirectangular panorama.
    pub lens: Lens,
    /// Options with which this project's programs draw it.
    options: DrawOptions,
    measure: fn(&Picture) -> Result<Vec<MeasuredQuantity>, String>,
}

/// Which of this project's programs draw a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawnBy {
    /// `uglorentz`, `ugdoppler` and `ugrainbow`, by the light of vertices.
    Pipe,
    /// `ugphoton`, by a ray for each sample.
    Rays,
}

/// Options of this project's programs.
#[derive(Clone, Copy, Debug, Default)]
struct DrawOptions {
    /// Colours are shifted.
    shift: bool,
    /// As spectra instead of hues.
    spectral: bool,
    /// Samples along the side of a pixel.
    samples: u32,
}

/// A picture and its camera.
struct Picture {
    pixels: RgbImage,
    /// The largest channel of all pixels.
    brightest: u8,
    camera: Sight,
}

/// A quantity measured in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredQuantity {
    /// Its name and unit.
    pub quantity: String,
    /// The measured value.
    pub value: f64,
    /// The expected value.
    pub expected: Expected,
}

/// The measurements of a picture for programs. A tolerance of `null` is that of a lower bound.
pub fn json(case: &PictureCase, measured: &[MeasuredQuantity], recognized: &[&str]) -> Value {
    let measured = measured.iter().map(|number| {
        let (expected, tolerance) = match number.expected {
            Expected::About { value, tolerance } => (value, Some(tolerance)),
            Expected::AtLeast(least) => (least, None),
        };
        let MeasuredQuantity { quantity, value, .. } = number;
        json!({ "quantity": quantity, "value": value, "expected": expected, "tolerance": tolerance,
            "passes": number.passes() })
    });
    let looks_like = mistakes::json(recognized.iter().copied());
    json!({ "picture": case.name, "about": case.about, "measured": measured.collect::<Vec<_>>(),
        "looks_like": looks_like })
}

/// The expected value of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// A number with a tolerance.
    About {
        /// The number.
        value: f64,
        /// The largest allowed deviation, from the size of a pixel or of a level.
        tolerance: f64,
    },
    /// A lower bound: below it, the other measurements would prove nothing.
    AtLeast(f64),
}

impl MeasuredQuantity {
    fn new(quantity: impl Into<String>, value: f64, expected: f64, tolerance: f64) -> Self {
        let expected = Expected::About { value: expected, tolerance };
        Self { quantity: quantity.into(), value, expected }
    }

    fn at_least(quantity: impl Into<String>, value: f64, least: f64) -> Self {
        Self { quantity: quantity.into(), value, expected: Expected::AtLeast(least) }
    }

    /// Is the value as expected? NaN never is.
    pub fn passes(&self) -> bool {
        match self.expected {
            Expected::About { value, tolerance } => (self.value - value).abs() <= tolerance,
            Expected::AtLeast(least) => self.value >= least,
        }
    }
}

impl fmt::Display for MeasuredQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.passes() { "ok    " } else { "FAILED" };
        write!(f, "{verdict}  {}: {:.4}, expected ", self.quantity, self.value)?;
        match self.expected {
            Expected::About { value, tolerance } => write!(f, "{value:.4} ± {tolerance:.4}"),
            Expected::AtLeast(least) => write!(f, "{least:.4} or more"),
        }
    }
}

const SHAPE: DrawOptions = DrawOptions { shift: false, spectral: false, samples: 1 };
const PATCHES: DrawOptions = DrawOptions { samples: 2, ..SHAPE };
const SHIFTED: DrawOptions = DrawOptions { shift: true, ..PATCHES };
const SPECTRA: DrawOptions = DrawOptions { spectral: true, ..SHIFTED };

/// Cases by name, size, lens, options and measurement, each with its topic and description.
macro_rules! cases {
    ($($name:literal $size:tt $lens:ident $options:ident $measure:path: $about:literal;)*) => {
        [$(PictureCase {
            name: $name,
            about: $about,
            scene: include_str!(concat!("../../scenes/", $name, ".ug")),
            size: $size,
            lens: Lens::$lens,
            options: $options,
            measure: $measure,
        }),*]
    };
}

/// All cases.
pub const CASES: [PictureCase; 9] = cases! {
    "sphere" [600, 600] Pinhole SHAPE sphere::measure:
        "T11: the outline of a moving sphere is a circle on the sphere of directions";
    "panorama" [2000, 1000] Panorama SHAPE sphere::measure_panorama:
        "T11: the same outline in a panorama, in both hemispheres";
    "cube" [800, 800] Pinhole SHAPE cube::measure:
        "T08, T09: a distant cube seen at right angles to its motion looks rotated by asin 0.8";
    "edge" [600, 450] Pinhole SHAPE edge::measure:
        "T10: a straight edge perpendicular to the motion appears as a hyperbola";
    "depth" [400, 400] Pinhole SHAPE depth::measure:
        "T36: occlusion is determined in the frame of the eye";
    "wide" [640, 360] Pinhole SHIFTED colours::measure_wide:
        "T19: D depends on the direction, not on the aspect ratio of the picture";
    "shift" [400, 200] Pinhole SHIFTED colours::measure_shift:
        "T22: the shift is applied once";
    "blackbody" [400, 100] Pinhole SPECTRA colours::measure_moving:
        "T22: a moving black body has the colour of a hotter or colder one";
    "colours" [600, 200] Pinhole PATCHES colours::measure_patches:
        "T22: black bodies and greys on an sRGB screen";
};

/// Finds a case by its name.
pub fn case(name: &str) -> Option<&'static PictureCase> {
    CASES.iter().find(|case| case.name == name)
}

impl PictureCase {
    /// Measures a PNG of the scene.
    ///
    /// # Errors
    /// It is not a PNG, has a wrong size, or does not show what is to be measured.
    pub fn measure(&self, png: &[u8]) -> Result<Vec<MeasuredQuantity>, String> {
        refuse_lossy(png, "PNG")?;
        let pixels = image::load_from_memory_with_format(png, ImageFormat::Png)
            .map_err(|error| format!("the picture cannot be read: {error}; write it as PNG"))?
            .into_rgb8();
        let [width, height] = self.size;
        if pixels.dimensions() != (width, height) {
            let (w, h) = pixels.dimensions();
            return Err(format!(
                "the picture is {w} x {h} pixels; `{}` is {width} x {height}",
                self.name
            ));
        }
        let brightest = pixels.as_raw().iter().copied().max().unwrap_or(0);
        (self.measure)(&Picture { pixels, brightest, camera: self.camera()? })
    }

    fn parsed(&self) -> Result<Scene, String> {
        let source = Source::new(self.name, self.scene);
        let parsed = ugparse::parse(&source, &Options::default());
        parsed.map(|parsed| parsed.scene).map_err(|error| error.to_string())
    }

    fn camera(&self) -> Result<Sight, String> {
        let scene = self.parsed()?;
        let camera = scene.camera().and_then(|camera| Sight::new(camera, self.lens, self.size));
        camera.ok_or_else(|| format!("the scene `{}` has no camera", self.name))
    }

    /// The programs of this project that draw the scene: panoramas are traced only.
    pub fn renderers(&self) -> &'static [DrawnBy] {
        match self.lens {
            Lens::Pinhole => &[DrawnBy::Pipe, DrawnBy::Rays],
            _ => &[DrawnBy::Rays],
        }
    }

    /// Draws the scene with this project's programs, in one process, to a PNG; by rays if the other
    /// programs do not draw it.
    ///
    /// # Errors
    /// The message of a program. There is none for the scenes of the suite.
    pub fn draw(&self, drawn_by: DrawnBy) -> Result<Vec<u8>, String> {
        match drawn_by {
            DrawnBy::Pipe if self.lens == Lens::Pinhole => self.draw_by_pipe(|_, _| {}),
            DrawnBy::Pipe | DrawnBy::Rays => self.draw_by_rays(),
        }
    }

    /// `change`: makes a mistake.
    fn draw_by_pipe(
        &self,
        change: impl Fn(&mut Scene, &mut uglorentz::Config),
    ) -> Result<Vec<u8>, String> {
        let mut parsed = ugparse::parse(&self.source("uglorentz"), &Options::default())
            .map_err(|error| error.to_string())?;
        let mut lorentz = uglorentz::Config::default();
        change(&mut parsed.scene, &mut lorentz);
        let (seen, _) =
            uglorentz::apply(parsed.scene, &lorentz).map_err(|error| error.to_string())?;
        // `-vr`: faces of one body keep their own colours.
        let doppler =
            ugdoppler::Config { repeat: true, shift: self.color_shift(), ..Default::default() };
        let (colored, _) = ugdoppler::apply(seen, &doppler).map_err(|error| error.to_string())?;
        let rainbow = ugrainbow::Config { picture: self.picture_options(), ..Default::default() };
        let source = Source::new(self.input_of("ugrainbow"), ugparse::write(&colored));
        let picture = ugrainbow::run(&rainbow, &source).map_err(|error| error.to_string())?;
        Ok(picture.bytes)
    }

    fn draw_by_rays(&self) -> Result<Vec<u8>, String> {
        let config = ugphoton::Config {
            shift: self.color_shift(),
            picture: self.picture_options(),
            lens: self.lens,
            repeat: true,
            ..Default::default()
        };
        let picture = ugphoton::run(&config, &self.source("ugphoton"), ugphoton::PROVENANCE, &())
            .map_err(|error| error.to_string())?;
        Ok(picture.bytes)
    }

    fn color_shift(&self) -> ColorShift {
        let DrawOptions { shift, spectral, .. } = self.options;
        ColorShift::new(spectral, shift, false, None)
    }

    fn picture_options(&self) -> PictureOptions {
        PictureOptions {
            size: self.size,
            samples: self.options.samples,
            ..PictureOptions::default()
        }
    }

    fn source(&self, program: &str) -> Source {
        Source::new(self.input_of(program), self.scene)
    }

    fn input_of(&self, program: &str) -> String {
        format!("{}.ug as input of {program}", self.name)
    }
}
