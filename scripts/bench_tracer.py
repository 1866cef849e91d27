#!/usr/bin/env python3
"""bake render beside Cycles and POV-Ray: the displaced torus of meshes/, one million triangles under one sun, 1024 x 1024
pixels of one sample, direct light alone, in turn.

bench_tracer.py BUILD_FOLDER WORK_FOLDER ROUNDS: prints rows as the other benches do. Compared is the time of rendering
alone: bake's seconds of rendering, Cycles' second picture with persistent data, POV-Ray's trace time."""
import json
import os
import re
import statistics
import subprocess
import sys
from pathlib import Path

home = Path(__file__).resolve().parent.parent
bake, work, rounds = Path(sys.argv[1]).resolve() / "bake", Path(sys.argv[2]).resolve(), int(sys.argv[3])
size, mesh = 1024, "torus_1M.obj"
os.chdir(work)


def run(command):
    """Its output, both streams; it must succeed."""
    done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f"bench_tracer: failed: {' '.join(map(str, command))}: {done.stdout[-500:]}")
    return done.stdout


def numbers(line):
    return [float(word) for word in line.split()[1:]]


def write_povray_scene():
    """The triangles of the mesh with its normals; POV-Ray is left-handed, hence the minus."""
    points, normals, faces = [], [], []
    for line in open(mesh):
        if line.startswith("v "):
            points.append(numbers(line))
        elif line.startswith("vn "):
            normals.append(numbers(line))
        elif line.startswith("f "):
            corners = [word.split("/") for word in line.split()[1:]]
            for k in range(1, len(corners) - 1):
                faces.append([corners[0], corners[k], corners[k + 1]])

    def vectors(name, values):
        return f"{name} {{ {len(values)}" + "".join(f",<{x:.7g},{y:.7g},{-z:.7g}>" for x, y, z in values) + " }\n"

    def triangles(name, which):
        rows = (",<" + ",".join(str(int(corner[which]) - 1) for corner in face) + ">" for face in faces)
        return f"{name} {{ {len(faces)}" + "".join(rows) + " }\n"

    with open("torus.pov", "w") as out:
        out.write("#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 1 }\n"
                  "camera { perspective location <0,2.4,-2.4> right x up y angle 45 look_at <0,0,0> }\n"
                  "light_source { <1000,2000,-1500> color rgb 1 parallel point_at <0,0,0> }\nmesh2 {\n")
        out.write(vectors("vertex_vectors", points) + vectors("normal_vectors", normals))
        out.write(triangles("face_indices", 0) + triangles("normal_indices", 2))
        out.write("texture { pigment { color rgb <.6,.5,.4> } finish { ambient 0 diffuse 1 phong .3 phong_size 32 } } }\n")


def ours():
    text = run([bake, "render", "torus.toml", "-o", "ours.png", "--json"])
    found = json.loads(text[text.index("{"):])
    return found["seconds"]["render"], found["rays"]


def cycles():
    text = run(["blender", "-b", "--factory-startup", "-P", home / "scripts/bench_blender.py", "--", "render", mesh, size])
    found = next(line for line in text.splitlines() if line.startswith("SECONDS ")).split()
    return (float(found[1]),)


def povray():
    text = run(["povray", "+Itorus.pov", "+Otheirs.png", f"+W{size}", f"+H{size}", "-A", "-D", "-V"])
    return (float(re.search(r"Trace Time:.*\(([\d.]+) seconds\)", text)[1]),)


run([bake, "displace", home / "meshes/torus.obj", "--height", home / "meshes/bricks.png", "--amplitude", "1%", "--midlevel",
     "0.5", "--levels", "4", "-o", mesh, "--quiet"])
Path("torus.toml").write_text(f"""camera = {{position = [0, 2.4, 2.4], target = [0, 0, 0], fov-deg = 45}}
render = {{size = [{size}, {size}], spp = 1, bounces = 0}}
material = [{{name = "m", brdf = "phong", diffuse = [0.6, 0.5, 0.4], specular = 0.3, shininess = 32}}]
mesh = [{{file = "{mesh}", material = "m"}}]
light = [{{type = "directional", from = [1, 2, 1.5]}}]
""")
write_povray_scene()
found = [(ours(), cycles(), povray()) for _ in range(rounds)]
pixels = size * size


def row(case, which, note):
    seconds = statistics.median(r[which][0] for r in found)
    ratio = statistics.median(r[which][0] / r[0][0] for r in found)
    print(f"tracer_file,{case},1048576,{os.cpu_count()},{1e9 * seconds / pixels:.4g},0,0,0,{ratio:.3g},bake render,"
          f"no error: one sample per pixel; pictures of three programs are not compared; {seconds:.3g} s of rendering{note}", flush=True)


row("bake render", 0, f"; {statistics.median(r[0][1] / r[0][0] for r in found) * 1e-6:.3g} M rays/s")
row("Cycles", 1, "; one sample; the second picture of a run")
row("POV-Ray", 2, "; its trace time")
for name in (mesh, "torus.pov", "ours.png", "theirs.png"):
    Path(name).unlink(missing_ok=True)
