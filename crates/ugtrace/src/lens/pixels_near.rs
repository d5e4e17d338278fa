//! Pixels near a direction, for the light of point sources.

use core::f64::consts::{PI, TAU};
use core::ops::Range;

use glam::DVec3;

use super::{Film, Lens};

/// Pixels of a frame that contain a cap of the sphere. They may be beyond the edges of a flat film;
/// columns of a panorama may be a turn too far.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// The frame: the side of a cube, else 0.
    pub frame: usize,
    /// Columns of the frame.
    pub columns: Range<i64>,
    /// Rows of the frame.
    pub rows: Range<i64>,
}

/// Pixels in a row or a column of which [`Film::visit_evenly`] visits all.
const MOST_ACROSS: i64 = 512;

/// A pixel as seen from the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// Column and row in the picture; `None` beyond its edges.
    pub place: Option<[u32; 2]>,
    /// Unit vector to its middle.
    pub direction: DVec3,
    /// Its solid angle, steradians.
    pub solid_angle: f64,
}

/// A flat film, or a side of a cube: a place (x, y) in pixels from the upper left corner is at
/// `corner` + x `across` + y `down`, of depth 1.
struct Flat {
    corner: DVec3,
    across: DVec3,
    down: DVec3,
    forward: DVec3,
}

impl Film {
    /// The longest side of a pixel at a direction, radians.
    #[must_use]
    pub fn pixel_side(&self, direction: DVec3) -> f64 {
        let [width, height] = self.size;
        match self.lens {
            Lens::Pinhole => {
                let side = self.pinhole[1].length().max(self.pinhole[2].length());
                side * direction.dot(self.forward).max(0.0)
            }
            Lens::Panorama => {
                let sin = direction.dot(self.up);
                (PI / height).max(TAU / width * (1.0 - sin * sin).max(0.0).sqrt())
            }
            Lens::Fisheye { angle } => angle / width.min(height),
            Lens::Cube => {
                let parts =
                    [self.right, self.up, self.forward].map(|axis| direction.dot(axis).abs());
                2.0 / width.min(height) * parts[0].max(parts[1]).max(parts[2])
            }
        }
    }

    /// The geometric mean of the sides of a pixel at a direction, radians.
    #[must_use]
    pub fn pixel_width(&self, direction: DVec3) -> f64 {
        let [width, height] = self.size;
        match self.lens {
            Lens::Pinhole => {
                let ahead = direction.dot(self.forward).max(0.0);
                (self.pinhole[1].cross(self.pinhole[2]).length() * ahead).sqrt() * ahead
            }
            Lens::Panorama => {
                let sin = direction.dot(self.up);
                (PI / height * TAU / width * (1.0 - sin * sin).max(0.0).sqrt()).sqrt()
            }
            Lens::Fisheye { .. } => self.pixel_side(direction),
            Lens::Cube => {
                let side = self.pixel_side(direction);
                side * (side * width.min(height) * 0.5).sqrt()
            }
        }
    }

    /// Cosine of the angle between a direction and the middle of the view.
    #[must_use]
    pub fn ahead(&self, direction: DVec3) -> f64 {
        direction.dot(self.forward)
    }

    /// The pixels in which one eye sees directions within `radius` of `direction`, in every frame.
    /// `radius`: radians, less than π/2.
    pub fn pixels_near(&self, direction: DVec3, radius: f64) -> impl Iterator<Item = Window> {
        let n_frames = if self.lens == Lens::Cube { 6 } else { 1 };
        (0..n_frames).filter_map(move |frame| self.window(frame, direction, radius))
    }

