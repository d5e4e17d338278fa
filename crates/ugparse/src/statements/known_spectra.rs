//! Spectra that scenes may name: reflectances of surfaces and the light of the sun.

use crate::token::Reason;

/// Reflectances from 400 to 2450 nm: medians of measured spectra, of foliage of simulated ones.
/// From earthlib 1.1.0; its licence is in `surfaces.license`.
const SURFACES: &str = include_str!("../surfaces.csv");

/// The sun above the air and on the ground (ASTM G-173-03) to 2500 nm, beyond it by Planck's law at
/// 5772 K, both with Y = 1.
const SUNS: &str = include_str!("../suns.csv");

/// The samples (nm, value) of a known spectrum. `reflects`: of a surface; else of light.
pub(super) fn samples(name: &[u8], reflects: bool) -> Option<Vec<[f64; 2]>> {
    let mut rows = table(reflects).lines();
    let column = rows.next()?.split(',').skip(1).position(|known| known.as_bytes() == name)?;
    let sample = |row: &str| {
        let mut numbers = row.split(',').map_while(|number| number.parse::<f64>().ok());
        Some([numbers.next()?, numbers.nth(column)?])
    };
    rows.map(sample).collect()
}

/// Why a name is not among them.
pub(super) fn unknown(reflects: bool) -> Reason {
    let (message, remedy) = if reflects {
        (
            "no surface has this name",
            "give wavelengths and reflectances, or one of foliage, soil, sand, asphalt, concrete, gravel, \
             tile, shingle, wood, bark, dry_leaves, metal, char, red_paint, yellow_paint, blue_paint, \
             white_paint",
        )
    } else {
        ("no light has this name", "give wavelengths and values, or one of sun, sunlight")
    };
    Reason::Impossible(1, message, remedy)
}

fn table(reflects: bool) -> &'static str {
    if reflects { SURFACES } else { SUNS }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_complete_and_rise() {
        for (reflects, n_columns, n_rows) in [(true, 17, 124), (false, 2, 200)] {
            let names: Vec<&str> =
                table(reflects).lines().next().unwrap().split(',').skip(1).collect();
            assert_eq!(names.len(), n_columns);
            let Reason::Impossible(_, _, remedy) = unknown(reflects) else { panic!("a remedy") };
            assert!(remedy.ends_with(&names.join(", ")), "{remedy}");
            for name in names {
                let samples = samples(name.as_bytes(), reflects).unwrap();
                assert_eq!(samples.len(), n_rows, "{name}");
                assert!(samples.is_sorted_by(|a, b| a[0] < b[0]), "{name}");
                assert!(samples.iter().all(|[_, value]| *value >= 0.0), "{name}");
                assert!(!reflects || samples.iter().all(|[_, value]| *value <= 1.0), "{name}");
            }
        }
        assert_eq!(samples(b"nm", true), None);
    }
}
