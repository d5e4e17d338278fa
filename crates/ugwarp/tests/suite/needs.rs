//! Which part of a panorama a picture needs: by laws of aberration, and by pictures of panoramas
//! whose other pixels are changed.

use core::f64::consts::TAU;

use glam::DVec3;
use ugphysics::Velocity;
use ugtesting::Random;
use ugwarp::{
    CameraOptions, ColorShift, Config, Extent, Lens, Needs, Opened, Panorama, PictureOptions,
    Texels, light, needs,
};

/// A panorama of noise: that of `inside` in a part, and that of `outside` elsewhere.
fn noise(
    size: [u32; 2],
    extent: Extent,
    is_inside: impl Fn(u32, u32) -> bool,
    outside: u64,
) -> Panorama {
    let texel = |idx: u32| {
        let seed = if is_inside(idx % size[0], idx / size[0]) { 1 } else { outside };
        let value = Random(seed.wrapping_mul(1 << 32) + u64::from(idx)).bits() as u32;
        let part = |bits: u32| (value >> bits & 255) as f32 / 255.0;
        [part(0), part(8), part(16), 1.0]
    };
    Panorama::new(size, Texels::Light((0..size[0] * size[1]).map(texel).collect()), extent).unwrap()
}

fn opened(panorama: Panorama) -> Opened {
    Opened { panorama: Some(panorama), ..Opened::default() }
}

fn grey(size: [u32; 2]) -> Opened {
    let texels = Texels::Srgb(vec![[128, 128, 128, 255]; size[0] as usize * size[1] as usize]);
    opened(Panorama::new(size, texels, Extent::FULL).unwrap())
}

fn config(beta: DVec3, size: [u32; 2], lens: Lens) -> Config {
    let velocity = Velocity::from_beta(beta).unwrap();
    let picture = PictureOptions { size, samples: 1, ..PictureOptions::default() };
    Config { velocity, shift: ColorShift::NONE, picture, lens, ..Config::default() }
}

fn needed(sky: &Opened, config: &Config) -> Needs {
    needs(sky, config, &()).unwrap().unwrap()
}

/// The angle in the sky of an angle to the motion.  Eq. (P6)
fn carried(beta: f64, angle: f64) -> f64 {
    2.0 * libm::atan(((1.0 + beta) / (1.0 - beta)).sqrt() * libm::tan(0.5 * angle))
}

/// A fisheye that looks ahead or back needs a disc of the angle by the formula of aberration, and
/// the filter: about a pixel of the picture and two of the panorama. Its pixels are wider by D.
#[test]
fn a_view_needs_its_angle_and_aberration_changes_it() {
    let sky = grey([1440, 720]);
    let texel = TAU / 1440.0;
    for beta in [0.0, 0.5, 0.9, -0.6, -0.99] {
        for degrees in [20.0_f64, 60.0, 120.0] {
            let angle = degrees.to_radians();
            let half = carried(beta, 0.5 * angle);
            // Beyond it a disc has a pole within, and all longitudes.
            if half > 1.3 {
                continue;
            }
            let config = config(DVec3::Y * beta, [301, 301], Lens::Fisheye { angle });
            let found = needed(&sky, &config);
            let gamma = 1.0 / (1.0 - beta * beta).sqrt();
            let doppler = |angle: f64| 1.0 / (gamma * (1.0 - beta * libm::cos(angle)));
            let [middle, rim] = [doppler(0.0), doppler(0.5 * angle)];
            let pixel = angle / 301.0;
            // The last middle is up to half a pixel within the rim, and the footprint is a pixel in
            // radius.
            let filter = libm::hypot(rim * pixel, 2.0 * texel);
            let [low, high] = [half - rim * pixel, half + 1.1 * filter + 3.0 * texel];
            let [west, east] = found.longitudes_deg().map(f64::to_radians);
            let [south, north] = found.latitudes_deg().map(f64::to_radians);
            for edge in [-west, east, -south, north] {
                let is_right = (low..=high).contains(&edge);
                assert!(is_right, "{beta} {degrees}: {edge} not in {low} to {high}");
            }
            let sides = [middle.min(rim), middle.max(rim)].map(|factor| factor * pixel / texel);
            for (found, side) in found.part.sides.into_iter().zip(sides) {
                assert!((found / side - 1.0).abs() < 0.01, "{beta} {degrees}: {found} {side}");
            }
        }
    }
}

/// A panorama at rest needs one of its own size; a fast one ahead needs 1/D behind.
#[test]
fn a_whole_panorama_needs_its_own_size() {
    let sky = grey([360, 180]);
    for (size, beta, rows) in
        [([720, 360], 0.0, 360.0), ([200, 100], 0.0, 100.0), ([200, 100], 0.6, 200.0)]
    {
        let found = needed(&sky, &config(DVec3::Y * beta, size, Lens::Panorama));
        assert_eq!([found.part.n_columns, found.part.n_rows], [360, 180]);
        let [columns, found] = found.whole_size();
        assert!(columns == 2.0 * found && (found - rows).abs() < 0.02 * rows, "{beta}: {found}");
    }
}

/// Random views, over poles, the date line and edges, of noise: their light does not depend on the
/// pixels outside the part that is needed.
#[test]
fn pixels_outside_the_part_have_no_effect() {
    let mut random = Random(68);
    let (mut n_parts, mut n_around) = (0, 0);
    for round in 0..60 {
        let size = [[64, 32], [200, 100], [333, 170]][round % 3];
        let extent = match round % 4 {
            3 => Extent { longitudes: [-1.9, 1.5], latitudes: [-0.8, 1.2] },
            _ => Extent::FULL,
        };
        let beta = random.direction() * random.between(0.0, 0.98);
        let lens = match round % 5 {
            0 => Lens::Fisheye { angle: random.between(0.2, 3.0) },
            _ => Lens::Pinhole,
        };
        let mut config = config(beta, [24, 18], lens);
        config.picture.samples = [1, 1, 2][round % 3];
        config.picture.camera = CameraOptions {
            center: Some(random.direction()),
            up: Some(random.direction()),
            view_angle: Some((random.between(5.0, 100.0), None)),
            ..CameraOptions::default()
        };
        let whole = opened(noise(size, extent, |_, _| true, 0));
        let Some(Needs { part, .. }) = needs(&whole, &config, &()).unwrap() else {
            continue;
        };
        let is_inside = |column: u32, row: u32| {
            (column + size[0] - part.column) % size[0] < part.n_columns
                && (part.row..part.row + part.n_rows).contains(&row)
        };
        let changed = opened(noise(size, extent, is_inside, 7));
        let [one, other] =
            [&whole, &changed].map(|sky| light(sky, &config).unwrap().pixels().to_vec());
        assert!(one == other, "round {round}: {beta} {part:?}");
        n_parts += usize::from(part.n_columns * part.n_rows < size[0] * size[1] / 2);
        n_around += usize::from(part.column + part.n_columns > size[0]);
    }
    assert!(n_parts > 15 && n_around > 3, "{n_parts} {n_around}");
}
