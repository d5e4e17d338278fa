//! Completions for shells: options, words and file names; where a number is needed, nothing.

use ugpipe::{Entry, Manual};

/// The completion of an option's values.
enum Values<'m> {
    Files,
    Words(Vec<&'m str>),
    Nothing,
}

fn values(option: &Entry) -> Values<'_> {
    if option.values.iter().any(ugpipe::Value::is_file) {
        Values::Files
    } else if option.words.is_empty() {
        Values::Nothing
    } else {
        Values::Words(option.words.iter().map(|(word, _)| word.as_str()).collect())
    }
}

fn n_needed(option: &Entry) -> usize {
    option.values.iter().filter(|value| !value.is_optional).count()
}

/// All options of the program and its commands, each once.
fn options(manual: &Manual) -> Vec<&Entry> {
    let mut options: Vec<&Entry> = Vec::new();
    for option in manual.options().chain(manual.commands.iter().flat_map(Manual::options)) {
        if options.iter().all(|other| other.names != option.names) {
            options.push(option);
        }
    }
    options
}

/// Names as documented, and the first one with two dashes.
fn all_names(option: &Entry) -> Vec<String> {
    let mut names = option.names.clone();
    let long = option.names.iter().find(|name| name.len() > 2 && !name.starts_with("--"));
    names.extend(long.map(|name| format!("-{name}")));
    names
}

/// Names of commands, without that of the program, and what they do.
fn commands(manual: &Manual) -> impl Iterator<Item = (&str, &str)> {
    let name = |sub: &'_ Manual| sub.name.rfind(' ').map_or(0, |blank| blank + 1);
    manual.commands.iter().map(move |sub| (&sub.name[name(sub)..], sub.about.as_str()))
}

/// Commands whose argument is one of several words, and the words.
fn words_of_commands(manual: &Manual) -> Vec<(&str, String)> {
    let words = |sub: &Manual| {
        let words = sub.arguments.iter().flat_map(|argument| &argument.words);
        words.map(|(word, _)| word.as_str()).collect::<Vec<_>>().join(" ")
    };
    let named = commands(manual).zip(&manual.commands).map(|((name, _), sub)| (name, words(sub)));
    named.filter(|(_, words)| !words.is_empty()).collect()
}

