"""Scenes and pictures that are copied and pickled, examples, threads, films and channels."""

from __future__ import annotations

import copy
import multiprocessing
import pickle
import sys
from pathlib import Path

import numpy as np
import pytest

import uglorentz as ug

SMALL = {"size": (60, 45)}
TRIANGLE = "v a 0 5 0; v b 1 5 0; v c 0 5 1; f (a b c); cam -ep 0 0 0 -vc 0 5 0;"
COPIES = [copy.copy, copy.deepcopy, lambda value: pickle.loads(pickle.dumps(value))]


@pytest.fixture(params=range(3))
def copied(request):
    return COPIES[request.param]


def scenes(folder: Path) -> dict[str, ug.Scene]:
    (folder / "part.ug").write_text("v a -1 5 0; v b 1 5 0; v c 0 5 1; f (a b c);")
    (folder / "all.ug").write_text("include part.ug; cam near -ep 0 0 0 -vc 0 5 0; l 1;")
    read = ug.Scene.read(folder / "all.ug")
    return {
        "text": ug.Scene.parse(TRIANGLE),
        "file": read,
        "seen": read.lorentz(camera="near", velocity=(0.5, 0, 0)),
        "coloured": read.lorentz(velocity=(0.5, 0, 0)).doppler(look="light"),
        "pictures": ug.Scene.example("town").lorentz(camera_velocity=(0, 0.5, 0)),
        "mesh": ug.Scene.example("crate.gltf"),
        "moved mesh": ug.Scene.example("crate.gltf").lorentz(velocity=(0.3, 0, 0)),
        "arrays": ug.Scene.from_arrays([[0, 5, 0], [1, 5, 0], [0, 5, 1]], [[0, 1, 2]], colors=(1, 0, 0)),
    }


def test_scenes(copied, tmp_path):
    for name, scene in scenes(tmp_path).items():
        again = copied(scene)
        (tmp_path / "part.ug").write_text("changed")
        assert again is not scene and again.notes == scene.notes, name
        assert again.notes is not scene.notes
        assert again.text() == scene.text() and repr(again) == repr(scene), name
        assert again.render(**SMALL).to_bytes() == scene.render(**SMALL).to_bytes(), name
        if scene._steps:
            assert np.array_equal(again.vertices_as_seen()["position"], scene.vertices_as_seen()["position"])
            with pytest.raises(ug.Error, match="at rest"):
                again.film("film.gif")
        else:
            for row, one in enumerate((scene, again)):
                one.film(tmp_path / f"{row}.apng", frames=2, velocity=[(0, 0, 0), (0.5, 0, 0)], **SMALL)
            assert (tmp_path / "0.apng").read_bytes() == (tmp_path / "1.apng").read_bytes(), name
        # What was copied can be copied and drawn further.
        assert copied(copied(scene)).text() == scene.text()


@pytest.mark.parametrize("options", [{}, {"format": "exr", "channels": ("D", "id")}, {"format": "svg", "vector": True},
                                     {"transparent": True}, {"format": "pfm"}])
def test_pictures(copied, options):
    picture = ug.Scene.parse(TRIANGLE).lorentz(velocity=(0.5, 0, 0), keep_in_view=True).render(**SMALL, **options)
    picture.notes.append("mine")
    again = copied(picture)
    assert again.to_bytes() == picture.to_bytes() and again.command == picture.command
    assert again.notes == picture.notes and again.notes is not picture.notes
    assert np.array_equal(again.pixels, picture.pixels) and again.pixels.flags.writeable
    assert np.array_equal(again.light, picture.light)
    assert np.array_equal(again.channel("D"), picture.channel("D"))
    assert again.to_bytes("png16") == picture.to_bytes("png16")
    assert copied(again).to_bytes() == picture.to_bytes()


def test_pictures_of_skies(copied, tmp_path):
    sky = np.random.default_rng(5).integers(0, 256, (32, 64, 3), np.uint8)
    picture = ug.warp(sky, camera_velocity=(0, 0.5, 0), **SMALL)
    again = copied(picture)
    assert again.to_bytes() == picture.to_bytes() and np.array_equal(again.light, picture.light)


def drawn_elsewhere(speed: float) -> ug.Picture:
    return ug.Scene.parse(TRIANGLE).photon(velocity=(speed, 0, 0), keep_in_view=True, **SMALL)


