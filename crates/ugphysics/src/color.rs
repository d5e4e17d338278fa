//! Colours as hue, saturation and value, and the sRGB coding of light.

/// A colour as the hexcone model of Smith 1978 has it, over display-encoded RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hsv {
    /// Degrees: 0 red, 120 green, 240 blue; any number of turns.
    pub hue: f64,
    /// 0 (grey) to 1 (pure).
    pub saturation: f64,
    /// 0 (black) upwards; 1 is the brightest a display shows.
    pub value: f64,
}

impl Hsv {
    /// Red, green and blue, display-encoded, each from 0 to [`Hsv::value`].
    ///
    /// ```
    /// use ugphysics::Hsv;
    ///
    /// let orange = Hsv { hue: 30.0, saturation: 1.0, value: 1.0 };
    /// assert_eq!(orange.to_rgb(), [1.0, 0.5, 0.0]);
    /// ```
    #[must_use]
    #[inline]
    pub fn to_rgb(self) -> [f64; 3] {
        let sixth = within_a_turn(self.hue) / 60.0;
        // How far each primary is from its own sixths of the circle, 0 inside to 1 two sixths away.
        [0.0, 2.0, 4.0].map(|primary| {
            let apart = (sixth - primary).abs();
            let away = (apart.min(6.0 - apart) - 1.0).clamp(0.0, 1.0);
            self.value - self.value * self.saturation * away
        })
    }

    /// What the eye sees of it: of the white and the pure hue that it is made of, V(1 − S) and V S, the hue
    /// times `attenuation`, 0 to 1, of its wavelength.  Eq. (P17)
    ///
    /// ```
    /// use ugphysics::Hsv;
    ///
    /// let pale = Hsv { hue: 300.0, saturation: 0.25, value: 1.0 };
    /// assert_eq!(pale.attenuated(0.0), Hsv { hue: 300.0, saturation: 0.0, value: 0.75 });
    /// assert_eq!(pale.attenuated(1.0), pale);
    /// ```
    #[must_use]
    #[inline]
    pub fn attenuated(self, attenuation: f64) -> Hsv {
        let pure = self.saturation * attenuation;
        // Exactly 1 if nothing is attenuated, and the attenuation of a pure hue.
        let kept = (1.0 - self.saturation) + pure;
        Hsv { saturation: if pure > 0.0 { pure / kept } else { 0.0 }, value: self.value * kept, ..self }
    }

    /// The colour of the same hue that [`Hsv::attenuated`] makes this one; or, if that is of a value above `limit`,
    /// the nearest to it that is not, with the same white. Above its own value nothing is limited.  Eq. (P17)
    ///
    /// ```
    /// use ugphysics::Hsv;
    ///
    /// let pale = Hsv { hue: 270.0, saturation: 0.25, value: 1.0 };
    /// assert_eq!(pale.attenuated(0.5).unattenuated(0.5, 1.0), pale);
    /// ```
    #[must_use]
    pub fn unattenuated(self, attenuation: f64, limit: f64) -> Hsv {
        if self.value * self.saturation <= 0.0 {
            return self;
        }
        let white = self.value * (1.0 - self.saturation);
        let pure = self.value * self.saturation;
        let pure = (pure / attenuation).min((limit - white).max(pure));
        Hsv { saturation: pure / (white + pure), value: white + pure, ..self }
    }

    /// The hue, saturation and value of display-encoded red, green and blue, none of them negative. The hue is
    /// above −60 and at most 300, as [`crate::hue_to_wavelength`] has it, and 0 for greys; the saturation of black
    /// is 0.
    ///
    /// ```
    /// use ugphysics::Hsv;
    ///
    /// let pink = Hsv::from_rgb([1.0, 0.5, 0.75]);
    /// assert_eq!(pink, Hsv { hue: -30.0, saturation: 0.5, value: 1.0 });
    /// ```
    #[must_use]
    pub fn from_rgb(rgb: [f64; 3]) -> Hsv {
        let [red, green, blue] = rgb;
        let value = red.max(green).max(blue);
        let chroma = value - red.min(green).min(blue);
        if chroma <= 0.0 {
            return Hsv { hue: 0.0, saturation: 0.0, value };
        }
        let hue = if value == red {
            60.0 * ((green - blue) / chroma)
        } else if value == green {
            120.0 + 60.0 * ((blue - red) / chroma)
        } else {
            240.0 + 60.0 * ((red - green) / chroma)
        };
        // Red comes first above, so magenta came out as −60; it is violet, the other end.
        let hue = if hue <= -60.0 { hue + 360.0 } else { hue };
        Hsv { hue, saturation: chroma / value, value }
    }
}

/// The same hue in 0…360 degrees. Nearly all are within a turn, where no slow remainder is needed for the same bits.
#[inline]
fn within_a_turn(hue: f64) -> f64 {
    if (0.0..360.0).contains(&hue) {
        hue
    } else if (-360.0..0.0).contains(&hue) {
        hue + 360.0
    } else {
        hue.rem_euclid(360.0)
    }
}

/// Linear light from a display-encoded sRGB value (IEC 61966-2-1). 0 and 1 stay; values above 1 follow the
/// curve, values below 0 its straight part.
///
/// ```
/// assert!((ugphysics::srgb_decode(0.5) - 0.21404114).abs() < 1e-8);
/// ```
#[must_use]
pub fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) }
}

/// The display-encoded sRGB value of linear light (IEC 61966-2-1), the inverse of [`srgb_decode`].
///
/// ```
/// assert!((ugphysics::srgb_encode(0.18) - 0.46135612).abs() < 1e-8);
/// ```
#[must_use]
pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= 0.0031308 { linear * 12.92 } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// Relative luminance Y of linear red, green and blue with the sRGB primaries (ITU-R BT.709): white is 1.
///
/// ```
/// assert_eq!(ugphysics::luminance([0.0, 1.0, 0.0]), 0.7152);
/// ```
#[must_use]
pub fn luminance(linear_rgb: [f64; 3]) -> f64 {
    let [red, green, blue] = linear_rgb;
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}
