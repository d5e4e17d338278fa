//! Light of a scene: its lamps, the irradiance they cause, and what colours look like in motion.
//!
//! Several programs need the same answers. A filter that puts light into vertex colours, a renderer
//! that shades corners or samples, a program that refines edges where light changes: each asks
//! which [`Lamps`] a scene has, how much of their light falls on a surface ([`Lighting`] for lamps
//! at rest with what they light, [`SurfaceElement`] for lamps that move against it), and which
//! [`Hsv`], linear light or [`Spectrum`] a colour statement stands for ([`hsv`], [`color_form`],
//! [`spectrum`]).
//!
//! The effect of motion on a colour depends on the model: a [`HueColor`] has one wavelength, which
//! a [`HueShift`] divides by the Doppler factor D; a [`SpectralColor`] is shifted as a whole by a
//! [`SpectralShift`]; a [`ColorShift`] is either. All hold for a vertex, a sample or a ray.
//!
//! A renderer has the colours of a scene as an [`Appearance`]. It interpolates them between
//! corners; [`Appearance::seen`] is the apparent colour of a sample, which is lit afterwards, and
//! [`Appearance::light`] the light that a ray meets, of a [`SurfaceColor`] under lamps behind
//! filters.
//!
//! Physics without a scene is in `ugphysics`; this crate applies it to the statements of a
//! [`Scene`].
//!
//! ```
//! use glam::DVec3;
//! use uglight::Lamps;
//!
//! let source = ugparse::Source::new("lamp.ug", "c blue 1 240; l 0.5 0 0 1 blue;");
//! let scene = ugparse::parse(&source, &ugparse::Options::default())?.scene;
//! let lamp = &Lamps::new(&scene, DVec3::ZERO, false)[0];
//! // Light that comes in at 60 degrees to the normal.
//! let normal = DVec3::new(0.75f64.sqrt(), 0.0, 0.5);
//! assert_eq!(lamp.color, DVec3::new(0.0, 0.0, 0.5));
//! assert!((lamp.level_at_rest(DVec3::ZERO, normal, DVec3::ZERO) - 0.5).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Hsv`]: ugphysics::Hsv
//! [`Spectrum`]: ugphysics::spectrum::Spectrum
//! [`Scene`]: ugscene::Scene

mod appearance;
mod color;
mod color_lattice;
mod face_colors;
mod hue;
mod hue_table;
mod irradiance;
mod lamp;
mod light_names;
mod lighting;
mod own_time;
mod palette;
mod shift;
mod spectra;
mod spectral;
mod surface_attributes;
mod vertex_color;

pub use appearance::{Appearance, ColorFilter, Illumination, SurfaceColor};
pub use color::{
    ColorForm, Mixing, RestColor, color_form, display_hue, hsv, hsv_and_factor, mean_hue,
    spectra_note, spectrum,
};
pub use face_colors::FaceColors;
pub use hue::{HueColor, HueShift};
pub use irradiance::{IncidentLamp, Irradiance, ScatteringTime, SurfaceElement};
pub use lamp::{
    DEFAULT_AMBIENT, DEFAULT_FROM_EYE, FallOff, Lamp, LampPlace, LampTable, Lamps,
    has_colored_lamps,
};
pub use light_names::light_names;
pub use lighting::Lighting;
pub use own_time::{freeze_colors_at_zero, mean_color};
pub use palette::{Interpolation, Palette, Swatch};
pub use shift::ColorShift;
pub use spectra::SpectralRows;
pub use spectral::{SpectralColor, SpectralFilter, SpectralShift, sampled_wavelengths};
pub use surface_attributes::SurfaceAttributes;
pub use vertex_color::{VertexColor, vertex_colors};
