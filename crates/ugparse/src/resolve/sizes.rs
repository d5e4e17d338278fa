//! Computes the size of the expanded scene before expansion.

use rustc_hash::FxHashSet;
use ugphysics::SampledPath;
use ugscene::Body;

use crate::diagnostic::Diagnostic;
use crate::options::{Limit, Limits};
use crate::scope::Scope;
use crate::source::Span;
use crate::statement::{Call, MotionStatement, PathStatement, Repeat};

/// Memory for an entry of a hash table of names, without their text: the string with the overhead
/// of its allocation, and the free places of the table.
const BYTES_PER_UNIQUE_NAME: u64 = 64;

/// Computes the sizes of scopes with their calls.
pub(super) struct Sizes<'g, 't> {
    pub text: &'t [u8],
    pub scopes: &'g [Scope<'t>],
    pub own_sizes: Vec<Size>,
    pub limits: &'g Limits,
}

impl Sizes<'_, '_> {
    /// Detects recursive definitions, chains that are too long, and scenes that exceed a limit.
    /// Returns the length of the longest chain.
    pub fn check_calls(&self) -> Result<usize, Diagnostic> {
        let mut sizes: Vec<Option<Size>> = vec![None; self.scopes.len()];
        // Unused definitions are checked, too.
        for root in 0..sizes.len() {
            self.measure(root, &mut sizes)?;
        }
        let size = sizes[0].unwrap_or_default();
        self.too_large(size).map_or(Ok(size.levels), Err)
    }

    /// Bytes of all tables of the expanded scene.
    fn memory(&self, size: &Size) -> u64 {
        let own = self.own_sizes[0];
        // The names of copies are also in a set, to be made unique, and for paths in an index.
        let has_paths = self.scopes.iter().any(|scope| !scope.paths.is_empty());
        let n_sets = if has_paths { 2 } else { 1 };
        let names = (size.names - own.names).saturating_mul(BYTES_PER_UNIQUE_NAME);
        let sets = names.saturating_add(size.name_bytes - own.name_bytes).saturating_mul(n_sets);
        size.bytes.saturating_add(size.name_bytes).saturating_add(sets)
    }

    /// Computes the sizes of `root` and of all scopes it places, without recursion.
    fn measure(&self, root: usize, sizes: &mut [Option<Size>]) -> Result<(), Diagnostic> {
        if sizes[root].is_some() {
            return Ok(());
        }
        let mut on_path = FxHashSet::from_iter([root]);
        // Each entry: a scope and the index of its next call.
        let mut path: Vec<(usize, usize)> = vec![(root, 0)];
        while let Some(&mut (row, ref mut next)) = path.last_mut() {
            let idx = *next;
            *next += 1;
            let Some(call) = self.scopes[row].calls.rows.get(idx) else {
                sizes[row] = Some(self.size(row, sizes));
                on_path.remove(&row);
                path.pop();
                continue;
            };
            let Some(target) = call.target else { continue };
            if on_path.contains(&target) {
                return Err(self.recursion(call));
            }
            // The file itself does not count in the chain.
            let below = sizes[target].map_or(1, |size| size.levels);
            if (path.len() - 1 + below) as u64 > self.limits.get(Limit::Chain) {
                return Err(self.too_long(call));
            }
            if sizes[target].is_none() {
                on_path.insert(target);
                path.push((target, 0));
            }
        }
        Ok(())
    }

    /// The size of a scope, including the scopes it places.
    fn size(&self, row: usize, sizes: &[Option<Size>]) -> Size {
        let mut total = self.own_sizes[row];
        let mut largest = 0;
        for call in &self.scopes[row].calls.rows {
            let Some(target) = call.target else { continue };
            let each = sizes[target].unwrap_or_default();
            let own = each.placed(call);
            if own.statements > largest {
                largest = own.statements;
                total.largest_call = Some(call.definition);
            }
            total.add(&own);
        }
        total.levels += 1;
        total
    }

