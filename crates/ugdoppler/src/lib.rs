//! Colours of a UniGrafix scene as seen in relativistic motion.
//!
//! [`apply`] gives every vertex the colour with which its body is seen from the eye. The hue
//! becomes a wavelength (P16), which is divided by the Doppler factor D (P10), (P11), and becomes a
//! hue again. The value is multiplied by D (P12). The saturation stays; a grey has no wavelength to
//! shift. The fading of hues towards infrared and ultraviolet (P17) is left to the renderer, which
//! applies it at every pixel.
//!
//! With [`Config::light`] the colours include the light of the scene's lamps. A lamp that moves
//! against a surface has a Doppler factor D_l of its own there, and shines from where it was at
//! emission (P14); D_l shifts and dims the colour as D does.
//!
//! With [`ColorShift::Spectra`] colours are spectra: of surfaces (P20), of black bodies (P13), or
//! given by samples. Each is shifted as a whole and multiplied by D⁵ (P12), and written as the X,
//! Y, Z that the eye makes of it (P19).
//!
//! Textures have no colours at vertices: where a face has one, the stage of the output says how the
//! renderer shifts the colours of the scene, with a ray for each sample.
//!
//! The input is what `uglorentz` writes: vertices where they are seen, faces with their velocity,
//! the eye in the camera.
//!
//! ```
//! let text = "(ugstage 1 geometry as-seen eye 0 0 0) c green 1 120;
//!     v a 9 0 0; v b 10 0 0; v c 10 1 0; f (a b c) green <-0.5 0 0>;";
//! let source = ugparse::Source::new("scene.ug", text);
//! let scene = ugparse::parse(&source, &ugparse::Options::default())?.scene;
//! let config = ugdoppler::Config { tolerance: 0.0, wavelengths: true, ..Default::default() };
//! let (scene, _) = ugdoppler::apply(scene, &config)?;
//! let seen = String::from_utf8(ugparse::write(&scene))?;
//! // It moves straight at the eye, so D = √3 and 546.1 nm is seen at 315.3 nm.
//! assert!(seen.contains("c green#1_73205080756887") && seen.contains(" 1 315.29098200445"), "{seen}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(feature = "cli")]
mod cli;
mod config;
mod digits;
mod error;
mod hue_statements;
mod irradiance;
mod notes;
mod quantization;
mod stage;
mod vertices;
mod xyz_statements;

use glam::DVec3;
use rayon::prelude::*;
use uglight::{
    ColorShift, HueColor, HueShift, Mixing, RestColor, SpectralColor, SpectralShift, VertexColor,
    hsv, hsv_and_factor,
};
use ugpipe::Progress;
use ugscene::{
    Camera, CameraError, CameraOptions, ColorId, ColorMix, ColorStage, DefaultCamera, HueScale,
    LightMotion, Projection, Provenance, RelativeMotion, RestFrames, Scene, SeenVertices,
    ShownEffects,
};
use ugskybox::SkyLamps;

#[cfg(feature = "cli")]
pub use cli::{Args, main};
pub use config::{Config, DEFAULT_TOLERANCE};
pub use error::Error;
pub use notes::Note;
pub use ugskybox::SceneSky;

use hue_statements::{HueStatements, LitColor};
use irradiance::VertexIrradiance;
use vertices::doppler_factors;
use xyz_statements::SpectralVertices;

/// This program, without a command line, for the history of what it makes.
pub const PROVENANCE: Provenance<'static> = Provenance {
    program: env!("CARGO_PKG_NAME"),
    version: env!("CARGO_PKG_VERSION"),
    command: None,
    files: &[],
};

/// The scene with a colour as seen on every vertex that a face or wire uses.
///
/// # Errors
/// See [`Error`].
pub fn apply(scene: Scene, config: &Config) -> Result<(Scene, Vec<Note>), Error> {
    apply_with(scene, config, &())
}

