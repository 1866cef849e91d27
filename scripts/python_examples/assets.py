#!/usr/bin/python3
"""Many assets: checks, maps with progress, refusals, measured differences, and a plan.

assets.py [OUT_FOLDER]. Each part below is a cell of a notebook.
"""
# %%
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import bake
from bake import arrays

meshes = Path(__file__).resolve().parents[2] / "meshes"
out = Path(sys.argv[1] if len(sys.argv) > 1 else "python-out")
out.mkdir(parents=True, exist_ok=True)

# %% What is in the files. A dict has what `bake check --json` prints.
report = bake.check(meshes / "torus.obj", meshes / "bricks.png")
for file in report["files"]:
    print("checked:", Path(file["file"]).name)

# %% A file that cannot be used is an exception with the file and the exit code of the command.
try:
    bake.normal_map(meshes / "missing.obj", height=meshes / "bricks.png", out=out / "none.png")
except bake.Error as error:
    print(f"refused with {error.exit_code}, file {Path(error.file).name}: {str(error).split(': ', 1)[1]}")

# %% Several maps at once. The GIL is released, so that threads of Python work in parallel.
heights = [meshes / name for name in ("bricks.png", "dots.png", "ripples.png")]


def map_of(height):
    target = out / f"{height.stem}_normal.png"
    bake.normal_map(height, out=target, amplitude=0.05, threads=1)
    return target


with ThreadPoolExecutor(2) as pool:
    for target in pool.map(map_of, heights):
        print("written:", target.name, arrays.read_image(target).shape)

# %% How much a viewer sees of 8 bits: pictures of one scene with both maps, and their FLIP.
bake.normal_map(heights[0], out=out / "fine.exr", amplitude=0.05)
bake.normal_map(heights[0], out=out / "coarse.png", amplitude=0.05, depth=8)
pictures = []
for name in ("fine.exr", "coarse.png"):
    picture = out / f"{Path(name).stem}_ball.exr"
    bake.render(out / name, on="sphere", out=picture, size=64, spp=16)
    pictures.append(np.ascontiguousarray(arrays.read_image(picture)[..., :3]))
print(f"mean FLIP of 8 bits: {arrays.flip(*pictures).mean():.5f}")

# %% A plan: the cheapest model of each relief of a scene within a budget.
plan = bake.plan(meshes / "studs.toml", size=64, budget="rmse=0.017", cost="triangles=1", out=out / "planned.toml",
                 manifest=out / "bakes.toml", progress=lambda step, done, total: None)
print("plan of", len(plan["objects"]), "objects, over the budget:", plan["over_budget"])
