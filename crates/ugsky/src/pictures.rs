//! Panoramas of decoded pictures.

use crate::arrangement::Arrangement;
use crate::cube::CubeMap;
use crate::grid::Extent;
use crate::panorama::{Panorama, PanoramaError};
use crate::texels::Texels;

/// A decoded picture: its pixels across and down, row after row from the top.
pub type DecodedPicture = ([u32; 2], Texels);

/// The places of the sides in a cross of four squares across, and in one of three across, whose
/// back is upside down: column and row.
const CROSSES: [[[usize; 2]; 6]; 2] = [
    [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]],
    [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [1, 3]],
];

impl Panorama {
    /// A panorama of pictures with an arrangement of directions. `extent`: the angles that an
    /// equirectangular one shows; without it the whole sphere.
    ///
    /// # Errors
    /// [`PanoramaError`].
    pub fn arranged(
        mut pictures: Vec<DecodedPicture>,
        arrangement: Arrangement,
        extent: Option<Extent>,
    ) -> Result<Self, PanoramaError> {
        if pictures.len() != arrangement.n_files() {
            return Err(PanoramaError::Sides { n_files: pictures.len() });
        }
        if arrangement == Arrangement::Sides {
            return sides(pictures)?.panorama();
        }
        let (size, texels) = pictures.remove(0);
        if arrangement != Arrangement::Equirectangular {
            return unfolded(size, &texels, arrangement)?.panorama();
        }
        let [width, height] = size.map(u64::from);
        // Some cameras cut off a row or a column.
        let is_double = width.abs_diff(2 * height) <= 2 + width / 100;
        match extent {
            Some(extent) => Self::new(size, texels, extent),
            None if is_double => Self::new(size, texels, Extent::FULL),
            None => Err(PanoramaError::Shape { size, arrangement }),
        }
    }
}

/// A cube of a picture for each side.
fn sides(pictures: Vec<DecodedPicture>) -> Result<CubeMap, PanoramaError> {
    let side = pictures[0].0[0];
    if let Some(idx) = pictures.iter().position(|(size, _)| *size != [side, side]) {
        return Err(PanoramaError::Side { idx, size: pictures[idx].0, expected: side });
    }
    let faces: Vec<Texels> = pictures.into_iter().map(|(_, texels)| texels).collect();
    CubeMap::new(side, faces.try_into().map_err(|_| PanoramaError::Size)?)
}

/// A cube of a strip or a cross.
fn unfolded(
    size: [u32; 2],
    texels: &Texels,
    arrangement: Arrangement,
) -> Result<CubeMap, PanoramaError> {
    let [width, height] = size;
    let (across, down) = match arrangement {
        Arrangement::Strip => (6, 1),
        _ if width > height => (4, 3),
        _ => (3, 4),
    };
    let side = width / across;
    if side == 0 || [side * across, side * down] != size {
        return Err(PanoramaError::Shape { size, arrangement });
    }
    let faces = std::array::from_fn(|face| {
        let place = match (arrangement, across) {
            (Arrangement::Strip, _) => [face, 0],
            (_, 4) => CROSSES[0][face],
            _ => CROSSES[1][face],
        };
        let is_turned = across == 3 && face == 5;
        match texels {
            Texels::Srgb(texels) => Texels::Srgb(square(texels, width, side, place, is_turned)),
            Texels::Light(texels) => Texels::Light(square(texels, width, side, place, is_turned)),
        }
    });
    CubeMap::new(side, faces)
}

/// A square of a picture of squares.
fn square<T: Copy>(
    texels: &[T],
    width: u32,
    side: u32,
    place: [usize; 2],
    is_turned: bool,
) -> Vec<T> {
    let (width, side) = (width as usize, side as usize);
    let row = |row: usize| {
        let start = (place[1] * side + row) * width + place[0] * side;
        &texels[start..start + side]
    };
    let mut square: Vec<T> = (0..side).flat_map(row).copied().collect();
    if is_turned {
        square.reverse();
    }
    square
}
