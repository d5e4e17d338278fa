//! The stage of a scene as text: an escape, which other readers of UniGrafix skip.
//!
//! ```text
//! (ugstage 1 geometry as-seen eye 0 -12 3 time -5 camera-velocity 0.6 0 0 no-contraction
//!  colors as-seen hues law report no-doppler lights mixtures mix#)
//! ```

use glam::DVec3;
use ugphysics::spectrum::InfraredRule;
use ugphysics::{Brightness, Velocity};
use ugscene::{
    ColorScale, ColorStage, GeometryStage, HueScale, MixtureNames, SeenColors, SeenGeometry, Stage,
};

use crate::diagnostic::Diagnostic;
use crate::number_text::push_number;
use crate::reader::Document;
use crate::source::Span;
use crate::suggest::nearest;
use crate::token::{Input, found, is_blank, number};
use crate::wording::{shorten, word_help};

/// First word of the statement.
const KEYWORD: &str = "ugstage";

/// The version that is read and written.
const VERSION: &str = "1";

const AT_REST: &str = "at-rest";
const AS_SEEN: &str = "as-seen";
const DEFERRED: &str = "deferred";
const GEOMETRY: &str = "geometry";
const COLORS: &str = "colors";
const MIXTURES: &str = "mixtures";
const EYE: &str = "eye";
const TIME: &str = "time";
const CAMERA_VELOCITY: &str = "camera-velocity";
const GAMMA: &str = "gamma";
const NO_CONTRACTION: &str = "no-contraction";
const NO_FLIGHT_TIME: &str = "no-flight-time";
const HUES: &str = "hues";
const WAVELENGTHS: &str = "wavelengths";
const SPECTRA: &str = "spectra";
const LAW: &str = "law";
const NO_DOPPLER: &str = "no-doppler";
const NO_FLUX: &str = "no-flux";
const CONSTANT_INFRARED: &str = "constant-infrared";
const LIGHTS: &str = "lights";

/// Escapes of earlier versions, which had these first and second words.
const EARLIER: (&str, [&str; 3]) = ("uglorentz", [NO_CONTRACTION, NO_FLIGHT_TIME, CAMERA_VELOCITY]);

/// Is an escape, given with its parentheses, a stage statement?
pub(crate) fn is_stage(escape: &[u8]) -> bool {
    escape.len() > 2 && first_word(escape, Span { start: 0, end: escape.len() as u32 }) == KEYWORD.as_bytes()
}

/// Moves the stage statement of a document from its escapes to [`Document::stage`].
pub(crate) fn take(text: &[u8], document: &mut Document<'_>, findings: &mut Vec<Diagnostic>) {
    for row in 0..document.scopes.len() {
        let scope = &mut document.scopes[row];
        let spans = scope.escapes.spans.iter().copied();
        let is_stage = |(_, span): &(usize, Span)| first_word(text, *span) == KEYWORD.as_bytes();
        let statements: Vec<(usize, Span)> = spans.clone().enumerate().filter(is_stage).collect();
        findings.extend(spans.filter_map(|span| earlier(text, span)));
        scope.remove_escapes(&statements.iter().map(|(row, _)| *row).collect::<Vec<_>>());
        for (_, span) in statements {
            let keyword = keyword_span(text, span);
            if row > 0 {
                findings.push(
                    Diagnostic::error(keyword, "the stage of a scene cannot stand in a definition")
                        .label("here")
                        .help("it applies to the whole scene: move it before the first statement"),
                );
            } else if let Some((_, first)) = &document.stage {
                findings.push(
                    Diagnostic::error(keyword, "the stage of the scene is stated twice")
                        .label("again here")
                        .other(keyword_span(text, *first), "first here")
                        .help("a scene has one stage: scenes of different stages cannot be joined"),
                );
            } else {
                match read(text, span) {
                    Ok(stage) => document.stage = Some((stage, span)),
                    Err(finding) => findings.push(finding),
                }
            }
        }
    }
}

/// The text of an escape, without its parentheses.
fn inner(span: Span) -> Span {
    Span { start: span.start + 1, end: span.end - 1 }
}

fn first_word(text: &[u8], span: Span) -> &[u8] {
    Words::new(text, span).next().map_or(&[][..], |word| word.text)
}

