//! Figures of small scenes against where their edges are.

use ugimage::Format;
use ugpipe::Words;
use ugrainbow::{Background, Config, Error, Output, run};

use crate::common::{file, from_above, with};

/// Ten pixels per unit, the origin at 40, 40.
fn svg(scene: &str) -> String {
    svg_with(scene, Config::default())
}

fn svg_with(scene: &str, config: Config) -> String {
    let config = with(&config, |picture| {
        (picture.size, picture.output) = ([80, 80], Output::Vector(Format::Svg));
    });
    String::from_utf8(file(&format!("{scene} {}", from_above()), &config)).unwrap()
}

const COLORS: &str = "l 1; c red 1 0; c green 1 120; c blue 1 240;";
const FAR: &str = "v a -3 -3 0; v b 3 -3 0; v c 3 3 0; v d -3 3 0; f far (a b c d) blue;";
const NEAR: &str = "v e -1 -1 1; v f -1 1 1; v g 1 1 1; v h 1 -1 1; f near (e f g h) red;";

/// Above them all; half of the light behind it passes. Its right half is over nothing.
const PANE: &str =
    "c pane 1 0 1 .5; v p -1 -2 2; v q 7 -2 2; v r 7 2 2; v s -1 2 2; f pane (p q r s) pane;";

/// Fill colour, and least and greatest x and y, of every area.
fn areas(svg: &str) -> Vec<(String, [f64; 4])> {
    let paths = svg.split("<path fill=\"").skip(1);
    let area = |path: &str| {
        let (color, rest) = path.split_once('"').unwrap();
        let outline = rest.split("d=\"").nth(1).unwrap().split('"').next().unwrap();
        let numbers: Vec<f64> =
            outline.split(['M', 'L', 'z', ' ']).filter_map(|number| number.parse().ok()).collect();
        let along = |axis: usize| numbers.iter().copied().skip(axis).step_by(2);
        let least = |axis| along(axis).fold(f64::INFINITY, f64::min);
        let greatest = |axis| along(axis).fold(f64::NEG_INFINITY, f64::max);
        (color.to_owned(), [least(0), greatest(0), least(1), greatest(1)])
    };
    paths.map(area).collect()
}

#[test]
fn what_is_nearer_is_painted_later_and_what_is_hidden_not_at_all() {
    let hidden = "v i -2 -2 -1; v j 2 -2 -1; v k 2 2 -1; f hidden (i j k) green;";
    let expected = [
        ("#00f".to_owned(), [10.0, 70.0, 10.0, 70.0]),
        ("#f00".to_owned(), [30.0, 50.0, 30.0, 50.0]),
    ];
    for scene in [[NEAR, FAR, hidden], [hidden, FAR, NEAR], [FAR, hidden, NEAR]] {
        assert_eq!(areas(&svg(&format!("{COLORS}{}", scene.concat()))), expected);
    }
}

#[test]
fn faces_that_cut_each_other_are_cut_there() {
    // Blue is level, and green rises from left to right through it, along x = 0.5.
    let steep = "v i -2 -1 -1; v j 3 -1 1; v k 3 1 1; v l -2 1 -1; f steep (i j k l) green;";
    let found = areas(&svg(&format!("{COLORS}{FAR}{steep}")));
    let last = found.last().unwrap();
    assert_eq!(last, &("#0f0".to_owned(), [45.0, 70.0, 30.0, 50.0]), "{found:?}");
}

#[test]
fn hidden_parts_of_wires_are_left_out() {
    let wire = "c white 1; v p -2 0 .5; v q 2 0 .5; w wire (p q) white;";
    let text = svg(&format!("{COLORS}{FAR}{NEAR}{wire}"));
    let mut lines: Vec<&str> = text
        .lines()
        .filter_map(|line| line.split_once("stroke-width=\"1.2\""))
        .map(|(_, line)| line)
        .collect();
    lines.sort_unstable();
    // It stands out of its ends by half its width, 0.6, and the near face covers it from 30 to 50.
    assert_eq!(lines, [" d=\"M19.4 40L30 40\"/>", " d=\"M50 40L60.6 40\"/>"]);
}

#[test]
fn what_cannot_be_a_figure_is_refused() {
    let source = ugparse::Source::new("test.ug", format!("{COLORS}{FAR}"));
    let refused = |format, size| {
        let config = with(&Config::default(), |picture| {
            (picture.size, picture.output) = (size, Output::Vector(format))
        });
        run(&config, &source).unwrap_err()
    };
    assert!(refused(Format::Png, [8, 8]).words().contains("-vec"));
    assert!(refused(Format::Pdf, [32769, 8]).to_string().contains("32768"));
    let clear = |background| {
        let glass = format!("{COLORS}{PANE} cam -ep 0 0 10 -vc 0 0 0;");
        let output = Output::Vector(Format::Svg);
        let config = with(&Config::default(), |picture| {
            (picture.size, picture.output, picture.background) = ([8, 8], output, background)
        });
        run(&config, &ugparse::Source::new("test.ug", glass))
    };
    assert!(matches!(clear(Background::Transparent).unwrap_err(), Error::FigureBackground));
    assert!(clear(Config::default().picture.background).is_ok());
}

