//! Doppler factors in names of colours.

/// A Doppler factor for the name of a colour, with `_` for the point: as many decimal places as
/// distinguish it from others that are `step` apart, all if there is no step.
pub(crate) fn digits(doppler: f64, step: Option<f64>) -> String {
    let Some(step) = step else { return format!("{doppler}").replace('.', "_") };
    // The number of digits at which a unit in the last place is below a step.
    let places = (-libm::log10(step)).ceil().clamp(0.0, 20.0) as usize;
    few_digits(doppler, places).unwrap_or_else(|| format!("{doppler:.places$}").replace('.', "_"))
}

/// Powers of ten, which are exact.
const POWERS: [u32; 9] = [1, 10, 100, 1000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

/// As many as the last of [`POWERS`] has, and one more.
const ZEROS: &str = "000000000";

/// A number rounded to some decimal places, several times as fast as by `format`; `None` if it has
/// too many digits or is close to a tie.
fn few_digits(number: f64, places: usize) -> Option<String> {
    let power = *POWERS.get(places)?;
    let scaled = number * f64::from(power);
    let nearest = scaled.round();
    // Below 10⁹ the product is off by less than 10⁻⁷, so only near a tie another integer may be
    // the nearest.
    let is_sure = (0.0..1e9).contains(&scaled) && (scaled - nearest).abs() < 0.499_999;
    is_sure.then(|| {
        let mut text = (nearest as u32).to_string();
        if places > 0 {
            // At least one digit before the point.
            let missing = (places + 1).saturating_sub(text.len());
            text.insert_str(0, &ZEROS[..missing]);
            text.insert(text.len() - places, '_');
        }
        text
    })
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
            if let Some(few) = few_digits(number, places) {
                assert_eq!(few, exact, "{number} {places}");
                n_few += 1;
            }
            assert_eq!(
                digits(number, Some(libm::pow(0.1, places as f64) * 0.99)),
                digits_slow(number, places)
            );
        }
        assert!(n_few > 10_000, "{n_few}");
        assert_eq!(digits(0.25, None), "0_25");
        assert_eq!(digits(7.0, Some(2.0)), "7");
    }

    fn digits_slow(number: f64, places: usize) -> String {
        let places = places + 1;
        format!("{number:.places$}").replace('.', "_")
    }
}
