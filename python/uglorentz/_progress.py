"""A progress bar for a computation."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

__all__ = ["shown"]


@contextmanager
def shown(progress: Any) -> Iterator[Callable[[str, int, int], None] | None]:
    """The function to report to: none, the caller's own, or one that moves a bar of tqdm."""
    if progress is None or progress is False:
        yield None
        return
    if progress is not True:
        yield progress
        return
    from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]

    with tqdm(unit="part", leave=False) as bar:

        def report(step: str, done: int, total: int) -> None:
            if bar.desc != f"{step}: ":
                bar.set_description(step, refresh=False)
                bar.reset(total or None)
            bar.n = min(done, total) if total else done
            bar.refresh()

        yield report
