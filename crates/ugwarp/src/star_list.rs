//! Lists of stars as text: CSV with a line of column names.

use glam::DVec3;
use ugparse::{Diagnostic, Diagnostics, Source, Span};
use ugsky::Star;

/// Most stars of a list.
pub const MAX_STARS: usize = 10_000_000;

/// Least and greatest temperature, kelvins.
const KELVIN: [f64; 2] = [100.0, 1e6];

/// Greatest absolute value of a magnitude.
const MAX_MAGNITUDE: f64 = 60.0;

/// Columns with their names, of which the first is documented.
const NAMES: [(Column, &[&str]); 11] = [
    (Column::Ra, &["ra", "ra_deg", "right ascension"]),
    (Column::RaHours, &["ra_hours"]),
    (Column::Dec, &["dec", "dec_deg", "declination"]),
    (Column::Longitude, &["lon", "longitude"]),
    (Column::Latitude, &["lat", "latitude"]),
    (Column::X, &["x"]),
    (Column::Y, &["y"]),
    (Column::Z, &["z"]),
    (Column::Magnitude, &["mag", "magnitude", "vmag"]),
    (Column::Kelvin, &["kelvin", "temperature", "teff"]),
    (Column::ColorIndex, &["b-v", "bv"]),
];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Column {
    Ra,
    RaHours,
    Dec,
    Longitude,
    Latitude,
    X,
    Y,
    Z,
    Magnitude,
    Kelvin,
    ColorIndex,
}

impl Column {
    fn name(self) -> &'static str {
        NAMES.iter().find(|(column, _)| *column == self).map_or("", |(_, names)| names[0])
    }

    /// Valid values, and their description.
    fn range(self) -> ([f64; 2], &'static str) {
        match self {
            Self::Ra | Self::Longitude => ([-360.0, 360.0], "degrees from -360 to 360"),
            Self::RaHours => ([-24.0, 24.0], "hours from -24 to 24"),
            Self::Dec | Self::Latitude => ([-90.0, 90.0], "degrees from -90 to 90"),
            Self::X | Self::Y | Self::Z => ([-1e100, 1e100], "a coordinate of a direction"),
            Self::Magnitude => ([-MAX_MAGNITUDE, MAX_MAGNITUDE], "a magnitude from -60 to 60"),
            Self::Kelvin => (KELVIN, "kelvins from 100 to 1000000"),
            Self::ColorIndex => ([-0.4, 8.0], "a colour index from -0.4 to 8"),
        }
    }
}

/// How the columns of a list give the direction and the temperature of a star: indices of columns.
struct Layout {
    direction: Direction,
    magnitude: usize,
    color: (Column, usize),
    n_columns: usize,
}

enum Direction {
    /// Longitude or right ascension, and latitude or declination.
    Angles([(Column, usize); 2]),
    Vector([usize; 3]),
}

/// True if bytes look like a list of stars rather than a picture: text whose first line, comments
/// apart, has names of columns.
#[must_use]
pub fn is_star_list(file: &[u8]) -> bool {
    let head = &file[..file.len().min(4096)];
    let line = head.split(|byte| *byte == b'\n').find(|line| !is_comment(line)).unwrap_or_default();
    let is_text = line.iter().all(|byte| *byte >= b' ' || *byte == b'\t' || *byte == b'\r');
    let names = fields(line).into_iter().filter_map(|(start, end)| column(&line[start..end]));
    is_text && names.count() >= 2
}

