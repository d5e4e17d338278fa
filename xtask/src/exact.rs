//! Measures the running time of exact pictures (`ugrainbow -xc`) and of the pipe that subdivides
//! faces and interpolates, as Markdown.
//!
//! The pipe is measured with its default bounds, and with bounds so fine that its picture is as
//! correct. Runs alternate, so that other load on the machine affects both.

use std::error::Error;
use std::io::Write;
use std::time::{Duration, Instant};

use glam::DVec3;
use ugtests::picture::{Picture, decode};
use ugtests::pipe::{Pipe, doppler, lorentz, rainbow};
use ugtests::scenes;

use crate::bench::{self, CommandTimes};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Names of scenes, whether they are placed with `-in`, and velocities.
const SCENES: [(&str, bool, DVec3); 6] = [
    ("ship", true, DVec3::new(0.9, 0.0, 0.0)),
    ("cubes", true, DVec3::new(0.72, -0.54, 0.0)),
    ("street", false, DVec3::new(0.0, -0.9, 0.0)),
    ("lattice", false, DVec3::new(0.0, -0.9, 0.0)),
    ("sphere", true, DVec3::new(0.9, 0.0, 0.0)),
    ("teapot", true, DVec3::new(0.9, 0.0, 0.0)),
];

/// The bounds are divided by these numbers until the picture is correct.
const FINER: [u32; 5] = [1, 4, 16, 64, 256];

/// A picture is correct if this fraction of its non-black pixels are within a level of the exact
/// ones.
const CORRECT: f64 = 0.999;

/// If a picture took longer, finer bounds are not tried.
const LONGEST: Duration = Duration::from_secs(8);

/// Runs of each command; the fastest counts.
const RUNS: usize = 3;

/// Prints the table.
pub fn write(out: &mut impl Write, only: Option<&str>) -> Outcome<()> {
    bench::build(&["uglorentz", "ugdoppler", "ugrainbow"])?;
    writeln!(out, "{}\n", bench::machine())?;
    writeln!(
        out,
        "| scene | `-aa` | `-xc`, s | pipe, s | pipe / `-xc` | correct | bounds | finer pipe, s | finer pipe / `-xc` | correct |"
    )?;
    writeln!(out, "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")?;
    for (name, in_place, beta) in
        SCENES.into_iter().filter(|scene| only.is_none_or(|only| scene.0.starts_with(only)))
    {
        for samples in [1, 4] {
            let view = View { name, in_place, beta, samples };
            let text = scenes::text(name);
            let exact = view.exact(&text);
            let (finer, correct) = view.finer(&text, &exact);
            let [exact, default, fine] = view.time(finer)?;
            writeln!(
                out,
                "| {name} | {samples} | {exact} | {default} | {:.2} | {:.1} % | 1/{finer} | {fine} | {:.2} | {:.2} % |",
                default.user / exact.user,
                100.0 * correct[0],
                fine.user / exact.user,
                100.0 * correct[1],
            )?;
            out.flush()?;
        }
    }
    Ok(())
}

struct View {
    name: &'static str,
    in_place: bool,
    beta: DVec3,
    samples: u32,
}

impl View {
    fn pipe(&self) -> Pipe {
        let mut pipe = Pipe::default();
        pipe.lorentz.velocity = Some(self.beta);
        pipe.lorentz.in_place = self.in_place;
        pipe.rainbow.picture.samples = self.samples;
        pipe
    }

    fn exact(&self, text: &[u8]) -> Picture {
        let mut pipe = self.pipe();
        pipe.lorentz.pieces = uglorentz::Pieces::PerEdge(1);
        pipe.rainbow.exact = Some(ugrainbow::ColorShift::default());
        decode(&rainbow(&lorentz(text, &pipe.lorentz), &pipe.rainbow))
    }

    /// The first divisor of the bounds with which the picture is correct, and the fraction of
    /// correct pixels with default bounds and with these.
    fn finer(&self, text: &[u8], exact: &Picture) -> (u32, [f64; 2]) {
        let mut fractions = Vec::new();
        for finer in FINER {
            let mut pipe = self.pipe();
            pipe.lorentz.pieces = uglorentz::Pieces::UpTo(uglorentz::DEFAULT_ERROR / f64::from(finer));
            pipe.lorentz.color_error /= f64::from(finer);
            pipe.doppler.keep = true;
            let start = Instant::now();
            let seen = doppler(&lorentz(text, &pipe.lorentz), &pipe.doppler);
            fractions.push(fraction_correct(&decode(&rainbow(&seen, &pipe.rainbow)), exact));
            if fractions[fractions.len() - 1] >= CORRECT || start.elapsed() > LONGEST {
                break;
            }
        }
        let last = fractions.len() - 1;
        (FINER[last], [fractions[0], fractions[last]])
    }

    /// Times of the exact picture, and of the pipe with default bounds and with finer ones.
    fn time(&self, finer: u32) -> Outcome<[CommandTimes; 3]> {
        let DVec3 { x, y, z } = self.beta;
        let in_place = if self.in_place { " -in" } else { "" };
        let file = scenes::root().join("scenes").join(format!("{}.ug", self.name));
        let lorentz = format!("uglorentz -qt -vel {x} {y} {z}{in_place} {}", file.display());
        let rainbow = format!("ugrainbow -qt -aa {}", self.samples);
        let percent = 100.0 * uglorentz::Config::default().color_error / f64::from(finer);
        let milliradians = 1e3 * uglorentz::DEFAULT_ERROR / f64::from(finer);
        let commands = [
            format!("{lorentz} -sd 1 | {rainbow} -xc"),
            format!("{lorentz} | ugdoppler -qt | {rainbow}"),
            format!("{lorentz} -se {milliradians} -sc {percent} | ugdoppler -qt -hd | {rainbow}"),
        ];
        let mut best = [CommandTimes::MOST; 3];
        for _ in 0..RUNS {
            for (best, command) in best.iter_mut().zip(&commands) {
                *best = best.least(CommandTimes::of(command)?);
            }
        }
        Ok(best)
    }
}

/// The fraction of the pixels that are not black in both pictures whose channels differ by at most
/// a level.
fn fraction_correct(picture: &Picture, exact: &Picture) -> f64 {
    let pairs = picture.pixels().zip(exact.pixels()).map(|(a, b)| (a.0, b.0));
    let shown = pairs.filter(|pair| *pair != ([0, 0, 0, 255], [0, 0, 0, 255]));
    let (mut n_shown, mut n_correct) = (0.0, 0.0);
    for (a, b) in shown {
        n_shown += 1.0;
        n_correct += f64::from(u8::from(a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 1)));
    }
    n_correct / n_shown
}
