//! Names to rows, when all of the text is read: colours, vertices and
//! definitions of every scope, each looked up and checked once, however often a
//! definition is placed.

mod calls;
mod complaints;
mod corners;
mod left_out;
mod named;
mod sizes;

use crate::diagnostic::Diagnostic;
use crate::group::Group;
use crate::options::Limits;
use crate::scene::Scene;

pub(crate) use complaints::undefined;
pub(crate) use left_out::{face_name, flatness, has_three, is_short, left_out, short_wire};

use calls::link_calls;
use complaints::{Complaints, show};
use corners::{link_corners, path_corners};
use left_out::{leave_out_flat_faces, leave_out_short_wires};
use named::{apply_default_colors, gather_named, name_surfaces, paint, visible};
use sizes::Sizes;

/// What calls refer to.
#[derive(Default)]
pub(crate) struct Links {
    /// For each group, for each call.
    pub calls: Vec<Vec<Link>>,
    /// For each group, the row of its first colour in the scene.
    pub first_colors: Vec<usize>,
    /// Length of the longest chain of definitions that place each other.
    pub levels: usize,
}

/// What one call refers to.
pub(crate) struct Link {
    /// The group that is placed; `None` if it is not defined.
    pub target: Option<usize>,
    /// The name to put into paths.
    pub label: String,
}

/// Resolves all names of `groups`; colours go into `scene` on the way.
pub(crate) fn resolve(
    text: &[u8],
    groups: &mut [Group<'_>],
    scene: &mut Scene,
    limits: &Limits,
    findings: &mut Vec<Diagnostic>,
) -> Links {
    for group in groups.iter() {
        findings.extend(group.duplicates.iter().map(|duplicate| {
            let shown = show(text, duplicate.again);
            Diagnostic::error(duplicate.again, format!("{} `{shown}` is defined twice", duplicate.kind))
                .label("again here")
                .other(duplicate.first, "first here")
                .help("give one of them another name")
        }));
    }
    let own_sizes = groups.iter().map(Group::own_size).collect();
    // The names of the file come first, so that they need not be moved.
    scene.names = std::mem::take(&mut groups[0].names);
    let firsts = match gather_named(text, groups, scene, limits) {
        Ok(firsts) => firsts,
        Err(finding) => {
            findings.push(finding);
            return Links::default();
        }
    };
    for row in 0..groups.len() {
        let colors = visible(groups, row, |group| &group.colors, &firsts.colors);
        let surfaces = visible(groups, row, |group| &group.surfaces, &firsts.surfaces);
        let group = &mut groups[row];
        let has_colors = paint(group, &colors);
        let has_surfaces = name_surfaces(group, &surfaces);
        let has_corners = link_corners(group);
        if !(has_colors && has_surfaces && has_corners) {
            Complaints { text, groups, row, findings }.about_all();
            groups[row].paths = path_corners(text, &groups[row]);
        }
        let group = &mut groups[row];
        leave_out_flat_faces(text, group, has_corners, findings);
        leave_out_short_wires(text, group, has_corners, findings);
    }
    apply_default_colors(&mut groups[0]);
    let calls = (0..groups.len()).map(|row| link_calls(text, groups, row, findings)).collect();
    let mut links = Links { calls, first_colors: firsts.colors, levels: 0 };
    match (Sizes { text, groups, own_sizes, links: &links, limits }).check_calls() {
        Ok(levels) => links.levels = levels,
        Err(finding) => findings.push(finding),
    }
    links
}

/// A group and those round it, from the inner to the outer.
fn scopes<'g>(groups: &'g [Group<'_>], row: usize) -> impl Iterator<Item = usize> + use<'g> {
    std::iter::successors(Some(row), |&scope| groups[scope].parent)
}
