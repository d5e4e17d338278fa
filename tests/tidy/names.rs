//! Types that libraries export: two different ones do not share a name.

use std::collections::BTreeMap;

use super::paths::{code, from_root, module_of, tree};

/// The text of each module, without comments, by its path from the root of the crate.
type Modules = BTreeMap<Vec<String>, String>;

/// The public types of a library, including those that it re-exports from its own modules.
/// `files`: paths below its `src`, and their texts.
pub fn public_types(files: &BTreeMap<String, String>) -> Vec<String> {
    let sources = files.iter().filter(|(path, _)| *path != "main.rs" && !path.starts_with("bin/"));
    let modules: Modules = sources.map(|(path, text)| (module_of(path), code(text))).collect();
    let mut types = Vec::new();
    let mut public = vec![Vec::new()];
    while let Some(module) = public.pop() {
        let Some(code) = modules.get(&module) else { continue };
        types.extend(defined(code).map(str::to_owned));
        public.extend(
            words_after(code, "pub mod ").map(|name| [&module[..], &[name.to_owned()]].concat()),
        );
        for path in exported(code, "pub use ") {
            let (name, folder) = path.split_last().expect("a path has a name");
            let folder = from_root(&module, folder);
            if name == "*" {
                public.push(folder);
            } else if is_type(&modules, &folder, name) {
                types.push(name.clone());
            }
        }
    }
    types.sort();
    types.dedup();
    types
}

/// Does a module define or re-export a type of this crate?
fn is_type(modules: &Modules, module: &[String], name: &str) -> bool {
    let Some(code) = modules.get(module) else { return false };
    defined(code).any(|defined| defined == name)
        || exported(code, "use ").any(|path| {
            let (last, folder) = path.split_last().expect("a path has a name");
            last == name && !folder.is_empty() && is_type(modules, &from_root(module, folder), name)
        })
}

/// The types that a module defines for everybody.
fn defined(code: &str) -> impl Iterator<Item = &str> {
    let begins = ["pub struct ", "pub enum ", "pub trait ", "pub type ", "pub union "];
    begins.into_iter().flat_map(|begin| words_after(code, begin))
}

/// The paths in statements that begin with `begin`, `use` of some visibility.
fn exported<'c>(code: &'c str, begin: &'c str) -> impl Iterator<Item = Vec<String>> + 'c {
    code.match_indices(begin).flat_map(|(at, begin)| tree(&code[at + begin.len()..]))
}

fn words_after<'c>(code: &'c str, begin: &'c str) -> impl Iterator<Item = &'c str> {
    let rests = code.match_indices(begin).map(|(at, begin)| &code[at + begin.len()..]);
    rests.map(|rest| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or(rest))
}
