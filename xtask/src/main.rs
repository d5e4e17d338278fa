//! Chores of the project: write the scenes that are made by rule rather than by
//! hand, time the programs.
//!
//! ```text
//! cargo xtask teapot > scenes/teapot.ug
//! cargo xtask mesh 1000000 > /tmp/mesh.ug
//! cargo xtask bench
//! cargo xtask bench-reading
//! cargo xtask bench-raster
//! cargo xtask bench-scale plot.svg
//! cargo xtask bench-exact
//! cargo xtask geometry > tables.md
//! ```
//!
//! Scenes go to standard output and are the same bytes on every run and platform.

mod bench;
mod exact;
mod geometry;
mod globe;
mod mesh;
mod plot;
mod raster;
mod reading;
mod scale;
mod short;
mod sphere;
mod teapot;

use clap::{Parser, Subcommand};
use std::io::{self, BufWriter, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Chores of the project.
#[derive(Parser)]
#[command(bin_name = "cargo xtask")]
struct Args {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Write the Utah teapot
    Teapot {
        /// Squares along each side of each of the 32 patches, two triangles a square
        #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=256))]
        squares: u32,
    },
    /// Write a sphere of radius 1
    Sphere {
        /// Bands from pole to pole; there are twice as many around
        #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u32).range(2..=2048))]
        bands: u32,
        /// Northern half red, southern half green, with common vertices on the equator
        #[arg(long)]
        halves: bool,
    },
    /// Write a bumpy sphere of about N triangles with vertex colours, for benchmarks
    Mesh {
        /// Triangles, roughly
        #[arg(value_name = "N", value_parser = clap::value_parser!(u32).range(36..=100_000_000))]
        triangles: u32,
        /// Give every vertex a colour of its own, in place of a palette
        #[arg(long)]
        each: bool,
    },
    /// Time the programs beside `cat` on meshes of these sizes, as Markdown
    Bench {
        /// Triangles, roughly
        #[arg(default_values_t = [100_000, 1_000_000])]
        triangles: Vec<u32>,
    },
    /// Time reading and writing beside `tobj` on the equal mesh as OBJ, as Markdown
    BenchReading {
        /// Triangles, roughly
        #[arg(default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(36..=100_000_000))]
        triangles: u32,
    },
    /// Time drawing beside Mesa llvmpipe, and the whole program beside POV-Ray's reading, as Markdown
    ///
    /// See the head of xtask/llvmpipe.py for what must be installed.
    BenchRaster {
        /// Triangles, roughly
        #[arg(default_values_t = [100_000, 1_000_000], value_parser = clap::value_parser!(u32).range(36..=10_000_000))]
        triangles: Vec<u32>,
        /// Python with numpy and moderngl
        #[arg(long, default_value = "python3")]
        python: String,
        /// POV-Ray
        #[arg(long, default_value = "povray")]
        povray: String,
        /// Threads of each side
        #[arg(long, default_value_t = 2)]
        threads: usize,
    },
    /// Measure time and memory of drawing over faces, pixels and samples, as Markdown and as a plot
    BenchScale {
        /// SVG file to write
        plot: PathBuf,
    },
    /// Time exact pictures beside the pipe that cuts faces, with default bounds and as right, as Markdown
    BenchExact {
        /// Only scenes whose name begins so
        #[arg(long, value_name = "NAME")]
        only: Option<String>,
    },
    /// Measure outlines in pictures against the oracle, and the faces it takes, as Markdown
    Geometry(geometry::Args),
    /// Draw a scene and tell the seconds and the peak memory in megabytes
    #[command(hide = true)]
    DrawOnce {
        /// Scene to draw
        scene: PathBuf,
        /// Pixels across
        width: u32,
        /// Pixels down
        height: u32,
        /// Samples along a side of a pixel
        samples: u32,
    },
    /// Read a scene and tell the peak memory in bytes
    #[command(hide = true)]
    ReadOnce {
        /// Scene to read
        scene: PathBuf,
        /// Threads to read on
        threads: usize,
    },
}

fn main() -> ExitCode {
    match run(&Args::parse().chore) {
        Ok(()) => ExitCode::SUCCESS,
        // The reader has seen enough (`| head`): not an error.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            // Nothing is left to tell if standard error is closed, too.
            let _ = writeln!(io::stderr(), "xtask: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(chore: &Chore) -> io::Result<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    match chore {
        Chore::Teapot { squares } => teapot::write(&mut out, *squares)?,
        Chore::Sphere { bands, halves: false } => sphere::write(&mut out, *bands)?,
        Chore::Sphere { bands, halves: true } => sphere::write_halves(&mut out, *bands)?,
        Chore::Mesh { triangles, each } => mesh::write(&mut out, *triangles, *each)?,
        Chore::Bench { triangles } => {
            bench::write(&mut out, triangles).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Chore::BenchReading { triangles } => {
            reading::write(&mut out, *triangles).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Chore::BenchRaster { triangles, python, povray, threads } => {
            let tools = raster::Tools { python, povray, threads: *threads };
            raster::write(&mut out, triangles, &tools)
                .map_err(|error| io::Error::other(error.to_string()))?;
        }
        Chore::BenchScale { plot } => {
            scale::write(&mut out, plot).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Chore::DrawOnce { scene, width, height, samples } => {
            scale::draw_once(&mut out, scene, [*width, *height], *samples)
                .map_err(|error| io::Error::other(error.to_string()))?;
        }
        Chore::BenchExact { only } => {
            exact::write(&mut out, only.as_deref()).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Chore::Geometry(args) => {
            geometry::write(&mut out, args).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Chore::ReadOnce { scene, threads } => {
            reading::read_once(&mut out, scene, *threads)
                .map_err(|error| io::Error::other(error.to_string()))?;
        }
    }
    out.flush()
}
