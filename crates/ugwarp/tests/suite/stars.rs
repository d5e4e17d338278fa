//! Stars in pictures against theory: where they are, and how bright.

use core::f64::consts::{PI, TAU};

use glam::DVec3;
use ugimage::LinearFrame;
use ugphysics::spectrum::{integrate, planck};
use ugphysics::{Velocity, linear_srgb_to_xyz};
use ugwarp::{
    CameraOptions, Config, Extent, Lens, Panorama, PictureOptions, Sky, Star, StarOptions, Texels,
    light, read_stars,
};

/// One square degree, in steradians.
const SQUARE_DEGREE: f64 = (PI / 180.0) * (PI / 180.0);

fn config(beta: f64, lens: Lens, size: [u32; 2]) -> Config {
    let camera = CameraOptions { view_angle: Some((90.0, None)), ..CameraOptions::default() };
    Config {
        velocity: Velocity::from_beta(DVec3::new(0.0, beta, 0.0)).unwrap(),
        lens,
        picture: PictureOptions { size, samples: 1, camera, ..PictureOptions::default() },
        stars: StarOptions { white: 0.0, ..StarOptions::default() },
        ..Config::default()
    }
}

/// Solid angle from the middle of a film at distance 1 to a place.
fn corner(x: f64, y: f64) -> f64 {
    libm::atan2(x * y, (x * x + y * y + 1.0).sqrt())
}

/// Direction and solid angle of a pixel, by textbook formulas; `None` outside a fisheye.
fn pixel(lens: Lens, [width, height]: [f64; 2], [x, y]: [f64; 2]) -> Option<(DVec3, f64)> {
    match lens {
        // 90 degrees across.
        Lens::Pinhole => {
            let place = |x: f64, y: f64| [2.0 * x / width - 1.0, (height - 2.0 * y) / width];
            let [u, v] = place(x + 0.5, y + 0.5);
            let [west, north] = place(x, y);
            let [east, south] = place(x + 1.0, y + 1.0);
            let area = corner(east, north) - corner(west, north) - corner(east, south)
                + corner(west, south);
            Some((DVec3::new(u, 1.0, v).normalize(), area))
        }
        Lens::Panorama => {
            let (sin, cos) = libm::sincos(TAU * ((x + 0.5) / width - 0.5));
            let sine = |y: f64| libm::cos(PI * y / height);
            let (up, level) = (sine(y + 0.5), libm::sin(PI * (y + 0.5) / height));
            Some((
                DVec3::new(level * sin, level * cos, up),
                TAU / width * (sine(y) - sine(y + 1.0)),
            ))
        }
        Lens::Fisheye { angle } => {
            let per_pixel = angle / width.min(height);
            let (right, above) = (x + 0.5 - 0.5 * width, 0.5 * height - y - 0.5);
            let from_middle = (per_pixel * libm::hypot(right, above)).max(1e-12);
            if from_middle > 0.5 * angle {
                return None;
            }
            let (sin, cos) = libm::sincos(from_middle);
            let part = per_pixel * sin / from_middle;
            Some((DVec3::new(right * part, cos, above * part), per_pixel * part))
        }
        Lens::Cube => {
            let (side, x) = ((x / height) as usize, x % height);
            let place = |x: f64, y: f64| [2.0 * x / height - 1.0, 1.0 - 2.0 * y / height];
            let [u, v] = place(x + 0.5, y + 0.5);
            let [west, north] = place(x, y);
            let [east, south] = place(x + 1.0, y + 1.0);
            let area = corner(east, north) - corner(west, north) - corner(east, south)
                + corner(west, south);
            let direction = match side {
                0 => DVec3::new(1.0, -u, v),
                1 => DVec3::new(-1.0, u, v),
                2 => DVec3::new(u, -v, 1.0),
                3 => DVec3::new(u, v, -1.0),
                4 => DVec3::new(u, 1.0, v),
                _ => DVec3::new(-u, -1.0, v),
            };
            Some((direction.normalize(), area))
        }
    }
}

