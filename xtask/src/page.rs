//! Builds the page of `web/`, one HTML file with the programs as WebAssembly, and tests it.

use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Map, Value};
use ugtests::scenes::{root, target_dir};

use crate::programs::{self, run};
use crate::{Outcome, notices};

const TARGET: &str = "wasm32-unknown-unknown";

/// What the page is built with.
#[derive(clap::Args)]
pub struct Args {
    /// Folder of a Rust toolchain that has the target wasm32-unknown-unknown, or the sources of
    /// std: bin/rustc, and bin/wasm-ld if rustc finds no linker [default: that of cargo, with
    /// rustup]
    #[arg(long, value_name = "FOLDER")]
    toolchain: Option<PathBuf>,
    /// Test the page in Chromium (/usr/bin/chromium), and in Firefox (/usr/bin/firefox-esr) if it is
    /// there; requires node and npm
    #[arg(long)]
    test: bool,
}

/// Builds `target/page/uglorentz.html`, and `notices.txt` beside it.
pub fn build(out: &mut impl io::Write, args: &Args) -> Outcome<()> {
    let folder = target_dir().join("page");
    let module = compile(&folder, args.toolchain.as_deref())?;
    let glue = bind(&folder, &module)?;
    let web = |name: &str| fs::read_to_string(root().join("web").join(name));
    let wasm = fs::read(folder.join("ugweb_bg.wasm"))?;
    let page = web("page.html")?
        .replace("@MODULE@", &packed(&wasm))
        .replace("@SCENES@", &packed(built_in().as_bytes()))
        .replace("@LESSONS@", &packed(lessons(&web("lessons.md")?)?.as_bytes()))
        .replace("@GLUE@", &glue)
        .replace("@WORKER@", &web("js/worker.js")?)
        .replace("@PAGE@", &joined(&root().join("web/js"))?);
    let file = folder.join("uglorentz.html");
    fs::write(&file, &page)?;
    let mut notices = Vec::new();
    notices::write(&mut notices, &notices::Args::of("ugweb", TARGET))?;
    fs::write(folder.join("notices.txt"), notices)?;
    let megabytes = |bytes: usize| bytes as f64 / 1e6;
    writeln!(
        out,
        "{}: {:.2} MB, of which the module has {:.2} MB ({:.2} MB unpacked)",
        file.display(),
        megabytes(page.len()),
        megabytes(packed(&wasm).len()),
        megabytes(wasm.len())
    )?;
    if args.test {
        test(&folder, &file)?;
    }
    Ok(())
}

/// Compiles the crate `ugweb` to WebAssembly.
fn compile(folder: &Path, toolchain: Option<&Path>) -> io::Result<PathBuf> {
    let build = folder.join("build");
    let mut cargo = Command::new(env!("CARGO"));
    // Optimisation for size, or at link time, made the packed module 4 and 5 percent smaller, not
    // faster, and took minutes.
    cargo
        .args(["rustc", "--release", "-p", "ugweb", "--lib", "--target", TARGET, "--target-dir"])
        .arg(&build);
    cargo.env("RUSTFLAGS", "-Ctarget-feature=+simd128").current_dir(root());
    match toolchain {
        Some(toolchain) => use_toolchain(&mut cargo, toolchain)?,
        // Without rustup, the target may be there nevertheless; cargo says if not.
        None => drop(Command::new("rustup").args(["target", "add", TARGET]).status()),
    }
    // wasm-bindgen reads a section that stripping removes. The stack has 8 MB, as programs on Linux
    // have it, not 1 MB.
    run(cargo.args(["--", "-Cstrip=none", "-Clink-arg=-zstack-size=8388608"]))?;
    Ok(build.join(TARGET).join("release/ugweb.wasm"))
}

/// Lets cargo use the compiler and the linker in a folder.
fn use_toolchain(cargo: &mut Command, toolchain: &Path) -> io::Result<()> {
    let has_ending = |path: &Path, part: &str| {
        path.file_name().and_then(OsStr::to_str).is_some_and(|name| name.contains(part))
    };
    let entries = |folder: &Path| -> io::Result<Vec<PathBuf>> {
        fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path())).collect()
    };
    let (bin, lib) = (toolchain.join("bin"), toolchain.join("lib"));
    cargo.env("RUSTC", bin.join("rustc"));
    if let Some(linker) = entries(&bin)?.iter().find(|path| has_ending(path, "wasm-ld")) {
        cargo.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker);
    }
    let below = entries(&lib)?.into_iter().flat_map(|folder| [folder.join("lib"), folder]);
    let libraries = below.filter(|folder| {
        entries(folder).is_ok_and(|files| files.iter().any(|file| has_ending(file, ".so")))
    });
    cargo.env("LD_LIBRARY_PATH", std::env::join_paths(libraries).map_err(io::Error::other)?);
    if !lib.join("rustlib").join(TARGET).exists() {
        cargo.arg("-Zbuild-std=std,panic_abort").env("RUSTC_BOOTSTRAP", "1");
    }
    Ok(())
}

