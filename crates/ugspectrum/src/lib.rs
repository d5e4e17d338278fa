//! Spectra of surfaces and of light, shifted by the Doppler effect and weighed by the eye.
//!
//! A colour of three numbers does not say what it looks like in motion: light that was infrared comes into
//! view, and what was visible leaves it. So every colour becomes a [`Spectrum`] L'(λ) over all wavelengths. Seen
//! with Doppler factor D it is L(λ) = D⁵ L'(λD) (P12), and the eye makes X, Y, Z of it (P19).
//!
//! * **Black bodies** stay black bodies: T seen with D is D·T (P13).
//! * **Tables** of wavelength and radiance are taken as they are.
//! * **Surface colours** in red, green and blue are raised to a smooth reflectance under daylight (P20), and give
//!   back their own red, green and blue at rest.
//!
//! Asking for one D is a sum over 471 wavelengths. For many, a [`Grid`] makes tables of X, Y, Z over ln D.
//!
//! ```
//! use ugspectrum::Spectrum;
//!
//! // A lamp at 3000 K, seen with D = 2, has the colour of one at 6000 K.
//! let [x, y, z] = Spectrum::blackbody(3000.0, 1.0).seen(2.0);
//! let [x6, y6, z6] = Spectrum::blackbody(6000.0, 1.0).seen(1.0);
//! assert!((x / y - x6 / y6).abs() < 1e-12 && (z / y - z6 / y6).abs() < 1e-12);
//! ```
//!
//! # Units
//!
//! Wavelengths in nanometres, temperatures in kelvins. Y is relative: 1 is a perfectly white surface under the
//! illuminant, an equal-energy table of value 1, a black body of scale 1 at rest. Nothing here panics on finite
//! input.

mod blackbody;
mod cie_1931;
mod daylight;
mod lamplight;
mod nodes;
mod observer;
mod reflectance;
mod samples;
mod shifted;
mod solve;
mod spectrum;

pub use blackbody::{blackbody_luminance_ratio, planck};
pub use daylight::{DAYLIGHT_KELVIN, daylight};
pub use lamplight::Lamplight;
pub use observer::{integrate, observer};
pub use reflectance::Reflectance;
pub use shifted::{Grid, LN_STEP, Shifted};
pub use spectrum::Spectrum;
