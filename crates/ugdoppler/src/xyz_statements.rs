//! Colour statements with X, Y, Z of spectra as seen (`-sp`).

use rayon::prelude::*;
use rustc_hash::FxHashMap;
use uglight::{SpectralColor, SpectralShift};
use ugphysics::spectrum::DopplerGrid;
use ugphysics::xyz_to_linear_srgb;
use ugscene::{Color, ColorId, ColorMix, ColorValue, Scene, UniqueNames};

use crate::Config;
use crate::notes::Note;
use crate::quantization::DopplerQuantizer;

/// The vertices of a scene, of whose spectra the X, Y, Z are written.
pub(crate) struct SpectralVertices<'a> {
    /// The colours that meet in each.
    pub shares: &'a [ColorMix],
    /// ln D.
    pub ln_factors: Vec<f64>,
    /// True for those of faces and wires.
    pub used: Vec<bool>,
    /// X, Y, Z of those whose colours include light; empty if none does.
    pub lit: Vec<Option<[f64; 3]>>,
}

impl SpectralVertices<'_> {
    /// X, Y, Z of a vertex whose colour includes light.
    fn lit(&self, row: usize) -> Option<[f64; 3]> {
        self.lit.get(row).copied().flatten()
    }

    /// The used vertices whose colours include light, or the others.
    fn rows(&self, is_lit: bool) -> impl Iterator<Item = usize> {
        (0..self.used.len()).filter(move |&row| self.used[row] && self.lit(row).is_some() == is_lit)
    }
}

/// Gives every used vertex the X, Y, Z with which the spectra of its colours are seen. The colours
/// of the scene stay, for lights and for vertices that nothing uses. Returns what to tell the user.
pub(crate) fn write(
    scene: &mut Scene,
    config: &Config,
    shift: SpectralShift,
    vertices: &SpectralVertices<'_>,
) -> Vec<Note> {
    let ln_factors = || vertices.rows(false).map(|row| vertices.ln_factors[row]);
    let grid =
        DopplerGrid::new(ln_factors().fold(0.0, f64::min)..=ln_factors().fold(0.0, f64::max));
    let colors = spectral_colors(scene, vertices, &grid);
    let tolerance = config.bounded_tolerance() / 100.0;
    let quantizer = DopplerQuantizer::new(&grid, colors.iter().flatten(), shift, tolerance);
    let plan = Plan::new(scene, &colors, &quantizer, vertices, tolerance);
    let xyz = |slot: &Slot| match slot.seen {
        Seen::Lit(xyz) => xyz,
        Seen::Shifted(ln_doppler) => {
            let mut sum = [0.0; 3];
            for (color, share) in vertices.shares[slot.vertex].parts() {
                let Some(color) = &colors[row(color)] else { continue };
                let seen = color.seen(&grid, ln_doppler, shift);
                sum.iter_mut().zip(seen).for_each(|(sum, part)| *sum += share * part);
            }
            finite(sum)
        }
    };
    let mut seen: Vec<[f64; 3]> = plan.slots.par_iter().map(xyz).collect();
    let lit = vertices.rows(true).filter_map(|row| vertices.lit(row));
    let largest = brightest(seen.iter().copied().chain(lit));
    let note = expose(&mut seen, largest, config.iris);
    let notes = note.into_iter().chain(changed_note(scene, &colors)).collect();
    push_colors(scene, config, &quantizer, vertices, &plan, &seen);
    notes
}

/// The row of a colour in a table of spectra: white first.
pub(crate) fn row(color: Option<ColorId>) -> usize {
    color.map_or(0, |color| color.index() + 1)
}

/// The spectrum of each used colour; tabulated if more vertices use it than the table has points.
fn spectral_colors(
    scene: &Scene,
    vertices: &SpectralVertices<'_>,
    grid: &DopplerGrid,
) -> Vec<Option<SpectralColor>> {
    let mut n_users = vec![0usize; scene.colors.len() + 1];
    for vertex in vertices.rows(false) {
        vertices.shares[vertex].parts().for_each(|(color, _)| n_users[row(color)] += 1);
    }
    let spectral_color = |(row, &n_users): (usize, &usize)| {
        let color = row.checked_sub(1).map(ColorId::from_index);
        let color = (n_users > 0).then(|| SpectralColor::new(scene, color))?;
        Some(if n_users > grid.n_points() { color.tabulated(grid) } else { color })
    };
    n_users.par_iter().enumerate().map(spectral_color).collect()
}