#[test]
fn what_lies_between_seen_faces_and_is_hidden_is_left_out() {
    // It shares two corners with the near face, which is visible at samples, and lies completely
    // behind it.
    let hidden = "v i 0 0 0.5; f hidden (e i h) red;";
    for scene in [[NEAR, FAR, hidden], [hidden, FAR, NEAR]] {
        let found = areas(&svg(&format!("{COLORS}{}", scene.concat())));
        assert_eq!(found.iter().map(|(color, _)| &**color).collect::<Vec<_>>(), ["#00f", "#f00"]);
    }
    // Of a face that stands out a part is seen.
    let tall = "v i 0 -2 0.5; f tall (e i h) red;";
    let found = areas(&svg(&format!("{COLORS}{NEAR}{FAR}{tall}")));
    assert!(found.iter().any(|(_, [.., bottom])| *bottom == 60.0), "{found:?}");
}

/// Half of the light of two colours, encoded, is 188.
#[test]
fn behind_a_pane_all_is_painted_once_more_in_linear_light() {
    let near = NEAR.replace("red", "green");
    let square =
        |color: &str, left, right, top, bottom| (color.to_owned(), [left, right, top, bottom]);
    let expected = [
        square("#00f", 10.0, 70.0, 10.0, 70.0),
        square("#0f0", 30.0, 50.0, 30.0, 50.0),
        // The pane over nothing, over blue, and over green, which hides all the blue behind it.
        square("#bc0000", 30.0, 84.0, 20.0, 60.0),
        square("#bc00bc", 30.0, 70.0, 20.0, 60.0),
        square("#bcbc00", 30.0, 50.0, 30.0, 50.0),
    ];
    for scene in [[PANE, FAR, &near], [&near, PANE, FAR]] {
        assert_eq!(areas(&svg(&format!("{COLORS}{}", scene.concat()))), expected);
    }
    // A pane before the pane, which lets a half through: one quarter of red shines through green.
    let second = PANE.replace("pane", "second").replace("v p", "v p2").replace("v q", "v q2");
    let second =
        second.replace("v r", "v r2").replace("v s", "v s2").replace("(p q r s)", "(p2 q2 r2 s2)");
    let second = second.replace(" 2;", " 3;").replace("1 0 1 .5", "1 120 1 .5");
    let colors: Vec<String> = areas(&svg(&format!("{COLORS}{PANE}{second}")))
        .into_iter()
        .map(|(color, _)| color)
        .collect();
    // Of the pane behind nothing is seen that is not behind the other.
    assert_eq!(colors, ["#bc0000", "#89bc00"]);
}

#[test]
fn lines_behind_panes_have_other_colours_there() {
    let wire = "c white 1; v t -3 0 1; v u 3 0 1; w wire (t u) white;";
    let text = svg(&format!("{COLORS}{PANE}{wire}"));
    let lines: Vec<&str> =
        text.lines().filter(|line| line.contains("stroke-width=\"1.2\"")).collect();
    // From the left to the edge of the pane, and behind it: all of red, and half of green and blue.
    assert_eq!(lines.len(), 2, "{text}");
    assert!(lines[0].contains("stroke=\"#fff\"") && lines[0].contains("L30 40"), "{text}");
    assert!(lines[1].contains("stroke=\"#ffbcbc\"") && lines[1].contains("M30 40"), "{text}");
}

#[test]
fn faces_of_one_colour_beside_each_other_are_one_area() {
    let halves = FAR.replace("f far (a b c d) blue;", "f (a b c) blue; f (a c d) blue;");
    let expected = [("#00f".to_owned(), [10.0, 70.0, 10.0, 70.0])];
    assert_eq!(areas(&svg(&format!("{COLORS}{halves}"))), expected);
    // Not across what is painted between them.
    assert_eq!(areas(&svg(&format!("{COLORS}{halves}{NEAR}"))).len(), 2);
    // Corners of their own, or they would have the mean of both colours.
    let colored = halves.replace("f (a c d) blue;", "v i -3 -3 0; v j 3 3 0; f (i j d) green;");
    assert_eq!(areas(&svg(&format!("{COLORS}{colored}"))).len(), 2);
}

#[test]
fn edges_of_faces_are_lines() {
    let wireframe = Some(ugrainbow::Wireframe {
        has_faces: false,
        color: None,
        ..ugrainbow::Wireframe::default()
    });
    let config = Config { wireframe, line_width: 2.0, ..Config::default() };
    let text = svg_with(&format!("{COLORS}{FAR}{NEAR}"), config);
    assert!(areas(&text).is_empty(), "{text}");
    let lines =
        |color: &str| text.matches(&format!("stroke=\"{color}\" stroke-width=\"2\"")).count();
    assert_eq!((lines("#00f"), lines("#f00")), (4, 4), "{text}");
    // The upper edge of the near face, with half the width at its ends.
    assert!(text.contains("M29 30L51 30") || text.contains("M51 30L29 30"), "{text}");
}

/// On a coarser grid, which has fewer samples.
#[test]
fn many_panes_in_front_of_each_other_are_drawn() {
    let panes =
        "c pane 1 0 1 .5; def panes; v p -9 -9 2; v q 9 -9 2; v r 9 9 2; v s -9 9 2; f (p q r s) pane;
                 end; a (panes) 300 -tz -.001;";
    let svg = svg(&format!("{COLORS} {FAR} {panes}"));
    // The square once, and each pane twice: whole, and blended where the square is behind it.
    assert_eq!(areas(&svg).len(), 601);
}
