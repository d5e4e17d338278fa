//! The plots of the papers, with the functions of `ugphysics`.

use std::error::Error;
use std::path::Path;

use glam::DVec3;
use plotters::style::{BLACK, RGBColor};
use ugphysics::{
    CONTROL_POINTS, Hsv, Velocity, VelocityError, aberrate, attenuation, wavelength_to_hue,
};

use crate::plot::{Axis, COLORS, Mark, Panel, Plot};

/// Speed of the particle of Chang, Lai and Chen, who state none.
const BETA: f64 = 0.8;

/// Width and height of each of their four panels, pixels.
const RAYS_SIZE: [u32; 2] = [320, 240];

/// Writes all plots into a folder, each as SVG and as PNG.
pub fn write(folder: &Path) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(folder)?;
    hues().write(folder, "nguyen-3.3.1-hues")?;
    visibility().write(folder, "nguyen-3.3.2-attenuation")?;
    emission()?.write(folder, "chang-01-aberration")?;
    fields_of_view("2: camera looking forward", 1.0, 180)?
        .write(folder, "howard-02-field-of-view-forward")?;
    fields_of_view("3: camera looking backward", -1.0, 0)?
        .write(folder, "howard-03-field-of-view-backward")
}

fn single(title: &str, axes: [Axis; 2], marks: Vec<Mark>) -> Plot {
    let panel = Panel { title: title.to_owned(), axes, has_scales: true, marks };
    Plot { columns: 1, panel_size: [640, 480], panels: vec![panel] }
}

/// Nguyen 1988, figure 3.3.1: the hue of a wavelength, in that hue, and the control points.
/// Eq. (P16)
fn hues() -> Plot {
    const NAMES: [&str; 7] = ["MAXW", "RED", "YELLOW", "GREEN", "CYAN", "BLUE", "MINW"];
    let point = |wavelength_nm: f64| [wavelength_nm, wavelength_to_hue(wavelength_nm)];
    let mut marks: Vec<_> = (380..780)
        .step_by(2)
        .map(|nm| {
            let ends = [f64::from(nm), f64::from(nm + 2)].map(point);
            let hue = 0.5 * (ends[0][1] + ends[1][1]);
            let [r, g, b] =
                Hsv { hue, saturation: 1.0, value: 1.0 }.to_rgb().map(|part| (255.0 * part) as u8);
            Mark::Line(ends.to_vec(), RGBColor(r, g, b), 5)
        })
        .collect();
    marks.push(Mark::Dots(CONTROL_POINTS.map(|c| [c.wavelength_nm, c.hue_deg]).to_vec(), BLACK));
    marks.extend(CONTROL_POINTS.iter().zip(NAMES).map(|(c, name)| {
        Mark::Text([c.wavelength_nm + 6.0, c.hue_deg + 16.0], name.to_owned(), BLACK)
    }));
    let axes = [
        Axis::new("wavelength, nm", &[380.0, 435.8, 505.0, 546.1, 605.0, 700.0, 780.0, 830.0]),
        Axis::new("hue, degrees", &[-60.0, 0.0, 60.0, 120.0, 180.0, 240.0, 300.0, 330.0]),
    ];
    single("3.3.1: hue and wavelength", axes, marks)
}

/// Nguyen 1988, figure 3.3.2: how much of a hue is seen.  Eq. (P17)
fn visibility() -> Plot {
    let points =
        (1700..=4100).map(|fifth| f64::from(fifth) / 5.0).map(|nm| [nm, attenuation(nm)]).collect();
    let axes = [
        Axis::new("wavelength, nm", &[340.0, 380.0, 435.8, 500.0, 600.0, 700.0, 780.0, 820.0]),
        Axis::new("attenuation", &[0.0, 0.25, 0.5, 0.75, 1.0, 1.1]),
    ];
    single(
        "3.3.2: attenuation at the ends of the visible range",
        axes,
        vec![Mark::Line(points, COLORS[0], 3)],
    )
}

/// Howard, Dance and Kitchen 1995, figures 2 and 3: the field of view of a camera that looks in the
/// direction of motion (`side` 1) or back (−1), over its speed. Their equations (18), (19).
fn fields_of_view(title: &str, side: f64, low: u32) -> Result<Plot, VelocityError> {
    let points = (0..1000).map(|thousandth| {
        let rest = 1.0 - f64::from(thousandth) / 1000.0;
        let beta = 1.0 - rest * rest;
        Ok([beta, field_of_view(beta, side)?.to_degrees()])
    });
    let points = points.collect::<Result<Vec<_>, VelocityError>>()?;
    let axes = [
        Axis::new("β", &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0]),
        Axis::new("field of view, degrees", &[0, 45, 90, 135, 180].map(|by| f64::from(low + by))),
    ];
    Ok(single(title, axes, vec![Mark::Line(points, COLORS[0], 3)]))
}

