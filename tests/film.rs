//! Films beside the pipes that their frames are the pictures of.
use std::collections::BTreeMap;
use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

use ugimage::{Format, Frame, Metadata};
use ugtests::shell::Shell;
use ugtests::{programs, tools};

/// The files in a folder, by name.
fn files(shell: &Shell, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(shell.path(folder)).unwrap().flatten();
    entries
        .filter(|entry| entry.file_type().unwrap().is_file())
        .map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap()))
        .collect()
}

/// Checks the status and a part of the messages of a film that fails.
#[track_caller]
fn refused(shell: &Shell, film: &str, expected: i32, message: &str) {
    let (status, messages) = shell.fail(film);
    assert!(messages.contains(message), "{film}: {messages}");
    assert_eq!(status, Some(expected), "{film}: {messages}");
}

/// Films of every renderer, with options that change.
const FILMS: [&str; 13] = [
    "-frames 3 -vel '0 0 0 .. .9 0 0' -in -sz 80 60 dice.ug",
    "-frames 3 -ti -2..2 -vel 0 .8 0 -in -sp -ex auto -ease smooth -sz 80 60 dice.ug",
    "-frames 3 -ti -2..6 -vel 0 .8 0 -follow -va 20 -sz 80 60 dice.ug",
    "-frames 3 -cv '0 0 0 .. 0 .9 0' -xc -sp -ex -2..-4 -sz 60 40 -aa 2 street.ug",
    "-frames 3 -cv '0 0 0 .. 0 .9 0' -ex follow -sp -sz 60 40 street.ug",
    "-frames 3 -vel 0 0 0..-.6 -in -vec -cap 'β = {beta}' -sz 80 60 dice.ug",
    "-frames 3 -cv '0 0 0 .. 0 .9 0' --ahead -va 60 -crease 20 -hl dash -sz 80 60 street.ug",
    "-warp -frames 3 -cv '0 0 0 .. 0 .9 0' -sp -ex auto -pz -va 100..80 -sz 60 40 sky.png",
    "-warp -pan -frames 3 -cv '0 0 0 .. 0 .9 0' -sz 60 30 sky.png",
    "-warp -frames 3 -cv '0 0 0 .. 0 .9 0' -sp -ex follow -sz 60 40 -cap 'picture {frame}' pano_%02d.png",
    "-warp -frames 3 -cv 0 .5 0 -sp -ex 0 --infrared pano_%02d.png --infrared-to 1000..1400 -sz 60 40 pano_%02d.png",
    "-warp -frames 3 -part '-180 180 -90 90 .. -180 100 -90 90' --highlights 0..6 -cv 0 .3 0 -sp -ex 0 -sz 60 40 sky.png",
    "-rays -frames 3 -loop -ti -3..3 -vel .9 0 0 -in -sz 60 40 -aa 2 shadow.ug",
];

/// Numbered panoramas of two digits, each of other colours.
fn panoramas(shell: &Shell, numbers: impl Iterator<Item = u32>) {
    for number in numbers {
        let pixel = |idx: u32| {
            let [column, row] = [idx % 64, idx / 64];
            [(column * 4) as u8, (row * 8) as u8, (40 * number) as u8, 255]
        };
        let frame = Frame::new([64, 32], true, (0..64 * 32).map(pixel).collect());
        let file = Format::Png.encode(&frame, &Metadata::default());
        shell.write(&format!("pano_{number:02}.png"), file);
    }
}

#[test]
fn every_frame_is_the_picture_of_its_pipe() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    shell.run("ugphoton -pan -sz 80 40 -aa 1 street.ug > sky.png");
    panoramas(&shell, 1..=3);
    for (row, film) in FILMS.into_iter().enumerate() {
        let ending = if film.contains("-vec") { "svg" } else { "png" };
        for n_threads in [1, 5] {
            let folder = format!("film{row}-{n_threads}");
            shell.run(&format!(
                "mkdir {folder}; ugfilm {film} -nt {n_threads} -fo {folder}/f_%02d.{ending}"
            ));
        }
        shell.run(&format!(
            "mkdir pipe{row}; ugfilm {film} -fo pipe{row}/f_%02d.{ending} --print > frames.sh"
        ));
        let [_, messages] = shell.run("sh -e frames.sh");
        assert!(!messages.contains("error"), "{messages}");
        let expected = files(&shell, &format!("pipe{row}"));
        assert!(expected.len() >= 3 && expected.values().all(|bytes| bytes.len() > 300), "{film}");
        let distinct: std::collections::BTreeSet<&Vec<u8>> = expected.values().collect();
        assert_eq!(distinct.len(), expected.len(), "{film}: frames differ");
        for n_threads in [1, 5] {
            assert!(
                files(&shell, &format!("film{row}-{n_threads}")) == expected,
                "{film} -nt {n_threads}"
            );
        }
        // The command of a single frame.
        let print = format!("ugfilm {film} -fo pipe{row}/f_%02d.{ending} --print");
        let [one, _] = shell.run(&format!("{print} 2"));
        let [all, _] = shell.run(&print);
        assert_eq!(Some(one.trim_end()), all.lines().nth(1));
    }
}

/// Names of files and captions that shells, terminals and comments of scenes would take apart.
const NAMES: [&str; 9] = [
    "two words",
    "it's",
    "a\tb",
    "a\nb",
    "{a}",
    "$(touch made)",
    "\u{202e}gnp",
    "\u{1b}[2J\\",
    "./-vel",
];

/// The printed command draws the same bytes, and so does the one that a picture records.
/// Spheres and the like are exact for rays and polygons elsewhere, in frames as in pipes.
#[test]
fn round_faces_are_those_of_the_pipe() {
    let shell = Shell::new(&[]);
    let shapes = [
        "sphere 0 0 0 1",
        "cylinder 0 0 -1 0 0 1 .7",
        "tube 0 -.3 -1 0 .3 1 .7",
        "disc 0 0 0 .2 -1 .3 1",
    ];
    for (row, shape) in shapes.into_iter().enumerate() {
        let name = format!("round{row}.ug");
        shell.write(&name, format!("{shape}; l .4; l .8 1 -2 2; cam -ep 0 -6 1 -vc 0 0 0 -va 30;"));
        let mut pictures = Vec::new();
        for mode in [
            "-rays",
            "-xc -sd 1",
            "-xc",
            "",
            "-sd 1",
            "-sp -li",
            "-rays -dl",
            "-xc -sd 1 -dl",
            "-wf",
            "-vec -dt svg",
            "-follow",
        ] {
            let film = format!(
                "ugfilm -frames 2 -vel .5 0..0.6 0 -in -ex 0 {mode} -sz 60 45 -fo f_%d.png {name}"
            );
            shell.run(&format!("rm -f f_*; {film}; cp f_2.png film.png; rm f_*"));
            shell.run(&format!("{film} --print 2 > one.sh; sh -e one.sh"));
            let frame = shell.read("film.png");
            assert!(frame == shell.read("f_2.png"), "{shape}: {mode}");
            let [script, _] = shell.run("ugsheet -qt --history film.png");
            assert!(script.contains(&name), "{script}");
            shell.run("ugsheet -qt --history film.png > one.sh; sh -e one.sh > again.png");
            assert!(frame == shell.read("again.png"), "{shape}: {mode}: {script}");
            pictures.push(frame);
        }
        // Rays meet the shape itself.
        assert!(pictures[1] != pictures[2], "{shape}");
    }
}

