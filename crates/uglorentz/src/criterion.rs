//! The refinement criterion: which edges have an error above the bound, and whether it is visible.
//!
//! The error of an edge is a function of the edge alone ("the edge bends"). Its visibility depends
//! on the piece it borders: outside the view nothing is visible; inside a face only the component
//! of the depth error normal to the piece is; of a piece that is seen as a line only the outline
//! is. An edge is halved if it bends and this is visible in any of its pieces.

use std::cell::LazyCell;

use glam::DVec3;
use rayon::prelude::*;
use ugscene::{Face, Scene, VertexId, face_edges};

use crate::clocks::Clocks;
use crate::cull::ViewVolume;
use crate::edge::{self, Shown, Tolerance};
use crate::evenness::Evenness;
use crate::near_lamps::NearLamps;
use crate::pieces::{Cut, Polyline, Shape, as_contours, shape};
use crate::refined_mesh::RefinedMesh;
use crate::relative_motion::{Point, RelativeMotion};
use crate::{early_accept, edge_on, interior, world_line};

/// The limit of halvings. Each divides the sagitta by 4, so 12 reduce the largest arc to the
/// default bound; the others are for edges that pass the eye at a millionth of their length.
pub(crate) const MAX_GENERATION: u32 = 32;

/// Error bounds.
#[derive(Clone, Debug)]
pub(crate) struct Bounds {
    /// The tolerance of each body.
    tolerances: Vec<Tolerance>,
    pub near_lamps: NearLamps,
    clocks: Clocks,
    view_volume: ViewVolume,
    /// [`early_accept::most_spread`] of each body.
    spreads: Vec<f64>,
}

impl Bounds {
    /// `tolerances`: of each body.
    pub(crate) fn new(
        tolerances: Vec<Tolerance>,
        (near_lamps, clocks): (NearLamps, Clocks),
        view_volume: ViewVolume,
        motions: &[RelativeMotion],
    ) -> Bounds {
        let of_body = |(motion, tolerance)| early_accept::most_spread(motion, tolerance);
        let spreads = motions.iter().zip(&tolerances).map(of_body).collect();
        Bounds { tolerances, near_lamps, clocks, view_volume, spreads }
    }

    fn tolerance(&self, point: &Point) -> &Tolerance {
        &self.tolerances[point.body.index()]
    }

    /// True only if a flat piece is outside the view.
    pub(crate) fn is_outside(&self, motion: &RelativeMotion, corners: &[&Point]) -> bool {
        self.view_volume.is_outside(motion, corners)
    }

    /// The visible parts of a flat piece and its edges.
    pub(crate) fn shown(&self, motion: &RelativeMotion, corners: &[&Point]) -> Shown {
        if motion.world_line().is_some() {
            return Shown::All;
        }
        let angle = corners.first().map_or(0.0, |corner| 2.0 * self.tolerance(corner).tan_half);
        let is_line = edge_on::is_seen_as_line(motion, corners, angle);
        if is_line { Shown::Outline } else { Shown::OnPiece(edge::slant(corners, motion)) }
    }
}

/// Which parts of a piece to subdivide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Marks {
    /// From each corner to the next.
    pub edges: [bool; 4],
    /// The inside, or a diagonal of the quadrilateral, but no edge.
    pub inside: bool,
}

impl Marks {
    pub(crate) fn any(self) -> bool {
        self.inside || self.any_edge()
    }

    fn any_edge(self) -> bool {
        self.edges.contains(&true)
    }

    /// Upper bound of the number of pieces added by halving these edges.
    pub(crate) fn n_added(self) -> usize {
        let n_edges = self.edges.iter().filter(|&&mark| mark).count();
        if self.any() { n_edges + 1 } else { 0 }
    }
}

/// The result for a piece.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Verdict {
    /// The edges that bend.
    pub bends: [bool; 4],
    /// Edges whose errors are visible in this piece; the inside, if there are none.
    pub shows: Marks,
}

impl Verdict {
    /// Is there anything to subdivide, now or when a neighbour requires it?
    pub(crate) fn is_open(&self) -> bool {
        self.bends.contains(&true) || self.shows.inside
    }
}

/// Evaluates the criterion.
pub(crate) struct Criterion<'a, 'b> {
    pub mesh: &'a RefinedMesh<'b>,
    pub bounds: &'a Bounds,
}

