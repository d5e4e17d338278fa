//! An explanation as text.

use ugpicture::explain::text::{ExplanationText, described, level, number, numbers};
use ugpicture::explain::{Explanation, WriteSample};

use super::{ExplainedCorner, RasterSample};

/// Corners listed; a face may have thousands.
const MAX_CORNERS: usize = 8;

impl WriteSample for RasterSample {
    fn write(&self, out: &mut ExplanationText, explanation: &Explanation<Self>) {
        let surface = &self.surface;
        out.surface(surface, explanation.is_at_rest);
        out.doppler(surface.doppler, "P10", explanation.colors.as_ref());
        out.assumed(surface.assumed.as_ref());
        out.rows("corner", &self.corners, MAX_CORNERS, corner_text);
        if let Some(color) = &surface.color {
            out.color(color);
        }
        out.row("light", format!("{} linear", numbers(&surface.linear)));
        if let Some(cue) = self.depth_cue {
            out.row("depth cueing", format!("leaves {} of it", number(cue)));
        }
        for (idx, layer) in self.layers.iter().enumerate() {
            let (pass, light) = (number(layer.translucency), numbers(&layer.linear));
            let title = if idx == 0 { "layers" } else { "behind it" };
            out.row(
                title,
                format!("{}: translucency {pass}, light {light}", described(&layer.item)),
            );
        }
    }
}

fn corner_text(corner: &ExplainedCorner) -> String {
    let color = match (corner.linear, corner.hue_saturation_value) {
        (Some(light), _) => format!("linear {}", numbers(&light)),
        (_, hsv) => {
            let [hue, saturation, value] = hsv.unwrap_or_default().map(number);
            format!("hue {hue}, saturation {saturation}, value {value}")
        }
    };
    let mut text =
        format!("`{}` {color}; light level {}", corner.vertex, level(&corner.light_level));
    if corner.lights.len() > 1 {
        let parts: Vec<String> = corner
            .lights
            .iter()
            .map(|part| format!("{} {}", level(&part.level), part.light))
            .collect();
        text += &format!(" = {}", parts.join(" + "));
    }
    text
}