    fn window(&self, frame: usize, direction: DVec3, radius: f64) -> Option<Window> {
        let [width, height] = self.size.map(|side| side as i64);
        let (columns, rows) = match self.lens {
            Lens::Pinhole => flat_window(&self.flat(frame), direction, radius)?,
            Lens::Cube => {
                let flat = self.flat(frame);
                let whole = || (0..width, 0..height);
                let (columns, rows) = flat_window(&flat, direction, radius).or_else(|| {
                    // A part of the cone may be ahead.
                    (direction.dot(flat.forward) > -libm::sin(radius)).then(whole)
                })?;
                (clipped(&columns, width), clipped(&rows, height))
            }
            Lens::Panorama => self.panorama_window(direction, radius),
            Lens::Fisheye { angle } => self.fisheye_window(angle, direction, radius),
        };
        let is_seen = !columns.is_empty()
            && !rows.is_empty()
            && rows.start < height
            && rows.end > 0
            && (self.lens == Lens::Panorama || (columns.start < width && columns.end > 0));
        is_seen.then_some(Window { frame, columns, rows })
    }

    fn panorama_window(&self, direction: DVec3, radius: f64) -> (Range<i64>, Range<i64>) {
        let [width, height] = self.size;
        let sin = direction.dot(self.up).clamp(-1.0, 1.0);
        let latitude = libm::asin(sin);
        let longitude = libm::atan2(direction.dot(self.right), direction.dot(self.forward));
        let row = |latitude: f64| (0.5 - latitude / PI) * height;
        let rows = range(row(latitude + radius), row(latitude - radius));
        let ratio = libm::sin(radius) / (1.0 - sin * sin).max(0.0).sqrt();
        let column = |longitude: f64| (longitude / TAU + 0.5) * width;
        let columns = if ratio < 1.0 && latitude.abs() + radius < 0.5 * PI {
            let half = libm::asin(ratio);
            range(column(longitude - half), column(longitude + half))
        } else {
            0..width as i64
        };
        let whole = columns.end - columns.start >= width as i64;
        (if whole { 0..width as i64 } else { columns }, clipped(&rows, height as i64))
    }

    fn fisheye_window(
        &self,
        angle: f64,
        direction: DVec3,
        radius: f64,
    ) -> (Range<i64>, Range<i64>) {
        let [width, height] = self.size;
        let edge = 0.5 * width.min(height);
        let per_radian = edge / (0.5 * angle);
        let (right, above) = (direction.dot(self.right), direction.dot(self.up));
        let sin = libm::hypot(right, above);
        let from_middle = libm::atan2(sin, direction.dot(self.forward));
        let far = ((from_middle + radius) * per_radian).min(edge);
        // The whole disc where the cap contains the middle or the opposite point.
        let is_ring = libm::sin(radius) >= sin || from_middle + radius >= PI;
        let mut box_of = [-far, far, -far, far];
        if !is_ring {
            let near = (from_middle - radius) * per_radian;
            let half = libm::asin(libm::sin(radius) / sin);
            let middle = libm::atan2(above, right);
            let quarters = [0.0, 0.5 * PI, PI, 1.5 * PI];
            let within = |turn: f64| {
                let apart = (turn - middle).rem_euclid(TAU);
                apart.min(TAU - apart) <= half
            };
            let turns = quarters.into_iter().filter(|turn| within(*turn));
            let turns = turns.chain([middle - half, middle + half]);
            box_of = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
            for turn in turns {
                let (sin, cos) = libm::sincos(turn);
                for distance in [near, far] {
                    let [x, y] = [distance * cos, distance * sin];
                    box_of =
                        [box_of[0].min(x), box_of[1].max(x), box_of[2].min(y), box_of[3].max(y)];
                }
            }
        }
        let [west, east, south, north] = box_of;
        let columns = range(0.5 * width + west, 0.5 * width + east);
        let rows = range(0.5 * height - north, 0.5 * height - south);
        (clipped(&columns, width as i64), clipped(&rows, height as i64))
    }

