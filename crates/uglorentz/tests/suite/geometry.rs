//! Where vertices go: laws of (P1)-(P5), through text.

use glam::DVec3;
use uglorentz::{Anchor, Config, Pieces};
use ugphysics::{Velocity, contracted, flight_time, seen_position};
use ugscene::{LightKind, Scene, ShownEffects};
use ugtesting::Random;

use crate::common::{edges, find, moving, parse, place, rock, run, seen, text, try_run};

/// A cloud of triangles.
fn cloud(random: &mut Random, n: usize) -> (String, Vec<DVec3>) {
    let vertices: Vec<DVec3> = (0..3 * n).map(|_| random.in_ball(10.0)).collect();
    let faces: Vec<Vec<usize>> = (0..n).map(|k| vec![3 * k, 3 * k + 1, 3 * k + 2]).collect();
    (text(&vertices, &faces), vertices)
}

#[test]
fn nothing_changes_at_rest() {
    let mut random = Random(3);
    let (text, _) = cloud(&mut random, 20);
    let text =
        format!("{{ mine }} {text} c red 0.5 0 1; f big (v0 v1 v2) (v3 v4 v5) red; w (v0 v9);");
    // Bent faces become triangles when they are read.
    let before =
        ugparse::read(&ugparse::Source::new("t.ug", &*text), &ugparse::Options::default(), None);
    let before = before.unwrap().scene;
    for config in [
        Config::default(),
        moving(DVec3::ZERO),
        Config { eye: Some(DVec3::ONE / 3.0), ..Config::default() },
    ] {
        let mut after = seen(&text, &config);
        assert_eq!(after.head.comments.remove(1), " uglorentz 0.1.0: uglorentz ");
        assert_eq!(after.cameras.pop().unwrap().eye, Some(config.eye.unwrap_or(DVec3::ZERO)));
        assert_eq!(ugparse::write(&after), ugparse::write(&before));
    }
}

/// Where the scene of one vertex `a` is seen.
fn seen_at(p: DVec3, config: &Config) -> DVec3 {
    let text = format!(
        "v a {:?} {:?} {:?}; v b {:?} {:?} {:?}; v c 4 5 6; f (a b c);",
        p.x,
        p.y,
        p.z,
        p.x,
        p.y,
        p.z + 2.0
    );
    let scene = seen(&text, config);
    place(&scene, find(&scene, "a"))
}

#[test]
fn a_later_picture_is_that_of_a_scene_further_on() {
    let beta = DVec3::new(0.3, -0.5, 0.6);
    let v = Velocity::from_beta(beta).unwrap();
    for (contraction, flight_time) in [(true, true), (true, false), (false, true), (false, false)] {
        let geometry = ShownEffects { contraction, flight_time };
        for time in [-3.0, 0.0, 2.5] {
            let p = DVec3::new(1.0, 2.0, -3.0);
            let found = seen_at(p, &Config { time, geometry, ..moving(beta) });
            // In S every point of the body has moved by v t; at time 0 it is contracted about the
            // eye.
            let now = if contraction { contracted(p, v) } else { p } + beta * time;
            let expected =
                if flight_time { now + ugphysics::flight_time(now, v) * beta } else { now };
            assert!((found - expected).length() < 1e-12, "{geometry:?} {time}");
        }
    }
}

#[test]
fn anchors_are_where_contraction_changes_nothing() {
    let beta = DVec3::new(0.3, -0.5, 0.6);
    let v = Velocity::from_beta(beta).unwrap();
    let eye = DVec3::new(-2.0, 1.0, 0.5);
    let p = DVec3::new(1.0, 2.0, -3.0);
    // Box of a, a + (0, 0, 2) and (4, 5, 6).
    let center = DVec3::new(2.5, 3.5, 1.5);
    let own = DVec3::new(7.0, -8.0, 9.0);
    for (anchor, point) in [
        (None, eye),
        (Some(Anchor::Eye), eye),
        (Some(Anchor::Origin), DVec3::ZERO),
        (Some(Anchor::Center), center),
        (Some(Anchor::Point(own)), own),
    ] {
        // Contraction alone, about the anchor.
        let only = ShownEffects { contraction: true, flight_time: false };
        let config = Config { anchor, geometry: only, eye: Some(eye), ..moving(beta) };
        let expected = point + contracted(p - point, v);
        assert!((seen_at(p, &config) - expected).length() < 1e-12, "{anchor:?}");
        // And then the time of flight.
        let config = Config { anchor, eye: Some(eye), ..moving(beta) };
        let now = expected - eye;
        let expected = eye + now + flight_time(now, v) * beta;
        assert!((seen_at(p, &config) - expected).length() < 1e-12, "{anchor:?}");
    }
}

