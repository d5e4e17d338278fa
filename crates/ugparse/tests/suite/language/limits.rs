//! Small texts that would expand to huge scenes. Each is refused, or parsed, with little time and
//! memory.

use std::time::{Duration, Instant};

use ugparse::{Limit, Limits, Options, Source};
use ugscene::{Vertex, VertexId};

use crate::language::{TRIANGLE, errors, flat, parse};

/// Far above the need of any row, and far below that of an expanded scene.
const SOON: Duration = Duration::from_secs(20);

#[track_caller]
fn refused(text: impl AsRef<[u8]>, expected: &str) {
    let start = Instant::now();
    let errors = errors(text);
    assert!(
        errors.len() == 1 && errors[0].starts_with(expected),
        "{expected}: {:?}",
        errors.first()
    );
    assert!(start.elapsed() < SOON, "{expected}: {:?}", start.elapsed());
}

#[test]
fn large_arrays_are_refused_before_expansion() {
    let def = "def d; v p 0 0 0; end; ";
    refused(
        format!("{def} a (d) 1000000000;"),
        "the expanded scene would have 2000000001 statements",
    );
    refused(
        format!("{def} a (d) 99999999999999999999999999;"),
        "the expanded scene would have too many statements",
    );
    refused("def d; end; a (d) 1000000000;", "the expanded scene would have 1000000001 statements");
    let nested = format!("{def} def e; a (d) 10000; end; a (e) 10000;");
    refused(nested, "the expanded scene would have");
    // The limit of the chain allows no more than two to the sixtieth.
    let doubling: String = (1..60).fold(def.to_string(), |text, idx| {
        let inner = if idx == 1 { "d".to_string() } else { format!("d{}", idx - 1) };
        text + &format!("def d{idx}; i ({inner}); i ({inner}); end; ")
    });
    refused(doubling + "i (d59);", "the expanded scene would have");
    let corners = "a b c ".repeat(100_000);
    refused(
        format!("def d; {TRIANGLE} f ({corners}); end; a (d) 10000;"),
        "the expanded scene would have 3000000000 corners",
    );
    // Ten thousand million bytes of names.
    let name = "n".repeat(100_000);
    refused(format!("{def} a {name} (d) 100000;"), "the expanded scene would have 10001");
    refused(
        format!("def d; v {name} 0 0 0; end; a (d) 100000;"),
        "the expanded scene would have 10001",
    );
}

#[test]
fn long_chains_are_refused() {
    let chain = |n: usize| {
        let defs: String =
            (1..n).map(|idx| format!("def d{idx}; i (d{}); end;\n", idx - 1)).collect();
        format!("def d0; v p 0 0 0; end;\n{defs}")
    };
    refused(chain(100_000) + "i (d99999);", "the chain of nested instances is too long");
    refused(chain(100_000), "the chain of nested instances is too long");
    // Every level is also placed by itself first, so that its size is already known.
    let calls: String = (0..3000).map(|idx| format!("i (d{idx});\n")).collect();
    refused(chain(3000) + &calls, "the chain of nested instances is too long");
    let deepest = chain(200) + "i (d199);";
    assert_eq!(parse(&deepest).vertices.len(), 1);
    refused(chain(201) + "i (d200);", "the chain of nested instances is too long");
    let circle = chain(100_000).replace("def d0; v p 0 0 0; end;", "def d0; i (d99999); end;");
    refused(circle, "the chain of nested instances is too long");
}

#[test]
fn definitions_nest_64_deep() {
    let nested = |n: usize| {
        format!("{}v p 0 0 0;{}", "def d;".repeat(n), "i (d); end;".repeat(n)).replacen(
            "i (d); end;",
            "end;",
            1,
        )
    };
    assert_eq!(parse(nested(64) + "i (d);").vertices.len(), 1);
    refused(nested(65), "definitions nest too deeply");
    refused(nested(100_000), "definitions nest too deeply");
    refused("def d;".repeat(100_000), "definitions nest too deeply");
}

#[test]
fn deep_comments_and_escapes_are_read() {
    let deep =
        |open: &str, close: &str| format!("{}{}", open.repeat(100_000), close.repeat(100_000));
    assert_eq!(flat(deep("{", "}") + "v p 0 0 0;").lines().count(), 2);
    assert_eq!(flat(format!("v p 0 {} 0 0;", deep("{", "}"))).lines().count(), 2);
    assert_eq!(flat(deep("(", ")")).lines().count(), 1);
    refused("{".repeat(100_000), "this comment is not closed");
    refused("(".repeat(100_000), "this escape is not closed");
    refused(format!("v a 0 0 0 {}", "{".repeat(100_000)), "this comment is not closed");
    refused("f (".repeat(100_000), "expected a vertex name or `)`, found `(`");
}

