//! Laws of hostile inputs in memory, without programs and files: thousands a second.
//!
//! Fuzz targets and the tests share these functions. Each returns the first finding in words; a
//! panic is left to the caller.

use std::ffi::OsString;
use std::io;
use std::sync::LazyLock;

use rayon::{ThreadPool, ThreadPoolBuilder};
use ugimage::{Format, Metadata};
use uglorentz::Pieces;
use ugmesh::Target;
use ugparse::{Limit, Limits, Options, Source};
use ugpipe::{Failure, ToolArgs, parse_words};
use ugscene::Scene;
use ugtesting::Random;

use super::options;
use super::template::Kind;

/// Small limits, because large scenes take long and reach no further code.
pub fn limits() -> Limits {
    let small = [
        (Limit::Statements, 1000),
        (Limit::Corners, 4000),
        (Limit::Names, 1 << 16),
        (Limit::Files, 20),
    ];
    small.into_iter().fold(Limits::default(), |limits, (limit, value)| limits.with(limit, value))
}

/// The scene through the whole pipe, with options that follow from `seed`:
///
/// - what a stage has written with success is read by the next;
/// - every number of a picture of light is finite;
/// - another number of threads gives the same bytes.
///
/// # Errors
/// The first of these that does not hold.
pub fn pipe(seed: u64, text: &[u8]) -> Result<(), String> {
    let options = Options { lax: seed.is_multiple_of(2), limits: limits(), ..Options::default() };
    let output = stages(seed, text, &options)?;
    if seed.is_multiple_of(4) {
        let other = if rayon::current_num_threads() > 1 { &ONE } else { &TWO };
        if other.install(|| stages(seed, text, &options))? != output {
            return Err("another number of threads gives other bytes".to_owned());
        }
    }
    Ok(())
}

static ONE: LazyLock<ThreadPool> = LazyLock::new(|| pool(1));
static TWO: LazyLock<ThreadPool> = LazyLock::new(|| pool(2));

fn pool(n_threads: usize) -> ThreadPool {
    let pool = ThreadPoolBuilder::new().num_threads(n_threads).build();
    pool.unwrap_or_else(|error| panic!("{n_threads} threads: {error}"))
}

/// The configuration of a program by options at random; the default if they are refused.
fn config<A: ToolArgs, C: Default>(
    random: &mut Random,
    program: &str,
    config: fn(&A) -> Result<C, Failure>,
) -> C {
    let words = options::line(random, Kind::Wild, program);
    parse_words(words.into_iter().map(OsString::from))
        .and_then(|args| config(&args))
        .unwrap_or_default()
}

/// The bytes of the last stage that succeeds; empty if the scene is invalid.
fn stages(seed: u64, text: &[u8], options: &Options) -> Result<Vec<u8>, String> {
    let mut random = Random(seed);
    let mut lorentz = config(&mut random, "uglorentz", uglorentz::Args::config);
    if let Pieces::UpTo(error) = lorentz.pieces {
        // Many pieces take long.
        lorentz.pieces = Pieces::UpTo(error.max(0.1));
    }
    let doppler = config(&mut random, "ugdoppler", ugdoppler::Args::config);
    let rainbow = config(&mut random, "ugrainbow", |args: &ugrainbow::Args| args.config(None));
    let [has_lorentz, has_doppler] = [!random.one_in(5), !random.one_in(3)];
    let Ok(parsed) = ugparse::read(&Source::new("first.ug", text), options, None) else {
        return Ok(Vec::new());
    };
    let mut scene = parsed.scene;
    if has_lorentz {
        match uglorentz::apply(scene, &lorentz) {
            Ok((seen, _)) => scene = again("uglorentz", &seen)?,
            Err(error) => return Ok(error.to_string().into_bytes()),
        }
    }
    if has_doppler {
        match ugdoppler::apply(scene, &doppler) {
            Ok((colored, _)) => scene = again("ugdoppler", &colored)?,
            Err(error) => return Ok(error.to_string().into_bytes()),
        }
    }
    let written = ugparse::write(&scene);
    let light = match ugrainbow::light(&scene, &rainbow) {
        Ok(light) => light,
        Err(error) => return Ok(error.to_string().into_bytes()),
    };
    if let Some(pixel) =
        light.pixels().iter().find(|pixel| pixel.iter().any(|part| !part.is_finite()))
    {
        return Err(format!("ugrainbow: the light of a pixel is {pixel:?}"));
    }
    match ugrainbow::render(&scene, &rainbow) {
        Ok(rendering) => Ok([written, rendering.into_file()].concat()),
        Err(error) => Ok(error.to_string().into_bytes()),
    }
}

