//! Previews (`-pv`): complete pictures, finer and finer, and at last the picture without them.

use std::io::Cursor;
use std::process::Command;
use std::time::Duration;

use tempfile::TempDir;
use ugphoton::{Background, Config, PictureOptions, PreparedScene};
use ugtesting::run::BuiltProgram;

use crate::cli::UGPHOTON;

const SCENE: &str = "\
{ A ball of glass over a mirror, and a square that moves. }
surf glass 0 .1 .9 1.5; surf mirror .2 .8 0; c white 1; c green 1 120; c red 1 0; l .4; l 1 3 -4 5;
v a -3 -3 0; v b 3 -3 0; v c 3 3 0; v d -3 3 0; f (a b c d) white mirror;
v e -1 0 1; v f 1 0 1; v g 1 0 2; v h -1 0 2; f (e f g h) green <.5 0 0>;
v k 0 -1 .5; v l .5 -1 1; v m -.5 -1 1.2; f (k l m) red glass;
cam -ep 0 -6 2 -vc 0 0 .7 -ud 0 0 1;
";

fn drawing(config: &Config) -> PreparedScene {
    PreparedScene::read(
        config,
        &ugparse::Source::new("scene.ug", SCENE),
        ugphoton::PROVENANCE,
        true,
        &(),
    )
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
            let (preview_size, preview) =
                pixels(&drawing(&config).preview(side, &()).unwrap().into_file());
            assert_eq!(preview_size, size);
            for (row, column) in
                (0..height).flat_map(|row| (0..width).map(move |column| (row, column)))
            {
                let middle = |at: u32, end: u32| (at / side * side + side / 2).min(end - 1);
                let expected =
                    whole[(middle(row, height) * width + middle(column, width)) as usize];
                assert_eq!(
                    preview[(row * width + column) as usize],
                    expected,
                    "{side}: {column} {row}"
                );
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
    let n_alike =
        coarse.iter().zip(&fine).filter(|(a, b)| a.iter().zip(*b).all(|(a, b)| a.abs_diff(*b) < 8));
    assert!(n_alike.count() * 2 > coarse.len());
}

/// A folder with the scene in `scene.ug`, and the program in it.
fn ugphoton() -> (TempDir, BuiltProgram) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.ug"), SCENE).unwrap();
    let ugphoton = UGPHOTON.in_folder(&folder);
    (folder, ugphoton)
}

#[test]
fn the_last_bytes_are_those_without_previews() {
    let (folder, ugphoton) = ugphoton();
    for options in [
        "-sz 90 70 -cap A",
        "-sz 90 70 -aa 2 -dt exr -ch D",
        "-sz 90 70 -aa 2 -stereo .1",
        "-sz 90 70 -aa 2 -ex auto -tb",
    ] {
        // Without an ending the file is PNG, unless -dt is given.
        let [preview, plain] = ["-pv -fo preview", "-fo plain"].map(|more| {
            ugphoton.output(&format!("{options} {more} scene.ug"), "");
            std::fs::read(folder.path().join(more.split(' ').next_back().unwrap())).unwrap()
        });
        assert!(preview == plain, "{options}");
    }
}

/// The file is complete from its first moment on, and nothing else is left.
#[test]
fn an_interrupted_preview_is_complete() {
    let (folder, ugphoton) = ugphoton();
    let picture = folder.path().join("picture.png");
    let args = "-pv -fo picture.png -sz 1200 1200 -aa 16 -nt 1 -qt scene.ug";
    let mut child = ugphoton.command(args).spawn().unwrap();
    while !picture.exists() {
        assert!(child.try_wait().unwrap().is_none());
        std::thread::sleep(Duration::from_millis(2));
    }
    Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
    assert!(!child.wait().unwrap().success());
    assert_eq!(pixels(&std::fs::read(&picture).unwrap()).0, [1200, 1200]);
    let mut names: Vec<_> =
        folder.path().read_dir().unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["picture.png", "scene.ug"]);
}

#[test]
fn what_cannot_be_replaced_is_refused() {
    let (folder, ugphoton) = ugphoton();
    for (args, status, expected) in [
        ("-pv", 2, "name one with -fo FILE, or leave out -pv"),
        ("-pv -fo /dev/null -dt png", 2, "name one with -fo FILE, or leave out -pv"),
        ("-pv -fo a.png --explain 1,1", 2, "--explain"),
        ("-pv -fo no/such/folder.png", 1, "cannot write `no/such/folder.png`"),
    ] {
        ugphoton.refuses(&format!("{args} scene.ug"), "", status, expected);
        assert_eq!(folder.path().read_dir().unwrap().count(), 1);
    }
}
