//! Lists of stars: the same star in every form, and what is refused.

use glam::DVec3;
use ugskybox::{StarList, is_star_list, read_stars};

/// A star 90 degrees east of the origin of right ascensions, 30 degrees north.
const DECLINATION: f64 = 30.0;

fn read(text: &str) -> StarList {
    read_stars("stars.csv", text.as_bytes()).unwrap_or_else(|errors| panic!("{text}: {errors}"))
}

#[test]
fn one_star_has_many_forms() {
    let reference = &read("ra,dec,mag,kelvin\n90,30,1.5,6000\n").stars[0];
    assert!((reference.direction.z - libm::sin(DECLINATION.to_radians())).abs() < 1e-12);
    assert!((reference.direction.length() - 1.0).abs() < 1e-15);
    assert_eq!((reference.magnitude, reference.kelvin), (1.5, 6000.0));
    for text in [
        "ra;dec;mag;kelvin\n90;30;1.5;6000\n",
        "ra\tdec\tmag\tkelvin\n90\t30\t1.5\t6000\n",
        "RA DEC MAG KELVIN\n 90  30  1.5  6000\n",
        "kelvin,name,mag,dec,ra\n6000,\"a, b\",1.5,30,90\n",
        "# a list\n\nra_hours,dec,mag,kelvin\n6,30,1.5,6000\n",
        "ra (h),dec,mag,kelvin\n6,30,1.5,6000\n",
        "ra,dec,mag,kelvin\ndeg,deg,,K\n90,30,1.5,6000\n",
        "ra,dec,mag,kelvin\r\n90,30,1.5,6000\r\n",
    ] {
        let star = &read(text).stars[0];
        assert!((star.direction - reference.direction).length() < 1e-12, "{text}: {star:?}");
        assert_eq!((star.magnitude, star.kelvin), (1.5, 6000.0), "{text}");
        assert!(is_star_list("stars.csv", text.as_bytes()), "{text}");
    }
    // Right ascension grows by 15 degrees an hour, eastwards: a quarter turn about the pole.
    let [east, south] =
        ["ra,dec,mag,kelvin\n0,0,1,6000\n90,0,1,6000\n", "ra,dec,mag,kelvin\n0,-90,1,6000\n"]
            .map(|text| read(text).stars);
    assert!(east[0].direction.cross(east[1].direction).distance(DVec3::Z) < 1e-12);
    assert!(south[0].direction.distance(DVec3::NEG_Z) < 1e-12);
}

#[test]
fn mistakes_have_a_place() {
    for (text, expected) in [
        ("ra,dec,mag,kelvin\n90,x,1.5,6000\n", "2:4"),
        ("ra,dec,mag,kelvin\n90,30,1.5,6000\n90,95,1.5,6000\n", "3:4"),
        ("ra,dec,mag\n90,30,1.5\n", "1:"),
        ("", "1:"),
    ] {
        let errors = read_stars("stars.csv", text.as_bytes()).expect_err(text).to_string();
        assert!(errors.contains(&format!("stars.csv:{expected}")), "{text}: {errors}");
    }
    // Stars with a gap are left out, with a note.
    let list = read("ra,dec,mag,kelvin\n90,30,,6000\n90,30,1,6000\n");
    assert_eq!((list.stars.len(), list.notes.len()), (1, 1));
}
