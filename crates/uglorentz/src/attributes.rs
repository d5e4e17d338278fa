//! Names, colours and normals of new vertices, and smooth normals.

use std::borrow::Borrow;

use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use uglight::{Mixing, RestColor, VertexColor};
use ugphysics::{Hsv, srgb_encode, unit_or_zero};
use ugscene::{
    Color, ColorId, ColorMix, ColorValue, Mix, MixtureNames, Scene, Tint, Vertex, face_vertices,
    vertex_mixes,
};

use crate::refined_mesh::Recipe;
use crate::relative_motion::{Point, RelativeMotion};

/// Prefix of the names of new vertices and colours; a number follows.
const PREFIX: &str = "s#";

/// The most colours in the mixtures of new vertices, beyond [`FREE_PARTS`] in each: where n faces
/// of n colours meet, they are about n².
pub(crate) const MOST_PARTS: usize = 1 << 22;

/// Colours of a mixture that do not count: so many meet in ordinary meshes.
const FREE_PARTS: usize = 16;

/// Adds the vertices of `recipes`, in order, without their positions.
///
/// `shades`: of the vertices of the scene, see [`shades`]. With `is_apart`, new vertices have no
/// mixtures of the colours of several faces.
///
/// Returns which vertices have a colour that depends on those of faces, by row; `None` if
/// mixtures have more than [`MOST_PARTS`].
pub(crate) fn add_vertices(
    scene: &mut Scene,
    recipes: &[Recipe],
    mut shades: Option<Vec<(Shade, ColorMix)>>,
    is_apart: bool,
) -> Option<Vec<bool>> {
    if recipes.is_empty() {
        return Some(Vec::new());
    }
    let mut n_parts = 0;
    let prefix =
        free_prefix(PREFIX, scene.vertices.iter().map(|vertex| scene.names.get(vertex.name)));
    let n_vertices = scene.vertices.len() + recipes.len();
    let is_used = shades.is_some().then(|| face_vertices(scene, n_vertices));
    let mut inherits = vec![false; if shades.is_some() { n_vertices } else { 0 }];
    let mut mixer = ColorMixer::new(scene);
    for (idx, recipe) in recipes.iter().enumerate() {
        let row = scene.vertices.len();
        let mut color = mixer.mix(scene, recipe);
        if let (Some(shades), Some(is_used)) = (&mut shades, &is_used) {
            let (shade, shares) = mixer.shade(scene, recipe, shades, color);
            if color.is_none() && is_used[row] && !(is_apart && shade.is_mixture) {
                color = mixer.statement(scene, &shade, &shares);
                inherits[row] = color.is_some();
            }
            if let ColorMix::Mixed(parts) = &shares {
                n_parts += parts.len().saturating_sub(FREE_PARTS);
            }
            if n_parts > MOST_PARTS {
                return None;
            }
            shades.push((shade, shares));
        }
        let normal = mean_normal(scene, recipe);
        let uv = mean_uv(scene, recipe);
        let name = scene.names.add_parts(&[&prefix, &(idx + 1).to_string()]);
        scene.add_vertex(Vertex { name, position: DVec3::ZERO, color, normal, uv });
    }
    Some(inherits)
}

/// The shades of the vertices of a scene, and the colours in them, from which those of new vertices
/// are interpolated; `None` if no new vertex needs that, because vertices and faces have their
/// colours and meet no others.
pub(crate) fn shades(scene: &Scene, points: &[Point]) -> Option<Vec<(Shade, ColorMix)>> {
    let mut has_color = scene.vertices.iter().map(|vertex| vertex.color.is_some());
    let first = has_color.next()?;
    let is_partial = has_color.any(|has_color| has_color != first);
    if !is_partial && ugscene::n_mixing_vertices(scene) == 0 {
        return None;
    }
    let rest: Vec<DVec3> = points[..scene.vertices.len()].iter().map(|point| point.rest).collect();
    let shade = |color: VertexColor| match color {
        VertexColor::Named(id) => Shade::of(scene, Some(id)),
        VertexColor::White => Shade::of(scene, None),
        VertexColor::Mixed(rest) => Shade { color: None, is_mixture: true, rest },
    };
    let shares = vertex_mixes(scene, &rest);
    let shades = uglight::vertex_colors(scene, &shares).into_iter().map(shade);
    Some(shades.zip(shares.into_iter().map(|shares| shares.of_spectra(scene))).collect())
}

/// The look of a vertex at rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shade {
    /// The statement it is given by, or `Some(None)` for white; `None` if there is no statement.
    color: Option<Option<ColorId>>,
    /// Colours of several faces are mixed in it.
    is_mixture: bool,
    rest: RestColor,
}

