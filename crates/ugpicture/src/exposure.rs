//! How light is brought into the range of a display.

/// The factor by which light is multiplied before it is displayed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// 2 to this power.
    Stops(f64),
    /// Chosen so that 99 of 100 pixels are at or below white, see [`ugimage::auto_exposure`].
    Auto,
}
