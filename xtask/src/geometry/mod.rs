//! Measures errors of drawn outlines and the number of faces they need, as tables in Markdown.
//!
//! The output of `uglorentz` and `ugrainbow` is compared with the oracle of the tests, which shares
//! no code with them: from points of drawn edges, and from pixels, it transforms a ray into the
//! past to the rest frame with a 4×4 matrix and intersects it with the scene as written.
//! `docs/geometry.md` explains the tables.

mod view;

use std::error::Error;
use std::io::Write;
use std::path::PathBuf;

use glam::DVec3;
use rayon::prelude::*;
use ugscene::{Camera, Scene};
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

/// The largest allowed outline error, pixels.
const MOST_PIXELS: f64 = 0.5;

/// The largest uniform subdivision tried, pieces per edge.
const MOST_PIECES: usize = 1 << 16;

/// Faces whose distances differ by less than this fraction may occlude each other wrongly: the
/// tolerance of depth, twice, because both faces have an error.
const DEPTH: f64 = 2e-4;

/// Selects what is measured.
#[derive(clap::Args)]
pub struct Args {
    /// Size of the pictures in pixels
    #[arg(long = "sz", num_args = 2, value_names = ["W", "H"], default_values_t = [1920, 1080])]
    size: Vec<u32>,
    /// Only scenes whose name begins with NAME
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
    /// Additional scenes
    #[arg(value_name = "FILE", value_parser = is_file)]
    files: Vec<PathBuf>,
}

impl Args {
    /// The combinations of speed and flight in a table.
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
        "| scene | β | camera motion | outline error, px | different pixels | close faces, pixels | slits, pixels | unexplained, pixels | faces | `-cull -sc off`: outline error, px | faces | uniform: pieces per edge | uniform: faces | ratio |"
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
            let Differences { different, close, at_slits, unexplained } =
                differences(view, beta, &oracle, &what, failures)?;
            let (visible_errors, mut visible) = view.measure(&view.config_of_shape(beta), &oracle)?;
            let n_visible = visible.len();
            visible.dedup();
            let n = uniform(view, &oracle, visible_errors.pixels);
            let n_uniform = n.map(|n| n_pieces(&view.scene, &visible, n));
            let number = |n: Option<usize>| n.map_or("—".to_string(), |n| n.to_string());
            writeln!(
                out,
                "| {} | {speed} | {flight} | {:.3} | {different} | {close} | {at_slits} | {unexplained} | {n_faces} | {:.3} | {n_visible} | {} | {} | {} |",
                view.name,
                errors.pixels,
                visible_errors.pixels,
                number(n),
                number(n_uniform),
                n_uniform.map_or("—".to_string(), |n| format!("{:.1}", n as f64 / n_visible as f64)),
            )?;
            out.flush()?;
            let error = errors.and(visible_errors).pixels;
            if error >= MOST_PIXELS {
                failures.push(format!("{} at {what}: outline error {error:.3} px", view.name));
            }
        }
    }
    writeln!(out)?;
    Ok(())
}

/// Numbers of pixels that show another face than the oracle sees, by cause.
#[derive(Default)]
struct Differences {
    /// All of them.
    different: usize,
    /// The two faces are as close to each other as the tolerance of depth.
    close: usize,
    /// An edge lies along a longer one of another face.
    at_slits: usize,
    /// Not explained by edges within their bound.
    unexplained: usize,
}

