//! Surfaces at the centres of pixels: for channels and legends.

use rayon::prelude::*;
use ugphysics::{RestFrame, Velocity};
use ugpicture::{Emission, MediumLight, SeenItem};
use ugscene::BodyId;

use crate::scenery::Scenery;
use ugtrace::rays::{PastRay, along};

/// The surfaces at the centres of the pixels of a part of a picture.
pub struct PixelCenters<'a> {
    scenery: &'a Scenery<'a>,
    /// Left column, top row and number of columns.
    area: [u32; 3],
    samples: u32,
    /// For each pixel the surface at its middle that transmits less than half of the light behind
    /// it: the parameter of its ray, and the row of the face.
    surfaces: Vec<Option<(f64, u32)>>,
}

impl<'a> PixelCenters<'a> {
    /// `area`: left column, upper row, width and height.
    pub fn new(
        scenery: &'a Scenery<'a>,
        [left, top, width, height]: [u32; 4],
        samples: u32,
    ) -> Self {
        let n_pixels = width as usize * height as usize;
        let mut centers = Self { scenery, area: [left, top, width], samples, surfaces: Vec::new() };
        centers.surfaces = (0..n_pixels).into_par_iter().map(|idx| centers.surface(idx)).collect();
        centers
    }

    /// The ray through the sample nearest to the centre of a pixel; ties go to the lower-right one.
    fn ray(&self, idx: usize) -> Option<PastRay> {
        let [left, top, width] = self.area;
        // A picture has fewer than 2^32 pixels.
        let (column, row) = ((idx % width as usize) as u32, (idx / width as usize) as u32);
        self.scenery
            .primary_ray([left + column, top + row].map(|at| at * self.samples + self.samples / 2))
    }

    fn surface(&self, idx: usize) -> Option<(f64, u32)> {
        let slab = self.scenery.view.slab;
        self.scenery.first_opaque(&self.ray(idx)?, slab.near..slab.far)
    }

    /// The surface at a pixel, and the emission event of its light, relative to the eye that sees
    /// it.
    pub fn item(&self, idx: usize) -> Option<SeenItem> {
        let ((s, item), ray) = (self.surfaces[idx]?, self.ray(idx)?);
        let frames = self.scenery.appearance.surface.frames();
        let body = self.scenery.scene.faces[item as usize].body;
        let event = along(ray.origin, ray.step, s);
        let (velocity, own_time) = frames.at_event(body, event);
        let emission = Emission {
            place: s * ray.step.x,
            depth: s,
            time: ray.origin.t + s * ray.step.t,
            velocity,
            own_time,
            scene_from_axes: frames.of(body).scene_from_boosted(),
            in_medium: self.in_medium(&ray, body, own_time.map(|_| velocity)),
        };
        Some((item, emission))
    }

    /// Light of a body along a ray, if the eye is in a transparent solid.
    fn in_medium(
        &self,
        ray: &PastRay,
        body: BodyId,
        on_line: Option<Velocity>,
    ) -> Option<MediumLight> {
        self.scenery.media_at(ray.origin).innermost()?;
        let frame = match on_line {
            Some(velocity) => RestFrame::new(velocity),
            None => *self.scenery.appearance.surface.frames().of(body),
        };
        Some(MediumLight {
            doppler: (ray.wave.frequency / frame.wave_to_rest(ray.wave).frequency).abs(),
            rest_direction: frame.rest_from_camera(ray.step).x.normalize_or_zero(),
        })
    }
}
