//! Maps pixels to viewing directions.

use std::f64::consts::PI;

use glam::DVec3;
use ugphoton::Lens;
use ugscene::Camera;

/// A camera at the origin: a pinhole with a flat film and square pixels, or an equirectangular
/// panorama of all directions.
pub struct Sight {
    lens: Lens,
    forward: DVec3,
    right: DVec3,
    down: DVec3,
    /// Size of a pixel at the centre, radians.
    pixel: f64,
    middle: [f64; 2],
}

impl Sight {
    /// `None` if eye, view centre or view angle are missing, or for another lens.
    pub fn new(camera: &Camera, lens: Lens, size: [u32; 2]) -> Option<Self> {
        let [across_deg, _] = camera.view_angle?;
        let forward = (camera.center? - camera.eye?).try_normalize()?;
        let right = forward.cross(camera.up.unwrap_or(DVec3::Z)).try_normalize()?;
        let pixel = match lens {
            Lens::Pinhole => 2.0 * libm::tan(across_deg.to_radians() / 2.0) / f64::from(size[0]),
            Lens::Panorama => 2.0 * PI / f64::from(size[0]),
            Lens::Fisheye { .. } | Lens::Cube => return None,
        };
        let middle = size.map(|pixels| f64::from(pixels) / 2.0);
        Some(Self { lens, forward, right, down: forward.cross(right), pixel, middle })
    }

    /// The viewing direction through a point of the picture, in pixels from its upper left corner.
    pub fn direction(&self, x: f64, y: f64) -> DVec3 {
        let [middle_x, middle_y] = self.middle;
        let (x, y) = ((x - middle_x) * self.pixel, (y - middle_y) * self.pixel);
        if self.lens == Lens::Panorama {
            let ((sin, cos), (down, level)) = (libm::sincos(x), libm::sincos(y));
            return level * (cos * self.forward + sin * self.right) + down * self.down;
        }
        (self.forward + x * self.right + y * self.down).normalize()
    }

    /// The angular size of the pixel at the centre, radians.
    pub fn pixel(&self) -> f64 {
        self.pixel
    }

    /// The centre of the picture, in pixels.
    pub fn middle(&self) -> [f64; 2] {
        self.middle
    }
}
