//! A fast parser for the two most frequent statements: vertices and faces in their simple forms.
//!
//! All other input, such as a comment between two words, a normal or an error, is left to the
//! [grammar](crate::statements), which parses the statement from its beginning and reports errors.

use glam::DVec3;
use ugscene::{BodyId, ColorId, Face, Vertex, VertexId};

use crate::numbered::Name;
use crate::scope::Scope;
use crate::source::Span;
use crate::token::{
    begins_identifier, ends_word, is_blank, is_identifier, number, number32, short_decimal,
};

/// Parses `v ID x y z [color] [(u v)] ;` or `f [ID] contours [color] [< x y z >] ;` at `start` and
/// returns the position after it; `None` for everything else.
#[inline]
pub(crate) fn statement<'t>(text: &'t [u8], start: usize, scope: &mut Scope<'t>) -> Option<usize> {
    let cursor = Cursor { text, at: start + 1 };
    match text.get(start)? {
        b'v' if is_blank(*text.get(start + 1)?) => vertex(cursor, scope),
        b'f' if is_blank(*text.get(start + 1)?) => face(cursor, start, scope),
        _ => None,
    }
}

fn vertex<'t>(mut cursor: Cursor<'t>, scope: &mut Scope<'t>) -> Option<usize> {
    cursor.skip_blank();
    let name = cursor.name()?;
    let span = Span { start: (cursor.at - name.text.len()) as u32, end: cursor.at as u32 };
    let position = cursor.point()?;
    cursor.skip_blank();
    let color = cursor.identifier();
    cursor.skip_blank();
    let uv = if cursor.next_is(b'(') { Some(cursor.uv()?) } else { None };
    cursor.mark(b';')?;
    let color = color.map(|color| ColorId::from_index(scope.colors.names.enter(color)));
    scope.n_statements += 1;
    scope.push_vertex(name, span, Vertex { uv, ..Vertex::at(position, color) });
    Some(cursor.at)
}

fn face<'t>(mut cursor: Cursor<'t>, start: usize, scope: &mut Scope<'t>) -> Option<usize> {
    cursor.skip_blank();
    let name = cursor.identifier();
    let first = scope.contours.len();
    let Some((color, body)) = contours(&mut cursor, scope).and_then(|()| tail(&mut cursor, scope))
    else {
        scope.contours.truncate(first);
        return None;
    };
    let name = name.map(|name| scope.add_name(name));
    let contours = first as u32..scope.contours.row_count();
    let face = Face { name, color, ..Face::polygon(contours, body) };
    scope.n_statements += 1;
    scope.faces.push(face, Span { start: start as u32, end: cursor.at as u32 });
    Some(cursor.at)
}

/// One or more `( ID … )`.
#[inline(always)]
fn contours<'t>(cursor: &mut Cursor<'t>, scope: &mut Scope<'t>) -> Option<()> {
    cursor.mark(b'(')?;
    loop {
        cursor.skip_blank();
        // A contour has at least one corner.
        loop {
            let name = cursor.name()?;
            scope.contours.push_corner(VertexId(scope.vertex_names.enter(name)));
            cursor.skip_blank();
            if cursor.next_is(b')') {
                break;
            }
        }
        cursor.at += 1;
        scope.contours.end_contour();
        cursor.skip_blank();
        if !cursor.next_is(b'(') {
            return Some(());
        }
        cursor.at += 1;
    }
}

/// `[color] [< x y z >] ;`: what of it is known is added even if the rest is not as simple.
#[inline(always)]
fn tail<'t>(cursor: &mut Cursor<'t>, scope: &mut Scope<'t>) -> Option<(Option<ColorId>, BodyId)> {
    let color =
        cursor.identifier().map(|color| ColorId::from_index(scope.colors.names.enter(color)));
    cursor.skip_blank();
    let body =
        if cursor.next_is(b'<') { motion(cursor, scope)? } else { scope.bodies.bodies.unstated() };
    cursor.mark(b';')?;
    Some((color, body))
}

/// `< x y z >` or `< NAME >`
fn motion<'t>(cursor: &mut Cursor<'t>, scope: &mut Scope<'t>) -> Option<BodyId> {
    cursor.at += 1;
    cursor.skip_blank();
    let start = cursor.at as u32;
    let Some(name) = cursor.identifier() else {
        let beta = cursor.point()?;
        cursor.mark(b'>')?;
        // Of one that is faster than light, the grammar reports the error.
        return scope.bodies.moving_with_beta(beta);
    };
    cursor.mark(b'>')?;
    Some(scope.bodies.enter_name(name, Span { start, end: start + name.len() as u32 }))
}

#[derive(Clone, Copy)]
struct Cursor<'t> {
    text: &'t [u8],
    at: usize,
}

impl<'t> Cursor<'t> {
    #[inline(always)]
    fn next_is(&self, byte: u8) -> bool {
        self.text.get(self.at) == Some(&byte)
    }

    #[inline(always)]
    fn skip_blank(&mut self) {
        while self.text.get(self.at).is_some_and(|&byte| is_blank(byte)) {
            self.at += 1;
        }
    }

    #[inline(always)]
    fn mark(&mut self, byte: u8) -> Option<()> {
        self.skip_blank();
        self.next_is(byte).then(|| self.at += 1)
    }

    /// A name at this position, split into stem and number in the same pass.
    #[inline(always)]
    fn name(&mut self) -> Option<Name<'t>> {
        let start = self.at;
        begins_identifier(*self.text.get(start)?).then_some(())?;
        let (mut stem, mut number) = (1, 0u32);
        let mut len = 1;
        let end = loop {
            let byte = *self.text.get(start + len)?;
            let digit = byte.wrapping_sub(b'0');
            if digit < 10 {
                number = number.wrapping_mul(10).wrapping_add(u32::from(digit));
            } else if is_identifier(byte) {
                (stem, number) = (len + 1, 0);
            } else {
                break byte;
            }
            len += 1;
        };
        if !ends_word(end) {
            return None;
        }
        self.at = start + len;
        Some(Name::with_number(&self.text[start..self.at], stem, number))
    }

    /// A name, if one begins here. If it is invalid, the mark after it does not match.
    #[inline(always)]
    fn identifier(&mut self) -> Option<&'t [u8]> {
        if !self.text.get(self.at).is_some_and(|&byte| begins_identifier(byte)) {
            return None;
        }
        let rest = &self.text[self.at..];
        let len = rest.iter().position(|&byte| !is_identifier(byte)).unwrap_or(rest.len());
        self.at += len;
        Some(&rest[..len])
    }

    #[inline(always)]
    fn number(&mut self) -> Option<f64> {
        self.skip_blank();
        let rest = &self.text[self.at..];
        if let Some((value, len)) = short_decimal(rest) {
            self.at += len;
            return Some(value);
        }
        // A comment before the number is left to the grammar.
        let (behind, value) = number(rest).ok().filter(|_| rest.first() != Some(&b'{'))?;
        self.at = self.text.len() - behind.len();
        Some(value)
    }

    #[inline(always)]
    fn point(&mut self) -> Option<DVec3> {
        Some(DVec3::new(self.number()?, self.number()?, self.number()?))
    }

    /// `(u v)`
    fn uv(&mut self) -> Option<[f32; 2]> {
        self.at += 1;
        let mut uv = [0.0; 2];
        for part in &mut uv {
            let (behind, value) = number32(&self.text[self.at..]).ok()?;
            (self.at, *part) = (self.text.len() - behind.len(), value);
        }
        self.mark(b')')?;
        Some(uv)
    }
}
