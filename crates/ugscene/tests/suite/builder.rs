//! Scenes from arrays.

use glam::DVec3;
use ugphysics::Velocity;
use ugscene::{
    AddedMesh, BodyId, BuildError, Camera, ColorId, ColorValue, Light, LightKind, LightMotion,
    Mesh, SceneBuilder, SurfaceProperties, Tint,
};

use super::parse;

const SQUARE: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];

fn square<'a>() -> Mesh<'a> {
    Mesh { name: "tile", positions: &SQUARE, corners: &[0, 1, 2, 0, 2, 3], ..Mesh::default() }
}

/// What is built is written as text that reads back as the same scene.
#[test]
fn built_scenes_are_those_of_their_text() {
    let mut builder = SceneBuilder::default();
    let red = builder.color("red", ColorValue::Rgb([0.8, 0.1, 0.0]), 0.25).unwrap();
    let hue = ColorValue::Hsv { value: 1.0, tint: Tint::Hue(120.0), saturation: 1.0, factor: 1.0 };
    let green = builder.color("green", hue, 0.0).unwrap();
    let lamp = builder.spectrum("lamp", &[[400.0, 0.5], [700.0, 1.0]]).unwrap();
    let glass = SurfaceProperties {
        diffuse: 0.1,
        specular: 0.2,
        transmitted: 0.7,
        refraction: 1.5,
        ..SurfaceProperties::default()
    };
    let glass = builder.surface("glass", glass).unwrap();
    let fast = builder.body(Velocity::from_beta(DVec3::new(0.9, 0.0, 0.0)).unwrap());
    assert_eq!(builder.body(Velocity::from_beta(DVec3::new(0.9, 0.0, 0.0)).unwrap()), fast);
    let mesh = Mesh { color: Some(red), surface: Some(glass), body: Some(fast), ..square() };
    let added = builder.mesh(&mesh).unwrap();
    assert_eq!(added, AddedMesh { vertices: 0..4, faces: 0..2, n_degenerate: 0 });
    let whole = Mesh {
        name: "whole",
        corners: &[0, 1, 2, 3],
        sizes: &[4],
        normals: &[DVec3::Z; 4],
        ..square()
    };
    builder.mesh(&Mesh { colors: &[green, red, green, red], ..whole }).unwrap();
    let kind = LightKind::Local {
        position: DVec3::ONE,
        radius: 0.0,
        reference: None,
        beam: Default::default(),
    };
    let motion = LightMotion::Body(fast);
    builder.light(Light { name: None, intensity: 2.0, kind, color: Some(lamp), motion }).unwrap();
    builder.camera(Camera { eye: Some(DVec3::new(0.0, -9.0, 2.0)), ..Camera::default() }).unwrap();
    let scene = builder.finish();
    let text = ugparse::write(&scene);
    let again = parse(str::from_utf8(&text).unwrap());
    assert_eq!(ugparse::write(&again), text);
    assert_eq!((again.faces.len(), again.vertices.len(), again.bodies.len()), (3, 8, 2));
}

#[test]
fn faces_without_area_are_left_out() {
    let mut builder = SceneBuilder::default();
    let corners = [0, 1, 1, 0, 1, 2, 3, 3, 3];
    let added = builder.mesh(&Mesh { corners: &corners, ..square() }).unwrap();
    assert_eq!(added, AddedMesh { vertices: 0..4, faces: 0..1, n_degenerate: 2 });
}

/// Each with the message; nothing is added.
#[test]
fn what_is_incomplete_is_refused() {
    let check = |mesh: Mesh<'_>, message: &str| {
        let mut builder = SceneBuilder::default();
        builder.color("grey", ColorValue::Rgb([0.5; 3]), 0.0).unwrap();
        let error = builder.mesh(&mesh).unwrap_err();
        assert_eq!(error.to_string(), message);
        let scene = builder.finish();
        assert_eq!((scene.vertices.len(), scene.faces.len(), scene.contours.len()), (0, 0, 0));
    };
    check(Mesh { corners: &[0, 1, 4], ..square() }, "corner 2 refers to row 4 of 4");
    check(Mesh { corners: &[0, 1], ..square() }, "2 rows of corners instead of 3");
    check(
        Mesh { corners: &[0, 1, 2], sizes: &[2], ..square() },
        "size of face 0 is out of range: 3 or more",
    );
    check(Mesh { sizes: &[3, u32::MAX], ..square() }, "6 rows of corners instead of 4294967298");
    check(Mesh { normals: &[DVec3::Z], ..square() }, "1 rows of normals instead of 4");
    check(
        Mesh { normals: &[DVec3::ZERO; 4], ..square() },
        "normal 0 is out of range: finite, and not 0",
    );
    check(
        Mesh { positions: &[DVec3::ZERO, DVec3::X, DVec3::NAN], corners: &[0, 1, 2], ..square() },
        "position 2 is out of range: finite",
    );
    check(
        Mesh { color: Some(ColorId::from_index(1)), ..square() },
        "colour of mesh 0 refers to row 1 of 1",
    );
    check(
        Mesh { body: Some(BodyId::from_index(7)), ..square() },
        "body of mesh 0 refers to row 7 of 1",
    );
    check(
        Mesh { name: "4th", ..square() },
        "`4th` is not a name of letters, digits, `:`, `_` and `#` that begins with no digit",
    );
}

#[test]
fn names_are_unique_and_numbers_in_range() {
    let mut builder = SceneBuilder::default();
    let grey = ColorValue::Rgb([0.5; 3]);
    builder.color("grey", grey, 0.0).unwrap();
    assert_eq!(
        builder.color("grey", grey, 0.0),
        Err(BuildError::Repeated { name: "grey".to_owned() })
    );
    for (value, translucency) in [
        (ColorValue::Rgb([0.5, 1.5, 0.0]), 0.0),
        (ColorValue::Xyz([f64::NAN, 0.0, 0.0]), 0.0),
        (ColorValue::Blackbody { kelvin: 0.0, scale: 1.0 }, 0.0),
        (ColorValue::Spectrum { reflects: true, start: 0, end: 9 }, 0.0),
        (grey, 1.5),
    ] {
        let error = builder.color("other", value, translucency).unwrap_err();
        assert!(matches!(error, BuildError::OutOfRange { row: 1, .. }), "{value:?}: {error}");
    }
    assert!(
        builder.spectrum("s", &[[500.0, 1.0], [500.0, 1.0]]).is_err()
            && builder.spectrum("s", &[]).is_err()
    );
    for (transmitted, refraction) in [(1.5, 1.0), (f64::NAN, 1.0), (0.5, 0.0), (0.5, f64::INFINITY)]
    {
        let surface = SurfaceProperties { transmitted, refraction, ..SurfaceProperties::default() };
        assert!(builder.surface("s", surface).is_err());
    }
    let light = |kind| Light {
        name: None,
        intensity: 1.0,
        kind,
        color: None,
        motion: LightMotion::WithWhatItLights,
    };
    assert!(builder.light(light(LightKind::Directional(DVec3::ZERO))).is_err());
    assert!(builder.camera(Camera { eye: Some(DVec3::INFINITY), ..Camera::default() }).is_err());
    assert_eq!(builder.finish().colors.len(), 1);
}