/// For bash: a function that finds the option whose value is typed.
pub fn bash(manual: &Manual) -> String {
    let program = &manual.name;
    let options = options(manual);
    let mut cases = String::new();
    for option in options.iter().filter(|option| !option.values.is_empty()) {
        let kind = match values(option) {
            Values::Files => "FILE".to_owned(),
            Values::Words(words) => words.join(" "),
            Values::Nothing => String::new(),
        };
        cases += &format!(
            "        {}) left={} needed={} kind='{kind}' ;;\n",
            all_names(option).join("|"),
            option.values.len(),
            n_needed(option)
        );
    }
    for (command, words) in words_of_commands(manual) {
        cases += &format!("        {command}) commands='{words}' ;;\n");
    }
    let words: Vec<&str> = commands(manual).map(|(name, _)| name).collect();
    let names: Vec<&str> = options.iter().flat_map(|option| &option.names).map(String::as_str).collect();
    format!(
        r#"# Completion of {program} for bash.
_{program}() {{
    local cur=${{COMP_WORDS[COMP_CWORD]}} word kind='' left=0 needed=0 commands='{commands}'
    COMPREPLY=()
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        if ((left > 0)) && [[ $word != -[A-Za-z-]* ]]; then
            left=$((left - 1)) needed=$((needed - 1))
            continue
        fi
        left=0 needed=0
        case $word in
{cases}        -*) ;;
        *) commands='' ;;
        esac
    done
    if ((needed > 0)) && [[ $kind != FILE ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$kind" -- "$cur")
    elif ((needed <= 0)) && [[ $cur == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W '{names}' -- "$cur")
    else
        ((needed > 0)) && commands=''
        compopt -o filenames
        mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$cur"; compgen -f -- "$cur")
    fi
}}
complete -F _{program} {program}
"#,
        commands = words.join(" "),
        names = names.join(" "),
    )
}

/// For zsh: a specification of all options for `_arguments`.
pub fn zsh(manual: &Manual) -> String {
    let program = &manual.name;
    let mut lines = String::new();
    for option in options(manual) {
        let action = match values(option) {
            Values::Files => "_files".to_owned(),
            Values::Words(words) => format!("({})", words.join(" ")),
            Values::Nothing => " ".to_owned(),
        };
        // Where an optional number may stand, a file name is more likely.
        let needed = option.values.iter().filter(|value| !value.is_optional);
        let values: String = needed.map(|value| format!(":{}:{action}", zsh_escaped(&value.name))).collect();
        for name in all_names(option) {
            lines += &format!(" \\\n    '*{name}[{}]{values}'", zsh_escaped(&option.about));
        }
    }
    let commands: Vec<String> = commands(manual)
        .map(|(name, about)| format!("'{name}:{}'", about.replace('\'', "'\\''").replace(':', "\\:")))
        .collect();
    let first = match commands.is_empty() {
        true => String::new(),
        false => " \\\n    '1:command or file:{ _describe command commands; _files }'".to_owned(),
    };
    let mut files = "_files".to_owned();
    for (command, words) in words_of_commands(manual) {
        files = format!("{{ if (( ${{words[(I){command}]}} )); then compadd {words}; else _files; fi }}");
    }
    format!(
        "#compdef {program}\n# Completion of {program} for zsh.\nlocal -a commands=({})\n_arguments -S{first}{lines} \\\n    '*:file:{files}'\n",
        commands.join(" ")
    )
}

/// Text for a specification in single quotes.
fn zsh_escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '\'' => escaped += "'\\''",
            '[' | ']' | ':' | '\\' => escaped.extend(['\\', c]),
            c => escaped.push(c),
        }
    }
    escaped
}

/// For fish: a line for each option. A function tells where the second or third number of an option
/// is typed, which fish would take for a file.
pub fn fish(manual: &Manual) -> String {
    let program = &manual.name;
    let options = options(manual);
    let names_with = |n: usize| {
        let several = options.iter().filter(|option| n_needed(option) >= n);
        several.flat_map(|option| all_names(option)).collect::<Vec<_>>().join(" ")
    };
    let mut text = format!("# Completion of {program} for fish.\n");
    let mut inside = String::new();
    for n in [2, 3] {
        let names = names_with(n);
        if !names.is_empty() {
            inside += &format!("    contains -- \"$words[-{n}]\" {names}; and return 0\n");
        }
    }
    text += &format!(
        "function __{program}_is_number\n    set -l words (commandline -opc)\n{inside}    return 1\nend\n\
         complete -c {program} -n __{program}_is_number -f\n"
    );
    for (name, about) in commands(manual) {
        text += &format!(
            "complete -c {program} -n __fish_use_subcommand -a {name} -d '{}'\n",
            fish_escaped(about)
        );
    }
    for (command, words) in words_of_commands(manual) {
        text +=
            &format!("complete -c {program} -n '__fish_seen_subcommand_from {command}' -f -a '{words}'\n");
    }
    for option in options {
        let flags: Vec<String> = all_names(option)
            .iter()
            .map(|name| match name.strip_prefix("--") {
                Some(word) => format!("-l {word}"),
                None if name.len() == 2 => format!("-s {}", &name[1..]),
                None => format!("-o {}", &name[1..]),
            })
            .collect();
        let is_needed = n_needed(option) > 0;
        let values = match values(option) {
            _ if option.values.is_empty() || !is_needed => String::new(),
            Values::Files => " -r -F".to_owned(),
            Values::Words(words) => format!(" -x -a '{}'", words.join(" ")),
            Values::Nothing => " -x".to_owned(),
        };
        text += &format!(
            "complete -c {program} {}{values} -d '{}'\n",
            flags.join(" "),
            fish_escaped(&option.about)
        );
    }
    text
}

fn fish_escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('\'', "\\'")
}
