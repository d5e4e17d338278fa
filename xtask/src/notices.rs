//! The notices that a copy of the programs has to contain: of the libraries that are linked into
//! them, of data that others made, of Rust's standard library and of the C library.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use ugtests::{scenes, tracked};

use crate::Outcome;

/// Beginnings of the names of files with licences and notices, in lower case.
const NAMES: [&str; 6] = ["licen", "copying", "copyright", "notice", "unlicense", "authors"];

/// The C library, which is linked statically.
const C_LIBRARY: &str = "\
The programs of the packages contain parts of the C library of the system on which they were built;
on Linux this is the GNU C Library, under the LGPL-2.1-or-later. Its source is that of the
distribution; `packages/build.sh` of the source of these programs links them with any version of it.
";

/// Files of Debian with the notices of the C library.
const OF_C_LIBRARY: [&str; 2] =
    ["/usr/share/doc/libc6-dev/copyright", "/usr/share/common-licenses/LGPL-2.1"];

/// What the notices are of.
#[derive(clap::Args, Default)]
pub struct Args {
    /// Crates of the workspace, such as ugpython or ugweb [default: the programs]
    #[arg(value_name = "CRATE")]
    crates: Vec<String>,
    /// The platform that they are built for [default: this one]
    #[arg(long)]
    target: Option<String>,
}

impl Args {
    /// One crate on a platform.
    pub fn of(name: &str, target: &str) -> Self {
        Self { crates: vec![name.to_owned()], target: Some(target.to_owned()) }
    }
}

/// Writes the notices as text.
pub fn write(out: &mut impl Write, args: &Args) -> Outcome<()> {
    let metadata = metadata(args.target.as_deref())?;
    let crates = linked(&metadata, &args.crates)?;
    let mut texts: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    writeln!(out, "These libraries of others, in Rust, are part of what this text comes with:\n")?;
    for package in &crates {
        let name = label(package);
        writeln!(out, "  {name}: {}", package["license"].as_str().unwrap_or("its own licence"))?;
        for text in texts_of(package)? {
            texts.entry(text).or_default().insert(name.clone());
        }
    }
    for file in tracked::files().iter().filter(|file| is_of_data(file)) {
        let name = file.parent().unwrap_or(file).strip_prefix(scenes::root())?;
        texts.entry(text(file)?).or_default().insert(name.display().to_string());
    }
    for (text, names) in texts {
        let names: Vec<String> = names.into_iter().collect();
        part(out, &names.join(", "), &text)?;
    }
    part(out, "The standard library of Rust", &standard_library()?)?;
    if args.target.as_ref().is_some_and(|target| target.starts_with("wasm")) {
        return Ok(());
    }
    part(out, "The C library", C_LIBRARY)?;
    for file in OF_C_LIBRARY.map(Path::new).into_iter().filter(|file| file.is_file()) {
        part(out, &file.display().to_string(), &text(file)?)?;
    }
    Ok(())
}

fn part(out: &mut impl Write, head: &str, text: &str) -> std::io::Result<()> {
    let line = "-".repeat(80);
    writeln!(out, "\n{line}\n{head}\n{line}\n\n{}", text.trim_end())
}

/// The packages of the workspace and of what it depends on, on a platform.
fn metadata(target: Option<&str>) -> Outcome<Value> {
    let about = output(Command::new("rustc").arg("-vV"))?;
    let host = about.lines().find_map(|line| line.strip_prefix("host: "));
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["metadata", "--locked", "--format-version", "1", "--filter-platform"]);
    cargo.arg(target.or(host).unwrap_or_default()).current_dir(scenes::root());
    Ok(serde_json::from_str(&output(&mut cargo)?)?)
}

