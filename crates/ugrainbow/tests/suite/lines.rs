//! Wires and edges of faces: their width, visibility and position.

use glam::DVec3;
use ugimage::Frame;
use ugphysics::{Hsv, srgb_decode};
use ugrainbow::{Config, EdgeKind, HiddenLines, Wireframe};

use crate::common::{config, draw};

const ONLY_EDGES: Wireframe = Wireframe {
    has_faces: false,
    color: Some(Hsv { hue: 0.0, saturation: 0.0, value: 1.0 }),
    edges: EdgeKind::All,
    hidden: HiddenLines::Omitted,
};

/// Linear light of the red channel, added up down a column.
fn down(frame: &Frame, x: u32) -> f64 {
    (0..frame.height()).map(|y| srgb_decode(f64::from(frame.pixel(x, y)[0]) / 255.0)).sum()
}

/// A wire along the far edge of a table seen at a grazing angle has the same width as one in the
/// air.
#[test]
fn a_wire_on_a_slanting_edge_has_its_full_width() {
    let table = "v a -9 8 0; v b 9 8 0; v c 9 12 0; v d -9 12 0; f (a b c d) blue;";
    let text = |table: &str, height: f64| {
        format!(
            "l 1; c blue 1 240; c red 1 0; {table} v p -9 12 0; v q 9 12 0; w (p q) red;
             cam -ep 0 0 {height} -vc 0 12 0 -va 30 30;"
        )
    };
    for line_width in [1.2, 3.0] {
        for height in [0.02, 0.2, 2.0, -0.2] {
            let config = Config { line_width, ..config(40, 16) };
            for table in ["", table] {
                let frame = draw(&text(table, height), &config);
                for x in [3, 20, 33] {
                    let width = down(&frame, x);
                    // Rows of samples are a sixteenth of a pixel high.
                    assert!(
                        (width - line_width).abs() < 0.07,
                        "{width} of {line_width} at height {height}"
                    );
                }
            }
        }
    }
}

/// A unit cube: bit i of a corner's number is its coordinate i.
fn cube() -> String {
    let mut text = "l 1; c white 1;".to_owned();
    for k in 0..8 {
        text += &format!("v v{k} {} {} {};", k & 1, k >> 1 & 1, k >> 2 & 1);
    }
    for face in ["0 2 3 1", "4 5 7 6", "0 1 5 4", "1 3 7 5", "3 2 6 7", "2 0 4 6"] {
        text += &format!("f (v{}) white;", face.replace(' ', " v"));
    }
    text
}

/// The visible edges of a convex body are those of its front faces.
#[test]
fn of_a_cube_the_edges_of_faces_turned_to_the_eye_are_seen() {
    let side = 200;
    for eye in [DVec3::new(3.0, -4.0, 2.5), DVec3::new(-2.0, -3.0, -4.0), DVec3::new(0.4, 0.6, 5.0)]
    {
        let center = DVec3::splat(0.5);
        let text = format!(
            "{} cam -ep {} {} {} -vc .5 .5 .5 -ud .1 .2 1 -va 30 30;",
            cube(),
            eye.x,
            eye.y,
            eye.z
        );
        let frame = draw(&text, &Config { wireframe: Some(ONLY_EDGES), ..config(side, 4) });
        let forward = (center - eye).normalize();
        let right = forward.cross(DVec3::new(0.1, 0.2, 1.0).normalize()).normalize();
        let up = right.cross(forward);
        let scale = 0.5 * f64::from(side) / libm::tan(15.0f64.to_radians());
        let corner =
            |k: usize| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2 & 1) as f64);
        let mut n_edges = 0;
        for (k, axis) in (0..8).flat_map(|k| (0..3).map(move |axis| (k, axis))) {
            let other = k | 1 << axis;
            if other == k {
                continue;
            }
            n_edges += 1;
            // Faces at the edge: where the other two coordinates are those of the corner.
            let is_turned = |face: usize| {
                let at = corner(k)[face];
                if at == 0.0 { eye[face] < 0.0 } else { eye[face] > 1.0 }
            };
            let is_seen = (0..3).filter(|&face| face != axis).any(is_turned);
            // Not at the middle, where edges may cross in the picture.
            let point = corner(k).lerp(corner(other), 0.37) - eye;
            let depth = point.dot(forward);
            let at = |along: f64| 0.5 * f64::from(side) + scale * along / depth;
            let (x, y) = (at(point.dot(right)), at(-point.dot(up)));
            let pixel = frame.pixel(x as u32, y as u32)[0];
            assert_eq!(pixel > 100, is_seen, "eye {eye}, edge {k} {other}: {pixel}");
        }
        assert_eq!(n_edges, 12);
    }
}

/// Cuts inside a face are not drawn, also after repeated subdivision; boundaries between colours
/// are.
#[test]
fn cuts_of_a_face_are_not_drawn() {
    let camera = "cam -ep 0 -3 6 -vc 0 0 0 -va 50 50;";
    let corners = "v a -2 -2 0; v b 2 -2 0; v c 2 2 0; v d -2 2 0;";
    let cut = "v ab 0 -2 0; v bc 2 0 0; v cd 0 2 0; v da -2 0 0; v m .3 .2 0;";
    let whole = format!("l 1; c red 1 0; c green 1 120; {corners} f (a b c d) red; {camera}");
    let pieces = format!(
        "l 1; c red 1 0; c green 1 120; {corners} {cut}
         f (a ab m) red; f (a m da) red; f (ab b bc m) red; f (m bc c cd) red; f (da m cd d) red; {camera}"
    );
    for wireframe in [ONLY_EDGES, Wireframe { color: None, ..ONLY_EDGES }] {
        let config = Config { wireframe: Some(wireframe), ..config(60, 4) };
        let [whole, parts] = [&whole, &pieces].map(|text| draw(text, &config));
        let change = |(a, b): (&[u8; 4], &[u8; 4])| (0..3).map(|i| a[i].abs_diff(b[i])).max();
        let greatest = whole.pixels().iter().zip(parts.pixels()).filter_map(change).max();
        // At most one sample at a joint differs.
        assert!(greatest <= Some(40), "{greatest:?}");
        let two = draw(&pieces.replace("f (a ab m) red", "f (a ab m) green"), &config);
        let change = whole.pixels().iter().zip(two.pixels()).filter_map(change).max();
        assert!(change > Some(100), "{change:?}");
    }
}
