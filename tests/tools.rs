//! The last of these tests: lists the checks that were skipped because of missing tools.

use ugtests::tools;

#[test]
fn skipped_checks_are_listed() {
    if tools::is_ci() {
        assert!(tools::has(&tools::TOOLS), "every check is made");
        return;
    }
    let missing = tools::TOOLS.iter().filter(|tool| !tool.is_there()).map(|tool| tool.missing());
    let only_in_ci = tools::ONLY_IN_CI.into_iter().map(tools::only_in_ci);
    let skipped: Vec<String> = missing.chain(only_in_ci).collect();
    assert!(skipped.len() >= tools::ONLY_IN_CI.len(), "{skipped:?}");
    tools::say(&format!(
        "\n{} checks were skipped; `.ci/run` makes them all:\n{}",
        skipped.len(),
        skipped.join("\n")
    ));
}
