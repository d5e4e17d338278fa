//! Colour and light of a face at its points at rest.

use glam::DVec3;
use uglight::{
    ColorForm, FaceColors, Illumination, Lighting, Mixing, SpectralRows, SurfaceColor, Swatch,
};
use ugscene::{ColorId, Face, VertexId};
use ugtrace::outlines::{PictureRays, RestRay};

use crate::painter::Painter;

/// The appearance of a face, point by point.
#[derive(Clone, Debug)]
pub struct Look {
    /// What its corners have in common.
    colors: FaceColors,
    /// Normal of the face on its visible side, in the axes of the scene.
    normal: DVec3,
    /// The light level, if it is the same everywhere.
    level: Option<DVec3>,
    /// The light level depends on the position.
    needs_place: bool,
    /// Coloured lamps, whose spectra multiply those of the face, or change its hue.
    is_lit_by_color: bool,
    has_colors: bool,
    has_tints: bool,
    has_normals: bool,
    /// Its colour at rest, or that of its first corner, with the wavelength of the colour.
    color: Swatch,
    wavelength_nm: f64,
    /// Index of its spectrum.
    row: u32,
    /// The colour of the face, if it is a picture or emits light.
    picture: Option<ColorId>,
    /// Samples in a row of a pixel, for which a texel is found once.
    pub n_together: u32,
    /// Triangles between the corners, if colours or normals differ between these, or for a picture.
    /// Values at a point are interpolated linearly in the rest frame.
    triangles: Box<[Triangle]>,
}

#[derive(Clone, Debug)]
struct Triangle {
    corners: [VertexId; 3],
    colors: [Swatch; 3],
    /// Indices of the spectra of the corners.
    rows: [u32; 3],
    normals: [DVec3; 3],
    /// If the colours are opaque hues, tint, saturation and value: each at the first corner, and
    /// the differences to the other two.
    hues: Option<[[f64; 3]; 3]>,
    /// Normals of the planes through the eye and each side. Dot products with a ray are
    /// proportional to the weights of the opposite corners.
    sides: [DVec3; 3],
}

/// The weighted mean.
#[inline]
fn mean(weights: [f64; 3], [a, b, c]: [DVec3; 3]) -> DVec3 {
    weights[0] * a + weights[1] * b + weights[2] * c
}

impl Triangle {
    fn new(places: [DVec3; 3], ids: [VertexId; 3], corners: [(Swatch, u32, DVec3); 3]) -> Self {
        let [a, b, c] = places;
        let sides = [(b, c), (c, a), (a, b)].map(|(from, to)| from.cross(to - from));
        let colors @ [a, b, c] = corners.map(|corner| corner.0);
        let number = |of: fn(&Swatch) -> f64| [of(&a), of(&b) - of(&a), of(&c) - of(&a)];
        let hues = [
            number(|color| color.tint),
            number(|color| color.saturation),
            number(|color| color.value),
        ];
        let are_hues =
            colors.iter().all(|color| color.form == ColorForm::Hue && color.translucency == 0.0);
        let (rows, normals) = (corners.map(|corner| corner.1), corners.map(|corner| corner.2));
        Self { corners: ids, colors, rows, normals, hues: are_hues.then_some(hues), sides }
    }

    /// The weights of the corners where a ray from the eye meets the plane of the triangle.
    #[inline]
    fn weights(&self, ray: DVec3) -> [f64; 3] {
        let products = self.sides.map(|side| side.dot(ray));
        let part = 1.0 / (products[0] + products[1] + products[2]);
        products.map(|product| product * part)
    }

    /// The colour at a point, given by weights of the corners.
    #[inline]
    fn color(&self, weights: [f64; 3]) -> Swatch {
        match &self.hues {
            Some(hues) => {
                let [_, second, third] = weights;
                // A number that is the same at all corners keeps its bits.
                let [tint, saturation, value] = hues.map(|[a, b, c]| a + second * b + third * c);
                Swatch { tint, saturation, value, ..self.colors[0] }
            }
            None => Swatch::mean(&self.colors, weights),
        }
    }
}

