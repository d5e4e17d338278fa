//! The history of a scene: each filter adds a head comment, the first one also the hash and the
//! name of what it read.

/// Comments at the head of a scene: its licence, and the history that pictures of it have as well.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Head {
    /// Comments before the first statement, without their outer braces. They come first in the
    /// output.
    pub comments: Vec<String>,
    /// The hash and the name of the input of a scene without a history, see [`Head::record`].
    pub origin: Option<String>,
}

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
    /// The command line, which begins with the name of the program. Without it nothing is added to
    /// a history.
    pub command: Option<&'s str>,
}

impl Head {
    /// Appends a head comment with a command and its program, after one with the
    /// [origin](Head::origin) of a scene without a history.
    pub fn record(&mut self, provenance: Provenance<'_>) {
        let Provenance { program, version, command: Some(command) } = provenance else { return };
        if let Some(origin) = self.origin.take()
            && self.history().is_empty()
        {
            self.comments.push(format!(" {origin} "));
        }
        self.comments.push(format!(" {program} {version}: {command} "));
    }

    /// The command lines recorded in a scene, oldest first.
    pub fn history(&self) -> Vec<&str> {
        self.entries().filter_map(|entry| entry.command).collect()
    }

    /// The history in one line for a shell, with the input of the first program, and with the hash
    /// of that input and the versions of all programs behind it:
    ///
    /// ```text
    /// uglorentz ship.ug -vel .9 0 0 | ugrainbow # SHA-256 3b1c… ship.ug; uglorentz 0.1.0, ugrainbow
    /// 0.1.0
    /// ```
    ///
    /// `last`: the last program of the pipe. `None` if it has no command, or if the origin of the
    /// scene is unknown. The comments of a scene may have been written by anybody, so check a line
    /// before a shell runs it.
    pub fn recipe(&self, last: Provenance<'_>) -> Option<String> {
        last.command?;
        let origin = self.recorded_origin().or(self.origin.as_deref())?;
        let (_, name) = origin_parts(origin)?;
        let entries: Vec<Provenance<'_>> = self.entries().chain([last]).collect();
        let mut commands: Vec<String> =
            entries.iter().filter_map(|entry| entry.command).map(str::to_owned).collect();
        if name != "-" {
            commands[0].insert_str(entries[0].program.len(), &format!(" {name}"));
        }
        let versions: Vec<String> =
            entries.iter().map(|entry| format!("{} {}", entry.program, entry.version)).collect();
        Some(format!("{} # {origin}; {}", commands.join(" | "), versions.join(", ")))
    }

    /// The records of programs, oldest first; each has a command.
    fn entries(&self) -> impl Iterator<Item = Provenance<'_>> {
        self.comments.iter().filter_map(|comment| recorded(comment))
    }

    /// The recorded hash and name.
    fn recorded_origin(&self) -> Option<&str> {
        self.comments
            .iter()
            .map(|comment| comment.trim())
            .find(|comment| origin_parts(comment).is_some())
    }
}

/// The record of a program in a comment: `name version: command line`, where the name is one of the
/// family's and the command line begins with it.
pub fn recorded(comment: &str) -> Option<Provenance<'_>> {
    let (title, command) = comment.trim().split_once(": ")?;
    let (program, version) = title.split_once(' ')?;
    let is_version = version.starts_with(|c: char| c.is_ascii_digit()) && !version.contains(' ');
    let is_ours = program.starts_with("ug") && command.split(' ').next() == Some(program);
    (is_version && is_ours).then_some(Provenance { program, version, command: Some(command) })
}

/// Hash and name of the words for an origin, `SHA-256 3b1c… ship.ug`, or `SHA-256 3b1c… including
/// 88d4… fleet.ug` with the hash of the whole text of a scene that includes files.
fn origin_parts(words: &str) -> Option<(&str, &str)> {
    let (hash, name) = words.strip_prefix("SHA-256 ")?.split_once(' ')?;
    let whole = name.strip_prefix("including ").and_then(|rest| rest.split_once(' '));
    let name = whole.map_or(name, |(_, name)| name);
    let is_hash = hash.len() == 64 && hash.bytes().all(|byte| byte.is_ascii_hexdigit());
    (is_hash && !name.contains('\n')).then_some((hash, name))
}