/// The scene as the next program reads it.
fn again(program: &str, scene: &Scene) -> Result<Scene, String> {
    let options = Options { lax: true, ..Options::default() };
    match ugparse::read(&Source::new("written.ug", ugparse::write(scene)), &options, None) {
        Ok(parsed) => Ok(parsed.scene),
        Err(findings) => Err(format!("{program} has written a scene that is refused:\n{findings}")),
    }
}

/// A mesh file of a format: the scene and the meshes made of it are read again. Every file that the
/// mesh refers to has the same content, so that an OBJ file can hold its materials.
///
/// # Errors
/// The refused input.
pub fn mesh(format: ugmesh::MeshFormat, bytes: &[u8]) -> Result<(), String> {
    let convert = |format, target, bytes: &[u8]| {
        let config = ugmesh::Config {
            format: Some(format),
            target,
            reading: Options { limits: Limits::default(), ..Options::default() },
            ..ugmesh::Config::default()
        };
        let read_file = |_: &str, limit: u64| -> io::Result<Vec<u8>> {
            Ok(bytes[..bytes.len().min(usize::try_from(limit).unwrap_or(usize::MAX))].to_vec())
        };
        let input = ugmesh::MeshFile::new("mesh", bytes).with_files(&read_file);
        ugmesh::run(&config, &input)
    };
    let Ok(scene) = convert(format, Target::Ug, bytes) else { return Ok(()) };
    if let Err(findings) =
        ugparse::parse(&Source::new("mesh.ug", scene.bytes.clone()), &Options::default())
    {
        return Err(format!("ugmesh has written a scene that is refused:\n{findings}"));
    }
    let targets = [
        (Target::Obj, ugmesh::MeshFormat::Obj),
        (Target::Ply { is_ascii: bytes.len().is_multiple_of(2) }, ugmesh::MeshFormat::Ply),
        (Target::Gltf, ugmesh::MeshFormat::Gltf),
        (Target::Glb, ugmesh::MeshFormat::Gltf),
    ];
    // The length selects the target: all of them take four times as long.
    let (target, format) = targets[bytes.len() / 2 % targets.len()];
    // A format that cannot represent the scene says so.
    let Ok(mesh) = convert(ugmesh::MeshFormat::Ug, target, &scene.bytes) else { return Ok(()) };
    match convert(format, Target::Ug, &mesh.bytes) {
        Ok(_) => Ok(()),
        Err(error) => Err(format!("ugmesh has written {target:?} that it refuses: {error}")),
    }
}

/// Limits of pictures: larger ones take long and reach no further code.
const LIMITS: ugimage::PictureLimits = ugimage::PictureLimits { pixels: 1 << 14, bytes: 1 << 18 };

/// A panorama as an observer in motion sees it, with options that follow from `seed`: every number
/// of the light is finite, and another number of threads gives the same.
///
/// # Errors
/// The violation.
pub fn panorama(seed: u64, bytes: &[u8]) -> Result<(), String> {
    if ugimage::read_picture(bytes, &LIMITS).is_err() {
        return Ok(());
    }
    let mut random = Random(seed);
    let arrangement = *random.pick(&ugwarp::Arrangement::ALL);
    let config = quick(&mut random, seed);
    if let Ok(bands) = ugskybox::open_spectrum(bytes, arrangement, None, &LIMITS) {
        sky(ugwarp::Sky { bands: &bands, ..ugwarp::Sky::default() }, &config, seed)?;
    }
    let Ok(opened) = ugwarp::open(&[bytes], Some(arrangement), None, None, LIMITS) else {
        return Ok(());
    };
    sky((&opened).into(), &config, seed)
}

