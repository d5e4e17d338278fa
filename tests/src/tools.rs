//! Checks whether external programs are installed that some tests require.

use std::process::Command;

/// A required program, an option with which it exits successfully at once, and the Debian package that contains it.
pub type Tool<'a> = (&'a str, &'a str, &'a str);

/// False, with a word about it, if a program is missing and need not be there.
///
/// With `UG_REQUIRE_TOOLS=1` all have to be there.
#[track_caller]
#[expect(clippy::print_stdout, reason = "a skipped test says so")]
pub fn has(tools: &[Tool<'_>]) -> bool {
    let must = std::env::var_os("UG_REQUIRE_TOOLS").is_some_and(|value| value == "1");
    tools.iter().all(|&(tool, option, package)| {
        let found = Command::new(tool).arg(option).output().is_ok_and(|output| output.status.success());
        assert!(found || !must, "UG_REQUIRE_TOOLS=1, but there is no `{tool}`: install {package}");
        if !found {
            println!("skipped: there is no `{tool}` on the path; install {package} to run this test");
        }
        found
    })
}
