//! Published and independently computed numbers.

use glam::DVec3;
use ugphysics::{
    Brightness, Velocity, aberrate, compose, contracted, doppler_at, doppler_factor, flight_time,
    observer_shift, rest_position, seen_position,
};

use crate::laws::{circle_through, sphere_outline};
use crate::{along_x, angle_deg, at_angle, beta, near, near_vector};

/// The numbers are given to ten digits.
const TEN_DIGITS: f64 = 1e-9;

/// A distance at which a body of size 1 is small: second-order terms are 10⁻¹², rounding is 10⁻¹⁰.
const FAR: f64 = 1e6;

/// Rest coordinates of a point seen from afar, with `angle` degrees between its motion along +x and
/// the direction from it to the eye.
fn far_point(angle: f64, v: Velocity) -> DVec3 {
    rest_position(-FAR * at_angle(angle), v)
}

#[test]
fn t02_retarded_position() {
    let check = |now: [f64; 3], v: [f64; 3], w: f64, seen: [f64; 3]| {
        let (now, v) = (DVec3::from(now), Velocity::from_beta(DVec3::from(v)).unwrap());
        near("w", flight_time(now, v), w, TEN_DIGITS);
        near_vector("p", now + flight_time(now, v) * v.beta(), DVec3::from(seen), TEN_DIGITS);
        // The point at rest at p' is at p₀ now: undo the contraction.
        let p_rest = now + (v.gamma() - 1.0) * now.dot(v.direction()) * v.direction();
        near_vector("seen", seen_position(p_rest, v), DVec3::from(seen), TEN_DIGITS);
    };
    check([3.0, 4.0, 0.0], [0.5, 0.0, 0.0], -4.110100927, [0.9449495367, 4.0, 0.0]);
    check([0.0, 1.0, 0.0], [0.9, 0.0, 0.0], -2.294157339, [-2.064741605, 1.0, 0.0]);
    check([1.0, 2.0, 3.0], [0.3, -0.4, 0.5], -3.656854249, [-0.09705627485, 3.4627417, 1.171572875]);
}

#[test]
fn t03_on_axis() {
    let v = along_x(0.9);
    near("approaching", -flight_time(DVec3::NEG_X, v), 10.0, 1e-13);
    near("receding", -flight_time(DVec3::X, v), 0.5263157895, TEN_DIGITS);
}

#[test]
fn t04_apparent_radial_speed() {
    for (speed, coming, going) in
        [(0.5, 1.0, 0.3333333333), (0.9, 9.0, 0.4736842105), (0.99, 99.0, 0.4974874372)]
    {
        let v = along_x(speed);
        let radial = |side: f64| {
            let at =
                |t: f64| seen_position(DVec3::new(side * 1e4, 0.0, 0.0) + observer_shift(v, t), v).length();
            (at(1.0) - at(0.0)).abs()
        };
        near("coming", radial(-1.0), coming, TEN_DIGITS);
        near("going", radial(1.0), going, TEN_DIGITS);
    }
}

#[test]
fn t05_superluminal_transverse_speed() {
    for (speed, angle, want) in [(0.9, 25.84193276, 2.064741605), (0.99, 10.0, 6.865394087)] {
        let v = along_x(speed);
        let (p, sight) = (far_point(angle, v), at_angle(angle));
        let at = |t: f64| seen_position(p + observer_shift(v, t), v).reject_from(sight);
        near("transverse", (at(1.0) - at(-1.0)).length() / 2.0, want, TEN_DIGITS);
    }
}

#[test]
fn t06_rod_end_on() {
    for (speed, coming, going) in [(0.5, 1.732050808, 0.5773502692), (0.9, 4.358898944, 0.2294157339)] {
        let v = along_x(speed);
        let seen_length = |from: f64| {
            let [near_end, far_end] = [from, 2.0 * from].map(|x| seen_position(DVec3::new(x, 0.0, 0.0), v));
            (far_end - near_end).length()
        };
        near("coming", seen_length(-1.0), coming, TEN_DIGITS);
        near("going", seen_length(1.0), going, TEN_DIGITS);
    }
}

#[test]
fn t07_distant_rod_along_the_motion() {
    let v = along_x(0.9);
    for (angle, extent) in [
        (0.0, 4.358898944),
        (30.0, 1.976133615),
        (60.0, 0.792527081),
        (90.0, 0.435889894),
        (120.0, 0.30061372),
        (180.0, 0.229415734),
    ] {
        let p = far_point(angle, v);
        let [tail, head] = [-0.5, 0.5].map(|x| seen_position(p + x * DVec3::X, v));
        near("extent", (head - tail).x, extent, 2e-9);
        near("D", doppler_factor(at_angle(angle), v), extent, TEN_DIGITS);
    }
}

