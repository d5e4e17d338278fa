"""Scenes."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._error import Error
from ._picture import Picture
from ._progress import shown
from ._words import camera_of, documented, in_python, words

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import Doppler, Film, Lorentz, Photon, Reading, Render
    from ._progress import Report

__all__ = ["Scene"]


class Scene:
    """A scene of bodies, lights and cameras, which does not change: its methods return others.

    >>> import uglorentz as ug
    >>> scene = ug.Scene.parse("v a 4 1 0; v b 5 1 0; v c 5 2 0; f (a b c); cam -ep 0 0 0;")
    >>> seen = scene.lorentz(velocity=(-0.1, 0, 0))
    >>> seen.vertices_as_seen()["position"][0].round(4)      # equation (P3)
    array([4.4345, 1.    , 0.    ])
    """

    __slots__ = ("_from", "_scene", "notes")
    _from: tuple[str | None, bytes | None, list[str]] | None
    _scene: _core.Scene

    #: Warnings and notes, a text each.
    notes: list[str]

    def __init__(self) -> None:
        raise TypeError("use Scene.read(path), Scene.parse(text) or Scene.from_arrays(vertices, faces)")

    @classmethod
    def _of(cls, core: _core.Scene, origin: Any = None) -> Scene:
        scene = object.__new__(cls)
        scene._scene, scene._from = core, origin
        scene.notes = [in_python(note) for note in core.notes]
        return scene

    @classmethod
    def read(cls, path: str | os.PathLike[str], **options: Unpack[Reading]) -> Scene:
        """Reads a file: UniGrafix, OBJ, PLY, STL, OFF or glTF.

        lax: pass on unknown statements. allow_execute: run programs that the scene names.
        allow_outside: read files that it names outside its folder. limit: "NAME=N", or several.

        Raises `Error` with the line if the scene is wrong, `OSError` if it cannot be read.
        """
        reading = words("uglorentz", options, is_common=True)
        path = os.fspath(path)
        if path == "-":
            path = "./-"
        return cls._of(_core.Scene.read(reading, path=path), (path, None, reading[1:]))

    @classmethod
    def parse(cls, text: str | bytes, **options: Unpack[Reading]) -> Scene:
        """A scene from its text, in UniGrafix or a mesh format. Options as in `read`.

        >>> import uglorentz as ug
        >>> try:
        ...     ug.Scene.parse("v a 0 0 0; f (a b);")
        ... except ug.Error as error:
        ...     print(error.message, error.line, error.column)
        vertex `b` is not defined 1 17
        """
        reading = words("uglorentz", options, is_common=True)
        data = text.encode() if isinstance(text, str) else bytes(text)
        return cls._of(_core.Scene.read(reading, text=data), (None, data, reading[1:]))

    @classmethod
    def from_arrays(
        cls,
        vertices: Any,
        faces: Any,
        *,
        colors: Any = None,
        velocities: Any = None,
        vertex_colors: Any = None,
        extra: str = "",
    ) -> Scene:
        """A scene from arrays.

        vertices: rest positions, (n, 3), any unit; times have the same unit, c = 1.
        faces: rows of vertices, counted from 0, counterclockwise seen from outside: (m, 3) or
        (m, k), or a list of faces with different numbers of corners.
        colors: encoded red, green and blue, 0 to 1, of each face (m, 3) or of all (3,).
        velocities: fractions of c, of each face (m, 3) or of all (3,).
        vertex_colors: (n, 3), in the place of colors of faces.
        extra: statements of the scene language: lights, cameras, motions.

        >>> import uglorentz as ug
        >>> tile = ug.Scene.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]],
        ...                             colors=(1, 0, 0), velocities=(0.5, 0, 0))
        >>> print(tile)
        <Scene: 3 vertices, 1 face, at rest>
        """
        points = _table("vertices", vertices, None)
        corners, sizes = _corners(faces)
        colors = _table("colors", colors, len(sizes))
        velocities = _table("velocities", velocities, len(sizes))
        own = _table("vertex_colors", vertex_colors, None if points is None else len(points))
        text = _core.text_from_arrays(points, corners, sizes, colors, velocities, own)
        return cls.parse(text + extra.encode())

    def _filtered(self, program: str, progress: bool | Report, options: Mapping[str, Any]) -> Scene:
        line = words(program, options)
        with shown(progress) as report:
            return Scene._of(self._scene.filtered(line, camera_of(options), report))

    def _drawn(self, program: str, progress: bool | Report, options: Mapping[str, Any]) -> Picture:
        picture = Picture._drawn(self._scene, program, options, progress)
        if program == "ugrainbow" and self._scene.warning is not None:
            picture.notes.insert(0, in_python(self._scene.warning))
        return picture

    @documented("uglorentz")
    def lorentz(self, *, progress: bool | Report = False, **options: Unpack[Lorentz]) -> Scene:
        """The scene with its vertices where they are seen: equation (P3)."""
        return self._filtered("uglorentz", progress, options)

    @documented("ugdoppler")
    def doppler(self, *, progress: bool | Report = False, **options: Unpack[Doppler]) -> Scene:
        """The scene with its colours as they are seen: equations (P10) to (P12)."""
        return self._filtered("ugdoppler", progress, options)

    @documented("ugrainbow")
    def render(self, *, progress: bool | Report = False, **options: Unpack[Render]) -> Picture:
        """A picture of the scene, usually of one as seen."""
        return self._drawn("ugrainbow", progress, options)

    @documented("ugphoton")
    def photon(self, *, progress: bool | Report = False, **options: Unpack[Photon]) -> Picture:
        """A picture of a scene at rest by tracing rays, with mirrors, glass and shadows."""
        return self._drawn("ugphoton", progress, options)

    @documented("ugfilm")
    def film(
        self, output: str | os.PathLike[str], *, progress: bool | Report = False, **options: Unpack[Film]
    ) -> list[str]:
        """Draws a film of the scene at rest, whose file is read again: see `uglorentz.film`."""
        if self._from is None:
            raise Error("a film begins with a scene at rest: use the one that was read")
        path, text, reading = self._from
        return _film(output, path, text, reading, progress, options)

    def vertices_as_seen(self) -> dict[str, Any]:
        """What is seen at every vertex of a scene that `lorentz` returned, as arrays.

        position: (n, 3), where it is seen (P3). velocity: (n, 3), of its body in the frame of the
        camera, fraction of c. emission_time: (n,), on the clock of the camera. doppler: (n,),
        D (P10). distance: (n,), from the eye. emission_angle_deg, rest_emission_angle_deg: (n,),
        between velocity and light, in the frame of the camera and of the body, NaN at rest.
        """
        if not self._scene.stage()[0]:
            raise Error("the scene is at rest: call lorentz() first")
        return dict(self._scene.measurements())

    @property
    def vertices(self) -> Any:
        """Positions of the vertices, (n, 3)."""
        return self._scene.vertices()

    @property
    def faces(self) -> list[Any]:
        """Rows of the vertices of every face, an array each. Holes are left out."""
        corners, sizes, contours = self._scene.faces()
        parts = np.split(corners, np.cumsum(sizes)[:-1]) if len(sizes) else []
        firsts = np.cumsum(contours) - contours
        return [parts[row] for row in firsts]

    @property
    def names(self) -> list[str]:
        """Names of the vertices."""
        return list(self._scene.names())

    @property
    def cameras(self) -> list[str | None]:
        """Names of the cameras."""
        return list(self._scene.cameras())

    def text(self) -> str:
        """The scene in UniGrafix, as the programs write it."""
        return bytes(self._scene.text()).decode(errors="surrogateescape")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the scene in UniGrafix."""
        with open(path, "wb") as file:
            file.write(self._scene.text())

    def __repr__(self) -> str:
        n_vertices, n_faces, _ = self._scene.counts()
        is_seen, is_coloured = self._scene.stage()
        stage = "as seen" if is_seen else "at rest"
        stage += ", colours as seen" if is_coloured else ""
        return f"<Scene: {_count(n_vertices, 'vertices', 'vertex')}, {_count(n_faces, 'faces', 'face')}, {stage}>"

    def __reduce__(self) -> Any:
        raise TypeError("a scene is not pickled: pass its text()")


