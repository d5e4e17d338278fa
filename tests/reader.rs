//! Compares the reader of scenes with a slow, independent one that was written from the language
//! page (see [`ugtests::slow_reader`]), and its results on several threads with those on one.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeMap;
use std::fmt::Debug;

use proptest::prelude::*;
use ugphysics::Velocity;
use ugscene::{BodyId, ColorId, ColorValue, LightKind, NameId, Projection, Scene, VertexId};
use ugtests::scenes;
use ugtests::slow_reader::{
    self, Camera, Face, Flat, Light, Motion, MotionOptions, Paint, Timed, Triple, Vertex, Wire,
};

/// Relative to the largest coordinate: the two readers multiply matrices in different orders, which
/// causes a few rounding errors per transformation.
const TOLERANCE: f64 = 1e-12;

/// Converts a scene to the types of the slow reader.
fn flat(scene: &Scene) -> Flat {
    let text = |id: NameId| scene.names.get(id).to_string();
    let name = |id: Option<NameId>| id.map(text);
    let velocity = |velocity: Velocity| Motion::Velocity(velocity.beta().to_array());
    let named = |body: BodyId| scene.bodies[body].name.map(|name| Motion::Named(text(name)));
    let motion = |body: BodyId| named(body).or_else(|| scene.bodies.stated_velocity(body).map(velocity));
    let color = |id: Option<ColorId>| {
        if let Some(table) = scene.table_of(id?) {
            let name = |color: ColorId| text(scene.colors[color.index()].name);
            let rows = table.rows.iter().map(|&(time, color)| (time, name(color))).collect();
            let (is_stepped, period) = (table.is_stepped, table.period);
            return Some(Paint::Timed(Timed { is_stepped, period, rows }));
        }
        let color = &scene.colors[id?.index()];
        Some(match color.value {
            ColorValue::Hsv { value, tint, saturation, factor } => {
                Paint::Hsv([value, tint.number(), saturation, color.translucency, factor])
            }
            ColorValue::Rgb([r, g, b]) => Paint::Rgb([r, g, b, color.translucency]),
            ColorValue::Xyz([x, y, z]) => Paint::Xyz([x, y, z, color.translucency]),
            ColorValue::Blackbody { kelvin, scale } => Paint::Blackbody([kelvin, scale]),
            ColorValue::Spectrum { start, end } => {
                Paint::Spectrum(scene.samples[start as usize..end as usize].as_flattened().to_vec())
            }
        })
    };
    let vertex_name = |id: &VertexId| text(scene.vertices[id.index()].name);
    let contour = |contour: &[VertexId]| contour.iter().map(vertex_name).collect();
    let vertices = scene.vertices.iter().map(|vertex| Vertex {
        name: text(vertex.name),
        position: vertex.position.to_array(),
        color: vertex.color.map(|id| text(scene.colors[id.index()].name)),
        normal: vertex.normal.map(|normal| normal.to_array()),
    });
    let faces = scene.faces.iter().map(|face| Face {
        name: name(face.name),
        contours: scene.face_contours(face).map(contour).collect(),
        color: color(face.color),
        illum: scene.light_level(face),
        surface: scene
            .surface(face)
            .map(|s| [s.diffuse, s.specular, s.transmitted, s.refraction, s.exponent, s.absorption]),
        motion: motion(face.body),
    });
    let wires = scene.wires.iter().map(|wire| Wire {
        name: name(wire.name),
        contours: scene.wire_contours(wire).map(contour).collect(),
        color: color(wire.color),
        motion: motion(wire.body),
    });
    let lights = scene.lights.iter().map(|light| {
        let (place, radius, reference) = match light.kind {
            LightKind::Ambient => (None, None, None),
            LightKind::Directional(toward) => (Some(toward.to_array()), None, None),
            LightKind::Local { position, radius, reference } => {
                (Some(position.to_array()), Some(radius), reference)
            }
        };
        let (name, color) = (name(light.name), color(light.color));
        let motion = light.motion.body().and_then(motion);
        Light { name, intensity: light.intensity, place, radius, reference, color, motion }
    });
    let cameras = scene.cameras.iter().map(|camera| Camera {
        name: name(camera.name),
        options: camera_options(camera),
        motion: camera.carrier.and_then(named).or_else(|| camera.velocity.map(velocity)),
    });
    Flat {
        vertices: vertices.collect(),
        faces: faces.collect(),
        wires: wires.collect(),
        lights: lights.collect(),
        cameras: cameras.collect(),
        escapes: scene.remarks.escapes.clone(),
        motions: BTreeMap::new(),
    }
}

