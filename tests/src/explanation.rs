//! What explains a pixel that shows another face than the oracle sees: edges within their bound, and slits.

use glam::{DVec2, DVec3};

use crate::agreement::Wrong;
use crate::oracle::{Oracle, Outline, Pinhole};

/// Would the pixel be right if edges were drawn `reach` pixels aside? The face it shows and all that should hide that,
/// nearer by more than `part` of the distance, have edges so near the pixel's middle.
pub fn are_edges_near(oracle: &Oracle, camera: &Pinhole, wrong: &Wrong, reach: f64, part: f64) -> bool {
    let spot = Spot::new(oracle, camera, wrong.pixel, reach);
    let Ok(Some(shown)) = wrong.shown else { return false };
    spot.edge(shown).is_some_and(|distance| {
        spot.hiding(Some(shown), distance * (1.0 - part)).into_iter().all(|face| spot.edge(face).is_some())
    })
}

/// Is the face that is shown, or nothing, seen through a slit? All that should hide it have edges `reach` pixels from the
/// pixel's middle or less, and one of these runs for a part along an edge of another face with other corners, so that two different
/// lines are drawn.
pub fn is_at_slit(oracle: &Oracle, camera: &Pinhole, wrong: &Wrong, reach: f64) -> bool {
    let spot = Spot::new(oracle, camera, wrong.pixel, reach);
    let hiding = match wrong.shown {
        Ok(Some(shown)) => {
            let distance = oracle.distance(shown, spot.direction).or_else(|| spot.edge(shown));
            spot.hiding(Some(shown), distance.unwrap_or(f64::INFINITY))
        }
        Ok(None) => spot.hiding(None, f64::INFINITY),
        Err(_) => return false,
    };
    hiding.iter().all(|&face| spot.edge(face).is_some()) && hiding.iter().any(|&face| spot.has_slit(face))
}

/// What is around the middle of a pixel.
struct Spot<'a> {
    oracle: &'a Oracle,
    camera: &'a Pinhole,
    center: DVec2,
    direction: DVec3,
    reach: f64,
}

impl<'a> Spot<'a> {
    fn new(oracle: &'a Oracle, camera: &'a Pinhole, pixel: [u32; 2], reach: f64) -> Self {
        let center = DVec2::from_array(pixel.map(f64::from)) + 0.5;
        Spot { oracle, camera, center, direction: camera.direction(center.x, center.y), reach }
    }

    /// The edges of a face within reach, hidden ones too.
    fn edges(&self, outline: Outline<'a>) -> impl Iterator<Item = usize> {
        let pixel = move |edge: usize| self.camera.pixel(outline.nearest(edge, self.direction));
        let is_near = move |edge: &usize| pixel(*edge).is_some_and(|p| p.distance(self.center) <= self.reach);
        (0..outline.n_edges()).filter(is_near)
    }

    /// How far away a face has an edge within reach, if it has one.
    fn edge(&self, face: usize) -> Option<f64> {
        let outline = self.oracle.outline(face)?;
        let distance = |edge| outline.nearest(edge, self.direction).length();
        self.edges(outline).map(distance).reduce(f64::max)
    }

    /// The other faces nearer than `distance` in the middle.
    fn hiding(&self, shown: Option<usize>, distance: f64) -> Vec<usize> {
        let hits = self.oracle.hits(self.direction).into_iter();
        hits.filter(|&(face, at)| Some(face) != shown && at < distance).map(|(face, _)| face).collect()
    }

    /// Does an edge of the face within reach run along one of another face with other ends?
    fn has_slit(&self, face: usize) -> bool {
        let Some(own) = self.oracle.outline(face) else { return false };
        let edges: Vec<usize> = self.edges(own).collect();
        let others = self.oracle.outlines().filter(|&(other, _)| other != face);
        let mut theirs = others.flat_map(|(_, other)| self.edges(other).map(move |edge| (other, edge)));
        theirs.any(|other| edges.iter().any(|&edge| run_apart((own, edge), other)))
    }
}

/// Do two edges run along each other for a part, and do not have the same ends?
fn run_apart((first, edge): (Outline<'_>, usize), (second, other): (Outline<'_>, usize)) -> bool {
    /// Places this part of the distance apart are the same.
    const SAME: f64 = 1e-9;
    let is_same = |a: DVec3, b: DVec3| (a - b).length() <= SAME * a.length();
    let ([a, b], [c, d]) = (first.ends(edge), second.ends(other));
    let is_shared = (is_same(a, c) && is_same(b, d)) || (is_same(a, d) && is_same(b, c));
    let of_second = [c, d].into_iter().filter(|&end| first.parts(edge, [end; 2]).is_some());
    let of_first = [a, b].into_iter().filter(|&end| second.parts(other, [end; 2]).is_some());
    let common: Vec<DVec3> = of_second.chain(of_first).collect();
    !is_shared && common.iter().any(|&place| !is_same(place, common[0]))
}
