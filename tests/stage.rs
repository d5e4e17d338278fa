//! The stage of a scene in real pipes: comments have no effect on programs, and wrong orders are
//! refused.

use ugtests::programs;

/// A scene with everything that programs use: bodies at rest and in motion, a face that is far from
/// flat, one with a hole, normals, spectra, coloured and moving lights, wires, and a comment at
/// each of them.
const SCENE: &str = "{ A licence. }
{ ours: nothing } c red 1 20 .8; { a colour }
c blue .8 230; c_rgb green .2 .8 .3; c_bb glow 4000 .5;
{ the floor } v a -4 9 -2; v b 4 9 -2; { a corner } v c 4 9 2; v d -4 9 2;
v e -1 9 -1; v f 1 9 -1; v g 1 9 1; v h -1 9 1;
f wall (a b c d) (e f g h) blue; { with a hole }
v i -3 7 -2 red; v j -1 7 -2; v k -1 8 1; v l -3 7 1;
f bent (i j k l) red <.1 .3 0>;
v m 1 7 -1 0 -1 0; v n 3 7 -1 0 -1 .1; v o 2 7 1 .1 -1 0;
f (m n o) green <0 -.2 .1>;
{ a wire } w (i m o) glow <0 0 .2>;
l .3; l .6 -1 -2 3 blue; { of the sky } l lamp .4 0 5 2 0 red <.2 0 0>;
cam -ep 0 0 0 -vc 0 8 0 -va 70 50; { the eye }
{ the end }
";

/// The output of a pipe of programs, with `joint` applied to the text between them.
#[track_caller]
fn piped(commands: &[&str], input: &str, joint: fn(&[u8]) -> Vec<u8>) -> Vec<u8> {
    commands.iter().fold(input.into(), |input, command| {
        let output = programs::fed(command, joint(&input));
        let messages = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{commands:?}: {messages}");
        output.stdout
    })
}

/// A picture without the command lines in the header of a PPM file.
fn without_history(file: &[u8]) -> Vec<u8> {
    let is_comment = |line: &&[u8]| line.starts_with(b"#");
    let n_lines =
        file.split_inclusive(|&byte| byte == b'\n').skip(1).take_while(is_comment).count();
    let mut lines = file.splitn(n_lines + 2, |&byte| byte == b'\n');
    let (first, rest) = (lines.next().unwrap_or_default(), lines.last().unwrap_or_default());
    [first, b"\n", rest].concat()
}

/// A scene without any of its comments, which nest.
fn without_comments(text: &[u8]) -> Vec<u8> {
    let mut depth = 0;
    let kept = |&byte: &u8| {
        depth += i32::from(byte == b'{');
        let is_outside = depth == 0;
        depth -= i32::from(byte == b'}');
        is_outside
    };
    text.iter().copied().filter(kept).collect()
}

