//! Measures the time of drawing, relative to Mesa llvmpipe (OpenGL in software), and of the whole
//! program, relative to reading by POV-Ray, alternately on the same mesh, as Markdown.
//!
//! `llvmpipe.py` runs llvmpipe; its head lists what must be installed. The mesh has vertex colours
//! and white ambient light, because the OpenGL shader does no lighting. Positions are rounded to
//! f32, so that both draw the same triangles.

use std::error::Error;
use std::f64::consts::PI;
use std::hint::black_box;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Instant;

use glam::DVec3;
use rayon::ThreadPoolBuilder;
use ugparse::{Options, Source};
use ugphysics::Hsv;
use ugrainbow::{Config, Prepared};
use ugscene::{ColorValue, Scene, Tint};

use crate::bench::{build, machine, program, target_dir};
use crate::mesh;

/// Pictures drawn by each program alternately; the fastest counts.
const ROUNDS: usize = 25;

/// Runs of POV-Ray and of the whole program.
const PROCESS_ROUNDS: usize = 5;

/// Sizes of the pictures in pixels.
const SIZES: [[u32; 2]; 2] = [[1280, 720], [1920, 1080]];

const EYE: DVec3 = DVec3::new(0.0, -3.2, 0.6);

/// Horizontal view angle, degrees.
const VIEW_ANGLE: f64 = 52.0;

/// The light and the camera of the mesh.
const TAIL: &str = "l 1;\ncam -ep 0 -3.2 .6 -vc 0 0 0 -ud 0 0 1 -va 52 30 -ps;\n";

/// The external programs.
pub struct Tools<'a> {
    /// Python interpreter with numpy and moderngl.
    pub python: &'a str,
    /// POV-Ray executable.
    pub povray: &'a str,
    /// Threads for each program.
    pub threads: usize,
}

/// Benchmarks meshes of about these numbers of triangles.
pub fn write(out: &mut impl Write, sizes: &[u32], tools: &Tools<'_>) -> Result<(), Box<dyn Error>> {
    build(&["ugrainbow"])?;
    let dir = target_dir().join("bench");
    std::fs::create_dir_all(&dir)?;
    let meshes: Vec<Mesh> = sizes.iter().map(|&n| Mesh::new(&dir, n)).collect::<Result<_, _>>()?;
    writeln!(out, "{}, {} used\n", machine(), tools.threads)?;
    for (idx, mesh) in meshes.iter().enumerate() {
        let mut mesa = Mesa::start(mesh, tools)?;
        if idx == 0 {
            writeln!(out, "{}\n", mesa.name)?;
            writeln!(
                out,
                "| triangles | picture, pixels | back faces | llvmpipe | drawing | llvmpipe / drawing | with colours | llvmpipe / with colours |"
            )?;
            writeln!(out, "| ---: | --- | --- | ---: | ---: | ---: | ---: | ---: |")?;
        }
        for size in SIZES {
            for cull in [false, true] {
                compare(out, mesh, &mut mesa, size, cull, tools)?;
            }
        }
    }
    writeln!(out, "\n| triangles | reading by POV-Ray | `ugrainbow`, 1280×720 | ratio |")?;
    writeln!(out, "| ---: | ---: | ---: | ---: |")?;
    for mesh in &meshes {
        compare_with_povray(out, mesh, &dir, tools)?;
    }
    Ok(())
}

/// A mesh in the formats of all programs.
struct Mesh {
    scene: Scene,
    /// The scene as text.
    text: PathBuf,
    /// Vertices and triangles for llvmpipe.
    binary: PathBuf,
}

impl Mesh {
    fn new(dir: &Path, triangles: u32) -> Result<Self, Box<dyn Error>> {
        let mut text = Vec::new();
        mesh::write_with(&mut text, triangles, false, TAIL)?;
        let mut scene = ugparse::parse(&Source::new("mesh", text), &Options::default())?.scene;
        for vertex in &mut scene.vertices {
            vertex.position = vertex.position.as_vec3().as_dvec3();
        }
        let [text, binary] = ["ug", "bin"].map(|ending| dir.join(format!("raster-{triangles}.{ending}")));
        std::fs::write(&text, ugparse::write(&scene))?;
        std::fs::write(&binary, to_binary(&scene)?)?;
        Ok(Self { scene, text, binary })
    }

    fn corners(&self) -> impl Iterator<Item = [u32; 3]> {
        corners(&self.scene)
    }
}

fn corners(scene: &Scene) -> impl Iterator<Item = [u32; 3]> {
    scene.faces.iter().filter_map(|face| {
        let corners = scene.contours.corners(face.contours.clone());
        <[_; 3]>::try_from(corners).ok().map(|corners| corners.map(|corner| corner.0))
    })
}

