//! Comparison of pictures that have to be the same but for rounding.

use super::picture::{Drawn, Renderer};

/// Pixels of a picture of 24 × 18 that may differ: a ray that passes within rounding of an edge.
const MOST_OTHERS: usize = 2;

/// Light relative to the brightest channel of a pixel. Spectra are tabulated or not by how often a
/// colour is used, which changes them by 3·10⁻⁴.  Eq. (P19)
const RELATIVE: f32 = 1.5e-3;

/// The same for the pipe, which interpolates light between corners.
const PIPE_RELATIVE: f32 = 0.06;

/// Darkness to which this is relative, as a part of the brightest light.
const PIPE_ABSOLUTE: f32 = 0.05;

/// Differences of darkness: a millionth of white.
const ABSOLUTE: f32 = 1e-6;

/// True if two pixels have the same light but for rounding.
pub fn is_same(one: [f32; 3], other: [f32; 3]) -> bool {
    is_within(one, other, RELATIVE)
}

/// True if two pixels differ by less than a part of their brightest channel.
pub fn is_within(one: [f32; 3], other: [f32; 3], part: f32) -> bool {
    let most = one.iter().chain(&other).fold(0.0_f32, |most, channel| most.max(channel.abs()));
    one.iter().zip(other).all(|(a, b)| (a - b).abs() <= part * most + ABSOLUTE)
}

/// Compares pixels in pairs. Returns how many are not black.
///
/// # Errors
/// More of them differ than rays at edges can.
pub fn check(pairs: &[([f32; 3], [f32; 3])], drawn: [&Drawn; 2]) -> Result<usize, String> {
    check_within(pairs, drawn, RELATIVE, MOST_OTHERS * pairs.len().div_ceil(432))
}

/// As [`check`], with a tolerance, and a number of pixels that may differ.
///
/// # Errors
/// More pixels differ.
pub fn check_within(
    pairs: &[([f32; 3], [f32; 3])],
    drawn: [&Drawn; 2],
    part: f32,
    most: usize,
) -> Result<usize, String> {
    let others: Vec<usize> =
        (0..pairs.len()).filter(|&at| !is_within(pairs[at].0, pairs[at].1, part)).collect();
    if others.len() > most {
        let (at, n) = (others[others.len() / 2], others.len());
        let (one, other) = pairs[at];
        let [a, b] = drawn.map(|drawn| drawn.picture.described());
        return Err(format!(
            "{n} of {} pixels differ, such as {at}: {one:?} and {other:?}\n{a}\n{b}",
            pairs.len()
        ));
    }
    Ok(n_lit(pairs))
}

/// Compares two pictures of one size.
///
/// # Errors
/// More pixels differ than rays at edges can.
pub fn check_same(one: &Drawn, other: &Drawn) -> Result<usize, String> {
    check_light(one, other, other.light())
}

/// Compares a picture with the reversed one.
///
/// # Errors
/// More pixels differ than rays at edges can.
pub fn check_reversed(one: &Drawn, other: &Drawn) -> Result<usize, String> {
    check_light(one, other, reversed(other))
}

/// Compares a picture with light that has to be that of another.
///
/// # Errors
/// More pixels differ than rays at edges can.
pub fn check_light(one: &Drawn, other: &Drawn, light: Vec<[f32; 3]>) -> Result<usize, String> {
    let pairs: Vec<_> = one.light().into_iter().zip(light).collect();
    if one.picture.renderer == Renderer::Pipe {
        check_pipe_light(pairs, [one, other])
    } else {
        check(&pairs, [one, other])
    }
}

/// The pipe cuts edges and round faces where rounding decides, and interpolates between the corners
/// of pieces, so its light differs more, in proportion to that of the brightest pixel.
///
/// # Errors
/// More pixels differ.
pub fn check_pipe_light(
    mut pairs: Vec<([f32; 3], [f32; 3])>,
    drawn: [&Drawn; 2],
) -> Result<usize, String> {
    let n_lit = n_lit(&pairs);
    let most =
        pairs.iter().flat_map(|(one, _)| one).fold(0.0_f32, |most, channel| most.max(*channel));
    for channel in pairs.iter_mut().flat_map(|(one, other)| one.iter_mut().chain(other)) {
        *channel += PIPE_ABSOLUTE * most;
    }
    check_within(&pairs, drawn, PIPE_RELATIVE, pairs.len() / 20)?;
    Ok(n_lit)
}

/// The light of a picture with left and right exchanged.
pub fn reversed(drawn: &Drawn) -> Vec<[f32; 3]> {
    let width = drawn.picture.size[0] as usize;
    drawn.light().chunks(width).flat_map(|row| row.iter().rev().copied()).collect()
}

/// Pixels that are not black in one of two pictures.
pub fn n_lit(pairs: &[([f32; 3], [f32; 3])]) -> usize {
    let is_lit = |pixel: [f32; 3]| pixel.iter().any(|channel| *channel > 1e-4);
    pairs.iter().filter(|(one, other)| is_lit(*one) || is_lit(*other)).count()
}

/// True for pixels whose neighbours, in rows of `width`, all satisfy a condition together with
/// them.
pub fn are_around(at: usize, width: usize, n: usize, is_alike: impl Fn(usize) -> bool) -> bool {
    let (column, row) = (at % width, at / width);
    let rows = row.saturating_sub(1)..=(row + 1).min(n / width - 1);
    rows.flat_map(|row| {
        (column.saturating_sub(1)..=(column + 1).min(width - 1)).map(move |x| row * width + x)
    })
    .all(is_alike)
}