#[test]
fn t08_terrell_rotation() {
    for (speed, angle, rotation) in [
        (0.5, 90.0, 30.0),
        (0.6, 90.0, 36.86989765),
        (0.8, 90.0, 53.13010235),
        (0.9, 90.0, 64.15806724),
        (0.99, 90.0, 81.89038554),
        (0.9, 30.0, 68.86030714),
        (0.9, 60.0, 76.65824177),
        (0.9, 120.0, 44.90981482),
        (0.5, 30.0, 19.79218128),
        (0.5, 60.0, 30.0),
        (0.5, 120.0, 23.13010235),
    ] {
        let v = along_x(speed);
        near("rotation", angle_deg(-far_point(angle, v), DVec3::X) - angle, rotation, TEN_DIGITS);
    }
}

#[test]
fn t09_distant_cube_side_on() {
    for (speed, total) in [(0.9, 1.335889894), (0.6, 1.4), (0.8, 1.4)] {
        let v = along_x(speed);
        let p = far_point(90.0, v);
        let width =
            |edge: DVec3| (seen_position(p + 0.5 * edge, v) - seen_position(p - 0.5 * edge, v)).x.abs();
        near("front face", width(DVec3::X), 1.0 / v.gamma(), 1e-9);
        near("trailing face", width(DVec3::Y), speed, 1e-9);
        near("both", width(DVec3::X) + width(DVec3::Y), total, 2e-9);
    }
}

#[test]
fn t10_straight_edge_is_a_hyperbola() {
    let v = along_x(0.9);
    let x = |y: f64| seen_position(DVec3::new(0.0, y, 1.0), v).x;
    for (y, want) in [(0.0, -2.064741605), (0.5, -2.308451292), (1.0, -2.91998558)] {
        near("x", x(y), want, TEN_DIGITS);
    }
    near("sagitta", x(0.0) - x(1.0), 0.8552439755, TEN_DIGITS);
    // Greatest distance from N equal chords, computed by ternary search in another program. It
    // approaches a quarter per doubling of N.
    for (n_segments, want) in [
        (1, 0.8552439755),
        (2, 0.1854556668),
        (4, 0.0583567345),
        (8, 0.01570530503),
        (16, 0.004005382346),
        (32, 0.001006455613),
    ] {
        let width = 2.0 / f64::from(n_segments);
        let errors = (0..n_segments).map(|i| {
            let y = -1.0 + width * f64::from(i);
            let slope = (x(y + width) - x(y)) / width;
            // The curve is furthest from its chord where it is parallel to it.
            let sine = -slope / v.proper_speed();
            let touch = sine / (1.0 - sine * sine).sqrt();
            (x(touch) - (x(y) + slope * (touch - y))).abs()
        });
        near("chord error", errors.fold(0.0, f64::max), want, 1e-10);
    }
}

#[test]
fn t11_sphere_outline() {
    for (speed, radius, axis_angle, centre_angle) in
        [(0.9, 8.760949008, 152.8103814, 154.1580672), (0.5, 17.02386618, 118.5608252, 120.0)]
    {
        let v = along_x(speed);
        let outline = sphere_outline(DVec3::Y, 1.0 / 3.0, v, 360);
        let (axis, radius_deg) = circle_through(&outline);
        near("angular radius", radius_deg, radius, TEN_DIGITS);
        near("circle's axis", angle_deg(axis, DVec3::X), axis_angle, TEN_DIGITS);
        near(
            "centre's image",
            angle_deg(seen_position(3.0 * DVec3::Y, v), DVec3::X),
            centre_angle,
            TEN_DIGITS,
        );
        let level = outline[0].dot(axis);
        for d in outline {
            near("planar", d.dot(axis), level, 1e-14);
        }
    }
}

#[test]
fn t12_sphere_on_the_line_of_motion() {
    for (speed, coming, going) in [(0.9, 1.31769992, 24.65001879), (0.5, 3.315359556, 9.923969916)] {
        let v = along_x(speed);
        let radius = |side: f64| circle_through(&sphere_outline(side * DVec3::X, 0.1, v, 36)).1;
        near("coming", radius(-1.0), coming, TEN_DIGITS);
        near("going", radius(1.0), going, TEN_DIGITS);
    }
}