/// A list of stars as an observer in motion sees them, as [`panorama`].
///
/// # Errors
/// The violation.
pub fn stars(seed: u64, bytes: &[u8]) -> Result<(), String> {
    match ugwarp::read_stars("stars.csv", bytes) {
        Ok(list) => sky(list.stars.as_slice().into(), &quick(&mut Random(seed), seed), seed),
        Err(findings) => {
            std::hint::black_box(findings.render(false));
            Ok(())
        }
    }
}

/// A picture of few samples, mostly in hues: near the speed of light a sample takes in all of the
/// sky, and the tables of spectra take longer than all else.
fn quick(random: &mut Random, seed: u64) -> ugwarp::Config {
    let mut config = config(random, "ugwarp", |args: &ugwarp::Args| args.config(None));
    config.picture.size = config.picture.size.map(|side| side.min(4));
    config.picture.samples = 1;
    if !seed.is_multiple_of(32) {
        config.shift = ugrainbow::ColorShift::hues(true, *random.pick(&ugphysics::Brightness::ALL));
    }
    config
}

fn sky(sky: ugwarp::Sky<'_>, config: &ugwarp::Config, seed: u64) -> Result<(), String> {
    // Options that exclude each other are refused.
    let Ok(light) = ugwarp::light(sky, config) else { return Ok(()) };
    if let Some(pixel) =
        light.pixels().iter().find(|pixel| pixel.iter().any(|part| !part.is_finite()))
    {
        return Err(format!("ugwarp: the light of a pixel is {pixel:?}"));
    }
    if seed.is_multiple_of(4) {
        let other = if rayon::current_num_threads() > 1 { &ONE } else { &TWO };
        match other.install(|| ugwarp::light(sky, config)) {
            Ok(again) if again == light => {}
            _ => return Err("another number of threads gives other light".to_owned()),
        }
    }
    Ok(())
}

/// A picture of any format: a history that is read from it is written into a PNG file and read
/// again.
///
/// # Errors
/// The difference.
pub fn history(bytes: &[u8]) -> Result<(), String> {
    let Some(history) = ugimage::read_history(bytes) else { return Ok(()) };
    // Text in PNG files ends at NUL.
    let comment = history.replace('\0', "");
    let metadata = Metadata { software: String::new(), comment, ..Metadata::default() };
    let frame = ugimage::Frame::new([1, 1], true, vec![[0, 0, 0, 255]]);
    let again = ugimage::read_history(&Format::Png.encode(&frame, &metadata));
    if again.as_ref().unwrap_or(&String::new()) == &metadata.comment {
        return Ok(());
    }
    Err(format!("the history {:?} is written as {again:?}", metadata.comment))
}

/// A PNG file: what is read is put on a sheet, and the sheet is read again as it was written.
///
/// # Errors
/// The refusal or the difference.
pub fn picture(bytes: &[u8]) -> Result<(), String> {
    let Ok((frame, history)) = ugimage::read_png(bytes, &LIMITS) else { return Ok(()) };
    let size = [frame.width(), frame.height()];
    let picture = ugsheet::Picture {
        name: "a".to_owned(),
        size,
        motion: ugsheet::Motion::recorded(&history),
        history,
    };
    let pictures = [picture.clone(), ugsheet::Picture { history: Metadata::default(), ..picture }];
    let sheet = ugsheet::Sheet::new(&ugsheet::Config::default(), &pictures);
    let Ok(sheet) = sheet.and_then(|sheet| sheet.draw(|_| Ok(frame.clone()))) else {
        return Ok(());
    };
    let metadata = ugsheet::history(&pictures, Some("ugsheet"));
    match ugimage::read_png(
        &Format::Png.encode(&sheet, &metadata),
        &ugimage::PictureLimits::default(),
    ) {
        Ok((frame, _)) if frame == sheet => Ok(()),
        Ok(_) => Err("a sheet is read with other pixels than were written".to_owned()),
        Err(error) => Err(format!("a sheet is refused: {error}")),
    }
}
