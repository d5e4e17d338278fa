//! Which direction is seen at a place of the picture.

mod pixels_near;

use std::ops::Range;

use glam::{DQuat, DVec3};
use ugscene::View;

pub use pixels_near::{Facet, Window};

/// Which direction is seen at a place of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Lens {
    /// A pinhole before a flat film, as in all other programs.
    #[default]
    Pinhole,
    /// All directions: longitude across the picture, latitude down, with the view direction in its
    /// middle (equirectangular).
    Panorama,
    /// A circle in the middle of the picture whose radius is the angle to the view direction
    /// (equidistant fisheye), as for domes.
    Fisheye {
        /// The angle across the circle, radians, above 0 and at most 2π.
        angle: f64,
    },
    /// All directions on the sides of a cube, six squares from left to right: right, left, up,
    /// down, front, back (+X, −X, +Y, −Y, +Z, −Z of cube maps).
    Cube,
}

impl Lens {
    /// The frames of which a picture consists, across and down: the sides of a cube, or the
    /// pictures of two eyes.
    #[must_use]
    pub fn frames(self, is_stereo: bool) -> [u32; 2] {
        match (self, is_stereo) {
            (Self::Cube, _) => [6, 1],
            (_, false) => [1, 1],
            (Self::Panorama, true) => [1, 2],
            (Self::Pinhole | Self::Fisheye { .. }, true) => [2, 1],
        }
    }
}

/// A line of sight, in the frame of the camera and the axes of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// The place of the eye relative to the middle between both eyes.
    pub eye: DVec3,
    /// The direction seen: of depth 1 for a pinhole, else a unit vector.
    pub direction: DVec3,
}

/// A lens before the film of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Film {
    lens: Lens,
    /// Half the distance of the eyes, if there are two.
    half_stereo: Option<f64>,
    /// Frames across and down.
    frames: [u32; 2],
    /// Samples of a frame across and down.
    size: [f64; 2],
    /// Direction of the upper left corner and its change per sample, at depth 1.
    pinhole: [DVec3; 3],
    right: DVec3,
    up: DVec3,
    forward: DVec3,
}

impl Film {
    /// `view`: of a frame, of `samples` across and down. `stereo`: distance of the eyes.
    pub fn new(lens: Lens, stereo: Option<f64>, view: &View, samples: [u32; 2]) -> Self {
        let pinhole @ [_, across, down] = view.rays();
        let (right, up) = (across.normalize_or_zero(), -down.normalize_or_zero());
        Self {
            lens,
            half_stereo: stereo.map(|distance| 0.5 * distance),
            frames: lens.frames(stereo.is_some()),
            size: samples.map(f64::from),
            pinhole,
            right,
            up,
            forward: view.forward,
        }
    }

    /// The same film with its axes turned.
    #[must_use]
    pub fn turned(mut self, turn: DQuat) -> Self {
        self.pinhole = self.pinhole.map(|direction| turn * direction);
        [self.right, self.up, self.forward] =
            [self.right, self.up, self.forward].map(|axis| turn * axis);
        self
    }

    /// True if all light of the picture arrives at one place.
    pub fn has_one_eye(&self) -> bool {
        self.half_stereo.is_none()
    }

    /// True if straight lines of sight pass one pinhole to one flat film.
    pub fn is_pinhole(&self) -> bool {
        self.lens == Lens::Pinhole && self.frames == [1, 1]
    }

    /// The line of sight at a place, in samples from the upper left corner. `None` outside the
    /// circle of a fisheye.
    #[inline(always)] // Called for every sample: otherwise the direction is passed in memory.
    pub fn sight(&self, place: [f64; 2]) -> Option<Sight> {
        if self.is_pinhole() {
            return Some(Sight { eye: DVec3::ZERO, direction: self.through_pinhole(place) });
        }
        self.sight_in_frames(place)
    }

    /// The line of sight at a place of a picture that may have several frames.
    #[inline(never)]
    fn sight_in_frames(&self, [x, y]: [f64; 2]) -> Option<Sight> {
        if self.frames == [1, 1] {
            return Some(Sight { eye: DVec3::ZERO, direction: self.direction([x, y], 0)? });
        }
        let [column, row] = [(x / self.size[0]).floor(), (y / self.size[1]).floor()];
        let place = [x - column * self.size[0], y - row * self.size[1]];
        let frame = column as usize + row as usize;
        let direction = self.direction(place, frame)?;
        let eye = self.half_stereo.map_or(DVec3::ZERO, |half| {
            let side = if frame == 0 { -half } else { half };
            side * self.across(place[0])
        });
        Some(Sight { eye, direction })
    }

