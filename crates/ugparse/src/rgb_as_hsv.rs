//! Warns of `c` statements that were probably meant as red, green and blue.
//!
//! `c` is lightness, hue and saturation, so `c red 1 0 0` is white. A statement is doubtful if its
//! name is a word for another colour than it has, but for the one that its numbers have as red,
//! green and blue; or if it is a grey with a hue, brighter than white, in whole numbers up to 255.

use ugphysics::Hsv;
use ugscene::{ColorValue, Tint};

use crate::diagnostic::Diagnostic;
use crate::scope::Scope;
use crate::source::Span;

/// Colour words with their hues in degrees; `None` for greys.
const WORDS: [(&str, Option<f64>); 11] = [
    ("red", Some(0.0)),
    ("orange", Some(30.0)),
    ("yellow", Some(60.0)),
    ("green", Some(120.0)),
    ("cyan", Some(180.0)),
    ("blue", Some(240.0)),
    ("purple", Some(300.0)),
    ("magenta", Some(300.0)),
    ("white", None),
    ("grey", None),
    ("gray", None),
];

/// A colour is not called by a word if its hue is farther from that of the word, in degrees.
const FARTHEST_HUE: f64 = 45.0;

/// Colours of less saturation or value are called white, grey or black.
const LEAST_TINT: f64 = 0.2;

/// A single warning for all doubtful colours, at the first.
pub(crate) fn warning(text: &[u8], scopes: &[Scope<'_>]) -> Option<Diagnostic> {
    let doubtful = |scope: &Scope<'_>| -> Vec<Doubtful> {
        let rows = scope.colors.table.rows.iter().zip(&scope.colors.table.spans);
        let named = rows.zip(&scope.colors.spans);
        named.filter_map(|((color, &span), &name)| doubt(text, color.value, span, name?)).collect()
    };
    let all: Vec<Doubtful> = scopes.iter().flat_map(doubtful).collect();
    let first = all.first()?;
    let others = match all.len() - 1 {
        0 => String::new(),
        1 => "; one other colour looks the same".to_owned(),
        n => format!("; {n} other colours look the same"),
    };
    let Doubtful { name, span, hsv, rgb } = first;
    let [r, g, b] = rgb.map(short);
    Some(
        Diagnostic::warning(
            *span,
            format!("colour `{name}` is {}, not red, green and blue{others}", word_for(hsv)),
        )
        .label(format!("lightness {}, hue {}, saturation {}", hsv.value, hsv.hue, hsv.saturation))
        .help(format!("for red {r}, green {g}, blue {b} write `c_rgb {name} {r} {g} {b}`")),
    )
}

/// A statement that may be meant otherwise.
struct Doubtful {
    name: String,
    span: Span,
    /// The colour as it is read.
    hsv: Hsv,
    /// Red, green and blue that may be meant, 0 to 1.
    rgb: [f64; 3],
}

fn doubt(text: &[u8], value: ColorValue, span: Span, name_span: Span) -> Option<Doubtful> {
    let ColorValue::Hsv { value, tint: Tint::Hue(hue), saturation, .. } = value else {
        return None;
    };
    let hsv = Hsv { hue, saturation, value };
    let numbers = [value, hue, saturation];
    let is_byte = |number: &f64| (0.0..=255.0).contains(number) && number.fract() == 0.0;
    let rgb = if numbers.iter().all(|number| (0.0..=1.0).contains(number)) {
        numbers
    } else if numbers.iter().all(is_byte) {
        numbers.map(|number| number / 255.0)
    } else {
        return None;
    };
    let name = std::str::from_utf8(name_span.of(text)).ok()?;
    let is_doubtful = match word_of(name) {
        Some(word) => !is_called(&hsv, word) && is_called(&Hsv::from_rgb(rgb), word),
        None => value > 1.0 && hue > 1.0 && saturation == 0.0,
    };
    // With one or two numbers it is not red, green and blue. Comments between them are rare.
    let statement = std::str::from_utf8(span.of(text)).ok()?;
    let n_words = statement.trim_end_matches([';', ' ']).split_whitespace().count();
    (is_doubtful && n_words == 5).then(|| Doubtful {
        name: name.to_owned(),
        span: name_span,
        hsv,
        rgb,
    })
}

/// The hue of the colour word that a name is, also with a number behind it.
fn word_of(name: &str) -> Option<Option<f64>> {
    let name = name.trim_end_matches(|c: char| c.is_ascii_digit() || c == '_');
    WORDS.iter().find(|(word, _)| name.eq_ignore_ascii_case(word)).map(|&(_, hue)| hue)
}

/// Would a person call this colour by a word of this hue?
fn is_called(hsv: &Hsv, word: Option<f64>) -> bool {
    let is_tinted = hsv.saturation >= LEAST_TINT && hsv.value >= LEAST_TINT;
    match word {
        Some(hue) => is_tinted && hue_distance(hsv.hue, hue) <= FARTHEST_HUE,
        None => !is_tinted,
    }
}

/// Along the circle, degrees.
fn hue_distance(a: f64, b: f64) -> f64 {
    let apart = (a - b).rem_euclid(360.0);
    apart.min(360.0 - apart)
}

/// A word for a colour.
fn word_for(hsv: &Hsv) -> &'static str {
    if hsv.value < LEAST_TINT {
        return "black";
    }
    if hsv.saturation < LEAST_TINT {
        return if hsv.value < 0.9 { "grey" } else { "white" };
    }
    let distance = |hue: Option<f64>| hue.map_or(f64::INFINITY, |hue| hue_distance(hsv.hue, hue));
    let nearest = WORDS.iter().min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
    nearest.map_or("grey", |(word, _)| word)
}

/// A number with at most three decimals.
fn short(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