#[test]
fn comments_tell_programs_nothing() {
    let lorentz = [
        "",
        "-vel 0 -.4 .1 -in -sd 2",
        "-cv .3 .2 0 -sm",
        "-nc -ti 2",
        "--no-flight-time",
        "-vel 0 0 0",
    ];
    let doppler = [
        "",
        "-gw -vr",
        "-sp -ir",
        "-li",
        "-br photon --no-doppler",
        "-sp --no-flux -li",
        "-gw -li -hd",
    ];
    let rainbow = ["-dt ppm", "-dt pfm", "-dt ppm -lg -dl -gr", "-dt ppm -iw -ed"];
    let mut n_pictures = 0;
    let mut check = |commands: &[&str]| {
        let plain = piped(commands, SCENE, <[u8]>::to_vec);
        let stripped = piped(commands, SCENE, without_comments);
        assert!(
            without_history(&plain) == without_history(&stripped),
            "{commands:?}: comments change the result"
        );
        n_pictures += 1;
    };
    let options = |program: &str, all: &[&str]| -> Vec<String> {
        all.iter().map(|options| format!("{program} -qt {options}")).collect()
    };
    let (lorentz, doppler) = (options("uglorentz", &lorentz), options("ugdoppler", &doppler));
    let rainbow = options("ugrainbow -sz 240 180 -aa 1", &rainbow);
    for (row, first) in lorentz.iter().enumerate() {
        for (column, second) in
            doppler.iter().enumerate().filter(|(column, _)| (row + column) % 2 == 0)
        {
            // Half of the pairs, and every kind of picture.
            check(&[first, second, &rainbow[(row + column) / 2 % rainbow.len()]]);
        }
        let drawn = &rainbow[row % rainbow.len()];
        check(&[first, drawn]);
        let is_complete = !first.contains("-nc") && !first.contains("--no-flight-time");
        if is_complete && !first.contains("-sm") {
            let hues = "ugrainbow -qt -sz 40 30 -aa 1 -dt ppm -xc --no-doppler --no-flux";
            check(&[first, hues]);
        }
    }
    for last in ["ugmesh -dt obj", "ugparse check"] {
        let head_of_mesh = |text: Vec<u8>| -> String {
            let text = String::from_utf8(text).expect("text");
            text.lines()
                .filter(|line| !line.starts_with('#'))
                .flat_map(|line| [line, "\n"])
                .collect()
        };
        let commands = ["uglorentz -vel 0 -.4 .1 -sm", "ugdoppler -qt -gw", last];
        let [plain, stripped] = [<[u8]>::to_vec, without_comments]
            .map(|joint: fn(&[u8]) -> Vec<u8>| head_of_mesh(piped(&commands, SCENE, joint)));
        assert!(plain == stripped, "{commands:?}: comments change the result");
    }
    assert!(n_pictures > 25, "{n_pictures}");
}

#[test]
#[rustfmt::skip] // rows of a table
fn pipes_that_would_draw_wrong_pictures_are_refused() {
    let scene = SCENE.to_owned() + "cam side -ep 3 0 0 -vc 0 8 0;";
    let moving = "bodies in this scene move, and their positions are not as seen yet";
    let seen_from = "positions in this scene are as seen from the eye point";
    // The last program of a pipe refuses its input with these words.
    for (pipe, problem, remedy) in [
        (&["uglorentz", "uglorentz"][..], "positions in this scene are as seen already", "give the scene at rest"),
        (&["uglorentz", "ugdoppler", "ugdoppler"], "colours in this scene are as seen already",
            "start again from the scene before ugdoppler"),
        (&["ugdoppler"], moving, "give the scene to uglorentz first"),
        (&["uglorentz", "ugdoppler -ep 0 0 1"], &format!("{seen_from} 0 0 0, and would be wrong from 0 0 1"),
            "give it to uglorentz (-ep 0 0 1)"),
        (&["uglorentz -ep 0 -1 0", "ugrainbow -ep 0 0 0"],
            &format!("{seen_from} 0 -1 0, and would be wrong from 0 0 0"), "leave out -ep"),
        (&["uglorentz", "ugdoppler", "ugrainbow -ep 1 0 0"], "as seen from the eye point 0 0 0", "leave out -ep"),
        (&["uglorentz", "ugrainbow -ep 1 0 0 --explain 3,3"], "as seen from the eye point 0 0 0", "leave out -ep"),
        (&["uglorentz", "ugrainbow -cam side"], "from the eye point 0 0 0, and would be wrong from 3 0 0",
            "leave out -ep"),
        (&["uglorentz", "ugdoppler", "ugrainbow -wi"],
            "colours in this scene are as seen, and are not written as wavelengths", "give -gw to ugdoppler"),
        (&["uglorentz", "ugdoppler -sp", "ugrainbow -wi"], "are not written as wavelengths", "leave out -wi"),
        (&["uglorentz -sd 1", "ugdoppler", "ugrainbow -xc"], "those of this scene have been shifted",
            "leave ugdoppler out"),
        (&["ugrainbow -xc --no-doppler --no-flux"], moving, "give the scene to uglorentz first"),
        (&["uglorentz -nc -sd 1", "ugrainbow -xc --no-doppler --no-flux"], "left one of them out", "leave out -xc"),
    ] {
        let (last, others) = pipe.split_last().expect("a program");
        let messages = refused(last, &piped(others, &scene, <[u8]>::to_vec));
        assert!(messages.contains(problem) && messages.contains(remedy), "{pipe:?}: {messages}");
    }
}

