//! The page's programs beside those of a shell.

use glam::DVec3;
use serde_json::{Value, json};
use ugphysics::{Velocity, wigner_rotation};
use ugtesting::Random;
use ugtests::hostile::damage;
use ugtests::shell::Shell;
use ugweb::{Flight, Studio, qr_code};

/// The words of a shell line without quotes.
fn commands(line: &str) -> String {
    let words = |command: &str| command.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    json!(line.split('|').map(words).collect::<Vec<_>>()).to_string()
}

/// A studio with the files of a shell's folder.
fn studio(shell: &Shell, names: &[&str]) -> Studio {
    let mut studio = Studio::new();
    names.iter().for_each(|name| studio.add((*name).to_owned(), shell.read(name)));
    studio
}

/// Pipes with their output files, and the files that they read, the input first.
const PIPES: [(&str, &[&str]); 12] = [
    (
        "uglorentz -vel .9 0 0 -in house.ug | ugrainbow -look shape -vr -sz 64 48 -fo out.png",
        &["house.ug"],
    ),
    (
        "uglorentz -vel .5 .1 0 -in -ti .5 ship.ug | ugdoppler -look light | ugrainbow -look light -lg -sz 300 200 -fo out.png",
        &["ship.ug"],
    ),
    (
        "uglorentz -cv 0 .9 0 street.ug | ugdoppler | ugrainbow -sz 64 48 -fo out.jpg -dt png",
        &["street.ug"],
    ),
    (
        "uglorentz -in -ep 0 -20 8 -vc 0 0 1 dice.ug | ugrainbow -look shape -vec -sz 64 48 -dl -fo out.svg",
        &["dice.ug"],
    ),
    (
        "uglorentz -vel .9 0 0 -in globe.obj | ugrainbow -look shape -sz 64 48 -fo out.png",
        &["globe.obj"],
    ),
    (
        "uglorentz -vel .9 0 0 -in -sd 1 house.ug | ugrainbow -xc -sp -sz 64 48 -fo out.pfm",
        &["house.ug"],
    ),
    ("uglorentz all.ug | ugdoppler | ugrainbow -iw -sz 64 48 -fo out.png", &["all.ug", "house.ug"]),
    ("ugrainbow house.ug -sz 64 48 -fo out.ppm", &["house.ug"]),
    ("ugphoton -in -look shape mirrors.ug -aa 1 -sz 64 48 -fo out.png", &["mirrors.ug"]),
    (
        "ugphoton -pan -look light -vel .5 0 0 -in house.ug -aa 1 -sz 64 32 -fo out.svg",
        &["house.ug"],
    ),
    ("ugwarp -cv 0 .9 0 -look light -va 90 stars.csv -sz 64 48 -fo out.png", &["stars.csv"]),
    (
        "ugwarp -cv 0 .5 0 -vc 1 0 0 --stars stars.csv sky.png -sz 64 48 -fo out.png",
        &["sky.png", "stars.csv"],
    ),
];

#[test]
fn files_are_those_of_a_shell() {
    let shell = Shell::new(&[
        "house.ug",
        "ship.ug",
        "street.ug",
        "dice.ug",
        "globe.obj",
        "mirrors.ug",
        "stars.csv",
    ]);
    shell.run("ugphoton -pan -sz 80 40 -aa 1 street.ug > sky.png");
    shell.write("all.ug", "include house.ug ;");
    for (line, names) in PIPES {
        let commands = commands(line);
        assert_eq!(Studio::line(&commands).unwrap(), line);
        shell.run(line);
        let output = line.split_whitespace().skip_while(|word| *word != "-fo").nth(1).unwrap();
        let mut studio = studio(&shell, names);
        assert!(studio.file(&commands).unwrap() == shell.read(output), "{line}");
        // Again, of the subject that was kept.
        assert!(studio.file(&commands).unwrap() == shell.read(output), "{line}");
    }
}

