//! The colour a vertex gets from the faces round it (Nguyen 1988, 4.1).

use glam::DVec3;
use ugparse::{Color, ColorId, ColorValue, HueScale, Scene};
use ugphysics::{Hsv, srgb_decode, srgb_encode, wavelength_to_hue, xyz_to_linear_srgb};
use ugscene::{Shares, vertex_shares};
use ugspectrum::Spectrum;

/// A colour statement as HSV, hue in degrees. Wavelengths outside 380…780 nm
/// become the hue at that end, (P16). Black bodies and spectra count with their
/// colour at rest, see [`spectra_note`]. What no screen can show is cut to what
/// it can.
pub fn hsv(scene: &Scene, color: &Color, scale: HueScale) -> Hsv {
    match color.value {
        ColorValue::Rgb(rgb) => Hsv::from_rgb(rgb),
        ColorValue::Xyz(xyz) => shown(xyz),
        ColorValue::Blackbody { .. } | ColorValue::Spectrum { .. } => {
            shown(spectrum(scene, color).0.seen(1.0))
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

/// True for a colour that is given as light, and not as what a screen shows: X, Y, Z, a black body or a spectrum.
pub fn is_light(color: &Color) -> bool {
    !matches!(color.value, ColorValue::Hsv { .. } | ColorValue::Rgb(_))
}

/// A colour statement at rest as linear red, green and blue of the sRGB primaries, uncut: light may have
/// parts above 1 and below 0.  Eq. (P19)  `None` for what is not given as light, see [`is_light`].
pub fn light(scene: &Scene, color: &Color) -> Option<[f64; 3]> {
    match color.value {
        ColorValue::Xyz(xyz) => Some(xyz_to_linear_srgb(xyz)),
        _ if is_light(color) => Some(xyz_to_linear_srgb(spectrum(scene, color).0.seen(1.0))),
        _ => None,
    }
}

/// X, Y, Z as the hue, saturation and value of a screen; colours outside the
/// triangle of its primaries are cut.
fn shown(xyz: [f64; 3]) -> Hsv {
    Hsv::from_rgb(xyz_to_linear_srgb(xyz).map(|channel| srgb_encode(channel.max(0.0))))
}

/// The spectrum of a colour statement, hues in degrees: of `c`, `c_rgb` and
/// `c_xyz` that of a surface of that colour (P20). True if it has this colour
/// at rest exactly, which all have but a `c_xyz` that no smooth surface shows.
pub fn spectrum(scene: &Scene, color: &Color) -> (Spectrum, bool) {
    let of_screen = |rgb: [f64; 3]| (Spectrum::from_linear_srgb(rgb.map(srgb_decode)), true);
    match color.value {
        ColorValue::Rgb(rgb) => of_screen(rgb),
        ColorValue::Hsv { value, hue, saturation } => of_screen(Hsv { hue, saturation, value }.to_rgb()),
        ColorValue::Xyz(xyz) => Spectrum::from_xyz(xyz),
        ColorValue::Blackbody { kelvin, scale } => (Spectrum::blackbody(kelvin, scale), true),
        ColorValue::Spectrum { start, end } => {
            (Spectrum::samples(&scene.samples[start as usize..end as usize]), true)
        }
    }
}

/// What to tell the user of a scene with spectra of which [`hsv`] takes the
/// colour at rest only: those that something is drawn or lit with.
pub fn spectra_note(scene: &Scene) -> Option<String> {
    let has_spectrum =
        |color: &Color| matches!(color.value, ColorValue::Blackbody { .. } | ColorValue::Spectrum { .. });
    // Most scenes have none, and their vertices need not be looked at.
    if !scene.colors.iter().any(has_spectrum) {
        return None;
    }
    let is_spectrum = |id: &ColorId| has_spectrum(&scene.colors[id.index()]);
    // A colour of the vertices beats that of their face.
    let needs_color = |rows: &std::ops::Range<u32>| {
        let corners = scene.contours.corners(rows.clone());
        corners.iter().any(|corner| scene.vertices[corner.index()].color.is_none())
    };
    let vertices = scene.vertices.iter().filter_map(|vertex| vertex.color);
    let faces = scene.faces.iter().filter(|face| needs_color(&face.contours)).filter_map(|face| face.color);
    let wires = scene.wires.iter().filter(|wire| needs_color(&wire.contours)).filter_map(|wire| wire.color);
    let lights = scene.lights.iter().filter_map(|light| light.color);
    let color = vertices.chain(faces).chain(wires).chain(lights).find(is_spectrum)?;
    let name = scene.names.get(scene.colors[color.index()].name);
    Some(format!(
        "black bodies and spectra count with their colour at rest (colour `{name}`): `ugdoppler -sp` shifts them as spectra"
    ))
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
    let shares = vertex_shares(scene, positions);
    // Decoding is slow, and most scenes have no vertex of several colours.
    let linear: Vec<DVec3> = if shares.iter().any(|share| matches!(share, Shares::Mixed(_))) {
        let shown = |color| hsv(scene, color, scale).to_rgb().map(srgb_decode);
        let linear = |color| light(scene, color).unwrap_or_else(|| shown(color));
        scene.colors.iter().map(|color| DVec3::from_array(linear(color))).collect()
    } else {
        Vec::new()
    };
    shares
        .into_iter()
        .map(|share| match share {
            Shares::One(color) => color.map_or(VertexColor::White, VertexColor::Named),
            Shares::Mixed(parts) => mean(scene, &linear, &parts),
        })
        .collect()
}

/// The mean of colours; `linear` is the linear RGB of each colour of the scene.
fn mean(scene: &Scene, linear: &[DVec3], parts: &[(Option<ColorId>, f64)]) -> VertexColor {
    let mut sum = DVec3::ZERO;
    let mut translucency = 0.0;
    let mut has_light = false;
    for &(color, share) in parts {
        has_light |= color.is_some_and(|color| is_light(&scene.colors[color.index()]));
        sum += color.map_or(DVec3::ONE, |color| linear[color.index()]) * share;
        translucency += color.map_or(0.0, |color| scene.colors[color.index()].translucency) * share;
    }
    let linear = sum.to_array();
    VertexColor::Mixed {
        hsv: Hsv::from_rgb(linear.map(|channel| srgb_encode(channel.max(0.0)))),
        light: has_light.then_some(linear),
        translucency,
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

    #[test]
    fn black_bodies_and_spectra_have_their_colour_at_rest() {
        let shown = |statement: &str| {
            let source = ugparse::Source::new("t.ug", statement);
            let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
            hsv(&scene, &scene.colors[0], HueScale::Degrees)
        };
        // Reddish below the temperature of daylight, bluish above, and as bright as the scale says.
        assert!((15.0..45.0).contains(&shown("c_bb glow 3000 0.2;").hue));
        assert!((210.0..240.0).contains(&shown("c_bb star 15000 0.2;").hue));
        let linear = shown("c_bb glow 5000 0.2;").to_rgb().map(srgb_decode);
        assert!((ugphysics::luminance(linear) - 0.2).abs() < 1e-4);
        // Lines of a nanometre: no screen shows them, but their hues are plain.
        assert!((shown("c_spd sodium 588 0 589 100 590 0;").hue - 40.0).abs() < 10.0);
        assert!((shown("c_spd green 531 0 532 100 533 0;").hue - 120.0).abs() < 20.0);
        assert_eq!(shown("c_spd infrared 900 1 1000 1;").value, 0.0);
    }
}
