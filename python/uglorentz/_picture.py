"""Pictures."""

from __future__ import annotations

import copy
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _core
from ._arrays import pixels_of, png
from ._error import Error
from ._progress import shown
from ._words import by_name, camera_of, documented, in_python, without_threads, words

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import Warp
    from ._progress import Report
    from ._scene import Scene

__all__ = ["Picture", "warp"]

#: Formats that hold light.
_LINEAR = ("exr", "pfm", "hdr")


class _Sky:
    """A panorama or stars, read when they are needed."""

    __slots__ = ("_arguments", "_made")
    _arguments: tuple[list[str], list[str], bytes | None]
    _made: _core.Sky | None

    def __init__(self, *arguments: Any) -> None:
        self._arguments, self._made = arguments, None

    @property
    def _scene(self) -> _core.Sky:
        if self._made is None:
            self._made = _core.Sky.read(*self._arguments)
        return self._made

    def __reduce__(self) -> Any:
        return _Sky, self._arguments


class _Kept:
    """The file and the arrays of a picture that was pickled, in the place of its drawing."""

    def __init__(self, line: str, file: bytes, arrays: dict[str, Any]) -> None:
        self.line, self._file, self._arrays = line, file, arrays

    def file(self) -> bytes:
        return self._file

    def pixels(self) -> Any:
        return self._arrays["pixels"].copy()

    def light(self) -> Any:
        return self._arrays["light"].copy()

    def planes(self) -> dict[str, Any]:
        return dict(self._arrays["planes"])


