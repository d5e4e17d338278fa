//! Properties of parsing and writing, tested with random scenes and random bytes.

use std::fmt::Write;

use proptest::prelude::*;
use proptest::sample::select;
use ugparse::{Options, Parsed, Source};
use ugscene::Scene;

use crate::language::{parse, parse_with, write, written};

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    #[test]
    fn numbers_come_back_to_the_bit(bits in prop::collection::vec(any::<u64>(), 30)) {
        let values: Vec<f64> = bits.into_iter().map(f64::from_bits).filter(|value| value.is_finite()).collect();
        let text: String = values.iter().enumerate().fold(String::new(), |mut text, (idx, value)| {
            // The standard library's formatting is the independent reference.
            writeln!(text, "v a{idx} {value:e} {value} 0;").unwrap();
            text
        });
        let scene = parse(&text);
        let again = parse(write(&scene));
        for (idx, value) in values.iter().enumerate() {
            for scene in [&scene, &again] {
                let position = scene.vertices[idx].position;
                prop_assert_eq!(position.x.to_bits(), value.to_bits());
                prop_assert_eq!(position.y.to_bits(), value.to_bits());
            }
        }
    }

    #[test]
    fn written_numbers_are_the_shortest(bits in any::<u64>()) {
        let value = f64::from_bits(bits);
        prop_assume!(value.is_finite());
        let written = write(&parse(format!("v a {value:e} 0 0;")));
        let word = written.split(' ').nth(2).unwrap();
        prop_assert_eq!(word.parse::<f64>().unwrap().to_bits(), bits);
        let digits = |text: &str| {
            let mantissa = text.split(['e', 'E']).next().unwrap().replace(['-', '.'], "");
            mantissa.trim_matches('0').len()
        };
        prop_assert_eq!(digits(word), digits(&format!("{value:e}")), "{} {:e}", word, value);
    }

    /// The round trip preserves every table, and gives the same text.
    #[test]
    fn scenes_round_trip(text in scene_text()) {
        let first = parse_with(&text, true);
        let out = written(&first);
        let second = parse_with(&out, true);
        prop_assert_eq!(&written(&second), &out);
        let is_kept = |message: &str| ["passed on unread", "not flat"].iter().any(|end| message.ends_with(end));
        prop_assert!(second.warnings.list.iter().all(|warning| is_kept(&warning.message)));
        same(&first, &second)?;
    }

    #[test]
    fn any_words_are_read_or_refused(words in prop::collection::vec(select(WORDS), 0..60)) {
        survives(words.join(" ").as_bytes())?;
        survives(words.concat().as_bytes())?;
    }
}

/// Parses bytes with and without `lax`: the result is a message that can be rendered, or a scene
/// that survives a round trip.
fn survives(bytes: &[u8]) -> Result<(), TestCaseError> {
    for lax in [false, true] {
        match ugparse::parse(&Source::new("any.ug", bytes), &Options { lax, ..Options::default() })
        {
            Ok(parsed) => {
                let out = written(&parsed);
                parsed.warnings.render(true);
                let again = ugparse::parse(
                    &Source::new("out.ug", out.as_bytes()),
                    &Options { lax, ..Options::default() },
                );
                prop_assert_eq!(
                    again.map(|again| written(&again)).map_err(|found| found.to_string()),
                    Ok(out)
                );
            }
            Err(found) => {
                prop_assert!(!found.list.is_empty() && found.list.len() <= ugparse::MAX_ERRORS);
                prop_assert!(!found.render(false).is_empty());
            }
        }
    }
    Ok(())
}

fn surface(scene: &Scene, face: &ugscene::Face) -> Option<(String, [f64; 6])> {
    let surface = scene.surface(face)?;
    let ugscene::SurfaceProperties {
        diffuse,
        specular,
        transmitted,
        refraction,
        exponent,
        absorption,
        ..
    } = *surface;
    let name = scene.names.get(surface.name).to_string();
    Some((name, [diffuse, specular, transmitted, refraction, exponent, absorption]))
}

