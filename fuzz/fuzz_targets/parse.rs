//! Any bytes: no panic, and every message can be drawn.
#![no_main]

use ugparse::{Options, Source, parse};

libfuzzer_sys::fuzz_target!(|text: &[u8]| {
    // Both ways of reading, and both ways of drawing, without doing each twice.
    let options = Options { lax: text.len() % 2 == 0 };
    let messages = match parse(&Source::new("fuzz.ug", text), &options) {
        Ok(parsed) => parsed.warnings,
        Err(findings) => findings,
    };
    std::hint::black_box(messages.render(text.len() % 4 < 2));
});