class Picture:
    """A picture that `Scene.render`, `Scene.photon` or `warp` has drawn.

    It is drawn in one format, PNG unless `format=` says otherwise, and drawn again when light,
    channels or files of other formats are needed that this format does not hold. With
    `format="exr", channels=("D", "time")` all of them come from one drawing.

    >>> import numpy as np, uglorentz as ug
    >>> scene = ug.Scene.parse("v a 0 -9 -9; v b 0 9 -9; v c 0 0 9; f (a b c); cam -ep 9 0 0 -vc 0 0 0;")
    >>> picture = scene.lorentz(camera_velocity=(-0.6, 0, 0)).render(size=(5, 3), format="exr")
    >>> picture.light.shape, picture.light.dtype
    ((3, 5, 3), dtype('float32'))
    >>> round(float(picture.channel("D")[1, 2]), 2)          # head-on at 0.6c: equation (P10)
    2.0
    """

    __slots__ = ("_drawing", "_options", "_planes", "_program", "_subject", "_threads", "notes")
    _drawing: Union[_core.Drawing, _Kept]
    _options: dict[str, Any]
    _planes: dict[str, Any] | None
    _program: str
    _subject: Union[Scene, _Sky]
    _threads: int | None

    #: Warnings and notes, a text each.
    notes: list[str]

    def __init__(self) -> None:
        raise TypeError("use Scene.render(), Scene.photon() or warp()")

    @classmethod
    def _drawn(cls, subject: Any, program: str, given: Mapping[str, Any], progress: bool | Report = False) -> Picture:
        given, threads = without_threads(given)
        line = words(program, given)
        known = by_name(program, False)
        options = {known[name].keyword: value for name, value in given.items()}
        picture = object.__new__(cls)
        picture._subject, picture._program, picture._options = subject, program, options
        with shown(progress) as report:
            drawing = _core.Drawing(subject._scene, line, camera_of(options), report, threads)
        picture._drawing, picture._planes, picture._threads = drawing, None, threads
        picture.notes = [in_python(note) for note in drawing.notes]
        return picture

    @property
    def _format(self) -> str:
        return str(self._options.get("format") or "png")

    def _as(self, format: str, **options: Any) -> Picture:
        """The same picture in another format, without what the format does not have."""
        if format == self._format and not options:
            return self
        left_out: set[str] = set()
        if format != "exr":
            left_out |= {"channels"}
        if format in _LINEAR:
            # Annotations and what is done to light.
            left_out |= {"exposure", "tone_curve", "caption", "legend", "undistorted", "grid"}
        if format not in ("svg", "pdf", "ps", "eps"):
            left_out |= {"vector", "text"}
        if format not in ("png", "png16"):
            left_out |= {"pack"}
        kept = {name: value for name, value in self._options.items() if name not in left_out}
        if self._threads is not None:
            kept["threads"] = self._threads
        return Picture._drawn(self._subject, self._program, {**kept, **options, "format": format})

    @property
    def light(self) -> Any:
        """Linear light, float32 (height, width, 3): red, green and blue, white is 1; with
        `transparent=True` (height, width, 4), not premultiplied by alpha."""
        return (self if self._format in _LINEAR else self._as("exr"))._drawing.light()

    @property
    def pixels(self) -> Any:
        """The pixels of the PNG file, uint8 (height, width, 3 or 4)."""
        return self._as("png")._drawing.pixels()

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        pixels = self.pixels
        return pixels if dtype is None else pixels.astype(dtype)

    def channels(self, *names: str, nothing: str | None = None) -> dict[str, Any]:
        """Channels at the middle of every pixel, by name.

        nothing: the pixels in which nothing is seen, "nan" for NaN, "mask" for masked arrays
        (`numpy.ma`), else numbers as below; in whole numbers of "id" NaN is 0.

        "D": Doppler factor (P10), 0 where nothing is seen. "time": when the light was emitted, the
        picture is taken at 0; -inf where nothing is seen. "distance": of the emission event from
        the eye, inf where nothing is seen. "Z": its depth. "id": the face, from 1, 0 where nothing
        is seen. "velocity": (height, width, 3), of the body. "direction": (height, width, 3), unit
        vector to what is seen in the frame of the body (P6). float32, but uint32 for "id".
        """
        for name in names:
            if name not in _core.channels():
                raise Error(f"there is no channel {name!r}: channels are {', '.join(_core.channels())}")
        if nothing not in (None, "nan", "mask"):
            raise Error(f'nothing= is "nan", "mask" or None, not {nothing!r}')
        wanted = names
        if nothing is not None and "id" not in names:
            names = (*names, "id")
        planes = self._planes
        drawn = self._options.get("channels") or ()
        drawn = drawn.split(",") if isinstance(drawn, str) else drawn
        if planes is None and self._format == "exr" and set(names) <= set(drawn):
            planes = self._planes = self._drawing.planes()
        if planes is None or not all(name in planes or f"{name}.X" in planes for name in names):
            # All channels cost little more than one.
            planes = self._planes = self._as("exr", channels=_core.channels())._drawing.planes()
        found = {name: _channel(planes, name) for name in wanted}
        if nothing is not None:
            is_nothing = planes["id"] == 0
            found = {name: _without(channel, is_nothing, nothing) for name, channel in found.items()}
        return found

    def channel(self, name: str, nothing: str | None = None) -> Any:
        """One of `channels`."""
        return self.channels(name, nothing=nothing)[name]

    def to_bytes(self, format: str | None = None, **options: Any) -> bytes:
        """The bytes of its file, as the program writes them. format: "png", "exr", "svg", …

        options: keywords of the drawing to change, as `vector=True`.
        """
        return bytes(self._as(format or self._format, **options)._drawing.file())

    def save(self, path: str | os.PathLike[str], **options: Any) -> None:
        """Writes a file, whose ending is the format unless `format=` names it. Options as in `to_bytes`."""
        ending = os.path.splitext(os.fspath(path))[1][1:].lower() or None
        data = self.to_bytes(**{"format": ending, **options})
        with open(path, "wb") as file:
            file.write(data)

    @property
    def command(self) -> str:
        """The command line that the file records."""
        return str(self._drawing.line)

    def __copy__(self) -> Picture:
        copied = object.__new__(Picture)
        for name in self.__slots__:
            setattr(copied, name, getattr(self, name))
        copied.notes = list(self.notes)
        return copied

    def __deepcopy__(self, memo: Any) -> Picture:
        copied = self.__copy__()
        copied._planes, copied._options = copy.deepcopy((self._planes, self._options), memo)
        return copied

    def __reduce__(self) -> Any:
        drawing, arrays = self._drawing, {}
        if self._format == "png":
            arrays["pixels"] = drawing.pixels()
        if self._format in _LINEAR:
            arrays["light"] = drawing.light()
        if self._format == "exr":
            arrays["planes"] = drawing.planes()
        kept = drawing.line, bytes(drawing.file()), arrays
        return _restored, (kept, self._subject, self._program, self._options, self._planes, self._threads, self.notes)

    def _repr_png_(self) -> bytes:
        return self.to_bytes("png")

    def __repr__(self) -> str:
        return f"<Picture: {self.command}>"


