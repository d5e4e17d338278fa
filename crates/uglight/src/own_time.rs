//! Colours that change with own time (`c_time`), at one time.

use glam::DVec3;
use ugscene::{ColorId, Mix, Scene};

use crate::color::encoded_hsv;
use crate::{Appearance, RestColor, SurfaceColor, Swatch};

/// The colour of parts with shares that add up to 1, the second of which may have none: the mean of
/// their light.
#[must_use]
pub fn mean_color([a, b]: [(RestColor, f64); 2]) -> RestColor {
    if b.1 == 0.0 {
        return a.0;
    }
    let linear = a.1 * a.0.linear() + b.1 * b.0.linear();
    let is_light = a.0.light.is_some() || b.0.light.is_some();
    let light = is_light.then(|| linear.to_array());
    RestColor {
        hsv: encoded_hsv(linear.to_array()),
        light,
        is_display: false,
        translucency: a.0.translucency,
    }
}

/// Gives all colours that change with own time their colour at own time 0, for programs that show
/// no times. Lamps keep their tables.
pub fn settle(scene: &mut Scene) {
    for row in 0..scene.color_tables.len() {
        let table = &scene.color_tables[row];
        let (id, parts) = (table.color, table.at(0.0).parts);
        let color = mean_color(parts.map(|(part, share)| (RestColor::new(scene, Some(part)), share)));
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
    /// change. `is_moving`: see [`Appearance::common_in_motion`].
    #[must_use]
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
            let light = swatch.light.filter(|_| keeps_light && !swatch.is_display);
            Swatch { light, ..swatch }
        };
        let [(a, share), (b, rest)] = parts;
        let rows = [(a.index() as u32, share), (b.index() as u32, rest), (a.index() as u32, 0.0)];
        let swatch = if rest == 0.0 { of(a) } else { self.mean_swatch([(of(a), share), (of(b), rest)]) };
        Some(SurfaceColor { swatch, rows })
    }

    /// As [`mean_color`].
    fn mean_swatch(&self, [a, b]: [(Swatch, f64); 2]) -> Swatch {
        let linear = |swatch: Swatch| {
            let shown = || DVec3::from(self.palette.hsv(&swatch).to_rgb().map(ugphysics::srgb_decode));
            swatch.light.unwrap_or_else(shown)
        };
        let mean = a.1 * linear(a.0) + b.1 * linear(b.0);
        let is_light = a.0.light.is_some() || b.0.light.is_some();
        let light = is_light.then_some(mean);
        Swatch { light, translucency: a.0.translucency, ..self.palette.swatch(encoded_hsv(mean.to_array())) }
    }
}
