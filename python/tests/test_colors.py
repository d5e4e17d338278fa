"""Colours, textures and meshes of other packages: trimesh, Open3D, matplotlib, Pillow."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import PIL.Image
import pytest
import trimesh
from matplotlib import colormaps

import uglorentz as ug

SMALL = {"size": (60, 45)}
CAMERA = "cam -ep 3 -4 2 -vc 0 0 0; l 0.4; l 0.6 1 -3 2;"


def drawn(scene: ug.Scene, **options) -> np.ndarray:
    return scene.render(**SMALL, **options).pixels


@pytest.fixture
def box() -> trimesh.Trimesh:
    box = trimesh.creation.box()
    box.visual.face_colors = np.random.default_rng(3).integers(0, 256, (12, 3), np.uint8)
    return box


def test_colours_of_trimesh(box):
    """uint8 is from 0 to 255, with and without alpha, of faces and of vertices."""
    faces = box.visual.face_colors
    assert faces.dtype == np.uint8 and faces.shape == (12, 4)
    expected = drawn(ug.Scene.from_arrays(box.vertices, box.faces, colors=faces[:, :3] / 255, extra=CAMERA))
    assert len(np.unique(expected.reshape(-1, 3), axis=0)) > 20
    for colors in (faces, faces[:, :3], faces / 255, (faces / 255).astype(np.float32)):
        scene = ug.Scene.from_arrays(box.vertices, box.faces, colors=colors, extra=CAMERA)
        assert np.abs(drawn(scene).astype(int) - expected).max() <= 1
    coloured = trimesh.creation.box()
    coloured.visual.vertex_colors = np.random.default_rng(4).integers(0, 256, (8, 3), np.uint8)
    own = coloured.visual.vertex_colors
    assert own.dtype == np.uint8 and own.shape == (8, 4)
    of_vertices = ug.Scene.from_arrays(box.vertices, box.faces, vertex_colors=own, extra=CAMERA)
    again = ug.Scene.from_arrays(box.vertices, box.faces, vertex_colors=own[:, :3] / 255, extra=CAMERA)
    assert np.array_equal(drawn(of_vertices), drawn(again))
    one = ug.Scene.from_arrays(box.vertices, box.faces, colors=np.array([255, 128, 0, 255], np.uint8))
    assert one.text() == ug.Scene.from_arrays(box.vertices, box.faces, colors=(1, 128 / 255, 0)).text()


def test_colours_are_those_of_ply(box, tmp_path):
    (tmp_path / "box.ply").write_bytes(box.export(file_type="ply", encoding="ascii"))
    read = ug.Scene.read(tmp_path / "box.ply").photon(**SMALL)
    made = ug.Scene.from_arrays(box.vertices, box.faces, colors=box.visual.face_colors).photon(**SMALL)
    assert np.abs(read.pixels.astype(int) - made.pixels).max() <= 1


def test_alpha_lets_light_through():
    square = [[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]
    vertices = np.array([[x, y, z] for y in (0, 1) for x, _, z in square], float)
    extra = "cam -ep 0 -5 0 -vc 0 0 0; l 1;"

    def middle(**colors):
        scene = ug.Scene.from_arrays(vertices, [[0, 1, 2, 3], [4, 5, 6, 7]], extra=extra, **colors)
        return scene.render(size=(9, 9), format="exr").light[4, 4]

    assert middle(colors=[[1, 0, 0, 1], [0, 0, 1, 1]])[2] == 0
    for colors in (np.array([[255, 0, 0, 51], [0, 0, 255, 255]], np.uint8), [[1, 0, 0, 0.2], [0, 0, 1, 1]]):
        red, _, blue = middle(colors=colors)
        assert blue == pytest.approx(4 * red, rel=1e-3)
    of_vertices = np.repeat([[1, 0, 0, 0.2], [0, 0, 1, 1]], 4, axis=0)
    red, _, blue = middle(vertex_colors=of_vertices)
    assert blue == pytest.approx(4 * red, rel=1e-3)


def test_colours_of_matplotlib(box):
    levels = np.linspace(0, 1, 12)
    floats, whole = colormaps["viridis"](levels), colormaps["viridis"](levels, bytes=True)
    assert floats.shape == (12, 4)
    pictures = [drawn(ug.Scene.from_arrays(box.vertices, box.faces, colors=colors, extra=CAMERA))
                for colors in (floats, whole)]
    assert np.abs(pictures[0].astype(int) - pictures[1]).max() <= 1


class VectorOfOpen3d:
    """Arrays in all but name, as `open3d.utility.Vector3dVector`."""

    def __init__(self, rows, dtype=float):
        self.rows = np.array(rows, dtype).reshape(-1, 3)

    def __array__(self, dtype=None, copy=None):
        return self.rows.astype(dtype or self.rows.dtype)

    def __len__(self):
        return len(self.rows)

    def __iter__(self):
        return iter(self.rows)


def test_arrays_of_open3d(box):
    vertices, faces = VectorOfOpen3d(box.vertices), VectorOfOpen3d(box.faces, np.int32)
    plain = ug.Scene.from_arrays(box.vertices, box.faces)
    # A mesh without colours has an empty vector of them.
    assert ug.Scene.from_arrays(vertices, faces, vertex_colors=VectorOfOpen3d([])).text() == plain.text()
    own = np.random.default_rng(1).random((8, 3))
    expected = ug.Scene.from_arrays(box.vertices, box.faces, vertex_colors=own)
    assert ug.Scene.from_arrays(vertices, faces, vertex_colors=VectorOfOpen3d(own)).text() == expected.text()


TILE = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])


@pytest.mark.parametrize("arguments, keywords, message", [
    (TILE, {"colors": (2, 0, 0)}, "colors[0] is [2, 0, 0], and colours are from 0 to 1, or from 0 to 255 in an array of uint8"),
    (TILE, {"colors": np.array([[255, 0, 0]])}, "colors[0] is [255, 0, 0], and colours"),
    (TILE, {"colors": [[0, 0, 0, -1.0]]}, "colors[0] is [0.0, 0.0, 0.0, -1.0], and"),
    (TILE, {"vertex_colors": [[0, 0, 0], [0, 0, 1.5], [0, 0, 0]]}, "vertex_colors[1] is [0.0, 0.0, 1.5], and"),
    (TILE, {"vertex_colors": [[0, 0, 0], [0, 0, np.nan], [0, 0, 0]]}, "vertex_colors[1] is not finite: [0.0, 0.0, nan]"),
    (TILE, {"colors": np.zeros((1, 5))}, "colors: the shape is (1, 5) instead of (1, 3) or (1, 4)"),
    (TILE, {"colors": np.zeros((1, 2), np.uint8)}, "colors: the shape is (1, 2)"),
    (TILE, {"velocities": [[0, 1, 0]]}, "velocities[0] is [0.0, 1.0, 0.0]: its speed is 1, not below that of light, 1"),
    (TILE, {"velocities": (0, np.inf, 0)}, "velocities[0] is not finite"),
    ((TILE[0], [[0, 1, 2], [0, 1, 5]]), {}, "faces[1] is [0, 1, 5]: there is no vertex 5 among 3"),
    ((TILE[0], [[0, 1, 2], [0, 1, 2, -4]]), {}, "faces[1] is [0, 1, 2, -4]: there is no vertex -4"),
    ((TILE[0], np.array([[0, 1, 2], [0, 1, 9]])), {}, "faces[1] is [0, 1, 9]: there is no vertex 9"),
    ((TILE[0], [[0, 1, 2], [0]]), {}, "faces[1] has fewer than 3 corners: [0]"),
    (([[0, 0, 0], [1, np.nan, 0]], []), {}, "vertices[1] is not finite: [1.0, nan, 0.0]"),
    (TILE, {"texture": np.zeros((2, 2, 3), np.uint8)}, "texture= and texture_coordinates= are given together"),
    (TILE, {"texture": np.zeros((2, 2, 3), np.uint8), "texture_coordinates": [[0, 0]]}, "texture_coordinates: the shape is (1, 2) instead of (3, 2)"),
    (TILE, {"texture": np.zeros((2, 2, 3), np.uint8), "texture_coordinates": [[0, 0], [0, 0], [np.nan, 0]]}, "texture_coordinates[2] is not finite: [nan, 0.0]"),
    (TILE, {"texture": np.full((2, 2, 3), 1.5), "texture_coordinates": np.zeros((3, 2))}, "texture[0, 0] is [1.5, 1.5, 1.5], and colours"),
    (TILE, {"texture": np.zeros((2, 2, 5), np.uint8), "texture_coordinates": np.zeros((3, 2))}, "texture: the shape is (2, 2, 5)"),
    (TILE, {"texture": b"not a picture", "texture_coordinates": np.zeros((3, 2))}, "error: texture: cannot read `picture.png`"),
    (TILE, {"texture": np.zeros((2, 2, 3)), "texture_coordinates": np.zeros((3, 2)), "colors": (1, 0, 0)}, "leave out colors="),
])
def test_errors_name_argument_row_and_value(arguments, keywords, message):
    with pytest.raises(ug.Error) as caught:
        ug.Scene.from_arrays(*arguments, **keywords)
    assert message in str(caught.value)
    assert "<stdin>" not in str(caught.value) and caught.value.line is None


def test_notes_and_errors_of_rows():
    """What the programs find later is told by rows, too, and never by a line of a text."""
    bent = ug.Scene.from_arrays([[0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 1, 0]], [[0, 1, 2], [0, 1, 2, 3]])
    (note,) = bent.notes
    assert "faces[1]: " in note, note
    moving = ug.Scene.from_arrays(*TILE, velocities=(0.5, 0, 0))
    notes = moving.render(size=(9, 9)).notes
    assert any("faces[0]: " in note for note in notes), notes
    flat = ug.Scene.from_arrays([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
    (note,) = flat.notes
    assert "faces[0]: " in note, note
    for note in (*bent.notes, *notes, *flat.notes):
        assert "-->" not in note and "stdin" not in note and " | " not in note and "v0" not in note, note


def test_errors_in_extra_statements_have_its_lines():
    with pytest.raises(ug.Error) as caught:
        ug.Scene.from_arrays(*TILE, extra="l 1;\nv v0 1 2 3;")
    error = caught.value
    assert (error.file, error.line, error.column) == ("<extra>", 2, 3)
    assert error.message == "vertex `v0` is defined twice" and "\n  ::: vertices[0]" in str(error), error
    with pytest.raises(ug.Error) as caught:
        ug.Scene.from_arrays(*TILE, extra="cam -ep 0 0;")
    assert (caught.value.file, caught.value.line) == ("<extra>", 1)


@pytest.fixture
def painted() -> np.ndarray:
    """Four colours: red, green above blue, white."""
    rows = [[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]]
    return np.repeat(np.repeat(np.array(rows, np.uint8), 8, axis=0), 8, axis=1)


def square(texture, **keywords) -> ug.Scene:
    corners = [[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]
    return ug.Scene.from_arrays(corners, [[0, 1, 2, 3]], texture=texture, extra="cam -ep 0 -5 0 -vc 0 0 0; l 1;",
                                texture_coordinates=[[0, 0], [1, 0], [1, 1], [0, 1]], **keywords)


def corners(scene: ug.Scene) -> list[list[int]]:
    """The colours of the quarters of a square, by rows."""
    pixels = scene.render(size=(40, 40), view_angle=30).pixels > 150
    return [pixels[row, column, :3].astype(int).tolist() for row in (13, 26) for column in (13, 26)]


QUARTERS = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]


def test_textures(painted, tmp_path):
    file = tmp_path / "painted.png"
    PIL.Image.fromarray(painted).save(file)
    alpha = np.concatenate([painted, np.full((16, 16, 1), 255, np.uint8)], axis=2)
    for texture in (painted, painted / 255, alpha, file, file.read_bytes(), PIL.Image.open(file),
                    PIL.Image.fromarray(painted).convert("P")):
        assert corners(square(texture)) == QUARTERS
    assert corners(square(painted, vertex_colors=(1, 0, 0)))[3] == [1, 0, 0]
    # Without textures the faces have the mean of their light.
    mean = square(np.array([[[255, 0, 0], [0, 0, 0]]], np.uint8)).text()
    assert mean.startswith(f"c_rgb picture {float(ug.physics.srgb_encode(0.5))!r} 0") and "c_tex picture" in mean
    # Saved with its picture, and read from there.
    scene = square(painted)
    folder = tmp_path / "saved"
    folder.mkdir()
    scene.save(folder / "square.ug")
    assert sorted(path.name for path in folder.iterdir()) == ["picture.png", "square.ug"]
    assert corners(ug.Scene.read(folder / "square.ug")) == QUARTERS
    scene.save(folder / "again.ug")
    (folder / "picture.png").write_bytes(b"other")
    with pytest.raises(ug.Error, match="is there already"):
        scene.save(folder / "once-more.ug")
    assert not (folder / "once-more.ug").exists()


def test_files_in_memory(painted, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    PIL.Image.fromarray(painted).save("wall.png")
    text = ("c_rgb w 1 1 1; c_tex w \"wall.png\"; v a -1 0 -1 (0 1); v b 1 0 -1 (1 1); v c 1 0 1 (1 0);"
            "v d -1 0 1 (0 0); f (a b c d) w; include lights.ug;")
    Path("lights.ug").write_text("cam -ep 0 -5 0 -vc 0 0 0; l 1;")
    expected = corners(ug.Scene.parse(text))
    files = {name: Path(name).read_bytes() for name in ("wall.png", "lights.ug")}
    for name in files:
        Path(name).unlink()
    scene = ug.Scene.parse(text, files=files)
    assert corners(scene) == expected
    with pytest.raises(ug.Error, match="wall.png"):
        ug.Scene.parse(text, files={"lights.ug": files["lights.ug"]})
    # A film has them, too.
    scene.film("film.gif", frames=2, time=[0, 1], size=(20, 20))
    assert Path("film.gif").stat().st_size > 100


def test_a_mesh_of_trimesh(box):
    scene = ug.Scene.from_trimesh(box, extra=CAMERA)
    assert repr(scene) == "<Scene: 8 vertices, 12 faces, at rest>"
    expected = ug.Scene.from_arrays(box.vertices, box.faces, colors=box.visual.face_colors, extra=CAMERA)
    assert scene.text() == expected.text()
    box.visual.vertex_colors = np.random.default_rng(2).integers(0, 256, (8, 4), np.uint8)
    expected = ug.Scene.from_arrays(box.vertices, box.faces, vertex_colors=box.visual.vertex_colors, extra=CAMERA)
    assert ug.Scene.from_trimesh(box, extra=CAMERA).text() == expected.text()
    moving = ug.Scene.from_trimesh(box, velocities=(0.5, 0, 0), threads=1)
    assert moving.lorentz(time=0).vertices_as_seen()["velocity"][0].tolist() == [0.5, 0, 0]
    plain = ug.Scene.from_trimesh(trimesh.Trimesh(box.vertices, box.faces, process=False))
    assert plain.text() == ug.Scene.from_arrays(box.vertices, box.faces).text()


def test_a_scene_of_trimesh(box, painted):
    ball = trimesh.creation.icosphere(subdivisions=1)
    ball.visual.vertex_colors = [0, 0, 255, 255]
    plane = trimesh.Trimesh([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], [[0, 1, 2], [0, 2, 3]], process=False)
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    material = trimesh.visual.material.SimpleMaterial(image=PIL.Image.fromarray(painted))
    plane.visual = trimesh.visual.TextureVisuals(uv=uv, material=material)
    whole = trimesh.Scene()
    whole.add_geometry(box, node_name="box", transform=trimesh.transformations.translation_matrix([5, 0, 0]))
    mirrored = np.diag([1.0, 1.0, -1.0, 1.0])
    mirrored[:3, 3] = [-5, 0, 0]
    whole.add_geometry(ball, node_name="the ball", transform=mirrored)
    whole.add_geometry(plane, node_name="plane")
    whole.add_geometry(trimesh.PointCloud([[0, 0, 0]]), node_name="points")
    scene = ug.Scene.from_trimesh(whole, extra="cam -ep 0 -5 0 -vc 0 0 0; l 1;")
    assert len(scene.faces) == 12 + len(ball.faces) + 2
    (note,) = scene.notes
    assert "'points' has no faces" in note
    assert scene.vertices[:8].tolist() == (box.vertices + [5, 0, 0]).tolist()
    assert "box_v0" in scene.names and "the_ball_v0" in scene.names
    # A mirror image has its outside outside.
    corners_of_ball = scene.vertices[scene.faces[12]]
    normal = np.cross(corners_of_ball[1] - corners_of_ball[0], corners_of_ball[2] - corners_of_ball[0])
    assert normal @ (corners_of_ball.mean(axis=0) - [-5, 0, 0]) > 0
    assert corners(scene) == QUARTERS
    with pytest.raises(ug.Error, match="faces to draw"):
        ug.Scene.from_trimesh(trimesh.Scene())
    with pytest.raises(TypeError, match="trimesh is expected, not str"):
        ug.Scene.from_trimesh("box.stl")
    with pytest.raises(ug.Error, match="up="):
        ug.Scene.from_trimesh(box, up="x")


def test_gltf_through_trimesh(tmp_path):
    """The same picture as that of the file itself."""
    (tmp_path / "crate.gltf").write_bytes(ug.example_file("crate.gltf"))
    scene = trimesh.load(tmp_path / "crate.gltf")
    made = ug.Scene.from_trimesh(scene, up="y").photon(size=(80, 60))
    read = ug.Scene.example("crate.gltf").photon(size=(80, 60))
    assert np.abs(made.pixels.astype(int) - read.pixels).max() <= 2
    assert len(np.unique(read.pixels.reshape(-1, 3), axis=0)) > 50


def test_skies_with_alpha():
    sky = np.random.default_rng(8).random((32, 64, 4)).astype(np.float32)
    options = {"camera_velocity": (0, 0.5, 0), "size": (40, 30)}
    assert ug.warp(sky, **options).to_bytes() == ug.warp(sky[:, :, :3], **options).to_bytes()
    whole = (sky * 255).astype(np.uint8)
    assert ug.warp(whole, **options).to_bytes() == ug.warp(whole[:, :, :3], **options).to_bytes()
    sky[3, 5, 1] = np.nan
    with pytest.raises(ug.Error, match=r"sky\[3, 5\] is not finite: \["):
        ug.warp(sky, **options)
