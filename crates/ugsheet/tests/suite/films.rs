//! Films side by side.

use std::fs;
use std::path::Path;

use tempfile::TempDir;
use ugimage::{Format, Frame, Metadata, PictureLimits, read_png};
use ugtesting::Random;

use super::UGSHEET;

/// A frame of noise with at most 64 colours, which a GIF keeps.
fn noise(size: [u32; 2], seed: u64) -> Frame {
    let mut random = Random(seed);
    let mut frame = Frame::opaque(size[0], size[1]);
    for pixel in frame.pixels_mut() {
        let [r, g, b, ..] = random.bits().to_be_bytes();
        *pixel = [r & 0xc0, g & 0xc0, b & 0xc0, 255];
    }
    frame
}

/// Writes the frames `NAME_1.png` and so on.
fn write_frames(folder: &Path, name: &str, n_frames: u32, size: [u32; 2], per_inch: Option<f64>) {
    for number in 1..=n_frames {
        let comment = format!("uglorentz -ti {number}");
        let metadata = Metadata { comment, per_inch, ..Metadata::default() };
        let file =
            Format::Png.encode(&noise(size, u64::from(number) + name.len() as u64), &metadata);
        fs::write(folder.join(format!("{name}_{number}.png")), file).unwrap();
    }
}

/// Two films of 5 and 3 frames, `a_%d.png` and `bb_%d.png`.
fn two_films() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    write_frames(folder.path(), "a", 5, [24, 16], None);
    write_frames(folder.path(), "bb", 3, [16, 20], None);
    folder
}

fn read(folder: &TempDir, name: &str) -> (Frame, Metadata) {
    let file = fs::read(folder.path().join(name)).unwrap();
    read_png(&file, &PictureLimits::default()).unwrap()
}

/// Frame k of joined films is the sheet of their frames k. The shorter film holds its last frame.
#[test]
fn a_frame_is_the_sheet_of_the_frames() {
    let folder = two_films();
    let ugsheet = UGSHEET.in_folder(&folder);
    for options in ["-label p -label q -lt -cap {} -gap 3 5", "-lb none -sz 121 -bg .2"] {
        let notes = ugsheet.notes(&format!("{options} -fo j_%d.png a_%d.png bb_%d.png"), "");
        assert!(
            notes.contains("`bb_%d.png` has 3 of 5 frames: its last frame is held to the end"),
            "{notes}"
        );
        for number in 1..=5 {
            let (joined, history) = read(&folder, &format!("j_{number}.png"));
            let of_b = number.min(3);
            ugsheet.output(&format!("{options} -fo s.png a_{number}.png bb_{of_b}.png"), "");
            let sheet = read(&folder, "s.png").0;
            // A row or column of background makes the sides even.
            assert_eq!([joined.width() % 2, joined.height() % 2], [0, 0]);
            for y in 0..sheet.height() {
                assert!(
                    (0..sheet.width()).all(|x| joined.pixel(x, y) == sheet.pixel(x, y)),
                    "{options} {number}"
                );
            }
            assert!(joined.width() - sheet.width() < 2 && joined.height() - sheet.height() < 2);
            let lines: Vec<&str> = history.comment.lines().collect();
            assert_eq!(
                lines[..2],
                [format!("uglorentz -ti {number}"), format!("uglorentz -ti {of_b}")]
            );
            assert!(lines[2].starts_with("ugsheet "));
        }
    }
}

/// What one program writes another reads: frames, animated PNG and GIF hold the same pixels, at the
/// same rate.
#[test]
fn films_are_read_as_they_are_written() {
    let folder = two_films();
    let ugsheet = UGSHEET.in_folder(&folder);
    let join = |args: &str| ugsheet.notes(&format!("-lb none -gap 0 {args}"), "");
    join("-fo j_%d.png a_%d.png bb_%d.png");
    for film in ["j.apng", "j.gif", "j20.gif", "j20.apng"] {
        let rate = if film.contains("20") { "-fps 20" } else { "" };
        join(&format!("{rate} -fo {film} a_%d.png bb_%d.png"));
        assert_eq!(join(&format!("-fo back_%d.png {film}")), "");
        for number in 1..=5 {
            let frames = ["j", "back"].map(|name| read(&folder, &format!("{name}_{number}.png")).0);
            assert_eq!(frames[0], frames[1], "{film} {number}");
        }
        // The rate is kept.
        let stream = ugsheet.output(&format!("-lb none -gap 0 -dt y4m {film}"), "");
        let header = format!("YUV4MPEG2 W40 H20 F{}:1 ", if rate.is_empty() { 25 } else { 20 });
        assert!(stream.starts_with(header.as_bytes()), "{film}");
        let head = stream.iter().position(|&byte| byte == b'\n').unwrap() + 1;
        assert_eq!(stream.len() - head, 5 * ("FRAME\n".len() + 3 * 40 * 20));
        let file = fs::read(folder.path().join(film)).unwrap();
        assert_eq!(ugsheet.output("-lb none -gap 0 -dt y4m", &file), stream, "from standard input");
    }
    // A folder is a film as well.
    fs::create_dir(folder.path().join("frames")).unwrap();
    write_frames(&folder.path().join("frames"), "a", 5, [24, 16], None);
    join("-fo a.apng a_%d.png");
    join("-fo frames.apng frames");
    let [named, found] =
        ["a.apng", "frames.apng"].map(|name| fs::read(folder.path().join(name)).unwrap());
    assert_eq!(named, found);
}