impl Shade {
    fn of(scene: &Scene, id: Option<ColorId>) -> Shade {
        let name = |id: ColorId| scene.names.get(scene.colors[id.index()].name);
        let is_mixture =
            id.zip(scene.stage.mixtures).is_some_and(|(id, mixtures)| mixtures.contains(name(id)));
        Shade { color: Some(id), is_mixture, rest: RestColor::new(scene, id) }
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

/// `prefix`, extended by `#` until no name begins with it.
pub(crate) fn free_prefix<'a>(
    prefix: &str,
    names: impl Iterator<Item = &'a str> + Clone,
) -> String {
    let mut prefix = prefix.to_string();
    while names.clone().any(|name| name.starts_with(&prefix)) {
        prefix.push('#');
    }
    prefix
}

/// Parents and their weights.
fn parents<'a>(
    scene: &'a Scene,
    recipe: &Recipe,
) -> impl Iterator<Item = (&'a Vertex, f64)> + Clone {
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

/// The mean of the parents' texture coordinates, which is linear at rest; `None` if a parent has
/// none.
fn mean_uv(scene: &Scene, recipe: &Recipe) -> Option<[f32; 2]> {
    let part = |(vertex, weight): (&Vertex, f64)| {
        Some(vertex.uv?.map(f64::from)).map(|[u, v]| DVec2::new(u, v) * weight)
    };
    let mean = parents(scene, recipe).map(part).sum::<Option<DVec2>>()?;
    Some([mean.x as f32, mean.y as f32])
}

/// Mixes colours. Equal mixtures share a statement.
struct ColorMixer {
    prefix: String,
    mixed: FxHashMap<Mixture, ColorId>,
    mixtures: MixtureNames,
    stated: FxHashMap<([u64; 5], bool, MixedColors), ColorId>,
    white: Option<ColorId>,
}

/// Rows of the parents' colours and the bits of their weights.
type Mixture = Vec<(ColorId, u64)>;

/// Colours of the scene, each once, and the bits of their shares.
type MixedColors = Vec<(Option<ColorId>, u64)>;

impl ColorMixer {
    fn new(scene: &Scene) -> ColorMixer {
        let names = scene.colors.iter().map(|color| scene.names.get(color.name));
        let prefix = free_prefix(PREFIX, names.clone());
        // Then the names of a scene that has mixtures already are continued.
        let earlier = scene.stage.mixtures.map(MixtureNames::prefix);
        let mixtures = MixtureNames::unused(names.chain(earlier.as_deref()));
        let (mixed, stated) = (FxHashMap::default(), FxHashMap::default());
        ColorMixer { prefix, mixed, mixtures, stated, white: None }
    }

    /// The colour of a new vertex: that of its parents if they agree, else a mixture; `None` if a
    /// parent has none.
    fn mix(&mut self, scene: &mut Scene, recipe: &Recipe) -> Option<ColorId> {
        let part = |(vertex, weight): (&Vertex, f64)| Some((vertex.color?, weight));
        let mut parts: Vec<(ColorId, f64)> =
            parents(scene, recipe).map(part).collect::<Option<_>>()?;
        parts.sort_by_key(|&(color, _)| color);
        let first = parts.first()?.0;
        if parts.iter().all(|&(color, _)| color == first) {
            return Some(first);
        }
        let key = parts.iter().map(|&(color, weight)| (color, weight.to_bits())).collect();
        if let Some(&known) = self.mixed.get(&key) {
            return Some(known);
        }
        let shades: Vec<Shade> =
            parts.iter().map(|&(color, _)| Shade::of(scene, Some(color))).collect();
        let shade = blend(shades.iter().zip(parts.iter().map(|&(_, weight)| weight)));
        let parts = parts
            .into_iter()
            .map(|(color, weight)| (ColorMix::One(Some(color)).of_spectra(scene), weight));
        let shares = sum(parts);
        let color = self.add(scene, &shade, &shares);
        self.mixed.insert(key, color);
        Some(color)
    }

    /// The shade of a new vertex, whose own colour is `color`, and the colours in it.
    fn shade(
        &self,
        scene: &Scene,
        recipe: &Recipe,
        shades: &[(Shade, ColorMix)],
        color: Option<ColorId>,
    ) -> (Shade, ColorMix) {
        if color.is_some() {
            return (Shade::of(scene, color), ColorMix::One(color).of_spectra(scene));
        }
        let parts =
            recipe.parents.into_iter().zip(recipe.weights).filter(|&(_, weight)| weight > 0.0);
        let shares = sum(parts.clone().map(|(row, weight)| (&shades[row as usize].1, weight)));
        let parts = parts.map(|(row, weight)| (&shades[row as usize].0, weight));
        let shade = Self::blend_or_same(parts);
        (shade, shares)
    }

    /// The shade of parts if it is one, else their mixture.
    fn blend_or_same<'s>(parts: impl Iterator<Item = (&'s Shade, f64)> + Clone) -> Shade {
        match parts.clone().next() {
            Some((first, _))
                if first.color.is_some()
                    && parts.clone().all(|part| part.0.color == first.color) =>
            {
                *first
            }
            _ => blend(parts),
        }
    }

    /// The statement for a shade; `None` if it is that of a face.
    fn statement(
        &mut self,
        scene: &mut Scene,
        shade: &Shade,
        shares: &ColorMix,
    ) -> Option<ColorId> {
        if shade.color.is_some() {
            return None;
        }
        let parts = shares.parts().map(|(color, share)| (color, share.to_bits())).collect();
        let key = (shade.rest.key(), shade.is_mixture, parts);
        if let Some(&known) = self.stated.get(&key) {
            return Some(known);
        }
        let color = self.add(scene, shade, shares);
        self.stated.insert(key, color);
        Some(color)
    }

    /// Adds a statement, and that of what it is mixed of where colours are spectra.
    fn add(&mut self, scene: &mut Scene, shade: &Shade, shares: &ColorMix) -> ColorId {
        let prefix = if shade.is_mixture {
            scene.stage.mixtures.get_or_insert(self.mixtures);
            self.mixtures.prefix()
        } else {
            self.prefix.clone()
        };
        let number = self.mixed.len() + self.stated.len() + 1;
        let name = scene.names.add_parts(&[&prefix, &number.to_string()]);
        let part = |(color, share): (Option<ColorId>, f64)| {
            (color.unwrap_or_else(|| self.white(scene)), share.min(1.0))
        };
        let parts: Vec<_> = shares.parts().map(part).collect();
        let color = ColorId::from_index(scene.colors.len());
        let RestColor { translucency, .. } = shade.rest;
        scene.colors.push(Color { name, value: shade.rest.value(), translucency });
        // Colours in ascending order, as the scene requires.
        scene.mixes.push(Mix { color, parts });
        color
    }

    /// A statement of white, for parts without one.
    fn white(&mut self, scene: &mut Scene) -> ColorId {
        *self.white.get_or_insert_with(|| {
            let name = scene.names.add_parts(&[&self.prefix, "white"]);
            let value =
                ColorValue::Hsv { value: 1.0, tint: Tint::Hue(0.0), saturation: 0.0, factor: 1.0 };
            scene.colors.push(Color { name, value, translucency: 0.0 });
            ColorId::from_index(scene.colors.len() - 1)
        })
    }
}

