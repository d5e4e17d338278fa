//! Malformed and extreme inputs break nothing: see [`ugtests::hostile`]. Cases follow from their
//! numbers; `cargo xtask hostile` runs others, for as long as it is left to.

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;
use ugmesh::MeshFormat;
use ugtesting::Random;
use ugtests::hostile::{Case, File, renderers};
use ugtests::programs;

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
