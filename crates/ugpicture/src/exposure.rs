//! How light is brought into the range of a display.

/// The factor by which light is multiplied before it is displayed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// 2 to this power.
    Stops(f64),
    /// Chosen so that hardly any pixel is white, and the median is not bright; see
    /// [`ugimage::auto_exposure`].
    Auto,
}