/// Round faces, which are exact for rays and polygons elsewhere.
#[test]
fn round_faces_are_those_of_a_shell() {
    let shell = Shell::new(&[]);
    let shapes = [
        "sphere 0 0 0 1",
        "cylinder 0 0 -1 0 0 1 .7",
        "tube 0 -.3 -1 0 .3 1 .7",
        "disc 0 0 0 .2 -1 .3 1",
    ];
    for shape in shapes {
        shell.write(
            "round.ug",
            format!("{shape}; l .4; l .8 1 -2 2; cam -ep 0 -6 1 -vc 0 0 0 -va 30;"),
        );
        let mut studio = studio(&shell, &["round.ug"]);
        for line in [
            "uglorentz -vel .5 .3 0 -in round.ug | ugdoppler | ugrainbow -sz 60 45 -fo out.png",
            "uglorentz -vel .5 .3 0 -in -sd 1 round.ug | ugdoppler | ugrainbow -sz 60 45 -fo out.png",
            "uglorentz -vel .5 .3 0 -in -sd 1 round.ug | ugrainbow -xc -sz 60 45 -fo out.png",
            "uglorentz -vel .5 .3 0 -in -sd 1 round.ug | ugrainbow -xc -dl -sz 60 45 -fo out.png",
            "uglorentz -vel .5 .3 0 -in round.ug | ugrainbow -vec -sz 60 45 -fo out.svg",
            "ugdoppler round.ug | ugrainbow -sz 60 45 -fo out.png",
            "ugrainbow -ep 0 -4 2 -sz 60 45 round.ug -fo out.png",
            "ugphoton -vel .5 .3 0 -in -sz 60 45 -aa 1 round.ug -fo out.png",
        ] {
            shell.run(line);
            let output = line.split_whitespace().last().unwrap();
            assert!(studio.file(&commands(line)).unwrap() == shell.read(output), "{shape}: {line}");
        }
    }
}

/// Keywords are the longest names of options; files and numbers as Python has them.
#[test]
fn lines_in_python_have_every_option() {
    let check =
        |line: &str, expected: &str| assert_eq!(Studio::python(&commands(line)).unwrap(), expected);
    check(
        "uglorentz -vel .9 0 -1e-3 -in -lax a.ug | ugdoppler -look light | ugrainbow -look 1988 -sz 64 48 -cap { -fo b.png",
        "import uglorentz as ug\n\nscene = ug.Scene.read(\"a.ug\", lax=True)\n\
         picture = scene.lorentz(velocity=(.9, 0, -1e-3), keep_in_view=True).doppler(look=\"light\")\
         .render(look=1988, size=(64, 48), caption=\"{\")\npicture.save(\"b.png\")",
    );
    check(
        "ugwarp --camera-velocity 0 .9 0 -va 90 stars.csv -fo b.svg",
        "import uglorentz as ug\n\npicture = ug.warp(\"stars.csv\", camera_velocity=(0, .9, 0), view_angle=90)\n\
         picture.save(\"b.svg\")",
    );
}

/// Options of the view leave the subject as it was read; those of reading do not.
#[test]
fn pixels_are_those_of_the_file() {
    let shell = Shell::new(&["halves.ug", "clocks.ug"]);
    let mut studio = studio(&shell, &["clocks.ug", "halves.ug"]);
    for line in [
        "uglorentz -ti 1 clocks.ug | ugrainbow -sz 60 40",
        "uglorentz -ti -2 -ep 3 -30 5 clocks.ug | ugrainbow -sz 40 60",
        "uglorentz -vel .5 0 0 -in halves.ug | ugdoppler | ugrainbow -sz 60 40",
        "ugphoton -ti 1 clocks.ug -sz 60 40",
    ] {
        shell.run(&format!("{line} > picture.png"));
        let shown = studio.draw(&commands(line)).unwrap();
        assert!(shown.pixels() == shell.pixels("picture.png").as_flattened(), "{line}");
        assert_eq!(shown.pixels().len(), 4 * (shown.width() * shown.height()) as usize);
    }
}

