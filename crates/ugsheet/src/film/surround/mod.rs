//! What a film shows of all directions, as players of 360° films need it: Spherical Video RFC, both
//! versions.
//!
//! ffmpeg writes the film, and the marks are written into its file afterwards: boxes of MP4
//! (ISO/IEC 14496-12) or elements of WebM (RFC 8794, RFC 9559). The pictures stay where they are
//! or move as a whole.

mod mesh;
mod mp4;
mod webm;

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

pub use mesh::SurroundMesh;

use super::kind::FilmKind;

/// What a film shows of all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Surround {
    /// Which direction is seen at a place of a frame.
    pub projection: FilmProjection,
    /// Where the pictures of two eyes are.
    pub eyes: Eyes,
    /// The program that made the film.
    pub source: &'static str,
}

/// Which direction is seen at a place of a frame, or of an eye's part of it.
#[derive(Clone, Debug, PartialEq)]
pub enum FilmProjection {
    /// A plane, as in any film.
    Flat,
    /// All directions: longitude across, latitude down.
    Equirectangular,
    /// The places of a frame that the vertices of a mesh around the eye show.
    Mesh(SurroundMesh),
}

/// Where the pictures of two eyes are in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Eyes {
    /// There is one picture.
    One,
    /// The left eye's above.
    TopBottom,
    /// The left eye's on the left.
    LeftRight,
}

impl Surround {
    /// Arguments of ffmpeg for what it writes itself, and for room that marks need in the file.
    pub(super) fn arguments(&self, kind: FilmKind) -> Vec<String> {
        if kind != FilmKind::Webm {
            return Vec::new();
        }
        let tag = |name: &str, value: &str| ["-metadata:s:v".to_owned(), format!("{name}={value}")];
        let eyes = match self.eyes {
            Eyes::One => None,
            Eyes::TopBottom => Some(tag("stereo_mode", "top_bottom")),
            Eyes::LeftRight => Some(tag("stereo_mode", "left_right")),
        };
        let first = self.first_version().map(|text| tag("SPHERICAL-VIDEO", &text));
        let room = tag(webm::ROOM, &"-".repeat(self.projection_data().len() + 64));
        eyes.into_iter().chain(first).chain([room]).flatten().collect()
    }

    /// Marks a film that ffmpeg has written.
    ///
    /// # Errors
    /// The file cannot be read or written, or is of another kind.
    pub(super) fn mark(&self, kind: FilmKind, path: &Path) -> io::Result<()> {
        let mut file = File::options().read(true).write(true).open(path)?;
        match kind {
            FilmKind::Webm => webm::mark(&mut file, self),
            _ => mp4::mark(&mut file, self),
        }
    }

    /// The metadata of version 1, which has equirectangular films alone.
    fn first_version(&self) -> Option<String> {
        let eyes = match self.eyes {
            Eyes::One => "",
            Eyes::TopBottom => "<GSpherical:StereoMode>top-bottom</GSpherical:StereoMode>",
            Eyes::LeftRight => "<GSpherical:StereoMode>left-right</GSpherical:StereoMode>",
        };
        let source = self.source;
        (self.projection == FilmProjection::Equirectangular).then(|| {
            format!(
                "<?xml version=\"1.0\"?><rdf:SphericalVideo \
                 xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" \
                 xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\">\
                 <GSpherical:Spherical>true</GSpherical:Spherical>\
                 <GSpherical:Stitched>true</GSpherical:Stitched>\
                 <GSpherical:StitchingSoftware>{source}</GSpherical:StitchingSoftware>\
                 <GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>\
                 {eyes}</rdf:SphericalVideo>"
            )
        })
    }

    /// Version, flags and content of the projection's box of version 2 (`equi`, `mshp`), which WebM
    /// has, too. Empty for a plane.
    fn projection_data(&self) -> Vec<u8> {
        match &self.projection {
            FilmProjection::Flat => Vec::new(),
            // Nothing is cut off at any of the four edges.
            FilmProjection::Equirectangular => vec![0; 4 + 4 * 4],
            FilmProjection::Mesh(mesh) => {
                let content = [b"raw ".to_vec(), mp4::boxed(*b"mesh", &[&mesh.packed()])].concat();
                let crc = crc32fast::hash(&content);
                [vec![0; 4], crc.to_be_bytes().to_vec(), content].concat()
            }
        }
    }
}

/// Moves the end of a file, from a place on, `n` bytes further.
fn make_room(file: &mut File, place: u64, n: u64) -> io::Result<()> {
    let mut block = vec![0; 1 << 20];
    let mut end = file.seek(SeekFrom::End(0))?;
    while end > place {
        let part = (end - place).min(block.len() as u64);
        let bytes = &mut block[..part as usize];
        end -= part;
        file.seek(SeekFrom::Start(end))?;
        file.read_exact(bytes)?;
        file.seek(SeekFrom::Start(end + n))?;
        file.write_all(bytes)?;
    }
    Ok(())
}

/// What ffmpeg wrote is not as expected.
fn unexpected(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("the film cannot be marked: {what}"))
}