impl Criterion<'_, '_> {
    /// Does this edge bend, or is a vertex of another face on it? The ends are ordered, so that all
    /// pieces that share it get the same
    /// result.
    fn bends(&self, a: u32, b: u32) -> bool {
        self.mesh.has_junction(a, b)
            || self.generation(a, b) < MAX_GENERATION && self.bends_at_any_depth(a, b)
    }

    pub(crate) fn generation(&self, a: u32, b: u32) -> u32 {
        self.mesh.point(a).generation.max(self.mesh.point(b).generation)
    }

    pub(crate) fn bends_at_any_depth(&self, a: u32, b: u32) -> bool {
        let (low, high) = (a.min(b), a.max(b));
        let mesh = self.mesh;
        let (from, to, motion) = (mesh.point(low), mesh.point(high), mesh.motion(low));
        edge::bends(from, to, motion, self.bounds.tolerance(from))
            || self.bounds.near_lamps.is_nonlinear(from, to, motion)
            || self.is_color_off(low, high)
    }

    fn is_color_off(&self, low: u32, high: u32) -> bool {
        let Self { mesh, bounds } = self;
        let Some(tables) = mesh.tables_of([low, high]) else { return false };
        let (ends, motion) = ([low, high].map(|row| mesh.point(row)), mesh.motion(low));
        bounds.clocks.is_off(ends, tables, motion, bounds.tolerance(ends[0]).tan_half)
    }

    /// The largest error of an edge relative to its bound, without light. New edges inside a face
    /// are chosen by it.
    pub(crate) fn excess(&self, a: u32, b: u32) -> f64 {
        let (low, high) = (a.min(b), a.max(b));
        let (from, to, motion) =
            (self.mesh.point(low), self.mesh.point(high), self.mesh.motion(low));
        edge::excess(from, to, motion, self.bounds.tolerance(from))
    }

    /// The faces with edges that bend, in order, as triangles and convex quadrilaterals.
    pub(crate) fn first_cuts(&self, scene: &Scene, evenness: &Evenness) -> Vec<(u32, Cut)> {
        let cut = |(idx, face): (usize, &Face)| {
            Some((idx as u32, self.first_cut(scene, face, evenness)?))
        };
        scene.faces.par_iter().enumerate().filter_map(cut).collect()
    }

    /// Is there a face or wire with edges that bend?
    pub(crate) fn has_cuts(&self, scene: &Scene, evenness: &Evenness) -> bool {
        scene.faces.par_iter().any(|face| self.first_cut(scene, face, evenness).is_some())
            || !self.bent_wires(scene).is_empty()
    }

    /// `None` if the face can stay as it is.
    fn first_cut(&self, scene: &Scene, face: &Face, evenness: &Evenness) -> Option<Cut> {
        let corners = scene.face_corners(face);
        let motion = self.mesh.motion(corners.first()?.0);
        let is_junction = |[a, b]: [VertexId; 2]| self.mesh.has_junction(a.0, b.0);
        let has_junctions =
            !self.mesh.junctions.is_empty() && face_edges(scene, face).any(is_junction);
        if !has_junctions && self.is_right_for_sure(motion, corners.iter().map(|corner| corner.0)) {
            return None;
        }
        let rest = |vertex: VertexId| -> DVec3 { self.mesh.point(vertex.0).rest };
        let is_edge_on =
            motion.world_line().is_none() && edge_on::is_edge_on(scene, face, motion, rest);
        let cut = if is_edge_on {
            Cut::EdgeOn(as_contours(scene, face))
        } else {
            shape(scene, face, evenness.is_even(scene, face), rest)?
        };
        let bends = match &cut {
            Cut::Pieces(shapes) => shapes.iter().any(|shape| self.piece(shape).is_open()),
            Cut::EdgeOn(lines) | Cut::Contours(lines) => {
                lines.iter().any(|line| self.line(line).contains(&true))
            }
        };
        bends.then_some(cut)
    }

    /// True only if the errors on all lines between these corners, and inside, are below the bound.
    fn is_right_for_sure(
        &self,
        motion: &RelativeMotion,
        corners: impl Iterator<Item = u32> + Clone,
    ) -> bool {
        let Bounds { tolerances, near_lamps, clocks, spreads, .. } = self.bounds;
        let points = corners.map(|corner| self.mesh.point(corner));
        let Some(body) = points.clone().next().map(|point| point.body) else { return true };
        if !clocks.are_still(body) {
            return false;
        }
        let body = body.index();
        let tolerance = &tolerances[body];
        let is_shape_right = || match motion.world_line() {
            Some(_) => {
                world_line::is_surely_right(points.clone(), motion, tolerance.on_world_line())
            }
            None => {
                motion.is_at_rest()
                    || early_accept::is_close(points.clone(), spreads[body])
                    || early_accept::is_right(motion, points.clone(), tolerance)
            }
        };
        is_shape_right() && near_lamps.is_surely_linear(motion, points.clone())
    }

