//! Numbers, letters and lines on pictures.

use glam::DVec3;
use ugimage::figure::{Point, Text};
use ugimage::label::number::{list_or_range, significant, speed};
use ugimage::label::{ASCENT, DESCENT, Drawing, Line, Shape, wrapped};
use ugimage::{Frame, LinearFrame};
use ugphysics::Velocity;

/// The outlines of the letters of a line.
fn outlines(text: &str, size: f64, origin: Point) -> Vec<Vec<Point>> {
    let mut drawing = Drawing::default();
    drawing.text(&Line::new(text, size).unwrap(), origin, [0; 3]);
    let contours = |shape: &Shape| match shape.outlined().into_owned() {
        Shape::Area { contours, .. } => contours,
        shape => panic!("{shape:?}"),
    };
    drawing.shapes.iter().flat_map(contours).collect()
}

#[test]
fn numbers_are_short_and_right() {
    let rows = [
        (0.0, "0"),
        (1.0, "1"),
        (2.294_157, "2.294"),
        (22.366, "22.37"),
        (0.5, "0.5"),
        (-0.05, "−0.05"),
        (123_456.0, "123456"),
        (7_088_812.0, "7.089×10⁶"),
        (0.000_012_34, "1.234×10⁻⁵"),
        (9.9999, "10"),
    ];
    for (number, text) in rows {
        assert_eq!(significant(number, 4), text);
    }
}

#[test]
fn speeds_are_distinguished_from_the_speed_of_light() {
    let rows = [
        (0.0, "0"),
        (0.3, "0.3"),
        (0.95, "0.95"),
        (0.999, "0.999"),
        (0.9999, "0.9999"),
        (11.0 / 13.0, "0.846"),
        (1e-4, "1×10⁻⁴"),
    ];
    for (beta, text) in rows {
        assert_eq!(speed(Velocity::from_beta(DVec3::new(0.0, beta, 0.0)).unwrap()), text);
    }
    assert_eq!(speed(Velocity::from_rapidity(DVec3::X, libm::acosh(1e7)).unwrap()), "1 − 5×10⁻¹⁵");
}

#[test]
fn more_than_three_are_a_range() {
    let of = |texts: &[&str]| list_or_range(texts.iter().map(|&text| text.to_owned()).collect());
    assert_eq!(of(&["0.5"]), "0.5");
    assert_eq!(of(&["0.5", "0.5", "0.9"]), "0.5, 0.9");
    assert_eq!(of(&["0", "0.3", "0.5", "0.9"]), "0 – 0.9");
}

#[test]
fn wrapped_lines_fit_and_keep_all_words() {
    let text = "A ship passes at 0.9c, seen where it was when its light was sent; \
                unbreakableunbreakableunbreakableunbreakable ends.\n\nNew paragraph.\n";
    let whole: usize = text.chars().filter(|c| !c.is_whitespace()).count();
    for width in [60.0, 100.0, 250.0, 5000.0] {
        let lines = wrapped(text, 12.0, width).unwrap();
        assert!(lines.iter().all(|line| line.width() <= width));
        let n_glyphs =
            |line: &Line| line.at([0.0; 2], [0; 3]).map(|run| run.places.len()).sum::<usize>();
        let glyphs: usize = lines.iter().map(n_glyphs).sum();
        // At least, because spaces within lines also count.
        assert!(glyphs >= whole, "{width}");
        assert!(lines.iter().any(|line| n_glyphs(line) == 0), "the empty line stays");
    }
    assert_eq!(wrapped(text, 12.0, 5000.0).unwrap().len(), 3);
}

#[test]
fn width_is_proportional_to_size_and_pairs_are_kerned() {
    let width = |text: &str, size: f64| Line::new(text, size).unwrap().width();
    assert!((width("λ → λ/D", 30.0) - 3.0 * width("λ → λ/D", 10.0)).abs() < 1e-9);
    assert!(width("AV", 100.0) < width("A", 100.0) + width("V", 100.0) - 1.0);
}

