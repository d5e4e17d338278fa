//! Messages that tell a person which program of the family to use.
//!
//! No other source spells the name of a sibling program (`tests/tidy.rs` checks it): a
//! program learns what was done to a scene from its stage, never from a name. `{}` stands for what
//! is wrong.

use crate::shell::shell_word;

/// The programs of the family: all that a recorded pipe may run.
pub const PROGRAMS: [&str; 10] = [
    "ugdiagram",
    "ugdoppler",
    "ugfilm",
    "uglorentz",
    "ugmesh",
    "ugparse",
    "ugphoton",
    "ugrainbow",
    "ugsheet",
    "ugwarp",
];

/// Positions were made as seen already, and rest shapes are needed.
pub const SEEN_GEOMETRY: &str = "give the scene at rest: uglorentz, ugphoton and ugfilm each compute themselves \
     where it is seen, so only one of them is in a pipe";

/// A number has several values, over time.
pub const CHANGING_NUMBERS: &str =
    "only ugfilm draws numbers that change over time; for one picture give one number";

/// Positions without a word on their stage are taken as seen.
pub const MOVE_FIRST: &str = "{}; for a scene at rest give -vel to uglorentz";

/// Colours were made as seen already.
pub const SEEN_COLORS: &str = "start again from the scene before ugdoppler; \
     the order is uglorentz, ugdoppler, ugrainbow, each once; ugphoton and ugfilm do the work of all three";

/// Textures are to be shifted by rays that the picture or file excludes.
pub const DEFERRED_COLORS: &str = "give uglorentz -se 0.1, and ugdoppler --no-textures for their mean colours; \
     rays exclude -cb, -og, -vec, lines without faces and mesh files";

/// Faces were left whole for rays, which the picture, colours at vertices or a file exclude.
pub const WHOLE_FACES: &str = "give uglorentz -se 0.1, which cuts them";

/// Bodies move whose positions are still at rest.
pub const GEOMETRY_AT_REST: &str =
    "give the scene to uglorentz first (with -nc and --no-flight-time to keep rest shapes)";

/// Help to the warning that moving bodies are drawn with their rest shapes.
pub const DRAW_AS_SEEN: &str = "send the scene through uglorentz to draw it as seen";

/// Help to the note that spectra are taken as the colours they have at rest.
pub const SHIFT_SPECTRA: &str = "`ugdoppler -sp` shifts them as spectra";

/// Exact mode shifts colours itself.
pub const EXACT_SEEN_COLORS: &str = "-xc shifts colours itself, at every sample, and those of this scene have been shifted by ugdoppler: \
     leave ugdoppler out, and give -sp, -br, --no-doppler or --no-flux here; or leave out -xc";

/// Only polygons are explained.
pub const EXPLAIN_EXACT: &str = "--explain works in scanline mode only: leave out -xc; \
     faces with textures are drawn by rays, which `ugphoton --explain` explains";

/// Exact mode follows rays through both effects of motion on shape.
pub const EXACT_PARTIAL_GEOMETRY: &str = "-xc follows rays through contraction and time of flight, and uglorentz left one of them out: \
     leave out -xc, or -nc and --no-flight-time";

/// Lights that move are drawn at rest.
pub const MOVING_LIGHTS: &str = "`ugdoppler -li` draws with them";

/// Nothing is in front of the eye.
pub const NOTHING_IN_FRONT: &str =
    "{}; try --keep-in-view (uglorentz, ugphoton), another -ep or -vc";

/// Nothing is in the picture.
pub const NOTHING_IN_PICTURE: &str =
    "{}; try --keep-in-view (uglorentz, ugphoton), another -vc or a wider -va";

/// Most or everything is shifted out of the visible range.
pub const OUT_OF_RANGE: &str =
    "{}; give ugdoppler and ugrainbow -look light, or -look shape to see the shape";

/// A look is given to a program without colours.
pub const LOOK_DOWNSTREAM: &str =
    "{} has no effect on positions: give it to ugdoppler and ugrainbow";

/// Vertices have colours as seen, so they cannot be repeated for the colours of faces.
pub const REPEAT_EARLIER: &str =
    "-vr has no effect on colours as seen, which every vertex has: give it to ugdoppler";

/// Colours of the scene are hues.
pub const WRITE_WAVELENGTHS: &str = "give -gw to ugdoppler";

/// The input is a mesh in a format of its own. `file`: its name, if it is not standard input.
pub fn convert_mesh(file: Option<&str>) -> String {
    let file = argument(file);
    format!("`ugmesh{file}` writes it as a scene, for the rest of the pipe")
}

/// The input is a picture. `file`: its name, if it is not standard input.
pub fn picture_is_complete(file: Option<&str>) -> String {
    match file {
        None => "the program before this one in the pipe has drawn the picture: leave this one out"
            .to_owned(),
        Some(file) => format!(
            "`ugwarp{0}` shows it as the sky around an observer in motion; if it was drawn of a scene, give that: \
             `ugsheet --history{0}` prints its name",
            argument(Some(file))
        ),
    }
}

/// The input is a table. `file`: its name, if it is not standard input.
pub fn draw_stars(file: Option<&str>) -> String {
    let file = argument(file);
    format!("`ugwarp{file}` draws a list of stars")
}

/// A file as an argument of a command that a message shows, after a blank.
fn argument(file: Option<&str>) -> String {
    file.map(|file| format!(" {}", shell_word(file))).unwrap_or_default()
}

/// The input is a scene, but only pictures and lists of stars are read.
pub const DRAW_SCENE: &str = "scenes are drawn by ugrainbow, and by ugphoton";

/// The input is a scene or mesh in a format that is not read.
pub const EXPORT_MESH: &str = "export it as glTF, OBJ or PLY, which are read";

/// Where another eye point has to be given instead.
pub const EYE_POINT: &str = "give it to uglorentz";

/// What to do about a character that looks like one of numbers, as word processors write it.
pub fn look_alike(word: &str) -> Option<String> {
    let (c, name) = word.chars().find_map(|c| match c {
        '\u{2212}' => Some((c, "a minus sign of Unicode")),
        '\u{2010}'..='\u{2015}' => Some((c, "a dash")),
        '\u{a0}' | '\u{2007}' | '\u{202f}' => Some((c, "a blank without break")),
        '\u{ff10}'..='\u{ff19}' => Some((c, "a wide digit")),
        _ => None,
    })?;
    Some(format!("`{c}` (U+{:04X}) is {name}: write it as ASCII", u32::from(c)))
}

/// The names of options, each once, behind a program that has it. `tests/help.rs` makes it of the
/// definitions of all programs.
const OPTIONS: &str = include_str!("options_of_programs.txt");

/// The program that has an option, by one of its names; of several the one whose short help has it.
pub fn program_with_option(name: &str) -> Option<&'static str> {
    let lines = OPTIONS.lines().filter_map(|line| line.split_once(": "));
    let mut with_option = lines.filter(|(_, names)| names.split(' ').any(|other| other == name));
    with_option.next().map(|(program, _)| program)
}