#[test]
fn bodies_in_place_are_seen_where_the_scene_has_them() {
    let eye = DVec3::new(-2.0, 1.0, 0.5);
    let p = DVec3::new(1.0, 2.0, -3.0);
    for beta in [DVec3::new(0.3, -0.5, 0.6), DVec3::new(0.0, 0.999, 0.0)] {
        for (contraction, flight_time) in
            [(true, true), (true, false), (false, true), (false, false)]
        {
            let geometry = ShownEffects { contraction, flight_time };
            let config = |anchor| Config {
                anchor,
                in_place: true,
                geometry,
                eye: Some(eye),
                ..moving(beta)
            };
            let found = seen_at(p, &config(Some(Anchor::Point(p))));
            assert!((found - p).length() < 1e-11, "{geometry:?} {found}");
            // Without an anchor it is the centre of the box: the vertex of a small box there hardly
            // moves.
            let text = "v a 3 3 3; v b 3.000002 3 3; v c 3 3.000002 3.000002; f (a b c);";
            let scene = seen(text, &config(None));
            let off =
                scene.vertices.iter().map(|v| (v.position - DVec3::splat(3.000_001)).length());
            // Seen sizes change by up to γ(1 + β), here 45.
            assert!(off.fold(0.0, f64::max) < 2e-4);
        }
    }
}

#[test]
fn time_runs_on_for_bodies_in_place() {
    let beta = DVec3::new(0.0, 0.8, 0.0);
    let p = DVec3::new(5.0, 1.0, 0.0);
    let config =
        Config { anchor: Some(Anchor::Point(p)), in_place: true, time: 2.0, ..moving(beta) };
    let found = seen_at(p, &config);
    // Its light left at −|p|, when it was at p; at 2 it is seen where v(t + |p|) from p is t + 2
    // light-seconds off.
    let emitted = (-p.length(), found);
    let travelled = emitted.1.length();
    assert!(((found - p) - beta * (2.0 - travelled - emitted.0)).length() < 1e-12);
}

#[test]
fn bodies_with_their_own_velocities() {
    let text = "v a 1 2 3; v b 2 2 3; v c 1 3 3; v lone 7 7 7;
        f still (a b c); f left (a b c) <-0.5 0 0>; f right (a b c) <0.5 0 0>;";
    let uncut = Config { pieces: Pieces::PerEdge(1), ..Config::default() };
    let scene = seen(text, &uncut);
    let beta = |name: &str| {
        let face =
            scene.faces.iter().find(|f| f.name.map(|n| scene.names.get(n)) == Some(name)).unwrap();
        let velocity = scene.bodies.stated_velocity(face.body).map(Velocity::beta);
        (velocity, scene.face_contours(face).next().unwrap()[0])
    };
    for (name, expected) in [("still", None), ("left", Some(-0.5)), ("right", Some(0.5))] {
        let (velocity, corner) = beta(name);
        assert_eq!(velocity.map(|v| v.x), expected);
        let v = Velocity::from_beta(velocity.unwrap_or_default()).unwrap();
        let a = seen_position(DVec3::new(1.0, 2.0, 3.0), v);
        let found = place(&scene, corner);
        assert!((found - a).length() < 1e-13, "{name}: {found} {a}");
    }
    assert_eq!(place(&scene, find(&scene, "lone")), DVec3::splat(7.0));
    // -vel overrides them all, and unused vertices follow.
    let scene = seen(text, &moving(DVec3::new(0.0, 0.0, 0.6)));
    assert!(
        scene.faces.iter().all(|f| scene.bodies.stated_velocity(f.body).unwrap().beta().z == 0.6)
    );
    let v = Velocity::from_beta(DVec3::new(0.0, 0.0, 0.6)).unwrap();
    assert!(
        (place(&scene, find(&scene, "lone")) - seen_position(DVec3::splat(7.0), v)).length()
            < 1e-13
    );
    // -vel 0 stops them; who had a velocity says so.
    let scene = seen(text, &moving(DVec3::ZERO));
    let said: Vec<bool> = scene.faces.iter().map(|f| f.body != scene.bodies.unstated()).collect();
    assert_eq!(said, [false, true, true]);
    assert_eq!(scene.vertices[0].position, DVec3::new(1.0, 2.0, 3.0));
}

