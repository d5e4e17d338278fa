//! A scene prepared for one camera.

use std::borrow::Cow;

use uglight::{Appearance, ColorShift, Lighting};
use ugpicture::{Background, Output, PictureOptions, WithoutFaces, refuse};
use ugraster::{SampleGrid, TileShape};
use ugscene::{Scene, ShownEffects, View};
use ugskybox::SkyError;
use ugtrace::textures::Textures;

use crate::config::Config;
use crate::error::Error;
use crate::packing::Layout;
use crate::painter::Painter;
use crate::shade::Shader;

/// Data computed once for a picture.
pub struct Setup<'a> {
    scene: Cow<'a, Scene>,
    pub view: View,
    pub grid: SampleGrid,
    pub appearance: Appearance,
    pub lighting: Lighting,
    /// The pictures that colours are, in exact pictures.
    textures: Textures,
    pub layout: Layout,
    pub shader: Shader,
    /// Back-facing faces are culled.
    is_culled: bool,
    /// Light brighter than white is kept until it is developed; otherwise it is clipped per sample,
    /// as in 1988.
    pub keeps_highlights: bool,
}

impl<'a> Setup<'a> {
    /// Prepares a scene. The options of the picture must have been checked.
    ///
    /// # Errors
    /// There is nothing to draw, the camera is invalid, or the scene cannot be drawn by rays.
    pub fn new(scene: &'a Scene, config: &Config) -> Result<Self, Error> {
        if scene.faces.is_empty() && scene.wires.is_empty() && !config.sky.is_some() {
            return Err(ugpicture::Error::Empty(WithoutFaces::new(scene)).into());
        }
        if config.exact.is_some() {
            ugscene::require_seen_geometry(scene)?;
        } else {
            ugscene::refuse_deferred_colors(scene)?;
            ugscene::refuse_whole_faces(scene)?;
        }
        let mut scene = drawable(scene);
        config.cut_rounds(&mut scene)?;
        if !scene.color_tables.is_empty() {
            uglight::freeze_colors_at_zero(scene.to_mut());
            scene.to_mut().color_tables.clear();
        }
        if config.repeat {
            ugscene::repeat_vertices(scene.to_mut(), true);
        }
        let shift = config.exact.unwrap_or(ColorShift::NONE);
        if scene.infrared != shift.infrared() {
            scene.to_mut().infrared = shift.infrared();
        }
        let PictureOptions { size: [width, height], samples, camera, .. } = &config.picture;
        let [width, height, samples] = [*width, *height, *samples];
        let view = View::new(&scene, camera, [width * samples, height * samples])?;
        ugscene::require_eye(&scene, view.eye)?;
        let fade = config.depth_cue.and_then(|cue| Some(cue.between(cue.range?)));
        let is_perspective = view.is_perspective;
        let tiles = if config.exact.is_some() { TileShape::Wide } else { TileShape::Tall };
        let grid = SampleGrid { width, height, samples, is_perspective, fade, tiles };
        // With -wi, numbers in the text of a scene at rest are wavelengths.
        let interpolation = config.interpolation.of_scene(&mut scene, config.hue_scale)?;
        let appearance = Appearance::new(&scene, view.eye, interpolation, shift, 1.0);
        let law = config.law(&scene);
        let lighting = Lighting::new(&scene, view.eye, view.forward, law, shift.is_spectral());
        let appearance =
            appearance.with_tables(lighting.colored_lamps().map_or(0, |lamps| lamps.len()));
        let palette = &appearance.palette;
        let keeps_highlights = palette.has_light || config.picture.keeps_light();
        if let Some(shift) = config.exact {
            check_exact(&scene, &view, shift)?;
            if appearance.surface.has_moving_spectra(&scene, &scene.wires, shift) {
                return Err(Error::ExactMovingSpectrum);
            }
        }
        if config.sky.is_some() {
            check_sky(&scene, &view, config)?;
        }
        let light = |color| uglight::RestColor::new(&scene, Some(color)).linear();
        let textures = match config.exact {
            Some(_) => {
                let memory = config.reading.limits.get(ugparse::Limit::Memory);
                Textures::new(&scene, memory, light)
                    .map_err(|error| Error::Picture(error.into()))?
            }
            None => Textures::default(),
        };
        let layout = match Layout::new(&scene, &appearance, &lighting) {
            // Texels are hues or light, and emitted light is added to light.
            Layout::Hues
                if !textures.is_empty()
                    || config.exact.is_some() && !scene.emissions.is_empty() =>
            {
                Layout::Mixed { has_levels: false }
            }
            layout => layout,
        };
        let shader =
            Shader::new(palette.interpolation, !keeps_highlights, law.acts_on_light(), layout);
        let is_culled = config.cull;
        Ok(Self {
            scene,
            view,
            grid,
            appearance,
            lighting,
            textures,
            layout,
            shader,
            is_culled,
            keeps_highlights,
        })
    }

    /// The scene, whose vertices are part of one body each. Faces and wires keep their order.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The view of the scene from which faces and lines are drawn.
    pub fn painter(&self) -> Painter<'_> {
        Painter {
            scene: &self.scene,
            view: &self.view,
            grid: &self.grid,
            appearance: &self.appearance,
            lighting: &self.lighting,
            textures: &self.textures,
            layout: self.layout,
            is_culled: self.is_culled,
        }
    }
}

/// Refuses orthographic projection and scenes whose colours would be shifted twice.
fn check_exact(scene: &Scene, view: &View, shift: ColorShift) -> Result<(), Error> {
    let deferred = scene.stage.deferred_colors().map(ColorShift::of_stage);
    let are_seen =
        scene.stage.seen_colors().is_some() || deferred.is_some_and(|deferred| deferred != shift);
    refuse([
        (are_seen, Error::ExactSeenColors),
        (ShownEffects::of(scene) != ShownEffects::default(), Error::ExactPartialGeometry),
        (!view.is_perspective, Error::ExactOrthographic),
    ])
}

/// Refuses a sky that cannot be seen so.
fn check_sky(scene: &Scene, view: &View, config: &Config) -> Result<(), SkyError> {
    refuse([
        (matches!(config.picture.output, Output::Vector(_)), SkyError::Vectors),
        (config.picture.background == Background::Transparent, SkyError::Transparent),
        (!view.is_perspective, SkyError::Orthographic),
        (ShownEffects::of(scene) != ShownEffects::default(), SkyError::PartialGeometry),
    ])
}

/// The scene with vertices of one body each; copied only if a vertex belongs to several bodies.
/// Moving bodies with rest shapes are drawn at rest.
fn drawable(scene: &Scene) -> Cow<'_, Scene> {
    let is_drawn_at_rest = ugscene::require_seen_geometry(scene).is_err();
    if ugscene::is_one_body(scene) && !is_drawn_at_rest {
        return Cow::Borrowed(scene);
    }
    let mut scene = scene.clone();
    if is_drawn_at_rest {
        let at_rest = scene.bodies.unstated();
        let faces = scene.faces.iter_mut().map(|face| &mut face.body);
        faces
            .chain(scene.wires.iter_mut().map(|wire| &mut wire.body))
            .for_each(|body| *body = at_rest);
    }
    ugscene::separate_bodies(&mut scene);
    Cow::Owned(scene)
}
