//! Irradiance at the vertices of a scene, from lamps at rest and in motion.  Eq. (P14)

use glam::DVec3;
use rayon::prelude::*;
use uglight::{Irradiance, Lamps, ScatteringTime, SurfaceElement};
use ugphysics::InertialFrame;
use ugpipe::Progress;
use ugscene::{
    Light, LightKind, LightMotion, RestFrames, Scene, SeenVertices, VertexId, shading_normal,
};

/// Normals that differ by less than this in every component count as equal, so that the pieces of a
/// face that was cut share their vertices. The error of the irradiance is at most as large.
const NORMAL_STEP: f64 = 1e-5;

/// The irradiance of every vertex of a scene, lamp by lamp.
pub(crate) struct VertexIrradiance {
    pub lamps: Lamps,
    /// `None` for vertices that are not lit: those of wires, and of faces with a light level of
    /// their own.
    pub of_vertex: Vec<Option<Vec<Irradiance>>>,
}

/// Repeats vertices where the irradiance differs between faces: faces that meet at an edge get
/// vertices of their own there, unless the vertex carries a normal, and so do faces with a light
/// level of their own.
///
/// Returns the originals of the new vertices, and the normal
/// to light each vertex with; `None` where it is not lit.
pub(crate) fn split(
    scene: &mut Scene,
    vertices: &SeenVertices,
    observer: (DVec3, &RestFrames),
) -> (Vec<VertexId>, Vec<Option<DVec3>>) {
    /// How a vertex is lit.
    #[derive(Clone, Copy, PartialEq, Eq, Hash)]
    enum Kind {
        Unlit,
        Smooth { is_turned: bool },
        Flat([i64; 3]),
    }
    // `None` for a face that is not lit.
    let normal = |face| {
        scene.light_level(face).is_none().then(|| vertices.seen_normal(scene, face, observer))
    };
    let normals: Vec<Option<DVec3>> = scene.faces.par_iter().map(normal).collect();
    let users: Vec<_> = scene.drawn().map(|drawn| drawn.contours).collect();
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
        for corner in scene.face_corners(face) {
            let own = scene.vertices[corner.index()].normal;
            of_vertex[corner.index()].get_or_insert_with(|| shading_normal(own, seen));
        }
    }
    (originals, of_vertex)
}

impl VertexIrradiance {
    /// The irradiance by the lamps of a scene at its vertices.
    ///
    /// `normals`: of [`split`]. Vertices stay unlit if the caller stops it.
    pub fn new(
        scene: &Scene,
        (eye, frames): (DVec3, &RestFrames),
        seen: &SeenVertices,
        normals: &[Option<DVec3>],
        (is_spectral, sky): (bool, Option<&crate::Sky>),
        progress: &dyn Progress,
    ) -> Self {
        let lamps = Lamps::new(scene, eye, is_spectral).over_time(scene, eye, is_spectral);
        let n_own = lamps.len();
        let (lamps, n_lit) = match sky {
            Some((sky, motion)) => {
                let n_lit = n_own + sky.stars.len() + sky.points.len();
                (lamps.and(sky.lights(n_own, *motion, is_spectral)), n_lit)
            }
            None => (lamps, n_own),
        };
        let of_vertex = (seen.rest.par_iter().zip(normals).zip(&seen.bodies).enumerate())
            .map(|(row, ((&point, normal), &body))| {
                progress.check().ok()?;
                let own = seen.own_time(row).map(ScatteringTime::Own);
                let time = own.unwrap_or(ScatteringTime::Delay(0.0));
                let surface = SurfaceElement { point, time, normal: (*normal)?, body };
                let mut light = surface.irradiances(&lamps[..n_own], frames);
                for part in surface.irradiances(&lamps[n_own..n_lit], frames) {
                    let lamp = n_own as u32 + part.lamp;
                    Irradiance { lamp, ..part }.add_to(&mut light, &lamps);
                }
                Some(light)
            })
            .collect();
        Self { lamps, of_vertex }
    }
}

/// Replaces all lights by one ambient light of intensity 1, because the colours include the light
/// already: a renderer then draws them unchanged.
pub(crate) fn replace_lights(scene: &mut Scene) {
    for body in scene.bodies.ids() {
        if let Some(&frame) =
            scene.bodies.motion(body).inertial_frame().filter(|frame| frame.shift.x != DVec3::ZERO)
        {
            scene.bodies.set_frame(body, InertialFrame::new(frame.velocity));
        }
    }
    scene.lights = vec![Light {
        name: None,
        intensity: 1.0,
        kind: LightKind::Ambient,
        color: None,
        motion: LightMotion::WithWhatItLights,
    }];
}
