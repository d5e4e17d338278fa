"""Meshes and scenes of trimesh, recognised by what they have: the package is not needed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from ._arrays import Mesh, Texture, colors_of, coordinates_of, corners_of, srgb, table_of, texture_of, velocities_of
from ._error import Error

__all__ = ["meshes_of"]

#: Textures of materials that are not drawn.
_LEFT_OUT = ("emissiveTexture", "normalTexture", "occlusionTexture", "metallicRoughnessTexture")


def meshes_of(subject: Any, velocities: Any, up: str) -> tuple[list[tuple[str, Mesh]], list[str]]:
    """The meshes of a scene with the prefixes of their names, and notes."""
    if up not in ("y", "z"):
        raise Error(f'up= is "y" or "z", not {up!r}')
    notes: list[str] = []
    found: list[tuple[str, Mesh]] = []
    placed = list(_placed(subject))
    n_faces = sum(len(getattr(mesh, "faces", ())) for _, mesh, _ in placed)
    moving = velocities_of("velocities", velocities, n_faces)
    first = 0
    for name, mesh, transform in placed:
        count = len(getattr(mesh, "faces", ()))
        if count == 0:
            notes.append(f"note: geometry {name!r} has no faces, and is left out")
            continue
        part = None if moving is None else np.ascontiguousarray(moving[first : first + count])
        first += count
        prefix = "" if len(placed) == 1 else _prefix(name, {prefix for prefix, _ in found})
        found.append((prefix, _mesh(mesh, transform, up, part, prefix, notes)))
    if not found:
        raise Error("there are no faces to draw: a mesh of trimesh has vertices and faces, a scene has such meshes")
    return found, notes


def _placed(subject: Any) -> Iterator[tuple[str, Any, Any]]:
    """The names, meshes and transforms of a scene; a mesh is one of its own."""
    if hasattr(subject, "geometry") and hasattr(subject, "graph"):
        for node in subject.graph.nodes_geometry:
            transform, name = subject.graph[node]
            yield str(node), subject.geometry[name], np.asarray(transform, np.float64)
    elif hasattr(subject, "vertices") and hasattr(subject, "faces"):
        yield "mesh", subject, np.eye(4)
    else:
        raise TypeError(f"a mesh or a scene of trimesh is expected, not {type(subject).__name__}")


def _prefix(name: str, taken: set[str]) -> str:
    """A prefix for the names of a mesh, which no other one has."""
    plain = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_") or "mesh"
    plain = plain if plain[0].isalpha() else f"mesh_{plain}"
    number, prefix = 1, f"{plain}_"
    while prefix in taken:
        number += 1
        prefix = f"{plain}_{number}_"
    return prefix


def _mesh(mesh: Any, transform: Any, up: str, velocities: Any, prefix: str, notes: list[str]) -> Mesh:
    vertices = table_of("vertices", mesh.vertices, None)
    vertices = vertices @ transform[:3, :3].T + transform[:3, 3]
    if up == "y":
        vertices = np.stack([vertices[:, 0], -vertices[:, 2], vertices[:, 1]], axis=1)
    faces = np.asarray(mesh.faces)
    if np.linalg.det(transform[:3, :3]) < 0.0:
        # A mirror image has its faces the other way round.
        faces = faces[:, ::-1]
    corners, sizes = corners_of(faces, len(vertices))
    made = Mesh(np.ascontiguousarray(vertices), corners, sizes, velocities=velocities)
    visual = getattr(mesh, "visual", None)
    kind = getattr(visual, "kind", None)
    if visual is None or kind is None:
        return made
    if kind == "face":
        return made._replace(colors=colors_of("face_colors", visual.face_colors, len(sizes)))
    if kind == "vertex":
        return made._replace(vertex_colors=colors_of("vertex_colors", visual.vertex_colors, len(vertices)))
    if kind != "texture":
        notes.append(f"note: colours of the kind {kind!r} are left out")
        return made
    material = visual.material
    left_out = [name for name in _LEFT_OUT if getattr(material, name, None) is not None]
    if left_out:
        notes.append(f"note: {', '.join(left_out)} of a material are left out: Scene.read() reads them from a glTF file")
    coordinates, texture, color = visual.uv, *_material(material, f"{prefix}picture")
    if texture is None or coordinates is None:
        return made._replace(colors=colors_of("material", color, len(sizes)))
    return made._replace(texture=texture, coordinates=coordinates_of(coordinates, len(vertices)))


def _material(material: Any, file: str) -> tuple[Texture | None, Any]:
    """The texture of a material, or its colour."""
    if hasattr(material, "baseColorTexture") or hasattr(material, "baseColorFactor"):
        # Factors of glTF are those of light, with 8 bits.
        given = getattr(material, "baseColorFactor", None)
        factor = np.ones(4) if given is None else np.asarray(given, np.float64).ravel()
        if given is not None and np.issubdtype(np.asarray(given).dtype, np.integer):
            factor = factor / 255.0
        factor = np.append(factor, 1.0)[:4]
        picture, mode = getattr(material, "baseColorTexture", None), getattr(material, "alphaMode", None)
        cutoff = getattr(material, "alphaCutoff", None)
        alpha = {"BLEND": "-blend", "MASK": f"-mask {0.5 if cutoff is None else float(cutoff)!r}"}.get(mode or "", "")
        if picture is not None:
            texture = texture_of("baseColorTexture", picture, file)
            return texture._replace(factor=tuple(map(float, factor)), alpha=alpha), None
        opaque = factor[3] if alpha else 1.0
        return None, np.append(np.clip(srgb(factor[:3], "srgb_encode"), 0.0, 1.0), opaque)
    picture = getattr(material, "image", None)
    if picture is not None:
        return texture_of("image", picture, file), None
    color = getattr(material, "diffuse", None)
    return None, color if color is not None else getattr(material, "main_color", None)
