"""A relativistic renderer to begin with: the shapes of the suite, in NumPy.

    for case in sphere panorama cube edge depth; do
        python3 renderer.py $case > $case.png && ugconformance score-image $case $case.png
    done

It needs `ugconformance` in the path and knows nothing else of this project. A ray against the light is
transformed into the frame of each body, where the body rests, and of all points that it meets there the one
that is nearest to the eye in the frame of the eye is seen. Colours are as at rest.
"""

import csv
import struct
import subprocess
import sys
import zlib

import numpy as np

# The suite has polygons; these are exact: centre and radius in the frame of the body.
SPHERES = {"sphere": ([0, 3, 0], 1), "panorama": ([3 * np.cos(np.pi / 6), 3 * np.sin(np.pi / 6), 0], 1)}


def suite(*words):
    return subprocess.run(["ugconformance", *words], capture_output=True, text=True, check=True).stdout


def rays(camera):
    """Unit vectors from the eye through the middle of each pixel."""
    width, height = int(camera["width"]), int(camera["height"])
    vector = lambda name: np.array([float(camera[f"{name}_{axis}"]) for axis in "xyz"])
    forward = vector("centre") - vector("eye")
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, vector("up"))
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    x = (np.arange(width) + 0.5) / width * 2 - 1
    y = 1 - (np.arange(height) + 0.5) / height * 2
    if camera["lens"] == "equirectangular":
        longitude, latitude = x[None, :, None] * np.pi, y[:, None, None] * np.pi / 2
        ahead, across = np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude)
        return vector("eye"), ahead * forward + across * right + np.sin(latitude) * up
    half = np.tan(np.radians(float(camera["horizontal_view_angle_deg"])) / 2)
    through = forward + half * (x[None, :, None] * right + y[:, None, None] * height / width * up)
    return vector("eye"), through / np.linalg.norm(through, axis=-1, keepdims=True)


def boosted(time, place, beta):
    """An event, or a ray against the light (time -1), in the frame of a body."""
    speed2 = beta @ beta
    if speed2 == 0:
        return time, place
    gamma = 1 / np.sqrt(1 - speed2)
    along = place @ beta
    return gamma * (time - along), place + ((gamma - 1) / speed2 * along - gamma * time)[..., None] * beta


def triangles(mesh):
    """The triangles of an OBJ file: object, corners."""
    vertices, name, found = [], "", []
    for line in mesh.splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append([float(number) for number in rest[:3]])
        elif word == "usemtl":
            name = rest[0]
        elif word == "f":
            corners = [np.array(vertices[int(corner.split("/")[0]) - 1]) for corner in rest]
            found += [(name, corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]
    return found


def hit_triangle(origin, direction, a, b, c):
    """The length along the ray, infinite where it misses."""
    normal = np.cross(b - a, c - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        length = (a - origin) @ normal / (direction @ normal)
        point = origin + length[..., None] * direction
    inside = np.isfinite(length) & (length > 0)
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= np.cross(q - p, point - p) @ normal >= -1e-12 * (normal @ normal)
    return np.where(inside, length, np.inf)


def hit_sphere(origin, direction, centre, radius):
    along = ((np.array(centre) - origin) * direction).sum(-1)
    off = (np.array(centre) - origin) @ (np.array(centre) - origin) - along**2
    return np.where((along > 0) & (off < radius**2), along - np.sqrt(np.maximum(radius**2 - off, 0)), np.inf)


def draw(case):
    camera = next(row for row in csv.DictReader(suite("table", "cameras").splitlines()) if row["case"] == case)
    eye, directions = rays(camera)
    picture, nearest = np.zeros(directions.shape), np.full(directions.shape[:2], np.inf)
    mesh = [] if case in SPHERES else triangles(suite("mesh", case))
    for row in csv.DictReader(suite("table", "objects").splitlines()):
        if row["case"] != case:
            continue
        beta = np.array([float(row[axis]) for axis in ("vx", "vy", "vz")])
        kind, *numbers = row["colour"].split()
        colour = np.array([float(number) for number in numbers]) if kind == "srgb" else np.ones(3)
        _, origin = boosted(np.float64(0), eye, beta)
        time, against = boosted(-np.ones(directions.shape[:2]), directions, beta)
        frequency = -time  # 1/D: a length along the ray in the frame of the body is this times that of the eye
        ray = against / frequency[..., None]
        if case in SPHERES:
            hits = [hit_sphere(origin, ray, *SPHERES[case])]
        else:
            hits = [hit_triangle(origin, ray, *corners) for name, *corners in mesh if name == row["object"]]
        for length in hits:
            distance = length / frequency
            picture[distance < nearest] = colour
            nearest = np.minimum(nearest, distance)
    return picture


def png(picture):
    pixels = (picture * 255).round().astype(np.uint8)
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: renderer.py CASE > picture.png; `ugconformance table cameras` lists the cases")
    sys.stdout.buffer.write(png(draw(sys.argv[1])))
