//! The colour of a vertex: its own, or the mean of those of its faces (Nguyen 1988, 4.1).

use glam::DVec3;
use ugscene::{ColorId, ColorMix, Scene};

use crate::color::encoded_hsv;
use crate::{Mixing, RestColor};

/// The colour of a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VertexColor {
    /// One colour statement: its own, or that of all its faces.
    Named(ColorId),
    /// Neither the vertex nor its faces have a colour: white.
    White,
    /// Its faces have different colours: their mean in linear RGB, weighted by the angle of the
    /// faces' corners.
    Mixed(RestColor),
}

impl VertexColor {
    /// As it is written or mixed.
    pub fn at_rest(&self, scene: &Scene) -> RestColor {
        match *self {
            Self::Named(id) => RestColor::new(scene, Some(id)),
            Self::White => RestColor::WHITE,
            Self::Mixed(color) => color,
        }
    }

    /// How it mixes with others.
    pub fn mixing(&self, scene: &Scene) -> Mixing {
        match self {
            Self::Named(id) => Mixing::of(&scene.colors[id.index()]),
            Self::White => Mixing::Hue,
            Self::Mixed(color) => color.form.mixing(),
        }
    }
}

/// The colour of every vertex: its own, else from its faces, else from its wires. `shares`: of
/// [`ugscene::vertex_mixes`].
pub fn vertex_colors(scene: &Scene, shares: &[ColorMix]) -> Vec<VertexColor> {
    // Decoding is slow, and in most scenes no vertex has several colours.
    let linear: Vec<DVec3> = if shares.iter().any(|share| matches!(share, ColorMix::Mixed(_))) {
        let ids = (0..scene.colors.len()).map(ColorId::from_index);
        ids.map(|color| RestColor::new(scene, Some(color)).linear()).collect()
    } else {
        Vec::new()
    };
    shares
        .iter()
        .map(|share| match share {
            &ColorMix::One(color) => color.map_or(VertexColor::White, VertexColor::Named),
            ColorMix::Mixed(parts) => mean(scene, &linear, parts),
        })
        .collect()
}

/// The mean of colours; `linear` is the linear RGB of each colour of the scene.
fn mean(scene: &Scene, linear: &[DVec3], parts: &[(Option<ColorId>, f64)]) -> VertexColor {
    let mut sum = DVec3::ZERO;
    let mut translucency = 0.0;
    let mut mixing = Mixing::Hue;
    for &(color, share) in parts {
        mixing =
            mixing.max(color.map_or(Mixing::Hue, |color| Mixing::of(&scene.colors[color.index()])));
        sum += color.map_or(DVec3::ONE, |color| linear[color.index()]) * share;
        translucency += color.map_or(0.0, |color| scene.colors[color.index()].translucency) * share;
    }
    VertexColor::Mixed(RestColor { hsv: encoded_hsv(sum), form: mixing.form(sum), translucency })
}

#[cfg(test)]
mod tests {
    use ugscene::vertex_mixes;

    use super::*;

    fn check(text: &str, expected: &[&str]) {
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        let positions: Vec<DVec3> = scene.vertices.iter().map(|v| v.position).collect();
        let shown: Vec<String> = vertex_colors(&scene, &vertex_mixes(&scene, &positions))
            .into_iter()
            .map(|color| match color {
                VertexColor::Named(id) => {
                    scene.names.get(scene.colors[id.index()].name).to_string()
                }
                VertexColor::White => "white".to_string(),
                VertexColor::Mixed(color) => {
                    let rgb = color.hsv.to_rgb().map(ugphysics::srgb_decode);
                    format!("{:.6} {:.6} {:.6}", rgb[0], rgb[1], rgb[2])
                }
            })
            .collect();
        assert_eq!(shown, expected);
    }

    #[test]
    fn colours_of_vertices() {
        let points = "c red 1 0; c green 1 120; v a 0 0 0; v b 1 0 0; v c 1 1 0; v d 0 1 0;";
        check(&format!("{points} f (a b c d) red;"), &["red"; 4]);
        check(&format!("{points} f (a b c d);"), &["white"; 4]);
        check(&format!("{points} w (a b) green;"), &["green", "green", "white", "white"]);
        // A wire along a face does not stain it.
        check(&format!("{points} f (a b c) red; w (a b) green;"), &["red", "red", "red", "white"]);
        // A vertex's own colour wins.
        check(
            &format!("{points} v e 2 0 0 green; f (a e c) red;"),
            &["red", "white", "red", "white", "green"],
        );
    }

    #[test]
    fn faces_of_two_colours_mix_by_angle_in_linear_light() {
        // At `a` the red triangle has 90 degrees, the green one 45.
        check(
            "c red 1 0; c green 1 120; v a 0 0 0; v b 1 0 0; v c 0 1 0; v d -1 1 0;
             f (a b c) red; f (a c d) green;",
            &["0.666667 0.333333 0.000000", "red", "0.333333 0.666667 0.000000", "green"],
        );
    }

    #[test]
    fn light_is_mixed_without_clipping() {
        let text = "c_xyz hot 9 8 7; c_xyz odd 0 1 0; v a 0 0 0; v b 1 0 0; v c 0 1 0; v d -1 0 0;
                    f (a b c) hot; f (a c d) odd;";
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        let positions: Vec<DVec3> = scene.vertices.iter().map(|v| v.position).collect();
        let color = vertex_colors(&scene, &vertex_mixes(&scene, &positions))[0];
        assert_eq!(color.mixing(&scene), Mixing::Light);
        let xyz = ugphysics::linear_srgb_to_xyz(color.at_rest(&scene).linear().to_array());
        // Both corners have 90 degrees.
        assert!((DVec3::from_array(xyz) - DVec3::new(4.5, 4.5, 3.5)).length() < 1e-9, "{xyz:?}");
    }
}
