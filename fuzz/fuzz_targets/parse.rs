//! Any bytes: no panic, and every message can be drawn.
#![no_main]

use ugparse::{Options, Source, parse};

libfuzzer_sys::fuzz_target!(|text: &[u8]| {
    // Large arrays take long and show nothing new: leave texts with whole numbers above 99 to the tests of limits.
    if has_large_whole_number(text) {
        return;
    }
    // Both ways of reading, and both ways of drawing, without doing each twice.
    let options = Options { lax: text.len() % 2 == 0 };
    let messages = match parse(&Source::new("fuzz.ug", text), &options) {
        Ok(parsed) => parsed.warnings,
        Err(findings) => findings,
    };
    std::hint::black_box(messages.render(text.len() % 4 < 2));
});

fn has_large_whole_number(text: &[u8]) -> bool {
    let words = text.split(|byte| byte.is_ascii_whitespace() || b"();<>{}".contains(byte));
    words.filter(|word| word.iter().all(u8::is_ascii_digit)).any(|word| word.len() > 2)
}
