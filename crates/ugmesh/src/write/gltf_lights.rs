//! Lights as `KHR_lights_punctual`.

use std::f32::consts::FRAC_PI_2;
use std::f64::consts::PI;

use glam::DVec3;
use serde_json::{Value, json};
use uglight::RestColor;
use ugscene::{Beam, Light, LightKind, Scene};

use crate::polygon_mesh::note_count;

/// The extension.
pub(super) const NAME: &str = "KHR_lights_punctual";

/// The notes on lights that glTF does not have.
const LEFT_OUT: [&str; 2] = [
    "light is left out: glTF has only directional lights, and points and spots up to 90° with a \
     reference distance",
    "lights are left out: glTF has only directional lights, and points and spots up to 90° with a \
     reference distance",
];

/// The lights of a scene, and their nodes. Those that glTF does not have are left out with a note.
pub(super) fn lights(scene: &Scene, notes: &mut Vec<String>) -> Vec<(Value, Value)> {
    let is_lit = scene.stage.seen_colors().is_some_and(|colors| colors.lights);
    if scene.stage.seen_geometry().is_some() || is_lit {
        let (one, many) =
            ("light of a scene as seen is left out", "lights of a scene as seen are left out");
        note_count(notes, scene.lights.len(), one, many);
        return Vec::new();
    }
    let written: Vec<_> = scene.lights.iter().filter_map(|it| light(scene, it)).collect();
    let n_left_out = scene.lights.len() - written.len();
    note_count(notes, n_left_out, LEFT_OUT[0], LEFT_OUT[1]);
    let with_row = |(row, (light, mut node)): (usize, (Value, Value))| {
        node["extensions"][NAME] = json!({ "light": row });
        (light, node)
    };
    written.into_iter().enumerate().map(with_row).collect()
}

/// A light and its node. The light level 1 is the illuminance π lux, see `ugmeshfile`.
fn light(scene: &Scene, light: &Light) -> Option<(Value, Value)> {
    let linear = light
        .color
        .map_or(DVec3::ONE, |color| RestColor::new(scene, Some(color)).linear().max(DVec3::ZERO));
    let most = linear.max_element();
    let color = if most > 0.0 { linear / most } else { DVec3::ONE };
    let level = light.intensity * most;
    let (kind, intensity, matrix) = match light.kind {
        LightKind::Directional(toward) => {
            let backward = (toward / toward.abs().max_element()).normalize_or_zero();
            ("directional", level * PI, node_matrix(DVec3::ZERO, backward, up_beside(backward)))
        }
        LightKind::Local { position, reference: Some(reference), beam, .. } => {
            let candela = level * reference * reference * PI;
            match beam {
                Beam::Even => ("point", candela, node_matrix(position, DVec3::Z, DVec3::Y)),
                Beam::Spot { axis, degrees: [outer, _] } if outer > 0.0 && outer <= 90.0 => {
                    let backward = (-axis / axis.abs().max_element()).normalize_or_zero();
                    ("spot", candela, node_matrix(position, backward, up_beside(backward)))
                }
                Beam::Spot { .. } | Beam::Area(_) => return None,
            }
        }
        LightKind::Local { reference: None, .. } | LightKind::Ambient => return None,
    };
    let intensity = intensity as f32;
    if !intensity.is_finite() || !matrix.iter().all(|number| number.is_finite()) {
        return None;
    }
    let color = color.as_vec3().to_array();
    let mut written = json!({ "type": kind, "color": color, "intensity": intensity });
    if let LightKind::Local { beam: Beam::Spot { degrees: [outer, edge], .. }, .. } = light.kind {
        // Cones of glTF end at a right angle, which 32 bits round up, and have an edge.
        let outer_angle = (outer.to_radians() as f32).min(FRAC_PI_2.next_down());
        let inner = ((outer - edge).to_radians() as f32).clamp(0.0, outer_angle.next_down());
        let outer = outer_angle;
        written["spot"] = json!({ "innerConeAngle": inner, "outerConeAngle": outer });
    }
    if let Some(name) = light.name {
        written["name"] = scene.names.get(name).into();
    }
    let mut node = json!({ "matrix": matrix });
    if let Some(name) = written.get("name") {
        node["name"] = name.clone();
    }
    Some((written, node))
}

/// An axis that is not along a unit vector.
fn up_beside(direction: DVec3) -> DVec3 {
    if direction.y.abs() < 0.9 { DVec3::Y } else { DVec3::X }
}

/// The matrix of a node by columns, for what looks or shines along its −z axis, with y up.
/// `backward`: a unit vector.
pub(super) fn node_matrix(place: DVec3, backward: DVec3, up: DVec3) -> [f32; 16] {
    let right = up.cross(backward).normalize();
    let columns = [(right, 0.0), (backward.cross(right), 0.0), (backward, 0.0), (place, 1.0)];
    let mut matrix = [0.0; 16];
    for (column, (axis, w)) in columns.into_iter().enumerate() {
        let row = axis.extend(w).as_vec4().to_array();
        matrix[4 * column..][..4].copy_from_slice(&row);
    }
    matrix
}