#[test]
fn commands_draw_the_same_whatever_names_are() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let bash = |script: &str| {
        let mut bash = Command::new("bash");
        bash.args(["-e", "-o", "pipefail", "-c", script]);
        bash.current_dir(shell.folder()).env("PATH", programs::path()).output()
    };
    if bash("true").is_err() {
        return;
    }
    let path = |name: &str| shell.path(name);
    for name in NAMES {
        // In captions of films braces are places for numbers, and the font has no signs of
        // direction.
        let caption = name.replace(['{', '}', '\u{202e}', '\u{1b}'], "?");
        fs::copy(path("dice.ug"), path(name)).unwrap();
        let film = |last: &[&str]| {
            let mut film = Command::new(programs::folder().join("ugfilm"));
            film.args([
                "-frames", "2", "-ti", "0..1", "-vel", ".5", "0", "0", "-in", "-sz", "160", "120",
                "-cap", &caption,
            ])
            .args(last)
            .current_dir(shell.folder());
            let output = film.output().unwrap();
            assert!(
                output.status.success(),
                "{name:?}: {}",
                String::from_utf8_lossy(&output.stderr)
            );
            String::from_utf8(output.stdout).unwrap()
        };
        film(&["-fo", "drawn_%d.png", "-fi", name]);
        let printed = film(&["-fo", "piped_%d.png", "--print", "2", "-fi", name]);
        let ran = bash(&printed).unwrap();
        assert!(ran.status.success(), "{printed}: {}", String::from_utf8_lossy(&ran.stderr));
        let [drawn, piped] = ["drawn_2.png", "piped_2.png"].map(|name| shell.read(name));
        assert!(drawn == piped, "{name:?}: {printed}");
        let [recorded, _] = shell.run("ugsheet --history drawn_2.png");
        let recorded = recorded.lines().last().unwrap();
        let ran = bash(&format!("{recorded} > again.png")).unwrap();
        assert!(ran.status.success(), "{recorded}: {}", String::from_utf8_lossy(&ran.stderr));
        assert!(shell.pixels("again.png") == shell.pixels("drawn_2.png"), "{recorded}");
        fs::remove_file(path("drawn_1.png")).unwrap();
        fs::remove_file(path("drawn_2.png")).unwrap();
        fs::remove_file(path(name)).unwrap();
    }
    assert!(!path("made").exists());
}

#[test]
fn frames_that_are_done_are_not_drawn_again() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let film = "ugfilm -frames 6 -vel 0 0..0.8 0 -in -sz 80 60 dice.ug -fo f_%02d.png";
    let drawn = |messages: &str| messages.lines().last().unwrap_or_default().to_owned();
    shell.run(film);
    let whole = files(&shell, ".");
    let [_, messages] = shell.run(film);
    assert_eq!(drawn(&messages), "ugfilm: note: 0 frames drawn, 6 were there already");
    // One is missing, one was cut off, one was drawn otherwise, one of another scene.
    let cut = shell.read("f_03.png");
    shell.write("f_03.png", &cut[..cut.len() - 1]);
    shell.run("rm f_02.png; uglorentz dice.ug | ugdoppler | ugrainbow -sz 80 60 > f_04.png");
    shell.run(&format!("cp dice.ug kept; echo >> dice.ug; {film} -only 5; mv kept dice.ug"));
    let [_, messages] = shell.run(film);
    assert_eq!(drawn(&messages), "ugfilm: note: 4 frames drawn, 2 were there already");
    assert!(files(&shell, ".") == whole);
    // Another option is another film.
    let [_, messages] = shell.run(&format!("{film} -aa 2 -only 1..3,6"));
    assert!(!messages.contains("already"), "{messages}");
}

#[test]
fn killed_films_go_on_and_two_processes_share_one() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let film = "ugfilm -frames 24 -ti -2..2 -vel 0 .8 0 -in -sz 120 90 dice.ug -fo out/f_%02d.png";
    shell.run(&format!("mkdir out; {film}; mv out whole; mkdir out"));
    for milliseconds in [20, 90, 150, 300] {
        let exec = format!("exec {film}");
        let mut run = shell.command(&exec).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        // It may have finished.
        let _ = run.kill();
        run.wait().unwrap();
    }
    let left = files(&shell, "out");
    let whole = files(&shell, "whole");
    for (name, bytes) in left.iter().filter(|(name, _)| name.starts_with('f')) {
        assert!(whole[name] == *bytes, "{name} is half written");
    }
    shell.run(&format!("{film} & {film} & wait"));
    shell.run(film);
    let done: BTreeMap<_, _> =
        files(&shell, "out").into_iter().filter(|(name, _)| name.starts_with('f')).collect();
    assert!(done == whole);
}

#[test]
fn films_in_one_file_have_the_pixels_of_their_frames() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let film = "ugfilm -frames 5 -vel 0 0..0.8 0 -in -sz 81 60 dice.ug";
    shell.run(&format!(
        "{film} -fo film.ppm; {film} -fo film.apng -fps 12.5; {film} -fo film.gif -keep k_%02d.png"
    ));
    shell.run(&format!(
        "{film} -fo film.y4m; {film} -fo f_%02d.png; {film} -fo again.ppm -keep f_%02d.png"
    ));
    let pixels = |row: usize| shell.pixels(&format!("f_{row:02}.png"));
    let files = files(&shell, ".");
    assert!(files["film.ppm"] == files["again.ppm"]);
    for row in 1..=5 {
        assert!(files[&format!("k_{row:02}.png")] == files[&format!("f_{row:02}.png")]);
        let rgb: Vec<u8> =
            pixels(row).iter().flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        let head = b"P6\n81 60\n255\n";
        let frame = &files["film.ppm"][(row - 1) * (head.len() + rgb.len())..];
        assert!(frame.starts_with(head) && frame[head.len()..].starts_with(&rgb), "frame {row}");
    }
    // The first frame of an animated PNG is what other programs read.
    assert!(shell.pixels("film.apng") == pixels(1));
    let decoder = png::Decoder::new(std::io::Cursor::new(&files["film.apng"])).read_info().unwrap();
    let control = decoder.info().animation_control().unwrap();
    assert_eq!((control.num_frames, control.num_plays), (5, 0));
    let delay = decoder.info().frame_control().unwrap();
    assert_eq!((delay.delay_num, delay.delay_den), (2, 25));
    let head = b"YUV4MPEG2 W81 H60 F25:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
    assert!(files["film.y4m"].starts_with(head));
    assert_eq!(files["film.y4m"].len(), head.len() + 5 * (6 + 3 * 81 * 60));
}

