//! How right the outlines in pictures are, and what it costs, as Markdown.
//!
//! Everything is measured on what `uglorentz` writes and `ugrainbow` draws, against the oracle of the tests, which
//! shares no code with them: from points of drawn edges, and from pixels, a ray into the past goes into the rest
//! frame by a matrix and meets the scene as it was written.

use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};

use glam::DVec3;
use ugparse::{Camera, Scene, Source};
use ugtests::agreement::{MOST_FACES, are_close, compare, painted, recolored};
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

    /// Cuts with a bound in radians: errors of the outlines, and the number of faces.
    fn measure(&self, beta: DVec3, bound: f64, oracle: &Oracle) -> Outcome<(Errors, usize)> {
        let mut scene = self.scene.clone();
        for row in 0..scene.faces.len() {
            scene.faces[row].name = Some(scene.names.add(&format!("f{row}")));
        }
        let config = self.config(beta, uglorentz::Pieces::UpTo(bound));
        let (seen, notes) = uglorentz::transform(&scene, &config)?;
        if notes.is_full {
            return Err(format!("{} at {beta}: too many pieces", self.name).into());
        }
        // Pieces have the name of their face.
        let origin = |face: &ugparse::Face| seen.names.get(face.name?).strip_prefix('f')?.parse().ok();
        let origins: Option<Vec<usize>> = seen.faces.iter().map(origin).collect();
        let origins = origins.ok_or("a piece has lost its name")?;
        Ok((outline::errors(&seen, &origins, self.eye(), oracle, &self.pinhole()), seen.faces.len()))
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
        "| scene | β | camera flies | outline off by, px | pixels that differ | of them further than 0.5 px, faces close | others | faces | uniform: pieces an edge | uniform: faces | ratio |"
    )?;
    writeln!(out, "| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")?;
    for view in views {
        for (speed, (flight, beta)) in
            SPEEDS.iter().flat_map(|&speed| view.motions(speed).map(|m| (speed, m)))
        {
            let oracle = view.oracle(beta);
            let (errors, n_faces) = view.measure(beta, uglorentz::DEFAULT_ERROR, &oracle)?;
            let (n_different, n_close, n_wrong) = pixels(view, beta, &oracle, &format!("{speed}-{flight}"))?;
            let n = uniform(view, &oracle, errors.pixels);
            let n_uniform = n.map(|n| n_pieces(&view.scene, n));
            let number = |n: Option<usize>| n.map_or("—".to_string(), |n| n.to_string());
            writeln!(
                out,
                "| {} | {speed} | {flight} | {:.3} | {n_different} | {n_close} | {n_wrong} | {n_faces} | {} | {} | {} |",
                view.name,
                errors.pixels,
                number(n),
                number(n_uniform),
                n_uniform.map_or("—".to_string(), |n| format!("{:.1}", n as f64 / n_faces as f64)),
            )?;
            out.flush()?;
            if errors.pixels >= MOST_PIXELS || n_wrong > 0 {
                failures.push(format!(
                    "{} at {speed} {flight}: {:.3} px, {n_wrong} far",
                    view.name, errors.pixels
                ));
            }
        }
    }
    writeln!(out)?;
    Ok(())
}

/// Pixels that show another face than the oracle sees; those of them without it within reach, where the two faces
/// are as close to each other as the bound of depth; and the rest.
fn pixels(view: &View, beta: DVec3, oracle: &Oracle, what: &str) -> Outcome<(usize, usize, usize)> {
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
    let n_close = agreement.wrong.iter().filter(|wrong| are_close(oracle, &camera, wrong, DEPTH)).count();
    let n_wrong = agreement.wrong.len() - n_close;
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
        (0..n).all(|k| outline::chord_error(outline, edge, [at(k), at(k + 1)], &camera).pixels <= error)
    };
    if error == 0.0 {
        return None;
    }
    let mut n = 1;
    for (outline, edge) in &edges {
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

/// Pieces of `-sd N`: N² of a triangle or quadrilateral, and of each triangle of other polygons.
fn n_pieces(scene: &Scene, n: usize) -> usize {
    let cells = |face: &ugparse::Face| {
        let n_corners = scene.contours.corners(face.contours.clone()).len();
        if face.contours.len() == 1 && n_corners <= 4 { 1 } else { n_corners + 2 * face.contours.len() - 4 }
    };
    scene.faces.iter().map(cells).sum::<usize>() * n * n
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
                let (found, n) = view.measure(beta, bound * 1e-3, &view.oracle(beta))?;
                errors = errors.and(found);
                n_faces += n;
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
