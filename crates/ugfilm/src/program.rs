//! The programs that make a frame, with typed options.

use thiserror::Error;
use ugimage::PanoramaArea;
use ugpicture::{PictureOptions, Rendering};
use ugpipe::Progress;
use ugscene::{MotionOptions, Provenance, Scene};
use ugskybox::SceneSky;
use ugtrace::lens::Lens;

use crate::note::Note;

/// Declares the programs: a variant for each with the options of its crate, and one with its
/// errors.
macro_rules! programs {
    ($($(#[doc = $doc:literal])* $variant:ident($krate:ident): $error:literal,)+) => {
        /// A program of the family with its options, whose functions are called in this process.
        #[derive(Clone, Debug)]
        pub enum Program {
            $($(#[doc = $doc])* $variant($krate::Config),)+
        }

        /// Why a program of a frame failed.
        #[derive(Debug, Error)]
        #[non_exhaustive]
        pub enum ProgramError {
            $(
                #[doc = $error]
                #[error(transparent)]
                $variant(#[from] $krate::Error),
            )+
        }

        impl Program {
            /// Its name and version, as in the history of a picture.
            pub fn provenance(&self) -> Provenance<'static> {
                match self {
                    $(Self::$variant(_) => $krate::PROVENANCE,)+
                }
            }
        }

        #[cfg(feature = "cli")]
        impl ugpipe::Words for ProgramError {
            fn words(&self) -> String {
                match self {
                    $(Self::$variant(error) => error.words(),)+
                }
            }
        }
    };
}

programs! {
    /// Positions as seen.
    Lorentz(uglorentz): "The scene has no apparent positions.",
    /// Colours as seen.
    Doppler(ugdoppler): "The scene has no apparent colours.",
    /// The picture, of a scene as seen.
    Rainbow(ugrainbow): "The scene as seen cannot be drawn.",
    /// The picture, by tracing rays.
    Photon(ugphoton): "The scene at rest cannot be drawn.",
    /// The view of a panorama.
    Warp(ugwarp): "The panorama cannot be drawn.",
}

/// The data between two programs.
pub enum FilmItem<'s> {
    /// A scene.
    Scene(Box<Scene>),
    /// A panorama.
    Panorama(&'s ugwarp::Opened),
    /// The picture.
    Picture(Rendering),
}

impl Program {
    /// The options of the picture, of a program that draws.
    pub fn picture(&mut self) -> Option<&mut PictureOptions> {
        match self {
            Self::Rainbow(config) => Some(&mut config.picture),
            Self::Photon(config) => Some(&mut config.picture),
            Self::Warp(config) => Some(&mut config.picture),
            Self::Lorentz(_) | Self::Doppler(_) => None,
        }
    }

    /// The lens of a program that draws, and whether it draws for two eyes.
    pub fn lens(&self) -> (Lens, bool) {
        match self {
            Self::Photon(config) => (config.lens, config.stereo.is_some()),
            Self::Warp(config) => (config.lens, false),
            Self::Lorentz(_) | Self::Doppler(_) | Self::Rainbow(_) => (Lens::Pinhole, false),
        }
    }

    /// The part of the whole picture that is drawn: left column, upper row, width and height.
    pub fn crop(&self) -> Option<[u32; 4]> {
        match self {
            Self::Photon(config) => config.crop,
            _ => None,
        }
    }

    /// The panorama that a picture with these options is, of a program that draws panoramas.
    pub fn panorama(&self, picture: &PictureOptions) -> Option<PanoramaArea> {
        let (lens, is_stereo) = self.lens();
        picture.panorama_area(lens, is_stereo, self.crop())
    }

    /// The sky around a scene, of a program that draws or lights scenes.
    pub fn sky(&mut self) -> Option<&mut SceneSky> {
        match self {
            Self::Rainbow(config) => Some(&mut config.sky),
            Self::Photon(config) => Some(&mut config.sky),
            Self::Doppler(config) if config.light => Some(&mut config.sky),
            Self::Lorentz(_) | Self::Doppler(_) | Self::Warp(_) => None,
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

    /// Its output for an item, with its warnings and notes; `None` if it reads something else.
    ///
    /// # Errors
    /// The program fails.
    pub fn run<'s>(
        &self,
        item: FilmItem<'s>,
        progress: &dyn Progress,
    ) -> Result<Option<(FilmItem<'s>, Vec<Note>)>, ProgramError> {
        let mut picture = match (self, item) {
            (Self::Lorentz(config), FilmItem::Scene(scene)) => {
                let (scene, report) = uglorentz::apply_with(*scene, config, progress)?;
                return Ok(Some((
                    FilmItem::Scene(scene.into()),
                    vec![Note::Lorentz(report.into())],
                )));
            }
            (Self::Doppler(config), FilmItem::Scene(scene)) => {
                let (scene, notes) = ugdoppler::apply_with(*scene, config, progress)?;
                let notes = notes.into_iter().map(Note::Doppler).collect();
                return Ok(Some((FilmItem::Scene(scene.into()), notes)));
            }
            (Self::Rainbow(config), FilmItem::Scene(scene)) => {
                ugrainbow::render_with(&scene, config, progress)?
            }
            (Self::Photon(config), FilmItem::Scene(scene)) => {
                ugphoton::render_with(*scene, config, progress)?
            }
            (Self::Warp(config), FilmItem::Panorama(panorama)) => {
                ugwarp::render_opened(panorama, config, progress)?
            }
            _ => return Ok(None),
        };
        let notes = self.notes(&mut picture);
        Ok(Some((FilmItem::Picture(picture), notes)))
    }

    /// Moves the notes on a picture that it drew.
    pub fn notes(&self, picture: &mut Rendering) -> Vec<Note> {
        let program = self.provenance().program;
        picture.notes.drain(..).map(|note| Note::Picture(program, note)).collect()
    }
}
