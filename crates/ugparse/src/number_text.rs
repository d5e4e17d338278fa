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
        out.extend_from_slice(itoa::Buffer::new().format(value as i32).as_bytes());
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