/// Irradiance as X, Y, Z in units of a star of magnitude 0, and its mean direction.
fn measured(frame: &LinearFrame, lens: Lens) -> ([f64; 3], DVec3) {
    let size = [frame.width(), frame.height()].map(f64::from);
    let (mut sum, mut direction) = ([0.0; 3], DVec3::ZERO);
    for (idx, light) in frame.pixels().iter().enumerate() {
        let at = [idx as u32 % frame.width(), idx as u32 / frame.width()].map(f64::from);
        let Some((seen, area)) = pixel(lens, size, at) else { continue };
        let xyz = linear_srgb_to_xyz([light[0], light[1], light[2]].map(f64::from));
        (0..3).for_each(|i| sum[i] += xyz[i] * area / SQUARE_DEGREE);
        direction += xyz[1] * area * seen;
    }
    (sum, direction.normalize_or_zero())
}

/// What theory says about a star at an angle to the motion: angle seen, Doppler factor, and
/// irradiance per that of magnitude 0.
fn theory(angle: f64, beta: f64, kelvin: f64) -> (f64, f64, [f64; 3]) {
    let cos = libm::cos(angle);
    let gamma = 1.0 / (1.0 - beta * beta).sqrt();
    let doppler = gamma * (1.0 + beta * cos);
    let seen = libm::acos((cos + beta) / (1.0 + beta * cos));
    let rest = integrate(|nm| planck(nm, kelvin))[1];
    // Radiance of a black body of D T, in a solid angle 1/D² of that at rest.
    let irradiance =
        integrate(|nm| planck(nm, doppler * kelvin)).map(|part| part / rest / (doppler * doppler));
    (seen, doppler, irradiance)
}

const LENSES: [(Lens, [u32; 2]); 4] = [
    (Lens::Pinhole, [401, 401]),
    (Lens::Panorama, [800, 400]),
    (Lens::Fisheye { angle: PI }, [501, 501]),
    (Lens::Cube, [1200, 200]),
];

/// Directions, colours and magnitudes at rest, at 0.5, 0.9 and 0.99c, in every lens.
#[test]
fn stars_are_where_and_as_bright_as_theory_says() {
    let mut n_seen = 0;
    for beta in [0.0, 0.5, 0.9, 0.99] {
        for (idx, degrees) in
            [0.0_f64, 3.0, 20.0, 41.0, 75.0, 100.0, 140.0, 179.0].into_iter().enumerate()
        {
            let angle = degrees.to_radians();
            let turn = 0.7 + 1.9 * idx as f64;
            let aside = DVec3::new(libm::cos(turn), 0.0, libm::sin(turn));
            let kelvin = [3400.0, 5800.0, 9700.0, 25_000.0][idx % 4];
            let direction = libm::cos(angle) * DVec3::Y + libm::sin(angle) * aside;
            let star = Star { direction, magnitude: 1.5, kelvin };
            let (seen, _, irradiance) = theory(angle, beta, kelvin);
            let expected = libm::cos(seen) * DVec3::Y + libm::sin(seen) * aside;
            for (lens, size) in LENSES {
                let limit = match lens {
                    Lens::Pinhole => PI / 4.0 - 0.03,
                    Lens::Fisheye { angle } => 0.5 * angle - 0.03,
                    _ => 4.0,
                };
                if seen > limit {
                    continue;
                }
                n_seen += 1;
                let frame = light([star].as_slice(), &config(beta, lens, size)).unwrap();
                let (xyz, mean) = measured(&frame, lens);
                let pixel_side = PI / f64::from(size[1]);
                let apart = (mean - expected).length() / pixel_side;
                assert!(apart < 0.02, "{lens:?} {beta} {degrees}: {apart} pixels");
                let size = irradiance.iter().fold(0.0_f64, |most, part| most.max(*part));
                for axis in 0..3 {
                    let expected = irradiance[axis] * libm::exp10(-0.6);
                    let error = (xyz[axis] - expected).abs() / (size * libm::exp10(-0.6));
                    assert!(
                        error < 1e-3,
                        "{lens:?} {beta} {degrees} {axis}: {} {expected}",
                        xyz[axis]
                    );
                }
            }
        }
    }
    assert!(n_seen > 80, "{n_seen}");
}

