//! Resolves the definitions of instances and arrays, and their labels in paths.

use rustc_hash::FxHashSet;
use ugscene::UniqueNames;

use super::enclosing;
use super::undefined::undefined_like;
use crate::diagnostic::Diagnostic;
use crate::scope::Scope;
use crate::statement::{Call, Repeat};

/// Resolves the calls of a scope, and labels them.
pub(super) fn link_calls(
    text: &[u8],
    scopes: &mut [Scope<'_>],
    row: usize,
    findings: &mut Vec<Diagnostic>,
) {
    let calls = &scopes[row].calls.rows;
    let labels = labels(text, calls);
    let target = |call: &Call| {
        let name = call.definition.of(text);
        let target = enclosing(scopes, row).find_map(|scope| scopes[scope].definitions.get(name));
        if target.is_none() {
            let remedy = "define it with `def NAME ; … end ;`";
            let names = enclosing(scopes, row).flat_map(|scope| scopes[scope].definitions.values());
            // The order of the hash table is arbitrary.
            let mut names: Vec<&[u8]> = names.map(|(_, span)| span.of(text)).collect();
            names.sort_unstable();
            let found =
                undefined_like(text, "definition", call.definition, remedy, names, findings.len());
            findings.push(found);
        }
        target.map(|&(scope, _)| scope)
    };
    let targets: Vec<_> = calls.iter().map(target).collect();
    for (call, link) in scopes[row].calls.rows.iter_mut().zip(targets.into_iter().zip(labels)) {
        (call.target, call.label) = link;
    }
}

/// The unique label of each call in a scope: its name, else its definition's name; empty for an
/// unnamed array that is the only call, because its element number is enough.
fn labels(text: &[u8], calls: &[Call]) -> Vec<String> {
    let wanted = |call: &Call| match call.name {
        None if calls.len() == 1 && matches!(call.repeat, Repeat::Times(..)) => String::new(),
        name => name.unwrap_or(call.definition).lossy(text),
    };
    let wanted: Vec<String> = calls.iter().map(wanted).collect();
    // Labels in the text are never used for other calls.
    let mut taken: UniqueNames = wanted.iter().map(String::as_str).collect();
    let mut known = FxHashSet::default();
    let again =
        wanted.iter().map(|label| if known.insert(label) { None } else { taken.fresh(label) });
    again.zip(&wanted).map(|(again, label)| again.unwrap_or_else(|| label.clone())).collect()
}
