//! Compares small pictures, one idea each, with the recorded ones, which somebody has reviewed.
//!
//! `UG_BLESS=1 cargo test -p ugtests golden` re-records them; review every change.

use glam::DVec3;
use ugphysics::Brightness;
use ugrainbow::{Background, ColorShift, Exposure, HueScale, Interpolation, Tone};
use ugtests::picture::{self, assert_golden, decode};
use ugtests::pipe::{Pipe, rainbow};
use ugtests::scenes;
use ugtests::shell::Shell;

const SIZE: [u32; 2] = [160, 120];

fn pipe(x: f64, y: f64, z: f64) -> Pipe {
    Pipe::new(DVec3::new(x, y, z), SIZE)
}

fn check(name: &str, scene: &str, pipe: &Pipe) {
    assert_golden(name, &pipe.draw(&scenes::text(scene)));
}

#[test]
fn ship_at_rest() {
    check("ship-at-rest", "ship", &pipe(0.0, 0.0, 0.0));
}

#[test]
fn terrell_rotation() {
    check("terrell-rotation-ship-0.9c", "ship", &pipe(0.9, 0.0, 0.0).in_place().shape());
}

#[test]
fn without_flight_time_only_contraction_is_left() {
    let mut ship = pipe(0.9, 0.0, 0.0).shape();
    ship.lorentz.geometry.flight_time = false;
    check("contraction-alone-ship-0.9c", "ship", &ship);
}

#[test]
fn a_wide_filter_smooths_edges() {
    let mut ship = pipe(0.5, 0.0, 0.0).in_place().shape();
    ship.rainbow.picture.filter = ugrainbow::Filter::Spline;
    check("spline-filter-ship-0.5c", "ship", &ship);
}

#[test]
fn rays_bend_edges_that_are_not_cut() {
    let mut cubes = pipe(0.95, 0.0, 0.0).in_place();
    cubes.lorentz.pieces = uglorentz::Pieces::PerEdge(1);
    cubes.rainbow.exact = Some(ColorShift::NONE);
    let seen = ugtests::pipe::lorentz(&scenes::text("cubes"), &cubes.lorentz);
    assert_golden("exact-edges-cubes-0.95c", &decode(&rainbow(&seen, &cubes.rainbow)));
}

#[test]
fn straight_edges_bend() {
    check("bent-edges-cubes-0.95c", "cubes", &pipe(0.95, 0.0, 0.0).in_place().shape());
}

#[test]
fn spheres_stay_round() {
    check("round-outline-sphere-0.95c", "sphere", &pipe(0.95, 0.0, 0.0).in_place().shape());
}

#[test]
fn smooth_things() {
    check("smooth-shading-teapot-0.95c", "teapot", &pipe(0.95, 0.0, 0.0).in_place().shape());
}

#[test]
fn aberration_shows_what_is_behind() {
    let mut street = pipe(0.0, -0.99, 0.0).shape();
    street.lorentz.eye = Some(DVec3::new(0.0, 40.0, 3.0));
    check("aberration-street-0.99c", "street", &street);
}

#[test]
fn aberration_backward_is_a_telescope() {
    check("telescope-street-backward-0.9c", "street", &pipe(0.0, 0.9, 0.0).shape());
}

#[test]
fn a_plane_that_was_passed_is_seen_ahead() {
    let mut grid = pipe(0.0, -0.9, 0.0).shape();
    grid.lorentz.eye = Some(DVec3::new(0.0, 0.5, 0.0));
    check("passed-grid-seen-ahead-0.9c", "grid", &grid);
}

#[test]
fn doppler_makes_a_ring() {
    check("doppler-ring-lattice-0.9c", "lattice", &pipe(0.0, -0.9, 0.0).view_angle(120.0));
}

#[test]
fn doppler_shifts_both_ways() {
    check("blueshift-ship-0.2c", "ship", &pipe(0.0, -0.2, 0.0).in_place());
    check("redshift-ship-0.2c", "ship", &pipe(0.0, 0.2, 0.0).in_place());
}

#[test]
fn the_iris_scales_what_is_too_bright() {
    let mut cubes = pipe(0.0, -0.15, 0.0).in_place();
    cubes.doppler.iris = true;
    check("iris-cubes-approaching-0.15c", "cubes", &cubes);
}

#[test]
fn every_body_has_its_own_velocity() {
    let mut dice = Pipe::default().in_place().shape();
    dice.rainbow.picture.size = SIZE;
    check("five-velocities-dice", "dice", &dice);
}

#[test]
fn the_camera_moves_among_cars() {
    let mut traffic = Pipe::default().shape();
    traffic.lorentz.anchor = Some(uglorentz::Anchor::Center);
    traffic.rainbow.picture.size = SIZE;
    check("moving-camera-traffic", "traffic", &traffic);
}