@pytest.mark.skipif(sys.platform != "linux", reason="fork is for Linux")
def test_pictures_come_from_other_processes():
    speeds = [0.1, 0.5]
    with multiprocessing.get_context("fork").Pool(2) as pool:
        pictures = pool.map_async(drawn_elsewhere, speeds).get(timeout=60)
    assert [picture.to_bytes() for picture in pictures] == [drawn_elsewhere(speed).to_bytes() for speed in speeds]


def test_errors_are_pickled():
    with pytest.raises(ug.Error) as caught:
        ug.Scene.parse("v a 0 0 0;\nf (a b);")
    again = pickle.loads(pickle.dumps(caught.value))
    assert (str(again), again.line, again.remedy) == (str(caught.value), 2, caught.value.remedy)


def test_examples(shell, tmp_path):
    """The scenes of `ugparse example`, as it writes them, with the record of their names."""
    names = ug.examples()
    assert len(names) >= 40 and all(len(about) > 15 for about in names.values()), names
    assert {"ship", "town", "crate.gltf", "globe.obj"} <= set(names)
    root = Path(__file__).parents[2] / "scenes"
    for name in names:
        file = name if "." in name else f"{name}.ug"
        assert ug.example_file(file) == (root / file).read_bytes()
        scene = ug.Scene.example(name)
        assert len(scene.faces) > 0 and not any(note.startswith("error") for note in scene.notes), name
    assert {path.name for path in root.glob("*.ug")} == {f"{name}.ug" for name in names if "." not in name}
    for name in ("ship.ug", "town.ug", "crate.gltf"):
        expected = shell(f"cd scenes && uglorentz -vel 0.5 0 0 -in {name} | ugdoppler -sp | ugrainbow -sz 60 45")
        seen = ug.Scene.example(name).lorentz(velocity=(0.5, 0, 0), keep_in_view=True).doppler(spectral=True)
        assert seen.render(**SMALL).to_bytes() == expected
    film = "-frames 2 -vel 0 0 0..0.5 -sz 60 45"
    expected = shell(f"cd scenes && ugfilm {film} -fo {tmp_path}/a.gif town.ug; cat {tmp_path}/a.gif")
    ug.Scene.example("town").film(tmp_path / "b.gif", frames=2, velocity=(0, 0, [0, 0.5]), **SMALL)
    assert (tmp_path / "b.gif").read_bytes() == expected
    with pytest.raises(ug.Error, match="examples are house, "):
        ug.Scene.example("stars.csv")
    with pytest.raises(ug.Error, match="stars.csv"):
        ug.example_file("stars")


def test_threads(tmp_path):
    """Every function has the keyword, and the number changes no byte."""
    outcomes = []
    for threads in (1, 3, None):
        options = {"threads": threads}
        scene = ug.Scene.parse(TRIANGLE, **options)
        seen = scene.lorentz(velocity=(0.5, 0, 0), keep_in_view=True, **options).doppler(**options)
        file = tmp_path / "film.gif"
        scene.film(file, frames=3, time="0..1", **SMALL, **options)
        sky = ug.warp(np.zeros((32, 64, 3), np.uint8), **SMALL, **options)
        pictures = [seen.render(**SMALL, **options), scene.photon(**SMALL, nt=threads), sky]
        outcomes.append([file.read_bytes(), *(picture.to_bytes() for picture in pictures)])
        assert pictures[1].light.shape == (45, 60, 3)
    assert outcomes[0] == outcomes[1] == outcomes[2]
    assert ug.Scene.example("die", threads=2).text() == ug.Scene.example("die").text()
    scene = ug.Scene.parse(TRIANGLE)
    for wrong in (0, -1, 1025):
        with pytest.raises(ug.Error, match="threads= is from 1 to 1024"):
            scene.render(threads=wrong)
    for wrong in ("2", 1.5, True):
        with pytest.raises(TypeError, match="threads= is a whole number"):
            scene.photon(threads=wrong)
    with pytest.raises(TypeError, match="the same option"):
        scene.photon(threads=1, nt=1)