#[test]
fn t13_aberration() {
    let angles = [30.0, 45.0, 60.0, 90.0, 120.0, 150.0];
    for (speed, seen) in [
        (0.5, [17.58795377, 26.89895105, 36.86989765, 60.0, 90.0, 130.2078187]),
        (0.9, [7.035292197, 10.8567036, 15.09018518, 25.84193276, 43.34175823, 81.13969286]),
        (0.99, [2.17633788, 3.363764931, 4.687304325, 8.109614456, 13.9996913, 29.63713015]),
    ] {
        for (angle, want) in angles.into_iter().zip(seen) {
            let d = aberrate(at_angle(angle), along_x(speed));
            near("aberration", angle_deg(d, DVec3::X), want, TEN_DIGITS);
            // The half-angle form, which is also the stereographic one (T16).
            let stretch = ((1.0 - speed) / (1.0 + speed)).sqrt();
            let half = libm::atan(stretch * libm::tan(angle.to_radians() / 2.0));
            near("half angle", angle_deg(d, DVec3::X), 2.0 * half.to_degrees(), 1e-13);
        }
    }
    near("Weiskopf's (1)", aberrate(at_angle(60.0), along_x(0.9)).x, 0.9655172414, TEN_DIGITS);
    near("inverse", aberrate(at_angle(60.0), along_x(-0.9)).x, -0.7272727273, TEN_DIGITS);
}

#[test]
fn t14_headlight() {
    for (speed, half_angle) in [(0.9, 25.84193276), (0.99, 8.109614456), (0.999, 2.562558733)] {
        // Light emitted at right angles in the body's frame.
        let n = -aberrate(DVec3::NEG_Y, along_x(-speed));
        near("half angle", angle_deg(n, DVec3::X), half_angle, TEN_DIGITS);
    }
}

#[test]
fn t15_field_of_view() {
    for (speed, forward, backward, radius) in [
        (0.5, 240.0, 120.0, 1.732050808),
        (0.9, 308.3161345, 51.68386553, 0.4843221048),
        (0.99, 343.7807711, 16.21922891, 0.1424922826),
    ] {
        // The scene moves towards a camera that looks along +x: its frame has velocity −x.
        let view = |angle: f64, sign: f64| {
            2.0 * angle_deg(aberrate(at_angle(angle), along_x(sign * speed)), DVec3::X)
        };
        near("forward", view(90.0, -1.0), forward, TEN_DIGITS);
        near("backward", view(90.0, 1.0), backward, TEN_DIGITS);
        let edge = aberrate(DVec3::Y, along_x(speed));
        near("radius of the forward hemisphere", edge.y / edge.x, radius, TEN_DIGITS);
    }
    for (speed, forward, backward) in [(0.5, 99.58436256, 35.17590755), (0.9, 197.7206143, 14.07058439)] {
        let view = |sign: f64| 2.0 * angle_deg(aberrate(at_angle(30.0), along_x(sign * speed)), DVec3::X);
        near("60° camera, forward", view(-1.0), forward, TEN_DIGITS);
        near("60° camera, backward", view(1.0), backward, TEN_DIGITS);
    }
}

#[test]
fn t17_astronomers_aberration() {
    // The test vector of ERFA's `ab`, without the Sun's potential. A first-order code is off by
    // 10⁻⁹.
    let natural = DVec3::new(-0.763_219_685_467_379_5, -0.608_694_539_830_603_8, -0.216_764_085_806_398_83);
    let v = beta(2.104_401_889_365_378_6e-5, -8.910_892_330_442_932e-5, -3.863_371_479_771_657e-5);
    near("1/γ", 1.0 / v.gamma(), 0.999_999_995_062_092_6, 1e-15);
    let got = aberrate(natural, v);
    let want = DVec3::new(-0.763_163_109_423_072_9, -0.608_755_308_249_359_3, -0.216_792_626_936_283_6);
    near_vector("direction", got, want, 1e-12);
    near("shift, arc seconds", 3600.0 * angle_deg(got, natural), 18.10935178, TEN_DIGITS);
}

#[test]
fn t18_constant_of_aberration() {
    for (km_per_s, arc_seconds) in [(29.789, 20.49558673), (29.7847, 20.49262822)] {
        let shifted = aberrate(DVec3::Y, along_x(km_per_s / 299_792.458));
        near("shift", 3600.0 * angle_deg(shifted, DVec3::Y), arc_seconds, TEN_DIGITS);
    }
}

