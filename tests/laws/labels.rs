//! Arrows of labels end where their vertices are seen, in every program, and are left out where
//! faces hide these.

use glam::DVec3;
use ugphoton::MotionOptions;
use ugrainbow::Place;
use ugtests::pipe::Pipe;
use ugtests::scenes;

const BOX: &str = "c grey .7; l 1; cam -ep 0 -9 3 -vc 0 0 .5 -va 40;
    v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; v e -1 -1 1; v f 1 -1 1; v g 1 1 1; v h -1 1 1;
    f (a b f e) grey; f (b c g f) grey; f (c d h g) grey; f (d a e h) grey; f (e f g h) grey; f (d c b a) grey;";
const LABELS: &str =
    "label \"left\" a; label \"right, β\" f; label \"behind\" h; v z 0 -20 0; label \"unseen\" z;";
const SIZE: [u32; 2] = [240, 180];

/// Where the vertices of labels in the picture are seen, in pixels.
fn places(beta: DVec3) -> Vec<[f64; 2]> {
    let pipe = Pipe::new(beta, SIZE).in_place();
    let seen = scenes::parse(&pipe.run(BOX.as_bytes()).seen);
    let find = |name: &str| {
        seen.vertices.iter().find(|vertex| seen.names.get(vertex.name) == name).unwrap()
    };
    let eye = DVec3::new(0.0, -9.0, 3.0);
    let forward = (DVec3::new(0.0, 0.0, 0.5) - eye).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let scale = 120.0 / libm::tan(20f64.to_radians());
    let place = |name: &str| {
        let at = find(name).position - eye;
        let depth = at.dot(forward);
        [120.0 + scale * at.dot(right) / depth, 90.0 - scale * at.dot(right.cross(forward)) / depth]
    };
    ["a", "f", "h"].map(place).to_vec()
}

#[test]
fn arrows_end_at_their_vertices_in_the_pipe_and_in_ray_traced_pictures() {
    let text = format!("{BOX}{LABELS}");
    for beta in [DVec3::ZERO, DVec3::new(0.7, 0.0, 0.0), DVec3::new(-0.3, 0.8, 0.1)] {
        let pipe = Pipe::new(beta, SIZE).in_place();
        let motion =
            MotionOptions { velocity: Some(beta), in_place: true, ..MotionOptions::default() };
        let rays = |text: &str| {
            let mut config =
                ugphoton::Config { motion: motion.clone(), ..ugphoton::Config::default() };
            (config.picture.size, config.picture.samples) = (SIZE, 1);
            ugphoton::render(scenes::parse(text.as_bytes()), &config).unwrap().into_frame().unwrap()
        };
        let by_pipe = [BOX, &text].map(|text| pipe.draw(text.as_bytes()));
        let by_rays = [BOX, &text].map(rays);
        let differs = [&|x, y| by_pipe[0].get_pixel(x, y) != by_pipe[1].get_pixel(x, y), &|x, y| {
            by_rays[0].pixel(x, y) != by_rays[1].pixel(x, y)
        }] as [&dyn Fn(u32, u32) -> bool; 2];
        for [x, y] in places(beta) {
            let near = |at: f64| (at.floor() as u32).saturating_sub(1)..=at.floor() as u32 + 1;
            for differs in differs {
                let has_tip = near(y).any(|row| near(x).any(|column| differs(column, row)));
                assert!(has_tip, "{beta}: no arrow ends at {x} {y}");
            }
        }
        // Labels are where a picture differs from one without them: at the same pixels by both
        // programs.
        let [pipe, rays] = differs.map(|differs| {
            let all = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
            all.filter(|&(x, y)| differs(x, y)).collect::<Vec<_>>()
        });
        let n_shared = pipe.iter().filter(|pixel| rays.contains(pixel)).count();
        assert!(pipe.len() > 300, "{}", pipe.len());
        assert!(
            n_shared * 20 > pipe.len().max(rays.len()) * 17,
            "{beta}: {n_shared} of {}",
            pipe.len()
        );
    }
}

#[test]
fn labels_outside_the_picture_are_told() {
    let text = format!("{BOX}{LABELS}");
    let mut config = ugphoton::Config::default();
    (config.picture.size, config.picture.samples) = ([80, 60], 1);
    config.picture.annotations.place = Place::Beside;
    config.picture.annotations.title = "A box at {beta}".into();
    let notes = ugphoton::render(scenes::parse(text.as_bytes()), &config).unwrap().notes;
    assert!(notes.contains(&ugphoton::Note::LabelsOutside(1)), "{notes:?}");
    assert!(notes.contains(&ugphoton::Note::UnknownNumber), "{notes:?}");
}

/// The corners of a box on the side away from the eye have no labels, unless hidden lines are
/// drawn.
#[test]
fn labels_of_hidden_vertices_are_left_out() {
    for beta in [0.0, 0.9] {
        let pipe = Pipe::new(DVec3::new(beta, 0.0, 0.0), SIZE).in_place();
        // Which corners are hidden, by the outward normals of the sides as seen: all that meet
        // there.
        let seen = scenes::parse(&pipe.run(BOX.as_bytes()).seen);
        let eye = DVec3::new(0.0, -9.0, 3.0);
        let mut is_seen = std::collections::BTreeMap::new();
        for face in &seen.faces {
            let corners: Vec<_> = seen.face_contours(face).next().unwrap().to_vec();
            let at = |idx: usize| seen.vertices[corners[idx].index()].position;
            let is_front = (at(1) - at(0)).cross(at(2) - at(0)).dot(eye - at(0)) > 0.0;
            for corner in &corners {
                let name = seen.names.get(seen.vertices[corner.index()].name).to_owned();
                *is_seen.entry(name).or_insert(false) |= is_front;
            }
        }
        let hidden: Vec<_> =
            "abcdefgh".chars().filter(|name| !is_seen[&name.to_string()]).collect();
        assert!((1..4).contains(&hidden.len()), "{beta}: {hidden:?}");
        for name in "abcdefgh".chars() {
            let text = format!("{BOX} label \"here\" {name};");
            let told = |note: &ugrainbow::Note| *note == ugrainbow::Note::LabelsHidden(1);
            let mut config = ugphoton::Config::default();
            config.motion.velocity = Some(DVec3::new(beta, 0.0, 0.0));
            config.motion.in_place = true;
            (config.picture.size, config.picture.samples) = (SIZE, 1);
            let rays = ugphoton::render(scenes::parse(text.as_bytes()), &config).unwrap();
            assert_eq!(rays.notes.iter().any(told), hidden.contains(&name), "{beta} {name}");
            let seen = scenes::parse(&pipe.run(text.as_bytes()).seen);
            let mut config = ugrainbow::Config::default();
            (config.picture.size, config.picture.samples) = (SIZE, 1);
            let notes = ugrainbow::render(&seen, &config).unwrap().notes;
            assert_eq!(notes.iter().any(told), hidden.contains(&name), "{beta} {name}");
            let hidden = ugrainbow::HiddenLines::Dashed;
            config.wireframe = Some(ugrainbow::Wireframe { hidden, ..Default::default() });
            let notes = ugrainbow::render(&seen, &config).unwrap().notes;
            assert!(!notes.iter().any(told), "{beta} {name}");
        }
    }
}
