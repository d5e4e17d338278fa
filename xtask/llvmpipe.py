#!/usr/bin/env python3
"""Draws a mesh with Mesa llvmpipe (OpenGL in software), for comparison in `cargo xtask bench-raster`.

    python3 xtask/llvmpipe.py MESH

Requires the Debian packages libegl1 libegl-mesa0 libgl1-mesa-dri and the Python packages numpy and moderngl.
LP_NUM_THREADS sets the number of threads.

MESH contains the numbers of vertices and triangles as two u32, position and colour of each vertex as six f32, and
three u32 for each triangle; all little-endian. Requests are read from standard input, one per line: width, height, 1
to cull back faces or else 0, the 16 numbers of the matrix from scene to clip space in column-major order, and a file
or "-". The answer is the time in seconds from clearing the frame to the end of drawing. The pixels are written to the
file, four bytes each, rows from the top.
"""
import os
import sys
import time

os.environ.setdefault("EGL_PLATFORM", "surfaceless")
os.environ.setdefault("GALLIUM_DRIVER", "llvmpipe")
os.environ.setdefault("LIBGL_ALWAYS_SOFTWARE", "1")

import moderngl
import numpy as np

VERTEX = """#version 330
uniform mat4 clip_from_scene;
in vec3 position;
in vec3 color;
out vec3 interpolated;
void main() { gl_Position = clip_from_scene * vec4(position, 1.0); interpolated = color; }
"""
FRAGMENT = """#version 330
in vec3 interpolated;
out vec4 pixel;
void main() { pixel = vec4(interpolated, 1.0); }
"""


def main():
    gl = moderngl.create_standalone_context(backend="egl", libgl="libGL.so.1", libegl="libEGL.so.1")
    if "llvmpipe" not in gl.info["GL_RENDERER"]:
        sys.exit("not llvmpipe but " + gl.info["GL_RENDERER"])
    print(gl.info["GL_RENDERER"], gl.info["GL_VERSION"], flush=True)
    with open(sys.argv[1], "rb") as file:
        vertices, triangles = np.fromfile(file, "<u4", 2)
        table = gl.buffer(np.fromfile(file, "<f4", 6 * vertices).tobytes())
        corners = gl.buffer(np.fromfile(file, "<u4", 3 * triangles).tobytes())
    program = gl.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
    mesh = gl.vertex_array(program, [(table, "3f 3f", "position", "color")], corners)
    gl.enable(moderngl.DEPTH_TEST)
    frames = {}
    for line in sys.stdin:
        width, height, cull, *matrix, file = line.split()
        size = int(width), int(height)
        if size not in frames:
            frames[size] = gl.framebuffer(gl.renderbuffer(size, 4), gl.depth_renderbuffer(size))
        frame = frames[size]
        frame.use()
        (gl.enable if cull == "1" else gl.disable)(moderngl.CULL_FACE)
        program["clip_from_scene"].write(np.array(matrix, "f4").tobytes())
        gl.finish()
        start = time.perf_counter()
        frame.clear(0, 0, 0, 1, depth=1)
        mesh.render()
        gl.finish()
        seconds = time.perf_counter() - start
        if file != "-":
            np.frombuffer(frame.read(components=4), "u1").reshape(size[1], size[0], 4)[::-1].tofile(file)
        print(seconds, flush=True)


main()
