//! Images in memory, from light to what a display shows.
//!
//! A [`LinearFrame`] holds linear light: red, green and blue of the sRGB primaries, unclipped, and
//! any number of extra channels. A [`Filter`] weights the samples that a pixel is made of. A
//! [`Development`] converts light for a display: exposure, tone mapping, and gamut mapping that
//! preserves hue.
//!
//! A [`Frame`] holds display-encoded pixels: four bytes per pixel, red, green, blue and alpha, the
//! colours encoded with the sRGB transfer function. All computations use linear light. Only
//! [`Quantizer`] converts it to bytes, and it rounds exactly to the nearest of the 256 levels.
//!
//! Light of half the white point, and twice as much of it by an exposure of one stop:
//!
//! ```
//! use ugframe::{Development, LinearFrame, Tone};
//!
//! let half = LinearFrame::new([1, 1], true, vec![[0.5, 0.5, 0.5, 1.0]]);
//! assert_eq!(half.to_display().pixels(), [[188, 188, 188, 255]]);
//! let brighter = Development { stops: 1.0, tone: Tone::Clip };
//! assert_eq!(brighter.apply([0.5; 3]), [1.0; 3]);
//! ```

mod develop;
mod filter;
mod frame;
mod linear;
mod quantizer;

pub use develop::{Development, DevelopmentSteps, Tone, auto_exposure};
pub use filter::Filter;
pub use frame::Frame;
pub use linear::{LinearFrame, Plane, Samples, display_pixel};
pub use quantizer::{Quantizer, ROUNDING_OFFSET};
