//! Selects one of several cameras.

use crate::suggest::nearest;
use crate::{Camera, Diagnostic, Diagnostics, Item, Parsed, Scene, Source, Span};

impl Scene {
    /// Row of the selected camera: the first without a name, else the first.
    pub fn camera_row(&self) -> Option<usize> {
        let unnamed = self.cameras.iter().position(|camera| camera.name.is_none());
        unnamed.or((!self.cameras.is_empty()).then_some(0))
    }

    /// The selected camera, see [`Scene::camera_row`].
    pub fn camera(&self) -> Option<&Camera> {
        self.camera_row().map(|row| &self.cameras[row])
    }

    /// Selects the camera of row `chosen`: removes its name, and moves it before others without
    /// one. `spans`: of all cameras.
    fn select_camera(&mut self, chosen: usize, spans: &mut [Span]) {
        self.cameras[chosen].name = None;
        let Some(first) = self.camera_row().filter(|&first| first < chosen) else { return };
        self.cameras[first..=chosen].rotate_right(1);
        spans[first..=chosen].rotate_right(1);
        for comment in &mut self.comments {
            if let Item::Camera(row) = &mut comment.at {
                *row = match *row as usize {
                    old if old == chosen => first as u32,
                    old if (first..chosen).contains(&old) => *row + 1,
                    _ => *row,
                };
            }
        }
        self.comments.sort_by_key(|comment| comment.at);
    }
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
                self.scene.select_camera(row, &mut self.origins.cameras);
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
                .help("no camera has a name: leave out -cam, or name one, as in `cam side -ep 0 -9 2;`"),
            (None, known) => finding.help(format!("cameras are `{}`", known.join("`, `"))),
        }
    }
}
