//! Reads the colours of a material library (MTL).

use std::collections::{BTreeMap, BTreeSet};

use ugscene::shorten;

use super::text::any_number;
use crate::builder::{Builder, Rgba};
use crate::decode::decode;

/// Materials by name.
#[derive(Debug, Default)]
pub(super) struct Materials {
    rows: BTreeMap<String, usize>,
    list: Vec<Material>,
    /// The kinds of their pictures that are not read.
    pub ignored: BTreeSet<&'static str>,
}

/// Diffuse and emitted colours, opacity, and their pictures.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Material {
    pub color: Rgba,
    /// `d` is stated, which overrides `Tr`.
    has_opacity: bool,
    pub texture: Option<MapFile>,
    pub opacity: Option<MapFile>,
    /// The colour that it emits, and its picture.
    pub emitted: ([f64; 3], Option<MapFile>),
}

impl Default for Material {
    /// The colour of a material without `Kd` is the same as in other readers.
    fn default() -> Self {
        Self {
            color: Rgba([0.8, 0.8, 0.8, 1.0]),
            has_opacity: false,
            texture: None,
            opacity: None,
            emitted: ([0.0; 3], None),
        }
    }
}

/// A picture of a material, and where it is on a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct MapFile {
    pub file: String,
    /// By which u and v are multiplied, and what is then added to them, if that is stated.
    pub placement: Option<[[f32; 2]; 2]>,
    /// Beyond its edges the picture has their colours, and is not repeated.
    pub is_clamped: bool,
}

/// Statements of pictures that are not read, and their kinds.
const IGNORED: [(&str, &str); 16] = [
    ("map_ka", "ambient"),
    ("map_ks", "specular"),
    ("map_ns", "shininess"),
    ("map_bump", "bump"),
    ("bump", "bump"),
    ("disp", "displacement"),
    ("decal", "decal"),
    ("refl", "reflection"),
    ("map_refl", "reflection"),
    ("norm", "normal"),
    ("map_kn", "normal"),
    ("map_pr", "roughness"),
    ("map_pm", "metallic"),
    ("map_ps", "sheen"),
    ("map_tr", "transparency"),
    ("map_tf", "transmission"),
];

impl Materials {
    /// The material of this name, and its row in the order of the files.
    pub fn get(&self, name: &str) -> Option<(usize, &Material)> {
        let row = *self.rows.get(name)?;
        Some((row, &self.list[row]))
    }

    /// The material in a row.
    pub fn at(&self, row: usize) -> Option<&Material> {
        self.list.get(row)
    }

    /// Adds the materials of a file. Only diffuse and emitted colours and opacity are read.
    /// Malformed statements are ignored, since a mesh is usable without its materials.
    pub fn add(&mut self, bytes: &[u8], builder: &mut Builder) {
        let text = decode(bytes);
        let mut none = Material::default();
        let mut current: &mut Material = &mut none;
        let mut name = "";
        for line in text.lines() {
            let (keyword, rest) = split(without_comment(line));
            let keyword = keyword.to_ascii_lowercase();
            if keyword == "newmtl" {
                name = rest;
                let row = *self.rows.entry(rest.to_owned()).or_insert(self.list.len());
                if row == self.list.len() {
                    self.list.push(Material::default());
                }
                current = &mut self.list[row];
                *current = Material::default();
                continue;
            }
            let mut numbers = rest.split_whitespace().map_while(any_number);
            let mut color = || {
                let red = numbers.next()?;
                // Missing components equal the first.
                let [green, blue] = [(); 2].map(|()| numbers.next().unwrap_or(red));
                Some([red, green, blue]).filter(|color| !color.iter().any(|part| part.is_nan()))
            };
            let map = (!rest.is_empty()).then(|| file_of_map(rest));
            match &*keyword {
                "kd" => match color() {
                    Some(color) => current.color.0[..3].copy_from_slice(&color),
                    None => {
                        let (name, kind) = (shorten(name), shorten(rest));
                        builder.warn(format!(
                            "the colour of material `{name}` is not read: `Kd {kind}`"
                        ));
                    }
                },
                "d" | "tr" => {
                    let number = numbers.next().filter(|number| !number.is_nan());
                    let Some(number) = number else { continue };
                    if keyword == "d" {
                        (current.color.0[3], current.has_opacity) = (number, true);
                    } else if !current.has_opacity {
                        current.color.0[3] = 1.0 - number;
                    }
                }
                "ke" => current.emitted.0 = color().unwrap_or_default(),
                "map_kd" => current.texture = map.or(current.texture.take()),
                "map_d" => current.opacity = map.or(current.opacity.take()),
                "map_ke" => current.emitted.1 = map.or(current.emitted.1.take()),
                _ => {
                    let known = IGNORED.iter().find(|(known, _)| *known == keyword);
                    self.ignored.extend(known.filter(|_| map.is_some()).map(|(_, kind)| kind));
                }
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

/// The keyword of a line, and the trimmed rest.
pub(super) fn split(line: &str) -> (&str, &str) {
    let line = line.trim();
    match line.split_once(char::is_whitespace) {
        Some((keyword, rest)) => (keyword, rest.trim()),
        None => (line, ""),
    }
}