fn keyword_span(text: &[u8], span: Span) -> Span {
    Words::new(text, span).next().map_or(span, |word| word.span)
}

/// The error for an escape of an earlier version.
fn earlier(text: &[u8], span: Span) -> Option<Diagnostic> {
    let mut words = Words::new(text, span);
    let (program, kinds) = EARLIER;
    let first = words.next().filter(|first| first.text == program.as_bytes())?;
    words.next().filter(|second| kinds.iter().any(|kind| kind.as_bytes() == second.text))?;
    Some(
        Diagnostic::error(first.span, "this scene as seen was written by an earlier version")
            .label("this escape is no longer read")
            .help("start again from the scene at rest"),
    )
}

/// Parses the statement at `span`, parentheses included.
fn read(text: &[u8], span: Span) -> Result<Stage, Diagnostic> {
    let mut words = Words::new(text, span);
    words.next();
    words.version()?;
    let mut stage = Stage::default();
    while let Some(word) = words.next() {
        words.once(word)?;
        match word.as_str() {
            GEOMETRY => stage.geometry = geometry(&mut words)?,
            COLORS => stage.colors = colors(&mut words)?,
            MIXTURES => stage.mixtures = Some(words.mixtures()?),
            _ => return Err(unknown(word, &[GEOMETRY, COLORS, MIXTURES])),
        }
    }
    Ok(stage)
}

fn geometry(words: &mut Words<'_>) -> Result<GeometryStage, Diagnostic> {
    if !words.is_as_seen()? {
        return Ok(GeometryStage::AtRest);
    }
    let mut eye = None;
    let mut seen = SeenGeometry {
        eye: DVec3::ZERO,
        time: 0.0,
        camera_velocity: Velocity::ZERO,
        contraction: true,
        flight_time: true,
    };
    while let Some(word) = words.next_of_part() {
        words.once(word)?;
        match word.as_str() {
            EYE => eye = Some(words.point()?),
            TIME => seen.time = words.number()?,
            CAMERA_VELOCITY => seen.camera_velocity = words.velocity(word)?,
            NO_CONTRACTION => seen.contraction = false,
            NO_FLIGHT_TIME => seen.flight_time = false,
            _ => {
                return Err(unknown(
                    word,
                    &[EYE, TIME, CAMERA_VELOCITY, NO_CONTRACTION, NO_FLIGHT_TIME, COLORS, MIXTURES],
                ));
            }
        }
    }
    seen.eye = eye.ok_or_else(|| words.missing("the eye point of a geometry as seen", "eye X Y Z"))?;
    Ok(GeometryStage::AsSeen(seen))
}

fn colors(words: &mut Words<'_>) -> Result<ColorStage, Diagnostic> {
    let stage = words.choice(&[AT_REST, AS_SEEN, DEFERRED])?;
    if stage == AT_REST {
        return Ok(ColorStage::AtRest);
    }
    let scales = [HUES, WAVELENGTHS, SPECTRA];
    let scale = words.choice(&scales)?;
    let is_spectral = scale == SPECTRA;
    let (mut law, mut flux, mut infrared) = (None, true, InfraredRule::Measured);
    let spectra = |flux, infrared| ColorScale::Spectra { flux, infrared };
    let mut seen = SeenColors { scale: spectra(flux, infrared), doppler: true, lights: false };
    while let Some(word) = words.next_of_part() {
        words.once(word)?;
        match word.as_str() {
            LAW if !is_spectral => {
                let name = words.choice(&Brightness::ALL.map(Brightness::name))?;
                law = Brightness::from_name(name);
            }
            NO_FLUX if is_spectral => flux = false,
            CONSTANT_INFRARED if is_spectral => infrared = InfraredRule::Constant,
            NO_DOPPLER => seen.doppler = false,
            LIGHTS => seen.lights = true,
            _ => {
                let own = if is_spectral { NO_FLUX } else { LAW };
                return Err(unknown(word, &[own, NO_DOPPLER, LIGHTS, GEOMETRY]));
            }
        }
    }
    seen.scale = if is_spectral {
        spectra(flux, infrared)
    } else {
        let unit = if scale == WAVELENGTHS { HueScale::Wavelengths } else { HueScale::Degrees };
        let law = law.ok_or_else(|| words.missing("the brightness law of hues as seen", "law report"))?;
        ColorScale::Hues { unit, law }
    };
    Ok(if stage == DEFERRED { ColorStage::Deferred(seen) } else { ColorStage::AsSeen(seen) })
}

