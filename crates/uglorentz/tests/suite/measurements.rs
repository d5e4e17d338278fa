//! What `-at` writes: published numbers, through the program's own text.

use base64::prelude::{BASE64_STANDARD, Engine as _};
use glam::DVec3;
use uglorentz::{Config, Pieces, Table};
use ugphysics::{doppler_at, rest_position, seen_event};
use ugtesting::Random;

use crate::common::{moving, parse, run, table};

/// The numbers of vertex `a` of a triangle that moves with `beta`, by heading.
fn measured(a: DVec3, beta: DVec3, config: Config) -> impl Fn(&str) -> f64 {
    let text = format!("v a {:?} {:?} {:?}; v b 7 8 9; v c 8 7 9; f (a b c);", a.x, a.y, a.z);
    let config = Config { velocity: Some(beta), pieces: Pieces::PerEdge(1), ..config };
    let table = table(&text, &config, Table::Csv);
    let mut lines = table.lines();
    let headings: Vec<String> = lines.next().unwrap().split(',').map(str::to_string).collect();
    let words: Vec<String> = lines.next().unwrap().split(',').map(str::to_string).collect();
    assert_eq!(words[0], "a");
    move |heading| {
        words[headings.iter().position(|other| other == heading).unwrap()].parse().unwrap()
    }
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance * expected.abs().max(1.0),
        "{found} for {expected}"
    );
}

#[test]
fn rows_are_those_of_the_scene_and_of_the_equations() {
    let mut random = Random(91);
    let points = [(); 9].map(|()| random.in_ball(10.0));
    let mut text = String::new();
    for (idx, p) in points.iter().enumerate() {
        text += &format!("v p{idx} {:?} {:?} {:?}; ", p.x, p.y, p.z);
    }
    text += "f (p0 p1 p2) <0.9 0 0>; f (p3 p4 p5); f (p6 p7 p8) <0 -0.2 0.3>; cam -ep 1 2 3 <0.3 0.3 0>;";
    for pieces in [Pieces::PerEdge(3), Pieces::UpTo(1e-4)] {
        let config = Config { time: 1.5, pieces, ..Config::default() };
        let scene = run(&text, &config).scene;
        let (eye, bodies) = (DVec3::new(1.0, 2.0, 3.0), ugscene::vertex_bodies(&scene));
        let table = table(&text, &config, Table::Csv);
        assert_eq!(table.lines().count(), 1 + scene.vertices.len());
        for ((line, vertex), body) in table.lines().skip(1).zip(&scene.vertices).zip(bodies) {
            let words: Vec<&str> = line.split(',').collect();
            assert_eq!(words[0], scene.names.get(vertex.name));
            let number = |idx: usize| words[idx].parse::<f64>().unwrap();
            assert_eq!(DVec3::new(number(1), number(2), number(3)), vertex.position);
            let v = scene.bodies.stated_velocity(body).unwrap();
            let seen = vertex.position - eye;
            near(number(5), doppler_at(seen, v), 0.0);
            near(number(4) - 1.5, seen_event(rest_position(seen, v), v).t, 1e-13);
            near(number(6), seen.length(), 0.0);
            // D again, from the angles in both frames.
            let (angle, rest_angle) = (number(7).to_radians(), number(8).to_radians());
            near(1.0 / (v.gamma() * (1.0 - v.speed() * libm::cos(angle))), number(5), 1e-12);
            near(v.gamma() * (1.0 + v.speed() * libm::cos(rest_angle)), number(5), 1e-12);
        }
    }
}

const HOUSE: &str =
    "v a:1 1 2 2; v b 3 2 2; v c 3 4 2; v d 1 4 2; v e 2 2.5 2; v g 2.5 3 2; v h 2 3 2;
    v at#eye 0 0 0; f (a:1 b c d) (e g h); f (a:1 b c);";

#[test]
fn at_rest_nothing_is_shifted() {
    let table = table(HOUSE, &Config::default(), Table::Csv);
    assert!(table.starts_with("name,x,y,z,emission_time,doppler,distance,emission_angle_deg,rest_emission_angle_deg\na:1,1,2,2,-3,1,3,NaN,NaN\n"), "{table}");
    assert!(table.ends_with("at#eye,0,0,0,0,1,0,NaN,NaN\n"), "{table}");
}

#[test]
fn without_flight_time_light_leaves_at_the_time_of_the_picture() {
    let geometry = ugscene::ShownEffects { contraction: true, flight_time: false };
    let at = measured(
        DVec3::new(1.0, 2.0, 2.0),
        DVec3::ZERO,
        Config { geometry, time: 5.0, ..Config::default() },
    );
    near(at("emission_time"), 5.0, 0.0);
    near(at("distance"), 3.0, 0.0);
}

