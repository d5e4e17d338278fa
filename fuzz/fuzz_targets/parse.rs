//! No input causes a panic, and every diagnostic can be rendered.
#![no_main]

use ugparse::{
    Diagnostics, Limit, Limits, Options, Request, RequestError, RequestKind, Source, include, parse,
};

libfuzzer_sys::fuzz_target!(|text: &[u8]| {
    // The length of the input selects the options. Rendering of diagnostics takes most of the time,
    // so it is done for two of eight lengths, once with and once without colour.
    let options =
        Options { lax: text.len() % 2 == 0, execute: text.len() % 3 > 0, limits: limits() };
    let messages = read(text, &options).unwrap_or_else(|findings| findings);
    if text.len() % 8 < 2 {
        std::hint::black_box(messages.render(text.len() % 2 == 0));
    }
});

/// Parses the text and returns its warnings, or its errors.
fn read(text: &[u8], options: &Options) -> Result<Diagnostics, Diagnostics> {
    let source = include(Source::new("fuzz.ug", text), options, load)?;
    Ok(parse(&source, options)?.warnings)
}

/// Serves two small files, `a` and `b`.
fn load(request: &Request<'_>) -> Result<Vec<u8>, RequestError> {
    match (request.path.to_str(), request.kind) {
        (Some("a"), _) => Ok(b"v a 0 0 0 ;\ninclude b ;\n".to_vec()),
        (Some("b"), _) => Ok(b"def d ; v b 1 0 0 ; end ;".to_vec()),
        (_, RequestKind::Include | RequestKind::Path | RequestKind::Image | RequestKind::Sky) => {
            Err(std::io::Error::from(std::io::ErrorKind::NotFound).into())
        }
        (_, RequestKind::Execute) => {
            Err(RequestError::Failed { status: "exit status: 1".into(), complaint: "no".into() })
        }
    }
}

/// Small limits, because large scenes take long and reach no further code.
fn limits() -> Limits {
    let small = [
        (Limit::Statements, 1000),
        (Limit::Corners, 4000),
        (Limit::Names, 1 << 16),
        (Limit::Files, 20),
    ];
    small.into_iter().fold(Limits::default(), |limits, (limit, value)| limits.with(limit, value))
}
