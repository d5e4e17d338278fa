//! Edges drawn as lines depend neither on the subdivision of faces nor on the drawing mode.

use glam::DVec3;
use ugphysics::Hsv;
use ugrainbow::{ColorShift, Config, Wireframe};
use ugtests::picture::{Picture, decode};
use ugtests::pipe::{lorentz, rainbow};
use ugtests::scenes;

/// A cube about the origin; its faces are of three colours, so that some edges lie between two of
/// one colour.
fn cube() -> String {
    let mut text = "l 1; c a .9; c b .8; c c .7;".to_owned();
    for k in 0..8 {
        let at = |bit: usize| if k >> bit & 1 == 0 { -1 } else { 1 };
        text += &format!("v v{k} {} {} {};", at(0), at(1), at(2));
    }
    for (face, color) in [
        ("0 2 3 1", "a"),
        ("4 5 7 6", "a"),
        ("0 1 5 4", "b"),
        ("1 3 7 5", "b"),
        ("3 2 6 7", "c"),
        ("2 0 4 6", "c"),
    ] {
        text += &format!("f (v{}) {color};", face.replace(' ', " v"));
    }
    text + "cam -ep 1 -7 4 -vc 0 0 0 -va 40 40;"
}

/// Draws the cube at 0.9c, with edges cut into `n_pieces`.
fn drawn(n_pieces: u32, config: &Config) -> Picture {
    let cut = uglorentz::Config {
        velocity: Some(0.9 * DVec3::X),
        in_place: true,
        pieces: uglorentz::Pieces::PerEdge(n_pieces),
        ..uglorentz::Config::default()
    };
    decode(&rainbow(&lorentz(cube().as_bytes(), &cut), config))
}

/// The number of lit pixels in the first picture, and of those that differ much.
fn compared(one: &Picture, other: &Picture) -> (usize, usize) {
    let n_lit = one.pixels().filter(|pixel| pixel[0] > 128).count();
    let differs = |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| a[0].abs_diff(b[0]) > 90;
    (n_lit, one.pixels().zip(other.pixels()).filter(differs).count())
}

fn edges() -> Config {
    let white = Hsv { hue: 0.0, saturation: 0.0, value: 1.0 };
    Config {
        picture: ugrainbow::PictureOptions {
            size: [240, 180],
            ..ugrainbow::PictureOptions::default()
        },
        wireframe: Some(Wireframe { has_faces: false, color: Some(white), ..Wireframe::default() }),
        line_width: 2.0,
        ..Config::default()
    }
}

#[test]
fn the_edges_of_a_cut_face_are_those_it_had() {
    // Finer pieces are close to coarser ones; if cuts were drawn, they would light every pixel of
    // some rows.
    let (n_lit, n_different) = compared(&drawn(16, &edges()), &drawn(32, &edges()));
    assert!(n_lit > 400 && n_lit < 2400 && n_different * 50 < n_lit, "{n_different} of {n_lit}");
}

#[test]
fn edges_found_by_rays_are_those_of_fine_pieces() {
    let exact = Config { exact: Some(ColorShift::default()), ..edges() };
    let (n_lit, n_different) = compared(&drawn(1, &exact), &drawn(32, &edges()));
    assert!(n_lit > 400 && n_different * 50 < n_lit, "{n_different} of {n_lit}");
}

/// The silhouette of a sphere in motion is seen as a cone of directions (Penrose 1959), and nothing
/// inside it is drawn.
#[test]
fn the_silhouette_of_a_moving_sphere_is_a_circle() {
    const SIDE: u32 = 600;
    /// The polygons of the sphere span 7.5 degrees, of which one minus the cosine is 0.0086.
    const MOST_OFF: f64 = 0.02;
    for beta in [DVec3::ZERO, 0.9 * DVec3::X, DVec3::new(0.5, 0.6, -0.5), 0.99 * DVec3::NEG_X] {
        let moved = uglorentz::Config {
            velocity: Some(beta),
            in_place: true,
            ..uglorentz::Config::default()
        };
        let mut config = edges();
        config.picture.size = [SIDE; 2];
        config.picture.camera.view_angle = Some((40.0, Some(40.0)));
        config.picture.output = ugrainbow::Output::Vector(ugimage::Format::Svg);
        config.wireframe = config
            .wireframe
            .map(|lines| Wireframe { edges: ugrainbow::EdgeKind::Silhouette, ..lines });
        config.line_width = 0.1;
        let figure =
            String::from_utf8(rainbow(&lorentz(&scenes::text("sphere"), &moved), &config)).unwrap();
        let ends = figure.split("d=\"M").skip(1).flat_map(|path| {
            let numbers = path.split('"').next().unwrap().split(['L', ' ']);
            let numbers: Vec<f64> = numbers.map(|number| number.parse().unwrap()).collect();
            [[numbers[0], numbers[1]], [numbers[2], numbers[3]]]
        });
        let half = 0.5 * f64::from(SIDE);
        let direction = |[x, y]: [f64; 2]| {
            let slope = libm::tan(20f64.to_radians()) / half;
            DVec3::new((x - half) * slope, (half - y) * slope, 1.0).normalize()
        };
        let mut seen: Vec<DVec3> = ends.map(direction).collect();
        let axis = seen.iter().sum::<DVec3>().normalize();
        let (e1, e2) = axis.any_orthonormal_pair();
        let around = |d: &DVec3| libm::atan2(d.dot(e2), d.dot(e1));
        seen.sort_by(|one, other| around(one).total_cmp(&around(other)));
        let gaps = seen.windows(2).map(|pair| around(&pair[1]) - around(&pair[0]));
        assert!(gaps.fold(0.0, f64::max) < 0.35 && seen.len() > 60, "{beta}: {}", seen.len());
        // The plane through three of the unit vectors has the axis of the cone for a normal.
        let [a, b, c] = [0, 1, 2].map(|third| seen[third * seen.len() / 3]);
        let axis = (b - a).cross(c - a).normalize();
        let angle = |d: &DVec3| libm::acos(axis.dot(*d).abs());
        let radius = angle(&a);
        for d in &seen {
            assert!((angle(d) / radius - 1.0).abs() < MOST_OFF, "{beta}: {} of {radius}", angle(d));
        }
    }
}