fn camera_options(camera: &ugscene::Camera) -> BTreeMap<String, Vec<f64>> {
    let projection = camera.projection.map(|projection| match projection {
        Projection::Orthographic => "-og",
        Projection::Perspective => "-ps",
    });
    let options = [
        ("-ep", camera.eye.map(|eye| eye.to_array().to_vec())),
        ("-vc", camera.center.map(|center| center.to_array().to_vec())),
        ("-ud", camera.up.map(|up| up.to_array().to_vec())),
        ("-cl", camera.clip.map(|clip| clip.to_vec())),
        ("-ph", camera.film.map(|film| film.to_vec())),
        ("-va", camera.view_angle.map(|angles| angles.to_vec())),
        ("-fs", camera.film_size.map(|size| size.to_vec())),
        ("-fl", camera.focal_length.map(|length| vec![length])),
        (projection.unwrap_or_default(), projection.map(|_| Vec::new())),
    ];
    let given = |(option, numbers): (&str, Option<Vec<f64>>)| Some((option.to_string(), numbers?));
    options.into_iter().filter_map(given).collect()
}

/// Compares lists row by row: `take` removes positions and directions, which are compared with a
/// tolerance; the rest must be equal.
#[track_caller]
fn assert_rows<T: Clone + Debug + PartialEq>(ours: &[T], slow: &[T], take: impl Fn(&mut T) -> Vec<f64>) {
    let size = slow.iter().flat_map(|row| take(&mut row.clone())).fold(0.0, |size: f64, x| size.max(x.abs()));
    for (idx, (ours, slow)) in ours.iter().zip(slow).enumerate() {
        let (mut exact, mut slow_exact) = (ours.clone(), slow.clone());
        let (close, slow_close) = (take(&mut exact), take(&mut slow_exact));
        let agree = close.iter().zip(&slow_close).all(|(a, b)| (a - b).abs() <= TOLERANCE * size);
        let alike = exact == slow_exact && close.len() == slow_close.len() && agree;
        assert!(alike, "row {idx}:\n{ours:?}\nmust be\n{slow:?}");
    }
    assert_eq!(ours.len(), slow.len(), "rows");
}

/// Takes out the numbers of a position or direction, if there is one.
fn take_triple(triple: &mut Option<Triple>) -> Vec<f64> {
    triple.as_mut().map_or_else(Vec::new, |triple| std::mem::take(triple).to_vec())
}

/// Asserts that both readers give the same scene.
#[track_caller]
fn check(text: &str) -> Flat {
    let slow = slow_reader::read(text);
    let ours = flat(&scenes::parse(text.as_bytes()));
    assert_rows(&ours.vertices, &slow.vertices, |vertex| {
        take_triple(&mut vertex.normal);
        std::mem::take(&mut vertex.position).to_vec()
    });
    let normals = |flat: &Flat| -> Vec<Option<Triple>> { flat.vertices.iter().map(|v| v.normal).collect() };
    assert_rows(&normals(&ours), &normals(&slow), take_triple);
    assert_rows(&ours.faces, &slow.faces, |_| Vec::new());
    assert_rows(&ours.wires, &slow.wires, |_| Vec::new());
    assert_rows(&ours.lights, &slow.lights, |light| {
        light.reference = light.reference.map(|_| 1.0);
        take_triple(&mut light.place)
    });
    // Lengths are scaled by a cube root, so they agree relative to themselves only.
    for (ours, slow) in ours.lights.iter().zip(&slow.lights) {
        let near = |(ours, slow): (f64, f64)| (ours - slow).abs() <= 1e-9 * slow;
        assert!(ours.reference.zip(slow.reference).is_none_or(near), "{ours:?}\nmust be\n{slow:?}");
    }
    assert_rows(&ours.cameras, &slow.cameras, |camera| {
        let places = ["-ep", "-vc", "-ud"].map(|option| camera.options.get_mut(option).map(std::mem::take));
        places.into_iter().flatten().flatten().collect()
    });
    assert_eq!(ours.escapes, slow.escapes, "escapes");
    check_motions(text, &slow);
    slow
}

/// Asserts that motions are written as they were read, apart from numbers that are the default.
#[track_caller]
fn check_motions(text: &str, slow: &Flat) {
    if slow.motions.is_empty() {
        return;
    }
    let written = ugparse::write(&scenes::parse(text.as_bytes()));
    let written = slow_reader::read(&String::from_utf8_lossy(&written));
    let number =
        |word: &String| word.parse::<f64>().map_or_else(|_| word.clone(), |number| number.to_string());
    let plain = |options: &MotionOptions| -> MotionOptions {
        let is_default = |words: &[String]| words.iter().all(|word| word == "0" || word == "|");
        let options = options
            .iter()
            .map(|(option, words)| (option.clone(), words.iter().map(number).collect::<Vec<_>>()));
        let stays = |(option, words): &(String, Vec<String>)| {
            !(matches!(&option[..], "-at" | "-vel" | "-shift") && is_default(words))
        };
        options.filter(stays).collect()
    };
    let all = |flat: &Flat| -> Vec<(String, MotionOptions)> {
        flat.motions.iter().map(|(name, options)| (name.clone(), plain(options))).collect()
    };
    assert_eq!(all(slow), all(&written), "motions");
}