/// Text without the styles of a terminal.
fn plain(text: &str) -> String {
    let mut parts = text.split('\u{1b}');
    let first = parts.next().unwrap_or_default().to_owned();
    first + &parts.filter_map(|part| Some(part.split_once('m')?.1)).collect::<String>()
}

#[test]
fn messages_are_those_of_the_programs() {
    let shell = Shell::new(&["house.ug"]);
    shell.write("bad.ug", "v a 0 0 0;\nf (a b c);\n");
    let mut studio = studio(&shell, &["house.ug", "bad.ug"]);
    for line in [
        "uglorentz -vel 1 0 0 house.ug | ugrainbow",
        "uglorentz -vel .5 0 house.ug | ugrainbow",
        "uglorentz -nonsense house.ug | ugrainbow",
        "uglorentz bad.ug | ugrainbow",
        "ugphoton -ep 0 0 0 -vc 0 0 0 house.ug",
        "ugwarp house.ug",
    ] {
        let (_, printed) = shell.fail(line.split('|').next().unwrap());
        let message = plain(&studio.draw(&commands(line)).err().unwrap());
        let first = printed.lines().next().unwrap().rsplit(": ").next().unwrap();
        assert!(message.contains(first), "{line}: {message}\n{printed}");
    }
    let missing = studio.draw(&commands("uglorentz missing.ug | ugrainbow")).err().unwrap();
    assert_eq!(
        missing,
        "uglorentz: error: cannot read `missing.ug`: It is not among the given files"
    );
    assert!(studio.draw("[]").is_err() && studio.draw("{").is_err());
    assert!(
        studio.draw(&commands("ugmesh house.ug")).err().unwrap().contains("none of the programs")
    );
    // Notes, too.
    let away = commands("uglorentz -vel .9 0 0 -ti 500 house.ug | ugrainbow -sz 40 30");
    let (note, [_, printed]) = (
        studio.draw(&away).unwrap().notes(),
        shell.run("uglorentz -vel .9 0 0 -ti 500 house.ug | ugrainbow -sz 40 30 > /dev/null"),
    );
    let note = note.lines().next().unwrap().split_once(": ").unwrap().1.to_owned();
    assert!(printed.contains(&note), "{note}\n{printed}");
}

/// A scene without a camera is described with the one that the programs choose for it.
#[test]
fn descriptions_are_of_the_picture() {
    let shell = Shell::new(&["globe.obj", "traffic.ug"]);
    let mut studio = studio(&shell, &["globe.obj", "traffic.ug"]);
    let about = |text: String| serde_json::from_str::<Value>(&text).unwrap();
    let globe = about(
        studio
            .describe(&commands("uglorentz -vel .9 0 0 -in globe.obj | ugrainbow -sz 40 30"))
            .unwrap(),
    );
    let point = |name: &str| {
        globe[name]
            .as_array()
            .unwrap()
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>()
            .join(" ")
    };
    let (eye, center) = (point("eye"), point("center"));
    shell.run("uglorentz -vel .9 0 0 -in globe.obj | ugrainbow -sz 40 30 > fitted.png");
    shell.run(&format!(
        "uglorentz -vel .9 0 0 -in -ep {eye} -vc {center} globe.obj | ugrainbow -sz 40 30 > stated.png"
    ));
    assert!(shell.pixels("fitted.png") == shell.pixels("stated.png"), "eye {eye}, centre {center}");
    let traffic = about(studio.describe(&commands("uglorentz traffic.ug | ugrainbow")).unwrap());
    assert_eq!(traffic["eye"], json!([0.0, -9.0, 2.6]));
    assert!(traffic["times"].is_array());
}

