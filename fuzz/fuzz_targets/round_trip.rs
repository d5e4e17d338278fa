//! What can be read is written so that it reads back equal, and writes the same text again.
#![no_main]

use ugparse::{Limit, Limits, Options, Source, parse, write};

libfuzzer_sys::fuzz_target!(|text: &[u8]| {
    let options = Options { lax: text.len() % 2 == 0, limits: limits(), ..Options::default() };
    let Ok(first) = parse(&Source::new("fuzz.ug", text), &options) else { return };
    let written = write(&first.scene);
    // Names may have grown, but not without bound.
    let options = Options { limits: Limits::default(), ..options };
    match parse(&Source::new("again.ug", written.clone()), &options) {
        Ok(second) => assert!(write(&second.scene) == written, "the second text differs"),
        Err(findings) => panic!("what was written is refused: {findings}"),
    }
});

/// Large scenes take long and show nothing new, so what is small is enough.
fn limits() -> Limits {
    Limits::default().with(Limit::Statements, 1000).with(Limit::Corners, 4000).with(Limit::Names, 1 << 16)
}
