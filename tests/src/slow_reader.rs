//! A second, independent reader of scenes, written from `docs/unigrafix.md` alone: small, slow and
//! simple.
//!
//! It splits the text into words, parses statements into structs with maps by name, and expands
//! instances recursively with 4×4 matrices. It accepts only valid scenes without `include`, and
//! panics otherwise.

use std::collections::{BTreeMap, BTreeSet};

/// x, y, z.
pub type Triple = [f64; 3];

/// A scene with all instances expanded.
#[derive(Clone, Debug, Default)]
pub struct Flat {
    /// `v`.
    pub vertices: Vec<Vertex>,
    /// `f`.
    pub faces: Vec<Face>,
    /// `w`.
    pub wires: Vec<Wire>,
    /// `l`.
    pub lights: Vec<Light>,
    /// `cam`.
    pub cameras: Vec<Camera>,
    /// Escapes, without their outer parentheses.
    pub escapes: Vec<String>,
    /// `motion`, by name.
    pub motions: BTreeMap<String, MotionOptions>,
}

/// An expanded vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertex {
    /// Its path.
    pub name: String,
    /// In scene coordinates.
    pub position: Triple,
    /// The name of its colour.
    pub color: Option<String>,
    /// Its normal, in scene coordinates.
    pub normal: Option<Triple>,
}

/// An expanded face.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// Its path, if it has a name.
    pub name: Option<String>,
    /// Names of its vertices.
    pub contours: Vec<Vec<String>>,
    /// Its colour, without the name.
    pub color: Option<Paint>,
    /// Its fixed light level.
    pub illum: Option<f64>,
    /// kd, ks, kt, n, exponent and absorption of its surface, without the name.
    pub surface: Option<[f64; 6]>,
    /// Its motion.
    pub motion: Option<Motion>,
}

/// An expanded wire.
#[derive(Clone, Debug, PartialEq)]
pub struct Wire {
    /// Its path, if it has a name.
    pub name: Option<String>,
    /// Names of its vertices.
    pub contours: Vec<Vec<String>>,
    /// Its colour.
    pub color: Option<Paint>,
    /// Its motion.
    pub motion: Option<Motion>,
}

/// An expanded light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its path, if it has a name.
    pub name: Option<String>,
    /// Its intensity.
    pub intensity: f64,
    /// The direction toward it, or its position if it has a radius; `None` for an ambient light.
    pub place: Option<Triple>,
    /// The radius of a lamp.
    pub radius: Option<f64>,
    /// The distance at which its level is its intensity, if its light falls off.
    pub reference: Option<f64>,
    /// Its colour.
    pub color: Option<Paint>,
    /// Its motion.
    pub motion: Option<Motion>,
}

/// An expanded camera.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Camera {
    /// Its path, if it has a name.
    pub name: Option<String>,
    /// Options and numbers; of `-og` and `-ps` the last one.
    pub options: BTreeMap<String, Vec<f64>>,
    /// Its motion.
    pub motion: Option<Motion>,
}

/// `< x y z >` or `< NAME >`
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// A velocity.
    Velocity(Triple),
    /// A motion by its name.
    Named(String),
}

/// The options of a motion with their words; those that were not given are left out.
pub type MotionOptions = BTreeMap<String, Vec<String>>;

/// A colour: its numbers and translucency.
#[derive(Clone, Debug, PartialEq)]
pub enum Paint {
    /// Lightness, hue, saturation, translucency, factor.
    Hsv([f64; 5]),
    /// Red, green, blue, translucency.
    Rgb([f64; 4]),
    /// X, Y, Z, translucency.
    Xyz([f64; 4]),
    /// Kelvin, scale.
    Blackbody([f64; 2]),
    /// Wavelengths with their values.
    Spectrum(Vec<f64>),
    /// Over own time.
    Timed(Timed),
}

/// The colours of `c_time`.
#[derive(Clone, Debug, PartialEq)]
pub struct Timed {
    /// `-step`.
    pub is_stepped: bool,
    /// `-period`.
    pub period: Option<f64>,
    /// Times and names of colours.
    pub rows: Vec<(f64, String)>,
}

