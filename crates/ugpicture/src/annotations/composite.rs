//! Annotations drawn over pixels, or added to a vector figure.

use ugimage::figure::{Element, Figure, Pane};
use ugimage::label::{Drawing, TextForm};
use ugimage::{Frame, LinearFrame, Quantizer};

use crate::image::Image;
use crate::note::Note;
use crate::rendering::{Content, VectorFigure};

/// Annotations over and beside the picture of a scene, ready to be composited.
pub struct Annotations {
    /// Pixels of the whole picture.
    pub size: [u32; 2],
    /// The part of it with the scene.
    pub scene: Pane,
    /// Background of the strips around the scene, as light developed for a display; `None` if
    /// transparent.
    pub background: Option<[f32; 3]>,
    /// Drawn over the scene, from its upper left corner.
    pub over: Drawing,
    /// Drawn on the whole picture.
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
                    let strip = self.background.map_or([0; 4], |light| {
                        let [red, green, blue] = light.map(|part| quantizer.level(part));
                        [red, green, blue, 255]
                    });
                    frame = Frame::new(
                        self.size,
                        frame.is_opaque(),
                        self.larger(frame.pixels(), strip),
                    );
                }
                self.strips.paint(&mut frame);
                Image::Display(frame)
            }
            Image::Light(mut frame) => {
                self.over.paint_light(&mut frame);
                if self.has_strips() {
                    let strip = self
                        .background
                        .map_or([0.0; 4], |[red, green, blue]| [red, green, blue, 0.0]);
                    frame = LinearFrame::new(
                        self.size,
                        frame.is_opaque(),
                        self.larger(frame.pixels(), strip),
                    );
                }
                self.strips.paint_light(&mut frame);
                Image::Light(frame)
            }
        }
    }

    fn has_strips(&self) -> bool {
        self.scene.size != self.size
    }

    /// The pixels of the scene with strips around them.
    fn larger<P: Copy>(&self, scene: &[P], strip: P) -> Vec<P> {
        let [width, height] = self.size.map(|side| side as usize);
        let [left, top] = self.scene.corner.map(|side| side as usize);
        let columns = self.scene.size[0] as usize;
        let mut pixels = vec![strip; width * height];
        let rows = pixels.chunks_exact_mut(width).skip(top);
        for (row, seen) in rows.zip(scene.chunks_exact(columns)) {
            row[left..left + columns].copy_from_slice(seen);
        }
        pixels
    }

    /// Adds the annotations to the vector figure of a scene.
    fn complete<S>(&self, mut figure: Figure<S>) -> Figure<S> {
        figure.size = self.size;
        figure.elements.extend(self.over.elements(self.text));
        if self.has_strips() {
            // Faces and lines may extend beyond the picture of the scene.
            figure.elements.insert(0, Element::Pane(Some(self.scene)));
            figure.elements.push(Element::Pane(None));
        }
        figure.elements.extend(self.strips.elements(self.text));
        figure
    }
}
