//! Numbers as text that reads back to the same bits.

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
