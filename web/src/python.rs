//! A pipe in Python, with the package `uglorentz`.

use serde_json::Value;
use ugpipe::{Entry, Manual};

/// The method of a program. The others are functions of the package.
fn method(program: &str) -> &str {
    match program {
        "uglorentz" => "lorentz",
        "ugdoppler" => "doppler",
        "ugrainbow" => "render",
        other => other.trim_start_matches("ug"),
    }
}

/// A command in parts, as Python writes them.
#[derive(Default)]
struct Call {
    files: Vec<String>,
    output: Option<String>,
    /// Keyword arguments of reading.
    reading: Vec<String>,
    /// Other keyword arguments.
    options: Vec<String>,
}

fn text(word: &str) -> String {
    Value::from(word).to_string()
}

/// The keyword of an option: its longest name.
fn keyword(entry: &Entry) -> String {
    let names = entry.names.iter().map(|name| name.trim_start_matches('-'));
    // Of equally long ones the first.
    let longest = names.rev().max_by_key(|name| name.len()).unwrap_or_default();
    let is_reserved = ["in", "from"].contains(&longest);
    longest.replace('-', "_") + if is_reserved { "_" } else { "" }
}

/// `keyword=value`
fn argument(entry: &Entry, values: &[&str]) -> String {
    let value =
        |word: &&str| if word.parse::<f64>().is_ok() { (*word).to_owned() } else { text(word) };
    let values: Vec<String> = values.iter().map(value).collect();
    let value = match &values[..] {
        [] => "True".to_owned(),
        [value] => value.clone(),
        values => format!("({})", values.join(", ")),
    };
    format!("{}={value}", keyword(entry))
}

impl Call {
    fn new(words: &[String], manual: &Manual) -> Self {
        let entries = || manual.groups.iter().flat_map(|group| &group.options);
        let find = |word: &str| {
            let name = word.trim_start_matches('-');
            let is_option = name.len() < word.len();
            let has_name = |entry: &&Entry| {
                entry.names.iter().any(|known| known.trim_start_matches('-') == name)
            };
            entries().find(has_name).filter(|_| is_option)
        };
        let mut call = Self::default();
        let mut words = words.iter().skip(1).map(String::as_str).peekable();
        while let Some(word) = words.next() {
            let Some(entry) = find(word) else {
                call.files.push(text(word));
                continue;
            };
            let most = if entry.is_repeated { usize::MAX } else { entry.values.len() };
            let least = entry.values.iter().filter(|value| !value.is_optional).count();
            let mut values = Vec::new();
            // Beyond those that are needed only numbers are values, so that a file may follow.
            let suits = |next: &str, count: usize| {
                find(next).is_none()
                    && (count < least || count < most && next.parse::<f64>().is_ok())
            };
            while let Some(value) = words.next_if(|next| suits(next, values.len())) {
                values.push(value);
            }
            match (keyword(entry).as_str(), &values[..]) {
                ("output", [file]) => call.output = Some(text(file)),
                ("input", [file]) => call.files.push(text(file)),
                _ if entry.is_common => call.reading.push(argument(entry, &values)),
                _ => call.options.push(argument(entry, &values)),
            }
        }
        call
    }
}

/// The lines that draw a pipe and write its file.
pub fn lines<'c>(commands: impl Iterator<Item = (&'c [String], Manual)>) -> String {
    let mut chain = String::new();
    let mut output = None;
    for (words, manual) in commands {
        let Call { files, output: file, reading, options } = Call::new(words, &manual);
        let method = method(words.first().map_or("", String::as_str));
        let all = |parts: [Vec<String>; 2]| parts.concat().join(", ");
        if method == "warp" {
            chain = format!("picture = ug.warp({})", all([files, options]));
        } else {
            if chain.is_empty() {
                chain =
                    format!("scene = ug.Scene.read({})\npicture = scene", all([files, reading]));
            }
            chain += &format!(".{method}({})", options.join(", "));
        }
        output = output.or(file);
    }
    let save = output.map_or_else(String::new, |file| format!("\npicture.save({file})"));
    format!("import uglorentz as ug\n\n{chain}{save}")
}
