"""Keyword arguments as the options of the programs, and messages the other way round."""

from __future__ import annotations

import difflib
import inspect
import keyword
import os
import re
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import Any, NamedTuple, TypeVar

from . import _core

#: The method of each program.
METHODS = {
    "uglorentz": "lorentz",
    "ugdoppler": "doppler",
    "ugrainbow": "render",
    "ugphoton": "photon",
    "ugwarp": "warp",
    "ugfilm": "film",
}

#: Options that write files or reports, or have no effect; that of threads is a keyword of all functions.
LEFT_OUT = {"fi", "fo", "fm", "qt", "vb", "nt", "at", "explain", "needs", "pv", "cn", "print", "help", "version"}


class Option(NamedTuple):
    """An option of a program."""

    #: Its name for the program, without dashes.
    word: str
    #: Its names as keywords, the longest first.
    names: tuple[str, ...]
    #: The names of its values.
    values: tuple[str, ...]
    #: How many of them are needed.
    n_needed: int
    #: True if the last value may be repeated.
    is_repeated: bool
    #: The words that are valid.
    choices: tuple[str, ...]
    default: str
    about: str
    details: tuple[str, ...]
    #: True of options of reading.
    is_common: bool

    @property
    def keyword(self) -> str:
        """The name that the documentation uses."""
        return self.names[0]


def as_keyword(name: str) -> str:
    name = name.lstrip("-").replace("-", "_")
    # `in` and `from` are words of the language.
    return f"{name}_" if keyword.iskeyword(name) else name


@lru_cache(maxsize=None)
def options(program: str) -> tuple[Option, ...]:
    """The options of a program that are keywords."""
    found = []
    for entry in _core.options(program):
        names = [as_keyword(name) for name in entry["names"]]
        if LEFT_OUT.intersection(names):
            continue
        first = entry["names"][0].lstrip("-")
        ordered = sorted(names, key=lambda name: (name == names[0] and len(name) <= 4, -len(name)))
        found.append(
            Option(
                first,
                tuple(ordered),
                tuple(entry["values"]),
                entry["n_needed"],
                entry["is_repeated"],
                tuple(entry["words"]),
                entry["default"],
                entry["about"],
                tuple(entry["details"]),
                entry["is_common"],
            )
        )
    return tuple(found)


@lru_cache(maxsize=None)
def by_name(program: str, is_common: bool) -> dict[str, Option]:
    """The options of a program by their keywords. Those that read files have the ones of reading, too."""
    reads = program in ("ugwarp", "ugfilm")
    chosen = (option for option in options(program) if option.is_common == is_common or reads)
    return {name: option for option in chosen for name in option.names}


def number(value: Any) -> str:
    """A number as text that reads back to the same bits."""
    if isinstance(value, bool):
        raise TypeError(f"a number is expected, not {value}")
    if hasattr(value, "__index__"):
        return str(value.__index__())
    text = repr(float(value))
    return text[:-2] if text.endswith(".0") else text


def flat(value: Any) -> Iterable[str]:
    """The words of a value: text, a path, a number, or a sequence of these."""
    if isinstance(value, (str, os.PathLike)):
        return [os.fspath(value)]
    if isinstance(value, Iterable):
        return [word for part in value for word in flat(part)]
    if not hasattr(value, "__float__") and not hasattr(value, "__index__"):
        raise TypeError(f"a number, a text or a sequence is expected, not {type(value).__name__}")
    # An array without dimensions is not iterated.
    return [number(value)]


def over_time(option: Option, value: Any) -> Any:
    """The value of an option of a film: sequences become texts with several values over its time.

    A number has a sequence, `time=range(10)`; several numbers have a sequence of rows,
    `velocity=[(0, 0, 0), (0.9, 0, 0)]`, or sequences among them, `velocity=([0, 0.9], 0, 0)`.
    """
    if isinstance(value, (str, os.PathLike)) or not isinstance(value, Iterable) or not getattr(value, "shape", (1,)):
        return value
    parts = list(value)
    is_list = [isinstance(part, Iterable) and not isinstance(part, str) for part in parts]
    if len(option.values) == 1 and not option.is_repeated:
        # The frames of `only`, and names, are lists at one time.
        if option.keyword in ("only", "channels", "limit") or any(isinstance(part, str) for part in parts):
            return value
        return "..".join(flat(parts))
    if not any(is_list):
        return value
    if not all(is_list):
        return ["..".join(flat(part)) for part in parts]
    rows = [list(flat(part)) for part in parts]
    for idx, row in enumerate(rows):
        if len(row) < option.n_needed or len(row) > len(option.values) and not option.is_repeated:
            shown = f"({', '.join(row)})"
            raise TypeError(f"{option.keyword}[{idx}] is {shown}: {' '.join(option.values)} are expected")
    if len(rows) == 1:
        return rows[0]
    return " .. ".join(" ".join(row) for row in rows)


