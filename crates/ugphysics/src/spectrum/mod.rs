//! Spectra of surfaces and lights, Doppler-shifted and converted to CIE XYZ.
//!
//! Three numbers per colour do not determine what the colour looks like in motion: infrared light
//! is shifted into the visible range, and visible light out of it. So every colour becomes a
//! [`Spectrum`], a spectral radiance L'(λ) over all wavelengths. With Doppler factor D it is seen
//! as L(λ) = D⁵ L'(λD) (P12), whose integrals with the CIE 1931 observer are X, Y, Z (P19).
//!
//! * **Black bodies** remain black bodies: temperature T seen with D is D·T (P13).
//! * **Tables** of wavelength and radiance are used as given.
//! * **Surface colours** in red, green and blue are upsampled to a smooth reflectance under
//!   daylight (P20), which reproduces the same red, green and blue at rest.
//!
//! Each evaluation at a D is a sum over 471 wavelengths. For many values of D, a [`DopplerGrid`]
//! tabulates X, Y, Z over ln D. Surfaces under lamps, whose D differ, are sums over the nodes of a
//! [`SmoothCurve`].
//!
//! ```
//! use ugphysics::spectrum::Spectrum;
//!
//! // A lamp at 3000 K, seen with D = 2, has the colour of one at 6000 K.
//! let [x, y, z] = Spectrum::blackbody(3000.0, 1.0).seen(2.0);
//! let [x6, y6, z6] = Spectrum::blackbody(6000.0, 1.0).seen(1.0);
//! assert!((x / y - x6 / y6).abs() < 1e-12 && (z / y - z6 / y6).abs() < 1e-12);
//! ```
//!
//! # Units
//!
//! Wavelengths in nanometres, temperatures in kelvins. Y is relative: Y = 1 for a perfectly white
//! surface under the illuminant, for a table of value 1 at every wavelength, and for a black body
//! of scale 1, all at rest. Nothing here panics on finite input.

mod blackbody;
mod cie_1931;
mod curve;
mod daylight;
mod doppler_table;
mod dot;
mod foliage;
mod infrared;
mod light_spectrum;
mod observer;
mod quadrature;
mod radiance;
mod ranges;
mod reflectance;
mod samples;
mod smooth_curve;
mod uncertainty;
mod upsampling;
mod weighted_daylight;

pub use blackbody::planck;
pub use daylight::{DAYLIGHT_KELVIN, daylight};
pub use doppler_table::{DopplerGrid, DopplerTable, GridPlace, LN_STEP};
pub use infrared::InfraredRule;
pub use light_spectrum::LightSpectrum;
pub use observer::{integrate, observer};
pub use radiance::Spectrum;
pub use reflectance::Reflectance;
pub use smooth_curve::SmoothCurve;
pub use uncertainty::ColorClass;
