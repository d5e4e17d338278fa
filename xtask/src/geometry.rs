//! How right the outlines in pictures are, and what it costs, as Markdown.
//!
//! Everything is measured on what `uglorentz` writes and `ugrainbow` draws, against the oracle of the tests, which
//! shares no code with them: from points of drawn edges, and from pixels, a ray into the past goes into the rest
//! frame by a matrix and meets the scene as it was written.

use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Camera, Scene, Source};
use ugtests::agreement::{MOST_FACES, Wrong, are_close, compare, painted, recolored};
use ugtests::oracle::{Oracle, Outline, Pinhole};
use ugtests::outline::{self, Errors};
use ugtests::pipe::Pipe;
use ugtests::scenes;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Scenes, and whether they are put in place (`-in`), so that they stay in the picture.
const SCENES: [(&str, bool); 6] = [
    ("ship", true),
    ("street", false),
    ("lattice", false),
    ("cubes", true),
    ("sphere", true),
    ("teapot", true),
];

const SPEEDS: [f64; 4] = [0.3, 0.9, 0.99, 0.999];

/// Bounds of the second table, milliradians.
const BOUNDS: [f64; 7] = [10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01];

/// Speeds of the second table.
const BOUND_SPEEDS: [f64; 2] = [0.9, 0.99];

/// What outlines may be off by, pixels.
const MOST_PIXELS: f64 = 0.5;

/// Equal pieces an edge are tried up to this many.
const MOST_PIECES: usize = 1 << 16;

/// Faces whose distances differ by less than this part of them may hide each other: the bound of depth, once for
/// each face.
const DEPTH: f64 = 2e-4;

/// What to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Table {
    /// Pictures at the default bound.
    Pictures,
    /// Errors and faces at several bounds.
    Bounds,
}