    /// Steps across and down of this length from a sample, back where a step ahead would end in
    /// another frame.
    pub fn steps_in_frame(&self, sample: [u32; 2], length: u32) -> [f64; 2] {
        [0, 1].map(|axis| {
            let ahead = f64::from(length);
            let ends_in_frame = f64::from(sample[axis]) % self.size[axis] + ahead < self.size[axis];
            if ends_in_frame || self.frames == [1, 1] { ahead } else { -ahead }
        })
    }

    /// The direction from the left to the right eye: perpendicular to the view; in a panorama, to
    /// the horizontal direction seen in a column.
    fn across(&self, x: f64) -> DVec3 {
        if self.lens != Lens::Panorama {
            return self.right;
        }
        let (sin, cos) = self.longitude(x);
        cos * self.right - sin * self.forward
    }

    /// Sine and cosine of the longitude of a column of a panorama.
    fn longitude(&self, x: f64) -> (f64, f64) {
        libm::sincos(core::f64::consts::TAU * (x / self.size[0] - 0.5))
    }

    #[inline(always)]
    fn through_pinhole(&self, [x, y]: [f64; 2]) -> DVec3 {
        let [corner, across, down] = self.pinhole;
        corner + y * down + x * across
    }

    /// The direction seen at a place of a frame.
    fn direction(&self, [x, y]: [f64; 2], frame: usize) -> Option<DVec3> {
        let [width, height] = self.size;
        match self.lens {
            Lens::Pinhole => Some(self.through_pinhole([x, y])),
            Lens::Panorama => {
                let (sin_long, cos_long) = self.longitude(x);
                let (sin_lat, cos_lat) = libm::sincos(core::f64::consts::PI * (0.5 - y / height));
                Some(
                    self.forward * (cos_lat * cos_long)
                        + self.right * (cos_lat * sin_long)
                        + self.up * sin_lat,
                )
            }
            Lens::Fisheye { angle } => {
                let (across, above) = (x - 0.5 * width, 0.5 * height - y);
                let (radius, edge) = (libm::hypot(across, above), 0.5 * width.min(height));
                if radius > edge {
                    return None;
                }
                if radius == 0.0 {
                    return Some(self.forward);
                }
                let (sin, cos) = libm::sincos(0.5 * angle * radius / edge);
                let aside = (across / radius) * self.right + (above / radius) * self.up;
                Some(cos * self.forward + sin * aside)
            }
            Lens::Cube => {
                let [middle, across, down] = self.side(frame);
                let [u, v] = [2.0 * x / width - 1.0, 2.0 * y / height - 1.0];
                Some((middle + u * across + v * down).normalize())
            }
        }
    }

    /// The middle of a side of a cube, and what is to the right and below in its square.
    fn side(&self, side: usize) -> [DVec3; 3] {
        let (right, up, forward) = (self.right, self.up, self.forward);
        match side {
            0 => [right, -forward, -up],
            1 => [-right, forward, -up],
            2 => [up, right, forward],
            3 => [-up, right, -forward],
            4 => [forward, right, -up],
            _ => [-forward, -right, -up],
        }
    }
}