#[test]
fn lamps_move_with_a_single_body() {
    let lamp = |scene: &Scene| match scene.lights[0].kind {
        LightKind::Local { position, .. } => position,
        _ => panic!("not local"),
    };
    let light = "l 1 5 5 5 0; l 1 0 0 1;";
    let config = Config { time: 2.0, ..Config::default() };
    let one =
        seen(&format!("v a 1 2 3; v b 2 2 3; v c 1 3 3; f (a b c) <0.6 0 0>; {light}"), &config);
    assert!((lamp(&one) - DVec3::new(5.0 + 1.25 * 0.6 * 2.0, 5.0, 5.0)).length() < 1e-14);
    let two = seen(
        &format!("v a 1 2 3; v b 2 2 3; v c 1 3 3; f (a b c) <0.6 0 0>; f (a b c); {light}"),
        &config,
    );
    assert_eq!(lamp(&two), DVec3::splat(5.0));
}

#[test]
fn the_camera_that_counts_gets_the_eye() {
    let tile = "v a 1 2 3; v b 2 2 3; v c 1 3 3; f (a b c);";
    let check = |cameras: &str, eye: Option<DVec3>, expected: &[Option<DVec3>]| {
        let scene = seen(&format!("{tile} {cameras}"), &Config { eye, ..Config::default() });
        let eyes: Vec<_> = scene.cameras.iter().map(|camera| camera.eye).collect();
        assert_eq!(eyes, expected, "{cameras}");
    };
    let (one, two) = (Some(DVec3::ONE), Some(DVec3::splat(2.0)));
    check("cam -vc 0 0 1;", None, &[Some(DVec3::ZERO)]);
    check("cam -ep 1 1 1;", None, &[one]);
    check("cam -ep 1 1 1 -va 30 30;", two, &[two]);
    check("cam side -ep 1 1 1; cam -vc 0 0 1;", two, &[one, two]);
    check("cam side; cam top -ep 2 2 2;", one, &[one, two]);
}

#[test]
fn a_vertex_at_the_eye_is_refused_if_it_moves_and_is_used() {
    let failure = |text: &str| try_run(text, &moving(DVec3::X * 0.5));
    assert_eq!(
        failure("v a 0 0 0;\nv b 1 0 0; v c 0 1 0; f (a b c);").unwrap_err(),
        "error: vertex `a` lies at the eye, where no direction to it exists
 --> t.ug:1:3
  |
1 | v a 0 0 0;
  |   ^ this vertex
  |
help: move the eye (-ep) or the vertex"
    );
    assert!(failure("v lone 0 0 0; v a 0 0 1; v b 1 0 0; v c 0 1 0; f (a b c);").is_ok());
    assert!(failure("v a 1e308 0 0; v b 1 0 0; v c 0 1 0; f (a b c);").is_ok());
    let far = failure("v a -1.7e308 0 0; v b 1 0 0; v c 0 1 0; f (a b c);").unwrap_err();
    assert!(far.contains("the seen position of vertex `a` is too far away for a number"), "{far}");
    run("v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c);", &Config::default());
}

#[test]
fn what_is_as_seen_already_is_refused() {
    const TILE: &str = "v a 0 0 1; v b 1 0 0; v c 0 1 0; f (a b c);";
    let config = moving(DVec3::X * 0.5);
    let once = run(TILE, &config);
    let twice = uglorentz::apply(once.scene.clone(), &config).unwrap_err().to_string();
    assert!(twice.starts_with("positions in this scene are as seen already"), "{twice}");
    let text = format!("(ugstage 1 colors as-seen hues law none) {TILE}");
    let colored = uglorentz::apply(parse(&text), &config).unwrap_err().to_string();
    assert!(colored.starts_with("colours in this scene are as seen already"), "{colored}");
    // Nothing moves, so nothing has changed.
    let still = run(TILE, &Config::default());
    assert!(still.scene.stage.is_at_rest());
    run(&String::from_utf8(still.text()).unwrap(), &config);
}

#[test]
fn smooth_normals_are_those_of_the_rest_frame() {
    let mut random = Random(6);
    let (vertices, faces) = rock(&mut random, DVec3::new(3.0, 0.0, 0.0), 1.0, 1);
    let text = text(&vertices, &faces);
    let config = Config { smooth: true, pieces: Pieces::PerEdge(2), ..moving(DVec3::Y * 0.9) };
    let scene = run(&text, &config).scene;
    let rest = parse(&text);
    let positions: Vec<DVec3> = rest.vertices.iter().map(|v| v.position).collect();
    let expected = ugscene::smooth_normals(&rest, &positions);
    for (vertex, normal) in scene.vertices.iter().zip(&expected) {
        assert!((vertex.normal.unwrap() - normal).length() < 1e-12);
    }
    // Between two vertices lies the normal between theirs.
    let n_edges = edges(&rest).len();
    assert_eq!(scene.vertices.len(), expected.len() + n_edges);
    for vertex in &scene.vertices[expected.len()..] {
        assert!((vertex.normal.unwrap().length() - 1.0).abs() < 1e-12);
    }
}
