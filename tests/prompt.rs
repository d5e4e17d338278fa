//! Mistakes at the prompt, and the answer to each.

use ugtests::shell::Shell;

/// What the last program of a shell command prints to standard error, without the hint at `-h`.
fn answer(shell: &Shell, command: &str) -> String {
    let shown = String::from_utf8(shell.output(command).stderr).unwrap();
    let name = command.rsplit(" | ").next().unwrap().split(' ').next().unwrap();
    let first = shown.lines().position(|line| line.starts_with(&format!("{name}: "))).unwrap_or(0);
    let lines = shown.lines().skip(first).filter(|line| !line.starts_with("try `"));
    lines.collect::<Vec<_>>().join("\n")
}

#[track_caller]
fn check(shell: &Shell, command: &str, expected: &str) {
    let shown = answer(shell, command);
    assert!(
        !expected.is_empty() && shown.contains(expected),
        "$ {command}\n{shown}\n  instead of\n{expected}"
    );
}

/// A lamp in a tetrahedron, which is closed.
const ENCLOSED_LAMP: &str =
    "v a 0 0 0; v b 1 0 0; v c 0 1 0; v d 0 0 1; f (a c b); f (a b d); f (b c d); f (c a d);
    l bulb 1 .2 .2 .2 1; cam -ep 3 3 3 -vc 0 0 0;";

/// A folder with scenes, and files that are none.
fn prepared() -> Shell {
    let shell = Shell::new(&["ship.ug", "stars.csv"]);
    let triangle = "v a 0 0 0; v b 1 0 0; v c 0 1 0;\n";
    for (name, text) in [
        ("photo.jpg", "\u{fffd}".to_owned()),
        ("ship.fbx", "Kaydara FBX Binary".to_owned()),
        ("ship.dae", "<COLLADA>".to_owned()),
        ("comment.ug", format!("# comment\n{triangle}f (a b c);\n")),
        ("slashes.ug", format!("// comment\n{triangle}f (a b c);\n")),
        ("capital.ug", format!("{triangle}F (a b c);\n")),
        ("broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n".to_owned()),
        ("boxed.ug", ENCLOSED_LAMP.to_owned()),
    ] {
        shell.write(name, text);
    }
    shell.write("photo.jpg", b"\xff\xd8\xff\xe0");
    shell
}

