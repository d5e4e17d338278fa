//! Vector figures: numbers, seams, and the embedded font.

use base64::Engine;
use ugimage::figure::{self, Element, Figure, Text};
use ugimage::label::Line;
use ugimage::{Compression, Format, Metadata};

use crate::frames;
use crate::postscript::decoded_85;

fn svg(elements: Vec<Element<figure::Gradient>>) -> String {
    let figure = Figure { size: [9, 9], background: None, elements };
    String::from_utf8(figure::svg(&figure, &Metadata::default())).unwrap()
}

#[test]
fn numbers_are_short() {
    for (value, text) in [
        (0.0, "0"),
        (-0.001, "0"),
        (0.5, ".5"),
        (-0.05, "-.05"),
        (12.0, "12"),
        (12.345, "12.35"),
        (-7.1, "-7.1"),
        (1e6, "1000000"),
    ] {
        let found = svg(vec![Element::Line { ends: [[value; 2]; 2], width: 1.0, color: [0; 3] }]);
        assert!(found.contains(&format!("d=\"M{text} {text}L{text} {text}\"")), "{found}");
    }
}

#[test]
fn the_area_painted_first_is_extended_under_the_other() {
    let area = |outline: [[f64; 2]; 4]| Element::Area {
        contours: vec![outline.to_vec()],
        color: [0; 3],
        is_inside: false,
    };
    let left = area([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let right = area([[1.0, 1.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]);
    let line = Element::Line { ends: [[0.0; 2]; 2], width: 1.0, color: [0; 3] };
    let found = svg(vec![left, line, right]);
    assert!(
        found.contains("M0 0L1 0L1 1L0 1z\"/><path stroke=\"#000\" d=\"M1 0L1 1\"/>\n"),
        "{found}"
    );
    assert!(found.contains("M1 1L1 0L2 0L2 1z\"/>\n"), "{found}");
}

/// A PostScript file embeds the font file as strings, each padded by a byte, and states the bounding
/// box of the font.
#[test]
fn the_font_is_embedded() {
    let mut elements = Vec::new();
    let text: Vec<Text> = Line::new("γ", 9.0).unwrap().at([1.0, 8.0], [0; 3]).collect();
    elements.extend(text.into_iter().map(Element::Text));
    let figure = Figure { size: [9, 9], background: None, elements };
    let file = String::from_utf8(figure::eps(&figure, &Metadata::default())).unwrap();
    let fonts = file.split_once("/sfnts [").unwrap().1.split_once("] def").unwrap().0;
    let parts: Vec<_> = fonts
        .split("<~")
        .skip(1)
        .map(|part| decoded_85(part.trim_end().trim_end_matches("~>")))
        .collect();
    assert!(parts.len() > 1 && parts.iter().all(|part| part.len() <= 65_535));
    let whole: Vec<u8> = parts.iter().flat_map(|part| &part[..part.len() - 1]).copied().collect();
    assert!(whole == include_bytes!("../../font/DejaVuSans.ttf"));
    let bounds = file.split_once("/FontBBox [").unwrap().1.split_once(']').unwrap().0;
    let bounds: Vec<f64> = bounds.split(' ').map(|number| number.parse().unwrap()).collect();
    let [left, bottom, right, top] = bounds[..] else { panic!("{bounds:?}") };
    assert!((-2.0..=0.0).contains(&left) && (-1.0..-0.2).contains(&bottom), "{left} {bottom}");
    assert!((1.0..2.0).contains(&right) && (0.9..1.5).contains(&top), "{right} {top}");
}

#[test]
fn the_embedded_picture_is_the_png() {
    for frame in frames() {
        let text = String::from_utf8(Format::Svg.encode(&frame, &Metadata::default())).unwrap();
        let data = text.split("base64,").nth(1).unwrap().split('"').next().unwrap();
        assert_eq!(
            base64::prelude::BASE64_STANDARD.decode(data).unwrap(),
            Format::Png.encode_with(&frame, &Metadata::default(), Compression::Fast)
        );
    }
}

#[test]
fn metadata_is_text() {
    let metadata = Metadata {
        software: "ug 1".into(),
        comment: "a < b > c & \"d\"\nγ\u{1}".into(),
        ..Metadata::default()
    };
    let text = String::from_utf8(Format::Svg.encode(&frames()[0], &metadata)).unwrap();
    assert!(text.contains("<desc>ug 1\na &lt; b &gt; c &amp; \"d\"\nγ?</desc>"), "{text}");
}
