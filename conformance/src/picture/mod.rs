//! Pictures of stated scenes, and what is measured in them.
//!
//! A case is a scene of `conformance/scenes/`, with its camera, and the size of the picture. Whoever draws it can have the
//! picture measured: the numbers do not depend on lights, on the kind of colours, or on how edges are smoothed.

mod camera;
mod colours;
mod cube;
mod depth;
mod edge;
mod sight;
mod sphere;

use std::fmt;

use image::{ImageFormat, RgbImage};
use ugparse::{Options, Source};

use camera::Pinhole;

/// A picture that is asked for.
pub struct PictureCase {
    /// Its name, one word.
    pub name: &'static str,
    /// What it shows.
    pub about: &'static str,
    /// The scene, in UniGrafix.
    pub scene: &'static str,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// How this project's programs draw it.
    switches: Switches,
    measure: fn(&Sight) -> Result<Vec<Measured>, String>,
}

/// Options of this project's programs.
#[derive(Clone, Copy, Default)]
struct Switches {
    /// Bodies are seen where they stand in the scene.
    in_place: bool,
    /// Colours are shifted.
    shift: bool,
    /// Not by their hues but as spectra.
    spectral: bool,
    /// Samples along the side of a pixel.
    samples: u32,
}

/// A picture and the camera it was taken with.
struct Sight {
    pixels: RgbImage,
    /// The largest channel anywhere.
    brightest: u8,
    camera: Pinhole,
}

/// A number found in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// What it is, with its unit.
    pub what: String,
    /// The number found.
    pub found: f64,
    /// What is right.
    pub right: Right,
}

/// What a number in a picture should be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Right {
    /// This number.
    About {
        /// The number itself.
        value: f64,
        /// How far it may be off; from the size of a pixel or of a level.
        tolerance: f64,
    },
    /// This or more: the picture would not show anything otherwise.
    AtLeast(f64),
}

impl Measured {
    fn new(what: impl Into<String>, found: f64, value: f64, tolerance: f64) -> Self {
        Self { what: what.into(), found, right: Right::About { value, tolerance } }
    }

    fn at_least(what: impl Into<String>, found: f64, least: f64) -> Self {
        Self { what: what.into(), found, right: Right::AtLeast(least) }
    }

    /// Is it right? NaN is not.
    pub fn passes(&self) -> bool {
        match self.right {
            Right::About { value, tolerance } => (self.found - value).abs() <= tolerance,
            Right::AtLeast(least) => self.found >= least,
        }
    }
}

impl fmt::Display for Measured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.passes() { "ok    " } else { "FAILED" };
        write!(f, "{verdict}  {}: {:.4}, right is ", self.what, self.found)?;
        match self.right {
            Right::About { value, tolerance } => write!(f, "{value:.4} ± {tolerance:.4}"),
            Right::AtLeast(least) => write!(f, "{least:.4} or more"),
        }
    }
}

const SHAPE: Switches = Switches { in_place: false, shift: false, spectral: false, samples: 1 };