/// Broken files are refused with a message, or drawn.
#[test]
fn broken_files_are_refused() {
    let shell = Shell::new(&["house.ug", "globe.obj", "stars.csv"]);
    shell.run("ugphoton -pan -sz 32 16 -aa 1 house.ug > sky.png; ugmesh house.ug -dt glb > house.glb; ugmesh house.ug -dt ply > house.ply");
    let mut random = Random(7);
    let mut n_refused = 0;
    for row in 0..60 {
        let names = ["house.ug", "globe.obj", "house.glb", "house.ply", "sky.png", "stars.csv"];
        let name = names[row % names.len()];
        let mut bytes = shell.read(name);
        damage(&mut random, &mut bytes);
        let mut studio = Studio::new();
        studio.add(name.to_owned(), bytes);
        let line = match name {
            "sky.png" | "stars.csv" => format!("ugwarp -cv 0 .5 0 {name} -sz 24 16"),
            _ => format!(
                "uglorentz -vel .5 0 0 -in --limit memory=100000000 {name} | ugrainbow -sz 24 16"
            ),
        };
        match studio.draw(&commands(&line)) {
            Ok(shown) => assert_eq!(shown.width(), 24),
            Err(message) => {
                assert!(message.contains("error"), "{message}");
                n_refused += 1;
            }
        }
    }
    assert!(n_refused > 20, "{n_refused} files were refused");
}

/// A camera at rest at `event`, which looks along x.
fn flight(event: [f64; 4]) -> Flight {
    let start = json!({"event": event, "velocity": [0, 0, 0], "view": [1, 0, 0], "up": [0, 0, 1]});
    Flight::new(&start.to_string()).unwrap()
}

fn pose(flight: &mut Flight, own_time: f64) -> Value {
    serde_json::from_str(&flight.at(own_time).unwrap()).unwrap()
}

fn numbers<const N: usize>(pose: &Value, name: &str) -> [f64; N] {
    std::array::from_fn(|row| pose[name][row].as_f64().unwrap())
}

#[track_caller]
fn assert_near<const N: usize>(found: [f64; N], expected: [f64; N], tolerance: f64) {
    let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance);
    assert!(is_near, "{found:?}, not {expected:?}");
}

/// x = (cosh aτ − 1)/a, t = sinh(aτ)/a, γ = cosh aτ.  Eq. (P32)
#[test]
fn constant_thrust_is_hyperbolic_motion() {
    let a = 0.5_f64;
    let mut flight = flight([7.0, 1.0, 2.0, 3.0]);
    for _ in 0..600 {
        flight.step(0.01, &[a, 0.0, 0.0], &[0.0; 3]);
    }
    for own_time in [0.0, 0.37, 3.0, 6.0] {
        let found = pose(&mut flight, own_time);
        let [sinh, cosh] = [libm::sinh(a * own_time), libm::cosh(a * own_time)];
        // Own times have six decimals.
        let place = [7.0 + sinh / a, 1.0 + (cosh - 1.0) / a, 2.0, 3.0];
        assert_near(numbers(&found, "event"), place, 1e-9);
        assert!((found["gamma"].as_f64().unwrap() - cosh).abs() < 1e-9);
        assert_near(numbers(&found, "course"), [sinh, 0.0, 0.0], 1e-9);
    }
    // One piece, however many steps.
    let text = flight.statements("flight", Some(60.0));
    let stated = "motion flight -at 1 2 3 -vel 0 0 0\n  -acc 0.5 0 0 0 6\n  -shift 7 0 0 0 ;\n\
                  cam -ep 1 2 3 -vc 2 2 3 -ud 0 0 1 -va 60 <flight> ;\n";
    assert_eq!(text, stated);
}