/// Which vertices share a colour.
struct Plan {
    slots: Vec<Slot>,
    /// The slot of each vertex that gets one.
    of_vertex: Vec<Option<u32>>,
}

/// A colour statement to be written.
struct Slot {
    /// The first vertex that has it.
    vertex: usize,
    seen: Seen,
}

/// How a vertex is seen.
#[derive(Clone, Copy)]
enum Seen {
    /// The spectra of its colours, shifted by this ln D.
    Shifted(f64),
    /// X, Y, Z.
    Lit([f64; 3]),
}

/// Identifies a mixture of colours: each with the bits of its share.
type Mixture = Vec<(Option<ColorId>, u64)>;

impl Plan {
    /// `width`: X, Y, Z with light that differ by a smaller part share a statement.
    fn new(
        scene: &Scene,
        colors: &[Option<SpectralColor>],
        quantizer: &DopplerQuantizer,
        vertices: &SpectralVertices<'_>,
        width: f64,
    ) -> Self {
        let mut plan = Self { slots: Vec::new(), of_vertex: vec![None; scene.vertices.len()] };
        let mut mixtures: FxHashMap<Mixture, usize> = FxHashMap::default();
        let mut made: FxHashMap<[u64; 4], u32> = FxHashMap::default();
        let step = |part: f64| {
            let part = if width > 0.0 { (libm::log(part) / width).round() } else { part };
            part.to_bits()
        };
        for vertex in vertices.rows(false).chain(vertices.rows(true)) {
            let shares = &vertices.shares[vertex];
            let (key, seen) = if let Some(xyz) = vertices.lit(vertex) {
                let [x, y, z] = xyz.map(step);
                ([x, y, z, translucency(scene, shares).to_bits()], Seen::Lit(xyz))
            } else {
                let mixture = match shares {
                    ColorMix::One(color) => row(*color),
                    ColorMix::Mixed(parts) => {
                        let bits =
                            parts.iter().map(|&(color, share)| (color, share.to_bits())).collect();
                        let n_mixtures = mixtures.len();
                        colors.len() + *mixtures.entry(bits).or_insert(n_mixtures)
                    }
                };
                let is_tabulated = shares.parts().all(|(color, _)| {
                    colors[row(color)].as_ref().is_some_and(SpectralColor::is_tabulated)
                });
                let ln = vertices.ln_factors[vertex];
                // Colours of few vertices are computed for each D, without quantization.
                let (step, ln) =
                    if is_tabulated { quantizer.quantized(ln) } else { (ln.to_bits(), ln) };
                // No translucency has these bits.
                ([mixture as u64, step, 0, u64::MAX], Seen::Shifted(ln))
            };
            let next = plan.slots.len() as u32;
            let slot = *made.entry(key).or_insert(next);
            if slot == next {
                plan.slots.push(Slot { vertex, seen });
            }
            plan.of_vertex[vertex] = Some(slot);
        }
        plan
    }
}

/// X, Y, Z that can be written: finite, with the hue that they have, and not below 0.
pub(crate) fn finite(xyz: [f64; 3]) -> [f64; 3] {
    ugphysics::limited(xyz, f64::MAX).map(|part| part.max(0.0))
}

/// The largest channel of linear sRGB.
fn brightest(seen: impl Iterator<Item = [f64; 3]>) -> f64 {
    // The largest X, Y, Z overflow in linear sRGB.
    seen.flat_map(xyz_to_linear_srgb).fold(0.0, f64::max).min(f64::MAX)
}

