//! Figures as SVG.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::{Element, Figure, Gradient, Pane, Point, Rgb, SEAM_WIDTH, Text, number, seams, texts};
use crate::svg::{document, escaped};
use crate::{Metadata, typeface};

/// The figure as an SVG file, one pixel per user unit.
pub fn svg(figure: &Figure<Gradient>, metadata: &Metadata) -> Vec<u8> {
    let mut out = String::new();
    if let Some(background) = figure.background {
        out += &format!("<rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n", hex(background));
    }
    let mut font = String::new();
    if texts(figure).next().is_some() {
        out += &font_face();
        let family = typeface::FAMILY;
        // A line may begin with a space.
        font = format!(" font-family=\"{family}, Verdana, sans-serif\" xml:space=\"preserve\"");
    }
    out += &format!("<g fill-rule=\"evenodd\" stroke-width=\"{SEAM_WIDTH}\"{font}>\n");
    let seams = seams(figure.elements.iter().map(|element| match element {
        Element::Area { contours, is_inside: false, .. } => Some(&contours[..]),
        Element::Smooth(gradient) if !gradient.is_inside => Some(&gradient.contours[..]),
        _ => None,
    }));
    let mut n_gradients = 0;
    for (element, seams) in figure.elements.iter().zip(seams) {
        match element {
            Element::Area { contours, color, .. } => out += &area(contours, &seams, &hex(*color)),
            Element::Smooth(Gradient { contours, ends: [a, b], colors, .. }) => {
                let ([x1, y1], [x2, y2]) = (a.map(number), b.map(number));
                let [from, to] = colors.map(hex);
                out += &format!(
                    "<linearGradient id=\"g{n_gradients}\" gradientUnits=\"userSpaceOnUse\" \
                     x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"><stop stop-color=\"{from}\"/>\
                     <stop offset=\"1\" stop-color=\"{to}\"/></linearGradient>"
                );
                out += &area(contours, &seams, &format!("url(#g{n_gradients})"));
                n_gradients += 1;
            }
            Element::Line { ends, width, color } => {
                let (path, width) = (lines(&[*ends]), number(*width));
                out += &format!(
                    "<path stroke=\"{}\" stroke-width=\"{width}\" d=\"{path}\"/>\n",
                    hex(*color)
                );
            }
            Element::Text(text) => out += &text_element(text),
            Element::Pane(Some(Pane { corner: [left, top], size: [width, height] })) => {
                out += &format!(
                    "<clipPath id=\"c\"><path d=\"M0 0H{width}V{height}H0z\"/></clipPath>"
                );
                let moved = match (left, top) {
                    (0, 0) => String::new(),
                    _ => format!(" transform=\"translate({left} {top})\""),
                };
                out += &format!("<g clip-path=\"url(#c)\"{moved}>\n");
            }
            Element::Pane(None) => out += "</g>\n",
        }
    }
    out += "</g>\n";
    document(figure.size, metadata, &out)
}

/// The embedded font as a style sheet, so that viewers need not have it.
fn font_face() -> String {
    format!(
        "<style>@font-face{{font-family:\"{}\";src:url(data:font/ttf;base64,{})}}</style>\n",
        typeface::FAMILY,
        STANDARD.encode(typeface::FILE)
    )
}

/// A line of text. Viewers apply the kerning of the font, as [`Text::places`] do.
fn text_element(Text { text, origin, size, color, is_slanted, .. }: &Text) -> String {
    let ([x, y], size) = (origin.map(number), number(*size));
    format!(
        "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\"{} fill=\"{}\">{}</text>\n",
        if *is_slanted { " font-style=\"oblique\"" } else { "" },
        hex(*color),
        escaped(text)
    )
}

/// An area, and the lines that extend it along shared edges.
fn area(contours: &[Vec<Point>], seams: &[[Point; 2]], paint: &str) -> String {
    let path = outline(contours);
    let mut text = format!("<path fill=\"{paint}\" d=\"{}\"/>", path);
    if !seams.is_empty() {
        text += &format!("<path stroke=\"{paint}\" d=\"{}\"/>", lines(seams));
    }
    text.push('\n');
    text
}

fn outline(contours: &[Vec<Point>]) -> String {
    let contour = |contour: &Vec<Point>| {
        let points: Vec<String> = contour.iter().map(|point| point.map(number).join(" ")).collect();
        format!("M{}z", points.join("L"))
    };
    contours.iter().map(contour).collect()
}

fn lines(lines: &[[Point; 2]]) -> String {
    let line = |[a, b]: &[Point; 2]| {
        let ([ax, ay], [bx, by]) = (a.map(number), b.map(number));
        format!("M{ax} {ay}L{bx} {by}")
    };
    lines.iter().map(line).collect()
}

/// A colour in three or six hexadecimal digits.
fn hex([red, green, blue]: Rgb) -> String {
    if [red, green, blue].iter().all(|level| level % 17 == 0) {
        format!("#{:x}{:x}{:x}", red / 17, green / 17, blue / 17)
    } else {
        format!("#{red:02x}{green:02x}{blue:02x}")
    }
}
