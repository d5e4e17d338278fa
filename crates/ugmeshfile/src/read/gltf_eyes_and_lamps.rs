//! Cameras and lights of glTF (`KHR_lights_punctual`), with the axes of the file.

use std::collections::BTreeSet;

use glam::{DAffine3, DVec3};
use serde_json::Value;
use ugphysics::srgb_encode;
use ugscene::{Beam, Camera, Light, LightKind, LightMotion, NameId, Projection, Scene, shorten};

use super::Input;
use super::gltf_document::{Document, numbers, whole};
use crate::builder::{Builder, Rgba};
use crate::error::Problem;

/// The shape of the picture, width over height, of a camera that does not state it.
const ASPECT: f64 = 4.0 / 3.0;

/// The most names in a message.
const MOST_NAMED: usize = 5;

/// The cameras and lights of nodes that are in the scene.
#[derive(Default)]
pub(super) struct EyesAndLamps {
    eyes: Vec<Eye>,
    lamps: Vec<Lamp>,
    /// The kinds of lights that are not read.
    unread: BTreeSet<String>,
    /// Cameras that make no picture.
    n_invalid: usize,
}

/// A camera of a node.
struct Eye {
    name: String,
    place: DAffine3,
    lens: Lens,
}

enum Lens {
    /// The tangents of half the angles across and down.
    Perspective([f64; 2]),
    /// Half the sides of the view.
    Orthographic([f64; 2]),
}

/// A light of a node.
struct Lamp {
    name: String,
    color: [f64; 3],
    intensity: f64,
    kind: LightKind,
}

impl EyesAndLamps {
    /// Adds the camera and the light of a node.
    pub fn add(
        &mut self,
        document: &Document,
        node: &Value,
        place: &DAffine3,
    ) -> Result<(), Problem> {
        let name_of = |object: &Value| {
            node["name"].as_str().or(object["name"].as_str()).unwrap_or_default().to_owned()
        };
        if let Some(index) = whole(&node["camera"]) {
            let camera = document.row("cameras", index)?;
            match lens(camera) {
                Some(lens) => self.eyes.push(Eye { name: name_of(camera), place: *place, lens }),
                None => self.n_invalid += 1,
            }
        }
        let light = &node["extensions"]["KHR_lights_punctual"]["light"];
        if let Some(index) = whole(light) {
            let lights = &document.0["extensions"]["KHR_lights_punctual"]["lights"];
            let none =
                || Problem::new(format!("light {index} does not exist; export the mesh again"));
            let light = lights.get(index).ok_or_else(none)?;
            match lamp(light, name_of(light), place) {
                Some(lamp) => self.lamps.push(lamp),
                None => {
                    let kind = shorten(light["type"].as_str().unwrap_or_default());
                    self.unread.insert(kind);
                }
            }
        }
        Ok(())
    }

    /// Adds all to the scene, whose faces are complete.
    pub fn finish(mut self, input: &Input<'_>, builder: &mut Builder) {
        let mut names = Vec::new();
        for (row, eye) in std::mem::take(&mut self.eyes).into_iter().enumerate() {
            let name =
                builder.name(&eye.name).or_else(|| builder.name(&format!("camera{}", row + 1)));
            let Some(camera) = camera(&eye, name, builder.scene()) else {
                self.n_invalid += 1;
                continue;
            };
            builder.camera(camera);
            names
                .extend(name.map(|name| format!("`{}`", shorten(builder.scene().names.get(name)))));
        }
        builder.warn_count(
            self.n_invalid,
            "camera is left out, since it makes no picture",
            "cameras are left out, since they make no picture",
        );
        if let [first, others @ ..] = &names[..] {
            let rest = match others {
                [] => String::new(),
                _ => {
                    let more = if others.len() > MOST_NAMED { ", …" } else { "" };
                    let others = &others[..others.len().min(MOST_NAMED)];
                    format!("; others can be selected by name: {}{more}", others.join(", "))
                }
            };
            let note = format!("the view is that of the camera {first} of the file{rest}");
            input.notes.borrow_mut().push(note);
        }
        for kind in self.unread.iter().take(MOST_NAMED) {
            builder.warn(format!("a light of the kind `{kind}` is not read"));
        }
        for lamp in self.lamps {
            let Lamp { name, color, intensity, kind } = lamp;
            let most = color.into_iter().fold(0.0, f64::max);
            let is_white = color == [most; 3];
            // The intensity has what is above 1.
            let scale = if is_white { most } else { most.max(1.0) };
            let color = (!is_white).then(|| {
                // Exactly 1 for 1, where the transfer function has a rounding error.
                let encode = |part: f64| if part == 1.0 { 1.0 } else { srgb_encode(part) };
                let [red, green, blue] = color.map(|part| encode(part / scale));
                builder.material(
                    Rgba::opaque([red, green, blue]),
                    &(if name.is_empty() { "light".to_owned() } else { format!("{name}_light") }),
                    None,
                    None,
                )
            });
            let name = builder.name(&name);
            let motion = LightMotion::WithWhatItLights;
            let intensity = (intensity * scale).min(f64::MAX);
            builder.light(Light { name, intensity, kind, color, motion });
        }
    }
}

