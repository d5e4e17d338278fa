//! Command lines, of the options that the manuals of the programs list.

use std::sync::LazyLock;

use ugpipe::{Entry, Manual, manual};
use ugtesting::Random;

use super::template::{Kind, name, number, velocity};

static MANUALS: LazyLock<[Manual; 10]> = LazyLock::new(|| {
    [
        manual::<ugdiagram::Args>(),
        manual::<ugdoppler::Args>(),
        manual::<ugfilm::Args>(),
        manual::<uglorentz::Args>(),
        manual::<ugmesh::Args>(),
        manual::<ugparse::Args>(),
        manual::<ugphoton::Args>(),
        manual::<ugrainbow::Args>(),
        manual::<ugsheet::Args>(),
        manual::<ugwarp::Args>(),
    ]
});

/// Numbered files that a film writes begin so.
pub const FRAMES: &str = "frame_";

/// A second output file.
pub const MEASURED: &str = "measured.csv";

/// Options that are not chosen at random: of files and help, names that may be unknown, and those
/// that decide how long it takes.
const EXCLUDED: [&str; 18] = [
    "-h",
    "-V",
    "-fi",
    "-fo",
    "-fm",
    "-sz",
    "-aa",
    "-nt",
    "-keep",
    "-keys",
    "--moments",
    "--frames",
    "-loop",
    "--limit",
    "--sheet",
    "-look",
    "-rays",
    "-cam",
];

/// Values that are possible, by the names of options, where a number between 0 and 1 is not enough.
const VALUES: [(&str, &[&str]); 32] = [
    ("--crease", &["0", "20", "180"]),
    ("--infrared-rule", &["measured", "constant"]),
    ("--across", &["va 2", "vel 3"]),
    ("-c", &["30km/h", "1e-9 m/s"]),
    ("-unit", &["m", "1e9 ly", "lns"]),
    ("-ad", &["0.1"]),
    ("-an", &["eye", "origin", "center", "middle"]),
    ("-at", &[MEASURED]),
    ("--basis", &["mixture", "3500 5900 10000"]),
    ("-ch", &["D,time,distance,Z,id,velocity", "id"]),
    ("-cn", &["1", "2"]),
    ("-cols", &["1", "2"]),
    ("-crop", &["0 0 1 1", "1 2 4 3"]),
    ("-ex", &["auto", "-3", "0", "2.5", "follow"]),
    ("--explain", &["0,0", "3,3"]),
    ("-fps", &["25"]),
    ("-gap", &["4", "0 3"]),
    ("--infrared", &["0.sky"]),
    ("-iso", &["D", "D .5 1 2", "time", "distance 3"]),
    ("-lb", &["none", "names"]),
    ("-lp", &["below", "beside", "top-left", "bottom-right"]),
    ("-map", &["D", "D .5 2", "speed", "z -1 9"]),
    ("-only", &["1", "1..2"]),
    ("-part", &["-180 180 -90 90", "-90 90 -45 45"]),
    ("-rd", &["0", "1", "9"]),
    ("--scene", &["scene.ug"]),
    ("-sd", &["1", "3"]),
    ("-se", &["10", "100"]),
    ("--sky", &["0.sky"]),
    ("--stars", &["0.sky"]),
    ("-ts", &["6", "12"]),
    ("--ultraviolet", &["0.sky"]),
];

/// Options that decide how long a program takes.
const SIZES: [(&[&str], &[&str]); 5] = [
    (&["ugrainbow"], &["-sz 1 7 -aa 2", "-sz 40 30 -aa 3", "-sz 9 9 -aa 1"]),
    (&["ugphoton", "ugwarp"], &["-sz 1 7 -aa 2", "-sz 16 10 -aa 1", "-sz 6 6 -aa 3"]),
    (&["ugfilm"], &["-rays", "-xc", "-vr"]),
    (&["ugfilm"], &["-sz 16 10 -frames 2", "-sz 1 7 -frames 1", "-sz 6 6 -frames 3"]),
    (&["ugfilm"], &["-dt apng", "-dt gif", "-dt html", "-dt ppm", "-dt y4m"]),
];

/// A program with some of its options. A picture has few pixels.
pub fn line(random: &mut Random, kind: Kind, program: &str) -> Vec<String> {
    let manual = MANUALS.iter().find(|manual| manual.name == program).expect("a program");
    let mut line = vec![program.to_owned()];
    if program == "ugparse" {
        let command = *random.pick(&["check", "tidy", "flatten", "count"]);
        return vec![line.remove(0), command.to_owned()];
    }
    for (_, choices) in SIZES.iter().filter(|(names, _)| names.contains(&program)) {
        line.extend(random.pick(choices).split(' ').map(str::to_owned));
    }
    if program == "ugfilm" && random.one_in(2) {
        line.truncate(line.len() - 2);
        line.extend([
            "-fo".to_owned(),
            format!("{FRAMES}%d.{}", random.pick(&["png", "exr", "pdf"])),
        ]);
    }
    let options: Vec<&Entry> = manual.options().filter(|option| !is_excluded(option)).collect();
    let mut given: Vec<&str> = Vec::new();
    for _ in 0..random.below(6) {
        let option = *random.pick(&options);
        let main = option.names[0].as_str();
        if !line.iter().any(|word| option.names.contains(word)) && !given.contains(&main) {
            given.push(main);
            line.push(random.pick(&option.names).clone());
            line.extend(values(random, kind, option));
        }
    }
    line
}

fn is_excluded(option: &Entry) -> bool {
    option.names.iter().any(|name| EXCLUDED.contains(&name.as_str()))
}

fn values(random: &mut Random, kind: Kind, option: &Entry) -> Vec<String> {
    let is_wild = kind == Kind::Wild && random.one_in(3);
    let possible = VALUES.iter().find(|(name, _)| option.names.iter().any(|other| other == name));
    if option.values.is_empty() {
        return Vec::new();
    }
    if let Some((_, values)) = possible.filter(|_| !is_wild) {
        return random.pick(values).split(' ').map(str::to_owned).collect();
    }
    if !option.words.is_empty() && !is_wild {
        return vec![random.pick(&option.words).0.clone()];
    }
    match option.names[0].as_str() {
        "-vel" | "-cv" => velocity(random, kind).to_vec(),
        "-cap" | "--title" | "--label" | "-name" => vec![name(random, kind)],
        _ => {
            let kind = if is_wild { Kind::Wild } else { Kind::Mild };
            let n_needed = option.values.iter().filter(|value| !value.is_optional).count();
            let n = if random.one_in(2) { n_needed } else { option.values.len() };
            (0..n).map(|_| number(random, kind)).collect()
        }
    }
}
