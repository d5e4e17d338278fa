//! Writers: one per format, all of which write a [`PolygonMesh`].

mod gltf;
mod gltf_lights;
mod obj;
mod ply;
mod vtp;

use ugscene::Scene;

use crate::polygon_mesh::{PolygonMesh, Polygons};
use crate::{Error, Target};

/// The file content for a scene in a format, and notes. `is_placed`: positions were scaled, moved
/// or turned, so that they are not those seen from the eye of the scene any more.
pub(crate) fn write(
    scene: Scene,
    target: Target,
    is_placed: bool,
) -> Result<(Vec<u8>, Vec<String>), Error> {
    let (polygons, writer): (Polygons, Writer) = match target {
        Target::Ug => return Ok((ugparse::write(&scene), Vec::new())),
        Target::Obj => (Polygons::Simple, |mesh| Ok(obj::write(mesh))),
        Target::Ply { is_ascii: false } => (Polygons::Simple, |mesh| Ok(ply::write(mesh, false))),
        Target::Ply { is_ascii: true } => (Polygons::Simple, |mesh| Ok(ply::write(mesh, true))),
        Target::Vtp if is_placed => (Polygons::Simple, |mesh| Ok(vtp::write(mesh, false))),
        Target::Vtp => (Polygons::Simple, |mesh| Ok(vtp::write(mesh, true))),
        Target::Gltf => (Polygons::Triangles, gltf::write_json),
        Target::Glb => (Polygons::Triangles, gltf::write_glb),
    };
    let mut mesh = PolygonMesh::new(scene, polygons, target.has_camera(), target.has_textures());
    let bytes = writer(&mut mesh)?;
    Ok((bytes, mesh.notes))
}

type Writer = fn(&mut PolygonMesh) -> Result<Vec<u8>, Error>;

/// The lines of the scene's head comments (licence and history).
fn head_lines(scene: &Scene) -> impl Iterator<Item = String> {
    scene
        .head
        .comments
        .iter()
        .flat_map(|comment| comment.lines())
        .map(|line| one_line(line.trim()))
        .filter(|line| !line.is_empty())
}

/// Text that every reader takes for the rest of one line. Some end lines at form feeds or at the
/// separators of Unicode, refuse characters that it leaves undefined, or continue a line at a
/// backslash.
fn one_line(text: &str) -> String {
    let is_plain = |c: char| {
        !c.is_control()
            && !matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}' | '\u{fdd0}'..='\u{fdef}')
            && u32::from(c) & 0xfffe != 0xfffe
    };
    let mut line: String = text.chars().map(|c| if is_plain(c) { c } else { ' ' }).collect();
    line.truncate(line.trim_end().len());
    if line.ends_with('\\') {
        line.push('.');
    }
    line
}