impl Look {
    /// The appearance of `face`. `frame`: rays in its rest frame; `None` on a world line, or for a
    /// round face.
    pub fn new(painter: &Painter<'_>, frame: Option<&PictureRays>, face: &Face) -> Self {
        let (appearance, lighting) = (painter.appearance, painter.lighting);
        let is_moving = match frame {
            Some(frame) => !frame.velocity.is_zero(),
            None => appearance.surface.frames().is_moving(face.body),
        };
        let mut colors = appearance.face_colors_in_motion(painter.scene, face, is_moving);
        let has_texture = painter.textures.has(face.color);
        if has_texture && !appearance.is_spectral() {
            // Texels are drawn as colours of a display.
            let keeps_light = appearance.keeps_light() || !is_moving;
            colors.mixing = if keeps_light { Mixing::Display } else { Mixing::Hue };
        }
        let emits = face.color.is_some_and(|color| painter.scene.emitted_by(color).is_some());
        let is_picture = has_texture || emits;
        let normal = painter.seen_normal(face);
        let vertices = painter.scene.face_corners(face);
        let corner = |&vertex: &VertexId| {
            (
                appearance.swatch(vertex, &colors),
                appearance.surface.row(vertex),
                painter.normal_at(vertex, normal),
            )
        };
        let corners: Vec<(Swatch, u32, DVec3)> = vertices.iter().map(corner).collect();
        let first = corners[0];
        let is_spectral = appearance.is_spectral();
        let has_colors = corners
            .iter()
            .any(|corner| corner.0 != first.0 || (is_spectral && corner.1 != first.1));
        let has_normals = corners.iter().any(|corner| corner.2 != first.2);
        let has_level = painter.scene.light_level(face).is_some();
        let is_hue = !is_spectral && colors.mixing == Mixing::Hue;
        let is_lit_by_color = !has_level && lighting.is_colored() && (is_spectral || is_hue);
        let is_light = colors.mixing == Mixing::Light;
        // A body on a world line turns, and a round face has all normals.
        let has_directions = (has_normals || frame.is_none()) && lighting.needs_geometry();
        let is_even = has_level || !(lighting.needs_places() || has_directions);
        let level = (is_even && !is_lit_by_color)
            .then(|| painter.level(face, vertices[0], normal, is_light));
        let has_normals = has_normals && level.is_none();
        let triangles = match frame {
            Some(frame) if has_colors || has_normals || is_picture => {
                triangles(painter, frame, face, &corners)
            }
            _ => Box::default(),
        };
        Self {
            colors,
            normal: first.2,
            level,
            needs_place: lighting.needs_places(),
            is_lit_by_color,
            has_colors,
            has_tints: has_texture || corners.iter().any(|corner| corner.0.tint != first.0.tint),
            picture: face.color.filter(|_| is_picture),
            n_together: if is_picture { painter.grid.samples } else { 1 },
            has_normals,
            color: first.0,
            wavelength_nm: appearance.wavelength_nm(first.0.tint),
            row: first.1,
            triangles,
        }
    }

    /// Apparent colour and light level where a ray meets the plane of the face. `key`: the inverse
    /// of the ray parameter there. `n_samples`: in a row, in whose middle the ray is. `SPECTRAL`:
    /// colours are spectra; a constant, so that the loop over hues has no call in it.
    #[inline(always)] // Called for every sample: otherwise the ray is passed in memory.
    pub fn at<const SPECTRAL: bool>(
        &self,
        painter: &Painter<'_>,
        frame: &PictureRays,
        (ray, n_samples): (&RestRay, u32),
        key: f64,
    ) -> (Swatch, DVec3) {
        let spot = (!self.triangles.is_empty()).then(|| self.spot(ray.rest));
        let mixed = spot.filter(|_| self.has_colors);
        let [texel, emitted] = match self.picture {
            Some(_) => self.pictures(painter, frame, (ray.rest, n_samples), spot),
            None => [None; 2],
        };
        let color = match &texel {
            Some(texel) => Some(texel.swatch),
            None => mixed.map(|(triangle, weights)| triangle.color(weights)),
        };
        let rows = || {
            let of_corners = |(it, weights): (&Triangle, [f64; 3])| {
                let [a, b, c] = std::array::from_fn(|at| (it.rows[at], weights[at]));
                [a, b, c, (0, 0.0)]
            };
            texel.map(|texel| texel.rows).or_else(|| mixed.map(of_corners))
        };
        let mut seen = self.shaded::<SPECTRAL>(painter, (color, rows), ray.stretch, || {
            let place = || frame.scene_from_aligned * (ray.rest * (1.0 / key));
            let normal = match spot {
                Some((triangle, weights)) if self.has_normals => {
                    mean(weights, triangle.normals).normalize_or_zero()
                }
                _ => self.normal,
            };
            [if self.needs_place { place() } else { DVec3::ZERO }, normal, frame.lamp_shift]
        });
        if let Some(emitted) = emitted {
            seen = with_emitted(painter, seen, ray.stretch, &emitted);
        }
        seen
    }

    /// The colour of a texture where a ray meets the face, and the colour that it emits.
    #[inline(never)] // Keeps the code of other faces small.
    fn pictures(
        &self,
        painter: &Painter<'_>,
        frame: &PictureRays,
        (ray, n_samples): (DVec3, u32),
        spot: Option<(&Triangle, [f64; 3])>,
    ) -> [Option<SurfaceColor>; 2] {
        let Painter { scene, appearance, textures, .. } = painter;
        let steps = || spot.map_or([[0.0; 2]; 2], |spot| steps(frame, (ray, n_samples), spot.0));
        let at = spot.map(|(triangle, weights)| (triangle.corners, weights));
        textures.colors((scene, appearance), self.picture, at, !frame.velocity.is_zero(), steps)
    }

