//! How far a picture drawn by the programs agrees with the oracle.
//!
//! Every face gets a colour of its own, light comes from everywhere and colours stay as they are, so each
//! pixel names the face it shows.

use std::fmt::{self, Display, Formatter};

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use ugparse::{Color, ColorId, ColorValue, Face, Light, LightKind, LightMotion, Scene};

use crate::oracle::{Oracle, Pinhole};
use crate::picture::Picture;

/// Least part of the pixels that show the very face.
const LEAST_AGREEMENT: f64 = 0.995;

/// Pixels that show a wrong face before the search for more is given up.
const MOST_WRONG: usize = 2000;

/// Levels between colours of faces. They are exact to one level.
const STEP: usize = 4;
/// Darkest level of a colour, well above the black background.
const DARKEST: usize = 28;
/// Colours of one plane: two channels, the third is 0.
const SIDE: usize = 57;

/// Faces that have a colour of their own.
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

/// What a pixel shows: a face, or nothing. `Err` for a colour that no face has.
pub type Shown = Result<Option<usize>, [u8; 4]>;

/// What a pixel of a [`recolored`] scene shows.
pub fn face_of(pixel: [u8; 4]) -> Shown {
    let step = |level: u8| {
        let above = usize::from(level).checked_sub(DARKEST - 1)?;
        (above % STEP <= 2).then_some(above / STEP).filter(|&step| step < SIDE)
    };
    match pixel {
        [0, 0, 0, 255] => Ok(None),
        [r, g, 0, 255] => step(r).zip(step(g)).map(|(a, b)| Some(a + SIDE * b)).ok_or(pixel),
        [0, g, b, 255] => step(g).zip(step(b)).map(|(a, b)| Some(SIDE * SIDE + a + SIDE * b)).ok_or(pixel),
        _ => Err(pixel),
    }
}

/// The scene with a colour for each face, lit from everywhere.
pub fn recolored(mut scene: Scene) -> Scene {
    scene.colors.clear();
    scene.wires.clear();
    scene.comments.clear();
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
        *face = Face { color: Some(ColorId::from_index(row)), illum: None, ..face.clone() };
    }
    scene
}

/// How far the pipe and the oracle agree.
#[derive(Debug, Default)]
pub struct Agreement {
    /// Pixels of the picture.
    pub n_pixels: usize,
    /// Pixels where both show the same face, or two that coincide there.
    pub n_same: usize,
    /// Pixels where both see nothing.
    pub n_empty: usize,
    /// Pixels with a face that is not seen within reach.
    pub wrong: Vec<Wrong>,
}

impl Agreement {
    /// The part of the pixels that show the very face.
    pub fn part(&self) -> f64 {
        self.n_same as f64 / self.n_pixels as f64
    }

    /// Wrong pixels that are not at a boundary.
    pub fn n_far(&self) -> usize {
        self.wrong.iter().filter(|wrong| !wrong.is_at_boundary).count()
    }

    /// Do all pixels show what is seen within reach, nearly all the very face, and some anything?
    pub fn is_good(&self) -> bool {
        let shows_something = self.n_empty < self.n_pixels * 98 / 100;
        self.part() >= LEAST_AGREEMENT && self.n_far() == 0 && self.wrong.is_empty() && shows_something
    }
}

impl Display for Agreement {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{:.3} % agree, {} differ", 100.0 * self.part(), self.n_pixels - self.n_same)?;
        write!(f, ", {:.0} % empty", 100.0 * self.n_empty as f64 / self.n_pixels as f64)?;
        write!(f, ", {} seen through seams", self.wrong.len() - self.n_far())?;
        write!(f, ", {} far off", self.n_far())?;
        for Wrong { pixel, shown, expected, .. } in self.wrong.iter().take(8) {
            write!(f, ", {pixel:?} shows {shown:?} for {expected:?}")?;
        }
        Ok(())
    }
}

/// A pixel that shows what it should not.
#[derive(Debug)]
pub struct Wrong {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Within reach something else than expected is seen, too.
    pub is_at_boundary: bool,
    /// What the picture shows.
    pub shown: Shown,
    /// What the oracle sees.
    pub expected: Option<usize>,
}

/// Between the middles of pixels that touch at a corner, just.
const DIAGONAL: f64 = 1.415;

/// What is seen near a pixel.
struct Neighbourhood<'a> {
    oracle: &'a Oracle,
    camera: &'a Pinhole,
    /// What the oracle sees in the middle of each pixel.
    picture: &'a [Option<usize>],
    /// Pixels; a face may be seen this far from where it should be.
    reach: f64,
}

