//! Writes a [`Scene`] as text: one statement per line, with numbers that read back to the same
//! bits.

use std::io::{self, Write};

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugphysics::{Event, InertialFrame, Piece};
use ugscene::{
    AlphaMode, Beam, BodyId, Camera, Carrier, Color, ColorId, ColorTable, ColorValue, Contours,
    Light, LightKind, MotionPath, NameId, Projection, Scene, Shading, StatedMotion,
    SurfaceProperties, Texture, VertexId, Wire, Wrap,
};

use crate::chunked_writer::ChunkedWriter;
use crate::number_text::{push_number, push_number32, push_velocity};
use crate::passed_on::{Comment, Item, PassedOn};
use crate::{sky_statement, stage_statement};

/// Number of rows per piece of text.
const BLOCK_ROWS: usize = 1 << 11;

/// Pieces per thread and round: enough to balance the load, few enough to save memory.
const BLOCKS_PER_THREAD: usize = 4;

/// The text of a scene to which nothing is [passed on](PassedOn), see [`write_with`].
pub fn write(scene: &Scene) -> Vec<u8> {
    write_with(scene, &PassedOn::default())
}

/// The text of a scene: head comments, the stage, then escapes and unknown statements,
/// colours, surfaces, motions, vertices, faces, wires, lights, cameras, each with its comments.
pub fn write_with(scene: &Scene, passed_on: &PassedOn) -> Vec<u8> {
    let mut text = Vec::with_capacity(64 * (scene.vertices.len() + scene.faces.len()) + 1024);
    write_to(scene, passed_on, &mut text).expect("memory takes all that is written to it");
    text
}

/// Writes the same text as [`write_with`] to `out` while it is formatted on all threads, which needs
/// less memory. The bytes do not depend on the number of threads.
///
/// Returns the number of bytes.
///
/// # Errors
/// Errors that `out` returns; it may have received a part of the text.
pub fn write_to(scene: &Scene, passed_on: &PassedOn, out: &mut dyn Write) -> io::Result<usize> {
    let motions: Vec<BodyId> = scene.bodies.stated_by_name().collect();
    let comments = &passed_on.comments_in(scene);
    Tables {
        scene,
        passed_on,
        motions: &motions,
        chunked_writer: ChunkedWriter::new(out),
        comments,
    }
    .send()
}

/// Writes the tables of a scene.
struct Tables<'s, 'o> {
    scene: &'s Scene,
    passed_on: &'s PassedOn,
    /// The bodies whose motions have statements.
    motions: &'s [BodyId],
    chunked_writer: ChunkedWriter<'o>,
    /// Comments not yet assigned to a block, sorted by statement.
    comments: &'s [(Item, &'s Comment)],
}