/// A page has the pictures of its frames, the changing values, and the commands that draw them.
#[test]
fn pages_have_the_pictures_and_their_commands() {
    use base64::Engine;
    let shell = Shell::new(&["dice.ug"]);
    let film = "ugfilm -frames 4 -vel 0 0..0.8 0 -in -cap '<\"{beta}\" & more' -sz 81 60 dice.ug";
    shell.run(&format!("{film} -fo lesson.html -fps 4; {film} -fo f_%02d.png"));
    let page = String::from_utf8(shell.read("lesson.html")).unwrap();
    assert!(
        page.starts_with("<!DOCTYPE html>")
            && page.ends_with("</html>\n")
            && page.contains(", 250);")
    );
    let attribute = |picture: &str, name: &str| {
        let value = picture.split_once(&format!("{name}=\"")).unwrap().1.split_once('"').unwrap().0;
        value.replace("&quot;", "\"").replace("&lt;", "<").replace("&amp;", "&")
    };
    let pictures: Vec<&str> = page.lines().filter(|line| line.starts_with("<img")).collect();
    assert_eq!(pictures.len(), 4);
    for (row, picture) in (1..).zip(pictures) {
        let source = attribute(picture, "src");
        let png = base64::engine::general_purpose::STANDARD
            .decode(source.split_once(',').unwrap().1)
            .unwrap();
        shell.write("shown.png", png);
        assert!(
            shell.pixels("shown.png") == shell.pixels(&format!("f_{row:02}.png")),
            "picture {row}"
        );
        let line = attribute(picture, "title");
        let drawn = format!("frame_{row:04}.png");
        shell.run(&line);
        assert!(shell.pixels(&drawn) == shell.pixels("shown.png"), "{line}");
        let values = attribute(picture, "alt");
        let speed = |text: &str| {
            let number = text.split_once("-vel 0 ").and_then(|(_, rest)| rest.split(' ').next());
            number.and_then(|number| number.parse::<f64>().ok())
        };
        let (shown, drawn) = (speed(&values).unwrap(), speed(&line).unwrap());
        assert!((shown - drawn).abs() < 5e-5, "{values}: {line}");
    }
}

/// A second slider has the pictures of the first for each of its values.
#[test]
fn pages_have_a_second_slider() {
    let shell = Shell::new(&["dice.ug"]);
    let film =
        "ugfilm -frames 3 -vel 0 0..0.8 0 -va 20..40 -in -cap '{va}' -ex 0 -sz 81 60 dice.ug";
    shell.run(&format!("{film} -across va 2 -fo lesson.html"));
    let page = String::from_utf8(shell.read("lesson.html")).unwrap();
    let values = page.lines().filter_map(|line| line.strip_prefix("<img hidden alt=\""));
    let values: Vec<&str> = values.map(|rest| rest.split_once('"').unwrap().0).collect();
    let expected: Vec<String> = [20, 40]
        .into_iter()
        .flat_map(|angle| [0.0, 0.5, 0.8].map(|speed| format!("-vel 0 {speed} 0 -va {angle}")))
        .collect();
    assert_eq!(values, expected);
    // Numbers are rounded to be read.
    shell.run("ugfilm -frames 4 -vel 0 0..0.8 0 -in -ex 0 -sz 81 60 dice.ug -fo read.html");
    let page = String::from_utf8(shell.read("read.html")).unwrap();
    assert!(page.contains("<img hidden alt=\"-vel 0 0.3507 0\""));
    shell.run(&format!(
        "{film} -across va 2 --print 5 -fo lesson.html > command.sh && sh command.sh"
    ));
    shell.run("ugfilm -frames 1 -vel 0 0.5 0 -va 40 -in -cap 40.00 -ex 0 -sz 81 60 dice.ug -fo one_%d.png");
    assert!(shell.pixels("frame_0005.png") == shell.pixels("one_1.png"));
    for wrong in ["-across va 0", "-across ti 2", "-across va 2 -only 1"] {
        shell.fail(&format!("{film} {wrong} -fo wrong.html"));
    }
    shell.fail(&format!("{film} -across va 2 -fo wrong.gif"));
}

/// The frames of a GIF as browsers show them, each with its time in hundredths of a second.
fn gif_frames(file: &[u8]) -> Vec<(u16, Vec<[u8; 4]>)> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(file).unwrap();
    let [width, height] = [decoder.width(), decoder.height()].map(usize::from);
    let (mut shown, mut frames) = (vec![[0; 4]; width * height], Vec::new());
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let rows = frame.buffer.as_chunks::<4>().0.chunks(usize::from(frame.width));
        for (row, pixels) in rows.enumerate() {
            let begin = (usize::from(frame.top) + row) * width + usize::from(frame.left);
            let drawn = shown[begin..].iter_mut().zip(pixels).filter(|(_, pixel)| pixel[3] > 0);
            drawn.for_each(|(shown, pixel)| *shown = *pixel);
        }
        frames.push((frame.delay, shown.clone()));
        if frame.dispose == gif::DisposalMethod::Background {
            assert_eq!([frame.width, frame.height].map(usize::from), [width, height]);
            shown.fill([0; 4]);
        }
    }
    frames
}

/// A flash of one frame is in the GIF, gradients keep their colours, and what is transparent in
/// frames is so in the film.
#[test]
fn gifs_have_the_colours_of_their_frames() {
    let shell = Shell::new(&["dice.ug"]);
    shell.write(
        "flash.ug",
        "c_rgb k .3 .3 .35; c_rgb r 1 .1 .1; c_time t -step 0 k 51.2 r 51.7 k; v a -3 0 -2; v b 3 0 -2; \
         v c 3 0 2; v d -3 0 2; f (a b c d) t 1 <0 0 0>; cam -ep 0 -9 0 -vc 0 0 0;",
    );
    shell.run("ugfilm -frames 200 -ti 9..108.5 -look shape -sz 16 12 -fo flash.gif flash.ug");
    let frames = gif_frames(&shell.read("flash.gif"));
    let is_red = |row: &usize| frames[*row].1[6 * 16 + 8] == [255, 26, 26, 255];
    assert_eq!((0..200).filter(is_red).collect::<Vec<_>>(), [103]);
    shell.write(
        "gradient.ug",
        "c_rgb w .8 .4 .2; c_rgb k1 .1 .2 .5; c_rgb k2 .8 .8 .3; v a -1 0 -1; v b 1 0 -1; v c 1 0 1; v d -1 0 1; \
         f (a b c d) w <.6 0 0>; v p -30 9 -20 k1; v q 30 9 -20 k2; v r 30 9 20 k1; v s -30 9 20 k2; \
         f (p q r s); l 1; cam -ep 0 -8 0 -vc 0 0 0 -va 50;",
    );
    for (options, scene, error) in [
        ("-ti -4..4 -look shape", "gradient.ug", 0.1),
        ("-cv '0 0 0 .. 0 .5 0' -va 20 -tb", "dice.ug", 0.2),
    ] {
        let film = format!("ugfilm -frames 5 {options} -sz 160 120 {scene}");
        shell.run(&format!("{film} -fps 60 -fo film.gif -keep k_%d.png"));
        let (mut sum, mut n_transparent) = (0, 0);
        let frames = gif_frames(&shell.read("film.gif"));
        for (row, (delay, shown)) in frames.iter().enumerate() {
            // Browsers show less than two hundredths of a second for ten.
            assert_eq!(*delay, 2, "{film}");
            for (shown, pixel) in shown.iter().zip(shell.pixels(&format!("k_{}.png", row + 1))) {
                assert_eq!(shown[3] == 255, pixel[3] >= 128, "{film}");
                if shown[3] == 255 {
                    sum += (0..3)
                        .map(|part| u32::from(shown[part].abs_diff(pixel[part])))
                        .sum::<u32>();
                } else {
                    n_transparent += 1;
                }
            }
        }
        let mean = f64::from(sum) / f64::from(5 * 160 * 120 * 3);
        assert!(frames.len() == 5 && mean < error, "{film}: {mean}");
        assert_eq!(n_transparent > 0, options.contains("-tb"), "{film}");
    }
}

