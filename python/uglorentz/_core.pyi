import os
from collections.abc import Callable, Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

_Report = Callable[[str, int, int], object]
_Path = Union[str, os.PathLike[str], None]
_Files = list[tuple[str, bytes]]

class Scene:
    notes: list[str]
    warning: str | None
    @staticmethod
    def read(
        words: list[str],
        path: _Path = None,
        text: bytes | None = None,
        files: _Files = ...,
        threads: int | None = None,
    ) -> Scene: ...
    def filtered(
        self,
        words: list[str],
        camera: str | None = None,
        progress: _Report | None = None,
        threads: int | None = None,
    ) -> Scene: ...
    def origin(self) -> tuple[list[str], _Path, bytes, _Files]: ...
    def text(self) -> bytes: ...
    def counts(self) -> list[int]: ...
    def stage(self) -> list[bool]: ...
    def cameras(self) -> list[str | None]: ...
    def names(self) -> list[str]: ...
    def vertices(self) -> npt.NDArray[np.float64]: ...
    def faces(self) -> list[npt.NDArray[np.uint32]]: ...
    def measurements(self) -> dict[str, npt.NDArray[np.float64]]: ...

class Sky:
    notes: list[str]
    @staticmethod
    def read(words: list[str], paths: Sequence[str], data: bytes | None = None, threads: int | None = None) -> Sky: ...

class Drawing:
    notes: list[str]
    line: str
    def __init__(
        self,
        subject: Scene | Sky,
        words: list[str],
        camera: str | None = None,
        progress: _Report | None = None,
        threads: int | None = None,
    ) -> None: ...
    def file(self) -> bytes: ...
    def pixels(self) -> npt.NDArray[np.uint8]: ...
    def light(self) -> npt.NDArray[np.float32]: ...
    def planes(self) -> dict[str, npt.NDArray[Any]]: ...

def film(
    words: list[str],
    path: _Path = None,
    text: bytes | None = None,
    files: _Files = ...,
    progress: _Report | None = None,
    threads: int | None = None,
) -> list[str]: ...
def physics(name: str, arguments: list[npt.NDArray[np.float64]]) -> npt.NDArray[np.float64]: ...
def text_from_arrays(
    vertices: npt.NDArray[np.float64],
    corners: npt.NDArray[np.int64],
    sizes: npt.NDArray[np.int64],
    colors: npt.NDArray[np.float64] | None = None,
    velocities: npt.NDArray[np.float64] | None = None,
    vertex_colors: npt.NDArray[np.float64] | None = None,
    coordinates: npt.NDArray[np.float64] | None = None,
    prefix: str = "",
    own: str | None = None,
) -> bytes: ...
def options(name: str) -> list[dict[str, Any]]: ...
def formats() -> list[str]: ...
def channels() -> list[str]: ...
def examples() -> list[tuple[str, str]]: ...
def example(name: str) -> bytes | None: ...
