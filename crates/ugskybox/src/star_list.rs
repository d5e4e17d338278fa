//! Lists of stars as text: CSV with a line of column names.

use std::ops::Range;

use csv::{ByteRecord, Reader, ReaderBuilder};
use glam::DVec3;
use thiserror::Error;
use ugimage::foreign_kind;
use ugparse::{Diagnostic, Diagnostics, Source, Span};
use ugpipe::remedies::look_alike;
use ugsky::Star;

/// Most stars of a list.
const MAX_STARS: usize = 10_000_000;

/// Most mistakes that are reported.
const MOST_MISTAKES: usize = 20;

/// Most bytes of a field that are quoted.
const MOST_QUOTED: usize = 40;

/// A column of a list of stars.
#[derive(Debug, PartialEq)]
struct StarColumn {
    /// Its names, of which the first is documented.
    names: &'static [&'static str],
    /// Least and greatest value, and their description.
    range: ([f64; 2], &'static str),
    /// What an hour or a degree of sexagesimal fields (`hh mm ss`, `hh:mm:ss`) stands for.
    sexagesimal: Option<f64>,
}

/// Indices in [`COLUMNS`].
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

const LONGITUDES: ([f64; 2], &str) = ([-360.0, 360.0], "degrees from -360 to 360");
const LATITUDES: ([f64; 2], &str) = ([-90.0, 90.0], "degrees from -90 to 90");
const COORDINATES: ([f64; 2], &str) = ([-1e100, 1e100], "a coordinate of a direction");

static COLUMNS: [StarColumn; 11] = [
    StarColumn {
        names: &["ra", "ra_deg", "right ascension", "raj2000", "ra_icrs", "radeg"],
        range: LONGITUDES,
        sexagesimal: Some(15.0),
    },
    StarColumn {
        names: &["ra_hours", "ra_h"],
        range: ([-24.0, 24.0], "hours from -24 to 24"),
        sexagesimal: Some(1.0),
    },
    StarColumn {
        names: &["dec", "dec_deg", "declination", "dej2000", "de_icrs", "dedeg"],
        range: LATITUDES,
        sexagesimal: Some(1.0),
    },
    StarColumn { names: &["lon", "longitude"], range: LONGITUDES, sexagesimal: Some(1.0) },
    StarColumn { names: &["lat", "latitude"], range: LATITUDES, sexagesimal: Some(1.0) },
    StarColumn { names: &["x"], range: COORDINATES, sexagesimal: None },
    StarColumn { names: &["y"], range: COORDINATES, sexagesimal: None },
    StarColumn { names: &["z"], range: COORDINATES, sexagesimal: None },
    StarColumn {
        names: &["mag", "magnitude", "vmag", "v", "gmag", "phot_g_mean_mag"],
        range: ([-60.0, 60.0], "a magnitude from -60 to 60"),
        sexagesimal: None,
    },
    StarColumn {
        names: &["kelvin", "temperature", "teff", "teff_gspphot", "t"],
        range: ([100.0, 1e6], "kelvins from 100 to 1000000"),
        sexagesimal: None,
    },
    StarColumn {
        names: &["b-v", "bv", "ci"],
        range: ([-0.4, 8.0], "a colour index from -0.4 to 8"),
        sexagesimal: None,
    },
];

impl StarColumn {
    /// Its documented name.
    fn name(&self) -> &'static str {
        self.names[0]
    }
}

/// The row in [`COLUMNS`] of a name, and its rank among the names of that row, the lowest of which
/// is read if a list has several. A name may have its unit in brackets: `ra [deg]`, `ra (h)`.
/// VizieR begins the names of columns that it has computed with `_`.
fn column_of(name: &[u8]) -> Option<(usize, usize)> {
    let name = str::from_utf8(name).ok()?.trim();
    let (name, unit) = match name.split_once(['[', '(']) {
        Some((name, unit)) => (name.trim_end(), unit.trim_end_matches([']', ')'])),
        None => (name, ""),
    };
    let bare = name.trim_start_matches('_');
    let place = |column: &StarColumn| {
        column.names.iter().position(|known| bare.eq_ignore_ascii_case(known))
    };
    let (column, place) =
        COLUMNS.iter().enumerate().find_map(|(row, column)| Some((row, place(column)?)))?;
    let is_hours = matches!(unit.to_ascii_lowercase().as_str(), "h" | "hr" | "hours" | "hourangle");
    let column =
        if column == Column::Ra as usize && is_hours { Column::RaHours as usize } else { column };
    Some((column, 2 * place + usize::from(bare == name)))
}