/// Like [`apply`], and reports progress.
///
/// # Errors
/// See [`Error`].
pub fn apply_with(
    mut scene: Scene,
    config: &Config,
    progress: &dyn Progress,
) -> Result<(Scene, Vec<Note>), Error> {
    progress.step("colouring", 0);
    let textures_note = textures_note(&scene, config);
    let is_deferred = matches!(textures_note, Some(Note::DeferredTextures { .. }));
    if !is_deferred {
        ugscene::refuse_whole_faces(&scene)?;
        let of_scene = scene.camera().and_then(|camera| camera.eye);
        ugscene::cut_rounds_at_rest(&mut scene, config.eye.or(of_scene))?;
    }
    scene.infrared = config.shift.infrared();
    uglight::freeze_colors_at_zero(&mut scene);
    // The light of coloured lamps multiplies spectra, which are not in the output.
    let is_lit = config.light || config.shift.is_spectral() && uglight::has_colored_lamps(&scene);
    let sky = if config.light { config.sky.lamps([1, SKY_POINTS])? } else { None };
    let sky = sky.map(|lamps| {
        let velocity = -ugscene::camera_velocity(&scene);
        (lamps, LightMotion::Body(scene.bodies.moving_with(velocity)))
    });
    let config = &Config { light: is_lit, ..config.clone() };
    let frames = RestFrames::with_default(&scene, config.velocity);
    let default_camera = default_camera(&scene, config, &frames);
    let eye = default_camera.map_or_else(|| ugscene::eye(&scene, config.eye), |camera| camera.eye);
    ugscene::require_colors_at_rest(&scene)?;
    ugscene::require_seen_geometry(&scene)?;
    ugscene::require_eye(&scene, eye)?;
    if let Some(vertex) = ugscene::vertex_at_eye(&scene, eye, &frames) {
        let name = scene.names.get(scene.vertices[vertex.index()].name).to_string();
        return Err(Error::VertexAtEye { vertex, name });
    }
    let is_taken_as_seen = !config.velocity.is_zero() && scene.stage.seen_geometry().is_none();
    let mut bodies =
        scene.faces.iter().map(|face| face.body).chain(scene.wires.iter().map(|wire| wire.body));
    let all_move = !config.velocity.is_zero()
        && bodies.all(|body| scene.bodies.stated_velocity(body).is_some());
    let (mut scene, mut notes) = if is_deferred {
        scene.stage.colors =
            ColorStage::Deferred(config.shift.seen_colors(HueScale::Degrees, false));
        (scene, Vec::new())
    } else {
        color(scene, (config, sky.as_ref()), eye, &frames, progress)?
    };
    notes.extend(textures_note);
    if is_taken_as_seen {
        notes.push(Note::TakenAsSeen);
    }
    if all_move {
        notes.push(Note::AllMove);
    }
    if let Some(camera) = default_camera {
        let (eye, center) = (Some(camera.eye), Some(camera.center));
        scene.cameras.push(Camera { eye, center, ..Camera::default() });
        notes.insert(0, Note::Scene(ugscene::Note::DefaultCamera(camera)));
    }
    if let Some(eye) = config.eye {
        set_eye(&mut scene, eye)?;
    }
    Ok((scene, notes))
}

/// What becomes of the textures of a scene: the renderer shifts all colours, unless something needs
/// colours at vertices.
fn textures_note(scene: &Scene, config: &Config) -> Option<Note> {
    let color = scene.drawn_texture_name().filter(|_| !config.no_textures)?.to_owned();
    let projection = scene.camera().and_then(|camera| camera.projection);
    let needs_vertices = config.wavelengths
        || config.iris
        || config.keep
        || !config.velocity.is_zero()
        || config.light && (ugscene::has_moving_lights(scene) || config.sky.is_some())
        || projection == Some(Projection::Orthographic)
        || ShownEffects::of(scene) != ShownEffects::default();
    Some(if needs_vertices {
        Note::PlainTextures { color }
    } else {
        Note::DeferredTextures { color }
    })
}

/// Writes the eye into the scene's camera if positions are as seen from it, so that programs
/// downstream use it.
fn set_eye(scene: &mut Scene, eye: DVec3) -> Result<(), CameraError> {
    if scene.stage.seen_geometry().is_none() {
        return Ok(());
    }
    if scene.cameras.is_empty() {
        scene.cameras.push(Camera::default());
    }
    let row = scene.camera_row().unwrap_or(0);
    scene.cameras[row].eye = Some(eye);
    scene.cameras[row].center.map_or(Ok(()), |center| ugscene::view_distance(eye, center).map(drop))
}

/// A sky as lights, and how they move.
type Sky = (SkyLamps, LightMotion);

/// The points of a sky that light a vertex.
const SKY_POINTS: usize = 128;

/// Most lights times lit vertices: about 3 GB.
const MAX_LIT: usize = 1 << 27;

