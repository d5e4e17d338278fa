//! Numbers, names, white space.

use ugparse::Parsed;

use crate::language::{check, check_error, errors, flat, parse, parse_with, written};

#[test]
fn numbers_are_read_to_the_bit() {
    let rows: &[(&str, f64)] = &[
        ("0", 0.0),
        ("-0", -0.0),
        ("+0", 0.0),
        (".9", 0.9),
        ("-.9", -0.9),
        ("+.9", 0.9),
        ("5.", 5.0),
        ("-5.", -5.0),
        ("+1", 1.0),
        ("007", 7.0),
        ("-1e-3", -0.001),
        ("1e+16", 1e16),
        ("1E5", 1e5),
        ("5.e3", 5000.0),
        (".5E-1", 0.05),
        ("0.1", 0.1),
        ("123456789012345678901234567890", 123456789012345678901234567890.0),
        ("9007199254740993", 9007199254740992.0),
        ("1.7976931348623157e308", f64::MAX),
        ("2.2250738585072014e-308", f64::MIN_POSITIVE),
        ("2.2250738585072011e-308", 2.225_073_858_507_201e-308),
        ("5e-324", f64::from_bits(1)),
        ("1e-400", 0.0),
        ("0e999999999999999999999", 0.0),
    ];
    for &(text, expected) in rows {
        let scene = parse(format!("v a {text} 0 0;"));
        assert_eq!(scene.vertices[0].position.x.to_bits(), expected.to_bits(), "{text}");
    }
}

#[test]
fn invalid_numbers_are_refused() {
    const NOT_NUMBERS: &str = "nan NaN inf -inf +infinity -nan . - + e5 .e5 +-1 -+1 --1 1e 1e+ 1e5. 0x10 \
        1_000 1,5 1.2.3 1f 1- ½ ١ #1";
    for word in NOT_NUMBERS.split(' ') {
        check_error(&format!("v a {word} 0 0;"), &format!("expected a number, found `{word}`"));
    }
    for word in ["1e309", "-1e309", "1e999999999999999999999", "179769313486231580000e290"] {
        check_error(&format!("v a {word} 0 0;"), &format!("the number `{word}` is too large"));
    }
}

#[test]
fn numbers_are_written_short_and_exact() {
    let rows: &[(&str, &str)] = &[
        ("1.0", "1"),
        ("-0.0", "-0"),
        ("+0.50", "0.5"),
        ("100000", "100000"),
        ("-999999", "-999999"),
        ("0.1", "0.1"),
        ("0.30000000000000004", "0.30000000000000004"),
        ("-12.25e1", "-122.5"),
    ];
    for (read, written) in rows {
        check(&format!("v a {read} 0 0;"), &[&format!("v a {written} 0 0;")]);
    }
}

/// A scene with every kind of token.
const WORDS: &str = "c red .9 0 0.8 ; v a 0 0 0 red ; v b 1 0 0 ; v c 1 1 0 red 0 0 -1 ; def d ; v a 0 0 0 ; v b 1 0 0 ; \
    v c 1 1 0 ; f x ( a b c ) ; w ( a b ) ( b c ) red ; l sun .5 0 0 1 ; end ; f f ( a b c ) red .5 < 0 -.5 0 > ; \
    i car ( d red -rz 90 -tx 3 ) < .1 0 0 > ; a ( d ) 2 -tx 5 ; cam -ep 0 -9 0 -og ; (escape) ;";

#[test]
fn the_layout_is_free() {
    let plain = flat(WORDS);
    assert_eq!(plain.lines().count(), 4 + 9 + 1 + 3 + 3 + 1 + 3 + 1, "{plain}");
    let words: Vec<&str> = WORDS.split_ascii_whitespace().collect();
    for blank in ["\n", "\r\n", "\t", "\r", "\x0b", "\x0c", " \t\r\n\n "] {
        assert_eq!(flat(words.join(blank)), plain, "{blank:?}");
    }
    let no_comments = |text: String| {
        let mut parsed = parse_with(text, false);
        parsed.scene.head.comments.clear();
        parsed.passed_on.comments.clear();
        written(&parsed)
    };
    // Not inside the escape, whose text must not change.
    let scene = WORDS.replace("(escape) ;", "");
    let words: Vec<&str> = scene.split_ascii_whitespace().collect();
    let plain = flat(&scene);
    let glued = [";", "(", ")", "<", ">"].iter().fold(words.join(" "), |text, mark| {
        text.replace(&format!(" {mark}"), mark).replace(&format!("{mark} "), mark)
    });
    assert!(glued.contains("f f(a b c)red .5<0 -.5 0>;i car(d red"), "{glued}");
    assert_eq!(flat(glued), plain);
    for comment in ["{}", "{ v a 0 0 0; }", "{ { } {{}{}} }", "{ ( < \" }\n", "\n{\n}", "{é}"] {
        assert_eq!(no_comments(words.join(comment)), plain, "{comment:?}");
    }
    for idx in 0..=words.len() {
        let (before, after) = words.split_at(idx);
        let text = format!("{} {{ here {{ and here }} }} {}", before.join(" "), after.join(" "));
        assert_eq!(no_comments(text.clone()), plain, "{text}");
        let Parsed { scene, passed_on, .. } = parse_with(text, false);
        let n_comments = scene.head.comments.len() + passed_on.comments.len();
        assert_eq!(n_comments, 1, "the comment before word {idx} is kept");
    }
}