/// Reads a valid scene.
pub fn read(text: &str) -> Flat {
    let mut words = Words { words: words(text), next: 0 };
    let root = read_scope(&mut words, "", None);
    let mut expansion = Expansion::default();
    let scene =
        Placement { path: String::new(), matrix: IDENTITY, is_mirrored: false, color: None, motion: None };
    expansion.scope(&[&root], &scene);
    expansion.prefer_outer_camera();
    Flat { motions: root.motions, ..expansion.flat }
}

// Words.

/// Splits a text into words. An escape is one word, including its outer parentheses.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut word = String::new();
    let mut rest = text.chars();
    let mut starts_statement = true;
    while let Some(c) = rest.next() {
        let ends_word = c.is_ascii_whitespace() || c == '\x0b' || "(){;<>".contains(c);
        if !ends_word {
            if starts_statement && word.is_empty() && c == '#' {
                // A line mark.
                rest.by_ref().find(|&c| c == '\n' || c == '\r');
            } else {
                word.push(c);
            }
            continue;
        }
        if !word.is_empty() {
            words.push(std::mem::take(&mut word));
            starts_statement = false;
        }
        if c == '{' {
            nested(&mut rest, '{', '}');
        } else if c == '(' && starts_statement {
            words.push(format!("({})", nested(&mut rest, '(', ')')));
        } else if "()<>;".contains(c) {
            words.push(c.to_string());
            starts_statement = c == ';';
        }
    }
    assert!(word.is_empty(), "the text ends within a statement");
    words
}

/// The text up to the matching closing bracket.
fn nested(rest: &mut std::str::Chars, open: char, close: char) -> String {
    let mut depth = 1;
    let mut inside = String::new();
    for c in rest {
        depth += i32::from(c == open) - i32::from(c == close);
        if depth == 0 {
            return inside;
        }
        inside.push(c);
    }
    panic!("`{open}` is not closed");
}

/// The words that are not yet parsed.
struct Words {
    words: Vec<String>,
    next: usize,
}

impl Words {
    fn peek(&self) -> &str {
        self.words.get(self.next).map_or("", |word| word)
    }

    fn take(&mut self) -> String {
        self.next += 1;
        self.words[self.next - 1].clone()
    }

    fn expect(&mut self, expected: &str) {
        let word = self.take();
        assert_eq!(word, expected, "word {}", self.next);
    }

    fn is_number(&self) -> bool {
        self.peek().parse::<f64>().is_ok() && !self.is_name()
    }

    fn is_name(&self) -> bool {
        self.peek().starts_with(|c: char| c.is_ascii_alphabetic() || ":_#".contains(c))
    }

    fn name(&mut self) -> Option<String> {
        self.is_name().then(|| self.take())
    }

    fn number(&mut self) -> f64 {
        self.take().parse().expect("a number")
    }

    fn numbers(&mut self, n_numbers: usize) -> Vec<f64> {
        (0..n_numbers).map(|_| self.number()).collect()
    }

    fn all_numbers(&mut self) -> Vec<f64> {
        let mut numbers = Vec::new();
        while self.is_number() {
            numbers.push(self.number());
        }
        numbers
    }

    fn triple(&mut self) -> Triple {
        [self.number(), self.number(), self.number()]
    }

    fn optional_triple(&mut self) -> Option<Triple> {
        self.is_number().then(|| self.triple())
    }

    /// Parses `< x y z >` or `< NAME >`, if present.
    fn motion(&mut self) -> Option<Motion> {
        if self.peek() != "<" {
            return None;
        }
        self.expect("<");
        let motion =
            if self.is_number() { Motion::Velocity(self.triple()) } else { Motion::Named(self.take()) };
        self.expect(">");
        Some(motion)
    }

    fn contours(&mut self) -> Vec<Vec<String>> {
        let mut contours = Vec::new();
        while self.peek() == "(" {
            self.expect("(");
            let mut contour = Vec::new();
            while let Some(name) = self.name() {
                contour.push(name);
            }
            self.expect(")");
            contours.push(contour);
        }
        contours
    }
}