#[test]
fn ply_has_faces_without_holes_and_names() {
    let text = table(HOUSE, &Config::default(), Table::Ply);
    let (head, body) = text.split_once("end_header\n").unwrap();
    assert_eq!(
        head,
        "ply\nformat ascii 1.0\ncomment uglorentz\nelement vertex 8\nproperty double x\nproperty double y\n\
         property double z\nproperty double emission_time\nproperty double doppler\nproperty double distance\n\
         property double emission_angle_deg\nproperty double rest_emission_angle_deg\nelement face 8\n\
         property list uint uint vertex_indices\nelement vertex_name 8\nproperty list uint uchar bytes\n"
    );
    let lines: Vec<&str> = body.lines().collect();
    assert_eq!(lines.len(), 8 + 8 + 8);
    assert_eq!(lines[0], "1 2 2 -3 1 3 NaN NaN");
    // Four corners and a hole of three make seven triangles, of the area that is left.
    let scene = parse(HOUSE);
    let area = |line: &&str| {
        let words: Vec<usize> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        assert_eq!(words[0], 3);
        let [a, b, c] = [1, 2, 3].map(|idx| scene.vertices[words[idx]].position);
        (b - a).cross(c - a).length() / 2.0
    };
    near(lines[8..15].iter().map(area).sum(), 4.0 - 0.125, 1e-14);
    assert_eq!(lines[15], "3 0 1 2");
    assert_eq!(lines[16], "3 97 58 49");
}

/// The bytes of the numbers in an array of a VTK file, 8 per number. The file stores their length
/// before them.
fn vtk_array(text: &str, name: &str) -> Vec<[u8; 8]> {
    let start = text.find(&format!("Name=\"{name}\"")).unwrap();
    let content = text[start..].split_once('>').unwrap().1.split_once('<').unwrap().0;
    let bytes = BASE64_STANDARD.decode(content).unwrap();
    let rows: Vec<[u8; 8]> = bytes.as_chunks().0.to_vec();
    assert_eq!((rows.len() - 1) * 8, u64::from_le_bytes(rows[0]) as usize, "{name}");
    rows[1..].to_vec()
}

#[test]
fn vtk_has_the_numbers_of_the_table() {
    let config = moving(DVec3::new(0.6, -0.2, 0.1));
    let (vtk, csv) = (table(HOUSE, &config, Table::Vtp), table(HOUSE, &config, Table::Csv));
    let numbers = |name: &str| -> Vec<f64> {
        vtk_array(&vtk, name).into_iter().map(f64::from_le_bytes).collect()
    };
    let columns: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let column = |name: &str| -> Vec<f64> {
        let idx = columns.iter().position(|column| *column == name).unwrap();
        rows.iter().map(|row| row[idx].parse().unwrap()).collect()
    };
    for name in &columns[4..] {
        // As text, so that NaN, of the vertex at the eye, equals itself.
        let text = |numbers: Vec<f64>| numbers.iter().map(f64::to_string).collect::<Vec<_>>();
        assert_eq!(text(numbers(name)), text(column(name)), "{name}");
    }
    let points: Vec<f64> = ["x", "y", "z"].map(column).concat();
    let n = rows.len();
    let expected: Vec<f64> = (0..3 * n).map(|idx| points[idx % 3 * n + idx / 3]).collect();
    assert_eq!(numbers("Points"), expected);
    // A vertex at rest, because nothing uses it, has no angle to its motion.
    for (velocity, angle) in numbers("velocity").chunks(3).zip(column("emission_angle_deg")) {
        let expected = if angle.is_nan() { DVec3::ZERO } else { DVec3::new(0.6, -0.2, 0.1) };
        near(DVec3::from_slice(velocity).distance(expected), 0.0, 1e-15);
    }
    // The corners of polygons, each up to its offset, which is where the next begins.
    let ints = |name: &str| -> Vec<i64> {
        vtk_array(&vtk, name).into_iter().map(i64::from_le_bytes).collect()
    };
    let (corners, ends) = (ints("connectivity"), ints("offsets"));
    assert_eq!(ends.last(), Some(&(corners.len() as i64)));
    assert!(ends.is_sorted() && corners.iter().all(|&corner| (0..n as i64).contains(&corner)));
    assert!(
        vtk.contains(&format!("NumberOfPoints=\"{n}\""))
            && vtk.contains(&format!("NumberOfPolys=\"{}\"", ends.len()))
    );
}

#[test]
fn endings_choose_the_format() {
    assert_eq!(
        ["csv", "PLY", "vtp", "txt", ""].map(Table::by_extension),
        [Some(Table::Csv), Some(Table::Ply), Some(Table::Vtp), None, None]
    );
}
