//! Colours as seen by their spectra (`-sp`): every vertex gets X, Y, Z.

use rayon::prelude::*;
use rustc_hash::FxHashMap;
use ugparse::{Color, ColorId, ColorValue, Scene, UniqueNames};
use ugphysics::xyz_to_linear_srgb;
use ugscene::Shares;
use ugspectrum::DopplerGrid;

use crate::Config;
use crate::look::{Look, Motion};
use crate::notes::{kept, scaled};
use crate::ruler::Ruler;

/// Gives every used vertex the colour that the spectra of its colours have under its D, or the one in `lit`. Colours of
/// the scene stay, for lights and for what is not used.
pub(crate) fn paint(
    scene: &mut Scene,
    config: &Config,
    shares: &[Shares],
    factors: &[f64],
    used: &[bool],
    lit: Option<&[Option<[f64; 3]>]>,
) -> Vec<String> {
    let lit = Lit::new(lit.unwrap_or_default(), used);
    let used = &*lit.others;
    let motion = Motion { doppler: config.doppler, flux: config.flux };
    let ln_factors: Vec<f64> = factors.par_iter().map(|&doppler| libm::log(doppler)).collect();
    let grid = DopplerGrid::new(range(&ln_factors, used));
    let looks = looks(scene, shares, used, &grid);
    let tolerance = config.tolerance / 100.0;
    let ruler = Ruler::new(&grid, looks.iter().flatten().filter_map(Look::table), motion, tolerance);

    let plan = Plan::new(scene, &looks, &ruler, shares, &ln_factors, used);
    let mut seen: Vec<[f64; 3]> =
        plan.slots.par_iter().map(|slot| slot.xyz(&looks, &grid, motion, shares)).collect();
    seen.extend(lit.vertices.iter().map(|&(_, xyz)| xyz));
    let notes = expose(&mut seen, config.iris).into_iter().chain(changed_note(scene, &looks)).collect();
    let (unlit, with_light) = seen.split_at(plan.slots.len());
    push_colors(scene, config, &ruler, shares, &plan, unlit);
    lit.push_colors(scene, config, shares, with_light);
    notes
}

/// ln D of the used vertices, from the least to the largest.
fn range(ln_factors: &[f64], used: &[bool]) -> std::ops::RangeInclusive<f64> {
    let used = ln_factors.iter().zip(used).filter(|(_, used)| **used);
    let (least, most) = used.fold((0.0_f64, 0.0_f64), |(low, high), (&ln, _)| (low.min(ln), high.max(ln)));
    least..=most
}

/// The row of a colour in a table of looks: white first.
fn row(color: Option<ColorId>) -> usize {
    color.map_or(0, |color| color.index() + 1)
}

/// The colours that meet at a vertex.
pub(crate) fn parts(shares: &Shares) -> impl Iterator<Item = (Option<ColorId>, f64)> {
    let one = match shares {
        Shares::One(color) => Some((*color, 1.0)),
        Shares::Mixed(_) => None,
    };
    let many = match shares {
        Shares::One(_) => &[][..],
        Shares::Mixed(parts) => parts,
    };
    one.into_iter().chain(many.iter().copied())
}

/// How each used colour looks; tabulated if more vertices ask than the table has points.
fn looks(scene: &Scene, shares: &[Shares], used: &[bool], grid: &DopplerGrid) -> Vec<Option<Look>> {
    let mut n_users = vec![0usize; scene.colors.len() + 1];
    for (shares, _) in shares.iter().zip(used).filter(|(_, used)| **used) {
        parts(shares).for_each(|(color, _)| n_users[row(color)] += 1);
    }
    let look = |(row, &n_users): (usize, &usize)| {
        let color = row.checked_sub(1).map(ColorId::from_index);
        let grid = (n_users > grid.n_points()).then_some(grid);
        (n_users > 0).then(|| Look::new(scene, color, grid))
    };
    n_users.par_iter().enumerate().map(look).collect()
}

/// Which vertices share a colour.
struct Plan {
    slots: Vec<Slot>,
    /// The slot of each vertex that gets one.
    of_vertex: Vec<Option<u32>>,
}

/// A colour to be made.
struct Slot {
    /// The first vertex that has it.
    vertex: usize,
    ln_doppler: f64,
}

/// What tells looks apart: one colour, or the bits of a mixture.
type Mixture = Vec<(Option<ColorId>, u64)>;

impl Plan {
    fn new(
        scene: &Scene,
        looks: &[Option<Look>],
        ruler: &Ruler,
        shares: &[Shares],
        ln_factors: &[f64],
        used: &[bool],
    ) -> Self {
        let mut plan = Self { slots: Vec::new(), of_vertex: vec![None; scene.vertices.len()] };
        let mut mixtures: FxHashMap<Mixture, usize> = FxHashMap::default();
        let mut made: FxHashMap<(usize, u64), u32> = FxHashMap::default();
        for vertex in (0..scene.vertices.len()).filter(|&vertex| used[vertex]) {
            let look = match &shares[vertex] {
                Shares::One(color) => row(*color),
                Shares::Mixed(parts) => {
                    let bits = parts.iter().map(|&(color, share)| (color, share.to_bits())).collect();
                    let n_mixtures = mixtures.len();
                    looks.len() + *mixtures.entry(bits).or_insert(n_mixtures)
                }
            };
            let is_tabulated = parts(&shares[vertex])
                .all(|(color, _)| looks[row(color)].as_ref().is_some_and(|look| look.table().is_some()));
            let ln = ln_factors[vertex];
            // A colour that few vertices have is made for each D as it is.
            let (step, ln_doppler) = if is_tabulated { ruler.rounded(ln) } else { (ln.to_bits(), ln) };
            let next = plan.slots.len() as u32;
            let slot = *made.entry((look, step)).or_insert(next);
            if slot == next {
                plan.slots.push(Slot { vertex, ln_doppler });
            }
            plan.of_vertex[vertex] = Some(slot);
        }
        plan
    }
}

