//! Paths of modules and names in source text.

/// The names that lead from the root of the crate to the module of a file.
pub fn module_of(path: &str) -> Vec<String> {
    let path = path.trim_end_matches(".rs");
    let names = path.strip_suffix("/mod").unwrap_or(path);
    if names == "lib" { Vec::new() } else { names.split('/').map(str::to_owned).collect() }
}

/// Source text without comments and without the tests at its end.
pub fn code(text: &str) -> String {
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

/// A path in a module, from the root of the crate.
pub fn from_root(module: &[String], path: &[String]) -> Vec<String> {
    let n_up = path.iter().take_while(|name| *name == "super").count();
    let n_begin =
        path.iter().take_while(|name| ["crate", "self", "super"].contains(&name.as_str())).count();
    let is_whole = path.first().is_some_and(|name| name == "crate");
    let base = if is_whole { &[] } else { &module[..module.len().saturating_sub(n_up)] };
    [base, &path[n_begin..]].concat()
}

/// The paths of a tree of imports: `a::b` and `a::c` of `a::{b, c}`, by their original names. The
/// text may go on behind it.
pub fn tree(text: &str) -> Vec<Vec<String>> {
    let mut paths = Vec::new();
    // The names before each open brace, and those of the current path.
    let mut open: Vec<Vec<String>> = Vec::new();
    let mut path: Vec<String> = Vec::new();
    let mut rest = text.trim_start();
    loop {
        let word: String =
            rest.chars().take_while(|c| c.is_alphanumeric() || "_*".contains(*c)).collect();
        rest = &rest[word.len()..];
        if !word.is_empty() {
            path.push(word);
        }
        let behind = rest.trim_start();
        if let Some(after) = rest.strip_prefix("::") {
            rest = after;
            if let Some(after) = rest.strip_prefix('{') {
                open.push(path.clone());
                rest = after.trim_start();
            }
            continue;
        }
        if !path.is_empty() {
            paths.push(std::mem::take(&mut path));
        }
        // The new name of `name as other`.
        let behind = behind.strip_prefix("as ").map_or(behind, |other| {
            other.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_').trim_start()
        });
        let Some(outer) = open.last() else { return paths };
        if let Some(after) = behind.strip_prefix(',') {
            (path, rest) = (outer.clone(), after.trim_start());
            if rest.starts_with('}') {
                path.clear();
            }
        } else if let Some(after) = behind.strip_prefix('}') {
            open.pop();
            rest = after;
        } else {
            return paths;
        }
    }
}