// Statements.

/// A scene or a definition: its statements as written.
#[derive(Default)]
struct Scope {
    /// Names of the enclosing definitions and its own, each followed by `:`.
    prefix: String,
    colors: BTreeMap<String, Paint>,
    surfaces: BTreeMap<String, [f64; 6]>,
    definitions: BTreeMap<String, Scope>,
    motions: BTreeMap<String, MotionOptions>,
    statements: Vec<Statement>,
}

enum Statement {
    /// Coordinates are those of the scope, colours are names as written.
    Vertex {
        name: String,
        position: Triple,
        color: Option<String>,
        normal: Option<Triple>,
    },
    /// A face, or a wire if `is_wire`.
    Shape {
        is_wire: bool,
        name: Option<String>,
        contours: Vec<Vec<String>>,
        color: Option<String>,
        unnamed: Option<Paint>,
        surface: Option<String>,
        illum: Option<f64>,
        motion: Option<Motion>,
    },
    /// `numbers`: intensity, then direction or position, radius and reference distance.
    Light {
        name: Option<String>,
        numbers: Vec<f64>,
        color: Option<String>,
        motion: Option<Motion>,
    },
    Camera(Camera),
    /// To copy k applies `first`, then k times `step`. An instance has no `size`.
    Placed {
        name: Option<String>,
        definition: String,
        color: Option<String>,
        first: Vec<Step>,
        size: Option<usize>,
        step: Vec<Step>,
        motion: Option<Motion>,
    },
    Escape(String),
}

/// Parses statements up to `end`, or to the end of the text.
fn read_scope(words: &mut Words, prefix: &str, mut unnamed: Option<Paint>) -> Scope {
    let mut scope = Scope { prefix: prefix.to_string(), ..Scope::default() };
    while !matches!(words.peek(), "" | "end") {
        let keyword = words.take();
        if keyword == ";" {
            continue;
        }
        if let Some(escape) = keyword.strip_prefix('(') {
            scope.statements.push(Statement::Escape(escape[..escape.len() - 1].to_string()));
            continue;
        }
        match &keyword[..] {
            "c" | "c_rgb" | "c_xyz" | "c_bb" | "c_spd" => {
                let name = words.name();
                let paint = paint(&keyword, &words.all_numbers());
                match name {
                    None => unnamed = Some(paint),
                    Some(name) => assert!(scope.colors.insert(name, paint).is_none(), "a second colour"),
                }
            }
            "c_time" => {
                let name = words.take();
                let mut timed = Timed { is_stepped: false, period: None, rows: Vec::new() };
                while words.peek().starts_with('-') && !words.is_number() {
                    match &words.take()[..] {
                        "-step" => timed.is_stepped = true,
                        "-period" => timed.period = Some(words.number()),
                        other => panic!("what is `{other}`?"),
                    }
                }
                while words.is_number() {
                    timed.rows.push((words.number(), words.take()));
                }
                let paint = Paint::Timed(timed);
                assert!(scope.colors.insert(name, paint).is_none(), "a second colour");
            }
            "surf" => {
                let name = words.take();
                let surface = match words.all_numbers()[..] {
                    [kd, ks, kt] => [kd, ks, kt, 1.0, 20.0, 0.0],
                    [kd, ks, kt, n] => [kd, ks, kt, n, 20.0, 0.0],
                    [kd, ks, kt, n, exponent] => [kd, ks, kt, n, exponent, 0.0],
                    [kd, ks, kt, n, exponent, absorption] => [kd, ks, kt, n, exponent, absorption],
                    ref numbers => panic!("{} numbers behind `surf`", numbers.len()),
                };
                assert!(scope.surfaces.insert(name, surface).is_none(), "a second surface");
            }
            "def" => {
                let name = words.take();
                words.expect(";");
                let inside = read_scope(words, &format!("{prefix}{name}:"), unnamed.clone());
                words.expect("end");
                assert!(scope.definitions.insert(name, inside).is_none(), "a second definition");
            }
            "motion" => {
                let name = words.take();
                let mut options = MotionOptions::new();
                while words.peek() != ";" {
                    let option = words.take();
                    let arguments = options.entry(option).or_default();
                    while words.peek() != ";" && (words.is_number() || !words.peek().starts_with('-')) {
                        arguments.push(words.take());
                    }
                    arguments.push("|".to_string());
                }
                scope.motions.insert(name, options);
            }
            _ => scope.statements.push(read_statement(&keyword, words, unnamed.clone())),
        }
        words.expect(";");
    }
    scope
}