/// The camera of a scene without one, if colours depend on the eye.
fn default_camera(scene: &Scene, config: &Config, frames: &RestFrames) -> Option<DefaultCamera> {
    if config.velocity.is_zero() && !config.light {
        return None;
    }
    let options = CameraOptions { eye: config.eye, ..CameraOptions::default() };
    let motion = |body| vec![RelativeMotion::new(frames.velocity(body), ShownEffects::default())];
    DefaultCamera::new(scene, &options, [4, 3], motion).ok().flatten()
}

fn color(
    mut scene: Scene,
    (config, sky): (&Config, Option<&Sky>),
    eye: DVec3,
    frames: &RestFrames,
    progress: &dyn Progress,
) -> Result<(Scene, Vec<Note>), Error> {
    let stage = stage::with_seen_colors(&scene, config, eye);
    ugscene::separate_bodies(&mut scene);
    ugscene::repeat_vertices(&mut scene, config.repeat);
    let mixing_note = ugscene::Note::mixed_colors(&scene);
    // Only for lamps, and for the angles at which colours of faces meet.
    let may_meet = || !config.repeat && scene.vertices.iter().any(|vertex| vertex.color.is_none());
    let needs_rest = config.light || may_meet();
    let seen = SeenVertices::new(&scene, eye, frames, needs_rest);
    let factors = doppler_factors(&scene, eye, frames, &seen);
    let vertices = (seen, factors);
    let shares = ugscene::vertex_mixes(&scene, &vertices.0.rest);
    let mut notes = if let ColorShift::Spectra(shift) = config.shift {
        let mut shares = shares.into_iter().map(|shares| shares.of_spectra(&scene)).collect();
        let (light, factors) = light_vertices(
            &mut scene,
            (config, sky),
            (eye, frames),
            vertices,
            &mut shares,
            progress,
        )?;
        let lit = light
            .map_or_else(Vec::new, |light| lit_spectra(&scene, shift, &shares, &factors, &light));
        let ln_factors = factors.par_iter().map(|&doppler| libm::log(doppler)).collect();
        let used = vertices::used(&scene);
        let vertices = SpectralVertices { shares: &shares, ln_factors, used, lit };
        xyz_statements::write(&mut scene, config, shift, &vertices)
    } else {
        let shift = config.shift.of_hues();
        let mut colors = uglight::vertex_colors(&scene, &shares);
        let (light, factors) = light_vertices(
            &mut scene,
            (config, sky),
            (eye, frames),
            vertices,
            &mut colors,
            progress,
        )?;
        let used = vertices::used(&scene);
        let lit = light.map(|light| lit_colors(&scene, shift, &colors, &factors, &light));
        let spectra_note = uglight::spectra_note(&scene);
        let mut statements = HueStatements::new(&mut scene, config, shift);
        for (row, (&color, &doppler)) in colors.iter().zip(&factors).enumerate() {
            match lit.as_ref().and_then(|lit| lit[row]) {
                _ if !used[row] => {}
                Some(lit) => statements.set_lit(row, color, lit),
                None => statements.set(row, color, doppler),
            }
        }
        statements.finish().into_iter().chain(spectra_note.map(Note::Scene)).collect()
    };
    notes.extend(mixing_note.map(Note::Scene));
    if config.light && scene.lights.is_empty() && sky.is_none() {
        notes.push(Note::NoLights);
    } else if config.light {
        irradiance::replace_lights(&mut scene);
    }
    scene.mixes.clear();
    scene.emissions.clear();
    scene.color_tables.clear();
    scene.stage = stage;
    Ok((scene, notes))
}

/// The irradiance of every vertex, if it is asked for and the scene has lamps, and the Doppler
/// factor of every vertex. Vertices where the irradiance differs between faces are repeated,
/// together with their row of `of_vertex`.
fn light_vertices<T: Clone>(
    scene: &mut Scene,
    (config, sky): (&Config, Option<&Sky>),
    (eye, frames): (DVec3, &RestFrames),
    (mut seen, mut factors): (SeenVertices, Vec<f64>),
    of_vertex: &mut Vec<T>,
    progress: &dyn Progress,
) -> Result<(Option<VertexIrradiance>, Vec<f64>), Error> {
    if !config.light || scene.lights.is_empty() && sky.is_none() {
        return Ok((None, factors));
    }
    let (originals, normals) = irradiance::split(scene, &seen, (eye, frames));
    for original in originals {
        seen.copy(original);
        factors.push(factors[original.index()]);
        of_vertex.push(of_vertex[original.index()].clone());
    }
    let n_of_sky = sky.map_or(0, |(lamps, _)| lamps.stars.len() + lamps.points.len());
    let (n_lights, n_vertices) = (scene.lights.len() + n_of_sky, normals.iter().flatten().count());
    if n_lights.saturating_mul(n_vertices) > MAX_LIT {
        return Err(Error::TooManyLights { n_lights, n_vertices });
    }
    let is_spectral = config.shift.is_spectral();
    let light =
        VertexIrradiance::new(scene, (eye, frames), &seen, &normals, (is_spectral, sky), progress);
    progress.check()?;
    Ok((Some(light), factors))
}

