//! The colour of a face.

use crate::language::{check, check_error, check_rest};

const FACE: &str = "v a 0 0 0; v b 1 0 0; v c 0 1 0; ";

/// Checks the output of a text with two colours, behind these.
#[track_caller]
fn row(text: &str, expected: &[&str]) {
    let text = format!("c r 1 0; c g 1 120; {}", text.replace("FACE", FACE));
    check_rest(&text, &[&["c r 1 0 1;", "c g 1 120 1;"], expected].concat());
}

#[test]
fn own_color_overrides_instance_overrides_unnamed() {
    row("FACE f (a b c);", &["f (a b c);"]);
    row("FACE f (a b c) r;", &["f (a b c) r;"]);
    row(
        "FACE f (a b c); c .5; f (a b c); c .25; f (a b c); f (a b c) r; w (a b);",
        &[
            "c unnamed#2 0.5;",
            "c unnamed#3 0.25;",
            "f (a b c);",
            "f (a b c) unnamed#2;",
            "f (a b c) unnamed#3;",
            "f (a b c) r;",
            "w (a b) unnamed#3;",
        ],
    );
    let def = "def d; FACE f (a b c); f (a b c) g; w (a b); end; ";
    let row_of = |text: &str, first: &[&str], color: &str| {
        let [face, wire] = [format!("f (d:a d:b d:c){color};"), format!("w (d:a d:b){color};")];
        row(text, &[first, &[&face, "f (d:a d:b d:c) g;", &wire]].concat());
    };
    row_of(&format!("{def} i (d);"), &[], "");
    row_of(&format!("{def} i (d r);"), &[], " r");
    // The unnamed colour in effect where the face is written, not where it is placed.
    row_of(&format!("{def} c .5; i (d);"), &["c unnamed#2 0.5;"], "");
    row_of(&format!("c .5; {def} i (d);"), &["c unnamed#2 0.5;"], " unnamed#2");
    row_of(&format!("c .5; {def} i (d r);"), &["c unnamed#2 0.5;"], " r");
    row_of(
        "def d; c .5; FACE f (a b c); f (a b c) g; w (a b); end; i (d);",
        &["c d:unnamed#2 0.5;"],
        " d:unnamed#2",
    );
}

#[test]
fn the_innermost_instance_with_a_color_applies() {
    let text = format!(
        "c r 1 0; c g 1 120; def d; {FACE} f (a b c); end; def e; i (d); i x (d g); end; i (e r); a y (e) 1;"
    );
    check_rest(
        &text,
        &[
            "c r 1 0 1;",
            "c g 1 120 1;",
            "f (e:d:a e:d:b e:d:c) r;",
            "f (e:x:a e:x:b e:x:c) g;",
            "f (y#0:d:a y#0:d:b y#0:d:c);",
            "f (y#0:x:a y#0:x:b y#0:x:c) g;",
        ],
    );
}

#[test]
fn vertices_and_lights_have_only_their_own() {
    let text = "c r 1 0; c .5; def d; v a 0 0 0; v b 0 0 0 r; l 1; l 1 r; end; i (d r);";
    let out = crate::language::flat(text);
    for line in ["v d:a 0 0 0;", "v d:b 0 0 0 r;", "l 1;", "l 1 r;"] {
        assert!(out.lines().any(|other| other == line), "{line}\n{out}");
    }
}

#[test]
fn names_of_colors() {
    // A colour may be used before it is defined, but not defined twice in one scope.
    check_rest(&format!("{FACE} f (a b c) late; c late 1;"), &["c late 1;", "f (a b c) late;"]);
    check_error("c a 1; c_rgb a 1 1 1;", "colour `a` is defined twice");
    // An inner scope shadows the outer one, and its colours get its name as a prefix.
    check_rest(
        &format!("c x 1; def d; c x .5; {FACE} f (a b c) x; end; {FACE} f (a b c) x; i (d);"),
        &["c x 1;", "c d:x 0.5;", "f (a b c) x;", "f (d:a d:b d:c) d:x;"],
    );
    // Colours of a definition are not visible outside.
    check_error(&format!("def d; c x .5; end; {FACE} f (a b c) x;"), "colour `x` is not defined");
    // Generated names never replace names in the text.
    check_rest("c .5; c unnamed#0 1;", &["c unnamed#0 0.5;", "c unnamed#0_2 1;"]);
    check_rest("c d:x 1; def d; c x .5; end;", &["c d:x 1;", "c d:x_2 0.5;"]);
}

