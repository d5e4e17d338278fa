//! Selection of one of several cameras.

use super::*;

/// The cameras of the written scene after the camera `name` was selected.
fn chosen(text: &str, name: &str) -> Result<Vec<String>, String> {
    let source = Source::new("test.ug", text);
    let mut parsed = parse_with(text, false);
    parsed.choose_camera(&source, name).map_err(|found| found.render(false))?;
    let again = parse(written(&parsed));
    assert_eq!(again.camera(), parsed.scene.camera());
    Ok(written(&parsed).lines().map(str::to_owned).collect())
}

#[test]
fn the_first_without_a_name_is_selected_else_the_first() {
    fn check(text: &str, expected: Option<f64>) {
        assert_eq!(parse(text).camera().map(|camera| camera.eye.unwrap().x), expected, "{text}");
    }
    check("", None);
    check("cam a -ep 1 0 0; cam b -ep 2 0 0;", Some(1.0));
    check("cam a -ep 1 0 0; cam -ep 2 0 0; cam -ep 3 0 0;", Some(2.0));
}

#[test]
fn a_camera_is_selected_by_name() {
    let check = |text: &str, name: &str, expected: &[&str]| {
        assert_eq!(chosen(text, name).unwrap(), expected, "{text}");
    };
    check("cam a -ep 1 0 0; cam b -ep 2 0 0;", "b", &["cam a -ep 1 0 0;", "cam -ep 2 0 0;"]);
    check("cam a -ep 1 0 0; cam b -ep 2 0 0;", "a", &["cam -ep 1 0 0;", "cam b -ep 2 0 0;"]);
    // It comes before the first without a name; the others keep their order.
    check(
        "cam x -ep 9 0 0; cam -ep 1 0 0; cam b -ep 2 0 0; cam -ep 3 0 0;",
        "b",
        &["cam x -ep 9 0 0;", "cam -ep 2 0 0;", "cam -ep 1 0 0;", "cam -ep 3 0 0;"],
    );
    // Names of cameras need not be unique; the first is selected. Those of instances have paths.
    check("cam b -ep 1 0 0; cam b -ep 2 0 0;", "b", &["cam -ep 1 0 0;", "cam b -ep 2 0 0;"]);
    let car = "def car; cam dash -ep 0 0 1; end; cam -ep 9 9 9; i taxi (car -tx 5);";
    check(car, "taxi:dash", &["cam -ep 5 0 1;", "cam -ep 9 9 9;"]);
}

#[test]
fn comments_move_with_their_cameras() {
    let text = "v z 0 0 0;\n{ front }\ncam -ep 1 0 0; { from here }\n{ side }\ncam side -ep 2 0 0; { from there }\n";
    let expected = [
        "v z 0 0 0;",
        "{ side }",
        "cam -ep 2 0 0; { from there }",
        "{ front }",
        "cam -ep 1 0 0; { from here }",
    ];
    assert_eq!(chosen(text, "side").unwrap(), expected);
}

#[test]
fn an_unknown_camera_is_an_error() {
    let check = |text: &str, name: &str, place: &str, help: &str| {
        let shown = chosen(text, name).unwrap_err();
        assert!(shown.starts_with(&format!("error: no camera is called `{name}`")), "{shown}");
        assert!(shown.contains(&format!("test.ug:{place}")) && shown.contains(help), "{shown}");
    };
    let two = "v z 0 0 0;\ncam -ep 1 0 0;\ncam bridge -ep 2 0 0; cam stern -ep 3 0 0;";
    check(two, "brigde", "2:1", "did you mean `bridge`?");
    check(two, "north", "2:1", "cameras are `bridge`, `stern`");
    check("cam -ep 1 0 0;", "a", "1:1", "no camera has a name");
    check("v z 0 0 0;", "a", "1:1", "no camera has a name");
}

#[test]
fn one_outside_definitions_takes_precedence() {
    let check = |text: &str, expected: &[&str], warning: Option<&str>| {
        check_rest(text, expected);
        assert_eq!(warnings(text, false), warning.as_slice(), "{text}");
    };
    let car = |camera: &str| format!("def car; {camera} -ep 0 0 1; end; i taxi (car -tx 5);");
    let unused = Some("a camera in a definition is not used");
    // Whichever comes first in the text, and whichever has a name.
    check(
        &format!("{} cam -ep 9 0 0;", car("cam")),
        &["cam -ep 9 0 0;", "cam taxi -ep 5 0 1;"],
        unused,
    );
    check(
        &format!("{} cam a -ep 9 0 0;", car("cam")),
        &["cam a -ep 9 0 0;", "cam taxi -ep 5 0 1;"],
        unused,
    );
    check(
        &format!("cam a -ep 9 0 0; {}", car("cam")),
        &["cam a -ep 9 0 0;", "cam taxi -ep 5 0 1;"],
        unused,
    );
    check(
        &format!("{} cam a -ep 9 0 0;", car("cam b")),
        &["cam a -ep 9 0 0;", "cam taxi:b -ep 5 0 1;"],
        unused,
    );
    check(&format!("cam -ep 9 0 0; {}", car("cam")), &["cam -ep 9 0 0;", "cam -ep 5 0 1;"], None);
    check(
        &format!("{} cam -ep 9 0 0;", car("cam b")),
        &["cam taxi:b -ep 5 0 1;", "cam -ep 9 0 0;"],
        None,
    );
    // Alone it is used; of several copies the first.
    check(&car("cam"), &["cam -ep 5 0 1;"], None);
    check(
        "def car; cam -ep 0 0 1; end; a row (car) 2 -tx 1;",
        &["cam -ep 0 0 1;", "cam -ep 1 0 1;"],
        Some("this camera is placed 2 times"),
    );
    let text = "def car;\n{ in }\ncam -ep 0 0 1; { here }\nend;\ni taxi (car);\n{ out }\ncam -ep 9 0 0; { there }";
    let expected =
        ["{ out }", "cam -ep 9 0 0; { there }", "{ in }", "cam taxi -ep 0 0 1; { here }"];
    check(text, &expected, unused);
    let warnings = parse_with(text, false).warnings;
    let drawn = warnings.render(false);
    assert!(drawn.contains("test.ug:3:1") && !drawn.contains("(-cam)"), "{drawn}");
    // A command line adds the option.
    let worded = warnings.worded().render(false);
    assert!(
        worded.ends_with("choose this one by its name `taxi`, or remove one of them (-cam)"),
        "{worded}"
    );
}
