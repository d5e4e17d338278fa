//! At rest the pipe draws the same picture as `ugrainbow` alone.

use glam::DVec3;
use ugrainbow::HueScale;
use ugtests::picture::{assert_same, decode};
use ugtests::pipe::{Pipe, rainbow};
use ugtests::scenes;

/// The scene without velocities of its own, which `-vel` overrides.
fn without_velocities(text: &[u8]) -> Vec<u8> {
    let mut scene = scenes::parse(text);
    let unstated = scene.bodies.unstated();
    scene.faces.iter_mut().for_each(|face| face.body = unstated);
    scene.wires.iter_mut().for_each(|wire| wire.body = unstated);
    ugparse::write(&scene)
}

#[test]
fn a_pipe_at_rest_draws_what_ugrainbow_alone_draws() {
    let names = scenes::names();
    assert!(names.len() >= 9, "{names:?}");
    for name in names {
        let text = scenes::text(&name);
        let scene = scenes::parse(&text);
        let has_moving_lights = ugscene::has_moving_lights(&scene);
        if scene.bodies.has_world_lines() || !scene.color_tables.is_empty() || has_moving_lights {
            // `-vel` overrides neither motions nor those of lights; changing colours are seen late.
            continue;
        }
        let mut pipe = Pipe::new(DVec3::ZERO, [240, 180]);
        pipe.lorentz.camera_velocity = Some(DVec3::ZERO);
        pipe.rainbow.picture.samples = 2;
        if name == "rainbow" {
            pipe.rainbow.hue_scale = HueScale::Wavelengths;
        }
        let alone = decode(&rainbow(&without_velocities(&text), &pipe.rainbow));
        assert_same(&format!("rest-{name}"), &alone, &pipe.draw(&text), 0);
    }
}

/// A wire along the edge of a face keeps its own colour.
#[test]
fn a_pipe_at_rest_keeps_the_colours_of_wires() {
    const TILE: &[u8] = b"c pale 0.7 200 0.3; c line 1 55 0.9; l 1;
        v a -1 7 -1; v b 1 7 -1; v c 1 7 1; v d -1 7 1; f (a b c d) pale; w (a b c d a) line;
        cam -ep 0 0 0 -vc 0 7 0;";
    let pipe = Pipe::new(DVec3::ZERO, [80, 60]);
    assert_same("rest-wires", &decode(&rainbow(TILE, &pipe.rainbow)), &pipe.draw(TILE), 0);
}
