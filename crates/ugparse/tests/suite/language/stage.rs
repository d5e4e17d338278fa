//! The stage of a scene, which records changes of positions and colours.

use glam::DVec3;
use ugphysics::spectrum::InfraredRule;
use ugphysics::{Brightness, Velocity};
use ugscene::{
    ColorScale, ColorStage, ColorValue, GeometryStage, HueScale, MixtureNames, SeenColors,
    SeenGeometry, Stage, Tint,
};

use super::*;

const SEEN: SeenGeometry = SeenGeometry {
    eye: DVec3::new(0.0, -12.0, 3.0),
    time: 0.0,
    camera_velocity: Velocity::ZERO,
    contraction: true,
    flight_time: true,
    is_whole: false,
};

fn written(stage: Stage) -> String {
    write(&Scene { stage, ..Scene::default() })
}

#[test]
fn every_stage_reads_back() {
    let third = Velocity::from_beta(DVec3::new(1.0 / 3.0, -1e-300, 0.7)).unwrap();
    let mut geometries = vec![GeometryStage::AtRest, GeometryStage::AsSeen(SEEN)];
    geometries.push(GeometryStage::AsSeen(SeenGeometry { is_whole: true, ..SEEN }));
    for (contraction, flight_time) in [(true, false), (false, true), (false, false)] {
        let seen =
            SeenGeometry { time: -0.1, camera_velocity: third, contraction, flight_time, ..SEEN };
        geometries.push(GeometryStage::AsSeen(seen));
    }
    let mut scales: Vec<_> = [(true, InfraredRule::Measured), (false, InfraredRule::Constant)]
        .map(|(flux, infrared)| ColorScale::Spectra { flux, infrared })
        .to_vec();
    for unit in [HueScale::Degrees, HueScale::Wavelengths] {
        scales.extend(Brightness::ALL.map(|law| ColorScale::Hues { unit, law }));
    }
    let mut colors = vec![ColorStage::AtRest];
    for scale in scales {
        for (doppler, lights) in [(true, false), (false, true)] {
            let seen = SeenColors { scale, doppler, lights };
            colors.extend([ColorStage::AsSeen(seen), ColorStage::Deferred(seen)]);
        }
    }
    for &geometry in &geometries {
        for &colors in &colors {
            for mixtures in [None, Some(MixtureNames::unused(["mix", "mix##1"].into_iter()))] {
                let stage = Stage { geometry, colors, mixtures };
                let text = written(stage);
                assert_eq!(text.is_empty(), stage.is_at_rest());
                assert_eq!(parse(&text).stage, stage, "{text}");
                assert_eq!(text.lines().count(), usize::from(!text.is_empty()));
            }
        }
    }
}

/// Displacements of lamps are those of the bodies that they light, whose reference points have no
/// meaning any more.
#[test]
fn lamp_shifts_belong_to_bodies() {
    let stage = "(ugstage 1 geometry as-seen eye 0 -12 3)\n";
    let corners = "v a 0 0 0;\nv b 1 0 0;\nv c 0 1 0;\n";
    let faces = "f (a b c) <0.3333333333333333 -1e-300 0.7 -shift 0 -0.1 0.3333333333333333 1e+300>;\n\
                 f (c b a) <0 0 0 -shift 0 1 0 0>;\nl 1 2 3 4 0 <0 0 0>;\n";
    let text = [stage, corners, faces].concat();
    assert_eq!(write(&parse(&text)), text);
    let placed = text.replace("<0 0 0>", "<0 0 0 -at 1 2 3>");
    assert_eq!(write(&parse(&placed)), text);
}

#[test]
fn it_is_the_unit_of_tints_wherever_it_stands() {
    let colors = "c green 1 546.1;\ndef d;\nc red 1 700;\nend;\n";
    let tints = |text: &str| -> Vec<Tint> {
        let scene = parse(text);
        assert_eq!(parse(write(&scene)).colors, scene.colors);
        let tint = |value| match value {
            ColorValue::Hsv { tint, .. } => tint,
            other => panic!("{other:?}"),
        };
        scene.colors.iter().map(|color| tint(color.value)).collect()
    };
    let hues = "(ugstage 1 colors as-seen hues law report)";
    for text in [colors.to_string(), format!("{hues} {colors}"), format!("{colors} {hues}")] {
        assert_eq!(tints(&text), [Tint::Hue(546.1), Tint::Hue(700.0)]);
    }
    let wavelengths = "(ugstage 1 colors as-seen wavelengths law report)";
    for text in [format!("{wavelengths} {colors}"), format!("{colors} {wavelengths}")] {
        assert_eq!(tints(&text), [Tint::Wavelength(546.1), Tint::Wavelength(700.0)]);
    }
}

#[test]
fn it_is_written_after_the_head_comments() {
    let statement =
        "(ugstage 1 geometry as-seen eye 0 -12 3 time -5 colors as-seen hues law report lights)";
    check(
        &format!(
            "{{ head }} c red 1 0;\n(other)\n{{ above }}\n{statement} {{ behind }}\nv a 0 0 0;"
        ),
        &[
            "{ head }",
            "{ above }",
            &format!("{statement} {{ behind }}"),
            "(other)",
            "c red 1 0 1;",
            "v a 0 0 0;",
        ],
    );
    check(
        "(ugstage 1 colors as-seen wavelengths no-doppler law none\n geometry as-seen eye 1e0 .5 -0.0)",
        &[
            "(ugstage 1 geometry as-seen eye 1 0.5 -0 colors as-seen wavelengths law none no-doppler)",
        ],
    );
    check("( ugstage 1 geometry at-rest colors at-rest ) v a 0 0 0;", &["v a 0 0 0;"]);
    check("(ugstage 1)", &[]);
    // After an instance, too: escapes before and after it keep their order.
    check(
        "def d; (in) end; (one) i (d); (ugstage 1 geometry as-seen eye 0 0 0) (two)",
        &["(ugstage 1 geometry as-seen eye 0 0 0)", "(one)", "(in)", "(two)"],
    );
    // Escapes of other programs, even if they look similar.
    check("(ugstages 1)(stage)(uglorentz)", &["(ugstages 1)", "(stage)", "(uglorentz)"]);
}