    fn recursion(&self, call: &Call) -> Diagnostic {
        let shown = call.definition.lossy(self.text);
        Diagnostic::error(call.definition, format!("definition `{shown}` contains itself"))
            .label("placed here, inside itself")
            .help("a definition must not place itself, directly or through others")
    }

    /// The error for a scene that exceeds a limit.
    fn too_large(&self, size: Size) -> Option<Diagnostic> {
        let (count, limit, what) = [
            (size.statements, Limit::Statements, "statements"),
            (size.corners, Limit::Corners, "corners of faces"),
            (size.name_bytes, Limit::Names, "bytes of names"),
            (self.memory(&size), Limit::Memory, "bytes in its tables"),
        ]
        .into_iter()
        .find(|&(count, limit, _)| count > self.limits.get(limit))?;
        let count = if count == u64::MAX { "too many".to_string() } else { count.to_string() };
        let finding = |place, label, else_do| {
            Diagnostic::error(place, format!("the expanded scene would have {count} {what}"))
                .label(label)
                .limited(self.limits, limit, else_do)
        };
        Some(match size.largest_call {
            Some(call) => finding(call, "most of them from here", "use smaller arrays"),
            None => finding(Span::default(), "", "split the scene"),
        })
    }

    fn too_long(&self, call: &Call) -> Diagnostic {
        let error = Diagnostic::error(call.definition, "the chain of nested instances is too long");
        error.label("here").limited(self.limits, Limit::Chain, "use fewer")
    }
}

/// The size of an expanded scope; sums saturate.
#[derive(Clone, Copy, Default)]
pub(super) struct Size {
    statements: u64,
    corners: u64,
    names: u64,
    name_bytes: u64,
    /// Bytes of the tables, without those of names.
    bytes: u64,
    /// Length of the longest chain of nested instances.
    levels: usize,
    /// The call with the most statements.
    largest_call: Option<Span>,
}

impl Size {
    /// The size of all copies that a call makes.
    fn placed(&self, call: &Call) -> Self {
        let copies = match call.repeat {
            Repeat::Once => 1,
            Repeat::Times(copies, _) => copies,
        };
        // The colon, and the number of a copy in an array.
        let added = call.label.len() as u64 + 1 + if copies > 1 { 9 } else { 2 };
        let body = call.motion.map_or(0, |_| size_of::<Body>() as u64);
        let name_bytes = self.name_bytes.saturating_add(self.names.saturating_mul(added));
        Self {
            statements: copies.saturating_mul(self.statements.saturating_add(1)),
            corners: copies.saturating_mul(self.corners),
            names: copies.saturating_mul(self.names),
            name_bytes: copies.saturating_mul(name_bytes),
            bytes: copies.saturating_mul(self.bytes).saturating_add(body),
            ..*self
        }
    }

    fn add(&mut self, other: &Self) {
        self.statements = self.statements.saturating_add(other.statements);
        self.corners = self.corners.saturating_add(other.corners);
        self.names = self.names.saturating_add(other.names);
        self.name_bytes = self.name_bytes.saturating_add(other.name_bytes);
        self.bytes = self.bytes.saturating_add(other.bytes);
        self.levels = self.levels.max(other.levels);
    }
}

impl Scope<'_> {
    /// The size of a scope without its calls. Omitted faces count, too.
    pub(super) fn own_size(&self) -> Size {
        let (corners, names) = (self.contours.corner_count() as u64, self.names.len() as u64);
        let name_bytes = self.names.len_bytes() as u64;
        let n_events = |motion: &MotionStatement| match &motion.path {
            Some(PathStatement::Events { events, .. }) => events.len(),
            _ => 0,
        };
        let paths =
            self.motions.rows.iter().map(n_events).sum::<usize>() * SampledPath::BYTES_PER_EVENT;
        let bytes = (self.table_bytes() + paths) as u64;
        let statements = self.n_statements - self.calls.len() as u64;
        Size { statements, corners, names, name_bytes, bytes, ..Size::default() }
    }
}