#[test]
fn both_readers_agree_on_our_scenes() {
    let names = scenes::names();
    assert!(names.len() >= 9, "{} scenes", names.len());
    for name in names {
        println!("{name}");
        assert!(!check(&String::from_utf8_lossy(&scenes::text(&name))).faces.is_empty(), "{name} has faces");
    }
}

/// Every statement and option of the language.
const ALL: &str = "\
{ head { nested } ; } ;;
# 1 \"lines.ug\"
( escape ; { not a comment ( nested ) ) (another)
i early (tile late -tx 1) ; { what it uses comes later }
f unlit (v f end) 0.5; f(v i f)late;
f (v f i) sky glossy ; surf glossy .5 .5 0 1 60 ; surf late 1 0 .5 ; surf clear 0 .1 .9 1.5 20 .25 ;
f (v f end) late late <.5 0 0> ;
c_xyz haze 1.5 2 .25 0.5 ; c_bb sun 5800 ; c_bb lamp 2700 .5 ; c_spd sodium 588 0 589 2.5 590 0 ; c_xyz void 0 0 0 ;
f (v f end) haze ; f (v f end) sun ; f (v f end) lamp ; f (v f end) sodium ; f (v f end) void ;
c late 2 -30 ; c 0.25 ; c_rgb sky 0.1 0.2 0.9 0.5 ; c_rgb night 0 0 .25 ; c full 1 400 0.5 0.25 ;
v v 0 0 0 ; v f 5 -0 0 ; v end +1 5. 0 sky ; v i 0 .5 1e+0 sky 0 0 -2 ; v def -2.5E-1 1 1 0 1 1 ;
v p1 1 1 0 ; v p2 2 1 0 ; v p3 1 2 0 ; v A 9 0 0 ; v a 0 9 0 ; v :c#1 0 0 9 ;
f(v f end)(p1 p2 p3)<0.1 0.2 -0.3>;
f own (A a :c#1) full 0.75 <0 0 0> ;
f line (v f A) ;        { no area }
f (v f v) ; f thin (v f end) (p1 p2 p1) ;
w w (v f) (f v i f) late <0 0 .5> ; w (v v) ; w short (v) ; w (a A) ;
l 0.3 ; l sun 0.7 1 -1 2 ; l lamp 2 0 0 5 0.1 sky ; l 0 0 0 1 late <0 .5 0> ; l point 1 1 2 3 0 ; l 1 sky ;
cam -ep 0 -12 3 -vc 0 0 0 -ud 0 0 1 -ps -va 40 30 -og ;
cam cam -fs 2 1 -fl 3 -ph 0.1 0.2 0.8 0.9 -cl 1 100 -ep 1 1 1 -og -ep 2 2 2 -ps <0 0 .9> ;
cam ;
c_rgb 0.5 0.25 0.125 ;
def tile ;
  v a 0 0 0 ; v b 1 0 0 ; v c 1 1 0 night 1 2 3 ; v d 0 1 0 full ;
  f first (a b c d) ; c 0.75 60 ; f second (c b a) ; f own (a b d) late ; f fast (b c d) <.5 0 0> ;
  w edge (a b c) ; w (d a) sky <.25 0 0> ;
  ( once )
end ;
f after (v f end) ;   { the unnamed colour of the scene, not of the definition }
i (tile) ; i (tile) ; i early (tile) ; i tile_2 (tile) ;
i tx (tile -tx 1 -ty 2 -tz 3) ; i ta (tile -ta 1 2 3) ; i tv (tile -tv 1 2 2 6) ;
i s (tile -sx 2 -sy 3 -sz 4) ; i sa (tile -sa -2) ; i sv (tile -sv 1 2 -2 3) ; i sn (tile -sx -1) ;
i r (tile -rx 90 -ry 45 -rz -30) ; i ra (tile -ra 10 20 30) ; i rv (tile -rv 1 1 1 120) ;
i order (tile -tx 1 -rz 90) ; i turns (tile -rx 450 -ry -180 -rz 270) ;
i mx (tile -mx) ; i my (tile -my -ty 3) ; i mz (tile -mz -mx) ; i ma (tile -ma) ; i mv (tile -mv 1 1 0) ;
i m3 (tile -M3 1 2 3 0 1 4 5 6 1) ; i m4 (tile -M4 0 1 0 0 -1 0 0 0 0 0 1 0 7 8 9 1) ;
i m3n (tile -M3 -1 0 0 0 1 0 0 0 1 -mx) ;
i still (tile) <0 0 0> ; i going (tile sky) <.25 .5 0> ;
def squashed ; v a 0 0 0 ; v b 1 0 0 ; v c 1 0 1 ; f standing (a b c) ; w (a c) ; end ;
i flat (squashed -sz 0) ; i upright (squashed) ;
a floor (tile night -tx -4) 3 -tx 1.1 -rz 10 <0 .125 0> ;
a (tile) 2 -ty 5 ; a (tile) 2 -mx -ty 5 ; a none (tile) 0 -tz 1 ; a one (tile) 1 ;
def car ;
  c late 0.125 ; c inner 0.5 90 1 ; surf clear 0 0 1 ;
  v a 0 0 0 late ; v b 1 0 0 inner ; v c 0 1 0 sky ;
  f body (a b c) late clear ; f (c b a) ; f (c b a) inner late ;
  i lamp (lamp -tz 1) ; i wheel (tile inner -rx 90) <.1 0 0> ; i (plain) ;
  def lamp ;
    v a 0 0 0 inner ; v b 1 0 0 ; v c 0 1 0 ; f glass (a b c) 0.9 ;
    l bulb 1 0 0 1 0.25 2 inner ; l beam 1 0 1 0 late ; l 0.125 ; l moving 1 0 0 1 <.1 .2 .3> ;
    cam driver -ep 0 0 1 -vc 5 0 1 -ud 0 0 1 -va 60 40 ;
    cam -og <.1 0 0> ;
  end ;
  def tile ; v t 0 0 0 ; v u 1 0 0 ; v v 0 1 0 ; f hides (t u v) ; ( inner once ) end ;
  def plain ; c 0.0625 ; end ;
end ;
i car (car) ; i car (car late -rz 30 -tx 2) <.2 .2 .2> ; a cars (car -mx) 2 -ty 3 -sa 0.5 ;
def rows ; a (row) 2 -ty 1 ; def row ; a (tile) 3 -tx 1 <.3 0 0> ; end ; end ;
a grid (rows) 2 -tz 1 ; i rows (rows) <0 .3 0> ; i (rows sky) ;
def mixed ; a (tile) 2 -tx 1 ; i (tile -tz 1) ; a again (rows) 1 ; end ;
i mixed (mixed -rv 1 2 3 40) ;
def unused ; v a 0 0 0 ; (never) end ;
v car:a 1 2 3 ;
";

#[test]
fn both_readers_agree_on_every_statement() {
    let slow = check(ALL);
    assert!(slow.faces.len() > 200 && slow.lights.len() > 15 && slow.cameras.len() > 10, "{slow:?}");
    let slow = check(
        "motion ship -path (-1 0 0 0  { then } 1 .5 -.5 0\n 4 1 .25 1e-1) -spin 0 0 .1; motion part -on ship;
         v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) <ship>; f (c b a) <part>;",
    );
    assert_eq!(slow.motions["ship"]["-path"].len(), 15);
}

// Random scenes. A strategy generates a tree of statements whose names are numbers; `Writer`
// converts these to names that are visible in their scope.

/// A statement of a random scene.
#[derive(Clone, Debug)]
enum Statement {
    Vertex {
        position: [f64; 3],
        color: Option<usize>,
        normal: Option<[f64; 3]>,
    },
    Face {
        name: Option<usize>,
        contours: Vec<Vec<usize>>,
        color: Option<usize>,
        illum: Illum,
        tail: Tail,
    },
    Wire {
        name: Option<usize>,
        contours: Vec<Vec<usize>>,
        color: Option<usize>,
        tail: Tail,
    },
    Color {
        is_named: bool,
        keyword: &'static str,
        numbers: Vec<f64>,
    },
    Surface(Vec<f64>),
    Light {
        name: Option<usize>,
        numbers: Vec<f64>,
        color: Option<usize>,
        tail: Tail,
    },
    Camera {
        name: Option<usize>,
        options: Vec<String>,
        tail: Tail,
    },
    Placed {
        name: Option<usize>,
        definition: usize,
        color: Option<usize>,
        first: Vec<String>,
        array: Option<(usize, Vec<String>)>,
        tail: Tail,
    },
    Definition(Vec<Statement>),
}

/// The light level or surface of a face; a surface requires a colour.
#[derive(Clone, Copy, Debug)]
enum Illum {
    None,
    Level(f64),
    Surface(usize),
}

/// The velocity of a statement.
type Tail = Option<[f64; 3]>;

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![(-5..=5i32).prop_map(f64::from), -10.0..10.0]
}

