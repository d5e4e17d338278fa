//! Vertices of instances, referred to by their paths.

use crate::language::{TRIANGLE, check_error, check_rest, errors, parse, warnings};

#[test]
fn faces_and_wires_use_vertices_of_instances() {
    let def = "def d; v a 0 0 0; v b 1 0 0; v c 0 1 0; end; ";
    let check = |text: &str, expected: &[&str]| check_rest(&format!("{def}{text}"), expected);
    check("i car (d); f (car:a car:b car:c);", &["f (car:a car:b car:c);"]);
    check("v o 0 0 1; w (x:a o y:b); i x (d); i y (d -tx 3);", &["w (x:a o y:b);"]);
    check(
        "a row (d) 3 -tz 1; f (row#0:a row#2:b row#1:c) (row#2:a row#2:b row#2:c);",
        &["f (row#0:a row#2:b row#1:c) (row#2:a row#2:b row#2:c);"],
    );
    // Unnamed instances have the labels in the names of their vertices.
    check("i (d); i (d -tx 1); w (d:a d_2:a);", &["w (d:a d_2:a);"]);
    check("a (d) 2 -tx 1; w (#0:a #1:a);", &["w (#0:a #1:a);"]);
    // Nested, and in a definition that is placed twice.
    check("def e; i in (d); end; i out (e); w (out:in:a out:in:b);", &["w (out:in:a out:in:b);"]);
    check(
        "def e; v o 5 5 5; i in (d -tx 1); w line (o in:a); end; i p (e); a q (e) 2;",
        &["w p:line (p:o p:in:a);", "w q#0:line (q#0:o q#0:in:a);", "w q#1:line (q#1:o q#1:in:a);"],
    );
    check(
        "def e; i in (d); f (in:a in:b in:c) <0 0 .5>; end; i m (e -mx);",
        &["f (m:in:a m:in:c m:in:b) <0 0 0.5>;"],
    );
    // The output uses these names and survives a round trip.
    let scene = parse(format!("{def} i car (d -tx 5); {TRIANGLE} f (a b car:c);"));
    let corners = scene.face_contours(&scene.faces[0]).next().unwrap();
    assert_eq!(scene.vertices[corners[2].index()].position.to_array(), [5.0, 1.0, 0.0]);
}

#[test]
fn instances_of_one_scope_have_distinct_paths() {
    let row = |calls: &str, expected: &[&str]| {
        let scene = parse(format!("def d; v a 0 0 0; end; {calls}"));
        let names: Vec<&str> =
            scene.vertices.iter().map(|vertex| scene.names.get(vertex.name)).collect();
        assert_eq!(names, expected, "{calls}");
    };
    row("i x (d); i x (d); i x (d);", &["x:a", "x_2:a", "x_3:a"]);
    // A name in the text is kept, and not used for another instance.
    row("i x (d); i x_2 (d); i x (d);", &["x:a", "x_2:a", "x_3:a"]);
    row("i x (d); i x (d); i x_2 (d);", &["x:a", "x_3:a", "x_2:a"]);
    row(
        "i x (d); i x (d); i x_2 (d); i x_2 (d); i x_2_2 (d);",
        &["x:a", "x_3:a", "x_2:a", "x_2_3:a", "x_2_2:a"],
    );
    row("i d_2 (d); i (d); a (d) 1; i (d);", &["d_2:a", "d:a", "d_3#0:a", "d_4:a"]);
}

#[test]
fn wires_of_one_vertex_are_omitted_by_path_too() {
    let def = "def d; v a 0 0 0; v b 1 0 0; end; def g; i q (d); w (q:a); w (q:a q:b) (q:b); end;";
    let text = format!("{def} i q (d); i h (g); i k (g); w (q:a); w (q:a q:b); w long (q:b);");
    check_rest(&text, &["w (q:a q:b);"]);
    assert_eq!(warnings(&text, false).len(), 4, "one for each statement");
}

#[test]
fn a_vertex_name_takes_precedence_over_a_path() {
    let scene = parse("def d; v a 9 9 9; end; i car (d); v car:a 1 2 3; v o 0 0 0; w (o car:a);");
    let corners = scene.wire_contours(&scene.wires[0]).next().unwrap();
    assert_eq!(scene.vertices[corners[1].index()].position.to_array(), [1.0, 2.0, 3.0]);
}

#[test]
fn undefined_paths_are_errors() {
    let def = "def d; v a 0 0 0; end; def e; i in (d); end; ";
    for path in ["car:b", "car:a:a", "bus:a", "car#0:a", "in:a", "e:in:a", ":a"] {
        let found = errors(format!("{def} i car (d); i car2 (e); v o 0 0 0; w (o {path});"));
        assert_eq!(found, [format!("vertex `{path}` is not defined")]);
    }
    check_error(
        "def d; v a 0 0 0; end; a r (d) 2; v o 0 0 0; w (o r#2:a);",
        "vertex `r#2:a` is not defined",
    );
    check_error(
        "def d; v a 0 0 0; end; a r (d) 0; v o 0 0 0; w (o r#0:a);",
        "vertex `r#0:a` is not defined",
    );
    // Once per statement, however often it is placed.
    check_error(
        &format!("{def} def f; v o 0 0 0; i x (d); w (o x:b); end; a (f) 3;"),
        "vertex `x:b` is not defined",
    );
}

#[test]
fn faces_without_area_by_path_are_omitted() {
    let def = "def d; v a 0 0 0; v b 1 0 0; v c 2 0 0; end; ";
    for text in [
        "i x (d); f (x:a x:b x:c);",
        "i x (d); f (x:a x:b x:b);",
        "def e; i x (d); f (x:a x:b x:c); end; i (e);",
    ] {
        let text = format!("{def}{text}");
        assert_eq!((warnings(&text, false).len(), parse(&text).faces.len()), (1, 0), "{text}");
    }
    // The comments of later statements keep their place.
    check_rest(
        &format!("{def} v o 0 1 0; i x (d); f (x:a x:b x:c);\n{{ it }}\nf (x:a x:b o); {{ that }}"),
        &["{ it }", "f (x:a x:b o); { that }"],
    );
}

#[test]
fn messages_suggest_the_nearest_name() {
    let check = |word: &str, names: &[&str], expected: Option<&str>| {
        let vertices: String = names.iter().map(|name| format!("v {name} 0 0 0;")).collect();
        let source = ugparse::Source::new("t.ug", format!("{vertices} f ({word} {word} {word});"));
        let found = ugparse::parse(&source, &ugparse::Options::default()).unwrap_err();
        let help = found.list[0].help.clone().unwrap();
        let suggested =
            help.strip_prefix("did you mean `").map(|rest| rest.split('`').next().unwrap());
        assert_eq!(suggested, expected, "{help}");
    };
    check("wing", &["body", "wign", "wings"], Some("wign"));
    check("Wing", &["wign", "wing"], Some("wing"));
    check("v1000", &["v100"], None);
    // Long words are not compared.
    let long = "x".repeat(50_000);
    check(&long, &[&format!("{long}y")], None);
}