/// Two boosts and the brake back to rest are a closed loop of velocities: it turns by the Wigner
/// rotation of the two.  Eq. (P25)
#[test]
fn a_closed_loop_of_velocities_turns_the_camera() {
    let [first, second] = [1.2_f64, 0.9];
    let mut flight = flight([0.0; 4]);
    flight.step(1.0, &[first, 0.0, 0.0], &[0.0; 3]);
    // To the left, which is −right.
    flight.step(1.0, &[0.0, -second, 0.0], &[0.0; 3]);
    let fast = pose(&mut flight, 2.0);
    let course: [f64; 3] = numbers(&fast, "course");
    let brake = libm::acosh(fast["gamma"].as_f64().unwrap());
    let length = DVec3::from(course).length();
    flight.step(1.0, &course.map(|part| -part / length * brake), &[0.0; 3]);
    let rest = pose(&mut flight, 3.0);
    // Accelerations have six decimals.
    assert_near(numbers(&rest, "velocity"), [0.0; 3], 1e-5);
    let along = |axis: DVec3, rapidity| Velocity::from_rapidity(axis, rapidity).unwrap();
    let wigner = wigner_rotation(along(DVec3::Y, second), along(DVec3::X, first));
    let view = DVec3::from(numbers(&rest, "view"));
    let expected = wigner * DVec3::X;
    assert!((view - expected).length() < 1e-5, "{view}, not {expected}");
    assert!(view.y.abs() > 0.3, "{view}");
}

/// A turn without thrust by its rate; thrust turns with the camera.
#[test]
fn turns_are_those_of_the_camera() {
    let mut flight = flight([0.0; 4]);
    let quarter = std::f64::consts::FRAC_PI_2;
    flight.step(1.0, &[0.0; 3], &[0.0, 0.0, quarter]);
    assert_near(numbers(&pose(&mut flight, 1.0), "view"), [0.0, 1.0, 0.0], 1e-6);
    flight.step(1.0, &[0.0; 3], &[0.0, quarter, 0.0]);
    assert_near(numbers(&pose(&mut flight, 2.0), "view"), [0.0, 0.0, 1.0], 1e-6);
    assert_near(numbers(&pose(&mut flight, 2.0), "up"), [0.0, -1.0, 0.0], 1e-6);
    flight.step(1.0, &[1.0, 0.0, 0.0], &[0.0; 3]);
    assert_near(numbers(&pose(&mut flight, 3.0), "velocity"), [0.0, 0.0, libm::tanh(1.0)], 1e-6);
    // What is no step changes nothing, and no thrust exceeds the limit.
    for (own_time, thrust) in [(0.0, 1.0), (-1.0, 1.0), (f64::NAN, 1.0), (1.0, f64::NAN)] {
        flight.step(own_time, &[thrust, 0.0, 0.0], &[0.0; 3]);
    }
    flight.step(1.0, &[1.0], &[0.0; 3]);
    assert_eq!(flight.end(), 3.0);
    for _ in 0..100 {
        flight.step(1.0, &[1.0, 0.0, 0.0], &[0.0; 3]);
    }
    assert!(pose(&mut flight, 103.0)["gamma"].as_f64().unwrap() < 4100.0);
    for start in ["{", "{}", r#"{"event": [0, 0, 0, 0], "velocity": [1, 0, 0]}"#] {
        assert!(Flight::new(start).is_err(), "{start}");
    }
}