/// Three numbers, none of them 0.
fn direction() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(prop_oneof![0.1..3.0, -3.0..-0.1])
}

fn tail() -> impl Strategy<Value = Tail> {
    prop_oneof![3 => Just(None), 1 => Just(Some([0.0; 3])), 2 => prop::array::uniform3(-0.5..0.5).prop_map(Some)]
}

fn some<S: Strategy>(strategy: S) -> impl Strategy<Value = Option<S::Value>> {
    prop::option::of(strategy)
}

fn contours(least: usize) -> impl Strategy<Value = Vec<Vec<usize>>> {
    prop::collection::vec(prop::collection::vec(0..100usize, least..6), 1..3)
}

fn words(numbers: &[f64]) -> String {
    numbers.iter().map(|number| format!(" {number}")).collect()
}

/// Transformations, none of them singular.
fn transformations() -> impl Strategy<Value = Vec<String>> {
    let axis = prop::sample::select(vec!['x', 'y', 'z']);
    let degrees = prop_oneof![(-5..=5i32).prop_map(|turns| 90.0 * f64::from(turns)), -400.0..400.0];
    let scale = prop_oneof![0.5..2.0, -2.0..-0.5];
    let step = prop_oneof![
        (axis.clone(), number()).prop_map(|(axis, d)| format!("-t{axis} {d}")),
        prop::array::uniform3(number()).prop_map(|by| format!("-ta{}", words(&by))),
        (direction(), number()).prop_map(|(v, d)| format!("-tv{} {d}", words(&v))),
        (axis.clone(), scale.clone()).prop_map(|(axis, k)| format!("-s{axis} {k}")),
        scale.clone().prop_map(|k| format!("-sa {k}")),
        (direction(), scale).prop_map(|(v, k)| format!("-sv{} {k}", words(&v))),
        (axis.clone(), degrees.clone()).prop_map(|(axis, angle)| format!("-r{axis} {angle}")),
        prop::array::uniform3(degrees.clone()).prop_map(|angles| format!("-ra{}", words(&angles))),
        (direction(), degrees).prop_map(|(v, angle)| format!("-rv{} {angle}", words(&v))),
        axis.prop_map(|axis| format!("-m{axis}")),
        Just("-ma".to_string()),
        direction().prop_map(|v| format!("-mv{}", words(&v))),
        prop::array::uniform9(-0.3..0.3).prop_map(|small| format!("-M3{}", words(&near_identity(small)))),
        (prop::array::uniform9(-0.3..0.3), prop::array::uniform3(number())).prop_map(|(small, by)| {
            let rows = near_identity(small);
            let rows: String = rows.chunks(3).map(|row| format!("{} 0", words(row))).collect();
            format!("-M4{rows}{} 1", words(&by))
        }),
    ];
    let in_words = |step: String| step.split(' ').map(str::to_string).collect::<Vec<_>>();
    prop::collection::vec(step.prop_map(in_words), 0..3).prop_map(|steps| steps.concat())
}

