//! Drawings put on pixels, or into a figure of areas.

use ugimage::figure::{Element, Figure, Rgb};
use ugimage::{Frame, LinearFrame, Quantizer};
use uglabel::Drawing;

use crate::canvas::Drawn;

/// What is drawn over the picture of a scene and below it.
pub struct Annotations {
    /// Of the whole.
    pub size: [u32; 2],
    /// Rows of the scene, from the top.
    pub scene_rows: u32,
    /// Of the strips below, as light developed for a display; none if it is clear.
    pub ground: Option<[f32; 3]>,
    /// Over the picture.
    pub over: Drawing,
    /// On the strips.
    pub strips: Drawing,
    /// What the user should know.
    pub notes: Vec<String>,
}

impl Annotations {
    /// The whole picture. Where nothing is drawn, that of the scene keeps its pixels.
    pub fn on(&self, drawn: Drawn) -> Drawn {
        match drawn {
            Drawn::Display(mut frame) => {
                self.over.paint(&mut frame);
                let mut frame = self.taller(frame);
                self.strips.paint(&mut frame);
                Drawn::Display(frame)
            }
            Drawn::Light(mut frame) => {
                self.over.paint_light(&mut frame);
                let mut frame = self.taller_light(frame);
                self.strips.paint_light(&mut frame);
                Drawn::Light(frame)
            }
        }
    }

    fn has_strips(&self) -> bool {
        self.scene_rows < self.size[1]
    }

    fn taller(&self, scene: Frame) -> Frame {
        if !self.has_strips() {
            return scene;
        }
        let empty = if scene.is_opaque() { Frame::opaque } else { Frame::clear };
        let mut frame = empty(self.size[0], self.size[1]);
        let (above, below) = frame.pixels_mut().split_at_mut(scene.pixels().len());
        above.copy_from_slice(scene.pixels());
        if let Some([red, green, blue]) = self.ground_color() {
            below.fill([red, green, blue, 255]);
        }
        frame
    }

    fn taller_light(&self, scene: LinearFrame) -> LinearFrame {
        if !self.has_strips() {
            return scene;
        }
        let ground = self.ground.map_or([0.0; 4], |[red, green, blue]| [red, green, blue, 0.0]);
        let mut pixels = scene.pixels().to_vec();
        pixels.resize(self.size[0] as usize * self.size[1] as usize, ground);
        LinearFrame::new(self.size, scene.is_opaque(), pixels)
    }

    /// Completes the figure of a scene.
    pub fn complete<S>(&self, figure: &mut Figure<S>) {
        figure.size = self.size;
        figure.elements.extend(self.over.elements());
        if self.has_strips() {
            // Faces reach out of the picture of the scene, and lines stand out of it.
            figure.elements.insert(0, Element::CutBelow(Some(self.scene_rows)));
            figure.elements.push(Element::CutBelow(None));
        }
        figure.elements.extend(self.strips.elements());
    }

    fn ground_color(&self) -> Option<Rgb> {
        let quantizer = Quantizer::new();
        self.ground.map(|light| light.map(|part| quantizer.level(part)))
    }
}
