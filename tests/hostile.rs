//! Malformed and extreme inputs break nothing: see [`ugtests::hostile`]. Cases follow from their
//! numbers; `cargo xtask hostile` runs others, for as long as it is left to, and `fuzz/` in memory.

use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;
use ugtesting::Random;
use ugtests::hostile::{Case, File, Kind, MESHES};
use ugtests::{programs, scenes};

/// Fails with all findings at once.
#[track_caller]
fn assert_none(findings: &[String]) {
    assert!(findings.is_empty(), "{} findings\n\n{}", findings.len(), findings.join("\n\n"));
}

/// Runs cases of a kind, and checks the part of them whose pipes succeed: cases that are all
/// refused would test the messages alone.
#[track_caller]
fn check_programs(kind: Kind, n_cases: u64, least: f64) {
    let run = |seed| Case::new(seed, kind).run(programs::folder());
    let results: Vec<_> = (0..n_cases).into_par_iter().map(run).collect();
    assert_none(&results.iter().filter_map(|result| result.clone().err()).collect::<Vec<_>>());
    let n_drawn = results.iter().filter(|result| **result == Ok(true)).count();
    assert!(n_drawn as f64 > least * n_cases as f64, "{n_drawn} of {n_cases} pipes succeed");
}

#[test]
fn programs_hold_of_mild_input() {
    check_programs(Kind::Mild, 80, 0.3);
}

#[test]
fn programs_hold_of_wild_input() {
    check_programs(Kind::Wild, 30, 0.02);
}

#[test]
fn libraries_hold() {
    let others = [File::Picture, File::Panorama, File::Stars, File::History];
    let kinds = MESHES.map(File::Mesh).into_iter().chain(others).map(|file| (file, 20));
    for (file, n_cases) in kinds.chain([(File::Scene, 80)]) {
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
        let piece =
            |idx: i32| format!(" -acc {} 0 0 {} {}", 0.1 - 0.2 * (idx & 1) as f64, idx, idx + 1);
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
    let orbit = String::from_utf8(scenes::text("orbit")).unwrap();
    let rows: [(&str, String, &[&str]); 12] = [
        ("turns that are not known", orbit.clone(), &["uglorentz", "-ti", "-1e300"]),
        ("turns that are hardly known", orbit, &["uglorentz", "-ti", "-1e12"]),
        (
            "no own time resolves it",
            format!("motion m -at 1e300 0 0 -orbit 0 0 0 0 0 1 1e-301 ;\n{body}"),
            PHOTON,
        ),
        (
            "its place overflows",
            format!("motion m -spin 0 0 1 -shift 1e308 1e308 0 0 ;\n{body}"),
            PHOTON,
        ),
        ("its acceleration overflows", format!("motion m -acc 1e308 0 0 -3 -2 ;\n{body}"), CHECK),
        ("two at all times", format!("motion m -spin 0 0 .1 -spin 0 .1 0 ;\n{body}"), CHECK),
        ("a flat orbit", format!("motion m -at 1e300 0 0 -orbit 0 0 0 0 0 1 0 ;\n{body}"), CHECK),
        (
            "fast spin",
            format!("motion m -spin 1e17 1e17 1 -orbit .1 .1 0 0 0 1 0 ;\n{body}"),
            CHECK,
        ),
        (
            "many pieces in the past",
            format!("motion m{} ;\n{body}", pieces(200_000, -300_000)),
            CHECK,
        ),
        (
            "many pieces and vertices",
            format!("motion m{} ;\n{}", pieces(20_000, 0).replace("0.1", "0.001"), grid(5000)),
            CHECK,
        ),
        ("many riders", format!("motion m{} ;\n{body}{}", pieces(5000, 0), riders(1000)), CHECK),
        ("some riders", format!("motion m{} ;\n{body}{}", pieces(500, 0), riders(200)), CHECK),
    ];
    let run = |(name, text, words): (&str, String, &[&str])| {
        let stages = vec![words.iter().copied().map(str::to_owned).collect()];
        let files = vec![("scene.ug".to_owned(), text.into_bytes())];
        let case = Case { seed: 1, files, stages };
        case.run(programs::folder()).err().map(|finding| format!("{name}: {finding}"))
    };
    assert_none(&rows.into_par_iter().filter_map(run).collect::<Vec<_>>());
}

const PHOTON: &[&str] = &["ugphoton", "-sz", "40", "30"];
const CHECK: &[&str] = &["ugparse", "check"];