fn paint(keyword: &str, numbers: &[f64]) -> Paint {
    match (keyword, numbers) {
        ("c", &[l]) => Paint::Hsv([l, 0.0, 0.0, 0.0, 1.0]),
        ("c", &[l, h]) => Paint::Hsv([l, h, 1.0, 0.0, 1.0]),
        ("c", &[l, h, s]) => Paint::Hsv([l, h, s, 0.0, 1.0]),
        ("c", &[l, h, s, t]) => Paint::Hsv([l, h, s, t, 1.0]),
        ("c", &[l, h, s, t, factor]) => Paint::Hsv([l, h, s, t, factor]),
        ("c_rgb", &[r, g, b]) => Paint::Rgb([r, g, b, 0.0]),
        ("c_rgb", &[r, g, b, t]) => Paint::Rgb([r, g, b, t]),
        ("c_xyz", &[x, y, z]) => Paint::Xyz([x, y, z, 0.0]),
        ("c_xyz", &[x, y, z, t]) => Paint::Xyz([x, y, z, t]),
        ("c_bb", &[kelvin]) => Paint::Blackbody([kelvin, 1.0]),
        ("c_bb", &[kelvin, scale]) => Paint::Blackbody([kelvin, scale]),
        ("c_spd", samples) => Paint::Spectrum(samples.to_vec()),
        _ => panic!("{} numbers behind `{keyword}`", numbers.len()),
    }
}

// Rust evaluates struct fields in the order in which they are written, which here is that of the
// text.
fn read_statement(keyword: &str, words: &mut Words, unnamed: Option<Paint>) -> Statement {
    match keyword {
        "v" => Statement::Vertex {
            name: words.take(),
            position: words.triple(),
            color: words.name(),
            normal: words.optional_triple(),
        },
        "f" | "w" => Statement::Shape {
            is_wire: keyword == "w",
            name: words.name(),
            contours: words.contours(),
            color: words.name(),
            unnamed,
            surface: if keyword == "f" { words.name() } else { None },
            illum: words.is_number().then(|| words.number()),
            motion: words.motion(),
        },
        "l" => Statement::Light {
            name: words.name(),
            numbers: words.all_numbers(),
            color: words.name(),
            motion: words.motion(),
        },
        "cam" => Statement::Camera(Camera {
            name: words.name(),
            options: camera_options(words),
            motion: words.motion(),
        }),
        "i" | "a" => {
            let name = words.name();
            words.expect("(");
            let definition = words.take();
            let color = words.name();
            let first = steps(words);
            words.expect(")");
            let size = (keyword == "a").then(|| words.take().parse().expect("a whole number"));
            let step = if keyword == "a" { steps(words) } else { Vec::new() };
            Statement::Placed { name, definition, color, first, size, step, motion: words.motion() }
        }
        _ => panic!("what is `{keyword}`?"),
    }
}

fn camera_options(words: &mut Words) -> BTreeMap<String, Vec<f64>> {
    let mut options = BTreeMap::new();
    while words.peek().starts_with('-') {
        let option = words.take();
        if matches!(&option[..], "-og" | "-ps") {
            options.remove("-og");
            options.remove("-ps");
        }
        let mut numbers = words.all_numbers();
        if option == "-va" && numbers.len() == 1 {
            numbers.push(numbers[0]);
        }
        options.insert(option, numbers);
    }
    options
}

// Transformations.

/// Row by row, for row vectors: p' = p M.
type Matrix = [[f64; 4]; 4];

const IDENTITY: Matrix =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// One transformation.
struct Step {
    matrix: Matrix,
    is_mirror: bool,
}

