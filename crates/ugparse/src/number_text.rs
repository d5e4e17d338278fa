//! Numbers as text that reads back to the same bits.

use ugphysics::Velocity;

/// Writes `x y z`, or `x y z -gamma γ`, after `mark`.
pub(crate) fn push_velocity(
    out: &mut Vec<u8>,
    numbers: &mut zmij::Buffer,
    mut mark: &'static str,
    velocity: Velocity,
) {
    let (vector, gamma) = velocity.stated();
    let parts = vector.to_array().map(|part| (" ", part));
    for (between, part) in parts.into_iter().chain(gamma.map(|gamma| (" -gamma ", gamma))) {
        out.extend_from_slice(if mark.is_empty() { between } else { mark }.as_bytes());
        push_number(out, numbers, part);
        mark = "";
    }
}

/// Writes the shortest decimal that reads back to the same bits.
pub(crate) fn push_number(out: &mut Vec<u8>, numbers: &mut zmij::Buffer, value: f64) {
    // Not `-0.0`, whose sign the general method keeps.
    if value == value.trunc() && value.abs() < 1e6 && (value != 0.0 || value.is_sign_positive()) {
        let mut digits = [0u8; 8];
        out.extend_from_slice(short_integer(value as i32, &mut digits));
        return;
    }
    let text = numbers.format_finite(value);
    out.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
}

/// Writes the shortest decimal that reads back to the same 32 bits.
pub(crate) fn push_number32(out: &mut Vec<u8>, numbers: &mut zmij::Buffer, value: f32) {
    let text = numbers.format_finite(value);
    out.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
}

/// Decimal digits of an integer of at most six digits.
fn short_integer(value: i32, digits: &mut [u8; 8]) -> &[u8] {
    let mut rest = value.unsigned_abs();
    let mut start = digits.len();
    loop {
        start -= 1;
        digits[start] = b'0' + (rest % 10) as u8;
        rest /= 10;
        if rest == 0 {
            break;
        }
    }
    if value < 0 {
        start -= 1;
        digits[start] = b'-';
    }
    &digits[start..]
}
