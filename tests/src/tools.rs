//! Requirements of some checks that may be missing: external programs, and another build of ours,
//! which only `.ci/run` makes.
//!
//! A check without its tool is skipped and says so on standard error, past the capture of
//! output by the test harness. `tests/z_skipped.rs`, the last of the cross-crate tests, repeats
//! what was skipped. With `UG_CI=1`, as `.ci/run` sets it, nothing is skipped: a missing
//! tool is a failure.

use std::io::{self, Write};
use std::process::Command;

/// An external program.
#[derive(Clone, Copy, Debug)]
pub struct Tool {
    /// Its name on the path.
    pub program: &'static str,
    /// An option with which it exits at once with status 0.
    pub option: &'static str,
    /// The Debian package that contains it.
    pub package: &'static str,
    /// The checks that use it.
    pub checks: &'static str,
}

const fn tool(
    program: &'static str,
    option: &'static str,
    package: &'static str,
    checks: &'static str,
) -> Tool {
    Tool { program, option, package, checks }
}

/// Renders PostScript and PDF.
pub const GHOSTSCRIPT: Tool =
    tool("gs", "--version", "ghostscript", "PostScript and PDF files show the pixels of the PNG");

/// Renders PDF.
pub const POPPLER: Tool =
    tool("pdftoppm", "-v", "poppler-utils", "PDF figures show the same as the PNG");

/// Renders SVG.
pub const RSVG: Tool =
    tool("rsvg-convert", "--version", "librsvg2-bin", "SVG figures show the same as the PNG");

/// A browser.
pub const CHROMIUM: Tool =
    tool("chromium", "--version", "chromium", "SVG figures look the same in a browser");

/// Encodes films.
pub const FFMPEG: Tool =
    tool("ffprobe", "-version", "ffmpeg", "films are marked as others expect it");

/// Reads EXR, HDR and PFM.
pub const OIIOTOOL: Tool = tool(
    "oiiotool",
    "--help",
    "openimageio-tools",
    "files of linear light are read by others as they were written",
);

/// Runs commands on a terminal.
pub const SCRIPT: Tool = tool(
    "script",
    "--version",
    "bsdutils",
    "programs answer mistakes at a terminal as the documentation says",
);

/// Emulates other processors.
pub const QEMU: Tool = tool(
    "qemu-x86_64",
    "--version",
    "qemu-user",
    "the programs write the same bytes on processors with other instructions",
);

/// Checks man pages.
pub const MANDOC: Tool = tool("mandoc", "/dev/null", "mandoc", "man pages are valid");

/// A shell.
pub const BASH: Tool =
    tool("bash", "--version", "bash", "bash completes options and reads printed commands");

/// A shell.
pub const ZSH: Tool =
    tool("zsh", "--version", "zsh", "zsh completes options and reads printed commands");

/// The shell of Debian's scripts.
pub const DASH: Tool = tool("dash", "-n", "dash", "dash reads printed commands");

/// The shell of small systems.
pub const BUSYBOX: Tool = tool("busybox", "--help", "busybox", "busybox reads printed commands");

/// A shell.
pub const FISH: Tool = tool("fish", "--version", "fish", "fish completes options");

/// Tools for the checks in `cargo test`: all but [`QEMU`].
pub const TOOLS: [Tool; 13] = [
    GHOSTSCRIPT,
    POPPLER,
    RSVG,
    CHROMIUM,
    FFMPEG,
    OIIOTOOL,
    SCRIPT,
    MANDOC,
    BASH,
    ZSH,
    FISH,
    DASH,
    BUSYBOX,
];

/// Checks that need the programs of another build, in the folder that the variable `UG_PROGRAMS`
/// names.
pub const OF_OTHER_BUILD: [&str; 2] = [PROFILES, PROCESSORS];
/// See [`OF_OTHER_BUILD`].
pub const PROFILES: &str = "debug and release builds write the same bytes";
/// See [`OF_OTHER_BUILD`].
pub const PROCESSORS: &str = "the programs write the same bytes on emulated processors";

/// True if no check may be skipped.
pub fn is_ci() -> bool {
    std::env::var_os("UG_CI").is_some_and(|value| value == "1")
}

/// Is there another build for a check of [`OF_OTHER_BUILD`]? Prints a message if not.
pub fn has_other_build(check: &str) -> bool {
    let is_given = std::env::var_os("UG_PROGRAMS").is_some();
    if !is_given {
        say(&without_other_build(check));
    }
    is_given
}

/// The message about one of [`OF_OTHER_BUILD`].
pub fn without_other_build(check: &str) -> String {
    format!("skipped: {check}: only `.ci/run` checks it")
}

impl Tool {
    /// True if the program is installed.
    pub fn is_there(self) -> bool {
        Command::new(self.program)
            .arg(self.option)
            .output()
            .is_ok_and(|output| output.status.success())
    }

    /// The message about a missing program, with the remedy.
    pub fn missing(self) -> String {
        let Tool { program, package, checks, .. } = self;
        format!("skipped: {checks}: there is no `{program}`; install {package}")
    }
}

/// Returns false and prints a message if a program is missing and not required.
#[track_caller]
pub fn has(tools: &[Tool]) -> bool {
    let missing: Vec<Tool> = tools.iter().copied().filter(|tool| !tool.is_there()).collect();
    for tool in &missing {
        assert!(!is_ci(), "UG_CI=1, but there is no `{}`: install {}", tool.program, tool.package);
        say(&tool.missing());
    }
    missing.is_empty()
}

/// Writes a line directly to standard error, because the test harness hides the output of
/// `eprintln!` for passing tests.
pub fn say(line: &str) {
    // A closed standard error must not make a test fail.
    let _ = writeln!(io::stderr(), "{line}");
}