def words_of(option: Option, value: Any) -> list[str]:
    """The words of an option."""
    dashed = f"--{option.word}"
    if value is None or value is False:
        return []
    if not option.values:
        if value is not True:
            raise TypeError(f"{option.keyword}= is True or False, not {value!r}")
        return [dashed]
    if value is True:
        if option.n_needed:
            raise TypeError(f"{option.keyword}= needs {' '.join(option.values)}, not True")
        return [dashed]
    words = list(flat(value))
    if len(option.values) > 1 or option.is_repeated:
        if len(words) > len(option.values) and not option.is_repeated:
            raise TypeError(f"{option.keyword}= is {' '.join(option.values)}, not {len(words)} values")
        options_among = [word for word in words if re.match(r"--?[a-zA-Z]", word)]
        if options_among:
            raise TypeError(f"{option.keyword}= has the value {options_among[0]!r}")
        return [dashed, *words]
    if option.keyword == "limit":
        return [f"{dashed}={word}" for word in words]
    return [f"{dashed}={','.join(words)}"]


def words(program: str, given: Mapping[str, Any], *, is_common: bool = False) -> list[str]:
    """The command line of a program without its input. Keywords that are None are left out."""
    known = by_name(program, is_common)
    line = [program]
    seen: dict[str, str] = {}
    for name, value in given.items():
        option = known.get(name)
        if option is None:
            near = difflib.get_close_matches(name, known, 1)
            hint = f"; did you mean {near[0]}=?" if near else ""
            method = "read" if is_common else METHODS[program]
            raise TypeError(f"{method}() has no keyword {name}={hint}")
        if seen.setdefault(option.word, name) != name:
            raise TypeError(f"{seen[option.word]}= and {name}= are the same option")
        try:
            line += words_of(option, over_time(option, value) if program == "ugfilm" else value)
        except TypeError as error:
            text = str(error)
            raise TypeError(text if name in text or "=" in text else f"{name}=: {text}") from None
    return line


def without_threads(given: Mapping[str, Any]) -> tuple[dict[str, Any], int | None]:
    """Keywords without `threads`, and its number."""
    rest = dict(given)
    threads = [rest.pop(name) for name in ("threads", "nt") if name in rest]
    if len(threads) > 1:
        raise TypeError("threads= and nt= are the same option")
    if not threads or threads[0] is None:
        return rest, None
    (wanted,) = threads
    if isinstance(wanted, bool) or not hasattr(wanted, "__index__"):
        raise TypeError(f"threads= is a whole number, not {wanted!r}")
    if not 1 <= wanted.__index__() <= 1024:
        from ._error import Error

        raise Error(f"threads= is from 1 to 1024, or None for all of the machine, not {wanted}")
    return rest, int(wanted.__index__())


#: What the keyword of all functions does.
THREADS = "N. Use N threads [default: all]. The result does not depend on it"


def camera_of(given: Mapping[str, Any]) -> str | None:
    """The name of the camera among keywords."""
    camera = given.get("camera", given.get("cam"))
    return None if camera is None else str(camera)


@lru_cache(maxsize=None)
def spellings() -> dict[str, Option]:
    """The options of all programs by their names for a shell."""
    found: dict[str, Option] = {}
    for program in METHODS:
        for option in options(program):
            for name in option.names:
                found.setdefault(name.strip("_").replace("_", "-"), option)
    return found


#: Lines of a message with the place and the text of a row of an array: see `mark_rows` in scene.rs.
ROW = re.compile(r"\n *(-->|:::) <(?P<array>vertices|faces|texture|colors)(?P<of> of [^>]*)?>:(?P<row>\d+):\d+(\n *\d* *\|.*)*")


