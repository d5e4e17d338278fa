//! The colours of a frame of a GIF: those of its pixels, or if these are too many, the means of
//! groups of them and patterns of two means.

use std::ops::Range;

type Rgb = [u8; 3];

/// At most 256 colours for the pixels of a frame.
pub struct Palette {
    /// Red, green, blue.
    pub colors: Vec<Rgb>,
    /// The colours of the pixels, in ascending order, and how each is shown.
    mixtures: Vec<(Rgb, Mixture)>,
}

/// A colour as a pattern of two colours of a palette.
#[derive(Clone, Copy)]
struct Mixture {
    nearest: u8,
    other: u8,
    /// Pixels of the other colour, of 16.
    n_other: u8,
}

/// Colours that get one colour of a palette, unless they are divided.
struct Group {
    rows: Range<usize>,
    /// The row at which its division decreases the sum of squared errors most.
    cut: usize,
    /// That decrease; 0 for a single colour.
    gain: f64,
}

impl Palette {
    /// At most `most` colours for these pixels, from 1 to 256.
    pub fn new(mut pixels: Vec<Rgb>, most: usize) -> Self {
        pixels.sort_unstable();
        let mut counted: Vec<(Rgb, f64)> =
            pixels.chunk_by(|a, b| a == b).map(|same| (same[0], same.len() as f64)).collect();
        let all = 0..counted.len();
        let mut groups = vec![Group::new(&mut counted, all)];
        while groups.len() < most {
            let widest =
                (0..groups.len()).max_by(|&a, &b| groups[a].gain.total_cmp(&groups[b].gain));
            let Some(widest) = widest.filter(|&row| groups[row].gain > 0.0) else { break };
            let Group { rows, cut, .. } = groups.swap_remove(widest);
            groups.extend(
                [rows.start..cut, cut..rows.end].map(|half| Group::new(&mut counted, half)),
            );
        }
        let mut colors: Vec<Rgb> =
            groups.into_iter().map(|group| mean(&counted[group.rows])).collect();
        colors.sort_unstable();
        counted.sort_unstable_by_key(|(color, _)| *color);
        let mixtures =
            counted.iter().map(|(color, _)| (*color, Mixture::new(*color, &colors))).collect();
        Self { colors, mixtures }
    }

    /// The index of the colour of a pixel. The pattern of two colours is fixed in the picture.
    pub fn index(&self, color: Rgb, [column, row]: [usize; 2]) -> u8 {
        /// Bayer's matrix of order 4.
        const PATTERN: [[u8; 4]; 4] =
            [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];
        let found = self.mixtures.binary_search_by_key(&color, |(color, _)| *color);
        let Ok(Mixture { nearest, other, n_other }) = found.map(|at| self.mixtures[at].1) else {
            return 0;
        };
        if PATTERN[row % 4][column % 4] < n_other { other } else { nearest }
    }
}

impl Group {
    /// Sorts colours along the channel in which they differ most, and finds where to divide them
    /// (Wu 1991).
    fn new(counted: &mut [(Rgb, f64)], rows: Range<usize>) -> Self {
        let colors = &mut counted[rows.clone()];
        // Number of pixels, and sums of the channel and of its squares.
        let sums = |colors: &[(Rgb, f64)], channel: usize| {
            colors.iter().fold([0.0; 3], |[n, sum, squares], (color, count)| {
                let level = f64::from(color[channel]);
                [n + count, sum + count * level, squares + count * level * level]
            })
        };
        let spread = |channel: usize| {
            let [n, sum, squares] = sums(colors, channel);
            squares - sum * sum / n
        };
        let spreads = [spread(0), spread(1), spread(2)];
        let widest = (0..3).max_by(|&a, &b| spreads[a].total_cmp(&spreads[b])).unwrap_or(0);
        colors.sort_unstable_by_key(|(color, _)| (color[widest], *color));
        let [n_all, sum_all, _] = sums(colors, widest);
        let (mut n, mut sum, mut best) = (0.0, 0.0, (rows.start, 0.0));
        for (row, (color, count)) in colors.iter().enumerate().take(rows.len().saturating_sub(1)) {
            n += count;
            sum += count * f64::from(color[widest]);
            let difference = sum / n - (sum_all - sum) / (n_all - n);
            let gain = n * (n_all - n) / n_all * difference * difference;
            if gain > best.1 {
                best = (rows.start + row + 1, gain);
            }
        }
        Self { rows, cut: best.0, gain: best.1 }
    }
}

