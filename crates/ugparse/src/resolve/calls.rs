//! Instances and arrays: the definitions they place, and what they are called in paths.

use rustc_hash::{FxHashMap, FxHashSet};

use super::undefined::{show, undefined_like};
use super::{Link, enclosing};
use crate::diagnostic::Diagnostic;
use crate::scope::{Call, Scope};
use crate::statement::Repeat;

/// Definitions and labels of the calls of a scope.
pub(super) fn link_calls(
    text: &[u8],
    scopes: &[Scope<'_>],
    row: usize,
    findings: &mut Vec<Diagnostic>,
) -> Vec<Link> {
    let calls = &scopes[row].calls.rows;
    let labels = labels(text, calls);
    let links = calls.iter().zip(labels).map(|(Call { statement: call, .. }, label)| {
        let name = call.definition.of(text);
        let target = enclosing(scopes, row).find_map(|scope| scopes[scope].definitions.get(name));
        if target.is_none() {
            let remedy = "define it with `def NAME ; … end ;`";
            let names = enclosing(scopes, row).flat_map(|scope| scopes[scope].definitions.values());
            // The table has no order of its own.
            let mut names: Vec<&[u8]> = names.map(|(_, span)| span.of(text)).collect();
            names.sort_unstable();
            let found = undefined_like(text, "definition", call.definition, remedy, names, findings.len());
            findings.push(found);
        }
        let target = target.map(|&(scope, _)| scope);
        Link { target, label }
    });
    links.collect()
}

/// For each call of a scope its label, unique there: its name, else its definition's name;
/// nothing for a nameless array that is alone, whose element number says enough.
fn labels(text: &[u8], calls: &[Call]) -> Vec<String> {
    let wanted = |Call { statement: call, .. }: &Call| match call.name {
        None if calls.len() == 1 && matches!(call.repeat, Repeat::Times(..)) => String::new(),
        name => show(text, name.unwrap_or(call.definition)),
    };
    let wanted: Vec<String> = calls.iter().map(wanted).collect();
    // A label that was written is never given to another call.
    let mut taken: FxHashSet<String> = wanted.iter().cloned().collect();
    let mut uses: FxHashMap<&str, u64> = FxHashMap::default();
    let mut labels = Vec::with_capacity(wanted.len());
    for wanted in &wanted {
        let uses = uses.entry(wanted).or_default();
        *uses += 1;
        let mut label = wanted.clone();
        while *uses > 1 {
            label = format!("{wanted}_{uses}");
            if taken.insert(label.clone()) {
                break;
            }
            *uses += 1;
        }
        labels.push(label);
    }
    labels
}
