//! The sky behind the picture of a scene.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use ugimage::LinearFrame;
use uglight::ColorShift;
use ugphysics::Velocity;
use ugpicture::{Background, Note, PictureOptions};
use ugpipe::Progress;
use ugscene::{StatedSky, View};
use ugsky::{ALL_NM, Basis, StarOptions};
use ugtrace::lens::{Film, Lens};

use crate::around::SkyAround;
use crate::built_in::BuiltIn;
use crate::error::SkyError;
use crate::open::Opened;
use crate::picture::{SkyPicture, sky_colors};
use crate::sky_light::SkyLamps;
use crate::stars::StarField;
use crate::warp::Warp;

/// Where the light of a sky comes from.
#[derive(Clone, Default)]
pub enum SkySource {
    /// There is no sky.
    #[default]
    None,
    /// A file that has not been opened, or the name of a [`BuiltIn`] sky.
    File(PathBuf),
    /// The same, by the statement of a scene.
    Stated(PathBuf),
    /// A panorama, stars or both.
    Opened(Arc<Opened>),
}

impl PartialEq for SkySource {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::None, Self::None) => true,
            (Self::File(one), Self::File(other)) | (Self::Stated(one), Self::Stated(other)) => {
                one == other
            }
            (Self::Opened(one), Self::Opened(other)) => Arc::ptr_eq(one, other),
            _ => false,
        }
    }
}

impl fmt::Debug for SkySource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("None"),
            Self::File(path) | Self::Stated(path) => f.debug_tuple("File").field(path).finish(),
            Self::Opened(_) => f.write_str("Opened"),
        }
    }
}

/// The sky of a scene: infinitely far away, and at rest in the frame in which the scene is written.
/// In a panorama y is ahead, in its middle, x is to the right and z up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneSky {
    /// Its light.
    pub source: SkySource,
    /// Turns directions of the sky into those of the scene.
    pub turn: DQuat,
    /// How stars are drawn.
    pub stars: StarOptions,
}

impl From<Opened> for SceneSky {
    fn from(opened: Opened) -> Self {
        Self { source: SkySource::Opened(opened.into()), ..Self::default() }
    }
}

/// How a picture of a scene sees its sky.
pub struct SkyCamera<'a> {
    /// The camera before one eye's picture or a side of a cube, with one sample per pixel.
    pub view: &'a View,
    /// Which direction is seen where.
    pub lens: Lens,
    /// The picture has two eyes.
    pub is_stereo: bool,
    /// Left column, upper row, width and height of the part that is drawn.
    pub crop: Option<[u32; 4]>,
    /// Velocity of the camera in the frame of the scene.
    pub velocity: Velocity,
    /// How motion changes colours.
    pub shift: ColorShift,
    /// Light brighter than white is kept.
    pub keeps_light: bool,
    /// Size, filter and background.
    pub picture: &'a PictureOptions,
}

impl SceneSky {
    /// Changes it to the sky that a scene states, unless there is one, and makes one without a
    /// file.
    pub fn or_stated(&mut self, stated: Option<&StatedSky>) {
        if let (Some(StatedSky { file, turn: degrees }), SkySource::None) = (stated, &self.source) {
            self.source = SkySource::Stated(file.into());
            self.turn = turn(degrees);
        }
        if let SkySource::File(path) | SkySource::Stated(path) = &self.source
            && let Some(sky) = path.to_str().and_then(BuiltIn::from_name)
        {
            self.source = SkySource::Opened(sky.open().into());
        }
    }

    /// The sky, if there is one.
    ///
    /// # Errors
    /// [`SkyError::Closed`].
    pub fn opened(&self) -> Result<Option<&Arc<Opened>>, SkyError> {
        match &self.source {
            SkySource::None => Ok(None),
            SkySource::File(path) | SkySource::Stated(path) => Err(SkyError::Closed(path.clone())),
            SkySource::Opened(opened) => Ok(Some(opened)),
        }
    }

    /// True if there is a sky.
    pub fn is_some(&self) -> bool {
        self.source != SkySource::None
    }

    /// Notes for the user about the file of the sky.
    pub fn notes(&self) -> impl Iterator<Item = Note> {
        let opened = self.opened().ok().flatten();
        opened.into_iter().flat_map(|opened| opened.notes.iter().cloned().map(Note::Source))
    }

    /// Its light as lights at infinity: sets of points, see [`SkyLamps::new`].
    ///
    /// # Errors
    /// [`SkyError::Closed`].
    pub fn lamps(&self, sets: [usize; 2]) -> Result<Option<SkyLamps>, SkyError> {
        Ok(self.opened()?.and_then(|opened| SkyLamps::new(opened, self.turn, sets)))
    }