    /// Calls `each` for the pixels of a window, row by row.
    pub fn visit(&self, window: &Window, mut each: impl FnMut(&Facet)) {
        match self.lens {
            Lens::Pinhole | Lens::Cube => self.visit_flat(window, &mut each),
            Lens::Panorama => self.visit_panorama(window, &mut each),
            Lens::Fisheye { angle } => self.visit_fisheye(angle, window, &mut each),
        }
    }

    /// Calls `each` for pixels evenly spread over a window, at most 512 in a row or a
    /// column, each with the solid angle of all those for which it stands.
    pub fn visit_evenly(&self, window: &Window, mut each: impl FnMut(&Facet)) {
        let step = |range: &Range<i64>| (range.end - range.start - 1).max(0) / MOST_ACROSS + 1;
        let [across, down] = [step(&window.columns), step(&window.rows)];
        if [across, down] == [1, 1] {
            return self.visit(window, each);
        }
        let part = across as f64 * down as f64;
        for row in window.rows.clone().step_by(down as usize) {
            for column in window.columns.clone().step_by(across as usize) {
                let pixel = Window { columns: column..column + 1, rows: row..row + 1, ..*window };
                self.visit(&pixel, |facet| {
                    each(&Facet { solid_angle: part * facet.solid_angle, ..*facet })
                });
            }
        }
    }

    fn visit_flat(&self, window: &Window, each: &mut impl FnMut(&Facet)) {
        let flat = self.flat(window.frame);
        let area = flat.across.cross(flat.down).length();
        for row in window.rows.clone() {
            let start = flat.corner + (row as f64 + 0.5) * flat.down;
            for column in window.columns.clone() {
                let at = start + (column as f64 + 0.5) * flat.across;
                let inverse = 1.0 / at.length();
                let solid_angle = area * (inverse * inverse * inverse);
                let place = self.place(window.frame, [column, row]);
                each(&Facet { place, direction: at * inverse, solid_angle });
            }
        }
    }

    fn visit_panorama(&self, window: &Window, each: &mut impl FnMut(&Facet)) {
        let [width, height] = self.size;
        let across: Vec<DVec3> = window
            .columns
            .clone()
            .map(|column| {
                let (sin, cos) = self.longitude(column as f64 + 0.5);
                self.forward * cos + self.right * sin
            })
            .collect();
        let row_angle = TAU / width * 2.0 * libm::sin(0.5 * PI / height);
        for row in window.rows.clone() {
            let (sin, cos) = libm::sincos(PI * (0.5 - (row as f64 + 0.5) / height));
            for (column, across) in window.columns.clone().zip(&across) {
                let place = self.place(0, [column.rem_euclid(width as i64), row]);
                let direction = *across * cos + self.up * sin;
                each(&Facet { place, direction, solid_angle: row_angle * cos });
            }
        }
    }

    fn visit_fisheye(&self, angle: f64, window: &Window, each: &mut impl FnMut(&Facet)) {
        let [width, height] = self.size;
        let per_pixel = angle / width.min(height);
        for row in window.rows.clone() {
            for column in window.columns.clone() {
                let at = [column as f64 + 0.5, row as f64 + 0.5];
                let Some(direction) = self.direction(at, 0) else { continue };
                let from_middle =
                    per_pixel * libm::hypot(at[0] - 0.5 * width, 0.5 * height - at[1]);
                let narrowed =
                    if from_middle > 0.0 { libm::sin(from_middle) / from_middle } else { 1.0 };
                let solid_angle = per_pixel * per_pixel * narrowed;
                each(&Facet { place: self.place(0, [column, row]), direction, solid_angle });
            }
        }
    }

    /// The place in the picture of a pixel of a frame.
    fn place(&self, frame: usize, at: [i64; 2]) -> Option<[u32; 2]> {
        let [width, height] = self.size.map(|side| side as i64);
        let is_inside = (0..width).contains(&at[0]) && (0..height).contains(&at[1]);
        is_inside.then(|| [(frame as i64 * width + at[0]) as u32, at[1] as u32])
    }