/// Reads a list of stars. `name`: of the file, for messages.
///
/// The first line has the names of columns, separated by commas; other columns than the known ones
/// are allowed and ignored. Lines that are empty or begin with `#` are skipped.
///
/// # Errors
/// All errors of up to 20 lines, with line and column.
pub fn read_stars(name: &str, file: &[u8]) -> Result<Vec<Star>, Box<Diagnostics>> {
    // The text is stored only where a message shows it.
    let failed = |found: Vec<Diagnostic>| Err(Box::new(Diagnostics::new(&Source::new(name, file), found)));
    let mut start = if file.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let mut layout = None;
    let (mut stars, mut found) = (Vec::new(), Vec::new());
    while start < file.len() && found.len() < ugparse::MAX_ERRORS {
        let end = file[start..].iter().position(|byte| *byte == b'\n').map_or(file.len(), |n| start + n);
        let line = Line { start, text: &file[start..end] };
        start = end + 1;
        if is_comment(line.text) {
            continue;
        }
        let Some(layout) = &layout else {
            match Layout::new(&line) {
                Ok(columns) => layout = Some(columns),
                Err(error) => return failed(vec![error]),
            }
            continue;
        };
        match layout.star(&line) {
            Ok(_) if stars.len() == MAX_STARS => {
                let error = Diagnostic::error(line.span(), format!("more than {MAX_STARS} stars"));
                found.push(error.help("keep the brightest"));
                break;
            }
            Ok(star) => stars.push(star),
            Err(error) => found.push(error),
        }
    }
    if layout.is_none() {
        let error = Diagnostic::error(Span::default(), "a list of stars without a line of column names");
        return failed(vec![error.help(HEAD)]);
    }
    if found.is_empty() { Ok(stars) } else { failed(found) }
}

/// What the first line has to be.
const HEAD: &str = "begin with the names of columns: `ra,dec,mag,kelvin`, or `lon,lat` or `x,y,z` in place of \
                    `ra,dec`, or `b-v` in place of `kelvin`";

/// A line of the file.
struct Line<'t> {
    start: usize,
    text: &'t [u8],
}

impl Line<'_> {
    fn at(&self, (start, end): (usize, usize)) -> Span {
        Span { start: (self.start + start) as u32, end: (self.start + end) as u32 }
    }

    fn span(&self) -> Span {
        let trimmed = self.text.trim_ascii_end().len();
        self.at((0, trimmed))
    }
}

fn is_comment(line: &[u8]) -> bool {
    let line = line.trim_ascii();
    line.is_empty() || line.starts_with(b"#")
}

/// Ranges of the fields of a line, without blanks and quotes around them.
fn fields(line: &[u8]) -> Vec<(usize, usize)> {
    let mut fields = Vec::new();
    let (mut start, mut is_quoted) = (0, false);
    for (at, byte) in line.iter().chain(b",").enumerate() {
        is_quoted ^= *byte == b'"' && at < line.len();
        if at < line.len() && (*byte != b',' || is_quoted) {
            continue;
        }
        let blank = |byte: &u8| byte.is_ascii_whitespace() || *byte == b'"';
        let field = &line[start..at];
        let before = field.iter().take_while(|byte| blank(byte)).count();
        let after = field[before..].iter().rev().take_while(|byte| blank(byte)).count();
        fields.push((start + before, at - after));
        start = at + 1;
    }
    fields
}

/// The column with a name.
fn column(name: &[u8]) -> Option<Column> {
    let is_it = |names: &[&str]| names.iter().any(|other| name.eq_ignore_ascii_case(other.as_bytes()));
    NAMES.iter().find(|(_, names)| is_it(names)).map(|(column, _)| *column)
}

