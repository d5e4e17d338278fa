//! Large texts are written in pieces, with the same result for any number of threads.

use std::fmt::Write;
use std::io;

use ugparse::{Options, Parsed, Source};

/// A scene in the layout of the writer, with comments above and after rows, also at the boundaries
/// between pieces that different threads write.
fn as_written() -> String {
    let mut text = "{ head }\n(escape)\nc red 1 0 1;\n".to_string();
    let rows = 70_000;
    let comment = |row: usize, what: &str| {
        // Rows around multiples of 1024, because the size of pieces is a power of two.
        if (row + 1) % 1024 < 3 { format!("{{ {what} {row} }}") } else { String::new() }
    };
    for row in 0..rows {
        let (above, behind) = (comment(row, "above"), comment(row, "behind"));
        let line = format!("{above}\nv v{row} {row} -{row}.5 {} red; {behind}", row * row % 101);
        writeln!(text, "{}", line.trim()).unwrap();
    }
    for row in 1..rows / 2 {
        let (above, behind) = (comment(row, "over"), comment(row, "after"));
        let line = format!("{above}\nf (v{row} v{} v0) <0.5 0 0>; {behind}", row + 1);
        writeln!(text, "{}", line.trim()).unwrap();
    }
    text + "w (v1 v2);\nl 1;\ncam -ep 1 2 3;\n{ the end }\n"
}

#[test]
fn any_number_of_threads_writes_the_same() {
    let text = as_written();
    let source = Source::new("written.ug", text.as_str());
    let Parsed { scene, passed_on, .. } = ugparse::parse(&source, &Options::default()).unwrap();
    for n_threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        let mut sent = Vec::new();
        pool.install(|| ugparse::write_to(&scene, &passed_on, &mut sent)).unwrap();
        assert!(sent == text.as_bytes(), "sent on {n_threads} threads");
        assert!(
            pool.install(|| ugparse::write_with(&scene, &passed_on)) == sent,
            "written on {n_threads} threads"
        );
    }
    // The caller may be outside the thread pool.
    assert!(ugparse::write_with(&scene, &passed_on) == text.as_bytes());
}

/// Accepts a limited number of bytes.
struct Full(usize);

impl io::Write for Full {
    fn write(&mut self, data: &[u8]) -> io::Result<usize> {
        let taken = data.len().min(self.0);
        self.0 -= taken;
        if taken == 0 { Err(io::ErrorKind::StorageFull.into()) } else { Ok(taken) }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn failed_output_is_an_error() {
    let text = as_written();
    let source = Source::new("written.ug", text.as_str());
    let Parsed { scene, passed_on, .. } = ugparse::parse(&source, &Options::default()).unwrap();
    for room in [0, 1, text.len() / 2, text.len() - 1] {
        let error = ugparse::write_to(&scene, &passed_on, &mut Full(room)).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::StorageFull, "room for {room} bytes");
    }
    ugparse::write_to(&scene, &passed_on, &mut Full(text.len())).unwrap();
}
