//! The units in the texts of a picture: what a length of 1 in the scene is, and how fast light is
//! there. Pictures do not depend on them.

use ugimage::label::number::significant;

/// The speed of light in vacuum in m/s.
const LIGHT: f64 = 299_792_458.0;

/// Units of length in metres.
const LENGTHS: [(&str, f64); 11] = [
    ("nm", 1e-9),
    ("µm", 1e-6),
    ("mm", 1e-3),
    ("cm", 0.01),
    ("m", 1.0),
    ("km", 1e3),
    ("ft", 0.3048),
    ("mi", 1_609.344),
    ("au", 149_597_870_700.0),
    ("ly", 9_460_730_472_580_800.0),
    ("pc", 30_856_775_814_913_673.0),
];

/// Units of length that are times of flight of light, in seconds.
const LIGHT_TIMES: [(&str, f64); 4] = [("ns", 1e-9), ("s", 1.0), ("min", 60.0), ("h", 3_600.0)];

/// Units of time in seconds, in which times are written.
const TIMES: [(&str, f64); 9] = [
    ("fs", 1e-15),
    ("ps", 1e-12),
    ("ns", 1e-9),
    ("µs", 1e-6),
    ("ms", 1e-3),
    ("s", 1.0),
    ("h", 3_600.0),
    ("d", 86_400.0),
    ("a", 31_557_600.0),
];

/// Units of speed in m/s.
const SPEEDS: [(&str, f64); 6] = [
    ("mm/s", 1e-3),
    ("cm/s", 0.01),
    ("m/s", 1.0),
    ("km/s", 1e3),
    ("km/h", 1.0 / 3.6),
    ("mph", 0.447_04),
];

/// The units in the texts of a picture. Without any, lengths and times are those of the scene, and
/// speeds have the unit c.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Units {
    /// What a length of 1 is: a number of units with a name.
    length: Option<(Unit, f64)>,
    /// The speed of light: in its unit, and in m/s.
    light: Option<(Unit, f64)>,
}

/// A unit in which something is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// The number of them in 1 of the scene.
    pub factor: f64,
    /// Its name.
    pub name: String,
}

impl Unit {
    /// A number of the scene with its unit.
    pub fn written(&self, value: f64, digits: usize) -> String {
        format!("{} {}", significant(self.factor * value, digits), self.name)
    }
}

impl Units {
    /// Units by name. `length`: a unit such as `m`, `km`, `ls` (the way of light in a second), with
    /// a number before it if a length of 1 is more of them; `light`: a speed such as `30km/h`. If
    /// only `length` is given, light is as fast as in vacuum.
    ///
    /// # Errors
    /// There is no such unit; the number is not above 0.
    pub fn new(length: Option<&str>, light: Option<&str>) -> Result<Self, String> {
        let in_vacuum = || (Unit { factor: LIGHT / 1e3, name: "km/s".to_owned() }, LIGHT);
        let light = match light {
            Some(words) => Some(speed_of_light(words)?),
            None => length.map(|_| in_vacuum()),
        };
        let metres_per_second = light.as_ref().map_or(LIGHT, |(_, speed)| *speed);
        let length = length.map(|words| length_of_one(words, metres_per_second)).transpose()?;
        Ok(Self { length, light })
    }

    /// That of lengths, if one is given.
    pub fn length(&self) -> Option<Unit> {
        self.length.as_ref().map(|(unit, _)| unit.clone())
    }

    /// That of speeds, if one is given.
    pub fn speed(&self) -> Option<Unit> {
        self.light.as_ref().map(|(unit, _)| unit.clone())
    }

    /// That in which times up to `longest` (in units of the scene) have few digits, if the lengths
    /// of the scene have a unit.
    pub fn time(&self, longest: f64) -> Option<Unit> {
        let ((_, metres), (_, speed)) = self.length.as_ref().zip(self.light.as_ref())?;
        let second = metres / speed;
        let fits = |(_, seconds): &&(&str, f64)| second * longest.abs() >= *seconds;
        let (name, seconds) = TIMES.iter().rev().find(fits).unwrap_or(&("s", 1.0));
        Some(Unit { factor: second / seconds, name: (*name).to_owned() })
    }
}