/// The angle across all directions that an unlimited film sees, radians: twice that between the
/// view direction and, in the frame of the scene, what is seen at right angles to it.  Eq. (P6)
fn field_of_view(beta: f64, side: f64) -> Result<f64, VelocityError> {
    let scene = Velocity::from_beta(DVec3::new(-beta, 0.0, 0.0))?;
    let abeam = aberrate(DVec3::Y, scene);
    Ok(2.0 * libm::atan2(abeam.y, side * abeam.x))
}

/// Chang, Lai and Chen 1996, figure 1: a ray, and light emitted alike in all directions, in the
/// frame of the particle and in the one in which it moves.  Eq. (P6)
fn emission() -> Result<Plot, VelocityError> {
    const RAYS: u32 = 24;
    let frame = Velocity::from_beta(DVec3::new(-BETA, 0.0, 0.0))?;
    let in_laboratory = |angle: f64| emitted(angle, frame);
    let all = (0..RAYS).map(|ray| std::f64::consts::TAU * f64::from(ray) / f64::from(RAYS));
    let ray = 75_f64.to_radians();
    let panels = vec![
        one_ray("(a) S′: the particle rests", ray, "φ′"),
        one_ray(&format!("(b) S: it moves along x, β = {BETA}"), in_laboratory(ray), "φ"),
        many_rays("(c) S′: all directions alike", all.clone().collect()),
        many_rays(&format!("(d) S, β = {BETA}: thrown forward"), all.map(in_laboratory).collect()),
    ];
    Ok(Plot { columns: 2, panel_size: RAYS_SIZE, panels })
}

/// The angle to the x axis, in the laboratory, of light that a particle emits at an angle in its
/// rest frame. `frame`: the velocity of the laboratory in that frame.
fn emitted(angle: f64, frame: Velocity) -> f64 {
    let (sin, cos) = libm::sincos(angle);
    // A viewing direction points against the light.
    let light = -aberrate(-DVec3::new(cos, sin, 0.0), frame);
    libm::atan2(light.y, light.x)
}

fn polar(radius: f64, angle: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(angle);
    [radius * cos, radius * sin]
}

fn directions(title: &str, marks: Vec<Mark>) -> Panel {
    const UP: f64 = 1.35;
    let right = UP * Plot::aspect(RAYS_SIZE);
    let mut all = vec![
        Mark::Text([-right, UP], title.to_owned(), BLACK),
        Mark::Line(vec![[-right, 0.0], [right, 0.0]], RGBColor(200, 200, 200), 1),
        Mark::Text([right - 0.1, -0.04], "x".to_owned(), BLACK),
    ];
    all.extend(marks);
    all.push(Mark::Dots(vec![[0.0; 2]], BLACK));
    let axes = [Axis::new("", &[-right, right]), Axis::new("", &[-UP, UP])];
    Panel { title: String::new(), axes, has_scales: false, marks: all }
}

fn one_ray(title: &str, angle: f64, name: &str) -> Panel {
    let arc = (0..=60).map(|step| polar(0.35, angle * f64::from(step) / 60.0)).collect();
    let [x, y] = polar(0.45, 0.5 * angle);
    directions(
        title,
        vec![
            Mark::Line(arc, COLORS[0], 1),
            Mark::Text([x, y + 0.06], format!("{name} = {:.0}°", angle.to_degrees()), COLORS[0]),
            Mark::Arrow([[0.0; 2], polar(1.1, angle)], COLORS[1]),
        ],
    )
}

fn many_rays(title: &str, angles: Vec<f64>) -> Panel {
    directions(
        title,
        angles
            .into_iter()
            .map(|angle| Mark::Arrow([[0.0; 2], polar(1.1, angle)], COLORS[1]))
            .collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::{Velocity, emitted, field_of_view};
    use glam::DVec3;

    /// Howard, Dance and Kitchen 1995, equations (18) and (19).
    #[test]
    fn fields_of_view_are_those_of_the_paper() {
        for beta in [0.0, 0.1, 0.5, 0.9, 0.999] {
            let gamma_beta = beta / libm::sqrt(1.0 - beta * beta);
            for side in [1.0, -1.0] {
                let paper = std::f64::consts::PI + side * 2.0 * libm::atan(gamma_beta);
                assert!(
                    (field_of_view(beta, side).unwrap() - paper).abs() < 1e-13,
                    "{beta} {side}"
                );
            }
        }
    }

    /// Chang, Lai and Chen 1996, equation (5), multiplied out.
    #[test]
    fn emission_is_aberrated_as_in_the_paper() {
        for beta in [0.1, 0.8, 0.99] {
            let laboratory = Velocity::from_beta(DVec3::new(-beta, 0.0, 0.0)).unwrap();
            for angle in [0.0, 0.5, 1.5, 2.5, 3.1, -1.0] {
                let (sin, cos) = libm::sincos(angle);
                let paper = libm::atan2(sin * libm::sqrt(1.0 - beta * beta), cos + beta);
                assert!((emitted(angle, laboratory) - paper).abs() < 1e-13, "{beta} {angle}");
            }
        }
    }
}
