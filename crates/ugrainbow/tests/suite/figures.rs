//! Captions, legends, grids and outlines: their positions, and that they do not change the picture
//! of the scene.

use ugimage::Format;
use ugphysics::Hsv;
use ugpicture::Canvas;
use ugpipe::Words;
use ugrainbow::{
    AnnotationOptions, Background, ColorShift, Config, Error, MAX_PIXELS, Note, Output,
    PictureOptions, Place, render, run,
};
use ugscene::View;

use crate::common::{draw, scene, with};

const SHIP: &str =
    "(ugstage 1 geometry as-seen eye 0 -9 3) c green 1 120 .8; l 1; cam -ep 0 -9 3 -vc 0 0 .5;
    v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; v e -1 -1 1; v f 1 -1 1; v g 1 1 1; v h -1 1 1;
    f (a b f e) green <.5 0 0>; f (b c g f) green <.5 0 0>; f (c d h g) green <.5 0 0>;
    f (d a e h) green <.5 0 0>; f (e f g h) green <.5 0 0>; f (d c b a) green <.5 0 0>;";

fn white() -> Background {
    Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 1.0 })
}

fn strips() -> AnnotationOptions {
    AnnotationOptions {
        caption: "A box at half the speed of light: β = 0.5".into(),
        legend: true,
        ..AnnotationOptions::default()
    }
}

/// Rows of the scene in an annotated picture, which is that of the scene alone in so many rows, to
/// the byte.
fn scene_rows(config: &Config) -> u32 {
    let figure = draw(SHIP, config);
    assert_eq!([figure.width(), figure.height()], config.picture.size);
    let canvas = Canvas::new(&config.picture).unwrap();
    let size = canvas.options().size;
    let alone = with(config, |picture| {
        (picture.size, picture.annotations) = (size, AnnotationOptions::default());
        picture.camera = canvas.options().camera.clone();
    });
    assert!(size[0] == figure.width() && figure.pixels().starts_with(draw(SHIP, &alone).pixels()));
    size[1]
}

#[test]
fn the_scene_is_drawn_as_it_would_be_alone_in_less_room() {
    let plain =
        with(&Config::default(), |picture| (picture.size, picture.samples) = ([320, 240], 1));
    let caption = AnnotationOptions { legend: false, ..strips() };
    let legend = AnnotationOptions { caption: String::new(), ..strips() };
    for (background, figures, output, exact) in [
        (plain.picture.background, strips(), Output::Color(Format::Png), None),
        (white(), caption, Output::Color(Format::Png16), None),
        (Background::Transparent, legend, Output::Color(Format::Png), Some(ColorShift::default())),
    ] {
        let picture = with(&plain, |picture| {
            (picture.background, picture.output, picture.annotations) =
                (background, output, figures)
        });
        let rows = scene_rows(&Config { exact, ..picture });
        assert!((120..235).contains(&rows), "{rows}");
    }
}

/// With a title, and with text beside the scene or over a corner, the scene is that of a picture of
/// the part that is left, to the byte, but where text covers a corner.
#[test]
fn the_scene_is_that_of_the_part_that_is_left() {
    const SIZE: [u32; 2] = [480, 300];
    for (name, place) in Place::NAMES {
        let annotations = AnnotationOptions { place, title: "A box: β = 0.5".into(), ..strips() };
        let config = with(&Config::default(), |picture| {
            (picture.size, picture.samples, picture.annotations) = (SIZE, 1, annotations);
        });
        let figure = draw(SHIP, &config);
        assert_eq!([figure.width(), figure.height()], SIZE, "the size of the file stays");
        let canvas = Canvas::new(&config.picture).unwrap();
        let size @ [width, height] = canvas.options().size;
        let alone = with(&config, |picture| {
            (picture.size, picture.annotations) = (size, AnnotationOptions::default());
            picture.camera = canvas.options().camera.clone();
        });
        let alone = draw(SHIP, &alone);
        let (mut changed, mut n_seen, mut title) = (Vec::new(), 0, Vec::new());
        for pixel @ [x, y] in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y])) {
            match canvas.pixel_of_scene(pixel) {
                Ok([column, row]) => {
                    n_seen += 1;
                    if figure.pixel(x, y) != alone.pixel(column, row) {
                        changed.push([column, row]);
                    }
                }
                Err(_) if y < 30 => title.push(figure.pixel(x, y)),
                Err(_) => {}
            }
        }
        assert_eq!(n_seen, width * height, "{name}");
        assert!(
            title.iter().any(|pixel| pixel[0] > 200) && title.contains(&[0, 0, 0, 255]),
            "{name}"
        );
        let is_over = !matches!(place, Place::Below | Place::Beside);
        assert_eq!(width < SIZE[0], place == Place::Beside, "{name}");
        assert_eq!(height < 250, place == Place::Below, "{name}: {height}");
        assert_eq!(!changed.is_empty(), is_over, "{name}");
        let [right, low] = [name.ends_with("right"), name.starts_with("bottom")];
        assert!(
            changed.iter().all(|[x, y]| (*x >= width / 2) == right && (*y >= height / 3) >= low),
            "{name}"
        );
    }
}