#[test]
fn an_empty_text_is_a_scene() {
    for text in ["", " ", "\n", ";", ";;\n;", "\r\n\t", "def d; end;"] {
        check(text, &[]);
    }
}

#[test]
fn names_may_be_almost_anything() {
    const NAMES: &str = "a A z9 _ # : #1 :a:b a#3#5:b v f w c l i a1 cam def end c_rgb nan inf e5 E include \
        a_very_long_name_that_goes_on_and_on_0123456789_0123456789";
    for name in NAMES.split(' ') {
        check(
            &format!(
                "c {name} 1; v {name} 0 0 0 {name}; v p 1 0 0; v q 0 1 0; f {name} ({name} p q) {name}; \
                 w {name} (p q) {name}; l {name} 1 {name}; cam {name} -og;"
            ),
            &[
                &format!("c {name} 1;"),
                &format!("v {name} 0 0 0 {name};"),
                "v p 1 0 0;",
                "v q 0 1 0;",
                &format!("f {name} ({name} p q) {name};"),
                &format!("w {name} (p q) {name};"),
                &format!("l {name} 1 {name};"),
                &format!("cam {name} -og;"),
            ],
        );
        check(
            &format!("def {name}; v p 0 0 0; end; i {name} ({name}); a {name} ({name}) 1;"),
            &[&format!("v {name}:p 0 0 0;"), &format!("v {name}_2#0:p 0 0 0;")],
        );
    }
    check("v ab 0 0 0; v aB 1 0 0; v Ab 2 0 0;", &["v ab 0 0 0;", "v aB 1 0 0;", "v Ab 2 0 0;"]);
}

#[test]
fn invalid_names_are_refused() {
    const BEGINS: &str = "expected a name that begins with a letter, `:`, `_` or `#`, found ";
    const LETTERS: &str = "expected a name of letters, digits, `:`, `_` and `#`, found ";
    for (name, expected) in [
        ("1a", BEGINS),
        ("7", BEGINS),
        ("-a", BEGINS),
        (".a", BEGINS),
        ("é", BEGINS),
        ("a-b", LETTERS),
        ("a.b", LETTERS),
        ("aé", LETTERS),
        ("a\0", LETTERS),
    ] {
        check_error(&format!("v {name} 0 0 0;"), &format!("{expected}`{name}`"));
    }
    assert_eq!(errors("v \"a\" 0 0 0;"), [format!("{BEGINS}`\"`")]);
}

#[test]
fn only_the_first_word_is_a_keyword_and_in_lower_case() {
    for word in
        ["V", "F", "Cam", "DEF", "End", "vertex", "ff", "1", "Include", "c_lab", "Surf", "-v"]
    {
        check_error(&format!("{word} a 0 0 0;"), &format!("`{word}` is not a statement"));
    }
}

/// Long lines are truncated in messages, with the column in the file.
#[test]
fn columns_count_from_the_beginning_of_the_line() {
    for n_before in [0, 30, 60, 90, 200, 5000] {
        let text = format!(
            "c red 1; {}v a 0 0 ü0;\n{}f (q);",
            "v v 0 0 0; ".repeat(n_before),
            " ".repeat(n_before)
        );
        let findings =
            ugparse::parse(&ugparse::Source::new("t.ug", text), &Default::default()).unwrap_err();
        let places = findings.locations();
        let drawn = findings.render(false);
        let column = 9 + 11 * n_before + "v a 0 0 ".len() + 1;
        assert!(drawn.contains(&format!(" t.ug:1:{column}\n")), "{n_before}: {drawn}");
        assert!(places.iter().any(|place| (place.line, place.column) == (1, column)), "{places:?}");
    }
}
