"""Normal maps, bump tables, displaced meshes and environment maps.

Every verb of the command is a function: bake.normal_map("mesh.obj", height="bricks.png", amplitude="1%", out="normal.png").
The options are those of the command with _ for -, and from_ for --from. What the command prints under --json comes back as a
dict. progress is called as progress(step, done, total). bake.arrays has functions on numpy arrays.
"""
from . import arrays
from ._bake import __version__, commit
from ._verbs import make_verbs
from .error import Error

_functions = make_verbs()
globals().update(_functions)
__all__ = ["Error", "arrays", "__version__", "commit", *_functions]
