//! Compares a picture drawn by the programs with the oracle.
//!
//! Every face gets its own colour, the light is ambient and colours are not shifted, so the colour
//! of a pixel identifies the face it shows.

use std::fmt::{self, Display, Formatter};

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use ugscene::{Color, ColorId, ColorValue, Face, Light, LightKind, LightMotion, Scene};

use crate::oracle::{Oracle, Pinhole};
use crate::picture::Picture;

/// The least fraction of the pixels that show the expected face. The rods of the lattice are few
/// pixels wide, so many of its pixels are at edges; all others must be explained anyway.
const LEAST_AGREEMENT: f64 = 0.99;

/// The search stops after this number of wrong pixels.
const MOST_WRONG: usize = 2000;

/// Levels between colours of faces. Pixels are exact to one level.
const STEP: usize = 4;
/// Darkest level of a colour, well above the black background.
const DARKEST: usize = 28;
/// Colours of one plane: two channels, the third is 0.
const SIDE: usize = 57;

/// The largest number of faces that have distinct colours.
pub const MOST_FACES: usize = 2 * SIDE * SIDE;

/// The colour of a face: without blue, then without red. Its hue lies in 0…240 degrees, where
/// wavelengths are not attenuated (P17).
pub fn color_of(face: usize) -> [u8; 3] {
    let plane = face % (SIDE * SIDE);
    let [a, b] = [plane % SIDE, plane / SIDE]
        .map(|step| u8::try_from(DARKEST + STEP * step).expect("a level is a byte"));
    match face / (SIDE * SIDE) {
        0 => [a, b, 0],
        1 => [0, a, b],
        _ => panic!("there are colours for {} faces only", 2 * SIDE * SIDE),
    }
}

/// The content of a pixel: a face, or the background. `Err` for a colour that no face has.
pub type Shown = Result<Option<usize>, [u8; 4]>;

/// The face that a pixel of a [`recolored`] scene shows.
pub fn face_of(pixel: [u8; 4]) -> Shown {
    let step = |level: u8| {
        let above = usize::from(level).checked_sub(DARKEST - 1)?;
        (above % STEP <= 2).then_some(above / STEP).filter(|&step| step < SIDE)
    };
    match pixel {
        [0, 0, 0, 255] => Ok(None),
        [r, g, 0, 255] => step(r).zip(step(g)).map(|(a, b)| Some(a + SIDE * b)).ok_or(pixel),
        [0, g, b, 255] => {
            step(g).zip(step(b)).map(|(a, b)| Some(SIDE * SIDE + a + SIDE * b)).ok_or(pixel)
        }
        _ => Err(pixel),
    }
}

/// The scene with a distinct colour for each face, and ambient light.
pub fn recolored(mut scene: Scene) -> Scene {
    scene.colors.clear();
    scene.wires.clear();
    scene.lights = vec![Light {
        name: None,
        intensity: 1.0,
        kind: LightKind::Ambient,
        color: None,
        motion: LightMotion::WithWhatItLights,
    }];
    for vertex in &mut scene.vertices {
        vertex.color = None;
    }
    for (row, face) in scene.faces.iter_mut().enumerate() {
        let rgb = color_of(row).map(|level| f64::from(level) / 255.0);
        let name = scene.names.add(&format!("k{row}"));
        scene.colors.push(Color { name, value: ColorValue::Rgb(rgb), translucency: 0.0 });
        *face = Face { color: Some(ColorId::from_index(row)), shading: None, ..face.clone() };
    }
    scene
}

/// The result of a comparison of the pipe with the oracle.
#[derive(Debug, Default)]
pub struct Agreement {
    /// Number of pixels.
    pub n_pixels: usize,
    /// Pixels where both show the same face, or two faces that coincide there.
    pub n_same: usize,
    /// Pixels where the oracle sees the background.
    pub n_empty: usize,
    /// Pixels with a face that is not visible within reach.
    pub wrong: Vec<Wrong>,
}

impl Agreement {
    /// The fraction of the pixels that show the expected face.
    pub fn fraction(&self) -> f64 {
        self.n_same as f64 / self.n_pixels as f64
    }

    /// Do all pixels show a face that is visible within reach, nearly all the expected face, and
    /// not all the background?
    pub fn is_good(&self) -> bool {
        let shows_something = self.n_empty < self.n_pixels * 98 / 100;
        self.fraction() >= LEAST_AGREEMENT && self.wrong.is_empty() && shows_something
    }
}

impl Display for Agreement {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:.3} % agree, {} differ",
            100.0 * self.fraction(),
            self.n_pixels - self.n_same
        )?;
        write!(f, ", {:.0} % empty", 100.0 * self.n_empty as f64 / self.n_pixels as f64)?;
        write!(f, ", {} wrong", self.wrong.len())?;
        for Wrong { pixel, shown, expected } in self.wrong.iter().take(8) {
            write!(f, ", {pixel:?} shows {shown:?} instead of {expected:?}")?;
        }
        Ok(())
    }
}

/// A pixel that shows a wrong face.
#[derive(Debug)]
pub struct Wrong {
    /// Column and row.
    pub pixel: [u32; 2],
    /// The face in the picture.
    pub shown: Shown,
    /// The face the oracle sees.
    pub expected: Option<usize>,
}

/// Slightly more than the distance between the centres of diagonal neighbours, pixels.
const DIAGONAL: f64 = 1.415;