fn near_identity(mut small: [f64; 9]) -> [f64; 9] {
    [0, 4, 8].into_iter().for_each(|idx| small[idx] += 1.0);
    small
}

fn color_statement() -> impl Strategy<Value = Statement> {
    let part = || 0.0..=1.0;
    let numbers = prop_oneof![
        (0.0..2.0).prop_map(|l| ("c", vec![l])),
        (0.0..2.0, number()).prop_map(|(l, h)| ("c", vec![l, h])),
        (0.0..2.0, -400.0..800.0, part()).prop_map(|(l, h, s)| ("c", vec![l, h, s])),
        (part(), number(), part(), part()).prop_map(|(l, h, s, t)| ("c", vec![l, h, s, t])),
        (prop::array::uniform3(part()), number(), 0.0..9.0)
            .prop_map(|([l, s, t], h, factor)| ("c", vec![l, h, s, t, factor])),
        prop::array::uniform3(part()).prop_map(|rgb| ("c_rgb", rgb.to_vec())),
        prop::array::uniform4(part()).prop_map(|rgbt| ("c_rgb", rgbt.to_vec())),
        prop::array::uniform4(part()).prop_map(|xyzt| ("c_xyz", xyzt.to_vec())),
    ];
    (any::<bool>(), numbers).prop_map(|(is_named, (keyword, numbers))| Statement::Color {
        is_named,
        keyword,
        numbers,
    })
}

