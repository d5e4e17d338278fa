//! Options of cameras.

use glam::DVec3;
use nom::Parser;
use nom::combinator::opt;
use ugscene::{Camera, Projection};

use super::{numbers, store, zero_vector};
use crate::token::{Input, Parsed, Reason, blank, fail, number, point, require};

/// Parses the arguments of camera option `name`, which begins at `at`; `input` begins after it.
pub(super) fn camera_option<'a>(
    camera: &mut Camera,
    name: Input<'a>,
    at: Input<'a>,
    input: Input<'a>,
) -> Parsed<'a, ()> {
    match name {
        b"vc" => store(&mut camera.center, point(input)),
        b"ep" => store(&mut camera.eye, point(input)),
        b"ud" if require(point(input))?.1 == DVec3::ZERO => fail(blank(at)?.0, zero_vector(4)),
        b"ud" => store(&mut camera.up, point(input)),
        b"cl" => store(&mut camera.clip, numbers(input)),
        b"ph" => store(&mut camera.film, numbers(input)),
        b"va" => {
            let (rest, (across, down)) = require((number, opt(number)).parse(input))?;
            store(&mut camera.view_angle, Ok((rest, [across, down.unwrap_or(across)])))
        }
        b"fs" => store(&mut camera.film_size, numbers(input)),
        b"fl" => store(&mut camera.focal_length, number(input)),
        b"og" => store(&mut camera.projection, Ok((input, Projection::Orthographic))),
        b"ps" => store(&mut camera.projection, Ok((input, Projection::Perspective))),
        _ => fail(
            blank(at)?.0,
            Reason::Expected("a camera option (-vc -ep -ud -cl -ph -og -ps -va -fs -fl)"),
        ),
    }
}
