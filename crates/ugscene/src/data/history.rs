//! The history of a scene: each filter adds a head comment, and one with hash and name of every
//! file that it read and that no program before it recorded.

use std::collections::HashSet;

/// Comments at the head of a scene: its licence, and the history that pictures of it have as well.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Head {
    /// Comments before the first statement, without their outer braces. They come first in the
    /// output.
    pub comments: Vec<String>,
    /// Hash and name of every file that was read for the scene and that its comments do not have
    /// yet, the input first, see [`Head::record`].
    pub files: Vec<String>,
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
    /// Hash and name of every file that the program read beside its input.
    pub files: &'s [String],
}

impl Head {
    /// Appends a head comment with a command and its program, after one for each
    /// [file](Head::files) that was read for it, unless a comment has the same record.
    pub fn record(&mut self, provenance: Provenance<'_>) {
        let Provenance { program, version, command: Some(command), .. } = provenance else {
            return;
        };
        let new: Vec<String> =
            self.new_files(provenance).map(|words| format!(" {words} ")).collect();
        self.files.clear();
        self.comments.extend(new);
        self.comments.push(format!(" {program} {version}: {command} "));
    }

    /// Hash and name of every file that was read for a picture, but those of the
    /// [pipe](Head::recipe) itself. `last`: the last program of the pipe.
    pub fn other_files<'h>(&'h self, last: Provenance<'h>) -> impl Iterator<Item = &'h str> {
        let origin = self.origin();
        self.recorded_files().chain(self.new_files(last)).filter(move |&file| Some(file) != origin)
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
        let origin = self.origin()?;
        let (_, name) = file_parts(origin)?;
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

    /// Hash and name of the input of the first program, if that recorded them.
    fn origin(&self) -> Option<&str> {
        let mut comments = self.comments.iter().map(|comment| comment.trim());
        let first = comments.find(|words| file_parts(words).is_some() || recorded(words).is_some());
        let first = first.or(self.files.first().map(String::as_str))?;
        file_parts(first).map(|_| first)
    }

    fn recorded_files(&self) -> impl Iterator<Item = &str> {
        self.comments
            .iter()
            .map(|comment| comment.trim())
            .filter(|words| file_parts(words).is_some())
    }

    /// The files that no comment records. Two may have one record: files of one name and content in
    /// folders that are not told, of which one may change.
    fn new_files<'h>(&'h self, last: Provenance<'h>) -> impl Iterator<Item = &'h str> {
        let known: HashSet<&str> = self.recorded_files().collect();
        let last = if last.command.is_some() { last.files } else { &[] };
        let files = self.files.iter().chain(last).map(String::as_str);
        files.filter(move |words| !known.contains(words))
    }
}

/// The record of a program in a comment: `name version: command line`, where the name is one of the
/// family's and the command line begins with it.
pub fn recorded(comment: &str) -> Option<Provenance<'_>> {
    let (title, command) = comment.trim().split_once(": ")?;
    let (program, version) = title.split_once(' ')?;
    let is_version = version.starts_with(|c: char| c.is_ascii_digit()) && !version.contains(' ');
    let is_ours = program.starts_with("ug") && command.split(' ').next() == Some(program);
    let command = Some(command);
    (is_version && is_ours).then_some(Provenance { program, version, command, files: &[] })
}

/// Hash and name in the record of a file: `SHA-256 3b1c… ship.ug`, or `SHA-256 none ship.png` for
/// one that could not be read. Earlier versions wrote `SHA-256 3b1c… including 88d4… fleet.ug` with
/// the hash of the whole text of a scene that includes files.
fn file_parts(words: &str) -> Option<(&str, &str)> {
    let (hash, name) = words.strip_prefix("SHA-256 ")?.split_once(' ')?;
    let whole = name.strip_prefix("including ").and_then(|rest| rest.split_once(' '));
    let name = whole.map_or(name, |(_, name)| name);
    let is_hash = hash.len() == 64 && hash.bytes().all(|byte| byte.is_ascii_hexdigit());
    ((is_hash || hash == "none") && !name.contains('\n')).then_some((hash, name))
}