#[test]
fn long_words_are_read() {
    let digits = "1234567890".repeat(1000);
    refused(
        format!("v a {digits} 0 0;"),
        "the number `1234567890123456789012345678901234567890…` is too large",
    );
    assert_eq!(
        parse(format!("v a 0.{digits} 0 0;")).vertices[0].position.x,
        0.123_456_789_012_345_68
    );
    let zeros = "0".repeat(10_000);
    assert_eq!(
        parse(format!("v a {zeros}7.5{zeros} 0.{zeros}1 1e-{digits};")).vertices[0]
            .position
            .to_array(),
        [7.5, 0.0, 0.0]
    );
    refused(format!("def d; end; a (d) {digits};"), "the expanded scene would have");
    let name = "n".repeat(1_000_000);
    assert_eq!(flat(format!("v {name} 0 0 0;")).len(), 1_000_000 + 10);
    refused(format!("f ({name});"), "vertex `nnnnnnnnnn");
}

#[test]
fn many_bodies_take_little_time() {
    let faces: String = (0..100_000)
        .map(|idx| format!("f (a b c) <{} 0 0>;\n", f64::from(idx) / 100_001.0))
        .collect();
    let start = Instant::now();
    assert_eq!(parse(format!("{TRIANGLE} {faces}")).bodies.len(), 100_001);
    assert!(start.elapsed() < SOON, "{:?}", start.elapsed());
}

#[test]
fn at_most_20_errors_are_listed() {
    let bad = "v 1 0 0 0;\n".repeat(1000);
    assert_eq!(errors(&bad).len(), 20);
    let source = Source::new("bad.ug", format!("f ({});", "nothing ".repeat(1000)));
    let found = ugparse::parse(&source, &Options::default()).unwrap_err();
    assert_eq!((found.list.len(), found.omitted), (20, 980));
    assert!(found.render(false).ends_with("… and 980 more"));
}

#[test]
fn odd_bytes_are_refused_outside_comments() {
    refused(b"\0", "`\0` is not a statement");
    refused(b"v a 0 0 0;\n\xff\xfe", "`\u{fffd}\u{fffd}` is not a statement");
    refused(
        b"v a\xff 0 0 0;",
        "expected a name of letters, digits, `:`, `_` and `#`, found `a\u{fffd}`",
    );
    refused(b"v a \0 0 0;", "expected a number, found `\0`");
    let dash = ugparse::parse(&Source::new("t.ug", "v a 0 0 \u{2212}1;"), &Options::default())
        .unwrap_err();
    assert!(
        dash.render(false).contains("`\u{2212}` (U+2212) is a minus sign of Unicode"),
        "{dash}"
    );
    // Marks of editors before the text, and after it.
    assert_eq!(flat("\u{feff}v a 0 0 0;\n\x1a\r\n".as_bytes()), "v a 0 0 0;\n");
    assert_eq!(flat(b"{\0\xff}v a 0 0 0;"), "{\0\u{fffd}}\nv a 0 0 0;\n");
}

/// The first message about a text with one limit set, and its remedy; `None` if the text is valid.
fn limited(text: &str, limit: Limit, value: u64) -> Option<(String, String)> {
    let options = Options { limits: Limits::default().with(limit, value), ..Options::default() };
    let found = ugparse::parse(&Source::new("test.ug", text), &options).err()?;
    let first = &found.list[0];
    Some((first.message.clone(), first.help.clone().unwrap_or_default()))
}