/// The binary format that `llvmpipe.py` reads.
fn to_binary(scene: &Scene) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut bytes = Vec::new();
    for count in [scene.vertices.len(), scene.faces.len()] {
        bytes.extend(u32::try_from(count)?.to_le_bytes());
    }
    for vertex in &scene.vertices {
        let color = vertex.color.ok_or("a vertex has no colour")?;
        let ColorValue::Hsv { value, tint: Tint::Hue(hue), saturation, .. } =
            scene.colors[color.index()].value
        else {
            return Err("a colour has no hue".into());
        };
        let [red, green, blue] = Hsv { hue, saturation, value }.to_rgb();
        let [x, y, z] = vertex.position.to_array();
        bytes.extend([x, y, z, red, green, blue].iter().flat_map(|&number| (number as f32).to_le_bytes()));
    }
    bytes.extend(corners(scene).flatten().flat_map(u32::to_le_bytes));
    Ok(bytes)
}

/// A running `llvmpipe.py` that waits for requests.
struct Mesa {
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
    name: String,
}

impl Mesa {
    fn start(mesh: &Mesh, tools: &Tools<'_>) -> Result<Self, Box<dyn Error>> {
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("llvmpipe.py");
        let mut child = Command::new(tools.python)
            .arg(script)
            .arg(&mesh.binary)
            .env("LP_NUM_THREADS", tools.threads.to_string())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        let requests = child.stdin.take().ok_or("no standard input")?;
        let answers = BufReader::new(child.stdout.take().ok_or("no standard output")?);
        let mut mesa = Self { child, requests, answers, name: String::new() };
        mesa.name = mesa.answer()?;
        Ok(mesa)
    }

    /// Draws a picture and returns the time in seconds.
    fn draw(&mut self, size: [u32; 2], cull: bool, file: Option<&Path>) -> Result<f64, Box<dyn Error>> {
        let matrix = clip_from_scene(size).map(|number| number.to_string()).join(" ");
        let file = file.map_or("-".into(), |file| file.display().to_string());
        writeln!(self.requests, "{} {} {} {matrix} {file}", size[0], size[1], u8::from(cull))?;
        self.requests.flush()?;
        Ok(self.answer()?.parse()?)
    }

    fn answer(&mut self) -> Result<String, Box<dyn Error>> {
        let mut line = String::new();
        if self.answers.read_line(&mut line)? == 0 {
            return Err(format!("llvmpipe.py stopped: {}", self.child.wait()?).into());
        }
        Ok(line.trim().to_string())
    }
}