/// A recorded flight is drawn by ugfilm with the pixels that the page draws. Pictures in between,
/// of a camera that passes the event with the same velocity, are the same but for rounding.
#[test]
fn recorded_flights_are_films() {
    let shell = Shell::new(&["house.ug", "street.ug", "twins.ug", "stars.csv"]);
    let mut random = Random(11);
    let mut part = move |most: f64| random.between(-most, most);
    for row in 0..20 {
        let scene = ["house.ug", "street.ug", "twins.ug", "stars.csv"][row % 4];
        let is_sky = scene == "stars.csv";
        let mut studio = studio(&shell, &[scene]);
        let start = json!({"event": [0, 0, 0, 0], "velocity": [0, 0.5, 0], "view": [0, 1, 0], "up": [0, 0, 1]});
        let (start, angle) = if is_sky {
            (start, None)
        } else {
            let line = format!("uglorentz -cv 0 .2 0 -ti 1 {scene} | ugrainbow -sz 48 27");
            let about = studio.describe(&commands(&line)).unwrap();
            let about: Value = serde_json::from_str(&about).unwrap();
            (about["start"].clone(), about["angle"].as_f64())
        };
        let mut flight = Flight::new(&start.to_string()).unwrap();
        for _ in 0..12 {
            let [thrust, turn] = [1.5, 0.8].map(|most| [0; 3].map(|_| part(most)));
            (0..4).for_each(|_| flight.step(0.03, &thrust, &turn));
        }
        let own_time = if row < 10 { flight.end() } else { 0.7317 };
        let include = if is_sky { String::new() } else { format!("include {scene} ;\n") };
        let text = flight.statements("flight", angle) + &include;
        shell.write("flight.ug", &text);
        studio.add("flight.ug".to_owned(), text.into_bytes());
        let (line, film, source) = if is_sky {
            let line = format!("ugwarp --scene flight.ug -ti {own_time} {scene} -look light");
            (line, "-warp --scene flight.ug", scene)
        } else {
            let line = format!("uglorentz -ti {own_time} flight.ug | ugdoppler | ugrainbow");
            (line, "-look 1988", "flight.ug")
        };
        let shown = studio.draw(&commands(&format!("{line} -sz 48 27"))).unwrap();
        shell.run(&format!(
            "ugfilm {film} -frames 1 -ti {own_time} -sz 48 27 -fo frame{row}_%d.png {source}"
        ));
        assert!(
            shown.pixels() == shell.pixels(&format!("frame{row}_1.png")).as_flattened(),
            "{scene} at {own_time}"
        );
        // As the page draws it in flight.
        let pose = pose(&mut flight, own_time);
        let [t, x, y, z] = numbers(&pose, "event");
        let velocity = DVec3::from(numbers(&pose, "velocity"));
        let eye = DVec3::new(x, y, z) - velocity * t;
        let [view, up] = ["view", "up"].map(|name| DVec3::from(numbers(&pose, name)));
        let words = |name: &str, v: DVec3| format!(" -{name} {} {} {}", v.x, v.y, v.z);
        let camera = words("cv", velocity) + &words("ud", up);
        let live = if is_sky {
            format!("ugwarp{camera}{} {scene} -look light", words("vc", view))
        } else {
            let clock = t / pose["gamma"].as_f64().unwrap();
            let place = words("ep", eye) + &words("vc", eye + view);
            format!("uglorentz{camera}{place} -ti {clock} {scene} | ugdoppler | ugrainbow")
        };
        let drawn = studio.draw(&commands(&format!("{live} -sz 48 27"))).unwrap();
        let both = drawn.pixels().into_iter().zip(shown.pixels());
        let n_other = both.filter(|(a, b)| a.abs_diff(*b) > 8).count();
        assert!(n_other <= 40, "{scene} at {own_time}: {n_other} of 5184 bytes differ");
    }
}

/// Finder patterns in three corners; texts that are too long have no code.
#[test]
fn links_have_qr_codes() {
    let code = qr_code("https://example.org/uglorentz.html#s=house.ug");
    let size = (1..).find(|size| size * size >= code.len()).unwrap();
    assert_eq!(size * size, code.len());
    let at = |x: usize, y: usize| code[y * size + x];
    for [x, y] in [[0, 0], [size - 7, 0], [0, size - 7]] {
        for k in 0..7 {
            assert_eq!([at(x + k, y), at(x + k, y + 6), at(x, y + k), at(x + 6, y + k)], [1; 4]);
        }
        assert_eq!([at(x + 1, y + 1), at(x + 3, y + 3)], [0, 1]);
    }
    assert!(qr_code(&"x".repeat(3000)).is_empty());
}
