//! Third-party crates: licences, sources and duplicates, in both workspaces.

use std::collections::{BTreeMap, BTreeSet};
use std::iter::Peekable;
use std::path::Path;
use std::process::Command;
use std::str::SplitWhitespace;

use serde_json::Value;

/// Licences that the programs can be given away under.
const LICENSES: [&str; 8] =
    ["0BSD", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "MIT", "NCSA", "Unicode-3.0", "Zlib"];

const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// A package of a lock file.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Locked {
    pub name: String,
    version: String,
    source: Option<String>,
    checksum: Option<String>,
}

/// The packages of a lock file.
pub fn locked(text: &str) -> Vec<Locked> {
    let package = |block: &str| {
        let field = |key: &str| {
            let value = |line: &str| {
                Some(line.strip_prefix(key)?.strip_prefix(" = \"")?.strip_suffix('"')?.to_owned())
            };
            block.lines().find_map(value)
        };
        Locked {
            name: field("name").unwrap_or_default(),
            version: field("version").unwrap_or_default(),
            source: field("source"),
            checksum: field("checksum"),
        }
    };
    text.split("[[package]]").skip(1).map(package).collect()
}

/// Packages that are not of crates.io, have no checksum, or are there in two versions. `file`: the
/// name of the lock file.
pub fn of_lock_file(file: &str, packages: &[Locked]) -> Vec<String> {
    let mut findings = Vec::new();
    let mut versions: BTreeMap<&str, usize> = BTreeMap::new();
    for package in packages {
        *versions.entry(&package.name).or_default() += 1;
        let Some(source) = &package.source else { continue };
        if source != REGISTRY {
            findings.push(format!(
                "{file}: {} is from {source}: use a version of crates.io",
                package.name
            ));
        } else if package.checksum.is_none() {
            findings.push(format!("{file}: {} has no checksum", package.name));
        }
    }
    for (name, n) in versions {
        if n > 1 {
            findings.push(format!(
                "{file}: {name} is there {n} times: `cargo tree -d` shows who requires it; take versions that agree"
            ));
        }
    }
    findings
}

/// Crates of the fuzz targets in other versions than the programs are built with.
pub fn differences(ours: &[Locked], fuzz: &[Locked]) -> Vec<String> {
    let names: BTreeSet<&str> = ours.iter().map(|package| package.name.as_str()).collect();
    let ours: BTreeSet<_> = ours.iter().map(|package| (&package.name, &package.version)).collect();
    let is_other = |package: &&Locked| {
        names.contains(package.name.as_str()) && !ours.contains(&(&package.name, &package.version))
    };
    let finding = |package: &Locked| {
        format!(
            "fuzz/Cargo.lock: {} {} is not the version of Cargo.lock: `cp Cargo.lock fuzz/` and \
             `cargo metadata --manifest-path fuzz/Cargo.toml`",
            package.name, package.version
        )
    };
    fuzz.iter().filter(is_other).map(finding).collect()
}

/// Licences that are not allowed, and the number of crates that were looked at.
pub fn of_licenses(folder: &Path) -> (Vec<String>, usize) {
    let packages = packages(folder);
    let finding = |package: &Value| {
        let license = package["license"].as_str().unwrap_or("no licence");
        let is_allowed = is_allowed(license);
        (!is_allowed).then(|| {
            format!("{}: {license} is not allowed in tests/tidy/dependencies.rs", package["name"])
        })
    };
    (packages.iter().filter_map(finding).collect(), packages.len())
}

/// Packages that state a newer version of Rust than `stated`, and the number of those that state
/// one.
pub fn newer_than(folder: &Path, stated: &str) -> (Vec<String>, usize) {
    let number = |version: &str| -> Vec<u32> {
        version.split('.').map(|part| part.parse().expect("a number")).collect()
    };
    let packages = packages(folder);
    let states = |package: &Value| Some(package["rust_version"].as_str()?.to_owned());
    let finding = |package: &Value| {
        let version = states(package)?;
        let is_newer = number(&version) > number(stated);
        is_newer.then(|| {
            let name = &package["name"];
            format!("{name} needs Rust {version}: take an older version, or raise `rust-version`")
        })
    };
    let n_stated = packages.iter().filter_map(states).count();
    (packages.iter().filter_map(finding).collect(), n_stated)
}

/// The packages of the workspace and its dependencies. Without `UG_CI` these are the crates of this
/// platform, since others need not be downloaded.
fn packages(folder: &Path) -> Vec<Value> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["metadata", "--locked", "--format-version", "1"]).current_dir(folder);
    if std::env::var_os("UG_CI").is_none() {
        cargo.args(["--offline", "--filter-platform", &host()]);
    }
    let mut metadata: Value = serde_json::from_slice(&output(&mut cargo)).unwrap();
    let Value::Array(packages) = metadata["packages"].take() else { panic!("no packages") };
    packages
}

/// The packages, with their versions, that a library without its default features is built of.
pub fn built(folder: &Path, library: &str) -> BTreeSet<String> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args([
        "tree",
        "--offline",
        "--no-default-features",
        "--edges",
        "normal",
        "--prefix",
        "none",
    ]);
    cargo.args(["--package", library, "--format", "{p}"]).current_dir(folder);
    // Cargo marks packages that it lists again.
    String::from_utf8(output(&mut cargo))
        .unwrap()
        .lines()
        .map(|line| line.replace(" (*)", ""))
        .collect()
}

/// The platform that this is built for, and its programs run on.
fn host() -> String {
    let about = output(Command::new("rustc").arg("-vV"));
    let about = String::from_utf8(about).unwrap();
    about.lines().find_map(|line| line.strip_prefix("host: ")).unwrap().to_owned()
}

fn output(command: &mut Command) -> Vec<u8> {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// True if an SPDX expression offers an allowed licence. `/` is the old form of `OR`. AND binds
/// more tightly than OR.
pub fn is_allowed(expression: &str) -> bool {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let mut words = spaced.split_whitespace().peekable();
    let allowed = any_of(&mut words);
    allowed && words.next().is_none()
}

type Words<'a> = Peekable<SplitWhitespace<'a>>;

fn any_of(words: &mut Words<'_>) -> bool {
    let mut allowed = all_of(words);
    while words.next_if_eq(&"OR").is_some() {
        allowed |= all_of(words);
    }
    allowed
}

fn all_of(words: &mut Words<'_>) -> bool {
    let mut allowed = one(words);
    while words.next_if_eq(&"AND").is_some() {
        allowed &= one(words);
    }
    allowed
}

/// A licence, or an expression in parentheses. An exception (`WITH`) only grants more.
fn one(words: &mut Words<'_>) -> bool {
    let allowed = match words.next() {
        Some("(") => any_of(words) && words.next() == Some(")"),
        Some(license) => LICENSES.contains(&license),
        None => false,
    };
    if words.next_if_eq(&"WITH").is_some() {
        words.next();
    }
    allowed
}
