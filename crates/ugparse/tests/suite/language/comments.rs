//! Comments stay with their statements.

use ugparse::{Options, Source};

use crate::language::check;

#[test]
#[rustfmt::skip] // rows of a table
fn comments_keep_their_places() {
    // The head comes first; escapes and colours are written before the rest.
    check("{ a licence }\n{ and more }\nv a 0 0 0;\nc red 1;", &["{ a licence }", "{ and more }", "c red 1;", "v a 0 0 0;"]);
    check("v a 0 0 0;\n{ above }\n\n{ this }\nv b 0 0 0;", &["v a 0 0 0;", "{ above }", "{ this }", "v b 0 0 0;"]);
    check("v a 0 0 0; { behind }\nv b 0 0 0;", &["v a 0 0 0; { behind }", "v b 0 0 0;"]);
    check("v a 0 0 0; { one } { two }\nv b 0 0 0;", &["v a 0 0 0; { one } { two }", "v b 0 0 0;"]);
    check("v a 0 0 0; v b 0 0 0; { b's }", &["v a 0 0 0;", "v b 0 0 0; { b's }"]);
    check("v a 0 { in } 0 0; { behind }", &["{ in }", "v a 0 0 0; { behind }"]);
    check("v{ first }a 0 0 0{ last };", &["{ first }", "{ last }", "v a 0 0 0;"]);
    check("v a 0 0 0;\n{ the end }", &["v a 0 0 0;", "{ the end }"]);
    check("v a 0 0 0;\n{ the end }\n;", &["v a 0 0 0;", "{ the end }"]);
    check("{ alone }", &["{ alone }"]);
    check("{two\nlines}v a 0 0 0; {also\ntwo} {more}\nv b 0 0 0;", &["{two", "lines}", "v a 0 0 0; {also", "two}", "{more}", "v b 0 0 0;"]);
    check("{}{ {nested} {{}} }v a 0 0 0;", &["{}", "{ {nested} {{}} }", "v a 0 0 0;"]);
    check("{ ; ( < \" }v a 0 0 0;", &["{ ; ( < \" }", "v a 0 0 0;"]);
    check("(escape) {its}\n{mine}\nv a 0 0 0;", &["(escape) {its}", "{mine}", "v a 0 0 0;"]);
}

/// Braces in the names of files begin no comment, wherever they would end.
#[test]
fn braces_in_quotes_are_text() {
    check("sky \"a{b}.png\";\nv a 0 0 0;", &["sky \"a{b}.png\";", "v a 0 0 0;"]);
    for text in [
        "motion ship -path \"a{b\" ;\nq } ;\n",
        "c_rgb a 1 1 1 ; c_tex a \"x{y\" ; } {",
        "c_tex a \"{\n",
    ] {
        assert!(ugparse::parse(&Source::new("t.ug", text), &Options::default()).is_err(), "{text}");
    }
}

#[test]
fn a_comment_moves_with_its_statement() {
    check(
        "{head}\ndef x; end;\nv a 0 0 0; {a}\n{red above}\nc red 1; {red}\nl 1; {l}",
        &["{head}", "{red above}", "c red 1; {red}", "v a 0 0 0; {a}", "l 1; {l}"],
    );
}

#[test]
fn comments_in_definitions_appear_once() {
    check(
        "v o 0 0 0;\n{ about d }\ndef d;\n{ about p }\nv p 0 0 0; { p }\nend; { of d }\na (d) 2; { of a }\n{ done }",
        &[
            "v o 0 0 0;",
            "{ about d }",
            "{ about p }",
            "v #0:p 0 0 0; { p }",
            "v #1:p 0 0 0;",
            "{ of d }",
            "{ of a }",
            "{ done }",
        ],
    );
    check(
        "c red 1; def d { name } ; v a 0 0 0; end { end } ; i (d);",
        &["c red 1;", "{ name }", "v d:a 0 0 0;", "{ end }"],
    );
    // Comments are kept even if nothing is drawn.
    check(
        "v o 0 0 0;\ndef d; { in } v p 0 0 0; { p } end;\n{ out }",
        &["v o 0 0 0;", "{ in }", "{ p }", "{ out }"],
    );
}

#[test]
fn invalid_utf_8_is_replaced() {
    let out = crate::language::flat(b"{ caf\xe9 }v a 0 0 0;(\xff)");
    assert_eq!(out, "{ caf\u{fffd} }\n(\u{fffd})\nv a 0 0 0;\n");
}
