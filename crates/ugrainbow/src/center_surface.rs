//! The surface that stands for a pixel where there are transparent ones.

use ugpicture::SurfaceSample;
use ugraster::{Center, Fragment, VisibleItem};
use ugscene::View;

use crate::lines::LIFT;

/// The nearest surface that transmits less than half of the light behind it.
pub fn center_surface(view: &View, center: &Center<'_>) -> Option<SurfaceSample> {
    let fragment = center.fragments.iter().rev().find(|fragment| fragment.transmittance < 0.5);
    fragment.map(|fragment| of_fragment(view, fragment)).or(center.opaque.map(of_surface))
}

/// An opaque surface.
pub fn of_surface(VisibleItem { key, item }: VisibleItem) -> SurfaceSample {
    SurfaceSample { key, item }
}

/// A transparent fragment. Lines are drawn nearer to the eye than they are; this is corrected.
pub fn of_fragment(view: &View, layer: &Fragment) -> SurfaceSample {
    let key = match (layer.is_line, view.is_perspective) {
        (false, _) => layer.key,
        (true, true) => layer.key * (1.0 - LIFT) as f32,
        (true, false) => layer.key - (LIFT * view.distance) as f32,
    };
    SurfaceSample { key, item: layer.item }
}
