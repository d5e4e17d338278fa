//! Colours as hue, saturation and value, and the sRGB transfer function.

/// A colour in the hexcone model (HSV, Smith 1978), over display-encoded RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hsv {
    /// Hue in degrees: 0 red, 120 green, 240 blue. Any number of whole turns may be added.
    pub hue: f64,
    /// 0 (grey) to 1 (pure).
    pub saturation: f64,
    /// 0 (black) or more; 1 is the brightest a display can show.
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
    #[inline]
    pub fn to_rgb(self) -> [f64; 3] {
        let sixth = within_a_turn(self.hue) / 60.0;
        // For each primary: 0 within 60° of its hue, rising linearly to 1 at 120° and beyond.
        [0.0, 2.0, 4.0].map(|primary| {
            let apart = (sixth - primary).abs();
            let away = (apart.min(6.0 - apart) - 1.0).clamp(0.0, 1.0);
            self.value - self.value * self.saturation * away
        })
    }

    /// The colour with its pure hue attenuated. A colour is a sum of white, V(1 − S), and of a pure
    /// hue, V S; the pure hue is multiplied by `attenuation` (0 to 1, from [`crate::attenuation`]
    /// of its wavelength) and the white is kept.  Eq. (P17)
    ///
    /// ```
    /// use ugphysics::Hsv;
    ///
    /// let pale = Hsv { hue: 300.0, saturation: 0.25, value: 1.0 };
    /// assert_eq!(pale.attenuated(0.0), Hsv { hue: 300.0, saturation: 0.0, value: 0.75 });
    /// assert_eq!(pale.attenuated(1.0), pale);
    /// ```
    #[inline]
    pub fn attenuated(self, attenuation: f64) -> Hsv {
        let pure = self.saturation * attenuation;
        // In this form `kept` is exactly 1 for attenuation 1, and exactly `attenuation` for
        // saturation 1.
        let kept = (1.0 - self.saturation) + pure;
        Hsv {
            saturation: if pure > 0.0 { pure / kept } else { 0.0 },
            value: self.value * kept,
            ..self
        }
    }

    /// The inverse of [`Hsv::attenuated`]: the colour of the same hue and the same white part that
    /// `attenuated` turns into this one. Its value is limited to `limit`, or to the value of this
    /// colour if that is larger.  Eq. (P17)
    ///
    /// ```
    /// use ugphysics::Hsv;
    ///
    /// let pale = Hsv { hue: 270.0, saturation: 0.25, value: 1.0 };
    /// assert_eq!(pale.attenuated(0.5).unattenuated(0.5, 1.0), pale);
    /// ```
    pub fn unattenuated(self, attenuation: f64, limit: f64) -> Hsv {
        if self.value * self.saturation <= 0.0 {
            return self;
        }
        let white = self.value * (1.0 - self.saturation);
        let pure = self.value * self.saturation;
        let pure = (pure / attenuation).min((limit - white).max(pure));
        Hsv { saturation: pure / (white + pure), value: white + pure, ..self }
    }

    /// The hue, saturation and value of display-encoded red, green and blue, which must not be
    /// negative. The hue is in (−60, 300], the range of [`crate::hue_to_wavelength`], and 0 for
    /// greys. Black has saturation 0.
    ///
    /// ```
    /// use ugphysics::Hsv;
    ///
    /// let pink = Hsv::from_rgb([1.0, 0.5, 0.75]);
    /// assert_eq!(pink, Hsv { hue: -30.0, saturation: 0.5, value: 1.0 });
    /// ```
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
        // The red branch gives −60 for magenta; use 300 instead, the violet end of the range.
        let hue = if hue <= -60.0 { hue + 360.0 } else { hue };
        Hsv { hue, saturation: chroma / value, value }
    }
}

/// The same hue in 0…360 degrees. Most hues are within one turn of that range; an addition gives
/// them the same bits as the slow remainder would.
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

/// Linear light from a display-encoded sRGB value (IEC 61966-2-1). Maps 0 to 0 and 1 to 1. Values
/// above 1 continue the power curve, values below 0 the linear part.
///
/// ```
/// assert!((ugphysics::srgb_decode(0.5) - 0.21404114).abs() < 1e-8);
/// ```
pub fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) }
}

/// The display-encoded sRGB value of linear light (IEC 61966-2-1): the inverse of [`srgb_decode`].
///
/// ```
/// assert!((ugphysics::srgb_encode(0.18) - 0.46135612).abs() < 1e-8);
/// ```
pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= 0.0031308 { linear * 12.92 } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// Relative luminance Y of linear red, green and blue with the sRGB primaries (ITU-R BT.709): white
/// is 1.
///
/// ```
/// assert_eq!(ugphysics::luminance([0.0, 1.0, 0.0]), 0.7152);
/// ```
pub fn luminance(linear_rgb: [f64; 3]) -> f64 {
    let [red, green, blue] = linear_rgb;
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}
