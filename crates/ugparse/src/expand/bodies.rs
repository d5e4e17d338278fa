//! The bodies of definitions: frames in frames.

use ugphysics::{InertialFrame, Velocity, WorldLineError};
use ugscene::{BodyId, LightMotion};

use super::Expander;
use super::placement::Inherited;
use crate::scope::Scope;
use crate::source::Span;

impl Expander<'_, '_> {
    /// The bodies in the scene of the bodies of a scope: what is stated in an instance that moves is
    /// stated in the frame of that, and turned with the instance.
    pub(super) fn bodies_in(&mut self, scope: &Scope<'_>, inherited: &Inherited) -> Vec<BodyId> {
        let names = scope.bodies.name_of_each();
        let body = |id: BodyId| {
            if let Some((name, span)) = names[id.index()] {
                let body = self.bodies.named(self.text, span);
                debug_assert_eq!(span.of(self.text), name, "a name is entered with its span");
                return self.named_body_in(body, span, inherited);
            }
            match scope.bodies.bodies.motion(id).inertial_frame() {
                Some(frame) if id != scope.bodies.bodies.unstated() => {
                    let at = inherited.transform.point(frame.at);
                    self.frame_in(InertialFrame { at, ..*frame }, first_use(scope, id), inherited)
                }
                _ => inherited.body.unwrap_or(self.bodies.bodies.unstated()),
            }
        };
        scope.bodies.bodies.ids().map(body).collect()
    }

    /// The body with a velocity that is stated where `inherited` holds. `frame`: its velocity and
    /// displacement are turned here. `span`: the statement, for errors.
    pub(super) fn frame_in(
        &mut self,
        frame: InertialFrame,
        span: Span,
        inherited: &Inherited,
    ) -> BodyId {
        self.check_finite(span, frame.at);
        let frame = self.composed(frame, inherited).unwrap_or_else(|(message, help)| {
            self.fail(span, &message, help);
            InertialFrame::REST
        });
        self.bodies.moving_with(frame)
    }

    /// An error is a message with its remedy.
    fn composed(
        &self,
        frame: InertialFrame,
        inherited: &Inherited,
    ) -> Result<InertialFrame, (String, &'static str)> {
        let too_fast = |error: WorldLineError| {
            (format!("frames on frames move too fast: {error}"), "use smaller velocities")
        };
        let (vector, gamma) = frame.velocity.stated();
        let turned = inherited.transform.turned(vector).ok_or_else(|| {
            let message = "this velocity has no direction where it is placed".to_owned();
            (message, "place it without a scale of 0")
        })?;
        let velocity =
            Velocity::from_stated(turned, gamma).map_err(|error| too_fast(error.into()))?;
        let mut shift = frame.shift;
        shift.x = inherited.transform.direction(shift.x);
        let frame = InertialFrame { velocity, shift, ..frame };
        let Some(carrier) = inherited.body else { return Ok(frame) };
        let carrier = self.bodies.bodies.motion(carrier).inertial_frame().ok_or_else(|| {
            let message = "a velocity is stated on a body that accelerates or turns".to_owned();
            (
                message,
                "give the part a `motion` with `-on`, which makes it a fixed point of that body",
            )
        })?;
        carrier.carrying(&frame).map_err(too_fast)
    }

    /// A body with a name where `inherited` holds: it is one body, wherever its parts are placed, so
    /// an instance that moves otherwise may not contain it.
    pub(super) fn named_body_in(
        &mut self,
        body: BodyId,
        name: Span,
        inherited: &Inherited,
    ) -> BodyId {
        let bodies = &self.bodies.bodies;
        let carriers = |&body: &BodyId| bodies.statement(body).and_then(|motion| motion.body());
        let rides_on =
            |carrier| std::iter::successors(Some(body), carriers).any(|body| body == carrier);
        if inherited.body.is_some_and(|carrier| bodies.is_moving(carrier) && !rides_on(carrier)) {
            let shown = name.lossy(self.text);
            self.fail(
                name,
                &format!("the body of motion `{shown}` is inside an instance that moves otherwise"),
                "state `-on` and the motion of the instance in its `motion`, or place it outside",
            );
        }
        body
    }
}

/// The first statement of a scope that is part of a body.
fn first_use(scope: &Scope<'_>, body: BodyId) -> Span {
    let faces = scope.faces.rows.iter().zip(&scope.faces.spans).find(|(face, _)| face.body == body);
    let wires = scope.wires.rows.iter().zip(&scope.wires.spans).find(|(wire, _)| wire.body == body);
    let is_light = |motion: LightMotion| motion.body() == Some(body);
    let lights =
        scope.lights.rows.iter().zip(&scope.lights.spans).find(|(light, _)| is_light(light.motion));
    let spans = [faces.map(|row| *row.1), wires.map(|row| *row.1), lights.map(|row| *row.1)];
    spans.into_iter().flatten().min().unwrap_or_default()
}
