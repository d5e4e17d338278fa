//! What the history of a scene says of its colours.

use ugparse::Scene;

/// How a scene was made, as far as its head comments tell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// The command lines, oldest first.
    pub lines: Vec<String>,
    /// Whether `uglorentz` is among them.
    pub has_lorentz: bool,
    /// What the last `ugdoppler` among them did.
    pub doppler: Option<DopplerStory>,
}

/// What `ugdoppler` was told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DopplerStory {
    /// Wavelengths were shifted.
    pub shifts: bool,
    /// The law by which brightness was changed, `none` if it was left alone.
    pub law: String,
}

impl Provenance {
    /// That of a scene.
    pub fn of(scene: &Scene) -> Self {
        let lines: Vec<String> = ugscene::history(scene).into_iter().map(str::to_owned).collect();
        let by = |program: &str| lines.iter().rfind(|line| line.split(' ').next() == Some(program));
        let doppler = by("ugdoppler").map(|line| DopplerStory::read(line));
        Self { has_lorentz: by("uglorentz").is_some(), doppler, lines }
    }

    /// True if wavelengths are known to have been shifted.
    pub fn shifts(&self) -> bool {
        self.doppler.as_ref().is_some_and(|doppler| doppler.shifts)
    }
}

impl DopplerStory {
    fn read(line: &str) -> Self {
        let words: Vec<&str> = line.split(' ').collect();
        let has = |word: &str| words.contains(&word);
        let named = words.iter().position(|word| *word == "-br").and_then(|at| words.get(at + 1));
        let law = if has("--no-flux") { "none" } else { named.copied().unwrap_or("report") };
        Self { shifts: !has("--no-doppler"), law: law.to_owned() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn command_lines_are_read() {
        let provenance = |line: &str| {
            let mut scene = Scene::default();
            ugscene::record(&mut scene, "uglorentz", "0.1.0", "uglorentz -vel .9 0 0");
            ugscene::record(&mut scene, "ugdoppler", "0.1.0", line);
            Provenance::of(&scene)
        };
        for (line, shifts, law) in [
            ("ugdoppler", true, "report"),
            ("ugdoppler -br photon -gw", true, "photon"),
            ("ugdoppler --no-doppler", false, "report"),
            ("ugdoppler -br photon --no-flux", true, "none"),
        ] {
            let Provenance { has_lorentz, doppler: Some(doppler), .. } = provenance(line) else {
                panic!("{line}")
            };
            assert!(has_lorentz);
            assert_eq!((doppler.shifts, &*doppler.law), (shifts, law));
        }
        assert_eq!(Provenance::of(&Scene::default()).doppler, None);
    }
}
