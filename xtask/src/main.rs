//! Maintenance tasks: generate scenes, run benchmarks, measure accuracy.
//!
//! ```text
//! cargo xtask teapot > scenes/teapot.ug
//! cargo xtask mesh 1000000 > /tmp/mesh.ug
//! cargo xtask bench
//! cargo xtask bench-reading
//! cargo xtask bench-raster
//! cargo xtask bench-rays
//! cargo xtask bench-photon plot.svg
//! cargo xtask bench-warp
//! cargo xtask bench-film
//! cargo xtask bench-scale plot.svg
//! cargo xtask bench-exact
//! cargo xtask instructions
//! cargo xtask geometry > tables.md
//! cargo xtask gallery
//! cargo xtask plots figures
//! cargo xtask directions > scenes/directions.ug
//! cargo xtask hostile 50000
//! cargo xtask worlds --from 1000000 --count 10000
//! cargo xtask cluster
//! cargo xtask install --prefix ~/.local
//! cargo xtask uninstall --prefix ~/.local
//! ```
//!
//! Scenes go to standard output and are the same bytes on every run and platform.

mod bench;
mod cluster;
mod directions;
mod exact;
mod film;
mod gallery;
mod geometry;
mod globe;
mod hostile;
mod install;
mod instructions;
mod mesh;
mod photon;
mod plot;
mod plots;
mod raster;
mod rays;
mod reading;
mod scale;
mod short;
mod sphere;
mod teapot;
mod warp;
mod world_lines;
mod worlds;