fn steps(words: &mut Words) -> Vec<Step> {
    let mut steps = Vec::new();
    while words.peek().starts_with('-') {
        let option = words.take();
        let kind = option.chars().nth(1).expect("a letter");
        let matrix = match &option[1..] {
            "M3" => {
                let m = words.numbers(9);
                linear(|axis| [m[3 * axis], m[3 * axis + 1], m[3 * axis + 2]])
            }
            "M4" => {
                let m = words.numbers(16);
                std::array::from_fn(|row| std::array::from_fn(|column| m[4 * row + column]))
            }
            "ta" => translation(words.triple()),
            "tv" => {
                let direction = unit(words.triple());
                translation(scaled(direction, words.number()))
            }
            "sa" => {
                let k = words.number();
                linear(|axis| scaled(basis(axis), k))
            }
            "sv" => {
                let direction = unit(words.triple());
                stretch(direction, words.number())
            }
            "ra" => {
                let [about_x, about_y, about_z] = words.triple();
                let xy = product(&turn(basis(0), about_x), &turn(basis(1), about_y));
                product(&xy, &turn(basis(2), about_z))
            }
            "rv" => {
                let axis = unit(words.triple());
                turn(axis, words.number())
            }
            "ma" => linear(|axis| scaled(basis(axis), -1.0)),
            "mv" => stretch(unit(words.triple()), -1.0),
            other => {
                let axis = basis("xyz".find(&other[1..]).expect("a known transformation"));
                match kind {
                    't' => translation(scaled(axis, words.number())),
                    's' => stretch(axis, words.number()),
                    'r' => turn(axis, words.number()),
                    'm' => stretch(axis, -1.0),
                    _ => panic!("what is `{option}`?"),
                }
            }
        };
        steps.push(Step { matrix, is_mirror: kind == 'm' });
    }
    steps
}

/// The matrix that maps each axis to its `image`, and the origin to itself.
fn linear(image: impl Fn(usize) -> Triple) -> Matrix {
    let mut matrix = IDENTITY;
    for (axis, row) in matrix[..3].iter_mut().enumerate() {
        row[..3].copy_from_slice(&image(axis));
    }
    matrix
}

fn translation(by: Triple) -> Matrix {
    let mut matrix = IDENTITY;
    matrix[3][..3].copy_from_slice(&by);
    matrix
}

/// Scales by `k` along a unit vector; by -1 it mirrors.
fn stretch(direction: Triple, k: f64) -> Matrix {
    linear(|axis| {
        let e = basis(axis);
        sum(e, scaled(direction, (k - 1.0) * dot(e, direction)))
    })
}

/// Rotates about a unit vector, counterclockwise seen from its tip (Rodrigues).
fn turn(n: Triple, degrees: f64) -> Matrix {
    let (sin, cos) = match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => libm::sincos(degrees.to_radians()),
    };
    linear(|axis| {
        let e = basis(axis);
        let along = scaled(n, dot(e, n) * (1.0 - cos));
        sum(sum(scaled(e, cos), scaled(cross(n, e), sin)), along)
    })
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|row| {
        std::array::from_fn(|column| (0..4).map(|inner| a[row][inner] * b[inner][column]).sum())
    })
}

fn basis(axis: usize) -> Triple {
    std::array::from_fn(|idx| if idx == axis { 1.0 } else { 0.0 })
}

fn sum(a: Triple, b: Triple) -> Triple {
    std::array::from_fn(|idx| a[idx] + b[idx])
}

fn scaled(a: Triple, k: f64) -> Triple {
    a.map(|x| x * k)
}

