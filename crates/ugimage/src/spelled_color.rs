//! Colours as people write them on a command line.

use ugphysics::Hsv;

/// Names of colours, and their red, green and blue.
const NAMES: [(&str, [u8; 3]); 10] = [
    ("black", [0, 0, 0]),
    ("white", [255, 255, 255]),
    ("gray", [128, 128, 128]),
    ("grey", [128, 128, 128]),
    ("red", [255, 0, 0]),
    ("yellow", [255, 255, 0]),
    ("green", [0, 255, 0]),
    ("cyan", [0, 255, 255]),
    ("blue", [0, 0, 255]),
    ("magenta", [255, 0, 255]),
];

/// A colour in words: lightness, with a hue in degrees and a saturation if wanted; or a name, or
/// `#rgb` or `#rrggbb`. Lightness alone is grey, with a hue it is pure. `number`: parses a number.
///
/// ```
/// use ugimage::spelled_color;
///
/// let color = |words: &[&str]| {
///     let words: Vec<String> = words.iter().map(|word| word.to_string()).collect();
///     spelled_color(&words, |word| word.parse().map_err(|_| "no number".to_owned()))
/// };
/// assert_eq!(color(&["white"]), color(&["1"]));
/// assert_eq!(color(&["#f00"]), color(&["1", "0"]));
/// assert!(color(&["#8000ff"]).is_ok_and(|color| color.saturation == 1.0));
/// assert_eq!(color(&["1.5"]).unwrap_err(), "lightness and saturation are from 0 to 1");
/// ```
///
/// # Errors
/// The words are no colour: why.
pub fn spelled_color(
    words: &[String],
    number: impl Fn(&str) -> Result<f64, String>,
) -> Result<Hsv, String> {
    let named = |word: &str| {
        let is_name = |(name, _): &&(&str, [u8; 3])| word.eq_ignore_ascii_case(name);
        NAMES
            .iter()
            .find(is_name)
            .map(|(_, rgb)| *rgb)
            .or_else(|| of_digits(word.strip_prefix('#')?))
    };
    if let [word] = words
        && let Some(rgb) = named(word)
    {
        return Ok(Hsv::from_rgb(rgb.map(|part| f64::from(part) / 255.0)));
    }
    let part = |word: &String| {
        let names =
            "write lightness, hue in degrees and saturation, a name such as white, or #rrggbb";
        number(word).map_err(|error| format!("`{word}` is {error}; {names}"))
    };
    let numbers = words.iter().map(part).collect::<Result<Vec<f64>, _>>()?;
    let value = numbers.first().copied().unwrap_or(0.0);
    let hue = numbers.get(1).copied().unwrap_or(0.0);
    let saturation = numbers.get(2).copied().unwrap_or(if numbers.len() > 1 { 1.0 } else { 0.0 });
    if ![value, saturation].iter().all(|part| (0.0..=1.0).contains(part)) {
        return Err("lightness and saturation are from 0 to 1".to_owned());
    }
    Ok(Hsv { hue, saturation, value })
}

/// Red, green and blue of three or six hexadecimal digits.
fn of_digits(digits: &str) -> Option<[u8; 3]> {
    let digit =
        |idx: usize| digits.as_bytes().get(idx).and_then(|&digit| char::from(digit).to_digit(16));
    let pair = |high: usize, low: usize| u8::try_from(16 * digit(high)? + digit(low)?).ok();
    match digits.len() {
        3 => Some([pair(0, 0)?, pair(1, 1)?, pair(2, 2)?]),
        6 => Some([pair(0, 1)?, pair(2, 3)?, pair(4, 5)?]),
        _ => None,
    }
}