/// The error for an unexpected word.
fn unknown(word: Word<'_>, expected: &[&str]) -> Diagnostic {
    let finding = Diagnostic::error(
        word.span,
        format!("`{}` is not expected here in the stage of a scene", shorten(word.text)),
    );
    let finding = finding.label("unexpected");
    match nearest(word.text, expected.iter().map(|word| word.as_bytes())) {
        Some(near) => finding.help(format!("did you mean `{near}`?")),
        None => finding.help(format!("expected `{}`", expected.join("`, `"))),
    }
}

/// A word of the statement.
#[derive(Clone, Copy)]
struct Word<'t> {
    text: Input<'t>,
    span: Span,
}

impl<'t> Word<'t> {
    fn as_str(self) -> &'t str {
        std::str::from_utf8(self.text).unwrap_or_default()
    }
}

/// The statement, word by word.
struct Words<'t> {
    rest: Input<'t>,
    /// Position of the closing parenthesis.
    end: u32,
    /// Key words so far that must not be repeated.
    known: Vec<Word<'t>>,
}

impl<'t> Words<'t> {
    /// `span`: of the statement.
    fn new(text: &'t [u8], span: Span) -> Self {
        let inner = inner(span);
        Self { rest: inner.of(text), end: inner.end, known: Vec::new() }
    }

    /// The next word, also if it is a punctuation mark; `None` at the end.
    fn next(&mut self) -> Option<Word<'t>> {
        self.skip_blanks();
        let text = found(self.rest);
        let start = self.position();
        self.rest = &self.rest[text.len()..];
        let span = Span { start, end: start + text.len() as u32 };
        (!text.is_empty()).then_some(Word { text, span })
    }

    fn skip_blanks(&mut self) {
        let n_blanks = self.rest.iter().take_while(|&&byte| is_blank(byte)).count();
        self.rest = &self.rest[n_blanks..];
    }

    /// Position of the remaining input in the text.
    fn position(&self) -> u32 {
        self.end - self.rest.len() as u32
    }

    /// The next word, if it belongs to the current part.
    fn next_of_part(&mut self) -> Option<Word<'t>> {
        let before = self.rest;
        let word = self.next();
        if word.is_some_and(|word| [GEOMETRY, COLORS, MIXTURES].contains(&word.as_str())) {
            self.rest = before;
            return None;
        }
        word
    }

    /// Refuses a repeated key word.
    fn once(&mut self, word: Word<'t>) -> Result<(), Diagnostic> {
        if let Some(first) = self.known.iter().find(|known| known.text == word.text) {
            return Err(Diagnostic::error(word.span, format!("`{}` is given twice", word.as_str()))
                .label("again here")
                .other(first.span, "first here")
                .help("remove one of them"));
        }
        self.known.push(word);
        Ok(())
    }

    fn version(&mut self) -> Result<(), Diagnostic> {
        match self.next() {
            Some(word) if word.as_str() == VERSION => Ok(()),
            Some(word) => {
                let shown = shorten(word.text);
                Err(Diagnostic::error(
                    word.span,
                    format!("`{shown}` is not a known version of the stage statement"),
                )
                .label(format!("expected {VERSION}"))
                .help("use the programs that wrote the scene, or make it again from the scene at rest"))
            }
            None => Err(self.missing("the version of the stage statement", VERSION)),
        }
    }

    fn is_as_seen(&mut self) -> Result<bool, Diagnostic> {
        Ok(self.choice(&[AT_REST, AS_SEEN])? == AS_SEEN)
    }

    /// One of several words.
    fn choice<'c>(&mut self, words: &[&'c str]) -> Result<&'c str, Diagnostic> {
        let Some(word) = self.next() else {
            return Err(self.missing("a word", &words.join("` or `")));
        };
        let found = words.iter().find(|known| known.as_bytes() == word.text);
        found.copied().ok_or_else(|| unknown(word, words))
    }

    fn number(&mut self) -> Result<f64, Diagnostic> {
        let Some(word) = self.next() else { return Err(self.missing("a number", "0")) };
        if let Ok(([], value)) = number(word.text) {
            return Ok(value);
        }
        let finding = Diagnostic::error(word.span, format!("`{}` is not a number", shorten(word.text)))
            .label("expected a number");
        Err(finding
            .help(word_help("a number", word.text).unwrap_or_else(|| "give a finite number".to_string())))
    }

    fn point(&mut self) -> Result<DVec3, Diagnostic> {
        Ok(DVec3::new(self.number()?, self.number()?, self.number()?))
    }

    /// The velocity after `word`.
    fn velocity(&mut self, word: Word<'t>) -> Result<Velocity, Diagnostic> {
        let vector = self.point()?;
        let behind = self.rest;
        let gamma = if self.next().is_some_and(|word| word.as_str() == GAMMA) {
            Some(self.number()?)
        } else {
            self.rest = behind;
            None
        };
        Velocity::from_stated(vector, gamma).map_err(|error| {
            Diagnostic::error(word.span, error.to_string())
                .label("here")
                .help("give three numbers whose length is below 1")
        })
    }

    fn mixtures(&mut self) -> Result<MixtureNames, Diagnostic> {
        let example = "mix#";
        let Some(word) = self.next() else { return Err(self.missing("the prefix of mixtures", example)) };
        MixtureNames::from_prefix(word.as_str()).ok_or_else(|| unknown(word, &[example]))
    }

    /// The error for a missing word at the current position.
    fn missing(&mut self, what: &str, example: &str) -> Diagnostic {
        self.skip_blanks();
        let start = self.position();
        Diagnostic::error(Span { start, end: start + 1 }, format!("{what} is missing"))
            .label("expected before this")
            .help(format!("add `{example}`"))
    }
}

