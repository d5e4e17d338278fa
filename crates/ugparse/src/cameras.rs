//! Selects one of several cameras.

use ugscene::{Item, Scene};

use crate::suggest::nearest;
use crate::{Diagnostic, Diagnostics, Parsed, Setting, Source, Span};

/// Selects the camera of row `chosen`: removes its name, and moves it before others without
/// one. `spans`: of all cameras.
fn select_camera(scene: &mut Scene, chosen: usize, spans: &mut [Span]) {
    scene.cameras[chosen].name = None;
    let Some(first) = scene.camera_row().filter(|&first| first < chosen) else { return };
    scene.cameras[first..=chosen].rotate_right(1);
    spans[first..=chosen].rotate_right(1);
    for comment in &mut scene.remarks.comments {
        if let Item::Camera(row) = &mut comment.at {
            *row = match *row as usize {
                old if old == chosen => first as u32,
                old if (first..chosen).contains(&old) => *row + 1,
                _ => *row,
            };
        }
    }
    scene.remarks.comments.sort_by_key(|comment| comment.at);
}

impl Parsed {
    /// Selects the first camera of this name (`-cam`), also for programs downstream: removes its
    /// name, and moves it before others without one.
    ///
    /// # Errors
    /// No camera has this name.
    pub fn choose_camera(&mut self, source: &Source, name: &str) -> Result<(), Diagnostics> {
        let names = self.scene.cameras.iter().map(|camera| camera.name.map(|id| self.scene.names.get(id)));
        let names: Vec<Option<&str>> = names.collect();
        match names.iter().position(|&other| other == Some(name)) {
            Some(row) => {
                select_camera(&mut self.scene, row, &mut self.origins.cameras);
                Ok(())
            }
            None => Err(Diagnostics::one(source, self.no_camera(name, &names))),
        }
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