impl Neighbourhood<'_> {
    /// Is the face, or nothing, seen within reach of the middle of a pixel?
    fn shows(&self, face: Option<usize>, center: DVec2) -> bool {
        (self.reach >= DIAGONAL && self.neighbours(center).any(|neighbour| neighbour == face))
            || self.rings(center).contains(&face)
            || face.is_some_and(|face| self.has_edge(face, center))
            || self.grid(center).contains(&face)
    }

    /// What the eight pixels round it show.
    fn neighbours(&self, center: DVec2) -> impl Iterator<Item = Option<usize>> {
        let [width, height] = self.camera.size().map(|side| side as usize);
        let (x, y) = (center.x as usize, center.y as usize);
        let rows = y.saturating_sub(1)..height.min(y + 2);
        let columns = move || x.saturating_sub(1)..width.min(x + 2);
        rows.flat_map(move |y| columns().map(move |x| self.picture[y * width + x]))
    }

    /// What is seen at 48 points on each of five rings.
    fn rings(&self, center: DVec2) -> Vec<Option<usize>> {
        let radii = (1..=5).map(|ring| self.reach * f64::from(ring) / 5.0);
        let angles = || (0..48).map(|step| f64::from(step) / 48.0 * std::f64::consts::TAU);
        let points = radii.flat_map(|radius| {
            angles().map(move |angle| {
                let (sin, cos) = libm::sincos(angle);
                center + radius * DVec2::new(cos, sin)
            })
        });
        let directions: Vec<DVec3> = points.map(|p| self.camera.direction(p.x, p.y)).collect();
        self.oracle.faces(&directions)
    }

    /// What is seen at points a fiftieth of the reach apart: slow, for slits and for corners.
    fn grid(&self, center: DVec2) -> Vec<Option<usize>> {
        const N_STEPS: i32 = 50;
        let steps = || (-N_STEPS..=N_STEPS).map(|step| f64::from(step) / f64::from(N_STEPS));
        let points = steps().flat_map(|y| steps().map(move |x| DVec2::new(x, y)));
        let points = points.filter(|p| p.length() <= 1.0).map(|p| center + p * self.reach);
        let directions: Vec<DVec3> = points.map(|p| self.camera.direction(p.x, p.y)).collect();
        self.oracle.faces(&directions)
    }

    /// For faces so thin that no point of a ring hits them.
    fn has_edge(&self, face: usize, center: DVec2) -> bool {
        /// Faces that share the edge do not hide it.
        const BESIDE: f64 = 1e-6;
        has_edge(self.oracle, self.camera, face, center, self.reach, BESIDE)
    }
}

/// Is an edge of the face within `reach` pixels, hidden by nothing that is nearer by more than `beside`?
fn has_edge(oracle: &Oracle, camera: &Pinhole, face: usize, center: DVec2, reach: f64, beside: f64) -> bool {
    let edges = oracle.edges_near(face, camera.direction(center.x, center.y), beside);
    let mut pixels = edges.into_iter().filter_map(|direction| camera.pixel(direction));
    pixels.any(|pixel| pixel.distance(center) <= reach)
}

/// Compares a picture of a [`recolored`] scene with what the oracle sees.
///
/// `reach`: pixels; a face may be seen this far from where it should be.
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
    // A few at a time, since it is no use to look at all of a picture that is all wrong.
    for some in different.chunks(1024) {
        let wrong = some
            .par_iter()
            .filter(|(_, center, shown, _)| !shown.is_ok_and(|face| near.shows(face, *center)));
        agreement.wrong.par_extend(wrong.map(|&(pixel, center, shown, expected)| {
            let is_at_boundary = near.rings(center).iter().any(|&face| face != expected);
            Wrong { pixel, is_at_boundary, shown, expected }
        }));
        if agreement.wrong.len() > MOST_WRONG {
            break;
        }
    }
    agreement
}

/// Would the pixel be right if what hides the face it shows, by less than `part` of the distance, did not? The
/// face may lie beside the pixel's middle, by `reach` pixels.
pub fn are_close(oracle: &Oracle, camera: &Pinhole, wrong: &Wrong, reach: f64, part: f64) -> bool {
    let center = DVec2::from_array(wrong.pixel.map(f64::from)) + 0.5;
    let direction = camera.direction(center.x, center.y);
    let Ok(Some(shown)) = wrong.shown else { return false };
    let distance = |face: Option<usize>| oracle.distance(face?, direction);
    let is_hit = match (distance(Some(shown)), distance(wrong.expected)) {
        (Some(a), Some(b)) => (a - b).abs() <= part * a.min(b),
        _ => false,
    };
    is_hit || has_edge(oracle, camera, shown, center, reach, part)
}

/// Two faces in one place: rods that cross have faces in common planes.
fn coincide(oracle: &Oracle, a: usize, b: usize, direction: DVec3) -> bool {
    match (oracle.distance(a, direction), oracle.distance(b, direction)) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * a,
        _ => false,
    }
}

/// The picture the oracle sees, in the colours of the faces.
pub fn painted(oracle: &Oracle, camera: &Pinhole) -> Picture {
    let [width, height] = camera.size();
    let pixels = oracle.picture(camera).into_iter().flat_map(|face| {
        let [r, g, b] = face.map_or([0; 3], color_of);
        [r, g, b, 255]
    });
    Picture::from_raw(width, height, pixels.collect()).expect("there are as many pixels")
}
