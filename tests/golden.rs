//! Compares small pictures, one idea each, with the recorded ones, which somebody has reviewed.
//!
//! `UG_BLESS=1 cargo test -p ugtests golden` re-records them; review every change.

use rayon::prelude::*;
use ugtests::picture::{self, assert_golden};
use ugtests::shell::Shell;

/// Definitions for all commands: the last two programs of a pipe, and of one that shows the shape
/// alone; the looks of rays; scenes.
const DEFINITIONS: &str = r#"set -e
draw() { ugdoppler -qt | ugrainbow -qt -sz 160 120 "$@"; }
shape() { ugdoppler -qt --no-doppler --no-flux | ugrainbow -qt -sz 160 120 "$@"; }
rays() { ugphoton -qt -look 1988 --no-doppler --no-flux -bg .8 210 .25 -aa 3 -sz 160 120 -in "$@"; }
bodies() { echo 'c_bb ember 3000 1;
    def square; v a -.9 10 -.9; v b .9 10 -.9; v c .9 10 .9; v d -.9 10 .9; f (a b c d) ember; end;
    i (square -tx -2) <0 -.2 0>; i (square); i (square -tx 2) <0 .2 0>; l 1;
    cam -ep 0 0 0 -vc 0 9 0 -ud 0 0 1 -va 44 33;'; }
stripes() { echo 'c red 1 0; c blue 1 240; c white 1; l 1;
    v a -2 9 .6 red; v b 2 9 .6 blue; v c 2 9 1.4 blue; v d -2 9 1.4 red; f (a b c d);
    v e -2 9 -.4 white; v f 2 9 -.4 blue; v g 2 9 .4 blue; v h -2 9 .4 white; f (e f g h);
    v i -2 9 -1.4 red; v j 2 9 -1.4 white; v k 2 9 -.6 white; v l -2 9 -.6 red; f (i j k l);
    cam -ep 0 0 0 -vc 0 9 0 -ud 0 0 1 -va 30 22;'; }
# The wires have their own vertices, so that their colour is not mixed with that of the faces.
boxed() { echo 'c pale 0.7 200 0.3; c line 1 55 0.9; l 1;
    def corners; v a -1 7 -1; v b 1 7 -1; v c 1 7 1; v d -1 7 1; v e -1 9 -1; v f 1 9 -1; v g 1 9 1; v h -1 9 1;
    f (a b c d); f (e a d h); f (b f g c); f (f e h g); f (d c g h); f (e f b a); end;
    def edges; v a -1 7 -1; v b 1 7 -1; v c 1 7 1; v d -1 7 1; v e -1 9 -1; v f 1 9 -1; v g 1 9 1; v h -1 9 1;
    w (a b c d a); w (e f g h e); w (a e); w (b f); w (c g); w (d h); end;
    i (corners pale); i (edges line); cam -ep 0 0 2 -vc 0 8 0 -ud 0 0 1 -va 30 22;'; }
# Lights at rest behind the pot: in its frame they are ahead.
lit_pot() { sed 's/^l 0.3 ;/l 1 0 -1 0 <0 0 0>; l 1 1 1 0 <0 0 0>; l 1 -1 1 0 <0 0 0>;/; /^l sun/d' teapot.ug; }
"#;

/// Name of the picture, and the command that writes it to standard output.
const PICTURES: [(&str, &str); 36] = [
    ("ship-at-rest", "uglorentz -vel 0 0 0 ship.ug | draw"),
    ("terrell-rotation-ship-0.9c", "uglorentz -vel .9 0 0 -in ship.ug | shape"),
    ("contraction-alone-ship-0.9c", "uglorentz -vel .9 0 0 --no-flight-time ship.ug | shape"),
    ("spline-filter-ship-0.5c", "uglorentz -vel .5 0 0 -in ship.ug | shape -fl spline"),
    (
        "exact-edges-cubes-0.95c",
        "uglorentz -vel .95 0 0 -in -sd 1 cubes.ug | ugrainbow -xc --no-doppler --no-flux -sz 160 120",
    ),
    ("bent-edges-cubes-0.95c", "uglorentz -vel .95 0 0 -in cubes.ug | shape"),
    ("round-outline-sphere-0.95c", "uglorentz -vel .95 0 0 -in sphere.ug | shape"),
    ("smooth-shading-teapot-0.95c", "uglorentz -vel .95 0 0 -in teapot.ug | shape"),
    ("aberration-street-0.99c", "uglorentz -vel 0 -.99 0 -ep 0 40 3 street.ug | shape"),
    ("telescope-street-backward-0.9c", "uglorentz -vel 0 .9 0 street.ug | shape"),
    ("passed-grid-seen-ahead-0.9c", "uglorentz -vel 0 -.9 0 -ep 0 .5 0 grid.ug | shape"),
    ("doppler-ring-lattice-0.9c", "uglorentz -vel 0 -.9 0 lattice.ug | draw -va 120"),
    ("blueshift-ship-0.2c", "uglorentz -vel 0 -.2 0 -in ship.ug | draw"),
    ("redshift-ship-0.2c", "uglorentz -vel 0 .2 0 -in ship.ug | draw"),
    (
        "iris-cubes-approaching-0.15c",
        "uglorentz -vel 0 -.15 0 -in cubes.ug | ugdoppler -ir | ugrainbow -sz 160 120",
    ),
    ("five-velocities-dice", "uglorentz -in dice.ug | shape"),
    ("moving-camera-traffic", "uglorentz -an center traffic.ug | shape"),
    // Bluer ahead, with the brightness at rest: figure 3c of Weiskopf 2000.
    (
        "doppler-alone-tunnel-0.6c",
        "uglorentz -cv 0 .6 0 tunnel.ug | ugdoppler -sp --no-flux | ugrainbow -sz 160 120",
    ),
    // Approaching, at rest and receding, all at 3000 K: they appear as 3674, 3000 and 2449 K, with
    // D⁵.
    (
        "filmic-black-bodies-0.2c",
        "bodies | uglorentz -in | ugdoppler -sp | ugrainbow -ex auto -tc filmic -sz 160 120",
    ),
    ("rainbow-under-a-lamp-0.4c", "uglorentz lamp.ug | ugdoppler -li | ugrainbow -sz 160 120"),
    (
        "lights-at-rest-teapot-0.6c",
        "lit_pot | uglorentz -vel .6 0 0 -in | ugdoppler -li -ir --no-doppler | ugrainbow -sz 160 120",
    ),
    ("colours-mixed-halves", "uglorentz -vel 0 0 0 halves.ug | draw"),
    (
        "colours-repeated-halves",
        "uglorentz -vel 0 0 0 halves.ug | ugdoppler -vr | ugrainbow -sz 160 120",
    ),
    ("wavelengths-380-to-780-rainbow", "ugrainbow -wi -sz 160 120 rainbow.ug"),
    // Interpolation from red to blue passes through the spectrum, at different places by hue and by
    // wavelength.
    ("interpolated-hue", "stripes | ugrainbow -sz 160 120"),
    ("interpolated-wavelength", "stripes | ugrainbow -iw -sz 160 120"),
    // Edges are partly transparent.
    ("transparent-background-cubes", "uglorentz -vel .6 0 0 -in cubes.ug | shape -tb"),
    ("wires-on-a-box-0.9c", "boxed | uglorentz -vel .9 0 0 -in | shape"),
    (
        "caption-and-legend-ship-0.3c",
        "uglorentz -vel .3 0 0 -in ship.ug | ugdoppler | ugrainbow -lg -cap 'A ship at 0.3c (γ = 1.048)' -sz 400 300",
    ),
    (
        "undistorted-outline-and-grid-teapot-0.95c",
        "uglorentz -vel .95 0 0 -in teapot.ug | ugdoppler --no-doppler --no-flux | ugrainbow -dl -gr -bg 1 -sz 320 240",
    ),
    ("rays-cube-and-its-mirror-image-0.9c", "rays mirrors.ug"),
    ("rays-shadow-lags-0.95c", "rays shadow.ug"),
    ("rays-glass-cube-in-a-room", "rays room.ug"),
    ("rays-glass-of-water-0.8c", "rays -rd 64 -rc .05 water.ug"),
    ("rays-panorama-of-a-room", "rays -pan room.ug"),
    ("rays-stereo-shadow-0.95c", "rays -stereo .6 shadow.ug"),
];

/// Runs a command beside these scenes, and compares the pictures of these names that it writes.
#[track_caller]
fn check(scenes: &[&str], command: &str, names: &[&str]) {
    let shell = Shell::new(scenes);
    shell.run(command);
    for name in names {
        assert_golden(name, &picture::read(&shell.path(&format!("{name}.png"))));
    }
}

#[test]
fn pictures_are_those_recorded() {
    PICTURES.par_iter().for_each(|(name, command)| {
        let words =
            format!("{command}{}", if command.contains("lit_pot") { " teapot.ug" } else { "" });
        let scenes: Vec<&str> = words.split(' ').filter(|word| word.ends_with(".ug")).collect();
        check(&scenes, &format!("{DEFINITIONS}{{ {command}; }} > {name}.png"), &[name]);
    });
}

#[test]
fn panoramas_are_warped_and_stars_drawn() {
    check(
        &["street.ug", "stars.csv"],
        "set -e; ugphoton -look 1988 -pan -sz 512 256 -aa 2 street.ug -fo sky.png
         ugwarp -look 1988 -cv 0 .5 0 -va 90 -sz 160 120 sky.png -fo warp-street-0.5c.png
         ugwarp -look 1988 -cv 0 .9 0 -va 90 -ex auto -sz 160 120 stars.csv -fo warp-stars-0.9c.png",
        &["warp-street-0.5c", "warp-stars-0.9c"],
    );
}

#[test]
fn frames_of_a_film_follow_a_shadow() {
    check(
        &["shadow.ug"],
        "ugfilm -look 1988 -rays -frames 3 -ti -3..3 -vel .9 0 0 -in --no-doppler --no-flux -bg .8 210 .25 \
         -sz 96 72 -aa 2 shadow.ug -fo film-shadow-lags-0.9c-%d.png",
        &["film-shadow-lags-0.9c-1", "film-shadow-lags-0.9c-2", "film-shadow-lags-0.9c-3"],
    );
}
