//! Malformed and extreme inputs break nothing: see [`ugtests::hostile`]. Cases follow from their
//! numbers; `cargo xtask hostile` runs others, for as long as it is left to.

use std::fs;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;
use ugimage::Format;
use ugmesh::MeshFormat;
use ugtesting::Random;
use ugtests::hostile::{Case, Edge, File, renderers};
use ugtests::{programs, scenes};

/// Fails with all findings at once.
#[track_caller]
fn assert_none(findings: &[String]) {
    assert!(findings.is_empty(), "{} findings\n\n{}", findings.len(), findings.join("\n\n"));
}

#[test]
fn programs_hold() {
    const CASES: Range<u64> = 0..600;
    let programs = programs::of_this_profile();
    let results: Vec<_> = CASES.into_par_iter().map(|seed| Case::new(seed).run(&programs)).collect();
    let findings: Vec<String> = results.iter().filter_map(|result| result.clone().err()).collect();
    assert_none(&findings);
    // Cases that are all refused would test the messages alone.
    let n_drawn = results.iter().filter(|result| **result == Ok(true)).count();
    assert!((250..400).contains(&n_drawn), "{n_drawn} pipes succeed");
}

#[test]
fn renderers_agree() {
    const CASES: u64 = 150;
    let results: Vec<_> = (0..CASES)
        .into_par_iter()
        .map(|seed| renderers::check(seed).map_err(|why| format!("{seed}: {why}")))
        .collect();
    assert_none(&results.iter().filter_map(|result| result.clone().err()).collect::<Vec<_>>());
    let n_drawn = results.iter().filter(|result| **result == Ok(true)).count();
    assert!(n_drawn > 75, "{n_drawn} show something");
}

#[test]
fn libraries_hold() {
    let kinds = [
        (File::Scene, 2000),
        (File::Mesh(MeshFormat::Obj), 500),
        (File::Mesh(MeshFormat::Off), 500),
        (File::Mesh(MeshFormat::Ply), 500),
        (File::Mesh(MeshFormat::Stl), 500),
        (File::Mesh(MeshFormat::Gltf), 500),
        (File::Picture, 300),
        (File::Panorama, 500),
        (File::Stars, 500),
        (File::History, 500),
        (File::Figure(Format::Svg), 1000),
        (File::Figure(Format::Pdf), 1000),
    ];
    for (file, n_cases) in kinds {
        let finding = |seed: u64| {
            let bytes = file.generate(&mut Random(seed));
            // Names the case of a panic, too.
            let held = catch_unwind(AssertUnwindSafe(|| file.check(&bytes)));
            let held = held.unwrap_or_else(|_| Err("panics".to_owned()));
            held.err().map(|finding| format!("{file:?} {seed}: {finding}"))
        };
        assert_none(&(0..n_cases).into_par_iter().filter_map(finding).collect::<Vec<_>>());
    }
}

/// Motions that once took too long, too much memory, or a message with NaN.
#[test]
fn motions_hold() {
    let body = "v a 0 0 0 ; v b .5 0 0 ; v c 0 .5 0 ; f (a b c) <m> ;\n";
    let pieces = |n: i32, first: i32| {
        let piece = |idx: i32| format!(" -acc {} 0 0 {} {}", 0.1 - 0.2 * (idx & 1) as f64, idx, idx + 1);
        (first..first + n).map(piece).collect::<String>()
    };
    let grid = |n: i32| {
        let row = |k: i32| format!("v g{k} {} {} 0 ;\n", k % 50, k / 50);
        let face = |k: i32| format!("f (g{k} g{} g{}) <m> ;\n", k + 1, k + 50);
        (0..n).map(row).chain((0..n - 50).map(face)).collect::<String>()
    };
    let riders = |n: i32| {
        let rider = |k: i32| format!("motion n{k} -on m ;\nf (a b c) <n{k}> ;\n");
        (0..n).map(rider).collect::<String>()
    };
    let orbit = fs::read_to_string(scenes::root().join("scenes/orbit.ug")).expect("a scene");
    let rows: [(&str, String, &[&str]); 12] = [
        ("turns that are not known", orbit.clone(), &["uglorentz", "-ti", "-1e300"]),
        ("turns that are hardly known", orbit, &["uglorentz", "-ti", "-1e12"]),
        (
            "no own time resolves it",
            format!("motion m -at 1e300 0 0 -orbit 0 0 0 0 0 1 1e-301 ;\n{body}"),
            PHOTON,
        ),
        ("its place overflows", format!("motion m -spin 0 0 1 -shift 1e308 1e308 0 0 ;\n{body}"), PHOTON),
        ("its acceleration overflows", format!("motion m -acc 1e308 0 0 -3 -2 ;\n{body}"), CHECK),
        ("two at all times", format!("motion m -spin 0 0 .1 -spin 0 .1 0 ;\n{body}"), CHECK),
        ("a flat orbit", format!("motion m -at 1e300 0 0 -orbit 0 0 0 0 0 1 0 ;\n{body}"), CHECK),
        ("fast spin", format!("motion m -spin 1e17 1e17 1 -orbit .1 .1 0 0 0 1 0 ;\n{body}"), CHECK),
        ("many pieces in the past", format!("motion m{} ;\n{body}", pieces(200_000, -300_000)), CHECK),
        (
            "many pieces and vertices",
            format!("motion m{} ;\n{}", pieces(20_000, 0).replace("0.1", "0.001"), grid(5000)),
            CHECK,
        ),
        ("many riders", format!("motion m{} ;\n{body}{}", pieces(5000, 0), riders(1000)), CHECK),
        ("some riders", format!("motion m{} ;\n{body}{}", pieces(500, 0), riders(200)), CHECK),
    ];
    let programs = programs::of_this_profile();
    let run = |(name, text, words): (&str, String, &[&str])| {
        let stages = vec![words.iter().copied().map(str::to_owned).collect()];
        let files = vec![("scene.ug".to_owned(), text.into_bytes())];
        let case = Case { seed: 0, files, stages, edge: Edge::Plain, is_repeated: false };
        case.run(&programs).err().map(|finding| format!("{name}: {finding}"))
    };
    assert_none(&rows.into_par_iter().filter_map(run).collect::<Vec<_>>());
}

