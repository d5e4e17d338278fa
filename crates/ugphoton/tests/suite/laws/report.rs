//! The formulas of the report of 1988, chapter 5, literally, against hits, reflections and
//! refractions: rays through moving planes in the frame of the eye, {5.1.1.5}, and the matrix
//! T_v M_1 R M_2 T_v^T of section 5.2.4.
//!
//! The report errs in two places. In {5.1.1.2} it has the normal of the plane at rest; that of the
//! contracted plane (P34) is right, and the same only if the plane is parallel or perpendicular to
//! the motion. In section 5.2.5 speeds in media change by n_L/n_T; right is n_T/n_L.

use glam::{DMat3, DVec3};
use ugtesting::Random;

use crate::laws::drawing::{Chart, HEAD, boost, distance, square, velocity};

/// Rows; vectors are multiplied from the left, as in the report.
type Matrix = [[f64; 4]; 4];

fn times(a: Matrix, b: Matrix) -> Matrix {
    let entry = |i: usize, j: usize| (0..4).map(|k| a[i][k] * b[k][j]).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// A velocity in homogeneous coordinates, times a matrix.
fn mapped(v: DVec3, matrix: Matrix) -> DVec3 {
    let row = [v.x, v.y, v.z, 1.0];
    let [x, y, z, t]: [f64; 4] = std::array::from_fn(|j| (0..4).map(|k| row[k] * matrix[k][j]).sum());
    DVec3::new(x, y, z) / t
}

/// M_1, {5.2.4.7}; M_2, {5.2.4.8}, is that of the opposite velocity.
fn m1(v: f64) -> Matrix {
    let root = (1.0 - v * v).sqrt();
    [[1.0, 0.0, 0.0, -v], [0.0, root, 0.0, 0.0], [0.0, 0.0, root, 0.0], [-v, 0.0, 0.0, 1.0]]
}

/// T_v, {5.2.4.10}, which turns the velocity to +x, as a rotation of columns.
fn turn(v: DVec3) -> DMat3 {
    let u = v.normalize();
    let w = u.any_orthonormal_vector();
    DMat3::from_cols(u, w, u.cross(w)).transpose()
}

fn homogeneous(rotation: DMat3) -> Matrix {
    // The rotation multiplies columns from the right.
    let [x, y, z] = rotation.to_cols_array_2d();
    [[x[0], x[1], x[2], 0.0], [y[0], y[1], y[2], 0.0], [z[0], z[1], z[2], 0.0], [0.0, 0.0, 0.0, 1.0]]
}

/// R, {5.2.4.9}, for a normal in the axes of the moving surface.
fn reflection(n: DVec3) -> Matrix {
    let n = n.to_array();
    let entry = |i: usize, j: usize| f64::from(u8::from(i == j)) - 2.0 * n[i] * n[j];
    let row = |i: usize| {
        std::array::from_fn(|j| if i < 3 && j < 3 { entry(i, j) } else { f64::from(u8::from(i == j)) })
    };
    std::array::from_fn(row)
}

/// A plane of a body: a point and the unit normal in the rest frame, and the velocity.
#[derive(Clone, Copy)]
struct Plane {
    point: DVec3,
    normal: DVec3,
    velocity: DVec3,
}

/// Contracted along the motion, about the eye.
fn contracted(place: DVec3, v: DVec3) -> DVec3 {
    let gamma = 1.0 / (1.0 - v.length_squared()).sqrt();
    let axis = v.normalize();
    place + (1.0 / gamma - 1.0) * place.dot(axis) * axis
}

/// The place in the rest frame of what passes an event.
fn at_rest(event: DVec3, time: f64, v: DVec3) -> DVec3 {
    let gamma = 1.0 / (1.0 - v.length_squared()).sqrt();
    let (now, axis) = (event - time * v, v.normalize());
    now + (gamma - 1.0) * now.dot(axis) * axis
}

impl Plane {
    /// {5.1.1.5}: when light with velocity `r_d` that reaches `r_0` at time `t_0` left the plane.
    fn time(&self, r_0: DVec3, t_0: f64, r_d: DVec3, normal: DVec3) -> f64 {
        let q_0 = contracted(self.point, self.velocity);
        (q_0 - r_0 + t_0 * r_d).dot(normal) / (r_d - self.velocity).dot(normal)
    }

    /// The normal of the contracted plane, (P34).
    fn contracted_normal(&self) -> DVec3 {
        let v = self.velocity;
        let gamma = 1.0 / (1.0 - v.length_squared()).sqrt();
        self.normal + (gamma - 1.0) * self.normal.dot(v.normalize()) * v.normalize()
    }

    fn hit(&self, r_0: DVec3, t_0: f64, r_d: DVec3) -> (DVec3, f64) {
        let t = self.time(r_0, t_0, r_d, self.contracted_normal());
        (r_0 + (t - t_0) * r_d, t)
    }

    /// The velocity of light that a mirror reflects to `r_e`.
    fn reflected(&self, r_e: DVec3) -> DVec3 {
        let (t_v, v) = (turn(self.velocity), self.velocity.length());
        let into = times(homogeneous(t_v), m1(v));
        let out = times(m1(-v), homogeneous(t_v.transpose()));
        mapped(r_e, times(times(into, reflection(t_v * self.normal)), out))
    }

    /// The velocity of light that becomes `t_e` in passing from index `n_l` to `n_t`. The
    /// directions obey Snell's law {5.2.5.1} in the frame of the surface.
    fn refracted(&self, t_e: DVec3, n_t: f64, n_l: f64) -> Option<DVec3> {
        let (t_v, v) = (turn(self.velocity), self.velocity.length());
        let t_s = mapped(t_e, times(homogeneous(t_v), m1(v))).normalize();
        let n = t_v * self.normal;
        let n = if n.dot(t_s) < 0.0 { -n } else { n };
        let sideways = (n_t / n_l) * (t_s - t_s.dot(n) * n);
        let cos = 1.0 - sideways.length_squared();
        let l_s = (cos > 0.0).then(|| (sideways + cos.sqrt() * n) / n_l)?;
        Some(mapped(l_s, times(m1(-v), homogeneous(t_v.transpose()))))
    }
}

/// A chart across the way of light: at the event where light of velocity `r_d` was at a time
/// `flight` before it reached `r_0`.
fn chart_behind(random: &mut Random, r_0: DVec3, t_0: f64, r_d: DVec3, flight: f64) -> Chart {
    let v = random.in_ball(0.8);
    let center = at_rest(r_0 - flight * r_d, t_0 - flight, v);
    let back = boost(-v) * r_d.extend(1.0);
    let normal = (back.truncate().normalize() + 0.8 * random.direction()).normalize();
    let (a, b) = normal.any_orthonormal_pair();
    Chart { center: center + 0.2 * (a - b), axes: [a, b], velocity: v }
}

/// The chart is seen where the formulas have the light that reached `r_0` with velocity `r_d`.
#[track_caller]
fn check(chart: &Chart, others: &str, toward: DVec3, (r_0, t_0, r_d): (DVec3, f64, DVec3)) {
    let [a, b] = chart.axes;
    let plane = Plane { point: chart.center, normal: a.cross(b).normalize(), velocity: chart.velocity };
    let (place, time) = plane.hit(r_0, t_0, r_d);
    let expected = at_rest(place, time, chart.velocity);
    let Some(found) = chart.place(others, toward) else { panic!("the chart is not seen") };
    assert!((found - expected).length() < 1e-5 * (1.0 + expected.length()), "{found} {expected}");
}

/// A plane before the eye that is oblique to its motion.
fn plane(random: &mut Random, toward: DVec3) -> Plane {
    let v = random.direction() * random.between(0.2, 0.9);
    let place = random.between(2.0, 4.0) * toward;
    let toward_rest = (boost(-v) * toward.extend(-1.0)).truncate().normalize();
    let normal = (0.7 * random.direction() - toward_rest).normalize();
    Plane { point: at_rest(place, -place.length(), v), normal, velocity: v }
}

#[test]
fn rays_meet_moving_planes_where_the_report_says() {
    let mut n_oblique = 0;
    for seed in 0..40 {
        let mut random = Random(seed);
        let toward = random.direction();
        let plane = plane(&mut random, toward);
        let text =
            square("p", plane.point, plane.normal, 1e-2, &format!("white 1 {}", velocity(plane.velocity)));
        let found = distance(&format!("{HEAD}{text}"), toward);
        let time = plane.time(DVec3::ZERO, 0.0, -toward, plane.contracted_normal());
        assert!((found / -time - 1.0).abs() < 1e-6, "{seed}: {found} {time}");
        // Not through the vertex that the formula has.
        let aside = (toward + 1e-3 * random.direction()).normalize();
        let found = distance(&format!("{HEAD}{text}"), aside);
        let time = plane.time(DVec3::ZERO, 0.0, -aside, plane.contracted_normal());
        assert!((found / -time - 1.0).abs() < 1e-6, "{seed}: {found} {time}");
        let by_rest_normal = plane.time(DVec3::ZERO, 0.0, -aside, plane.normal);
        n_oblique += u32::from((found / -by_rest_normal - 1.0).abs() > 1e-5);
    }
    assert!(n_oblique > 20, "the normal at rest is wrong for oblique planes: {n_oblique}");
}

#[test]
fn moving_mirrors_reflect_as_the_report_says() {
    for seed in 0..30 {
        let mut random = Random(1000 + seed);
        let toward = random.direction();
        let mirror = plane(&mut random, toward);
        let (place, time) = mirror.hit(DVec3::ZERO, 0.0, -toward);
        let light = mirror.reflected(-toward);
        assert!((light.length() - 1.0).abs() < 1e-12);
        let chart = chart_behind(&mut random, place, time, light, 5.0);
        let rest = format!("white mirror {}", velocity(mirror.velocity));
        check(&chart, &square("m", mirror.point, mirror.normal, 0.1, &rest), toward, (place, time, light));
    }
}

/// Light that comes out of moving glass: from a chart inside it, and through a prism from a chart
/// behind it.
#[test]
fn moving_glass_refracts_as_the_report_says() {
    let mut n_through = 0;
    for seed in 0..40 {
        let mut random = Random(2000 + seed);
        let toward = random.direction();
        let front = plane(&mut random, toward);
        let (place, time) = front.hit(DVec3::ZERO, 0.0, -toward);
        let Some(inside) = front.refracted(-toward, 1.0, 1.5) else { continue };
        let rest = format!("white glass {}", velocity(front.velocity));
        let entrance = square("front", front.point, front.normal, 0.3, &rest);
        let chart = chart_behind(&mut random, place, time, inside, 2.0);
        check(&chart, &entrance, toward, (place, time, inside));
        // The other side of the prism, seen from outside.
        let far = at_rest(place - 0.5 * inside, time - 0.5, front.velocity);
        let step = (far - front.point).normalize();
        let back = Plane { point: far, normal: (step + 0.3 * random.direction()).normalize(), ..front };
        let (behind, then) = back.hit(place, time, inside);
        let Some(before) = back.refracted(inside, 1.5, 1.0) else { continue };
        let others = entrance + &square("back", back.point, back.normal, 0.3, &rest);
        let chart = chart_behind(&mut random, behind, then, before, 5.0);
        check(&chart, &others, toward, (behind, then, before));
        n_through += 1;
    }
    assert!(n_through > 20, "{n_through}");
}
