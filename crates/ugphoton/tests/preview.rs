//! Previews (`-pv`): complete pictures, finer and finer, and at last the picture without them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use std::io::Cursor;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use ugphoton::{Background, Config, PictureOptions, PreparedScene};

const SCENE: &str = "\
{ A ball of glass over a mirror, and a square that moves. }
surf glass 0 .1 .9 1.5; surf mirror .2 .8 0; c white 1; c green 1 120; c red 1 0; l .4; l 1 3 -4 5;
v a -3 -3 0; v b 3 -3 0; v c 3 3 0; v d -3 3 0; f (a b c d) white mirror;
v e -1 0 1; v f 1 0 1; v g 1 0 2; v h -1 0 2; f (e f g h) green <.5 0 0>;
v k 0 -1 .5; v l .5 -1 1; v m -.5 -1 1.2; f (k l m) red glass;
cam -ep 0 -6 2 -vc 0 0 .7 -ud 0 0 1;
";

fn drawing(config: &Config) -> PreparedScene {
    PreparedScene::read(config, &ugparse::Source::new("scene.ug", SCENE), ugphoton::PROVENANCE, &())
        .unwrap()
        .0
}

fn config(size: [u32; 2], crop: Option<[u32; 4]>) -> Config {
    let picture = PictureOptions { size, samples: 1, ..PictureOptions::default() };
    Config { picture, crop, ..Config::default() }
}

/// Size and red, green, blue of the pixels of a complete PNG file.
fn pixels(png: &[u8]) -> ([u32; 2], Vec<[u8; 3]>) {
    let mut reader = png::Decoder::new(Cursor::new(png)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    reader.finish().unwrap();
    assert_eq!(info.buffer_size() as u64, u64::from(info.width) * u64::from(info.height) * 3);
    ([info.width, info.height], bytes.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect())
}

/// Each square has the colour of a pixel near its middle, also where the last ones are cut off.
#[test]
fn a_preview_is_the_picture_at_fewer_pixels() {
    for (size, crop) in [([61, 35], None), ([64, 48], Some([5, 3, 43, 29]))] {
        let config = config(size, crop);
        let (size, whole) = pixels(&drawing(&config).picture(&()).unwrap().into_file());
        assert!(whole.iter().any(|&rgb| rgb != whole[0]));
        let [width, height] = size;
        for side in PreparedScene::PREVIEWS {
            let (preview_size, preview) = pixels(&drawing(&config).preview(side, &()).unwrap().into_file());
            assert_eq!(preview_size, size);
            for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column))) {
                let middle = |at: u32, end: u32| (at / side * side + side / 2).min(end - 1);
                let expected = whole[(middle(row, height) * width + middle(column, width)) as usize];
                assert_eq!(preview[(row * width + column) as usize], expected, "{side}: {column} {row}");
            }
        }
        assert!(
            drawing(&config).preview(1, &()).unwrap().into_file()
                == drawing(&config).picture(&()).unwrap().into_file()
        );
    }
}

/// Previews with several samples a pixel, and on another background.
#[test]
fn samples_of_previews_count_as_whole_pixels() {
    let mut config = config([48, 32], None);
    let [coarse, fine] = [1, 4].map(|samples| {
        config.picture.samples = samples;
        config.picture.background =
            Background::Color(ugphysics::Hsv { hue: 200.0, saturation: 0.5, value: 0.8 });
        pixels(&drawing(&config).preview(8, &()).unwrap().into_file()).1
    });
    // The sample in the middle is in another place; most squares show the same.
    let n_alike = coarse.iter().zip(&fine).filter(|(a, b)| a.iter().zip(*b).all(|(a, b)| a.abs_diff(*b) < 8));
    assert!(n_alike.count() * 2 > coarse.len());
}

fn ugphoton(folder: &Path, args: &[&str]) -> Child {
    std::fs::write(folder.join("scene.ug"), SCENE).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ugphoton"));
    command.args(args).arg("scene.ug").current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

fn run(folder: &Path, args: &[&str]) -> Output {
    ugphoton(folder, args).wait_with_output().unwrap()
}

#[test]
fn the_last_bytes_are_those_without_previews() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let rows: [&[&str]; 4] = [
        &["-lg", "-sz", "400", "300"],
        &["-dt", "exr", "-ch", "D"],
        &["-stereo", ".1"],
        &["-ex", "auto", "-tb"],
    ];
    for options in rows {
        let with = |more: &[&'static str]| {
            let all = [&["-sz", "90", "70", "-aa", "2"], more].concat();
            // A size that is given in a row counts.
            if options.contains(&"-sz") { more.to_vec() } else { all }
        };
        for args in [with(&["-pv", "-fo", "preview"]), with(&["-fo", "plain"])] {
            // Without an ending the file is PNG, unless -dt is given.
            let output = run(folder.path(), &[options, &args].concat());
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        }
        assert!(file("preview") == file("plain"), "{options:?}");
    }
}

/// The file is complete from its first moment on, and nothing else is left.
#[test]
fn an_interrupted_preview_is_complete() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("picture.png");
    let size = ["-pv", "-fo", "picture.png", "-sz", "1200", "1200", "-aa", "16", "-nt", "1"];
    let mut child = ugphoton(folder.path(), &size);
    while !picture.exists() {
        assert!(child.try_wait().unwrap().is_none());
        std::thread::sleep(Duration::from_millis(2));
    }
    Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
    assert!(!child.wait_with_output().unwrap().status.success());
    assert_eq!(pixels(&std::fs::read(&picture).unwrap()).0, [1200, 1200]);
    let mut names: Vec<_> =
        folder.path().read_dir().unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["picture.png", "scene.ug"]);
}

#[test]
fn what_cannot_be_replaced_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let rows: [(&[&str], &str); 4] = [
        (&["-pv"], "name one with -fo FILE, or leave out -pv"),
        (&["-pv", "-fo", "/dev/null", "-dt", "png"], "name one with -fo FILE, or leave out -pv"),
        (&["-pv", "-fo", "a.png", "--explain", "1,1"], "--explain"),
        (&["-pv", "-fo", "no/such/folder.png"], "cannot write `no/such/folder.png`"),
    ];
    for (args, expected) in rows {
        let output = run(folder.path(), args);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && output.stdout.is_empty() && error.contains(expected), "{error}");
        assert_eq!(folder.path().read_dir().unwrap().count(), 1);
    }
}