/// Bluer ahead, with the brightness at rest: figure 3c of Weiskopf 2000.
#[test]
fn a_tunnel_of_black_bodies_turns_blue_ahead() {
    let mut tunnel = Pipe::default();
    tunnel.lorentz.camera_velocity = Some(DVec3::new(0.0, 0.6, 0.0));
    tunnel.rainbow.picture.size = SIZE;
    tunnel.doppler.shift = ColorShift::spectra(true, false);
    check("doppler-alone-tunnel-0.6c", "tunnel", &tunnel);
}

/// Approaching, at rest and receding, all at 3000 K: they appear as 3674, 3000 and 2449 K, with D⁵.
#[test]
fn black_bodies_change_their_temperature() {
    const BODIES: &[u8] = b"c_bb ember 3000 1;
        def square; v a -.9 10 -.9; v b .9 10 -.9; v c .9 10 .9; v d -.9 10 .9; f (a b c d) ember; end;
        i (square -tx -2) <0 -.2 0>; i (square); i (square -tx 2) <0 .2 0>; l 1;
        cam -ep 0 0 0 -vc 0 9 0 -ud 0 0 1 -va 44 33;";
    let mut bodies = Pipe::default().in_place();
    bodies.rainbow.picture.size = SIZE;
    bodies.doppler.shift = ColorShift::SPECTRA;
    bodies.rainbow.picture.exposure = Some(Exposure::Auto);
    bodies.rainbow.picture.tone = Tone::Filmic;
    assert_golden("filmic-black-bodies-0.2c", &bodies.draw(BODIES));
}

#[test]
fn a_lamp_that_moves_makes_a_rainbow() {
    let mut lamp = Pipe::default();
    lamp.rainbow.picture.size = SIZE;
    lamp.doppler.light = true;
    check("rainbow-under-a-lamp-0.4c", "lamp", &lamp);
}

/// Lights at rest behind the pot: in its frame they are ahead.
#[test]
fn lights_behind_light_the_front() {
    let mut pot = pipe(0.6, 0.0, 0.0).in_place();
    pot.doppler.light = true;
    pot.doppler.shift = ColorShift::hues(false, Brightness::Report);
    pot.doppler.iris = true;
    let text = String::from_utf8(scenes::text("teapot")).unwrap();
    let lights = "l 1 0 -1 0 <0 0 0>; l 1 1 1 0 <0 0 0>; l 1 -1 1 0 <0 0 0>;";
    let text = text.replace("\nl 0.3 ;", &format!("\n{lights}")).replace("\nl sun 0.7 -0.2 -0.8 0.7 ;", "");
    assert_golden("lights-at-rest-teapot-0.6c", &pot.draw(text.as_bytes()));
}

#[test]
fn colours_meet_at_vertices() {
    let mut halves = pipe(0.0, 0.0, 0.0);
    check("colours-mixed-halves", "halves", &halves);
    halves.doppler.repeat = true;
    check("colours-repeated-halves", "halves", &halves);
}

#[test]
fn the_rainbow_of_1988() {
    let config = ugrainbow::Config {
        picture: ugrainbow::PictureOptions { size: SIZE, ..ugrainbow::PictureOptions::default() },
        hue_scale: HueScale::Wavelengths,
        ..Default::default()
    };
    assert_golden("wavelengths-380-to-780-rainbow", &decode(&rainbow(&scenes::text("rainbow"), &config)));
}

/// Interpolation from red to blue passes through the spectrum, at different places by hue and by
/// wavelength.
#[test]
fn hue_and_wavelength() {
    const STRIPES: &[u8] = b"c red 1 0; c blue 1 240; c white 1; l 1;
        v a -2 9 .6 red; v b 2 9 .6 blue; v c 2 9 1.4 blue; v d -2 9 1.4 red; f (a b c d);
        v e -2 9 -.4 white; v f 2 9 -.4 blue; v g 2 9 .4 blue; v h -2 9 .4 white; f (e f g h);
        v i -2 9 -1.4 red; v j 2 9 -1.4 white; v k 2 9 -.6 white; v l -2 9 -.6 red; f (i j k l);
        cam -ep 0 0 0 -vc 0 9 0 -ud 0 0 1 -va 30 22;";
    for (name, interpolation) in
        [("interpolated-hue", Interpolation::Hue), ("interpolated-wavelength", Interpolation::Wavelength)]
    {
        let config = ugrainbow::Config {
            picture: ugrainbow::PictureOptions { size: SIZE, ..ugrainbow::PictureOptions::default() },
            interpolation,
            ..Default::default()
        };
        assert_golden(name, &decode(&rainbow(STRIPES, &config)));
    }
}

