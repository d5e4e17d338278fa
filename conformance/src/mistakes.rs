//! Mistakes that published programs make.

/// Number and name of each.
pub const MISTAKES: [(&str, &str); 16] = [
    ("M1", "direction of another frame, or the present place in place of the retarded one"),
    ("M2", "gamma without its square root"),
    ("M3", "velocities composed with the wrong sign or in the wrong order"),
    ("M4", "view direction skewed by the shape of the picture"),
    ("M5", "another power of D"),
    ("M6", "depth compared in different frames"),
    ("M7", "shift applied twice"),
    ("M8", "the power of a radiance used for the irradiance of a point light"),
    ("M9", "right only to first order in the speed, or not made unit length"),
    ("M10", "the back half of the view folded into the front half"),
    ("M11", "proper time and coordinate time exchanged"),
    ("M12", "a normal transformed like a point, or not at all"),
    ("M13", "an edge cut at the middle of what is seen, or not at all"),
    ("M14", "linear light shown as if it were encoded, or colours of another white"),
    ("M15", "small speeds left out"),
    ("M16", "single precision, or too few digits printed"),
];

/// What a mistake is; empty if there is none of that name.
pub fn what(name: &str) -> &'static str {
    MISTAKES.iter().find(|(known, _)| *known == name).map_or("", |(_, what)| what)
}
