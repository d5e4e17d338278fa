//! Parts of a picture are the whole; eyes of stereo pictures, the moments of a film shutter and
//! places in panoramas are pictures of their own.

use core::f64::consts::{PI, TAU};

use glam::DVec3;
use ugphoton::{Lens, Shutter};
use ugphysics::{Brightness, Velocity};
use ugtesting::Random;
use ugwarp::{Extent, Panorama, Texels};

use super::Outcome;
use super::compare::{check, check_within, is_same, is_within};
use super::generate::{Lamps, Recipe, Surfaces, under_sky, world};
use super::picture::{Drawn, Picture, SIZE, SPECTRA, UNSHIFTED, by_law};
use super::world::{Camera, World};

fn any_world(random: &mut Random) -> World {
    world(random, Recipe { fastest: 0.9, lamps: Lamps::All, surfaces: Surfaces::Glass })
}

fn any_picture(random: &mut Random, world: &World) -> Picture {
    Picture::new(world, *random.pick(&[SPECTRA, UNSHIFTED, by_law(Brightness::Report)]))
}

/// The picture as another camera sees it.
fn seen_by(world: &World, camera: Camera, picture: &Picture) -> Result<Drawn, String> {
    let world = World { camera, ..world.clone() };
    Picture { text: world.text(), motion: world.motion(), ..picture.clone() }.draw()
}

fn light_at(drawn: &Drawn, [column, row]: [u32; 2]) -> [f32; 3] {
    drawn.light()[(row * drawn.picture.size[0] + column) as usize]
}

/// A part of every lens, with several samples.
pub fn crops(random: &mut Random) -> Outcome {
    let world = any_world(random);
    let world = under_sky(random, world);
    let (lens, stereo, size) = match random.below(5) {
        0 => (Lens::Panorama, None, [24, 18]),
        1 => (Lens::Fisheye { angle: PI }, None, [24, 18]),
        2 => (Lens::Cube, None, [42, 7]),
        3 => (Lens::Pinhole, Some(0.5), [24, 12]),
        _ => (Lens::Pinhole, None, SIZE),
    };
    let picture = Picture { lens, stereo, size, samples: 2, ..any_picture(random, &world) };
    let whole = picture.draw()?;
    let [left, top] = size.map(|side| random.below(side as usize - 1) as u32);
    let [width, height] = [[size[0], left], [size[1], top]]
        .map(|[side, start]| 1 + random.below((side - start) as usize) as u32);
    let part = Picture { crop: Some([left, top, width, height]), ..picture }.draw()?;
    let places =
        (0..height).flat_map(|row| (0..width).map(move |column| [left + column, top + row]));
    let pairs: Vec<_> = places.map(|place| light_at(&whole, place)).zip(part.light()).collect();
    if pairs.iter().any(|(one, other)| one != other) {
        return Err(format!("a part has other bytes\n{}", part.picture.described()));
    }
    Ok(super::compare::n_lit(&pairs))
}

/// Two eyes beside each other in the frame of the camera.
pub fn stereo(random: &mut Random) -> Outcome {
    let world = any_world(random);
    let world = under_sky(random, world);
    let single = any_picture(random, &world);
    let distance = random.between(0.01, 6.0);
    let [width, height] = SIZE;
    let both =
        Picture { stereo: Some(distance), size: [2 * width, height], ..single.clone() }.draw()?;
    let mut n_lit = 0;
    for (eye, side) in [(0, -0.5), (1, 0.5)] {
        let camera = world.camera.displaced(side * distance * world.camera.right(), 0.0);
        let one = seen_by(&world, camera, &single)?;
        let places = (0..height).flat_map(|row| (0..width).map(move |column| [column, row]));
        let pairs: Vec<_> = places
            .map(|[column, row]| {
                (light_at(&one, [column, row]), light_at(&both, [eye * width + column, row]))
            })
            .collect();
        // At the edge between the eyes footprints of textures are measured on their other side.
        n_lit += if world.bodies.iter().all(|body| body.coordinates.is_empty()) {
            check(&pairs, [&one, &both])?
        } else {
            check_within(&pairs, [&one, &both], 0.1, 4)?
        };
    }
    Ok(n_lit)
}

/// Compares single pixels, with cameras of their own, of the picture `whole`.
fn check_pixels(
    random: &mut Random,
    world: &World,
    whole: &Drawn,
    camera: impl Fn([u32; 2]) -> Option<Camera>,
) -> Outcome {
    const PIXELS: usize = 6;
    let (mut n_lit, mut others) = (0, Vec::new());
    for _ in 0..PIXELS {
        let place = whole.picture.size.map(|side| random.below(side as usize) as u32);
        let Some(camera) = camera(place) else { continue };
        let plain = Picture::new(world, whole.picture.shift).of_pixel();
        let one = seen_by(world, camera, &plain)?;
        if !is_same(one.light()[0], light_at(whole, place)) {
            others.push(format!(
                "pixel {place:?}: {:?}, {:?}\n{}",
                light_at(whole, place),
                one.light()[0],
                one.picture.described()
            ));
        }
        n_lit += usize::from(one.light()[0] != [0.0; 3]);
    }
    match others.first() {
        Some(first) => {
            Err(format!("{} pixels: {first}\n{}", others.len(), whole.picture.described()))
        }
        None => Ok(n_lit),
    }
}

/// Each pixel is that of a picture taken earlier.
pub fn film_shutter(random: &mut Random) -> Outcome {
    let world = any_world(random);
    let mut picture = any_picture(random, &world);
    let distance = random.between(0.5, 6.0);
    picture.rays.shutter = Shutter::Film { distance };
    let whole = picture.draw()?;
    check_pixels(random, &world, &whole, |pixel| {
        let direction = world.camera.direction(pixel, SIZE);
        let earlier = distance * (direction.length() - 1.0);
        Some(world.camera.displaced(DVec3::ZERO, -earlier).looking(direction))
    })
}

