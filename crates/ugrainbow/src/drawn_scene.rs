//! The drawn parts of a scene.

use ugpicture::DrawnContent;
use ugraster::SampleStats;

use crate::setup::Setup;

/// A scene as drawn, before it is developed.
pub struct DrawnScene<'a> {
    /// The scene at the resolution at which visibility was decided.
    pub setup: Setup<'a>,
    /// Statistics of its samples.
    pub stats: SampleStats,
    /// Light, pixels or areas.
    pub content: DrawnContent,
}
