//! Annotations drawn over pixels, or added to a vector figure.

use ugimage::figure::{Element, Figure};
use ugimage::label::{Drawing, TextForm};
use ugimage::{Frame, LinearFrame, Quantizer};

use crate::image::Image;
use crate::note::Note;
use crate::rendering::{Content, VectorFigure};

/// Annotations over and below the picture of a scene, ready to be composited.
pub struct Annotations {
    /// Pixels of the whole picture.
    pub size: [u32; 2],
    /// Rows of the scene, which is at the top.
    pub scene_rows: u32,
    /// Background of the strips below, as light developed for a display; `None` if transparent.
    pub background: Option<[f32; 3]>,
    /// Drawn over the scene.
    pub over: Drawing,
    /// Drawn on the strips.
    pub strips: Drawing,
    /// The form of their text in vector figures.
    pub text: TextForm,
    /// Notes for the user.
    pub notes: Vec<Note>,
}

impl Annotations {
    /// Adds the annotations to the picture of the scene, pixels or areas.
    pub fn add_to(&self, content: Content) -> Content {
        match content {
            Content::Image(image) => Content::Image(self.composite(image)),
            Content::Figure(VectorFigure::Gradients(figure)) => {
                Content::Figure(VectorFigure::Gradients(self.complete(figure)))
            }
            Content::Figure(VectorFigure::Triangles(figure, format)) => {
                Content::Figure(VectorFigure::Triangles(self.complete(figure), format))
            }
        }
    }

    /// Composites the annotations with the picture of the scene. All other pixels keep their bits.
    fn composite(&self, image: Image) -> Image {
        match image {
            Image::Display(mut frame) => {
                self.over.paint(&mut frame);
                if self.has_strips() {
                    let quantizer = Quantizer::new();
                    let below = self.background.map_or([0; 4], |light| {
                        let [red, green, blue] = light.map(|part| quantizer.level(part));
                        [red, green, blue, 255]
                    });
                    frame = Frame::new(self.size, frame.is_opaque(), self.taller(frame.pixels(), below));
                }
                self.strips.paint(&mut frame);
                Image::Display(frame)
            }
            Image::Light(mut frame) => {
                self.over.paint_light(&mut frame);
                if self.has_strips() {
                    let below =
                        self.background.map_or([0.0; 4], |[red, green, blue]| [red, green, blue, 0.0]);
                    frame =
                        LinearFrame::new(self.size, frame.is_opaque(), self.taller(frame.pixels(), below));
                }
                self.strips.paint_light(&mut frame);
                Image::Light(frame)
            }
        }
    }

    fn has_strips(&self) -> bool {
        self.scene_rows < self.size[1]
    }

    /// The pixels of the scene with strips below them.
    fn taller<P: Copy>(&self, scene: &[P], below: P) -> Vec<P> {
        let mut pixels = scene.to_vec();
        pixels.resize(self.size[0] as usize * self.size[1] as usize, below);
        pixels
    }

    /// Adds the annotations to the vector figure of a scene.
    fn complete<S>(&self, mut figure: Figure<S>) -> Figure<S> {
        figure.size = self.size;
        figure.elements.extend(self.over.elements(self.text));
        if self.has_strips() {
            // Faces and lines may extend beyond the picture of the scene.
            figure.elements.insert(0, Element::ClipRows(Some(self.scene_rows)));
            figure.elements.push(Element::ClipRows(None));
        }
        figure.elements.extend(self.strips.elements(self.text));
        figure
    }
}