/// All that a picture of the whole size shows is in the part that text leaves, where it is smaller.
#[test]
fn text_cuts_no_body() {
    for size in [[400, 230], [300, 300], [230, 400]] {
        for place in [Place::Below, Place::Beside] {
            for camera in ["-va 24", "-va 24 -ph 0.2 -0.1 1.1 0.8", "-fl 2 -fs 1 1"] {
                let annotations = AnnotationOptions { place, title: "A".into(), ..strips() };
                let config = with(&Config::default(), |picture| {
                    (picture.size, picture.samples, picture.annotations) = (size, 1, annotations);
                });
                let canvas = Canvas::new(&config.picture).unwrap();
                let scene = scene(&SHIP.replace("-vc 0 0 .5", &format!("-vc 0 0 .5 {camera}")));
                let view = |picture: &PictureOptions| {
                    View::new(&scene, &picture.camera, picture.size).unwrap()
                };
                let [whole, part] = [view(&config.picture), view(canvas.options())];
                let [width, height] = canvas.options().size.map(f64::from);
                let scale = (width / f64::from(size[0])).min(height / f64::from(size[1]));
                for corner in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
                    let at = [0, 1].map(|axis| corner[axis] * f64::from(size[axis]));
                    let found = part.place(whole.point(at, 7.0));
                    let middle = [0.5 * width, 0.5 * height];
                    let expected = [0, 1].map(|axis| {
                        middle[axis] + scale * f64::from(size[axis]) * (corner[axis] - 0.5)
                    });
                    let apart = [found.x / 7.0 - expected[0], found.y / 7.0 - expected[1]];
                    assert!(apart.iter().all(|apart| apart.abs() < 1e-9), "{apart:?} {camera}");
                    assert!(expected[0] > -1e-9 && expected[0] < width + 1e-9, "{expected:?}");
                    assert!(expected[1] > -1e-9 && expected[1] < height + 1e-9, "{expected:?}");
                }
            }
        }
    }
}

/// Twice the size of text takes twice the rows.
#[test]
fn strips_grow_with_the_size_of_text() {
    let plain =
        with(&Config::default(), |picture| (picture.size, picture.samples) = ([480, 300], 1));
    let rows = |text_size| {
        let annotations =
            AnnotationOptions { text_size, legend: true, ..AnnotationOptions::default() };
        300 - scene_rows(&with(&plain, |picture| picture.annotations = annotations))
    };
    let [small, large] = [rows(Some(6.0)), rows(Some(12.0))];
    assert!((2 * small).abs_diff(large) <= 2, "{small} {large}");
}

