//! Filters against the samples themselves, weighed one by one, and against laws.

use ugrainbow::{Background, Config, Exposure, Filter};

use crate::common::{config, draw, light, with};

/// Bodies of hues and light, one of them clear, some of which reach out of the picture.
const SCENE: &str = "
c red 1.4 350 .8; c blue .7 250; c grey .6; c pane .8 130 1 .6; c_xyz hot 6 5 1; l .2; l .8 -1 -2 3;
v a -9 8 -9; v b 3 5 -3 blue; v c 4 5 2.9; v d -4 6 3 red; f (a b c d) red;
v i -3 4 -2; v j 0 3.5 2.5; v k 2 7 -1; f (i j k) hot;
v m 1 3 -2; v n 3 3 -2.3; v o 2 3 1; f (m n o) pane;
v p -.9 2 -1; v q .9 2 -1.05; v r .9 2 -1.09; v s -.9 2 -1.02; f (p q r s) grey;
cam -ep 0 0 0 -vc 0 5 0 -va 70 55;";

/// Schoenberg's formula for B-splines: differences of truncated powers.
fn spline(order: i32, x: f64) -> f64 {
    let knots = 0..=order + 1;
    let sum: f64 = knots
        .map(|k| {
            let choose =
                (0..k).fold(1.0, |all, i| all * f64::from(order + 1 - i) / f64::from(i + 1));
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            let reach = x + 0.5 * f64::from(order + 1) - f64::from(k);
            if reach > 0.0 {
                sign * choose * (0..order).fold(1.0, |power, _| power * reach)
            } else {
                0.0
            }
        })
        .sum();
    sum / (1..=order).map(f64::from).product::<f64>()
}

fn order(filter: Filter) -> i32 {
    match filter {
        Filter::Box => 0,
        Filter::Triangle => 1,
        Filter::Spline => 2,
    }
}

/// The samples are the pixels of a picture of that resolution with one sample per pixel.
#[track_caller]
fn check(filter: Filter, size: [u32; 2], samples: u32) {
    let config = with(&Config::default(), |picture| {
        (picture.filter, picture.size, picture.samples) = (filter, size, samples)
    });
    let ours = light(SCENE, &config);
    let large = with(&config, |picture| {
        (picture.filter, picture.size, picture.samples) =
            (Filter::Box, size.map(|side| side * samples), 1)
    });
    let all = light(SCENE, &large);
    // By rows, then by columns.
    let weights = |n_pixels: u32| -> Vec<Vec<(usize, f64)>> {
        let place = |sample: u32| (f64::from(sample) + 0.5) / f64::from(samples);
        let of_pixel = |pixel: u32| {
            let near = (0..n_pixels * samples)
                .filter(|&sample| (place(sample) - f64::from(pixel) - 0.5).abs() < 2.0);
            let weight = |sample| spline(order(filter), place(sample) - f64::from(pixel) - 0.5);
            near.map(|sample| (sample as usize, weight(sample))).collect()
        };
        (0..n_pixels).map(of_pixel).collect()
    };
    let (columns, rows) = (weights(size[0]), weights(size[1]));
    let width = (size[0] * samples) as usize;
    let mut n_mixed = 0;
    for (idx, ours) in ours.iter().enumerate() {
        let (row, column) = (&rows[idx / columns.len()], &columns[idx % columns.len()]);
        let (mut sum, mut total) = ([0.0; 3], 0.0);
        for (y, down) in row {
            for (x, across) in column {
                total += down * across;
                for (sum, light) in sum.iter_mut().zip(all[y * width + x]) {
                    *sum += down * across * f64::from(light);
                }
            }
        }
        n_mixed += usize::from(sum.iter().any(|sum| *sum > 0.0));
        for (ours, sum) in ours.iter().zip(sum) {
            // Sums in single precision; and occasionally a sample on an edge is assigned to the
            // other side.
            let off = (f64::from(*ours) - sum / total).abs();
            assert!(
                off < 5e-6 * (1.0 + sum / total),
                "{filter:?} {size:?} {samples}: {idx}: {ours} {off}"
            );
        }
    }
    assert!(n_mixed > ours.len() / 4, "{n_mixed}");
}

