"""Arrays of callers, checked: an error names the argument, the row and its value."""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from . import _core
from ._error import Error

__all__ = ["Mesh", "Texture", "colors_of", "corners_of", "numbers_of", "pixels_of", "png", "table_of", "texture_of"]

#: What colours are, for errors.
_COLORS = "colours are from 0 to 1, or from 0 to 255 in an array of uint8"


class Texture(NamedTuple):
    """A picture on faces."""

    #: The name of its file, which is in memory.
    name: str
    file: bytes
    #: Its mean colour, display-encoded, for pictures that have no textures.
    mean: tuple[float, ...] = (1.0, 1.0, 1.0)
    #: Factors of its linear light, and of alpha.
    factor: tuple[float, ...] = (1.0, 1.0, 1.0, 1.0)
    #: "-blend", "-mask 0.5", or nothing for a picture whose alpha is not used.
    alpha: str = ""

    def statements(self, prefix: str) -> str:
        """The statements of its colour, with the place that errors have: see `mark_rows` in scene.rs."""
        color = f"{prefix}picture"
        if any(mark in self.name for mark in '"\r\n'):
            raise Error(f"texture: the name {self.name!r} has a quotation mark or a line end: rename the file")
        numbers = " ".join(repr(part) for part in self.mean)
        factor = "" if self.factor == (1.0,) * 4 else f" -factor {' '.join(repr(part) for part in self.factor)}"
        of = f" of {prefix[:-1]}" if prefix else ""
        return f'# 0 "<texture{of}>"\nc_rgb {color} {numbers};\nc_tex {color} "{self.name}"{factor} {self.alpha};\n'


class Mesh(NamedTuple):
    """The checked arrays of a mesh. Rows of NaN are those of what has none of a property."""

    vertices: Any
    corners: Any
    sizes: Any
    colors: Any = None
    velocities: Any = None
    vertex_colors: Any = None
    coordinates: Any = None
    texture: Texture | None = None

    def text(self, prefix: str = "") -> bytes:
        """Its statements. prefix: of all names in them, for a scene of several meshes."""
        head = "" if self.texture is None else self.texture.statements(prefix)
        picture = f"{prefix}picture" if head else None
        return head.encode(errors="surrogateescape") + _core.text_from_arrays(
            self.vertices, self.corners, self.sizes, self.colors, self.velocities, self.vertex_colors,
            self.coordinates, prefix, picture,
        )


def numbers_of(name: str, value: Any) -> Any:
    """Numbers as an array."""
    table = np.asarray(value)
    if table.dtype == object or not np.can_cast(table.dtype, np.float64, "same_kind"):
        raise TypeError(f"{name}: numbers are expected, not {table.dtype}")
    return table


def table_of(name: str, value: Any, n_rows: int | None, widths: tuple[int, ...] = (3,)) -> Any:
    """Numbers as an array (n, width), of finite float64; one row stands for all."""
    table = numbers_of(name, value)
    if n_rows is not None and table.ndim == 1 and len(table) in widths:
        table = np.broadcast_to(table, (n_rows, len(table)))
    if table.ndim != 2 or table.shape[1] not in widths or (n_rows is not None and len(table) != n_rows):
        rows = "n" if n_rows is None else n_rows
        expected = " or ".join(f"({rows}, {width})" for width in widths)
        raise Error(f"{name}: the shape is {table.shape} instead of {expected}")
    table = table.astype(np.float64)
    row = _first(~np.isfinite(table).all(axis=1))
    if row is not None:
        raise Error(f"{name}[{row}] is not finite: {table[row].tolist()}")
    return np.ascontiguousarray(table)


def _first(is_wrong: Any) -> int | None:
    """The first wrong row."""
    rows = np.flatnonzero(is_wrong)
    return int(rows[0]) if len(rows) else None


def colors_of(name: str, value: Any, n_rows: int) -> Any:
    """Colours as an array (n, 4), display-encoded from 0 to 1, the last one alpha: uint8 from 0 to
    255 or numbers from 0 to 1, with or without alpha, of all rows or of one that stands for all."""
    if value is None or (np.size(value) == 0 and n_rows > 0):
        # An empty array is what Open3D has for no colours.
        return None
    given = numbers_of(name, value)
    colors = table_of(name, given, n_rows, (3, 4))
    if given.dtype == np.uint8:
        colors = colors / 255.0
    row = _first(((colors < 0.0) | (colors > 1.0)).any(axis=1))
    if row is not None:
        shown = np.broadcast_to(given, colors.shape)[row].tolist()
        raise Error(f"{name}[{row}] is {shown}, and {_COLORS}")
    if colors.shape[1] == 3:
        colors = np.hstack([colors, np.ones((len(colors), 1))])
    return np.ascontiguousarray(colors)


def velocities_of(name: str, value: Any, n_rows: int) -> Any:
    """Velocities as an array (n, 3), slower than light."""
    if value is None:
        return None
    velocities = table_of(name, value, n_rows)
    speeds = np.sqrt((velocities**2).sum(axis=1))
    row = _first(speeds >= 1.0)
    if row is not None:
        raise Error(f"{name}[{row}] is {velocities[row].tolist()}: its speed is {speeds[row]:g}, not below that of light, 1")
    return velocities


