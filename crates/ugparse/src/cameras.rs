//! Selects one of several cameras.

use ugscene::Scene;

use crate::passed_on::{Item, PassedOn};
use crate::suggest::nearest;
use crate::{Diagnostic, Diagnostics, Parsed, Setting, Source, Span};

/// Puts the cameras of a scene in another order. `order`: the old row of each. `spans`: of all.
pub(crate) fn reorder(
    scene: &mut Scene,
    passed_on: &mut PassedOn,
    spans: &mut Vec<Span>,
    order: &[usize],
) {
    scene.cameras = order.iter().map(|&row| scene.cameras[row].clone()).collect();
    *spans = order.iter().map(|&row| spans[row]).collect();
    for comment in &mut passed_on.comments {
        if let Item::Camera(row) = &mut comment.at {
            let new = order.iter().position(|&old| old == *row as usize);
            *row = new.map_or(*row, |new| new as u32);
        }
    }
}

impl Parsed {
    /// Selects the first camera of this name (`-cam`), also for programs downstream: removes its
    /// name, and moves it before others without one.
    ///
    /// # Errors
    /// No camera has this name.
    pub fn choose_camera(&mut self, source: &Source, name: &str) -> Result<(), Diagnostics> {
        let names =
            self.scene.cameras.iter().map(|camera| camera.name.map(|id| self.scene.names.get(id)));
        let names: Vec<Option<&str>> = names.collect();
        let Some(chosen) = names.iter().position(|&other| other == Some(name)) else {
            return Err(Diagnostics::one(source, self.no_camera(name, &names)));
        };
        self.scene.cameras[chosen].name = None;
        let first = self.scene.camera_row().unwrap_or(chosen);
        let mut order: Vec<usize> = (0..self.scene.cameras.len()).collect();
        order[first..=chosen].rotate_right(1);
        reorder(&mut self.scene, &mut self.passed_on, &mut self.origins.cameras, &order);
        Ok(())
    }

    fn no_camera(&self, name: &str, names: &[Option<&str>]) -> Diagnostic {
        let known: Vec<&str> = names.iter().copied().flatten().collect();
        let span = self.origins.cameras.first().copied().unwrap_or_default();
        let finding = Diagnostic::error(span, format!("no camera is called `{name}`"));
        match (nearest(name.as_bytes(), known.iter().map(|known| known.as_bytes())), &known[..]) {
            (Some(near), _) => finding.help(format!("did you mean `{near}`?")),
            (None, []) => finding
                .help("no camera has a name: name one, as in `cam side -ep 0 -9 2;`")
                .setting(Setting::NoCamera),
            (None, known) => finding.help(format!("cameras are `{}`", known.join("`, `"))),
        }
    }
}