/// Compares the picture drawn by the programs with the oracle.
fn differences(
    view: &View,
    beta: DVec3,
    oracle: &Oracle,
    what: &str,
    failures: &mut Vec<String>,
) -> Outcome<Differences> {
    if view.scene.faces.len() > MOST_FACES {
        return Err(
            format!("{}: more than {MOST_FACES} faces cannot be told apart by colour", view.name).into()
        );
    }
    let mut scene = recolored(view.scene.clone());
    scene.cameras =
        vec![Camera { view_angle: view.camera.view_angle.map(|[a, _]| [a, a]), ..view.camera.clone() }];
    let mut pipe = Pipe::default().shape();
    pipe.lorentz = view.config(beta, uglorentz::Pieces::UpTo(uglorentz::DEFAULT_ERROR));
    pipe.doppler.repeat = true;
    pipe.rainbow.picture.size = view.size;
    pipe.rainbow.picture.samples = 1;
    pipe.rainbow.picture.camera.view_angle = view.camera.view_angle.map(|[across, _]| (across, None));
    let picture = pipe.draw(&ugparse::write(&scene));
    let camera = view.pinhole();
    let agreement = compare(&picture, oracle, &camera, MOST_PIXELS);
    let different = agreement.n_pixels - agreement.n_same;
    let mut counts = Differences { different, ..Differences::default() };
    for wrong in &agreement.wrong {
        let Wrong { pixel, shown, expected, .. } = wrong;
        if are_close(oracle, &camera, wrong, MOST_PIXELS, DEPTH) {
            counts.close += 1;
        } else if are_edges_near(oracle, &camera, wrong, MOST_PIXELS, DEPTH) {
            // The expected face is within reach: an edge is displaced within its bound.
        } else if is_at_slit(oracle, &camera, wrong, MOST_PIXELS) {
            counts.at_slits += 1;
        } else {
            counts.unexplained += 1;
            failures
                .push(format!("{} at {what}: {pixel:?} shows {shown:?} instead of {expected:?}", view.name));
        }
    }
    if counts.unexplained > 0 {
        let folder = ugtests::scenes::target_dir().join("geometry");
        std::fs::create_dir_all(&folder)?;
        picture.save(folder.join(format!("{}-{what}-pipe.png", view.name)))?;
        painted(oracle, &camera).save(folder.join(format!("{}-{what}-expected.png", view.name)))?;
    }
    Ok(counts)
}

/// The least number of equal pieces per edge with an outline error of at most `error` pixels.
///
/// `None` if no edge is in the picture.
fn uniform(view: &View, oracle: &Oracle, error: f64) -> Option<usize> {
    let camera = view.pinhole();
    let outlines = (0..view.scene.faces.len()).filter_map(|face| oracle.outline(face));
    let edges: Vec<(Outline, usize)> =
        outlines.flat_map(|outline| (0..outline.n_edges()).map(move |edge| (outline, edge))).collect();
    let is_right = |outline: &Outline, edge: usize, n: usize| {
        let at = |k: usize| outline.point(edge, k as f64 / n as f64);
        (0..n).all(|k| outline::is_within(outline, edge, [at(k), at(k + 1)], &camera, error))
    };
    if error == 0.0 {
        return None;
    }
    let (mut n, mut rest) = (1, &edges[..]);
    while let Some(at) = rest.par_iter().position_first(|(outline, edge)| !is_right(outline, *edge, n)) {
        let (outline, edge) = &rest[at];
        rest = &rest[at + 1..];
        // Increase n by half until the edge is within the error, then bisect.
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

/// Pieces of `-sd N` of some faces: N² of a triangle or quadrilateral, and of each triangle of
/// other polygons.
fn n_pieces(scene: &Scene, faces: &[usize], n: usize) -> usize {
    let cells = |face: &ugscene::Face| {
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
    let motion_names: Vec<String> =
        motions.iter().map(|(speed, flight)| format!("{speed} c {}", flight.name())).collect();
    writeln!(out, "### Bound, error and faces: {} together\n", motion_names.join(", "))?;
    writeln!(out, "| scene | bound, mrad | largest error, mrad | faces | growth |")?;
    writeln!(out, "| --- | ---: | ---: | ---: | ---: |")?;
    for view in views {
        let mut last: Option<(f64, usize)> = None;
        for bound in BOUNDS {
            let (mut errors, mut n_faces) = (Errors::default(), 0);
            for &(speed, flight) in motions {
                let beta = view.beta(speed, flight);
                let config = view.config(beta, uglorentz::Pieces::UpTo(bound * 1e-3));
                let (of_motion, pieces) = view.measure(&config, &view.oracle(beta))?;
                errors = errors.and(of_motion);
                n_faces += pieces.len();
            }
            // The exponent with which the number of faces grows with 1/bound.
            let growth =
                last.map(|(coarser, n)| libm::log(n_faces as f64 / n as f64) / libm::log(coarser / bound));
            let growth = growth.map_or(String::new(), |power| format!("{power:.2}"));
            let angle = errors.angle * 1e3;
            writeln!(out, "| {} | {bound} | {angle:.4} | {n_faces} | {growth} |", view.name)?;
            out.flush()?;
            if angle > bound {
                failures.push(format!("{} at a bound of {bound} mrad: error {angle} mrad", view.name));
            }
            last = Some((bound, n_faces));
        }
    }
    Ok(())
}