fn surface() -> impl Strategy<Value = Statement> {
    let last = some((0.5..2.0, some((0.0..90.0, some(0.0..3.0)))));
    ([0.0..1.5, 0.0..1.5, 0.0..1.0], last).prop_map(|(numbers, last)| {
        let (n, last) = last.map_or((None, None), |(n, last)| (Some(n), last));
        let (exponent, absorption) = last.map_or((None, None), |(exponent, last)| (Some(exponent), last));
        Statement::Surface(numbers.into_iter().chain(n).chain(exponent).chain(absorption).collect())
    })
}

fn light() -> impl Strategy<Value = Statement> {
    let size = some((0.0..1.0, some(0.1..9.0)));
    let numbers = (0.0..2.0, some((direction(), size))).prop_map(|(intensity, place)| {
        let (place, size) = place.map_or((None, None), |(place, size)| (Some(place), size));
        let (radius, reference) = size.map_or((None, None), |(radius, last)| (Some(radius), last));
        let place = place.into_iter().flatten();
        std::iter::once(intensity).chain(place).chain(radius).chain(reference).collect()
    });
    (some(0..9usize), numbers, some(0..9usize), tail())
        .prop_map(|(name, numbers, color, tail)| Statement::Light { name, numbers, color, tail })
}

fn camera() -> impl Strategy<Value = Statement> {
    let option = prop_oneof![
        (prop::sample::select(vec!["-ep", "-vc", "-ud"]), direction())
            .prop_map(|(option, place)| format!("{option}{}", words(&place))),
        (1.0..90.0, 1.0..90.0).prop_map(|(a, b)| format!("-va {a} {b}")),
        (1.0..9.0, 1.0..9.0).prop_map(|(w, h)| format!("-fs {w} {h}")),
        (1.0..9.0).prop_map(|length| format!("-fl {length}")),
        (0.1..1.0, 1.0..9.0).prop_map(|(hither, yon)| format!("-cl {hither} {yon}")),
        prop::sample::select(vec!["-og", "-ps", "-ph 0 0.25 0.5 1"]).prop_map(str::to_string),
    ];
    let options = prop::collection::vec(option, 0..5).prop_map(|options| {
        options.iter().flat_map(|option| option.split(' ')).map(str::to_string).collect()
    });
    (some(0..9usize), options, tail()).prop_map(|(name, options, tail)| Statement::Camera {
        name,
        options,
        tail,
    })
}

fn placed() -> impl Strategy<Value = Statement> {
    let array = some((0..4usize, transformations()));
    (some(0..9usize), 0..100usize, some(0..9usize), transformations(), array, tail()).prop_map(
        |(name, definition, color, first, array, tail)| Statement::Placed {
            name,
            definition,
            color,
            first,
            array,
            tail,
        },
    )
}

fn vertex() -> impl Strategy<Value = Statement> {
    (prop::array::uniform3(number()), some(0..9usize), some(direction()))
        .prop_map(|(position, color, normal)| Statement::Vertex { position, color, normal })
}

fn other() -> impl Strategy<Value = Statement> {
    let illum = prop_oneof![
        Just(Illum::None),
        (0.0..1.0).prop_map(Illum::Level),
        (0..9usize).prop_map(Illum::Surface),
    ];
    let face = (some(0..9usize), contours(3), some(0..9usize), illum, tail()).prop_map(
        |(name, contours, color, illum, tail)| Statement::Face { name, contours, color, illum, tail },
    );
    let wire = (some(0..9usize), contours(1), some(0..9usize), tail())
        .prop_map(|(name, contours, color, tail)| Statement::Wire { name, contours, color, tail });
    prop_oneof![
        4 => face,
        1 => wire,
        3 => color_statement(),
        2 => surface(),
        1 => light(),
        1 => camera(),
        4 => placed(),
    ]
}

/// The statements of a scope, in any order, with definitions `depth` deep.
fn scope(depth: usize) -> BoxedStrategy<Vec<Statement>> {
    let vertices = prop::collection::vec(vertex(), 3..7);
    let others = prop::collection::vec(other(), 1..9);
    let n_definitions = if depth == 0 { 0..=0 } else { 0..=2 };
    let inside = if depth == 0 { Just(Vec::new()).boxed() } else { scope(depth - 1) };
    let definitions = prop::collection::vec(inside.prop_map(Statement::Definition), n_definitions);
    let all = (vertices, others, definitions)
        .prop_map(|(vertices, others, definitions)| [vertices, others, definitions].concat());
    all.prop_shuffle().boxed()
}

/// The layout of words in the text.
#[derive(Clone, Copy, Debug)]
enum Layout {
    Lines,
    /// A comment or line end before each word.
    Comments,
    /// No blanks except where they are required.
    Tight,
}

