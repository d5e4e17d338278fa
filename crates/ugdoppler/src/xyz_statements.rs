//! Colour statements with X, Y, Z of spectra as seen (`-sp`).

use rayon::prelude::*;
use rustc_hash::FxHashMap;
use uglight::{SpectralColor, SpectralShift};
use ugphysics::spectrum::DopplerGrid;
use ugphysics::xyz_to_linear_srgb;
use ugscene::{Color, ColorId, ColorValue, Scene, Shares, UniqueNames};

use crate::Config;
use crate::notes::Note;
use crate::quantization::DopplerQuantizer;

/// Gives every used vertex the X, Y, Z with which the spectra of its colours are seen, or those of
/// `lit`. The colours of the scene stay, for lights and for vertices that nothing uses. Returns
/// what to tell the user.
pub(crate) fn write(
    scene: &mut Scene,
    config: &Config,
    shift: SpectralShift,
    shares: &[Shares],
    factors: &[f64],
    used: &[bool],
    lit: Option<&[Option<[f64; 3]>]>,
) -> Vec<Note> {
    let lit = Lit::new(lit.unwrap_or_default(), used);
    let used = &*lit.others;
    let ln_factors: Vec<f64> = factors.par_iter().map(|&doppler| libm::log(doppler)).collect();
    let grid = DopplerGrid::new(range(&ln_factors, used));
    let colors = spectral_colors(scene, shares, used, &grid);
    let tolerance = config.bounded_tolerance() / 100.0;
    let tables = colors.iter().flatten().filter_map(SpectralColor::table);
    let quantizer = DopplerQuantizer::new(&grid, tables, shift, tolerance);

    let plan = Plan::new(scene, &colors, &quantizer, shares, &ln_factors, used);
    let mut seen: Vec<[f64; 3]> =
        plan.slots.par_iter().map(|slot| slot.xyz(&colors, &grid, shift, shares)).collect();
    seen.extend(lit.vertices.iter().map(|&(_, xyz)| xyz));
    let notes = expose(&mut seen, config.iris).into_iter().chain(changed_note(scene, &colors)).collect();
    let (unlit, with_light) = seen.split_at(plan.slots.len());
    push_colors(scene, config, &quantizer, shares, &plan, unlit);
    lit.push_colors(scene, config, shares, with_light);
    notes
}

/// The range of ln D of the used vertices, and 0.
fn range(ln_factors: &[f64], used: &[bool]) -> std::ops::RangeInclusive<f64> {
    let used = ln_factors.iter().zip(used).filter(|(_, used)| **used);
    let (least, most) = used.fold((0.0_f64, 0.0_f64), |(low, high), (&ln, _)| (low.min(ln), high.max(ln)));
    least..=most
}

/// The row of a colour in a table of spectra: white first.
pub(crate) fn row(color: Option<ColorId>) -> usize {
    color.map_or(0, |color| color.index() + 1)
}