#[test]
fn colours_may_be_physical() {
    check("c_xyz x 0.95 1 -1.09;", &["c_xyz x 0.95 1 -1.09;"]);
    check("c_xyz x 9 1 1 .5;", &["c_xyz x 9 1 1 0.5;"]);
    check("c_bb sun 5772; c_bb dim 300 0;", &["c_bb sun 5772;", "c_bb dim 300 0;"]);
    check(
        "c_mix m a .25 b .75; c a 1 0 1; c b 1 240 1; c m .5 300 1;",
        &["c a 1 0 1;", "c b 1 240 1;", "c m 0.5 300 1;", "c_mix m a 0.25 b 0.75;"],
    );
    check(
        "c a 1; def d; c m .5; c_mix m a 1; c_mix a m .5 a .5; v p 0 0 0 m; end; i (d);",
        &["c a 1;", "c d:m 0.5;", "c_mix a d:m 0.5 a 0.5;", "c_mix d:m a 1;", "v d:p 0 0 0 d:m;"],
    );
    check("c_spd s 380 0 555 1.5;c_spd t 589 1;", &["c_spd s 380 0 555 1.5;", "c_spd t 589 1;"]);
    check("c_refl s 400 0 700 .5;", &["c_refl s 400 0 700 0.5;"]);
    // Samples of all scopes share a table.
    check(
        "def d; c_spd s 1 2 3 4; v a 0 0 0 s; end; c_spd s 5 6; i (d); v b 0 0 0 s;",
        &["c_spd s 5 6;", "c_spd d:s 1 2 3 4;", "v b 0 0 0 s;", "v d:a 0 0 0 d:s;"],
    );
    for (text, message) in [
        ("c_xyz x 1 1;", "expected a number, found `;`"),
        ("c_bb x 0;", "the number `0` is out of range"),
        ("c_bb x 300 -1;", "the number `-1` is out of range"),
        ("c_spd x;", "no light has this name"),
        ("c_refl x;", "no surface has this name"),
        ("c_refl x oak;", "no surface has this name"),
        ("c_refl x 400;", "expected a number, found `;`"),
        ("c_mix;", "expected a name that begins with a letter, `:`, `_` or `#`, found `;`"),
        ("c_mix x;", "expected a name that begins with a letter, `:`, `_` or `#`, found `;`"),
        ("c_mix x y;", "expected a number, found `;`"),
        ("c_mix x y 1.5;", "the number `1.5` is out of range"),
        ("c x 1; c_mix x y 1;", "colour `y` is not defined"),
        ("c y 1; c_mix x y 1;", "colour `x` is not defined"),
        ("c y 1; c x 1; c_mix x y 1; c_mix x y .5;", "colour `x` is mixed twice"),
        ("c_spd x 400;", "expected a number, found `;`"),
        ("c_spd x 400 1 400 2;", "the number `400` is out of range"),
        ("c_spd x 400 -1;", "the number `-1` is out of range"),
    ] {
        check_error(text, message);
    }
}

/// Known spectra are written in full, and have the colours that measured ones have.
#[test]
fn surfaces_and_lights_have_names() {
    let scene = crate::language::parse_with(
        "c_refl wood; c_refl leaf foliage; c_spd sun; c_spd noon sunlight;",
        false,
    )
    .scene;
    let names: Vec<&str> = scene.colors.iter().map(|color| scene.names.get(color.name)).collect();
    assert_eq!(names, ["wood", "leaf", "sun", "noon"]);
    let sample = |color: usize, nm: f64| {
        let ugscene::ColorValue::Spectrum { start, end, .. } = scene.colors[color].value else {
            panic!("a spectrum")
        };
        let samples = &scene.samples[start as usize..end as usize];
        samples.iter().find(|[at, _]| *at == nm).unwrap()[1]
    };
    // The red edge of leaves; water vapour takes light of the sun on its way.
    assert!(sample(1, 800.0) > 10.0 * sample(1, 650.0));
    assert!(sample(3, 1400.0) < 0.1 * sample(2, 1400.0));
    let emits: Vec<bool> = scene.colors.iter().map(|color| color.value.emits()).collect();
    assert_eq!(emits, [false, false, true, true]);
}

/// The warnings of a scene, as a person sees them.
fn warnings(text: &str) -> String {
    crate::language::parse_with(text, false).warnings.render(false)
}

#[test]
fn red_green_and_blue_in_a_statement_of_lightness_and_hue_are_noticed() {
    assert_eq!(
        warnings("c red 1 0 0;"),
        "warning: colour `red` is white, not red, green and blue
 --> test.ug:1:3
  |
1 | c red 1 0 0;
  |   ^^^ lightness 1, hue 0, saturation 0
  |
help: for red 1, green 0, blue 0 write `c_rgb red 1 0 0`"
    );
    assert_eq!(
        warnings("c wood .6 30 .5;\nc yellow 255 128 0 ;\nc green 0 1 0; c Blue2 0 0 1;"),
        "warning: colour `yellow` is white, not red, green and blue; 2 other colours look the same
 --> test.ug:2:3
  |
2 | c yellow 255 128 0 ;
  |   ^^^^^^ lightness 255, hue 128, saturation 0
  |
help: for red 1, green 0.502, blue 0 write `c_rgb yellow 1 0.502 0`"
    );
    let noticed = "c red 255 0 0 | c green 0 1 0 | c green 0 255 0 | c blue 0 0 1 | c yellow 1 1 0 | c orange 1 .5 0 \
        | c cyan 0 1 1 | c magenta 1 0 1 | c white 1 1 1 | c grey .5 .5 .5 | c wall 200 180 0 \
        | def d; c red 1 0 0; end";
    // The last is written by a program, which read it with the warning.
    let plain = "c red 1 0 1 | c red .9 0 .8 | c red .9 5 .75 | c red 1 | c red 1 0 | c blue 1 240 1 | c white .95 45 .12 \
        | c white 1 0 0 | c black 0 0 0 | c grey .6 | c sun 20 0 0 | c sun 20 | c lamp 3 60 .5 | c wall 1 0 0 | c 1 0 0 \
        | c red 1 780 1 | c_rgb red 0 1 0 | (ugstage 1 colors as-seen hues law report) c red 1 0 0";
    for (all, expected) in [(noticed, true), (plain, false)] {
        for text in all.split(" | ") {
            assert_eq!(!warnings(&format!("{text};")).is_empty(), expected, "{text}");
        }
    }
}

#[test]
fn tables_of_own_times_are_kept() {
    let table = "c_time t -step -period 3 0 r 1.5 g;";
    row(&format!("{table} FACE f (a b c) t;"), &[table, "f (a b c) t;"]);
    // A colour may be defined after the table that uses it, and rows may share one.
    let table = "c_time t -2 g 0 g;";
    row(&format!("FACE f (a b c) t; {table}"), &[table, "f (a b c) t;"]);
}
