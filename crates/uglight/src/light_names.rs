//! Names of lights, for explanations.

use ugscene::{LightKind, Scene};

/// The names of the lights of a scene, in their order: as in their statement, else by their kind
/// and their number among those of this kind, such as `local 2`. In a scene without lights, the
/// default ones.
pub fn light_names(scene: &Scene) -> Vec<String> {
    if scene.lights.is_empty() {
        return ["ambient 1", "directional 1"].map(str::to_owned).to_vec();
    }
    let mut counts = [0_usize; 3];
    let name = |light: &ugscene::Light| {
        let (kind, count) = match light.kind {
            LightKind::Ambient => ("ambient", &mut counts[0]),
            LightKind::Directional(_) => ("directional", &mut counts[1]),
            LightKind::Local { .. } => ("local", &mut counts[2]),
        };
        *count += 1;
        light
            .name
            .map_or_else(|| format!("{kind} {count}"), |name| scene.names.get(name).to_owned())
    };
    scene.lights.iter().map(name).collect()
}
