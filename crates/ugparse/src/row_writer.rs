//! Writes one row of a scene: words, names and numbers, with a blank before each.

use glam::DVec3;
use ugphysics::Velocity;
use ugscene::{BodyId, ColorId, NameId, Scene};

use crate::number_text::{push_number, push_number32};

/// Rows that are written, and what rows one after the other share.
pub(crate) struct RowWriter<'s> {
    pub scene: &'s Scene,
    pub out: Vec<u8>,
    pub digits: zmij::Buffer,
    /// The row that is written.
    pub row: u32,
    /// The body of the last row, and the text of its motion, because consecutive rows mostly share
    /// one.
    pub body: Option<BodyId>,
    pub motion_text: Vec<u8>,
}

impl<'s> RowWriter<'s> {
    pub fn new(scene: &'s Scene, out: Vec<u8>) -> Self {
        let digits = zmij::Buffer::new();
        Self { scene, out, digits, row: 0, body: None, motion_text: Vec::new() }
    }

    pub fn text(&mut self, text: &str) {
        self.out.extend_from_slice(text.as_bytes());
    }

    pub fn name(&mut self, name: NameId) {
        self.out.push(b' ');
        self.out.extend_from_slice(self.scene.names.bytes(name));
    }

    pub fn color(&mut self, color: ColorId) {
        self.name(self.scene.colors[color.index()].name);
    }

    pub fn optional_color(&mut self, color: Option<ColorId>) {
        color.into_iter().for_each(|color| self.color(color));
    }

    /// Writes the keyword of a statement and its name, if it has one.
    pub fn begin(&mut self, keyword: &str, name: impl Into<Option<NameId>>) {
        self.text(keyword);
        name.into().into_iter().for_each(|name| self.name(name));
    }

    /// Writes the keyword of a statement about a colour, and that colour.
    pub fn begin_color(&mut self, keyword: &str, color: ColorId) {
        self.text(keyword);
        self.color(color);
    }

    /// Writes a number without a blank before it.
    pub fn digits(&mut self, value: f64) {
        push_number(&mut self.out, &mut self.digits, value);
    }

    pub fn number(&mut self, value: f64) {
        self.out.push(b' ');
        self.digits(value);
    }

    /// The same of 32 bits.
    pub fn digits32(&mut self, value: f32) {
        push_number32(&mut self.out, &mut self.digits, value);
    }

    pub fn number32(&mut self, value: f32) {
        self.out.push(b' ');
        self.digits32(value);
    }

    pub fn point(&mut self, p: DVec3) {
        self.numbers(&p.to_array());
    }

    pub fn numbers(&mut self, values: &[f64]) {
        values.iter().for_each(|&value| self.number(value));
    }

    /// Writes an option and its numbers.
    pub fn option(&mut self, word: &str, numbers: &[f64]) {
        self.text(" -");
        self.text(word);
        self.numbers(numbers);
    }

    /// Writes the file of a statement, in quotes.
    pub fn quoted(&mut self, text: &str) {
        self.text(" \"");
        self.text(text);
        self.text("\"");
    }

    /// Writes `x y z`, or `x y z -gamma γ`, after `mark`.
    pub fn velocity(&mut self, mark: &str, velocity: Velocity) {
        let (vector, gamma) = velocity.stated();
        self.text(mark);
        self.digits(vector.x);
        self.numbers(&[vector.y, vector.z]);
        if let Some(gamma) = gamma {
            self.text(" -gamma");
            self.number(gamma);
        }
    }

    /// Writes ` <NAME>`.
    pub fn motion_name(&mut self, body: BodyId) {
        self.text(" <");
        let name = self.scene.bodies[body].name;
        self.text(name.map_or("", |name| self.scene.names.get(name)));
        self.text(">");
    }
}

/// A row that has a statement.
pub(crate) trait WriteRow {
    /// Writes the statement without its `;`.
    fn write(&self, out: &mut RowWriter<'_>);
}
