//! Cube maps as panoramas.

use core::f64::consts::{PI, TAU};

use glam::DVec3;
use rayon::prelude::*;

use crate::grid::Extent;
use crate::panorama::{Panorama, PanoramaError};
use crate::texels::{Decoder, Texels, premultiply};

/// The sides of a cube map, each as seen from inside: right, left, up, down, front, back (+X, −X,
/// +Y, −Y, +Z, −Z of OpenGL).
pub struct CubeMap {
    side: u32,
    /// Linear light times alpha, and alpha; six squares one after the other.
    texels: Vec<[f32; 4]>,
}

/// The middle of a side, and what is to the right and below in its square.
const SIDES: [[DVec3; 3]; 6] = [
    [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z],
    [DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z],
    [DVec3::Z, DVec3::X, DVec3::Y],
    [DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y],
    [DVec3::Y, DVec3::X, DVec3::NEG_Z],
    [DVec3::NEG_Y, DVec3::NEG_X, DVec3::NEG_Z],
];

impl CubeMap {
    /// A cube map of six squares, `side` texels wide.
    ///
    /// # Errors
    /// [`PanoramaError::Size`] if a square has another number of texels.
    pub fn new(side: u32, faces: [Texels; 6]) -> Result<Self, PanoramaError> {
        let n_texels = side as usize * side as usize;
        let mut texels = Vec::with_capacity(6 * n_texels);
        let decoder = Decoder::new();
        for face in faces {
            let before = texels.len();
            match face {
                Texels::Srgb(face) => {
                    texels.extend(face.into_iter().map(|texel| decoder.light(texel)))
                }
                Texels::Light(mut face) => {
                    face.iter_mut().for_each(premultiply);
                    texels.append(&mut face);
                }
            }
            if n_texels == 0 || texels.len() - before != n_texels {
                return Err(PanoramaError::Size);
            }
        }
        Ok(Self { side, texels })
    }

    /// The same light on an equirectangular grid, four sides around, by cubic interpolation across
    /// the edges of the cube.
    ///
    /// # Errors
    /// [`PanoramaError::Coarse`].
    pub fn panorama(&self) -> Result<Panorama, PanoramaError> {
        let [width, height] = [4 * self.side, 2 * self.side];
        let mut texels = vec![[0.0; 4]; width as usize * height as usize];
        texels.par_chunks_mut(width as usize).enumerate().for_each(|(row, texels)| {
            let (sin_lat, cos_lat) =
                libm::sincos(PI * (0.5 - (row as f64 + 0.5) / f64::from(height)));
            for (column, texel) in texels.iter_mut().enumerate() {
                let (sin_long, cos_long) =
                    libm::sincos(TAU * ((column as f64 + 0.5) / f64::from(width) - 0.5));
                let [red, green, blue, alpha] =
                    self.light(DVec3::new(cos_lat * sin_long, cos_lat * cos_long, sin_lat));
                *texel = if alpha > 0.0 {
                    [red / alpha, green / alpha, blue / alpha, alpha]
                } else {
                    [0.0; 4]
                };
            }
        });
        Panorama::new([width, height], Texels::Light(texels), Extent::FULL)
    }

    /// The light of a direction, by Catmull–Rom interpolation of 4 × 4 texels.
    fn light(&self, direction: DVec3) -> [f32; 4] {
        let (face, [u, v]) = self.place(direction);
        let cell = |at: f64| ((at - 0.5).floor() as i64, (at - 0.5) - (at - 0.5).floor());
        let ((column, across), (row, down)) = (cell(u), cell(v));
        let mut sum = [0.0_f32; 4];
        for (i, weight_down) in catmull_rom(down).into_iter().enumerate() {
            for (j, weight_across) in catmull_rom(across).into_iter().enumerate() {
                let texel = self.texel(face, column + j as i64 - 1, row + i as i64 - 1);
                let weight = (weight_across * weight_down) as f32;
                (0..4).for_each(|channel| sum[channel] += weight * texel[channel]);
            }
        }
        sum
    }

    /// The side that a direction meets, and the place on it in texels.
    fn place(&self, direction: DVec3) -> (usize, [f64; 2]) {
        let along = SIDES.map(|[middle, ..]| middle.dot(direction));
        let face = (1..6).fold(0, |best, face| if along[face] > along[best] { face } else { best });
        let [_, across, down] = SIDES[face];
        let half = 0.5 * f64::from(self.side);
        (face, [across, down].map(|axis| half * (1.0 + axis.dot(direction) / along[face])))
    }

    /// A texel of a side; beyond its edges, the nearest one of the neighbouring side.
    fn texel(&self, face: usize, column: i64, row: i64) -> [f32; 4] {
        let side = i64::from(self.side);
        let (mut face, mut column, mut row) = (face, column, row);
        if !((0..side).contains(&column) && (0..side).contains(&row)) {
            let [middle, across, down] = SIDES[face];
            let at = |idx: i64| (2 * idx + 1 - side) as f64 / side as f64;
            let (other, place) = self.place(middle + at(column) * across + at(row) * down);
            face = other;
            [column, row] = place.map(|at| (at.floor() as i64).clamp(0, side - 1));
        }
        self.texels[(face * side as usize + row as usize) * side as usize + column as usize]
    }
}

/// Weights of the texels at −1, 0, 1 and 2.
fn catmull_rom(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        -0.5 * t + t2 - 0.5 * t3,
        1.0 - 2.5 * t2 + 1.5 * t3,
        0.5 * t + 2.0 * t2 - 1.5 * t3,
        -0.5 * t2 + 0.5 * t3,
    ]
}