/// All cases.
pub const CASES: [PictureCase; 8] = [
    PictureCase {
        name: "sphere",
        about: "T11: the outline of a fast sphere is a circle in the sphere of directions",
        scene: include_str!("../../scenes/sphere.ug"),
        size: [600, 600],
        switches: SHAPE,
        measure: sphere::measure,
    },
    PictureCase {
        name: "cube",
        about: "T08, T09: a far cube abeam looks turned by asin 0.8",
        scene: include_str!("../../scenes/cube.ug"),
        size: [800, 800],
        switches: Switches { in_place: true, ..SHAPE },
        measure: cube::measure,
    },
    PictureCase {
        name: "edge",
        about: "T10: a straight edge across the motion is seen as a hyperbola",
        scene: include_str!("../../scenes/edge.ug"),
        size: [600, 450],
        switches: SHAPE,
        measure: edge::measure,
    },
    PictureCase {
        name: "depth",
        about: "T36: what hides what is decided in the frame of the eye",
        scene: include_str!("../../scenes/depth.ug"),
        size: [400, 400],
        switches: SHAPE,
        measure: depth::measure,
    },
    PictureCase {
        name: "wide",
        about: "T19: D depends on the direction, not on the shape of the picture",
        scene: include_str!("../../scenes/wide.ug"),
        size: [640, 360],
        switches: Switches { shift: true, samples: 2, ..SHAPE },
        measure: colours::measure_wide,
    },
    PictureCase {
        name: "shift",
        about: "T22: the shift is applied once",
        scene: include_str!("../../scenes/shift.ug"),
        size: [400, 200],
        switches: Switches { shift: true, samples: 2, ..SHAPE },
        measure: colours::measure_shift,
    },
    PictureCase {
        name: "blackbody",
        about: "T22: a moving black body has the colour of a hotter or colder one",
        scene: include_str!("../../scenes/blackbody.ug"),
        size: [400, 100],
        switches: Switches { shift: true, spectral: true, samples: 2, ..SHAPE },
        measure: colours::measure_moving,
    },
    PictureCase {
        name: "colours",
        about: "T22: black bodies and greys on an sRGB screen",
        scene: include_str!("../../scenes/colours.ug"),
        size: [600, 200],
        switches: Switches { samples: 2, ..SHAPE },
        measure: colours::measure_patches,
    },
];

/// The case of a name.
pub fn case(name: &str) -> Option<&'static PictureCase> {
    CASES.iter().find(|case| case.name == name)
}

impl PictureCase {
    /// Measures a PNG of the scene.
    ///
    /// # Errors
    /// It is no PNG, has another size, or does not show what is to be measured.
    pub fn measure(&self, png: &[u8]) -> Result<Vec<Measured>, String> {
        let pixels = image::load_from_memory_with_format(png, ImageFormat::Png)
            .map_err(|error| format!("the picture cannot be read: {error}"))?
            .into_rgb8();
        let [width, height] = self.size;
        if pixels.dimensions() != (width, height) {
            let (w, h) = pixels.dimensions();
            return Err(format!("the picture is {w} x {h} pixels; `{}` is {width} x {height}", self.name));
        }
        let brightest = pixels.as_raw().iter().copied().max().unwrap_or(0);
        (self.measure)(&Sight { pixels, brightest, camera: self.camera()? })
    }

    fn camera(&self) -> Result<Pinhole, String> {
        let source = Source::new(self.name, self.scene);
        let scene = ugparse::parse(&source, &Options::default()).map_err(|error| error.to_string())?.scene;
        let camera = scene.camera().and_then(|camera| Pinhole::new(camera, self.size));
        camera.ok_or_else(|| format!("the scene `{}` has no camera", self.name))
    }

    /// Draws the scene with this project's programs, in one process: a PNG.
    ///
    /// # Errors
    /// What a program says, which it does not of scenes as they are in the suite.
    pub fn draw(&self) -> Result<Vec<u8>, String> {
        let name = |what: &str| format!("{}.ug as {what} sees it", self.name);
        let lorentz = uglorentz::Config { in_place: self.switches.in_place, ..Default::default() };
        let seen = uglorentz::run(&lorentz, &Source::new(name("uglorentz"), self.scene))
            .map_err(|error| error.to_string())?;
        // `-vr`: faces of one body keep their own colours.
        let doppler = ugdoppler::Config {
            repeat: true,
            doppler: self.switches.shift,
            spectral: self.switches.spectral,
            flux: false,
            ..Default::default()
        };
        let colored = ugdoppler::run(&doppler, &Source::new(name("ugdoppler"), seen.text()))
            .map_err(|error| error.to_string())?;
        let rainbow =
            ugrainbow::Config { size: self.size, samples: self.switches.samples, ..Default::default() };
        let picture = ugrainbow::run(&rainbow, &Source::new(name("ugrainbow"), colored.text()))
            .map_err(|error| error.to_string())?;
        Ok(picture.bytes)
    }
}
