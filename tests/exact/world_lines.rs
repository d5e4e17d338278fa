//! Exact pictures of bodies that accelerate, spin or orbit, beside those of the ray tracer, which
//! places and lights them from the scene at rest.

use ugphoton::RayOptions;
use ugrainbow::ColorShift;
use ugtests::pipe::lorentz;
use ugtests::scenes;

use super::exact;

/// Faces with normals, holes, translucency and wires; lamps that rest with what they light.
const TURNING: &str = "c red 1 0; c pane .8 120 .5 .4; c grey .7; l .3; l .7 1 -2 1.5; l .4 4 -3 2 0;
    cam -ep 0 -8 2 -vc 0 0 0 -ud 0 0 1 -va 60 46; motion m -at 0 0 0 -vel .3 0 0 -spin 0 0 .5;
    v a -1 -1 -1; v b 1 -1 -1; v c 1 1 -1; v d -1 1 -1; v e 0 0 1.5;
    f (a b e) red <m>; f (b c e) grey <m>; f (c d e) pane <m>; f (d a e) pane <m>; f (d c b a) grey <m>;
    v p -3 2 -2; v q 3 2 -2; v r 3 2 3; v s -3 2 3; f (p q r s) grey;";

#[test]
fn bodies_on_world_lines_look_as_the_ray_tracer_draws_them() {
    // Lamps with a motion do not rest with what they light.
    let of_file = |name| {
        (name, String::from_utf8(scenes::text(name)).unwrap().replace("<0 0 0>", "").into_bytes())
    };
    let files = ["wheels", "twins", "disc", "slalom"].map(of_file);
    let scenes = files.into_iter().chain([("turning", TURNING.as_bytes().to_vec())]);
    for (name, text) in scenes {
        for shift in [ColorShift::SPECTRA, ColorShift::default()] {
            let mut pipe = exact(None);
            pipe.rainbow.exact = Some(shift);
            let seen = scenes::parse(&lorentz(&text, &pipe.lorentz));
            let drawn = ugrainbow::light(&seen, &pipe.rainbow).unwrap();
            let traced = ugphoton::Config {
                shift,
                picture: pipe.rainbow.picture.clone(),
                rays: RayOptions { shadows: false, depth: 0, ..RayOptions::default() },
                ..ugphoton::Config::default()
            };
            let traced = ugphoton::light(scenes::parse(&text), &traced).unwrap();
            let pairs = drawn.pixels().iter().zip(traced.pixels());
            let is_far = |(a, b): &(&[f32; 4], &[f32; 4])| {
                (0..3).any(|at| (a[at] - b[at]).abs() > 3e-3 * (1.0 + b[at].abs()))
            };
            let n_far = pairs.clone().filter(is_far).count();
            let n_drawn = pairs.filter(|(a, _)| a[..3].iter().any(|light| *light > 1e-3)).count();
            // At edges rounding decides between faces.
            assert!(
                n_far * 200 <= n_drawn && n_drawn > 500,
                "{name}, {shift:?}: {n_far} of {n_drawn}"
            );
        }
    }
}
