"""The exception of the package."""

from __future__ import annotations

import re

from ._words import in_python

__all__ = ["Error"]


class Error(ValueError):
    """A scene or an option is wrong, or a scene cannot be drawn.

    The text of the exception is the whole message, with the line of the scene it is about.
    """

    #: What is wrong, in one sentence.
    message: str
    #: The name of the file or text, of an error in a scene.
    file: str | None = None
    #: The line, from 1, of an error in a scene.
    line: int | None = None
    #: The column in bytes, from 1, of an error in a scene.
    column: int | None = None
    #: What to do, of an error that has a remedy.
    remedy: str | None = None

    def __init__(self, text: str) -> None:
        super().__init__(text)
        first = text.split("\n", 1)[0]
        self.message = re.sub(r"^error: ", "", first)

    @classmethod
    def _of(cls, text: str, place: tuple[str, int, int] | None, remedy: str | None) -> Error:
        """An error of the compiled module, which names options as a shell does."""
        text = re.sub(r"\x1b\[[0-9;]*m", "", text)
        error = cls(in_python(text))
        # Rows of arrays have their place in the message.
        if place is not None and not re.match(r"<(vertices|faces|texture|colors)\b", place[0]):
            error.file, error.line, error.column = place
        message, _, rest = error.message.partition("; ")
        error.remedy = in_python(remedy) if remedy is not None else (rest or None)
        if rest and remedy is None:
            error.message = message
        return error
