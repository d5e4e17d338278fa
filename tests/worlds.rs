//! Laws of light in random worlds: see [`ugtests::worlds`]. Worlds follow from their numbers;
//! `cargo xtask worlds` checks others, for as long as it is left to.

use rayon::prelude::*;
use ugtests::worlds::LAWS;

#[test]
fn laws_hold() {
    let worlds: Vec<_> = LAWS.iter().flat_map(|law| (0..law.worlds).map(move |seed| (law, seed))).collect();
    let outcomes: Vec<_> = worlds.par_iter().map(|(law, seed)| law.check(*seed)).collect();
    let findings: Vec<&String> = outcomes.iter().filter_map(|outcome| outcome.as_ref().err()).collect();
    assert!(findings.is_empty(), "{} findings, such as\n{}", findings.len(), findings[0]);
    // Worlds in the dark would hold by themselves.
    for law in LAWS {
        let of_law = worlds.iter().zip(&outcomes).filter(|((of, _), _)| of.name == law.name);
        let n_lit = of_law.filter(|(_, outcome)| **outcome != Ok(0)).count() as u64;
        assert!(3 * n_lit > law.worlds, "{}: light in {n_lit} of {} worlds", law.name, law.worlds);
    }
}