    /// The film of a pinhole, or a side of a cube.
    fn flat(&self, frame: usize) -> Flat {
        if self.lens == Lens::Pinhole {
            let [corner, across, down] = self.pinhole;
            return Flat { corner, across, down, forward: self.forward };
        }
        let [middle, across, down] = self.side(frame);
        let [width, height] = self.size;
        Flat {
            corner: middle - across - down,
            across: across * (2.0 / width),
            down: down * (2.0 / height),
            forward: middle,
        }
    }
}

/// The pixels of a flat film in which a cone is seen; `None` unless all of it is ahead.
///
/// The plane through the eye and a column x of the film has the normal N = â − x f, where f is the
/// view direction. It touches a cone of half-angle r about n if (N·n)² = sin² r N².
fn flat_window(flat: &Flat, direction: DVec3, radius: f64) -> Option<(Range<i64>, Range<i64>)> {
    let sin = libm::sin(radius);
    let ahead = direction.dot(flat.forward);
    if ahead <= sin {
        return None;
    }
    let ends = |axis: DVec3| {
        let length = axis.length();
        let aside = direction.dot(axis) / length;
        let denominator = ahead * ahead - sin * sin;
        let root = sin * (ahead * ahead + aside * aside - sin * sin).max(0.0).sqrt();
        let start = flat.corner.dot(axis) / length;
        [-1.0, 1.0].map(|sign| ((aside * ahead + sign * root) / denominator - start) / length)
    };
    let ([west, east], [above, below]) = (ends(flat.across), ends(flat.down));
    Some((range(west, east), range(above, below)))
}

/// The pixels whose middles may be between two places, and one more at each end.
fn range(from: f64, to: f64) -> Range<i64> {
    // Far beyond any picture, and far from overflow.
    const FAR: f64 = 1e12;
    let [from, to] = [from, to].map(|at| at.floor().clamp(-FAR, FAR) as i64);
    from - 1..to + 2
}

