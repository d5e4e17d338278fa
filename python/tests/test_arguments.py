"""Wrong, extreme and hostile arguments raise exceptions that say what to do."""

from __future__ import annotations

import gc
import multiprocessing
import os
import re
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import uglorentz as ug

TRIANGLE = "v a 0 5 0; v b 1 5 0; v c 0 5 1; f (a b c); cam -ep 0 0 0 -vc 0 5 0;"
TILE = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])


@pytest.fixture
def scene() -> ug.Scene:
    return ug.Scene.parse(TRIANGLE)


def test_an_error_in_a_scene_has_its_place():
    with pytest.raises(ug.Error) as caught:
        ug.Scene.parse("v a 0 0 0;\nv b 1 0 0;\nv c 0 1 0; f (a b d);\n")
    error = caught.value
    assert isinstance(error, ValueError)
    assert (error.file, error.line, error.column) == ("<stdin>", 3, 19)
    assert error.message == "vertex `d` is not defined"
    assert error.remedy is not None and "v` statement" in error.remedy
    # The whole message shows the line.
    assert "f (a b d);" in str(error)


def test_a_file_that_cannot_be_read_is_an_error_of_the_system(tmp_path):
    with pytest.raises(FileNotFoundError) as caught:
        ug.Scene.read(tmp_path / "none.ug")
    assert caught.value.filename.endswith("none.ug")
    with pytest.raises(IsADirectoryError):
        ug.Scene.read(tmp_path)
    with pytest.raises(FileNotFoundError):
        ug.Scene.parse(TRIANGLE).render(size=(4, 3)).save(tmp_path / "no" / "file.png")
    with pytest.raises(FileNotFoundError):
        ug.Scene.parse(TRIANGLE).film(tmp_path / "no" / "film.gif", frames=2, size=(4, 4), time="0..1")
    with pytest.raises(FileNotFoundError):
        ug.warp(tmp_path / "none.png")


@pytest.mark.parametrize("call, message", [
    (lambda s: s.lorentz(velocity=(1, 0, 0)), "speed of light"),
    (lambda s: s.lorentz(velocity=(np.nan, 0, 0)), "finite"),
    (lambda s: s.lorentz(velocity=(0.5, 0)), "velocity="),
    (lambda s: s.lorentz(velocity=()), "velocity="),
    (lambda s: s.lorentz(velocity="fast"), "velocity="),
    (lambda s: s.lorentz(pieces=2, error=1), "pieces="),
    (lambda s: s.lorentz(camera="side"), "no camera is called"),
    (lambda s: s.doppler(brightness="loud"), "brightness="),
    (lambda s: s.doppler(spectral=True, wavelengths=True), "spectral=True"),
    (lambda s: s.render(size=(0, 3)), "size="),
    (lambda s: s.render(size=(1 << 40, 3)), "size="),
    (lambda s: s.render(size=(10**6, 10**6)), "pixels"),
    (lambda s: s.render(size=(65535, 65535), samples=16), ""),
    (lambda s: s.render(format="jpeg2000"), "format="),
    (lambda s: s.render(caption="a\0b" * 10**5, size=(9, 9)), ""),
    (lambda s: s.render(channels="D"), "exr"),
    (lambda s: s.lorentz(velocity=(0.5, 0, 0)).lorentz(velocity=(0.5, 0, 0)), ""),
    (lambda s: s.lorentz(velocity=(0.5, 0, 0)).photon(), ""),
    (lambda s: s.lorentz(velocity=(0.5, 0, 0)).film("film.gif"), "at rest"),
    (lambda s: s.vertices_as_seen(), "lorentz()"),
    (lambda s: s.film("film"), "film"),
    (lambda s: s.film("f.gif", time="a..b"), "time="),
    (lambda s: s.render(size=(4, 3)).channels("heat"), "D, time"),
    (lambda s: ug.warp(np.zeros((4, 4))), "shape"),
    (lambda s: ug.warp(np.zeros((0, 4, 3))), "shape"),
    (lambda s: ug.warp(np.full((4, 8, 3), np.inf)), "finite"),
    (lambda s: ug.warp(b""), ""),
    (lambda s: ug.warp(b"\x89PNG\r\n\x1a\n" + bytes(100)), ""),
    (lambda s: ug.Scene.parse(b"\xff\xfe\x00"), ""),
    (lambda s: ug.Scene.parse("execute ./run ;"), "allow_execute=True"),
    (lambda s: ug.Scene.parse("frob 1 2 3;"), "lax=True"),
    (lambda s: ug.Scene.parse(TRIANGLE, limit="text=3"), "limit="),
    (lambda s: ug.options("draw"), "lorentz"),
])
def test_wrong_values(scene, call, message):
    with pytest.raises(ug.Error) as caught:
        call(scene)
    text = str(caught.value)
    assert message in text
    # Python's names, not those of a shell.
    text = re.sub(r"(?m)^.*\|.*$|`[^`]*`", "", text)
    assert not re.search(r"\x1b|ugrainbow|uglorentz |(?<![\w-])--?[a-z]{2,}", text), text


