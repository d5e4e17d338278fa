//! The colour a vertex gets from the faces round it (Nguyen 1988, 4.1).

use glam::DVec3;
use ugparse::{Color, ColorId, ColorValue, Scene};
use ugphysics::{Hsv, srgb_decode, srgb_encode, wavelength_to_hue, xyz_to_linear_srgb};

use crate::corner_angle;

/// What the hue field of `c` statements holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HueScale {
    /// Degrees.
    #[default]
    Degrees,
    /// Wavelengths in nm (`-wi`).
    Wavelengths,
}

/// A colour statement as HSV, hue in degrees. Wavelengths outside 380…780 nm
/// become the hue at that end, (P16). What no screen can show is cut to what it
/// can. Black bodies and spectra count as white, see [`spectra_note`].
pub fn hsv(color: &Color, scale: HueScale) -> Hsv {
    match color.value {
        ColorValue::Rgb(rgb) => Hsv::from_rgb(rgb),
        ColorValue::Xyz(xyz) => {
            Hsv::from_rgb(xyz_to_linear_srgb(xyz).map(|channel| srgb_encode(channel.max(0.0))))
        }
        ColorValue::Blackbody { .. } | ColorValue::Spectrum { .. } => {
            Hsv { hue: 0.0, saturation: 0.0, value: 1.0 }
        }
        ColorValue::Hsv { value, hue, saturation } => {
            let hue = match scale {
                HueScale::Degrees => hue,
                HueScale::Wavelengths => wavelength_to_hue(hue),
            };
            Hsv { hue, saturation, value }
        }
    }
}

/// A colour statement as linear red, green and blue of the sRGB primaries, uncut: light in XYZ may have
/// parts above 1 and below 0. `None` for what is not given as light.
pub fn light(color: &Color) -> Option<[f64; 3]> {
    match color.value {
        ColorValue::Xyz(xyz) => Some(xyz_to_linear_srgb(xyz)),
        _ => None,
    }
}

/// What to tell the user of a scene with colours that [`hsv`] takes for white.
pub fn spectra_note(scene: &Scene) -> Option<String> {
    let is_spectrum =
        |color: &Color| matches!(color.value, ColorValue::Blackbody { .. } | ColorValue::Spectrum { .. });
    let color = scene.colors.iter().find(|color| is_spectrum(color))?;
    let name = scene.names.get(color.name);
    Some(format!("black bodies and spectra are not drawn yet: colour `{name}` and its like count as white"))
}

/// The colour of a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VertexColor {
    /// One colour statement: its own, or that of all its faces.
    Named(ColorId),
    /// No colour is given anywhere: white.
    White,
    /// Its faces have different colours: their mean in linear RGB, weighted by
    /// the angle of the faces' corners.
    Mixed {
        /// The mean, hue in degrees.
        hsv: Hsv,
        /// The mean as linear light, if one of the colours is [`light`]: then nothing is cut.
        light: Option<[f64; 3]>,
        /// The mean translucency.
        translucency: f64,
    },
}

/// The colour of every vertex: its own, else from its faces, else from its wires.
///
/// `positions`: one for each vertex, in the rest frame of its body, where
/// angles do not depend on the speed.
pub fn vertex_colors(scene: &Scene, positions: &[DVec3], scale: HueScale) -> Vec<VertexColor> {
    let mut sums: Vec<Sum> = scene.vertices.iter().map(|vertex| Sum::new(vertex.color)).collect();
    let mut use_colour = |contour: &[ugparse::VertexId], color: Option<ColorId>, weighted: bool| {
        for (idx, corner) in contour.iter().enumerate() {
            let weight = || if weighted { corner_angle(contour, idx, positions) } else { 1.0 };
            sums[corner.index()].add(scene, scale, color, weight);
        }
    };
    for face in &scene.faces {
        scene.face_contours(face).for_each(|contour| use_colour(contour, face.color, true));
    }
    // Wires speak only for vertices that no face uses.
    let used_by_faces: Vec<bool> = if scene.wires.is_empty() { Vec::new() } else { face_vertices(scene) };
    for wire in &scene.wires {
        for corner in scene.wire_contours(wire).flatten() {
            if !used_by_faces[corner.index()] {
                use_colour(std::slice::from_ref(corner), wire.color, false);
            }
        }
    }
    sums.into_iter().map(Sum::finish).collect()
}

