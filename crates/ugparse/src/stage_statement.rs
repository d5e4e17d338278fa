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
use crate::origin;
use crate::reader::Document;
use crate::row_writer::RowWriter;
use crate::source::Span;
use crate::suggest::nearest;
use crate::token::{Input, escape, found, is_blank, number};
use crate::wording::{shorten, word_help};

/// First word of the statement.
const KEYWORD: &str = "ugstage";

/// The version that is read and written.
const VERSION: &str = "1";

const GEOMETRY: &str = "geometry";
const COLORS: &str = "colors";
const MIXTURES: &str = "mixtures";

/// Is a text that is passed on a stage statement?
pub(crate) fn is_stage(escape: &[u8]) -> bool {
    let first = || Words::new(escape, Span { start: 0, end: escape.len() as u32 }).next();
    escape.starts_with(b"(") && first().is_some_and(|word| word.as_str() == KEYWORD)
}

/// True for the output of a program in the middle of a pipe, which recorded what it read: a text
/// with a history and a stage. A scene at rest may have a history as well, and somebody may have
/// changed it since.
pub fn comes_through_a_pipe(text: &[u8]) -> bool {
    let (has_history, rest) = origin::head(text);
    let Ok((after, _)) = escape(rest) else { return false };
    let end = rest.len() - after.len();
    let span = Span { start: 0, end: u32::try_from(end).unwrap_or(0) };
    has_history
        && is_stage(&rest[..end])
        && read(rest, span)
            .is_ok_and(|stage| stage != Stage { mixtures: stage.mixtures, ..Stage::default() })
}