/// The number before a name, 1 if there is none.
fn split(words: &str) -> Result<(f64, &str), String> {
    let is_name = |c: char| !(c.is_ascii_digit() || c == '.' || c == ' ');
    // An exponent is part of the number: a digit follows its letter.
    let exponent = |at: usize| {
        let rest =
            words[at..].strip_prefix(['e', 'E']).map(|rest| rest.trim_start_matches(['+', '-']));
        rest.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    let mut start = words.find(is_name).unwrap_or(words.len());
    if start > 0 && start < words.len() && exponent(start) {
        let digits =
            words[start + 1..].find(|c: char| !(c.is_ascii_digit() || c == '+' || c == '-'));
        start = digits.map_or(words.len(), |at| start + 1 + at);
    }
    let (number, name) = (words[..start].trim(), words[start..].trim());
    let value = if number.is_empty() { Ok(1.0) } else { number.parse::<f64>() };
    match value {
        Ok(value) if value > 0.0 && value.is_finite() => Ok((value, name)),
        _ => Err(format!("`{words}` does not begin with a number above 0, or with a unit")),
    }
}

fn length_of_one(words: &str, light: f64) -> Result<(Unit, f64), String> {
    let (number, name) = split(words)?;
    let of_light = |name: &str| {
        let (_, seconds) =
            LIGHT_TIMES.iter().find(|(time, _)| name.strip_prefix('l') == Some(time))?;
        Some(seconds * light)
    };
    let plain =
        |name: &str| LENGTHS.iter().find(|(known, _)| *known == name).map(|(_, metres)| *metres);
    let name = if name == "um" { "µm" } else { name };
    let metres = plain(name).or_else(|| of_light(name)).ok_or_else(|| {
        let names = LENGTHS.iter().map(|(name, _)| (*name).to_owned());
        let of_light = LIGHT_TIMES.iter().map(|(name, _)| format!("l{name}"));
        format!(
            "`{name}` is none of the units {}",
            names.chain(of_light).collect::<Vec<_>>().join(", ")
        )
    })?;
    in_range(number * metres, words)?;
    Ok((Unit { factor: number, name: name.to_owned() }, number * metres))
}

fn speed_of_light(words: &str) -> Result<(Unit, f64), String> {
    let (number, name) = split(words)?;
    let (name, speed) = SPEEDS.iter().find(|(known, _)| *known == name).ok_or_else(|| {
        format!("`{name}` is none of the units {}", SPEEDS.map(|(name, _)| name).join(", "))
    })?;
    in_range(number * speed, words)?;
    Ok((Unit { factor: number, name: (*name).to_owned() }, number * speed))
}

/// Products of lengths, speeds and times stay within the range of numbers.
fn in_range(value: f64, words: &str) -> Result<(), String> {
    if (1e-60..=1e60).contains(&value) { Ok(()) } else { Err(format!("`{words}` is out of range")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(unit: Option<Unit>, value: f64) -> String {
        unit.map_or_else(String::new, |unit| unit.written(value, 4))
    }

    #[test]
    fn metres_give_nanoseconds() {
        let units = Units::new(Some("m"), None).unwrap();
        assert_eq!(written(units.length(), 12.5), "12.5 m");
        assert_eq!(written(units.time(1.0), 1.0), "3.336 ns");
        assert_eq!(written(units.time(-1e9), -1e9), "−3.336 s");
        assert_eq!(written(units.speed(), 0.5), "149896 km/s");
        let far = Units::new(Some("4.22 ly"), None).unwrap();
        assert_eq!(written(far.length(), 0.5), "2.11 ly");
        assert_eq!(written(far.time(1.0), 1.0), "4.22 a");
    }

    /// In a town where light is as fast as a bicycle, a length of 1 m takes 0.12 s.
    #[test]
    fn light_may_be_slow() {
        let units = Units::new(Some("m"), Some("30km/h")).unwrap();
        assert_eq!(written(units.speed(), 0.9), "27 km/h");
        assert_eq!(written(units.time(1.0), 1.0), "120 ms");
        let seconds = Units::new(Some("20 ls"), Some("1e1 m/s")).unwrap();
        assert_eq!(written(seconds.length(), 1.0), "20 ls");
        assert_eq!(written(seconds.time(1.0), 1.0), "20 s");
        assert_eq!(Units::new(None, Some("1 m/s")).unwrap().time(1.0), None);
        assert_eq!(Units::default().speed(), None);
    }

    #[test]
    fn what_is_no_unit_is_refused() {
        for words in
            ["", "furlong", "0 m", "-1 m", "1e999 m", "1e300 m", "m m", "nan m", "1 e5", "km/h"]
        {
            assert!(Units::new(Some(words), None).is_err(), "{words}");
        }
        for words in ["", "30", "0km/h", "30 m", "c", "1e-99 m/s"] {
            assert!(Units::new(None, Some(words)).is_err(), "{words}");
        }
    }
}
