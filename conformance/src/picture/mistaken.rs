//! Pictures with known mistakes, by which those of other renderers are recognised.

use ugphysics::{InertialFrame, Velocity, compose};
use ugscene::{Scene, ShownEffects};

use super::{Expected, MeasuredQuantity, PictureCase};
use crate::mistakes;

/// The name of a mistake of [`mistakes::MISTAKES`], and what makes it.
type Mistake = (&'static str, fn(&mut Scene, &mut uglorentz::Config));

/// The mistakes that this project's programs can be made to draw.
const DRAWN: [Mistake; 6] = [
    ("M1", |_, config| {
        config.geometry = ShownEffects { flight_time: false, ..ShownEffects::default() }
    }),
    ("M2", |scene, _| change_velocities(scene, without_root)),
    ("M3", |scene, _| change_velocities(scene, |velocity| -velocity)),
    ("M7", |scene, _| change_velocities(scene, |velocity| compose(velocity, velocity))),
    ("M9", |_, config| {
        config.geometry = ShownEffects { contraction: false, ..ShownEffects::default() }
    }),
    ("M13", |_, config| config.pieces = uglorentz::Pieces::PerEdge(1)),
];

/// The velocity whose γ is the square of that of another one.
fn without_root(velocity: Velocity) -> Velocity {
    let rapidity = libm::acosh(velocity.gamma() * velocity.gamma());
    Velocity::from_rapidity(velocity.proper(), rapidity).unwrap_or(velocity)
}

fn change_velocities(scene: &mut Scene, change: fn(Velocity) -> Velocity) {
    for id in scene.bodies.ids() {
        if let Some(&frame) = scene.bodies.motion(id).inertial_frame()
            && !frame.velocity.is_zero()
        {
            scene.bodies.set_frame(id, InertialFrame { velocity: change(frame.velocity), ..frame });
        }
    }
}

/// The known mistakes with which this project's programs draw such a picture: none if its numbers
/// are right, or if only rays draw it. Where nothing can be measured, areas that are drawn count.
pub fn recognized(case: &PictureCase, png: &[u8]) -> Vec<&'static str> {
    let measured = case.measure(png);
    let is_right = measured.as_ref().is_ok_and(|all| all.iter().all(MeasuredQuantity::passes));
    if is_right || !case.renderers().contains(&super::DrawnBy::Pipe) {
        return Vec::new();
    }
    let is_like = |(_, mistake): &&Mistake| {
        let Ok(drawn) = case.draw_by_pipe(*mistake) else { return false };
        match (&measured, case.measure(&drawn)) {
            (Ok(measured), Ok(wrong)) => {
                let is_wrong = !wrong.iter().all(MeasuredQuantity::passes);
                is_wrong
                    && wrong.len() == measured.len()
                    && measured.iter().zip(&wrong).all(are_equal)
            }
            (Err(_), Err(_)) => common_part(png, &drawn).is_some_and(|part| part > COMMON),
            _ => false,
        }
    };
    DRAWN.iter().filter(is_like).map(|(name, _)| *name).collect()
}

/// The part of areas that is common to pictures of one shape.
const COMMON: f64 = 0.97;

/// The part of the pixels drawn in one of two pictures that is drawn in both.
fn common_part(one: &[u8], other: &[u8]) -> Option<f64> {
    let drawn = |png: &[u8]| {
        let pixels = image::load_from_memory(png).ok()?.into_luma8();
        let half = pixels.iter().max()? / 2;
        Some(pixels.iter().map(|level| *level > half).collect::<Vec<bool>>())
    };
    let (one, other) = (drawn(one)?, drawn(other)?);
    let count = |is_counted: fn(bool, bool) -> bool| {
        one.iter().zip(&other).filter(|(one, other)| is_counted(**one, **other)).count()
    };
    let any = count(|one, other| one || other);
    (any > 0).then(|| count(|one, other| one && other) as f64 / any as f64)
}

/// True if two measurements differ by no more than the tolerance, or little beside their error.
fn are_equal((one, other): (&MeasuredQuantity, &MeasuredQuantity)) -> bool {
    match one.expected {
        Expected::About { value, tolerance } => {
            (one.value - other.value).abs() <= tolerance.max(0.02 * (one.value - value).abs())
        }
        Expected::AtLeast(_) => one.passes() == other.passes(),
    }
}

/// The lines of a report on mistakes.
pub fn lines(names: &[&str]) -> String {
    names.iter().map(|name| format!("looks like {name}: {}\n", mistakes::describe(name))).collect()
}
