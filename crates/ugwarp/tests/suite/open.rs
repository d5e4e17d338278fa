//! Arrangements of cube maps.

use ugimage::{Format, Frame, Metadata, PictureLimits};
use ugwarp::{Arrangement, Config, Lens, PictureOptions, open};

fn png(size: [u32; 2], color: impl Fn([u32; 2]) -> [u8; 4]) -> Vec<u8> {
    let pixels = (0..size[0] * size[1]).map(|idx| color([idx % size[0], idx / size[0]])).collect();
    Format::Png.encode(&Frame::new(size, true, pixels), &Metadata::default())
}

const SIDE: u32 = 16;

/// Sides of different colours, whose red increases to the right and green downward.
fn side(face: usize, [x, y]: [u32; 2]) -> [u8; 4] {
    [(8 * x) as u8, (8 * y) as u8, 40 * face as u8, 255]
}

/// Strips, crosses and files of the same sides are the same panorama.
#[test]
fn arrangements_agree() {
    let light = |files: &[Vec<u8>], arrangement: Arrangement| {
        let files: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
        let opened = open(&files, Some(arrangement), None, None, PictureLimits::default())
            .unwrap_or_else(|error| panic!("{error}"));
        let config = Config { lens: Lens::Panorama, ..Config::default() };
        let picture = PictureOptions { size: [40, 20], samples: 1, ..config.picture.clone() };
        ugwarp::light(&opened, &Config { picture, ..config }).unwrap()
    };
    let files: Vec<Vec<u8>> = (0..6).map(|face| png([SIDE, SIDE], |at| side(face, at))).collect();
    let expected = light(&files, Arrangement::Sides);
    let strip = png([6 * SIDE, SIDE], |[x, y]| side((x / SIDE) as usize, [x % SIDE, y]));
    assert_eq!(light(&[strip], Arrangement::Strip), expected);
    for (across, down, places) in [
        (4, 3, [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]]),
        (3, 4, [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [1, 3]]),
    ] {
        let cross = png([across * SIDE, down * SIDE], |[x, y]| {
            let place = [x / SIDE, y / SIDE].map(|at| at as usize);
            let Some(face) = places.iter().position(|other| *other == place) else {
                return [0, 0, 0, 255];
            };
            let at = [x % SIDE, y % SIDE];
            side(face, if across == 3 && face == 5 { at.map(|at| SIDE - 1 - at) } else { at })
        });
        assert_eq!(light(&[cross], Arrangement::Cross), expected, "{across}");
    }
}

#[test]
fn wrong_shapes_are_refused() {
    let file = |size: [u32; 2]| png(size, |_| [9, 9, 9, 255]);
    let message = |files: &[Vec<u8>], arrangement: Arrangement| {
        let files: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
        open(&files, Some(arrangement), None, None, PictureLimits::default())
            .err()
            .map(|error| error.to_string())
            .unwrap_or_default()
    };
    let mut sides = vec![file([16, 16]); 6];
    assert!(message(&sides[..5], Arrangement::Sides).contains("5 files"));
    sides[2] = file([16, 15]);
    assert_eq!(
        message(&sides, Arrangement::Sides),
        "the third side of the cube has 16 x 15 pixels: all must be squares of the same size, here 16 x 16"
    );
    assert!(
        message(&[file([60, 16])], Arrangement::Strip)
            .contains("60 x 16 pixels are not the shape of a strip")
    );
    assert!(message(&[file([60, 16])], Arrangement::Cross).contains("not the shape of a cross"));
    assert!(
        message(&[file([60, 40])], Arrangement::Equirectangular).contains("twice as wide as high")
    );
}