#[test]
fn symbols_are_slanted_and_words_and_units_upright() {
    let slanted = |text: &str| {
        let line = Line::new(text, 10.0).unwrap();
        let runs: Vec<Text> = line.at([3.0, 0.0], [0; 3]).collect();
        let whole: String = runs.iter().map(|run| &run.text[..]).collect();
        assert_eq!(whole, text);
        // Each run begins where a line of what is before it and its first character has that.
        for (idx, run) in runs.iter().enumerate() {
            let before: String = runs[..idx].iter().map(|run| &run.text[..]).collect();
            let kerned = before.clone() + &run.text[..run.text.chars().next().unwrap().len_utf8()];
            let start = Line::new(&kerned, 10.0).unwrap().width()
                - Line::new(&run.text[..kerned.len() - before.len()], 10.0).unwrap().width();
            assert!((run.origin[0] - 3.0 - start).abs() < 1e-9, "{text}");
        }
        runs.into_iter().filter(|run| run.is_slanted).map(|run| run.text).collect::<String>()
    };
    let rows = [
        ("β = 0.9,  γ = 2.29", "βγ"),
        ("D = 0.3 – 2,  τ = 3 s", "Dτ"),
        ("v = 300 km/s", "v"),
        ("x = −3 m", "x"),
        ("speed β", "β"),
        ("t≈4", "t"),
        ("Doppler factor D", "D"),
        ("", ""),
        ("vitamin D at t", ""),
        ("γ-rays, αβγ, 2λ", "γ"),
        ("D1 = 2", ""),
    ];
    for (text, symbols) in rows {
        assert_eq!(slanted(text), symbols, "{text}");
    }
}

#[test]
fn letters_stay_within_ascent_and_descent() {
    for text in ["Éßgjpqy|ﬁ", "(γ = 2,29)²", "ÀÂÅ Ωβ∫"] {
        let rows = outlines(text, 100.0, [0.0; 2]).into_iter().flatten().map(|place| place[1]);
        // Accents on capitals reach higher than ASCENT.
        assert!(
            rows.into_iter().all(|row| (-100.0 * (ASCENT + 0.2)..=100.0 * DESCENT).contains(&row)),
            "{text}"
        );
    }
}

#[test]
fn the_font_has_the_common_characters() {
    for character in (' '..='~')
        .chain('\u{a0}'..='ÿ')
        .chain('α'..='ω')
        .chain("βγλν×°−→⟵←↑↓≈≤≥⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺₀₁₂₃′″–—‘’“”…√∞⊙⊗".chars())
    {
        // The long arrow is not among the characters of the subset font.
        assert_eq!(
            Line::new(&character.to_string(), 10.0).is_ok(),
            character != '⟵',
            "{character}"
        );
    }
}

#[test]
fn errors_name_the_code_point_of_missing_characters() {
    let missing = Line::new("漢", 10.0).err().unwrap();
    assert!(missing.to_string().starts_with("the font has no `漢` (U+6F22); it has"), "{missing}");
}

/// Vector figures are filled by the even-odd rule, but fonts are designed for the nonzero
/// winding rule. Both agree if no outlines overlap.
#[test]
fn no_glyph_has_outlines_that_overlap() {
    let characters = (' '..='\u{ffff}').map(|character| character.to_string());
    let characters: Vec<_> = characters.filter(|text| Line::new(text, 200.0).is_ok()).collect();
    assert!(characters.len() > 200);
    for character in characters {
        let contours = outlines(&character, 200.0, [0.0, 200.0]);
        for row in (0..300).step_by(4) {
            for column in (0..300).step_by(5) {
                let place = [f64::from(column) + 0.37 - 40.0, f64::from(row) + 0.41];
                let winding = winding(&contours, place);
                assert!(winding == 0 || winding.abs() == 1, "{character} {winding}");
            }
        }
    }
}

fn winding(contours: &[Vec<Point>], [x, y]: Point) -> i32 {
    let edges =
        contours.iter().flat_map(|contour| contour.iter().zip(contour.iter().cycle().skip(1)));
    edges
        .filter(|(a, b)| (a[1] <= y) != (b[1] <= y))
        .filter(|(a, b)| a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) > x)
        .map(|(a, b)| if a[1] < b[1] { 1 } else { -1 })
        .sum()
}

fn rectangle(left: f64, top: f64, right: f64, bottom: f64) -> Drawing {
    let mut drawing = Drawing::default();
    drawing.rectangle([left, top], [right, bottom], [255, 128, 0]);
    drawing
}