/// A picture beside a film is shown in all frames.
#[test]
fn a_picture_is_held() {
    let folder = two_films();
    let ugsheet = UGSHEET.in_folder(&folder);
    let notes = ugsheet.notes("-lb none -gap 0 -fo j_%d.png a_1.png bb_%d.png", "");
    assert!(
        notes.contains("`a_1.png` has 1 of 3 frames: its only frame is held to the end"),
        "{notes}"
    );
    let still = noise([24, 16], 2);
    for number in 1..=3 {
        let (joined, _) = read(&folder, &format!("j_{number}.png"));
        assert!(
            (0..16).all(|y| (0..24).all(|x| joined.pixel(x, y + 2) == still.pixel(x, y))),
            "{number}"
        );
    }
}

#[test]
fn what_is_no_film_is_refused() {
    let folder = two_films();
    let at = |name: &str| folder.path().join(name);
    let ugsheet = UGSHEET.in_folder(&folder);
    for (film, rate) in [("a.gif", 25), ("slow.gif", 10), ("a.apng", 25)] {
        ugsheet.output(&format!("-lb none -fps {rate} -fo {film} a_%d.png"), "");
    }
    for film in ["a.gif", "a.apng"] {
        let whole = fs::read(at(film)).unwrap();
        for cut in [12, 100, whole.len() / 2, whole.len() - 40] {
            fs::write(at("cut"), &whole[..cut]).unwrap();
            ugsheet.refuses("-dt gif cut", "", 1, "`cut`: ");
        }
        fs::write(
            at("broken"),
            [&whole[..whole.len() / 2], &[0; 40], &whole[whole.len() / 2 + 40..]].concat(),
        )
        .unwrap();
        // Some damage to pixels cannot be seen.
        let ended = ugsheet.run("-dt gif broken", "");
        assert!(matches!(ended.status.code(), Some(0 | 1)));
    }
    // A screen of 4 G pixels.
    let mut huge = fs::read(at("a.gif")).unwrap();
    huge[6..10].fill(255);
    fs::write(at("huge.gif"), huge).unwrap();
    ugsheet.refuses(
        "-dt gif huge.gif",
        "",
        1,
        "exceed the limit of memory; allow it with --limit memory=",
    );
    for folder in ["empty", "mixed", "several", "others"] {
        fs::create_dir(at(folder)).unwrap();
    }
    write_frames(&at("mixed"), "a", 1, [8, 8], None);
    write_frames(&at("mixed"), "a", 0, [8, 8], None);
    fs::copy(at("bb_1.png"), at("mixed/a_2.png")).unwrap();
    fs::copy(at("a_1.png"), at("several/a_1.png")).unwrap();
    fs::copy(at("a_1.png"), at("several/b_1.png")).unwrap();
    fs::write(at("others/a_1.png"), "no picture").unwrap();
    fs::remove_file(at("bb_2.png")).unwrap();
    for (args, status, message) in [
        ("-dt gif empty", 1, "There are no frames, such as frame_0001.png"),
        ("-dt gif none_%d.png", 1, "There are no frames, such as none_1.png"),
        ("-dt gif bb_%d.png", 1, "Frame bb_2.png is missing: draw it first"),
        ("-dt gif mixed", 1, "16 x 20 pixels, the frames before 8 x 8: draw all with one -sz"),
        (
            "-dt gif several",
            1,
            "several/b_1.png is not a frame of the film of several/a_1.png: name its frames, as several/frame_%04d.png",
        ),
        ("-dt gif others", 1, "`others/a_1.png`: not a PNG file"),
        ("a.gif", 2, "these are films: give -fo FILE with gif"),
        ("-fo a.png a.gif", 2, "these are films"),
        ("-fo x_%d.gif a.gif", 2, "is a whole film, not a frame"),
        ("-fo x.gif a_1.png", 2, "the pictures are no films"),
        ("-dt gif a.gif slow.gif", 2, "`a.gif` has 25 frames a second and `slow.gif` 10"),
        ("-dt gif -fps 0 a.gif", 2, "from 0.01 to 1000"),
        ("-dt gif -sz 20 a.gif a.apng", 2, "the sheet has no room for the pictures"),
    ] {
        ugsheet.refuses(args, "", status, message);
    }
    assert!(ugsheet.output("-dt gif -fps 25 a.gif slow.gif", "").starts_with(b"GIF89a"));
}