/// A scope that is being written.
struct Level {
    n_colors: usize,
    n_surfaces: usize,
    n_definitions: usize,
    /// Number of definitions begun so far.
    n_begun: usize,
}

/// Writes random scenes.
struct Writer {
    words: Vec<String>,
    levels: Vec<Level>,
    /// Do definitions use later ones, or earlier ones? Either way none contains itself.
    uses_later: bool,
}

impl Writer {
    fn word(&mut self, word: impl ToString) {
        self.words.push(word.to_string());
    }

    fn numbers(&mut self, numbers: &[f64]) {
        for (idx, number) in numbers.iter().enumerate() {
            self.word(if idx % 2 == 0 { number.to_string() } else { format!("{number:e}") });
        }
    }

    /// Returns false if no colour is visible.
    fn color(&mut self, color: Option<usize>) -> bool {
        let n_seen = self.levels.iter().map(|level| level.n_colors).max().unwrap();
        let color = color.filter(|_| n_seen > 0);
        color.into_iter().for_each(|color| self.word(format!("c{}", color % n_seen)));
        color.is_some()
    }

    fn illum(&mut self, illum: Illum, has_color: bool) {
        let n_seen = self.levels.iter().map(|level| level.n_surfaces).max().unwrap();
        match illum {
            Illum::Level(level) => self.numbers(&[level]),
            Illum::Surface(surface) if has_color && n_seen > 0 => self.word(format!("s{}", surface % n_seen)),
            _ => {}
        }
    }

    fn tail(&mut self, tail: Tail) {
        if let Some(velocity) = tail {
            self.word("<");
            self.numbers(&velocity);
            self.word(">");
        }
        self.word(";");
    }

    /// Names may repeat, but never equal those that the reader generates for repeated names.
    fn name(&mut self, name: Option<usize>) {
        if let Some(name) = name {
            self.word(["i", "a", "box", "box", "_b:x", "end", "f", "x#1", "box"][name]);
        }
    }

    fn contours(&mut self, contours: &[Vec<usize>], n_vertices: usize) {
        for contour in contours {
            self.word("(");
            contour.iter().for_each(|&corner| self.word(vertex_name(corner % n_vertices)));
            self.word(")");
        }
    }

    /// The definitions that may be instantiated here.
    fn usable(&self) -> Vec<usize> {
        let innermost = self.levels.len() - 1;
        let mut n_hidden = 0;
        let mut usable = Vec::new();
        for (idx, level) in self.levels.iter().enumerate().rev() {
            let own = level.n_begun.wrapping_sub(1);
            let is_usable = |&definition: &usize| {
                idx == innermost || if self.uses_later { definition > own } else { definition < own }
            };
            usable.extend((n_hidden..level.n_definitions).filter(is_usable));
            n_hidden = n_hidden.max(level.n_definitions);
        }
        usable
    }

    fn scope(&mut self, statements: &[Statement]) {
        let count = |is: fn(&Statement) -> bool| statements.iter().filter(|&statement| is(statement)).count();
        let n_vertices = count(|statement| matches!(statement, Statement::Vertex { .. }));
        let n_colors = count(|statement| matches!(statement, Statement::Color { is_named: true, .. }));
        let n_definitions = count(|statement| matches!(statement, Statement::Definition(_)));
        let n_surfaces = count(|statement| matches!(statement, Statement::Surface(_)));
        self.levels.push(Level { n_colors, n_surfaces, n_definitions, n_begun: 0 });
        let (mut vertices, mut colors, mut surfaces) = (0.., 0.., 0..);
        for statement in statements {
            match statement {
                Statement::Vertex { position, color, normal } => {
                    self.word("v");
                    self.word(vertex_name(vertices.next().unwrap()));
                    self.numbers(position);
                    self.color(*color);
                    self.numbers(normal.as_ref().map_or(&[], |normal| &normal[..]));
                    self.word(";");
                }
                Statement::Color { is_named, keyword, numbers } => {
                    self.word(keyword);
                    if *is_named {
                        let color: usize = colors.next().unwrap();
                        self.word(format!("c{color}"));
                    }
                    self.numbers(numbers);
                    self.word(";");
                }
                Statement::Surface(numbers) => {
                    let surface: usize = surfaces.next().unwrap();
                    self.word("surf");
                    self.word(format!("s{surface}"));
                    self.numbers(numbers);
                    self.word(";");
                }
                Statement::Definition(inside) => {
                    let level = self.levels.last_mut().unwrap();
                    let name = format!("d{}", level.n_begun);
                    level.n_begun += 1;
                    ["def", &name, ";"].into_iter().for_each(|word| self.word(word));
                    self.scope(inside);
                    ["end", ";"].into_iter().for_each(|word| self.word(word));
                }
                _ => self.other(statement, n_vertices),
            }
        }
        self.levels.pop();
    }

