//! What vertices look like and where they rest.

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use uglight::{HueScale, VertexColor, vertex_colors};
use ugparse::{ColorId, Scene, VelocityId, VertexId};
use ugphysics::{Velocity, VelocityError, aberrate};
use ugscene::{Bodies, rest_positions};

use crate::palette::{Palette, Swatch};

/// Colours and rest positions of the vertices of a scene.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Different colours: those of the scene, white, and mixed ones.
    swatches: Vec<Swatch>,
    /// For each vertex a row of the swatches; most vertices share theirs with others.
    rows: Vec<u32>,
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
        let mut swatches = palette.all().to_vec();
        let own = scene.vertices.par_iter().map(|vertex| vertex.color.map(row));
        let rows = match own.collect() {
            Some(rows) => rows,
            None => mixed_rows(scene, &rest, palette, scale, &mut swatches),
        };
        Ok(Self { swatches, rows, rest, bodies })
    }

    /// Its own colour, else the mix of its faces' colours, else white.
    #[inline]
    pub fn swatch(&self, vertex: VertexId) -> &Swatch {
        &self.swatches[self.rows[vertex.index()] as usize]
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

fn row(color: ColorId) -> u32 {
    // Scenes have fewer than 2^32 colours.
    color.index() as u32
}

/// The rows of vertices that have not all colours of their own; what is not in the scene is added.
fn mixed_rows(
    scene: &Scene,
    rest: &[DVec3],
    palette: &Palette,
    scale: HueScale,
    swatches: &mut Vec<Swatch>,
) -> Vec<u32> {
    let white = swatches.len() as u32;
    swatches.push(Swatch::WHITE);
    let colors = vertex_colors(scene, rest, scale).into_iter();
    let rows = colors.map(|color| match color {
        VertexColor::Named(color) => row(color),
        VertexColor::White => white,
        VertexColor::Mixed { hsv, light, translucency } => {
            let light = light.map(DVec3::from_array);
            swatches.push(Swatch { light, translucency, ..palette.swatch(hsv) });
            // There are no more mixed colours than vertices.
            swatches.len() as u32 - 1
        }
    });
    rows.collect()
}
