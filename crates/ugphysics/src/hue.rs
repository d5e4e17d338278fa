//! The map between hue and wavelength of the 1988 report, and the attenuation at the ends of the
//! visible spectrum.

/// One control point of the map between wavelength and hue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    /// Wavelength λ, nanometres.
    pub wavelength_nm: f64,
    /// Hue H, degrees.
    pub hue_deg: f64,
    /// dH/dλ at the point, degrees per nanometre.
    pub slope: f64,
}

/// The control points, from red to violet. Three of them are the primaries of the CIE 1931 RGB
/// colour space (700, 546.1 and 435.8 nm), at the hues red, green and blue.  Eq. (P16)
pub const CONTROL_POINTS: [ControlPoint; 7] = [
    ControlPoint { wavelength_nm: 780.0, hue_deg: -60.0, slope: 60.0 / (700.0 - 780.0) },
    ControlPoint { wavelength_nm: 700.0, hue_deg: 0.0, slope: 120.0 / (605.0 - 780.0) },
    ControlPoint { wavelength_nm: 605.0, hue_deg: 60.0, slope: 0.5 * 120.0 / (546.1 - 700.0) },
    ControlPoint { wavelength_nm: 546.1, hue_deg: 120.0, slope: 1.33 * 120.0 / (505.0 - 605.0) },
    ControlPoint { wavelength_nm: 505.0, hue_deg: 180.0, slope: 0.5 * 120.0 / (435.8 - 546.1) },
    ControlPoint { wavelength_nm: 435.8, hue_deg: 240.0, slope: 120.0 / (380.0 - 505.0) },
    ControlPoint { wavelength_nm: 380.0, hue_deg: 300.0, slope: 60.0 / (380.0 - 435.8) },
];

/// The longest wavelength of the map, nm; its hue is −60°.
pub const RED_END_NM: f64 = 780.0;

/// The shortest wavelength of the map, nm; its hue is 300°.
pub const VIOLET_END_NM: f64 = 380.0;

/// The hue, in degrees from −60 to 300, of monochromatic light.  Eq. (P16)
///
/// Strictly decreasing in the wavelength. Wavelengths outside 380…780 nm have no hue and are
/// clamped to the nearer end, 300° or −60°.
///
/// ```
/// use ugphysics::wavelength_to_hue;
///
/// assert_eq!(wavelength_to_hue(700.0), 0.0);
/// assert!((wavelength_to_hue(589.0) - 69.1338484669).abs() < 1e-9);
/// assert_eq!(wavelength_to_hue(1000.0), -60.0);
/// ```
pub fn wavelength_to_hue(wavelength_nm: f64) -> f64 {
    let wavelength_nm = wavelength_nm.clamp(VIOLET_END_NM, RED_END_NM);
    segment_where(|red, _| wavelength_nm >= red).hue(wavelength_nm)
}

/// The wavelength, in nanometres, of the spectral colour of a hue in degrees: the inverse of
/// [`wavelength_to_hue`], to rounding.  Eq. (P16)
///
/// Hues from −60 to 300 are used as they are, so −60 is 780 nm and 300 is 380 nm. Other hues are
/// first reduced to that range by whole turns: 330 is −30.
///
/// ```
/// use ugphysics::hue_to_wavelength;
///
/// assert_eq!(hue_to_wavelength(120.0), 546.1);
/// assert_eq!(hue_to_wavelength(330.0), hue_to_wavelength(-30.0));
/// assert_eq!(hue_to_wavelength(300.0), 380.0);
/// ```
pub fn hue_to_wavelength(hue_deg: f64) -> f64 {
    let hue_deg = spectral_hue(hue_deg);
    segment_where(|_, hue| hue_deg <= hue).wavelength_nm(hue_deg)
}

