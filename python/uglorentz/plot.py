"""Channels of pictures as plots with a colour bar. Requires matplotlib."""

from __future__ import annotations

from typing import Any

from ._picture import Picture

__all__ = ["channel"]

_LABELS = {
    "D": "Doppler factor D",
    "time": "emission time",
    "distance": "distance of the emission event",
    "Z": "depth of the emission event",
    "id": "number of the face",
}


def channel(picture: Picture, name: str, ax: Any = None, **options: Any) -> Any:
    """Draws a channel of one number per pixel into axes of matplotlib, and returns them.

    The colours of D diverge about 1, on a logarithmic scale: blue is blueshifted. Pixels where
    nothing is seen are left out. options: those of `imshow`.
    """
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.colors import LogNorm
    from matplotlib.ticker import Locator, LogLocator, MaxNLocator

    if name not in _LABELS:
        raise ValueError(f"a channel of one number per pixel is expected, {', '.join(_LABELS)}, not {name!r}")
    values = picture.channel(name, nothing="mask")
    if ax is None:
        ax = plt.figure().gca()
    ticks: Locator | None = None
    if name == "D":
        most = float(np.ma.max(np.ma.abs(np.ma.log(values)))) if values.count() else 1.0
        most = max(most, 1e-6)
        options = {"norm": LogNorm(np.exp(-most), np.exp(most)), "cmap": "coolwarm_r", **options}
        ticks = LogLocator(subs=(1.0, 1.5, 2.0, 3.0, 5.0, 7.0)) if most > 0.5 else MaxNLocator(5)
    image = ax.imshow(values, **options)
    bar = ax.figure.colorbar(image, ax=ax, label=_LABELS[name], ticks=ticks, format="%g" if ticks else None)
    bar.minorticks_off()
    ax.set_axis_off()
    return ax
