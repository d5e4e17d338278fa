//! Damaged files cause an error message, quickly and without a panic.

use ugmesh::{Config, Target};

use crate::common::{Encoding, convert, glb, glb_with_nodes, ply, stl_binary, stl_text, to_mesh};

const SCENE: &str =
    "c red 1 0; v a 0 0 0 red 0 0 1; v b 1 0 0 0 0 1; v c 0 1 0; v d 9 9 9; f (a b c d); f (a b d) red;";

/// One file of every kind that can be read.
fn samples() -> Vec<(&'static str, Vec<u8>)> {
    let sparse = |bytes: Vec<u8>| {
        let text = String::from_utf8_lossy(&bytes[20..]).into_owned();
        let json = &text[..=text.rfind('}').expect("JSON")];
        let sparse = r#""count":3,"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":1}},"#;
        glb(&json.replacen(r#""count":3,"#, sparse, 1), &[0; 72])
    };
    let nodes = r#"[{"children":[1],"rotation":[0,0,1,0]},{"mesh":0,"scale":[2,3,4]}]"#;
    let scene = SCENE.as_bytes();
    vec![
        (
            "a.obj",
            b"mtllib m\nv 0 0 0 1 1 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nusemtl a\nf 1//1 2//1 -1//-1\nl 1 2\\\n3"
                .to_vec(),
        ),
        ("a.obj", to_mesh(Target::Obj, scene)),
        (
            "a.off",
            b"CNOFF\n3 1 0\n0 0 0 0 0 1 0 255 0\n1 0 0 0 0 1 0 0 0\n0 1 0 0 0 1 0 0 0\n3 0 1 2 1.0 0 0 1"
                .to_vec(),
        ),
        ("a.ply", ply(Encoding::Ascii)),
        ("a.ply", ply(Encoding::Little)),
        ("a.ply", ply(Encoding::Big)),
        ("a.ply", to_mesh(Target::Ply { is_ascii: false }, scene)),
        ("a.stl", stl_text()),
        ("a.stl", stl_binary()),
        ("a.glb", glb_with_nodes(nodes)),
        ("a.glb", sparse(glb_with_nodes(nodes))),
        ("a.gltf", to_mesh(Target::Gltf, scene)),
        ("a.glb", to_mesh(Target::Glb, scene)),
    ]
}

/// All samples are valid, so that the other tests really damage something.
#[test]
fn samples_are_read() {
    for (name, bytes) in samples() {
        let found = convert(&Config::default(), name, bytes.clone());
        assert!(found.is_ok(), "{name}: {}\n{}", found.unwrap_err(), String::from_utf8_lossy(&bytes));
    }
}

#[test]
fn truncated_files_are_harmless() {
    for (name, bytes) in samples() {
        for len in 0..bytes.len() {
            let _ = convert(&Config::default(), name, &bytes[..len]);
        }
    }
}

/// Numbers that a damaged file may contain where a small one is expected.
const NUMBERS: &str = "-1 0 255 65536 4294967295 4294967296 9223372036854775807 18446744073709551615 \
                       -9223372036854775808 1e999 nan 1000000000000";

/// Replaces every number of a text by each of these, one at a time.
#[test]
fn absurd_numbers_are_harmless() {
    for (name, bytes) in samples() {
        let is_digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
        let starts = (0..bytes.len()).filter(|&at| is_digit(at) && (at == 0 || !is_digit(at - 1)));
        for start in starts {
            let end = (start..).find(|&at| !is_digit(at)).unwrap();
            for number in NUMBERS.split(' ') {
                let mut changed = [&bytes[..start], number.as_bytes(), &bytes[end..]].concat();
                if changed.starts_with(b"glTF") {
                    // The lengths of the file and of the JSON chunk change, too.
                    let grown = (number.len() as i64) - (end - start) as i64;
                    for at in [8, 12] {
                        let length = u32::from_le_bytes(changed[at..at + 4].try_into().unwrap());
                        let length = (i64::from(length) + grown) as u32;
                        changed[at..at + 4].copy_from_slice(&length.to_le_bytes());
                    }
                }
                let _ = convert(&Config::default(), name, changed);
            }
        }
    }
}
