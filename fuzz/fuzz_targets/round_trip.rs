//! What can be read is written so that it reads back equal, and writes the same text again.
#![no_main]

use ugparse::{Options, Source, parse, write};

libfuzzer_sys::fuzz_target!(|text: &[u8]| {
    let options = Options { lax: text.len() % 2 == 0 };
    let Ok(first) = parse(&Source::new("fuzz.ug", text), &options) else { return };
    let written = write(&first.scene);
    match parse(&Source::new("again.ug", written.clone()), &options) {
        Ok(second) => assert!(write(&second.scene) == written, "the second text differs"),
        Err(findings) => panic!("what was written is refused: {findings}"),
    }
});
