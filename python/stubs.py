"""Writes uglorentz/_options.pyi, the types of all keyword arguments, from the options of the programs."""

from __future__ import annotations

from pathlib import Path

from uglorentz._words import METHODS, THREADS, Option, options, summary

FILE = Path(__file__).parent / "uglorentz" / "_options.pyi"

HEAD = '''\
# Written by stubs.py from the options of the programs; do not edit.
import os
from collections.abc import Sequence
from typing import Any, Literal, TypedDict, Union

import numpy as np

Vector = Union[Sequence[float], np.ndarray[Any, Any]]
Values = Union[Vector, Sequence[Vector]]
Text = Union[str, os.PathLike[str]]
'''

THREADED = f'''    threads: int | None
    """{THREADS}"""
    nt: int | None
    """The same as threads."""
'''

#: Values that are text.
TEXTS = {"TEXT", "NAME", "FILE", "NAMES", "FRAME", "LAW", "FILTER", "CURVE", "FMT", "LOOK", "WORD", "HOW", "KIND", "SKY"}


def type_of(program: str, option: Option) -> str:
    if not option.values:
        return "bool"
    if option.keyword in ("channels", "limit"):
        return "str | Sequence[str]"
    if option.values[0] == "QUANTITY":
        return "str | Sequence[str | float]"
    # Over the time of a film, sequences have values of sequences.
    vector = "Values" if program == "ugfilm" else "Vector"
    if option.is_repeated:
        return f"{vector} | str"
    if option.values[0] in TEXTS or option.keyword == "only":
        return "Text"
    several = vector if len(option.values) > 1 else "Vector" if program == "ugfilm" else ""
    # Over the time of a film, numbers may be texts.
    single = "float | str" if program == "ugfilm" or option.values[0] not in ("X", "Y", "W", "H") else ""
    if option.n_needed > 1 and program != "ugfilm":
        single = ""
    bare = "bool" if option.n_needed == 0 else ""
    return " | ".join(kind for kind in (several, single, bare) if kind) or "float"


def keys(program: str, chosen: list[Option]) -> str:
    lines = []
    for option in chosen:
        text = summary(option).replace("\\", "\\\\").replace('"""', "'''")
        first, *others = option.names
        lines.append(f'    {first}: {type_of(program, option)} | None\n    """{text}"""')
        lines += [f'    {name}: {type_of(program, option)} | None\n    """The same as {first}."""' for name in others]
    return "\n".join(lines)


def stub() -> str:
    parts = [HEAD]
    common = [option for option in options("uglorentz") if option.is_common]
    parts.append(f"class Reading(TypedDict, total=False):\n{THREADED}{keys('uglorentz', common)}\n")
    for program, method in METHODS.items():
        own = [option for option in options(program) if not option.is_common]
        base = "Reading" if program in ("ugwarp", "ugfilm") else "TypedDict"
        threads = "" if base == "Reading" else THREADED
        parts.append(f"class {method.capitalize()}({base}, total=False):\n{threads}{keys(program, own)}\n")
    return "\n".join(parts)


if __name__ == "__main__":
    FILE.write_text(stub())