use clap::{Parser, Subcommand};
use std::io::{self, BufWriter, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Generates scenes, runs benchmarks and measures accuracy
#[derive(Parser)]
#[command(bin_name = "cargo xtask")]
struct Args {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Write the Utah teapot
    Teapot {
        /// Squares along each side of each of the 32 patches; a square has two triangles
        #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=256))]
        squares: u32,
    },
    /// Write a sphere of radius 1
    Sphere {
        /// Bands from pole to pole; there are twice as many sectors
        #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u32).range(2..=2048))]
        bands: u32,
        /// Make the northern half red and the southern half green, with shared vertices on the
        /// equator
        #[arg(long)]
        halves: bool,
    },
    /// Write a textured sphere, and beside it the same as an observer in motion towards its pole
    /// sees it from its middle
    Directions {
        /// Speed of the observer
        #[arg(long, value_name = "BETA", default_value_t = 0.9)]
        beta: f64,
    },
    /// Write a bumpy sphere of about N triangles with vertex colours, for benchmarks
    Mesh {
        /// Triangles, roughly
        #[arg(value_name = "N", value_parser = clap::value_parser!(u32).range(36..=100_000_000))]
        triangles: u32,
        /// Give every vertex its own colour instead of one from a palette
        #[arg(long)]
        each: bool,
    },
    /// Measure the time of every program, relative to `cat`, on meshes of these sizes, as Markdown
    Bench {
        /// Triangles, roughly
        #[arg(default_values_t = [100_000, 1_000_000])]
        triangles: Vec<u32>,
    },
    /// Measure the time of reading and writing, relative to `tobj` on the same mesh as OBJ, as
    /// Markdown
    BenchReading {
        /// Triangles, roughly
        #[arg(default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(36..=100_000_000))]
        triangles: u32,
    },
    /// Measure the time of drawing, relative to Mesa llvmpipe, and of the whole program, relative
    /// to reading by POV-Ray, as Markdown
    ///
    /// The head of xtask/llvmpipe.py lists what must be installed.
    BenchRaster {
        /// Triangles, roughly
        #[arg(default_values_t = [100_000, 1_000_000], value_parser = clap::value_parser!(u32).range(36..=10_000_000))]
        triangles: Vec<u32>,
        /// Python interpreter with numpy and moderngl
        #[arg(long, default_value = "python3")]
        python: String,
        /// POV-Ray executable
        #[arg(long, default_value = "povray")]
        povray: String,
        /// Threads for each program
        #[arg(long, default_value_t = 2)]
        threads: usize,
    },
    /// Measure the time of rays against triangles and of building their hierarchy, relative to
    /// Embree 3, as Markdown
    ///
    /// The head of xtask/embree.cpp lists what must be installed.
    BenchRays {
        /// Triangles, roughly
        #[arg(default_values_t = [100_000, 1_000_000], value_parser = clap::value_parser!(u32).range(36..=10_000_000))]
        triangles: Vec<u32>,
        /// C++ compiler
        #[arg(long, default_value = "g++")]
        compiler: String,
        /// Threads for each program
        #[arg(long, default_value_t = 2)]
        threads: usize,
    },
    /// Measure `ugphoton`: motion relative to rest, whole pictures relative to POV-Ray, and time
    /// and memory as functions of faces and bodies, as Markdown and as a plot
    ///
    /// Requires POV-Ray, the Debian package povray.
    BenchPhoton {
        /// SVG file to write
        plot: PathBuf,
        /// POV-Ray executable
        #[arg(long, default_value = "povray")]
        povray: String,
        /// Triangles of the greatest mesh
        #[arg(long, value_name = "N", default_value_t = 10_000_000)]
        most: u32,
    },
    /// Measure `ugwarp` relative to the filter `v360` of ffmpeg, for the same view of the same
    /// panorama of 8192 x 4096 pixels, as Markdown
    BenchWarp {
        /// ffmpeg executable
        #[arg(long, default_value = "ffmpeg")]
        ffmpeg: String,
    },
    /// Measure `ugfilm` relative to the pipes that it prints, its memory, and the share of time in
    /// each stage, as Markdown
    BenchFilm {
        /// Frames of the film
        #[arg(default_value_t = 200, value_parser = clap::value_parser!(u32).range(2..=9999))]
        frames: u32,
    },
    /// Measure time and memory of drawing as functions of faces, pixels and samples, as Markdown
    /// and as a plot
    BenchScale {
        /// SVG file to write
        plot: PathBuf,
    },
    /// Measure the time of exact pictures and of the subdividing pipe, with default bounds and at
    /// equal accuracy, as Markdown
    BenchExact {
        /// Only scenes whose name begins with NAME
        #[arg(long, value_name = "NAME")]
        only: Option<String>,
    },
    /// Measure the pipe and rays on bodies that accelerate and spin, relative to inertial motion, as
    /// Markdown
    BenchWorldLines {
        /// Triangles, roughly
        #[arg(default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(36..=10_000_000))]
        triangles: u32,
    },
    /// Count the instructions that the programs execute on fixed work, and compare with
    /// xtask/instructions.csv, as Markdown
    ///
    /// Requires valgrind, the Debian package valgrind.
    Instructions(instructions::Args),
    /// Measure errors of outlines in pictures against the oracle, and the number of faces, as
    /// Markdown
    Geometry(geometry::Args),
    /// Draw the plots of the papers, as SVG and PNG
    Plots {
        /// Folder of the files
        folder: PathBuf,
    },
    /// Draw the pictures of the documentation with the commands in its pages
    Gallery(gallery::Args),
    /// Run the programs on malformed and extreme inputs, and check what must hold of any
    Hostile(hostile::Args),
    /// Check the laws of light in random worlds
    Worlds(worlds::Args),
    /// Run the workflows of batch/ on a Slurm of this machine, and compare with one process
    ///
    /// Installs the Debian packages slurm-wlm, munge, parallel and python3-venv if they are
    /// missing, and Snakemake in the cache folder of the user.
    Cluster,
    /// Install the programs, their man pages and documentation, and completions for bash, zsh and
    /// fish
    Install(install::Args),
    /// Remove what `install` has written, and nothing else
    Uninstall(install::UninstallArgs),
    /// Draw a scene and print the time in seconds and the peak memory in megabytes
    #[command(hide = true)]
    DrawOnce {
        /// Scene to draw
        scene: PathBuf,
        /// Width in pixels
        width: u32,
        /// Height in pixels
        height: u32,
        /// Samples along a side of a pixel
        samples: u32,
    },
    /// Trace a scene and print the time, the processor time of tracing and the peak memory
    #[command(hide = true)]
    TraceOnce {
        /// Scene to draw
        scene: PathBuf,
    },
    /// Read a scene and print the peak memory in bytes
    #[command(hide = true)]
    ReadOnce {
        /// Scene to read
        scene: PathBuf,
        /// Threads used for reading
        threads: usize,
    },
}

fn main() -> ExitCode {
    match run(&Args::parse().task) {
        Ok(()) => ExitCode::SUCCESS,
        // The other end of the pipe was closed (`| head`): not an error.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            // If standard error is closed, too, nothing can be reported.
            let _ = writeln!(io::stderr(), "xtask: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(task: &Task) -> io::Result<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    match task {
        Task::Teapot { squares } => teapot::write(&mut out, *squares)?,
        Task::Sphere { bands, halves: false } => sphere::write(&mut out, *bands)?,
        Task::Sphere { bands, halves: true } => sphere::write_halves(&mut out, *bands)?,
        Task::Directions { beta } => {
            directions::write(&mut out, *beta).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::Mesh { triangles, each } => mesh::write(&mut out, *triangles, *each)?,
        Task::Bench { triangles } => {
            bench::write(&mut out, triangles).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::BenchReading { triangles } => {
            reading::write(&mut out, *triangles).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::BenchRaster { triangles, python, povray, threads } => {
            let tools = raster::Tools { python, povray, threads: *threads };
            raster::write(&mut out, triangles, &tools)
                .map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::BenchRays { triangles, compiler, threads } => {
            rays::write(&mut out, triangles, compiler, *threads)
                .map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::BenchPhoton { plot, povray, most } => {
            photon::write(&mut out, plot, povray, *most)
                .map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::BenchWarp { ffmpeg } => {
            warp::write(&mut out, ffmpeg).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::BenchFilm { frames } => {
            film::write(&mut out, *frames).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::TraceOnce { scene } => {
            photon::trace_once(&mut out, scene).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::BenchScale { plot } => {
            scale::write(&mut out, plot).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::DrawOnce { scene, width, height, samples } => {
            scale::draw_once(&mut out, scene, [*width, *height], *samples)
                .map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::BenchExact { only } => {
            exact::write(&mut out, only.as_deref()).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::BenchWorldLines { triangles } => {
            world_lines::write(&mut out, *triangles).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::Instructions(args) => {
            instructions::write(&mut out, args).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::Geometry(args) => {
            geometry::write(&mut out, args).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::Gallery(args) => gallery::write(&mut out, args)?,
        Task::Plots { folder } => {
            plots::write(folder).map_err(|error| io::Error::other(error.to_string()))?;
        }
        Task::Hostile(args) => hostile::write(&mut out, args)?,
        Task::Worlds(args) => worlds::write(&mut out, args)?,
        Task::Cluster => cluster::check()?,
        Task::Install(args) => install::write(&mut out, args, std::env::var_os("PATH").as_deref())?,
        Task::Uninstall(args) => install::remove(&mut out, args)?,
        Task::ReadOnce { scene, threads } => {
            reading::read_once(&mut out, scene, *threads)
                .map_err(|error| io::Error::other(error.to_string()))?;
        }
    }
    out.flush()
}
