//! Reading for programs that move or draw faces: bent faces become triangles.

use std::ops::Range;

use ugscene::{Face, Item, Scene, VertexId, face_triangles};

use crate::{Diagnostics, Options, Parsed, Source};

/// Reads a scene and cuts bent faces ([`Parsed::bent`]) into their triangles, since their shape
/// would depend on the side they are seen from. The triangles keep all properties of the face,
/// including its name.
///
/// `camera`: the name of the camera to use, see [`Parsed::choose_camera`].
///
/// # Errors
/// See [`crate::parse`] and [`Parsed::choose_camera`].
pub fn read(source: &Source, options: &Options, camera: Option<&str>) -> Result<Parsed, Diagnostics> {
    let mut parsed = crate::parse(source, options)?;
    if let Some(name) = camera {
        parsed.choose_camera(source, name)?;
    }
    let rows: Vec<usize> = parsed.bent.iter().map(|face| face.row).collect();
    if !rows.is_empty() {
        cut_faces(&mut parsed, &rows);
    }
    Ok(parsed)
}

/// Triangulates the faces of these rows, which are in order, where possible.
fn cut_faces(parsed: &mut Parsed, rows: &[usize]) {
    let Parsed { scene, origins, .. } = parsed;
    let faces = std::mem::take(&mut scene.faces);
    let spans = std::mem::take(&mut origins.faces);
    let mut first_pieces = Vec::with_capacity(faces.len());
    for (row, (face, span)) in faces.into_iter().zip(spans).enumerate() {
        first_pieces.push(scene.faces.len() as u32);
        let pieces = if rows.binary_search(&row).is_ok() { triangles(scene, &face) } else { None };
        match pieces {
            Some(pieces) => {
                scene.faces.extend(pieces.map(|contours| Face { contours, ..face.clone() }));
            }
            None => scene.faces.push(face),
        }
        origins.faces.resize(scene.faces.len(), span);
    }
    for comment in &mut scene.remarks.comments {
        if let Item::Face(row) = &mut comment.at {
            // A trailing comment follows the last piece.
            let ahead = if comment.trailing { first_pieces.get(*row as usize + 1) } else { None };
            *row = match ahead {
                Some(next) => next - 1,
                None if comment.trailing => scene.faces.len() as u32 - 1,
                None => first_pieces[*row as usize],
            };
        }
    }
}

/// The triangles of a face, as contours; `None` if it intersects itself.
fn triangles(scene: &mut Scene, face: &Face) -> Option<impl Iterator<Item = Range<u32>> + use<>> {
    let corners: Vec<VertexId> = scene.contours.corners(face.contours.clone()).to_vec();
    let triangles = face_triangles(scene, face, |vertex| scene.vertices[vertex.index()].position)?;
    let cut = triangles.iter().map(|triangle| triangle.map(|corner| corners[corner as usize]));
    let rows = scene.contours.push_all(cut);
    Some(rows.map(|row| row..row + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_text(text: &str) -> Parsed {
        read(&Source::new("t.ug", text), &Options::default(), None).unwrap()
    }

    /// A square of side 1 whose corners are alternately above and below its plane by `d`.
    fn square(d: f64, rest: &str) -> String {
        format!("v a 0 0 {d}; v b 1 0 -{d}; v c 1 1 {d}; v e 0 1 -{d}; {rest}")
    }

    #[test]
    fn bent_faces_become_triangles() {
        let check = |d: f64, n_faces: usize, n_warnings: usize| {
            let parsed = read_text(&square(d, "f (a b c e);"));
            assert_eq!((parsed.scene.faces.len(), parsed.warnings.list.len()), (n_faces, n_warnings), "{d}");
            assert_eq!(parsed.origins.faces.len(), n_faces);
        };
        // Its size is the root of 2, almost.
        check(0.0, 1, 0);
        check(0.99e-6 * 2f64.sqrt(), 1, 0);
        check(1.01e-6 * 2f64.sqrt(), 2, 0);
        check(0.99e-3 * 2f64.sqrt(), 2, 0);
        check(1.01e-3 * 2f64.sqrt(), 2, 1);
    }

    #[test]
    fn triangles_keep_what_the_face_has() {
        let rest = "c red 1 0; surf s 1 0 0;\n{ first } f (a b c);\n{ bent }\nf x (a b c e) red s <.5 0 0>; { behind }\n\
                    { last }\nf (a c e);";
        let parsed = read_text(&square(0.25, rest));
        let out = String::from_utf8(crate::write(&parsed.scene)).unwrap();
        let lines: Vec<&str> = out.lines().skip_while(|line| !line.starts_with("{ first")).collect();
        let [first, f, bent, one, two, last, g] = lines[..] else { panic!("{out}") };
        assert_eq!(
            [first, f, bent, last, g],
            ["{ first }", "f (a b c);", "{ bent }", "{ last }", "f (a c e);"]
        );
        assert!(one.starts_with("f x (") && one.ends_with(") red s <0.5 0 0>;"), "{out}");
        assert!(two.starts_with("f x (") && two.ends_with(") red s <0.5 0 0>; { behind }"), "{out}");
        assert_eq!((one.len() + 11, parsed.origins.faces[1]), (two.len(), parsed.origins.faces[2]));
    }

    #[test]
    fn faces_with_holes_are_cut_and_what_was_seen_stays() {
        let hole = "v h .4 .4 0; v i .6 .4 0; v j .5 .6 0; f (a b c e) (h i j);";
        assert_eq!(read_text(&square(0.25, hole)).scene.faces.len(), 7);
        let seen = format!("(ugstage 1 geometry as-seen eye 0 0 0) {}", square(0.25, "f (a b c e);"));
        let parsed = read_text(&seen);
        assert_eq!((parsed.scene.faces.len(), parsed.warnings.list.len()), (1, 0));
    }
}
