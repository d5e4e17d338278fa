//! Options of the programs' libraries, for pipes in memory.

use glam::DVec3;
use ugimage::{Filter, Format, Tone};
use ugphysics::{Brightness, Hsv, Velocity};
use ugrainbow::{
    AnnotationOptions, Background, CameraOptions, Channel, ColorShift, DepthCue, Exposure, HueScale,
    Interpolation, Output, PictureOptions, SpectralShift, TextForm, Wireframe,
};
use ugtesting::Random;
use ugwarp::{Basis, Lens};

use super::words;

/// Options of `uglorentz`. Subdivision is coarse, since many pieces take long.
pub fn lorentz(random: &mut Random) -> uglorentz::Config {
    uglorentz::Config {
        velocity: maybe(random, 2, beta),
        camera_velocity: maybe(random, 5, beta),
        eye: maybe(random, 8, point),
        camera: camera(random),
        size: [1 + random.below(64) as u32, 1 + random.below(64) as u32],
        cull: random.one_in(5),
        time: if random.one_in(6) { number(random) } else { 0.0 },
        anchor: maybe(random, 6, anchor),
        in_place: random.one_in(3),
        pieces: match random.below(3) {
            0 => uglorentz::Pieces::PerEdge(1 + random.below(3) as u32),
            1 => uglorentz::Pieces::PerEdge(1),
            _ => uglorentz::Pieces::UpTo(0.3),
        },
        color_error: if random.one_in(4) { 0.5 } else { f64::INFINITY },
        light_error: if random.one_in(4) { 0.5 } else { f64::INFINITY },
        measure: random.one_in(4),
        smooth: random.one_in(4),
        repeat: random.one_in(4),
        geometry: ugscene::Geometry { contraction: !random.one_in(8), flight_time: !random.one_in(8) },
    }
}

/// Options of `ugdoppler`.
pub fn doppler(random: &mut Random) -> ugdoppler::Config {
    ugdoppler::Config {
        velocity: maybe(random, 6, beta)
            .and_then(|beta| Velocity::from_beta(beta).ok())
            .unwrap_or(Velocity::ZERO),
        eye: maybe(random, 8, point),
        wavelengths: random.one_in(3),
        shift: shift(random),
        repeat: random.one_in(4),
        tolerance: if random.one_in(4) { number(random).abs() } else { 0.1 },
        iris: random.one_in(4),
        light: random.one_in(3),
        keep: random.one_in(3),
    }
}

/// Options of `ugrainbow`.
pub fn rainbow(random: &mut Random) -> ugrainbow::Config {
    ugrainbow::Config {
        interpolation: *random.pick(&[Interpolation::Hue, Interpolation::Wavelength]),
        hue_scale: *random.pick(&[HueScale::Degrees, HueScale::Degrees, HueScale::Wavelengths]),
        picture: picture(random),
        reading: ugparse::Options::default(),
        wireframe: maybe(random, 4, |random| Wireframe {
            has_faces: random.one_in(2),
            color: maybe(random, 2, color),
        }),
        line_width: random.between(0.1, 9.0),
        depth_cue: maybe(random, 6, |random| DepthCue {
            range: maybe(random, 2, |random| [number(random), number(random)])
                .filter(|[near, far]| near < far),
            least: random.unit(),
        }),
        exact: maybe(random, 4, shift),
        cull: random.one_in(6),
        repeat: random.one_in(6),
    }
}