#[test]
fn the_caption_keeps_within_its_strip() {
    for text in [
        "β = 0.5",
        "jpqgy ÂÉ|",
        &"A long caption that needs several lines, ".repeat(5),
        "two\nlines",
        "i",
    ] {
        for background in
            [Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 0.0 }), white()]
        {
            let figures =
                AnnotationOptions { caption: text.into(), ..AnnotationOptions::default() };
            let config = with(&Config::default(), |picture| {
                (picture.size, picture.samples, picture.background, picture.annotations) =
                    ([300, 300], 1, background, figures)
            });
            let figure = draw(SHIP, &config);
            let ground = figure.pixel(0, 299);
            let rows = scene_rows(&config);
            let inks = |x: u32, y: u32| figure.pixel(x, y) != ground;
            // The strip begins and ends with at least half a line of background.
            let ink: Vec<[u32; 2]> = (rows..300)
                .flat_map(|y| (0..300).map(move |x| [x, y]))
                .filter(|&[x, y]| inks(x, y))
                .collect();
            let bound = |axis: usize| {
                let places = ink.iter().map(move |place| place[axis]);
                [places.clone().min().unwrap(), places.max().unwrap()]
            };
            let ([left, right], [_, bottom]) = (bound(0), bound(1));
            assert!(left >= 5 && right < 295 && bottom < 297, "{text}: {left} {right} {bottom}");
            let [red, ..] = ground;
            let contrast = ink.iter().map(|&[x, y]| figure.pixel(x, y)[0].abs_diff(red)).max();
            assert!(contrast > Some(100), "{text}: {contrast:?}");
        }
    }
}

/// Each number of the legend is under the colour of its wavelength.
#[test]
fn the_legend_has_the_hues_of_the_map() {
    let figures = AnnotationOptions { caption: String::new(), ..strips() };
    let config = with(&Config::default(), |picture| {
        (picture.size, picture.background, picture.annotations) = ([1200, 900], white(), figures)
    });
    let figure = draw(SHIP, &config);
    let hue = |x: u32, y: u32| {
        let [red, green, blue, _] = figure.pixel(x, y);
        let color = Hsv::from_rgb([red, green, blue].map(|level| f64::from(level) / 255.0));
        (color.saturation > 0.99 && color.value > 0.99).then_some(color.hue)
    };
    // The longest row of pure colours is in the middle of the rainbow.
    let pure = |y: u32| (0..1200).filter(|&x| hue(x, y).is_some()).count();
    let rainbow: Vec<u32> = (600..900).filter(|&y| pure(y) > 100).collect();
    let (row, end) = (rainbow[rainbow.len() / 2], *rainbow.last().unwrap());
    // The ticks are below its frame.
    let is_tick = |x: u32| figure.pixel(x, end + 4)[0] < 128;
    // The rainbow is in the left half.
    let starts: Vec<u32> = (1..600).filter(|&x| is_tick(x) && !is_tick(x - 1)).collect();
    let middles = starts.iter().map(|&start| {
        let width = (start..1200).take_while(|&x| is_tick(x)).count() as u32;
        start + width / 2
    });
    let middles: Vec<u32> = middles.collect();
    assert_eq!(middles.len(), 4, "{middles:?}");
    for (x, wavelength_nm) in middles.iter().zip([400.0, 500.0, 600.0, 700.0]) {
        if let Some(found) = hue(*x, row) {
            let expected = [-3.0, 3.0].map(|off| ugphysics::wavelength_to_hue(wavelength_nm + off));
            let found = if found > 330.0 { found - 360.0 } else { found };
            assert!(
                (expected[1]..=expected[0]).contains(&found),
                "{wavelength_nm} nm: {found} {expected:?}"
            );
        }
    }
    // Ticks are evenly spaced, so all other wavelengths are where they belong.
    let at = |wavelength_nm: f64| {
        let (first, last) = (f64::from(middles[0]), f64::from(middles[3]));
        (first + (last - first) * (wavelength_nm - 400.0) / 300.0).round() as u32
    };
    for wavelength_nm in [450.0, 486.1, 550.0, 589.0, 656.3] {
        let found = hue(at(wavelength_nm), row).unwrap();
        let expected = [-3.5, 3.5].map(|off| ugphysics::wavelength_to_hue(wavelength_nm + off));
        assert!(
            (expected[1]..=expected[0]).contains(&found),
            "{wavelength_nm} nm: {found} {expected:?}"
        );
    }
}

