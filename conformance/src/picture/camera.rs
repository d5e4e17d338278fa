//! Maps pixels to viewing directions.

use glam::DVec3;
use ugscene::Camera;

/// A pinhole camera at the origin with a flat film and square pixels.
pub struct Pinhole {
    forward: DVec3,
    /// Step to the next pixel on the right, on the film at distance 1.
    right: DVec3,
    /// Step to the next pixel below.
    down: DVec3,
    middle: [f64; 2],
}

impl Pinhole {
    /// `None` if eye, view centre or view angle are missing.
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

    /// The angular size of the pixel at the centre, radians.
    pub fn pixel(&self) -> f64 {
        self.right.length()
    }

    /// The centre of the picture, in pixels.
    pub fn middle(&self) -> [f64; 2] {
        self.middle
    }
}