/// Panoramas, fisheyes, cube maps, and each eye of panoramas for two (ODS).
pub fn lenses(random: &mut Random) -> Outcome {
    let world = any_world(random);
    let (lens, stereo, size) = match random.below(5) {
        0 => (Lens::Fisheye { angle: random.between(2.0, TAU) }, None, [24, 20]),
        1 => (Lens::Cube, None, [48, 8]),
        2 => (Lens::Panorama, Some(random.between(0.1, 4.0)), [24, 24]),
        _ => (Lens::Panorama, None, [24, 12]),
    };
    let whole = Picture { lens, stereo, size, ..any_picture(random, &world) }.draw()?;
    check_pixels(random, &world, &whole, |pixel| {
        let (direction, eye) = sight(&world.camera, &whole.picture, pixel)?;
        Some(world.camera.displaced(eye, 0.0).looking(direction))
    })
}

/// The direction seen in the middle of a pixel, and the place of its eye.
fn sight(camera: &Camera, picture: &Picture, [column, row]: [u32; 2]) -> Option<(DVec3, DVec3)> {
    let (forward, right, up) = (camera.forward, camera.right(), camera.up);
    let [width, height] = picture.size.map(f64::from);
    let [x, y] = [column, row].map(|pixel| f64::from(pixel) + 0.5);
    match picture.lens {
        Lens::Pinhole => None,
        Lens::Panorama => {
            let frame_height = if picture.stereo.is_some() { 0.5 * height } else { height };
            let is_lower = y > frame_height;
            let (sin_long, cos_long) = libm::sincos(TAU * (x / width - 0.5));
            let (sin_lat, cos_lat) = libm::sincos(PI * (0.5 - (y % frame_height) / frame_height));
            let direction = cos_lat * (cos_long * forward + sin_long * right) + sin_lat * up;
            let across = cos_long * right - sin_long * forward;
            let side = if is_lower { 0.5 } else { -0.5 } * picture.stereo.unwrap_or(0.0);
            Some((direction, side * across))
        }
        Lens::Fisheye { angle } => {
            let (x, y) = (x - 0.5 * width, 0.5 * height - y);
            let (radius, edge) = (libm::hypot(x, y), 0.5 * width.min(height));
            let (sin, cos) = libm::sincos(0.5 * angle * radius / edge);
            (radius < edge)
                .then(|| (cos * forward + sin * (x * right + y * up) / radius, DVec3::ZERO))
        }
        Lens::Cube => {
            let [middle, across, down] = match column / picture.size[1] {
                0 => [right, -forward, -up],
                1 => [-right, forward, -up],
                2 => [up, right, forward],
                3 => [-up, right, -forward],
                4 => [forward, right, -up],
                _ => [-forward, -right, -up],
            };
            let [u, v] = [x % height, y].map(|place| 2.0 * place / height - 1.0);
            Some((middle + u * across + v * down, DVec3::ZERO))
        }
    }
}

/// A panorama looked up by an eye that passes by is what that eye sees.
pub fn looked_up(random: &mut Random) -> Outcome {
    // With half as many texels, a tenth of the smooth pixels of some worlds differs by resampling.
    const SKY: [u32; 2] = [1024, 512];
    let mut world = any_world(random);
    // The axes of the panorama are those of the camera.
    world.camera.velocity = DVec3::ZERO;
    let plain = Picture::new(&world, UNSHIFTED);
    let sky = Picture { lens: Lens::Panorama, size: SKY, ..plain.clone() }.draw()?;
    let texels = sky.light().iter().map(|&[red, green, blue]| [red, green, blue, 1.0]).collect();
    let panorama = Panorama::new(SKY, Texels::Light(texels), Extent::FULL)
        .map_err(|error| error.to_string())?;
    let beta = random.in_ball(0.6);
    let Camera { forward, up, angle, .. } = world.camera;
    let in_scene = beta.x * world.camera.right() + beta.y * forward + beta.z * up;
    let camera = Camera { velocity: in_scene, ..world.camera };
    let seen = seen_by(&world, camera, &plain)?;
    let config = ugwarp::Config {
        velocity: Velocity::from_beta(beta).map_err(|error| error.to_string())?,
        shift: UNSHIFTED,
        picture: ugwarp::PictureOptions {
            size: SIZE,
            samples: 4,
            camera: ugwarp::CameraOptions {
                view_angle: Some((angle, None)),
                ..ugwarp::CameraOptions::default()
            },
            ..ugwarp::PictureOptions::default()
        },
        ..ugwarp::Config::default()
    };
    let warped = ugwarp::light(&panorama, &config).map_err(|error| error.to_string())?;
    let (traced, width) = (seen.light(), SIZE[0] as usize);
    // Where light changes little from pixel to pixel.
    let is_smooth = |at: usize| {
        super::compare::are_around(at, width, traced.len(), |near| {
            is_within(traced[at], traced[near], 0.2)
        })
    };
    let (mut n_smooth, mut others) = (0, 0);
    for (at, pixel) in warped.pixels().iter().enumerate().filter(|(at, _)| is_smooth(*at)) {
        let [red, green, blue, _] = *pixel;
        n_smooth += 1;
        others += usize::from(!is_within([red, green, blue], traced[at], 0.1));
    }
    if others * 12 > n_smooth {
        return Err(format!(
            "{others} of {n_smooth} smooth pixels differ at {beta}\n{}",
            seen.picture.described()
        ));
    }
    Ok(n_smooth)
}
