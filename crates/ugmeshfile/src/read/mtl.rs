//! Reads the colours of a material library (MTL).

use std::collections::BTreeMap;

use ugscene::shorten;

use super::text::any_number;
use crate::builder::{Builder, Rgba};
use crate::decode::decode;

/// Diffuse and emitted colours, and their textures, by name.
#[derive(Debug, Default)]
pub(super) struct Materials {
    pub colors: BTreeMap<String, Rgba>,
    pub textures: BTreeMap<String, MapFile>,
    /// Emitted colours, and their pictures.
    pub emissions: BTreeMap<String, ([f64; 3], Option<MapFile>)>,
}

/// A picture of a material, and where it is on a surface.
#[derive(Clone, Debug, Default)]
pub(super) struct MapFile {
    pub file: String,
    /// By which u and v are multiplied, and what is then added to them, if that is stated.
    pub placement: Option<[[f32; 2]; 2]>,
    /// Beyond its edges the picture has their colours, and is not repeated.
    pub is_clamped: bool,
}

impl Materials {
    /// Adds the materials of a file. Only diffuse and emitted colours and opacity are read.
    /// Malformed statements are ignored, since a mesh is usable without its materials.
    pub fn add(&mut self, bytes: &[u8], builder: &mut Builder) {
        let text = decode(bytes);
        let mut current: Option<&mut Rgba> = None;
        let mut name = "";
        for line in text.lines() {
            let (keyword, rest) = split(without_comment(line));
            let mut numbers = rest.split_whitespace().map_while(any_number);
            match (&*keyword.to_ascii_lowercase(), &mut current) {
                ("newmtl", _) => {
                    let color = self.colors.entry(rest.to_string()).or_insert(UNNAMED);
                    *color = UNNAMED;
                    current = Some(color);
                    name = rest;
                    self.textures.remove(name);
                    self.emissions.remove(name);
                }
                ("kd", Some(color)) => {
                    if let Some(red) = numbers.next() {
                        // Missing components equal the first.
                        let [green, blue] = [(); 2].map(|()| numbers.next().unwrap_or(red));
                        color.0[..3].copy_from_slice(&[red, green, blue]);
                    } else {
                        let (name, kind) = (shorten(name), shorten(rest));
                        builder.warn(format!(
                            "the colour of material `{name}` is not read: `Kd {kind}`"
                        ));
                    }
                }
                ("d", Some(color)) => numbers.take(1).for_each(|opacity| color.0[3] = opacity),
                ("tr", Some(color)) => numbers.take(1).for_each(|clear| color.0[3] = 1.0 - clear),
                ("map_kd", Some(_)) if !rest.is_empty() => {
                    self.textures.insert(name.to_owned(), file_of_map(rest));
                }
                ("ke", Some(_)) => {
                    let red = numbers.next().unwrap_or(0.0);
                    let [green, blue] = [(); 2].map(|()| numbers.next().unwrap_or(red));
                    self.emissions.entry(name.to_owned()).or_default().0 = [red, green, blue];
                }
                ("map_ke", Some(_)) if !rest.is_empty() => {
                    self.emissions.entry(name.to_owned()).or_default().1 = Some(file_of_map(rest));
                }
                _ => {}
            }
        }
    }
}

/// The statement without a comment at its end. Names may have a `#`, but not after a blank.
pub(super) fn without_comment(statement: &str) -> &str {
    let end = statement.match_indices('#').map(|(at, _)| at);
    let mut end = end.filter(|&at| statement[..at].ends_with(char::is_whitespace));
    end.next().map_or(statement, |at| statement[..at].trim_end())
}

/// What follows the keyword of a statement such as `map_Kd -s 1 1 1 tree bark.png`.
fn file_of_map(mut rest: &str) -> MapFile {
    let mut map = MapFile::default();
    while rest.starts_with('-') {
        let (option, arguments) = split(rest);
        let most = match option {
            "-o" | "-s" | "-t" => 3,
            "-mm" => 2,
            "-blendu" | "-blendv" | "-bm" | "-boost" | "-cc" | "-clamp" | "-imfchan"
            | "-texres" | "-type" => 1,
            _ => break,
        };
        rest = arguments;
        map.is_clamped |= option == "-clamp" && split(rest).0 == "on";
        if let "-s" | "-o" = option {
            let parts =
                &mut map.placement.get_or_insert([[1.0; 2], [0.0; 2]])[usize::from(option == "-o")];
            let numbers = rest.split_whitespace().map_while(any_number);
            parts.iter_mut().zip(numbers).for_each(|(part, number)| *part = number as f32);
        }
        for idx in 0..most {
            let (word, after) = split(rest);
            // The last two numbers of `-o`, `-s` and `-t` may be missing.
            if most == 3 && idx > 0 && any_number(word).is_none() {
                break;
            }
            rest = after;
        }
    }
    rest.clone_into(&mut map.file);
    map
}

/// The colour of a material without `Kd`, the same as in other readers.
const UNNAMED: Rgba = Rgba([0.8, 0.8, 0.8, 1.0]);

/// The keyword of a line, and the trimmed rest.
pub(super) fn split(line: &str) -> (&str, &str) {
    let line = line.trim();
    match line.split_once(char::is_whitespace) {
        Some((keyword, rest)) => (keyword, rest.trim()),
        None => (line, ""),
    }
}
