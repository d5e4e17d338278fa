//! The pipe that a picture was drawn by, as a script for a shell.

use ugpipe::shell_word;

use crate::shell_words::{self, HASH, Token, is_recipe};

/// Options that are never recorded, with their other names: those that write files.
const WRITES: [&str; 7] = ["fo", "output", "o", "fm", "messages", "at", "attributes"];

/// Options with which a scene may run programs or read files elsewhere.
const PERMISSIONS: [&str; 2] = ["allow-execute", "allow-outside"];

/// A recorded pipe, checked: it runs programs of this family only, and none of them is told to
/// write a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recipe {
    /// The words of every command.
    commands: Vec<Vec<String>>,
    /// SHA-256 of the input of the first command, in hexadecimal digits.
    pub sha256: String,
    /// The file with this input, relative to the folder where the pipe was run; `None` for standard
    /// input.
    pub scene: Option<String>,
    /// Names and versions of the programs: `ugmesh 0.1.0, ugrainbow 0.1.0`.
    pub versions: String,
}

/// The pipes in the history of a picture; a sheet has one for each of its pictures.
///
/// # Errors
/// Why a line must not be run.
pub fn recipes(history: &str) -> Result<Vec<Recipe>, String> {
    history.lines().filter(|line| is_recipe(line)).map(Recipe::parse).collect()
}

impl Recipe {
    fn parse(line: &str) -> Result<Self, String> {
        let (mut commands, mut comment) = (vec![Vec::new()], String::new());
        for token in shell_words::tokens(line) {
            match token {
                Token::Word(word) => commands.last_mut().expect("begins with one").push(word),
                Token::Pipe => commands.push(Vec::new()),
                Token::Comment(text) => comment = text,
            }
        }
        commands.iter().try_for_each(|command| check(command))?;
        Self::from_parts(commands, &comment)
            .ok_or_else(|| "its hash or its versions are damaged".to_owned())
    }

    fn from_parts(commands: Vec<Vec<String>>, comment: &str) -> Option<Self> {
        let (origin, versions) = comment.strip_prefix(HASH)?.rsplit_once("; ")?;
        let (sha256, name) = origin.split_once(' ')?;
        let is_hash = sha256.len() == 64 && sha256.bytes().all(|byte| byte.is_ascii_hexdigit());
        let is_version = |c: char| c.is_ascii_alphanumeric() || " .,-+".contains(c);
        let name = shell_words::split(name).pop()?;
        (is_hash && versions.chars().all(is_version)).then(|| Self {
            commands,
            sha256: sha256.to_ascii_lowercase(),
            scene: (name != "-").then_some(name),
            versions: versions.to_owned(),
        })
    }

    /// The pipe as a script: a comment with the origin, and a line with the commands.
    pub fn script(&self) -> String {
        let quoted = |command: &Vec<String>| {
            command.iter().map(|word| shell_word(word)).collect::<Vec<_>>().join(" ")
        };
        let commands: Vec<String> = self.commands.iter().map(quoted).collect();
        let scene = self.scene.as_deref().map_or_else(|| "standard input".to_owned(), shell_word);
        format!("# {scene}, {HASH}{}; {}\n{}\n", self.sha256, self.versions, commands.join(" | "))
    }

    /// The first option that gives a scene permissions.
    pub fn permission(&self) -> Option<&str> {
        let words = self.commands.iter().flatten();
        words
            .map(String::as_str)
            .find(|word| PERMISSIONS.contains(&option(word).unwrap_or_default()))
    }
}

/// Refuses commands that our programs do not record.
fn check(command: &[String]) -> Result<(), String> {
    let name = command.first().map_or("", String::as_str);
    let is_ours = name
        .strip_prefix("ug")
        .is_some_and(|rest| !rest.is_empty() && rest.bytes().all(|byte| byte.is_ascii_lowercase()));
    if !is_ours {
        return Err(format!("it runs `{name}`"));
    }
    match command.iter().find(|word| option(word).is_some_and(|name| WRITES.contains(&name))) {
        Some(word) => Err(format!("its option `{word}` writes a file")),
        None => Ok(()),
    }
}

/// The name of an option without its dashes and without a value in the same word.
fn option(word: &str) -> Option<&str> {
    let name = word.strip_prefix('-')?;
    let name = name.strip_prefix('-').unwrap_or(name);
    Some(name.split_once('=').map_or(name, |(name, _)| name))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(pipe: &str, name: &str) -> String {
        format!("{pipe} # SHA-256 {} {name}; uglorentz 0.1.0, ugrainbow 0.1.0", "0a".repeat(32))
    }

    #[test]
    fn pipes_become_scripts() {
        let check = |pipe: &str, name: &str, scene: &str| {
            let history = format!("uglorentz -vel .9 0 0\n{}", line(pipe, name));
            let recipes = recipes(&history).unwrap();
            let hash = "0a".repeat(32);
            let expected =
                format!("# {scene}, SHA-256 {hash}; uglorentz 0.1.0, ugrainbow 0.1.0\n{pipe}\n");
            assert_eq!(recipes.iter().map(Recipe::script).collect::<Vec<_>>(), [expected]);
        };
        check(
            "uglorentz ship.ug -vel .9 0 0 | ugrainbow -cap 'a | b; $(c) # it'\\''s'",
            "ship.ug",
            "ship.ug",
        );
        check("uglorentz 'a; b.ug' | ugrainbow", "'a; b.ug'", "'a; b.ug'");
        check("ugrainbow -dt exr", "-", "standard input");
        assert_eq!(recipes("uglorentz -vel .9 0 0\nugrainbow # no hash"), Ok(vec![]));
    }

    #[test]
    fn what_programs_do_not_record_is_refused_or_quoted() {
        let refusal = |pipe: &str| recipes(&line(pipe, "a.ug")).unwrap_err();
        assert_eq!(refusal("rm -r ."), "it runs `rm`");
        assert_eq!(refusal("ugrainbow | sh"), "it runs `sh`");
        assert_eq!(refusal("ugrainbow |"), "it runs ``");
        assert_eq!(refusal("./ugrainbow"), "it runs `./ugrainbow`");
        assert_eq!(refusal("ugrainbow; rm a"), "it runs `ugrainbow;`");
        for option in
            ["-fo", "--fo", "--fo=a", "-output", "-fm", "-at", "-o", "'-'fo", "--attributes"]
        {
            assert!(
                refusal(&format!("ugrainbow {option} a")).contains("writes a file"),
                "{option}"
            );
        }
        let script = |pipe: &str| recipes(&line(pipe, "a.ug")).unwrap()[0].script();
        assert!(
            script("ugrainbow $(rm a) `b` > c & d; e")
                .ends_with("\nugrainbow '$(rm' 'a)' '`b`' '>' c '&' 'd;' e\n")
        );
        assert!(recipes("ugrainbow # SHA-256 12 a.ug; ugrainbow 0.1.0").is_err());
        let damaged = line("ugrainbow", "a.ug").replace("uglorentz 0.1.0", "$(rm)");
        assert!(recipes(&damaged).is_err());
    }

    #[test]
    fn permissions_are_found() {
        let found =
            |pipe: &str| recipes(&line(pipe, "a.ug")).unwrap()[0].permission().map(str::to_owned);
        assert_eq!(found("uglorentz a.ug --allow-execute"), Some("--allow-execute".to_owned()));
        assert_eq!(found("ugrainbow a.ug -cap allow-execute"), None);
    }
}
