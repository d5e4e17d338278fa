"""A progress bar for a computation."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
__all__ = ["Report", "shown"]

#: A function that is called with the step, the parts that are done, and all parts, 0 if not known.
Report = Callable[[str, int, int], object]


@contextmanager
def shown(progress: bool | Report) -> Iterator[Report | None]:
    """The function to report to: none, the caller's own, or one that moves a bar of tqdm."""
    if progress is False:
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
