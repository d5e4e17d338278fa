//! Visibility of names in scopes.

use crate::language::{TRIANGLE, check, check_error, check_rest, errors};

#[test]
fn references_may_come_first() {
    check_rest(
        &format!("f (a b c) red; w (c a); {TRIANGLE} c red 1;"),
        &["c red 1;", "f (a b c) red;", "w (c a);"],
    );
    check("i (d); def d; i (e); end; def e; v a 1 2 3; end;", &["v d:e:a 1 2 3;"]);
    check(
        "def d; def f; i (e); end; i (f); end; def e; v a 1 2 3; end; i (d);",
        &["v d:f:e:a 1 2 3;"],
    );
}

#[test]
fn definitions_are_local_and_shadow_outer_ones() {
    let text = "def d; v out 0 0 0; end; def e; def d; v in 0 0 0; end; i (d); end; i (e); i (d);";
    check(text, &["v e:d:in 0 0 0;", "v d:out 0 0 0;"]);
    check_error("def e; def d; end; end; i (d);", "definition `d` is not defined");
    // Siblings of the enclosing definition are visible.
    check(
        "def d; v a 0 0 0; end; def e; def f; i (d); end; i (f); end; i (e);",
        &["v e:f:d:a 0 0 0;"],
    );
    check_error("def d; end; def d; end;", "definition `d` is defined twice");
    check(
        "def d; v d 0 0 0; end; v d 1 0 0; c d 1; i d (d d);",
        &["c d 1;", "v d 1 0 0;", "v d:d 0 0 0;"],
    );
}

#[test]
fn vertices_are_visible_in_their_own_scope_only() {
    check_error(
        &format!("{TRIANGLE} def d; v x 0 0 0; f (a x x); end;"),
        "vertex `a` is not defined",
    );
    assert_eq!(errors("def d; v x 0 0 0; end; i (d); f (d:x x x);").len(), 2);
    assert_eq!(errors("def d; v x 0 0 0; end; f (d:x x x);").len(), 3);
    check_error("v a 0 0 0; v a 0 0 0;", "vertex `a` is defined twice");
    check("def d; v a 1 0 0; end; v a 0 0 0; i (d);", &["v a 0 0 0;", "v d:a 1 0 0;"]);
}

#[test]
fn a_definition_must_not_contain_itself() {
    for text in [
        "def d; i (d); end; i (d);",
        "def d; a (d) 0; end; i (d);",
        "def d; i (d); end;",
        "def d; def e; i (d); end; i (e); end; i (d);",
        "i (a1); def a1; i (b1); end; def b1; i (c1); end; def c1; i (a1); end;",
    ] {
        let errors = errors(text);
        assert!(errors.len() == 1 && errors[0].ends_with("contains itself"), "{text}: {errors:?}");
    }
    // Placing the same definition twice is not recursive.
    check_rest("def d; v a 0 0 0; end; def e; i (d); i (d); end; i (e); i (d);", &[]);
    // Nor is a definition nested in one that it places, as long as it is not placed there.
    check_rest("def d; def e; i (d); end; end; i (d);", &[]);
}

#[test]
fn unused_definitions_are_checked_but_not_drawn() {
    check("def d; v a 0 0 0; l 1; (gone) end;", &[]);
    check_error("def d; f (a); end;", "vertex `a` is not defined");
}