#[test]
fn t19_doppler() {
    for (speed, coming, going, abeam) in [
        (0.5, 1.732050808, 0.5773502692, 0.8660254038),
        (0.6, 2.0, 0.5, 0.8),
        (0.8, 3.0, 0.3333333333, 0.6),
        (0.9, 4.358898944, 0.2294157339, 0.4358898944),
        (0.99, 14.10673598, 0.0708881205, 0.1410673598),
    ] {
        let v = along_x(speed);
        near("coming", doppler_factor(DVec3::X, v), coming, TEN_DIGITS);
        near("going", doppler_factor(DVec3::NEG_X, v), going, TEN_DIGITS);
        near("abeam", doppler_factor(DVec3::Z, v), abeam, TEN_DIGITS);
        // Abeam in the source's rest frame: γ.
        near("abeam in the rest frame", doppler_at(seen_position(DVec3::Y, v), v), v.gamma(), 1e-14);
    }
    for (cos_in_body, cos_seen, doppler) in [
        (1.0, 1.0, 2.0),
        (0.5, 0.8461538462, 1.625),
        (0.0, 0.6, 1.25),
        (-0.5, 0.1428571429, 0.875),
        (-1.0, -1.0, 0.5),
    ] {
        let v = along_x(0.6);
        let n_in_body = at_angle(libm::acos(cos_in_body).to_degrees());
        let n = -aberrate(-n_in_body, -v);
        near("cos", n.x, cos_seen, TEN_DIGITS);
        near("D", doppler_factor(n, v), doppler, 1e-14);
        near("1/D'", 1.0 / doppler_factor(n_in_body, -v), doppler, 1e-14);
    }
    for (speed, angle) in [(0.5, 74.45773178), (0.9, 51.18638344), (0.99, 29.81806385)] {
        near("no shift", doppler_factor(at_angle(angle), along_x(speed)), 1.0, 1e-8);
    }
}

#[test]
fn t19_doppler_at_a_trillionth_below_light() {
    let v = Velocity::from_rapidity(DVec3::X, 0.5 * libm::log((2.0 - 1e-12) / 1e-12)).unwrap();
    let ahead = ((2.0 - 1e-12) / 1e-12_f64).sqrt();
    near("coming", doppler_factor(DVec3::X, v) / ahead, 1.0, 1e-14);
    near("going", doppler_factor(DVec3::NEG_X, v) * ahead, 1.0, 1e-14);
    near("abeam", doppler_factor(DVec3::Y, v) * v.gamma(), 1.0, 1e-15);
    near("gamma", v.gamma() / (1.0 / (1e-12 * (2.0 - 1e-12_f64)).sqrt()), 1.0, 1e-14);
}

#[test]
fn t20_powers() {
    for (doppler, report, photon, bolometric) in [
        (3.0_f64.sqrt(), 1.732050808, 5.196152423, 9.0),
        (19.0_f64.sqrt(), 4.358898944, 82.81907993, 361.0),
        (0.19_f64.sqrt(), 0.4358898944, 0.08281907993, 0.0361),
    ] {
        near("report", Brightness::Report.factor(doppler), report, TEN_DIGITS);
        near("photon", Brightness::Photon.factor(doppler), photon, TEN_DIGITS);
        near("bolometric", Brightness::Bolometric.factor(doppler), bolometric, TEN_DIGITS);
        near("none", Brightness::None.factor(doppler), 1.0, 0.0);
    }
    assert_eq!(Brightness::default(), Brightness::Report);
}

#[test]
fn t32_composition() {
    near("0.5 and 0.5", compose(along_x(0.5), along_x(0.5)).speed(), 0.8, 1e-15);
    near("0.5 less −0.5", compose(along_x(0.5), -along_x(-0.5)).speed(), 0.8, 1e-15);
    near("0.9 and 0.9", compose(along_x(0.9), along_x(0.9)).speed(), 0.9944751381, TEN_DIGITS);
    near("0.5 less 0.5", compose(along_x(0.5), -along_x(0.5)).speed(), 0.0, 1e-16);
    let sum = compose(beta(0.0, 0.8, 0.0), along_x(0.8));
    near_vector("frame (0.8,0,0), object (0,0.8,0)", sum.beta(), DVec3::new(0.8, 0.48, 0.0), 1e-15);
    near("its speed", sum.speed(), 0.9329523032, TEN_DIGITS);
}

#[test]
fn t35_normal_of_a_contracted_plane() {
    // A plane at rest with its normal at 45° from the motion, contracted point by point.
    let v = along_x(0.9);
    let [a, b, c] = [DVec3::ZERO, DVec3::new(1.0, -1.0, 0.0), DVec3::Z].map(|p| contracted(p, v));
    let normal = (c - a).cross(b - a);
    near("from the motion", angle_deg(normal, DVec3::X), 23.55190057, TEN_DIGITS);
}