impl<'s> Tables<'s, '_> {
    fn send(mut self) -> io::Result<usize> {
        let scene = self.scene;
        for text in &scene.head.comments {
            self.chunked_writer.append(|out| Writer::on(out, scene, &[], |w| w.comment_line(text)));
        }
        let at_stage: fn(u32) -> Item = |_| Item::Stage;
        let stage = if scene.stage.is_at_rest() { &[] } else { std::slice::from_ref(&scene.stage) };
        self.rows(stage, at_stage, |w, stage| {
            stage_statement::write(stage, &mut w.out, &mut w.numbers)
        })?;
        let sky = scene.sky.as_slice();
        self.rows(sky, at_stage, |w, sky| sky_statement::write(sky, &mut w.out, &mut w.numbers))?;
        self.rows(&self.passed_on.statements, Item::PassedOn, |w, text| w.text(text))?;
        self.rows(&scene.colors, Item::Color, |w, color| {
            match scene.table_of(ColorId::from_index(w.row as usize)) {
                Some(table) => w.color_table(table),
                None => w.color(color),
            }
        })?;
        self.rows(&scene.mixes, Item::Mix, |w, mix| {
            w.begin("c_mix", scene.colors[mix.color.index()].name);
            for &(part, share) in &mix.parts {
                w.name(scene.colors[part.index()].name);
                w.number(share);
            }
            w.text(";");
        })?;
        self.rows(&scene.textures, Item::Texture, Writer::texture)?;
        self.rows(&scene.emissions, Item::Emission, |w, &[color, emitted]| {
            w.begin("c_emit", scene.colors[color.index()].name);
            w.name(scene.colors[emitted.index()].name);
            w.text(";");
        })?;
        self.rows(&scene.surfaces, Item::Surface, Writer::surface)?;
        let mut along = FxHashMap::default();
        for &body in self.motions {
            if let Some(MotionPath::Along(path)) =
                scene.bodies.statement(body).map(|motion| &motion.path)
            {
                along.entry(path.address()).or_insert(body);
            }
        }
        self.rows(self.motions, Item::Motion, |w, &body| w.motion(body, &along))?;
        self.rows(&scene.vertices, Item::Vertex, |w, vertex| {
            w.begin("v", vertex.name);
            w.point(vertex.position);
            w.optional_color(vertex.color);
            vertex.normal.into_iter().for_each(|normal| w.point(normal));
            if let Some([u, v]) = vertex.uv {
                w.text(" (");
                push_number32(&mut w.out, &mut w.numbers, u);
                w.number32(v);
                w.text(")");
            }
            w.text(";");
        })?;
        self.rows(&scene.faces, Item::Face, |w, face| {
            w.begin(face.shape.keyword(), face.name);
            w.contours(&scene.contours, face.contours.clone());
            w.optional_color(face.color);
            face.shading.into_iter().for_each(|shading| w.shading(scene.shadings[shading.index()]));
            w.body(face.body);
            w.text(";");
        })?;
        self.rows(&scene.wires, Item::Wire, |w, wire| {
            w.begin(if wire.text.is_some() { "label" } else { "w" }, wire.name);
            if let Some(text) = wire.text {
                w.label(text, wire);
            } else {
                w.contours(&scene.contours, wire.contours.clone());
                w.optional_color(wire.color);
            }
            w.body(wire.body);
            w.text(";");
        })?;
        self.rows(&scene.lights, Item::Light, Writer::light)?;
        self.rows(&scene.cameras, Item::Camera, Writer::camera)?;
        let comments = self.comments;
        self.chunked_writer
            .append(|out| Writer::on(out, scene, comments, |w| w.comments_at(Item::End, false)));
        self.chunked_writer.send()?;
        Ok(self.chunked_writer.n_sent)
    }

    /// Writes one line per row, in blocks on all threads.
    fn rows<T: Sync>(
        &mut self,
        rows: &'s [T],
        item: fn(u32) -> Item,
        line: impl Fn(&mut Writer<'s>, &'s T) + Sync,
    ) -> io::Result<()> {
        let scene = self.scene;
        let write = |block: &Block<'s, T>, out: &mut Vec<u8>| {
            Writer::on(out, scene, block.comments, |w| w.block(block, item, &line));
        };
        let blocks: Vec<Block<'s, T>> = rows
            .chunks(BLOCK_ROWS)
            .enumerate()
            .map(|(idx, rows)| self.take_block(idx * BLOCK_ROWS, rows, item))
            .collect();
        for round in blocks.chunks(BLOCKS_PER_THREAD * rayon::current_num_threads()) {
            match round {
                // Waking a thread would take longer than formatting a small table.
                [block] => self.chunked_writer.append(|out| write(block, out)),
                _ => self.chunked_writer.round(round.len(), &|idx, out| write(&round[idx], out))?,
            }
        }
        Ok(())
    }

    /// A block of rows with the comments that belong to them.
    fn take_block<T>(
        &mut self,
        first: usize,
        rows: &'s [T],
        item: fn(u32) -> Item,
    ) -> Block<'s, T> {
        let last = item((first + rows.len() - 1) as u32);
        let (comments, rest) =
            self.comments.split_at(self.comments.partition_point(|(at, _)| *at <= last));
        self.comments = rest;
        Block { first, rows, comments }
    }
}

/// Consecutive rows of a table.
struct Block<'s, T> {
    /// Row in the table.
    first: usize,
    rows: &'s [T],
    comments: &'s [(Item, &'s Comment)],
}

struct Writer<'s> {
    scene: &'s Scene,
    out: Vec<u8>,
    /// Comments not yet written, sorted by statement.
    comments: &'s [(Item, &'s Comment)],
    numbers: zmij::Buffer,
    /// The row that is written.
    row: u32,
    /// The body of the last row, and the text of its motion, because consecutive rows mostly share
    /// one.
    body: Option<BodyId>,
    motion_text: Vec<u8>,
}