impl Slot {
    /// X, Y, Z: those of the spectra that meet, each by its share.
    fn xyz(&self, looks: &[Option<Look>], grid: &DopplerGrid, motion: Motion, shares: &[Shares]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (color, share) in parts(&shares[self.vertex]) {
            let Some(look) = &looks[row(color)] else { continue };
            let seen = look.seen(grid, self.ln_doppler, motion);
            sum.iter_mut().zip(seen).for_each(|(sum, part)| *sum += share * part);
        }
        // What is too bright for a number stays finite; what is no number is dark.
        sum.map(|part| if part.is_nan() { 0.0 } else { part.clamp(0.0, f64::MAX) })
    }
}

/// The largest channel of linear sRGB, told, and with `iris` brought to 1.
fn expose(seen: &mut [[f64; 3]], iris: bool) -> Option<String> {
    let brightest = |&xyz: &[f64; 3]| xyz_to_linear_srgb(xyz).into_iter().fold(0.0, f64::max);
    let largest = seen.iter().map(brightest).fold(0.0, f64::max);
    if iris && largest > 0.0 && largest.is_finite() {
        seen.iter_mut().flatten().for_each(|part| *part /= largest);
        return (largest != 1.0).then(|| scaled(largest));
    }
    // White comes out a little above 1 by rounding.
    (largest > 1.0 + 1e-9).then(|| kept(largest))
}

fn changed_note(scene: &Scene, looks: &[Option<Look>]) -> Option<String> {
    let row = looks.iter().position(|look| look.as_ref().is_some_and(|look| !look.is_exact()))?;
    let name = scene.names.get(scene.colors[row.checked_sub(1)?].name);
    Some(format!(
        "colour `{name}` is more saturated than a smooth spectrum can be, and is brought toward grey; give it by `c_spd`"
    ))
}

fn push_colors(
    scene: &mut Scene,
    config: &Config,
    ruler: &Ruler,
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
        let base = match shares {
            Shares::One(None) => "white".to_string(),
            Shares::One(Some(color)) => scene.names.get(scene.colors[color.index()].name).to_string(),
            Shares::Mixed(_) => {
                n_mixed += 1;
                format!("mixed{n_mixed}")
            }
        };
        let name = names.fresh(&format!("{base}#{}", ruler.digits(slot.ln_doppler)));
        let translucency = parts(shares)
            .map(|(color, share)| color.map_or(0.0, |id| scene.colors[id.index()].translucency) * share)
            .sum();
        let name = scene.names.add(&name);
        scene.colors.push(Color { name, value: ColorValue::Xyz(xyz), translucency });
        ids.push(ColorId::from_index(scene.colors.len() - 1));
    }
    for (vertex, slot) in scene.vertices.iter_mut().zip(&plan.of_vertex) {
        vertex.color = slot.map(|slot| ids[slot as usize]).or(vertex.color);
    }
}

/// The colour itself, if it is X, Y, Z already and looks as it is written.
fn unchanged(scene: &Scene, shares: &Shares, seen: [f64; 3]) -> Option<ColorId> {
    /// A spectrum has its colour at rest to 10⁻⁹ of its brightest channel.
    const NEAR: f64 = 1e-8;
    let &Shares::One(Some(id)) = shares else { return None };
    let ColorValue::Xyz(given) = scene.colors[id.index()].value else { return None };
    let largest = given.iter().fold(0.0, |largest: f64, part| largest.max(part.abs()));
    given.iter().zip(seen).all(|(a, b)| (a - b).abs() <= NEAR * largest).then_some(id)
}

/// Used vertices that have their light in their colours already.
struct Lit {
    vertices: Vec<(usize, [f64; 3])>,
    /// Used vertices without.
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

    /// `seen`: X, Y, Z as they are to be written. Steps as wide as the tolerance share a colour.
    fn push_colors(&self, scene: &mut Scene, config: &Config, shares: &[Shares], seen: &[[f64; 3]]) {
        let mut names: UniqueNames = scene.colors.iter().map(|color| scene.names.get(color.name)).collect();
        let mut made: FxHashMap<[u64; 4], ColorId> = FxHashMap::default();
        let width = config.tolerance / 100.0;
        let step = |part: f64| {
            let part = if width > 0.0 { (libm::log(part) / width).round() } else { part };
            part.to_bits()
        };
        for (&(row, _), &xyz) in self.vertices.iter().zip(seen) {
            let translucency: f64 = parts(&shares[row])
                .map(|(color, share)| color.map_or(0.0, |id| scene.colors[id.index()].translucency) * share)
                .sum();
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