fn face_vertices(scene: &Scene) -> Vec<bool> {
    let mut used = vec![false; scene.vertices.len()];
    for face in &scene.faces {
        scene.contours.corners(face.contours.clone()).iter().for_each(|corner| used[corner.index()] = true);
    }
    used
}

/// The colours met at a vertex so far.
enum Sum {
    /// Given by the vertex itself; nothing changes it.
    Own(ColorId),
    Nothing,
    /// One colour only; its weight is needed if another comes.
    One {
        color: Option<ColorId>,
        weight: f64,
    },
    Many(Box<Mean>),
}

impl Sum {
    fn new(own: Option<ColorId>) -> Self {
        own.map_or(Self::Nothing, Self::Own)
    }

    fn add(&mut self, scene: &Scene, scale: HueScale, color: Option<ColorId>, weight: impl Fn() -> f64) {
        match self {
            Self::Own(_) => {}
            Self::Nothing => *self = Self::One { color, weight: weight() },
            Self::One { color: first, weight: sum } if *first == color => *sum += weight(),
            Self::One { color: first, weight: sum } => {
                let mut mean = Box::<Mean>::default();
                mean.add(scene, scale, *first, *sum);
                mean.add(scene, scale, color, weight());
                *self = Self::Many(mean);
            }
            Self::Many(mean) => mean.add(scene, scale, color, weight()),
        }
    }

    fn finish(self) -> VertexColor {
        match self {
            Self::Own(color) | Self::One { color: Some(color), .. } => VertexColor::Named(color),
            Self::Nothing | Self::One { color: None, .. } => VertexColor::White,
            Self::Many(mean) => mean.finish(),
        }
    }
}

/// A weighted mean of colours in linear RGB.
#[derive(Default)]
struct Mean {
    linear: DVec3,
    /// One of them is given as light.
    is_light: bool,
    translucency: f64,
    weight: f64,
}

impl Mean {
    fn add(&mut self, scene: &Scene, scale: HueScale, color: Option<ColorId>, weight: f64) {
        let color = color.map(|color| &scene.colors[color.index()]);
        let given = color.and_then(light);
        let linear = given.unwrap_or_else(|| match color {
            Some(color) => hsv(color, scale).to_rgb().map(srgb_decode),
            None => [1.0; 3],
        });
        let translucency = color.map_or(0.0, |color| color.translucency);
        self.is_light |= given.is_some();
        self.linear += DVec3::from_array(linear) * weight;
        self.translucency += translucency * weight;
        self.weight += weight;
    }

    fn finish(&self) -> VertexColor {
        // Corners without an angle, all of them: as good as no colour.
        if self.weight <= 0.0 {
            return VertexColor::White;
        }
        let linear = self.linear / self.weight;
        VertexColor::Mixed {
            hsv: Hsv::from_rgb(linear.to_array().map(|channel| srgb_encode(channel.max(0.0)))),
            light: self.is_light.then_some(linear.to_array()),
            translucency: self.translucency / self.weight,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &[&str]) {
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        let positions: Vec<DVec3> = scene.vertices.iter().map(|v| v.position).collect();
        let shown: Vec<String> = vertex_colors(&scene, &positions, HueScale::Degrees)
            .into_iter()
            .map(|color| match color {
                VertexColor::Named(id) => scene.names.get(scene.colors[id.index()].name).to_string(),
                VertexColor::White => "white".to_string(),
                VertexColor::Mixed { hsv, .. } => {
                    let rgb = hsv.to_rgb().map(srgb_decode);
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
    fn light_is_mixed_uncut() {
        let text = "c_xyz hot 9 8 7; c_xyz odd 0 1 0; v a 0 0 0; v b 1 0 0; v c 0 1 0; v d -1 0 0;
                    f (a b c) hot; f (a c d) odd;";
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        let positions: Vec<DVec3> = scene.vertices.iter().map(|v| v.position).collect();
        let VertexColor::Mixed { light: Some(light), .. } =
            vertex_colors(&scene, &positions, HueScale::Degrees)[0]
        else {
            panic!("two faces with two colours meet there")
        };
        let xyz = ugphysics::linear_srgb_to_xyz(light);
        // Both corners have 90 degrees.
        assert!((DVec3::from_array(xyz) - DVec3::new(4.5, 4.5, 3.5)).length() < 1e-9, "{xyz:?}");
    }
}