fn clipped(range: &Range<i64>, n: i64) -> Range<i64> {
    range.start.clamp(0, n)..range.end.clamp(0, n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lens::tests::film;
    use ugscene::{Camera, CameraOptions, View};

    const LENSES: [(Lens, [u32; 2]); 6] = [
        (Lens::Pinhole, [40, 20]),
        (Lens::Panorama, [40, 20]),
        (Lens::Panorama, [30, 41]),
        (Lens::Fisheye { angle: PI }, [40, 30]),
        (Lens::Fisheye { angle: TAU }, [30, 40]),
        (Lens::Cube, [16, 16]),
    ];

    fn directions() -> impl Iterator<Item = DVec3> {
        let some = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
        some.chain((0..500).map(|step| {
            let part = |by: f64| (f64::from(step) * by).fract();
            let (z, turn) = (2.0 * part(0.618_034) - 1.0, TAU * part(0.754_878));
            let (sin, cos) = libm::sincos(turn);
            let level = (1.0 - z * z).sqrt();
            DVec3::new(level * sin, level * cos, z)
        }))
    }

    /// All pixels of a picture.
    fn whole(film: &Film) -> Vec<Facet> {
        let [width, height] = film.size.map(|side| side as i64);
        let n_frames = if film.lens == Lens::Cube { 6 } else { 1 };
        let mut all = Vec::new();
        for frame in 0..n_frames {
            let window = Window { frame, columns: 0..width, rows: 0..height };
            film.visit(&window, |facet| all.push(*facet));
        }
        all
    }

    /// The windows of a cap have every pixel of the picture in it, once.
    #[test]
    fn caps_have_all_their_pixels() {
        for (lens, size) in LENSES {
            let film = film(lens, None, size);
            let all = whole(&film);
            for (idx, direction) in directions().enumerate() {
                let radius = [0.02, 0.1, 0.5][idx % 3];
                // A pinhole sees only caps that are all ahead.
                if lens == Lens::Pinhole && film.ahead(direction) <= libm::sin(radius) {
                    continue;
                }
                let is_inside = |facet: &Facet| facet.direction.angle_between(direction) < radius;
                let mut expected: Vec<_> =
                    all.iter().filter(|facet| is_inside(facet)).map(|facet| facet.place).collect();
                let mut found = Vec::new();
                for window in film.pixels_near(direction, radius) {
                    film.visit(&window, |facet| {
                        if is_inside(facet) && facet.place.is_some() {
                            found.push(facet.place);
                        }
                    });
                }
                expected.sort_unstable();
                found.sort_unstable();
                assert_eq!(found, expected, "{lens:?} {direction} {radius}");
            }
        }
    }

    /// Pixels have the directions of lines of sight, and solid angles that add up.
    #[test]
    fn pixels_are_parts_of_the_sphere() {
        for (lens, size) in LENSES {
            let film = film(lens, None, size);
            let all = whole(&film);
            for facet in &all {
                let Some(place) = facet.place else { panic!("inside") };
                let at = place.map(|at| f64::from(at) + 0.5);
                let sight = |x: f64, y: f64| film.sight([at[0] + x, at[1] + y]);
                let middle = sight(0.0, 0.0).map(|sight| sight.direction.normalize());
                assert!(middle.is_some_and(|middle| (middle - facet.direction).length() < 1e-14));
                let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                    .map(|[x, y]| sight(0.01 * x, 0.01 * y));
                let [Some(a), Some(b), Some(c), Some(d)] = corners else { continue };
                let [a, b, c, d] = [a, b, c, d].map(|sight| sight.direction.normalize());
                let area = 0.5 * (c - a).cross(d - b).length() / 0.0004;
                assert!(
                    (facet.solid_angle / area - 1.0).abs() < 2e-3,
                    "{lens:?} {place:?}: {area}"
                );
                let side = film.pixel_side(facet.direction);
                assert!(side * side > 0.99 * facet.solid_angle);
            }
            let sum: f64 = all.iter().map(|facet| facet.solid_angle).sum();
            let expected = match lens {
                Lens::Panorama | Lens::Cube => 4.0 * PI,
                Lens::Fisheye { angle } => TAU * (1.0 - libm::cos(0.5 * angle)),
                Lens::Pinhole => sum,
            };
            // The rim of a disc goes through pixels.
            assert!((sum / expected - 1.0).abs() < 0.02, "{lens:?}: {sum}, not {expected}");
        }
    }

    /// A profile over pixels a million times longer than wide has its integral: the solid angle
    /// within a chord c is πc².
    #[test]
    fn sums_over_some_pixels_are_those_over_all() {
        for view_angle in [(2.0, Some(2e-6)), (2e-6, Some(2.0)), (2.0, Some(2.0))] {
            let center = Some(DVec3::Y);
            let options =
                CameraOptions { center, view_angle: Some(view_angle), ..CameraOptions::default() };
            let Ok(view) = View::without_scene(&Camera::default(), &options, [9, 9]) else {
                panic!("a camera")
            };
            let film = Film::new(Lens::Pinhole, None, &view, [9, 9]);
            let direction =
                film.sight([4.7, 4.4]).map_or(DVec3::ZERO, |sight| sight.direction.normalize());
            let deviation = 4.0 * film.pixel_side(direction);
            let mut sum = 0.0;
            for window in film.pixels_near(direction, 4.0 * deviation) {
                film.visit_evenly(&window, |facet| {
                    let square = (facet.direction - direction).length_squared();
                    sum += libm::exp(-0.5 * square / (deviation * deviation)) * facet.solid_angle;
                });
            }
            let expected = TAU * deviation * deviation;
            assert!((sum / expected - 1.0).abs() < 1e-3, "{view_angle:?}: {sum} {expected}");
        }
    }
}