    /// The velocity in the axes of the sky.
    fn velocity(&self, velocity: Velocity) -> Velocity {
        crate::around::turned(self.turn.inverse(), velocity)
    }

    /// Puts the sky behind the picture of a scene, an opaque one drawn on black whose alpha is the
    /// part that the scene covers. Returns the brightest channel of the sky. A transparent picture
    /// stays as it is.
    ///
    /// # Errors
    /// [`SkyError`].
    pub fn put_behind(
        &self,
        frame: &mut LinearFrame,
        camera: &SkyCamera<'_>,
        progress: &dyn Progress,
    ) -> Result<f32, SkyError> {
        let (Some(opened), true) = (self.opened()?, frame.is_opaque()) else { return Ok(0.0) };
        let [width, height] = camera.picture.size;
        let eyes = if camera.is_stereo { camera.lens.frames(true) } else { [1, 1] };
        // Both eyes see the same sky.
        let whole = [0, 0, width / eyes[0], height / eyes[1]];
        let part = camera.crop.filter(|_| !camera.is_stereo).unwrap_or(whole);
        let sky = self.light(opened, camera, part, progress)?;
        let [left, top] = match camera.crop {
            Some([left, top, ..]) if camera.is_stereo => [left, top],
            _ => [0, 0],
        };
        let [columns, rows] = [part[2], part[3]];
        let width = frame.width() as usize;
        let pixels = frame.pixels_mut().par_chunks_mut(width.max(1)).enumerate();
        let brightest = pixels.map(|(row, pixels)| {
            let start = ((top + row as u32) % rows * columns) as usize;
            let mut most = 0.0_f32;
            for (column, pixel) in pixels.iter_mut().enumerate() {
                let behind = sky.pixels()[start + ((left + column as u32) % columns) as usize];
                let free = 1.0 - pixel[3];
                if free > 0.0 {
                    (0..3).for_each(|channel| pixel[channel] += free * behind[channel]);
                    pixel[3] += free * behind[3];
                    most = behind[..3].iter().fold(most, |most, part| most.max(*part));
                }
            }
            most
        });
        Ok(brightest.reduce(|| 0.0, f32::max))
    }

    /// The light of the sky in a part of one eye's picture.
    fn light(
        &self,
        opened: &Opened,
        camera: &SkyCamera<'_>,
        part: [u32; 4],
        progress: &dyn Progress,
    ) -> Result<LinearFrame, SkyError> {
        let [across, down] = camera.lens.frames(false);
        let [width, height] = camera.picture.size;
        let eyes = if camera.is_stereo { camera.lens.frames(true) } else { [1, 1] };
        let frame = [width / across / eyes[0], height / down / eyes[1]];
        let film = Film::new(camera.lens, None, camera.view, frame).turned(self.turn.inverse());
        let picture = SkyPicture {
            part,
            samples: 1,
            filter: camera.picture.filter,
            background: camera.picture.background,
            lens: camera.lens,
            film,
            pixel_film: film,
            velocity: self.velocity(camera.velocity),
            colors: sky_colors(camera.shift, Basis::Mixture),
            range_nm: ALL_NM,
            keeps_light: camera.keeps_light,
            stars: self.stars,
        };
        let (mut light, _) = Warp::new(opened.into(), &picture)?.light(progress);
        if !opened.stars.is_empty() {
            StarField::new(&opened.stars, &picture).add(&opened.stars, &mut light);
        }
        Ok(light)
    }

    /// The sky for rays that leave the scene, in the frame of the camera. `None` without a sky.
    ///
    /// # Errors
    /// [`SkyError`].
    pub fn around(
        &self,
        velocity: Velocity,
        shift: ColorShift,
        keeps_light: bool,
    ) -> Result<Option<SkyAround>, SkyError> {
        let Some(opened) = self.opened()? else { return Ok(None) };
        let colors = sky_colors(shift, Basis::Mixture);
        let around = SkyAround::new(opened.clone(), self.turn, velocity, colors, keeps_light)?;
        Ok(Some(around.with_stars(self.stars)))
    }
}

/// The background on which a scene is drawn: black instead of a colour, if a sky is put behind it.
pub fn drawn_on(sky: &SceneSky, background: Background) -> Background {
    match background {
        Background::Color(_) if sky.is_some() => PictureOptions::default().background,
        background => background,
    }
}

/// Turns about the axes, one after the other, by angles in degrees.
pub(crate) fn turn(degrees: &[f64]) -> DQuat {
    let about = |(axis, degrees): (DVec3, &f64)| {
        let (sin, cos) = libm::sincos(0.5 * degrees.to_radians());
        DQuat::from_xyzw(axis.x * sin, axis.y * sin, axis.z * sin, cos)
    };
    let turns = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().zip(degrees).map(about);
    turns.fold(DQuat::IDENTITY, |sum, turn| turn * sum).normalize()
}
