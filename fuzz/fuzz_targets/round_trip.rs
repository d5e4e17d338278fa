//! The round trip is exact: every scene that parses is written as text that parses and is written
//! equally.
#![no_main]

use ugparse::{Limit, Limits, Options, Parsed, Source, parse, write_with};

libfuzzer_sys::fuzz_target!(|text: &[u8]| {
    let options = Options { lax: text.len() % 2 == 0, limits: limits(), ..Options::default() };
    let Ok(first) = parse(&Source::new("fuzz.ug", text), &options) else { return };
    let write = |parsed: &Parsed| write_with(&parsed.scene, &parsed.passed_on);
    let written = write(&first);
    // Expansion may make names longer than the small limit, but not longer than the default one.
    let options = Options { limits: Limits::default(), ..options };
    match parse(&Source::new("again.ug", written.clone()), &options) {
        Ok(second) => assert!(write(&second) == written, "the second text differs from the first"),
        Err(findings) => panic!("the written scene does not parse: {findings}"),
    }
});

/// Small limits, because large scenes take long and reach no further code.
fn limits() -> Limits {
    Limits::default()
        .with(Limit::Statements, 1000)
        .with(Limit::Corners, 4000)
        .with(Limit::Names, 1 << 16)
}
