"""Special relativity as pictures: what moves nearly as fast as light looks like this.

>>> import uglorentz as ug
>>> scene = ug.Scene.parse("c red 1 0 1; v a 0 0 0; v b 1 0 0; v c 0 0 1; f (a b c) red;")
>>> picture = scene.lorentz(velocity=(0.5, 0, 0), keep_in_view=True).doppler(look="light").render(size=(64, 48))
>>> picture.pixels.shape
(48, 64, 3)

Keyword arguments are the options of the programs uglorentz, ugdoppler, ugrainbow, ugphoton, ugwarp
and ugfilm; `options("lorentz")` prints them. Units: c = 1, velocities are fractions of c, times and
lengths share a unit, angles of options are in degrees. Equation numbers are those of the project's
docs/physics.md.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from . import _core, physics, plot
from ._error import Error
from ._picture import Picture, warp
from ._scene import SCENES, Scene, _film, short
from ._words import METHODS, documented
from ._words import options as _options

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import Film
    from ._progress import Report

__all__ = [
    "Error", "Picture", "Scene", "example_file", "examples", "film", "options", "physics", "plot", "warp",
]
__version__ = "0.1.0"


@documented("ugfilm")
def film(
    subject: Scene | str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    progress: bool | Report = False,
    **options: Unpack[Film],
) -> list[str]:
    """Draws a film of a scene at rest, or with `warp=True` of a panorama. Returns the notes.

    subject: a scene, or a file. output: film.apng, film.gif, film.mp4, or numbered frames,
    frame_%04d.png. Any number among the options may be a text with several values over the film,
    as `time="-10..10"` or a sequence of them, `time=range(-10, 11)`. Of several numbers it is a
    sequence of rows, `camera_velocity=[(0, 0, 0), (0, 0.9, 0)]`, which may be an array.
    """
    if isinstance(subject, Scene):
        return subject.film(output, progress=progress, **options)
    return _film(output, os.fspath(subject), progress, options)


def examples() -> dict[str, str]:
    """The names of the scenes that come with the package, and what each shows: see `Scene.example`.

    >>> import uglorentz as ug
    >>> print(ug.examples()["cubes"])
    Two cubes of tiles, after figure 9 of Chang, Lai and Chen (1996)
    """
    return {short(file): about for file, about in SCENES.items()}


def example_file(name: str) -> bytes:
    """The bytes of a file that comes with the package: a scene, "stars.csv" or a picture of a scene.

    >>> import uglorentz as ug
    >>> ug.warp(ug.example_file("stars.csv"), camera_velocity=(0, 0.9, 0), size=(64, 48)).pixels.shape
    (48, 64, 3)
    """
    data = _core.example(name)
    if data is None:
        raise Error(f"there is no file {name!r}: files are {', '.join(file for file, _ in _core.examples())}")
    return data


def options(method: str) -> None:
    """Prints the keyword arguments of "lorentz", "doppler", "render", "photon", "warp", "film"."""
    programs = {name: program for program, name in METHODS.items()}
    if method not in programs:
        raise Error(f"there are no options of {method!r}, but of {', '.join(programs)}")
    for option in _options(programs[method]):
        if not option.is_common:
            default = f" [default: {option.default}]" if option.default else ""
            print(f"{' / '.join(option.names)}= {' '.join(option.values) or 'True'}\n    {option.about}{default}")
