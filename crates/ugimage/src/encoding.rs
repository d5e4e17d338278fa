//! How the numbers of a picture stand for light: colour profiles, gamma and chromaticities, where
//! they differ from sRGB.
//!
//! Not with a crate for colour management: those compute with the vector instructions and functions
//! of the platform, so results differ, and cost more than what is read here: curves and a matrix.

use glam::{DMat3, DVec3};
use libm::pow;
use ugphysics::{srgb_decode, xyz_to_linear_srgb};

use crate::pixels::Pixels;

/// The light that the numbers of a picture stand for.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Encoding {
    /// Of red, green and blue.
    curves: [Curve; 3],
    /// From the linear light of the picture.
    srgb_from_light: DMat3,
}

/// Linear light from an encoded number, both from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
enum Curve {
    Srgb,
    Gamma(f64),
    /// The kinds 1 to 4 of parametric curves: g, a, b, c, d, e, f.
    Parametric([f64; 7]),
    Table(Vec<f64>),
}

impl Curve {
    fn decode(&self, encoded: f64) -> f64 {
        match self {
            Self::Srgb => srgb_decode(encoded),
            Self::Gamma(gamma) => pow(encoded.max(0.0), *gamma),
            Self::Parametric([g, a, b, c, d, e, f]) => {
                if encoded >= *d {
                    pow((a * encoded + b).max(0.0), *g) + e
                } else {
                    c * encoded + f
                }
            }
            Self::Table(rows) => {
                let place = encoded.clamp(0.0, 1.0) * (rows.len() - 1) as f64;
                let row = (place as usize).min(rows.len().saturating_sub(2));
                let next = rows[(row + 1).min(rows.len() - 1)];
                rows[row] + (place - row as f64) * (next - rows[row])
            }
        }
    }
}

/// Largest difference from sRGB, in encoded numbers and in parts of the matrix, that is ignored:
/// profiles of sRGB differ in their rounding.
const SAME: f64 = 4e-3;

impl Encoding {
    fn new(curves: [Curve; 3], srgb_from_light: DMat3) -> Option<Self> {
        let levels = (0..=16).map(|level| f64::from(level) / 16.0);
        let is_srgb = |curve: &Curve| {
            levels.clone().all(|level| (curve.decode(level) - srgb_decode(level)).abs() < SAME)
        };
        let is_same =
            curves.iter().all(is_srgb) && srgb_from_light.abs_diff_eq(DMat3::IDENTITY, SAME);
        (!is_same).then_some(Self { curves, srgb_from_light })
    }

    /// That of chromaticities x, y of red, green, blue and white, in linear light or encoded with a
    /// gamma; `None` for sRGB or if they are impossible.
    pub fn from_chromaticities(primaries: [[f64; 2]; 4], gamma: Option<f64>) -> Option<Self> {
        let [xw, yw] = primaries[3];
        let white = DVec3::new(xw / yw, 1.0, (1.0 - xw - yw) / yw);
        let columns = [0, 1, 2].map(|idx| {
            let [x, y] = primaries[idx];
            DVec3::new(x, y, 1.0 - x - y)
        });
        let primaries = DMat3::from_cols(columns[0], columns[1], columns[2]);
        // With X, Y and Z as primaries, the channels are X, Y and Z, whatever white is stated.
        let amounts =
            if primaries == DMat3::IDENTITY { DVec3::ONE } else { primaries.inverse() * white };
        let xyz_from_light = primaries * DMat3::from_diagonal(amounts);
        let curve = gamma.map_or(Curve::Gamma(1.0), |gamma| {
            if (gamma - SRGB_GAMMA).abs() < 0.1 { Curve::Srgb } else { Curve::Gamma(gamma) }
        });
        let matrix = srgb_from_xyz() * xyz_from_light;
        let matrix =
            if matrix.abs_diff_eq(DMat3::IDENTITY, SAME) { DMat3::IDENTITY } else { matrix };
        if !matrix.is_finite() {
            return None;
        }
        let curves = [curve.clone(), curve.clone(), curve];
        // Linear light is sRGB, too, where no gamma is expected.
        match gamma {
            None if matrix == DMat3::IDENTITY => None,
            None => Some(Self { curves, srgb_from_light: matrix }),
            Some(_) => Self::new(curves, matrix),
        }
    }

