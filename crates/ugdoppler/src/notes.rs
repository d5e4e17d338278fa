//! Notes for the user on values above 1.

pub(crate) fn scaled(largest: f64) -> String {
    format!("max intensity is {}, scaled to 1.0", shown(largest))
}

pub(crate) fn clipped(largest: f64) -> String {
    format!("max intensity is {}, clip to 1.0", shown(largest))
}

pub(crate) fn kept(largest: f64) -> String {
    format!("max intensity is {}, kept for the renderer; -ir scales it to 1.0", shown(largest))
}

/// A value with about three significant digits.
fn shown(value: f64) -> String {
    if value < 10.0 {
        format!("{value:.2}")
    } else if value < 1e6 {
        format!("{value:.0}")
    } else {
        format!("{value:.2e}")
    }
}
