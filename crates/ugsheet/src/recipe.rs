//! The pipe that a picture was drawn by, as a script for a shell.

use ugpipe::remedies::PROGRAMS;
use ugpipe::{CommonArgs, WRITING, shell_pipe, shell_word};

use crate::shell_words::{self, HASH, Token, is_recipe};

/// A recorded pipe, checked: it runs programs of this family only, none of them is told to write a
/// file, and no scene may run programs or read files elsewhere, unless that is allowed.
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

/// The pipes in the history of a picture; a sheet has one for each of its pictures. `allowed`: the
/// options that state what scenes may do.
///
/// # Errors
/// Why a line must not be run.
pub fn recipes(history: &str, allowed: &CommonArgs) -> Result<Vec<Recipe>, String> {
    let recipe = |line: &str| Recipe::parse(line, allowed);
    history.lines().filter(|line| is_recipe(line)).map(recipe).collect()
}

impl Recipe {
    fn parse(line: &str, allowed: &CommonArgs) -> Result<Self, String> {
        let (mut commands, mut comment) = (vec![Vec::new()], String::new());
        for token in shell_words::tokens(line) {
            match token {
                Token::Word(word) => commands.last_mut().expect("begins with one").push(word),
                Token::Pipe => commands.push(Vec::new()),
                Token::Comment(text) => comment = text,
            }
        }
        commands.iter().try_for_each(|command| check(command, allowed))?;
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
        let scene = self.scene.as_deref().map_or_else(|| "standard input".to_owned(), shell_word);
        let line = shell_pipe(&self.commands, None);
        format!("# {scene}, {HASH}{}; {}\n{line}\n", self.sha256, self.versions)
    }
}

/// Refuses commands that our programs do not record.
fn check(command: &[String], allowed: &CommonArgs) -> Result<(), String> {
    let name = command.first().map_or("", String::as_str);
    if !PROGRAMS.contains(&name) {
        return Err(format!("it runs `{name}`"));
    }
    for word in command {
        match option(word) {
            Some(name) if WRITING.contains(&name) => {
                return Err(format!("its option `{word}` writes a file"));
            }
            Some("allow-execute") if !allowed.allow_execute => {
                return Err(permission(word, "run programs"));
            }
            Some("allow-outside") if !allowed.allow_outside => {
                return Err(permission(word, "read files outside its folder"));
            }
            _ => {}
        }
    }
    Ok(())
}

fn permission(option: &str, action: &str) -> String {
    format!(
        "its option `{option}` lets the scene {action}; if you trust the scene, give {option} here, too"
    )
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
            let recipes = recipes(&history, &CommonArgs::default()).unwrap();
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
        let none = "uglorentz -vel .9 0 0\nugrainbow # no hash";
        assert_eq!(recipes(none, &CommonArgs::default()), Ok(vec![]));
    }

    #[test]
    fn what_programs_do_not_record_is_refused_or_quoted() {
        let read = |line: &str| recipes(line, &CommonArgs::default());
        let refusal = |pipe: &str| read(&line(pipe, "a.ug")).unwrap_err();
        assert_eq!(refusal("rm -r ."), "it runs `rm`");
        assert_eq!(refusal("ugrainbow | sh"), "it runs `sh`");
        assert_eq!(refusal("ugrainbow |"), "it runs ``");
        assert_eq!(refusal("./ugrainbow"), "it runs `./ugrainbow`");
        assert_eq!(refusal("ugrep --filter=*:sh x y"), "it runs `ugrep`");
        assert_eq!(refusal("eval ugrainbow"), "it runs `eval`");
        assert_eq!(refusal("ugrainbow; rm a"), "it runs `ugrainbow;`");
        for option in ["-fo", "--fo", "--fo=a", "-o", "'-'fo", r#""$(printf '\055')"fo"#] {
            assert!(
                refusal(&format!("ugrainbow {option} a")).contains("writes a file"),
                "{option}"
            );
        }
        let script = |pipe: &str| read(&line(pipe, "a.ug")).unwrap()[0].script();
        assert!(
            script("ugrainbow $(rm a) `b` > c & d; e")
                .ends_with("\nugrainbow '$(rm' 'a)' '`b`' '>' c '&' 'd;' e\n")
        );
        // A shell would drop the line end at the end of the last word.
        assert!(script(r#"ugrainbow -cap "$(printf '\012')" a.ug"#).ends_with(concat!(
            "\n",
            r#"eval 'ugrainbow -cap '\'''"$(printf '\012\047')"' a.ug'"#,
            "\n"
        )));
        assert!(read("ugrainbow # SHA-256 12 a.ug; ugrainbow 0.1.0").is_err());
        let damaged = line("ugrainbow", "a.ug").replace("uglorentz 0.1.0", "$(rm)");
        assert!(read(&damaged).is_err());
    }

    #[test]
    fn permissions_are_asked_for() {
        let none = CommonArgs::default();
        let [mut execute, mut outside] = [CommonArgs::default(), CommonArgs::default()];
        execute.allow_execute = true;
        outside.allow_outside = true;
        for (option, allowed) in [("--allow-execute", &execute), ("-allow-outside", &outside)] {
            let line = line(&format!("uglorentz a.ug {option}"), "a.ug");
            assert!(recipes(&line, allowed).is_ok());
            for other in [&none, &execute, &outside].into_iter().filter(|other| *other != allowed) {
                assert!(recipes(&line, other).unwrap_err().contains(option));
            }
        }
        assert!(recipes(&line("ugrainbow a.ug -cap allow-execute", "a.ug"), &none).is_ok());
    }
}