/// Seen from above in orthographic projection: lines are at their coordinates, except where a box
/// occludes them.
#[test]
fn grid_lines_are_at_their_coordinates_and_hidden_by_what_is_nearer() {
    let angle = 2.0 * libm::atan(4.0 / 10.0).to_degrees();
    let text = format!(
        "c grey .5; l 1; cam -ep 0 0 10 -vc 0 0 0 -ud 0 1 0 -og -va {angle} {angle};
         v a -.6 -.6 2; v b .6 -.6 2; v c .6 .6 2; v d -.6 .6 2; f (a b c d) grey;
         v e -3 -3 0; v f -2.9 -3 0; v g -2.9 -2.9 0; f (e f g) grey; v h 3 3 0; v i 2.9 3 0; v j 2.9 2.9 0; f (h i j) grey;"
    );
    let config = with(&Config::default(), |picture| picture.size = [400, 400]);
    let plain = draw(&text, &config);
    let figures = AnnotationOptions { grid: true, ..AnnotationOptions::default() };
    let grid = draw(&text, &with(&config, |picture| picture.annotations = figures));
    let differs = |x: u32, y: u32| grid.pixel(x, y) != plain.pixel(x, y);
    // 50 pixels a unit; lines are 1 apart from -3 to 3.
    for x in -3..=3 {
        let column = (200 + 50 * x) as u32;
        assert!(differs(column, 75) || differs(column - 1, 75), "x = {x}");
        let is_under_box = x == 0;
        assert_eq!(differs(column, 200 + 3), !is_under_box, "x = {x}");
    }
    for column in (60..340).filter(|column| (column % 50i32 - 25).abs() < 20) {
        assert!(!differs(column as u32, 225), "column {column} is between lines");
    }
    assert!((50..350).all(|y| !differs(40, y)), "nothing but numbers stands outside");
}

/// A body placed as `uglorentz -in` places it has the outline that it has at rest.
#[test]
fn the_undistorted_outline_is_that_of_the_body_at_rest() {
    // Where the eye of the pipe is, so that (P3) moves corners as uglorentz does.
    let eye = glam::DVec3::new(0.0, -9.0, 3.0);
    let corners: Vec<glam::DVec3> = (0..8)
        .map(|idx| {
            let side = |bit: u32| if idx >> bit & 1 == 1 { 1.0 } else { -1.0 };
            glam::DVec3::new(1.5 * side(0), side(1), 0.7 * side(2))
        })
        .collect();
    const FACES: [[usize; 4]; 6] =
        [[0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6], [4, 5, 7, 6], [2, 3, 1, 0]];
    let text = |velocity: &str, places: &[glam::DVec3]| {
        let vertices =
            places.iter().enumerate().map(|(idx, p)| format!("v p{idx} {} {} {};", p.x, p.y, p.z));
        let faces = FACES.iter().map(|face| {
            let names: Vec<String> = face.iter().map(|idx| format!("p{idx}")).collect();
            format!("f ({}) grey {velocity};", names.join(" "))
        });
        let head =
            "(ugstage 1 geometry as-seen eye 0 -9 3) c grey .5; l .3; l .7 1 -2 4; cam -ep 0 -9 3 -vc 0 0 0;"
                .to_owned();
        std::iter::once(head).chain(vertices).chain(faces).collect::<Vec<_>>().join(" ")
    };
    let v = ugphysics::Velocity::from_beta(glam::DVec3::new(0.9, 0.1, 0.0)).unwrap();
    // Seen with its centre at the origin: rest coordinates about the one that is seen there.
    let middle = ugphysics::rest_position(-eye, v);
    let seen: Vec<glam::DVec3> =
        corners.iter().map(|&corner| eye + ugphysics::seen_position(middle + corner, v)).collect();
    let config = with(&Config::default(), |picture| picture.size = [320, 240]);
    let rest = draw(&text("", &corners), &config);
    let moving = text("<.9 .1 0>", &seen);
    let plain = draw(&moving, &config);
    let figures = AnnotationOptions { outline: true, ..AnnotationOptions::default() };
    let outlined = draw(&moving, &with(&config, |picture| picture.annotations = figures));

    let near = |x: u32, y: u32, reach: u32| {
        let span = move |at: u32, end: u32| at.saturating_sub(reach)..(at + reach + 1).min(end);
        span(y, 240).flat_map(move |y| span(x, 320).map(move |x| (x, y)))
    };
    let is_edge = |x: u32, y: u32| near(x, y, 1).any(|(i, j)| rest.pixel(i, j) != rest.pixel(x, y));
    let is_white =
        |x: u32, y: u32| outlined.pixel(x, y)[0] > plain.pixel(x, y)[0].saturating_add(40);
    let mut n_ink = 0;
    for y in 0..240 {
        for x in 0..320 {
            if is_white(x, y) {
                n_ink += 1;
                assert!(near(x, y, 2).any(|(i, j)| is_edge(i, j)), "ink at {x} {y} is at no edge");
            }
            if is_edge(x, y) {
                assert!(
                    near(x, y, 2).any(|(i, j)| is_white(i, j)),
                    "the edge at {x} {y} has no ink"
                );
            }
        }
    }
    assert!(n_ink > 400, "{n_ink}");
}

