"""The package as a whole: documentation, types, notebooks."""

from __future__ import annotations

import doctest
import importlib
import inspect
import os
import subprocess
import sys
from pathlib import Path

import pytest

import uglorentz as ug
from uglorentz import _words

FOLDER = Path(__file__).parents[1]
sys.path.insert(0, str(FOLDER))
NOTEBOOKS = sorted((FOLDER / "notebooks").glob("*.ipynb"))


def test_the_installed_package_is_tested():
    assert "site-packages" in ug.__file__ or os.environ.get("PYTHONPATH"), ug.__file__


@pytest.mark.parametrize("name", ["uglorentz", "uglorentz._scene", "uglorentz._picture", "uglorentz.physics"])
def test_examples_in_the_documentation(name):
    results = doctest.testmod(importlib.import_module(name))
    assert results.failed == 0 and results.attempted >= 2


def test_the_readme():
    assert doctest.testfile(str(FOLDER / "README.md"), module_relative=False).attempted >= 5
    assert doctest.testfile(str(FOLDER / "README.md"), module_relative=False).failed == 0


def test_everything_public_is_documented():
    for holder in (ug, ug.Scene, ug.Picture, ug.physics, ug.plot):
        for name, value in inspect.getmembers(holder):
            if not name.startswith("_") and callable(value):
                assert inspect.getdoc(value), name


def test_types_of_keywords_are_current():
    import stubs

    if os.environ.get("UG_BLESS"):
        stubs.FILE.write_text(stubs.stub())
    assert stubs.FILE.read_text() == stubs.stub(), "run python stubs.py, or the tests with UG_BLESS=1"


def test_every_option_is_a_keyword():
    """The options of the programs, but for those that are left out on purpose."""
    from uglorentz import _core

    for program, method in _words.METHODS.items():
        if program in ("ugwarp", "ugfilm"):
            function = getattr(ug, method)
        else:
            function = getattr(ug.Scene, method)
        keywords = inspect.signature(function).parameters
        for entry in _core.options(program):
            names = {_words.as_keyword(name) for name in entry["names"]}
            if not entry["is_common"] and not names & _words.LEFT_OUT:
                assert names & set(keywords), entry["names"]


@pytest.mark.parametrize("text, expected", [
    ("give the view centre with -vc, or leave out -va", "give the view centre with center=, or leave out view_angle="),
    ("try -ex auto, or -look light", 'try exposure="auto", or look="light"'),
    ("give -sz 640 480", "give size=(640, 480)"),
    ("-in and -ti -2.5: uglorentz", "keep_in_view=True and time=-2.5: lorentz()"),
    ("between -5 and 3, x-ray, /a/b-vel.ug", "between -5 and 3, x-ray, /a/b-vel.ug"),
    ("docs/unigrafix.md; see uglorentz.Error", "docs/unigrafix.md; see uglorentz.Error"),
])
def test_messages_have_the_names_of_python(text, expected):
    assert _words.in_python(text) == expected


def mypy(*words: str) -> None:
    command = [sys.executable, "-m", "mypy", *words]
    ran = subprocess.run(command, capture_output=True, text=True, cwd=FOLDER / "examples")
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_types():
    mypy("--strict", "--cache-dir", os.devnull, "-p", "uglorentz")
    mypy("--strict", "--cache-dir", os.devnull, str(FOLDER / "examples" / "passing.py"))


def test_a_wrong_type_is_found(tmp_path):
    file = tmp_path / "wrong.py"
    file.write_text('import uglorentz as ug\nug.Scene.read("a.ug").lorentz(velocty=(0.5, 0, 0), keep_in_view=3)\n')
    ran = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, str(file)],
                         capture_output=True, text=True)
    assert ran.returncode == 1
    assert "velocty" in ran.stdout and "keep_in_view" in ran.stdout, ran.stdout


def test_the_example(tmp_path):
    subprocess.run([sys.executable, str(FOLDER / "examples" / "passing.py")], cwd=tmp_path, check=True)
    assert len(list(tmp_path.glob("*.png"))) == 3


def test_plots():
    import matplotlib

    matplotlib.use("Agg")
    scene = ug.Scene.parse("v a -1 5 0; v b 1 5 0; v c 0 5 1; f (a b c); cam -ep 0 0 0 -vc 0 5 0;")
    picture = scene.photon(velocity=(0, -0.5, 0), size=(16, 12))
    axes = ug.plot.channel(picture, "D")
    (image,) = axes.get_images()
    # Diverging about 1.
    assert image.norm.vmin * image.norm.vmax == pytest.approx(1)
    assert image.norm(1.0) == pytest.approx(0.5)
    # Its scale has numbers, not powers of ten.
    bar = axes.figure.axes[1]
    axes.figure.canvas.draw()
    low, high = bar.get_ylim()
    shown = [text.get_text() for text in bar.get_yticklabels() if low <= text.get_position()[1] <= high]
    assert "1" in shown and len(shown) > 2 and not any("10" in text for text in shown), shown
    ug.plot.channel(picture, "distance")
    with pytest.raises(ValueError, match="velocity"):
        ug.plot.channel(picture, "velocity")


def test_remedies_are_python():
    with pytest.raises(ug.Error, match=r"write `velocity=\(X, Y, Z\)`"):
        ug.Scene.parse("v a 0 0 0;").lorentz(velocity=0.5)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks(notebook, tmp_path):
    import json

    cells = json.loads(notebook.read_text())["cells"]
    assert not any(cell.get("outputs") for cell in cells), "notebooks are stored without outputs"
    ran = subprocess.run(
        [sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output-dir", str(tmp_path),
         str(notebook)],
        capture_output=True, text=True,
    )
    assert ran.returncode == 0, ran.stderr[-3000:]


def test_there_are_notebooks():
    assert len(NOTEBOOKS) == 3