#[test]
fn tidy_formats_it_word_by_word() {
    let tidied = |text: &str| {
        let text = ugparse::tidy(&Source::new("test.ug", text), &Options::default());
        text.map(|text| String::from_utf8(text).unwrap()).map_err(|found| found.render(false))
    };
    let laid_out =
        tidied("( ugstage\n1 geometry   at-rest colors as-seen  spectra no-flux ) v a 0 0 0;")
            .unwrap();
    assert_eq!(
        laid_out,
        "(ugstage 1 geometry at-rest colors as-seen spectra no-flux)\nv a 0 0 0;\n"
    );
    assert_eq!(tidied(&laid_out).unwrap(), laid_out);
    let numbers = tidied("(ugstage 1 geometry as-seen eye +1.50 1e0 0.0)").unwrap();
    assert_eq!(numbers, "(ugstage 1 geometry as-seen eye 1.5 1 0)\n");
    assert!(tidied("(ugstage 1 geometry seen)").unwrap_err().contains("test.ug:1:21"));
}

#[test]
#[rustfmt::skip] // rows of a table
fn errors_have_locations_and_remedies() {
    let check = |text: &str, place: &str, message: &str, help: &str| {
        let source = Source::new("test.ug", text);
        let found = ugparse::parse(&source, &Options::default()).unwrap_err();
        assert_eq!(found.list[0].message, message, "{text}");
        assert_eq!(found.list[0].help.as_deref(), Some(help), "{text}");
        let drawn = found.render(false);
        assert!(drawn.contains(&format!("--> test.ug:{place}\n")), "{drawn}");
    };
    let unexpected = |word: &str| format!("`{word}` is not expected here in the stage of a scene");
    check("v a 0 0 0;\n(ugstage 2 light)", "2:10", &unexpected("2"), "expected `1`");
    check("(ugstage)", "1:9", "a word is missing", "add `1`");
    check("(ugstage 1 geometri at-rest)", "1:12", &unexpected("geometri"), "did you mean `geometry`?");
    check("(ugstage 1 shape)", "1:12", &unexpected("shape"), "expected `geometry`, `colors`, `mixtures`");
    check("(ugstage 1 geometry)", "1:20", "a word is missing", "add `at-rest` or `as-seen`");
    check("(ugstage 1 geometry at_rest)", "1:21", &unexpected("at_rest"), "did you mean `at-rest`?");
    check("(ugstage 1 geometry as-seen time 1 colors at-rest)", "1:36", "the eye point of a geometry as seen is missing", "add `eye X Y Z`");
    check("(ugstage 1 geometry as-seen eye 0 0)", "1:36", "a number is missing", "add `0`");
    check("(ugstage 1 geometry as-seen eye 0 0,5 0)", "1:35", "`0,5` is not a number", "write a decimal point");
    check("(ugstage 1 geometry as-seen eye 0 nan 0)", "1:35", "`nan` is not a number", "every number must be finite");
    check(
        "(ugstage 1 geometry as-seen eye 0 0 0 camera-velocity 0 1.5 0)",
        "1:39",
        "speed is 1.5 c: it must be below 1 (velocities are fractions of the speed of light)",
        "give three numbers whose length is below 1",
    );
    check(
        "(ugstage 1 geometry as-seen eye 0 0 0 law report)",
        "1:39",
        &unexpected("law"),
        "expected `eye`, `time`, `camera-velocity`, `no-contraction`, `no-flight-time`, `whole`, \
         `colors`, `mixtures`",
    );
    check("(ugstage 1 colors as-seen)", "1:26", "a word is missing", "add `hues` or `wavelengths` or `spectra`");
    check("(ugstage 1 mixtures)", "1:20", "the prefix of mixtures is missing", "add `mix#`");
    check("(ugstage 1 mixtures mix)", "1:21", &unexpected("mix"), "did you mean `mix#`?");
    check("(ugstage 1 mixtures mix#1)", "1:21", &unexpected("mix#1"), "expected `mix#`");
    check("(ugstage 1 colors as-seen hues lights)", "1:38", "the brightness law of hues as seen is missing", "add `law report`");
    check("(ugstage 1 colors as-seen hues law photn)", "1:36", &unexpected("photn"), "did you mean `photon`?");
    check("(ugstage 1 colors as-seen spectra law none)", "1:35", &unexpected("law"), "expected `no-flux`, `no-doppler`, `lights`, `geometry`");
    check("(ugstage 1 colors as-seen hues law none no-flux)", "1:41", &unexpected("no-flux"), "expected `law`, `no-doppler`, `lights`, `geometry`");
    check("(ugstage 1 { why } colors at-rest)", "1:12", &unexpected("{"), "expected `geometry`, `colors`, `mixtures`");
    check("(ugstage 1 colors at-rest colors at-rest)", "1:27", "`colors` is given twice", "remove one of them");
    check(
        "(ugstage 1)\n(ugstage 1)",
        "2:2",
        "the stage of the scene is stated twice",
        "a scene has one stage: scenes of different stages cannot be joined",
    );
    check(
        "def d; (ugstage 1) end;",
        "1:9",
        "the stage of a scene cannot stand in a definition",
        "it applies to the whole scene: move it before the first statement",
    );
}
