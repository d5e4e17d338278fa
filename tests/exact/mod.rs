//! Compares every sample of exact pictures (`ugrainbow -xc`) with the oracle, which uses 4×4
//! matrices and the scene as written, and with the formulas of `ugphysics`.

mod rules;
mod samples;
mod world_lines;

use std::collections::BTreeMap;

use exr::prelude::{ReadChannels, ReadLayers};
use glam::DVec3;
use ugimage::Format;
use ugrainbow::{Channel, ColorShift, Output};
use ugtests::pipe::{Pipe, lorentz, rainbow};

const SIZE: [u32; 2] = [96, 72];
/// The pipe of an exact picture, without subdivision.
fn exact(beta: Option<DVec3>) -> Pipe {
    let mut pipe = Pipe::default();
    pipe.lorentz.velocity = beta;
    pipe.lorentz.pieces = uglorentz::Pieces::PerEdge(1);
    pipe.rainbow.exact = Some(ColorShift::default());
    pipe.rainbow.picture.size = SIZE;
    pipe.rainbow.picture.samples = 1;
    pipe
}

/// The channels of the picture.
fn channels(pipe: &Pipe, text: &[u8]) -> BTreeMap<String, Vec<f64>> {
    let mut pipe = pipe.clone();
    pipe.rainbow.picture.output = Output::Color(Format::Exr);
    pipe.rainbow.picture.channels = vec![Channel::Id, Channel::Distance, Channel::Doppler];
    let file = rainbow(&lorentz(text, &pipe.lorentz), &pipe.rainbow);
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(std::io::Cursor::new(file))
        .unwrap();
    let list = image.layer_data.channel_data.list.iter();
    list.map(|channel| {
        let numbers = channel.sample_data.values_as_f32().map(f64::from).collect();
        (channel.name.to_string(), numbers)
    })
    .collect()
}

/// A square that fills the picture and moves sideways and towards the eye.
const SQUARE: &str = "c green .9 130 .8; l .2; l .7 1 -2 .5; cam -ep 0 0 0 -vc 0 9 0 -va 60 50;
    v a -40 9 -40; v b 40 9 -40; v c 40 9 40; v d -40 9 40; f (a b c d) green <.2 -.1 0>;";
