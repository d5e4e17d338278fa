//! Numbers and names as text.

use ugtesting::Random;

/// A number as text: mostly usual, sometimes extreme, rarely malformed.
pub fn number(random: &mut Random) -> String {
    const EXTREME: [&str; 18] = [
        "0",
        "-0",
        "1e300",
        "-1e300",
        "1e155",
        "-1e155",
        "1e-300",
        "5e-324",
        "1.7976931348623157e308",
        "-1.7976931348623157e308",
        "1e-12",
        "1e9",
        "-1e9",
        "0.30000000000000004",
        "1e10",
        "179.99999",
        "1e-160",
        "4294967296",
    ];
    const MALFORMED: [&str; 8] = ["nan", "inf", "1e999", "0x10", "1,5", "--1", "1e", "\u{2212}1"];
    match random.below(60) {
        0 => (*random.pick(&MALFORMED)).to_owned(),
        1..=7 => (*random.pick(&EXTREME)).to_owned(),
        8..=30 => format!("{}", random.below(5) as f64 - 2.0),
        _ => format!("{:.3}", random.between(-3.0, 3.0)),
    }
}

/// A component of a velocity as text: mostly possible.
pub fn beta(random: &mut Random) -> String {
    const NEAR_ONE: [&str; 7] =
        ["0.9999999999999999", "-0.999999999999", "0.999999", "0.99", "1", "-1", "1.5"];
    match random.below(12) {
        0 => (*random.pick(&NEAR_ONE)).to_owned(),
        1 => number(random),
        2..=6 => "0".to_owned(),
        _ => format!("{:.4}", random.between(-0.57, 0.57)),
    }
}

/// A velocity as text: mostly possible, sometimes within rounding of the speed of light, in a
/// direction of three components.
pub fn velocity(random: &mut Random) -> [String; 3] {
    const FAST: [[&str; 3]; 6] = [
        ["0.6", "0.8", "0"],
        ["0.6", "0.7999999999999999", "0"],
        ["-0.28", "0", "0.96"],
        ["0.5773502691896257", "0.5773502691896257", "0.5773502691896257"],
        ["0.5773502691896258", "-0.5773502691896258", "0.5773502691896258"],
        ["0", "1e-200", "-0.9999999999999999"],
    ];
    if random.one_in(12) { random.pick(&FAST).map(str::to_owned) } else { [(); 3].map(|()| beta(random)) }
}

/// A name: mostly plain, sometimes with what a terminal would obey.
pub fn name(random: &mut Random) -> String {
    match random.below(60) {
        0 => "x".repeat(1 + random.below(3000)),
        1 => "\u{202e}gnp.pihs".to_owned(),
        2 => "\u{1b}[2J".to_owned(),
        3 => "a\u{9b}31m".to_owned(),
        4 => "ship:wing#2".to_owned(),
        5 => "\u{3b3}\u{2067}".to_owned(),
        6 => "\u{200f}a\u{200b}\u{2028}\u{61c}".to_owned(),
        7 => {
            (*random.pick(&["a\u{c}b", "a\u{fffe}", "a\\", "#a", "'a'", "$a", "a\u{85}b\u{2029}"])).to_owned()
        }
        _ => format!("{}{}", random.pick(&["a", "b", "v", "red"]), random.below(12)),
    }
}