impl Drop for Mesa {
    fn drop(&mut self) {
        // The script ends with its input anyway, so a failure to kill it can be ignored.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The camera of [`TAIL`] as an OpenGL matrix from scene to clip space, in column-major order.
fn clip_from_scene([width, height]: [u32; 2]) -> [f64; 16] {
    const NEAR: f64 = 0.1;
    const FAR: f64 = 100.0;
    let forward = -EYE.normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let scale = 1.0 / libm::tan(VIEW_ANGLE * PI / 360.0);
    let rows = [
        (right * scale, 0.0),
        (up * (scale * f64::from(width) / f64::from(height)), 0.0),
        (forward * ((FAR + NEAR) / (FAR - NEAR)), -2.0 * FAR * NEAR / (FAR - NEAR)),
        (forward, 0.0),
    ];
    let rows = rows.map(|(axis, offset)| axis.extend(offset - axis.dot(EYE)));
    std::array::from_fn(|idx| rows[idx % 4][idx / 4])
}

/// Measures all programs alternately and writes a row of the table.
fn compare(
    out: &mut impl Write,
    mesh: &Mesh,
    mesa: &mut Mesa,
    size: [u32; 2],
    cull: bool,
    tools: &Tools<'_>,
) -> Result<(), Box<dyn Error>> {
    let pool = ThreadPoolBuilder::new().num_threads(tools.threads).build()?;
    // The scene's camera has two angles; a single one gives square pixels.
    let camera = ugrainbow::CameraOptions { view_angle: Some((VIEW_ANGLE, None)), ..Default::default() };
    let config = Config {
        picture: ugrainbow::PictureOptions {
            size,
            samples: 1,
            camera,
            ..ugrainbow::PictureOptions::default()
        },
        cull,
        ..Config::default()
    };
    let prepared = Prepared::new(&mesh.scene, &config)?;
    check_same(&prepared, mesa, size, cull)?;
    let mut fastest = [f64::INFINITY; 3];
    for _ in 0..ROUNDS {
        let start = Instant::now();
        black_box(pool.install(|| prepared.draw()));
        let drawn = start.elapsed().as_secs_f64();
        let theirs = mesa.draw(size, cull, None)?;
        let start = Instant::now();
        black_box(pool.install(|| ugrainbow::render(&mesh.scene, &config))?);
        let all = start.elapsed().as_secs_f64();
        for (fastest, seconds) in fastest.iter_mut().zip([theirs, drawn, all]) {
            *fastest = fastest.min(seconds);
        }
    }
    let [theirs, drawn, all] = fastest.map(|seconds| seconds * 1e3);
    let back = if cull { "culled" } else { "drawn" };
    Ok(writeln!(
        out,
        "| {} | {}×{} | {back} | {theirs:.1} ms | {drawn:.1} ms | {:.2} | {all:.1} ms | {:.2} |",
        mesh.scene.faces.len(),
        size[0],
        size[1],
        theirs / drawn,
        theirs / all
    )?)
}

/// Fails if the pictures show different things. Colours may differ between vertices, because one
/// program interpolates hues and the other red, green and blue.
fn check_same(
    prepared: &Prepared<'_>,
    mesa: &mut Mesa,
    size: [u32; 2],
    cull: bool,
) -> Result<(), Box<dyn Error>> {
    let file = target_dir().join("bench/llvmpipe.rgba");
    mesa.draw(size, cull, Some(&file))?;
    let theirs = std::fs::read(&file)?;
    let ours = prepared.draw();
    let is_black = |pixel: &[u8]| pixel[..3] == [0; 3];
    let pairs = || ours.pixels().iter().zip(theirs.chunks_exact(4));
    let apart = pairs().filter(|(ours, theirs)| is_black(*ours) != is_black(theirs)).count();
    let off: u64 = pairs()
        .flat_map(|(ours, theirs)| ours[..3].iter().zip(theirs).map(|(a, b)| u64::from(a.abs_diff(*b))))
        .sum();
    let (apart, off) = (apart as f64 / (theirs.len() / 4) as f64, off as f64 / theirs.len() as f64);
    if apart > 1e-3 || off > 1.0 {
        return Err(format!("the pictures differ: {apart:.6} of pixels, {off:.3} levels in the mean").into());
    }
    Ok(())
}

/// POV-Ray reads vertices and triangles without colours; `ugrainbow` reads everything, draws, and
/// writes a PNG.
fn compare_with_povray(
    out: &mut impl Write,
    mesh: &Mesh,
    dir: &Path,
    tools: &Tools<'_>,
) -> Result<(), Box<dyn Error>> {
    let scene = dir.join("raster.pov");
    std::fs::write(&scene, to_povray(mesh)?)?;
    let (mut theirs, mut ours) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..PROCESS_ROUNDS {
        theirs = theirs.min(parse_time(&scene, dir, tools)?);
        let start = Instant::now();
        let status = Command::new(program("ugrainbow"))
            .args(["-qt", "-sz", "1280", "720", "-aa", "1"])
            .arg(&mesh.text)
            .env("RAYON_NUM_THREADS", tools.threads.to_string())
            .stdout(Stdio::null())
            .status()?;
        ours = ours.min(start.elapsed().as_secs_f64());
        if !status.success() {
            return Err(format!("ugrainbow failed: {status}").into());
        }
    }
    let n_faces = mesh.scene.faces.len();
    Ok(writeln!(out, "| {n_faces} | {:.0} ms | {:.0} ms | {:.1} |", theirs * 1e3, ours * 1e3, theirs / ours)?)
}

fn to_povray(mesh: &Mesh) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut text = Vec::new();
    writeln!(
        text,
        "#version 3.7; global_settings {{ assumed_gamma 1 }} camera {{ location <0,-9,0> look_at 0 }}"
    )?;
    write!(text, "mesh2 {{ vertex_vectors {{ {}", mesh.scene.vertices.len())?;
    for vertex in &mesh.scene.vertices {
        let [x, y, z] = vertex.position.to_array();
        write!(text, ",\n<{x},{y},{z}>")?;
    }
    write!(text, "\n}} face_indices {{ {}", mesh.scene.faces.len())?;
    for [a, b, c] in mesh.corners() {
        write!(text, ",\n<{a},{b},{c}>")?;
    }
    writeln!(text, "\n}} pigment {{ rgb 1 }} }}")?;
    Ok(text)
}

/// The time that POV-Ray reports for parsing a scene, in seconds.
fn parse_time(scene: &Path, dir: &Path, tools: &Tools<'_>) -> Result<f64, Box<dyn Error>> {
    let output = Command::new(tools.povray)
        .arg(format!("+I{}", scene.display()))
        .arg(format!("+O{}", dir.join("povray.png").display()))
        .args(["+W16", "+H9", "-A", "-D", &format!("+WT{}", tools.threads)])
        .output()?;
    let text = String::from_utf8_lossy(&output.stderr);
    let line =
        text.lines().find(|line| line.contains("Parse Time")).ok_or("POV-Ray reports no parse time")?;
    let seconds = line.rsplit('(').next().and_then(|rest| rest.split_whitespace().next());
    Ok(seconds.ok_or("POV-Ray reports no seconds")?.parse()?)
}
