"""Uses the Python module as it is installed: a verb, a JPEG, and a bake from array to array against a closed form."""
import bake
import numpy

table = bake.bump_table("/try/bricks.png", out="/try/bump.exr")
assert table["filter"] == "c2" and table["width"] == 512, table
assert bake.check("/try/dots.jpg")["verb"] == "check"  # JPEG is read by the helper program

# b = .05 sin(2 pi u) on the unit square: the normal is (-b_u, 0, 1), normalised.
n = 256
u = (numpy.arange(n, dtype="f") + 0.5) / n
height = numpy.tile(0.05 * numpy.sin(2 * numpy.pi * u), (n, 1)).astype("f")
normals = 2 * bake.arrays.normal_map(height) - 1
slope = 0.05 * 2 * numpy.pi * numpy.cos(2 * numpy.pi * u)
truth = numpy.stack([-slope, 0 * slope, 1 + 0 * slope], 1) / numpy.sqrt(1 + slope**2)[:, None]
error = numpy.degrees(numpy.arccos(numpy.clip((normals * truth).sum(2), -1, 1))).max()
assert error < 0.1, error

try:
    bake.check("/try/nowhere.png")
except bake.Error as refusal:
    assert refusal.exit_code == 3 and refusal.file == "/try/nowhere.png"
else:
    raise AssertionError("a file that is not there was not refused")
print(f"bake {bake.__version__} {bake.commit} in {bake.__file__}: a sine wave's normals are within {error:.4f} degrees")