def of_rows(text: str) -> str:
    """A message that names rows of arrays, in place of a text that the package wrote."""

    def reworded(part: str) -> str:
        first = []

        def place(found: re.Match[str]) -> str:
            # Statements of colours are not in the order of rows.
            number = f"[{found['row']}]" if found["array"] in ("vertices", "faces") else ""
            row = f"{found['array']}{number}{found['of'] or ''}"
            if found[1] == "-->":
                first.append(row)
                return ""
            return f"\n  ::: {row}"

        part = ROW.sub(place, part)
        if not first:
            return part
        part = re.sub(r"^((?:error|warning): )?", rf"\g<1>{first[0]}: ", part, count=1)
        return re.sub(r"\n *\|(?=\n|$)", "", part)

    return "".join(map(reworded, re.split(r"(?m)^(?=(?:error|warning): )", text)))


def in_python(text: str) -> str:
    """A message of a program with keywords in the place of options, and methods of programs."""
    if "--> <" in text:
        text = of_rows(text)

    def keyword_of(match: re.Match[str]) -> str:
        option = spellings().get(match["name"])
        if option is None:
            return match[0]
        rest = match["rest"]
        if match["word"] is not None:
            rest = rest[: -len(match["word"]) - 1]
        if not option.values:
            return f"{option.keyword}=True{rest}"
        numbers = rest.split()
        if numbers and len(numbers) <= len(option.values):
            value = numbers[0] if len(option.values) == 1 else f"({', '.join(numbers)})"
            return f"{option.keyword}={value}"
        if match["word"] is not None:
            return f'{option.keyword}="{match["word"]}"'
        return f"{option.keyword}={rest}"

    if "`" in text:
        # Statements of a scene are quoted; options are, too, and begin with a dash.
        parts = text.split("`")
        parts = [in_python(part) if row % 2 == 0 or part[:1] == "-" else part for row, part in enumerate(parts)]
        # The names of values, as in `-vel X Y Z`.
        named = re.compile(r"^(\w+=) (\w+(?: \w+)+)$")
        return "`".join(named.sub(lambda of: f"{of[1]}({of[2].replace(' ', ', ')})", part) for part in parts)
    text = re.sub(r"(?<![\w-])-fo\b", "output", text)
    value = r"(?: (?:-?\d*\.?\d+(?:e-?\d+)?)(?![\w.]*\w))*"
    value = rf"{value}(?: (?P<word>auto|off|light|shape|filmic|center|exr|png|svg|strip|cross|[a-z]+=N)\b)?"
    if "\n" in text:
        # Lines of a scene are shown as they are.
        is_code = re.compile(r"\s*\d*\s*\||\s*-->")
        return "\n".join(line if is_code.match(line) else in_python(line) for line in text.split("\n"))
    text = re.sub(rf"(?<![\w/.<-])--?(?P<name>[a-z][a-z0-9-]*[a-z0-9]|w)(?P<rest>{value})", keyword_of, text)
    for program, method in METHODS.items():
        text = re.sub(rf"\b{program}\b(?!\.)", f"{method}()", text)
    return text


_Function = TypeVar("_Function", bound=Callable[..., Any])


def documented(program: str) -> Callable[[_Function], _Function]:
    """Adds the options of a program to the signature and the documentation of a function."""

    def document(function: _Function) -> _Function:
        shown = [option for option in options(program) if not option.is_common]
        signature = inspect.signature(function)
        fixed = [part for part in signature.parameters.values() if part.kind is not part.VAR_KEYWORD]
        names = ["threads", *(option.keyword for option in shown)]
        added = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None) for name in names]
        function.__signature__ = signature.replace(parameters=[*fixed, *added])  # type: ignore[attr-defined]
        lines = [f"    threads: {THREADS}"]
        lines += [f"    {option.keyword}: {summary(option)}" for option in shown]
        function.__doc__ = f"{inspect.getdoc(function)}\n\nOptions:\n" + "\n".join(lines)
        return function

    return document


def summary(option: Option) -> str:
    """What an option does, in one line."""
    values = " ".join(option.values) or "True"
    default = f" [default: {in_python(option.default)}]" if option.default else ""
    # Lines of a file have options as in a shell.
    about = option.about if option.values == ("FILE",) else in_python(option.about)
    return f"{values}. {about}{default}"
