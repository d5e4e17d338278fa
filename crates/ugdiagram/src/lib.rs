//! Spacetime diagrams of UniGrafix scenes: what makes the picture that the other programs draw.
//!
//! A picture shows each body where it was when its light left. A diagram shows the world lines of
//! all bodies, the past light cone of the eye, and on it the events at which the light of the
//! picture left: the same events, from the same functions. With lines of simultaneity and axes of
//! other frames it answers what a picture cannot: what happens at the same time, and for whom.
//!
//! - [`Spacetime`] has the world lines and events of a scene, in all of space and time.
//! - [`Diagram`] has lines, marks and bands in the coordinates of one frame, along one direction.
//! - [`render`] draws it: as pixels, or as lines and letters in PDF, SVG and PostScript.
//! - [`table`] lists its events and intervals in several frames.
//!
//! # Modules
//!
//! Each line imports only from the lines above it:
//!
//! ```text
//! words  interval  place  frame  error      names of events and frames; coordinates; errors
//! config  window  world_line                options; what is seen of time and space; curves
//! spacetime                                 from a scene to world lines
//! diagram                                   lines and marks
//! labels  drawing  table  note              from a diagram to letters
//! render                                    from a scene to a file
//! cli                                       the command line
//! ```
//!
//! # Example
//!
//! A traveller at 0.8c is 5 units of time away and ages 3:
//!
//! ```
//! use ugdiagram::{Config, DiagramOptions, render};
//!
//! let text = "motion home; motion away -vel .8 0 0; cam -ep 0 0 0;";
//! let scene = ugparse::parse(&ugparse::Source::new("twins.ug", text), &Default::default())?.scene;
//! let diagram = DiagramOptions {
//!     intervals: vec![["away@0".parse()?, "away@3".parse()?]],
//!     ..DiagramOptions::default()
//! };
//! let rendered = render(scene, &Config { diagram, ..Config::default() })?;
//! let measured = &rendered.diagram.intervals[0];
//! assert!((measured.interval.length() - 3.0).abs() < 1e-14);
//! // Δt in the frame of the scene.
//! let passed = rendered.diagram.frames[0].components(measured.difference).t;
//! assert!((passed - 5.0).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(feature = "cli")]
mod cli;
mod config;
mod diagram;
mod drawing;
mod error;
mod frame;
mod interval;
mod labels;
mod note;
mod place;
mod render;
mod spacetime;
mod table;
mod window;
mod words;
mod world_line;

#[cfg(feature = "cli")]
pub use cli::{Args, draw};
pub use config::{Config, DiagramOptions, PointChoice, TickChoice};
pub use diagram::{
    AxisSource, BodyBand, CurveRole, Diagram, DiagramCurve, DiagramMark, MarkRole, MeasuredInterval,
};
pub use drawing::DrawnDiagram;
pub use error::Error;
pub use frame::ReferenceFrame;
pub use interval::{Interval, IntervalKind};
pub use labels::{Obstacles, Placed, Rectangle, Wanted, crosses, overlap, place};
pub use note::Note;
pub use place::DiagramPlace;
pub use render::{DiagramFile, PROVENANCE, RenderedDiagram, render, run};
pub use spacetime::{EmittedLight, FlashSource, Ink, Spacetime, SpacetimeLine};
pub use table::table;
pub use window::{DiagramWindow, round_step};
pub use words::{EventWord, FrameOwner, FrameWord, NamedEvent};