fn output(command: &mut Command) -> Outcome<String> {
    let output = command.output()?;
    if !output.status.success() {
        return Err(format!("{command:?}: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    Ok(String::from_utf8(output.stdout)?)
}

/// The packages of others that are linked into crates of the workspace, or into the programs: their
/// dependencies and those of these, without those of build scripts and tests and without procedural
/// macros, which only run in the compiler. In order of their names.
fn linked<'m>(metadata: &'m Value, crates: &[String]) -> Outcome<Vec<&'m Value>> {
    let by_id = |list: &'static str, nodes: &'static str| {
        let rows = metadata.pointer(list).and_then(Value::as_array).into_iter().flatten();
        rows.map(move |row| (row[nodes].as_str().unwrap_or_default(), row))
            .collect::<BTreeMap<&str, &Value>>()
    };
    let (packages, nodes) = (by_id("/packages", "id"), by_id("/resolve/nodes", "id"));
    let programs = metadata["workspace_default_members"].as_array().into_iter().flatten();
    let is_named = |(_, package): &(&&str, &&Value)| {
        package["source"].is_null() && crates.iter().any(|name| package["name"] == name.as_str())
    };
    let named = packages.iter().filter(is_named).map(|(id, _)| *id);
    let mut open: Vec<&str> = match crates {
        [] => programs.filter_map(Value::as_str).collect(),
        _ => named.collect(),
    };
    if open.len() < crates.len() {
        return Err(format!("not all of {} are crates of the workspace", crates.join(", ")).into());
    }
    let mut found = BTreeSet::new();
    while let Some(id) = open.pop() {
        if found.insert(id) {
            let uses = nodes[id]["deps"].as_array().into_iter().flatten();
            let normal = uses.filter(|other| is_normal(other));
            let ids = normal.filter_map(|other| other["pkg"].as_str());
            open.extend(ids.filter(|id| !is_macro(packages[id])));
        }
    }
    let packages = found.into_iter().map(|id| packages[id]);
    let mut others: Vec<_> = packages.filter(|package| !package["source"].is_null()).collect();
    others.sort_by_key(|package| label(package));
    Ok(others)
}

fn is_normal(dependency: &Value) -> bool {
    let kinds = dependency["dep_kinds"].as_array().into_iter().flatten();
    kinds.into_iter().any(|kind| kind["kind"].is_null())
}

fn is_macro(package: &Value) -> bool {
    let targets = package["targets"].as_array().into_iter().flatten();
    targets.into_iter().any(|target| target["kind"][0] == "proc-macro")
}

/// Name and version.
fn label(package: &Value) -> String {
    let field = |name: &str| package[name].as_str().unwrap_or_default().to_owned();
    format!("{} {}", field("name"), field("version"))
}

/// The texts with which a package may be passed on: that of MIT alone where it is offered, and
/// notices.
fn texts_of(package: &Value) -> Outcome<Vec<String>> {
    let manifest = PathBuf::from(package["manifest_path"].as_str().unwrap_or_default());
    let mut files = Vec::new();
    for entry in fs::read_dir(manifest.parent().unwrap_or(&manifest))? {
        let path = entry?.path();
        if path.is_file() && NAMES.iter().any(|name| lower_name(&path).starts_with(name)) {
            files.push(path);
        }
    }
    files.sort();
    let license = package["license"].as_str().unwrap_or_default();
    let offers_mit = license.split([' ', '/']).any(|word| word == "MIT");
    if offers_mit && files.iter().any(|path| lower_name(path).contains("mit")) {
        files.retain(|path| {
            let name = lower_name(path);
            name.contains("mit") || !(name.contains("licen") || name == "copying")
        });
    }
    if files.is_empty() && offers_mit {
        return Ok(vec![of_authors(package)]);
    }
    if files.is_empty() {
        return Err(format!("{} has no text of its licence, {license}", label(package)).into());
    }
    files.iter().map(|path| text(path)).collect()
}

fn lower_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// The MIT licence of a package that has no text: ours, of its authors.
fn of_authors(package: &Value) -> String {
    let authors = package["authors"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let authors: Vec<&str> = authors.collect();
    let ours = include_str!("../../LICENSE-MIT");
    let (holder, named) = match &authors[..] {
        [] => (format!("the authors of {}", label(package)), ""),
        some => (some.join(", "), "\n"),
    };
    let lines = ours.lines().map(|line| match line.starts_with("Copyright") {
        true => format!("Copyright (c) {holder}"),
        false => line.to_owned(),
    });
    lines.collect::<Vec<_>>().join("\n") + named
}

/// Files of the repository with the licences of fonts, tables and measurements.
fn is_of_data(file: &Path) -> bool {
    let is_of_a_crate = !file.is_symlink() && file.starts_with(scenes::root().join("crates"));
    is_of_a_crate && (file.ends_with("LICENSE") || file.extension() == Some("license".as_ref()))
}

/// The text of a file, with line feeds alone.
fn text(path: &Path) -> Outcome<String> {
    let bytes = fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(String::from_utf8_lossy(&bytes).replace("\r\n", "\n").trim_end().to_owned() + "\n")
}

/// The notices of the standard library, which come with the compiler as a page.
fn standard_library() -> Outcome<String> {
    let root = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let page = Path::new(root.trim_end()).join("share/doc/rust/COPYRIGHT-library.html");
    Ok(plain(&text(&page)?))
}

/// The text of a page: tags left out, at most one empty line in a row.
fn plain(page: &str) -> String {
    let mut plain = String::new();
    for piece in page.split('<') {
        plain.push_str(piece.split_once('>').map_or(piece, |(_, text)| text));
    }
    let entities =
        [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#x27;", "'"), ("&amp;", "&")];
    let plain = entities.iter().fold(plain, |text, (name, sign)| text.replace(name, sign));
    let lines: Vec<&str> = plain.lines().map(str::trim_end).collect();
    let is_needed = |pair: &[&str]| !pair.iter().all(|line| line.is_empty());
    let kept = lines.windows(2).filter(|pair| is_needed(pair)).map(|pair| pair[1]);
    kept.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cargo names the same crates in another way, and each has its text.
    #[test]
    fn no_linked_crate_is_missing() {
        let metadata = metadata(None).expect("metadata");
        let of = |crates: &[String]| linked(&metadata, crates);
        let found: BTreeSet<String> = of(&[]).expect("crates").into_iter().map(label).collect();
        assert!(of(&["ugnone".into()]).is_err());
        let [page, raster] = ["ugweb", "ugraster"].map(|name| of(&[name.into()]).expect(name));
        assert!(page.len() > raster.len() && raster.len() > 2, "{} {}", page.len(), raster.len());
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(["tree", "--locked", "--edges", "normal,no-proc-macro", "--prefix", "none"]);
        cargo.args(["--format", "{p}"]).current_dir(scenes::root());
        let tree = output(&mut cargo).expect("a tree");
        // `NAME vVERSION`, and the folder of ours.
        let others = tree.lines().map(|line| line.trim_end_matches(" (*)"));
        let others = others.filter(|line| !line.contains('(')).map(|line| line.replace(" v", " "));
        let expected: BTreeSet<String> = others.filter(|line| !line.is_empty()).collect();
        assert!(expected.len() > 90, "{}", expected.len());
        // Features that a test turns on may add a few.
        let missing: Vec<&String> = expected.difference(&found).collect();
        assert!(missing.is_empty() && found.len() < expected.len() + 5, "{missing:?} {found:?}");

        let mut written = Vec::new();
        write(&mut written, &Args::default()).expect("notices");
        let written = String::from_utf8(written).expect("text");
        let (list, texts) = written.split_once("\n----").expect("texts");
        let heads: BTreeSet<&str> = texts.lines().flat_map(|line| line.split(", ")).collect();
        for name in &expected {
            assert!(list.contains(&format!("\n  {name}: ")), "{name} is not in the list");
            assert!(heads.contains(name.as_str()), "{name} has no text");
        }
        for data in ["crates/ugimage/font", "crates/ugskybox/stars", "crates/ugparse/src"] {
            assert!(heads.contains(data), "{data} has no text");
        }
        for words in ["Bitstream", "The Rust Standard Library is dual-licensed", "LGPL-2.1"] {
            assert!(texts.contains(words), "{words}");
        }
        assert!(!texts.contains("</"), "tags are left out");
    }

    #[test]
    fn crates_without_a_text_have_that_of_their_licence() {
        let folder = tempfile::tempdir().expect("a folder");
        let package = |license: &str| {
            let manifest = folder.path().join("Cargo.toml");
            serde_json::json!({
                "name": "lost", "version": "1.0.0", "license": license, "authors": ["A. Nobody"],
                "manifest_path": manifest.to_str()
            })
        };
        let [mit] = &texts_of(&package("MIT")).expect("a text")[..] else { panic!("one text") };
        assert!(mit.contains("Copyright (c) A. Nobody\n") && mit.contains("free of charge"));
        let error = texts_of(&package("Zlib")).expect_err("no text").to_string();
        assert_eq!(error, "lost 1.0.0 has no text of its licence, Zlib");
        // MIT alone where it is offered, and notices.
        for (name, text) in [("LICENSE-MIT", "one"), ("LICENSE-APACHE", "two"), ("NOTICE", "three")]
        {
            fs::write(folder.path().join(name), text).expect("a file");
        }
        let texts = |license| texts_of(&package(license)).expect("texts").concat();
        assert_eq!(texts("Apache-2.0/MIT"), "one\nthree\n");
        assert_eq!(texts("Apache-2.0"), "two\none\nthree\n");
    }
}
