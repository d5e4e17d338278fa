//! How right the outlines in pictures are, and what it costs, as Markdown.
//!
//! Everything is measured on what `uglorentz` writes and `ugrainbow` draws, against the oracle of the tests, which
//! shares no code with them: from points of drawn edges, and from pixels, a ray into the past goes into the rest
//! frame by a matrix and meets the scene as it was written.

mod view;

use std::error::Error;
use std::io::Write;
use std::path::PathBuf;

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Camera, Scene};
use ugtests::agreement::{MOST_FACES, Wrong, are_close, compare, painted, recolored};
use ugtests::explanation::{are_edges_near, is_at_slit};
use ugtests::oracle::{Oracle, Outline};
use ugtests::outline::{self, Errors};
use ugtests::pipe::Pipe;

use view::{Flight, View, is_file, views};

type Outcome<T> = Result<T, Box<dyn Error>>;

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
#[derive(clap::Args)]
pub struct Args {
    /// Pixels across and down
    #[arg(long = "sz", num_args = 2, value_names = ["W", "H"], default_values_t = [1920, 1080])]
    size: Vec<u32>,
    /// Only scenes whose name begins so
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Only one of the tables
    #[arg(long, value_enum)]
    table: Option<Table>,
    /// Only these speeds, separated by commas
    #[arg(long, value_name = "BETA", value_delimiter = ',', value_parser = clap::value_parser!(f64))]
    speed: Vec<f64>,
    /// Only these flights, separated by commas
    #[arg(long, value_enum, value_name = "FLIGHT", value_delimiter = ',', default_values_t = Flight::ALL)]
    direction: Vec<Flight>,
    /// Scenes besides those of the repository
    #[arg(value_name = "FILE", value_parser = is_file)]
    files: Vec<PathBuf>,
}

impl Args {
    /// The speeds and flights of a table.
    fn motions(&self, speeds: &[f64]) -> Vec<(f64, Flight)> {
        let speeds = if self.speed.is_empty() { speeds } else { &self.speed };
        let of_speed = |&speed: &f64| self.direction.iter().map(move |&flight| (speed, flight));
        speeds.iter().flat_map(of_speed).collect()
    }
}

/// One of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Table {
    /// Pictures at the default bound.
    Pictures,
    /// Errors and faces at several bounds.
    Bounds,
}

/// Prints the tables.
pub fn write(out: &mut impl Write, args: &Args) -> Outcome<()> {
    let mut views = views([args.size[0], args.size[1]], &args.files)?;
    views.retain(|view| args.only.as_ref().is_none_or(|name| view.name.starts_with(name)));
    let mut failures = Vec::new();
    if args.table != Some(Table::Bounds) {
        pictures(out, &views, &args.motions(&SPEEDS), &mut failures)?;
    }
    if args.table != Some(Table::Pictures) {
        bounds(out, &views, &args.motions(&BOUND_SPEEDS), &mut failures)?;
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n").into()) }
}

fn pictures(
    out: &mut impl Write,
    views: &[View],
    motions: &[(f64, Flight)],
    failures: &mut Vec<String>,
) -> Outcome<()> {
    let Some([width, height]) = views.first().map(|view| view.size) else { return Ok(()) };
    writeln!(out, "### At the default bound, {width}×{height}, 1 sample\n")?;
    writeln!(
        out,
        "| scene | β | camera flies | outline off by, px | pixels that differ | of them further than 0.5 px, faces close | slits | others | faces | `-cull -sc off`: off by, px | faces | uniform: pieces an edge | uniform: faces | ratio |"
    )?;
    writeln!(
        out,
        "| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
    )?;
    for view in views {
        for &(speed, flight) in motions {
            let (beta, flight) = (view.beta(speed, flight), flight.name());
            let oracle = view.oracle(beta);
            let config = view.config(beta, uglorentz::Pieces::UpTo(uglorentz::DEFAULT_ERROR));
            let (errors, pieces) = view.measure(&config, &oracle)?;
            let n_faces = pieces.len();
            let what = format!("{speed}-{flight}");
            let Pixels { different, close, at_slits, others } = pixels(view, beta, &oracle, &what, failures)?;
            let (seen_errors, mut seen) = view.measure(&view.config_of_shape(beta), &oracle)?;
            let n_seen = seen.len();
            seen.dedup();
            let n = uniform(view, &oracle, seen_errors.pixels);
            let n_uniform = n.map(|n| n_pieces(&view.scene, &seen, n));
            let number = |n: Option<usize>| n.map_or("—".to_string(), |n| n.to_string());
            writeln!(
                out,
                "| {} | {speed} | {flight} | {:.3} | {different} | {close} | {at_slits} | {others} | {n_faces} | {:.3} | {n_seen} | {} | {} | {} |",
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

/// Pixels that show another face than the oracle sees, and those of them that are not near one it sees.
#[derive(Default)]
struct Pixels {
    different: usize,
    /// The two faces are as close to each other as the bound of depth.
    close: usize,
    /// An edge is part of a longer one of another face.
    at_slits: usize,
    /// Edges within their bound do not explain them.
    others: usize,
}

/// Counts pixels of the picture that the programs draw.
fn pixels(
    view: &View,
    beta: DVec3,
    oracle: &Oracle,
    what: &str,
    failures: &mut Vec<String>,
) -> Outcome<Pixels> {
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
    let mut counts = Pixels { different: agreement.n_pixels - agreement.n_same, ..Pixels::default() };
    for wrong in &agreement.wrong {
        let Wrong { pixel, shown, expected, .. } = wrong;
        if are_close(oracle, &camera, wrong, MOST_PIXELS, DEPTH) {
            counts.close += 1;
        } else if are_edges_near(oracle, &camera, wrong, MOST_PIXELS, DEPTH) {
            // As if it saw the oracle's face within reach.
        } else if is_at_slit(oracle, &camera, wrong, MOST_PIXELS) {
            counts.at_slits += 1;
        } else {
            counts.others += 1;
            failures.push(format!("{} at {what}: {pixel:?} shows {shown:?} for {expected:?}", view.name));
        }
    }
    if counts.others > 0 {
        let folder = crate::bench::target_dir().join("geometry");
        std::fs::create_dir_all(&folder)?;
        picture.save(folder.join(format!("{}-{what}-pipe.png", view.name)))?;
        painted(oracle, &camera).save(folder.join(format!("{}-{what}-expected.png", view.name)))?;
    }
    Ok(counts)
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

fn bounds(
    out: &mut impl Write,
    views: &[View],
    motions: &[(f64, Flight)],
    failures: &mut Vec<String>,
) -> Outcome<()> {
    let motions_told: Vec<String> =
        motions.iter().map(|(speed, flight)| format!("{speed} c {}", flight.name())).collect();
    writeln!(out, "### Bound, error and faces: {} together\n", motions_told.join(", "))?;
    writeln!(out, "| scene | bound, mrad | greatest error, mrad | faces | growth |")?;
    writeln!(out, "| --- | ---: | ---: | ---: | ---: |")?;
    for view in views {
        let mut last: Option<(f64, usize)> = None;
        for bound in BOUNDS {
            let (mut errors, mut n_faces) = (Errors::default(), 0);
            for &(speed, flight) in motions {
                let beta = view.beta(speed, flight);
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
