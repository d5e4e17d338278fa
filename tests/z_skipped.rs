//! The last of these tests, by its name: lists the checks that were skipped.

use ugtests::tools;

#[test]
fn skipped_checks_are_listed() {
    if tools::is_ci() {
        assert!(tools::has(&tools::TOOLS), "every check is made");
        return;
    }
    let missing = tools::TOOLS.iter().filter(|tool| !tool.is_there()).map(|tool| tool.missing());
    let others = tools::OF_OTHER_BUILD.into_iter().map(tools::without_other_build);
    let skipped: Vec<String> = missing.chain(others).collect();
    tools::say(&format!(
        "\n{} checks were skipped; `.ci/run` makes them all:\n{}",
        skipped.len(),
        skipped.join("\n")
    ));
}
