//! The history of a scene: each filter adds a head comment.

use crate::scene::Scene;

/// Appends a head comment with the name, version and command line of a program.
pub fn record(scene: &mut Scene, program: &str, version: &str, command_line: &str) {
    scene.head.push(format!(" {program} {version}: {command_line} "));
}

/// The command lines recorded in a scene, oldest first.
pub fn history(scene: &Scene) -> Vec<&str> {
    scene.head.iter().filter_map(|comment| command_line(comment)).collect()
}

/// `name version: command line`, where the name is one of the family's and the
/// command line begins with it.
fn command_line(comment: &str) -> Option<&str> {
    let (title, command) = comment.trim().split_once(": ")?;
    let (program, version) = title.split_once(' ')?;
    let is_version = version.starts_with(|c: char| c.is_ascii_digit()) && !version.contains(' ');
    let is_ours = program.starts_with("ug") && command.split(' ').next() == Some(program);
    (is_version && is_ours).then_some(command)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn history_is_what_was_recorded() {
        let mut scene = Scene { head: vec![" A licence: free for all ".to_string()], ..Scene::default() };
        record(&mut scene, "uglorentz", "0.1.0", "uglorentz -vel .9 0 0");
        record(&mut scene, "ugdoppler", "0.1.0", "ugdoppler");
        assert_eq!(history(&scene), ["uglorentz -vel .9 0 0", "ugdoppler"]);
        assert_eq!(scene.head[0], " A licence: free for all ");
    }
}