/// The frames of an animated PNG last exactly as long as the rate says.
#[test]
fn the_times_of_animated_png_are_exact() {
    let shell = Shell::new(&["dice.ug"]);
    for (rate, expected) in
        [("24", Some((1, 24))), ("29.97", Some((1001, 30000))), ("99.999", None)]
    {
        shell.run(&format!(
            "ugfilm -qt -frames 5 -vel 0 0..0.8 0 -sz 8 6 -fps {rate} -fo a.apng dice.ug"
        ));
        let file = shell.read("a.apng");
        let mut reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().unwrap();
        let mut seconds = 0.0;
        for _ in 0..5 {
            reader.next_frame(&mut [0; 8 * 6 * 4]).unwrap();
            let delay = reader.info().frame_control().unwrap();
            let delay = (delay.delay_num, delay.delay_den);
            assert!(expected.is_none_or(|expected| delay == expected), "{rate}: {delay:?}");
            seconds += f64::from(delay.0) / f64::from(delay.1);
        }
        let exact =
            expected.map_or(5.0 / 99.999, |(num, den)| 5.0 * f64::from(num) / f64::from(den));
        assert!((seconds - exact).abs() < 1.0 / 60_000.0, "{rate}: {seconds}");
    }
}

#[test]
fn one_exposure_and_one_camera_for_all_frames() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let film = "-frames 4 -vel '0 0 0 .. 0 -.8 0' -sp -ex auto -sz 80 60";
    let [commands, messages] = shell.run(&format!("ugfilm {film} -fo f_%d.png --print dice.ug"));
    let exposures: std::collections::BTreeSet<&str> = commands
        .lines()
        .map(|line| line.split(" -ex ").nth(1).unwrap().split(' ').next().unwrap())
        .collect();
    let [stops] = Vec::from_iter(exposures)[..] else { panic!("{commands}") };
    assert!(messages.contains(&format!("one exposure for all frames: -ex {stops}")), "{messages}");
    shell.run("grep -v '^cam' dice.ug > bare.ug");
    let [commands, messages] = shell
        .run(&format!("ugfilm {film} -ex 0 -fo f_%d.png --print bare.ug").replace("-ex auto ", ""));
    let eyes: std::collections::BTreeSet<&str> = commands
        .lines()
        .map(|line| line.split(" -ep ").nth(1).unwrap().split(" |").next().unwrap())
        .collect();
    assert_eq!(eyes.len(), 1, "{commands}");
    assert!(
        messages.contains("no camera in the scene") && messages.contains("in all frames"),
        "{messages}"
    );
}

/// The exposure that follows a still scene is that of the whole film, frames have it in whatever
/// order and by whatever process they are drawn, and it is between those of single frames.
#[test]
fn exposures_follow_the_light() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let draw = |folder: &str, options: &str| {
        shell.run(&format!(
            "mkdir -p {folder}; ugfilm {options} -sz 64 48 street.ug -fo {folder}/f_%02d.png"
        ))
    };
    for still in ["-frames 3", "-frames 3 -rays -aa 1", "-frames 3 -blur 1"] {
        let [_, followed] = draw("still", &format!("{still} -ex follow"));
        let [_, held] = draw("held", &format!("{still} -ex hold"));
        draw("auto", &format!("{still} -ex auto"));
        let frames = ["still", "held", "auto"].map(|folder| files(&shell, folder));
        assert!(
            frames[0].len() == 3 && frames[0] == frames[2] && frames[1] == frames[2],
            "{still}"
        );
        assert!(followed.contains("one exposure for all frames") && followed == held, "{followed}");
        shell.run("rm -r still held auto");
    }
    let film = "-frames 6 -cv '0 0 0 .. 0 .95 0'";
    let [_, notes] = draw("whole", &format!("{film} -ex follow"));
    assert!(notes.contains("the exposure follows the light, from -ex "), "{notes}");
    for frame in 1..=6 {
        let pixels = shell.pixels(&format!("whole/f_{frame:02}.png"));
        let n_white = pixels.iter().filter(|pixel| pixel[..3] == [255; 3]).count();
        assert!(100 * n_white <= pixels.len(), "frame {frame}: {n_white} of {}", pixels.len());
    }
    for part in ["-only 3..5", "-only 2,6 -nt 1", "", ""] {
        draw("parts", &format!("{film} {part} -ex follow"));
    }
    assert_eq!(files(&shell, "parts"), files(&shell, "whole"));
    draw("parts", &format!("{film} -ex hold"));
    assert_ne!(files(&shell, "parts"), files(&shell, "whole"));
    let stops = |exposure: &str| -> Vec<f64> {
        let [commands, _] =
            shell.run(&format!("ugfilm {film} {exposure} -sz 64 48 street.ug -fo x.gif --print"));
        let stops = commands
            .lines()
            .map(|line| line.split(" -ex ").nth(1).unwrap().split(' ').next().unwrap());
        stops.map(|stops| stops.parse().unwrap()).collect()
    };
    let (followed, held) = (stops("-ex follow"), stops("-ex hold"));
    assert!(
        followed.len() == 6 && followed.windows(2).all(|pair| pair[0] > pair[1]),
        "{followed:?}"
    );
    assert!(followed[0] > held[0] && followed[5] < held[5]);
    let wrong = format!("ugfilm {film} -across va 2 -va 40..50 -ex follow street.ug -fo x.html");
    refused(&shell, &wrong, 2, "leave out -across, or give -ex hold");
}

/// A mesh and a camera on a motion, in one line.
#[test]
fn a_camera_moves_past_a_mesh() {
    let shell = Shell::new(&["dice.ug"]);
    shell.run("mkdir meshes; ugmesh -dt gltf dice.ug > meshes/dice.gltf");
    let film = "ugfilm -frames 3 -ti 0..6 -sz 40 30 -fo f_%d.png";
    let scene = "motion car -at 0 -9 1 -acc 0 .1 0 ; cam -ep 0 -9 1 -vc 0 0 0 <car> ;";
    shell.run(&format!("echo 'include \"meshes/dice.gltf\" ; {scene}' | {film}"));
    let drawn = || [1, 2, 3].map(|number| shell.pixels(&format!("f_{number}.png")));
    let included = drawn();
    shell.run(&format!("rm f_*; (ugparse flatten meshes/dice.gltf; echo '{scene}') | {film}"));
    let converted = drawn();
    assert!(included == converted && included[0] != included[1] && included[1] != included[2]);
}

#[test]
fn the_exposure_of_a_film_is_kept_for_the_next_start() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let film = |options: &str, scene: &str| {
        let options =
            format!("-frames 2 -vel 0 -.8 0 -ti 0..1 -ex auto -sz 20 15 {options} -fo f_%d.png");
        let [_, messages] = shell.run(&format!("ugfilm {options} {scene}"));
        messages.lines().find(|line| line.contains("one exposure")).unwrap().to_owned()
    };
    let found = film("-only 1", "dice.ug");
    // A number that was not measured shows that the file is read.
    shell.run("sed -i 's/ .*/ 1 9.125/' .f_1.png.exposure");
    let kept = "ugfilm: note: one exposure for all frames: -ex 9.125";
    assert_eq!(film("-only 1", "dice.ug"), kept);
    // It is that of other options or another scene no longer.
    assert_ne!(film("-br photon -only 1", "dice.ug"), kept);
    assert_eq!(film("-only 1", "dice.ug"), found);
    shell.run("sed -i 's/ .*/ 1 9.125/' .f_1.png.exposure");
    shell.run("sed 's/^l 0.35/l 0.3/' dice.ug > dim.ug");
    assert_ne!(film("-only 1", "dim.ug"), kept);
    // Nothing is left beside a complete film.
    assert!(shell.path(".f_1.png.exposure").exists());
    film("", "dice.ug");
    assert!(!shell.path(".f_1.png.exposure").exists());
}