/// Equal row by row, not only as text.
fn same(first: &Parsed, second: &Parsed) -> Result<(), TestCaseError> {
    let (a, b) = (&first.scene, &second.scene);
    let vertices = |scene: &Scene| -> Vec<String> {
        let row = |v: &ugscene::Vertex| {
            format!("{} {:?} {:?}", scene.names.get(v.name), v.position, v.normal)
        };
        scene.vertices.iter().map(row).collect()
    };
    let faces = |scene: &Scene| -> Vec<String> {
        let row = |f: &ugscene::Face| {
            let contours: Vec<_> = scene.face_contours(f).collect();
            let velocity = scene.bodies.stated_velocity(f.body);
            format!(
                "{:?} {contours:?} {:?} {:?} {velocity:?}",
                f.name.map(|name| scene.names.get(name)),
                f.color,
                (scene.light_level(f), surface(scene, f))
            )
        };
        scene.faces.iter().map(row).collect()
    };
    prop_assert_eq!(vertices(a), vertices(b));
    prop_assert_eq!(faces(a), faces(b));
    let kinds = |scene: &Scene| -> Vec<_> {
        scene.lights.iter().map(|light| (light.intensity, light.kind, light.color)).collect()
    };
    prop_assert_eq!(kinds(a), kinds(b));
    prop_assert_eq!(&first.passed_on.statements, &second.passed_on.statements);
    let n_comments =
        |parsed: &Parsed| parsed.scene.head.comments.len() + parsed.passed_on.comments.len();
    prop_assert_eq!(n_comments(first), n_comments(second));
    let colors =
        |scene: &Scene| -> Vec<_> { scene.colors.iter().map(|color| color.translucency).collect() };
    prop_assert_eq!(colors(a), colors(b));
    Ok(())
}

const WORDS: &[&str] = &[
    "v", "f", "w", "c", "c_rgb", "l", "cam", "i", "a", "def", "end", "surf", "execute", "include",
    "#", "(", ")", "<", ">", ";", ";", ";", "{", "}", "-tx", "-M3", "-ep", "-og", "0", "1", ".5",
    "-1e300", "1e999", "v1", "d", "red", "\n", "\"", "é", "\0",
];

/// Typical and unusual numbers.
fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => (-40..40i32).prop_map(|n| n.to_string()),
        3 => (-1000..1000i32).prop_map(|n| format!("{}", f64::from(n) / 128.0)),
        1 => (-1.0e6..1.0e6f64).prop_map(|x| format!("{x:e}")),
        1 => select(&["-0", ".5", "+1.", "1E2", "-2.5e-3", "1e-320", "0.1"][..]).prop_map(str::to_string),
    ]
}

fn point() -> impl Strategy<Value = String> {
    [number(), number(), number()].prop_map(|point| point.join(" "))
}

fn optional(part: impl Strategy<Value = String>) -> impl Strategy<Value = String> {
    prop::option::of(part).prop_map(Option::unwrap_or_default)
}

fn word(words: &'static [&'static str]) -> impl Strategy<Value = String> {
    select(words).prop_map(str::to_string)
}

fn velocity() -> impl Strategy<Value = String> {
    optional(word(&["<.5 0 0>", "<0 -0.25 .125>", "<0 0 0>", "< 1e-9 0 .9 >", "<-0 0 0>"]))
}

fn color() -> impl Strategy<Value = String> {
    optional(word(&["red", "green", "f"]))
}

fn tforms() -> impl Strategy<Value = String> {
    let one = prop_oneof![
        (word(&["-tx", "-ty", "-tz", "-rx", "-ry", "-rz"]), number())
            .prop_map(|(name, n)| format!("{name} {n}")),
        word(&["-sx 2", "-sy -1", "-sa .375", "-sz 1e-3"]),
        word(&[
            "-mx",
            "-my",
            "-mz",
            "-ma",
            "-mv 1 2 3",
            "-sv 1 1 0 2",
            "-rv 1 1 1 50",
            "-M3 1 0 0 0 2 0 0 1 1"
        ]),
        point().prop_map(|p| format!("-ta {p}")),
    ];
    prop::collection::vec(one, 0..4).prop_map(|tforms| tforms.join(" "))
}

