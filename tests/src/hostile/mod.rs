//! Hostile inputs for the programs, and what must hold whatever they are given.
//!
//! A [`Case`] follows from its number alone: an input (a scene, a mesh, pictures or panoramas) and
//! the command lines of a pipe, possible or malformed and extreme. [`Case::run`] runs it with the
//! programs and checks what no input may break:
//!
//! - a program ends by itself, with status 0, 1 or 2, within [`PROCESSOR_LIMIT`] and the memory
//!   that the size of its input and output allows;
//! - with status 0 it has written something, and the next program reads it;
//! - with another status it has written nothing to standard output, and says why;
//! - no temporary file is left;
//! - nothing that it prints moves the cursor or reverses the text, and no number in a message is
//!   infinite or NaN;
//! - the number of threads changes no byte.
//!
//! Full disks, closed pipes, signals and limits of the shell are the business of ugpipe, whose
//! tests have them. [`memory`] has what must hold in memory, for fuzz targets, whose inputs are
//! [`File`]s.

mod bytes;
mod files;
pub mod memory;
mod options;
mod run;
mod scene;
mod template;

use std::path::Path;

use ugimage::Format;
use ugmesh::MeshFormat;
use ugtesting::Random;

pub use bytes::damage;
pub use run::{PROCESSOR_LIMIT, is_dangerous};
pub use template::Kind;

/// A pipe with a hostile input.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its number.
    pub seed: u64,
    /// Name and content of the files in its folder; the first is the input.
    pub files: Vec<(String, Vec<u8>)>,
    /// Program and arguments of each stage.
    pub stages: Vec<Vec<String>>,
}

impl Case {
    /// The case of this number.
    pub fn new(seed: u64, kind: Kind) -> Self {
        let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
        let random = &mut random;
        let (name, file, programs) = match random.below(8) {
            0 => ("0.png", File::Picture, &["ugsheet"][..]),
            1 => (
                "0.sky",
                if random.one_in(3) { File::Stars } else { File::Panorama },
                &["ugwarp"][..],
            ),
            2 | 3 => {
                let format = *random.pick(&MESHES);
                (
                    "mesh",
                    File::Mesh(format),
                    *random.pick(&[&["ugmesh"][..], &["uglorentz", "ugrainbow"]]),
                )
            }
            _ => ("scene.ug", File::Scene, PIPES[random.below(PIPES.len())]),
        };
        let input =
            if kind == Kind::Wild { file.generate(random) } else { file.undamaged(random, kind) };
        let mut stages: Vec<Vec<String>> =
            programs.iter().map(|program| options::line(random, kind, program)).collect();
        if file != File::Scene {
            stages[0].push(name.to_owned());
        }
        let part = b"v part 0 0 1 ;\n".to_vec();
        let files = vec![(name.to_owned(), input), ("part.ug".to_owned(), part)];
        Self { seed, files, stages }
    }

    /// Runs the pipe with the programs in `programs`. True if every stage succeeds.
    ///
    /// # Errors
    /// The first thing that does not hold, in words.
    pub fn run(&self, programs: &Path) -> Result<bool, String> {
        let stages: Vec<String> = self.stages.iter().map(|words| words.join(" ")).collect();
        let shell = format!("  {} < {}", stages.join(" | "), self.files[0].0);
        run::run(self, programs)
            .map_err(|finding| format!("case {}: {finding}\n{shell}", self.seed))
    }

    /// Writes the files of the case into a folder, to look into it by hand.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write_to(&self, folder: &Path) -> std::io::Result<()> {
        self.files.iter().try_for_each(|(name, bytes)| std::fs::write(folder.join(name), bytes))
    }
}

/// The programs of a pipe for a scene.
const PIPES: [&[&str]; 7] = [
    &["uglorentz", "ugdoppler", "ugrainbow"],
    &["uglorentz", "ugdoppler", "ugrainbow"],
    &["uglorentz", "ugrainbow"],
    &["uglorentz", "ugdoppler", "ugmesh"],
    &["ugphoton"],
    &["ugfilm"],
    &["ugparse"],
];

/// The formats of meshes other than that of scenes.
pub const MESHES: [MeshFormat; 5] =
    [MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply, MeshFormat::Stl, MeshFormat::Gltf];

/// A kind of file that the programs read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum File {
    /// A scene.
    Scene,
    /// A mesh of a format other than that of scenes.
    Mesh(MeshFormat),
    /// A PNG file.
    Picture,
    /// A panorama: a PNG, JPEG, HDR or EXR file.
    Panorama,
    /// A list of stars.
    Stars,
    /// A picture of any format, with its history.
    History,
}

impl File {
    /// A file of this kind, often malformed.
    pub fn generate(self, random: &mut Random) -> Vec<u8> {
        let kind = if random.one_in(3) { Kind::Mild } else { Kind::Wild };
        let mut bytes = self.undamaged(random, kind);
        if random.one_in(2) {
            damage(random, &mut bytes);
        }
        bytes
    }

    fn undamaged(self, random: &mut Random, kind: Kind) -> Vec<u8> {
        match self {
            Self::Scene if random.one_in(4) => scene::known(random),
            Self::Scene => scene::statements(random, kind).into_bytes(),
            Self::Mesh(format) => files::mesh(random, kind, format),
            Self::Picture => files::picture(random, kind, Format::Png),
            Self::Panorama => files::panorama(random, kind),
            Self::Stars => files::stars(random, kind),
            Self::History => {
                let format = *random.pick(&Format::ALL);
                files::picture(random, kind, format)
            }
        }
    }

    /// The law for such a file in memory: the function of [`memory`] for it.
    ///
    /// # Errors
    /// The violation.
    pub fn check(self, bytes: &[u8]) -> Result<(), String> {
        // Options follow from the content, so that a corpus is a folder of files.
        let hash = |seed: u64, &byte: &u8| (seed ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        let seed = bytes.iter().fold(0, hash);
        match self {
            Self::Scene => memory::pipe(seed, bytes),
            Self::Mesh(format) => memory::mesh(format, bytes),
            Self::Picture => memory::picture(bytes),
            Self::Panorama => memory::panorama(seed, bytes),
            Self::Stars => memory::stars(seed, bytes),
            Self::History => memory::history(bytes),
        }
    }
}
