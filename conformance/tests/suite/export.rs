//! The OBJ files and tables for other renderers agree with the scenes in UniGrafix.

use std::collections::{BTreeMap, BTreeSet};

use ugconformance::picture::{CASES, PictureCase, cameras, objects};
use ugphoton::Lens;
use ugscene::{Scene, Tint};

/// The corners of a polygon and the name of its object.
type Polygon = (Vec<[f64; 3]>, String);

fn scene(case: &PictureCase) -> Scene {
    let source = ugparse::Source::new(case.name, case.scene);
    ugparse::parse(&source, &ugparse::Options::default()).expect("a scene without errors").scene
}

fn numbers<'t>(words: impl Iterator<Item = &'t str>) -> Vec<f64> {
    words.map(|word| word.parse().unwrap_or_else(|_| panic!("`{word}` is a number"))).collect()
}

/// Reads vertices, materials and polygons of OBJ.
fn polygons_of_obj(text: &str) -> Vec<Polygon> {
    let (mut vertices, mut material, mut polygons) = (Vec::new(), String::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split(' ');
        match words.next() {
            Some("v") => {
                vertices.push(<[f64; 3]>::try_from(numbers(words.take(3))).expect("three numbers"))
            }
            Some("usemtl") => material = words.next().expect("a name").to_string(),
            Some("f") => {
                let corners = words.map(|word| vertices[word.parse::<usize>().expect("a row") - 1]);
                polygons.push((corners.collect(), material.clone()));
            }
            Some("#") => {}
            other => panic!("OBJ for all programs has no `{other:?}`"),
        }
    }
    polygons
}

fn polygons_of_scene(scene: &Scene) -> Vec<Polygon> {
    let polygon = |face: &ugscene::Face| {
        let [outline] = scene.face_contours(face).collect::<Vec<_>>()[..] else { panic!("a hole") };
        let corners =
            outline.iter().map(|corner| scene.vertices[corner.index()].position.to_array());
        let color = &scene.colors[face.color.expect("a colour").index()];
        (corners.collect(), scene.names.get(color.name).to_string())
    };
    scene.faces.iter().map(polygon).collect()
}

/// Rows of a table by the case, and by the object if there is one; the cells after these.
fn rows(table: &str, n_keys: usize) -> BTreeMap<String, Vec<String>> {
    let n_columns = table.lines().next().expect("a head").split(',').count();
    let mut rows = BTreeMap::new();
    for line in table.lines().skip(1) {
        let cells: Vec<String> = line.split(',').map(str::to_string).collect();
        assert_eq!(cells.len(), n_columns, "{line}");
        let key = cells[..n_keys].join(" ");
        assert!(rows.insert(key.clone(), cells[n_keys..].to_vec()).is_none(), "{key} has one row");
    }
    rows
}

#[test]
fn meshes_have_the_vertices_of_the_scenes() {
    let mut n_polygons = 0;
    for case in &CASES {
        let obj = String::from_utf8(case.mesh().unwrap()).unwrap();
        let polygons = polygons_of_obj(&obj);
        assert_eq!(polygons, polygons_of_scene(&scene(case)), "{}", case.name);
        n_polygons += polygons.len();
    }
    assert!(n_polygons > 7000, "{n_polygons}");
}

#[test]
fn tables_have_the_velocities_and_colours_of_the_scenes() {
    let table = objects().unwrap();
    let table = rows(&table, 2);
    let mut used = BTreeSet::new();
    for case in &CASES {
        let scene = scene(case);
        for face in &scene.faces {
            let color = &scene.colors[face.color.unwrap().index()];
            let key = format!("{} {}", case.name, scene.names.get(color.name));
            let cells = table.get(&key).unwrap_or_else(|| panic!("{key} has a row"));
            let velocity = numbers(cells[..3].iter().map(String::as_str));
            assert_eq!(velocity, scene.bodies.velocity(face.body).beta().to_array(), "{key}");
            if let ugscene::ColorValue::Hsv { tint: Tint::Hue(hue), saturation: 1.0, .. } =
                color.value
            {
                assert_eq!(cells[4], format!("{hue:?}"), "{key}");
            }
            used.insert(key);
        }
    }
    assert_eq!(used.len(), table.len(), "every row is an object");
    // The wavelengths that the README states.
    let nm = |key: &str| table[key][5].parse::<f64>().unwrap();
    for (key, expected) in
        [("wide red", 700.0), ("shift rest", 600.0 / 1.1), ("shift coming", 600.0)]
    {
        assert!((nm(key) - expected).abs() < 1e-6, "{key}: {}", nm(key));
    }
    assert_eq!(table["blackbody b1"][3], "blackbody 3000.0 2.5741664");
}

#[test]
fn tables_have_the_cameras_of_the_scenes() {
    let table = cameras().unwrap();
    let table = rows(&table, 1);
    assert_eq!(table.len(), CASES.len());
    for case in &CASES {
        let scene = scene(case);
        let camera = scene.camera().unwrap();
        let vectors =
            [camera.eye, camera.center, camera.up].map(|vector| vector.unwrap().to_array());
        let size = case.size.map(f64::from);
        let expected = [&size[..], vectors.as_flattened()].concat();
        let (lens, view) = match case.lens {
            Lens::Panorama => ("equirectangular", 360.0),
            _ => ("pinhole", camera.view_angle.unwrap()[0]),
        };
        let cells = &table[case.name];
        assert_eq!(numbers(cells[..11].iter().map(String::as_str)), expected, "{}", case.name);
        assert_eq!(cells[11..], [lens.to_string(), format!("{view:?}")], "{}", case.name);
    }
}
