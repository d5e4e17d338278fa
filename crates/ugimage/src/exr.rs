//! OpenEXR, written with the `exr` crate.

use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, write::WritableImage};
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
    let mut image = Image::from_layer(Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, channels));
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
    let light = |channel: usize| frame.pixels().iter().map(|&pixel| frame.light_of(pixel)[channel]).collect();
    let mut channels: Vec<_> =
        ["R", "G", "B"].into_iter().zip(0..3).map(|(name, channel)| float(name, light(channel))).collect();
    if !frame.is_opaque() {
        channels.push(float("A", frame.pixels().iter().map(|pixel| pixel[3]).collect()));
    }
    channels.extend(frame.planes().iter().map(|plane| match &plane.samples {
        Samples::Float(numbers) => float(&plane.name, numbers.clone()),
        Samples::Whole(numbers) => AnyChannel::new(latin(&plane.name), FlatSamples::U32(numbers.clone())),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_frames::linear_frames;
    use exr::prelude::{ReadChannels, ReadLayers};
    use ugframe::Plane;

    fn decode(file: &[u8]) -> exr::prelude::FlatImage {
        exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .non_parallel()
            .from_buffered(std::io::Cursor::new(file))
            .unwrap()
    }

    #[test]
    fn values_round_trip() {
        let metadata = Metadata {
            software: "ug 1".into(),
            comment: "ug é\nug γ".into(),
            camera: Some(Box::new([[2.0; 16], [3.0; 16]])),
            ..Metadata::default()
        };
        for mut frame in linear_frames() {
            let n_pixels = frame.pixels().len() as u32;
            frame.push_plane(Plane {
                name: "id".into(),
                samples: Samples::Whole((0..n_pixels).rev().collect()),
            });
            let times: Vec<f32> = (0..n_pixels).map(|idx| -(idx as f32)).collect();
            frame.push_plane(Plane { name: "time".into(), samples: Samples::Float(times.clone()) });
            let file = encode(&frame, &metadata);
            assert_eq!(file, encode(&frame, &metadata));
            let read = decode(&file);
            let layer = &read.layer_data[0];
            assert_eq!(layer.attributes.comments.as_ref().unwrap().to_string(), "ug é\nug ?");
            assert_eq!(layer.attributes.world_to_camera, Some([2.0; 16]));
            assert_eq!(layer.attributes.world_to_normalized_device, Some([3.0; 16]));
            assert_eq!(layer.size, Vec2(frame.width() as usize, frame.height() as usize));
            let channel =
                |name: &str| layer.channel_data.list.iter().find(|c| c.name.eq(name)).map(|c| &c.sample_data);
            for (idx, name) in ["R", "G", "B"].into_iter().enumerate() {
                let light: Vec<f32> =
                    frame.pixels().iter().map(|&pixel| frame.light_of(pixel)[idx]).collect();
                assert_eq!(channel(name), Some(&FlatSamples::F32(light)));
            }
            assert_eq!(channel("A").is_some(), !frame.is_opaque());
            assert_eq!(channel("id"), Some(&FlatSamples::U32((0..n_pixels).rev().collect())));
            assert_eq!(channel("time"), Some(&FlatSamples::F32(times)));
        }
    }
}