/// Prints the tables.
pub fn write(
    out: &mut impl Write,
    size: [u32; 2],
    only: Option<&str>,
    table: Option<Table>,
    files: &[PathBuf],
) -> Outcome<()> {
    let mut views = views(size, files)?;
    views.retain(|view| only.is_none_or(|name| view.name.starts_with(name)));
    let mut failures = Vec::new();
    if table != Some(Table::Bounds) {
        pictures(out, size, &views, &mut failures)?;
    }
    if table != Some(Table::Pictures) {
        bounds(out, &views, &mut failures)?;
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n").into()) }
}

/// A scene seen by a camera.
struct View {
    name: String,
    scene: Scene,
    camera: Camera,
    in_place: bool,
    size: [u32; 2],
}

fn views(size: [u32; 2], files: &[PathBuf]) -> Outcome<Vec<View>> {
    let mut views = Vec::new();
    for (name, in_place) in SCENES {
        let scene = without_wires(scenes::parse(&scenes::text(name)));
        let camera = scene.camera().ok_or("the scene has a camera")?.clone();
        views.push(View { name: name.to_string(), scene, camera, in_place, size });
    }
    for file in files {
        let source = Source::new(file.display().to_string(), std::fs::read(file)?);
        let scene =
            ugparse::parse(&source, &ugparse::Options { lax: true, ..ugparse::Options::default() })?.scene;
        let scene = without_wires(scene);
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        for (place, camera, in_place) in cameras(&scene) {
            views.push(View {
                name: format!("{name}, {place}"),
                scene: scene.clone(),
                camera,
                in_place,
                size,
            });
        }
    }
    Ok(views)
}

/// The oracle sees faces only, and does not count wires when it puts bodies in place.
fn without_wires(scene: Scene) -> Scene {
    Scene { wires: Vec::new(), comments: Vec::new(), ..scene }
}

/// The camera of the scene if it says enough; else one in the middle of its box, at the height of a person's head
/// were it a storey, looking along it, and one outside.
fn cameras(scene: &Scene) -> Vec<(&'static str, Camera, bool)> {
    if let Some(camera) = scene.camera()
        && camera.eye.is_some()
        && camera.center.is_some()
        && camera.view_angle.is_some()
    {
        return vec![("its camera", camera.clone(), false)];
    }
    let places = scene.vertices.iter().map(|vertex| vertex.position);
    let (low, high) =
        places.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    let (middle, reach) = (low.midpoint(high), high - low);
    let along = if reach.x > reach.y { DVec3::X } else { DVec3::Y };
    // Not on a coordinate of the scene.
    let inside = middle + reach * DVec3::new(0.017, 0.013, 0.041);
    let camera = |eye, center, across: f64| Camera {
        eye: Some(eye),
        center: Some(center),
        up: Some(DVec3::Z),
        view_angle: Some([across, across * 0.75]),
        ..Camera::default()
    };
    let outside = middle + reach.length() * DVec3::new(0.5, -0.9, 0.6);
    vec![
        ("inside", camera(inside, inside + along, 90.0), false),
        ("outside", camera(outside, middle, 50.0), true),
    ]
}

impl View {
    fn eye(&self) -> DVec3 {
        self.camera.eye.unwrap_or(DVec3::ZERO)
    }

    /// The camera flies forward, backward, and to the left: velocities of the scene in its frame.
    fn motions(&self, speed: f64) -> [(&'static str, DVec3); 3] {
        let ahead = (self.camera.center.unwrap_or(DVec3::Y) - self.eye()).normalize();
        let right = ahead.cross(self.camera.up.unwrap_or(DVec3::Z)).normalize();
        [("forward", -ahead * speed), ("backward", ahead * speed), ("sideways", right * speed)]
    }

    fn pinhole(&self) -> Pinhole {
        Pinhole::new(&self.camera, self.eye(), self.size)
    }

    fn config(&self, beta: DVec3, pieces: uglorentz::Pieces) -> uglorentz::Config {
        uglorentz::Config {
            velocity: Some(beta),
            eye: Some(self.eye()),
            in_place: self.in_place,
            pieces,
            ..uglorentz::Config::default()
        }
    }

    fn oracle(&self, beta: DVec3) -> Oracle {
        Oracle::new(&self.scene, self.eye(), Some(beta), self.in_place)
    }

    /// The configuration for what the camera sees and how it is shaped: no more than outlines and depth need.
    fn config_of_shape(&self, beta: DVec3) -> uglorentz::Config {
        let mut config = self.config(beta, uglorentz::Pieces::UpTo(uglorentz::DEFAULT_ERROR));
        config.color_error = f64::INFINITY;
        config.cull = Some(self.size);
        config.camera.view_angle = self.camera.view_angle.map(|[across, _]| (across, None));
        config
    }

    /// Errors of the outlines of what a configuration writes, and of which face each piece is.
    fn measure(&self, config: &uglorentz::Config, oracle: &Oracle) -> Outcome<(Errors, Vec<usize>)> {
        let mut scene = Scene { cameras: vec![self.camera.clone()], ..self.scene.clone() };
        for row in 0..scene.faces.len() {
            scene.faces[row].name = Some(scene.names.add(&format!("f{row}")));
        }
        let (seen, notes) = uglorentz::transform(&scene, config)?;
        if notes.is_full {
            return Err(format!("{} at {:?}: too many pieces", self.name, config.velocity).into());
        }
        // Pieces have the name of their face.
        let origin = |face: &ugparse::Face| seen.names.get(face.name?).strip_prefix('f')?.parse().ok();
        let origins: Option<Vec<usize>> = seen.faces.iter().map(origin).collect();
        let origins = origins.ok_or("a piece has lost its name")?;
        Ok((outline::errors(&seen, &origins, self.eye(), oracle, &self.pinhole()), origins))
    }
}

fn pictures(
    out: &mut impl Write,
    [width, height]: [u32; 2],
    views: &[View],
    failures: &mut Vec<String>,
) -> Outcome<()> {
    writeln!(out, "### At the default bound, {width}×{height}, 1 sample\n")?;
    writeln!(
        out,
        "| scene | β | camera flies | outline off by, px | pixels that differ | of them further than 0.5 px, faces close | others | faces | `-cull -sc off`: off by, px | faces | uniform: pieces an edge | uniform: faces | ratio |"
    )?;
    writeln!(
        out,
        "| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
    )?;
    for view in views {
        for (speed, (flight, beta)) in
            SPEEDS.iter().flat_map(|&speed| view.motions(speed).map(|m| (speed, m)))
        {
            let oracle = view.oracle(beta);
            let config = view.config(beta, uglorentz::Pieces::UpTo(uglorentz::DEFAULT_ERROR));
            let (errors, pieces) = view.measure(&config, &oracle)?;
            let n_faces = pieces.len();
            let what = format!("{speed}-{flight}");
            let (n_different, n_close, n_wrong) = pixels(view, beta, &oracle, &what, failures)?;
            let (seen_errors, mut seen) = view.measure(&view.config_of_shape(beta), &oracle)?;
            let n_seen = seen.len();
            seen.dedup();
            let n = uniform(view, &oracle, seen_errors.pixels);
            let n_uniform = n.map(|n| n_pieces(&view.scene, &seen, n));
            let number = |n: Option<usize>| n.map_or("—".to_string(), |n| n.to_string());
            writeln!(
                out,
                "| {} | {speed} | {flight} | {:.3} | {n_different} | {n_close} | {n_wrong} | {n_faces} | {:.3} | {n_seen} | {} | {} | {} |",
                view.name,
                errors.pixels,
                seen_errors.pixels,
                number(n),
                number(n_uniform),
                n_uniform.map_or("—".to_string(), |n| format!("{:.1}", n as f64 / n_seen as f64)),
            )?;
            out.flush()?;
            let off = errors.and(seen_errors).pixels;
            if off >= MOST_PIXELS {
                failures.push(format!("{} at {what}: {off:.3} px", view.name));
            }
        }
    }
    writeln!(out)?;
    Ok(())
}

/// Pixels that show another face than the oracle sees; those of them without it within reach, where the two faces
/// are as close to each other as the bound of depth; and the rest.
fn pixels(
    view: &View,
    beta: DVec3,
    oracle: &Oracle,
    what: &str,
    failures: &mut Vec<String>,
) -> Outcome<(usize, usize, usize)> {
    if view.scene.faces.len() > MOST_FACES {
        return Err(format!("{}: there are colours for {MOST_FACES} faces only", view.name).into());
    }
    let mut scene = recolored(view.scene.clone());
    scene.cameras =
        vec![Camera { view_angle: view.camera.view_angle.map(|[a, _]| [a, a]), ..view.camera.clone() }];
    let mut pipe = Pipe::default().shape();
    pipe.lorentz = view.config(beta, uglorentz::Pieces::UpTo(uglorentz::DEFAULT_ERROR));
    pipe.doppler.repeat = true;
    pipe.rainbow.size = view.size;
    pipe.rainbow.samples = 1;
    pipe.rainbow.camera.view_angle = view.camera.view_angle.map(|[across, _]| (across, None));
    let picture = pipe.draw(&ugparse::write(&scene));
    let camera = view.pinhole();
    let agreement = compare(&picture, oracle, &camera, MOST_PIXELS);
    let is_close = |wrong: &Wrong| are_close(oracle, &camera, wrong, MOST_PIXELS, DEPTH);
    let (close, far): (Vec<&Wrong>, Vec<&Wrong>) = agreement.wrong.iter().partition(|wrong| is_close(wrong));
    let (n_close, n_wrong) = (close.len(), far.len());
    for Wrong { pixel, shown, expected, .. } in far {
        failures.push(format!("{} at {what}: {pixel:?} shows {shown:?} for {expected:?}", view.name));
    }
    if n_wrong > 0 {
        let folder = crate::bench::target_dir().join("geometry");
        std::fs::create_dir_all(&folder)?;
        picture.save(folder.join(format!("{}-{what}-pipe.png", view.name)))?;
        painted(oracle, &camera).save(folder.join(format!("{}-{what}-expected.png", view.name)))?;
    }
    Ok((agreement.n_pixels - agreement.n_same, n_close, n_wrong))
}

/// Equal pieces an edge that are as right as `error` pixels; `None` if there is no edge in the picture.
fn uniform(view: &View, oracle: &Oracle, error: f64) -> Option<usize> {
    let camera = view.pinhole();
    let outlines = (0..view.scene.faces.len()).filter_map(|face| oracle.outline(face));
    let edges: Vec<(Outline, usize)> =
        outlines.flat_map(|outline| (0..outline.n_edges()).map(move |edge| (outline, edge))).collect();
    let is_right = |outline: &Outline, edge: usize, n: usize| {
        let at = |k: usize| outline.point(edge, k as f64 / n as f64);
        (0..n).all(|k| outline::is_right(outline, edge, [at(k), at(k + 1)], &camera, error))
    };
    if error == 0.0 {
        return None;
    }
    let (mut n, mut rest) = (1, &edges[..]);
    while let Some(at) = rest.par_iter().position_first(|(outline, edge)| !is_right(outline, *edge, n)) {
        let (outline, edge) = &rest[at];
        rest = &rest[at + 1..];
        // Errors fall with the square of n: up by halves, then down.
        let mut low = n;
        while n < MOST_PIECES && !is_right(outline, *edge, n) {
            low = n;
            n = (n + n.div_ceil(2)).min(MOST_PIECES);
        }
        while low + 1 < n {
            let middle = low.midpoint(n);
            if is_right(outline, *edge, middle) { n = middle } else { low = middle }
        }
    }
    Some(n)
}

/// Pieces of `-sd N` of some faces: N² of a triangle or quadrilateral, and of each triangle of other polygons.
fn n_pieces(scene: &Scene, faces: &[usize], n: usize) -> usize {
    let cells = |face: &ugparse::Face| {
        let n_corners = scene.contours.corners(face.contours.clone()).len();
        if face.contours.len() == 1 && n_corners <= 4 { 1 } else { n_corners + 2 * face.contours.len() - 4 }
    };
    faces.iter().map(|&row| cells(&scene.faces[row])).sum::<usize>() * n * n
}

fn bounds(out: &mut impl Write, views: &[View], failures: &mut Vec<String>) -> Outcome<()> {
    let speeds = BOUND_SPEEDS.map(|speed| speed.to_string()).join(" and ");
    writeln!(out, "### Bound, error and faces, {speeds} c, three flights together\n")?;
    writeln!(out, "| scene | bound, mrad | greatest error, mrad | faces | growth |")?;
    writeln!(out, "| --- | ---: | ---: | ---: | ---: |")?;
    for view in views {
        let mut last: Option<(f64, usize)> = None;
        for bound in BOUNDS {
            let (mut errors, mut n_faces) = (Errors::default(), 0);
            for (_, beta) in BOUND_SPEEDS.iter().flat_map(|&speed| view.motions(speed)) {
                let config = view.config(beta, uglorentz::Pieces::UpTo(bound * 1e-3));
                let (found, pieces) = view.measure(&config, &view.oracle(beta))?;
                errors = errors.and(found);
                n_faces += pieces.len();
            }
            // The power of 1/bound by which the number of faces has grown.
            let growth =
                last.map(|(coarser, n)| libm::log(n_faces as f64 / n as f64) / libm::log(coarser / bound));
            let growth = growth.map_or(String::new(), |power| format!("{power:.2}"));
            let angle = errors.angle * 1e3;
            writeln!(out, "| {} | {bound} | {angle:.4} | {n_faces} | {growth} |", view.name)?;
            out.flush()?;
            if angle > bound {
                failures.push(format!("{} at {bound} mrad: {angle} mrad", view.name));
            }
            last = Some((bound, n_faces));
        }
    }
    Ok(())
}

/// Is this a scene file? For the command line.
pub fn is_file(path: &str) -> Result<PathBuf, String> {
    if Path::new(path).is_file() { Ok(path.into()) } else { Err("there is no such file".to_string()) }
}
