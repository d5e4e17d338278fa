//! The programs in a browser: files and the words of commands in, pictures out.
//!
//! The page `web/page.html` composes the commands that a shell would run, and shows them. A
//! [`Studio`] parses their words with the programs' own definitions of options and calls the
//! programs' own functions in memory. So every option works, messages are those of the programs,
//! and a picture has the bytes of the file that the commands write.
//!
//! ```
//! let mut studio = ugweb::Studio::new();
//! studio.add("triangle.ug".into(), b"v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c); cam -ep 0 0 5;".into());
//! let commands = r#"[["uglorentz", "-vel", ".5", "0", "0", "-in", "triangle.ug"],
//!                    ["ugdoppler"],
//!                    ["ugrainbow", "-sz", "40", "30", "-fo", "seen.png"]]"#;
//! assert!(studio.file(commands)?.starts_with(b"\x89PNG"));
//! assert_eq!(
//!     Studio::line(commands)?,
//!     "uglorentz -vel .5 0 0 -in triangle.ug | ugdoppler | ugrainbow -sz 40 30 -fo seen.png"
//! );
//! # use ugweb::Studio;
//! # Ok::<(), String>(())
//! ```

mod commands;
mod flight;
mod python;
mod subject;

use qrcodegen::{QrCode, QrCodeEcc};
use ugfilm::Pipe;
use ugpicture::Rendering;
use ugpipe::{Failure, Input, Words, shell_pipe};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::commands::Commands;
pub use crate::flight::Flight;
use crate::subject::Subject;

/// Files, of which the one that was drawn last is kept as it was read.
#[wasm_bindgen]
#[derive(Default)]
pub struct Studio {
    files: Vec<Input>,
    subject: Option<Subject>,
}

/// A picture for a display.
#[wasm_bindgen]
pub struct Shown {
    size: [u32; 2],
    pixels: Vec<u8>,
    notes: String,
}

/// A failure as the program prints it.
fn printed(program: &str, failure: &Failure) -> String {
    match failure {
        Failure::Report(text) => format!("{program}: {text}"),
        failure => format!("{program}: error: {failure}"),
    }
}

#[wasm_bindgen]
impl Studio {
    /// A studio without files.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file, by the name that commands and other files have for it, or replaces it.
    pub fn add(&mut self, name: String, bytes: Vec<u8>) {
        let n_others = self.files.len();
        self.files.retain(|file| file.name != name);
        if self.files.len() < n_others {
            // It may have been read.
            self.subject = None;
        }
        self.files.push(Input { name, text: bytes });
    }

    /// Draws the picture of a pipe. `commands`: JSON, a list of words for each program.
    ///
    /// # Errors
    /// What the program that fails prints.
    pub fn draw(&mut self, commands: &str) -> Result<Shown, String> {
        let (picture, notes) = self.rendering(commands)?;
        let frame = picture.into_frame().ok_or("vector graphics have no pixels")?;
        let size = [frame.width(), frame.height()];
        Ok(Shown { size, pixels: frame.pixels().as_flattened().to_vec(), notes: notes.join("\n") })
    }

    /// The bytes of the file that a pipe writes.
    ///
    /// # Errors
    /// See [`Studio::draw`].
    pub fn file(&mut self, commands: &str) -> Result<Vec<u8>, String> {
        Ok(self.rendering(commands)?.0.into_file())
    }

    /// What is known of the input of a pipe, as JSON: its `kind` (`scene` or `sky`), and of a scene
    /// its `eye`, `center`, `up` and view `angle` in degrees, the `times` between which moving
    /// bodies are in view, and the `start` of a flight from its camera (see [`Flight::new`]).
    ///
    /// # Errors
    /// See [`Studio::draw`].
    pub fn describe(&mut self, commands: &str) -> Result<String, String> {
        let commands = Commands::parse(commands)?;
        let pipe = commands.pipe();
        Ok(self.subject(&commands)?.describe(&pipe).to_string())
    }

    /// True if a program that draws has this option, with or without dashes.
    pub fn has(program: &str, option: &str) -> bool {
        let name = option.trim_start_matches('-');
        let mut options = ugfilm::TOOLS
            .iter()
            .filter(|tool| tool.name() == program)
            .flat_map(|tool| tool.options());
        options.any(|arg| {
            let others = arg.get_all_aliases().unwrap_or_default();
            arg.get_long() == Some(name) || others.contains(&name)
        })
    }

    /// The pipe as a line for a shell.
    ///
    /// # Errors
    /// `commands` is not a list of lists of words.
    pub fn line(commands: &str) -> Result<String, String> {
        Ok(shell_pipe(&commands::words(commands)?, None))
    }

    /// The pipe in Python, with the package `uglorentz`.
    ///
    /// # Errors
    /// The words of a command are wrong.
    pub fn python(commands: &str) -> Result<String, String> {
        Ok(Commands::parse(commands)?.python())
    }
}

/// The QR code of a text: rows of dark (1) and light (0) modules, without the quiet zone around
/// it; empty if the text is too long for one.
#[wasm_bindgen]
pub fn qr_code(text: &str) -> Vec<u8> {
    let Ok(code) = QrCode::encode_text(text, QrCodeEcc::Medium) else { return Vec::new() };
    let size = code.size();
    (0..size * size).map(|row| u8::from(code.get_module(row % size, row / size))).collect()
}

impl Studio {
    fn rendering(&mut self, commands: &str) -> Result<(Rendering, Vec<String>), String> {
        let commands = Commands::parse(commands)?;
        let mut pipe: Pipe = commands.pipe();
        let subject = self.subject(&commands)?;
        if let Some(sky) = pipe.sky() {
            subject.give_light(sky);
        }
        let drawn = pipe.draw(subject.film_subject());
        let (picture, notes) = drawn.map_err(|error| format!("error: {}", error.words()))?;
        let mut words = subject.notes(&pipe);
        words.extend(notes.iter().flat_map(ugfilm::Note::words));
        Ok((picture, words))
    }

    /// The input of a pipe, which is read once.
    fn subject(&mut self, commands: &Commands) -> Result<&Subject, String> {
        if self.subject.as_ref().is_none_or(|subject| subject.key != commands.key()) {
            self.subject = None;
            let files = std::mem::take(&mut self.files);
            let (opened, files) = Subject::open(commands, files);
            self.files = files;
            self.subject = Some(opened.map_err(|failure| printed(commands.program(), &failure))?);
        }
        self.subject.as_ref().ok_or_else(|| "there is no input".to_owned())
    }
}

#[wasm_bindgen]
impl Shown {
    /// Pixels across.
    #[wasm_bindgen(getter)]
    pub fn width(&self) -> u32 {
        self.size[0]
    }

    /// Pixels down.
    #[wasm_bindgen(getter)]
    pub fn height(&self) -> u32 {
        self.size[1]
    }

    /// Red, green, blue and alpha of each pixel, sRGB.
    #[wasm_bindgen(getter)]
    pub fn pixels(&self) -> Vec<u8> {
        self.pixels.clone()
    }

    /// What the programs note, a line each.
    #[wasm_bindgen(getter)]
    pub fn notes(&self) -> String {
        self.notes.clone()
    }
}
