//! Any bytes: no panic, and every message can be drawn.
#![no_main]

use ugparse::{
    Diagnostics, Limit, Limits, Options, Request, RequestError, RequestKind, Source, include, parse,
};

libfuzzer_sys::fuzz_target!(|text: &[u8]| {
    // Both ways of reading, and both ways of drawing, without doing each twice. Drawing takes most of the time,
    // so it is done for two lengths of eight.
    let options = Options { lax: text.len() % 2 == 0, execute: text.len() % 3 > 0, limits: limits() };
    let messages = read(text, &options).unwrap_or_else(|findings| findings);
    if text.len() % 8 < 2 {
        std::hint::black_box(messages.render(text.len() % 2 == 0));
    }
});

/// Gives the warnings.
fn read(text: &[u8], options: &Options) -> Result<Diagnostics, Diagnostics> {
    let source = include(Source::new("fuzz.ug", text), options, load)?;
    Ok(parse(&source, options)?.warnings)
}

/// Small files `a` and `b`, and nothing else.
fn load(request: &Request<'_>) -> Result<Vec<u8>, RequestError> {
    match (request.path.to_str(), request.kind) {
        (Some("a"), _) => Ok(b"v a 0 0 0 ;\ninclude b ;\n".to_vec()),
        (Some("b"), _) => Ok(b"def d ; v b 1 0 0 ; end ;".to_vec()),
        (_, RequestKind::Include) => Err(std::io::Error::from(std::io::ErrorKind::NotFound).into()),
        (_, RequestKind::Execute) => {
            Err(RequestError::Failed { status: "exit status: 1".into(), complaint: "no".into() })
        }
    }
}

/// Large scenes take long and show nothing new, so what is small is enough.
fn limits() -> Limits {
    let small = [(Limit::Statements, 1000), (Limit::Corners, 4000), (Limit::Names, 1 << 16), (Limit::Files, 20)];
    small.into_iter().fold(Limits::default(), |limits, (limit, value)| limits.with(limit, value))
}