def _restored(kept: Any, subject: Any, program: str, options: Any, planes: Any, threads: Any, notes: Any) -> Picture:
    """A picture that was pickled: its file is the same, and other formats are drawn again."""
    picture = object.__new__(Picture)
    picture._drawing, picture._subject, picture._program, picture._options = _Kept(*kept), subject, program, options
    picture._planes, picture._threads, picture.notes = planes, threads, notes
    return picture


def _without(channel: Any, is_nothing: Any, how: str) -> Any:
    """A channel without the pixels in which nothing is seen."""
    where = is_nothing[:, :, None] if channel.ndim == 3 else is_nothing
    if how == "mask":
        return np.ma.masked_where(np.broadcast_to(where, channel.shape), channel)
    return np.where(where, np.float32(np.nan), channel) if channel.dtype.kind == "f" else channel


def _channel(planes: Any, name: str) -> Any:
    if name in planes:
        return planes[name]
    return np.stack([planes[f"{name}.{axis}"] for axis in "XYZ"], axis=-1)


@documented("ugwarp")
def warp(
    sky: Any, *more: str | os.PathLike[str], progress: bool | Report = False, **options: Unpack[Warp]
) -> Picture:
    """The sky as an observer in motion sees it.

    sky: a panorama or a list of stars: a file, the bytes of one, or an array (height, width, 3 or
    4), uint8 as encoded for displays, or floating-point linear light; alpha is not used. more: the
    other sides of a cube.

    >>> import numpy as np, uglorentz as ug
    >>> grey = np.full((32, 64, 3), 0.25, np.float32)
    >>> view = ug.warp(grey, camera_velocity=(0, 0.6, 0), brightness="bolometric", no_doppler=True,
    ...                size=(3, 3), view_angle=1)
    >>> float(view.light[1, 1, 0].round(2))                  # D = 2, and brightness D to the 4th
    4.0
    """
    data, paths = None, list(more)
    if isinstance(sky, (str, os.PathLike)):
        paths.insert(0, sky)
    elif isinstance(sky, (bytes, bytearray, memoryview)):
        data = bytes(sky)
    else:
        data = _file_of(sky)
    rest, threads = without_threads(options)
    line = words("ugwarp", rest)
    files = [("./-" if os.fspath(path) == "-" else os.fspath(path)) for path in paths]
    subject = _Sky(line, files, data)
    picture = Picture._drawn(subject, "ugwarp", options, progress)
    picture.notes[:0] = [in_python(note) for note in subject._scene.notes]
    return picture


def _file_of(array: Any) -> bytes:
    """An array as a file: 8 bits as PNG, light as PFM."""
    pixels = pixels_of("sky", array, (3, 4))[:, :, :3]
    if pixels.dtype == np.uint8:
        return png(pixels)
    is_wrong = ~np.isfinite(pixels).all(axis=2)
    if is_wrong.any():
        row, column = map(int, np.argwhere(is_wrong)[0])
        raise Error(f"sky[{row}, {column}] is not finite: {pixels[row, column].tolist()}")
    height, width, _ = pixels.shape
    # Rows of PFM go from the bottom to the top.
    return b"PF\n%d %d\n-1.0\n" % (width, height) + bytes(pixels[::-1].astype("<f4").tobytes())
