//! Known causes of pixels that show another face than the oracle sees: edges within their error
//! bound, and slits.

use glam::{DVec2, DVec3};

use crate::agreement::Wrong;
use crate::oracle::{Oracle, Outline, Pinhole};

/// Can edges displaced by `reach` pixels explain the pixel? The shown face and all its occluders,
/// which are nearer by more than the fraction `part` of the distance, have edges that close to the
/// pixel's centre.
pub fn are_edges_near(oracle: &Oracle, camera: &Pinhole, wrong: &Wrong, reach: f64, part: f64) -> bool {
    let spot = Spot::new(oracle, camera, wrong.pixel, reach);
    let Ok(Some(shown)) = wrong.shown else { return false };
    spot.edge(shown).is_some_and(|distance| {
        spot.occluders(Some(shown), distance * (1.0 - part)).into_iter().all(|face| spot.edge(face).is_some())
    })
}

/// Is the shown face, or the background, visible through a slit? All its occluders have edges
/// within `reach` pixels of the pixel's centre, and one of these edges partly coincides with an
/// edge of another face that has other ends, so that two different lines are drawn.
pub fn is_at_slit(oracle: &Oracle, camera: &Pinhole, wrong: &Wrong, reach: f64) -> bool {
    let spot = Spot::new(oracle, camera, wrong.pixel, reach);
    let occluders = match wrong.shown {
        Ok(Some(shown)) => {
            let distance = oracle.distance(shown, spot.direction).or_else(|| spot.edge(shown));
            spot.occluders(Some(shown), distance.unwrap_or(f64::INFINITY))
        }
        Ok(None) => spot.occluders(None, f64::INFINITY),
        Err(_) => return false,
    };
    occluders.iter().all(|&face| spot.edge(face).is_some())
        && occluders.iter().any(|&face| spot.has_slit(face))
}

/// The neighbourhood of a pixel's centre.
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

    /// The edges of a face within reach, occluded ones too.
    fn edges(&self, outline: Outline<'a>) -> impl Iterator<Item = usize> {
        let pixel = move |edge: usize| self.camera.pixel(outline.nearest(edge, self.direction));
        let is_near = move |edge: &usize| pixel(*edge).is_some_and(|p| p.distance(self.center) <= self.reach);
        (0..outline.n_edges()).filter(is_near)
    }

    /// The distance of a face's farthest edge within reach, if there is one.
    fn edge(&self, face: usize) -> Option<f64> {
        let outline = self.oracle.outline(face)?;
        let distance = |edge| outline.nearest(edge, self.direction).length();
        self.edges(outline).map(distance).reduce(f64::max)
    }

    /// The other faces nearer than `distance` at the pixel's centre.
    fn occluders(&self, shown: Option<usize>, distance: f64) -> Vec<usize> {
        let hits = self.oracle.hits(self.direction).into_iter();
        hits.filter(|&(face, at)| Some(face) != shown && at < distance).map(|(face, _)| face).collect()
    }

    /// Does an edge of the face within reach partly coincide with one of another face that has
    /// other ends?
    fn has_slit(&self, face: usize) -> bool {
        let Some(own) = self.oracle.outline(face) else { return false };
        let edges: Vec<usize> = self.edges(own).collect();
        let others = self.oracle.outlines().filter(|&(other, _)| other != face);
        let mut theirs = others.flat_map(|(_, other)| self.edges(other).map(move |edge| (other, edge)));
        theirs.any(|other| edges.iter().any(|&edge| overlap((own, edge), other)))
    }
}

/// Do two edges coincide partly, with different ends?
fn overlap((first, edge): (Outline<'_>, usize), (second, other): (Outline<'_>, usize)) -> bool {
    /// Points closer than this fraction of their distance are the same.
    const SAME: f64 = 1e-9;
    let is_same = |a: DVec3, b: DVec3| (a - b).length() <= SAME * a.length();
    let ([a, b], [c, d]) = (first.ends(edge), second.ends(other));
    let is_shared = (is_same(a, c) && is_same(b, d)) || (is_same(a, d) && is_same(b, c));
    let of_second = [c, d].into_iter().filter(|&end| first.parts(edge, [end; 2]).is_some());
    let of_first = [a, b].into_iter().filter(|&end| second.parts(other, [end; 2]).is_some());
    let common: Vec<DVec3> = of_second.chain(of_first).collect();
    !is_shared && common.iter().any(|&point| !is_same(point, common[0]))
}
