#!/usr/bin/python3
"""Skies: one by a formula, its irradiance by two methods, and what a rough mirror sees of it.

skies.py [OUT_FOLDER]. Each part below is a cell of a notebook.
"""
# %%
import sys
from pathlib import Path

import numpy as np

import bake
from bake import arrays

out = Path(sys.argv[1] if len(sys.argv) > 1 else "python-out")
out.mkdir(parents=True, exist_ok=True)

# %% The directions of the texels of a cube, in cube space: left-handed, +Z ahead, +X right, +Y up.
n = 64
s, t = np.meshgrid((np.arange(n) + 0.5) / n * 2 - 1, (np.arange(n) + 0.5) / n * 2 - 1)
one = np.ones_like(s)
names = ("px", "nx", "py", "ny", "pz", "nz")
directions = [np.stack(face, axis=-1) for face in (
    (one, -t, -s), (-one, -t, s), (s, one, t), (s, -one, -t), (s, -t, one), (-s, -t, -one))]
directions = [d / np.linalg.norm(d, axis=-1, keepdims=True) for d in directions]

# %% A blue sky over grey ground, and a sun of about 3 degrees.
sun = np.array([0.4, 0.6, 0.7])
sun /= np.linalg.norm(sun)


def radiance(d):
    up = np.clip(d[..., 1:2], 0, 1)
    sky = np.where(d[..., 1:2] > 0, np.array([0.3, 0.5, 1.0]) * (0.4 + 0.6 * up), [0.15, 0.14, 0.12])
    return sky + 500 * np.array([1.0, 0.95, 0.85]) * ((d @ sun) > np.cos(np.radians(1.5)))[..., None]


sky = [radiance(d).astype(np.float32) for d in directions]

# %% Irradiance: the sum over all texels, and three bands of spherical harmonics as engines use them.
direct = arrays.irradiance(sky, size=16)
for bands in (3, 5, 9):
    sh = arrays.irradiance(sky, size=16, method="sh", bands=bands)
    error = max(np.abs(a - b).max() for a, b in zip(direct, sh)) / max(face.max() for face in direct)
    print(f"spherical harmonics, {bands} bands: largest error {100 * error:.2f} % of the largest irradiance")

# %% In a direction: what a white surface that faces the sun gets.
print("irradiance towards the sun:", arrays.sample_sky(direct, [sun])[0])

# %% The levels of a specular chain. progress is called a few times a second.
levels = arrays.prefilter(sky, [0.0, 0.1, 0.3, 0.6, 1.0], progress=lambda step, done, total: print(step, done, "of", total))
for level in levels:
    print(f"{level[0].shape[0]:3} texels along an edge, brightest {max(face.max() for face in level):8.2f}")

# %% As files, and as one picture by the verb cubemap.
for name, face in zip(names, sky):
    arrays.write_image(out / f"sky_{name}.exr", face, depth="float")
result = bake.cubemap(str(out / "sky_%s.exr"), out=out / "sky.exr", to="latlong")
print("written:", result.get("out", out / "sky.exr"))