    /// That of an ICC profile; `None` for sRGB.
    ///
    /// # Errors
    /// Says why the profile is not used.
    pub fn from_icc(profile: &[u8]) -> Result<Option<Self>, &'static str> {
        const BAD: &str = "is damaged";
        let number = |at: usize| profile.get(at..at + 4)?.try_into().ok().map(u32::from_be_bytes);
        let fixed = |at: usize| number(at).map(|bits| f64::from(bits as i32) / 65536.0);
        let tag = |name: &[u8; 4]| {
            let count = number(128)?.min(100) as usize;
            let entry = (0..count)
                .map(|idx| 132 + 12 * idx)
                .find(|&at| profile.get(at..at + 4) == Some(name))?;
            Some(number(entry + 4)? as usize)
        };
        let curve = |name: &[u8; 4]| {
            let at = tag(name)?;
            match profile.get(at..at + 4)? {
                b"curv" => match number(at + 8)? as usize {
                    0 => Some(Curve::Gamma(1.0)),
                    1 => Some(Curve::Gamma(f64::from(number(at + 12)? >> 16) / 256.0)),
                    count => {
                        let rows =
                            profile.get(at + 12..at + 12 + 2 * count.min(1 << 16))?.chunks_exact(2);
                        let row =
                            |row: &[u8]| f64::from(u16::from_be_bytes([row[0], row[1]])) / 65535.0;
                        Some(Curve::Table(rows.map(row).collect()))
                    }
                },
                b"para" => {
                    let part = |idx: usize| fixed(at + 12 + 4 * idx);
                    let [g, a, b, c, d] = [part(0)?, part(1)?, part(2)?, part(3)?, part(4)?];
                    Some(match number(at + 8)? >> 16 {
                        0 => Curve::Gamma(g),
                        1 => Curve::Parametric([g, a, b, 0.0, -b / a, 0.0, 0.0]),
                        2 => Curve::Parametric([g, a, b, 0.0, -b / a, c, c]),
                        3 => Curve::Parametric([g, a, b, c, d, 0.0, 0.0]),
                        4 => Curve::Parametric([g, a, b, c, d, part(5)?, part(6)?]),
                        _ => return None,
                    })
                }
                _ => None,
            }
        };
        let column = |name: &[u8; 4]| {
            let at = tag(name)?;
            Some(DVec3::new(fixed(at + 8)?, fixed(at + 12)?, fixed(at + 16)?))
        };
        match profile.get(16..20) {
            Some(b"RGB ") => {}
            Some(b"GRAY") => {
                let curve = curve(b"kTRC").ok_or(BAD)?;
                return Ok(Self::new([curve.clone(), curve.clone(), curve], DMat3::IDENTITY));
            }
            Some(_) => return Err("is not for red, green and blue"),
            None => return Err(BAD),
        }
        let [red, green, blue] = [column(b"rXYZ"), column(b"gXYZ"), column(b"bXYZ")];
        let (Some(red), Some(green), Some(blue)) = (red, green, blue) else {
            return Err("has tables in place of curves and primaries");
        };
        let curves =
            [curve(b"rTRC").ok_or(BAD)?, curve(b"gTRC").ok_or(BAD)?, curve(b"bTRC").ok_or(BAD)?];
        // Profiles relate colours to D50, sRGB's own as well.
        let matrix = XYZ_D50_FROM_SRGB.inverse() * DMat3::from_cols(red, green, blue);
        if matrix.is_finite() { Ok(Self::new(curves, matrix)) } else { Err(BAD) }
    }

    /// The light of pixels that are encoded so, or that hold this linear light.
    pub fn light(&self, pixels: Pixels) -> Vec<[f32; 4]> {
        let srgb = |light: [f64; 3], alpha: f32| {
            let [red, green, blue] = (self.srgb_from_light * DVec3::from_array(light)).to_array();
            [red as f32, green as f32, blue as f32, alpha]
        };
        match pixels {
            Pixels::Srgb(pixels) => {
                let table = |curve: &Curve| -> Vec<f64> {
                    (0..=255_u8).map(|level| curve.decode(f64::from(level) / 255.0)).collect()
                };
                let [reds, greens, blues] = [0, 1, 2].map(|idx| table(&self.curves[idx]));
                let light = |&[red, green, blue, alpha]: &[u8; 4]| {
                    let light = [
                        reds[usize::from(red)],
                        greens[usize::from(green)],
                        blues[usize::from(blue)],
                    ];
                    srgb(light, f32::from(alpha) / 255.0)
                };
                pixels.iter().map(light).collect()
            }
            Pixels::Light(mut pixels) => {
                for pixel in &mut pixels {
                    let [red, green, blue, alpha] = *pixel;
                    *pixel = srgb([red, green, blue].map(f64::from), alpha);
                }
                pixels
            }
        }
    }

    /// The linear light of every level of 16 bits, in each channel.
    pub fn deep_levels(&self) -> [Vec<f32>; 3] {
        [0, 1, 2].map(|idx| levels(|level| self.curves[idx].decode(level)))
    }
}

/// The linear light of every level of 16 bits.
pub(crate) fn levels(decode: impl Fn(f64) -> f64) -> Vec<f32> {
    (0..=u16::MAX).map(|level| decode(f64::from(level) / 65535.0) as f32).collect()
}

/// X, Y and Z as the primaries of a picture, with any white.
pub(crate) const XYZ_CHROMATICITIES: [[f64; 2]; 4] =
    [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0 / 3.0; 2]];

/// The exponent that resembles the curve of sRGB.
const SRGB_GAMMA: f64 = 2.2;

/// X, Y, Z of the primaries of sRGB, adapted to D50 as in its ICC profile.
const XYZ_D50_FROM_SRGB: DMat3 = DMat3::from_cols_array(&[
    0.4360747, 0.2225045, 0.0139322, 0.3850649, 0.7168786, 0.0971045, 0.1430804, 0.0606169,
    0.7141733,
]);

fn srgb_from_xyz() -> DMat3 {
    let columns =
        [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| DVec3::from(xyz_to_linear_srgb(axis.to_array())));
    DMat3::from_cols(columns[0], columns[1], columns[2])
}