const PHOTON: &[&str] = &["ugphoton", "-sz", "40", "30"];
const CHECK: &[&str] = &["ugparse", "check"];

/// Figures that once took too long or too much memory, or made a sheet that other programs refuse.
#[test]
fn figures_hold() {
    let page = |kids: &str, more: &str, resources: String| {
        vec![
            "<</Type/Catalog/Pages 2 0 R>>".to_owned(),
            format!("<</Type/Pages/Kids[{kids}]/X<<{more}>>>>"),
            "<</Type/Page/MediaBox[0 0 9 9]/Contents 4 0 R/Resources<</A 5 0 R>>>>".to_owned(),
            "<</Length 3>>stream\nq Q\nendstream".to_owned(),
            resources,
        ]
    };
    let numbers = 6..3000;
    let within: String = numbers.clone().map(|number| format!("({number} 0 obj ")).collect();
    let refs: String = numbers.clone().map(|number| format!("{number} 0 R ")).collect();
    let within = format!("[{refs} {within}0{}]", ")".repeat(numbers.len()));
    let entry = "0000000000 00000 n \n";
    let circle = pdf(&page("3 0 R", "", "0".to_owned()), &format!("0 200000\n{}", entry.repeat(200_000)));
    let rows: [(&str, &str, String, bool); 8] = [
        ("objects within each other", "a.pdf", pdf(&page("3 0 R", "", within), ""), false),
        (
            "pages in a circle",
            "a.pdf",
            pdf(&page("2 0 R", &"/ 1".repeat(250_000), "0".to_owned()), ""),
            false,
        ),
        (
            "tables in a circle",
            "a.pdf",
            circle.replace("/Root", &format!("/Prev {}/Root", table(&circle))),
            false,
        ),
        ("a number without end", "a.pdf", pdf(&page("3 0 R", "", "9".repeat(400)), ""), false),
        // Where overflow is checked, it panicked.
        ("the least integer", "a.pdf", pdf(&page("3 0 R", "", "-2147483649".to_owned()), ""), true),
        ("a figure", "a.pdf", pdf(&page("3 0 R", "/ 1", "9".to_owned()), ""), true),
        ("an entity in an attribute", "a.svg", "<svg width='9' height='9' id='&a;'/>".to_owned(), false),
        ("many attributes", "a.svg", format!("<svg width='9' height='9'{}/>", many_attributes()), true),
    ];
    let programs = programs::of_this_profile();
    let run = |(name, file, text, is_drawn): (&str, &str, String, bool)| {
        let stages = vec![["ugsheet", file, file].map(str::to_owned).to_vec()];
        let files = vec![(file.to_owned(), text.into_bytes())];
        let case = Case { seed: 0, files, stages, edge: Edge::Plain, is_repeated: false };
        match case.run(&programs) {
            Ok(drawn) if drawn == is_drawn => None,
            Ok(drawn) => Some(format!("{name}: drawn: {drawn}")),
            Err(finding) => Some(format!("{name}: {finding}")),
        }
    };
    assert_none(&rows.into_par_iter().filter_map(run).collect::<Vec<_>>());
}

fn many_attributes() -> String {
    (0..100_000).map(|idx| format!(" a{idx}=''")).collect()
}

/// A PDF file of objects, and of those that begin `(NUMBER 0 obj` within them. `more`: further rows
/// of its table.
fn pdf(objects: &[String], more: &str) -> String {
    let mut file = "%PDF-1.4\n".to_owned();
    let mut places = Vec::new();
    for (idx, object) in objects.iter().enumerate() {
        places.push(file.len());
        file += &format!("{} 0 obj\n{object}\nendobj\n", idx + 1);
    }
    places.extend(file.match_indices('(').map(|(at, _)| at + 1));
    let rows: String = places.iter().map(|place| format!("{place:010} 00000 n \n")).collect();
    let table = file.len();
    file + &format!(
        "xref\n0 {}\n0000000000 65535 f \n{rows}{more}trailer\n<</Root 1 0 R>>\nstartxref\n{table}\n%%EOF\n",
        places.len() + 1
    )
}

/// Where the table of a PDF file is.
fn table(file: &str) -> usize {
    file.find("xref").expect("the file has a table")
}