/// The mean colour of pixels; black if there are none.
fn mean(counted: &[(Rgb, f64)]) -> Rgb {
    let n = counted.iter().map(|(_, count)| count).sum::<f64>().max(1.0);
    [0, 1, 2].map(|channel| {
        let sum =
            counted.iter().map(|(color, count)| count * f64::from(color[channel])).sum::<f64>();
        (sum / n).round() as u8
    })
}

impl Mixture {
    /// The nearest colour, and another that makes the mean of the pattern right.
    fn new(color: Rgb, colors: &[Rgb]) -> Self {
        /// Weight of the squared contrast of a pattern beside the squared error of its mean.
        const CONTRAST: f64 = 0.1;
        let step = |to: Rgb, from: Rgb| {
            let difference = |channel: usize| i32::from(to[channel]) - i32::from(from[channel]);
            [difference(0), difference(1), difference(2)]
        };
        let dot = |a: [i32; 3], b: [i32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let error = |row: &usize| {
            let missing = step(color, colors[*row]);
            dot(missing, missing)
        };
        let nearest = (0..colors.len()).min_by_key(error).unwrap_or(0);
        let missing = step(color, colors[nearest]);
        let mut best = (f64::from(dot(missing, missing)), nearest, 0.0);
        let others = if best.0 > 0.0 { colors } else { &[] };
        let error = best.0;
        for (row, &other) in others.iter().enumerate() {
            let step = step(other, colors[nearest]);
            let (along, square) = (dot(missing, step), dot(step, step));
            if along > 0 {
                let (along, square) = (f64::from(along), f64::from(square));
                let share = (along / square).min(0.5);
                let cost = error - share * (2.0 * along - (share + CONTRAST) * square);
                if cost < best.0 {
                    best = (cost, row, share);
                }
            }
        }
        Self { nearest: nearest as u8, other: best.1 as u8, n_other: (16.0 * best.2).round() as u8 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of the channels' errors of pixels in their places.
    fn mean_error(pixels: &[Rgb], most: usize) -> f64 {
        let palette = Palette::new(pixels.to_vec(), most);
        assert!(palette.colors.len() <= most);
        let errors = pixels.iter().enumerate().flat_map(|(at, &pixel)| {
            let shown = palette.colors[palette.index(pixel, [at % 64, at / 64]) as usize];
            [0, 1, 2].map(|channel| f64::from(pixel[channel].abs_diff(shown[channel])))
        });
        errors.sum::<f64>() / (3 * pixels.len()) as f64
    }

    #[test]
    fn few_colours_are_kept_and_many_are_near() {
        let grey: Vec<Rgb> = (0..4096).map(|at| [(at % 256) as u8; 3]).collect();
        assert_eq!(mean_error(&grey, 256), 0.0);
        assert!(mean_error(&grey, 255) < 0.01);
        // A single pixel among many keeps its colour.
        let mut flash = vec![[76, 76, 89]; 4095];
        flash.extend([[255, 26, 26]]);
        assert_eq!(mean_error(&flash, 2), 0.0);
        // A plane of 4096 colours in 256 cells of 4 x 4 levels.
        let plane: Vec<Rgb> = (0..4096).map(|at| [(at % 64) as u8, (at / 64) as u8, 90]).collect();
        assert!(mean_error(&plane, 256) < 1.5);
        assert_eq!(Palette::new(Vec::new(), 255).colors, [[0; 3]]);
    }

    /// The mean of a pattern is the colour that it stands for.
    #[test]
    fn patterns_have_the_mean_of_their_colour() {
        let palette =
            Palette::new([vec![[0; 3]; 99], vec![[100; 3]; 99], vec![[25; 3]]].concat(), 2);
        assert_eq!(palette.colors, [[0; 3], [100; 3]]);
        let cells =
            (0..16).map(|at| palette.colors[palette.index([25; 3], [at % 4, at / 4]) as usize][0]);
        assert_eq!(cells.map(u32::from).sum::<u32>(), 16 * 25);
    }
}
