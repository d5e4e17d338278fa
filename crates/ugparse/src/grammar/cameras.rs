//! Options of cameras.

use glam::DVec3;
use nom::Parser;
use nom::combinator::opt;
use ugscene::{Camera, Projection};

use super::{numbers, zero_vector};
use crate::token::{Input, Parsed, Reason, blank, fail, number, point, require};

/// Parses the arguments of camera option `name`, which begins at `at`; `input` begins after it.
pub(super) fn camera_option<'a>(
    camera: &mut Camera,
    name: Input<'a>,
    at: Input<'a>,
    input: Input<'a>,
) -> Parsed<'a, ()> {
    fn store<'a, T, U>(
        slot: &mut Option<U>,
        parsed: Parsed<'a, T>,
        convert: impl Fn(T) -> U,
    ) -> Parsed<'a, ()> {
        let (rest, value) = require(parsed)?;
        *slot = Some(convert(value));
        Ok((rest, ()))
    }
    let same = |x| x;
    let pair = |x: [f64; 2]| x;
    match name {
        b"vc" => store(&mut camera.center, point(input), same),
        b"ep" => store(&mut camera.eye, point(input), same),
        b"ud" => {
            let (rest, up) = require(point(input))?;
            camera.up = Some(up);
            if up == DVec3::ZERO { fail(blank(at)?.0, zero_vector(4)) } else { Ok((rest, ())) }
        }
        b"cl" => store(&mut camera.clip, numbers(input), pair),
        b"ph" => store(&mut camera.film, numbers(input), |x: [f64; 4]| x),
        b"va" => {
            let (rest, across) = require(number(input))?;
            let (rest, down) = opt(number).parse(rest)?;
            camera.view_angle = Some([across, down.unwrap_or(across)]);
            Ok((rest, ()))
        }
        b"fs" => store(&mut camera.film_size, numbers(input), pair),
        b"fl" => store(&mut camera.focal_length, number(input), |x| x),
        b"og" => {
            camera.projection = Some(Projection::Orthographic);
            Ok((input, ()))
        }
        b"ps" => {
            camera.projection = Some(Projection::Perspective);
            Ok((input, ()))
        }
        _ => {
            fail(blank(at)?.0, Reason::Expected("a camera option (-vc -ep -ud -cl -ph -og -ps -va -fs -fl)"))
        }
    }
}
