//! Colours of a material library (MTL).

use std::collections::BTreeMap;

use super::words;
use crate::builder::Rgba;

/// Diffuse colours by name.
#[derive(Debug, Default)]
pub(super) struct Materials {
    pub colors: BTreeMap<String, Rgba>,
    pub has_textures: bool,
}

impl Materials {
    /// Adds the materials of a file. What is not a colour or its opacity is passed over, and so is a statement that
    /// cannot be read: a material is an ornament.
    pub fn add(&mut self, bytes: &[u8]) {
        let text = words::text(bytes);
        let mut current: Option<&mut Rgba> = None;
        for line in text.lines() {
            let (keyword, rest) = split(line);
            let mut numbers = rest.split_whitespace().map_while(|word| word.parse::<f64>().ok());
            match (keyword, &mut current) {
                ("newmtl", _) => {
                    let color = self.colors.entry(rest.to_string()).or_insert(UNNAMED);
                    *color = UNNAMED;
                    current = Some(color);
                }
                ("Kd", Some(color)) => {
                    if let Some(red) = numbers.next() {
                        // Those left out are like the first.
                        let [green, blue] = [(); 2].map(|()| numbers.next().unwrap_or(red));
                        color.0[..3].copy_from_slice(&[red, green, blue]);
                    }
                }
                ("d", Some(color)) => numbers.take(1).for_each(|opacity| color.0[3] = opacity),
                ("Tr", Some(color)) => numbers.take(1).for_each(|clear| color.0[3] = 1.0 - clear),
                ("map_Kd", _) => self.has_textures = true,
                _ => {}
            }
        }
    }
}

/// The colour of a material that names none, as other readers have it.
const UNNAMED: Rgba = Rgba([0.8, 0.8, 0.8, 1.0]);

/// Keyword and what follows, without the blanks round it.
pub(super) fn split(line: &str) -> (&str, &str) {
    let line = line.trim();
    match line.split_once(char::is_whitespace) {
        Some((keyword, rest)) => (keyword, rest.trim()),
        None => (line, ""),
    }
}
