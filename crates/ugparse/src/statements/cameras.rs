//! `cam`

use ugscene::{Camera, Projection};

use super::grammar::{Grammar, Outcome, Valid};
use super::options::{Argument, OptionForm, OptionTable, option, valid_option};
use crate::row_writer::{RowWriter, WriteRow};
use crate::statement::MotionReference;

pub(super) static OPTIONS: OptionTable<Camera> = OptionTable {
    rows: &[
        option("ep x y z", |camera| &mut camera.eye),
        option("vc x y z", |camera| &mut camera.center),
        valid_option("ud x y z", Valid::Direction, |camera| &mut camera.up),
        option("cl hither yon", |camera| &mut camera.clip),
        option("ph x0 y0 x1 y1", |camera| &mut camera.film),
        option("va a [b]", |camera| &mut camera.view_angle),
        option("fs w h", |camera| &mut camera.film_size),
        option("fl f", |camera| &mut camera.focal_length),
        option("og", |camera| &mut camera.projection),
        option("ps", |camera| &mut camera.projection),
    ],
    expected: "a camera option (-vc -ep -ud -cl -ph -og -ps -va -fs -fl)",
};

impl<'t> Grammar<'t, '_> {
    pub fn camera(&mut self) -> Outcome<'t> {
        let name = self.optional_name()?;
        let mut camera = Camera::default();
        OPTIONS.read(&mut camera, self)?;
        match self.optional_motion()? {
            Some(MotionReference::Frame(frame)) => camera.velocity = Some(frame.velocity),
            Some(MotionReference::Named(name)) => {
                camera.carrier = Some(self.scope.bodies.named(self.text, name));
            }
            None => {}
        }
        camera.name = self.own_name(name);
        self.end_row(|scope| &mut scope.cameras, camera)
    }
}

/// Writes `cam`.
impl WriteRow for Camera {
    fn write(&self, out: &mut RowWriter<'_>) {
        out.begin("cam", self.name);
        OPTIONS.write(self, out);
        if let Some(body) = self.carrier {
            out.motion_name(body);
        } else if let Some(velocity) = self.velocity {
            out.velocity(" <", velocity);
            out.text(">");
        }
    }
}

/// `-og` or `-ps`
impl Argument for Option<Projection> {
    fn read<'t>(&mut self, of: OptionForm, _: &mut Grammar<'t, '_>) -> Outcome<'t> {
        *self = projection(of.form);
        Ok(())
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        if *self == projection(word) {
            out.option(word, &[]);
        }
    }
}

fn projection(word: &str) -> Option<Projection> {
    Some(if word == "og" { Projection::Orthographic } else { Projection::Perspective })
}