#[test]
#[rustfmt::skip] // rows of a table
fn every_limit_can_be_set_and_says_so() {
    #[track_caller]
    fn check(text: &str, limit: Limit, enough: u64, message: &str, remedy: &str) {
        assert_eq!(limited(text, limit, enough), None, "{text}");
        let (found, help) = limited(text, limit, enough - 1).unwrap();
        assert_eq!((found.as_str(), help.as_str()), (message, remedy), "{text}");
    }
    check("v a 0 0 0;", Limit::Text, 10, "the scene is too large", "the limit is 9 bytes; split it, or raise it");
    let nested = "def a; def b; v p 0 0 0; end; end;";
    check(nested, Limit::Nesting, 2, "definitions nest too deeply", "the limit is 1 level; use fewer, or raise it");
    let chain = "def a; v p 0 0 0; end; def b; i (a); end; def c; i (b); end; i (c);";
    check(chain, Limit::Chain, 3, "the chain of nested instances is too long", "the limit is 2 levels; use fewer, or raise it");
    let array = "def d; v pp 0 0 0; v qq 1 0 0; w (pp qq); end; a (d) 10;";
    check(array, Limit::Statements, 41, "the expanded scene would have 41 statements", "the limit is 40 statements; use smaller arrays, or raise it");
    check(array, Limit::Corners, 20, "the expanded scene would have 20 corners of faces", "the limit is 19 corners; use smaller arrays, or raise it");
    check(
        "v long 0 0 0; v longer 0 0 0;",
        Limit::Names,
        10,
        "the expanded scene would have 10 bytes of names",
        "the limit is 9 bytes; split the scene, or raise it",
    );
    // Statements with many contours are counted by their contours, and copies by their rows.
    let star = format!("v a 0 0 0; v b 1 0 0; v c 0 1 0; f {};", "(a b c)".repeat(100));
    let stars = |n: u32| format!("def d; {star} end; def e; a (d) {n}; end; a (e) {n};");
    let tables = |text: &str| {
        let (found, _) = limited(text, Limit::Memory, 1).unwrap();
        let count = found.strip_prefix("the expanded scene would have ").unwrap();
        count.strip_suffix(" bytes in its tables").unwrap().parse::<u64>().unwrap()
    };
    let one = tables(&stars(1));
    let least = 100 * (3 * size_of::<VertexId>() + size_of::<u32>()) + 3 * size_of::<Vertex>();
    assert!((least as u64..2 * least as u64).contains(&one), "{one}");
    assert!((95 * one..130 * one).contains(&tables(&stars(10))), "{one} {}", tables(&stars(10)));
    let points: String = (0..100).map(|idx| format!("v p{idx} 0 0 0;")).collect();
    let clouds = format!("def d; {points} end; def e; a (d) 490; end; a (e) 490;");
    let (found, help) = limited(&clouds, Limit::Memory, Limit::Memory.default_value()).unwrap();
    assert!(found.ends_with(" bytes in its tables"), "{found}");
    assert_eq!(help, "the limit is 2147483648 bytes; use smaller arrays, or raise it");
    let (_, help) = limited("v a 0 0 0;", Limit::Memory, 20).unwrap();
    assert_eq!(help, "the limit is 20 bytes; split the scene, or raise it");
    let (found, _) = limited("def d; c long 1; end; surf long 1 0 0;", Limit::Names, 39).unwrap();
    assert!(found.starts_with("the names of colours and surfaces"), "{found}");
    assert_eq!(limited("def d; c long 1; end; surf long 1 0 0;", Limit::Names, 40), None);
}

#[test]
fn limits_have_names_defaults_and_bounds() {
    for limit in Limit::all() {
        assert_eq!(Limit::from_name(limit.name()), Some(limit));
        assert_eq!(Limits::default().get(limit), limit.default_value());
        assert!(limit.default_value() <= limit.most());
        assert_eq!(Limits::default().with(limit, u64::MAX).get(limit), limit.most());
        assert_eq!(Limits::default().with(limit, 7).get(limit), 7);
    }
    assert_eq!(Limit::from_name("Text"), None);
    // The remedy for a limit at its maximum does not suggest to raise it.
    let (_, help) =
        limited("def d; v p 0 0 0; end; a (d) 9999999999;", Limit::Statements, u64::MAX).unwrap();
    assert_eq!(
        help,
        "the limit is 2000000000 statements, and cannot be raised; use smaller arrays"
    );
}

/// Each level of a chain needs stack, so a long chain gets its own stack.
#[test]
fn the_longest_chains_are_expanded() {
    let defs: String =
        (1..10_000).map(|idx| format!("def d{idx}; i x (d{}); end;\n", idx - 1)).collect();
    let text = format!("def d0; v p 0 0 0; end;\n{defs} i x (d9999 -tx 1);");
    let options =
        Options { limits: Limits::default().with(Limit::Chain, 10_000), ..Options::default() };
    let scene = ugparse::parse(&Source::new("test.ug", text), &options).unwrap().scene;
    assert_eq!(scene.vertices[0].position.to_array(), [1.0, 0.0, 0.0]);
}

#[test]
fn definitions_nest_up_to_the_largest_limit() {
    let n = Limit::Nesting.most() as usize;
    let text = format!("{}v p 0 0 0;{}", "def d;".repeat(n), "end;".repeat(n));
    assert_eq!(limited(&text, Limit::Nesting, n as u64), None);
}
