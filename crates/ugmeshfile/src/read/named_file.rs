//! Files that a mesh names.

use std::io;

use ugpipe::OtherCase;
use ugscene::shorten;

use super::Input;
use crate::textures::{MAX_TEXTURE_BYTES, TextureOrigin};

impl Input<'_> {
    /// Reads a file that the mesh names, perhaps by a path of another machine: then it is searched
    /// for in the folder of the mesh. Returns the name by which it was found as well.
    pub fn read_named(&self, name: &str, limit: u64) -> io::Result<(Vec<u8>, String)> {
        let name = name.trim_matches('"').replace('\\', "/");
        match (self.read_in_any_case(&name, limit), name.rsplit_once('/')) {
            (Err(error), Some((_, last))) => self.read_in_any_case(last, limit).map_err(|_| error),
            (read, _) => read,
        }
    }

    /// Reads a file by a name in which the case of letters may be another one, as written on a
    /// system that ignores it; then there is a note.
    fn read_in_any_case(&self, name: &str, limit: u64) -> io::Result<(Vec<u8>, String)> {
        let error = match (self.read_file)(name, limit) {
            Ok(bytes) => return Ok((bytes, name.to_owned())),
            Err(error) => error,
        };
        let Some(other) = OtherCase::instead_of(name, &error) else { return Err(error) };
        let bytes = (self.read_file)(&other, limit)?;
        let note = format!("`{}` is read in place of `{}`", shorten(&other), shorten(name));
        let mut notes = self.notes.borrow_mut();
        if !notes.contains(&note) {
            notes.push(note);
        }
        Ok((bytes, other))
    }

    /// Reads a picture beside the mesh.
    pub fn read_picture(&self, name: &str) -> Result<(Vec<u8>, TextureOrigin), String> {
        let read = self.read_named(name, MAX_TEXTURE_BYTES);
        read.map(|(bytes, name)| (bytes, TextureOrigin::File(name)))
            .map_err(|error| error.to_string())
    }
}