/// Options of `ugwarp`.
pub fn warp(random: &mut Random) -> ugwarp::Config {
    let velocity = |random: &mut Random| Velocity::from_beta(beta(random)).ok();
    ugwarp::Config {
        velocity: velocity(random).unwrap_or(Velocity::ZERO),
        camera: Box::default(),
        time: number(random),
        shift: shift(random),
        basis: match random.below(3) {
            0 => Basis::Planck([number(random), number(random), number(random)]),
            1 => Basis::Planck([3500.0, 5900.0, 10000.0]),
            _ => Basis::Mixture,
        },
        picture: picture(random),
        lens: match random.below(4) {
            0 => Lens::Panorama,
            1 => Lens::Fisheye { angle: random.between(0.0, std::f64::consts::TAU) },
            2 => Lens::Cube,
            _ => Lens::Pinhole,
        },
        stars: ugwarp::StarOptions { width: random.between(0.4, 52.0), white: number(random) },
        range_nm: if random.one_in(4) { 360.0..830.0 } else { ugwarp::ALL_NM },
    }
}

fn maybe<T>(random: &mut Random, one_in: usize, value: impl Fn(&mut Random) -> T) -> Option<T> {
    random.one_in(one_in).then(|| value(random))
}

/// A finite number: the command line accepts no other.
fn number(random: &mut Random) -> f64 {
    words::number(random).parse().ok().filter(|number: &f64| number.is_finite()).unwrap_or(1.0)
}

fn point(random: &mut Random) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| number(random)))
}

fn beta(random: &mut Random) -> DVec3 {
    let component = |random: &mut Random| words::beta(random).parse().ok().filter(|b: &f64| b.is_finite());
    DVec3::from_array([(); 3].map(|()| component(random).unwrap_or(0.5)))
}

fn anchor(random: &mut Random) -> uglorentz::Anchor {
    use uglorentz::Anchor;
    match random.below(4) {
        0 => Anchor::Eye,
        1 => Anchor::Origin,
        2 => Anchor::Center,
        _ => Anchor::Point(point(random)),
    }
}

fn camera(random: &mut Random) -> CameraOptions {
    CameraOptions {
        name: None,
        eye: maybe(random, 8, point),
        center: maybe(random, 6, point),
        up: maybe(random, 8, point),
        view_angle: maybe(random, 6, |random| (number(random), maybe(random, 3, number))),
        is_orthographic: random.one_in(8),
    }
}

fn color(random: &mut Random) -> Hsv {
    Hsv { hue: number(random), saturation: random.unit(), value: random.unit() }
}

fn shift(random: &mut Random) -> ColorShift {
    let doppler = !random.one_in(4);
    if random.one_in(2) {
        return ColorShift::Spectra(SpectralShift { doppler, flux: !random.one_in(4) });
    }
    ColorShift::hues(doppler, *random.pick(&Brightness::ALL))
}

fn picture(random: &mut Random) -> PictureOptions {
    const FORMATS: [Format; 4] = [Format::Png, Format::Png16, Format::Ppm, Format::Exr];
    let output = match random.below(11) {
        0 => Output::Vector(*random.pick(&[Format::Eps, Format::Pdf, Format::Svg])),
        1 => Output::Color(*random.pick(&[Format::Pfm, Format::Hdr, Format::Svg])),
        _ => Output::Color(*random.pick(&FORMATS)),
    };
    let is_exr = output == Output::Color(Format::Exr);
    PictureOptions {
        camera: camera(random),
        size: [1 + random.below(12) as u32, 1 + random.below(12) as u32],
        samples: 1 + random.below(3) as u32,
        filter: *random.pick(&Filter::ALL),
        background: match random.below(3) {
            0 => Background::Transparent,
            _ => Background::Color(color(random)),
        },
        output,
        exposure: maybe(random, 5, |random| match random.below(2) {
            0 => Exposure::Auto,
            _ => Exposure::Stops(random.between(-300.0, 300.0)),
        }),
        tone: *random.pick(&Tone::ALL),
        channels: if is_exr && random.one_in(2) { Channel::ALL.to_vec() } else { Vec::new() },
        small: random.one_in(50),
        // Text needs room, and takes longer than all else in a small picture.
        annotations: AnnotationOptions {
            caption: String::new(),
            legend: random.one_in(20),
            outline: random.one_in(4),
            grid: random.one_in(4),
        },
        text: *random.pick(&[TextForm::Outlines, TextForm::Text]),
    }
}
