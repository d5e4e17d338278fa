"""Scenes."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _core
from ._arrays import Mesh, colors_of, coordinates_of, corners_of, table_of, texture_of, velocities_of
from ._error import Error
from ._picture import Picture
from ._progress import shown
from ._trimesh import meshes_of
from ._words import camera_of, documented, in_python, without_threads, words

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import Doppler, Film, Lorentz, Photon, Reading, Render
    from ._progress import Report

__all__ = ["SCENES", "Scene", "short"]

#: Files in memory, by name.
Files = dict[str, bytes]
#: Options, path, text and files of a scene that was read.
_Origin = tuple[list[str], Union[os.PathLike[str], str, None], bytes, list[tuple[str, bytes]]]

#: The examples that are scenes or meshes.
SCENES = {file: about for file, about in _core.examples() if file.endswith((".ug", ".obj", ".gltf"))}


def short(file: str) -> str:
    """The name of an example."""
    return file[:-3] if file.endswith(".ug") else file


class Scene:
    """A scene of bodies, lights and cameras, which does not change: its methods return others.

    >>> import uglorentz as ug
    >>> scene = ug.Scene.parse("v a 4 1 0; v b 5 1 0; v c 5 2 0; f (a b c); cam -ep 0 0 0;")
    >>> seen = scene.lorentz(velocity=(-0.1, 0, 0))
    >>> seen.vertices_as_seen()["position"][0].round(4)      # equation (P3)
    array([4.4345, 1.    , 0.    ])
    """

    __slots__ = ("_files", "_made", "_origin", "_steps", "notes")
    #: Files in memory that it was read with.
    _files: Files
    #: The scene of the compiled module, which one that was unpickled makes when it is needed.
    _made: _core.Scene | None
    _origin: _Origin | None
    #: The command lines of the programs that made it from the one that was read, and the names of their cameras.
    _steps: tuple[tuple[list[str], str | None], ...]

    #: Warnings and notes, a text each.
    notes: list[str]

    def __init__(self) -> None:
        raise TypeError("use Scene.read(path), Scene.parse(text) or Scene.from_arrays(vertices, faces)")

    @classmethod
    def _of(cls, core: _core.Scene, files: Files, steps: Any = (), notes: Sequence[str] = ()) -> Scene:
        scene = object.__new__(cls)
        scene._made, scene._origin, scene._files, scene._steps = core, None, files, steps
        scene.notes = [*notes, *(in_python(note) for note in core.notes)]
        return scene

    @classmethod
    def _read(
        cls, options: Mapping[str, Any], path: str | None, text: bytes | None, files: Files, notes: Sequence[str] = ()
    ) -> Scene:
        options, threads = without_threads(options)
        reading = words("uglorentz", options, is_common=True)[1:]
        core = _core.Scene.read(["read", *reading], path, text, list(files.items()), threads)
        return cls._of(core, files, (), notes)

    @property
    def _scene(self) -> _core.Scene:
        if self._made is None:
            assert self._origin is not None
            made = _core.Scene.read(*self._origin)
            for line, camera in self._steps:
                made = made.filtered(line, camera)
            self._made = made
        return self._made

    @classmethod
    def read(cls, path: str | os.PathLike[str], **options: Unpack[Reading]) -> Scene:
        """Reads a file: UniGrafix, OBJ, PLY, STL, OFF or glTF.

        lax: pass on unknown statements. allow_execute: run programs that the scene names.
        allow_outside: read files that it names outside its folder. limit: "NAME=N", or several.

        Raises `Error` with the line if the scene is wrong, `OSError` if it cannot be read.
        """
        path = os.fspath(path)
        return cls._read(options, "./-" if path == "-" else path, None, {})

    @classmethod
    def parse(
        cls, text: str | bytes, *, files: Mapping[str, bytes] | None = None, **options: Unpack[Reading]
    ) -> Scene:
        """A scene from its text, in UniGrafix or a mesh format. Options as in `read`.

        files: those that the text names, such as pictures, in memory: bytes by name. Others are
        read from the current folder.

        >>> import uglorentz as ug
        >>> try:
        ...     ug.Scene.parse("v a 0 0 0; f (a b);")
        ... except ug.Error as error:
        ...     print(error.message, error.line, error.column)
        vertex `b` is not defined 1 17
        """
        data = text.encode(errors="surrogateescape") if isinstance(text, str) else bytes(text)
        return cls._read(options, None, data, {name: bytes(file) for name, file in (files or {}).items()})

    @classmethod
    def example(cls, name: str, **options: Unpack[Reading]) -> Scene:
        """A scene that comes with the package, with its pictures: `uglorentz.examples()` lists them.

        >>> import uglorentz as ug
        >>> ug.Scene.example("ship")
        <Scene: 1948 vertices, 932 faces, at rest>
        """
        files = [file for file, _ in _core.examples() if file in (name, f"{name}.ug") and file in SCENES]
        text = _core.example(files[0]) if files else None
        if text is None:
            raise Error(f"there is no example {name!r}: examples are {', '.join(map(short, SCENES))}")
        beside = {file: _core.example(file) or b"" for file, _ in _core.examples() if file not in SCENES}
        return cls._read(options, files[0], text, beside)

    @classmethod
    def from_arrays(
        cls,
        vertices: Any,
        faces: Any,
        *,
        colors: Any = None,
        velocities: Any = None,
        vertex_colors: Any = None,
        texture: Any = None,
        texture_coordinates: Any = None,
        extra: str = "",
        **options: Unpack[Reading],
    ) -> Scene:
        """A scene from arrays.

        vertices: rest positions, (n, 3), any unit; times have the same unit, c = 1.
        faces: rows of vertices, counted from 0, counterclockwise seen from outside: (m, 3) or
        (m, k), or a list of faces with different numbers of corners.
        colors: red, green and blue, and alpha if there is a fourth column, encoded for displays, of
        each face (m, 3 or 4) or of all (3 or 4,): numbers from 0 to 1, or uint8 from 0 to 255.
        velocities: fractions of c, of each face (m, 3) or of all (3,).
        vertex_colors: likewise (n, 3 or 4), in the place of colors of faces.
        texture: a picture for all faces: pixels (height, width, 3 or 4) as colors, a picture of
        Pillow, the bytes of a file, or its path. vertex_colors are its factors.
        texture_coordinates: of each vertex, (n, 2), from (0, 0) at the lower left of the picture to
        (1, 1) at the upper right, as in OBJ and trimesh.
        extra: statements of the scene language: lights, cameras, motions.

        Vertices are called v0, v1, … in them. Other options as in `read`.

        >>> import uglorentz as ug
        >>> tile = ug.Scene.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]],
        ...                             colors=(1, 0, 0), velocities=(0.5, 0, 0))
        >>> print(tile)
        <Scene: 3 vertices, 1 face, at rest>
        """
        points = table_of("vertices", vertices, None)
        corners, sizes = corners_of(faces, len(points))
        mesh = Mesh(
            points,
            corners,
            sizes,
            colors_of("colors", colors, len(sizes)),
            velocities_of("velocities", velocities, len(sizes)),
            colors_of("vertex_colors", vertex_colors, len(points)),
        )
        if (texture is None) != (texture_coordinates is None):
            raise Error("texture= and texture_coordinates= are given together")
        if texture is not None:
            if colors is not None:
                raise Error("texture= is the colour of all faces: leave out colors=, or give vertex_colors=")
            coordinates = coordinates_of(texture_coordinates, len(points))
            mesh = mesh._replace(texture=texture_of("texture", texture), coordinates=coordinates)
        return cls._of_meshes([("", mesh)], extra, options)

    @classmethod
    def from_trimesh(
        cls, mesh: Any, *, velocities: Any = None, up: str = "z", extra: str = "", **options: Unpack[Reading]
    ) -> Scene:
        """A scene from a mesh or a scene of trimesh, with its colours and base textures.

        mesh: what has vertices, faces and `visual` as trimesh.Trimesh, or meshes in a graph of
        transforms as trimesh.Scene. velocities: as in `from_arrays`, of the faces of all meshes.
        up: the axis that points up in it, which is "y" if trimesh read it from glTF. extra and
        other options as in `from_arrays`; a vertex of the mesh NAME of several is called NAME_v0.
        """
        meshes, notes = meshes_of(mesh, velocities, up)
        return cls._of_meshes(meshes, extra, options, notes)

    @classmethod
    def _of_meshes(
        cls, meshes: Sequence[tuple[str, Mesh]], extra: str, options: Mapping[str, Any], notes: Sequence[str] = ()
    ) -> Scene:
        text = b"".join(mesh.text(prefix) for prefix, mesh in meshes)
        # Its errors have lines of their own.
        text += b'# 1 "<extra>"\n' + extra.encode() if extra else b""
        files = {mesh.texture.name: mesh.texture.file for _, mesh in meshes if mesh.texture is not None}
        return cls._read(options, None, text, files, notes)

    def _filtered(self, program: str, progress: bool | Report, options: Mapping[str, Any]) -> Scene:
        options, threads = without_threads(options)
        line, camera = words(program, options), camera_of(options)
        with shown(progress) as report:
            core = self._scene.filtered(line, camera, report, threads)
        return Scene._of(core, self._files, (*self._steps, (line, camera)))

    def _drawn(self, program: str, progress: bool | Report, options: Mapping[str, Any]) -> Picture:
        picture = Picture._drawn(self, program, options, progress)
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
        """Draws a film of the scene at rest, as it was read: see `uglorentz.film`."""
        if self._steps:
            raise Error("a film begins with a scene at rest: use the one that was read")
        return _film(output, self._origin or self._scene.origin(), progress, options)

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
        """Writes the scene in UniGrafix, and beside it pictures that it was made with in memory."""
        path, text = os.fspath(path), self._scene.text()
        missing = {}
        for name, data in self._files.items():
            file = os.path.join(os.path.dirname(path), name)
            if f'"{name}"'.encode() not in text or os.path.isabs(name) or ".." in name.split("/"):
                continue
            if not os.path.exists(file):
                missing[file] = data
                continue
            with open(file, "rb") as there:
                if there.read() != data:
                    raise Error(f"{file!r} is there already, with another content: rename it, or use another folder")
        with open(path, "wb") as opened:
            opened.write(text)
        for file, data in missing.items():
            os.makedirs(os.path.dirname(file) or ".", exist_ok=True)
            with open(file, "wb") as opened:
                opened.write(data)

    def __repr__(self) -> str:
        n_vertices, n_faces, _ = self._scene.counts()
        is_seen, is_coloured = self._scene.stage()
        stage = "as seen" if is_seen else "at rest"
        stage += ", colours as seen" if is_coloured else ""
        return f"<Scene: {_count(n_vertices, 'vertices', 'vertex')}, {_count(n_faces, 'faces', 'face')}, {stage}>"

    def __copy__(self) -> Scene:
        copied = object.__new__(Scene)
        copied._made, copied._origin = self._made, self._origin
        copied._files, copied._steps, copied.notes = self._files, self._steps, list(self.notes)
        return copied

    def __deepcopy__(self, _: Any) -> Scene:
        # Nothing else can be changed.
        return self.__copy__()

    def __reduce__(self) -> Any:
        return _restored, (self._origin or self._scene.origin(), self._files, self._steps, self.notes)


def _restored(origin: _Origin, files: Files, steps: Any, notes: list[str]) -> Scene:
    """A scene that was pickled, which is read again from what it was read from then."""
    scene = object.__new__(Scene)
    scene._made, scene._origin = None, origin
    scene._files, scene._steps, scene.notes = files, steps, notes
    return scene


def _count(number: int, many: str, one: str) -> str:
    return f"{number} {one if number == 1 else many}"


def _film(
    output: str | os.PathLike[str],
    origin: _Origin | str,
    progress: bool | Report,
    options: Mapping[str, Any],
) -> list[str]:
    """A film of a scene that was read, or of a file."""
    options, threads = without_threads(options)
    program, *line = words("ugfilm", options)
    file = os.fspath(output)
    reading, path, text, files = ([], origin, None, []) if isinstance(origin, str) else origin
    line = [program, f"--fo={'./-' if file == '-' else file}", *reading[1:], *line]
    with shown(progress) as report:
        return [in_python(note) for note in _core.film(line, path, text, files, report, threads)]