/// The rows or columns, in pixels, of the frame that contains one of them. `side`: of the picture,
/// which has `n_frames` frames in this direction.
pub fn frame_around(pixel: u32, side: u32, n_frames: u32) -> Range<u32> {
    let length = (side / n_frames).max(1);
    let start = pixel / length * length;
    start..(start + length).min(side)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use ugscene::CameraOptions;

    pub(super) fn film(lens: Lens, stereo: Option<f64>, samples: [u32; 2]) -> Film {
        let text = "v a 0 1 0; cam -ep 0 0 0 -vc 0 1 0 -ud 0 0 1;";
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default());
        let view = scene
            .ok()
            .and_then(|parsed| View::new(&parsed.scene, &CameraOptions::default(), samples).ok());
        let Some(view) = view else { panic!("a camera") };
        Film::new(lens, stereo, &view, samples)
    }

    #[track_caller]
    fn check(lens: Lens, place: [f64; 2], expected: DVec3) {
        let found = film(lens, None, [40, 20]).sight(place);
        let is_there = |found: Sight| {
            found.eye == DVec3::ZERO && (found.direction - expected).length() < 1e-15
        };
        assert!(found.is_some_and(is_there), "{found:?}");
    }

    #[test]
    fn panoramas_have_longitude_and_latitude() {
        for (place, expected) in [
            ([20.0, 10.0], DVec3::Y),
            ([30.0, 10.0], DVec3::X),
            ([10.0, 10.0], DVec3::NEG_X),
            ([40.0, 10.0], DVec3::NEG_Y),
            ([7.0, 0.0], DVec3::Z),
            ([20.0, 15.0], DVec3::new(0.0, 0.5_f64.sqrt(), -0.5_f64.sqrt())),
        ] {
            check(Lens::Panorama, place, expected);
        }
    }

    #[test]
    fn fisheyes_have_angles_as_radii() {
        let dome = Lens::Fisheye { angle: core::f64::consts::PI };
        check(dome, [20.0, 10.0], DVec3::Y);
        check(dome, [30.0, 10.0], DVec3::X);
        check(dome, [20.0, 0.0], DVec3::Z);
        check(dome, [25.0, 10.0], DVec3::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0));
        assert_eq!(film(dome, None, [40, 20]).sight([31.0, 10.0]), None);
    }

    /// The middles of the sides, and the directions to the right and below them.
    #[test]
    fn cubes_have_the_order_of_cube_maps() {
        let film = film(Lens::Cube, None, [20, 20]);
        let (right, front, up) = (DVec3::X, DVec3::Y, DVec3::Z);
        for (side, [middle, across, down]) in [
            [right, -front, -up],
            [-right, front, -up],
            [up, right, front],
            [-up, right, -front],
            [front, right, -up],
            [-front, -right, -up],
        ]
        .into_iter()
        .enumerate()
        {
            let left = 20.0 * side as f64;
            for (place, expected) in [
                ([10.0, 10.0], middle),
                ([15.0, 10.0], middle + 0.5 * across),
                ([10.0, 15.0], middle + 0.5 * down),
            ] {
                let found = film.sight([left + place[0], place[1]]).map(|sight| sight.direction);
                let is_there = |found: DVec3| (found - expected.normalize()).length() < 1e-15;
                assert!(found.is_some_and(is_there), "{side} {found:?}");
            }
        }
    }

    /// The twelve edges of the cube: a place on each is seen in the same direction from both sides.
    #[test]
    fn cubes_continue_at_their_edges() {
        let film = film(Lens::Cube, None, [20, 20]);
        let edges = |side: usize| {
            let at = |[x, y]: [f64; 2]| {
                // Just inside, so that the place belongs to this side.
                let inside = |part: f64| 10.0 + (1.0 - 1e-12) * (part - 10.0);
                let place = [20.0 * side as f64 + inside(x), inside(y)];
                film.sight(place).map_or(DVec3::ZERO, |sight| sight.direction)
            };
            let places = |along: f64| [[along, 0.0], [along, 20.0], [0.0, along], [20.0, along]];
            [0, 1, 2, 3].map(|edge| [3.0, 17.0].map(|along| at(places(along)[edge])))
        };
        let mut n_pairs = 0;
        for (side, other) in (0..6).flat_map(|side| (0..side).map(move |other| (side, other))) {
            for (one, two) in edges(side).iter().flat_map(|a| edges(other).map(|b| (*a, b))) {
                let is_same = |a: DVec3, b: DVec3| (a - b).length() < 1e-9;
                let joins = is_same(one[0], two[0]) && is_same(one[1], two[1]);
                let joins_turned = is_same(one[0], two[1]) && is_same(one[1], two[0]);
                n_pairs += usize::from(joins || joins_turned);
            }
        }
        assert_eq!(n_pairs, 12);
    }

    /// Each eye is at half the distance to its side of the view; in a panorama, of the direction
    /// seen.
    #[test]
    fn eyes_are_apart_across_the_view() {
        let check = |lens: Lens, place: [f64; 2], eye: DVec3, direction: DVec3| {
            let found = film(lens, Some(0.5), [40, 20]).sight(place);
            let is_there = |found: Sight| {
                (found.eye - eye).length() + (found.direction - direction).length() < 1e-15
            };
            assert!(found.is_some_and(is_there), "{found:?}");
        };
        let half = 0.25;
        for lens in [Lens::Pinhole, Lens::Fisheye { angle: 3.0 }] {
            check(lens, [20.0, 10.0], -half * DVec3::X, DVec3::Y);
            check(lens, [60.0, 10.0], half * DVec3::X, DVec3::Y);
        }
        check(Lens::Panorama, [20.0, 10.0], -half * DVec3::X, DVec3::Y);
        check(Lens::Panorama, [20.0, 30.0], half * DVec3::X, DVec3::Y);
        check(Lens::Panorama, [30.0, 10.0], half * DVec3::Y, DVec3::X);
        check(Lens::Panorama, [30.0, 30.0], -half * DVec3::Y, DVec3::X);
    }
}