#[test]
fn mistakes_are_answered() {
    let shell = prepared();
    let check = |command: &str, expected: &str| check(&shell, command, expected);

    // Programs in the wrong order.
    let seen = "error: positions in this scene are as seen already, so its rest shapes are not known: give the scene \
                at rest: uglorentz, ugphoton and ugfilm each compute themselves where it is seen, so only one of \
                them is in a pipe";
    check("uglorentz -vel .9 0 0 ship.ug | ugphoton", seen);
    check("uglorentz -vel .9 0 0 ship.ug | uglorentz", seen);
    let film = "ugfilm -frames 2 -ti 0..1 -fo f_%d.png";
    check(&format!("uglorentz -vel .9 0 0 ship.ug | {film}"), "each compute themselves");
    check("uglorentz -vel .9 0 0 ship.ug | ugdoppler | ugphoton", seen);
    check("ugdoppler -qt ship.ug | ugphoton", "ugphoton and ugfilm do the work of all three");
    check(
        "ugdoppler -vel .9 0 0 ship.ug | cat",
        "ugdoppler: note: positions in this scene are taken as seen already; for a scene at rest give -vel to \
         uglorentz",
    );
    check(
        "ugphoton -qt -sz 9 9 ship.ug | ugrainbow",
        "help: the program before this one in the pipe has drawn the picture: leave this one out",
    );

    // Values of options.
    let three = "`-vel` takes three values, not one: write `-vel X Y Z`";
    check("ugfilm -vel 0..0.9 -fo a_%04d.png ship.ug", three);
    for program in ["uglorentz", "ugphoton", "ugwarp", "ugfilm"] {
        let expected =
            format!("{program}: error: `-cv` takes three values, not one: write `-cv X Y Z`");
        check(&format!("{program} -cv .9 -fo x.png ship.ug"), &expected);
    }
    check("uglorentz -ti -fo x.ug ship.ug", "`-ti` needs a value: `-ti T`");
    check("ugfilm -ti -fo x.png ship.ug", "`-ti` needs a value: `-ti T`");
    let percent = "`90%` is not valid for `-vel`: percentages are fractions of 1: write `0.9`";
    let comma = "`0,9` is not valid for `-vel`: the decimal point is a point: write `0.9`";
    check("uglorentz -vel 90% 0 0 ship.ug", percent);
    let speed = "is not valid for `-vel`: speeds are fractions of the speed of light, without a unit: write";
    check("uglorentz -vel .9c 0 0 ship.ug", &format!("`.9c` {speed} `0.9`"));
    check("uglorentz -vel 270000km/s 0 0 ship.ug", &format!("`270000km/s` {speed} `0.9006230"));
    check("uglorentz -vel 0,9 0 0 ship.ug", comma);
    let separated = "`0.9,` is not valid for `-vel`: numbers are separated by blanks";
    check("uglorentz -vel 0.9, 0, 0 ship.ug", separated);
    check("uglorentz -ti 0..5 ship.ug", "only ugfilm draws numbers that change over time");
    check("uglorentz -ti 0 .. 5 ship.ug", "only ugfilm draws numbers that change over time");
    check(
        "ugfilm -ti 0...1 -fo a_%d.png ship.ug",
        "`-ti`: `0...1` has three dots: write `0..1` or `0..0.1`",
    );
    check(
        "ugrainbow -bg mauve ship.ug",
        "write lightness, hue in degrees and saturation, a name such as white, or #rrggbb",
    );
    check("ugrainbow -ed -lc '#ff' ship.ug", "a name such as white, or #rrggbb");

    // Options.
    let velocity = "there is no option `-v`; the velocity along x, y and z is `-vel`";
    check("uglorentz -v .9 0 0 ship.ug", velocity);
    check("ugphoton -v .9 0 0 ship.ug", velocity);
    let blank = "there is no option `-vel.9`; write a blank before the number: `-vel .9`";
    check("uglorentz -vel.9 0 0 ship.ug", blank);
    check("ugwarp -stereo photo.jpg", "`-stereo` is an option of ugphoton, not of ugwarp");
    check("ugwarp --stereo photo.jpg", "`--stereo` is an option of ugphoton, not of ugwarp");
    check(
        "ugwarp -keep-in-view photo.jpg",
        "`-keep-in-view` is an option of uglorentz, not of ugwarp",
    );
    let shift = "is an option of ugdoppler, not of ugrainbow; here it needs `-xc`";
    check("ugrainbow --no-doppler ship.ug", &format!("`--no-doppler` {shift}"));
    check("ugrainbow -no-flux ship.ug", &format!("`-no-flux` {shift}"));
    // The option in need is named, not another that only other programs have.
    check("ugrainbow -sp -cap A ship.ug", &format!("`-sp` {shift}"));
    check("ugrainbow -look light -sp ship.ug", &format!("`-sp` {shift}"));
    check("ugrainbow -txt -cap A ship.ug", "`-txt` needs `-vec`");
    let scene = "`-ti` is an option of uglorentz, not of ugwarp; here it needs `--scene FILE`";
    check("ugwarp -look light -ti 3 stars.csv", scene);
    // Without effect.
    check("ugrainbow -vec -br photon ship.ug", "`-vec` and `-br` cannot be given together");
    check("ugrainbow -vec --no-flux ship.ug", "`-vec` and `--no-flux` cannot be given together");
    check("ugrainbow -vec -aa 2 ship.ug", "`-vec` and `-aa` cannot be given together");
    check("ugrainbow -xc -txt ship.ug", "`-xc` and `-txt` cannot be given together");
    check("ugphoton -pan -va 30 ship.ug", "`-pan` and `-va` cannot be given together");
    check("ugwarp -fish 180 -va 30 photo.jpg", "`-fish` and `-va` cannot be given together");
    check("ugmesh -dt obj -name part ship.ug", "not a mesh, so -name has no effect; leave it out");
    check("ugwarp --white 1 photo.jpg", "there are no stars: leave out --star-width and --white");
    let both = "cannot be given together";
    check("uglorentz -sd 2 -se 1 ship.ug", both);
    check("uglorentz -sd 2 -sc 1 ship.ug", both);
    check("uglorentz -sd 2 -sl 1 ship.ug", both);
    check("uglorentz -vel .5 0 0 -in ship.ug | ugdoppler -vel .3 0 0", "so -vel has no effect");
    check("ugdoppler -sp -gw ship.ug", "give one of them");
    check("ugdoppler -sp -hd ship.ug", "leave out -hd");
    check("ugdoppler -br none --no-flux ship.ug", both);
    check("ugrainbow -xc -sp -iw ship.ug", both);
    check("ugrainbow -pz -dt ppm ship.ug", "leave out -pz");
    check("ugrainbow -pz -vec -dt pdf ship.ug", "leave out -pz");
    check("ugrainbow -ch D ship.ug", "write -dt exr");
    check("ugrainbow -ex 1 -dt exr ship.ug", "leave out -ex and -tc");
    check("ugrainbow -tc filmic -dt hdr ship.ug", "leave out -ex and -tc");
    check("ugrainbow -lg -dt pfm ship.ug", "leave out -title, -cap, -lg, -dl, -gr, -map and -iso");
    check("ugrainbow -tb -dt pfm ship.ug", "leave out -tb");
    check("ugrainbow -vec -dt pdf -fl triangle ship.ug", "leave out -fl");
    check("ugrainbow -lc 1 ship.ug", "add -wf or -ed, or leave it out");
    check("ugphoton -sp -iw ship.ug", both);
    check("ugphoton -ad .1 -aa 1 ship.ug", "leave out -ad");
    check("ugphoton --film-shutter 1 -pan ship.ug", "leave out --film-shutter, or -pan");
    check("ugphoton -pan -gr ship.ug", "leave out -dl and -gr");
    check("ugphoton -crop 0 0 2 2 -lg ship.ug", "or -crop");
    check("ugphoton --stereo .1 -cube ship.ug", both);
    check("ugwarp -ep 0 1 0 photo.jpg", "leave out -ep");
    check("ugwarp -bg .5 photo.jpg", "leave out -bg and -tb");
    check("ugwarp -tb -pan photo.jpg", "leave out -bg and -tb");
    check("ugwarp -gr photo.jpg", "leave out -dl and -gr");
    check("ugwarp --no-doppler --infrared photo.jpg photo.jpg", both);
    check("ugwarp -aa 4 stars.csv", "leave out -aa and -fl");
    check("ugwarp -fl spline stars.csv", "leave out -aa and -fl");
    check("ugmesh -dt obj --ascii ship.ug", "applies only to PLY");
    check("ugsheet --history -cols 2 a.png", both);

    // Files.
    check(
        "ugrainbow photo.jpg",
        "help: `ugwarp photo.jpg` shows it as the sky around an observer in motion",
    );
    let film = "`photo.jpg` is not a scene but a picture; with -warp, ugfilm shows it as the sky around an observer \
                in motion, as `ugwarp photo.jpg` does in one picture";
    check("ugfilm -ti 0..1 -fo a_%d.png photo.jpg", film);
    let film = "a table; with -warp, ugfilm shows a list of stars, as `ugwarp stars.csv` does in one picture";
    check("ugfilm -ti 0..1 -fo a_%d.png stars.csv", film);
    check("ugrainbow ship.fbx", "not a UniGrafix scene but a model in a format that is not read");
    check("ugphoton ship.dae", "help: export it as glTF, OBJ or PLY, which are read");
    check(
        "ugmesh ship.fbx",
        "`ship.fbx` is not a mesh but a model in a format that is not read; export it",
    );
    check("ugrainbow stars.csv", "help: `ugwarp stars.csv` draws a list of stars");
    check("ugwarp ship.ug", "scenes are drawn by ugrainbow, and by ugphoton");
    check("ugwarp photo.jpg stars.csv", "a list of stars is added with --stars FILE");
    check("ugwarp stars.csv photo.jpg", "name the panorama first, and add stars with --stars FILE");
    check(
        "ugrainbow comment.ug",
        "help: comments are in braces, `{ like this }`; a line mark is `# LINE \"FILE\"`",
    );
    check("ugrainbow slashes.ug", "help: comments are in braces: `{ like this }`");
    check("ugrainbow capital.ug", "help: keywords are lower case: `f`");
    check("ugrainbow broken.obj", "--> broken.obj:3:1");
    check(
        "ugmesh -fo x.stl ship.ug",
        "`x.stl` is none of the formats ug, obj, ply, gltf, glb and vtp",
    );
    check("ugparse example dragon", "dragon");
    for program in ["ugrainbow -fo", "ugphoton -fo", "ugfilm -ti 0..1 -ex auto -fo"] {
        check(&format!("{program} none/x_%d.png no-such.ug"), "there is no folder `none`");
    }
}