/// The spectrum of each used colour; tabulated if more vertices use it than the table has points.
fn spectral_colors(
    scene: &Scene,
    shares: &[Shares],
    used: &[bool],
    grid: &DopplerGrid,
) -> Vec<Option<SpectralColor>> {
    let mut n_users = vec![0usize; scene.colors.len() + 1];
    for (shares, _) in shares.iter().zip(used).filter(|(_, used)| **used) {
        shares.parts().for_each(|(color, _)| n_users[row(color)] += 1);
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
    ln_doppler: f64,
}

/// Identifies a mixture of colours: each with the bits of its share.
type Mixture = Vec<(Option<ColorId>, u64)>;

impl Plan {
    fn new(
        scene: &Scene,
        colors: &[Option<SpectralColor>],
        quantizer: &DopplerQuantizer,
        shares: &[Shares],
        ln_factors: &[f64],
        used: &[bool],
    ) -> Self {
        let mut plan = Self { slots: Vec::new(), of_vertex: vec![None; scene.vertices.len()] };
        let mut mixtures: FxHashMap<Mixture, usize> = FxHashMap::default();
        let mut made: FxHashMap<(usize, u64), u32> = FxHashMap::default();
        for vertex in (0..scene.vertices.len()).filter(|&vertex| used[vertex]) {
            let mixture = match &shares[vertex] {
                Shares::One(color) => row(*color),
                Shares::Mixed(parts) => {
                    let bits = parts.iter().map(|&(color, share)| (color, share.to_bits())).collect();
                    let n_mixtures = mixtures.len();
                    colors.len() + *mixtures.entry(bits).or_insert(n_mixtures)
                }
            };
            let is_tabulated = shares[vertex]
                .parts()
                .all(|(color, _)| colors[row(color)].as_ref().is_some_and(|color| color.table().is_some()));
            let ln = ln_factors[vertex];
            // Colours of few vertices are computed for each D, without quantization.
            let (step, ln_doppler) = if is_tabulated { quantizer.quantized(ln) } else { (ln.to_bits(), ln) };
            let next = plan.slots.len() as u32;
            let slot = *made.entry((mixture, step)).or_insert(next);
            if slot == next {
                plan.slots.push(Slot { vertex, ln_doppler });
            }
            plan.of_vertex[vertex] = Some(slot);
        }
        plan
    }
}

impl Slot {
    /// X, Y, Z of the spectra that meet at the vertex, each by its share.
    fn xyz(
        &self,
        colors: &[Option<SpectralColor>],
        grid: &DopplerGrid,
        shift: SpectralShift,
        shares: &[Shares],
    ) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (color, share) in shares[self.vertex].parts() {
            let Some(color) = &colors[row(color)] else { continue };
            let seen = color.seen(grid, self.ln_doppler, shift);
            sum.iter_mut().zip(seen).for_each(|(sum, part)| *sum += share * part);
        }
        finite(sum)
    }
}

/// X, Y, Z that can be written: finite, with the hue that they have, and not below 0.
pub(crate) fn finite(xyz: [f64; 3]) -> [f64; 3] {
    ugphysics::limited(xyz, f64::MAX).map(|part| part.max(0.0))
}

/// With `iris` scales the largest channel of linear sRGB to 1. Returns what to tell the user of
/// values above 1.
fn expose(seen: &mut [[f64; 3]], iris: bool) -> Option<Note> {
    let brightest = |&xyz: &[f64; 3]| xyz_to_linear_srgb(xyz).into_iter().fold(0.0, f64::max);
    // The largest X, Y, Z overflow in linear sRGB.
    let largest = seen.iter().map(brightest).fold(0.0, f64::max).min(f64::MAX);
    if iris && largest > 0.0 {
        seen.iter_mut().flatten().for_each(|part| *part /= largest);
        return (largest != 1.0).then_some(Note::Scaled(largest));
    }
    // By rounding, white may be slightly above 1.
    (largest > 1.0 + 1e-9).then_some(Note::Kept(largest))
}

fn changed_note(scene: &Scene, colors: &[Option<SpectralColor>]) -> Option<Note> {
    let row = colors.iter().position(|color| color.as_ref().is_some_and(|color| !color.is_exact()))?;
    let name = scene.names.get(scene.colors[row.checked_sub(1)?].name);
    Some(Note::TooSaturated { color: name.to_owned() })
}

fn push_colors(
    scene: &mut Scene,
    config: &Config,
    quantizer: &DopplerQuantizer,
    shares: &[Shares],
    plan: &Plan,
    seen: &[[f64; 3]],
) {
    let mut names: UniqueNames = scene.colors.iter().map(|color| scene.names.get(color.name)).collect();
    let mut n_mixed = 0;
    let mut ids = Vec::with_capacity(seen.len());
    for (slot, &xyz) in plan.slots.iter().zip(seen) {
        let shares = &shares[slot.vertex];
        if let (false, Some(given)) = (config.iris, unchanged(scene, shares, xyz)) {
            ids.push(given);
            continue;
        }
        let digits = quantizer.digits(slot.ln_doppler);
        let name = match shares {
            Shares::One(None) => format!("white#{digits}"),
            Shares::One(Some(color)) => {
                [scene.names.get(scene.colors[color.index()].name), "#", &digits].concat()
            }
            Shares::Mixed(_) => {
                n_mixed += 1;
                format!("mixed{n_mixed}#{digits}")
            }
        };
        let name = names.fresh(&name);
        let translucency = translucency(scene, shares);
        let name = scene.names.add(&name);
        scene.colors.push(Color { name, value: ColorValue::Xyz(xyz), translucency });
        ids.push(ColorId::from_index(scene.colors.len() - 1));
    }
    for (vertex, slot) in scene.vertices.iter_mut().zip(&plan.of_vertex) {
        vertex.color = slot.map(|slot| ids[slot as usize]).or(vertex.color);
    }
}