/// Edges are partly transparent.
#[test]
fn transparent_background() {
    let mut cubes = pipe(0.6, 0.0, 0.0).in_place().shape();
    cubes.rainbow.picture.background = Background::Transparent;
    check("transparent-background-cubes", "cubes", &cubes);
}

/// Wires follow the bent edges of faces.
#[test]
fn wires_follow_edges() {
    // The wires have their own vertices, so that their colour is not mixed with that of the faces.
    const BOX: &[u8] = b"c pale 0.7 200 0.3; c line 1 55 0.9; l 1;
        def corners; v a -1 7 -1; v b 1 7 -1; v c 1 7 1; v d -1 7 1; v e -1 9 -1; v f 1 9 -1; v g 1 9 1; v h -1 9 1;
        f (a b c d); f (e a d h); f (b f g c); f (f e h g); f (d c g h); f (e f b a); end;
        def edges; v a -1 7 -1; v b 1 7 -1; v c 1 7 1; v d -1 7 1; v e -1 9 -1; v f 1 9 -1; v g 1 9 1; v h -1 9 1;
        w (a b c d a); w (e f g h e); w (a e); w (b f); w (c g); w (d h); end;
        i (corners pale); i (edges line);
        cam -ep 0 0 2 -vc 0 8 0 -ud 0 0 1 -va 30 22;";
    assert_golden("wires-on-a-box-0.9c", &pipe(0.9, 0.0, 0.0).in_place().shape().draw(BOX));
}

#[test]
fn captions_and_legends_stand_below() {
    let mut ship = Pipe::new(DVec3::new(0.3, 0.0, 0.0), [400, 300]).in_place();
    ship.rainbow.picture.annotations.caption = "A ship at 0.3c (γ = 1.048)".into();
    ship.rainbow.picture.annotations.legend = true;
    check("caption-and-legend-ship-0.3c", "ship", &ship);
}

#[test]
fn outlines_show_what_is_not_distorted() {
    let mut teapot = Pipe::new(DVec3::new(0.95, 0.0, 0.0), [320, 240]).in_place().shape();
    teapot.rainbow.picture.annotations.outline = true;
    teapot.rainbow.picture.annotations.grid = true;
    teapot.rainbow.picture.background =
        Background::Color(ugphysics::Hsv { hue: 0.0, saturation: 0.0, value: 1.0 });
    check("undistorted-outline-and-grid-teapot-0.95c", "teapot", &teapot);
}

/// Runs commands beside these scenes, and compares the pictures of these names that they write.
#[track_caller]
fn check_commands(scenes: &[&str], commands: &str, names: &[&str]) {
    let shell = Shell::new(scenes);
    shell.run(commands);
    for name in names {
        assert_golden(name, &picture::read(&shell.path(&format!("{name}.png"))));
    }
}

#[test]
fn rays_show_mirrors_shadows_and_glass() {
    const SHAPES: &str = "-look 1988 --no-doppler --no-flux -bg .8 210 .25 -aa 3 -sz 160 120 -in";
    for (name, options) in [
        ("rays-cube-and-its-mirror-image-0.9c", "mirrors.ug"),
        ("rays-shadow-lags-0.95c", "shadow.ug"),
        ("rays-glass-cube-in-a-room", "room.ug"),
        ("rays-glass-of-water-0.8c", "-rd 64 -rc .05 water.ug"),
        ("rays-panorama-of-a-room", "-pan room.ug"),
        ("rays-stereo-shadow-0.95c", "-stereo .6 shadow.ug"),
    ] {
        let scene = options.rsplit(' ').next().unwrap();
        check_commands(&[scene], &format!("ugphoton {SHAPES} {options} -fo {name}.png"), &[name]);
    }
}

#[test]
fn panoramas_are_warped_and_stars_drawn() {
    check_commands(
        &["street.ug", "stars.csv"],
        "set -e; ugphoton -look 1988 -pan -sz 512 256 -aa 2 street.ug -fo sky.png
         ugwarp -look 1988 -cv 0 .5 0 -va 90 -sz 160 120 sky.png -fo warp-street-0.5c.png
         ugwarp -look 1988 -cv 0 .9 0 -va 90 -ex auto -sz 160 120 stars.csv -fo warp-stars-0.9c.png",
        &["warp-street-0.5c", "warp-stars-0.9c"],
    );
}

#[test]
fn frames_of_a_film_follow_a_shadow() {
    check_commands(
        &["shadow.ug"],
        "ugfilm -look 1988 -rays -frames 3 -ti -3..3 -vel .9 0 0 -in --no-doppler --no-flux -bg .8 210 .25 \
         -sz 96 72 -aa 2 shadow.ug -fo film-shadow-lags-0.9c-%d.png",
        &["film-shadow-lags-0.9c-1", "film-shadow-lags-0.9c-2", "film-shadow-lags-0.9c-3"],
    );
}