#[test]
#[rustfmt::skip] // rows of a table
fn what_cannot_be_is_refused() {
    let check = |config: Config, part: &str| {
        let source = ugparse::Source::new("test.ug", SHIP);
        let error: Error = run(&config, &source).unwrap_err();
        assert!(error.is_usage() && error.words().contains(part), "{error}");
    };
    let annotated = |figures: AnnotationOptions| {
        with(&Config::default(), |picture| (picture.size, picture.annotations) = ([320, 240], figures))
    };
    check(annotated(AnnotationOptions { caption: "光速".into(), ..AnnotationOptions::default() }), "the font has no `光` (U+5149)");
    check(with(&annotated(strips()), |picture| picture.output = Output::Color(Format::Exr)), "leave out -title, -cap");
    check(with(&annotated(strips()), |picture| picture.size = [100, 30]), "give a larger -sz");
    let narrow = "too narrow for a title, caption, legend or scale: give a wider -sz";
    check(with(&annotated(strips()), |picture| picture.size = [30, 30]), narrow);
    check(
        {
            let letter = annotated(AnnotationOptions { caption: "M".into(), ..AnnotationOptions::default() });
            with(&letter, |picture| picture.size = [20, 400])
        },
        narrow,
    );
    check(with(&annotated(strips()), |picture| picture.size = [0, 30]), &MAX_PIXELS.to_string());
    check(annotated(AnnotationOptions { caption: "x\n".repeat(50) + "x", ..AnnotationOptions::default() }), "a shorter -title and -cap");
}

#[test]
fn figures_of_any_width_are_drawn_or_refused() {
    let draws = |width: u32| {
        let config = with(&Config::default(), |picture| {
            (picture.size, picture.samples, picture.annotations) = ([width, 400], 1, strips())
        });
        let drawn = render(&scene(SHIP), &config);
        assert!(drawn.as_ref().err().is_none_or(Error::is_usage), "{width}");
        drawn.is_ok()
    };
    let least = (1..400).find(|&width| draws(width)).unwrap();
    assert!((60..100).contains(&least), "{least}");
    assert!((least..400).step_by(37).all(draws));
}

#[test]
fn at_rest_there_is_a_legend_but_no_outline() {
    let text = SHIP.replace("<.5 0 0>", "");
    let render = |annotations| {
        let picture = PictureOptions { size: [320, 240], annotations, ..PictureOptions::default() };
        render(&scene(&text), &Config { picture, ..Config::default() }).unwrap()
    };
    let rendering = render(AnnotationOptions { outline: true, ..strips() });
    let notes = &rendering.notes;
    assert!(notes.contains(&Note::NoOutline), "{notes:?}");
    assert_eq!(rendering.into_frame().unwrap().height(), 240);
    let notes = render(strips()).notes;
    assert!(notes.is_empty(), "{notes:?}");
}