/// Captions have the speeds of a camera on a motion, tanh(a τ), and those that the scene states.
#[test]
fn speeds_of_captions_are_those_of_the_scene() {
    let shell = Shell::new(&[]);
    let wall = "v a -3 30 -2; v b 3 30 -2; v c 3 30 2; l 1;";
    let camera = "cam -ep 0 0 0 -vc 0 9 0";
    shell.write(
        "camera.ug",
        format!("motion car -acc 0 .1 0 0 8; {wall} f (a b c); {camera} <car>;"),
    );
    shell.write("bodies.ug", format!("{wall} f (a b c) <.3 0 0>; f (b a c) <0 .9 0>; {camera};"));
    shell.write("rest.ug", format!("{wall} f (a b c); {camera};"));
    let caption = |options: &str, scene: &str| {
        let film = format!(
            "ugfilm -qt -frames 3 -ti 0..4 {options} -cap '{{beta}}, {{gamma}}' -fo f_%d.png"
        );
        let [commands, _] = shell.run(&format!("{film} --print 2 {scene}"));
        commands.split("-cap '").nth(1).unwrap().split('\'').next().unwrap().to_owned()
    };
    let beta = libm::tanh(0.2);
    let expected = format!("{beta:.3}, {:.2}", 1.0 / (1.0 - beta * beta).sqrt());
    assert_eq!(caption("", "camera.ug"), expected);
    assert_eq!(caption("-rays", "camera.ug"), expected);
    assert_eq!(caption("", "bodies.ug"), "0.300 – 0.900, 1.05 – 2.29");
    assert_eq!(caption("", "rest.ug"), "0.000, 1.00");
    assert_eq!(caption("-cv 0 .6 0", "rest.ug"), "0.600, 1.25");
}

/// A number that is wrong in a later frame is found before the first is written.
#[test]
fn wrong_numbers_are_found_first() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    refused(
        &shell,
        "ugfilm -frames 9 -sz 20 20 -va 40..-1 -dt apng dice.ug > film.apng",
        2,
        "frame 9: ",
    );
    assert_eq!(shell.read("film.apng").len(), 0);
}

#[test]
fn mistakes() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let check = |film: &str, status: i32, message: &str| {
        refused(&shell, &format!("ugfilm {film} dice.ug"), status, message);
    };
    check("-frames 3 -sz 20 20", 2, "give numbered files, -fo frame_%04d.png, or a film");
    for (options, message) in [
        ("-fo a.png", "`png` is not a kind of film; give numbered files"),
        ("-fo a.mp5", "`mp5` is not a kind of film; give numbered files"),
        ("-fo f_%d.gif", "gif is a whole film, not a frame"),
        ("-fo f_%d.jpg", "`.jpg` is none of the formats"),
        ("-fo f_%d.png -vel 0 0..1 0", "`-vel`: speed is 1 c: it must be below 1"),
        ("-fo f_%d.png -ti 0..1..x", "frame 1: "),
        ("-fo f_%d.png -rd 3", "`-rd`: it is an option of ugphoton"),
        ("-fo f_%d.png -sp -br photon", "frame 1: "),
        ("-fo f_%d.png -only 2..4", "--only: the film has 3 frames"),
        ("-fo f_%d.png -cap '{x}'", "`{x}` is not one of {frame}"),
        ("-tb -fo a.y4m", "y4m is not transparent: leave out -tb"),
        ("-tb -fo a.ppm", "ppm is not transparent: leave out -tb"),
        ("-tb -fo a.mp4", "mp4 is not transparent: leave out -tb"),
        ("-pz -fo a.gif", "-pz packs PNG files, not a film in gif"),
        ("-fps 10 -fo f_%d.png", "leave out -fps"),
        ("-keep k_%d.png -fo f_%d.png", "--keep is for films in one file"),
        ("-moments 3 -fo f_%d.png", "`-moments` needs `-blur TIME`"),
        ("-fo f_%d.png -sz 9 9", "`-sz` is given twice"),
    ] {
        check(&format!("-frames 3 -sz 20 20 {options}"), 2, message);
    }
    check("-frames 3 -fo no/f_%d.png", 1, "cannot write `no/f_%d.png`: there is no folder `no`");
    check("-frames 0 -fo a.gif", 2, "from 1 to 10000000");
    check("-frames 3 -sz 21 20 -fo a.mp4", 2, "widths and heights of mp4 are even: give -sz 22 20");
    check("-frames 3 -sz 20..30 20 -fo f_%d.png", 2, "all frames of a film have one size");
    check("-frames 4 -sz 20..30 20 -fo f_%d.png", 2, "all frames of a film have one size");
    // A file of key frames.
    for (keys, more, message) in [
        ("1 -ti 0\n2 -ti 1\n2 -ti 2\n", "", "keys:3: frame 2 comes after frame 2"),
        ("1 -ti 0\n3 -vel 0 0 1\n", "", "`-vel`: speed is 1 c"),
        ("1 -ti 0\n", "-ti 1", "`-ti`: it is given twice"),
    ] {
        shell.write("keys", keys);
        check(&format!("-frames 3 -sz 20 20 {more} -keys keys -fo f_%d.png"), 1, message);
    }
    // Without ffmpeg.
    let without = "f=$(command -v ugfilm); PATH= $f -frames 3 -sz 20 20 -fo a.mp4 dice.ug";
    refused(&shell, without, 1, "there is no ffmpeg, which writes mp4 files");
    let left: Vec<String> = files(&shell, ".").into_keys().collect();
    assert_eq!(left, ["dice.ug", "keys", "shadow.ug", "street.ug"]);
}

#[test]
fn a_full_disk_and_a_failing_encoder_keep_what_is_done() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let film = "ugfilm -frames 9 -vel 0 0..0.8 0 -in -sz 80 60 dice.ug";
    // No file may be larger than 4 blocks of 512 bytes: the frames at high speed are.
    let largest = shell.run(&format!(
        "{film} -fo f_%d.png; ls -l f_*.png | awk '{{print $5}}' | sort -n | tail -1"
    ));
    let largest: u64 = largest[0].trim().parse().unwrap();
    let blocks = largest / 512;
    shell.run("mkdir small");
    let (_, messages) =
        shell.fail(&format!("ulimit -f {blocks}; trap '' XFSZ; {film} -nt 1 -fo small/f_%d.png"));
    assert!(
        messages.contains("cannot write `small/f_") && messages.contains("File too large"),
        "{messages}"
    );
    let whole = files(&shell, ".");
    for (name, bytes) in
        files(&shell, "small").into_iter().filter(|(name, _)| name.starts_with('f'))
    {
        assert!(whole[&name] == bytes, "{name}");
    }
    for kind in ["gif", "apng", "y4m", "ppm", "html"] {
        let full = "cannot write `/dev/full`: No space left on device";
        refused(&shell, &format!("{film} -dt {kind} -fo /dev/full"), 1, full);
    }
    // An ffmpeg that ends early.
    shell.run("mkdir bin; printf '#!/bin/sh\\necho no codec >&2; exit 3' > bin/ffmpeg; chmod +x bin/ffmpeg");
    let ended = "ffmpeg failed with exit status: 3: no codec";
    refused(&shell, &format!("PATH=$PWD/bin:$PATH; {film} -keep k_%d.png -fo a.mp4"), 1, ended);
    let files = files(&shell, ".");
    assert!(!files.contains_key("a.mp4") && !files.keys().any(|name| name.starts_with(".ug-")));
    let mut kept = files.iter().filter(|(name, _)| name.starts_with('k'));
    assert!(kept.all(|(name, bytes)| whole[&name.replacen('k', "f", 1)] == *bytes));
}

