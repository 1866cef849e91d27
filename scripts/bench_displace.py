#!/usr/bin/env python3
"""bake displace beside Blender's Subdivision and Displace modifiers, whole commands from file to file, in turn.

bench_displace.py BUILD_FOLDER WORK_FOLDER ROUNDS MILLIONS...: prints rows as the other benches do. Each cage is brought to
as near a number of million quads as whole levels allow. bake writes .ply, .obj and .glb, Blender .obj, which is its fastest."""
import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

home = Path(__file__).resolve().parent.parent
bake, work, rounds = Path(sys.argv[1]).resolve() / "bake", Path(sys.argv[2]).resolve(), int(sys.argv[3])
height, amplitude = home / "meshes" / "bricks.png", "0.02"
spot = home.parent / "shared/data/meshes/spot/spot_control_mesh.obj"
blender = ["blender", "-b", "--factory-startup", "-P", str(home / "scripts/bench_blender.py"), "--"]
os.chdir(work)


def run(command):
    """Seconds, peak MiB and stdout of a command that must succeed."""
    begin = time.perf_counter()
    with open("stdout", "w+") as out, open("log", "a") as log:
        child = subprocess.Popen(command, stdout=out, stderr=log)
        status, usage = os.wait4(child.pid, 0)[1:]
        seconds = time.perf_counter() - begin
        out.seek(0)
        text = out.read()
    if status != 0:
        sys.exit(f"bench_displace: failed: {' '.join(map(str, command))}; see {work}/log")
    return seconds, usage.ru_maxrss / 1024, text


def ours(cage, levels, out):
    """Seconds, seconds of the steps between reading and writing, peak MiB, faces."""
    seconds, peak, text = run([bake, "displace", cage, "--height", height, "--amplitude", amplitude, "--midlevel", "0.5",
                               "--subdivide", "catmark", "--levels", str(levels), "-o", out, "--json"])
    report = json.loads(text)
    steps = report["seconds"]
    return {"seconds": seconds, "steps": steps["base"] + steps["height"] + steps["displace"], "peak": peak,
            "faces": report["faces"]}


def theirs(cage, levels, out):
    """The same, and the seconds from import to export, without Blender's start."""
    seconds, peak, text = run(blender + ["displace", str(cage), str(height), str(levels), amplitude, out])
    found = next(line for line in text.splitlines() if line.startswith("SECONDS ")).split()
    return {"seconds": seconds, "started": float(found[1]), "steps": float(found[2]), "peak": peak, "faces": int(found[4])}


def median(runs, key):
    return statistics.median(r[key] for r in runs)


def ratio(ours_runs, their_runs, our_key, their_key):
    """Of times, pair by pair: a neighbour that slows one of a pair slows both."""
    return statistics.median(t[their_key] / o[our_key] for o, t in zip(ours_runs, their_runs))


def row(case, faces, seconds, errors, over, against, note):
    print(f"displace_file,{case},{faces},{os.cpu_count()},{1e9 * seconds / faces:.4g},"
          + ",".join(f"{e:.3g}" for e in errors) + f",{over:.3g},{against},{note}", flush=True)


def agreement():
    """Angles between the normals of the two results, and their mean distance as a part of the diagonal."""
    found = json.loads(run([bake, "check", "ours.ply", "--against", "theirs.obj", "--json"])[2])["files"][0]
    angles = found["there"]["file_normals_deg"]
    return [angles["mean"], angles["p95"], angles["max"]], found["there"]["mean"] / found["diagonal"]


def compare(name, cage, our_levels, their_levels):
    endings = ("ply", "obj", "glb")
    runs = {ending: [] for ending in endings}
    their_runs = []
    for _ in range(rounds):
        for ending in endings + ("blender",):
            out = "theirs.obj" if ending == "blender" else f"ours.{ending}"
            # Twice, and the second counts: a virtual machine may have given free memory back, and fetching it takes
            # longer than the work. Nobody is to wait for the disk to take what was written before.
            for _ in range(2):
                Path(out).unlink(missing_ok=True)
                os.sync()
                found = theirs(cage, their_levels, out) if ending == "blender" else ours(cage, our_levels, out)
            (their_runs if ending == "blender" else runs[ending]).append(found)
    faces = their_runs[0]["faces"]
    if faces != runs["ply"][0]["faces"]:
        sys.exit(f"bench_displace: {name}: {runs['ply'][0]['faces']} faces against {faces}")
    errors, apart = agreement() if faces < 2500000 else ([0, 0, 0], None)
    for ending in endings:
        own = runs[ending]
        seconds, times = median(own, "seconds"), ratio(own, their_runs, "seconds", "seconds")
        note = (f"{seconds:.3g} s; Blender takes {times:.3g} times as long; "
                f"{ratio(own, their_runs, 'seconds', 'started'):.3g} without its start; "
                f"{ratio(own, their_runs, 'steps', 'steps'):.3g} without reading and writing ({median(own, 'steps'):.3g} s); "
                f"peak {median(own, 'peak'):.0f} MiB against {median(their_runs, 'peak'):.0f}")
        if apart is not None:
            note += f"; {apart:.2g} of the diagonal from Blender's result"
        else:
            note = "no error: results of up to 2.5 M faces alone are compared; " + note
        row(f"{name}_{ending}", faces, seconds, errors, 1 / times, "Blender OBJ", note)
    row(f"{name}_blender", faces, median(their_runs, "seconds"), [0, 0, 0], 1, "",
        f"no error: the others are compared with it; {median(their_runs, 'seconds'):.3g} s; {median(their_runs, 'started'):.3g} s without its start; "
        f"{median(their_runs, 'steps'):.3g} s for the modifiers; peak {median(their_runs, 'peak'):.0f} MiB")
    for out in ("ours.ply", "ours.obj", "ours.glb", "theirs.obj"):
        Path(out).unlink()


for shape in ("cube", "suzanne"):
    run(blender + ["cage", shape, f"{shape}.obj"])
# Levels for one million quads, ours and Blender's. Blender's first level makes quads of faces that are none; bake does that
# before its first.
cages = [("cube", Path("cube.obj"), 9, 9), ("suzanne", Path("suzanne.obj"), 4, 5)]
cages.append(("spot", spot, 5, 6) if spot.exists() else ("torus", home / "meshes" / "torus.obj", 4, 4))
for millions in map(int, sys.argv[4:]):
    more = {1: 0, 4: 1}[millions]
    for name, cage, our_levels, their_levels in cages:
        compare(f"{name}_{millions}M", cage, our_levels + more, their_levels + more)
