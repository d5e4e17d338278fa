//! `sphere`, `cylinder`, `tube` and `disc`.

use glam::{DMat3, DVec3};
use nom::Parser;
use nom::combinator::opt;
use ugscene::{FaceShape, RoundShape};

use super::{Grammar, number, number_from, option_word, zero_vector};
use crate::scope::as_str;
use crate::source::Span;
use crate::statement::Statement;
use crate::token::{Input, Parsed, Reason, blank, fail, point, require};

impl<'t> Grammar<'t, '_> {
    /// `sphere [ID] x y z radius …`, `cylinder [ID] x y z x y z radius …` and `tube` alike,
    /// `disc [ID] x y z nx ny nz radius [-inner radius] …`; or with contours in place of the
    /// numbers
    pub(super) fn round(
        &mut self,
        mut shape: FaceShape,
        input: Input<'t>,
    ) -> Parsed<'t, Statement> {
        let behind_keyword = self.position(input);
        let (input, name) = self.optional_name(input)?;
        let at = blank(input)?.0;
        if at.starts_with(b"(") {
            let (rest, contours) = self.contours(input)?;
            if shape == FaceShape::Disc && contours.len() == 2 {
                shape = FaceShape::Ring;
            }
            let numbers = self.scope.contours.iter(contours.clone()).map(<[_]>::len);
            if !numbers.eq(shape.corners_of_contours().iter().copied()) {
                return fail(
                    at,
                    Reason::Impossible(1, "this is not the number of vertices", CONTOURS),
                );
            }
            return self.behind_shape(rest, name, shape, contours);
        }
        let (input, origin) = require(point(input))?;
        let end = blank(input)?.0;
        let (input, second) = match shape {
            FaceShape::Sphere => (input, DVec3::Z),
            _ => require(point(input))?,
        };
        let radius_at = blank(input)?.0;
        let radius = number_from(f64::MIN_POSITIVE, f64::INFINITY, "a radius is above 0");
        let (mut input, radius) = require(radius(input))?;
        let mut inner = 0.0;
        if shape == FaceShape::Disc
            && let at = blank(input)?.0
            && let (rest, Some(word)) = opt(option_word).parse(input)?
        {
            if word != b"inner" {
                return fail(at, Reason::Expected("`-inner`, a color, `<` or `;`"));
            }
            let radius_at = blank(rest)?.0;
            (input, inner) = require(number(rest))?;
            inner /= radius;
            // NaN fails the comparison.
            if !(0.0 < inner && inner < 1.0) {
                return fail(
                    radius_at,
                    Reason::OutOfRange("an inner radius is above 0 and below the radius"),
                );
            }
            shape = FaceShape::Ring;
        }
        let is_flat = matches!(shape, FaceShape::Disc | FaceShape::Ring);
        let axis = if matches!(shape, FaceShape::Cylinder | FaceShape::Tube) {
            second - origin
        } else {
            second
        };
        let direction = ugphysics::unit_or_zero(axis);
        if axis == DVec3::ZERO {
            return fail(end, if is_flat { zero_vector(3) } else { NO_LENGTH });
        }
        let axes = match shape {
            FaceShape::Sphere => DMat3::from_diagonal(DVec3::splat(radius)),
            _ => {
                let (a, b) = across(direction);
                let along = if is_flat { radius * direction } else { axis };
                DMat3::from_cols(radius * a, radius * b, along)
            }
        };
        let round = RoundShape { shape, origin, axes, inner };
        // Positions are rounded: a shape that is too small far away is lost.
        let placed = RoundShape::from_corners(shape, &round.corners());
        let is_kept = |placed: RoundShape| {
            (placed.stretch() / radius - 1.0).abs() < MOST_ROUNDED
                && (placed.inner - inner).abs() <= MOST_ROUNDED * inner.min(1.0 - inner)
        };
        if !placed.is_some_and(is_kept) {
            return fail(radius_at, OUT_OF_RANGE);
        }
        // As of the name of a vertex, the statement is that around it.
        let place = name.unwrap_or(Span { start: behind_keyword, end: behind_keyword });
        let word = name.map_or(shape.keyword(), |name| as_str(name.of(self.text)));
        let contours = self.scope.push_round(word, place, &round);
        self.behind_shape(input, name, shape, contours)
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