/// A list of stars that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct StarList {
    /// The stars.
    pub stars: Vec<Star>,
    /// What its user should know, one sentence each.
    pub notes: Vec<String>,
}

/// An error in a list of stars.
#[derive(Clone, Debug, Error, PartialEq)]
enum StarListMistake {
    /// There is no line but comments.
    #[error("a list of stars without a line of column names")]
    NoNames,
    /// Two columns have the same meaning.
    #[error("the column `{}` is there twice", .0.name())]
    Twice(&'static StarColumn),
    /// Columns are missing: directions, magnitudes or temperatures.
    #[error("a list of stars without {0}")]
    Missing(&'static str),
    /// A line has more or fewer fields than there are columns.
    #[error("{n_fields} fields where {n_columns} columns have names")]
    Fields {
        /// Fields of the line.
        n_fields: usize,
        /// Columns of the list.
        n_columns: usize,
    },
    /// A field that is needed is empty.
    #[error("the field `{}` is empty", .0.name())]
    Empty(&'static StarColumn),
    /// A field is no number; its first characters.
    #[error("`{1}` is not a number")]
    NotANumber(&'static StarColumn, String),
    /// A number is out of range; its first characters.
    #[error("`{1}` is out of range")]
    OutOfRange(&'static StarColumn, String),
    /// x, y and z are 0.
    #[error("a star without a direction")]
    NoDirection,
    /// There are more than [`MAX_STARS`].
    #[error("more than {MAX_STARS} stars")]
    TooMany,
}

impl StarListMistake {
    /// The error with its place, the bytes of the file that are wrong.
    fn at(&self, place: Range<usize>) -> Diagnostic {
        let span = Span { start: place.start as u32, end: place.end as u32 };
        Diagnostic::error(span, self.to_string()).help(self.remedy())
    }

    /// How to correct it.
    fn remedy(&self) -> String {
        match self {
            Self::NoNames | Self::Missing(_) => {
                "begin with the names of columns: `ra,dec,mag,kelvin`, or `ra_hours` in place of `ra`, `lon,lat` or \
                 `x,y,z` in place of `ra,dec`, or `b-v` in place of `kelvin`"
            }
            Self::Twice(_) => "rename or remove one",
            Self::Fields { .. } => {
                "write as many fields in each line; put a field with a comma in double quotes, without blanks around \
                 them"
            }
            Self::Empty(column) | Self::NotANumber(column, _) | Self::OutOfRange(column, _) => {
                let takes = format!("`{}` takes {}", column.name(), column.range.1);
                return match self {
                    Self::NotANumber(_, word) if let Some(remedy) = look_alike(word) => remedy,
                    Self::NotANumber(_, word) if word.contains(',') => format!("{takes}, with a decimal point"),
                    Self::NotANumber(..) if column.sexagesimal.is_some() => {
                        let is_time = matches!(column.name(), "ra" | "ra_hours");
                        let words = if is_time { "`hh mm ss` or `hh:mm:ss`" } else { "`dd mm ss` or `dd:mm:ss`" };
                        format!("{takes}, or {words}")
                    }
                    _ => takes,
                };
            }
            Self::NoDirection => "one of `x`, `y` and `z` must not be 0",
            Self::TooMany => "keep the brightest",
        }
        .to_owned()
    }
}

/// True if a file is a list of stars rather than a picture: text whose first line, comments apart,
/// has names of columns, or any text in a file called `.csv` or `.tsv`.
pub fn is_star_list(name: &str, file: &[u8]) -> bool {
    let head = &file[..file.len().min(4096)];
    let mut record = ByteRecord::new();
    let is_text = |byte: &u8| *byte >= b' ' || byte.is_ascii_whitespace();
    let is_table = [".csv", ".tsv"].iter().any(|end| name.to_ascii_lowercase().ends_with(end))
        && head.iter().all(is_text)
        && foreign_kind(file).is_none();
    next(&mut reader(head, separator(head)), &mut record, separator(head))
        && record.as_slice().iter().all(is_text)
        && (record.iter().filter_map(column_of).count() >= 2 || is_table)
}

/// Reads a list of stars. `name`: of the file, for messages.
///
/// The first line has the names of columns, separated by commas, semicolons, tabs, bars or blanks;
/// other columns than the known ones are allowed and ignored. Angles may be sexagesimal (`hh mm
/// ss`, `hh:mm:ss`, right ascension in hours). In a list with the columns `ra` and
/// `rarad`, those of the HYG catalogue, `ra` is in hours. Lines that are empty or begin with `#` or
/// `sep=` are skipped, and so are lines of units, without a digit, before the first star. Stars
/// without a magnitude, a temperature or a direction are left out.
///
/// # Errors
/// All errors of up to 20 lines, with line and column.
pub fn read_stars(name: &str, file: &[u8]) -> Result<StarList, Box<Diagnostics>> {
    read(file).map_err(|errors| Box::new(Diagnostics::new(&Source::new(name, file), errors)))
}

fn read(file: &[u8]) -> Result<StarList, Vec<Diagnostic>> {
    let separator = separator(file);
    let (mut reader, mut record) = (reader(file, separator), ByteRecord::new());
    if !next(&mut reader, &mut record, separator) {
        return Err(vec![StarListMistake::NoNames.at(0..0)]);
    }
    let layout = Layout::new(&record).map_err(|wrong| vec![wrong.at(file, separator, &record)])?;
    let (mut stars, mut errors) = (Vec::new(), Vec::new());
    let (mut n_incomplete, mut largest) = (0, f64::NEG_INFINITY);
    while errors.len() < MOST_MISTAKES && next(&mut reader, &mut record, separator) {
        if stars.is_empty() && !record.as_slice().iter().any(u8::is_ascii_digit) {
            continue;
        }
        match layout.star(&record) {
            Ok(_) if stars.len() == MAX_STARS => {
                errors.push(Wrong(None, StarListMistake::TooMany).at(file, separator, &record));
                break;
            }
            Ok(star) => {
                largest = largest.max(layout.right_ascension(&record));
                stars.push(star);
            }
            Err(Wrong(_, StarListMistake::Empty(_))) => n_incomplete += 1,
            Err(wrong) => errors.push(wrong.at(file, separator, &record)),
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let mut notes = Vec::new();
    if n_incomplete > 0 {
        let fields = "a direction, a magnitude and a temperature or colour index";
        notes.push(format!(
            "{n_incomplete} stars of the list are left out, since they have not all of {fields}"
        ));
    }
    if layout.is_hyg {
        notes.push(
            "the list has the columns of the HYG catalogue: its right ascensions are in hours"
                .to_owned(),
        );
    } else if stars.len() > 1 && (0.0..24.0).contains(&largest) {
        notes.push(
            "all right ascensions are below 24 degrees: if they are hours, name the column `ra_hours`"
                .to_owned(),
        );
    }
    Ok(StarList { stars, notes })
}

/// The character between the names of columns: a comma, a semicolon, a tab or a bar, whichever is
/// there most often, or else a blank.
fn separator(file: &[u8]) -> u8 {
    let file = file.strip_prefix(b"\xef\xbb\xbf").unwrap_or(file);
    let mut lines = file.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let names = lines.find(|line| !line.is_empty() && !is_comment(line)).unwrap_or_default();
    let count = |separator: &u8| names.iter().filter(|byte| *byte == separator).count();
    let most =
        [b'\t', b'|', b';', b','].into_iter().max_by_key(count).filter(|most| count(most) > 0);
    most.unwrap_or(if names.contains(&b' ') { b' ' } else { b',' })
}

/// Comments, and what tells spreadsheets the separator.
fn is_comment(line: &[u8]) -> bool {
    line.starts_with(b"#") || line.starts_with(b"sep=")
}

fn reader(file: &[u8], separator: u8) -> Reader<&[u8]> {
    let mut builder = ReaderBuilder::new();
    builder
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .delimiter(separator)
        .from_reader(file)
}

/// Reads the next record, skipping blank lines and comments; returns false at the end of the file.
fn next(reader: &mut Reader<&[u8]>, record: &mut ByteRecord, separator: u8) -> bool {
    // Bytes in memory are read without errors.
    while matches!(reader.read_byte_record(record), Ok(true)) {
        let first = record.get(0).unwrap_or_default().trim_ascii_start();
        if is_comment(first) || record.iter().all(<[u8]>::is_empty) && record.len() <= 1 {
            continue;
        }
        if separator == b' ' {
            // Of several blanks in a row one separates.
            let position = record.position().cloned();
            *record = record.iter().filter(|field| !field.is_empty()).collect();
            record.set_position(position);
        }
        return true;
    }
    false
}

/// A mistake in a field of a record, or in all of it.
struct Wrong(Option<usize>, StarListMistake);

impl Wrong {
    /// The mistake with its place in the file, which is searched again: a record has its fields
    /// without quotes, and begins before the comments above it.
    fn at(self, file: &[u8], separator: u8, record: &ByteRecord) -> Diagnostic {
        let Self(field, mistake) = self;
        let before = record.position().map_or(0, |position| position.byte() as usize);
        let is_blank = |byte: &u8| byte.is_ascii_whitespace() && *byte != separator;
        let trimmed = |text: &[u8]| text.iter().take_while(|byte| is_blank(byte)).count();
        let mut rest = &file[before.min(file.len())..];
        rest = &rest[trimmed(rest)..];
        while is_comment(rest) {
            rest = &rest[line_end(rest)..];
            rest = &rest[trimmed(rest)..];
        }
        for _ in 0..field.unwrap_or(0) {
            rest = &rest[(field_end(rest, separator) + 1).min(rest.len())..];
            if separator == b' ' {
                rest = rest.trim_ascii_start();
            }
        }
        let end = if field.is_some() { field_end(rest, separator) } else { line_end(rest) };
        let start = file.len() - rest[..end].trim_ascii_start().len() - rest[end..].len();
        mistake.at(start..start + rest[..end].trim_ascii().len())
    }
}

fn line_end(text: &[u8]) -> usize {
    text.iter().position(|byte| *byte == b'\n').unwrap_or(text.len())
}

fn field_end(text: &[u8], separator: u8) -> usize {
    let mut is_quoted = false;
    let is_end = |byte: &u8| {
        is_quoted ^= *byte == b'"';
        !is_quoted && (*byte == separator || matches!(byte, b'\r' | b'\n'))
    };
    text.iter().position(is_end).unwrap_or(text.len())
}

/// How the columns of a list give the direction and the temperature of a star: indices of columns.
struct Layout {
    direction: Direction,
    magnitude: usize,
    color: (Column, usize),
    n_columns: usize,
    /// The list has the columns of the HYG catalogue.
    is_hyg: bool,
    /// The column of distances in it, which is 0 for the sun.
    distance: Option<usize>,
}

enum Direction {
    /// Longitude or right ascension, and latitude or declination.
    Angles([(Column, usize); 2]),
    Vector([usize; 3]),
}

impl Layout {
    fn new(record: &ByteRecord) -> Result<Self, Wrong> {
        let mut indices = [None; COLUMNS.len()];
        let mut ranks = [usize::MAX; COLUMNS.len()];
        for (idx, name) in record.iter().enumerate() {
            let Some((column, rank)) = column_of(name) else { continue };
            if ranks[column] == rank {
                return Err(Wrong(Some(idx), StarListMistake::Twice(&COLUMNS[column])));
            }
            if rank < ranks[column] {
                (indices[column], ranks[column]) = (Some(idx), rank);
            }
        }
        let missing = |what: &'static str| Wrong(None, StarListMistake::Missing(what));
        let place = |name: &[u8]| {
            record.iter().position(|other| other.trim_ascii().eq_ignore_ascii_case(name))
        };
        let is_hyg = place(b"rarad").is_some();
        if is_hyg && let Some(idx) = indices[Column::Ra as usize].take() {
            indices[Column::RaHours as usize] = Some(idx);
        }
        let at = |column: Column| indices[column as usize];
        let both = |one: Column, other: Column| Some([(one, at(one)?), (other, at(other)?)]);
        let vector = || Some([at(Column::X)?, at(Column::Y)?, at(Column::Z)?]);
        let direction = both(Column::Ra, Column::Dec)
            .or_else(|| both(Column::RaHours, Column::Dec))
            .or_else(|| both(Column::Longitude, Column::Latitude))
            .map(Direction::Angles)
            .or_else(|| vector().map(Direction::Vector))
            .ok_or_else(|| missing("directions"))?;
        let color = |column: Column| Some((column, at(column)?));
        let temperatures = match place(b"bp_rp").or_else(|| place(b"bp-rp")) {
            Some(_) => "temperatures: `bp_rp` is not `b-v`, and Gaia has `teff_gspphot`",
            None => "temperatures",
        };
        Ok(Self {
            direction,
            magnitude: at(Column::Magnitude).ok_or_else(|| missing("magnitudes"))?,
            color: color(Column::Kelvin)
                .or_else(|| color(Column::ColorIndex))
                .ok_or_else(|| missing(temperatures))?,
            n_columns: record.len(),
            is_hyg,
            distance: place(b"dist").filter(|_| is_hyg),
        })
    }

    /// The right ascension of a star of the list as a single number of degrees; NaN without one.
    fn right_ascension(&self, record: &ByteRecord) -> f64 {
        match self.direction {
            Direction::Angles([(Column::Ra, idx), _]) => {
                let field = str::from_utf8(&record[idx]).unwrap_or_default();
                field.trim().parse().unwrap_or(f64::NAN)
            }
            _ => f64::NAN,
        }
    }

    fn star(&self, record: &ByteRecord) -> Result<Star, Wrong> {
        if record.len() != self.n_columns {
            let mistake =
                StarListMistake::Fields { n_fields: record.len(), n_columns: self.n_columns };
            return Err(Wrong(None, mistake));
        }
        let is_at_eye = |idx: usize| {
            str::from_utf8(&record[idx]).is_ok_and(|field| field.trim().parse() == Ok(0.0))
        };
        if let Some(idx) = self.distance.filter(|&idx| is_at_eye(idx)) {
            return Err(Wrong(Some(idx), StarListMistake::Empty(&COLUMNS[Column::X as usize])));
        }
        let number = |column: Column, idx: usize| {
            number(&COLUMNS[column as usize], &record[idx])
                .map_err(|mistake| Wrong(Some(idx), mistake))
        };
        let direction = match self.direction {
            Direction::Angles([(column, idx), (other, other_idx)]) => {
                sphere(column, number(column, idx)?, number(other, other_idx)?)
            }
            Direction::Vector([x, y, z]) => {
                let vector =
                    DVec3::new(number(Column::X, x)?, number(Column::Y, y)?, number(Column::Z, z)?);
                let largest = vector.abs().max_element();
                if largest == 0.0 {
                    return Err(Wrong(None, StarListMistake::NoDirection));
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

/// Fields of stars without a value.
const NOTHING: [&[u8]; 5] = [b"", b"null", b"nan", b"--", b"~"];

fn number(column: &'static StarColumn, field: &[u8]) -> Result<f64, StarListMistake> {
    let field = field.trim_ascii();
    let quoted = || {
        let rest = if field.len() > MOST_QUOTED { "…" } else { "" };
        format!("{}{rest}", String::from_utf8_lossy(&field[..field.len().min(MOST_QUOTED)]))
    };
    let ([least, most], _) = column.range;
    if NOTHING.iter().any(|it| field.eq_ignore_ascii_case(it)) {
        return Err(StarListMistake::Empty(column));
    }
    let text = std::str::from_utf8(field).unwrap_or_default();
    let number = text.parse::<f64>().ok().or_else(|| sexagesimal(text, column.sexagesimal?));
    match number {
        None => Err(StarListMistake::NotANumber(column, quoted())),
        Some(number) if !(least..=most).contains(&number) => {
            Err(StarListMistake::OutOfRange(column, quoted()))
        }
        Some(number) => Ok(number),
    }
}

/// The number that hours or degrees, minutes and seconds stand for, times `unit`: `-00 30 00.0`,
/// `05:30:00`, `5h30m0s`, `-0°30'`. The sign is that of all parts, also of −00.
fn sexagesimal(text: &str, unit: f64) -> Option<f64> {
    let unsigned = text.trim_start_matches(['+', '-']);
    if text.len() > unsigned.len() + 1 {
        return None;
    }
    let is_mark = |c: char| matches!(c, 'h' | 'd' | 'm' | 's' | '°' | '\'' | '"' | '′' | '″' | ':');
    let is_in_degrees = unsigned.contains(['d', '°']);
    // Degrees of right ascension are no hours, and hours of others no degrees.
    if is_in_degrees && unsigned.contains('h') || unit == 1.0 && unsigned.contains('h') {
        return None;
    }
    let words =
        unsigned.split(|c: char| is_mark(c) || c.is_whitespace()).filter(|it| !it.is_empty());
    let mut parts = [0.0_f64; 3];
    let mut n_parts = 0;
    for word in words {
        let is_plain = word.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
        let part: f64 = word.parse().ok().filter(|_| is_plain)?;
        // Before another part is a whole number; rounded seconds may be 60.
        let is_whole = n_parts == 0 || parts[n_parts - 1].fract() == 0.0;
        let is_within = n_parts == 0 || part < 60.0 || n_parts == 2 && part == 60.0;
        *parts.get_mut(n_parts).filter(|_| is_whole && is_within)? = part;
        n_parts += 1;
    }
    let [whole, minutes, seconds] = parts;
    let sum = whole + (minutes + seconds / 60.0) / 60.0;
    let sign = if text.starts_with('-') { -1.0 } else { 1.0 };
    (n_parts >= 2).then_some(sign * sum * if is_in_degrees { 1.0 } else { unit })
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