/// With `iris` scales the largest channel to 1. Returns what to tell the user of values above 1.
fn expose(seen: &mut [[f64; 3]], largest: f64, iris: bool) -> Option<Note> {
    if iris && largest > 0.0 {
        seen.iter_mut().flatten().for_each(|part| *part /= largest);
        return (largest != 1.0).then_some(Note::Scaled(largest));
    }
    // By rounding, white may be slightly above 1.
    (largest > 1.0 + 1e-9).then_some(Note::Kept(largest))
}

fn changed_note(scene: &Scene, colors: &[Option<SpectralColor>]) -> Option<Note> {
    let row =
        colors.iter().position(|color| color.as_ref().is_some_and(|color| !color.is_exact()))?;
    let name = scene.names.get(scene.colors[row.checked_sub(1)?].name);
    Some(Note::TooSaturated { color: name.to_owned() })
}

fn push_colors(
    scene: &mut Scene,
    config: &Config,
    quantizer: &DopplerQuantizer,
    vertices: &SpectralVertices<'_>,
    plan: &Plan,
    seen: &[[f64; 3]],
) {
    let mut names: UniqueNames =
        scene.colors.iter().map(|color| scene.names.get(color.name)).collect();
    names.reserve(seen.len());
    let (mut n_mixed, mut n_lit) = (0, 0);
    let mut ids = Vec::with_capacity(seen.len());
    for (slot, &xyz) in plan.slots.iter().zip(seen) {
        let shares = &vertices.shares[slot.vertex];
        let name = match (slot.seen, shares) {
            (Seen::Lit(_), _) => {
                n_lit += 1;
                format!("lit#{n_lit}")
            }
            (Seen::Shifted(ln_doppler), shares) => {
                if let (false, Some(given)) = (config.iris, unchanged(scene, shares, xyz)) {
                    ids.push(given);
                    continue;
                }
                let seen = |name: &str| quantizer.name_as_seen(name, ln_doppler);
                match shares {
                    ColorMix::One(None) => seen("white"),
                    ColorMix::One(Some(color)) => {
                        seen(scene.names.get(scene.colors[color.index()].name))
                    }
                    ColorMix::Mixed(_) => {
                        n_mixed += 1;
                        seen(&format!("mixed{n_mixed}"))
                    }
                }
            }
        };
        let (name, translucency) = (names.add(name, &mut scene.names), translucency(scene, shares));
        scene.colors.push(Color { name, value: ColorValue::Xyz(xyz), translucency });
        ids.push(ColorId::from_index(scene.colors.len() - 1));
    }
    for (vertex, slot) in scene.vertices.iter_mut().zip(&plan.of_vertex) {
        vertex.color = slot.map(|slot| ids[slot as usize]).or(vertex.color);
    }
}

fn translucency(scene: &Scene, shares: &ColorMix) -> f64 {
    let of = |(color, share): (Option<ColorId>, f64)| {
        color.map_or(0.0, |id| scene.colors[id.index()].translucency) * share
    };
    shares.parts().map(of).sum()
}

/// The given colour, if it is written as X, Y, Z and is seen so.
fn unchanged(scene: &Scene, shares: &ColorMix, seen: [f64; 3]) -> Option<ColorId> {
    /// A spectrum has its colour at rest to 10⁻⁹ of its largest channel.
    const NEAR: f64 = 1e-8;
    let &ColorMix::One(Some(id)) = shares else { return None };
    let ColorValue::Xyz(given) = scene.colors[id.index()].value else { return None };
    let largest = given.iter().fold(0.0, |largest: f64, part| largest.max(part.abs()));
    given.iter().zip(seen).all(|(a, b)| (a - b).abs() <= NEAR * largest).then_some(id)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The brightness of the largest colours is a number.
    #[test]
    fn the_largest_light_is_exposed() {
        let mut seen = [[f64::MAX, 0.0, 0.0], [1.0; 3]];
        assert_eq!(brightest(seen.into_iter()), f64::MAX);
        assert_eq!(expose(&mut seen, f64::MAX, true), Some(Note::Scaled(f64::MAX)));
        assert_eq!(seen[0], [1.0, 0.0, 0.0]);
    }
}
