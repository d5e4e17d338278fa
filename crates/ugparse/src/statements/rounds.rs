//! `sphere`, `cylinder`, `tube` and `disc`.

use glam::{DMat3, DVec3};
use ugscene::{FaceShape, RoundShape};

use super::grammar::{Grammar, Outcome, Valid, refuse};
use super::options::{OptionTable, option, option_word, zero_vector};
use crate::scope::as_str;
use crate::source::Span;
use crate::token::{Reason, point};

pub(super) static INNER: OptionTable<f64> = OptionTable {
    rows: &[option("inner radius", |inner| inner)],
    expected: "`-inner`, a color, `<` or `;`",
};

impl<'t> Grammar<'t, '_> {
    /// Numbers, or contours in place of them.
    pub fn round(&mut self, shape: FaceShape) -> Outcome<'t> {
        let behind_keyword = self.position();
        let name = self.optional_name()?;
        if self.at()?.starts_with(b"(") {
            return self.round_of_contours(shape, name);
        }
        let round = self.round_of_numbers(shape)?;
        // As of the name of a vertex, the statement is that around it.
        let place = name.unwrap_or(Span { start: behind_keyword, end: behind_keyword });
        let word = name.map_or(shape.keyword(), |name| as_str(name.of(self.text)));
        let contours = self.scope.push_round(word, place, &round);
        self.behind_shape(name, round.shape, contours)
    }

    fn round_of_contours(&mut self, mut shape: FaceShape, name: Option<Span>) -> Outcome<'t> {
        let at = self.rest;
        let contours = self.contours()?;
        if shape == FaceShape::Disc && contours.len() == 2 {
            shape = FaceShape::Ring;
        }
        let numbers = self.scope.contours.iter(contours.clone()).map(<[_]>::len);
        if !numbers.eq(shape.corners_of_contours().iter().copied()) {
            return refuse(
                at,
                Reason::Impossible(1, "this is not the number of vertices", CONTOURS),
            );
        }
        self.behind_shape(name, shape, contours)
    }

    fn round_of_numbers(&mut self, mut shape: FaceShape) -> Outcome<'t, RoundShape> {
        let origin = self.take(point)?;
        let axis_at = self.rest;
        let (axis, none) = match shape {
            FaceShape::Sphere => (DVec3::Z, NO_LENGTH),
            FaceShape::Disc => (self.take(point)?, zero_vector(3)),
            _ => (self.take(point)? - origin, NO_LENGTH),
        };
        let radius_at = self.rest;
        let radius = self.number(Valid::positive("a radius is above 0"))?;
        let mut inner = 0.0;
        let before = self.rest;
        if shape == FaceShape::Disc && INNER.read_one(&mut inner, self)? {
            shape = FaceShape::Ring;
            inner /= radius;
            // NaN fails the comparison.
            if !(0.0 < inner && inner < 1.0) {
                let rule = "an inner radius is above 0 and below the radius";
                return refuse(option_word(before)?.0, Reason::OutOfRange(rule));
            }
        }
        if axis == DVec3::ZERO {
            return refuse(axis_at, none);
        }
        let round = RoundShape { shape, origin, axes: axes(shape, axis, radius), inner };
        // Positions are rounded: a shape that is too small far away is lost.
        let placed = RoundShape::from_corners(shape, &round.corners());
        let is_kept = |placed: RoundShape| {
            (placed.stretch() / radius - 1.0).abs() < MOST_ROUNDED
                && (placed.inner - inner).abs() <= MOST_ROUNDED * inner.min(1.0 - inner)
        };
        if placed.is_some_and(is_kept) { Ok(round) } else { refuse(radius_at, OUT_OF_RANGE) }
    }
}

/// The axes of a round face. `axis`: from its one end to the other, or the direction of a disc.
fn axes(shape: FaceShape, axis: DVec3, radius: f64) -> DMat3 {
    let direction = ugphysics::unit_or_zero(axis);
    let (a, b) = across(direction);
    match shape {
        FaceShape::Sphere => DMat3::from_diagonal(DVec3::splat(radius)),
        FaceShape::Disc | FaceShape::Ring => {
            DMat3::from_cols(radius * a, radius * b, radius * direction)
        }
        _ => DMat3::from_cols(radius * a, radius * b, axis),
    }
}

/// Rounding may change a radius by this part of it.
const MOST_ROUNDED: f64 = 1e-6;

const CONTOURS: &str = "a sphere has contours of 3 and 3 vertices, a cylinder or tube of 4 and 4, a disc one \
                        of 4, and with a hole another one of 4; or give numbers, such as `sphere ball 0 0 1 0.5 ;`";

const NO_LENGTH: Reason =
    Reason::Impossible(3, "both ends of the axis are the same", "give two different points");

const OUT_OF_RANGE: Reason = Reason::Impossible(
    1,
    "coordinates of this shape are lost in rounding, or too large",
    "use a radius and coordinates of similar size",
);

/// Two unit vectors at right angles to a unit vector and to each other, in axes of the scene if it
/// is along one of them; the three are right-handed.
fn across(direction: DVec3) -> (DVec3, DVec3) {
    let least = direction.abs().min_position();
    let first = DVec3::AXES[least];
    let second = ugphysics::unit_or_zero(direction.cross(first));
    let a = ugphysics::unit_or_zero(second.cross(direction));
    (a, direction.cross(a))
}
