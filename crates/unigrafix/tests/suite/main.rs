//! Whoever depends on `unigrafix` alone can name every type that a `Config` is made of, and reads,
//! draws and writes with them.
//!
//! Each struct is taken apart completely, so a field that is added later does not compile before
//! its type is named here, by a path that begins with `unigrafix`.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use std::ops::Range;
use std::sync::Arc;

use unigrafix::glam::{DQuat, DVec3};
use unigrafix::{
    doppler, film, image, light, lorentz, mesh, parse, photon, physics, picture, pipe, rainbow,
    scene, sheet, sky, skybox, trace, warp,
};

/// Takes a struct apart into fields of the given types.
macro_rules! parts {
    ($value:expr => $($path:ident)::+ { $($field:ident: $kind:ty),+ $(,)? }) => {
        let $($path)::+ { $($field),+ } = $value;
        $(let _: $kind = $field;)+
    };
}

#[test]
fn every_type_of_a_config_has_a_name() {
    parts!(lorentz::Config::default() => lorentz::Config {
        velocity: Option<DVec3>,
        camera_velocity: Option<DVec3>,
        eye: Option<DVec3>,
        camera: scene::CameraOptions,
        size: [u32; 2],
        cull: bool,
        time: f64,
        anchor: Option<scene::Anchor>,
        in_place: bool,
        pieces: lorentz::Pieces,
        color_error: f64,
        light_error: f64,
        is_for_rays: bool,
        measure: bool,
        smooth: bool,
        repeat: bool,
        geometry: scene::ShownEffects,
        zero: Option<physics::Event>,
        measured: Option<lorentz::MeasuredFrame>,
    });
    parts!(doppler::Config::default() => doppler::Config {
        velocity: physics::Velocity,
        eye: Option<DVec3>,
        wavelengths: bool,
        shift: light::ColorShift,
        repeat: bool,
        tolerance: f64,
        iris: bool,
        light: bool,
        sky: skybox::SceneSky,
        keep: bool,
        no_textures: bool,
    });
    parts!(rainbow::Config::default() => rainbow::Config {
        interpolation: light::Interpolation,
        hue_scale: scene::HueScale,
        picture: picture::PictureOptions,
        reading: parse::Options,
        wireframe: Option<rainbow::Wireframe>,
        line_width: f64,
        depth_cue: Option<rainbow::DepthCue>,
        exact: Option<light::ColorShift>,
        sky: skybox::SceneSky,
        cull: bool,
        repeat: bool,
    });
    parts!(photon::Config::default() => photon::Config {
        motion: scene::MotionOptions,
        shift: light::ColorShift,
        picture: picture::PictureOptions,
        rays: photon::RayOptions,
        interpolation: light::Interpolation,
        hue_scale: scene::HueScale,
        smooth: bool,
        repeat: bool,
        lens: trace::lens::Lens,
        stereo: Option<f64>,
        adaptive: Option<f64>,
        sky: skybox::SceneSky,
        ground: bool,
        crop: Option<[u32; 4]>,
        radiances: bool,
        reading: parse::Options,
    });
    parts!(warp::Config::default() => warp::Config {
        velocity: physics::Velocity,
        camera: Box<scene::Camera>,
        time: f64,
        shift: light::ColorShift,
        basis: sky::Basis,
        picture: picture::PictureOptions,
        lens: trace::lens::Lens,
        stars: sky::StarOptions,
        range_nm: Range<f64>,
    });
    parts!(mesh::Config::default() => mesh::Config {
        format: Option<mesh::MeshFormat>,
        target: mesh::Target,
        up: Option<mesh::Axis>,
        size: mesh::Size,
        is_centered: bool,
        stage: bool,
        rest_normals: bool,
        name: String,
        pictures: Option<mesh::PictureFiles>,
        reading: parse::Options,
    });
    parts!(sheet::Config::default() => sheet::Config {
        columns: Option<u32>,
        labels: sheet::Labels,
        letters: bool,
        title: String,
        caption: String,
        background: sheet::Rgb,
        gap: Option<[u32; 2]>,
        text_size: Option<f64>,
        size: Option<(u32, Option<u32>)>,
        is_even: bool,
    });
}

