//! `include`, `execute` and `sky`

use ugscene::StatedSky;

use super::grammar::{Grammar, Outcome};
use super::options::{OptionTable, option};
use crate::request::RequestKind;
use crate::row_writer::{RowWriter, WriteRow};
use crate::statement::FileStatement;
use crate::token::FILE_NAME;

pub(super) static SKY: OptionTable<[f64; 3]> =
    OptionTable { rows: &[option("ra x y z", |turn| turn)], expected: "`-ra` or `;`" };

impl<'t> Grammar<'t, '_> {
    /// The text of a file, or the output of a program.
    pub fn text_of(&mut self, kind: RequestKind) -> Outcome<'t> {
        let file = self.file(FILE_NAME)?;
        let span = self.end()?;
        self.requests.push(FileStatement { span, ..file }.request(kind));
        Ok(())
    }

    pub fn sky(&mut self) -> Outcome<'t> {
        let file = self.file(FILE_NAME)?;
        let mut turn = [0.0; 3];
        SKY.read_one(&mut turn, self)?;
        let span = self.end()?;
        self.requests.push(file.request(RequestKind::Sky));
        self.scope.skies.push(StatedSky { file: file.name.lossy(self.text), turn }, span);
        Ok(())
    }
}

/// Writes `sky`.
impl WriteRow for StatedSky {
    fn write(&self, out: &mut RowWriter<'_>) {
        let is_plain =
            |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b'/' | b'_');
        let quote = if self.file.bytes().all(is_plain) { "" } else { "\"" };
        out.text(&format!("sky {quote}{}{quote}", self.file));
        SKY.write(&self.turn, out);
    }
}