fn dot(a: Triple, b: Triple) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Triple, b: Triple) -> Triple {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(a: Triple) -> f64 {
    dot(a, a).sqrt()
}

fn unit(a: Triple) -> Triple {
    scaled(a, 1.0 / length(a))
}

// Expansion.

/// The placement of a scope: transformation and inherited properties.
#[derive(Clone)]
struct Placement {
    /// The path of its instance.
    path: String,
    /// From the scope to the scene.
    matrix: Matrix,
    is_mirrored: bool,
    /// Colour of the innermost instance with a colour.
    color: Option<Paint>,
    /// Motion of the outermost instance with one.
    motion: Option<Motion>,
}

impl Placement {
    fn name(&self, name: &str) -> String {
        if self.path.is_empty() { name.to_string() } else { format!("{}:{name}", self.path) }
    }

    fn optional_name(&self, name: &Option<String>) -> Option<String> {
        name.as_ref().map(|name| self.name(name))
    }

    fn point(&self, p: Triple) -> Triple {
        std::array::from_fn(|column| {
            (0..3).map(|row| p[row] * self.matrix[row][column]).sum::<f64>() + self.matrix[3][column]
        })
    }

    /// The factor of lengths without a direction: the cube root of that of volumes.
    fn scale(&self) -> f64 {
        let [a, b, c, _] = self.matrix;
        let cross = |a: [f64; 4], b: [f64; 4]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let volume: f64 = cross(a, b).iter().zip(c).map(|(x, y)| x * y).sum();
        libm::cbrt(volume.abs())
    }

    fn direction(&self, d: Triple) -> Triple {
        std::array::from_fn(|column| (0..3).map(|row| d[row] * self.matrix[row][column]).sum())
    }

    /// Transforms a normal, so that it stays perpendicular to its plane.
    fn normal(&self, n: Triple) -> Triple {
        let [x, y, z] = [0, 1, 2].map(|axis| self.direction(basis(axis)));
        // Rows of the inverse transpose, times the determinant.
        let [a, b, c] = [cross(y, z), cross(z, x), cross(x, y)];
        let turned = sum(sum(scaled(a, n[0]), scaled(b, n[1])), scaled(c, n[2]));
        scaled(unit(turned), length(n).copysign(dot(x, a)))
    }

    /// The placement of copy `k` of an array or instance.
    fn copy(&self, first: &[Step], step: &[Step], k: usize) -> Self {
        let mut matrix = IDENTITY;
        let mut is_mirrored = self.is_mirrored;
        let behind = std::iter::repeat_n(step, k).flatten();
        for transformation in first.iter().chain(behind) {
            matrix = product(&matrix, &transformation.matrix);
            is_mirrored ^= transformation.is_mirror;
        }
        Self { matrix: product(&matrix, &self.matrix), is_mirrored, ..self.clone() }
    }
}

/// Searches the scopes from the innermost outwards.
fn seen<'s, T>(scopes: &[&'s Scope], get: impl Fn(&'s Scope) -> Option<T>) -> Option<(usize, T)> {
    (0..scopes.len()).rev().find_map(|level| get(scopes[level]).map(|found| (level, found)))
}

fn find_paint(scopes: &[&Scope], name: &Option<String>) -> Option<Paint> {
    let name = name.as_ref()?;
    let (_, paint) = seen(scopes, |scope| scope.colors.get(name)).expect("a colour that is seen");
    Some(paint.clone())
}

/// `wanted`, or `wanted` with the first unused suffix of `_2`, `_3`, …
fn fresh(taken: &mut BTreeSet<String>, wanted: String) -> String {
    let names = std::iter::once(wanted.clone()).chain((2..).map(|n| format!("{wanted}_{n}")));
    let new = names.into_iter().find(|name| !taken.contains(name)).expect("numbers do not end");
    taken.insert(new.clone());
    new
}

/// A vertex as a scope refers to it: its position, and its name in the scene.
type Local<'s> = BTreeMap<&'s str, (Triple, String)>;

#[derive(Default)]
struct Expansion {
    flat: Flat,
    /// Names of vertices, and paths of instances.
    vertices: BTreeSet<String>,
    paths: BTreeSet<String>,
    /// Escapes already written, by their address in the scopes.
    escapes: BTreeSet<usize>,
    /// For each camera, the path of its instance; empty outside definitions.
    camera_paths: Vec<String>,
}

