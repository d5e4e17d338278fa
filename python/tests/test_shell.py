"""A picture has the bytes of the shell pipe, whatever it is drawn from."""

from __future__ import annotations

import sys

import matplotlib.pyplot as plt
import numpy as np
import pytest

import uglorentz as ug

SIZE = "-sz 240 220"
SMALL = {"size": (240, 220)}


@pytest.mark.parametrize(
    ("filters", "moved", "coloured", "drawn"),
    [
        ("uglorentz -vel 0.9 0 0 -in {} | ugdoppler -look light | ugrainbow -look light",
         {"velocity": (0.9, 0, 0), "keep_in_view": True}, {"look": "light"}, {"look": "light"}),
        # Numbers keep their bits, and historical names are accepted.
        ("uglorentz -vel -0.30000000000000004 1e-07 0.5 -in -se 2 {} | ugdoppler | ugrainbow -ex -1.5",
         {"vel": np.array([-0.1 - 0.2, 1e-7, 0.5]), "in_": True, "se": 2}, {}, {"ex": -1.5}),
        ("uglorentz -cv 0 0.5 0 -ti -2 --no-flight-time {} | ugdoppler -br photon -gw | ugrainbow -lg -cap 'a, -b'",
         {"camera_velocity": [0, 0.5, 0], "time": -2, "no_flight_time": True},
         {"brightness": "photon", "wavelengths": True}, {"legend": True, "caption": "a, -b"}),
        ("uglorentz -vel 0 0.5 0 -an 1 2 3 {} | ugdoppler --no-doppler | ugrainbow -va 50 40 -bg 1 120 -wf -lc 1",
         {"velocity": (0, 0.5, 0), "anchor": (1, 2, 3)}, {"no_doppler": True},
         {"view_angle": (50, 40), "background": (1, 120), "wireframe": True, "line_color": 1}),
    ],
)
@pytest.mark.parametrize("scene", ["scenes/teapot.ug", "scenes/street.ug"])
def test_the_pipe(shell, filters, moved, coloured, drawn, scene):
    expected = shell(f"{filters.format(scene)} {SIZE}")
    seen = ug.Scene.read(scene).lorentz(**moved).doppler(**coloured)
    assert seen.render(**drawn, **SMALL).to_bytes() == expected


@pytest.mark.parametrize("format", ["png16", "exr", "svg", "pdf", "ppm"])
def test_formats(shell, format, tmp_path):
    file = tmp_path / f"picture.{format}"
    pipe = "uglorentz -vel 0.9 0 0 -in scenes/teapot.ug | ugdoppler -look light | ugrainbow"
    expected = shell(f"{pipe} {SIZE} -dt {format}")
    seen = ug.Scene.read("scenes/teapot.ug").lorentz(velocity=(0.9, 0, 0), keep_in_view=True)
    picture = seen.doppler(look="light").render(**SMALL)
    picture.save(file, format=format)
    assert file.read_bytes() == expected
    if format == "svg":
        picture.save(file, vector=True)
        assert file.read_bytes() == shell(f"{pipe} {SIZE} -vec -dt svg")


@pytest.mark.parametrize("shape", [
    "sphere 0 0 0 1", "cylinder 0 0 -1 0 0 1 .7", "tube 0 -.3 -1 0 .3 1 .7", "disc 0 0 0 .2 -1 .3 1",
])
def test_round_faces(shell, shape, tmp_path):
    """They are exact for rays and polygons elsewhere; arrays have the polygons."""
    file = tmp_path / "round.ug"
    file.write_text(f"{shape}; l .4; l .8 1 -2 2; cam -ep 0 -6 1 -vc 0 0 0 -va 30;")
    scene = ug.Scene.read(file)
    moving = {"velocity": (0.5, 0.3, 0), "keep_in_view": True}
    moved = f"uglorentz -vel 0.5 0.3 0 -in {file}"
    small, lorentz = {"size": (60, 45)}, scene.lorentz(**moving)
    exact = scene.lorentz(**moving, sd=1)
    assert lorentz.doppler().render(**small).to_bytes() == shell(f"{moved} | ugdoppler | ugrainbow -sz 60 45")
    assert exact.render(xc=True, **small).to_bytes() == shell(f"{moved} -sd 1 | ugrainbow -xc -sz 60 45")
    assert exact.doppler().render(**small).to_bytes() == shell(f"{moved} -sd 1 | ugdoppler | ugrainbow -sz 60 45")
    options = f"-ex 0 -aa 1 -vel 0.5 0.3 0 -in -sz 60 45 {file}"
    photon = scene.photon(exposure=0, samples=1, **moving, **small).to_bytes()
    assert photon == shell(f"ugphoton {options}")
    assert len(scene.vertices) > 8 and len(scene.vertices) == len(scene.names)


def test_text_between_programs(shell):
    scene = ug.Scene.read("scenes/teapot.ug").lorentz(velocity=(0.5, 0, 0))
    assert scene.text().encode() == shell("uglorentz -vel 0.5 0 0 scenes/teapot.ug")
    seen = shell("uglorentz -vel 0.5 0 0 scenes/teapot.ug | ugdoppler")
    assert scene.doppler().text().encode() == seen
    # A scene that a program wrote is read like any other.
    assert ug.Scene.parse(seen).render(**SMALL).to_bytes() == scene.doppler().render(**SMALL).to_bytes()