/// What is black, or outside the picture, is not drawn without a word.
#[test]
fn nothing_is_black_in_silence() {
    let shell = prepared();
    let check = |command: &str, expected: &str| check(&shell, command, expected);
    check(
        "uglorentz -vel .9 0 0 -in ship.ug | ugdoppler | ugrainbow -sz 40 30 -fo x.png",
        "its wavelengths are outside 380-780 nm; give ugdoppler and ugrainbow -look light, or -look shape",
    );
    // One program of the pipe has no look.
    check(
        "uglorentz -qt -cv 0 -.9 0 -in ship.ug | ugdoppler -look light | ugrainbow -sz 40 30 -fo x.png",
        "hardly anything is bright enough to be seen: try -ex auto, or -look light, which every program of a pipe \
         needs",
    );
    check(
        "uglorentz -qt -cv 0 -.9 0 -in ship.ug | ugdoppler | ugrainbow -look light -sz 40 30 -fo x.png",
        "its wavelengths are outside 380-780 nm; give ugdoppler and ugrainbow -look light, or -look shape",
    );
    let flash = "c_rgb on 1 1 1; c_rgb off 0 0 0; c_time fl -step -.001 off 0 on .2 off;
        v a -9 10 -9; v b 9 10 -9; v c 9 10 9; v d -9 10 9; f (a b c d); l 1 0 4 0 0 fl <0 0 0>;
        cam -ep 0 0 0 -vc 0 1 0 -va 60;";
    shell.write("flash.ug", flash);
    check(
        "uglorentz -ti 5 flash.ug | ugdoppler -li -sp | ugrainbow -sz 40 30 -fo x.png",
        "black: its colours are, or the light of its lamps does not reach it at this time",
    );
    check(
        "uglorentz -look light -vel .1 0 0 -fo x.ug ship.ug",
        "-look light has no effect on positions: give it to ugdoppler and ugrainbow",
    );
    check(
        "ugphoton -ex -9 -sz 40 30 -fo x.png ship.ug",
        "hardly anything is bright enough to be seen: give -ex more stops, or try -look shape",
    );
    let dark = ugimage::Frame::new([32, 16], true, vec![[3, 3, 3, 255]; 32 * 16]);
    let dark = ugimage::Format::Png.encode(&dark, &ugimage::Metadata::default());
    shell.write("dark.png", dark);
    // The first is packed while it is drawn.
    for options in ["-sz 40 20", "-sz 400 200 -cap dark", "-sz 40 20 -dt png16"] {
        check(
            &format!("ugwarp -look 1988 {options} -fo x.png dark.png"),
            "ugwarp: note: hardly anything is bright enough to be seen: try -ex auto, or -look light",
        );
    }
    check(
        "ugphoton -ex 9 -sz 40 30 -fo x.png ship.ug",
        "more than a tenth of what is in the picture is white: give -ex fewer stops",
    );
    // The exposure of a film is kept beside its frames; the number shows that it is read.
    check(
        "ugfilm -qt -only 1 -frames 2 -cv 0 .1..0.5 0 -sz 40 30 -fo k_%d.png ship.ug; sed -i 's/ 1 .*/ 1 9.125/' .k_1.png.exposure; \
         ugfilm -frames 2 -cv 0 .1..0.5 0 -sz 40 30 -fo k_%d.png ship.ug",
        "ugfilm: note: one exposure for all frames: -ex 9.125",
    );
    let when = "nothing that moves is in the picture at -ti 0; it is with -ti from 4 to 24.5, best at 12.5";
    check("uglorentz -vel .9 0 0 -fo x.ug ship.ug", when);
    check("ugphoton -vel .9 0 0 -sz 40 30 -fo x.png ship.ug", when);
    let film = "ugfilm -frames 2 -vel .9 0 0 -ti 0..1 -sz 40 30 -fo x_%d.png ship.ug";
    check(
        film,
        "nothing will be in the picture in 2 of 2 frames, 1..2: what moves is in it with -ti from 4 to",
    );
    let enclosed =
        "the light of lamp `bulb` does not leave the closed body that it is in: move it out";
    check("ugphoton -sz 40 30 -fo x.png boxed.ug", enclosed);
}