    /// Apparent colour and light level of a point of the face. `mixed`: its colour at rest, if the
    /// colours of corners differ, and the rows of their spectra with weights. `stretch`: 1/D.
    /// `lit`: position, normal and shift of lamps, see [`uglight::Lighting::level`].
    #[inline(always)] // As `at`.
    pub fn shaded<const SPECTRAL: bool>(
        &self,
        painter: &Painter<'_>,
        (mixed, rows): (Option<Swatch>, impl Fn() -> Option<SpectralRows>),
        stretch: f64,
        lit: impl Fn() -> [DVec3; 3],
    ) -> (Swatch, DVec3) {
        let appearance = painter.appearance;
        let rest = mixed.unwrap_or(self.color);
        let rows = || rows().unwrap_or_else(|| SurfaceColor::even(rest, self.row).rows);
        if self.is_lit_by_color {
            return (
                lit_by_color(painter, SurfaceColor { swatch: rest, rows: rows() }, stretch, lit()),
                DVec3::ONE,
            );
        }
        let color = if SPECTRAL {
            // Between corners, the apparent colours of spectra are mixed.
            Swatch { form: ColorForm::Light(appearance.seen_light(rows(), stretch)), ..rest }
        } else {
            let has_own = mixed.is_some() && self.has_tints && stretch != 1.0;
            let rest_nm =
                if has_own { appearance.wavelength_nm(rest.tint) } else { self.wavelength_nm };
            appearance.seen(rest, rest_nm, stretch)
        };
        let color = painter.lit_as_written(color);
        let level = self.level.unwrap_or_else(|| {
            let [point, normal, shift] = lit();
            painter.lighting.level(point, normal, shift, self.colors.mixing == Mixing::Light)
        });
        (color, level)
    }

    /// The point of the triangles on a ray. Where rounding places the ray outside all triangles,
    /// the nearest triangle is used.
    #[inline]
    fn spot(&self, ray: DVec3) -> (&Triangle, [f64; 3]) {
        let mut best = (&self.triangles[0], [1.0, 0.0, 0.0]);
        let mut most = f64::NEG_INFINITY;
        for triangle in &self.triangles {
            let weights = triangle.weights(ray);
            let least = weights[0].min(weights[1]).min(weights[2]);
            if least > most {
                (best, most) = ((triangle, weights), least);
            }
            if least >= 0.0 {
                return (triangle, weights);
            }
        }
        let (triangle, weights) = best;
        let weights = weights.map(|weight| weight.max(0.0));
        let sum: f64 = weights.iter().sum();
        (triangle, weights.map(|weight| weight / sum))
    }
}

/// A colour as seen under coloured lamps. `lit`: see [`Look::shaded`].
#[inline(never)] // Keeps the code of other faces small.
fn lit_by_color(
    painter: &Painter<'_>,
    color: SurfaceColor,
    stretch: f64,
    [point, normal, shift]: [DVec3; 3],
) -> Swatch {
    let Some(lamps) = painter.lighting.colored_lamps() else { return color.swatch };
    let light = Lighting::irradiances(lamps, point, normal, shift);
    painter.appearance.seen_lit(&color, stretch, &light, lamps)
}

/// A colour as seen with its level of light, and with light of the colour that the face emits.
#[inline(never)] // Keeps the code of other faces small.
pub fn with_emitted(
    painter: &Painter<'_>,
    (seen, level): (Swatch, DVec3),
    stretch: f64,
    emitted: &SurfaceColor,
) -> (Swatch, DVec3) {
    let appearance = painter.appearance;
    let emitted = appearance.light(emitted, 1.0 / stretch, Illumination::Level(1.0), &[]);
    let form = ColorForm::Light(appearance.drawn_light(&seen, level) + emitted);
    (Swatch { form, ..seen }, DVec3::ONE)
}

/// The changes of the weights of corners from a ray in the middle of samples to the next ones.
fn steps(
    frame: &PictureRays,
    (ray, n_samples): (DVec3, u32),
    triangle: &Triangle,
) -> [[f64; 2]; 2] {
    let [_, second, third] = triangle.weights(ray);
    frame.neighbours(ray, f64::from(n_samples)).map(|ray| {
        let [_, b, c] = triangle.weights(ray);
        [b - second, c - third]
    })
}

/// The triangles of a face. `corners`: colour, row and normal of each corner.
fn triangles(
    painter: &Painter<'_>,
    frame: &PictureRays,
    face: &Face,
    corners: &[(Swatch, u32, DVec3)],
) -> Box<[Triangle]> {
    let vertices = painter.scene.face_corners(face);
    let place = |id: VertexId| frame.aligned_from_scene(painter.appearance.surface.rest(id));
    let triangle = |at: [u32; 3]| {
        let places = at.map(|corner| place(vertices[corner as usize]));
        Triangle::new(
            places,
            at.map(|corner| vertices[corner as usize]),
            at.map(|corner| corners[corner as usize]),
        )
    };
    // A self-intersecting face has no triangulation, so it gets a fan.
    let fan = || (2..vertices.len() as u32).map(|corner| [0, corner - 1, corner]).collect();
    painter.triangles(face).unwrap_or_else(fan).into_iter().map(triangle).collect()
}
