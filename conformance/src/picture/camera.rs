//! From pixels to directions.

use glam::DVec3;
use ugparse::Camera;

/// A pinhole at the origin before a flat film with square pixels.
pub struct Pinhole {
    forward: DVec3,
    /// To the neighbour pixel on the right, on the film at distance 1.
    right: DVec3,
    /// To the neighbour pixel below.
    down: DVec3,
    middle: [f64; 2],
}

impl Pinhole {
    /// None if the camera does not say where it looks and how wide.
    pub fn new(camera: &Camera, size: [u32; 2]) -> Option<Self> {
        let [across_deg, _] = camera.view_angle?;
        let forward = (camera.center? - camera.eye?).try_normalize()?;
        let right = forward.cross(camera.up.unwrap_or(DVec3::Z)).try_normalize()?;
        let pixel = 2.0 * libm::tan(across_deg.to_radians() / 2.0) / f64::from(size[0]);
        let middle = size.map(|pixels| f64::from(pixels) / 2.0);
        Some(Self { forward, right: right * pixel, down: forward.cross(right) * pixel, middle })
    }

    /// The viewing direction through a point of the film, in pixels from its upper left corner.
    pub fn direction(&self, x: f64, y: f64) -> DVec3 {
        let [middle_x, middle_y] = self.middle;
        (self.forward + self.right * (x - middle_x) + self.down * (y - middle_y)).normalize()
    }

    /// The angle of the pixel in the middle, radians.
    pub fn pixel(&self) -> f64 {
        self.right.length()
    }

    /// The middle of the picture, in pixels.
    pub fn middle(&self) -> [f64; 2] {
        self.middle
    }
}