/// The light of a star does not depend on its place between the middles of pixels, at seams and
/// poles either, and adds to that of a panorama.
#[test]
fn light_is_conserved_at_every_place() {
    let grey = vec![[0.25, 0.25, 0.25, 1.0]; 64 * 32];
    let sky = Panorama::new([64, 32], Texels::Light(grey), Extent::FULL).unwrap();
    for (lens, size) in LENSES {
        let size = size.map(|side| side / 4);
        for width in [0.5, 1.0, 1.7, 5.0] {
            let mut config = config(0.0, lens, size);
            config.stars.width = width;
            let mut places = vec![DVec3::Y, DVec3::new(0.01, 1.0, 0.4)];
            if lens != Lens::Pinhole {
                places.extend([DVec3::Z, DVec3::new(1e-3, 1e-3, 1.0), DVec3::new(0.3, 1e-3, -1.0)]);
            }
            if matches!(lens, Lens::Panorama | Lens::Cube) {
                places.extend([
                    DVec3::NEG_Y,
                    DVec3::ONE,
                    DVec3::new(1.0, -1.0, 0.2),
                    DVec3::new(-0.01, -1.0, 0.3),
                ]);
            }
            // Near the rim of a fisheye a part of a pixel is outside.
            let limit = if matches!(lens, Lens::Fisheye { .. }) { 0.02 } else { 2e-3 };
            let plain = light(&sky, &config).unwrap();
            for place in places {
                for step in 0..5 {
                    let nudge = 0.003 * f64::from(step) * place.any_orthogonal_vector();
                    let direction = (place + nudge).normalize();
                    let star = Star { direction, magnitude: 0.0, kelvin: 6000.0 };
                    let frame = light([star].as_slice(), &config).unwrap();
                    let (xyz, _) = measured(&frame, lens);
                    assert!(
                        (xyz[1] - 1.0).abs() < limit,
                        "{lens:?} {width} {direction}: {}",
                        xyz[1]
                    );
                    if step > 0 {
                        continue;
                    }
                    let both =
                        Sky { panorama: Some(&sky), bands: &[], stars: &[star], highlights: None };
                    let on_grey = light(both, &config).unwrap();
                    let pairs = plain.pixels().iter().zip(frame.pixels());
                    for (found, (behind, star)) in on_grey.pixels().iter().zip(pairs) {
                        let error = (found[1] - behind[1] - star[1]).abs();
                        assert!(
                            error <= 1e-6 * found[1].abs().max(1.0),
                            "{found:?} {behind:?} {star:?}"
                        );
                    }
                }
            }
        }
    }
}

/// More stars than are in memory at once.
#[test]
fn many_stars_add_up() {
    const N: u32 = 200_000;
    let star = |idx: u32| {
        let part = |by: f64| (f64::from(idx) * by).fract();
        let (z, turn) = (2.0 * part(0.618_033_988_7) - 1.0, TAU * part(0.754_877_666_2));
        let level = (1.0 - z * z).sqrt();
        let direction = DVec3::new(level * libm::sin(turn), level * libm::cos(turn), z);
        Star { direction, magnitude: 5.0, kelvin: 5800.0 }
    };
    let stars: Vec<Star> = (0..N).map(star).collect();
    let frame = light(stars.as_slice(), &config(0.0, Lens::Panorama, [256, 128])).unwrap();
    let (xyz, _) = measured(&frame, Lens::Panorama);
    assert!((xyz[1] / (f64::from(N) * 0.01) - 1.0).abs() < 1e-3, "{}", xyz[1]);
}

