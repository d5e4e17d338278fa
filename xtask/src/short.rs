//! Numbers with few digits, as a person would type them.

use glam::DVec3;
use std::fmt;

/// Displays a number with at most 6 significant digits, without trailing zeros: `0.333333`, `-1.5`,
/// `2`.
///
/// Numbers below 10⁻⁹ are rounding errors and displayed as `0`.
pub struct Short(pub f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(x) = *self;
        if x.abs() < 1e-9 {
            return f.write_str("0");
        }
        let rounded: f64 = format!("{x:.5e}").parse().expect("Rust reads the numbers it writes");
        write!(f, "{rounded}")
    }
}

/// Displays a point as three [`Short`] numbers.
pub struct ShortPoint(pub DVec3);

impl fmt::Display for ShortPoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(p) = *self;
        write!(f, "{} {} {}", Short(p.x), Short(p.y), Short(p.z))
    }
}

#[cfg(test)]
mod tests {
    use super::Short;

    #[test]
    fn at_most_six_digits_and_no_padding() {
        #[track_caller]
        fn check(x: f64, expected: &str) {
            assert_eq!(Short(x).to_string(), expected);
        }
        check(2.0, "2");
        check(-1.5, "-1.5");
        check(1.0 / 3.0, "0.333333");
        check(1234567.0, "1234570");
        check(-0.0, "0");
        check(6.1e-17, "0");
        check(0.1 + 0.2, "0.3");
    }
}
