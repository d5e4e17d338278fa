//! A scene as a polygon mesh, as the mesh formats require it: one colour per vertex, polygons
//! without holes.

use glam::DVec3;
use rustc_hash::FxHashMap;
use uglight::{RestColor, hsv};
use ugphysics::{srgb_decode, srgb_encode};
use ugscene::{ColorId, ColorValue, Contours, NameId, Scene, Texture, VertexId};

/// The polygons that a format supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Polygons {
    /// Any polygons without holes.
    Simple,
    /// Triangles only.
    Triangles,
}

/// The mesh that is written.
pub(crate) struct PolygonMesh {
    /// The scene, of which the vertices and the head comments are written.
    pub scene: Scene,
    /// Red, green, blue (display-encoded) and alpha of every vertex; `None` if the scene has no
    /// colours.
    pub colors: Option<Vec<[f64; 4]>>,
    /// One polygon per row, counterclockwise as seen from outside.
    pub polygons: Contours,
    /// The face of each polygon.
    faces: Vec<u32>,
    /// Notes for the user about parts that are left out.
    pub notes: Vec<String>,
}

impl PolygonMesh {
    /// `has_camera`: whether the format has cameras. `has_textures`: whether it has pictures on
    /// surfaces; in others these have their plain colour.
    pub fn new(mut scene: Scene, kind: Polygons, has_camera: bool, has_textures: bool) -> Self {
        let mut notes = Vec::new();
        let n_labels = scene.labels().count();
        let n_wires = scene.wires.len() - n_labels;
        note_count(&mut notes, n_wires, "wire is left out", "wires are left out");
        note_count(&mut notes, n_labels, "label is left out", "labels are left out");
        // Formats with cameras have lights, too.
        if !has_camera {
            let n_lights = scene.lights.len();
            note_count(&mut notes, n_lights, "light is left out", "lights are left out");
            note_count(
                &mut notes,
                scene.cameras.len(),
                "camera is left out",
                "cameras are left out",
            );
        }
        if !has_textures && !scene.textures.is_empty() {
            notes.push("the format has no textures: their faces have a plain colour".to_string());
            scene.textures.clear();
        }
        if !has_textures && !scene.emissions.is_empty() {
            notes.push("the format has no emitted light: it is left out".to_string());
        }
        leave_out_wires(&mut scene);
        separate_colors(&mut scene);
        let mut colors = vertex_colors(&scene, &mut notes);
        colors.iter_mut().for_each(|colors| apply_factors(&scene, colors));
        let (polygons, faces) = polygons(&scene, kind, &mut notes);
        Self { scene, colors, polygons, faces, notes }
    }

    /// The polygons by the name and the colour of their faces, in order of first appearance. A
    /// single group, with a note, if there are more than a person has named: a name for every
    /// colour of a scan helps nobody.
    pub fn groups(&mut self) -> Vec<Group> {
        const MAX: usize = 256;
        let all = 0..self.faces.len() as u32;
        let text = |name: NameId| self.scene.names.get(name).to_owned();
        let mut groups: Vec<Group> = Vec::new();
        let mut rows: FxHashMap<GroupKey, usize> = FxHashMap::default();
        for polygon in all.clone() {
            let face = &self.scene.faces[self.faces[polygon as usize] as usize];
            let level = self.scene.light_level(face);
            // Rows of names may have equal text.
            let name = face.name.map(|name| self.scene.names.get(name));
            let key = (name, face.color, level.map(f64::to_bits));
            let row = *rows.entry(key).or_insert_with(|| {
                let of = |color| self.scene.texture_of(color).cloned();
                let emitted =
                    face.color.and_then(|color| self.scene.emitted_by(color)).map(|color| {
                        let light = RestColor::new(&self.scene, Some(color)).linear();
                        (light.to_array(), of(color))
                    });
                let name = face.color.map(|color| text(self.scene.colors[color.index()].name));
                let texture = face.color.and_then(of);
                let color = GroupColor { name, texture, emitted, level };
                groups.push(Group { name: face.name.map(text), color, polygons: Vec::new() });
                groups.len() - 1
            });
            groups[row].polygons.push(polygon);
        }
        if groups.len() <= MAX {
            return groups;
        }
        let count = groups.len();
        self.notes
            .push(format!("names of faces and colours are left out: {count} are more than {MAX}"));
        vec![Group { name: None, color: GroupColor::default(), polygons: all.collect() }]
    }

