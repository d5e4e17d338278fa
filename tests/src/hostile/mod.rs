//! Hostile inputs for the programs, and what must hold whatever they are given.
//!
//! A [`Case`] follows from its number alone: an input (a scene, a mesh, pictures or panoramas) that
//! is malformed, extreme or both, and the command lines of a pipe. Half of the cases are valid, so
//! that their pipes run to the end. [`Case::run`] runs it with the built programs and checks what
//! no input may break:
//!
//! - a program ends by itself, with status 0, 1 or 2, within [`PROCESSOR_LIMIT`] and
//!   [`MEMORY_LIMIT`], and allocates no more than 64 MiB and 16 times the bytes of its input and
//!   output; a film 64 MiB more for each frame that it draws at once;
//! - limits of the shell (address space, processes, the size of files) cause errors, not panics;
//! - with status 0 it has written something, and every program downstream reads it;
//! - with another status it has written nothing to standard output, and says why;
//! - if its output is lost (a full disk, a closed pipe), the status is not 0;
//! - after a signal its output file is whole or absent;
//! - nothing that it prints moves the cursor or reverses the text, and no number in a message is
//!   infinite or NaN;
//! - the number of threads changes no byte;
//! - no temporary file is left, unless there was not enough address space: then the next run
//!   deletes it.
//!
//! [`memory`] has what must hold in memory, for fuzz targets, whose inputs are [`File`]s.

mod bytes;
pub mod config;
mod edge;
mod film;
mod line;
pub mod memory;
mod mesh;
mod mild;
mod motion;
mod options;
mod panorama;
mod path;
mod picture;
pub mod renderers;
mod run;
mod scene;
mod words;

use std::path::Path;

use ugtesting::Random;

pub use bytes::damage;
pub use edge::Edge;
pub use run::{MEMORY_LIMIT, PROCESSOR_LIMIT};

/// Names and contents.
type Files = Vec<(String, Vec<u8>)>;

/// A pipe with a hostile input.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its number.
    pub seed: u64,
    /// Name and content of the files in its folder; the first is the input.
    pub files: Files,
    /// Program and arguments of each stage.
    pub stages: Vec<Vec<String>>,
    /// Streams and signals of the last stage.
    pub edge: Edge,
    /// Whether the pipe is run again on one thread, and compared.
    pub is_repeated: bool,
}

impl Case {
    /// The case of this number.
    pub fn new(seed: u64) -> Self {
        match seed % 16 {
            7 => return Self::with_motions(seed),
            15 => return Self::with_figures(seed),
            _ => {}
        }
        let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
        let (files, stages) = if random.one_in(3) { wild(&mut random) } else { mild::pipe(&mut random) };
        Self::finished(seed, random, files, stages)
    }

    /// The case of this number among scenes with motions alone.
    pub fn with_motions(seed: u64) -> Self {
        let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
        let (files, stages) = match random.below(6) {
            0 | 1 => {
                let files = scene::named(motion::wild(&mut random).into_bytes());
                let stages = options::stages(&mut random, "scene", &files);
                (files, stages)
            }
            2 | 3 => {
                let stages = mild::stages(&mut random);
                (scene::named(motion::sane(&mut random).into_bytes()), stages)
            }
            4 => path::path(&mut random),
            _ => path::warp(&mut random),
        };
        Self::finished(seed, random, files, stages)
    }

    /// The case of this number among vector figures with text.
    pub fn with_figures(seed: u64) -> Self {
        let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
        let (files, stages) = path::vector(&mut random);
        Self::finished(seed, random, files, stages)
    }

    fn finished(seed: u64, mut random: Random, files: Files, stages: Vec<Vec<String>>) -> Self {
        let is_repeated = random.one_in(4);
        let edge = Edge::new(&mut random);
        Self { seed, files, stages, edge, is_repeated }
    }

    /// Runs the pipe with the programs in `programs`. True if every stage succeeds.
    ///
    /// # Errors
    /// The first thing that does not hold, in words.
    pub fn run(&self, programs: &Path) -> Result<bool, String> {
        run::run(self, programs).map_err(|finding| format!("case {}: {finding}\n{}", self.seed, self.shell()))
    }

    /// The pipe as a shell would take it.
    fn shell(&self) -> String {
        let stages: Vec<String> = self.stages.iter().map(|words| words.join(" ")).collect();
        format!("  {} < {}", stages.join(" | "), self.files[0].0)
    }

    /// Writes the files of the case into a folder, to look into it by hand.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write_to(&self, folder: &Path) -> std::io::Result<()> {
        self.files.iter().try_for_each(|(name, bytes)| std::fs::write(folder.join(name), bytes))
    }
}

/// Malformed and extreme files and options.
fn wild(random: &mut Random) -> (Files, Vec<Vec<String>>) {
    let (files, first) = match random.below(11) {
        0 | 1 => mesh::files(random),
        2 => picture::files(random),
        3 => panorama::files(random),
        _ => scene::files(random),
    };
    let stages = options::stages(random, first, &files);
    (files, stages)
}

/// A kind of file that the programs read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum File {
    /// A scene.
    Scene,
    /// A mesh of a format other than that of scenes.
    Mesh(ugmesh::MeshFormat),
    /// A PNG file.
    Picture,
    /// A panorama: a PNG, JPEG, HDR, EXR or PFM file.
    Panorama,
    /// A list of stars.
    Stars,
    /// A picture of any format, with its history.
    History,
}

impl File {
    /// A file of this kind, often malformed.
    pub fn generate(self, random: &mut Random) -> Vec<u8> {
        let mut bytes = match self {
            Self::Scene => return scene::text(random),
            Self::Mesh(format) => mesh::of(format, random),
            Self::Picture => picture::png(random),
            Self::Panorama => panorama::file(random),
            Self::Stars => panorama::stars(random).into_bytes(),
            Self::History => picture::with_history(random),
        };
        if random.one_in(2) {
            damage(random, &mut bytes);
        }
        bytes
    }

    /// The law for such a file in memory: the function of [`memory`] for it.
    ///
    /// # Errors
    /// The violation.
    pub fn check(self, bytes: &[u8]) -> Result<(), String> {
        match self {
            Self::Scene => memory::pipe(seed_of(bytes), bytes),
            Self::Mesh(format) => memory::mesh(format, bytes),
            Self::Picture => memory::picture(bytes),
            Self::Panorama => memory::panorama(seed_of(bytes), bytes),
            Self::Stars => memory::stars(seed_of(bytes), bytes),
            Self::History => memory::history(bytes),
        }
    }
}

/// Options follow from the content, so that a corpus is a folder of files.
fn seed_of(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0, |seed: u64, &byte| (seed ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
