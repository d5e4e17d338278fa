//! Processors with other instruction sets give the same bytes: runs the programs on emulated ones.
//!
//! Only `.ci/run` makes this check, with the release build: emulated, other builds take minutes. It
//! requires x86-64 and Linux, where the emulator can run single programs built for the host.

#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

use std::path::Path;
use std::process::Command;

use rayon::prelude::*;
use ugtests::{programs, scenes, tools};

/// The programs as shell functions of the same names. `$1` is their folder, `$2` the emulator
/// command.
const FUNCTIONS: &str = r#"
    programs=$1 processor=$2
    uglorentz() { $processor "$programs/uglorentz" -qt "$@"; }
    ugdoppler() { $processor "$programs/ugdoppler" -qt "$@"; }
    ugrainbow() { $processor "$programs/ugrainbow" -qt -sz 160 120 "$@"; }
"#;

/// Pipes that use different loops of the programs, and a scene for each.
const PIPES: [(&str, &str); 11] = [
    ("ship", "uglorentz -vel .3 -.2 0 -in | ugdoppler | ugrainbow"),
    ("ship", "uglorentz -vel .6 0 0 -in | ugdoppler | ugrainbow -vec -dt pdf"),
    ("ship", "uglorentz -vel .9 0 0 -in | ugrainbow -aa 1 -wf -dl -gr"),
    ("teapot", "uglorentz -vel .5 .5 .5 -in | ugdoppler -ir | ugrainbow -iw -cb"),
    (
        "teapot",
        "uglorentz -vel -.9 0 0 -in -sm | ugdoppler -hd | ugrainbow -ex auto -tc filmic -aa 3 -fl triangle",
    ),
    ("tunnel", "uglorentz -vel 0 -.6 0 -cull | ugdoppler -sp -ir | ugrainbow -dt png16"),
    ("street", "uglorentz -vel 0 -.6 0 | ugrainbow -xc -aa 2"),
    ("glass", "uglorentz -vel .9 0 0 -in | ugdoppler | ugrainbow -tb -dc 4 40 -fl spline"),
    ("lattice", "uglorentz -vel 0 -.9 0 -sd 3 | ugdoppler -vr | ugrainbow -va 120 -dt exr -ch D,Z"),
    ("lamp", "uglorentz -sl 2 | ugdoppler -li | ugrainbow -bg .5 200 .2"),
    ("sphere", "uglorentz -vel .99 0 0 -in -og | ugdoppler -ct 0 | ugrainbow -dt eps"),
];

/// The output on an emulated processor, or on that of this machine.
fn written(scene: &str, pipe: &str, programs: &Path, processor: Option<&str>) -> Vec<u8> {
    let text =
        std::fs::File::open(scenes::root().join("scenes").join(format!("{scene}.ug"))).unwrap();
    let mut shell = Command::new("sh");
    shell.args(["-e", "-c", &format!("{FUNCTIONS}{pipe}"), "sh"]).arg(programs).stdin(text);
    shell.arg(processor.map(|name| format!("qemu-x86_64 -cpu {name}")).unwrap_or_default());
    let output = shell.output().unwrap();
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success() && messages.is_empty(),
        "{scene}: {pipe}: {}: {messages}",
        output.status
    );
    output.stdout
}

/// Conroe has SSE up to SSSE3, Nehalem up to 4.2; `max` has everything that is emulated, including
/// AVX2 and FMA.
#[test]
fn bytes_do_not_depend_on_the_processor() {
    if !tools::has_other_build(tools::PROCESSORS) || !tools::has(&[tools::QEMU]) {
        return;
    }
    let programs = programs::folder();
    PIPES.into_par_iter().for_each(|(scene, pipe)| {
        let here = written(scene, pipe, programs, None);
        assert!(here.len() > 1000, "{scene}: {pipe}: {} bytes", here.len());
        for processor in ["Conroe", "Nehalem", "max"] {
            let there = written(scene, pipe, programs, Some(processor));
            assert!(there == here, "{scene}: {pipe}: on {processor}");
        }
    });
}