@pytest.mark.parametrize("keywords, same", [
    ({"velocity": [(0, 0, 0), (0.9, 0, 0)]}, {"velocity": "0 0 0 .. 0.9 0 0"}),
    ({"velocity": np.array([[0, 0, 0], [0.9, 0, 0]])}, {"velocity": "0 0 0 .. 0.9 0 0"}),
    ({"velocity": ([0, 0.9], 0, 0)}, {"velocity": ("0..0.9", 0, 0)}),
    ({"velocity": (0.5, 0, 0), "time": range(3)}, {"velocity": (0.5, 0, 0), "time": "0..1..2"}),
    ({"velocity": (0.5, 0, 0), "ti": np.linspace(-1, 1, 3)}, {"velocity": (0.5, 0, 0), "ti": "-1..0..1"}),
    ({"velocity": (0.5, 0, 0), "time": [0, 2]}, {"velocity": (0.5, 0, 0), "time": "0..2"}),
    ({"velocity": [(0.5, 0, 0)], "time": [1]}, {"velocity": (0.5, 0, 0), "time": 1}),
    ({"view_angle": [(60, 50), (40, 30)]}, {"view_angle": "60 50 .. 40 30"}),
    ({"view_angle": (60, 50)}, {"view_angle": (60, 50)}),
    ({"eye": np.array([[0.0, -1, 0], [0, -2, 0], [1, -2, 0]])}, {"eye": "0 -1 0 .. 0 -2 0 .. 1 -2 0"}),
    ({"exposure": [0, 1]}, {"exposure": "0..1"}),
    ({"only": [1, 3], "time": (0, 1)}, {"only": "1,3", "time": "0..1"}),
])
def test_films_of_sequences(keywords, same, tmp_path):
    films = []
    for options in (keywords, same):
        ug.Scene.parse(TRIANGLE).film(tmp_path / "film.apng", frames=4, **SMALL, **options)
        films.append((tmp_path / "film.apng").read_bytes())
    assert films[0] == films[1]


@pytest.mark.parametrize("keywords, message", [
    ({"velocity": [(0, 0), (0.9, 0, 0)]}, r"velocity\[0\] is \(0, 0\): X Y Z are expected"),
    ({"velocity": [(0, 0, 0), (0.9, 0, 0, 0)]}, r"velocity\[1\] is \(0.9, 0, 0, 0\)"),
    ({"time": [object()]}, "time="),
])
def test_films_of_wrong_sequences(keywords, message, tmp_path):
    with pytest.raises(TypeError, match=message):
        ug.Scene.parse(TRIANGLE).film(tmp_path / "film.apng", frames=4, **keywords)
    for wrong in ({"velocity": [(0, 0, 0), (2, 0, 0)]}, {"time": [0, np.nan]}):
        with pytest.raises(ug.Error):
            ug.Scene.parse(TRIANGLE).film(tmp_path / "film.apng", frames=4, **wrong)


def test_channels_without_nothing():
    picture = ug.Scene.parse(TRIANGLE).photon(velocity=(0, -0.5, 0), size=(24, 18))
    raw = picture.channels("D", "time", "velocity", "id")
    is_nothing = raw["id"] == 0
    assert is_nothing.any() and not is_nothing.all()
    masked = picture.channels("D", "time", "velocity", "id", nothing="mask")
    for name, channel in masked.items():
        assert isinstance(channel, np.ma.MaskedArray)
        mask = channel.mask[..., 0] if name == "velocity" else channel.mask
        assert np.array_equal(mask, is_nothing), name
        assert np.array_equal(channel.data, raw[name])
    holes = picture.channels("D", "time", "velocity", nothing="nan")
    assert set(holes) == {"D", "time", "velocity"}
    for name, channel in holes.items():
        gone = np.isnan(channel[..., 0]) if name == "velocity" else np.isnan(channel)
        assert np.array_equal(gone, is_nothing) and channel.dtype == np.float32
        assert np.array_equal(channel[~is_nothing], raw[name][~is_nothing])
    assert np.array_equal(picture.channel("id", nothing="nan"), raw["id"])
    only = ug.Scene.parse(TRIANGLE).photon(size=(24, 18), format="exr", channels="D")
    assert np.ma.count_masked(only.channel("D", nothing="mask")) > 0
    with pytest.raises(ug.Error, match="nothing="):
        picture.channel("D", nothing="zero")
