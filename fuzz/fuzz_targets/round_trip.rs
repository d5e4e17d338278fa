//! What can be read is written so that it reads back equal, and writes the same text again.
#![no_main]

use ugparse::{Options, Source, parse, write};

libfuzzer_sys::fuzz_target!(|text: &[u8]| {
    // Large arrays take long and show nothing new: leave texts with whole numbers above 99 to the tests of limits.
    if has_large_whole_number(text) {
        return;
    }
    let options = Options { lax: text.len() % 2 == 0 };
    let Ok(first) = parse(&Source::new("fuzz.ug", text), &options) else { return };
    let written = write(&first.scene);
    match parse(&Source::new("again.ug", written.clone()), &options) {
        Ok(second) => assert!(write(&second.scene) == written, "the second text differs"),
        Err(findings) => panic!("what was written is refused: {findings}"),
    }
});

fn has_large_whole_number(text: &[u8]) -> bool {
    let words = text.split(|byte| byte.is_ascii_whitespace() || b"();<>{}".contains(byte));
    words.filter(|word| word.iter().all(u8::is_ascii_digit)).any(|word| word.len() > 2)
}
