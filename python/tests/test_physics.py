"""Formulas against published numbers and independent ones, in plain NumPy."""

from __future__ import annotations

import numpy as np
import pytest

import uglorentz as ug
from uglorentz import physics as p


def random_velocities(n: int, seed: int = 1905) -> np.ndarray:
    rng = np.random.default_rng(seed)
    directions = rng.normal(size=(n, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return directions * np.tanh(rng.uniform(0, 3, (n, 1)))


V = random_velocities(200)
POINTS = np.random.default_rng(7).normal(size=(200, 3)) * 3


def test_a_seen_event_is_a_boost_of_one_on_the_light_cone():
    # Independent: solve for the retarded time of a point that moves uniformly. Its position at t = 0 is contracted.
    for rest, v in zip(POINTS, V):
        speed = np.linalg.norm(v)
        gamma = 1 / np.sqrt(1 - speed**2)
        along = v / speed * (rest @ v / speed)
        now = rest - along + along / gamma
        # |now + v t| = -t, the earlier root.
        a, b, c = speed**2 - 1, 2 * now @ v, now @ now
        t = (-b + np.sqrt(b * b - 4 * a * c)) / (2 * a)
        t = min(t, (-b - np.sqrt(b * b - 4 * a * c)) / (2 * a))
        np.testing.assert_allclose(p.contracted(rest, v), now, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(p.seen_position(rest, v), now + v * t, rtol=1e-7, atol=1e-8)
        np.testing.assert_allclose(p.emission_time(rest, v), t, rtol=1e-7)


def test_doppler_factor_is_that_of_textbooks():
    n = -POINTS / np.linalg.norm(POINTS, axis=1, keepdims=True)
    expected = 1 / (p.gamma(V) * (1 - np.sum(V * n, axis=1)))
    np.testing.assert_allclose(p.doppler_at(POINTS, V), expected, rtol=1e-12)
    np.testing.assert_allclose(p.doppler_factor(n, V), expected, rtol=1e-12)
    # Ives and Stilwell: the product of forward and backward factors is 1.
    np.testing.assert_allclose(p.doppler_factor(V, V) * p.doppler_factor(-V, V), 1, rtol=1e-12)


def test_aberration_is_that_of_1905():
    # cos θ' = (cos θ + β)/(1 + β cos θ), for viewing directions of an observer who moves with β.
    theta = np.linspace(0, np.pi, 50)
    for beta in (0.1, 0.5, 0.99):
        seen = p.aberrate(np.stack([np.cos(theta), np.sin(theta), 0 * theta], -1), [beta, 0, 0])
        np.testing.assert_allclose(seen[:, 0], (np.cos(theta) + beta) / (1 + beta * np.cos(theta)), atol=1e-12)


def test_composition_is_that_of_matrices():
    U = random_velocities(200, 8)
    product = p.boost(V) @ p.boost(U)
    np.testing.assert_allclose(p.compose(U, V), product[:, 1:, 0] / product[:, :1, 0], rtol=1e-9)
    metric = np.diag([-1.0, 1, 1, 1])
    for matrix in p.boost(V):
        np.testing.assert_allclose(matrix.T @ metric @ matrix, metric, atol=1e-9)
    # Fizeau: c/n of water, dragged.
    dragged = 1 / 1.333 + 1e-4 * (1 - 1 / 1.333**2)
    assert p.compose([1 / 1.333, 0, 0], [1e-4, 0, 0])[0] == pytest.approx(dragged, rel=1e-8)
    # Thomas and Wigner: boosts at right angles, tan of the angle.
    x, y, z, w = p.wigner_rotation([0.6, 0, 0], [0, 0.8, 0])
    g, h = 1.25, 1 / 0.6
    tangent = g * h * 0.6 * 0.8 / (g + h)
    assert abs(np.tan(2 * np.arctan2(np.hypot(np.hypot(x, y), z), w))) == pytest.approx(tangent)


def test_rapidities_add():
    along = np.array([0, 0, 1.0])
    np.testing.assert_allclose(p.rapidity(p.compose(np.tanh(1) * along, np.tanh(2) * along)), 3)
    np.testing.assert_allclose(p.rapidity(p.from_rapidity(along, [0.5, 5, 15])), [0.5, 5, 15], rtol=1e-5)


def test_a_round_trip_near_the_speed_of_light():
    v = p.from_rapidity([1, 2, 3], 15.0)
    assert np.linalg.norm(v) < 1
    np.testing.assert_allclose(p.rest_position(p.seen_position(POINTS, v), v), POINTS, rtol=1e-5, atol=1e-5)


def test_a_traveller_to_andromeda():
    # One g for half the way, then braking: 28 years on board for 2.5 million (Misner, Thorne, Wheeler, box 6.1;
    # for 30 000 light years to the centre of the galaxy, 20 years).
    g = 1.0323  # c per year
    distance = 30_000 / 2
    own_time = np.arccosh(1 + g * distance) / g
    t, x, *_ = p.hyperbolic_event([g, 0, 0], own_time)
    assert x == pytest.approx(distance, rel=1e-9)
    assert 19 < 2 * own_time < 21
    assert t**2 - (x + 1 / g) ** 2 == pytest.approx(-1 / g**2, rel=1e-3)
    beta = p.hyperbolic_velocity([g, 0, 0], own_time)[0]
    assert beta == pytest.approx(np.tanh(g * own_time))


def test_black_bodies():
    # Wien: 2897.771955 μm K. Stefan and Boltzmann: σ T⁴/π.
    wavelengths = np.linspace(400, 600, 200_001)
    assert wavelengths[np.argmax(p.planck(wavelengths, 5772))] == pytest.approx(2897771.955 / 5772, abs=2e-3)
    wide = np.geomspace(50, 1e7, 400_000)
    spectrum = p.planck(wide, 5772.0)
    total = np.sum((spectrum[1:] + spectrum[:-1]) / 2 * np.diff(wide))
    assert total == pytest.approx(5.670374419e-8 * 5772**4 / np.pi, rel=1e-5)
    # Illuminant A, chromaticity of the CIE, with 2855.54 K on the present temperature scale.
    xyz = p.blackbody_xyz(2855.5)
    np.testing.assert_allclose(xyz[:2] / xyz.sum(), [0.44757, 0.40745], atol=2e-4)
    # A shifted black body is one of temperature D T; radiance per wavelength is D to the 5th.
    seen = p.blackbody_xyz(4000, [0.5, 1, 2])
    for row, kelvin, factor in zip(seen, (2000, 4000, 8000), (0.5, 1, 2)):
        expected = p.observer(np.arange(360, 831)).T @ p.planck(np.arange(360, 831), kelvin)
        np.testing.assert_allclose(row / row[1], expected / expected[1], rtol=1e-3)


def test_colours():
    white = p.surface_xyz([1, 1, 1])
    np.testing.assert_allclose(white, [0.95047, 1, 1.08883], atol=3e-4)
    # IEC 61966-2-1.
    levels = np.linspace(0, 1, 101)
    linear = np.where(levels <= 0.04045, levels / 12.92, ((levels + 0.055) / 1.055) ** 2.4)
    np.testing.assert_allclose(p.srgb_decode(levels), linear, atol=1e-7)
    np.testing.assert_allclose(p.srgb_encode(linear), levels, atol=1e-7)
    # The report of 1988: red at 700 nm, green 546.1, blue 435.8.
    np.testing.assert_allclose(p.hue_to_wavelength([0, 120, 240]), [700, 546.1, 435.8], atol=0.1)
    np.testing.assert_allclose(p.brightness(2.0, "photon"), 8)
    with pytest.raises(ug.Error):
        p.brightness(1.0, "loud")


def test_shapes_are_broadcast():
    assert p.seen_position(np.ones((4, 1, 3)), np.zeros((5, 3))).shape == (4, 5, 3)
    assert p.boost(np.zeros((2, 3, 3))).shape == (2, 3, 4, 4)
    assert p.hyperbolic_event([1, 0, 0], np.zeros((3, 2))).shape == (3, 2, 4)
    assert p.gamma([0, 0, 0]) == 1 and np.ndim(p.gamma([0, 0, 0])) == 0
    assert p.gamma(np.empty((0, 3))).shape == (0,)
    assert p.doppler_factor(np.float32([1, 0, 0]), np.int8([0, 0, 0])) == 1
    for wrong in (lambda: p.gamma([1, 2]), lambda: p.gamma(0.5), lambda: p.compose(np.zeros((2, 3)), np.zeros((3, 3))),
                  lambda: p.gamma([0, 0, 1]), lambda: p.gamma([np.nan, 0, 0]), lambda: p.planck(-1, 300),
                  lambda: p.surface_xyz([2, 0, 0])):
        with pytest.raises(ug.Error):
            wrong()
    with pytest.raises(ug.Error, match="row 1"):
        p.gamma([[0, 0, 0], [0, 2, 0]])
    # NaN that is no velocity stays NaN.
    assert np.isnan(p.seen_position([np.nan, 0, 0], [0.5, 0, 0])).any()


def test_vertices_as_seen_are_those_of_the_formulas():
    rng = np.random.default_rng(3)
    rest = rng.normal(size=(30, 3)) + [0, 8, 0]
    faces = rng.permutation(30).reshape(10, 3)
    scene = ug.Scene.from_arrays(rest, faces, extra="cam -ep 0 0 0 -vc 0 8 0;")
    v = np.array([0.3, -0.6, 0.2])
    seen = scene.lorentz(velocity=v, pieces=1).vertices_as_seen()
    np.testing.assert_allclose(seen["position"], p.seen_position(rest, v), rtol=1e-12)
    np.testing.assert_allclose(seen["emission_time"], p.emission_time(rest, v), rtol=1e-12)
    np.testing.assert_allclose(seen["doppler"], p.doppler_at(p.seen_position(rest, v), v), rtol=1e-12)
    np.testing.assert_allclose(seen["velocity"], np.broadcast_to(v, (30, 3)), rtol=1e-15)
    later = scene.lorentz(velocity=v, pieces=1, time=2.0).vertices_as_seen()
    np.testing.assert_allclose(later["emission_time"], 2 - np.linalg.norm(later["position"], axis=1), rtol=1e-12)


def test_channels_are_those_of_the_formulas():
    scene = ug.Scene.from_arrays([[-50, 9, -50], [50, 9, -50], [50, 9, 50], [-50, 9, 50]], [[0, 1, 2, 3]],
                                 extra="cam -ep 0 0 0 -vc 0 9 0;")
    beta = np.array([0, -0.5, 0])
    for picture in (scene.photon(velocity=beta, size=(7, 5)), scene.lorentz(velocity=beta).render(size=(7, 5))):
        found = picture.channels("D", "time", "distance", "Z", "id", "velocity", "direction")
        assert {name: (c.shape, c.dtype.name) for name, c in found.items()} == {
            "D": ((5, 7), "float32"), "time": ((5, 7), "float32"), "distance": ((5, 7), "float32"),
            "Z": ((5, 7), "float32"), "id": ((5, 7), "uint32"), "velocity": ((5, 7, 3), "float32"),
            "direction": ((5, 7, 3), "float32"),
        }
        # Pieces of the plane, if it was subdivided.
        assert (found["id"] > 0).all()
        np.testing.assert_allclose(found["time"], -found["distance"], rtol=1e-6)
        # The viewing direction in the scene, from that in the frame of the body.
        view = p.aberrate(found["direction"], -beta)
        np.testing.assert_allclose(found["D"], p.doppler_at(view, beta), rtol=1e-5)
        np.testing.assert_allclose(found["distance"] * view[..., 1], found["Z"], rtol=1e-5)
        # Every point of the plane rests at y = 9.
        np.testing.assert_allclose(p.rest_position(found["distance"][..., None] * view, beta)[..., 1], 9, rtol=1e-4)
        np.testing.assert_allclose(found["velocity"], np.broadcast_to(beta, (5, 7, 3)), atol=1e-7)