/// Writes the module and its JavaScript by wasm-bindgen, which is installed if need be, and returns
/// the JavaScript.
fn bind(folder: &Path, module: &Path) -> io::Result<String> {
    let lock = fs::read_to_string(root().join("Cargo.lock"))?;
    let version = lock
        .split("name = \"wasm-bindgen\"\nversion = \"")
        .nth(1)
        .and_then(|rest| rest.split('"').next());
    let version = version.ok_or_else(|| io::Error::other("Cargo.lock has no wasm-bindgen"))?;
    let tools = folder.join("tools");
    let tool = tools.join("bin/wasm-bindgen");
    let installed = Command::new(&tool).arg("--version").output();
    if !installed
        .is_ok_and(|output| String::from_utf8_lossy(&output.stdout).trim().ends_with(version))
    {
        let mut install = Command::new(env!("CARGO"));
        install.args("install wasm-bindgen-cli --no-default-features --version".split(' '));
        run(install.args([version, "--root"]).arg(&tools))?;
    }
    let mut bind = Command::new(&tool);
    bind.args("--target no-modules --no-typescript --remove-name-section".split(' '));
    bind.args("--remove-producers-section --out-name ugweb --out-dir".split(' '));
    run(bind.arg(folder).arg(module))?;
    fs::read_to_string(folder.join("ugweb.js"))
}

/// The files of `ugparse example` as JSON, from their names to their text, or to their bytes.
fn built_in() -> String {
    let content = |bytes: &[u8]| match std::str::from_utf8(bytes) {
        Ok(text) => Value::from(text),
        Err(_) => Value::from(bytes),
    };
    let files = ugparse::EXAMPLE_FILES.map(|(name, bytes)| (name.to_owned(), content(bytes)));
    Value::Object(Map::from_iter(files)).to_string()
}

/// The modules of a folder as one script, each behind those that it imports. A page from a disk
/// cannot load modules, so imports and the word `export` are left out.
fn joined(folder: &Path) -> io::Result<String> {
    let mut script = "'use strict';\n".to_owned();
    add_module(folder, "main.js", &mut Vec::new(), &mut script)?;
    Ok(script)
}

fn add_module(
    folder: &Path,
    name: &str,
    added: &mut Vec<String>,
    script: &mut String,
) -> io::Result<()> {
    if added.iter().any(|known| known == name) {
        return Ok(());
    }
    added.push(name.to_owned());
    let text = fs::read_to_string(folder.join(name))?;
    for line in text.lines() {
        if let Some((_, from)) = line.strip_prefix("import ").and_then(|l| l.split_once("'./")) {
            add_module(folder, from.trim_end_matches("';"), added, script)?;
        }
    }
    for line in text.lines().filter(|line| !line.starts_with("import ")) {
        script.push_str(line.strip_prefix("export ").unwrap_or(line));
        script.push('\n');
    }
    Ok(())
}

/// The lessons of the scenes as JSON: rows of a table, with questions and answers of
/// `docs/teaching.md` where a row names one of its experiments.
fn lessons(table: &str) -> io::Result<String> {
    let teaching = fs::read_to_string(root().join("docs/teaching.md"))?;
    let experiments: Vec<&str> = teaching.split("\n## ").collect();
    let part = |number: &str, word: &str| {
        let experiment = experiments.iter().find(|text| text.starts_with(&format!("{number}.")));
        let begin = experiment?.split_once(&format!("**{word}.** "))?.1;
        Some(plain(begin.split("\n\n").next()?))
    };
    let rows = table.lines().filter(|line| line.starts_with("| ")).skip(2);
    let lesson = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
        let [scene, seen, why, question, answer] = cells[..] else { return None };
        let (question, answer) = match question.strip_prefix("→ ") {
            Some(number) => {
                let answer = [part(number, "Answer")?, part(number, "By hand")?].join(" ");
                (part(number, "Question")?, answer)
            }
            None => (plain(question), plain(answer)),
        };
        let parts = [("seen", plain(seen)), ("why", plain(why))];
        let parts = parts.into_iter().chain([("question", question), ("answer", answer)]);
        let parts = parts.map(|(name, text)| (name.to_owned(), Value::from(text)));
        Some((scene.to_owned(), Value::Object(Map::from_iter(parts))))
    };
    let lessons: Option<Map<_, _>> = rows.map(lesson).collect();
    let refused = || io::Error::other("web/lessons.md: a row has no five cells, or no experiment");
    Ok(Value::Object(lessons.ok_or_else(refused)?).to_string())
}

/// Text without the links, code and line breaks of Markdown.
fn plain(markdown: &str) -> String {
    let mut text = String::new();
    let mut rest = markdown;
    while let Some((before, link)) = rest.split_once('[') {
        let Some((name, behind)) = link.split_once(']') else { break };
        text = text + before + name;
        rest = behind.strip_prefix('(').and_then(|b| b.split_once(')')).map_or(behind, |b| b.1);
    }
    (text + rest).replace(['`', '*'], "").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Bytes as a browser unpacks them: base64 of zlib.
fn packed(bytes: &[u8]) -> String {
    STANDARD.encode(miniz_oxide::deflate::compress_to_vec_zlib(bytes, 10))
}

/// Checks the types of the page's modules, drives it in Chromium, and in Firefox if that is installed,
/// and compares what it saves with what the programs write.
fn test(folder: &Path, page: &Path) -> io::Result<()> {
    let mut npm = Command::new("npm");
    npm.args(["install", "--no-save", "--no-fund", "--no-audit", "--prefix"]).arg(folder).args([
        "playwright-core@1",
        "puppeteer-core",
        "typescript@7",
    ]);
    run(&mut npm)?;
    // The types of the modules, which Chromium runs without them.
    let mut types = Command::new(folder.join("node_modules/.bin/tsc"));
    run(types.arg("--project").arg(root().join("web/js/tsconfig.json")))?;
    for name in ["test.mjs", "firefox.mjs"] {
        let script = folder.join(name);
        fs::copy(root().join("web").join(name), &script)?;
        let mut node = Command::new("node");
        node.arg(script).arg(page).arg(programs::released()).arg(root().join("scenes"));
        run(&mut node)?;
    }
    Ok(())
}
