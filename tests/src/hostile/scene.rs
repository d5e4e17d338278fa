//! Scenes: of random statements, and those of the repository.

use ugtesting::Random;

use super::template::{Kind, fill};
use crate::scenes;

/// What the statements of a random scene refer to.
const MOTIONS: [&str; 4] = [
    "motion m0 -at % -spin 0 0 .1 ;",
    "motion m1 -vel & -acc 0 .05 0 -1 2 -acc .02 0 0 2 9 ;",
    "motion m2 -on m0 -at 0 0 .1 ;",
    "motion m3 -orbit 0 1 0 0 0 1 .1 ;",
];
const COLORS: [&str; 6] = [
    "c red0 # # # ;",
    "c_rgb red0 % # ;",
    "c_xyz red0 % ;",
    "c_bb red0 4# ;",
    "c_spd red0 400 # 500 # 600 1 ;",
    "c red3 1 0 ; c_time red0 -period 2 0 red3 # red1 ;",
];
const DEFINITION: &str = "def d ; v a % ; v b % ; v c 0 0 1 ; v e 1 0 0 ;
f (a b c) ^ ; f (a e b) red1 ; f (b e c) ; f (c e a) red2 ~ ; end ;\n";

/// Statements that are valid whatever replaces their signs.
const MILD: [&str; 21] = [
    "f (* * *) ^ ~ ;",
    "f @ (* * *) ^ # ~ ;",
    "f (v0 v1 v2 v3) red0 mirror ~ ;",
    "f (v4 v5 v6) red1 glass ~ ;",
    "w (* * *) ^ ~ ;",
    "label @ \"at # (γ; 2)\" * ~ ;",
    "sphere @ % 1# ^ ~ ;",
    "cylinder # # # 2 # # # red0 glass ~ ;",
    "tube 0 0 # # 1 # # red0 # ~ ;",
    "disc % # # 3 1# ^ ~ ;",
    "disc % # # 3 2# -inner 1 ^ ~ ;",
    "i (d) ~ ;",
    "i (d -tx # -ry # -sa #) ~ ;",
    "a (d -mx) 3 -rz 2# -ty # ~ ;",
    "l # ;",
    "l # 1 # # ~ ;",
    "l # # # 3 # red1 ~ ;",
    "l # # # 3 # -spot 1 # # 40 5 ~ ;",
    "l # # -2 2 # # -area 1 # 0 0 0 1 ~ ;",
    "l # # -2 2 # # red2 ~ ;",
    "cam -ep 0 -9 # -vc # 0 # -va 3# ~ ;",
];

/// Statements that may be invalid.
const WILD: [&str; 25] = [
    "f (* * * * * *)(* * *) ^ ~ ;",
    "f (@ * *) ;",
    "sphere @ (* * *)(* * *) red0 mirror ~ ; disc (* * * *) ^ ; disc (* * * *)(* * * *) ^ ; cylinder (* * * *)(* * * *) ^ ~ ;",
    "sphere % % ; tube @ % % # ^ ~ ; disc % % % ; cylinder % # red0 ; disc % % # -inner # ^ ;",
    "v @ % ^ % ;",
    "label @ \"@ { # \" * ; label \"\" * ; label \"漢\" @ ~ ; label @ ;",
    "v v0 % ;",
    "a (d) 4000# -tx # ;",
    "def @ ; i (@) ; end ;",
    "i (@ -M3 % % % -rv % #) ;",
    "c red0 # # # # # ;",
    "c_mix red0 red0 # ;",
    "c_emit red0 red1 ;",
    "cam @ -ep % -vc % -ud % -va # # -og ~ ;",
    "l # % # # ~ ;",
    "surf @ # # # # # ;",
    "include part.ug ;",
    "include @ ; include /dev/zero ; include scene.ug ;",
    "execute @ ; execute ./part.ug ;",
    "( ug @ )",
    "# 9 \"@\"\n@ # ;",
    "motion @ -acc % # # -spin % # # -shift % # ;",
    "motion m0 -orbit % % # ;",
    "motion m1 -path (# % # % # %) -on m0 ;",
    "motion m2 -on m2 ; motion m3 -at % -vel & -spin % ;",
];

/// A scene of random statements.
pub fn statements(random: &mut Random, kind: Kind) -> String {
    let mut text = String::new();
    for idx in 0..8 {
        let [x, y, z] = random.in_cube(2.0).to_array();
        text += &format!("v v{idx} {x:.3} {y:.3} {z:.3} ;\n");
    }
    let mut add = |random: &mut Random, template: &str| {
        text += &fill(random, kind, template);
        text.push('\n');
    };
    add(
        random,
        "surf mirror .1 .9 0 1 60 ; surf glass 0 .1 .9 1.5 60 ; c red1 # 2# 1 ; c red2 # 9# # # ;",
    );
    let color = *random.pick(&COLORS);
    add(random, color);
    add(random, DEFINITION);
    let motions: Vec<&str> =
        MOTIONS.into_iter().filter(|_| kind == Kind::Mild || !random.one_in(4)).collect();
    let n = 2 + random.below(9);
    let others = (0..n).map(|_| match kind {
        Kind::Wild if random.one_in(2) => *random.pick(&WILD),
        _ => *random.pick(&MILD),
    });
    let mut all: Vec<&str> = others.collect();
    // A motion is stated before or after its name is used.
    all.splice(0..0, motions);
    let start = random.below(all.len());
    all.rotate_left(start);
    all.into_iter().for_each(|template| add(random, template));
    text
}

/// A scene of the repository that is not large.
pub fn known(random: &mut Random) -> Vec<u8> {
    const NAMES: [&str; 10] = [
        "ship", "cubes", "dice", "glass", "halves", "traffic", "lamp", "rainbow", "twins", "orbit",
    ];
    let name: &&str = random.pick(&NAMES);
    scenes::text(name)
}