    pub(crate) fn bent_wires(&self, scene: &Scene) -> Vec<Polyline> {
        let rows: Vec<u32> = scene.wires.iter().flat_map(|wire| wire.contours.clone()).collect();
        rows.into_par_iter()
            .map(|row| Polyline::open(row, scene.contours.get(row)))
            .filter(|line| self.line(line).contains(&true))
            .collect()
    }

    pub(crate) fn line(&self, line: &Polyline) -> Vec<bool> {
        line.edges().map(|(a, b)| self.bends(a, b)).collect()
    }

    /// The bent and visible parts of a piece.
    pub(crate) fn piece(&self, shape: &Shape) -> Verdict {
        let mut verdict = Verdict::default();
        let motion = self.mesh.motion(shape.corners()[0]);
        let has_junctions = || {
            !self.mesh.junctions.is_empty()
                && shape.edges().any(|(a, b)| self.mesh.has_junction(a, b))
        };
        if self.is_right_for_sure(motion, shape.corners().iter().copied()) && !has_junctions() {
            return verdict;
        }
        for (mark, (a, b)) in verdict.bends.iter_mut().zip(shape.edges()) {
            *mark = self.bends(a, b);
        }
        let corners = shape.corners();
        let points: [&Point; 4] =
            std::array::from_fn(|idx| self.mesh.point(corners[idx.min(corners.len() - 1)]));
        let points = &points[..corners.len()];
        if self.bounds.is_outside(motion, points) {
            return verdict;
        }
        let shown = LazyCell::new(|| self.bounds.shown(motion, points));
        let shown = || *shown;
        let shows = &mut verdict.shows;
        for ((mark, bends), (a, b)) in shows.edges.iter_mut().zip(verdict.bends).zip(shape.edges())
        {
            *mark = bends && self.shows(a, b, shown);
        }
        shows.inside = !shows.any_edge()
            && self.bends_inside(shape, shown)
            && !matches!(shown(), Shown::Outline);
        verdict
    }

    /// Of an edge that bends. `shown`: of the piece, for edges inside a face. Errors of edges of
    /// the scene are always visible: the neighbour may have been modelled with other corners, and
    /// two lines subdivided differently would leave a slit.
    fn shows(&self, a: u32, b: u32, shown: impl Fn() -> Shown) -> bool {
        if self.mesh.is_rim(a, b) {
            return true;
        }
        let (low, high) = (a.min(b), a.max(b));
        let (from, to, motion) =
            (self.mesh.point(low), self.mesh.point(high), self.mesh.motion(low));
        edge::shows(from, to, motion, self.bounds.tolerance(from), shown())
            || self.bounds.near_lamps.is_nonlinear(from, to, motion)
            || self.is_color_off(low, high)
    }

    /// Assumes that no edge bends visibly.
    fn bends_inside(&self, shape: &Shape, shown: impl Fn() -> Shown) -> bool {
        match *shape {
            Shape::Triangle(corners) => self.bulges(corners),
            Shape::Quad([a, b, c, d]) => {
                let bends = |(a, b)| self.bends(a, b) && self.shows(a, b, &shown);
                [(a, c), (b, d)].into_iter().any(bends)
                    || [[a, b, c], [a, c, d], [b, c, d], [b, d, a]]
                        .into_iter()
                        .any(|half| self.bulges(half))
            }
        }
    }

    /// Is the error inside this triangle above the bound?
    fn bulges(&self, corners: [u32; 3]) -> bool {
        let motion = self.mesh.motion(corners[0]);
        let points: [&Point; 3] = corners.map(|corner| self.mesh.point(corner));
        let is_deep = points.iter().any(|point| point.generation >= MAX_GENERATION);
        let offset = || match motion.world_line() {
            Some(_) => world_line::offset_inside(points, motion),
            None => interior::offset(motion, points),
        };
        let tolerance = self.bounds.tolerance(points[0]);
        !is_deep
            && (motion.has_flight_time() && offset() > tolerance.offset
                || self.bounds.near_lamps.jumps_inside(points, motion)
                || self.mesh.tables_of(corners).is_some_and(|tables| {
                    self.bounds.clocks.is_off_inside(points, tables, motion, tolerance.tan_half)
                }))
    }
}
