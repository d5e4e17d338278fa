//! Expands faces, wires, lights and cameras of a definition.

use std::ops::Range;

use glam::DVec3;
use ugscene::{Beam, Camera, Face, Light, LightKind, LightMotion, ShadingId, Wire};

use super::Expander;
use super::cameras::NestedCamera;
use super::placement::Placement;
use crate::diagnostic::Diagnostic;
use crate::resolve::{degeneracy, face_name, is_short, short_wire};
use crate::source::Span;
use crate::statement::Counts;

impl Expander<'_, '_> {
    /// Expands everything except vertices and calls, from `start` up to `end`.
    pub(super) fn rows(&mut self, placement: &Placement<'_>, start: Counts, end: Counts) {
        let scope = placement.scope;
        for row in start.faces..end.faces {
            self.face(placement, row);
        }
        for row in start.wires..end.wires {
            self.wire(placement, row);
        }
        for row in start.lights..end.lights {
            self.light(placement, row);
        }
        for row in start.cameras..end.cameras {
            self.camera(placement, row);
        }
        if placement.first_time {
            let passed_on = start.passed_on..end.passed_on;
            self.origins.passed_on.extend_from_slice(&scope.passed_on.spans[passed_on.clone()]);
            self.passed_on.statements.extend_from_slice(&scope.passed_on.rows[passed_on]);
        }
    }

    fn face(&mut self, placement: &Placement<'_>, row: usize) {
        let Placement { scope, inherited, .. } = placement;
        let (face, span) = (&scope.faces.rows[row], scope.faces.spans[row]);
        let contours =
            self.contours(placement, face.contours.clone(), inherited.transform.mirrored);
        let placed = Face { contours, ..face.clone() };
        // Collapsed by `-sz 0`, too small relative to its distance, or with one vertex by several paths.
        if degeneracy(&self.scene.contours, &self.scene.vertices, &placed).is_some() {
            self.scene.contours.truncate(placed.contours.start as usize);
            let text = self.text;
            self.degenerate.entry(span.start).or_insert_with(|| {
                let shown = face_name(text, span)
                    .unwrap_or(Span { start: span.start, end: span.start + 1 });
                let kind = if face.shape.is_round() { face.shape.keyword() } else { "face" };
                Diagnostic::warning(shown, format!("{kind} has no area where it is placed"))
                    .label("omitted")
                    .help("correct the transformations of its instance")
            });
            return;
        }
        let placed = Face {
            name: self.optional_name(scope, face.name, inherited),
            color: placement.color(face.color, row, |default| default.first_face),
            shading: face
                .shading
                .map(|row| ShadingId::from_index(placement.first_shading + row.index())),
            body: placement.bodies[face.body.index()],
            ..placed
        };
        self.scene.faces.push(placed);
        self.origins.faces.push(span);
    }

    fn wire(&mut self, placement: &Placement<'_>, row: usize) {
        let Placement { scope, inherited, .. } = placement;
        let (wire, span) = (&scope.wires.rows[row], scope.wires.spans[row]);
        // Only wires with vertices by path can be too short here.
        if is_short(&scope.contours, wire) {
            self.degenerate.entry(span.start).or_insert_with(|| short_wire(self.text, span));
            return;
        }
        let placed = Wire {
            name: self.optional_name(scope, wire.name, inherited),
            contours: self.contours(placement, wire.contours.clone(), false),
            color: placement.color(wire.color, row, |default| default.first_wire),
            body: placement.bodies[wire.body.index()],
            text: wire.text.map(|text| self.scene.names.add(scope.names.get(text))),
        };
        self.scene.wires.push(placed);
        self.origins.wires.push(span);
    }

    /// Copies contours; mirroring reverses their direction but keeps the first vertex.
    fn contours(
        &mut self,
        placement: &Placement<'_>,
        rows: Range<u32>,
        reversed: bool,
    ) -> Range<u32> {
        self.scene.contours.push_all(rows.map(|row| {
            let corners = placement.corners(row);
            let len = corners.len();
            (0..len).map(move |idx| {
                let idx = if reversed { (len - idx) % len } else { idx };
                placement.corner(corners.start + idx)
            })
        }))
    }