/// The light of a picture in the folder.
fn light(shell: &Shell, name: &str) -> Vec<[f32; 4]> {
    let file = shell.read(name);
    match ugimage::read_picture(&file, &ugimage::PictureLimits::default()).unwrap().pixels {
        ugimage::Pixels::Light(pixels) => pixels,
        ugimage::Pixels::Srgb(_) => panic!("{name} holds no light"),
    }
}

#[test]
fn motion_blur_is_the_mean_light_of_its_moments() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    // What does not change over the film is not blurred.
    let rest = "-frames 2 -vel 0 .5 0 -in -ex 0 -sz 60 40 -cap 'β = {beta}' dice.ug";
    shell.run(&format!("ugfilm {rest} -blur 1 -moments 7 -fo blurred_%d.png"));
    shell.run(&format!("ugfilm {rest} -fo sharp_%d.png"));
    let pixels = |name: &str| shell.pixels(name);
    assert!(pixels("blurred_1.png") == pixels("sharp_1.png"));
    // Annotations are those of the moment of the frame.
    shell.run("(cat dice.ug; echo 'v p 0 0 9; label \"above\" p;') > told.ug");
    let told = "-frames 2 -vel 0 .5 0 -in -ex 0 -sz 200 150 -lg -gr -dl -iso D 1 told.ug";
    shell.run(&format!("ugfilm {told} -blur 1 -moments 3 -fo blurred_%d.png"));
    shell.run(&format!("ugfilm {told} -fo sharp_%d.png"));
    assert!(pixels("blurred_2.png") == pixels("sharp_2.png"));
    // Frames state their size, too.
    for blur in ["", "-blur 1"] {
        shell.run(&format!(
            "ugfilm -frames 1 -ti 0..0 -ex 0 -lg -sz 4cm 4cm {blur} -fo size_%d.png dice.ug"
        ));
        let file = shell.read("size_1.png");
        let chunk = file.windows(4).position(|name| name == b"pHYs").unwrap();
        assert_eq!(file[chunk + 4..chunk + 8], 11811u32.to_be_bytes());
    }
    shell
        .run("ugfilm -frames 1 -blur 1 -sz 200 150 -ti 0..0 -lg -fo moment_%d.png --print 1 dice.ug | sh -e");
    // `--print` prints one command for each moment.
    let film = "ugfilm -frames 4 -vel 0 0..0.6 0 -in -ex -1 -tc filmic -sz 60 40 dice.ug -blur .8 -moments 5";
    for n_threads in [1, 5] {
        shell.run(&format!("mkdir t{n_threads}; {film} -nt {n_threads} -fo t{n_threads}/f_%d.png"));
        assert!(files(&shell, &format!("t{n_threads}")) == files(&shell, "t1"));
    }
    let [script, _] =
        shell.run(&format!("{film} -fo t1/f_%d.png --print 3 | tee moments.sh; sh -e moments.sh"));
    let first =
        "# frame 3 is the mean light of the next 5 pictures, developed with -ex -1 -tc filmic\n";
    assert!(script.starts_with(first), "{script}");
    let moments: Vec<Vec<[f32; 4]>> =
        (1..=5).map(|row| light(&shell, &format!("t1/f_3.0{row}.exr"))).collect();
    assert!(moments[0] != moments[4]);
    let development = ugimage::Development { stops: -1.0, tone: ugimage::Tone::Filmic };
    let mean = |idx: usize| {
        let sum =
            |part: usize| moments.iter().map(|pixels| f64::from(pixels[idx][part])).sum::<f64>();
        let [red, green, blue] = development.apply([0, 1, 2].map(|part| (sum(part) / 5.0) as f32));
        [red, green, blue, 1.0]
    };
    let expected =
        ugimage::LinearFrame::new([60, 40], true, (0..60 * 40).map(mean).collect()).to_display();
    assert!(pixels("t1/f_3.png") == expected.pixels());
    // A frame that is done is not drawn again, unless its blur is another.
    let last = |messages: &str| messages.lines().last().unwrap_or_default().to_owned();
    let [_, messages] = shell.run(&format!("{film} -fo t1/f_%d.png"));
    assert_eq!(last(&messages), "ugfilm: note: 0 frames drawn, 4 were there already");
    let [_, messages] =
        shell.run(&format!("{} -fo t1/f_%d.png", film.replace("-blur .8", "-blur .7")));
    assert!(!messages.contains("already"), "{messages}");
    refused(
        &shell,
        &format!("{film} -ch D -fo d_%d.exr"),
        2,
        "-blur gives the mean of several moments",
    );
}

/// An edge that the eye passes at a constant rate becomes a linear ramp, in linear light.
#[test]
fn a_moving_edge_is_a_linear_ramp() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let wall = "v a 0 5 -50 ; v b 99 5 -50 ; v c 99 5 50 ; v d 0 5 50 ; f wall (a b c d) ; l 1 ; \
                cam -ud 0 0 1 -va 40 30 ;";
    shell.write("wall.ug", wall);
    // From frame 1 to frame 3 the eye moves by 2; the shutter of frame 2 is open from -1/2 to 1/2.
    shell.run(
        "ugfilm -frames 3 -ep -1..1 0 0 -vc -1..1 5 0 -blur 1 -moments 64 -only 2 -sz 80 60 -fo f_%d.exr wall.ug",
    );
    let pixels = light(&shell, "f_2.exr");
    let row = &pixels[80 * 30..80 * 31];
    let whole = row[79][1];
    assert!(whole > 0.1 && row[0][1] == 0.0, "{row:?}");
    // Half a picture of 40 columns is tan 20° wide at distance 1.
    let reach = 0.5 / 5.0 / libm::tan(20f64.to_radians()) * 40.0;
    assert!(reach > 10.0);
    for (column, pixel) in row.iter().enumerate() {
        let center = column as f64 + 0.5 - 40.0;
        let expected = ((center + reach) / (2.0 * reach)).clamp(0.0, 1.0);
        let found = f64::from(pixel[1] / whole);
        // Half a moment, and half a sample at the ends of the ramp.
        assert!(
            (found - expected).abs() < 0.5 / 64.0 + 0.125 / (2.0 * reach) + 1e-3,
            "{column}: {found} {expected}"
        );
    }
}

#[test]
fn chosen_frames_on_one_sheet() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let film = "ugfilm -frames 5 -vel 0 0..0.8 0 -in -sz 80 60 dice.ug";
    shell.run(&format!("{film} -fo f_%d.png; ugsheet f_1.png f_3.png f_5.png -fo expected.png"));
    shell.run(&format!("{film} -sheet 3 -fo spread.png; {film} -sheet -only 1,3,5 -fo chosen.png"));
    let pixels = |name: &str| shell.pixels(name);
    assert!(pixels("spread.png") == pixels("expected.png"));
    assert!(pixels("chosen.png") == pixels("expected.png"));
    refused(&shell, &format!("{film} -sheet -fo sheet.gif"), 2, "-sheet writes a PNG");
}

