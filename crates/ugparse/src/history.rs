//! The history of a scene: each filter adds a head comment, the first one also the hash and the
//! name of what it read.

use crate::origin::Origin;
use crate::scene::Scene;
use crate::token;

/// The program that made a scene or a picture, and the command that makes it again.
///
/// By default nothing is stated. A library caller states name and version of its own program, and
/// a command only if there is one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Provenance<'s> {
    /// Name of the program.
    pub program: &'s str,
    /// Version of the program.
    pub version: &'s str,
    /// The command line, which begins with the name of the program. Without it nothing is added to a
    /// history.
    pub command: Option<&'s str>,
}

/// Appends a head comment with a command and its program, after one with the
/// [origin](Scene::origin) of a scene without a history.
pub fn record(scene: &mut Scene, provenance: Provenance<'_>) {
    let Provenance { program, version, command: Some(command) } = provenance else { return };
    if let Some(origin) = scene.origin.take()
        && history(scene).is_empty()
    {
        scene.head.push(format!(" {origin} "));
    }
    scene.head.push(format!(" {program} {version}: {command} "));
}

/// The command lines recorded in a scene, oldest first.
pub fn history(scene: &Scene) -> Vec<&str> {
    entries(scene).filter_map(|entry| entry.command).collect()
}

/// The history in one line for a shell, with the input of the first program, and with the hash of
/// that input and the versions of all programs behind it:
///
/// ```text
/// uglorentz ship.ug -vel .9 0 0 | ugrainbow # SHA-256 3b1c… ship.ug; uglorentz 0.1.0, ugrainbow
/// 0.1.0
/// ```
///
/// `last`: the last program of the pipe. `None` if it has no command, or if the origin of the scene
/// is unknown. The comments of a scene may have been written by anybody, so check a line before a
/// shell runs it.
pub fn recipe(scene: &Scene, last: Provenance<'_>) -> Option<String> {
    last.command?;
    let origin = recorded_origin(scene).or(scene.origin.as_deref())?;
    let (_, name) = Origin::parts(origin)?;
    let entries: Vec<Provenance<'_>> = entries(scene).chain([last]).collect();
    let mut commands: Vec<String> =
        entries.iter().filter_map(|entry| entry.command).map(str::to_owned).collect();
    if name != "-" {
        commands[0].insert_str(entries[0].program.len(), &format!(" {name}"));
    }
    let versions: Vec<String> =
        entries.iter().map(|entry| format!("{} {}", entry.program, entry.version)).collect();
    Some(format!("{} # {origin}; {}", commands.join(" | "), versions.join(", ")))
}

/// True if a text begins with comments of which one was recorded by a program.
pub fn has_history(text: &[u8]) -> bool {
    let mut rest = text.trim_ascii_start();
    while let Ok((after, comment)) = token::comment(rest) {
        if str::from_utf8(comment).is_ok_and(|comment| entry(comment).is_some()) {
            return true;
        }
        rest = after.trim_ascii_start();
    }
    false
}

/// What programs recorded, oldest first; each has a command.
fn entries(scene: &Scene) -> impl Iterator<Item = Provenance<'_>> {
    scene.head.iter().filter_map(|comment| entry(comment))
}

/// `name version: command line`, where the name is one of the family's and the
/// command line begins with it.
fn entry(comment: &str) -> Option<Provenance<'_>> {
    let (title, command) = comment.trim().split_once(": ")?;
    let (program, version) = title.split_once(' ')?;
    let is_version = version.starts_with(|c: char| c.is_ascii_digit()) && !version.contains(' ');
    let is_ours = program.starts_with("ug") && command.split(' ').next() == Some(program);
    (is_version && is_ours).then_some(Provenance { program, version, command: Some(command) })
}

/// The recorded hash and name.
fn recorded_origin(scene: &Scene) -> Option<&str> {
    scene.head.iter().map(|comment| comment.trim()).find(|comment| Origin::parts(comment).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made<'s>(program: &'s str, version: &'s str, command: &'s str) -> Provenance<'s> {
        Provenance { program, version, command: Some(command) }
    }

    fn licensed() -> Scene {
        Scene { head: vec![" A licence: free for all ".to_string()], ..Scene::default() }
    }

    #[test]
    fn history_is_what_was_recorded() {
        let mut scene = licensed();
        record(&mut scene, made("uglorentz", "0.1.0", "uglorentz -vel .9 0 0"));
        record(&mut scene, made("ugdoppler", "0.1.0", "ugdoppler"));
        assert_eq!(history(&scene), ["uglorentz -vel .9 0 0", "ugdoppler"]);
        assert_eq!(scene.head[0], " A licence: free for all ");
        assert_eq!(recipe(&scene, made("ugrainbow", "0.1.0", "ugrainbow")), None);
        let text = crate::write(&scene);
        assert!(has_history(&text) && !has_history(&crate::write(&licensed())) && !has_history(b"{"));
    }

    #[test]
    fn recipes_are_pipes() {
        let hash = "0123456789abcdef".repeat(4);
        let check = |name: &str, first: &str| {
            let mut scene = Scene { origin: Some(format!("SHA-256 {hash} {name}")), ..licensed() };
            let alone = recipe(&scene, made("ugrainbow", "0.1.0", "ugrainbow")).expect("an origin");
            assert!(alone.starts_with("ugrainbow ") && alone.ends_with("; ugrainbow 0.1.0"), "{alone}");
            record(&mut scene, made("uglorentz", "0.1.0", "uglorentz -vel .9 0 0"));
            // What a program downstream reads has no origin of its own.
            scene.origin = Some(format!("SHA-256 {} -", "0".repeat(64)));
            record(&mut scene, made("ugdoppler", "0.2.0", "ugdoppler"));
            let line = recipe(&scene, made("ugrainbow", "0.1.0", "ugrainbow -sz 9 9"));
            assert_eq!(
                line.expect("an origin"),
                format!(
                    "{first} | ugdoppler | ugrainbow -sz 9 9 # SHA-256 {hash} {name}; \
                     uglorentz 0.1.0, ugdoppler 0.2.0, ugrainbow 0.1.0"
                )
            );
        };
        check("ship.ug", "uglorentz ship.ug -vel .9 0 0");
        check("'my ship.ug'", "uglorentz 'my ship.ug' -vel .9 0 0");
        check("-", "uglorentz -vel .9 0 0");
    }
}