#[test]
fn lists_have_several_frames_and_colours() {
    let text = "\u{feff}# two stars\r\nname,RA,Dec,mag,kelvin\r\n\"A, b\",90,30,1.5,5000\r\n\r\n north ,0,90,-1,3e4\r\n";
    let stars = read_stars("t.csv", text.as_bytes()).unwrap().stars;
    assert_eq!(stars.len(), 2);
    // Right ascension increases to the left of a sky with the north up.
    let (up, level) = (0.5, 0.75_f64.sqrt());
    assert!((stars[0].direction - DVec3::new(-level, 0.0, up)).length() < 1e-15);
    assert_eq!((stars[0].magnitude, stars[0].kelvin), (1.5, 5000.0));
    assert!((stars[1].direction - DVec3::Z).length() < 1e-15);
    for text in [
        "ra_hours,dec,mag,kelvin\n6,30,1.5,5000",
        "lon,lat,mag,kelvin\n-90,30,1.5,5000",
        "x,y,z,mag,kelvin\n-173.205080756887729,0,100,1.5,5000",
        "# a, b, c\nra;dec;mag;kelvin\n90;30;1.5;5000",
        "ra\tdec\tname\tmag\tkelvin\n90\t30\tA, b\t1.5\t5000",
    ] {
        let other = read_stars("t.csv", text.as_bytes()).unwrap().stars;
        assert!((other[0].direction - stars[0].direction).length() < 1e-12, "{text}");
    }
    // The Sun: B − V of 0.65 and about 5780 K (Ballesteros 2012).
    let sun = read_stars("t.csv", b"lon,lat,mag,b-v\n0,0,0,0.65").unwrap().stars;
    assert!((sun[0].kelvin - 5780.0).abs() < 30.0, "{}", sun[0].kelvin);
}

/// Hours or degrees, minutes and seconds, as VizieR writes them; the sign is that of all parts.
#[test]
fn angles_may_be_sexagesimal() {
    #[track_caller]
    fn check(names: &str, fields: &str, ra: f64, dec: f64) {
        let text = format!("{names},Vmag,B-V\n{fields},1.0,0.5\n");
        let list = read_stars("t.csv", text.as_bytes()).unwrap();
        let (sin, cos) = libm::sincos(-ra.to_radians());
        let (up, level) = libm::sincos(dec.to_radians());
        let expected = DVec3::new(level * sin, level * cos, up);
        assert!((list.stars[0].direction - expected).length() < 1e-15, "{fields}");
        assert_eq!(list.notes, [""; 0], "{fields}");
    }
    let vizier = "RAJ2000,DEJ2000";
    check(vizier, "05 30 00.0,-00 30 00.0", 82.5, -0.5);
    check(vizier, "05:30:00.0,+00:30:36", 82.5, 0.51);
    check(vizier, "5h30m0s,-0\u{b0}30'36\"", 82.5, -0.51);
    check(vizier, "5 30.5,-00 30.6", 82.625, -0.51);
    check(vizier, "82d30m,-89 59 60.0", 82.5, -90.0);
    check("ra_hours,dec", "05 30 00,1 0 0", 82.5, 1.0);
    check("lon,lat", "-00 30 00,-0:30:0", 0.5, -0.5);
    let refused = |text: &str, expected: &str| {
        let text = format!("ra,dec,mag,kelvin\n{text},1,5000\n");
        let found = read_stars("t.csv", text.as_bytes()).unwrap_err().render(false);
        assert!(found.contains(expected), "{text}: {found}");
    };
    refused("5 60 0,1", "`5 60 0` is not a number");
    refused("5 0 61,1", "`5 0 61` is not a number");
    refused("5.5 0 0,1", "`5.5 0 0` is not a number");
    refused("1 2 3 4,1", "`ra` takes degrees from -360 to 360, or `hh mm ss` or `hh:mm:ss`");
    refused("1,--1 0 0", "`dec` takes degrees from -90 to 90, or `dd mm ss` or `dd:mm:ss`");
    refused("1,5h0m0s", "`5h0m0s` is not a number");
    refused("1,5 -1 0", "`5 -1 0` is not a number");
    refused("25 0 0,1", "`25 0 0` is out of range");
    // `hh mm ss` with hours below 1 gets no note that the column may be in hours.
    let list = b"ra,dec,mag,kelvin\n0 10 0,1,1,5000\n0 20 0,1,1,5000\n";
    assert_eq!(read_stars("t.csv", list).unwrap().notes, [""; 0]);
}

