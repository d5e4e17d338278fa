//! Compares positions and colours in the text of the pipe with the papers' formulas at 200 bits.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use glam::DVec3;
use ugscene::{ColorValue, Tint};
use ugtesting::Random;
use ugtests::pipe;
use ugtests::scenes::parse;

use super::{color_of, named, triangles};

type Big = FBig<HalfEven, 2>;
type BigVector = [Big; 3];

/// `x`, converted exactly.
fn big(x: f64) -> Big {
    Big::try_from(x).unwrap().with_precision(200).value()
}

fn difference(a: DVec3, b: DVec3) -> BigVector {
    [0, 1, 2].map(|i| big(a[i]) - big(b[i]))
}

fn dot(a: &BigVector, b: &BigVector) -> Big {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn add_scaled(a: &BigVector, s: &Big, b: &BigVector) -> BigVector {
    [0, 1, 2].map(|i| &a[i] + s * &b[i])
}

/// A velocity, and 1 − β².
struct Motion {
    beta: BigVector,
    rest: Big,
}

impl Motion {
    fn new(beta: DVec3) -> Self {
        let beta = beta.to_array().map(big);
        let rest = big(1.0) - dot(&beta, &beta);
        Self { beta, rest }
    }

    /// (P1) and then (P2), as in the report.
    fn seen(&self, p: &BigVector) -> BigVector {
        let square = big(1.0) - &self.rest;
        if square == big(0.0) {
            return p.clone();
        }
        let shrink = (self.rest.sqrt() - big(1.0)) * dot(p, &self.beta) / square;
        let now = add_scaled(p, &shrink, &self.beta);
        let approach = dot(&now, &self.beta);
        let root = (&approach * &approach + &self.rest * dot(&now, &now)).sqrt();
        add_scaled(&now, &((approach - root) / &self.rest), &self.beta)
    }

    /// (P10) for a point seen at `p`: n = −p/|p|.
    fn doppler(&self, p: &BigVector) -> Big {
        self.rest.sqrt() / (big(1.0) + dot(p, &self.beta) / dot(p, p).sqrt())
    }
}

fn number(x: &Big) -> f64 {
    x.to_f64().value()
}

/// |got − want| / |want|
fn error(got: &BigVector, want: &BigVector) -> f64 {
    let gap = add_scaled(got, &big(-1.0), want);
    number(&(dot(&gap, &gap) / dot(want, want)).sqrt())
}

/// Speeds from 0 to 0.999999, most of them near its end.
fn speeds() -> impl Iterator<Item = f64> {
    let near_light = (0..=24).map(|step| 1.0 - libm::pow(10.0, -f64::from(step) / 4.0));
    [1e-9, 1e-3, 0.1, 0.3, 0.5].into_iter().chain(near_light)
}

#[test]
fn vertices_have_positions_by_p3_and_doppler_factors_by_p10() {
    /// Relative to the distance from the eye. Near the speed of light, rounding errors of the input
    /// are amplified by up to γ = 707.
    const TOLERANCE: f64 = 1e-12;
    /// Hue 120, (P16).
    const GREEN_NM: f64 = 546.1;

    let mut random = Random(1);
    let (mut n_vertices, mut worst_place, mut worst_doppler) = (0, 0.0_f64, 0.0_f64);
    for speed in speeds() {
        let (beta, eye) = (speed * random.direction(), random.in_cube(10.0));
        let (text, points) = triangles(&mut random, 5, "green");
        let text = format!("c green 0.1 120 1; {text}");
        // Vertices are where they are however edges are divided.
        let pieces = uglorentz::Pieces::PerEdge(1);
        let lorentz = uglorentz::Config {
            velocity: Some(beta),
            eye: Some(eye),
            pieces,
            ..Default::default()
        };
        let seen = pipe::lorentz(text.as_bytes(), &lorentz);
        let doppler = ugdoppler::Config { tolerance: 0.0, wavelengths: true, ..Default::default() };
        let scene = parse(&pipe::doppler(&seen, &doppler));

        let motion = Motion::new(beta);
        for (name, vertex) in named(&scene, &points) {
            let place = difference(vertex.position, eye);
            let off = error(&place, &motion.seen(&difference(points[&name], eye)));
            assert!(off < TOLERANCE, "{name} at {:?}, {speed} c, is off by {off:e}", points[&name]);

            let ColorValue::Hsv { tint: Tint::Wavelength(wavelength_nm), .. } =
                color_of(&scene, vertex).value
            else {
                panic!("ugdoppler writes colours with `c`")
            };
            let ratio = big(GREEN_NM) / big(wavelength_nm);
            let shift = number(&(ratio / motion.doppler(&place) - big(1.0))).abs();
            assert!(
                shift < TOLERANCE,
                "{name} at {:?}, {speed} c: D is off by {shift:e}",
                points[&name]
            );

            n_vertices += 1;
            worst_place = worst_place.max(off);
            worst_doppler = worst_doppler.max(shift);
        }
    }
    println!(
        "{n_vertices} vertices: places within {worst_place:.1e}, D within {worst_doppler:.1e}"
    );
    assert!(n_vertices > 400);
}