def corners_of(faces: Any, n_vertices: int) -> tuple[Any, Any]:
    """The corners of all faces, one after the other, and the number of corners of each."""
    # Vectors of Open3D are arrays in all but name.
    if not isinstance(faces, (list, tuple)):
        faces = np.asarray(faces)
    is_table = isinstance(faces, np.ndarray) and faces.ndim == 2
    rows: Sequence[Any] = [faces] if is_table else [np.asarray(face) for face in faces]
    for row, part in enumerate(rows):
        if part.size and (part.dtype == bool or not np.issubdtype(part.dtype, np.integer)):
            which = "faces: rows" if is_table else f"faces[{row}]: the numbers"
            raise TypeError(f"{which} of vertices are whole numbers, not {part.dtype}")
        if not is_table and part.ndim != 1:
            raise Error(f"faces[{row}]: the shape is {part.shape} instead of (k,)")
    if is_table:
        sizes = np.full(len(faces), faces.shape[1], np.int64)
    else:
        sizes = np.array([row.size for row in rows], np.int64)
    short = _first(sizes < 3)
    if short is not None:
        raise Error(f"faces[{short}] has fewer than 3 corners: {np.asarray(faces[short]).tolist()}")
    parts = [part.ravel() for part in rows]
    corners = np.concatenate(parts) if parts else np.empty(0, np.int64)
    bad = _first((corners < 0) | (corners >= n_vertices))
    if bad is not None:
        row = int(np.searchsorted(np.cumsum(sizes), bad, side="right"))
        raise Error(f"faces[{row}] is {np.asarray(faces[row]).tolist()}: there is no vertex {corners[bad]} among {n_vertices}")
    return corners.astype(np.int64), sizes


def coordinates_of(value: Any, n_vertices: int) -> Any:
    """Texture coordinates from the lower left corner, as those of the scene language, from the upper one."""
    coordinates = table_of("texture_coordinates", value, n_vertices, (2,))
    coordinates[:, 1] = 1.0 - coordinates[:, 1]
    return coordinates


def pixels_of(name: str, value: Any, widths: tuple[int, ...]) -> Any:
    """The pixels of a picture, (height, width, channels)."""
    # Pictures of Pillow with a palette have no colours as arrays.
    if hasattr(value, "convert") and getattr(value, "mode", "RGB") not in ("RGB", "RGBA"):
        value = value.convert("RGBA" if "A" in value.mode or "transparency" in value.info else "RGB")
    pixels = np.asarray(value)
    if pixels.ndim == 2 and 1 in widths:
        pixels = np.repeat(pixels[:, :, None], 3, axis=2)
    if pixels.ndim != 3 or pixels.shape[2] not in widths or 0 in pixels.shape:
        channels = " or ".join(str(width) for width in widths if width > 1)
        raise Error(f"{name}: the shape is {pixels.shape} instead of (height, width, {channels})")
    if pixels.dtype != np.uint8 and not np.issubdtype(pixels.dtype, np.floating):
        raise TypeError(f"{name}: uint8 or floating-point numbers are expected, not {pixels.dtype}")
    return pixels


def texture_of(name: str, value: Any, file: str = "picture") -> Texture:
    """A texture: a file, the bytes of one, or pixels as colours are given, encoded for displays."""
    if isinstance(value, (str, os.PathLike)):
        path = os.fspath(value)
        with open(path, "rb") as opened:
            return Texture(os.path.basename(path), opened.read())
    if isinstance(value, (bytes, bytearray, memoryview)):
        # The bytes say of which kind it is.
        return Texture(f"{file}.png", bytes(value))
    pixels = pixels_of(name, value, (1, 3, 4))
    if pixels.dtype != np.uint8:
        is_wrong = ~((pixels >= 0.0) & (pixels <= 1.0)).all(axis=2)
        if is_wrong.any():
            row, column = map(int, np.argwhere(is_wrong)[0])
            raise Error(f"{name}[{row}, {column}] is {pixels[row, column].tolist()}, and {_COLORS}")
        pixels = np.rint(pixels * 255.0).astype(np.uint8)
    is_seen = pixels.shape[2] == 4 and bool((pixels[:, :, 3] < 255).any())
    return Texture(f"{file}.png", png(pixels), _mean(pixels), alpha="-blend" if is_seen else "")


def _mean(pixels: Any) -> tuple[float, ...]:
    """The colour of the mean light of some pixels, weighted by alpha."""
    levels = np.asarray(srgb(np.arange(256) / 255.0, "srgb_decode"))
    flat = pixels.reshape(-1, pixels.shape[2])
    weights = flat[:, 3].astype(np.float64) if flat.shape[1] == 4 else np.ones(len(flat))
    if not weights.any():
        return (1.0, 1.0, 1.0)
    light = [float((levels[flat[:, channel]] * weights).sum() / weights.sum()) for channel in range(3)]
    return tuple(float(part) for part in np.clip(srgb(np.array(light), "srgb_encode"), 0.0, 1.0))


def srgb(values: Any, formula: str) -> Any:
    """Display-encoded numbers as light, or the other way round."""
    return _core.physics(formula, [np.ascontiguousarray(values, np.float64).reshape(-1, 1)])[:, 0]


def png(pixels: Any) -> bytes:
    """8-bit pixels (height, width, 3 or 4) as PNG, hardly compressed."""

    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    height, width, n_channels = pixels.shape
    rows = np.zeros((height, 1 + n_channels * width), np.uint8)
    rows[:, 1:] = pixels.reshape(height, -1)
    header = struct.pack(">IIBBBBB", width, height, 8, 6 if n_channels == 4 else 2, 0, 0, 0)
    parts = chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)), chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)