impl Layout {
    fn new(line: &Line<'_>) -> Result<Self, Diagnostic> {
        let places = fields(line.text);
        let mut indices = [None; NAMES.len()];
        for (idx, &(start, end)) in places.iter().enumerate() {
            let Some(column) = column(&line.text[start..end]) else { continue };
            let place = &mut indices[column as usize];
            if place.is_some() {
                let text = format!("the column `{}` is there twice", column.name());
                return Err(Diagnostic::error(line.at((start, end)), text).help("rename or remove one"));
            }
            *place = Some(idx);
        }
        let at = |column: Column| indices[column as usize];
        let missing =
            |what: &str| Diagnostic::error(line.span(), format!("a list of stars without {what}")).help(HEAD);
        let both = |one: Column, other: Column| Some([(one, at(one)?), (other, at(other)?)]);
        let vector = || Some([at(Column::X)?, at(Column::Y)?, at(Column::Z)?]);
        let direction = both(Column::Ra, Column::Dec)
            .or_else(|| both(Column::RaHours, Column::Dec))
            .or_else(|| both(Column::Longitude, Column::Latitude))
            .map(Direction::Angles)
            .or_else(|| vector().map(Direction::Vector))
            .ok_or_else(|| missing("directions"))?;
        let color = |column: Column| Some((column, at(column)?));
        Ok(Self {
            direction,
            magnitude: at(Column::Magnitude).ok_or_else(|| missing("magnitudes"))?,
            color: color(Column::Kelvin)
                .or_else(|| color(Column::ColorIndex))
                .ok_or_else(|| missing("temperatures"))?,
            n_columns: places.len(),
        })
    }

    fn star(&self, line: &Line<'_>) -> Result<Star, Diagnostic> {
        let places = fields(line.text);
        if places.len() != self.n_columns {
            let text = format!("{} fields where {} columns have names", places.len(), self.n_columns);
            let help = "write as many fields in each line; put a field with a comma in double quotes";
            return Err(Diagnostic::error(line.span(), text).help(help));
        }
        let number = |column: Column, idx: usize| {
            let (start, end) = places[idx];
            number(column, &line.text[start..end]).map_err(|error| {
                let (_, range) = column.range();
                // A place to point to, even if the field is empty.
                let span = line.at((start, end.max(start)));
                Diagnostic::error(span, error).help(format!("`{}` takes {range}", column.name()))
            })
        };
        let direction = match self.direction {
            Direction::Angles([(column, idx), (other, other_idx)]) => {
                sphere(column, number(column, idx)?, number(other, other_idx)?)
            }
            Direction::Vector(indices) => {
                let [x, y, z] = [Column::X, Column::Y, Column::Z];
                let vector =
                    DVec3::new(number(x, indices[0])?, number(y, indices[1])?, number(z, indices[2])?);
                let largest = vector.abs().max_element();
                if largest == 0.0 {
                    let error = Diagnostic::error(line.span(), "a star without a direction");
                    return Err(error.help("one of `x`, `y` and `z` must not be 0"));
                }
                (vector / largest).normalize()
            }
        };
        let (column, idx) = self.color;
        let color = number(column, idx)?;
        Ok(Star {
            direction,
            magnitude: number(Column::Magnitude, self.magnitude)?,
            kelvin: if column == Column::ColorIndex { ballesteros(color) } else { color },
        })
    }
}

fn number(column: Column, field: &[u8]) -> Result<f64, String> {
    let text = String::from_utf8_lossy(field);
    let ([least, most], _) = column.range();
    match text.parse::<f64>() {
        _ if text.is_empty() => Err(format!("the field `{}` is empty", column.name())),
        Err(_) => Err(format!("`{text}` is not a number")),
        Ok(number) if !(least..=most).contains(&number) => Err(format!("`{text}` is out of range")),
        Ok(number) => Ok(number),
    }
}

/// A direction in the axes of panoramas: y ahead, x to the right and z up. Longitude increases to
/// the right; right ascension, as seen from inside with the north up, to the left.
fn sphere(column: Column, longitude: f64, latitude: f64) -> DVec3 {
    let right = match column {
        Column::Ra => -longitude,
        Column::RaHours => -15.0 * longitude,
        _ => longitude,
    };
    let (sin, cos) = libm::sincos(right.to_radians());
    let (up, level) = libm::sincos(latitude.to_radians());
    DVec3::new(level * sin, level * cos, up)
}

/// The temperature of a colour index B − V, kelvins (Ballesteros 2012, eq. 14).
fn ballesteros(index: f64) -> f64 {
    4600.0 * (1.0 / (0.92 * index + 1.7) + 1.0 / (0.92 * index + 0.62))
}
