//! Sides of pictures, in pixels or as lengths.

/// Pixels in an inch of a picture whose size is a length.
pub const PIXELS_PER_INCH: f64 = 300.0;

/// A side of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side {
    /// Pixels, or points of vector graphics; 1 or more.
    Whole(u32),
    /// A length in inches, above 0.
    Inches(f64),
}

impl Side {
    /// The number of pixels, or of points, of which `per_inch` are an inch; 1 or more.
    pub fn at(self, per_inch: f64) -> u32 {
        match self {
            Self::Whole(number) => number,
            // The cast saturates.
            Self::Inches(inches) => ((inches * per_inch).round() as u32).max(1),
        }
    }

    /// True for a length.
    pub fn is_length(self) -> bool {
        matches!(self, Self::Inches(_))
    }

    /// Width and height in pixels, or in points, of which `per_inch` are an inch.
    ///
    /// # Errors
    /// One side is a length and the other is not.
    pub fn both(sides: &[Self], per_inch: f64) -> Result<[u32; 2], String> {
        let &[width, height] = sides else { return Err("-sz has a width and a height".to_owned()) };
        if width.is_length() == height.is_length() {
            return Ok([width, height].map(|side| side.at(per_inch)));
        }
        Err("-sz: one side has a unit and the other has none: write both as lengths, 8.6cm 6cm, or both \
             without units"
            .to_owned())
    }

    /// Value parser of sides: `800`, `8.6cm`.
    ///
    /// # Errors
    /// No whole number, and no length of at most 1000 inches.
    pub fn parse(word: &str) -> Result<Self, String> {
        const UNITS: [(&str, f64); 4] = [("mm", 25.4), ("cm", 2.54), ("in", 1.0), ("pt", 72.0)];
        let length =
            UNITS.iter().find_map(|(unit, per_inch)| Some((word.strip_suffix(unit)?, per_inch)));
        let Some((number, per_inch)) = length else {
            let number = word.parse().ok().filter(|&number| number >= 1).map(Self::Whole);
            return number
                .ok_or_else(|| "must be a whole number, 1 or more, or a length: 6cm".to_owned());
        };
        let inches = number.parse().map(|number: f64| number / per_inch);
        // NaN is outside.
        let inches = inches.ok().filter(|inches| *inches > 0.0 && *inches <= 1000.0);
        inches
            .map(Self::Inches)
            .ok_or_else(|| "must be a length above 0 and of at most 1000 in".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_have_units_or_neither() {
        let both = |[width, height]: [&str; 2], per_inch| {
            Side::both(&[Side::parse(width).unwrap(), Side::parse(height).unwrap()], per_inch)
        };
        assert_eq!(both(["8.6cm", "60mm"], 300.0), Ok([1016, 709]));
        assert_eq!(both(["1in", "72pt"], 72.0), Ok([72, 72]));
        assert_eq!(both(["640", "480"], 300.0), Ok([640, 480]));
        for mixed in [["8.6cm", "600"], ["600", "8.6cm"]] {
            assert!(both(mixed, 300.0).unwrap_err().contains("write both as lengths"));
        }
    }
}