/// Contours over the vertices `v0` … `v7` that every scope has.
fn contours() -> impl Strategy<Value = String> {
    let contour = prop::collection::vec((0..8u8).prop_map(|idx| format!("v{idx}")), 3..7);
    prop::collection::vec(contour.prop_map(|names| format!("({})", names.join(" "))), 1..3)
        .prop_map(|all| all.join(" "))
}

fn statement(placeable: &'static [&'static str]) -> impl Strategy<Value = String> {
    let name = || optional(word(&["x", "car", "a", "f", "#", "b:c"]));
    let share = || word(&["0", "1", ".25"]);
    let call = move || (name(), word(placeable), color(), tforms(), velocity());
    let array = (call(), 0..4u8, tforms());
    prop_oneof![
        8 => (name(), contours(), color(), optional(number()), velocity())
            .prop_map(|(name, c, color, illum, v)| format!("f {name} {c} {color} {illum} {v};")),
        2 => (name(), contours(), word(&["red", "f"]), word(&["shiny", "glass", "f"]), velocity())
            .prop_map(|(name, c, color, surface, v)| format!("f {name} {c} {color} {surface} {v};")),
        2 => (name(), contours(), color(), velocity()).prop_map(|(name, c, color, v)| format!("w {name} {c} {color} {v};")),
        1 => (share(), number()).prop_map(|(l, hue)| format!("c {l} {hue};")),
        1 => [share(), share(), share(), share()].prop_map(|rgb| format!("c_rgb {};", rgb.join(" "))),
        2 => (name(), share(), optional(point().prop_map(|p| format!("{p} 2"))), color(), velocity())
            .prop_map(|(name, i, place, color, v)| format!("l {name} {i} {place} {color} {v};")),
        1 => share().prop_map(|i| format!("l {i} 1 2 -3;")),
        1 => (name(), point(), point(), velocity()).prop_map(|(n, e, c, v)| format!("cam {n} -ep {e} -vc {c} -va 40 30 {v};")),
        4 => call().prop_map(|(name, def, color, t, v)| format!("i {name} ({def} {color} {t}) {v};")),
        3 => array.prop_map(|((name, def, color, t, v), n, step)| format!("a {name} ({def} {color} {t}) {n} {step} {v};")),
        1 => word(&["(escape)", "( (nested) { )", "shine .5 .5 0;", "future { of; } it;"]),
        2 => word(&["{ c }\n", "\n{ above }\n", "{ {x} \n }", "\n", ";", "{}"]),
    ]
}

fn body(placeable: &'static [&'static str]) -> impl Strategy<Value = String> {
    let vertex = (point(), color(), optional(word(&["0 0 1", "1 2 -3", "0 .1 .7"])));
    let vertices = prop::collection::vec(vertex, 8).prop_map(|rows| {
        rows.iter().enumerate().fold(String::new(), |text, (idx, (p, color, normal))| {
            text + &format!("v v{idx} {p} {color} {normal};\n")
        })
    });
    (vertices, prop::collection::vec(statement(placeable), 0..12))
        .prop_map(|(v, rest)| v + &rest.join(" "))
}

/// A scene with statements of all kinds and nested definitions.
fn scene_text() -> impl Strategy<Value = String> {
    (
        body(&["d"]),
        body(&["d", "e"]),
        body(&["d", "e", "g"]),
        optional(word(&["{ head }", "{ two }{ heads }\n"])),
    )
        .prop_map(|(first, second, file, head)| {
            format!(
                "{head} c red 1 0; c_rgb green 0 .5 0 .25; c f .5 200 .5;\n\
                 surf shiny .5 .5 0; surf glass 0 .125 .875 1.5; {{ of f }} surf f 1 0 0 1 60;\n\
                 def d; v only 1 2 3; w (only only); end;\n\
                 def e;\n{first}\nend;\ndef g; c red .25; surf glass 1 1 1;\n{second}\nend; {{ behind g }}\n{file}\n"
            )
        })
}