/// Writes the statement, parentheses included, without parts at rest and default values.
pub(crate) fn write(stage: &Stage, out: &mut Vec<u8>, numbers: &mut zmij::Buffer) {
    out.extend_from_slice(format!("({KEYWORD} {VERSION}").as_bytes());
    let mut add = |word: &str, values: &[f64]| {
        out.push(b' ');
        out.extend_from_slice(word.as_bytes());
        for &value in values {
            out.push(b' ');
            push_number(out, numbers, value);
        }
    };
    if let Some(seen) = stage.seen_geometry() {
        add(GEOMETRY, &[]);
        add(AS_SEEN, &[]);
        add(EYE, &seen.eye.to_array());
        if seen.time != 0.0 {
            add(TIME, &[seen.time]);
        }
        if !seen.camera_velocity.is_zero() {
            let (vector, gamma) = seen.camera_velocity.stated();
            add(CAMERA_VELOCITY, &vector.to_array());
            gamma.into_iter().for_each(|gamma| add(GAMMA, &[gamma]));
        }
        if !seen.contraction {
            add(NO_CONTRACTION, &[]);
        }
        if !seen.flight_time {
            add(NO_FLIGHT_TIME, &[]);
        }
    }
    if let ColorStage::AsSeen(seen) | ColorStage::Deferred(seen) = &stage.colors {
        add(COLORS, &[]);
        add(if stage.deferred_colors().is_some() { DEFERRED } else { AS_SEEN }, &[]);
        match seen.scale {
            ColorScale::Hues { unit, law } => {
                add(if unit == HueScale::Degrees { HUES } else { WAVELENGTHS }, &[]);
                add(LAW, &[]);
                add(law.name(), &[]);
            }
            ColorScale::Spectra { flux, infrared } => {
                add(SPECTRA, &[]);
                if !flux {
                    add(NO_FLUX, &[]);
                }
                if infrared == InfraredRule::Constant {
                    add(CONSTANT_INFRARED, &[]);
                }
            }
        }
        if !seen.doppler {
            add(NO_DOPPLER, &[]);
        }
        if seen.lights {
            add(LIGHTS, &[]);
        }
    }
    if let Some(mixtures) = stage.mixtures {
        add(MIXTURES, &[]);
        add(&mixtures.prefix(), &[]);
    }
    out.push(b')');
}
