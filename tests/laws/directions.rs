//! The channel `direction` and the rest positions of explanations are in the axes of the scene,
//! also if body and camera move. Expected: 4×4 matrices of the oracle. (P6), (P7), (P25)

use glam::DVec3;
use ugimage::{LinearFrame, Samples};
use ugparse::Source;
use ugrainbow::{Channel, ColorShift, Output, PictureOptions};
use ugtesting::Random;
use ugtests::oracle::{Pinhole, boost};
use ugtests::pipe::lorentz;
use ugtests::scenes::parse;

const SIZE: [u32; 2] = [12, 9];

/// A pixel away from the centre.
const PIXEL: [u32; 2] = [9, 2];

/// Numbers of channels are in single precision.
const SINGLE: f64 = 3e-7;

/// A cube around the eye that moves with `body`, seen by a camera with `camera`.
fn scene(body: DVec3, camera: DVec3) -> String {
    let velocity = |v: DVec3| format!("<{:?} {:?} {:?}>", v.x, v.y, v.z);
    let body = velocity(body);
    format!(
        "v a -1 -1 -1; v b 1 -1 -1; v c 1 1 -1; v d -1 1 -1; v e -1 -1 1; v f 1 -1 1; v g 1 1 1; v h -1 1 1;
         f (a b c d) {body}; f (e f g h) {body}; f (a b f e) {body}; f (b c g f) {body};
         f (c d h g) {body}; f (d a e h) {body};
         l 1; cam -ep 0 0 0 -vc 0 9 0 -va 90 {};",
        velocity(camera)
    )
}

fn picture() -> PictureOptions {
    let output = Output::Color(ugimage::Format::Exr);
    PictureOptions {
        size: SIZE,
        samples: 1,
        channels: vec![Channel::Direction],
        output,
        ..PictureOptions::default()
    }
}

fn directions(frame: &LinearFrame) -> Vec<DVec3> {
    let axis =
        |name: &str| match &frame.planes().iter().find(|plane| plane.name == name).unwrap().samples
        {
            Samples::Float(numbers) => numbers.clone(),
            Samples::Whole(_) => panic!("directions are not whole numbers"),
        };
    let [x, y, z] = ["direction.X", "direction.Y", "direction.Z"].map(axis);
    let point = |at: usize| DVec3::new(x[at].into(), y[at].into(), z[at].into());
    (0..x.len()).map(point).collect()
}

#[test]
fn directions_are_in_the_axes_of_the_scene() {
    let mut random = Random(29);
    // 0.9c across 0.9c: the axes of the two boosts are 42.9° apart.
    let mut cases = vec![(0.9 * DVec3::X, 0.9 * DVec3::Y)];
    cases.extend((0..6).map(|_| (random.in_ball(0.95), random.in_ball(0.95))));
    for (body, camera) in cases {
        let text = scene(body, camera);
        let rest_from_camera = boost(body) * boost(-camera);
        let film = Pinhole::new(&parse(text.as_bytes()).cameras[0], DVec3::ZERO, SIZE);
        let of_sample = |at: usize| film.direction((at % 12) as f64 + 0.5, (at / 12) as f64 + 0.5);
        let expected: Vec<DVec3> = (0..12 * 9)
            .map(|at| (rest_from_camera * of_sample(at).extend(-1.0)).truncate().normalize())
            .collect();

        let seen = |pieces| {
            lorentz(text.as_bytes(), &uglorentz::Config { pieces, ..uglorentz::Config::default() })
        };
        let fine = seen(uglorentz::Config::default().pieces);
        let whole = seen(uglorentz::Pieces::PerEdge(1));
        let scanned = ugrainbow::Config { picture: picture(), ..ugrainbow::Config::default() };
        let exact = ugrainbow::Config { exact: Some(ColorShift::default()), ..scanned.clone() };
        let rays = ugphoton::Config { picture: picture(), ..ugphoton::Config::default() };
        let found = [
            ("ugrainbow", ugrainbow::light(&parse(&fine), &scanned).unwrap()),
            ("ugrainbow -xc", ugrainbow::light(&parse(&whole), &exact).unwrap()),
            ("ugphoton", ugphoton::light(parse(text.as_bytes()), &rays).unwrap()),
        ];
        for (program, frame) in found {
            for (at, (found, &expected)) in
                directions(&frame).into_iter().zip(&expected).enumerate()
            {
                let off = found.distance(expected);
                assert!(
                    off < SINGLE,
                    "{program}, {body} from {camera}, pixel {at}: {found} for {expected}"
                );
            }
        }

        let by_pipe = ugrainbow::explain::explain(&scanned, &Source::new("t.ug", &fine[..]), PIXEL)
            .unwrap()
            .0;
        let by_rays =
            ugphoton::explain(&rays, &Source::new("t.ug", text.as_str()), PIXEL).unwrap().0;
        let by_pipe = by_pipe.sample.unwrap().own.surface;
        let by_rays = by_rays.sample.unwrap().own.surfaces.remove(0).surface;
        for (program, surface) in [("ugrainbow", by_pipe), ("ugphoton", by_rays)] {
            let [seen, rest] = [surface.emission, surface.emission_at_rest]
                .map(|event| DVec3::from_array(event.x));
            let event = rest_from_camera * seen.extend(surface.emission.t.unwrap());
            let off = rest.distance(event.truncate()) / rest.length();
            assert!(off < 1e-6, "{program} --explain, {body} from {camera}: {rest} for {event}");
        }
    }
}