def _count(number: int, many: str, one: str) -> str:
    return f"{number} {one if number == 1 else many}"


def _table(name: str, value: Any, n_rows: int | None) -> Any:
    """Numbers as an array (n, 3); one row stands for all."""
    if value is None:
        return None
    table = np.asarray(value)
    if table.dtype == object or not np.can_cast(table.dtype, np.float64, "same_kind"):
        raise TypeError(f"{name}: numbers are expected, not {table.dtype}")
    table = table.astype(np.float64)
    if n_rows is not None and table.shape == (3,):
        table = np.broadcast_to(table, (n_rows, 3))
    if table.ndim != 2 or table.shape[1] != 3 or (n_rows is not None and len(table) != n_rows):
        expected = f"({'n' if n_rows is None else n_rows}, 3)"
        raise Error(f"{name}: the shape is {table.shape} instead of {expected}")
    bad = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(bad):
        raise Error(f"{name}[{bad[0]}] is not finite: {table[bad[0]]}")
    return np.ascontiguousarray(table)


def _corners(faces: Any) -> tuple[Any, Any]:
    """The corners of all faces, one after the other, and the number of corners of each."""
    if isinstance(faces, np.ndarray) and faces.ndim == 2:
        rows: Sequence[Any] = [faces]
        sizes = np.full(len(faces), faces.shape[1], np.int64)
    else:
        rows = [np.asarray(face) for face in faces]
        sizes = np.array([row.size for row in rows], np.int64)
    for row, part in enumerate(rows):
        if part.size and (part.dtype == bool or not np.issubdtype(part.dtype, np.integer)):
            raise TypeError(f"faces: rows of vertices are whole numbers, not {part.dtype}")
        if not (isinstance(faces, np.ndarray) and faces.ndim == 2) and part.ndim != 1:
            raise Error(f"faces[{row}]: the shape is {part.shape} instead of (k,)")
    if (sizes < 3).any():
        raise Error(f"faces[{int(np.flatnonzero(sizes < 3)[0])}] has fewer than 3 corners")
    parts = [part.ravel().astype(np.int64) for part in rows]
    return (np.concatenate(parts) if parts else np.empty(0, np.int64)), sizes


def _film(
    output: str | os.PathLike[str],
    path: str | None,
    text: bytes | None,
    reading: list[str],
    progress: bool | Report,
    options: Mapping[str, Any],
) -> list[str]:
    program, *line = words("ugfilm", options)
    file = os.fspath(output)
    line = [program, f"--fo={'./-' if file == '-' else file}", *reading, *line]
    with shown(progress) as report:
        return [in_python(note) for note in _core.film(line, path, text, report)]