    /// True if any vertex is transparent.
    pub fn is_transparent(&self) -> bool {
        self.colors.iter().flatten().any(|color| color[3] < 1.0)
    }

    /// True if any corner of this polygon is transparent.
    pub fn is_transparent_at(&self, polygon: u32) -> bool {
        let colors = self.colors.as_deref();
        let alpha = |corner: &VertexId| colors.map_or(1.0, |colors| colors[corner.index()][3]);
        self.polygons.get(polygon).iter().any(|corner| alpha(corner) < 1.0)
    }

    /// The unit normals, if every vertex that a face uses has one: formats with one normal per
    /// vertex cannot omit single ones.
    pub fn normals(&self) -> Option<Vec<DVec3>> {
        let used = (0..self.polygons.len() as u32).flat_map(|row| self.polygons.get(row));
        let mut has_all = !self.polygons.is_empty();
        used.for_each(|corner| has_all &= self.scene.vertices[corner.index()].normal.is_some());
        has_all.then(|| {
            let unit = |normal: Option<DVec3>| normal.map_or(DVec3::Z, unit);
            self.scene.vertices.iter().map(|vertex| unit(vertex.normal)).collect()
        })
    }
}

/// The name, the colour and the bits of the light level of faces.
type GroupKey<'s> = (Option<&'s str>, Option<ColorId>, Option<u64>);

/// Polygons of faces with the same name, colour and light level.
pub(crate) struct Group {
    /// The name of the faces.
    pub name: Option<String>,
    /// Their colour.
    pub color: GroupColor,
    /// Rows in the polygons of the mesh.
    pub polygons: Vec<u32>,
}

/// The colour of polygons, as a material.
#[derive(Default)]
pub(crate) struct GroupColor {
    /// Its name.
    pub name: Option<String>,
    /// The picture that it is.
    pub texture: Option<Texture>,
    /// The linear light that its faces emit, and its picture.
    pub emitted: Option<([f64; 3], Option<Texture>)>,
    /// The light level of faces that are not lit.
    pub level: Option<f64>,
}

impl PartialEq for GroupColor {
    /// Colours of one name are one.
    fn eq(&self, other: &Self) -> bool {
        (&self.name, self.level) == (&other.name, other.level)
    }
}

/// The unit vector along `v`, which must not be 0. A vector that is already of unit length keeps
/// its bits.
fn unit(v: DVec3) -> DVec3 {
    if (v.length_squared() - 1.0).abs() < 1e-6 {
        v
    } else {
        (v / v.abs().max_element()).normalize()
    }
}

/// Adds a note with a count, unless the count is 0.
pub(crate) fn note_count(notes: &mut Vec<String>, count: usize, one: &str, many: &str) {
    match count {
        0 => {}
        1 => notes.push(format!("1 {one}")),
        _ => notes.push(format!("{count} {many}")),
    }
}

/// Removes the wires, and the vertices that only they used, which would be outside the box that
/// `-fit` and `--center` measure. Vertices that nothing uses stay.
fn leave_out_wires(scene: &mut Scene) {
    if scene.wires.is_empty() {
        return;
    }
    let mut keeps = vec![true; scene.vertices.len()];
    for wire in scene.wires.drain(..) {
        scene
            .contours
            .corners(wire.contours)
            .iter()
            .for_each(|corner| keeps[corner.index()] = false);
    }
    let of_faces = ugscene::face_vertices(scene, keeps.len());
    keeps.iter_mut().zip(of_faces).for_each(|(keeps, is_used)| *keeps |= is_used);
    let rows = keeps.iter().scan(0, |next, &is_kept| {
        let row = *next;
        *next += u32::from(is_kept);
        Some(row)
    });
    let rows: Vec<u32> = rows.collect();
    for face in &scene.faces {
        let corners = scene.contours.corners_mut(face.contours.clone());
        corners.iter_mut().for_each(|corner| corner.0 = rows[corner.index()]);
    }
    retain(&mut scene.vertices, &keeps);
    retain(&mut scene.rest, &keeps);
    retain(&mut scene.own_times, &keeps);
}

