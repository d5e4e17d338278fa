//! OpenEXR, written with the `exr` crate.

use exr::image::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, write::WritableImage,
};
use exr::math::Vec2;
use exr::meta::attribute::{Chromaticities, Text};
use exr::meta::header::LayerAttributes;

use crate::{LinearFrame, Metadata};
use ugframe::Samples;

/// The light as an OpenEXR file: channels `R`, `G`, `B` and, unless the frame is opaque, `A`,
/// 32-bit floating point, unclipped; then the frame's planes under their names. Colours are
/// premultiplied by `A`, as OpenEXR requires. The chromaticities are those of sRGB; the metadata is
/// in `software`, `comments`, `worldToCamera` and `worldToNDC`.
pub fn encode(frame: &LinearFrame, metadata: &Metadata) -> Vec<u8> {
    let attributes = LayerAttributes {
        software_name: text(&metadata.software),
        comments: text(&metadata.comment),
        world_to_camera: metadata.camera.as_ref().map(|both| single(both[0])),
        world_to_normalized_device: metadata.camera.as_ref().map(|both| single(both[1])),
        ..LayerAttributes::default()
    };
    let size = (frame.width() as usize, frame.height() as usize);
    let channels = AnyChannels::sort(channels(frame).into());
    let mut image =
        Image::from_layer(Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, channels));
    image.attributes.chromaticities = Some(Chromaticities {
        red: Vec2(0.64, 0.33),
        green: Vec2(0.30, 0.60),
        blue: Vec2(0.15, 0.06),
        white: Vec2(0.3127, 0.3290),
    });
    let mut file = std::io::Cursor::new(Vec::new());
    // On one thread; the bytes would be the same on several.
    let written = image.write().non_parallel().to_unbuffered(&mut file);
    written.expect("a frame with pixels is a valid image and a vector takes every write");
    file.into_inner()
}

fn single(matrix: [f64; 16]) -> [f32; 16] {
    matrix.map(|entry| entry as f32)
}

fn channels(frame: &LinearFrame) -> Vec<AnyChannel<FlatSamples>> {
    let light = |channel: usize| {
        frame.pixels().iter().map(|&pixel| frame.light_of(pixel)[channel]).collect()
    };
    let mut channels: Vec<_> = ["R", "G", "B"]
        .into_iter()
        .zip(0..3)
        .map(|(name, channel)| float(name, light(channel)))
        .collect();
    if !frame.is_opaque() {
        channels.push(float("A", frame.pixels().iter().map(|pixel| pixel[3]).collect()));
    }
    channels.extend(frame.planes().iter().map(|plane| match &plane.samples {
        Samples::Float(numbers) => float(&plane.name, numbers.clone()),
        Samples::Whole(numbers) => {
            AnyChannel::new(latin(&plane.name), FlatSamples::U32(numbers.clone()))
        }
    }));
    channels
}

fn float(name: &str, numbers: Vec<f32>) -> AnyChannel<FlatSamples> {
    AnyChannel::new(latin(name), FlatSamples::F32(numbers))
}

/// `None` for empty text, so that no empty attribute is written.
fn text(text: &str) -> Option<Text> {
    (!text.is_empty()).then(|| latin(text))
}

/// OpenEXR text is a byte string: Latin-1 here, with `?` for NUL and other characters.
fn latin(text: &str) -> Text {
    let byte = |c: char| u8::try_from(u32::from(c)).ok().filter(|byte| *byte != 0).unwrap_or(b'?');
    Text::from_bytes_unchecked(text.chars().map(byte).collect())
}