/// A photograph: a blue sky with the sun on the horizon, above a meadow.
fn photograph() -> Vec<u8> {
    let pixel = |idx: usize| match [idx % 64, idx / 64] {
        [29..35, 12..16] => [255; 4],
        [_, 0..16] => [40, 90, 200, 255],
        _ => [90, 110, 60, 255],
    };
    let frame = ugimage::Frame::new([64, 32], true, (0..64 * 32).map(pixel).collect());
    ugimage::Format::Png.encode(&frame, &ugimage::Metadata::default())
}

/// The sun of a photograph is no brighter than white, unless `--highlights` says so, and three
/// black bodies may add up to negative light.
#[test]
fn what_a_photograph_does_not_hold_is_chosen_or_noted() {
    let shell = Shell::new(&[]);
    shell.write("sky.png", photograph());
    let shown = |options: &str| {
        let command = format!("ugwarp -cv 0 .5 0 -va 90 -sz 96 72 -fo x.png {options} sky.png");
        (answer(&shell, &command), shell.pixels("x.png"))
    };
    // In the middle of the column: sky, sun, meadow.
    let at = |pixels: &[[u8; 4]], row: usize| pixels[96 * row + 48];
    // A quarter of the light shows the colour of the sun: blue, as of a white wall ahead.
    let (_, pixels) = shown("-ex -2");
    let [red, green, blue, _] = at(&pixels, 29);
    assert!(red + 10 < green && green + 20 < blue, "{:?}", at(&pixels, 29));
    let (_, pixels) = shown("-ex -2 --highlights 6");
    assert_eq!(at(&pixels, 29), [255; 4]);
    // With the exposure of the look the sun is white, and the meadow is lit.
    let (messages, pixels) = shown("");
    assert_eq!(at(&pixels, 29), [255; 4]);
    assert!(!messages.contains("negative"), "{messages}");
    assert!(at(&pixels, 48)[..3].iter().all(|&level| level > 60), "{:?}", at(&pixels, 48));
    let (messages, pixels) = shown("--basis 3500 5900 10000");
    // The meadow is the lower half.
    let note = "ugwarp: note: the three temperatures of the basis add up to negative light, drawn as black, in ";
    let percent = messages.split_once(note).unwrap().1.split_once(' ').unwrap().0;
    assert!((percent.parse::<f64>().unwrap() - 50.0).abs() < 1.0, "{messages}");
    assert!(
        messages.contains(" percent of what is in the picture; --basis mixture has none"),
        "{messages}"
    );
    assert_eq!(at(&pixels, 48), [0, 0, 0, 255]);
    // At rest every colour is kept.
    let (messages, _) = shown("--basis 3500 5900 10000 --no-doppler --no-flux");
    assert!(!messages.contains("negative"), "{messages}");
}