    fn light(&mut self, placement: &Placement<'_>, row: usize) {
        let Placement { scope, inherited, .. } = placement;
        let (light, span) = (&scope.lights.rows[row], scope.lights.spans[row]);
        let kind = match light.kind {
            LightKind::Ambient => LightKind::Ambient,
            LightKind::Directional(toward) => {
                let toward = inherited.transform.direction(toward);
                self.check_direction(span, toward);
                LightKind::Directional(toward)
            }
            LightKind::Local { position, radius, reference, beam } => {
                let position = inherited.transform.point(position);
                let reference =
                    reference.map(|reference| inherited.transform.mean_length(reference));
                self.check_finite(span, position);
                self.check_finite(span, DVec3::splat(reference.unwrap_or_default()));
                let beam = match beam {
                    Beam::Spot { .. } => beam.turned(|axis| inherited.transform.direction(axis)),
                    _ => beam.turned(|edge| {
                        inherited.transform.point(edge) - inherited.transform.point(DVec3::ZERO)
                    }),
                };
                if !beam.is_valid() {
                    self.check_finite(span, DVec3::NAN);
                }
                LightKind::Local { position, radius, reference, beam }
            }
        };
        let placed = Light {
            name: self.optional_name(scope, light.name, inherited),
            kind,
            motion: match light.motion {
                LightMotion::Body(body) => LightMotion::Body(placement.bodies[body.index()]),
                LightMotion::WithWhatItLights => LightMotion::WithWhatItLights,
            },
            ..light.clone()
        };
        self.scene.lights.push(placed);
        self.origins.lights.push(span);
    }

    fn camera(&mut self, placement: &Placement<'_>, row: usize) {
        let Placement { scope, inherited, .. } = placement;
        let (camera, span) = (&scope.cameras.rows[row], scope.cameras.spans[row]);
        let placed = Camera {
            name: self.optional_name(scope, camera.name, inherited),
            center: camera.center.map(|point| inherited.transform.point(point)),
            eye: camera.eye.map(|point| inherited.transform.point(point)),
            up: camera.up.map(|up| inherited.transform.direction(up)),
            carrier: camera.carrier.map(|body| placement.bodies[body.index()]),
            ..camera.clone()
        };
        for point in [placed.center, placed.eye].into_iter().flatten() {
            self.check_finite(span, point);
        }
        placed.up.into_iter().for_each(|up| self.check_direction(span, up));
        let path = if placed.name.is_none() { inherited.prefix.clone() } else { String::new() };
        self.nested_cameras.push(NestedCamera { row: self.scene.cameras.len(), path });
        self.scene.cameras.push(placed);
        self.origins.cameras.push(span);
    }

    pub(super) fn check_finite(&mut self, span: Span, position: DVec3) {
        if !position.is_finite() {
            self.fail(span, "coordinates overflow when this is placed", "use smaller numbers");
        }
    }

    /// Checks a normal or another direction.
    pub(super) fn check_length(&mut self, span: Span, direction: DVec3) {
        if !direction.is_finite() {
            let help = "make it shorter; its length has no meaning";
            self.fail(span, "this normal or direction becomes too long when it is placed", help);
        }
    }

    fn check_direction(&mut self, span: Span, direction: DVec3) {
        self.check_length(span, direction);
        if direction == DVec3::ZERO {
            self.error.get_or_insert_with(|| {
                Diagnostic::error(span, "this direction becomes zero when it is placed")
                    .label("is zero there")
                    .help("place it without a scale of 0")
            });
        }
    }

    pub(super) fn fail(&mut self, span: Span, message: &str, help: &str) {
        self.error.get_or_insert_with(|| Diagnostic::here(span, message, help));
    }
}