/// The factor by which a pure hue is dimmed near the ends of the visible spectrum: 1 from 435.8 to
/// 700 nm, falling linearly to 0 at 380 and at 780 nm, and 0 outside.  Eq. (P17)
///
/// Only the renderer applies it, per sample. A filter must not: a filter downstream may shift
/// invisible light back into the visible range.
///
/// ```
/// use ugphysics::attenuation;
///
/// assert_eq!(attenuation(550.0), 1.0);
/// assert_eq!(attenuation(740.0), 0.5);
/// assert_eq!(attenuation(379.0), 0.0);
/// ```
pub fn attenuation(wavelength_nm: f64) -> f64 {
    const FULL_FROM_NM: f64 = 435.8;
    const FULL_TO_NM: f64 = 700.0;
    let violet = (wavelength_nm - VIOLET_END_NM) / (FULL_FROM_NM - VIOLET_END_NM);
    let red = (RED_END_NM - wavelength_nm) / (RED_END_NM - FULL_TO_NM);
    violet.min(red).clamp(0.0, 1.0)
}

/// The hue reduced by whole turns to (−60, 300]. A hue already in [−60, 300] is unchanged.
fn spectral_hue(hue_deg: f64) -> f64 {
    if (-60.0..=300.0).contains(&hue_deg) {
        return hue_deg;
    }
    let hue_deg = hue_deg.rem_euclid(360.0);
    if hue_deg > 300.0 { hue_deg - 360.0 } else { hue_deg }
}

/// The first segment, from the red end, whose violet end (wavelength in nm, hue in degrees)
/// satisfies `reaches`; else the last segment.
fn segment_where(reaches: impl Fn(f64, f64) -> bool) -> Segment {
    let mut segments =
        CONTROL_POINTS.windows(2).map(|ends| Segment { red: ends[0], violet: ends[1] });
    let last = Segment { red: CONTROL_POINTS[5], violet: CONTROL_POINTS[6] };
    segments.find(|s| reaches(s.violet.wavelength_nm, s.violet.hue_deg)).unwrap_or(last)
}

/// The cubic Hermite curve between two control points, over s from 0 (its red end) to 1 (its violet
/// end).
struct Segment {
    red: ControlPoint,
    violet: ControlPoint,
}

impl Segment {
    /// Signed length in nm, violet less red: negative.
    fn span(&self) -> f64 {
        self.violet.wavelength_nm - self.red.wavelength_nm
    }

    fn hue(&self, wavelength_nm: f64) -> f64 {
        self.hue_at((wavelength_nm - self.red.wavelength_nm) / self.span())
    }

    fn hue_at(&self, s: f64) -> f64 {
        let rest = 1.0 - s;
        let ends = rest * rest * (1.0 + 2.0 * s) * self.red.hue_deg
            + s * s * (3.0 - 2.0 * s) * self.violet.hue_deg;
        ends + s * rest * self.span() * (rest * self.red.slope - s * self.violet.slope)
    }

    /// dH/ds, positive throughout.
    fn hue_slope_at(&self, s: f64) -> f64 {
        let rest = 1.0 - s;
        let ends = 6.0 * s * rest * (self.violet.hue_deg - self.red.hue_deg);
        ends + self.span()
            * (rest * (1.0 - 3.0 * s) * self.red.slope + s * (3.0 * s - 2.0) * self.violet.slope)
    }

    /// Newton's method, started from linear interpolation and safeguarded by bisection of a
    /// bracket.
    fn wavelength_nm(&self, hue_deg: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let mut s = (hue_deg - self.red.hue_deg) / (self.violet.hue_deg - self.red.hue_deg);
        // Newton needs about 5 steps; bisection alone would need 53.
        for _ in 0..53 {
            let excess = self.hue_at(s) - hue_deg;
            if excess == 0.0 || excess.is_nan() {
                break;
            }
            if excess > 0.0 {
                high = s
            } else {
                low = s
            }
            let newton = s - excess / self.hue_slope_at(s);
            let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
            let step = next - s;
            s = next;
            if step.abs() < f64::EPSILON {
                break;
            }
        }
        self.red.wavelength_nm + s * self.span()
    }
}
