//! Text beside the statements of a scene, which programs that read and write text pass on.

use std::cell::LazyCell;

use rustc_hash::FxHashMap;
use ugscene::Scene;

/// Comments, and statements for other programs. They change no picture.
#[derive(Clone, Debug, Default)]
pub struct PassedOn {
    /// Comments behind the head of the scene.
    pub comments: Vec<Comment>,
    /// Escapes `( … )` with their parentheses, and unknown statements, if they are accepted, with
    /// their `;`.
    pub statements: Vec<String>,
}

/// A comment inside the scene.
#[derive(Clone, Debug)]
pub struct Comment {
    /// Text without the outer braces.
    pub text: String,
    /// The statement to which it belongs.
    pub at: Item,
    /// True if it follows `at` on the same line, false if it is above it.
    pub trailing: bool,
}

/// A statement of a scene without instances: its table and its row there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Item {
    /// [`Scene::stage`].
    Stage,
    /// Row of [`PassedOn::statements`].
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
    /// Row of [`Scene::vertices`]; in [`PassedOn`], the index of the name, which vertices keep.
    Vertex(u32),
    /// Row of [`Scene::faces`]; in [`PassedOn`], [`ugscene::Face::row_as_read`].
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

impl PassedOn {
    /// The comments at the rows that their statements have in `scene`, in the order of these.
    /// Comments of vertices and faces that were removed are left out. Those above a face that was
    /// cut are at its first piece, those behind it at the last.
    pub(crate) fn comments_in<'c>(&'c self, scene: &Scene) -> Vec<(Item, &'c Comment)> {
        let vertex_rows = LazyCell::new(|| -> FxHashMap<u32, u32> {
            scene.vertices.iter().map(|vertex| vertex.name.index() as u32).zip(0..).collect()
        });
        let first_piece = |row| scene.faces.partition_point(|face| face.row_as_read < row) as u32;
        let placed = |comment: &'c Comment| {
            let at = match comment.at {
                Item::Vertex(name) => Item::Vertex(*vertex_rows.get(&name)?),
                Item::Face(row) => match first_piece(row)..first_piece(row + 1) {
                    pieces if pieces.is_empty() => return None,
                    pieces => {
                        Item::Face(if comment.trailing { pieces.end - 1 } else { pieces.start })
                    }
                },
                at => at,
            };
            Some((at, comment))
        };
        let mut comments: Vec<_> = self.comments.iter().filter_map(placed).collect();
        comments.sort_by_key(|(at, comment)| (*at, comment.trailing));
        comments
    }
}
