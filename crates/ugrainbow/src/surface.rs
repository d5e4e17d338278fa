//! What vertices look like and where they rest.

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use ugparse::{Scene, VelocityId, VertexId};
use ugphysics::{Velocity, VelocityError, aberrate};
use ugscene::{Bodies, HueScale, VertexColor, rest_positions, vertex_colors};

use crate::palette::{Palette, Swatch};

/// Colours and rest positions of the vertices of a scene.
#[derive(Clone, Debug)]
pub struct Surface {
    swatches: Vec<Swatch>,
    rest: Vec<DVec3>,
    bodies: Bodies,
}

impl Surface {
    /// `scene`: its vertices belong to one velocity each.
    ///
    /// # Errors
    /// A velocity of the scene is not below that of light.
    pub fn new(scene: &Scene, eye: DVec3, palette: &Palette, scale: HueScale) -> Result<Self, VelocityError> {
        let bodies = Bodies::new(scene, Velocity::ZERO)?;
        let rest = rest_positions(scene, eye, &bodies);
        let swatches = vertex_colors(scene, &rest, scale)
            .into_par_iter()
            .map(|color| match color {
                VertexColor::Named(color) => palette.get(color),
                VertexColor::White => Swatch::WHITE,
                VertexColor::Mixed { hsv, light, translucency } => {
                    Swatch { light: light.map(DVec3::from_array), translucency, ..palette.swatch(hsv) }
                }
            })
            .collect();
        Ok(Self { swatches, rest, bodies })
    }

    /// Its own colour, else the mix of its faces' colours, else white.
    pub fn swatch(&self, vertex: VertexId) -> Swatch {
        self.swatches[vertex.index()]
    }

    /// Where the vertex is in the rest frame of its body, relative to the eye, in the axes of the scene.  Eq. (P4)
    pub fn rest(&self, vertex: VertexId) -> DVec3 {
        self.rest[vertex.index()]
    }

    /// The velocity of a face or wire.
    pub fn velocity(&self, velocity: Option<VelocityId>) -> Velocity {
        self.bodies.of(velocity)
    }

    /// Turns rest coordinates of a body, as (P4) gives them, into the axes of the scene.  Eq. (P25)
    pub fn scene_from_axes(&self, velocity: Option<VelocityId>) -> DQuat {
        self.bodies.scene_from_axes(velocity)
    }

    /// A viewing direction in the rest frame of a body, in the axes of the scene.  Eq. (P6), (P25)
    pub fn rest_direction(&self, direction: DVec3, velocity: Option<VelocityId>) -> DVec3 {
        self.scene_from_axes(velocity) * aberrate(direction, self.bodies.of(velocity))
    }
}
