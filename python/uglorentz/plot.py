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

    if name not in _LABELS:
        raise ValueError(f"a channel of one number per pixel is expected, {', '.join(_LABELS)}, not {name!r}")
    found = picture.channels("id", name)
    values = np.ma.masked_where(found["id"] == 0, found[name])
    if ax is None:
        ax = plt.figure().gca()
    if name == "D":
        most = float(np.ma.max(np.ma.abs(np.ma.log(values)))) if values.count() else 1.0
        most = max(most, 1e-6)
        options = {"norm": LogNorm(np.exp(-most), np.exp(most)), "cmap": "coolwarm_r", **options}
    image = ax.imshow(values, **options)
    ax.figure.colorbar(image, ax=ax, label=_LABELS[name])
    ax.set_axis_off()
    return ax
