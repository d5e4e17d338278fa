//! How light is brought into the range of a display.

use std::borrow::Borrow;

use ugimage::{Development, LinearFrame, Tone, auto_exposure};

/// The factor by which light is multiplied before it is displayed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// 2 to this power.
    Stops(f64),
    /// Chosen so that 99 of 100 pixels are at or below white, see [`ugimage::auto_exposure`].
    Auto,
}

impl Exposure {
    /// Exposure and tone curve together. `frame`: the light of the picture, which is computed for
    /// [`Exposure::Auto`] alone.
    pub fn development<F: Borrow<LinearFrame>>(
        exposure: Option<Self>,
        tone: Tone,
        frame: impl FnOnce() -> F,
    ) -> Development {
        let stops = match exposure {
            None => 0.0,
            Some(Self::Stops(stops)) => stops,
            Some(Self::Auto) => auto_exposure(frame().borrow(), tone),
        };
        Development { stops, tone }
    }
}