/// Determines which faces are visible near a pixel.
struct Neighbourhood<'a> {
    oracle: &'a Oracle,
    camera: &'a Pinhole,
    /// The face the oracle sees at the centre of each pixel.
    picture: &'a [Option<usize>],
    /// The allowed displacement of a face, pixels.
    reach: f64,
}

impl Neighbourhood<'_> {
    /// Is the face, or the background, visible within reach of a pixel's centre?
    fn shows(&self, face: Option<usize>, center: DVec2) -> bool {
        (self.reach >= DIAGONAL && self.neighbours(center).any(|neighbour| neighbour == face))
            || face.is_some_and(|face| self.has_edge(face, center))
            || self.rings(center).any(|seen| seen == face)
            || self.grid(center).contains(&face)
    }

    /// The faces in the eight neighbouring pixels.
    fn neighbours(&self, center: DVec2) -> impl Iterator<Item = Option<usize>> {
        let [width, height] = self.camera.size().map(|side| side as usize);
        let (x, y) = (center.x as usize, center.y as usize);
        let rows = y.saturating_sub(1)..height.min(y + 2);
        let columns = move || x.saturating_sub(1)..width.min(x + 2);
        rows.flat_map(move |y| columns().map(move |x| self.picture[y * width + x]))
    }

    /// The faces visible at 48 points on each of five rings.
    fn rings(&self, center: DVec2) -> impl Iterator<Item = Option<usize>> {
        (1..=5).flat_map(move |ring| {
            let points = (0..48).map(|step| {
                let (sin, cos) = libm::sincos(f64::from(step) / 48.0 * std::f64::consts::TAU);
                center + self.reach * f64::from(ring) / 5.0 * DVec2::new(cos, sin)
            });
            let directions: Vec<DVec3> = points.map(|p| self.camera.direction(p.x, p.y)).collect();
            self.oracle.faces(&directions)
        })
    }

    /// The faces visible at points a twenty-fifth of the reach apart. Slow; necessary for slits and
    /// corners.
    fn grid(&self, center: DVec2) -> Vec<Option<usize>> {
        const N_STEPS: i32 = 25;
        let steps = || (-N_STEPS..=N_STEPS).map(|step| f64::from(step) / f64::from(N_STEPS));
        let points = steps().flat_map(|y| steps().map(move |x| DVec2::new(x, y)));
        let points = points.filter(|p| p.length() <= 1.0).map(|p| center + p * self.reach);
        let directions: Vec<DVec3> = points.map(|p| self.camera.direction(p.x, p.y)).collect();
        self.oracle.faces(&directions)
    }

    /// Necessary for faces so thin that no point of a ring hits them.
    fn has_edge(&self, face: usize, center: DVec2) -> bool {
        /// Relative tolerance of depth, so that faces that share the edge do not occlude it.
        const BESIDE: f64 = 1e-6;
        let points = self.oracle.edge_points(face, self.camera.direction(center.x, center.y));
        points.into_iter().any(|point| {
            let pixel = self.camera.pixel(point.normalize());
            pixel.is_some_and(|pixel| pixel.distance(center) <= self.reach)
                && self.oracle.is_visible(point, BESIDE)
        })
    }
}

/// Compares a picture of a [`recolored`] scene with the oracle.
///
/// `reach`: the allowed displacement of a face, pixels.
pub fn compare(actual: &Picture, oracle: &Oracle, camera: &Pinhole, reach: f64) -> Agreement {
    let near = Neighbourhood { oracle, camera, picture: &oracle.picture(camera), reach };
    let mut agreement = Agreement::default();
    let mut different = Vec::new();
    for ((x, y, pixel), &expected) in actual.enumerate_pixels().zip(near.picture) {
        agreement.n_pixels += 1;
        agreement.n_empty += usize::from(expected.is_none());
        let shown = face_of(pixel.0);
        let center = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
        let coincide = |a, b| coincide(oracle, a, b, camera.direction(center.x, center.y));
        let is_same = match (shown, expected) {
            (Ok(Some(shown)), Some(expected)) => shown == expected || coincide(shown, expected),
            (shown, expected) => shown == Ok(expected),
        };
        agreement.n_same += usize::from(is_same);
        if !is_same {
            different.push(([x, y], center, shown, expected));
        }
    }
    // In chunks, to stop early if the whole picture is wrong.
    for some in different.chunks(1024) {
        let wrong = some
            .par_iter()
            .filter(|(_, center, shown, _)| !shown.is_ok_and(|face| near.shows(face, *center)));
        agreement.wrong.par_extend(wrong.map(|&(pixel, _, shown, expected)| Wrong {
            pixel,
            shown,
            expected,
        }));
        if agreement.wrong.len() > MOST_WRONG {
            break;
        }
    }
    agreement
}

/// Do two faces coincide in a direction? Crossing rods have faces in common planes.
fn coincide(oracle: &Oracle, a: usize, b: usize, direction: DVec3) -> bool {
    match (oracle.distance(a, direction), oracle.distance(b, direction)) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * a,
        _ => false,
    }
}

/// The oracle's picture, in the colours of the faces.
pub fn painted(oracle: &Oracle, camera: &Pinhole) -> Picture {
    let [width, height] = camera.size();
    let pixels = oracle.picture(camera).into_iter().flat_map(|face| {
        let [r, g, b] = face.map_or([0; 3], color_of);
        [r, g, b, 255]
    });
    Picture::from_raw(width, height, pixels.collect()).expect("there are as many pixels")
}
