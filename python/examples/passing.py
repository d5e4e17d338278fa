"""Three pictures of a cube that passes, faster and faster."""

import numpy as np

import uglorentz as ug

corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
colors = ug.physics.srgb_encode(np.eye(3)[[0, 0, 1, 1, 2, 2]] * 0.6 + 0.2)
cube = ug.Scene.from_arrays(corners, faces, colors=colors, extra="cam -ep 2 -6 3 -vc 0 0 0;")

for beta in (0, 0.5, 0.9):
    seen = cube.lorentz(velocity=(beta, 0, 0), keep_in_view=True)
    picture = seen.doppler(look="light").render(look="light", exposure=0, size=(320, 240))
    picture.save(f"cube-{beta}.png")
    measured = seen.vertices_as_seen()
    print(f"{beta} c: D from {measured['doppler'].min():.2f} to {measured['doppler'].max():.2f}")