#[test]
fn frames_are_drawn_again_after_a_change_of_an_included_file() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    shell.run("printf 'include dice.ug ;\\n' > whole.ug");
    let film = "ugfilm -frames 3 -vel 0 0..0.8 0 -in -sz 40 30 whole.ug -fo f_%d.png";
    let drawn = || {
        let [_, messages] = shell.run(film);
        messages.lines().last().filter(|line| line.contains("already")).map(str::to_owned)
    };
    assert_eq!(drawn(), None);
    let all = Some("ugfilm: note: 0 frames drawn, 3 were there already".to_owned());
    assert_eq!(drawn(), all);
    let before = files(&shell, ".");
    assert!(!before.keys().any(|name| name.starts_with('.')), "{:?}", before.keys());
    shell.run("sed -i 's/^l .*/l 0.05 ;/' dice.ug; touch -d '2001-01-01' dice.ug");
    assert_eq!(drawn(), None);
    let after = files(&shell, ".");
    assert!(["f_1.png", "f_2.png", "f_3.png"].iter().any(|name| before[*name] != after[*name]));
    assert_eq!(drawn(), all);
    // A frame alone that is older than the change is drawn alone.
    shell.run("rm f_2.png");
    assert_eq!(drawn(), Some("ugfilm: note: 1 frames drawn, 2 were there already".to_owned()));
}

/// The scene of the camera and what it includes, and a second list of stars.
#[test]
fn frames_of_skies_are_drawn_again_after_a_change_of_any_file() {
    let shell = Shell::new(&["stars.csv"]);
    let write = |name: &str, text: &str| fs::write(shell.path(name), text).unwrap();
    write("eye.ug", "include way.ug ; cam -ep 0 0 0 -vc 0 1 0 -va 80 <ship> ;");
    write("way.ug", "motion ship -acc 0 1 0 ;");
    write("more.csv", "ra,dec,mag,kelvin\n10,0,1,5000\n40,0,1,5000\n");
    let command = "ugfilm -warp -frames 2 --scene eye.ug --stars more.csv -ti 0..1 -sz 16 12 -ex 0 -fo q_%d.png stars.csv";
    let drawn =
        || shell.run(command)[1].lines().any(|line| line.contains("note: 0 frames drawn, 2 were"));
    assert!(!drawn() && drawn());
    write("way.ug", "motion ship -acc 0 2 0 ;");
    assert!(!drawn() && drawn());
    write("more.csv", "ra,dec,mag,kelvin\n10,0,2,5000\n40,0,1,5000\n");
    assert!(!drawn() && drawn());
}

/// The k-th frame is drawn from the k-th picture, and drawn again after a change of that alone.
#[test]
fn numbered_panoramas_are_those_of_the_frames() {
    let shell = Shell::new(&["stars.csv"]);
    panoramas(&shell, 5..=8);
    let film = "ugfilm -warp -frames 4 -cv 0 .5 0 --stars stars.csv -ex 0 -sz 40 30 -fo f_%d.png pano_%02d.png";
    let [_, messages] = shell.run(film);
    assert!(messages.contains("note: the first picture is `pano_05.png`"), "{messages}");
    assert!(!messages.contains("all frames are alike"), "{messages}");
    let [script, _] = shell.run(&format!("{film} --print 3"));
    assert!(
        script.starts_with("ugwarp pano_07.png ") && script.ends_with("> f_3.png\n"),
        "{script}"
    );
    let [recorded, _] = shell.run("ugsheet -qt --history f_3.png; sha256sum pano_07.png");
    let hash = recorded.lines().last().unwrap().split(' ').next().unwrap();
    let [text, _] = shell.run("ugsheet --history f_3.png");
    assert!(text.contains(hash) && text.contains("pano_07.png"), "{text}");
    // With one that is changed, and as a whole film that keeps its frames.
    let before = files(&shell, ".");
    shell.run("cp pano_05.png pano_07.png");
    let [_, messages] = shell.run(film);
    assert!(messages.contains("1 frames drawn, 3 were there already"), "{messages}");
    let after = files(&shell, ".");
    let changed: Vec<_> = before.keys().filter(|name| before[*name] != after[*name]).collect();
    assert_eq!(changed, ["f_3.png", "pano_07.png"]);
    let one = film.replace("-fo f_%d.png", "-keep f_%d.png -fo all.apng");
    let [_, messages] = shell.run(&one);
    assert!(messages.contains("0 frames drawn, 4 were there already"), "{messages}");
    shell.run(&film.replace("-fo f_%d.png", "-fo alone.apng"));
    assert!(shell.read("all.apng") == shell.read("alone.apng"));
    // A second slider has the same pictures again.
    let page = "ugfilm -warp -frames 4 -cv '0 0 0 .. 0 .5 0' -va 60..90 -across va 2 -ex 0 -sz 16 12 -fo p.html";
    let [script, _] = shell.run(&format!("{page} --print pano_%02d.png"));
    let inputs: Vec<&str> = script.lines().filter_map(|line| line.split(' ').nth(1)).collect();
    let row = ["pano_05.png", "pano_06.png", "pano_07.png", "pano_08.png"];
    assert_eq!(inputs, [row, row].concat());
}

/// A moment of motion blur is drawn from the picture of the nearest frame.
#[test]
fn moments_of_numbered_panoramas_are_those_of_the_nearest_frame() {
    let shell = Shell::new(&[]);
    panoramas(&shell, 1..=3);
    let film = "ugfilm -warp -frames 3 -cv '0 0 0 .. 0 .5 0' -blur 2 -moments 4 -sz 20 15 -dt exr -fo b_%d.exr pano_%02d.png";
    shell.run(film);
    let [script, _] = shell.run(&format!("{film} --print 2"));
    let inputs: Vec<&str> =
        script.lines().skip(1).filter_map(|line| line.split(' ').nth(1)).collect();
    assert_eq!(inputs, ["pano_01.png", "pano_02.png", "pano_02.png", "pano_03.png"]);
    shell.write("moments.sh", script);
    shell.run("sh -e moments.sh");
    let moments = ["01", "02", "03", "04"].map(|row| light(&shell, &format!("b_2.{row}.exr")));
    for (idx, pixel) in light(&shell, "b_2.exr").into_iter().enumerate() {
        for channel in 0..3 {
            let mean = moments.iter().map(|moment| moment[idx][channel]).sum::<f32>() / 4.0;
            assert!((pixel[channel] - mean).abs() < 2e-3 * mean.max(0.1), "{pixel:?} {mean}");
        }
    }
}

#[test]
fn numbered_panoramas_that_are_missing_are_named_first() {
    let shell = Shell::new(&[]);
    let film = "ugfilm -warp -frames 5 -cv 0 .5 0 -ex 0 -sz 16 12 -fo f_%d.png pano_%02d.png";
    refused(&shell, film, 1, "there are no pictures such as `pano_01.png`");
    panoramas(&shell, 0..=3);
    let message =
        "`pano_04.png` is missing, of which frame 5 is drawn; there are 4 pictures: give -frames 4";
    refused(&shell, film, 1, message);
    refused(&shell, &format!("{film} --print"), 1, message);
    shell.run("cp pano_03.png pano_04.png; cp pano_03.png pano_05.png; rm pano_02.png");
    refused(&shell, film, 1, "error: `pano_02.png` is missing, of which frame 3 is drawn\n");
    let metered = film.replace("-ex 0", "-ex auto -only 1..2");
    refused(&shell, &metered, 1, "cannot read `pano_02.png`");
    assert!(!files(&shell, ".").keys().any(|name| name.starts_with("f_")));
    shell.run(&format!("{film} -only 1..2,4..5"));
    panoramas(&shell, 2..=2);
    let [_, messages] = shell.run(film);
    let note = "of 6 pictures the film shows the first 5; give -frames 6 to show all";
    assert!(messages.contains(note), "{messages}");
    let infrared = format!("{film} -sp --infrared ir_%02d.png");
    shell.run("cp pano_00.png ir_00.png");
    refused(&shell, &infrared, 1, "`ir_01.png` is missing, of which frame 2 is drawn");
    // One that cannot be read, and a file of the very name.
    shell.run("head -c 200 pano_03.png > pano_02.png");
    refused(&shell, film, 1, "frame 3: `pano_02.png`: ");
    shell.run("cp pano_03.png pano_%02d.png; rm f_*");
    shell.run(film);
    assert_eq!(files(&shell, ".").keys().filter(|name| name.starts_with("f_")).count(), 5);
}