#[test]
fn covered_pixels_are_exact_and_others_unchanged() {
    let mut frame = Frame::opaque(600, 300);
    frame.pixels_mut().fill([9, 8, 7, 255]);
    rectangle(250.0, 200.0, 530.0, 280.0).paint(&mut frame);
    for y in 0..300 {
        for x in 0..600 {
            let is_inside = (250..530).contains(&x) && (200..280).contains(&y);
            let expected = if is_inside { [255, 128, 0, 255] } else { [9, 8, 7, 255] };
            assert_eq!(frame.pixel(x, y), expected, "{x} {y}");
        }
    }
}

#[test]
fn partly_covered_pixels_are_blended() {
    let mut frame = Frame::opaque(3, 1);
    let mut drawing = Drawing::default();
    drawing.rectangle([0.5, 0.0], [1.25, 1.0], [255; 3]);
    drawing.paint(&mut frame);
    for (x, part) in [(0, 0.5), (1, 0.25), (2, 0.0)] {
        assert!((f64::from(frame.pixel(x, 0)[0]) - 255.0 * part).abs() <= 1.0, "{x}");
    }
}

/// Letters are equally bold on black and on white.
#[test]
fn black_on_white_is_white_on_black() {
    let mut frames = [Frame::opaque(60, 20), Frame::opaque(60, 20)];
    frames[1].pixels_mut().fill([255; 4]);
    for (frame, ink) in frames.iter_mut().zip([[255; 3], [0; 3]]) {
        let mut drawing = Drawing::default();
        drawing.text(&Line::new("γ = 2.29", 12.0).unwrap(), [2.0, 14.0], ink);
        drawing.paint(frame);
    }
    let [black, white] = &frames;
    for (light, dark) in black.pixels().iter().zip(white.pixels()) {
        // The results may be rounded in opposite directions.
        assert!(light[0].abs_diff(255 - dark[0]) <= 1, "{light:?} {dark:?}");
    }
}

#[test]
fn ink_keeps_its_colour_on_a_transparent_frame() {
    let mut frame = Frame::clear(2, 1);
    rectangle(0.0, 0.0, 1.5, 1.0).paint(&mut frame);
    assert_eq!(frame.pixel(0, 0), [255, 128, 0, 255]);
    let [red, green, blue, alpha] = frame.pixel(1, 0);
    assert_eq!([red, green, blue], [255, 128, 0]);
    assert!(alpha.abs_diff(128) <= 1, "{alpha}");
}

/// Overlapping lines of any direction are covered as their union.
#[test]
fn crossing_lines_are_covered_as_a_union() {
    let mut frame = Frame::opaque(20, 20);
    let mut drawing = Drawing::default();
    let lines =
        vec![[[10.0, 2.0], [10.0, 18.0]], [[18.0, 10.0], [2.0, 10.0]], [[10.0, 18.0], [10.0, 9.0]]];
    drawing.lines(lines, 4.0, [255; 3]);
    drawing.paint(&mut frame);
    assert_eq!(frame.pixel(10, 10), [255; 4]);
    assert_eq!(frame.pixel(9, 12), [255; 4]);
    assert_eq!(frame.pixel(4, 4), [0, 0, 0, 255]);
}

#[test]
fn light_is_blended_in_display_encoding() {
    let mut drawing = rectangle(0.3, 0.2, 3.7, 2.6);
    drawing.text(&Line::new("β", 4.0).unwrap(), [0.2, 3.1], [0, 40, 90]);
    for mut frame in [Frame::opaque(5, 4), Frame::clear(5, 4)] {
        let mut light = LinearFrame::from(&frame);
        drawing.paint(&mut frame);
        drawing.paint_light(&mut light);
        for (ours, theirs) in frame.pixels().iter().zip(light.to_display().pixels()) {
            // Bytes are rounded after each shape.
            assert!(
                ours.iter().zip(theirs).all(|(a, b)| a.abs_diff(*b) <= 2),
                "{ours:?} {theirs:?}"
            );
        }
    }
}

#[test]
fn huge_and_nan_coordinates_are_harmless() {
    let mut drawing = rectangle(-1e300, -1e300, 1e300, 1e300);
    drawing.rectangle([f64::NAN, 0.0], [3.0, 3.0], [1, 2, 3]);
    drawing.lines(
        vec![[[1.0, 1.0], [1.0, 1.0]], [[f64::INFINITY, 0.0], [0.0, 0.0]]],
        2.0,
        [1, 2, 3],
    );
    let mut frame = Frame::opaque(4, 4);
    drawing.paint(&mut frame);
    assert_eq!(frame.pixel(2, 2), [255, 128, 0, 255]);
}