/// A mesh of another program is a scene to every program that reads one.
#[test]
fn meshes_are_read_in_place_of_scenes() {
    let shell = Shell::new(&[]);
    let run = |command: &str| {
        let output = shell.output(command);
        let messages = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{command}: {messages}");
        (output.stdout, messages)
    };
    let write = |name: &str, bytes: &[u8]| shell.write(name, bytes);
    let pyramid = "v 0 0 0\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\nv .5 1 -.5\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nusemtl tiled\nf 3 4 5\nf 4 1 5\n";
    write("a.obj", format!("mtllib a.mtl\nusemtl red\n{pyramid}").as_bytes());
    write("a.mtl", b"newmtl red\nKd 1 0 0\nnewmtl tiled\nKd 1 1 1\nmap_Kd tiles.png\n");
    let tiles = ugimage::Frame::new([2, 1], true, vec![[0, 0, 0, 255], [0, 0, 255, 255]]);
    write("tiles.png", &ugimage::Format::Png.encode(&tiles, &ugimage::Metadata::default()));
    for format in ["ply", "glb", "gltf"] {
        run(&format!("ugmesh a.obj -fo a.{format}"));
    }
    let statements = |text: Vec<u8>| {
        let text = String::from_utf8(text).unwrap();
        text.lines().filter(|line| !line.starts_with('{')).map(str::to_owned).collect::<Vec<_>>()
    };
    for name in ["a.obj", "a.ply", "a.glb", "a.gltf"] {
        let (converted, _) = run(&format!("ugmesh {name}"));
        assert_eq!(
            statements(run(&format!("ugparse flatten {name}")).0),
            statements(converted),
            "{name}"
        );
        let motion = "-qt -vel .5 0 0 --keep-in-view";
        let (direct, _) = run(&format!("uglorentz {motion} {name}"));
        let (piped, _) = run(&format!("ugmesh -qt {name} | uglorentz {motion}"));
        assert_eq!(statements(direct), statements(piped), "{name}");
        for command in ["ugrainbow -sz 20 15", "ugphoton -sz 20 15"] {
            let (png, _) = run(&format!("{command} -qt {name}"));
            let (expected, _) = run(&format!("ugmesh -qt {name} | {command} -qt"));
            let limits = ugimage::PictureLimits::default();
            let pixels = |file: &[u8]| ugimage::read_png(file, &limits).unwrap().0;
            assert!(pixels(&png) == pixels(&expected), "{command} {name}");
        }
        run(&format!("ugfilm -qt -frames 2 -vel 0...5 0 0 -sz 20 15 -fo f_%d.png {name}")
            .replace("0...5", "0..0.5"));
    }
    // Half black, half blue.
    let (scene, messages) = run("ugparse flatten a.obj");
    let scene = String::from_utf8(scene).unwrap();
    assert!(scene.contains("c_rgb red 1 0 0;\nc_rgb tiled 0 0 0.7353"), "{scene}");
    assert!(
        scene.contains("c_tex tiled \"tiles.png\";") && messages.is_empty(),
        "{scene} {messages}"
    );
    std::fs::remove_file(shell.path("tiles.png")).unwrap();
    let (scene, messages) = run("ugparse flatten a.obj");
    assert!(String::from_utf8(scene).unwrap().contains("c_rgb tiled 1 1 1;"));
    let missing = "warning: texture `tiles.png`: No such file or directory; its faces have the colour of their material";
    assert!(messages.contains(missing), "{messages}");
}