impl Expansion {
    /// If a camera in a definition would be used although there are others, those others come first
    /// and the ones in definitions have names.
    fn prefer_outer_camera(&mut self) {
        let cameras = std::mem::take(&mut self.flat.cameras);
        let used = cameras.iter().position(|camera| camera.name.is_none()).unwrap_or(0);
        let is_nested = |row: usize| !self.camera_paths[row].is_empty();
        let is_changed = !cameras.is_empty() && is_nested(used) && !(0..cameras.len()).all(is_nested);
        let mut rows: Vec<(usize, Camera)> = cameras.into_iter().enumerate().collect();
        if is_changed {
            // Stable: rows of each kind keep their order.
            rows.sort_by_key(|(row, _)| is_nested(*row));
            for (row, camera) in rows.iter_mut().filter(|(row, _)| is_nested(*row)) {
                camera.name.get_or_insert_with(|| self.camera_paths[*row].clone());
            }
        }
        self.flat.cameras = rows.into_iter().map(|(_, camera)| camera).collect();
    }

    /// Expands the last of `scopes`; the others enclose it. Vertices of a scope come before those
    /// of its instances, because shapes may use later vertices; everything else keeps its order.
    fn scope(&mut self, scopes: &[&Scope], place: &Placement) {
        let statements = &scopes[scopes.len() - 1].statements;
        let mut local = Local::new();
        for statement in statements {
            if let Statement::Vertex { name, .. } = statement {
                self.vertex(statement, scopes, place);
                let vertex = self.flat.vertices.last().expect("one was added");
                local.insert(name, (vertex.position, vertex.name.clone()));
            }
        }
        for statement in statements {
            match statement {
                Statement::Vertex { .. } => {}
                Statement::Shape { .. } => self.shape(statement, scopes, place, &local),
                Statement::Light { .. } => self.light(statement, scopes, place),
                Statement::Placed { .. } => self.placed(statement, scopes, place),
                Statement::Camera(camera) => {
                    self.flat.cameras.push(placed_camera(camera, place));
                    self.camera_paths.push(place.path.clone());
                }
                Statement::Escape(text) => {
                    if self.escapes.insert(std::ptr::from_ref(text).addr()) {
                        self.flat.escapes.push(text.clone());
                    }
                }
            }
        }
    }

    fn vertex(&mut self, vertex: &Statement, scopes: &[&Scope], place: &Placement) {
        let Statement::Vertex { name, position, color, normal } = vertex else {
            unreachable!("the caller matched a vertex")
        };
        self.flat.vertices.push(Vertex {
            name: fresh(&mut self.vertices, place.name(name)),
            position: place.point(*position),
            color: color.as_ref().map(|name| {
                let found = seen(scopes, |scope| scope.colors.get(name));
                format!("{}{name}", scopes[found.expect("a colour that is seen").0].prefix)
            }),
            normal: normal.map(|normal| place.normal(normal)),
        });
    }

    fn shape(&mut self, shape: &Statement, scopes: &[&Scope], place: &Placement, local: &Local) {
        let Statement::Shape { is_wire, name, contours, color, unnamed, surface, illum, motion } = shape
        else {
            unreachable!("the caller matched a face or wire")
        };
        let name = place.optional_name(name);
        let color = find_paint(scopes, color).or_else(|| place.color.clone()).or_else(|| unnamed.clone());
        let motion = place.motion.clone().or_else(|| motion.clone());
        let new_name = |vertex: &String| local[&vertex[..]].1.clone();
        let mut new_contours: Vec<Vec<String>> =
            contours.iter().map(|contour| contour.iter().map(new_name).collect()).collect();
        if *is_wire {
            if contours.iter().all(|contour| contour.len() >= 2) {
                self.flat.wires.push(Wire { name, contours: new_contours, color, motion });
            }
        } else if is_polygon(contours, |vertex| local[vertex].0) {
            if place.is_mirrored {
                new_contours.iter_mut().for_each(|contour| contour[1..].reverse());
            }
            let find = |name| seen(scopes, |scope| scope.surfaces.get(name)).expect("a surface that is seen");
            let surface = surface.as_ref().map(|name| *find(name).1);
            self.flat.faces.push(Face {
                name,
                contours: new_contours,
                color,
                illum: *illum,
                surface,
                motion,
            });
        }
    }