fn retain<T>(rows: &mut Vec<T>, keeps: &[bool]) {
    let mut keeps = keeps.iter();
    rows.retain(|_| keeps.next() == Some(&true));
}

/// Duplicates vertices where faces of different colours meet, so that each vertex has one colour.
fn separate_colors(scene: &mut Scene) {
    let users: Vec<_> =
        scene.faces.iter().map(|face| (face.contours.clone(), face.color)).collect();
    ugscene::split_vertices(scene, &users, |vertex| vertex.color.is_none());
}

/// The colour of every vertex: its own, otherwise that of its faces, otherwise white. Those of a
/// face with a texture only multiply this.
fn vertex_colors(scene: &Scene, notes: &mut Vec<String>) -> Option<Vec<[f64; 4]>> {
    let mut ids: Vec<Option<ColorId>> = scene.vertices.iter().map(|vertex| vertex.color).collect();
    for face in &scene.faces {
        for corner in scene.face_corners(face) {
            let id = &mut ids[corner.index()];
            *id = id.or(face.color.filter(|&color| scene.texture_of(color).is_none()));
        }
    }
    let mut n_clipped = 0;
    let palette: Vec<[f64; 4]> = scene
        .colors
        .iter()
        .map(|color| {
            let [red, green, blue] = match color.value {
                ColorValue::Rgb(rgb) => rgb,
                _ => hsv(scene, color).to_rgb(),
            };
            n_clipped += usize::from(red.max(green).max(blue) > 1.0);
            [red, green, blue, 1.0 - color.translucency].map(|part| part.clamp(0.0, 1.0))
        })
        .collect();
    note_count(
        notes,
        n_clipped,
        "colour brighter than 1 is clipped",
        "colours brighter than 1 are clipped",
    );
    let color = |id: Option<ColorId>| id.map_or([1.0; 4], |id| palette[id.index()]);
    ids.iter().any(Option::is_some).then(|| ids.into_iter().map(color).collect())
}

/// Multiplies colours that tint textures by the parts of factors above 1, which formats do not
/// have.
fn apply_factors(scene: &Scene, colors: &mut [[f64; 4]]) {
    let mut is_done = vec![false; colors.len()];
    for face in &scene.faces {
        let Some(texture) = face.color.and_then(|color| scene.texture_of(color)) else { continue };
        for corner in scene.face_corners(face) {
            let row = corner.index();
            if scene.vertices[row].color.is_some() && !std::mem::replace(&mut is_done[row], true) {
                let factors = texture.factor.map(|part| f64::from(part).max(1.0));
                for (channel, factor) in colors[row].iter_mut().zip(factors).take(3) {
                    *channel = srgb_encode(srgb_decode(*channel) * factor).min(1.0);
                }
            }
        }
    }
}

/// Faces as polygons without holes, and the face of each polygon. A face that cannot be
/// triangulated becomes a triangle fan of its outline.
fn polygons(scene: &Scene, kind: Polygons, notes: &mut Vec<String>) -> (Contours, Vec<u32>) {
    let mut polygons = Contours::default();
    let mut faces = Vec::with_capacity(scene.faces.len());
    let mut n_uncut = 0;
    for (row, face) in scene.faces.iter().enumerate() {
        let contours: Vec<&[VertexId]> = scene.face_contours(face).collect();
        let is_fit = match kind {
            Polygons::Simple => contours.len() == 1,
            Polygons::Triangles => contours.len() == 1 && contours[0].len() == 3,
        };
        if is_fit {
            polygons.push(contours[0].iter().copied());
            faces.push(row as u32);
            continue;
        }
        let place = |corner: VertexId| scene.vertices[corner.index()].position;
        let corners = contours.concat();
        let triangles = ugpolygon::face_triangles(scene, face, place).unwrap_or_else(|| {
            n_uncut += 1;
            (2..contours[0].len() as u32).map(|last| [0, last - 1, last]).collect()
        });
        for triangle in triangles {
            polygons.push(triangle.map(|corner| corners[corner as usize]));
            faces.push(row as u32);
        }
    }
    note_count(
        notes,
        n_uncut,
        "face without area is written as a fan",
        "faces without area are written as fans",
    );
    (polygons, faces)
}
