//! Shell commands in a folder of their own, with the programs on the path.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

use crate::{programs, scenes};

/// A temporary folder in which scripts run.
pub struct Shell(TempDir);

impl Shell {
    /// A folder with these files of `scenes/`.
    pub fn new(files: &[&str]) -> Self {
        let shell = Self(tempfile::tempdir().expect("a temporary folder"));
        let scenes = scenes::root().join("scenes");
        for name in files {
            fs::copy(scenes.join(name), shell.path(name))
                .unwrap_or_else(|error| panic!("{name}: {error}"));
        }
        shell
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        self.0.path()
    }

    /// The path of a file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder().join(name)
    }

    /// Writes a file.
    #[track_caller]
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap_or_else(|error| panic!("{name}: {error}"));
    }

    /// The content of a file.
    #[track_caller]
    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The pixels of a PNG file.
    #[track_caller]
    pub fn pixels(&self, name: &str) -> Vec<[u8; 4]> {
        let read = ugimage::read_png(&self.read(name), &ugimage::PictureLimits::default());
        read.unwrap_or_else(|error| panic!("{name}: {error}")).0.pixels().to_vec()
    }

    /// `sh -c SCRIPT`
    pub fn command(&self, script: &str) -> Command {
        let mut shell = Command::new("sh");
        shell.args(["-c", script]).current_dir(self.folder()).env("PATH", programs::path());
        shell.env_remove("RUST_BACKTRACE");
        shell
    }

    /// Runs a script.
    pub fn output(&self, script: &str) -> Output {
        self.command(script).output().expect("a shell runs")
    }

    /// Runs a script that succeeds; returns what it wrote to standard output and to standard error.
    #[track_caller]
    pub fn run(&self, script: &str) -> [String; 2] {
        let output = self.output(script);
        let [out, messages] =
            [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into());
        assert!(output.status.success(), "{script}: {messages}");
        [out, messages]
    }

    /// Status and messages of a script that fails.
    #[track_caller]
    pub fn fail(&self, script: &str) -> (Option<i32>, String) {
        let output = self.output(script);
        assert!(!output.status.success(), "{script}");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    }
}
