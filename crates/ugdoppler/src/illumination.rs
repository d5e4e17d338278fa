//! Light that falls on vertices, from lights at rest and in motion.  Eq. (P14)

use glam::DVec3;
use rayon::prelude::*;
use uglight::{HueScale, Irradiance, Lamp, SurfaceElement, lamps};
use ugparse::{Face, Light, LightKind, LightMotion, Scene, VertexId};
use ugscene::{RestFrames, seen_normal, shading_normal};

/// Normals nearer to each other than this in all components are one, so that the pieces of a face that was cut
/// share their vertices. A level is off by as much at most.
const NORMAL_STEP: f64 = 1e-5;

/// The light on every vertex of a scene.
pub(crate) struct Illumination {
    pub lamps: Vec<Lamp>,
    /// `None` for vertices that are not lit: of wires, and of faces with a light level of their own.
    pub of_vertex: Vec<Option<Vec<Irradiance>>>,
}

/// Vertices apart where the light on them differs: faces that meet at an edge have vertices of their own there,
/// unless the vertex carries a normal, and so have faces with a light level of their own.
///
/// `rest`: position of each vertex, (P4). Gives the originals of the new vertices, and the normal to light each
/// vertex with; `None` where it is not lit.
pub(crate) fn split(scene: &mut Scene, rest: &[DVec3]) -> (Vec<VertexId>, Vec<Option<DVec3>>) {
    /// What a vertex is lit as.
    #[derive(Clone, Copy, PartialEq, Eq, Hash)]
    enum Kind {
        Unlit,
        Smooth { is_turned: bool },
        Flat([i64; 3]),
    }
    let normals: Vec<Option<DVec3>> =
        scene.faces.par_iter().map(|face| face_normal(scene, face, rest)).collect();
    let faces = scene.faces.iter().map(|face| face.contours.clone());
    let users: Vec<_> = faces.chain(scene.wires.iter().map(|wire| wire.contours.clone())).collect();
    let originals = ugscene::split_corners(scene, users.into_iter(), |user, _, vertex| {
        let Some(&Some(seen)) = normals.get(user) else { return Some(Kind::Unlit) };
        Some(match vertex.normal {
            Some(own) => Kind::Smooth { is_turned: own.dot(seen) < 0.0 },
            None => Kind::Flat((seen / NORMAL_STEP).round().to_array().map(|part| part as i64)),
        })
    });
    let mut of_vertex = vec![None; scene.vertices.len()];
    for (face, seen) in scene.faces.iter().zip(&normals) {
        let Some(seen) = *seen else { continue };
        for corner in scene.contours.corners(face.contours.clone()) {
            let own = scene.vertices[corner.index()].normal;
            of_vertex[corner.index()].get_or_insert_with(|| shading_normal(own, seen));
        }
    }
    (originals, of_vertex)
}

/// The rest normal on the side the eye sees, as `ugrainbow` takes it; `None` for a face that is not lit.
fn face_normal(scene: &Scene, face: &Face, rest: &[DVec3]) -> Option<DVec3> {
    if scene.light_level(face).is_some() {
        return None;
    }
    let outline = scene.face_contours(face).next()?;
    let corners = outline.iter().map(|corner| rest[corner.index()]);
    Some(seen_normal(corners, -rest[outline.first()?.index()]))
}

impl Illumination {
    /// The light of a scene's lights on its vertices.
    ///
    /// `rest`: position of each vertex, relative to the eye, (P4). `normals`: of [`split`].
    pub fn new(
        scene: &Scene,
        eye: DVec3,
        frames: &RestFrames,
        rest: &[DVec3],
        normals: &[Option<DVec3>],
    ) -> Self {
        let lamps = lamps(scene, eye, HueScale::Degrees);
        let bodies = ugscene::vertex_bodies(scene);
        let of_vertex = (rest.par_iter().zip(normals).zip(&bodies))
            .map(|((&point, normal), &body)| {
                let surface = SurfaceElement { point, normal: (*normal)?, body };
                Some(surface.irradiances(&lamps, frames))
            })
            .collect();
        Self { lamps, of_vertex }
    }
}

/// One ambient light in place of all lights, so that colours with light in them are drawn as they are. Comments
/// at the lights stay.
pub(crate) fn replace_lights(scene: &mut Scene) {
    scene.lights = vec![Light {
        name: None,
        intensity: 1.0,
        kind: LightKind::Ambient,
        color: None,
        motion: LightMotion::WithWhatItLights,
    }];
    for comment in &mut scene.comments {
        if let ugparse::Item::Light(row) = &mut comment.at {
            comment.trailing = false;
            *row = 0;
        }
    }
}