    fn light(&mut self, light: &Statement, scopes: &[&Scope], place: &Placement) {
        let Statement::Light { name, numbers, color, motion } = light else {
            unreachable!("the caller matched a light")
        };
        let triple = (numbers.len() > 1).then(|| [numbers[1], numbers[2], numbers[3]]);
        let radius = numbers.get(4).copied();
        let to_scene = |p| if radius.is_some() { place.point(p) } else { place.direction(p) };
        self.flat.lights.push(Light {
            name: place.optional_name(name),
            intensity: numbers[0],
            place: triple.map(to_scene),
            radius,
            reference: numbers.get(5).map(|reference| reference * place.scale()),
            color: find_paint(scopes, color),
            motion: motion.clone(),
        });
    }

    fn placed(&mut self, placed: &Statement, scopes: &[&Scope], place: &Placement) {
        let Statement::Placed { name, definition, color, first, size, step, motion } = placed else {
            unreachable!("the caller matched an instance or array")
        };
        let found = seen(scopes, |scope| scope.definitions.get(definition));
        let (level, inside) = found.expect("a definition that is seen");
        let inside_scopes = [&scopes[..=level], &[inside]].concat();
        // An unnamed array that is the only one in its scope contributes no name to the path.
        let is_placed = |statement: &&Statement| matches!(statement, Statement::Placed { .. });
        let is_alone = scopes[scopes.len() - 1].statements.iter().filter(is_placed).count() == 1;
        let path = if size.is_some() && name.is_none() && is_alone {
            place.path.clone()
        } else {
            let wanted = place.name(name.as_ref().unwrap_or(definition));
            if self.paths.insert(wanted.clone()) { wanted } else { self.second_path(&wanted, scopes, place) }
        };
        for k in 0..size.unwrap_or(1) {
            let mut copy = place.copy(first, step, k);
            copy.path = if size.is_some() { format!("{path}#{k}") } else { path.clone() };
            copy.color = find_paint(scopes, color).or_else(|| place.color.clone());
            copy.motion = place.motion.clone().or_else(|| motion.clone());
            self.scope(&inside_scopes, &copy);
        }
    }
}

impl Expansion {
    /// The first suffix of `_2`, `_3`, … that is not used or requested by another name of this
    /// scope.
    fn second_path(&mut self, wanted: &str, scopes: &[&Scope], place: &Placement) -> String {
        let written = scopes[scopes.len() - 1].statements.iter().filter_map(|statement| match statement {
            Statement::Placed { name, definition, .. } => {
                Some(place.name(name.as_ref().unwrap_or(definition)))
            }
            _ => None,
        });
        let mut taken: BTreeSet<String> = written.chain(self.paths.iter().cloned()).collect();
        let path = fresh(&mut taken, wanted.to_string());
        self.paths.insert(path.clone());
        path
    }
}

fn placed_camera(camera: &Camera, place: &Placement) -> Camera {
    let mut camera = Camera { name: place.optional_name(&camera.name), ..camera.clone() };
    for (option, numbers) in &mut camera.options {
        match (&option[..], &numbers[..]) {
            ("-ep" | "-vc", &[x, y, z]) => *numbers = place.point([x, y, z]).to_vec(),
            ("-ud", &[x, y, z]) => *numbers = place.direction([x, y, z]).to_vec(),
            _ => {}
        }
    }
    camera
}

/// Do all contours have three different vertices, and does the outline have an area?
fn is_polygon(contours: &[Vec<String>], position: impl Fn(&str) -> Triple) -> bool {
    let n_different = |contour: &Vec<String>| contour.iter().collect::<BTreeSet<_>>().len();
    if contours.iter().any(|contour| n_different(contour) < 3) {
        return false;
    }
    let outline: Vec<Triple> = contours[0].iter().map(|vertex| position(vertex)).collect();
    let from_first = |p: Triple| sum(p, scaled(outline[0], -1.0));
    let area = outline
        .windows(2)
        .fold([0.0; 3], |area, side| sum(area, cross(from_first(side[0]), from_first(side[1]))));
    area != [0.0; 3]
}
