//! No circle of imports between the files and folders of a folder, at any depth.
//!
//! A circle has no bottom: none of its files can be read, tested or moved without all the others. A
//! module and its own parts count as one.

use std::collections::{BTreeMap, BTreeSet};

use super::paths::{code, from_root, module_of, tree};

/// Imports between the modules of one folder: from each module to those it uses, each with the
/// first file that imports it.
type Imports = BTreeMap<String, BTreeMap<String, String>>;

/// The circles of imports in a crate, one message each. `files`: paths below its `src`, and their
/// texts.
pub fn circles(krate: &str, files: &BTreeMap<String, String>) -> Vec<String> {
    let mut messages = Vec::new();
    for (folder, imports) in imports(files) {
        let found: BTreeSet<Vec<String>> =
            imports.keys().filter_map(|start| shortest_circle(&imports, start)).collect();
        messages.extend(found.iter().map(|circle| {
            let steps = circle.iter().zip(circle.iter().cycle().skip(1));
            let steps: Vec<String> =
                steps.map(|(from, to)| format!("`{to}` is used by src/{}", imports[from][to])).collect();
            let place = if folder.is_empty() { String::new() } else { format!(" in {}", folder.join("/")) };
            format!(
                "crates/{krate}: a circle of imports{place} between {}: {}. Move what two of them need into a file \
                 below both, or pass it in as an argument",
                circle.join(", "),
                steps.join("; ")
            )
        }));
    }
    messages
}

/// A shortest circle through a module, beginning with the module that sorts first.
fn shortest_circle(imports: &Imports, start: &str) -> Option<Vec<String>> {
    // Breadth first; each module with the one it was reached from.
    let mut before: BTreeMap<&str, &str> = BTreeMap::new();
    let mut queue = vec![start];
    let mut next = 0;
    while let Some(&module) = queue.get(next) {
        next += 1;
        for other in imports.get(module).into_iter().flat_map(BTreeMap::keys).map(String::as_str) {
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

/// The imports in every folder, by the names on the way to it.
fn imports(files: &BTreeMap<String, String>) -> BTreeMap<Vec<String>, Imports> {
    let is_module = |path: &&String| path.as_str() != "main.rs" && !path.starts_with("bin/");
    let paths = files.keys().filter(is_module);
    let modules: BTreeMap<Vec<String>, &String> =
        paths.map(|path| (module_of(path), path)).collect();
    let exports: BTreeMap<&Vec<String>, BTreeMap<String, String>> =
        modules.iter().map(|(module, path)| (module, exports(&code(&files[*path])))).collect();
    let mut imports: BTreeMap<Vec<String>, Imports> = BTreeMap::new();
    for (module, path) in &modules {
        for used in used(module, &code(&files[*path])) {
            for depth in 0..used.len().min(module.len()) {
                let folder = &used[..depth];
                if module[..depth] != *folder {
                    break;
                }
                let name = &used[depth];
                let other = exports
                    .get(&folder.to_vec())
                    .and_then(|exports| exports.get(name))
                    .unwrap_or(name);
                let is_other = *other != module[depth];
                if is_other && modules.contains_key(&[folder, std::slice::from_ref(other)].concat())
                {
                    let of_folder = imports.entry(folder.to_vec()).or_default();
                    let of_own = of_folder.entry(module[depth].clone()).or_default();
                    of_own.entry(other.clone()).or_insert_with(|| (*path).clone());
                }
            }
        }
    }
    imports
}

/// The names that a module re-exports from its parts, with the parts.
/// `pub use shape::{Circle, area as size};`
fn exports(code: &str) -> BTreeMap<String, String> {
    let mut exports = BTreeMap::new();
    for statement in code.split(';') {
        let Some(at) = statement.find("use ").filter(|&at| statement[..at].contains("pub")) else {
            continue;
        };
        for path in tree(&statement[at + "use ".len()..]) {
            if let [module, .., name] = &path[..] {
                exports.insert(name.clone(), module.clone());
            }
        }
    }
    exports
}

/// The parts of its crate that a module uses, as names from the root: paths that begin with
/// `crate`, `self` or `super`.
fn used(module: &[String], code: &str) -> Vec<Vec<String>> {
    let mut used = Vec::new();
    for begin in ["crate::", "self::", "super::"] {
        for (at, _) in code.match_indices(begin) {
            let is_whole =
                !code[..at].ends_with(|c: char| c == ':' || c == '_' || c.is_alphanumeric());
            if is_whole {
                used.extend(tree(&code[at..]).into_iter().map(|path| from_root(module, &path)));
            }
        }
    }
    used
}
