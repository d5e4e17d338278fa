//! Numbers in messages.

use glam::DVec3;

/// A point as three numbers; very small and very large ones with an exponent.
pub(crate) fn point(p: DVec3) -> String {
    let number = |x: f64| format!("{x:?}").trim_end_matches(".0").to_owned();
    p.to_array().map(number).join(" ")
}
