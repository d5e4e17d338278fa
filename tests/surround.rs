//! Films of all directions: what players of 360° films read, by ffprobe and by readers after the
//! published layouts (ISO/IEC 14496-12, RFC 9559, Spherical Video RFC versions 1 and 2).

use std::fs;

use ugtests::shell::Shell;
use ugtests::tools;

/// Boxes one after the other: kind and content.
fn boxes(mut bytes: &[u8]) -> Vec<([u8; 4], &[u8])> {
    let mut all = Vec::new();
    while !bytes.is_empty() {
        let length = u32::from_be_bytes(bytes[..4].try_into().unwrap()) as usize;
        all.push((bytes[4..8].try_into().unwrap(), &bytes[8..length]));
        bytes = &bytes[length..];
    }
    all
}

/// The content of the only box of each kind, one within the other. `skipped`: bytes of fields
/// before the boxes within.
fn box_at<'b>(bytes: &'b [u8], path: &[(&str, usize)]) -> Option<&'b [u8]> {
    let [(kind, skipped), rest @ ..] = path else { return Some(bytes) };
    let found: Vec<_> = boxes(bytes).into_iter().filter(|one| one.0 == kind.as_bytes()).collect();
    assert!(found.len() < 2, "{kind} stands twice");
    box_at(&found.first()?.1[*skipped..], rest)
}

/// Elements of WebM one after the other: identifier and content.
fn elements(mut bytes: &[u8]) -> Vec<(u64, &[u8])> {
    fn number(bytes: &mut &[u8], keeps_mark: bool) -> u64 {
        let n = bytes[0].leading_zeros() as usize + 1;
        let value = bytes[..n].iter().fold(0, |sum, byte| sum << 8 | u64::from(*byte));
        *bytes = &bytes[n..];
        if keeps_mark { value } else { value - (1 << (7 * n)) }
    }
    let mut all = Vec::new();
    while !bytes.is_empty() {
        let id = number(&mut bytes, true);
        let length = (number(&mut bytes, false) as usize).min(bytes.len());
        all.push((id, &bytes[..length]));
        bytes = &bytes[length..];
    }
    all
}

fn element<'b>(bytes: &'b [u8], path: &[u64]) -> Option<&'b [u8]> {
    let [id, rest @ ..] = path else { return Some(bytes) };
    let (_, content) = elements(bytes).into_iter().find(|one| one.0 == *id)?;
    element(content, rest)
}

const SEGMENT: u64 = 0x1853_8067;

/// The projection of a WebM film: kind and data.
fn projection(film: &[u8]) -> Option<(u8, &[u8])> {
    let video = [SEGMENT, 0x1654_AE6B, 0xAE, 0xE0, 0x7670];
    let found = element(film, &video)?;
    Some((element(found, &[0x7671])?[0], element(found, &[0x7672])?))
}

/// A mesh that was read: x, y, z, across and up of each vertex, and triangles.
struct Mesh {
    vertices: Vec<[f32; 5]>,
    triangles: Vec<[usize; 3]>,
}

/// Reads the content of a box `mshp`.
fn read_mesh(bytes: &[u8]) -> Mesh {
    assert_eq!(&bytes[..4], [0; 4]);
    let crc = u32::from_be_bytes(bytes[4..8].try_into().unwrap());
    // CRC-32 of ISO 3309, bit by bit.
    let mut sum = u32::MAX;
    for byte in &bytes[8..] {
        sum ^= u32::from(*byte);
        for _ in 0..8 {
            sum = if sum & 1 == 1 { sum >> 1 ^ 0xEDB8_8320 } else { sum >> 1 };
        }
    }
    assert_eq!(crc, !sum);
    assert_eq!(&bytes[8..12], b"raw ");
    let mesh = box_at(&bytes[12..], &[("mesh", 0)]).unwrap();
    let mut at = 0;
    let mut bits = |n: u32| {
        (0..n).fold(0_u32, |number, _| {
            let bit = mesh[at / 8] >> (7 - at % 8) & 1;
            at += 1;
            number << 1 | u32::from(bit)
        })
    };
    let width = |n: usize| libm::log2(2.0 * n as f64).ceil() as u32;
    let step = |number: u32| {
        let half = i64::from(number.div_ceil(2));
        if number % 2 == 1 { -half } else { half }
    };
    let n_numbers = bits(32) as usize;
    let numbers: Vec<f32> = (0..n_numbers).map(|_| f32::from_bits(bits(32))).collect();
    let n_vertices = bits(32) as usize;
    let mut last = [0_i64; 5];
    let mut vertices = Vec::new();
    for _ in 0..n_vertices {
        last.iter_mut().for_each(|last| *last += step(bits(width(n_numbers))));
        vertices.push(last.map(|index| numbers[index as usize]));
    }
    let used = (2 + n_numbers) * 32 + n_vertices * 5 * width(n_numbers) as usize;
    bits((8 - used as u32 % 8) % 8);
    // One list, of the film's own frames, of triangles.
    assert_eq!([bits(32), bits(8), bits(8)], [1, 0, 0]);
    let n_indices = bits(32) as usize;
    let mut last = 0;
    let indices: Vec<usize> = (0..n_indices)
        .map(|_| {
            last += step(bits(width(n_vertices)));
            last as usize
        })
        .collect();
    Mesh { vertices, triangles: indices.as_chunks::<3>().0.to_vec() }
}