fn translucency(scene: &Scene, shares: &Shares) -> f64 {
    let of = |(color, share): (Option<ColorId>, f64)| {
        color.map_or(0.0, |id| scene.colors[id.index()].translucency) * share
    };
    shares.parts().map(of).sum()
}

/// The given colour, if it is written as X, Y, Z and is seen so.
fn unchanged(scene: &Scene, shares: &Shares, seen: [f64; 3]) -> Option<ColorId> {
    /// A spectrum has its colour at rest to 10⁻⁹ of its largest channel.
    const NEAR: f64 = 1e-8;
    let &Shares::One(Some(id)) = shares else { return None };
    let ColorValue::Xyz(given) = scene.colors[id.index()].value else { return None };
    let largest = given.iter().fold(0.0, |largest: f64, part| largest.max(part.abs()));
    given.iter().zip(seen).all(|(a, b)| (a - b).abs() <= NEAR * largest).then_some(id)
}

/// Used vertices whose colours include light.
struct Lit {
    vertices: Vec<(usize, [f64; 3])>,
    /// True for the other used vertices.
    others: Vec<bool>,
}

impl Lit {
    fn new(lit: &[Option<[f64; 3]>], used: &[bool]) -> Self {
        let mut others = used.to_vec();
        let mut vertices = Vec::new();
        for (row, xyz) in lit.iter().enumerate() {
            if let (true, Some(xyz)) = (used[row], *xyz) {
                vertices.push((row, xyz));
                others[row] = false;
            }
        }
        Self { vertices, others }
    }

    /// `seen`: X, Y, Z to be written. Those that differ by less than the tolerance share a
    /// statement.
    fn push_colors(&self, scene: &mut Scene, config: &Config, shares: &[Shares], seen: &[[f64; 3]]) {
        let mut names: UniqueNames = scene.colors.iter().map(|color| scene.names.get(color.name)).collect();
        let mut made: FxHashMap<[u64; 4], ColorId> = FxHashMap::default();
        let width = config.bounded_tolerance() / 100.0;
        let step = |part: f64| {
            let part = if width > 0.0 { (libm::log(part) / width).round() } else { part };
            part.to_bits()
        };
        for (&(row, _), &xyz) in self.vertices.iter().zip(seen) {
            let translucency = translucency(scene, &shares[row]);
            let [x, y, z] = xyz.map(step);
            let n_made = made.len();
            let id = *made.entry([x, y, z, translucency.to_bits()]).or_insert_with(|| {
                let name = scene.names.add(&names.fresh(&format!("lit#{}", n_made + 1)));
                scene.colors.push(Color { name, value: ColorValue::Xyz(xyz), translucency });
                ColorId::from_index(scene.colors.len() - 1)
            });
            scene.vertices[row].color = Some(id);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The brightness of the largest colours is a number.
    #[test]
    fn the_largest_light_is_exposed() {
        let mut seen = [[f64::MAX, 0.0, 0.0], [1.0; 3]];
        assert_eq!(expose(&mut seen, false), Some(Note::Kept(f64::MAX)));
        assert_eq!(expose(&mut seen, true), Some(Note::Scaled(f64::MAX)));
        assert_eq!(seen[0], [1.0, 0.0, 0.0]);
    }
}
