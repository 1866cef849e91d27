#!/usr/bin/python3
"""Heights, slopes and normals: from a formula to a map on a mesh, and how far each step is from the truth.

relief.py [OUT_FOLDER]. Each part below is a cell of a notebook.
"""
# %% What is needed: numpy and bake. meshes/ is the folder of the sources.
import sys
from pathlib import Path

import numpy as np

import bake
from bake import arrays

meshes = Path(__file__).resolve().parents[2] / "meshes"
out = Path(sys.argv[1] if len(sys.argv) > 1 else "python-out")
out.mkdir(parents=True, exist_ok=True)

# %% A height by a formula: an egg box over the unit square. Row 0 is at the top, where v is 1.
n = 256
u = (np.arange(n) + 0.5) / n
v = 1 - u
amplitude, k = 0.02, 2 * np.pi * 4
height = (amplitude * np.cos(k * u)[None, :] * np.cos(k * v)[:, None]).astype(np.float32)

# %% Its slopes by the filters of bump_table, against the derivative of the formula.
true_u = -amplitude * k * np.sin(k * u)[None, :] * np.cos(k * v)[:, None]
for name in ("central", "sobel", "scharr", "order4", "order6", "c2"):
    table = arrays.bump_table(height, filter=name)
    error = np.abs(table[..., 0] - true_u).max() / np.abs(true_u).max()
    print(f"{name:8} largest error of b_u: {100 * error:.4f} %")

# %% Its normals. A map holds (n + 1) / 2; the angle to the true normal is what counts.
true_v = -amplitude * k * np.cos(k * u)[None, :] * np.sin(k * v)[:, None]
truth = np.stack([-true_u, -true_v, np.ones_like(true_u)], axis=-1)
truth /= np.linalg.norm(truth, axis=-1, keepdims=True)


def degrees(normals):
    normals = normals / np.linalg.norm(normals, axis=-1, keepdims=True)
    return np.degrees(np.arccos(np.clip((normals * truth).sum(axis=-1), -1, 1)))


normals = arrays.normal_map(height)
print(f"float normal map: mean {degrees(2 * normals.astype(float) - 1).mean():.5f} deg")
in_8_bits = np.round(normals * 255) / 255
print(f"in 8 bits: mean {degrees(2 * in_8_bits.astype(float) - 1).mean():.5f} deg")
arrays.write_image(out / "eggbox.png", normals)

# %% The same as a verb: what the command does, its result as a dict with the error budget.
arrays.write_image(out / "eggbox_height.exr", height, depth="float")
result = bake.normal_map(out / "eggbox_height.exr", out=out / "eggbox_verb.exr", extent=(1, 1))
print("error budget of the verb:", result["error_budget"])

# %% On a mesh the lengths and the curvature of the surface matter. The map is in MikkTSpace of the mesh.
torus = arrays.read_mesh(meshes / "torus.obj")
print(torus)
bricks = arrays.read_image(meshes / "bricks.png")
bricks = bricks if bricks.ndim == 2 else bricks[..., 0]
exact = arrays.normal_map(bricks, 0.08, torus, midlevel=0.5, size=(256, 256))
blinn = arrays.normal_map(bricks, 0.08, torus, midlevel=0.5, size=(256, 256), method="blinn")
print(f"dropping b n_u and b n_v changes colours by up to {np.abs(exact - blinn).max():.3f}")
arrays.write_image(out / "torus_normal.png", exact)

# %% And a look at it.
bake.render(out / "torus_normal.png", on="sphere", out=out / "ball.png", size=64, spp=4)
print("pictures are in", out)