/// The messages of a program that refuses its input.
#[track_caller]
fn refused(command: &str, input: &[u8]) -> String {
    let output = programs::fed(command, input);
    let messages = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{command}: {messages}");
    assert!(output.stdout.is_empty(), "{command}");
    messages
}

/// Nothing moves.
const STILL: &str =
    "c red 1 20; v a 0 5 0; v b 1 5 0; v c 0 5 1; f (a b c) red; l 1; cam -vc 0 5 0;";

#[test]
fn colours_come_last_even_at_rest() {
    let colored = piped(&["ugdoppler"], STILL, <[u8]>::to_vec);
    for command in ["uglorentz -vel .1 0 0", "ugdoppler"] {
        let messages = refused(command, &colored);
        assert!(
            messages.contains("colours in this scene are as seen already"),
            "{command}: {messages}"
        );
    }
}

#[test]
fn legitimate_pipes_pass() {
    let check = |pipe: &[&str], scene: &str| drop(piped(pipe, scene, <[u8]>::to_vec));
    // Nothing moves, so positions do not depend on the eye and stay at rest.
    check(
        &[
            "uglorentz -ep 0 -1 0",
            "uglorentz",
            "ugdoppler -ep 0 0 1",
            "ugrainbow -ep 1 1 1 -sz 9 9",
        ],
        STILL,
    );
    check(&["ugdoppler -vel 0 -.3 0", "ugrainbow -sz 9 9"], STILL);
    check(&["uglorentz -nc --no-flight-time", "ugdoppler", "ugrainbow -sz 9 9"], SCENE);
    // The eye point may be repeated.
    check(&["uglorentz -ep .1 0 0", "ugdoppler -ep .1 0 0", "ugrainbow -ep .1 0 0 -sz 9 9"], SCENE);
    check(&["ugrainbow -sz 9 9 -wi"], STILL);
    // Hues of bodies at rest are as they were written.
    check(&["uglorentz", "ugdoppler", "ugrainbow -sz 9 9 -wi"], STILL);
}

#[test]
fn wavelengths_need_no_option() {
    let picture = |last: &str| piped(&["uglorentz", "ugdoppler -gw", last], SCENE, <[u8]>::to_vec);
    let [plain, asked] = ["", "-wi"]
        .map(|option| without_history(&picture(&format!("ugrainbow -sz 60 40 -dt ppm {option}"))));
    assert!(plain == asked, "-wi makes a difference");
}

#[test]
fn moving_bodies_at_rest_are_drawn_with_a_warning() {
    let output = programs::fed("ugrainbow -sz 9 9", SCENE.as_bytes());
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && !output.stdout.is_empty(), "{messages}");
    let warning = "bodies in this scene move, and are drawn with their shapes at rest";
    assert!(messages.contains(warning), "{messages}");
    assert!(messages.contains("<stdin>:8:1") && messages.contains("uglorentz"), "{messages}");
}

#[test]
fn explanations_name_the_law_of_spectra() {
    for (options, told, law) in [
        ("-sp", "brightness D^5 per wavelength", "\"D^5\""),
        ("-sp --no-flux", "brightness by the law `none`", "\"none\""),
        ("-br photon", "brightness by the law `photon`", "\"photon\""),
        ("-br photon -li", "the light of lamps is in them", "\"photon\""),
    ] {
        let doppler = format!("ugdoppler {options}");
        for (last, part) in [("", told), (" --format json", &format!("\"brightness_law\": {law}"))]
        {
            let last = format!("ugrainbow -sz 40 30 --explain 8,20{last}");
            let text = piped(&["uglorentz", &doppler, &last], SCENE, <[u8]>::to_vec);
            let text = String::from_utf8(text).expect("text");
            assert!(text.contains(part), "{options}: {part}\n{text}");
        }
    }
}