@pytest.mark.parametrize("call, message", [
    (lambda s: s.lorentz(velocty=(0.5, 0, 0)), "did you mean velocity=?"),
    (lambda s: s.lorentz(velocity=(0.5, 0, 0), vel=(0.5, 0, 0)), "same option"),
    (lambda s: s.lorentz(keep_in_view=1), "True or False"),
    (lambda s: s.lorentz(velocity=(0.5, 0, 0, 0)), "not 4 values"),
    (lambda s: s.lorentz(velocity=("-qt", 0, 0)), "velocity="),
    (lambda s: s.lorentz(velocity=True), "needs X Y Z"),
    (lambda s: s.lorentz(velocity=(object(), 0, 0)), "velocity="),
    (lambda s: s.lorentz(velocity=(True, 0, 0)), "velocity="),
    (lambda s: s.lorentz(fo="file.ug"), "no keyword fo="),
    (lambda s: s.lorentz(attributes="file.csv"), "no keyword"),
    (lambda s: ug.Scene(), "Scene.read"),
    (lambda s: ug.Picture(), "render()"),
    (lambda s: ug.warp(np.zeros((4, 8, 3), complex)), "floating"),
    (lambda s: ug.warp(np.zeros((4, 8, 3), np.int64)), "uint8"),
    (lambda s: ug.Scene.from_arrays("abc", [[0, 1, 2]]), "vertices"),
    (lambda s: ug.Scene.from_arrays(TILE[0], [[0.0, 1.0, 2.0]]), "whole"),
    (lambda s: ug.Scene.from_arrays(np.array([[1j, 0, 0]]), []), "vertices"),
    (lambda s: ug.physics.gamma(["a", "b", "c"]), "numbers"),
    (lambda s: ug.physics.gamma(None), "numbers"),
])
def test_wrong_types(scene, call, message):
    with pytest.raises(TypeError) as caught:
        call(scene)
    assert message in str(caught.value)


@pytest.mark.parametrize("arguments, keywords, message", [
    (([[0, 0], [1, 0]], []), {}, "(n, 3)"),
    (([0, 0, 0], []), {}, "(n, 3)"),
    (([[0, 0, np.nan]], []), {}, "vertices[0] is not finite"),
    ((TILE[0], [[0, 1]]), {}, "faces[0] has fewer than 3"),
    ((TILE[0], [[0, 1, 3]]), {}, "no vertex 3"),
    ((TILE[0], [[0, 1, -1]]), {}, "no vertex -1"),
    ((TILE[0], [[0, 1, 2**62]]), {}, "no vertex"),
    ((TILE[0], [[[0, 1, 2]]]), {}, "faces[0]"),
    ((TILE[0], np.zeros((1, 3, 3), int)), {}, "faces[0]"),
    (TILE, {"colors": [[1, 0, 0], [0, 1, 0]]}, "(1, 3)"),
    (TILE, {"colors": (2, 0, 0)}, ""),
    (TILE, {"velocities": (0, 1, 0)}, ""),
    (TILE, {"velocities": np.zeros((2, 3))}, "(1, 3)"),
    (TILE, {"vertex_colors": np.zeros((4, 3))}, "(3, 3)"),
    (TILE, {"extra": "v v0 1 2 3;"}, "v0"),
])
def test_arrays_of_a_wrong_shape(arguments, keywords, message):
    with pytest.raises(ug.Error) as caught:
        ug.Scene.from_arrays(*arguments, **keywords)
    assert message in str(caught.value)


def test_arrays_of_any_layout():
    points, faces = np.array(TILE[0], np.float32), np.array(TILE[1], np.uint8)
    expected = ug.Scene.from_arrays(*TILE).text()
    strided = np.asfortranarray(np.repeat(points, 2, axis=0))[::2]
    assert not strided.flags.c_contiguous
    for vertices in (points, strided, points.astype(">f8"), [tuple(map(float, row)) for row in points]):
        for corners in (faces, faces.astype(np.int64), [[0, 1, 2]], [(0, 1, 2)], [np.array([0, 1, 2])]):
            assert ug.Scene.from_arrays(vertices, corners).text() == expected
    for kind in (np.int16, np.float16, np.float64):
        moved = ug.Scene.parse(TRIANGLE).lorentz(velocity=np.zeros(3, kind), time=kind(2))
        assert "(2" not in moved.text()
    empty = ug.Scene.from_arrays(np.empty((0, 3)), np.empty((0, 3), int))
    assert len(empty.faces) == 0 and empty.vertices.shape == (0, 3)


