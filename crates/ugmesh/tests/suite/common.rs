//! Mesh files made byte by byte, and a simplified view of scenes for comparison.

use ugmesh::{Config, Converted, Error, MeshFile, Target};
use ugparse::Source;
use ugscene::{ColorValue, Scene};

/// Converts a mesh with the options of `config`.
pub fn convert(config: &Config, name: &str, bytes: impl Into<Vec<u8>>) -> Result<Converted, Error> {
    ugmesh::run(config, &MeshFile::new(name, bytes))
}

/// Converts a mesh to a scene.
pub fn to_scene(config: &Config, name: &str, bytes: impl Into<Vec<u8>>) -> Scene {
    let converted = convert(config, name, bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
    parse(&converted.bytes)
}

/// Writes a scene in another format.
pub fn to_mesh(target: Target, text: &[u8]) -> Vec<u8> {
    let config = Config { target, ..Config::default() };
    convert(&config, "scene.ug", text).unwrap_or_else(|error| panic!("{error}")).bytes
}

pub fn parse(text: &[u8]) -> Scene {
    let source = Source::new("scene.ug", text);
    ugparse::parse(&source, &ugparse::Options::default())
        .unwrap_or_else(|findings| panic!("{findings}"))
        .scene
}

/// The text of a scene without its head comments.
pub fn statements(scene: &Scene) -> String {
    let mut bare = scene.clone();
    bare.head.comments.clear();
    String::from_utf8(ugparse::write(&bare)).unwrap()
}

/// A corner of a face: position, normal and colour, without the name of the vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    pub position: [f64; 3],
    pub normal: Option<[f64; 3]>,
    pub rgba: Option<[f64; 4]>,
}

/// The corners of all faces.
pub fn seen(scene: &Scene) -> Vec<Vec<Corner>> {
    let rgba = |id: ugscene::ColorId| {
        let color = &scene.colors[id.index()];
        let ColorValue::Rgb([red, green, blue]) = color.value else { panic!("no c_rgb") };
        [red, green, blue, 1.0 - color.translucency]
    };
    let corner = |face: &ugscene::Face, id: &ugscene::VertexId| {
        let vertex = &scene.vertices[id.index()];
        Corner {
            position: vertex.position.to_array(),
            normal: vertex.normal.map(|normal| normal.to_array()),
            rgba: vertex.color.or(face.color).map(rgba),
        }
    };
    let outline = |face: &ugscene::Face| scene.face_contours(face).next().unwrap().to_vec();
    scene
        .faces
        .iter()
        .map(|face| outline(face).iter().map(|id| corner(face, id)).collect())
        .collect()
}

/// A GLB file.
pub fn glb(json: &str, bin: &[u8]) -> Vec<u8> {
    let chunk = |kind: &[u8; 4], data: &[u8], pad: u8| {
        let mut data = data.to_vec();
        data.resize(data.len().next_multiple_of(4), pad);
        [&(data.len() as u32).to_le_bytes(), &kind[..], &data].concat()
    };
    let chunks = [chunk(b"JSON", json.as_bytes(), b' '), chunk(b"BIN\0", bin, 0)].concat();
    [&b"glTF"[..], &2u32.to_le_bytes(), &(12 + chunks.len() as u32).to_le_bytes(), &chunks].concat()
}

pub fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// A triangle mesh in a GLB file, with the nodes of `nodes`; the first scene begins with node 0.
/// Positions (0 0 0), (1 1 1), (0 1 0), each with the normal (1 1 0)/√2.
pub fn glb_with_nodes(nodes: &str) -> Vec<u8> {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let positions = floats(&[0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 0.0]);
    let normals = floats(&[half, half, 0.0, half, half, 0.0, half, half, 0.0]);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":{nodes},
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1}}}}]}}],
        "accessors":[
          {{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},
          {{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":36}}],
        "buffers":[{{"byteLength":72}}]}}"#
    );
    glb(&json, &[positions, normals].concat())
}

/// The encoding of a PLY file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Encoding {
    Ascii,
    Little,
    Big,
}

/// Two faces of five vertices with colours and normals.
pub fn ply(encoding: Encoding) -> Vec<u8> {
    let format = match encoding {
        Encoding::Ascii => "ascii",
        Encoding::Little => "binary_little_endian",
        Encoding::Big => "binary_big_endian",
    };
    let mut bytes = format!(
        "ply\nformat {format} 1.0\ncomment free for all\nelement vertex 5\n\
         property float x\nproperty float y\nproperty double z\n\
         property float nx\nproperty float ny\nproperty float nz\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\nproperty short quality\n\
         element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let mut write = |text: String, little: Vec<u8>| match encoding {
        Encoding::Ascii => bytes.extend_from_slice(format!("{text} ").as_bytes()),
        Encoding::Little => bytes.extend_from_slice(&little),
        Encoding::Big => bytes.extend(little.iter().rev()),
    };
    let places = [[0f32, 0., 0.], [1., 0., 0.1], [1., 1., -0.3], [0., 1., 1e-7], [0.5, 2., 0.]];
    for (row, [x, y, z]) in places.into_iter().enumerate() {
        let z = f64::from(z) / 3.0;
        let rest = [0.0, 0.6f32, 0.8];
        [x, y].into_iter().for_each(|n| write(n.to_string(), n.to_le_bytes().into()));
        write(z.to_string(), z.to_le_bytes().into());
        rest.into_iter().for_each(|n| write(n.to_string(), n.to_le_bytes().into()));
        [255u8, 51 * row as u8, 0].into_iter().for_each(|n| write(n.to_string(), vec![n]));
        write("-7".to_string(), (-7i16).to_le_bytes().into());
        if encoding == Encoding::Ascii {
            write("\n".to_string(), Vec::new());
        }
    }
    for face in [&[0i32, 1, 2, 3][..], &[3, 2, 4]] {
        write(face.len().to_string(), vec![face.len() as u8]);
        face.iter().for_each(|n| write(n.to_string(), n.to_le_bytes().into()));
        if encoding == Encoding::Ascii {
            write("\n".to_string(), Vec::new());
        }
    }
    bytes
}

const TETRAHEDRON: [[[f32; 3]; 3]; 4] = [
    [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.1, 0.2, 0.3]],
    [[0.0, 0.0, 0.0], [0.1, 0.2, 0.3], [0.0, 1.0, 0.0]],
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.1, 0.2, 0.3]],
];

/// A tetrahedron as ASCII STL, in two solids, the second without a name, as some exporters write.
pub fn stl_text() -> Vec<u8> {
    let facet = |corners: &[[f32; 3]; 3]| {
        let vertex = |[x, y, z]: &[f32; 3]| format!("vertex {x:e} {y:e} {z:e}\n");
        let corners: String = corners.iter().map(vertex).collect();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    let [first, rest @ ..] = &TETRAHEDRON;
    let rest: String = rest.iter().map(facet).collect();
    format!("solid a name\n{}endsolid a name\nsolid\n{rest}endsolid\n", facet(first)).into_bytes()
}

/// The same tetrahedron as binary STL, with a header that looks like ASCII STL, as some exporters
/// write.
pub fn stl_binary() -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes[..6].copy_from_slice(b"solid ");
    bytes.extend(4u32.to_le_bytes());
    for corners in TETRAHEDRON {
        bytes.extend(floats(&[0.0; 3]));
        bytes.extend(floats(&corners.concat()));
        bytes.extend([0, 0]);
    }
    bytes
}
