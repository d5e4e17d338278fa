//! The options of a sky behind a scene.

use std::path::PathBuf;

use clap::{ArgAction, Args};
use glam::DQuat;
use ugimage::PictureLimits;
use ugparse::{Diagnostic, Diagnostics, Source};
use ugpipe::{CommonArgs, Context, Failure, Input, Words, finite};
use ugsky::PanoramaError;

use crate::built_in::BuiltIn;
use crate::error::{OpenError, SkyError};
use crate::open::{Opened, open};
use crate::scene_sky::{SceneSky, SkySource, turn};
use crate::star_list::{StarList, is_star_list, read_stars};

/// A sky behind a scene: flatten it into the arguments of a renderer.
#[derive(Args, Clone, Debug)]
pub struct SkyArgs {
    /// Sky behind the scene: day, dusk, stars, or a file
    ///
    /// day, dusk: a clear sky with a sun; stars: those that the naked eye sees. A file is a picture
    /// twice as wide as high with all directions (PNG, JPEG, HDR, EXR or PFM); a cube map, six
    /// squares side by side or a cross; or stars (CSV). The sky is infinitely far away, at rest in
    /// the frame of the scene, with y in its middle, x to the right and z up.
    #[arg(long, value_name = "SKY", help_heading = SKY)]
    sky: Option<PathBuf>,

    /// Turn the sky by these angles about x, then y, then z, in degrees
    #[arg(long, num_args = 3, value_names = ["X", "Y", "Z"], action = ArgAction::Set, requires = "sky",
          allow_hyphen_values = true, value_parser = finite, help_heading = SKY)]
    sky_turn: Option<Vec<f64>>,
}

/// Heading of these options in `--help`.
const SKY: &str = "Sky";

impl SkyArgs {
    /// The sky that these arguments define, which has not been opened.
    pub fn sky(&self) -> SceneSky {
        let source = self.sky.clone().map_or(SkySource::None, SkySource::File);
        let turn = self.sky_turn.as_deref().map_or(DQuat::IDENTITY, turn);
        SceneSky { source, turn, ..SceneSky::default() }
    }

    /// As [`SkyArgs::sky`]; without one, a sky without a file.
    pub fn sky_or(&self, sky: BuiltIn) -> SceneSky {
        let found = self.sky();
        let source = SkySource::File(sky.name().into());
        if found.is_some() { found } else { SceneSky { source, ..found } }
    }
}

impl SceneSky {
    /// The sky of a scene, open: this one, or else the one that the scene states.
    ///
    /// # Errors
    /// As [`SceneSky::open`], at the statement of the scene if it names the file.
    pub fn open_with(
        &mut self,
        (source, options): (&Source, &ugparse::Options),
        common: &CommonArgs,
        context: &Context,
    ) -> Result<(), Failure> {
        let stated = ugparse::stated_sky(source, options);
        self.or_stated(stated.as_ref().map(|(sky, _)| sky));
        let span =
            stated.map(|(_, span)| span).filter(|_| matches!(self.source, SkySource::Stated(_)));
        self.open(common, context).map_err(|failure| match (failure, span) {
            (Failure::Failed(message), Some(span)) => {
                let finding = Diagnostic::error(span, message).label("named here");
                Failure::Report(Diagnostics::new(source, vec![finding]).report())
            }
            (failure, _) => failure,
        })
    }

    /// Opens its file, unless it is open ([`SceneSky::or_stated`] makes one without a file). One
    /// that a scene names has to be in its folder or below. `common`: for the limit of memory.
    ///
    /// # Errors
    /// A file that cannot be read, or is neither a panorama nor a list of stars.
    pub fn open(&mut self, common: &CommonArgs, context: &Context) -> Result<(), Failure> {
        let file = match &self.source {
            SkySource::File(path) => context.input_file(path)?,
            SkySource::Stated(path) => {
                let name = path.display().to_string();
                let failed = |error| Failure::Failed(format!("sky `{name}`: {error}"));
                Input { text: context.read_named(path, MOST_BYTES).map_err(failed)?, name }
            }
            SkySource::None | SkySource::Opened(_) => return Ok(()),
        };
        self.source = SkySource::Opened(opened(&file, common)?.into());
        Ok(())
    }
}

/// Most bytes of a file that a scene names.
const MOST_BYTES: u64 = 1 << 30;

fn opened(file: &Input, common: &CommonArgs) -> Result<Opened, Failure> {
    let Input { name, text } = file;
    if is_star_list(name, text) {
        let StarList { stars, notes } =
            read_stars(name, text).map_err(|found| Failure::Report(found.report()))?;
        return Ok(Opened { stars, notes, ..Opened::default() });
    }
    let mut limits = PictureLimits::default();
    limits.bytes = common.memory_limit().unwrap_or(limits.bytes);
    open(&[text], None, None, None, limits).map_err(|error| {
        let remedy = match &error {
            OpenError::Read { error, .. } => CommonArgs::memory_remedy(error.needed_memory()),
            OpenError::Panorama(PanoramaError::Shape { .. }) => {
                "; a sky is twice as wide as high, six squares in a row, or a cross of 4 : 3 or 3 : 4"
                    .to_owned()
            }
            OpenError::Panorama(_) => String::new(),
        };
        Failure::Failed(format!("sky `{name}`: {error}{remedy}"))
    })
}

impl Words for SkyError {
    fn words(&self) -> String {
        let remedy = match self {
            Self::Closed(_) | Self::Basis(_) => "",
            Self::Vectors => ": leave out -vec or -sky",
            Self::Orthographic => ": leave out -og (in the scene, too), or -sky",
            Self::Transparent => ": leave out -tb or -sky",
            Self::PartialGeometry => ": leave out -sky",
            Self::Explained => ": leave out -sky (in the scene, too)",
        };
        format!("{self}{remedy}")
    }

    fn is_usage(&self) -> bool {
        matches!(self, Self::Vectors | Self::Transparent | Self::Explained)
    }
}
