//! `docs/physics/avenue.csv`: what measured spectra change in `scenes/avenue.ug`.

use uglight::SpectralColor;
use ugphysics::Velocity;
use ugphysics::spectrum::Spectrum;

/// CIE L*a*b*, relative to a white.
fn lab(xyz: [f64; 3], white: [f64; 3]) -> [f64; 3] {
    let root =
        |t: f64| if t > 216.0 / 24389.0 { libm::cbrt(t) } else { t * 841.0 / 108.0 + 4.0 / 29.0 };
    let [x, y, z] = [0, 1, 2].map(|at| root(xyz[at] / white[at]));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[test]
fn measured_spectra_change_surfaces_as_the_table_says() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let read = |path: &str| std::fs::read_to_string(format!("{root}/{path}")).unwrap();
    let source = ugparse::Source::new("avenue.ug", read("scenes/avenue.ug"));
    let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
    let (table, mut n_rows) = (read("docs/physics/avenue.csv"), 0);
    let white = Spectrum::from_linear_srgb([1.0; 3]);
    for (row, color) in scene.colors.iter().enumerate() {
        let measured = SpectralColor::new(&scene, Some(ugscene::ColorId::from_index(row)));
        let (measured, name) = (measured.spectrum(), scene.names.get(color.name));
        // Lines are painted as walls are.
        if !measured.is_surface() || name == "line" {
            continue;
        }
        let guessed = Spectrum::from_xyz(measured.shifted(1.0)).0;
        let mut expected = name.to_owned();
        for speed in [0.5, 0.9] {
            let ahead = Velocity::from_beta(glam::DVec3::X * speed).unwrap();
            let doppler = ahead.gamma() * (1.0 + speed);
            let [seen, other, white] =
                [measured, &guessed, &white].map(|part| part.shifted(doppler));
            let [one, two] = [lab(seen, white), lab(other, white)];
            let difference =
                (0..3).map(|at| (one[at] - two[at]) * (one[at] - two[at])).sum::<f64>().sqrt();
            expected += &format!(",{:.2},{difference:.0}", seen[1] / other[1]);
        }
        assert!(table.lines().any(|line| line == expected), "not in avenue.csv: {expected}");
        n_rows += 1;
    }
    assert_eq!(n_rows, 9);
}

/// A grey and one with a little less red and blue; a measured roof and its colour at rest. At D =
/// 1.3 they were 38 and 50 apart while the reflectance of a colour had a notch in deep red. The
/// roof still differs by its infrared, which is darker than that of other surfaces of its colour.
#[test]
fn colours_that_are_alike_at_rest_look_alike_in_motion() {
    let text = "c_rgb grey .7354 .7354 .7354; c_rgb greenish .7188 .7354 .7188;
        c_refl metal; c_rgb roof .451 .508 .428;";
    let source = ugparse::Source::new("alike.ug", text);
    let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
    let colors: Vec<_> = (0..4)
        .map(|row| SpectralColor::new(&scene, Some(ugscene::ColorId::from_index(row))))
        .collect();
    let white = Spectrum::from_linear_srgb([1.0; 3]);
    for (doppler, most) in [(1.0, 1.0), (1.1, 3.0), (1.2, 10.0), (1.3, 16.0)] {
        let seen: Vec<_> = colors
            .iter()
            .map(|color| lab(color.spectrum().shifted(doppler), white.shifted(doppler)))
            .collect();
        for (pair, most) in seen.chunks(2).zip([6.0, most]) {
            let apart = (0..3)
                .map(|at| (pair[0][at] - pair[1][at]) * (pair[0][at] - pair[1][at]))
                .sum::<f64>()
                .sqrt();
            assert!(apart < most, "D = {doppler}: {apart}");
        }
    }
}
