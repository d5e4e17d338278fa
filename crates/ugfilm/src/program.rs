//! The programs that make a frame, with typed options.

use ugpicture::{PictureOptions, Rendering};
use ugscene::{MotionOptions, Provenance, Scene};

use crate::error::Error;
use crate::note::Note;

/// A program of the family with its options, whose functions are called in this process.
#[derive(Clone, Debug)]
pub enum Program {
    /// Positions as seen.
    Lorentz(uglorentz::Config),
    /// Colours as seen.
    Doppler(ugdoppler::Config),
    /// The picture, of a scene as seen.
    Rainbow(ugrainbow::Config),
    /// The picture, by tracing rays.
    Photon(ugphoton::Config),
    /// The view of a panorama.
    Warp(ugwarp::Config),
}

/// What goes from one program to the next.
pub enum Item<'s> {
    Scene(Box<Scene>),
    Panorama(&'s ugwarp::Opened),
    Picture(Rendering),
}

impl Program {
    /// Its name and version, as in the history of a picture.
    pub fn provenance(&self) -> Provenance<'static> {
        match self {
            Self::Lorentz(_) => uglorentz::PROVENANCE,
            Self::Doppler(_) => ugdoppler::PROVENANCE,
            Self::Rainbow(_) => ugrainbow::PROVENANCE,
            Self::Photon(_) => ugphoton::PROVENANCE,
            Self::Warp(_) => ugwarp::PROVENANCE,
        }
    }

    /// The options of the picture, of a program that draws.
    pub fn picture(&mut self) -> Option<&mut PictureOptions> {
        match self {
            Self::Rainbow(config) => Some(&mut config.picture),
            Self::Photon(config) => Some(&mut config.picture),
            Self::Warp(config) => Some(&mut config.picture),
            Self::Lorentz(_) | Self::Doppler(_) => None,
        }
    }

    /// How bodies and camera move, of a program that reads a scene at rest.
    pub fn motion(&self) -> Option<MotionOptions> {
        match self {
            Self::Lorentz(config) => Some(config.motion()),
            Self::Photon(config) => Some(config.motion.clone()),
            Self::Doppler(_) | Self::Rainbow(_) | Self::Warp(_) => None,
        }
    }

    /// What it makes of an item, and its warnings and notes.
    ///
    /// # Errors
    /// The program fails, or reads something else.
    pub fn run<'s>(&self, item: Item<'s>) -> Result<(Item<'s>, Vec<Note>), Error> {
        let mut picture = match (self, item) {
            (Self::Lorentz(config), Item::Scene(scene)) => {
                let (scene, report) = uglorentz::apply(*scene, config)?;
                return Ok((Item::Scene(scene.into()), vec![Note::Lorentz(report)]));
            }
            (Self::Doppler(config), Item::Scene(scene)) => {
                let (scene, report) = ugdoppler::apply(*scene, config)?;
                let notes = report.notes.into_iter().map(Note::Doppler).collect();
                return Ok((Item::Scene(scene.into()), notes));
            }
            (Self::Rainbow(config), Item::Scene(scene)) => ugrainbow::render(&scene, config)?,
            (Self::Photon(config), Item::Scene(scene)) => ugphoton::render(*scene, config)?,
            (Self::Warp(config), Item::Panorama(panorama)) => ugwarp::render(panorama, config)?,
            _ => return Err(Error::Subject),
        };
        let program = self.provenance().program;
        let notes = std::mem::take(&mut picture.notes).into_iter();
        let notes = notes.map(|note| Note::Picture(program, note)).collect();
        Ok((Item::Picture(picture), notes))
    }
}
