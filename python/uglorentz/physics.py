"""The formulas of special relativity and of colour, for arrays.

c = 1: velocities are fractions of c, and times and lengths share a unit. Positions are relative to
the eye. A body rests in a frame S' that moves with `velocity` in the frame S of the eye; the axes
are parallel, and the origins coincide at time 0, when the picture is taken. Equation numbers are
those of docs/physics.md. For the velocity that is given, as rounded, every function is exact to a few
units in the last place; near c that rounding changes γ by about γ² units.

Vectors are arrays (…, 3), numbers arrays (…); leading axes are broadcast against each other, and
the result is a float64 array of their shape. A velocity of c or above raises `uglorentz.Error`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core
from ._error import Error


def _of(name: str, vectors: tuple[Any, ...] = (), numbers: tuple[Any, ...] = ()) -> Any:
    """A formula of vectors and then numbers, broadcast."""
    arrays = []
    for value in (*vectors, *numbers):
        array = np.asarray(value)
        if array.dtype == object or not np.can_cast(array.dtype, np.float64, "same_kind"):
            raise TypeError(f"{name}: numbers are expected, not {array.dtype}")
        arrays.append(array.astype(np.float64))
    for array in arrays[: len(vectors)]:
        if array.shape[-1:] != (3,):
            raise Error(f"{name}: a vector has the shape (…, 3), not {array.shape}")
    widths = [3] * len(vectors) + [1] * len(numbers)
    leads = [array.shape[:-1] if width == 3 else array.shape for array, width in zip(arrays, widths)]
    try:
        shape = np.broadcast_shapes(*leads)
    except ValueError:
        raise Error(f"{name}: the shapes {', '.join(map(str, leads))} do not broadcast") from None
    flat = []
    for array, width in zip(arrays, widths):
        full = (*shape, 3) if width == 3 else shape
        flat.append(np.ascontiguousarray(np.broadcast_to(array, full)).reshape(-1, width))
    result = _core.physics(name, flat)
    return result.reshape(shape if result.shape[1] == 1 else (*shape, result.shape[1]))[()]


def contracted(rest: Any, velocity: Any) -> Any:
    """Where a point of a body is at the time of the picture: length contraction. Equation (P1)

    >>> contracted([1, 1, 0], [0.6, 0, 0])
    array([0.8, 1. , 0. ])
    """
    return _of("contracted", (rest, velocity))


def seen_position(rest: Any, velocity: Any) -> Any:
    """Where a point of a body is seen: its retarded position. Equation (P3)

    rest: its position in the rest frame of the body.

    >>> seen_position([4, 1, 0], [-0.1, 0, 0]).round(4)
    array([4.4345, 1.    , 0.    ])
    """
    return _of("seen_position", (rest, velocity))


def emission_time(rest: Any, velocity: Any) -> Any:
    """When the light left that is seen at time 0: minus the distance at which it is seen. Equation (P3)

    >>> emission_time([0, 1, 0], [0.6, 0, 0])
    np.float64(-1.25)
    """
    return _of("emission_time", (rest, velocity))


def rest_position(seen: Any, velocity: Any) -> Any:
    """The inverse of `seen_position`. Equation (P4)

    >>> rest_position(seen_position([4, 1, 2], [0.9, 0.3, 0]), [0.9, 0.3, 0]).round(12)
    array([4., 1., 2.])
    """
    return _of("rest_position", (seen, velocity))


def aberrate(direction: Any, velocity: Any) -> Any:
    """The viewing direction in the frame that moves with `velocity`, a unit vector. Equation (P6)

    direction: from the eye to what is seen, of any length.

    >>> aberrate([0, 1, 0], [0.5, 0, 0]).round(6)           # 60 degrees from straight ahead
    array([0.5     , 0.866025, 0.      ])
    """
    return _of("aberrate", (direction, velocity))


def doppler_factor(to_observer: Any, velocity: Any) -> Any:
    """Doppler factor D = observed by emitted frequency. Equation (P10)

    to_observer: direction of the light in the frame of the observer, of any length.

    >>> doppler_factor([[1, 0, 0], [0, 1, 0], [-1, 0, 0]], [0.6, 0, 0])
    array([2. , 0.8, 0.5])
    """
    return _of("doppler_factor", (to_observer, velocity))


def doppler_at(seen: Any, velocity: Any) -> Any:
    """Doppler factor of a point that is seen at the position `seen`. Equation (P10)

    >>> doppler_at(seen_position([0, 2, 0], [0.6, 0, 0]), [0.6, 0, 0])
    np.float64(1.25)
    """
    return _of("doppler_factor", (np.negative(seen), velocity))


def compose(u: Any, v: Any) -> Any:
    """The velocity of a body that moves with u in a frame that moves with v. Equation (P15)

    >>> compose([0.5, 0, 0], [0.5, 0, 0])
    array([0.8, 0. , 0. ])
    """
    return _of("compose", (u, v))


def wigner_rotation(u: Any, v: Any) -> Any:
    """The rotation of the boosts with u and then v, as a quaternion (…, 4): x, y, z, w. Equation (P25)

    >>> angle = 2 * np.arccos(wigner_rotation([0.6, 0, 0], [0, 0.6, 0])[3])
    >>> bool(np.isclose(np.cos(angle), (1.25 + 1.25) / (1 + 1.25 * 1.25)))
    True
    """
    return _of("wigner_rotation", (u, v))


def boost(velocity: Any) -> Any:
    """The matrix (…, 4, 4) from the body's (t', x', y', z') to (t, x, y, z). Equation (P7)

    >>> boost([0.6, 0, 0])[:2, :2]
    array([[1.25, 0.75],
           [0.75, 1.25]])
    """
    matrix = _of("boost", (velocity,))
    return matrix.reshape((*matrix.shape[:-1], 4, 4))


def gamma(velocity: Any) -> Any:
    """Lorentz factor.

    >>> gamma([0, 0.6, 0])
    np.float64(1.25)
    """
    return _of("gamma", (velocity,))


def rapidity(velocity: Any) -> Any:
    """Rapidity, artanh of the speed.

    >>> rapidity([[0, 0, 0], [0, 0, np.tanh(2)]]).round(12)
    array([0., 2.])
    """
    return _of("rapidity", (velocity,))


def from_rapidity(direction: Any, rapidity: Any) -> Any:
    """The velocity with a rapidity in a direction of any length.

    >>> from_rapidity([0, 5, 0], np.arctanh(0.6)).round(12)
    array([0. , 0.6, 0. ])
    """
    return _of("from_rapidity", (direction,), (rapidity,))


def brightness(doppler: Any, law: str = "report") -> Any:
    """The factor on brightness: "report" D, "photon" D³, "bolometric" D⁴, "none" 1. Equation (P12)

    >>> brightness([0.5, 2], "bolometric")
    array([ 0.0625, 16.    ])
    """
    if law not in ("report", "photon", "bolometric", "none"):
        raise Error(f"there is no brightness law {law!r}: report, photon, bolometric, none")
    return _of(f"brightness.{law}", (), (doppler,))


def wavelength_to_hue(wavelength_nm: Any) -> Any:
    """The hue of a wavelength, in degrees: the map of 1988. Equation (P16)"""
    return _of("wavelength_to_hue", (), (wavelength_nm,))


def hue_to_wavelength(hue_deg: Any) -> Any:
    """The wavelength of a hue, in nm: the map of 1988. Equation (P16)

    >>> wavelength_to_hue(hue_to_wavelength([0, 120, 240])).round(9)
    array([  0., 120., 240.])
    """
    return _of("hue_to_wavelength", (), (hue_deg,))


def attenuation(wavelength_nm: Any) -> Any:
    """How pure colours fade towards the ends of the visible range, 0 to 1. Equation (P17)

    >>> attenuation([200, 550])
    array([0., 1.])
    """
    return _of("attenuation", (), (wavelength_nm,))


def planck(wavelength_nm: Any, kelvin: Any) -> Any:
    """Spectral radiance of a black body, W/(m² sr nm). Equation (P13)

    >>> float(planck(500, 5772).round(0))
    26239.0
    """
    return _of("planck", (), (wavelength_nm, kelvin))


def daylight(wavelength_nm: Any) -> Any:
    """Relative spectral power of the illuminant D65, 1 at 560 nm; 0 where there is no table.

    >>> daylight(560)
    np.float64(1.0)
    """
    return _of("daylight", (), (wavelength_nm,))


def observer(wavelength_nm: Any) -> Any:
    """The colour matching functions of the CIE 1931 observer, (…, 3).

    >>> observer(555).round(4)
    array([0.5121, 1.    , 0.0057])
    """
    return _of("observer", (), (wavelength_nm,))


def blackbody_xyz(kelvin: Any, doppler: Any = 1.0) -> Any:
    """X, Y, Z of a black body seen with a Doppler factor; at rest, Y is 1. Equations (P12), (P13), (P19)

    It looks like one at rest of the temperature kelvin × D.

    >>> seen, hotter = blackbody_xyz(3000, 2), blackbody_xyz(6000)
    >>> bool(np.allclose(seen / seen[1], hotter))
    True
    """
    return _of("blackbody_xyz", (), (kelvin, doppler))


def surface_xyz(linear_rgb: Any, doppler: Any = 1.0) -> Any:
    """X, Y, Z of a surface in daylight, of linear red, green and blue, seen with D. Equations (P12), (P19)

    >>> surface_xyz([1, 1, 1]).round(4)
    array([0.9505, 1.    , 1.0888])
    """
    return _of("surface_xyz", (linear_rgb,), (doppler,))


def xyz_to_linear_srgb(xyz: Any) -> Any:
    """Linear red, green and blue of sRGB, which may be negative.

    >>> xyz_to_linear_srgb(linear_srgb_to_xyz([0.2, 0.4, 0.6])).round(12)
    array([0.2, 0.4, 0.6])
    """
    return _of("xyz_to_linear_srgb", (xyz,))


def linear_srgb_to_xyz(linear_rgb: Any) -> Any:
    """X, Y, Z of linear red, green and blue of sRGB."""
    return _of("linear_srgb_to_xyz", (linear_rgb,))


def srgb_encode(linear: Any) -> Any:
    """The transfer function of sRGB, from linear light to levels, both 0 to 1.

    >>> srgb_decode(srgb_encode([0, 0.5, 1])).round(12)
    array([0. , 0.5, 1. ])
    """
    return _of("srgb_encode", (), (linear,))


def srgb_decode(encoded: Any) -> Any:
    """The inverse of `srgb_encode`."""
    return _of("srgb_decode", (), (encoded,))


def hyperbolic_event(acceleration: Any, proper_time: Any) -> Any:
    """The event (t, x, y, z) of a body with constant proper acceleration from rest at 0. Equation (P32)

    >>> hyperbolic_event([1, 0, 0], 2.0).round(6)
    array([3.62686 , 2.762196, 0.      , 0.      ])
    """
    return _of("hyperbolic_event", (acceleration,), (proper_time,))


def hyperbolic_velocity(acceleration: Any, proper_time: Any) -> Any:
    """Its velocity at a proper time. Equation (P32)

    >>> hyperbolic_velocity([1, 0, 0], [0.0, 2.0])[:, 0].round(6)
    array([0.      , 0.964028])
    """
    return _of("hyperbolic_velocity", (acceleration,), (proper_time,))
