//! Names, colours and normals of new vertices, and smooth normals.

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugparse::{Color, ColorId, ColorValue, Scene, Tint, Vertex};
use ugphysics::{Hsv, unit_or_zero};

use crate::refined_mesh::Recipe;
use crate::relative_motion::{Point, RelativeMotion};

/// Prefix of the names of new vertices and colours; a number follows.
const PREFIX: &str = "s#";

/// Adds the vertices of `recipes`, in order, without their positions.
pub(crate) fn add_vertices(scene: &mut Scene, recipes: &[Recipe]) {
    if recipes.is_empty() {
        return;
    }
    let prefix = free_prefix(scene.vertices.iter().map(|vertex| scene.names.get(vertex.name)));
    let mut mixer = ColorMixer::new(scene);
    for (idx, recipe) in recipes.iter().enumerate() {
        let color = mixer.mix(scene, recipe);
        let normal = mean_normal(scene, recipe);
        let name = scene.names.add_parts(&[&prefix, &(idx + 1).to_string()]);
        scene.vertices.push(Vertex { name, position: DVec3::ZERO, color, normal });
    }
}

/// Gives vertices without a normal the mean normal of their faces. Normals are in the axes of the
/// scene, as its lights are.
pub(crate) fn smooth(scene: &mut Scene, points: &[Point], motions: &[RelativeMotion]) {
    let rest: Vec<DVec3> = points.iter().map(|point| point.rest).collect();
    let normals = ugscene::smooth_normals(scene, &rest);
    for ((vertex, normal), point) in scene.vertices.iter_mut().zip(normals).zip(points) {
        if vertex.normal.is_none() && normal != DVec3::ZERO {
            vertex.normal = Some(motions[point.body.index()].turned_back(normal));
        }
    }
}

/// [`PREFIX`], extended by `#` until no name begins with it.
fn free_prefix<'a>(names: impl Iterator<Item = &'a str> + Clone) -> String {
    let mut prefix = PREFIX.to_string();
    while names.clone().any(|name| name.starts_with(&prefix)) {
        prefix.push('#');
    }
    prefix
}

/// Parents and their weights.
fn parents<'a>(scene: &'a Scene, recipe: &Recipe) -> impl Iterator<Item = (&'a Vertex, f64)> + Clone {
    let pairs = recipe.parents.into_iter().zip(recipe.weights).filter(|&(_, weight)| weight > 0.0);
    pairs.map(|(row, weight)| (&scene.vertices[row as usize], weight))
}

/// The mean of the parents' unit normals, of unit length; `None` if a parent has none or they
/// cancel.
fn mean_normal(scene: &Scene, recipe: &Recipe) -> Option<DVec3> {
    parents(scene, recipe)
        .map(|(vertex, weight)| Some(unit_or_zero(vertex.normal?) * weight))
        .sum::<Option<DVec3>>()?
        .try_normalize()
}

/// Mixes colours. Equal mixtures share a statement.
struct ColorMixer {
    prefix: String,
    mixed: FxHashMap<Mixture, ColorId>,
}

/// Rows of the parents' colours and the bits of their weights.
type Mixture = Vec<(ColorId, u64)>;

impl ColorMixer {
    fn new(scene: &Scene) -> ColorMixer {
        let prefix = free_prefix(scene.colors.iter().map(|color| scene.names.get(color.name)));
        ColorMixer { prefix, mixed: FxHashMap::default() }
    }

    /// The colour of a new vertex: that of its parents if they agree, else a mixture; `None` if a
    /// parent has none.
    fn mix(&mut self, scene: &mut Scene, recipe: &Recipe) -> Option<ColorId> {
        let part = |(vertex, weight): (&Vertex, f64)| Some((vertex.color?, weight));
        let mut parts: Vec<(ColorId, f64)> = parents(scene, recipe).map(part).collect::<Option<_>>()?;
        parts.sort_by_key(|&(color, _)| color);
        let first = parts.first()?.0;
        if parts.iter().all(|&(color, _)| color == first) {
            return Some(first);
        }
        let key = parts.iter().map(|&(color, weight)| (color, weight.to_bits())).collect();
        let (prefix, n_mixed) = (&self.prefix, self.mixed.len());
        Some(*self.mixed.entry(key).or_insert_with(|| {
            let (value, translucency) = blend(scene, &parts);
            let name = scene.names.add_parts(&[prefix, &(n_mixed + 1).to_string()]);
            scene.colors.push(Color { name, value, translucency });
            ColorId::from_index(scene.colors.len() - 1)
        }))
    }
}

/// The weighted means of hue, saturation and value, as the renderer of 1988 interpolates them
/// between the corners of a face. Wavelengths in place of hues are averaged alike. Greys do not
/// contribute to the hue.
fn blend(scene: &Scene, parts: &[(ColorId, f64)]) -> (ColorValue, f64) {
    let (mut mean, mut hue_weight, mut translucency) =
        (Hsv { hue: 0.0, saturation: 0.0, value: 0.0 }, 0.0, 0.0);
    for &(id, weight) in parts {
        let color = &scene.colors[id.index()];
        let hsv = uglight::hsv(scene, color);
        mean.value += weight * hsv.value;
        mean.saturation += weight * hsv.saturation;
        translucency += weight * color.translucency;
        if hsv.saturation > 0.0 {
            mean.hue += weight * below_violet(hsv.hue);
            hue_weight += weight;
        }
    }
    if hue_weight > 0.0 {
        mean.hue /= hue_weight;
    }
    let Hsv { hue, saturation, value } = mean;
    (ColorValue::Hsv { value, tint: Tint::Hue(hue), saturation }, translucency)
}

/// Maps hues between violet (300) and red (360) to negative ones, (P16). Larger numbers are
/// wavelengths.
fn below_violet(hue: f64) -> f64 {
    if hue > 300.0 && hue < 360.0 { hue - 360.0 } else { hue }
}
