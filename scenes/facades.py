#!/usr/bin/env python3
"""Draws the facades of town.ug: the same window in walls of bricks of different colours.

    ./facades.py [FOLDER]            default: the current folder

Frames, sills and glass have the same colours in all pictures, and all colours are those of matt
surfaces at most as white as paint, so no factor has to change them.
"""
import struct
import sys
import zlib

WIDTH, HEIGHT = 256, 384  # 2 m by 3 m
COURSE, BRICK = 12, 32  # pixels of a course and of a brick, joints included

# Bricks of a wall have five shades; colours are 8-bit sRGB.
WALLS = {
    "facade": (158, 88, 70),
    "facade-yellow": (190, 160, 112),
    "facade-brown": (118, 84, 68),
    "facade-grey": (150, 146, 140),
}
SHADES = (0.82, 0.92, 1.0, 1.06, 1.12)
MORTAR, FRAME, STONE, SHADE = (184, 178, 166), (236, 234, 226), (206, 200, 184), (122, 116, 104)
# From the sky's reflection above to the dark room below; nearly grey, since a blue paint would turn
# green or red in motion, and the light of the sky does not.
GLASS = [(98 - 4 * row, 106 - 4 * row, 116 - 4 * row) for row in range(16)]


def random(seed):
    """A number from 0 to 1 for each seed (an integer hash by Wang)."""
    seed = (seed ^ 61) ^ (seed >> 16)
    seed = seed * 9 & 0xFFFFFFFF
    seed ^= seed >> 4
    seed = seed * 0x27D4EB2D & 0xFFFFFFFF
    return (seed ^ seed >> 15) / 2**32


def wall(x, y):
    """Row in the palette of the wall, with half a brick of offset in every second course."""
    course = y // COURSE
    x += BRICK // 2 * (course % 2)
    if y % COURSE >= COURSE - 2 or x % BRICK >= BRICK - 2:
        return 0
    # The picture repeats, so its bricks do.
    return 1 + int(len(SHADES) * random(1 + course * 97 + x % WIDTH // BRICK))


def pixel(x, y):
    stone, frame, shade = len(SHADES) + 1, len(SHADES) + 2, len(SHADES) + 3
    if 54 <= x < 202 and 74 <= y < 90 or 50 <= x < 206 and 282 <= y < 296:
        return stone
    if 50 <= x < 206 and 296 <= y < 299:
        return shade
    if not (64 <= x < 192 and 90 <= y < 282):
        return wall(x, y)
    is_pane = (72 <= x < 124 or 132 <= x < 184) and (98 <= y < 146 or 154 <= y < 274)
    if not is_pane:
        return frame
    # Panes lie behind their frames, which shade their upper edges.
    if y in (98, 99, 154, 155):
        return shade + len(GLASS)
    return shade + 1 + (y - 98) * len(GLASS) // 176


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(palette, rows):
    """A PNG file with at most 32 colours, in a byte for each pixel."""
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 3, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)
    parts = [(b"IHDR", header), (b"PLTE", bytes(sum(palette, ()))), (b"IDAT", data), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunk(*part) for part in parts)


rows = [[pixel(x, y) for x in range(WIDTH)] for y in range(HEIGHT)]
for name, brick in WALLS.items():
    bricks = [tuple(min(255, round(shade * part)) for part in brick) for shade in SHADES]
    palette = [MORTAR, *bricks, STONE, FRAME, SHADE, *GLASS]
    folder = sys.argv[1] if len(sys.argv) > 1 else "."
    with open(f"{folder}/{name}.png", "wb") as file:
        file.write(png(palette, rows))
