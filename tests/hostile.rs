//! Malformed and extreme inputs break nothing: see [`ugtests::hostile`]. Cases follow from their
//! numbers; `cargo xtask hostile` runs others, for as long as it is left to.

use std::fs;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;
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