#[test]
fn samples_weigh_by_their_distance() {
    for filter in Filter::ALL {
        check(filter, [50, 41], 1);
        // More than two strips, and tiles of several rows.
        check(filter, [45, 71], 2);
        check(filter, [61, 33], 3);
        check(filter, [70, 97], 4);
        check(filter, [1, 7], 4);
        check(filter, [9, 1], 5);
        // More than a tile is wide.
        check(filter, [2060, 1], 16);
    }
}

/// A body of one sample, at each position in a pixel: its total light in the picture is the same.
#[test]
fn small_bodies_keep_their_light_wherever_they_stand() {
    // Eight pixels across of four samples, a unit each.
    let angle = 2.0 * libm::atan(16.0 / 10.0).to_degrees();
    for filter in Filter::ALL {
        for (x, y) in (0..4).flat_map(|x| [(x, 0), (x, 3)]) {
            let ([left, low], [right, high]) = (
                [x, y].map(|place| f64::from(place) + 0.2),
                [x, y].map(|place| f64::from(place) + 0.8),
            );
            let text = format!(
                "c_xyz sun .9505 1 1.089; l 16; v a {left} {low} 0; v b {right} {low} 0; v c {right} {high} 0;
                 v d {left} {high} 0; f (a b c d) sun; cam -ep 0 0 10 -vc 0 0 0 -ud 0 1 0 -og -va {angle} {angle};"
            );
            let pixels = light(&text, &with(&config(8, 4), |picture| picture.filter = filter));
            let sum: f64 = pixels.iter().map(|pixel| f64::from(pixel[1])).sum();
            // Sixteen times white, on a sixteenth of a pixel; white is known to four digits.
            assert!((sum - 1.0).abs() < 1e-4, "{filter:?} {x} {y}: {sum}");
        }
    }
}

/// A face that covers the picture covers it up to the edges, bit for bit; elsewhere only the
/// background is visible.
#[test]
fn covered_is_covered() {
    let text = "c_rgb all .25 .5 .75; l 1; v a -9 -9 0; v b 9 -9 0; v c 9 9 0; v d -9 9 0; f (a b c d) all;
                v e 1 1 -1; v f 2 1 -1; v g 1 2 -1; f (e f g);
                cam -ep 0 0 10 -vc 0 0 0 -ud 0 1 0;";
    for (filter, samples) in
        Filter::ALL.into_iter().flat_map(|filter| [(filter, 1), (filter, 3), (filter, 4)])
    {
        let config = with(&config(40, samples), |picture| {
            (picture.filter, picture.background) = (filter, Background::Transparent)
        });
        assert!(
            draw(text, &config).pixels().iter().all(|pixel| *pixel == [64, 128, 191, 255]),
            "{filter:?}"
        );
        let exposed = with(&config, |picture| picture.exposure = Some(Exposure::Stops(0.0)));
        assert!(draw(text, &exposed).pixels().iter().all(|pixel| pixel[3] == 255), "{filter:?}");
        let half = text.replace("v a -9 -9 0", "v a 0 -9 0").replace("v d -9 9 0", "v d 0 9 0");
        let frame = draw(&half, &config);
        let row: Vec<u8> = (0..40).map(|column| frame.pixel(column, 20)[3]).collect();
        assert!(
            row[..19].iter().all(|part| *part == 0) && row[21..].iter().all(|part| *part == 255),
            "{row:?}"
        );
        assert_eq!(u16::from(row[19]) + u16::from(row[20]), 255, "{filter:?}");
        // The colour of a partly covered pixel is still that of the face.
        assert!(
            (19..40).all(|column| row[column as usize] == 0
                || frame.pixel(column, 20)[..3] == [64, 128, 191])
        );
    }
}
