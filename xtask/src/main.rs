//! Maintenance tasks: generate meshes, run benchmarks, draw figures, install.
//!
//! ```text
//! cargo xtask mesh 1000000 > /tmp/mesh.ug
//! cargo xtask bench
//! cargo xtask bench photon --against ../before/target/release
//! cargo xtask instructions
//! cargo xtask scaling
//! cargo xtask gallery
//! cargo xtask gallery --check
//! cargo xtask plots figures
//! cargo xtask page --test
//! cargo xtask hostile 50000
//! cargo xtask mutants ugsky --file stars.rs
//! cargo xtask notices
//! cargo xtask worlds --from 1000000 --count 10000
//! cargo xtask cluster
//! cargo xtask package --check
//! cargo xtask site
//! cargo xtask python
//! cargo xtask install --prefix ~/.local
//! cargo xtask uninstall --prefix ~/.local
//! ```
//!
//! Meshes go to standard output and are the same bytes on every run and platform.

mod gallery;
mod hostile;
mod install;
mod instructions;
mod mesh;
mod mutants;
mod notices;
mod page;
mod plot;
mod plots;
mod programs;
mod rays;
mod scaling;
mod scripts;
mod site;
mod worlds;

use clap::{Parser, Subcommand};
use std::error::Error;
use std::ffi::OsString;
use std::io::{self, BufWriter, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Generates meshes, runs benchmarks and measures accuracy
#[derive(Parser)]
#[command(bin_name = "cargo xtask")]
struct Args {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Write a bumpy sphere of about N triangles in 36 colours, for benchmarks
    Mesh {
        /// Triangles, roughly
        #[arg(value_name = "N", value_parser = clap::value_parser!(u32).range(36..=100_000_000))]
        triangles: u32,
        /// Give every vertex a colour of its own
        #[arg(long)]
        each: bool,
    },
    /// Measure running times, beside those of another commit if wanted, as Markdown
    ///
    /// Requires hyperfine, which Debian and Homebrew have a package of. xtask/bench.sh lists the
    /// benchmarks and their options.
    Bench {
        /// Benchmark and options
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        words: Vec<OsString>,
    },
    /// Count the instructions that the programs execute on fixed work, and compare with
    /// xtask/instructions.csv, as Markdown
    ///
    /// Requires valgrind, the Debian package valgrind.
    Instructions(instructions::Args),
    /// Count how the instructions of the programs grow with the parts of a scene, and fail where
    /// they grow faster than n^1.3, as Markdown
    Scaling(scaling::Args),
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
    /// Change formulas one by one, and list the changes that no test of their crate notices
    ///
    /// Installs cargo-mutants in target/tools if it is missing.
    Mutants(mutants::Args),
    /// Write the notices of everything that is linked into the programs
    Notices(notices::Args),
    /// Write the documentation as a site, in target/site/book
    Site,
    /// Build a Debian package and an archive of static programs in target/packages
    Package {
        /// Install the package in a new Debian and remove it, build all a second time, and package
        /// every crate: as root, with the Debian package debootstrap
        #[arg(long)]
        check: bool,
    },
    /// Build the wheel of the Python package and test it in a clean environment
    ///
    /// Requires Python 3.9 or later with its module venv; the rest is installed in target/python,
    /// with the linker of Zig, which makes the wheel run on Linux since 2014 (manylinux2014).
    Python,
    /// Build the page of web/, one HTML file with the programs as WebAssembly
    Page(page::Args),
    /// Install the programs, their man pages and documentation, and completions for bash, zsh and
    /// fish
    Install(install::Args),
    /// Remove what `install` has written, and nothing else
    Uninstall(install::UninstallArgs),
    /// Trace primary rays, for `bench rays`
    #[command(hide = true)]
    TraceRays {
        /// What is done
        #[arg(value_enum)]
        work: rays::Work,
        /// Triangles, roughly
        triangles: u32,
        /// How often
        #[arg(default_value_t = 1)]
        times: u32,
    },
}

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> ExitCode {
    match run(&Args::parse().task) {
        Ok(()) => ExitCode::SUCCESS,
        // The other end of the pipe was closed (`| head`): not an error.
        Err(error) if is_broken_pipe(&*error) => ExitCode::SUCCESS,
        Err(error) => {
            // If standard error is closed, too, nothing can be reported.
            let _ = writeln!(io::stderr(), "xtask: {error}");
            ExitCode::FAILURE
        }
    }
}

fn is_broken_pipe(error: &(dyn Error + 'static)) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

fn run(task: &Task) -> Outcome<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    match task {
        Task::Mesh { triangles, each } => {
            let mesh = mesh::Mesh::of_triangles(*triangles).scene(*each)?;
            writeln!(out, "{mesh}cam -ep 5 3 2 -vc 0 0 0 -ud 0 0 1 -ps -va 30 24 ;")?;
        }
        Task::Bench { words } => scripts::bench(words)?,
        Task::TraceRays { work, triangles, times } => {
            rays::write(&mut out, *work, *triangles, *times)?
        }
        Task::Instructions(args) => instructions::write(&mut out, args)?,
        Task::Scaling(args) => scaling::write(&mut out, args)?,
        Task::Gallery(args) => gallery::write(&mut out, args)?,
        Task::Plots { folder } => plots::write(folder)?,
        Task::Hostile(args) => hostile::write(&mut out, args)?,
        Task::Worlds(args) => worlds::write(&mut out, args)?,
        Task::Cluster => scripts::cluster()?,
        Task::Mutants(args) => mutants::run(args)?,
        Task::Notices(args) => notices::write(&mut out, args)?,
        Task::Site => site::write(&mut out)?,
        Task::Package { check } => scripts::package(*check)?,
        Task::Python => scripts::python()?,
        Task::Page(args) => page::build(&mut out, args)?,
        Task::Install(args) => install::write(&mut out, args, std::env::var_os("PATH").as_deref())?,
        Task::Uninstall(args) => install::remove(&mut out, args)?,
    }
    Ok(out.flush()?)
}
