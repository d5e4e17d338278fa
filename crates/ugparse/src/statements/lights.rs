//! `l`

use glam::DVec3;
use ugscene::{Beam, Light, LightKind, LightMotion};

use super::grammar::{Grammar, Outcome, Valid, refuse};
use super::motions::write_motion_of;
use super::options::{Argument, OptionForm, OptionTable, option, option_word, zero_vector};
use crate::row_writer::{RowWriter, WriteRow};
use crate::token::{Reason, point};

pub(super) static BEAMS: OptionTable<Beam> = OptionTable {
    rows: &[
        option("spot x y z angle edge", |beam| beam),
        option("area ux uy uz vx vy vz", |beam| beam),
    ],
    expected: "`-spot`, `-area`, `<` or `;`",
};

impl<'t> Grammar<'t, '_> {
    pub fn light(&mut self) -> Outcome<'t> {
        let name = self.optional_name()?;
        let intensity = self.number(Valid::not_negative("an intensity is 0 or more"))?;
        let mut kind = self.light_kind()?;
        let color = self.optional_color()?;
        self.beam(&mut kind)?;
        // A lamp with a velocity of its own is at its position at time 0.
        let at = if let LightKind::Local { position, .. } = kind { position } else { DVec3::ZERO };
        let motion = self.optional_motion()?.map(|motion| self.body_with(motion, at));
        let motion = motion.map_or(LightMotion::WithWhatItLights, LightMotion::Body);
        let light = Light { name: self.own_name(name), intensity, kind, color, motion };
        self.end_row(|scope| &mut scope.lights, light)
    }

    /// `[x y z [radius [reference]]]`
    fn light_kind(&mut self) -> Outcome<'t, LightKind> {
        let at = self.rest;
        let Some(vector) = self.optional(point)? else { return Ok(LightKind::Ambient) };
        let radius = self.optional_number(Valid::not_negative("a radius is 0 or more"))?;
        Ok(match radius {
            None if vector == DVec3::ZERO => return refuse(at, zero_vector(3)),
            None => LightKind::Directional(vector),
            Some(radius) => {
                let valid = Valid::positive("a reference distance is above 0");
                let reference = self.optional_number(valid)?;
                LightKind::Local { position: vector, radius, reference, beam: Beam::Even }
            }
        })
    }

    /// Reads the beam of a light, if it has one.
    fn beam(&mut self, kind: &mut LightKind) -> Outcome<'t> {
        let at = self.rest;
        let wrong = |rule| refuse(at, Reason::OutOfRange(rule));
        let (has_place, has_reference) = match kind {
            LightKind::Local { reference, .. } => (true, reference.is_some()),
            _ => (false, false),
        };
        match option_word(at) {
            Ok((_, b"spot")) if !has_place => {
                return wrong("a spot has a position and a radius, such as `l 1  0 0 5 0`");
            }
            Ok((_, b"area")) if !has_reference => {
                return wrong(
                    "an area has a position, a radius and a reference distance, such as `l 1  0 0 5 0 3`",
                );
            }
            _ => {}
        }
        let mut own = Beam::Even;
        BEAMS.read_one(&mut own, self)?;
        if !own.is_valid() {
            return wrong(
                "an axis is not 0, an angle 0 to 180 degrees, an edge 0 to the angle; edges span an area",
            );
        }
        if let LightKind::Local { beam, .. } = kind {
            *beam = own;
        }
        Ok(())
    }
}

/// Writes `l`.
impl WriteRow for Light {
    fn write(&self, out: &mut RowWriter<'_>) {
        out.begin("l", self.name);
        out.number(self.intensity);
        let (mut place, mut beam) = (DVec3::ZERO, Beam::Even);
        match self.kind {
            LightKind::Ambient => {}
            LightKind::Directional(toward) => out.point(toward),
            LightKind::Local { position, radius, reference, beam: own } => {
                (place, beam) = (position, own);
                out.point(position);
                out.number(radius);
                out.numbers(reference.as_slice());
            }
        }
        out.optional_color(self.color);
        BEAMS.write(&beam, out);
        self.motion.body().into_iter().for_each(|body| write_motion_of(body, place, out));
    }
}

impl Argument for Beam {
    fn read<'t>(&mut self, of: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        let (mut vector, mut degrees) = (DVec3::ZERO, [0.0; 2]);
        vector.read(of, grammar)?;
        if of.form.starts_with("spot") {
            degrees.read(of, grammar)?;
            *self = Self::Spot { axis: vector, degrees };
        } else {
            let mut other = vector;
            other.read(of, grammar)?;
            *self = Self::Area([vector, other]);
        }
        Ok(())
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        match (*self, word) {
            (Self::Spot { axis, degrees: [angle, edge] }, "spot") => {
                out.option(word, &[axis.x, axis.y, axis.z, angle, edge]);
            }
            (Self::Area(edges), "area") => {
                out.option(word, edges.map(|edge| edge.to_array()).as_flattened());
            }
            _ => {}
        }
    }
}