/// The colours in weighted parts, each once.
fn sum(weighted: impl Iterator<Item = (impl Borrow<ColorMix>, f64)>) -> ColorMix {
    let mut parts = Vec::new();
    for (shares, weight) in weighted {
        parts.extend(shares.borrow().parts().map(|(color, share)| (color, weight * share)));
    }
    parts.sort_by_key(|&(color, _)| color);
    parts.dedup_by(|(color, share), (before, sum)| {
        let is_same = color == before;
        if is_same {
            *sum += *share;
        }
        is_same
    });
    match parts[..] {
        [(color, _)] => ColorMix::One(color),
        _ => ColorMix::Mixed(parts),
    }
}

/// The mean of hues ([`uglight::mean_hue`]). If a part is given as light, or as a colour of a
/// display (`c_rgb`), light is averaged instead.
fn blend<'s>(parts: impl Iterator<Item = (&'s Shade, f64)> + Clone) -> Shade {
    let (mut translucency, mut mixing, mut is_mixture) = (0.0, Mixing::Hue, false);
    for (Shade { rest, is_mixture: is_mixed, .. }, weight) in parts.clone() {
        translucency += weight * rest.translucency;
        mixing = mixing.max(rest.form.mixing());
        is_mixture |= is_mixed;
    }
    // Weights may add up to more than 1 by rounding.
    let translucency = translucency.min(1.0);
    let mean = || parts.clone().map(|(shade, weight)| weight * shade.rest.linear()).sum::<DVec3>();
    let light = if mixing == Mixing::Hue { DVec3::ZERO } else { mean() };
    let (hsv, light) = match mixing {
        Mixing::Display => {
            let light = light.min(DVec3::ONE);
            (Hsv::from_rgb(light.to_array().map(srgb_encode)), light)
        }
        _ => (uglight::mean_hue(parts.map(|(shade, weight)| (shade.rest.hsv, weight))), light),
    };
    Shade {
        color: None,
        is_mixture,
        rest: RestColor { hsv, form: mixing.form(light), translucency },
    }
}
