//! Text from templates, whose signs stand for numbers and names.

use ugtesting::Random;

/// A choice of numbers and names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Possible ones, so that pipes run to their end.
    Mild,
    /// Extreme and malformed ones, too.
    Wild,
}

/// A template with its signs replaced: `#` by a number, `%` by three, `&` by a velocity, `@` by a
/// name, `*` by the name of a vertex, `^` by that of a color, and `~` by a motion or nothing.
pub fn fill(random: &mut Random, kind: Kind, template: &str) -> String {
    let mut text = String::new();
    for sign in template.chars() {
        match sign {
            '#' => text += &number(random, kind),
            '%' => text += &[(); 3].map(|()| number(random, kind)).join(" "),
            '&' => text += &velocity(random, kind).join(" "),
            '@' => text += &name(random, kind),
            '*' => text += &format!("v{}", random.below(8)),
            '^' => text += *random.pick(&["", "red0", "red1", "red2"]),
            '~' => match random.below(4) {
                0 => text += &format!("<{}>", velocity(random, kind).join(" ")),
                1 => text += &format!("<m{}>", random.below(4)),
                _ => {}
            },
            sign => text.push(sign),
        }
    }
    text
}

/// A number: a wild one is sometimes extreme, and rarely malformed.
pub fn number(random: &mut Random, kind: Kind) -> String {
    const EXTREME: [&str; 16] = [
        "-0",
        "1e300",
        "-1e300",
        "1e155",
        "1e-300",
        "5e-324",
        "1.7976931348623157e308",
        "-1.7976931348623157e308",
        "1e-12",
        "-1e9",
        "0.30000000000000004",
        "179.99999",
        "4294967296",
        "0.9999999999999999",
        "1e17",
        "1e-160",
    ];
    const MALFORMED: [&str; 8] = ["nan", "inf", "1e999", "0x10", "1,5", "--1", "1e", "\u{2212}1"];
    match (kind, random.below(60)) {
        (Kind::Wild, 0) => (*random.pick(&MALFORMED)).to_owned(),
        (Kind::Wild, 1..=7) => (*random.pick(&EXTREME)).to_owned(),
        (Kind::Wild, 8..=30) => format!("{}", random.below(5) as f64 - 2.0),
        (Kind::Wild, _) => format!("{:.3}", random.between(-3.0, 3.0)),
        (Kind::Mild, 0..9) => format!("{:.9}", libm::exp10(random.between(-6.0, 0.0))),
        (Kind::Mild, _) => format!("{:.3}", random.between(0.1, 1.0)),
    }
}

/// The components of a velocity: a wild one may be within rounding of the speed of light, or above.
pub fn velocity(random: &mut Random, kind: Kind) -> [String; 3] {
    const FAST: [[&str; 3]; 5] = [
        ["0.6", "0.8", "0"],
        ["0.6", "0.7999999999999999", "0"],
        ["0.5773502691896257", "0.5773502691896257", "0.5773502691896257"],
        ["0", "1e-200", "-0.9999999999999999"],
        ["1.5", "0", "0"],
    ];
    if kind == Kind::Wild && random.one_in(8) {
        return random.pick(&FAST).map(str::to_owned);
    }
    let speed = if random.one_in(5) {
        1.0 - libm::exp10(random.between(-9.0, -1.0))
    } else {
        random.unit()
    };
    (random.direction() * speed * 0.999_999_999).to_array().map(|part| part.to_string())
}

/// A name: a wild one may have what a terminal would obey.
pub fn name(random: &mut Random, kind: Kind) -> String {
    const ODD: [&str; 10] = [
        "\u{202e}gnp.pihs",
        "\u{1b}[2J",
        "a\u{9b}31m",
        "ship:wing#2",
        "\u{3b3}\u{2067}",
        "\u{200f}a\u{200b}\u{2028}\u{61c}",
        "a\u{fffe}",
        "a\\",
        "'a'",
        "]]>&<b>",
    ];
    match (kind, random.below(30)) {
        (Kind::Wild, 0) => "x".repeat(1 + random.below(3000)),
        (Kind::Wild, 1..=4) => (*random.pick(&ODD)).to_owned(),
        _ => format!("{}{}", random.pick(&["a", "b", "v", "red"]), random.below(12)),
    }
}