/// The lens of a camera; `None` if its numbers make no picture.
fn lens(camera: &Value) -> Option<Lens> {
    let number =
        |value: &Value| value.as_f64().filter(|number| *number > 0.0 && number.is_finite());
    if camera["type"] == "orthographic" {
        let view = &camera["orthographic"];
        return Some(Lens::Orthographic([number(&view["xmag"])?, number(&view["ymag"])?]));
    }
    let view = &camera["perspective"];
    let down = libm::tan(0.5 * number(&view["yfov"])?);
    let across = down * number(&view["aspectRatio"]).unwrap_or(ASPECT);
    let is_flat = down > 0.0 && across.is_finite();
    is_flat.then_some(Lens::Perspective([across, down]))
}

/// A camera at the place of its node, along −z and with y up. The view centre is at the distance of
/// the middle of the mesh.
fn camera(eye: &Eye, name: Option<NameId>, scene: &Scene) -> Option<Camera> {
    let Eye { place, lens, .. } = eye;
    let forward = (place.matrix3 * DVec3::NEG_Z).try_normalize()?;
    let up = (place.matrix3 * DVec3::Y).try_normalize()?;
    let middle = scene.bounds().map(|(low, high)| 0.5 * low + 0.5 * high);
    let far = middle.map_or(1.0, |middle| (middle - place.translation).length());
    let ahead = middle.map_or(1.0, |middle| (middle - place.translation).dot(forward));
    let distance = [ahead, far, 1.0].into_iter().find(|it| *it > 0.0 && it.is_finite())?;
    let center = place.translation + distance * forward;
    let (projection, half) = match lens {
        Lens::Perspective(half) => (Projection::Perspective, *half),
        // At the distance of the view centre both projections have the same scale.
        Lens::Orthographic(half) => (Projection::Orthographic, half.map(|half| half / distance)),
    };
    let angle = |half: f64| 2.0 * libm::atan(half).to_degrees();
    let angles = half.map(angle);
    let is_usable = place.translation.is_finite()
        && center.is_finite()
        && center != place.translation
        && angles.iter().all(|angle| 0.0 < *angle && *angle < 180.0);
    is_usable.then_some(Camera {
        name,
        eye: Some(place.translation + DVec3::ZERO),
        center: Some(center + DVec3::ZERO),
        up: Some(up + DVec3::ZERO),
        projection: Some(projection),
        view_angle: Some(angles),
        ..Camera::default()
    })
}

/// A light at the place of its node, along −z. A white face that reflects all light has the
/// luminance E/π; 1 cd/m² is full white, as of emitted light. So a directional light of E lux has
/// the level E/π, and one of I candela at the distance 1 the level I/π.
fn lamp(light: &Value, name: String, place: &DAffine3) -> Option<Lamp> {
    let photometric = light["intensity"].as_f64().unwrap_or(1.0);
    let intensity = photometric.clamp(0.0, f64::MAX) / std::f64::consts::PI;
    let part = |part: f64| if part.is_finite() { part.max(0.0) } else { 0.0 };
    let color = numbers(&light["color"]).unwrap_or([1.0; 3]).map(part);
    let backward = (place.matrix3 * DVec3::Z).try_normalize();
    let local = |beam| LightKind::Local {
        position: place.translation + DVec3::ZERO,
        radius: 0.0,
        reference: Some(1.0),
        beam,
    };
    let kind = match light["type"].as_str()? {
        "directional" => LightKind::Directional(backward? + DVec3::ZERO),
        "point" => local(Beam::Even),
        "spot" => {
            let angle = |key: &str| light["spot"][key].as_f64();
            let outer = angle("outerConeAngle").unwrap_or(std::f64::consts::FRAC_PI_4);
            let outer = outer.to_degrees().clamp(0.0, 180.0);
            let inner = angle("innerConeAngle").unwrap_or(0.0).to_degrees().clamp(0.0, outer);
            let axis = DVec3::ZERO - backward?;
            local(Beam::Spot { axis, degrees: [outer, outer - inner] })
        }
        _ => return None,
    };
    let is_usable = place.translation.is_finite();
    is_usable.then_some(Lamp { name, color, intensity, kind })
}
