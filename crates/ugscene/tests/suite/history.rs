//! What made a scene.

use ugscene::{Head, Provenance};

fn made<'s>(program: &'s str, version: &'s str, command: &'s str) -> Provenance<'s> {
    Provenance { program, version, command: Some(command) }
}

fn licensed() -> Head {
    Head { comments: vec![" A licence: free for all ".to_string()], ..Head::default() }
}

#[test]
fn history_is_what_was_recorded() {
    let mut head = licensed();
    head.record(made("uglorentz", "0.1.0", "uglorentz -vel .9 0 0"));
    head.record(made("ugdoppler", "0.1.0", "ugdoppler"));
    assert_eq!(head.history(), ["uglorentz -vel .9 0 0", "ugdoppler"]);
    assert_eq!(head.comments[0], " A licence: free for all ");
    assert_eq!(head.recipe(made("ugrainbow", "0.1.0", "ugrainbow")), None);
}

#[test]
fn recipes_are_pipes() {
    let hash = "0123456789abcdef".repeat(4);
    let check = |name: &str, first: &str| {
        let mut head = licensed();
        head.origin = Some(format!("SHA-256 {hash} {name}"));
        let alone = head.recipe(made("ugrainbow", "0.1.0", "ugrainbow")).expect("an origin");
        assert!(alone.starts_with("ugrainbow ") && alone.ends_with("; ugrainbow 0.1.0"), "{alone}");
        head.record(made("uglorentz", "0.1.0", "uglorentz -vel .9 0 0"));
        // What a program downstream reads has no origin of its own.
        head.origin = Some(format!("SHA-256 {} -", "0".repeat(64)));
        head.record(made("ugdoppler", "0.2.0", "ugdoppler"));
        let line = head.recipe(made("ugrainbow", "0.1.0", "ugrainbow -sz 9 9"));
        assert_eq!(
            line.expect("an origin"),
            format!(
                "{first} | ugdoppler | ugrainbow -sz 9 9 # SHA-256 {hash} {name}; \
                 uglorentz 0.1.0, ugdoppler 0.2.0, ugrainbow 0.1.0"
            )
        );
    };
    check("ship.ug", "uglorentz ship.ug -vel .9 0 0");
    check("'my ship.ug'", "uglorentz 'my ship.ug' -vel .9 0 0");
    check("-", "uglorentz -vel .9 0 0");
}