impl<'s> Writer<'s> {
    /// Appends the output of `write` to `out`.
    fn on(
        out: &mut Vec<u8>,
        scene: &'s Scene,
        comments: &'s [(Item, &'s Comment)],
        write: impl FnOnce(&mut Self),
    ) {
        let mut writer = Self {
            scene,
            out: std::mem::take(out),
            comments,
            numbers: zmij::Buffer::new(),
            row: 0,
            body: None,
            motion_text: Vec::new(),
        };
        write(&mut writer);
        *out = writer.out;
    }

    /// Writes one line per row, with the comments above and after it.
    fn block<T>(
        &mut self,
        block: &Block<'s, T>,
        item: fn(u32) -> Item,
        line: impl Fn(&mut Self, &'s T),
    ) {
        for (row, idx) in block.rows.iter().zip(block.first..) {
            self.row = idx as u32;
            if self.comments.is_empty() {
                line(self, row);
            } else {
                let item = item(self.row);
                self.comments_at(item, false);
                line(self, row);
                self.comments_at(item, true);
            }
            self.out.push(b'\n');
        }
    }

    /// Writes the comments of `item`: those after it if `trailing`, else those above it.
    fn comments_at(&mut self, item: Item, trailing: bool) {
        while let Some((&(at, comment), rest)) = self.comments.split_first() {
            // A comment of a missing row must not block the others.
            let lost = at < item;
            if !lost && (at != item || comment.trailing != trailing) {
                break;
            }
            self.comments = rest;
            if trailing {
                self.text(" ");
                self.comment(&comment.text);
            } else {
                self.comment_line(&comment.text);
            }
        }
    }

    fn comment_line(&mut self, text: &str) {
        self.comment(text);
        self.out.push(b'\n');
    }

    fn comment(&mut self, text: &str) {
        self.text("{");
        self.text(text);
        self.text("}");
    }

    fn text(&mut self, text: &str) {
        self.out.extend_from_slice(text.as_bytes());
    }

    fn name(&mut self, name: NameId) {
        self.out.push(b' ');
        self.out.extend_from_slice(self.scene.names.bytes(name));
    }

    /// Writes the keyword of a statement and its name, if it has one.
    fn begin(&mut self, keyword: &str, name: impl Into<Option<NameId>>) {
        self.text(keyword);
        name.into().into_iter().for_each(|name| self.name(name));
    }

    fn number(&mut self, value: f64) {
        self.out.push(b' ');
        push_number(&mut self.out, &mut self.numbers, value);
    }

    fn number32(&mut self, value: f32) {
        self.out.push(b' ');
        push_number32(&mut self.out, &mut self.numbers, value);
    }

    fn point(&mut self, p: DVec3) {
        self.number(p.x);
        self.number(p.y);
        self.number(p.z);
    }

    fn numbers(&mut self, values: &[f64]) {
        values.iter().for_each(|&value| self.number(value));
    }

    /// Writes an option and its numbers.
    fn option(&mut self, option: &str, numbers: &[f64]) {
        self.text(option);
        self.numbers(numbers);
    }

    fn optional_color(&mut self, color: Option<ColorId>) {
        if let Some(color) = color {
            self.name(self.scene.colors[color.index()].name);
        }
    }

    /// Writes the motion of a face or wire.
    fn body(&mut self, body: BodyId) {
        if self.body != Some(body) {
            self.body = Some(body);
            let before = self.out.len();
            self.motion_of(body, DVec3::ZERO);
            self.motion_text = self.out.split_off(before);
        }
        self.out.extend_from_slice(&self.motion_text);
    }

    /// Writes the motion of a body. `at`: its reference point, if none is written.
    fn motion_of(&mut self, body: BodyId, at: DVec3) {
        let bodies = &self.scene.bodies;
        if bodies.statement(body).is_some() {
            push_motion_name(&mut self.out, self.scene, body);
        } else if let (Some(_), Some(frame)) =
            (bodies.stated_velocity(body), bodies.motion(body).inertial_frame())
        {
            let is_seen = self.scene.stage.seen_geometry().is_some();
            self.frame(frame, (!is_seen).then_some(at));
        }
    }

    /// Writes ` <x y z …>`. `at`: the reference point, if none is written; `None` if it has no
    /// meaning.
    fn frame(&mut self, frame: &InertialFrame, at: Option<DVec3>) {
        push_velocity(&mut self.out, &mut self.numbers, " <", frame.velocity);
        if at.is_some_and(|at| frame.at != at) {
            self.option(" -at", frame.at.as_ref());
        }
        if frame.turn != DVec3::ZERO {
            self.option(" -turn", frame.turn.as_ref());
        }
        self.shift(frame.shift);
        self.out.push(b'>');
    }

    fn shift(&mut self, shift: Event) {
        if shift != StatedMotion::NO_SHIFT {
            self.option(" -shift", &[shift.t]);
            self.point(shift.x);
        }
    }

    fn contours(&mut self, contours: &Contours, rows: std::ops::Range<u32>) {
        for contour in contours.iter(rows) {
            self.text(" (");
            for (idx, &corner) in contour.iter().enumerate() {
                if idx > 0 {
                    self.out.push(b' ');
                }
                self.corner(corner);
            }
            self.text(")");
        }
    }

    fn corner(&mut self, corner: VertexId) {
        let name = self.scene.names.bytes(self.scene.vertices[corner.index()].name);
        self.out.extend_from_slice(name);
    }

    /// A label after its name: the text and the vertex.
    fn label(&mut self, text: NameId, wire: &Wire) {
        self.out.extend_from_slice(format!(" \"{}\" ", self.scene.names.get(text)).as_bytes());
        self.corner(self.scene.contours.get(wire.contours.start)[0]);
    }

    /// A colour that changes with own time.
    fn color_table(&mut self, table: &ColorTable) {
        self.begin("c_time", self.scene.colors[table.color.index()].name);
        if table.is_stepped {
            self.text(" -step");
        }
        if let Some(period) = table.period {
            self.option(" -period", &[period]);
        }
        if table.shift != 0.0 {
            self.option(" -shift", &[table.shift]);
        }
        for &(time, color) in &table.rows {
            self.number(time);
            self.name(self.scene.colors[color.index()].name);
        }
        self.text(";");
    }

    fn color(&mut self, color: &Color) {
        let clear = Some(color.translucency).filter(|clear| *clear != 0.0);
        match color.value {
            ColorValue::Hsv { value, tint, saturation, factor } => {
                self.begin("c", color.name);
                self.number(value);
                if (tint.number(), saturation, clear, factor) != (0.0, 0.0, None, 1.0) {
                    self.numbers(&[tint.number(), saturation]);
                }
                if factor != 1.0 {
                    self.numbers(&[color.translucency, factor]);
                    return self.text(";");
                }
            }
            ColorValue::Rgb(rgb) => {
                self.begin("c_rgb", color.name);
                self.numbers(&rgb);
            }
            ColorValue::Xyz(xyz) => {
                self.begin("c_xyz", color.name);
                self.numbers(&xyz);
            }
            ColorValue::Blackbody { kelvin, scale } => {
                self.begin("c_bb", color.name);
                self.number(kelvin);
                (scale != 1.0).then(|| self.number(scale));
            }
            ColorValue::Spectrum { reflects, start, end } => {
                self.begin(if reflects { "c_refl" } else { "c_spd" }, color.name);
                self.numbers(self.scene.samples[start as usize..end as usize].as_flattened());
            }
        }
        clear.into_iter().for_each(|clear| self.number(clear));
        self.text(";");
    }

    /// Writes `c_tex`; nothing for a picture inside a mesh from standard input, which has no name.
    fn texture(&mut self, texture: &Texture) {
        let Texture { color, image, wrap, factor, alpha, is_nearest } = texture;
        let Some(file) = &image.file else { return };
        self.begin("c_tex", self.scene.colors[color.index()].name);
        self.text(" \"");
        self.text(file);
        self.text("\"");
        if let Some(row) = image.row {
            self.option(" -image", &[f64::from(row)]);
        }
        if *wrap != [Wrap::Repeat; 2] {
            self.text(" -wrap");
            let n = if wrap[0] == wrap[1] { 1 } else { 2 };
            for axis in &wrap[..n] {
                self.text(" ");
                self.text(axis.name());
            }
        }
        if *factor != [1.0; 4] {
            self.text(" -factor");
            let n = if factor[3] == 1.0 { 3 } else { 4 };
            factor[..n].iter().for_each(|&channel| self.number32(channel));
        }
        match *alpha {
            AlphaMode::Opaque => {}
            AlphaMode::Mask(cutoff) => {
                self.text(" -mask");
                self.number32(cutoff);
            }
            AlphaMode::Blend => self.text(" -blend"),
        }
        if *is_nearest {
            self.text(" -nearest");
        }
        self.text(";");
    }

    fn surface(&mut self, surface: &SurfaceProperties) {
        self.begin("surf", surface.name);
        self.numbers(&surface.numbers());
        self.text(";");
    }

    fn shading(&mut self, shading: Shading) {
        match shading {
            Shading::Level(level) => self.number(level),
            Shading::Surface(surface) => self.name(self.scene.surfaces[surface.index()].name),
        }
    }

    /// `along`: the first motion along each path.
    fn motion(&mut self, body: BodyId, along: &FxHashMap<usize, BodyId>) {
        let bodies = &self.scene.bodies;
        let Some(motion) = bodies.statement(body) else { return };
        self.begin("motion", bodies[body].name);
        let StatedMotion { at, path, spins, on, shift } = motion;
        if *at != DVec3::ZERO {
            self.option(" -at", at.as_ref());
        }
        match path {
            MotionPath::Free { velocity, accelerations } => {
                if !velocity.is_zero() {
                    push_velocity(&mut self.out, &mut self.numbers, " -vel ", *velocity);
                }
                accelerations.iter().for_each(|piece| self.piece(" -acc", piece, 0.0));
            }
            MotionPath::Curve { kind, numbers } => {
                self.option(&format!(" -{}", kind.word), numbers)
            }
            MotionPath::Along(path) if along[&path.address()] != body => {
                self.text(" -path");
                push_motion_name(&mut self.out, self.scene, along[&path.address()]);
            }
            MotionPath::Along(path) => {
                self.text(" -path (");
                let mut behind = "";
                for Event { t, x } in path.events() {
                    self.text(behind);
                    push_number(&mut self.out, &mut self.numbers, t);
                    self.point(x);
                    behind = " ";
                }
                self.text(")");
            }
        }
        match on {
            None => {}
            Some(Carrier::Body(body)) => {
                self.text(" -on");
                bodies[*body].name.into_iter().for_each(|name| self.name(name));
            }
            Some(Carrier::Frame(frame)) => {
                self.text(" -on");
                self.frame(frame, Some(DVec3::ZERO));
            }
        }
        spins.iter().for_each(|piece| self.piece(" -spin", piece, f64::NEG_INFINITY));
        self.shift(*shift);
        self.text(";");
    }

    /// A piece of a motion. `default_begin`: without times, it acts from then on.
    fn piece(&mut self, option: &str, piece: &Piece, default_begin: f64) {
        self.option(option, piece.of.as_ref());
        if (piece.from, piece.to) != (default_begin, f64::INFINITY) {
            self.numbers(&[piece.from, piece.to]);
        }
    }

    fn light(&mut self, light: &Light) {
        self.begin("l", light.name);
        self.number(light.intensity);
        let (mut place, mut beam) = (DVec3::ZERO, Beam::Even);
        match light.kind {
            LightKind::Ambient => {}
            LightKind::Directional(toward) => self.point(toward),
            LightKind::Local { position, radius, reference, beam: own } => {
                (place, beam) = (position, own);
                self.point(position);
                self.number(radius);
                reference.into_iter().for_each(|reference| self.number(reference));
            }
        }
        self.optional_color(light.color);
        match beam {
            Beam::Even => {}
            Beam::Spot { axis, degrees } => {
                self.option(" -spot", &axis.to_array());
                self.numbers(&degrees);
            }
            Beam::Area(edges) => {
                self.option(" -area", edges.map(|edge| edge.to_array()).as_flattened())
            }
        }
        light.motion.body().into_iter().for_each(|body| self.motion_of(body, place));
        self.text(";");
    }

    fn camera(&mut self, camera: &Camera) {
        self.begin("cam", camera.name);
        let options = [
            (" -ep", camera.eye.as_ref().map(|point| &point.as_ref()[..])),
            (" -vc", camera.center.as_ref().map(|point| &point.as_ref()[..])),
            (" -ud", camera.up.as_ref().map(|point| &point.as_ref()[..])),
            (" -cl", camera.clip.as_ref().map(|pair| &pair[..])),
            (" -ph", camera.film.as_ref().map(|film| &film[..])),
            (" -va", camera.view_angle.as_ref().map(|pair| &pair[..])),
            (" -fs", camera.film_size.as_ref().map(|pair| &pair[..])),
            (" -fl", camera.focal_length.as_ref().map(std::slice::from_ref)),
        ];
        for (option, numbers) in options {
            numbers.into_iter().for_each(|numbers| self.option(option, numbers));
        }
        match camera.projection {
            Some(Projection::Orthographic) => self.text(" -og"),
            Some(Projection::Perspective) => self.text(" -ps"),
            None => {}
        }
        if let Some(body) = camera.carrier {
            push_motion_name(&mut self.out, self.scene, body);
        } else if let Some(velocity) = camera.velocity {
            push_velocity(&mut self.out, &mut self.numbers, " <", velocity);
            self.out.push(b'>');
        }
        self.text(";");
    }
}

/// Writes ` <NAME>`.
fn push_motion_name(out: &mut Vec<u8>, scene: &Scene, body: BodyId) {
    let name = scene.bodies[body].name.map_or("", |name| scene.names.get(name));
    out.extend_from_slice(b" <");
    out.extend_from_slice(name.as_bytes());
    out.push(b'>');
}