#[test]
fn a_million_frames_and_a_folder_that_cannot_be_written() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let film = "ugfilm -frames 1000000 -vel '.9 0 0 .. 0 .9 0' -in -sz 20 20 dice.ug";
    let [line, _] = shell.run(&format!("{film} -fo f_%07d.png --print 1000000"));
    assert!(line.contains("-vel 0 0.9") && line.ends_with("> f_1000000.png\n"), "{line}");
    shell.run(&format!("{film} -only 1,500000,999999..1000000 -fo f_%07d.png"));
    assert_eq!(files(&shell, ".").keys().filter(|name| name.starts_with("f_")).count(), 4);
    let refusal = "cannot write `/proc/f_0000003.png`";
    refused(&shell, &format!("{film} -only 3..9 -fo /proc/f_%07d.png"), 1, refusal);
}

/// A square passes a narrow view in the middle frames of a film.
#[test]
fn a_film_says_which_frames_are_empty_or_black() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let scene = "c red 1 0; v a -1 9 -1; v b 1 9 -1; v c 1 9 1; v d -1 9 1; f (a b c d) red;
                 cam -ep 0 0 0 -vc 0 9 0 -va 20;";
    let film = |options: &str, lamps: &str| {
        shell.write("pass.ug", format!("{scene} {lamps}"));
        let time = if options.contains("-ti") { "" } else { "-ti -11..29" };
        let command = format!(
            "ugfilm -frames 9 -vel .5 0 0 {time} -sz 32 24 {options} -dt apng pass.ug > film.png"
        );
        shell.run(&command)[1].clone()
    };
    let says = |found: &str, words: &str| assert!(found.contains(words), "{found}");
    // The eye sees the middle at x = .5 (t − √(81 + x²)), which is −2.66 at t = 4, 0 at 9, 2.34 at
    // 14 and 4.46 at 19. It is in view while |x| is less than about 9 tan 10° + 1 = 2.59.
    let found = film("-look shape", "l 1;");
    // Before a frame is drawn, and when it would be: from x = −2.59 on, a little inside the edge.
    let before = "nothing will be in the picture in 7 of 9 frames, 1..4, 7..9: what moves is in it with -ti from";
    let times = found.split_once(before).unwrap().1.split_whitespace().next().unwrap();
    assert!(
        (times.parse::<f64>().unwrap() - (-2.59 / 0.5 + libm::hypot(9.0, 2.59))).abs() < 0.3,
        "{times}"
    );
    // Once: at the end there is nothing to add.
    assert!(!found.contains("nothing is in") && !found.contains("is black in"), "{found}");
    assert!(!film("-look shape -ti 9..10", "l 1;").contains("nothing"));
    // Too dark, and too bright.
    let found = film("-look shape -ti 8..10 -ex -9", "l 1;");
    says(&found, "hardly anything is bright enough to be seen in all 9 frames that were drawn: ");
    let found = film("-ti 8..10 -ex 14", "l 1;");
    says(&found, "than a tenth of what is in the picture is white in all 9 frames that were drawn");
    let found = film("-look shape", "l 0;");
    says(&found, "all that is in the picture is black in 2 of 9 frames that were drawn, 5..6: ");
    // Of a part of the film.
    let found = film("-look shape -only 5..7", "l 1;");
    says(&found, "nothing will be in the picture in 1 of 3 frames, 7: ");
    assert!(!found.contains("nothing is in"), "{found}");
    // What cannot be said before is said at the end: of a fisheye picture it is not known.
    let found = film("-look shape -rays -fish 20", "l 1;");
    assert!(!found.contains("will be"), "{found}");
    says(&found, "nothing is in the picture in 7 of 9 frames that were drawn, 1..4, 7..9: ");
    // Measured frames are named once, before; frames between them are not measured.
    let half =
        "c_rgb grey .5 .5 .5; v a -9 9 -9; v b 9 9 -9; v c 9 9 9; v d -9 9 9; f (a b c d) grey;
                cam -ep 0 0 0 -vc 0 9 0 -va 20; l 1;";
    shell.write("fade.ug", half);
    let fade = |frames: &str| {
        let command = format!(
            "ugfilm {frames} -vel 0 0..0.9 0 -in -va 90 -sz 32 24 -dt apng fade.ug > film.png"
        );
        shell.run(&command)[1].clone()
    };
    let dark = "hardly anything is bright enough to be seen";
    let found = fade("-frames 9");
    assert_eq!(found.matches(dark).count(), 1, "{found}");
    says(&found, "of 9 frames that were measured, ");
    let found = fade("-frames 99");
    says(&found, "of 48 frames that were measured, ");
    says(&found, "of 99 frames that were drawn, ");
}

/// A camera that follows has what moves in the middle of every frame.
#[test]
fn a_camera_follows_what_moves() {
    let shell = Shell::new(&["dice.ug", "shadow.ug", "street.ug"]);
    let scene = "c red 1 0; v a -1 9 -1; v b 1 9 -1; v c 1 9 1; v d -1 9 1; f (a b c d) red;
                 cam -ep 0 0 0 -vc 0 9 0 -va 20; l 1;";
    shell.write("pass.ug", scene);
    let film = "ugfilm -frames 9 -vel .5 0 0 -ti -11..29 -sz 64 48 -look shape";
    let [_, messages] = shell.run(&format!("{film} -follow -fo f_%d.png pass.ug"));
    assert!(!messages.contains("nothing"), "{messages}");
    for frame in 1..=9 {
        let pixels = shell.pixels(&format!("f_{frame}.png"));
        let lit: Vec<f64> =
            (0..64 * 48).filter(|&idx| pixels[idx][0] > 100).map(|idx| (idx % 64) as f64).collect();
        let middle = lit.iter().sum::<f64>() / lit.len() as f64;
        assert!(lit.len() > 4 && (middle - 31.5).abs() < 1.5, "{frame}: {} {middle}", lit.len());
    }
    refused(
        &shell,
        &format!("{film} -follow -vc 0..1 9 0 -fo g_%d.png pass.ug"),
        2,
        "leave out -vc",
    );
}

/// `ffprobe` counts all frames in films that `ugfilm` writes with ffmpeg.
#[test]
fn films_by_ffmpeg_have_all_frames() {
    if !tools::has(&[tools::FFMPEG]) {
        return;
    }
    let shell = Shell::new(&["street.ug"]);
    for file in ["a.mp4", "a.webm"] {
        let film =
            format!("ugfilm -qt -frames 3 -cv '0 0 0 .. 0 .9 0' -sz 32 16 -fo {file} street.ug");
        shell.run(&film);
        let probe = "ffprobe -v error -count_frames -of flat -show_entries stream=nb_read_frames";
        let [found, messages] = shell.run(&format!("{probe} {file}"));
        assert_eq!(messages, "", "{film}");
        assert!(found.contains("nb_read_frames=\"3\""), "{film}: {found}");
    }
}