#[test]
fn mistakes_in_lists_are_shown() {
    let message = |text: &str| read_stars("sky.csv", text.as_bytes()).unwrap_err().render(false);
    for separator in ["\t", ";"] {
        let text = "ra,dec,mag,kelvin\n10,20,,5000\n10,20,1.0,hot\n".replace(',', separator);
        let places = message(&text);
        assert!(places.contains("--> sky.csv:3:11"), "{places}");
    }
    let text = "ra,dec,mag,kelvin\n10,20,1.0,hot\n10,120,1.0,5000\n10,20,1.0\n";
    assert_eq!(
        message(text).trim_end(),
        "error: `hot` is not a number
 --> sky.csv:2:11
  |
2 | 10,20,1.0,hot
  |           ^^^
  |
help: `kelvin` takes kelvins from 100 to 1000000

error: `120` is out of range
 --> sky.csv:3:4
  |
3 | 10,120,1.0,5000
  |    ^^^
  |
help: `dec` takes degrees from -90 to 90

error: 3 fields where 4 columns have names
 --> sky.csv:4:1
  |
4 | 10,20,1.0
  | ^^^^^^^^^
  |
help: write as many fields in each line; put a field with a comma in double quotes, without blanks around them"
    );
    for (text, expected) in [
        ("ra,mag,kelvin\n", "a list of stars without directions"),
        ("ra,dec,kelvin\n", "a list of stars without magnitudes"),
        ("ra,dec,mag\n", "a list of stars without temperatures"),
        ("ra,dec,mag,mag,kelvin\n", "the column `mag` is there twice"),
        ("x,y,z,mag,kelvin\n0,0,0,1,5000\n", "a star without a direction"),
        ("ra,dec,mag,kelvin\n1,2,inf,5000\n", "`inf` is out of range"),
        (
            "ra,dec,mag,kelvin\n1,\u{2212}2,3,5000\n",
            "`\u{2212}` (U+2212) is a minus sign of Unicode",
        ),
        (
            "ra;dec;mag;kelvin\n1,5;2;3;5000\n",
            "`ra` takes degrees from -360 to 360, with a decimal point",
        ),
        (
            "ra,dec,phot_g_mean_mag,bp_rp\n1,2,3,4\n",
            "`bp_rp` is not `b-v`, and Gaia has `teff_gspphot`",
        ),
        ("10,20,1,5000\n", "a list of stars without directions"),
        ("", "a list of stars without a line of column names"),
    ] {
        let found = message(text);
        assert!(found.contains(expected) && found.contains("help: "), "{text}: {found}");
    }
}