/// Rays and exact pictures draw the same textures: of inertial bodies and of those that turn, from
/// a mesh and from a scene with its picture beside it, through a pipe.
#[test]
fn textures_are_drawn_alike() {
    let shell = Shell::new(&["crate.gltf"]);
    shell.run("ugmesh crate.gltf -fo crate.ug");
    let scene = String::from_utf8(std::fs::read(shell.path("crate.ug")).unwrap()).unwrap();
    assert!(scene.contains("c_tex wood \"crate_texture1.png\" -wrap clamp;"), "{scene}");
    let spinning =
        scene.replace(") wood;", ") wood <turn>;") + "motion turn -acc .05 0 0 -spin 0 .2 .1;";
    shell.write("spinning.ug", spinning.as_bytes());
    let view = "-ep 4 -6 3 -vc 0 0 0 -va 30 -sz 60 45 -ex 1";
    let pixels = |name: &str| shell.pixels(name);
    // ugrainbow finds texels once for a row of samples in a pixel.
    let decibels = |name: &str| {
        let (rays, other) = (pixels("rays.png"), pixels(name));
        let square = |(a, b): (&[u8; 4], &[u8; 4])| {
            (0..3).map(|at| u32::from(a[at].abs_diff(b[at])).pow(2)).sum::<u32>()
        };
        let sum: u32 = rays.iter().zip(&other).map(square).sum();
        10.0 * libm::log10(255.0 * 255.0 * 3.0 * rays.len() as f64 / f64::from(sum))
    };
    for (name, motion) in [
        ("crate.gltf", ""),
        ("crate.gltf", "-vel .3 .6 0 -in"),
        ("crate.ug", "-vel .8 0 0 -in"),
        ("spinning.ug", ""),
    ] {
        for look in ["light", "1988", "shape"] {
            shell.run(&format!("ugphoton -qt -look {look} {motion} {view} {name} > rays.png"));
            shell.run(&format!(
                "uglorentz -qt {motion} -ep 4 -6 3 {name} | ugrainbow -qt -xc -look {look} {view} > exact.png"
            ));
            assert!(
                decibels("exact.png") > 45.0,
                "{name} {motion} {look}: {} dB",
                decibels("exact.png")
            );
            let rays = pixels("rays.png");
            let n_colours = rays.iter().collect::<std::collections::BTreeSet<_>>().len();
            assert!(n_colours > 50, "{name} {motion} {look}: {n_colours} colours");
        }
    }
    // Without -xc colours are as they are.
    shell.run(&format!("ugphoton -qt -look shape {view} crate.ug > rays.png"));
    shell.run(&format!("ugrainbow -qt {view} crate.ug > plain.png"));
    assert!(decibels("plain.png") > 45.0);
    let note =
        "textures are not drawn: faces of colour `wood` have its plain colour; -xc draws them";
    check(&shell, "ugrainbow -cb crate.ug", note);
    check(
        &shell,
        "ugrainbow --explain 30,20 -sz 60 45 crate.ug",
        "faces with textures are drawn by rays",
    );
    check(
        &shell,
        "uglorentz -vel .5 0 0 -se .1 crate.ug | ugdoppler -ir",
        "plain colour; leave out -vel, -gw, -ir",
    );
    // ugdoppler leaves textures to rays, which draw as without it.
    let moved = "uglorentz -vel .5 0 0 -in -ep 4 -6 3 crate.ug";
    for shift in ["", "-sp", "-sp --infrared-rule constant --no-flux", "-br photon"] {
        shell.run(&format!("{moved} | ugdoppler -qt {shift} | ugrainbow -qt {view} > pipe.png"));
        shell.run(&format!("{moved} | ugrainbow -qt -xc {shift} {view} > exact.png"));
        assert!(pixels("pipe.png") == pixels("exact.png"), "{shift}");
    }
    let refused = |pipe: &str, remedy: &str| {
        let output = shell.output(pipe);
        assert!(!output.status.success(), "{pipe}");
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(error.contains(remedy), "{pipe}: {error}");
    };
    refused(&format!("{moved} | ugdoppler -qt --no-textures"), "give uglorentz -se 0.1");
    for picture in ["ugrainbow -cb", "ugrainbow -vec -dt svg", "ugmesh -dt ply"] {
        refused(&format!("{moved} | ugdoppler -qt | {picture}"), "--no-textures");
        refused(&format!("{moved} | {picture}"), "give uglorentz -se 0.1");
        let cut = format!("{moved} -se .1 | ugdoppler -qt --no-textures | {picture}");
        let output = shell.output(&cut);
        assert!(output.status.success() && !output.stdout.is_empty(), "{cut}");
    }
    // Whole faces are drawn as those that were cut, whose colours between corners are interpolated
    // over pieces.
    let cut = format!("{moved} -se .1 | ugdoppler -qt | ugrainbow -qt {view} > cut.png");
    shell.run(&cut);
    shell.run(&format!("{moved} | ugdoppler -qt | ugrainbow -qt {view} > whole.png"));
    let (cut, whole) = (pixels("cut.png"), pixels("whole.png"));
    let is_other =
        |(a, b): &(&[u8; 4], &[u8; 4])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 8);
    let n_other = cut.iter().zip(&whole).filter(is_other).count();
    assert!(n_other <= cut.len() / 1000, "{n_other} of {}", cut.len());
    check(
        &shell,
        "uglorentz -vel .5 0 0 < crate.gltf",
        "textures within a mesh on standard input are left out",
    );
    // Films draw them by rays; what they print draws the same.
    let film = "ugfilm -qt -frames 2 -vel 0..0.6 0 0 -in -sz 60 45";
    shell.run(&format!("{film} -fo film_%d.png crate.gltf"));
    let [printed, _] = shell.run(&format!("{film} --print -fo shell_%d.png crate.gltf"));
    assert!(!printed.contains("--no-textures"), "{printed}");
    printed.lines().for_each(|line| drop(shell.run(line)));
    assert!(pixels("film_2.png") == pixels("shell_2.png"));
    let [plain, _] = shell.run(&format!("{film} -cb --print -fo shell_%d.png crate.gltf"));
    assert!(plain.contains("--no-textures") && plain.contains("-se 0.1"), "{plain}");
    let [exact, _] = shell.run(&format!("{film} -xc --print -fo shell_%d.png crate.gltf"));
    assert!(exact.contains("uglorentz -sd 1") || exact.contains("-sd 1 "), "{exact}");
    // A scene in a folder, of which programs see only that.
    std::fs::create_dir(shell.path("sub")).unwrap();
    shell.write("sub/a.ug", b"c w 1; c_tex w \"../crate_texture1.png\";");
    check(&shell, "ugparse check sub/a.ug", "cannot read `sub/../crate_texture1.png`");
    check(&shell, "ugparse check sub/a.ug", "--allow-outside");
}

/// Values over time may have blanks around their dots.
#[test]
fn blanks_in_values_over_time() {
    let shell = prepared();
    let printed = |options: &str| {
        let [commands, _] = shell
            .run(&format!("ugfilm -qt -frames 3 {options} -sz 40 30 --print -fo f_%d.png ship.ug"));
        commands
    };
    for (with_blanks, without) in [
        ("-ti 0 .. 5", "-ti 0..5"),
        ("-ti -5 .. .5", "-ti -5..0.5"),
        ("-vel 0 .. .9 0 0", "-vel 0..0.9 0 0"),
        ("-vel 0 .. .9 .. 0 0 0", "-vel 0..0.9..0 0 0"),
        ("-cv 0 0 0 .. 0 .9 0", "-cv '0 0 0 .. 0 .9 0'"),
        ("-va 40 .. 60", "-va 40..60"),
    ] {
        assert_eq!(printed(with_blanks), printed(without), "{with_blanks}");
    }
}
