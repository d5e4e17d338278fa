//! No circle of imports between the folders and files at the top of a crate.
//!
//! A circle has no bottom: none of its files can be read, tested or moved without all the others.

use std::collections::{BTreeMap, BTreeSet};

/// Imports between the top-level modules of a crate: from each module to those it uses, each with
/// the first file that imports it.
type Imports = BTreeMap<String, BTreeMap<String, String>>;

/// The circles of imports in a crate, one message each. `files`: paths below its `src`, and their
/// texts.
pub fn circles(krate: &str, files: &BTreeMap<String, String>) -> Vec<String> {
    let imports = imports(files);
    let mut found = BTreeSet::new();
    for start in imports.keys() {
        if let Some(circle) = shortest_circle(&imports, start) {
            found.insert(circle);
        }
    }
    let message = |circle: &Vec<String>| {
        let steps = circle.iter().zip(circle.iter().cycle().skip(1));
        let steps: Vec<String> =
            steps.map(|(from, to)| format!("`{to}` is used by src/{}", imports[from][to])).collect();
        format!(
            "crates/{krate}: a circle of imports between {}: {}. Move what two of them need into a file below both, \
             or pass it in as an argument",
            circle.join(", "),
            steps.join("; ")
        )
    };
    found.iter().map(message).collect()
}

/// A shortest circle through a module, beginning with the module that sorts first.
fn shortest_circle(imports: &Imports, start: &str) -> Option<Vec<String>> {
    // Breadth first; each module with the one it was reached from.
    let mut before: BTreeMap<&str, &str> = BTreeMap::new();
    let mut queue = vec![start];
    let mut next = 0;
    while let Some(&module) = queue.get(next) {
        next += 1;
        for other in imports[module].keys().map(String::as_str) {
            if other == start {
                let mut circle = vec![module.to_string()];
                while circle[circle.len() - 1] != start {
                    circle.push(before[circle[circle.len() - 1].as_str()].to_string());
                }
                circle.reverse();
                let first = (0..circle.len()).min_by_key(|&idx| &circle[idx])?;
                circle.rotate_left(first);
                return Some(circle);
            }
            if !before.contains_key(other) {
                before.insert(other, module);
                queue.push(other);
            }
        }
    }
    None
}

fn imports(files: &BTreeMap<String, String>) -> Imports {
    let is_module =
        |path: &&String| !matches!(path.as_str(), "lib.rs" | "main.rs") && !path.starts_with("bin/");
    let paths: Vec<&String> = files.keys().filter(is_module).collect();
    let modules: BTreeSet<&str> = paths.iter().map(|path| module_of(path)).collect();
    let exported = files.get("lib.rs").map_or_else(BTreeMap::new, |text| exports(&code(text)));
    let mut imports: Imports = modules.iter().map(|module| (module.to_string(), BTreeMap::new())).collect();
    for path in paths {
        let (own, text) = (module_of(path), code(&files[path]));
        for name in names_at_root(path, &text) {
            let module = if modules.contains(name.as_str()) { Some(&name) } else { exported.get(&name) };
            if let Some(module) = module.filter(|module| *module != own && modules.contains(module.as_str()))
            {
                let of_own = imports.entry(own.to_string()).or_default();
                of_own.entry(module.clone()).or_insert_with(|| path.clone());
            }
        }
    }
    imports
}

/// The top-level module of a file.
fn module_of(path: &str) -> &str {
    path.split('/').next().unwrap_or(path).trim_end_matches(".rs")
}

/// Source text without comments and without the tests at its end.
fn code(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or(line).trim());
    let mut code = String::new();
    let mut is_for_tests = false;
    for line in lines {
        if is_for_tests && line.starts_with("mod ") && line.ends_with('{') {
            break;
        }
        is_for_tests = line == "#[cfg(test)]";
        code.push_str(line);
        code.push(' ');
    }
    code
}

/// The names that `lib.rs` re-exports, with their modules. `pub use shape::{Circle, area as size};`
fn exports(code: &str) -> BTreeMap<String, String> {
    let mut exports = BTreeMap::new();
    for statement in code.split(';').filter_map(|statement| statement.split("use ").nth(1)) {
        let Some((module, names)) = statement.split_once("::") else { continue };
        for name in names.trim_matches(['{', '}', ' ']).split(',') {
            let name = name.rsplit([' ', ':']).find(|word| !word.is_empty()).unwrap_or_default();
            exports.insert(name.to_string(), module.trim().to_string());
        }
    }
    exports
}

/// First names after `crate::`, or after as many `super::` as lead to the root.
fn names_at_root(path: &str, code: &str) -> Vec<String> {
    let depth = path.matches('/').count() + usize::from(!path.ends_with("/mod.rs"));
    let roots = ["crate::".to_string(), "super::".repeat(depth)];
    let mut names = Vec::new();
    for root in &roots {
        for (at, _) in code.match_indices(root.as_str()) {
            let is_whole = !code[..at].ends_with(|c: char| c == ':' || c == '_' || c.is_alphanumeric());
            if is_whole {
                names.extend(first_names(&code[at + root.len()..]));
            }
        }
    }
    names
}

/// The first names of a path: `shape` of `shape::Circle`; `shape` and `area` of
/// `{shape::Circle, area}`.
fn first_names(rest: &str) -> Vec<String> {
    let word = |text: &str| -> String {
        text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let Some(group) = rest.strip_prefix('{') else { return vec![word(rest)] };
    let (mut depth, mut names) = (1, vec![word(group)]);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => names.push(word(&group[at + 1..])),
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    names
}

#[test]
fn circles_are_found() {
    let files = |all: &[(&str, &str)]| -> BTreeMap<String, String> {
        all.iter().map(|(path, text)| (path.to_string(), text.to_string())).collect()
    };
    let open = [
        ("lib.rs", "mod a; mod b; mod c;\npub use c::{Thing, other as Other};"),
        ("a.rs", "use crate::b::x;\n// use crate::c;\n#[cfg(test)]\nmod tests {\n    use crate::c;\n}\n"),
        ("b/mod.rs", "mod inner;\nuse super::c;"),
        ("b/inner.rs", "use crate::{Thing, b::y};"),
        ("c.rs", "pub struct Thing;"),
    ];
    assert_eq!(circles("demo", &files(&open)), Vec::<String>::new());
    for closing in ["use crate::a::z;", "use super::{b, a};", "fn f() { crate::a::f() }"] {
        let mut closed = open;
        closed[4].1 = closing;
        let found = circles("demo", &files(&closed));
        let expected = "crates/demo: a circle of imports between";
        assert!(
            !found.is_empty() && found.iter().all(|text| text.starts_with(expected)),
            "{closing} {found:?}"
        );
    }
    // A name that `lib.rs` exports stands for its module.
    let named = [("lib.rs", "pub use a::One;"), ("a.rs", "use crate::b;"), ("b.rs", "use crate::One;")];
    let [message] = &circles("demo", &files(&named))[..] else { panic!("one circle") };
    assert!(message.contains("between a, b: `b` is used by src/a.rs; `a` is used by src/b.rs."), "{message}");
}
