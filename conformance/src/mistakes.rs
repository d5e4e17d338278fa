//! Known mistakes of relativistic renderers.

use serde_json::{Value, json};

/// Number and description of each.
pub const MISTAKES: [(&str, &str); 20] = [
    ("M1", "direction in the wrong frame, or the present position instead of the retarded one"),
    ("M2", "gamma without its square root"),
    ("M3", "velocities composed with the wrong sign or in the wrong order"),
    ("M4", "view direction skewed by the aspect ratio of the picture"),
    ("M5", "wrong power of D"),
    ("M6", "depth compared in different frames"),
    ("M7", "shift applied twice"),
    ("M8", "the power of D for radiance used for the irradiance by a point light"),
    ("M9", "correct only to first order in the speed, or not normalised"),
    ("M10", "the rear hemisphere folded into the front one"),
    ("M11", "proper time and coordinate time exchanged"),
    ("M12", "a normal transformed like a point, or not at all"),
    ("M13", "an edge subdivided at the midpoint of its image, or not at all"),
    ("M14", "linear light displayed without encoding, or the wrong white point"),
    ("M15", "small speeds ignored"),
    ("M16", "single precision, or too few digits printed"),
    ("M17", "the velocity of a body when its light arrives instead of when it left"),
    ("M18", "the turn of a body when its light arrives instead of when it left"),
    ("M19", "light of all points of a body leaves when that of its reference point does"),
    ("M20", "axes that are those of a single boost, without Thomas precession"),
];

/// Mistakes for programs.
pub fn json<'n>(names: impl Iterator<Item = &'n str>) -> Value {
    names.map(|name| json!({ "name": name, "about": describe(name) })).collect()
}

/// The description of a mistake; empty if the name is unknown.
pub fn describe(name: &str) -> &'static str {
    MISTAKES.iter().find(|(known, _)| *known == name).map_or("", |(_, description)| description)
}
