//! Checks that a scene is at the stage that a program requires: wrong orders of programs are
//! refused.

use glam::DVec3;
use ugphysics::{Hsv, hue_to_wavelength};

use crate::words::{messages, point};
use crate::{BodyId, ColorScale, ColorStage, ColorValue, HueScale, Scene, Tint};

/// Why a scene cannot go through a program: its stage is not the one the program needs.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum StageError {
    /// Rest shapes are required, but positions are as seen.
    GeometryAsSeen,
    /// Colours at rest are required, but colours are as seen.
    ColorsAsSeen,
    /// Colours as seen are required, and the renderer is to shift those of textures.
    ColorsDeferred,
    /// Faces with an outline as seen are required, but they are whole, for rays.
    WholeFaces,
    /// Positions as seen are required, but bodies move and have their rest shapes.
    GeometryAtRest,
    /// Wavelengths are required, but colours as seen are hues.
    NotWavelengths,
    /// Positions are as seen from another eye point.
    OtherEye {
        /// The eye point that positions were computed for.
        made_for: DVec3,
        /// The requested eye point.
        asked: DVec3,
    },
}

messages! { StageError {
    Self::GeometryAsSeen =>
        "positions in this scene are as seen already, so its rest shapes are not known";
    Self::ColorsAsSeen => "colours in this scene are as seen already";
    Self::ColorsDeferred =>
        "textures in this scene are shifted where they are drawn, by a ray for each sample";
    Self::WholeFaces =>
        "faces in this scene are not cut where they are seen as curved: it has textures or emitted light, \
         drawn by a ray for each sample";
    Self::GeometryAtRest => "bodies in this scene move, and their positions are not as seen yet";
    Self::NotWavelengths => "colours in this scene are as seen, and are not written as wavelengths";
    Self::OtherEye { made_for, asked } =>
        "positions in this scene are as seen from the eye point {}, and would be wrong from {}",
        point(*made_for), point(*asked);
} }

/// True if a face or wire moves.
pub fn has_moving_bodies(scene: &Scene) -> bool {
    any_moves(scene, scene.drawn().map(|drawn| drawn.body))
}

/// True if a light moves.
pub fn has_moving_lights(scene: &Scene) -> bool {
    any_moves(scene, scene.lights.iter().filter_map(|light| light.motion.body()))
}

fn any_moves(scene: &Scene, mut bodies: impl Iterator<Item = BodyId>) -> bool {
    // In most scenes nothing moves, so their faces need not be visited.
    scene.bodies.has_motion() && bodies.any(|body| scene.bodies.is_moving(body))
}

/// Refuses apparent positions.
///
/// # Errors
/// [`StageError::GeometryAsSeen`].
pub fn require_geometry_at_rest(scene: &Scene) -> Result<(), StageError> {
    scene.stage.seen_geometry().map_or(Ok(()), |_| Err(StageError::GeometryAsSeen))
}

/// Refuses apparent colours, deferred ones included.
///
/// # Errors
/// [`StageError::ColorsAsSeen`].
pub fn require_colors_at_rest(scene: &Scene) -> Result<(), StageError> {
    if scene.stage.colors == ColorStage::AtRest { Ok(()) } else { Err(StageError::ColorsAsSeen) }
}

/// Refuses deferred colours.
///
/// # Errors
/// [`StageError::ColorsDeferred`].
pub fn refuse_deferred_colors(scene: &Scene) -> Result<(), StageError> {
    scene.stage.deferred_colors().map_or(Ok(()), |_| Err(StageError::ColorsDeferred))
}

/// Refuses faces that are seen as curved and were left whole for rays.
///
/// # Errors
/// [`StageError::WholeFaces`].
pub fn refuse_whole_faces(scene: &Scene) -> Result<(), StageError> {
    let is_whole = scene.stage.seen_geometry().is_some_and(|seen| seen.is_whole);
    if is_whole { Err(StageError::WholeFaces) } else { Ok(()) }
}

/// Refuses moving bodies with rest shapes.
///
/// # Errors
/// [`StageError::GeometryAtRest`].
pub fn require_seen_geometry(scene: &Scene) -> Result<(), StageError> {
    if scene.stage.seen_geometry().is_none() && has_moving_bodies(scene) {
        return Err(StageError::GeometryAtRest);
    }
    Ok(())
}

/// Refuses an eye point other than the one that positions were computed for.
///
/// # Errors
/// [`StageError::OtherEye`].
pub fn require_eye(scene: &Scene, eye: DVec3) -> Result<(), StageError> {
    match scene.stage.seen_geometry() {
        Some(seen) if seen.eye != eye => {
            Err(StageError::OtherEye { made_for: seen.eye, asked: eye })
        }
        _ => Ok(()),
    }
}

/// The meaning of the hue field of `c` statements: for colours as seen, that of the stage;
/// otherwise `asked`.
///
/// # Errors
/// [`StageError::NotWavelengths`].
pub fn hue_scale(scene: &Scene, asked: HueScale) -> Result<HueScale, StageError> {
    let Some(seen) = scene.stage.seen_colors() else { return Ok(asked) };
    // Hues of bodies at rest are as written.
    let are_as_written =
        matches!(seen.scale, ColorScale::Hues { .. }) && scene.stage.seen_geometry().is_none();
    match (scene.stage.hue_scale(), asked) {
        (HueScale::Degrees, HueScale::Wavelengths) if are_as_written => Ok(asked),
        (HueScale::Degrees, HueScale::Wavelengths) => Err(StageError::NotWavelengths),
        (scale, _) => Ok(scale),
    }
}

/// Writes red, green and blue of a display (`c_rgb`) as hue, saturation and value (`c`), which are
/// mixed by hue, as in 1988.
pub fn write_display_as_hues(scene: &mut Scene) {
    let unit = scene.stage.hue_scale();
    for color in &mut scene.colors {
        if let ColorValue::Rgb(rgb) = color.value {
            let Hsv { hue, saturation, value } = Hsv::from_rgb(rgb);
            let tint = match unit {
                HueScale::Wavelengths if saturation > 0.0 => {
                    Tint::Wavelength(hue_to_wavelength(hue))
                }
                unit => Tint::new(hue, unit),
            };
            color.value = ColorValue::Hsv { value, tint, saturation, factor: 1.0 };
        }
    }
}

/// Reads the numbers of all tints in this unit, whatever they were read in.
pub fn read_tints_in(scene: &mut Scene, unit: HueScale) {
    for color in &mut scene.colors {
        color.value = color.value.with_tint_in(unit);
    }
}