/// Moves the stage statement of a document from its escapes to [`Document::stage`].
pub(crate) fn take(text: &[u8], document: &mut Document<'_>, findings: &mut Vec<Diagnostic>) {
    for row in 0..document.scopes.len() {
        let scope = &mut document.scopes[row];
        let spans = scope.passed_on.spans.iter().copied().enumerate();
        let statements: Vec<(usize, Span)> =
            spans.filter(|(_, span)| is_stage(span.of(text))).collect();
        scope.remove_escapes(&statements.iter().map(|(row, _)| *row).collect::<Vec<_>>());
        for (_, span) in statements {
            let keyword = keyword_span(text, span);
            if row > 0 {
                let help = "it applies to the whole scene: move it before the first statement";
                let message = "the stage of a scene cannot stand in a definition";
                findings.push(Diagnostic::here(keyword, message, help));
            } else if let Some((_, first)) = &document.stage {
                let places = [keyword, keyword_span(text, *first)];
                let help = "a scene has one stage: scenes of different stages cannot be joined";
                findings.push(Diagnostic::again(
                    places,
                    "the stage of the scene is stated twice",
                    help,
                ));
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

fn keyword_span(text: &[u8], span: Span) -> Span {
    Words::new(text, span).next().map_or(span, |word| word.span)
}

/// Parses the statement at `span`, parentheses included.
fn read(text: &[u8], span: Span) -> Result<Stage, Diagnostic> {
    let mut words = Words::new(text, span);
    words.next();
    words.choice(&[VERSION])?;
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
    if words.choice(&["at-rest", "as-seen"])? == "at-rest" {
        return Ok(GeometryStage::AtRest);
    }
    let mut eye = None;
    let mut seen = SeenGeometry {
        eye: DVec3::ZERO,
        time: 0.0,
        camera_velocity: Velocity::ZERO,
        contraction: true,
        flight_time: true,
        is_whole: false,
    };
    const OPTIONS: [&str; 8] = [
        "eye",
        "time",
        "camera-velocity",
        "no-contraction",
        "no-flight-time",
        "whole",
        COLORS,
        MIXTURES,
    ];
    while let Some(word) = words.next_of_part()? {
        match word.as_str() {
            "eye" => eye = Some(words.point()?),
            "time" => seen.time = words.number()?,
            "camera-velocity" => seen.camera_velocity = words.velocity(word)?,
            "no-contraction" => seen.contraction = false,
            "no-flight-time" => seen.flight_time = false,
            "whole" => seen.is_whole = true,
            _ => return Err(unknown(word, &OPTIONS)),
        }
    }
    seen.eye =
        eye.ok_or_else(|| words.missing("the eye point of a geometry as seen", "eye X Y Z"))?;
    Ok(GeometryStage::AsSeen(seen))
}

fn colors(words: &mut Words<'_>) -> Result<ColorStage, Diagnostic> {
    let stage = words.choice(&["at-rest", "as-seen", "deferred"])?;
    if stage == "at-rest" {
        return Ok(ColorStage::AtRest);
    }
    let scales = ["hues", "wavelengths", "spectra"];
    let scale = words.choice(&scales)?;
    let is_spectral = scale == "spectra";
    let (mut law, mut flux, mut infrared) = (None, true, InfraredRule::Measured);
    let spectra = |flux, infrared| ColorScale::Spectra { flux, infrared };
    let mut seen = SeenColors { scale: spectra(flux, infrared), doppler: true, lights: false };
    while let Some(word) = words.next_of_part()? {
        match word.as_str() {
            "law" if !is_spectral => {
                let name = words.choice(&Brightness::ALL.map(Brightness::name))?;
                law = Brightness::from_name(name);
            }
            "no-flux" if is_spectral => flux = false,
            "constant-infrared" if is_spectral => infrared = InfraredRule::Constant,
            "no-doppler" => seen.doppler = false,
            "lights" => seen.lights = true,
            _ => {
                let own = if is_spectral { "no-flux" } else { "law" };
                return Err(unknown(word, &[own, "no-doppler", "lights", GEOMETRY]));
            }
        }
    }
    seen.scale = if is_spectral {
        spectra(flux, infrared)
    } else {
        let unit = if scale == "wavelengths" { HueScale::Wavelengths } else { HueScale::Degrees };
        let law =
            law.ok_or_else(|| words.missing("the brightness law of hues as seen", "law report"))?;
        ColorScale::Hues { unit, law }
    };
    Ok(if stage == "deferred" { ColorStage::Deferred(seen) } else { ColorStage::AsSeen(seen) })
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

    /// The next word, if it belongs to the current part. It must not be repeated.
    fn next_of_part(&mut self) -> Result<Option<Word<'t>>, Diagnostic> {
        let before = self.rest;
        let word = self.next();
        if word.is_some_and(|word| [GEOMETRY, COLORS, MIXTURES].contains(&word.as_str())) {
            self.rest = before;
            return Ok(None);
        }
        word.map(|word| self.once(word)).transpose()
    }

    /// Refuses a repeated key word.
    fn once(&mut self, word: Word<'t>) -> Result<Word<'t>, Diagnostic> {
        if let Some(first) = self.known.iter().find(|known| known.text == word.text) {
            let message = format!("`{}` is given twice", word.as_str());
            return Err(Diagnostic::again([word.span, first.span], message, "remove one of them"));
        }
        self.known.push(word);
        Ok(word)
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
        let finding =
            Diagnostic::error(word.span, format!("`{}` is not a number", shorten(word.text)))
                .label("expected a number");
        Err(finding.help(
            word_help("a number", word.text).unwrap_or_else(|| "give a finite number".to_string()),
        ))
    }

    fn point(&mut self) -> Result<DVec3, Diagnostic> {
        Ok(DVec3::new(self.number()?, self.number()?, self.number()?))
    }

    /// The velocity after `word`.
    fn velocity(&mut self, word: Word<'t>) -> Result<Velocity, Diagnostic> {
        let vector = self.point()?;
        let behind = self.rest;
        let gamma = if self.next().is_some_and(|word| word.as_str() == "gamma") {
            Some(self.number()?)
        } else {
            self.rest = behind;
            None
        };
        Velocity::from_stated(vector, gamma).map_err(|error| {
            let help = "give three numbers whose length is below 1";
            Diagnostic::here(word.span, error.to_string(), help)
        })
    }

    fn mixtures(&mut self) -> Result<MixtureNames, Diagnostic> {
        let example = "mix#";
        let Some(word) = self.next() else {
            return Err(self.missing("the prefix of mixtures", example));
        };
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
pub(crate) fn write(stage: &Stage, out: &mut RowWriter<'_>) {
    out.text(&format!("({KEYWORD} {VERSION}"));
    let mut add = |is_stated: bool, words: &str, values: &[f64]| {
        if is_stated {
            out.text(" ");
            out.text(words);
            out.numbers(values);
        }
    };
    if let Some(seen) = stage.seen_geometry() {
        add(true, "geometry as-seen eye", &seen.eye.to_array());
        add(seen.time != 0.0, "time", &[seen.time]);
        if !seen.camera_velocity.is_zero() {
            let (vector, gamma) = seen.camera_velocity.stated();
            add(true, "camera-velocity", &vector.to_array());
            add(gamma.is_some(), "gamma", gamma.as_slice());
        }
        add(!seen.contraction, "no-contraction", &[]);
        add(!seen.flight_time, "no-flight-time", &[]);
        add(seen.is_whole, "whole", &[]);
    }
    if let ColorStage::AsSeen(seen) | ColorStage::Deferred(seen) = &stage.colors {
        let is_deferred = stage.deferred_colors().is_some();
        add(true, if is_deferred { "colors deferred" } else { "colors as-seen" }, &[]);
        match seen.scale {
            ColorScale::Hues { unit, law } => {
                let unit = if unit == HueScale::Degrees { "hues" } else { "wavelengths" };
                add(true, &format!("{unit} law {}", law.name()), &[]);
            }
            ColorScale::Spectra { flux, infrared } => {
                add(true, "spectra", &[]);
                add(!flux, "no-flux", &[]);
                add(infrared == InfraredRule::Constant, "constant-infrared", &[]);
            }
        }
        add(!seen.doppler, "no-doppler", &[]);
        add(seen.lights, "lights", &[]);
    }
    if let Some(mixtures) = stage.mixtures {
        add(true, &format!("{MIXTURES} {}", mixtures.prefix()), &[]);
    }
    out.text(")");
}