    fn other(&mut self, statement: &Statement, n_vertices: usize) {
        match statement {
            Statement::Face { contours, .. } | Statement::Wire { contours, .. } if n_vertices == 0 => {}
            Statement::Face { name, contours, color, illum, tail } => {
                self.word("f");
                self.name(*name);
                self.contours(contours, n_vertices);
                let has_color = self.color(*color);
                self.illum(*illum, has_color);
                self.tail(*tail);
            }
            Statement::Wire { name, contours, color, tail } => {
                self.word("w");
                self.name(*name);
                self.contours(contours, n_vertices);
                self.color(*color);
                self.tail(*tail);
            }
            Statement::Light { name, numbers, color, tail } => {
                self.word("l");
                self.name(*name);
                self.numbers(numbers);
                self.color(*color);
                self.tail(*tail);
            }
            Statement::Camera { name, options, tail } => {
                self.word("cam");
                self.name(*name);
                options.iter().for_each(|option| self.word(option));
                self.tail(*tail);
            }
            Statement::Placed { name, definition, color, first, array, tail } => {
                let usable = self.usable();
                if usable.is_empty() {
                    return;
                }
                self.word(if array.is_some() { "a" } else { "i" });
                self.name(*name);
                self.word("(");
                self.word(format!("d{}", usable[definition % usable.len()]));
                self.color(*color);
                first.iter().for_each(|word| self.word(word));
                self.word(")");
                if let Some((size, step)) = array {
                    self.word(size);
                    step.iter().for_each(|word| self.word(word));
                }
                self.tail(*tail);
            }
            _ => unreachable!("the others are written by `scope`"),
        }
    }

    fn text(&self, layout: Layout) -> String {
        let mut text = String::new();
        let mut before = ";";
        for (idx, word) in self.words.iter().enumerate() {
            let is_mark = |word: &str| matches!(word, "(" | ")" | "<" | ">" | ";");
            text += match layout {
                Layout::Lines if before == ";" => "\n",
                Layout::Lines => " ",
                Layout::Comments => ["{ a ; (} ", "\r\n", "{{f (a b)}{\n}; } ", "\t"][idx % 4],
                Layout::Tight if is_mark(before) || is_mark(word) => "",
                Layout::Tight => " ",
            };
            text += word;
            before = word;
        }
        text
    }
}

fn vertex_name(idx: usize) -> String {
    const FIRST: [&str; 5] = ["v", "f", "end", "_#:", "A"];
    FIRST.get(idx).map_or_else(|| format!("v{idx}"), ToString::to_string)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn both_readers_agree_on_random_scenes(
        statements in scope(3),
        uses_later in any::<bool>(),
        layout in prop::sample::select(vec![Layout::Lines, Layout::Comments, Layout::Tight]),
    ) {
        let mut writer = Writer { words: Vec::new(), levels: Vec::new(), uses_later };
        writer.scope(&statements);
        check(&writer.text(layout));
    }
}

/// A scene of several MB, long enough to be read in parallel.
fn long_text() -> String {
    let mut text = String::from("{ long }\n");
    for n in 0..20_000 {
        let (x, y) = (n % 200, n / 200);
        text += &format!(
            "c c{n} 0.5 {x} 0.{y};{{ row {n} }}\nv a{n} {x} {y} 0 c{n};\nv b{n} {x}.5 {y} 1e-{y};\n\
             v c{n} {x} {y}.25 -0.{n} 0 0 1;\nf f{n} (a{n} b{n} c{n}) c{n} <0.{n} 0 0>;\n\
             w (a{n} b{n}) (b{n} c{n});\n"
        );
        if n % 100 == 0 {
            text += &format!(
                "def d{n};\nc 0.{n};\nv a 0 0 0;\nv b 1 0 0;\nv c 0 1 {n};\nf (a b c);\nend;\n\
                 i (d{n} -tx {x}) <0 0.{n} 0>;\na array{n} (d{n}) 3 -rz {x} -ta 0 {y} 0.5;\n\
                 c 0.{n} {x};\n(escape {n})\nl 0.{n} 1 2 3;\nf (a{n} c{n} b{n});\n"
            );
        }
    }
    text
}

#[test]
fn threads_do_not_change_a_long_scene() {
    let text = long_text();
    assert!(text.len() > 4_000_000, "{} bytes", text.len());
    let on = |n_threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        pool.install(|| ugparse::write(&scenes::parse(text.as_bytes())))
    };
    let one = on(1);
    for n_threads in [2, 3] {
        assert!(on(n_threads) == one, "{n_threads} threads");
    }
    // The common result is correct.
    check(&text);
}
