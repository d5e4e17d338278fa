//! Lights, unlit faces and samplers: from scenes to glTF and back.

use glam::DVec3;
use uglight::Lamps;
use ugmesh::{Config, Size, Target};
use ugscene::Scene;

use crate::common::{convert, parse, statements, to_mesh, to_scene};

const TRIANGLE: &str = "v a 0 0 0; v b 1 0 0; v c 0 1 0;";

/// The linear light that each lamp sends to a surface.
fn levels(scene: &Scene, point: DVec3, normal: DVec3) -> Vec<DVec3> {
    let lamps = Lamps::new(scene, DVec3::ZERO, false);
    lamps.iter().map(|lamp| lamp.linear * lamp.level_at_rest(point, normal, DVec3::ZERO)).collect()
}

/// Every surface has the light that it had, to the 32 bits of glTF, also in a mesh of another size.
#[test]
fn lights_round_trip() {
    let text = format!(
        "{TRIANGLE} f (a b c); c_rgb amber 1 .7 .2; c_xyz bright 3 2 1;
        l sun 0.5  3 -4 5; l 0.7 0 0 -2 amber; l bulb 2  1 2 3 0 3 amber;
        l glow 1  -2 1 2 0.1 0.5 bright; l down 2  0 0 5 0 3 -spot 0 1 -2 40 15;"
    );
    let scene = parse(text.as_bytes());
    let lit = levels(&scene, DVec3::new(0.5, 0.5, 1.0), DVec3::Z);
    assert!(lit.len() == 5 && lit.iter().filter(|light| light.length() > 0.01).count() == 4);
    for (target, scale) in [(Target::Gltf, 1.0), (Target::Glb, 8.0), (Target::Glb, 0.125)] {
        let config = Config { target, size: Size::Times(scale), ..Config::default() };
        let converted = convert(&config, "a.ug", text.as_str()).unwrap();
        assert_eq!(converted.notes, ["1 colour brighter than 1 is clipped"]);
        let back = to_scene(&Config::default(), "<stdin>", converted.bytes);
        assert_eq!(back.names.get(back.lights[0].name.unwrap()), "sun");
        for place in [[0.5, 0.5, 1.0], [-3.0, 2.0, 0.0], [0.0, 1.5, 4.0], [9.0, 0.0, -2.0]] {
            for normal in [DVec3::Z, DVec3::NEG_X, DVec3::new(0.6, 0.8, 0.0)] {
                let place = DVec3::from(place);
                let before = levels(&scene, place, normal);
                let after = levels(&back, scale * place, normal);
                for (before, after) in before.into_iter().zip(after) {
                    let off = (before - after).length();
                    assert!(off <= 1e-5 * (1e-3 + before.length()), "{place} {before} {after}");
                }
            }
        }
    }
}

#[test]
fn lights_that_gltf_does_not_have_are_noted() {
    let notes = |lights: &str, stage: &str| {
        let text = format!("{stage} {TRIANGLE} f (a b c); {lights}");
        let config = Config { target: Target::Glb, ..Config::default() };
        convert(&config, "a.ug", text).unwrap().notes
    };
    let why = "glTF has only directional lights, and points and spots up to 90° with a reference distance";
    let many = format!("3 lights are left out: {why}");
    assert_eq!(
        notes("l 0.3; l 1 0 0 1 0; l 1 0 0 1 0 2 -area 1 0 0 0 1 0; l 1 0 0 1;", ""),
        [many]
    );
    let seen = "(ugstage 1 geometry as-seen eye 0 0 9)";
    assert_eq!(notes("l sun 1 0 0 1;", seen), ["1 light of a scene as seen is left out"]);
}

/// A light level is a factor of an unlit colour.
#[test]
fn unlit_faces_round_trip() {
    let text =
        format!("{TRIANGLE} c_rgb red 1 0 0; f (a b c) red 1; f (c b a) red; f (b a c) red .5;");
    let gltf = to_mesh(Target::Gltf, text.as_bytes());
    let document: serde_json::Value = serde_json::from_slice(&gltf).unwrap();
    assert_eq!(document["extensionsUsed"], serde_json::json!(["KHR_materials_unlit"]));
    let back = to_scene(&Config::default(), "<stdin>", gltf);
    let levels: Vec<_> = back.faces.iter().map(|face| back.light_level(face)).collect();
    assert_eq!(levels, [Some(1.0), None, Some(1.0)]);
}

#[test]
fn cameras_round_trip() {
    let text = format!("{TRIANGLE} f (a b c); cam -ep 1 -4 2 -vc 0 0 0 -ud 0 0 1 -va 40 30.5;");
    for up in ["", "cam side -ep 9 9 9;"] {
        let text = format!("{text} {up}");
        let back = to_scene(&Config::default(), "<stdin>", to_mesh(Target::Glb, text.as_bytes()));
        let camera = back.camera().unwrap();
        let off = |found: Option<DVec3>, x: f64, y: f64, z: f64| {
            (found.unwrap() - DVec3::new(x, y, z)).length()
        };
        assert!(off(camera.eye, 1.0, -4.0, 2.0) < 1e-6, "{camera:?}");
        let forward = (camera.center.unwrap() - camera.eye.unwrap()).normalize();
        assert!((forward - DVec3::new(-1.0, 4.0, -2.0).normalize()).length() < 1e-6);
        assert!((camera.view_angle.unwrap()[0] - 40.0).abs() < 1e-4, "{camera:?}");
        assert!(statements(&back).contains("cam camera1 "), "{}", statements(&back));
    }
}