@pytest.mark.parametrize("options", [
    ("-vel 0.9 0 0 -in", {"velocity": (0.9, 0, 0), "keep_in_view": True}),
    ("-cv 0 0.5 0 -pan -look 1988", {"camera_velocity": (0, 0.5, 0), "panorama": True, "look": "1988"}),
    ("-vel 0.5 0 0 -in -stereo 0.1 --no-shadows -ad 0.05",
     {"velocity": (0.5, 0, 0), "in_place": True, "stereo": 0.1, "no_shadows": True, "adaptive": 0.05}),
])
def test_rays(shell, options):
    line, keywords = options
    expected = shell(f"ugphoton {line} {SIZE} scenes/teapot.ug")
    assert ug.Scene.read("scenes/teapot.ug").photon(**keywords, **SMALL).to_bytes() == expected
    exr = shell(f"ugphoton {line} {SIZE} scenes/teapot.ug -ch D,id -dt exr")
    picture = ug.Scene.read("scenes/teapot.ug").photon(**keywords, **SMALL)
    assert picture.to_bytes("exr", channels=["D", "id"]) == exr


@pytest.mark.parametrize("name", ["obj", "ply", "glb"])
def test_meshes(shell, name, tmp_path):
    file = tmp_path / f"ship.{name}"
    file.write_bytes(shell(f"ugmesh -dt {name} scenes/teapot.ug"))
    expected = shell(f"ugphoton -vel 0.5 0 0 -in {SIZE} {file}")
    assert ug.Scene.read(file).photon(velocity=(0.5, 0, 0), keep_in_view=True, **SMALL).to_bytes() == expected


def test_includes_and_cameras(shell, tmp_path):
    (tmp_path / "part.ug").write_text("v a -1 5 0; v b 1 5 0; v c 0 5 1; f (a b c);")
    (tmp_path / "all.ug").write_text("include part.ug; cam near -ep 0 0 0; cam far -ep 0 -9 0;")
    file = tmp_path / "all.ug"
    for name in ("near", "far"):
        expected = shell(f"uglorentz -cam {name} -vel 0.5 0 0 {file} | ugdoppler | ugrainbow {SIZE}")
        seen = ug.Scene.read(file).lorentz(camera=name, velocity=(0.5, 0, 0)).doppler()
        assert seen.render(**SMALL).to_bytes() == expected
        rays = ug.Scene.read(file).photon(cam=name, **SMALL)
        assert rays.to_bytes() == shell(f"ugphoton -cam {name} {SIZE} {file}")


def test_standard_input_is_text(shell):
    text = (b"c red 1 0 1; v a 0 0 0; v b 1 0 0; v c 0 0 1; f (a b c) red;")
    expected = shell(f"ugphoton -vel 0.5 0 0 {SIZE}", input=text)
    assert ug.Scene.parse(text).photon(velocity=(0.5, 0, 0), **SMALL).to_bytes() == expected


def test_skies(shell, tmp_path):
    sky = np.random.default_rng(1905).integers(0, 256, (32, 64, 3), np.uint8)
    file = tmp_path / "sky.png"
    plt.imsave(file, sky)
    keywords = {"camera_velocity": (0, 0.9, 0), "view_angle": 90, **SMALL}
    assert ug.warp(file, **keywords).to_bytes() == shell(f"ugwarp -cv 0 0.9 0 -va 90 {SIZE} {file}")
    assert ug.warp(file.read_bytes(), **keywords).to_bytes() == shell(f"ugwarp -cv 0 0.9 0 -va 90 {SIZE} < {file}")
    assert np.array_equal(ug.warp(sky, **keywords).pixels, ug.warp(file, **keywords).pixels)
    light = ug.physics.srgb_decode(sky / 255).astype(np.float32)
    assert np.array_equal(ug.warp(light, **keywords, look="1988").pixels, ug.warp(sky, **keywords, look="1988").pixels)
    stars = tmp_path / "stars.csv"
    stars.write_text("ra,dec,mag,kelvin\n10,20,1,6000\n-30,5,0,3000\n")
    expected = shell(f"ugwarp -cv 0 0.5 0 -fish 180 {SIZE} {stars}")
    assert ug.warp(stars, camera_velocity=(0, 0.5, 0), fisheye=180, **SMALL).to_bytes() == expected


def test_films(shell, tmp_path):
    line = f"-frames 4 -vel 0.9 0 0 -ti 3..9 -va 90 -look shape {SIZE}"
    keywords = {"frames": 4, "velocity": (0.9, 0, 0), "time": "3..9", "view_angle": 90, "look": "shape", **SMALL}
    for ending in ("apng", "gif"):
        expected = shell(f"ugfilm {line} -fo {tmp_path}/a.{ending} scenes/teapot.ug; cat {tmp_path}/a.{ending}")
        file = tmp_path / f"b.{ending}"
        ug.Scene.read("scenes/teapot.ug").film(file, **keywords)
        assert file.read_bytes() == expected
    ug.film("scenes/teapot.ug", tmp_path / "frame_%02d.png", **keywords)
    frame = ug.Scene.read("scenes/teapot.ug").lorentz(velocity=(0.9, 0, 0), time=5, view_angle=90, **SMALL)
    drawn = frame.doppler(look="shape").render(**SMALL, view_angle=90)
    frames = sorted(tmp_path.glob("frame_*.png"))
    assert len(frames) == 4
    assert pixels(frames[1]) == drawn.pixels.tobytes()


def pixels(file) -> bytes:
    return (plt.imread(file)[..., :3] * 255).round().astype(np.uint8).tobytes()


@pytest.mark.parametrize("case", ["sphere", "panorama", "cube", "edge", "depth"])
def test_the_renderer_of_the_conformance_suite(shell, case, tmp_path):
    picture = tmp_path / "picture.png"
    picture.write_bytes(shell(f"'{sys.executable}' conformance/renderer.py {case}"))
    # Its status is 1 if a number is wrong.
    shell(f"ugconformance score-image {case} '{picture}'")
