//! Scenes and diagrams for tests.

use ugdiagram::{Config, Diagram, DiagramOptions, RenderedDiagram, Spacetime, render};
use ugphysics::Event;
use ugscene::Scene;

/// A scene of the repository.
pub fn stored(name: &str) -> Scene {
    let path = format!("{}/../../scenes/{name}.ug", env!("CARGO_MANIFEST_DIR"));
    scene(&std::fs::read_to_string(path).unwrap())
}

pub fn scene(text: &str) -> Scene {
    let source = ugparse::Source::new("test.ug", text);
    ugparse::parse(&source, &ugparse::Options::default())
        .unwrap_or_else(|error| panic!("{error:?}\n{text}"))
        .scene
}

/// The diagram of a scene, in a small picture unless the options ask for another one.
pub fn drawn(scene: Scene, config: &Config) -> RenderedDiagram {
    let mut config = config.clone();
    if config.picture.size == Config::default().picture.size {
        config.picture.size = [320, 240];
    }
    render(scene, &config).unwrap_or_else(|error| panic!("{error}"))
}

pub fn diagram(text: &str, options: DiagramOptions) -> Diagram {
    drawn(scene(text), &Config { diagram: options, ..Config::default() }).diagram
}

pub fn spacetime(scene: Scene, config: &Config) -> Spacetime {
    Spacetime::new(scene, &config.motion, &config.picture.camera, config.picture.size).unwrap()
}

pub fn names(list: &str) -> Option<Vec<String>> {
    Some(list.split(' ').map(str::to_owned).collect())
}

/// Two events differ by rounding: `size` is that of their coordinates.
#[track_caller]
pub fn assert_near(a: Event, b: Event, tolerance: f64) {
    let size = 1.0 + a.t.abs().max(a.x.length());
    let error = (a.t - b.t).abs().max((a.x - b.x).length());
    assert!(error <= tolerance * size, "{a:?} and {b:?} differ by {error:e}");
}

/// The place at which a line through two points passes a time.
pub fn place_at(points: &[[f64; 2]], time: f64) -> f64 {
    let pair = points
        .windows(2)
        .find(|pair| {
            let [low, high] = [pair[0][1].min(pair[1][1]), pair[0][1].max(pair[1][1])];
            low <= time && time <= high
        })
        .unwrap_or_else(|| panic!("no part of {points:?} is at {time}"));
    let part = (time - pair[0][1]) / (pair[1][1] - pair[0][1]);
    pair[0][0] + part * (pair[1][0] - pair[0][0])
}

/// The time at which a line through two points passes a place.
pub fn time_at(points: &[[f64; 2]], place: f64) -> f64 {
    let turned: Vec<[f64; 2]> = points.iter().map(|[x, t]| [*t, *x]).collect();
    place_at(&turned, place)
}