/// The content of boxes within the description of the pictures of an MP4 film.
fn description<'b>(film: &'b [u8], path: &[(&str, usize)]) -> Option<&'b [u8]> {
    let track = [("moov", 0), ("trak", 0), ("mdia", 0), ("minf", 0), ("stbl", 0), ("stsd", 8)];
    box_at(film, &[&track[..], &[("avc1", 78)], path].concat())
}

const LENSES: [(&str, &str, u8); 6] = [
    ("-pan -sz 64 32", "equirectangular", 0),
    ("-pan -stereo .1 -sz 64 64", "equirectangular", 1),
    ("-fish 200 -sz 32 32", "mesh", 0),
    ("-fish 180 -stereo .1 -sz 64 32", "mesh", 2),
    ("-cube -sz 192 32", "mesh", 0),
    ("-stereo .1 -sz 64 32", "", 2),
];

/// All lenses in both formats; the film itself is the one that ffmpeg wrote, frame by frame.
#[test]
fn films_of_all_directions_say_so() {
    if !tools::has(&[tools::FFMPEG]) {
        return;
    }
    let shell = Shell::new(&["street.ug"]);
    for (options, kind, eyes) in LENSES {
        let film = "ugfilm -qt -rays -aa 1 -frames 3 -cv '0 0 0 .. 0 .9 0'";
        for file in ["a.mp4", "a.webm"] {
            shell.run(&format!("{film} {options} -fo {file} street.ug"));
            let [found, messages] = shell.run(&format!(
                "ffprobe -v error -count_frames -show_streams {file}; ffmpeg -v error -i {file} -f null -"
            ));
            let lines = || found.lines().filter_map(|line| line.split_once('='));
            let is = |name: &str, value: &str| lines().any(|line| line == (name, value));
            assert!(is("nb_read_frames", "3"), "{options} {file}: {found}");
            // ffprobe names meshes as unknown.
            let unknown = messages.lines().filter(|line| !line.contains("Unknown projection type"));
            assert_eq!(unknown.count(), 0, "{options} {file}: {messages}");
            let of_eyes = ["2D", "top and bottom", "side by side"][usize::from(eyes)];
            assert!(
                is("type", of_eyes) || eyes == 0 && file == "a.webm",
                "{options} {file}: {found}"
            );
            assert_eq!(is("projection", "equirectangular"), kind == "equirectangular", "{options}");
            let is_flat = kind.is_empty();

            let bytes = fs::read(shell.path(file)).unwrap();
            let data = if file == "a.webm" {
                let found = projection(&bytes);
                found.map(|(number, data)| {
                    assert_eq!(number, if kind == "mesh" { 3 } else { 1 }, "{options}");
                    data
                })
            } else {
                let stereo = description(&bytes, &[("st3d", 0)]).unwrap();
                assert_eq!(stereo, [0, 0, 0, 0, eyes], "{options}");
                // The codec comes first, the marks before what is optional.
                let kinds: Vec<_> =
                    boxes(description(&bytes, &[]).unwrap()).iter().map(|one| one.0).collect();
                let expected: &[_] =
                    if is_flat { &[b"avcC", b"st3d"] } else { &[b"avcC", b"st3d", b"sv3d"] };
                assert!(
                    kinds.iter().take(expected.len()).eq(expected.iter().copied()),
                    "{kinds:?}"
                );
                let sphere = |path: &[(&'static str, usize)]| {
                    description(&bytes, &[&[("sv3d", 0)], path].concat())
                };
                if !is_flat {
                    assert_eq!(sphere(&[("svhd", 4)]).unwrap(), b"ugfilm\0");
                    assert_eq!(sphere(&[("proj", 0), ("prhd", 0)]).unwrap(), [0; 16]);
                }
                let found = if kind == "mesh" { "mshp" } else { "equi" };
                sphere(&[("proj", 0), (found, 0)])
            };
            assert_eq!(data.is_none(), is_flat, "{options} {file}");
            match (kind, data) {
                ("equirectangular", Some(data)) => assert_eq!(data, [0; 20]),
                ("mesh", Some(data)) => check_mesh(&read_mesh(data), options),
                _ => {}
            }
            check_first_version(&bytes, kind == "equirectangular", eyes);
        }
    }
}

/// Version 1 is XML, of equirectangular films alone.
fn check_first_version(film: &[u8], is_there: bool, eyes: u8) {
    let text = String::from_utf8_lossy(film);
    let part = |name: &str, value: &str| {
        text.contains(&format!("<GSpherical:{name}>{value}</GSpherical:{name}>"))
    };
    assert_eq!(part("Spherical", "true"), is_there);
    assert_eq!(part("Stitched", "true"), is_there);
    assert_eq!(part("ProjectionType", "equirectangular"), is_there);
    assert_eq!(part("StereoMode", "top-bottom"), is_there && eyes == 1);
    if is_there && film[4..8] == *b"ftyp" {
        let track = box_at(film, &[("moov", 0), ("trak", 0), ("uuid", 0)]).unwrap();
        let uuid = 0xffcc_8263_f855_4a93_8814_587a_0252_1fdd_u128;
        assert_eq!(track[..16], uuid.to_be_bytes());
    }
}

/// Directions along the axes are where the lens has them.
fn check_mesh(mesh: &Mesh, options: &str) {
    let nearest = |direction: [f32; 3]| {
        let off = |vertex: &&[f32; 5]| -> f32 {
            let part = |axis: usize| vertex[axis] - direction[axis];
            (0..3).map(|axis| part(axis) * part(axis)).sum()
        };
        let best = mesh.vertices.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
        assert!(off(&best) < 1e-6, "{options}: {best:?}");
        [best[3], best[4]]
    };
    let near = |found: [f32; 2], expected: [f32; 2]| {
        let off = (found[0] - expected[0]).abs().max((found[1] - expected[1]).abs());
        assert!(off < 1e-5, "{options}: {found:?}, not {expected:?}");
    };
    if options.contains("-cube") {
        assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (24, 12));
        // The corner of the cube where the right, the upper and the front side meet.
        let third = 1.0 / 3.0_f32.sqrt();
        let corners = mesh.vertices.iter().filter(|vertex| {
            (0..3).all(|axis| (vertex[axis] - [third, third, -third][axis]).abs() < 1e-6)
        });
        let mut places: Vec<_> = corners.map(|vertex| (6.0 * vertex[3]).round()).collect();
        places.sort_by(f32::total_cmp);
        // Left edge of the right side, right edge of the upper and of the front side.
        assert_eq!(places, [0.0, 3.0, 5.0]);
        return;
    }
    near(nearest([0.0, 0.0, -1.0]), [0.5, 0.5]);
    if options.contains("180") {
        near(nearest([1.0, 0.0, 0.0]), [1.0, 0.5]);
        near(nearest([0.0, 1.0, 0.0]), [0.5, 1.0]);
    }
}

