//! Files of pictures, and text on them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod figure;
mod history;
mod label;
mod light;
mod light_files;
mod png_files;
mod postscript;
mod read;

use ugimage::{Frame, LinearFrame, Pixels, ReadError};

/// Size and pixels of a picture.
fn read_picture(file: &[u8]) -> Result<([u32; 2], Pixels), ReadError> {
    ugimage::read_picture(file, &Default::default()).map(|picture| (picture.size, picture.pixels))
}

/// Size and light of a picture that has more than 8 bits.
fn read_light(file: &[u8]) -> Result<([u32; 2], Vec<[f32; 4]>), String> {
    match read_picture(file) {
        Ok((size, Pixels::Light(pixels))) => Ok((size, pixels)),
        Ok(_) => panic!("8 bits"),
        Err(error) => Err(error.to_string()),
    }
}

/// Frames for testing writers: one pixel, odd sizes, long runs, noise, transparency.
pub fn frames() -> Vec<Frame> {
    let mut noise = Frame::opaque(37, 19);
    let mut random = ugtesting::Random(1);
    for pixel in noise.pixels_mut() {
        let [r, g, b, ..] = random.bits().to_be_bytes();
        *pixel = [r, g, b, 255];
    }
    let mut runs = Frame::opaque(300, 5);
    for (idx, pixel) in runs.pixels_mut().iter_mut().enumerate() {
        *pixel = if idx % 301 < 7 { [idx as u8, 9, 9, 255] } else { [0, 0, 0, 255] };
    }
    let mut clear = Frame::clear(16, 16);
    for (idx, pixel) in clear.pixels_mut().iter_mut().enumerate() {
        *pixel = [idx as u8, 255 - idx as u8, 7, idx as u8];
    }
    vec![Frame::opaque(1, 1), Frame::opaque(129, 3), noise, runs, clear]
}

/// Frames for testing writers of linear light: bright, negative, tiny, transparent, one pixel,
/// wide.
pub fn linear_frames() -> Vec<LinearFrame> {
    let frame = |size: [u32; 2], is_opaque, pixel: &dyn Fn(usize) -> [f32; 4]| {
        LinearFrame::new(size, is_opaque, (0..(size[0] * size[1]) as usize).map(pixel).collect())
    };
    vec![
        frame([1, 1], true, &|_| [0.25, 1.0, 4.0, 1.0]),
        frame([9, 5], true, &|idx| [idx as f32 * 0.37, -0.5, 1e-4 * idx as f32, 1.0]),
        frame([300, 3], true, &|idx| {
            if idx % 97 < 60 { [5.5, 0.5, 1e5, 1.0] } else { [idx as f32; 4] }
        }),
        frame([8, 4], false, &|idx| [2.0, 0.1 * idx as f32, 0.0, (idx % 5) as f32 / 4.0]),
    ]
}
