//! Text beside the statements of a scene: comments, history, statements for other programs.

#[cfg(doc)]
use crate::Scene;

/// Comments, history and statements that programs pass on and that change no picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remarks {
    /// Comments before the first statement (licence, history), without their outer braces. They
    /// come first in the output.
    pub head: Vec<String>,
    /// The hash and the name of the input of a scene without a history, see
    /// [`Remarks::record`].
    pub origin: Option<String>,
    /// All other comments, sorted by statement.
    pub comments: Vec<Comment>,
    /// Text for other programs: escapes `( … )` with their parentheses, and unknown statements, if
    /// they are accepted, with their `;`.
    pub passed_on: Vec<String>,
}

impl Remarks {
    /// Moves comments of faces that were cut: one above a face goes to the first piece, one behind
    /// it to the last. `first_pieces`: of each face before the cut, its first row; then the number
    /// of rows.
    pub fn follow_pieces(&mut self, first_pieces: &[u32]) {
        for comment in &mut self.comments {
            if let Item::Face(row) = &mut comment.at {
                let at = *row as usize;
                *row = if comment.trailing { first_pieces[at + 1] - 1 } else { first_pieces[at] };
            }
        }
    }
}

/// A comment inside the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Comment {
    /// Text without the outer braces.
    pub text: String,
    /// The statement to which it belongs.
    pub at: Item,
    /// True if it follows `at` on the same line, false if it is above it.
    pub trailing: bool,
}

/// A statement of a flat scene, by table and row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Item {
    /// [`Scene::stage`].
    Stage,
    /// Row of [`Remarks::passed_on`].
    PassedOn(u32),
    /// Row of [`Scene::colors`].
    Color(u32),
    /// Row of [`Scene::mixes`].
    Mix(u32),
    /// Row of [`Scene::textures`].
    Texture(u32),
    /// Row of [`Scene::emissions`].
    Emission(u32),
    /// Row of [`Scene::surfaces`].
    Surface(u32),
    /// Row of [`Scene::bodies`], of a body whose motion has a statement.
    Motion(u32),
    /// Row of [`Scene::vertices`].
    Vertex(u32),
    /// Row of [`Scene::faces`].
    Face(u32),
    /// Row of [`Scene::wires`].
    Wire(u32),
    /// Row of [`Scene::lights`].
    Light(u32),
    /// Row of [`Scene::cameras`].
    Camera(u32),
    /// After the last statement.
    End,
}
