//! Which direction is seen at a place of the picture.

use glam::DVec3;
use ugscene::View;

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
}

/// A lens before the film of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Film {
    lens: Lens,
    /// Samples across and down.
    size: [f64; 2],
    /// Direction of the upper left corner and its change per sample, at depth 1.
    pinhole: [DVec3; 3],
    right: DVec3,
    up: DVec3,
    forward: DVec3,
}

impl Film {
    /// `samples`: of the picture, across and down.
    pub fn new(lens: Lens, view: &View, samples: [u32; 2]) -> Self {
        let pinhole @ [_, across, down] = view.rays();
        let (right, up) = (across.normalize_or_zero(), -down.normalize_or_zero());
        Self { lens, size: samples.map(f64::from), pinhole, right, up, forward: view.forward }
    }

    /// The direction seen at a place, in samples from the upper left corner: of depth 1 for a
    /// pinhole, else a unit vector. `None` outside the circle of a fisheye.
    #[inline]
    pub fn direction(&self, [x, y]: [f64; 2]) -> Option<DVec3> {
        let [width, height] = self.size;
        match self.lens {
            Lens::Pinhole => {
                let [corner, across, down] = self.pinhole;
                Some(corner + y * down + x * across)
            }
            Lens::Panorama => {
                let (sin_long, cos_long) = libm::sincos(core::f64::consts::TAU * (x / width - 0.5));
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
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ugscene::CameraOptions;

    fn film(lens: Lens, samples: [u32; 2]) -> Film {
        let text = "v a 0 1 0; cam -ep 0 0 0 -vc 0 1 0 -ud 0 0 1;";
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default());
        let view =
            scene.ok().and_then(|parsed| View::new(&parsed.scene, &CameraOptions::default(), samples).ok());
        let Some(view) = view else { panic!("a camera") };
        Film::new(lens, &view, samples)
    }

    #[track_caller]
    fn check(lens: Lens, place: [f64; 2], expected: DVec3) {
        let found = film(lens, [40, 20]).direction(place);
        assert!(found.is_some_and(|found| (found - expected).length() < 1e-15), "{found:?}");
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
        assert_eq!(film(dome, [40, 20]).direction([31.0, 10.0]), None);
    }
}
