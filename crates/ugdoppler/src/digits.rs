//! Doppler factors in names of colours.

/// The name of a colour as seen with a Doppler factor, which follows the name at rest with `_` for
/// the point: as many decimal places as distinguish it from others that are `step` apart, all if
/// there is no step.
pub(crate) fn name_as_seen(name: &str, doppler: f64, step: Option<f64>) -> String {
    // Names have no more bytes than this behind `name`, but for extreme factors.
    let mut seen = String::with_capacity(name.len() + 16);
    seen.push_str(name);
    seen.push('#');
    let Some(step) = step else { return seen + &format!("{doppler}").replace('.', "_") };
    // The number of digits at which a unit in the last place is below a step.
    let few = POWERS.iter().position(|&power| f64::from(power) * step >= 1.0);
    let places = few.unwrap_or_else(|| (-libm::log10(step)).ceil().clamp(0.0, 20.0) as usize);
    if !push_few_digits(&mut seen, doppler, places) {
        seen += &format!("{doppler:.places$}").replace('.', "_");
    }
    seen
}

/// Powers of ten, which are exact.
const POWERS: [u32; 9] = [1, 10, 100, 1000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

/// Appends a number rounded to some decimal places, several times as fast as by `format`; returns
/// false if it has too many digits or is close to a tie.
fn push_few_digits(text: &mut String, number: f64, places: usize) -> bool {
    let Some(&power) = POWERS.get(places) else { return false };
    let scaled = number * f64::from(power);
    let nearest = scaled.round();
    // Below 10⁹ the product is off by less than 10⁻⁷, so only near a tie another integer may be
    // the nearest.
    let is_sure = (0.0..1e9).contains(&scaled) && (scaled - nearest).abs() < 0.499_999;
    if is_sure {
        // From the last one: up to 10 digits, at least one of them before the point.
        let (mut digits, mut first, mut rest) = ([0; 11], 11, nearest as u32);
        for place in 0.. {
            if place > places && rest == 0 {
                break;
            }
            if place == places && places > 0 {
                first -= 1;
                digits[first] = b'_';
            }
            first -= 1;
            digits[first] = b'0' + (rest % 10) as u8;
            rest /= 10;
        }
        text.push_str(&String::from_utf8_lossy(&digits[first..]));
    }
    is_sure
}

#[cfg(test)]
mod tests {
    use ugtesting::Random;

    use super::*;

    #[test]
    fn digits_are_those_of_the_exact_number() {
        let mut random = Random(3);
        let mut n_few = 0;
        for round in 0..20_000 {
            let places = round % 12;
            let number = match round % 5 {
                // Ties, and what is nearest to them.
                0 => (random.unit() * 1000.0).round() / 16.0,
                1 => ((random.unit() * 100.0).round() / 8.0).next_up(),
                2 => ((random.unit() * 100.0).round() / 8.0 + 0.5).next_down(),
                3 => random.unit() * 10.0,
                _ => 1.0 / random.unit(),
            };
            let exact = format!("{number:.places$}").replace('.', "_");
            let mut few = String::new();
            if push_few_digits(&mut few, number, places) {
                assert_eq!(few, exact, "{number} {places}");
                n_few += 1;
            }
            assert_eq!(
                name_as_seen("a", number, Some(libm::pow(0.1, places as f64) * 0.99)),
                format!("a#{}", digits_slow(number, places))
            );
        }
        assert!(n_few > 10_000, "{n_few}");
        assert_eq!(name_as_seen("a", 0.25, None), "a#0_25");
        assert_eq!(name_as_seen("a", 7.0, Some(2.0)), "a#7");
    }

    fn digits_slow(number: f64, places: usize) -> String {
        let places = places + 1;
        format!("{number:.places$}").replace('.', "_")
    }
}