/// The colour as seen of every vertex with light on it; `None` where it is not lit.
///
/// One of a display stays red, green and blue where nothing shifts it, and it is mixed with other
/// colours in a face, or would be faded as a hue.
fn lit_colors(
    scene: &Scene,
    shift: HueShift,
    colors: &[VertexColor],
    factors: &[f64],
    light: &VertexIrradiance,
) -> Vec<Option<LitColor>> {
    let is_mixed = displays_in_mixtures(scene, colors);
    let all = colors.par_iter().zip(factors).zip(&light.of_vertex).zip(is_mixed);
    all.map(|(((&color, &doppler), parts), is_mixed)| {
        let (base, parts) = (hue_color(scene, shift, color), parts.as_ref()?);
        let is_display = is_mixed || base.is_faded() && color.mixing(scene) == Mixing::Display;
        let colors = || (color.at_rest(scene).linear(), base);
        let display =
            || shift.display_lit(colors(), doppler, parts, &light.lamps).map(HueColor::of_display);
        let display = if is_display { display() } else { None };
        let hue = || shift.seen_lit(base, doppler, parts, &light.lamps);
        Some(LitColor { seen: display.unwrap_or_else(hue), is_display: display.is_some() })
    })
    .collect()
}

/// For each vertex whether it has the colour of a display, and a face of it other colours as well.
fn displays_in_mixtures(scene: &Scene, colors: &[VertexColor]) -> Vec<bool> {
    let mut is_mixed = vec![false; colors.len()];
    if !scene.colors.iter().any(|color| Mixing::of(color) == Mixing::Display) {
        return is_mixed;
    }
    for face in &scene.faces {
        let corners = scene.face_corners(face);
        let of = |corner: &ugscene::VertexId| colors[corner.index()];
        if corners.iter().any(|corner| of(corner) != of(&corners[0])) {
            let displays =
                corners.iter().filter(|corner| of(corner).mixing(scene) == Mixing::Display);
            displays.for_each(|corner| is_mixed[corner.index()] = true);
        }
    }
    is_mixed
}

/// A colour at rest as `shift` requires it: with the factor of its linear light if the law acts on
/// that, else with a value that contains the factor.
pub(crate) fn hue_color(scene: &Scene, shift: HueShift, color: VertexColor) -> HueColor {
    match color {
        VertexColor::Named(id) if color.mixing(scene) == Mixing::Display => {
            uglight::display_hue(scene, id).into()
        }
        VertexColor::Named(id) if shift.law.acts_on_light() => {
            let (hsv, factor) = hsv_and_factor(scene, &scene.colors[id.index()]);
            HueColor { factor, ..hsv.into() }
        }
        VertexColor::Named(id) => hsv(scene, &scene.colors[id.index()]).into(),
        VertexColor::White => RestColor::WHITE.hsv.into(),
        VertexColor::Mixed(color) => color.hsv.into(),
    }
}

/// X, Y, Z as seen of every vertex with light on it; `None` where it is not lit.
fn lit_spectra(
    scene: &Scene,
    shift: SpectralShift,
    shares: &[ColorMix],
    factors: &[f64],
    light: &VertexIrradiance,
) -> Vec<Option<[f64; 3]>> {
    let ids = (0..scene.colors.len()).map(|row| Some(ColorId::from_index(row)));
    // White comes first, see `xyz_statements::row`.
    let colors: Vec<SpectralColor> =
        std::iter::once(None).chain(ids).map(|id| SpectralColor::new(scene, id)).collect();
    let all = shares.par_iter().zip(factors).zip(&light.of_vertex);
    all.map(|((shares, &doppler), parts)| {
        let parts = parts.as_ref()?;
        let sum = shares.parts().fold(DVec3::ZERO, |sum, (color, share)| {
            let surface = colors[xyz_statements::row(color)].spectrum();
            sum + share * shift.seen_lit(surface, doppler, parts, &light.lamps, &[])
        });
        Some(xyz_statements::finite(sum.to_array()))
    })
    .collect()
}