/// Frames with text on them, parts of frames and plain films say nothing.
#[test]
fn films_of_a_part_say_nothing() {
    if !tools::has(&[tools::FFMPEG]) {
        return;
    }
    let shell = Shell::new(&["street.ug"]);
    for options in ["-sz 64 32", "-rays -sz 64 32", "-rays -pan -cap street -sz 256 128"] {
        shell.run(&format!("ugfilm -qt -aa 1 -frames 2 -ti 0..1 {options} -fo a.mp4 street.ug"));
        let bytes = fs::read(shell.path("a.mp4")).unwrap();
        assert!(description(&bytes, &[("avcC", 0)]).is_some());
        assert_eq!(description(&bytes, &[("sv3d", 0)]), None, "{options}");
        assert_eq!(description(&bytes, &[("st3d", 0)]), None, "{options}");
        check_first_version(&bytes, false, 0);
    }
}

/// An exposure is measured in small pictures, whose sides are squares, too.
#[test]
fn films_of_cubes_measure_their_exposure() {
    let shell = Shell::new(&["street.ug"]);
    let film = "ugfilm -rays -aa 1 -frames 2 -cv '0 0 0 .. 0 .9 0' -sz 768 128 -cube -fo a_%d.png";
    let [_, notes] = shell.run(&format!("{film} street.ug"));
    assert!(notes.contains("one exposure for all frames"), "{notes}");
}
