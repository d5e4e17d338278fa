//! Numbers formatted as in textbooks.

use ugphysics::Velocity;

/// A number rounded to `digits` significant digits, without trailing zeros: `2.294`, `1.3×10⁻⁵`,
/// `−0.5`.
pub fn significant(number: f64, digits: usize) -> String {
    let scientific = format!("{:.*e}", digits - 1, number);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if number == 0.0 || (-3..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        return minus(trimmed(&format!("{number:.decimals$}")));
    }
    format!("{}×10{}", minus(trimmed(mantissa)), raised(exponent))
}

/// The speed β, with enough decimals to distinguish it from 1; as `1 − …` if that takes more than
/// 10.
pub fn speed(v: Velocity) -> String {
    let beta = v.speed();
    // 1 − β = 1/(γ²(1 + β)), without cancellation.
    let slack = 1.0 / (v.gamma() * v.gamma() * (1.0 + beta));
    if beta < 0.1 {
        return significant(beta, 3);
    }
    let decimals = (2.0 - libm::log10(slack).floor()).max(3.0);
    if decimals > 10.0 {
        return format!("1 − {}", significant(slack, 2));
    }
    trimmed(&format!("{beta:.*}", decimals as usize)).to_owned()
}

/// A list of formatted numbers in order: up to three are listed, more become a range from the first
/// to the last. Repeated neighbours count once.
pub fn list_or_range(mut texts: Vec<String>) -> String {
    texts.dedup();
    match texts.as_slice() {
        [first, .., last] if texts.len() > 3 => range(first, last),
        texts => texts.join(", "),
    }
}

/// A range, or a single number if both ends are equal.
pub fn range(low: &str, high: &str) -> String {
    if low == high { low.to_owned() } else { format!("{low} – {high}") }
}

fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

fn minus(number: &str) -> String {
    number.replace('-', "−")
}

fn raised(exponent: i32) -> String {
    let digit = |c: char| match c.to_digit(10) {
        Some(1) => '¹',
        Some(2) => '²',
        Some(3) => '³',
        Some(other) => char::from_u32(0x2070 + other).unwrap_or(c),
        None => '⁻',
    };
    exponent.to_string().chars().map(digit).collect()
}
