//! Special relativity and colour physics as pure functions.
//!
//! What does a body look like that moves at nearly the speed of light? Three effects act between
//! the body and the picture, and each is one function here:
//!
//! * **where** it is seen ([`seen_position`]): light from its far parts left earlier, when the body
//!   was elsewhere. Length contraction and light travel time together are one Lorentz boost of the
//!   emission event;
//! * **in which colour** ([`doppler_factor`], [`wavelength_to_hue`]): every frequency is multiplied
//!   by D;
//! * **how bright** ([`Brightness`]): radiance is multiplied by a power of D, which depends on the
//!   quantity that brightness stands for.
//!
//! Before that, light fell on the body, possibly from a source that moves relative to it
//! ([`illumination`]). Colours that are a whole spectrum, and their X, Y, Z in motion, are in
//! [`spectrum`].
//!
//! # Conventions
//!
//! c = 1: speeds are fractions of the speed of light, and times and lengths share a unit. The eye
//! rests at the origin of the camera frame S and takes its picture at t = 0. A body rests in its
//! own frame S', which moves with velocity **v** in S; the axes are parallel and the origins
//! coincide at t = t' = 0. Every coordinate passed to this crate is relative to the eye.
//! Wavelengths are in nanometres, hues in degrees. Equation numbers like (P3) are those of
//! `docs/physics.md`, which derives them.
//!
//! # Guarantees
//!
//! * A [`Velocity`] is below the speed of light. Its constructors check this exactly and store γ.
//! * Nothing here panics, prints, or holds state; only constants are cached. Finite input gives
//!   finite output wherever the true value is finite; NaN gives NaN.
//! * No formula loses digits near the speed of light or near rest, and none switches to an
//!   approximation at small speeds: at rest the general formulas are the identity.
//! * The same input gives the same bits on every platform: transcendental functions come from
//!   `libm`.
//!
//! # Example
//!
//! A green point, four units ahead and one to the side, comes towards the eye at a tenth of the
//! speed of light:
//!
//! ```
//! use glam::DVec3;
//! use ugphysics::{Velocity, doppler_at, hue_to_wavelength, seen_position, wavelength_to_hue};
//!
//! let v = Velocity::from_beta(DVec3::new(-0.1, 0.0, 0.0))?;
//! let seen = seen_position(DVec3::new(4.0, 1.0, 0.0), v);
//! assert!((seen.x - 4.43453).abs() < 1e-5); // its light left when it was further away
//!
//! let doppler = doppler_at(seen, v);
//! let wavelength_nm = hue_to_wavelength(120.0) / doppler;
//! let hue = wavelength_to_hue(wavelength_nm);
//! assert!((doppler - 1.102).abs() < 1e-3); // blueshifted by a tenth
//! assert!(hue > 180.0); // towards blue
//! # Ok::<(), ugphysics::VelocityError>(())
//! ```

mod aberration;
mod ambient;
mod color;
mod doppler;
mod error_free;
mod fresnel;
mod hue;
mod hyperbolic;
mod illumination;
mod lorentz;
mod medium;
mod rest_frame;
mod retarded_position;
pub mod spectrum;
mod vector;
mod velocity;
mod world_line;
mod xyz;

pub use aberration::aberrate;
pub use ambient::{SkyRing, ambient_illumination};
pub use color::{Hsv, luminance, srgb_decode, srgb_encode};
pub use doppler::{Brightness, doppler_at, doppler_factor};
pub use fresnel::reflectance;
pub use hue::{
    CONTROL_POINTS, ControlPoint, RED_END_NM, VIOLET_END_NM, attenuation, hue_to_wavelength,
    wavelength_to_hue,
};
pub use hyperbolic::HyperbolicMotion;
pub use illumination::{
    IncidentLight, illumination, illumination_along, illumination_at, illumination_from_afar,
};
pub use lorentz::{Lorentz, compose, compose_rounded, wigner_rotation};
pub use medium::{Medium, WaveVector};
pub use rest_frame::RestFrame;
pub use retarded_position::{
    Event, contracted, elongated, flight_time, observer_shift, rest_position, seen_event,
    seen_position,
};
pub use vector::{angle, length, unit_or_zero};
pub use velocity::{Velocity, VelocityError};
pub use world_line::{
    ElementFrame, EmissionEvent, InertialFrame, Piece, Pose, RayPoint, RayStretch, SampledPath,
    SeenLight, SeenPoint, SeenTriangle, SmoothStretch, WorldLine, WorldLineError, WorldTube,
};
pub use xyz::{MOST_LIGHT, WHITE_XYZ, limited, linear_srgb_to_xyz, xyz_to_linear_srgb};
