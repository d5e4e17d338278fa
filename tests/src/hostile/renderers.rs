//! The three renderers show faces in the same pixels, however unusual the scene is.

use ugphoton::{Channel, Lens, RayOptions};
use ugscene::MotionOptions;
use ugtesting::Random;

use super::mild;
use crate::worlds::picture::{Picture, Renderer, SIZE, UNSHIFTED};

/// Pixels in which the exact mode and rays may differ: samples on an edge, within rounding.
const ON_EDGES: usize = 4;

/// Pixels amid equal ones in which the pipe may differ, whose faces are bent in steps.
const MID_FACES: usize = 2;

/// Draws the scene of this number with every renderer. True if it can be drawn and shows something.
///
/// # Errors
/// Where they differ.
pub fn check(seed: u64) -> Result<bool, String> {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let text = mild::faces(&mut random);
    let velocity = random.direction() * random.unit() * 0.99;
    let motion = MotionOptions {
        velocity: random.one_in(2).then_some(velocity),
        camera_velocity: random.one_in(4).then(|| -0.5 * velocity),
        time: if random.one_in(3) { random.between(-3.0, 3.0) } else { 0.0 },
        in_place: random.one_in(2),
        ..MotionOptions::default()
    };
    let picture = Picture {
        text,
        motion,
        renderer: Renderer::Rays,
        size: SIZE,
        samples: 1,
        shift: UNSHIFTED,
        rays: RayOptions { depth: 0, shadows: false, ..RayOptions::default() },
        lens: Lens::Pinhole,
        stereo: None,
        crop: None,
        channels: vec![Channel::Id],
    };
    let shown = |renderer: Renderer| {
        let drawn = picture.clone().by(renderer).draw()?;
        Ok::<Vec<bool>, String>(drawn.ids().iter().map(|id| *id > 0).collect())
    };
    let [rays, exact, pipe] = [Renderer::Rays, Renderer::Exact, Renderer::Pipe].map(shown);
    let (rays, exact, pipe) = match (rays, exact, pipe) {
        (Ok(rays), Ok(exact), Ok(pipe)) => (rays, exact, pipe),
        (Err(_), Err(_), Err(_)) => return Ok(false),
        (rays, exact, pipe) => {
            let errors: Vec<String> = [rays, exact, pipe].into_iter().filter_map(Result::err).collect();
            return Err(format!("one renderer refuses what another draws: {}", errors.join("\n")));
        }
    };
    let n_differ = (0..rays.len()).filter(|&pixel| rays[pixel] != exact[pixel]).count();
    if n_differ > ON_EDGES {
        return Err(format!("-xc and rays differ in {n_differ} pixels\n{}", picture.described()));
    }
    let n_differ = (0..rays.len()).filter(|&at| is_amid(&rays, at) && rays[at] != pipe[at]).count();
    if n_differ > MID_FACES {
        return Err(format!("the pipe and rays differ in {n_differ} pixels\n{}", picture.described()));
    }
    Ok(rays.contains(&true))
}

/// True if the pixels around one are like it.
fn is_amid(shown: &[bool], pixel: usize) -> bool {
    let [width, height] = SIZE.map(|side| side as usize);
    let (column, row) = (pixel % width, pixel / width);
    let around = |at: usize, side: usize| at.saturating_sub(1)..(at + 2).min(side);
    around(row, height)
        .flat_map(|row| around(column, width).map(move |column| row * width + column))
        .all(|at| shown[at] == shown[pixel])
}
