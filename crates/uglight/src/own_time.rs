//! Colours that change with own time (`c_time`), at one time.

use glam::DVec3;
use ugphysics::Hsv;
use ugscene::{ColorId, Mix, Scene};

use crate::color::{encoded_hsv, shown_light};
use crate::{Appearance, ColorForm, Mixing, RestColor, SurfaceColor, Swatch};

/// The colour of parts with shares that add up to 1, the second of which may have none: the mean of
/// their light.
pub fn mean_color([a, b]: [(RestColor, f64); 2]) -> RestColor {
    if b.1 == 0.0 {
        return a.0;
    }
    let (hsv, form) = mean([a, b].map(|(color, share)| (color.form, color.linear(), share)));
    RestColor { hsv, form, ..a.0 }
}

/// The mean of two tones with their light and shares: light if one of them is, else a hue.
fn mean([a, b]: [(ColorForm, DVec3, f64); 2]) -> (Hsv, ColorForm) {
    let linear = a.2 * a.1 + b.2 * b.1;
    let is_light = a.0.mixing().max(b.0.mixing()) == Mixing::Light;
    (encoded_hsv(linear), if is_light { ColorForm::Light(linear) } else { ColorForm::Hue })
}

/// Gives all colours that change with own time their colour at own time 0, for programs that show
/// no times. Lamps keep their tables.
pub fn freeze_colors_at_zero(scene: &mut Scene) {
    for row in 0..scene.color_tables.len() {
        let table = &scene.color_tables[row];
        let (id, parts) = (table.color, table.at(0.0).parts);
        let color =
            mean_color(parts.map(|(part, share)| (RestColor::new(scene, Some(part)), share)));
        if parts[1].1 == 0.0 {
            scene.colors[id.index()].value = scene.colors[parts[0].0.index()].value;
            continue;
        }
        scene.colors[id.index()].value = color.value();
        let mix = Mix { color: id, parts: parts.to_vec() };
        match scene.mixes.binary_search_by_key(&id, |mix| mix.color) {
            Ok(at) => scene.mixes[at] = mix,
            Err(at) => scene.mixes.insert(at, mix),
        }
    }
}

impl Appearance {
    /// The colour at rest of a face whose colour changes, at an own time; `None` if it does not
    /// change. `is_moving`: see [`Appearance::face_colors_in_motion`].
    pub fn color_at_time(
        &self,
        scene: &Scene,
        color: ColorId,
        own_time: f64,
        is_moving: bool,
    ) -> Option<SurfaceColor> {
        let parts = scene.table_of(color)?.at(own_time).parts;
        let keeps_light = self.keeps_light() || !is_moving;
        let of = |color: ColorId| {
            let swatch = self.palette.get(color);
            // One colour of a display is drawn as a hue.
            let is_light = keeps_light && swatch.form.mixing() == Mixing::Light;
            Swatch { form: if is_light { swatch.form } else { ColorForm::Hue }, ..swatch }
        };
        let [(a, share), (b, rest)] = parts;
        let rows = [(a.index() as u32, share), (b.index() as u32, rest), (0, 0.0), (0, 0.0)];
        let part = |(color, share)| {
            let swatch = of(color);
            let linear =
                swatch.form.light().unwrap_or_else(|| shown_light(self.palette.hsv(&swatch)));
            (swatch.form, linear, share)
        };
        let swatch = if rest == 0.0 {
            of(a)
        } else {
            let (hsv, form) = mean(parts.map(part));
            Swatch { form, translucency: of(a).translucency, ..self.palette.swatch(hsv) }
        };
        Some(SurfaceColor { swatch, rows })
    }
}