/// Lists as catalogues write them: names, units and separators, all with the same star.
#[test]
fn columns_of_catalogues_are_understood() {
    let expected = read_stars("t.csv", b"ra,dec,mag,kelvin\n105,-16.5,-1.5,9940").unwrap().stars;
    let hyg = "the list has the columns of the HYG catalogue: its right ascensions are in hours";
    let below =
        "all right ascensions are below 24 degrees: if they are hours, name the column `ra_hours`";
    let incomplete = "1 stars of the list are left out, since they have not all of a direction, a magnitude and a \
                      temperature or colour index";
    let header = "#\n_RAJ2000\t_DEJ2000\tRAJ2000\tDEJ2000\tVmag\tTeff\n";
    let vizier =
        format!("{header}deg\tdeg\t\"h:m:s\"\t\"d:m:s\"\tmag\tK\n---\t---\t---\t---\t---\t---\n");
    let vizier = format!("{vizier}105\t-16.5\t07 00 00\t-16 30 00\t-1.5\t9940\n");
    let nothing =
        "ra,dec,Gmag,mag,kelvin\n105,-16.5,2,-1.5,9940\n1,2,3,4,null\n1,2,3,4,--\n1,2,3,NaN,5000";
    let all_incomplete = incomplete.replace('1', "3");
    for (text, notes) in [
        (&*vizier, &[][..]),
        ("sep=|\nra|dec|mag|kelvin\n105|-16.5|-1.5|9940", &[]),
        (nothing, &[&*all_incomplete]),
        ("ra [deg],dec (deg),mag,T [K]\n105,-16.5,-1.5,9940", &[][..]),
        ("RA (h);Dec;Vmag;Teff\n7;-16.5;-1.5;9940", &[]),
        ("ra   dec  mag kelvin name\n105 -16.5 -1.5  9940 Sirius\n", &[]),
        (
            "ra,dec,phot_g_mean_mag,bp_rp,teff_gspphot\n105,-16.5,-1.5,.1,9940\n1,2,3,4,",
            &[incomplete],
        ),
        (
            "id,ra,dec,dist,mag,kelvin,rarad\n0,0,0,0,-26.7,5770,0\n1,7,-16.5,2.6,-1.5,9940,1",
            &[incomplete, hyg],
        ),
    ] {
        let found = read_stars("t.csv", text.as_bytes()).unwrap_or_else(|found| panic!("{found}"));
        assert!(ugwarp::is_star_list("t.txt", text.as_bytes()), "{text}");
        assert_eq!(
            (found.stars, found.notes.iter().map(String::as_str).collect::<Vec<_>>()),
            (expected.clone(), notes.to_vec()),
            "{text}"
        );
    }
    // Tables by name, but not what is something else.
    let is_table = |file: &[u8]| ugwarp::is_star_list("t.CSV", file);
    assert!(
        is_table(b"1,2\n")
            && is_table(b"a|b\n")
            && !is_table(b"<html>")
            && !is_table(b"\x89PNG\r\n\x1a\n")
    );
    let hours = read_stars("t.csv", b"ra,dec,mag,b-v\n6,1,2,0\n7,1,2,0").unwrap();
    assert_eq!(hours.notes, [below]);
    let words = "ra dec mag kelvin\n1  2 3 hot";
    assert!(
        read_stars("t.csv", words.as_bytes()).unwrap_err().render(false).contains("--> t.csv:2:8")
    );
}

/// The list of the gallery: Orion's belt is three stars in a row, as bright as each other.
#[test]
fn the_list_of_the_gallery_is_read() {
    let stars =
        read_stars("stars.csv", include_bytes!("../../../../scenes/stars.csv")).unwrap().stars;
    assert!(stars.len() > 5000, "{}", stars.len());
    let belt = |star: &&Star| star.direction.angle_between(DVec3::new(-0.995, 0.1, -0.02)) < 0.03;
    let belt: Vec<&Star> = stars.iter().filter(belt).filter(|star| star.magnitude < 2.5).collect();
    assert_eq!(belt.len(), 3);
    let magnitudes = |low: f64, high: f64| {
        stars.iter().filter(|star| (low..high).contains(&star.magnitude)).count() as f64
    };
    let growth = magnitudes(5.0, 6.0) / magnitudes(4.0, 5.0);
    assert!((2.7..3.7).contains(&growth), "{growth}");
}