/// The structs and enums that these fields are made of.
#[test]
fn every_type_within_has_a_name() {
    parts!(picture::PictureOptions::default() => picture::PictureOptions {
        camera: scene::CameraOptions,
        size: [u32; 2],
        per_inch: Option<f64>,
        samples: u32,
        filter: picture::Filter,
        background: picture::Background,
        output: picture::Output,
        exposure: Option<picture::Exposure>,
        tone: picture::Tone,
        channels: Vec<picture::Channel>,
        small: bool,
        annotations: picture::AnnotationOptions,
        text: picture::TextForm,
        light: Option<Arc<image::LinearFrame>>,
    });
    parts!(picture::AnnotationOptions::default() => picture::AnnotationOptions {
        title: String,
        caption: String,
        place: picture::Place,
        legend: bool,
        outline: bool,
        grid: bool,
        map: Option<picture::MapOptions>,
        iso: Option<picture::IsoOptions>,
        text_size: Option<f64>,
        units: picture::Units,
    });
    let map = picture::MapOptions { quantity: picture::Quantity::Doppler, range: None };
    parts!(map => picture::MapOptions {
        quantity: picture::Quantity, range: Option<[f64; 2]>
    });
    parts!(scene::MotionOptions::default() => scene::MotionOptions {
        velocity: Option<DVec3>,
        camera_velocity: Option<DVec3>,
        time: f64,
        anchor: Option<scene::Anchor>,
        in_place: bool,
        geometry: scene::ShownEffects,
        zero: Option<physics::Event>,
    });
    parts!(photon::RayOptions::default() => photon::RayOptions {
        depth: u32,
        cutoff: f64,
        shadows: bool,
        sky_light: bool,
        fresnel: bool,
        shutter: photon::Shutter,
    });
    parts!(rainbow::Wireframe::default() => rainbow::Wireframe {
        has_faces: bool,
        color: Option<physics::Hsv>,
        edges: rainbow::EdgeKind,
        hidden: rainbow::HiddenLines,
    });
    parts!(skybox::SceneSky::default() => skybox::SceneSky {
        source: skybox::SkySource, turn: DQuat, stars: sky::StarOptions
    });
    let _: [light::ColorShift; 2] = [
        light::ColorShift::Hues(light::HueShift {
            doppler: true,
            law: physics::Brightness::Photon,
        }),
        light::ColorShift::Spectra(light::SpectralShift {
            doppler: true,
            flux: true,
            infrared: physics::spectrum::InfraredRule::default(),
            sampled_nm: None,
        }),
    ];
    let _: picture::Output = picture::Output::Color(image::Format::Png);
    let _: Option<picture::Unit> = picture::Units::default().length();
    // A renderer's own crate has the type of its sky, too.
    let _: photon::SceneSky = rainbow::SceneSky::default();
    let _: doppler::SceneSky = skybox::SceneSky::default();
}

/// A mesh, the frames of a film of it, and their files.
#[test]
fn a_mesh_is_read_and_filmed() {
    let tile = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let read = mesh::run(&mesh::Config::default(), &mesh::MeshFile::new("tile.obj", tile)).unwrap();
    let source = parse::Source::new("tile.ug", read.bytes);
    let tile = parse::parse(&source, &parse::Options::default()).unwrap().scene;
    assert_eq!((tile.faces.len(), tile.vertices[2].position), (1, DVec3::new(1.0, 0.0, 1.0)));

    let frame = |time: f64| {
        let velocity = Some(DVec3::X * 0.5);
        let eye = Some(DVec3::new(0.5, -4.0, 0.5));
        let motion = lorentz::Config { velocity, eye, time, ..Default::default() };
        let mut film = film::Pipe::new(vec![
            film::Program::Lorentz(motion),
            film::Program::Doppler(Default::default()),
            film::Program::Rainbow(Default::default()),
        ]);
        film.picture = picture::PictureOptions {
            size: [24, 18],
            camera: scene::CameraOptions {
                eye,
                center: Some(DVec3::new(0.5, 0.0, 0.5)),
                ..Default::default()
            },
            ..Default::default()
        };
        let (drawn, _) = film.draw(film::FilmSubject::Scene(&tile)).unwrap();
        drawn.into_frame().unwrap()
    };
    // The mean column of what is lit, which moves to the right.
    let column = |frame: image::Frame| {
        let lit = (0..24 * 18).filter(|&idx| frame.pixel(idx % 24, idx / 24)[0] > 50);
        let columns: Vec<f64> = lit.map(|idx| f64::from(idx % 24)).collect();
        assert!(columns.len() > 10, "{}", columns.len());
        columns.iter().sum::<f64>() / columns.len() as f64
    };
    let [first, second] = [3.5, 4.5].map(|time| column(frame(time)));
    assert!(second > first + 2.0, "{first} {second}");
}

/// A computation is stopped by a type that has a name, and errors are matched with a wildcard.
#[test]
fn a_picture_is_stopped() {
    struct Never;
    impl pipe::Progress for Never {
        fn step(&self, _name: &'static str, _parts: u64) {}
        fn done(&self, _parts: u64) {}
        fn is_stopped(&self) -> bool {
            true
        }
    }
    let text = "v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c); cam -ep 0 0 5;";
    let source = parse::Source::new("triangle.ug", text);
    let scene = parse::parse(&source, &parse::Options::default()).unwrap().scene;
    match photon::render_with(scene, &photon::Config::default(), &Never) {
        Err(photon::Error::Picture(picture::Error::Stopped(_))) => {}
        Err(error) => panic!("{error}"),
        Ok(_) => panic!("it was stopped"),
    }
}