def test_arrays_come_back():
    rng = np.random.default_rng(7)
    vertices = rng.normal(size=(60, 3))
    vertices[50:] *= 10.0 ** rng.integers(-300, 300, (10, 1))
    faces = np.array([rng.permutation(50)[:3] for _ in range(20)])
    scene = ug.Scene.from_arrays(vertices, faces, colors=rng.random((20, 3)), velocities=rng.random((20, 3)) / 2)
    assert np.array_equal(scene.vertices, vertices)
    assert np.array_equal(scene.faces, faces)
    flat = ug.Scene.from_arrays([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
    assert len(flat.faces) == 0 and len(flat.notes) == 1
    again = ug.Scene.parse(scene.text())
    assert np.array_equal(again.vertices, vertices)


def test_notes_are_collected(scene, capfd):
    dark = ug.Scene.parse(TRIANGLE.replace("0 5 0;", "0 5 0;", 1) + "l 0;")
    seen = dark.lorentz(velocity=(0, 0, 0))
    picture = seen.render(size=(20, 10))
    assert any("black" in note or "bright" in note for note in picture.notes), picture.notes
    bent = ug.Scene.parse("v a 0 0 0; v b 1 0 0; v c 1 1 1; v d 0 1 0; f (a b c d);")
    assert len(bent.notes) == 1 and "not flat" in bent.notes[0] or "bent" in bent.notes[0]
    assert capfd.readouterr() == ("", "")


def test_moving_bodies_at_rest_are_told():
    scene = ug.Scene.from_arrays(*TILE, velocities=(0.5, 0, 0))
    (note, *_) = scene.render(size=(20, 10)).notes
    assert "drawn with their shapes at rest" in note and "lorentz()" in note
    assert not any("at rest" in note for note in scene.lorentz().render(size=(20, 10)).notes)


def test_what_is_out_of_view_is_told(scene):
    passed = ug.Scene.parse(TRIANGLE).photon(velocity=(0.9, 0, 0), time=100, size=(20, 10))
    assert any("time=" in note for note in passed.notes), passed.notes


def test_ten_thousand_renders_leave_no_memory(scene):
    def memory() -> int:
        gc.collect()
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * resource.getpagesize()

    seen = scene.lorentz(velocity=(0.1, 0, 0)).doppler()

    def draw(times: int) -> None:
        for _ in range(times):
            seen.render(size=(8, 6), samples=1).pixels

    draw(500)
    before = memory()
    draw(10_000)
    assert memory() - before < 16 << 20


def test_threads_draw_at_the_same_time(scene):
    expected = scene.photon(size=(32, 24)).to_bytes()
    results: list[bytes] = []
    work = lambda: results.append(scene.photon(size=(32, 24)).to_bytes())
    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert results == [expected] * 8


def draw_in_child(_: int) -> bytes:
    return ug.Scene.parse(TRIANGLE).photon(size=(32, 24)).to_bytes()


@pytest.mark.skipif(sys.platform != "linux", reason="fork is for Linux")
def test_a_forked_process_draws(scene):
    expected = scene.photon(size=(32, 24)).to_bytes()
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(draw_in_child, range(4)).get(timeout=60) == [expected] * 4


SLOW = """
import signal
import uglorentz as ug
# A job in the background inherits that interrupts are ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
scene = ug.Scene.parse({text!r})
print("begun", flush=True)
try:
    {call}
except KeyboardInterrupt:
    print("interrupted", flush=True)
# The interpreter goes on.
print(scene.photon(size=(4, 3)).pixels.shape, flush=True)
"""


@pytest.mark.parametrize("call", [
    "scene.photon(size=(4000, 4000), samples=16)",
    "scene.film({film!r}, frames=100000, rays=True, size=(640, 480), time='0..1')",
])
def test_an_interrupt_stops_a_picture(call, tmp_path):
    program = SLOW.format(text=TRIANGLE, call=call.format(film=str(tmp_path / "f.gif")))
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "begun\n"
        time.sleep(1)
        begun = time.monotonic()
        child.send_signal(signal.SIGINT)
        rest = child.stdout.read()
        assert rest == "interrupted\n(3, 4, 3)\n"
        assert time.monotonic() - begun < 5
    assert child.returncode == 0
    assert os.listdir(tmp_path) == []


def test_progress_is_reported(scene):
    reports: list[tuple[str, int, int]] = []
    scene.photon(size=(600, 400), progress=lambda *report: reports.append(report))
    assert reports and all(done <= total or total == 0 for _, done, total in reports)
    with pytest.raises(ZeroDivisionError):
        scene.photon(size=(2000, 2000), progress=lambda *report: 1 / 0)
    scene.photon(size=(300, 200), progress=True)
