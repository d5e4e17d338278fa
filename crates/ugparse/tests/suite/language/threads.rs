//! Large texts are parsed in parts and written in pieces, with the same result for any number of
//! threads.

use std::fmt::Write;
use std::io;

use ugparse::{Options, Source};

/// Number of statements in a text of about 2 MB, enough for several parts.
const ROWS: usize = 12_000;

/// The written scene and all messages for `text`.
fn outcome(text: &str, n_threads: usize) -> (Vec<u8>, String) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
    let source = Source::new("large.ug", text);
    match pool.install(|| ugparse::parse(&source, &Options { lax: true, ..Options::default() })) {
        Ok(parsed) => {
            let scene = &parsed.scene;
            let light = |face| (scene.light_level(face), scene.surface(face));
            let colors: Vec<_> =
                scene.faces.iter().map(|face| (face.color, face.body, light(face))).collect();
            let what = format!("{:?} {:?} {}", parsed.origins, colors, parsed.warnings.render(false));
            (ugparse::write(scene), what)
        }
        Err(found) => (Vec::new(), found.render(false)),
    }
}

#[track_caller]
fn check(text: &str, is_read: bool) {
    assert!(text.len() > 5 << 19, "{} bytes are too few for five parts", text.len());
    let alone = outcome(text, 1);
    assert_eq!(!alone.0.is_empty(), is_read, "{}", &alone.1[..alone.1.len().min(500)]);
    for n_threads in [2, 3, 5] {
        let together = outcome(text, n_threads);
        assert!(alone.0 == together.0, "other bytes on {n_threads} threads");
        assert!(alone.1 == together.1, "other rows or messages on {n_threads} threads");
    }
}

fn vertices(text: &mut String, rows: std::ops::Range<usize>) {
    for row in rows {
        // Names with numbers, with large numbers, with leading zeros, without numbers.
        let (x, y) = (row as f64 / 7.0, row * row % 101);
        writeln!(text, "v v{row} {x} {y} 1e-3 c{};\nv far{}00000 {y} {x} 2;", row % 7, row).unwrap();
        writeln!(text, "v z00{row} {x} 3 {y}; v name{row}_ {y} 4 {x} 0 0 {};", row + 1).unwrap();
    }
}

fn faces(text: &mut String, rows: std::ops::Range<usize>) {
    for row in rows {
        let next = (row + 1) % ROWS;
        writeln!(text, "f (v{row} far{next}00000 z00{row}) c{} <.5 0 {}>;", row % 7, row % 3).unwrap();
        writeln!(text, "f big{row} (v{row} v{next} name{row}_) (z00{row} z00{next} v{row}) .{row};").unwrap();
        writeln!(text, "f (v{row} v{next} name{row}_) c{} s{};", row % 7, row / 5 % 3).unwrap();
        writeln!(text, "w (v{row} v{next}); l sun{row} 1 0 0 1 c3;").unwrap();
    }
}

fn colors(text: &mut String) {
    (0..7).for_each(|row| writeln!(text, "c c{row} .5 {row}0;").unwrap());
    (1..7).for_each(|row| writeln!(text, "c_mix c{row} c0 .{row} c6 .25;").unwrap());
    (0..3).for_each(|row| writeln!(text, "surf s{row} .{row} 0 .5;").unwrap());
}

/// Vertices, then faces, as the programs write them; or in the opposite order.
fn scene(faces_first: bool) -> String {
    let mut text = "{ head }\n".to_string();
    if faces_first {
        faces(&mut text, 0..ROWS);
        vertices(&mut text, 0..ROWS);
        colors(&mut text);
    } else {
        colors(&mut text);
        vertices(&mut text, 0..ROWS);
        faces(&mut text, 0..ROWS);
    }
    text.replace("<.5 0 2>", "").replace("<.5 0 1>", "<0 .1 0>")
}

#[test]
fn any_number_of_threads_reads_the_same() {
    let (ordered, reversed) = (scene(false), scene(true));
    check(&ordered, true);
    check(&reversed, true);
    // All kinds in turn, with unnamed colours, comments, escapes and unknown statements.
    let mut mixed = String::new();
    for start in (0..ROWS).step_by(100) {
        writeln!(mixed, "c .{start} 20;\n{{ from {start} }}").unwrap();
        faces(&mut mixed, start..start + 100);
        vertices(&mut mixed, start..start + 100);
        writeln!(
            mixed,
            "(escape {start})\nother thing {start};\ncam eye{start} -ep 0 0 1 <0 0 .2>; {{ behind }}"
        )
        .unwrap();
        writeln!(mixed, "f flat{start} (v0 v0 v0);\nw short{start} (v0);").unwrap();
    }
    colors(&mut mixed);
    check(&mixed.replace("<.5 0 2>", "").replace("<.5 0 1>", "<0 .1 0>"), true);
}

#[test]
fn the_text_may_be_split_anywhere() {
    let scene = scene(false);
    check(&format!("{{ {scene} }} {scene}"), true);
    check(&format!("def d; {scene} end; i (d -tx 1); {scene}"), true);
    check(&format!("{scene} def d; v a 0 0 0; end;\n a (d) 3;"), true);
    check(&format!("({}) {scene}", scene.replace(['(', ')'], "")), true);
    check(&scene.replace('\n', " "), true);
    check(&scene.replace(";\n", "\n;\n\n"), true);
}

#[test]
fn any_number_of_threads_gives_the_same_messages() {
    let scene = scene(false);
    for mistake in [
        "f (v0 v1 nobody) nothing;",
        "v v17 0 0 0;",
        "v far700000 0 0 0;",
        "c c1 1;",
        "surf s1 1 0 0;",
        "f (v0 v1 v2) c1 s7;",
        "v w 0 0;",
        "end;",
        "{",
        "i (d);",
    ] {
        check(&format!("{scene}{mistake}\n"), false);
        check(&format!("{mistake}\n{scene}"), false);
    }
    let two = "f (v1 v2 one);\n".to_string() + &scene + "f (v1 v2 two);\n";
    check(&two, false);
}

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
    let scene = ugparse::parse(&source, &Options::default()).unwrap().scene;
    for n_threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        let mut sent = Vec::new();
        pool.install(|| ugparse::write_to(&scene, &mut sent)).unwrap();
        assert!(sent == text.as_bytes(), "sent on {n_threads} threads");
        assert!(pool.install(|| ugparse::write(&scene)) == sent, "written on {n_threads} threads");
    }
    // The caller may be outside the thread pool.
    assert!(ugparse::write(&scene) == text.as_bytes());
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
    let scene = ugparse::parse(&source, &Options::default()).unwrap().scene;
    for room in [0, 1, text.len() / 2, text.len() - 1] {
        let error = ugparse::write_to(&scene, &mut Full(room)).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::StorageFull, "room for {room} bytes");
    }
    ugparse::write_to(&scene, &mut Full(text.len())).unwrap();
}
