//! The licence of a scene, and data for other programs, pass through the pipe unchanged.

use glam::DVec3;
use ugtests::pipe::Pipe;
use ugtests::scenes;

/// A scene with a licence in its head comment, as in old files, and with surfaces, which our
/// programs do not use.
const SCENE: &str = "{ A room. Copyright of nobody.\n  { Keep this notice. } }\n{ Second comment. }\n\
    c grey 0.6 ; c_rgb brick 0.7 0.3 0.2 ; surf dull 1 0 0 ; surf shiny 0.25 0.75 0 1 60 ;\n\
    def wall ; surf waxed 0.5 0.5 0 1.5 ;\n\
    v a 0 0 0 ; v b 4 0 0 ; v c 4 0 3 ; v d 0 0 3 ; f front (a b c d) brick waxed ; f (a d c) brick 0.5 ; end ;\n\
    a walls (wall -ta -2 4 -1) 2 -ty 2 ;\n\
    v o -2 3 -1 ; v p 2 3 -1 ; v q 2 9 -1 ; f floor (o p q) grey shiny <0 0.1 0> ; { stays }\n\
    cam -ep 0 0 0 -vc 0 4 0 -ud 0 0 1 -va 60 45 ;\n";

#[test]
fn the_notice_stays_at_the_head_and_surfaces_on_their_faces() {
    let stages = Pipe::new(DVec3::new(0.0, 0.9, 0.0), [64, 48]).run(SCENE.as_bytes());
    let notice = &SCENE[..SCENE.find("c grey").expect("colours")];
    for (name, text, programs) in
        [("uglorentz", &stages.seen, 1), ("ugdoppler", &stages.colored, 2)]
    {
        let text = String::from_utf8_lossy(text);
        assert!(text.starts_with(notice), "{name}: {text}");
        let scene = scenes::parse(text.as_bytes());
        assert_eq!(scene.head.history().len(), programs, "{name}");
        let names: Vec<&str> = scene.surfaces.iter().map(|row| scene.names.get(row.name)).collect();
        assert_eq!(names, ["dull", "shiny", "wall:waxed"], "{name}");
        // Every piece of a face keeps the surface or level of the face.
        let mut n_pieces = [0; 3];
        for face in &scene.faces {
            let is = |end: &str| face.name.is_some_and(|name| scene.names.get(name).ends_with(end));
            let of = |face| scene.surface(face).map(|surface| surface.specular);
            let (kind, light) = if is("front") {
                (0, (Some(0.5), None))
            } else if is("floor") {
                (1, (Some(0.75), None))
            } else {
                (2, (None, Some(0.5)))
            };
            n_pieces[kind] += 1;
            assert_eq!((of(face), scene.light_level(face)), light, "{name}");
        }
        assert!(n_pieces.iter().all(|&n| n > 1), "{name}: faces are cut: {n_pieces:?}");
    }
}

/// Surfaces do not change a picture: such faces are lit like others.
#[test]
fn faces_with_surfaces_are_lit() {
    let pipe = Pipe::new(DVec3::ZERO, [64, 48]);
    let plain = SCENE.replace(" brick waxed ;", " brick ;").replace(" grey shiny <", " grey <");
    assert_ne!(plain, SCENE);
    assert!(pipe.run(SCENE.as_bytes()).file == pipe.run(plain.as_bytes()).file);
    let glowing = SCENE.replace(" brick waxed ;", " brick 0.9 ;");
    assert!(pipe.run(SCENE.as_bytes()).file != pipe.run(glowing.as_bytes()).file);
}
