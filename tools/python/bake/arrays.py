"""Functions on numpy arrays.

Pictures are arrays of shape (height, width) or (height, width, channels), row 0 at the top. Arrays that are given are copied,
as float32. Results own the memory of the library, without a copy. Every function releases the GIL, ends with
KeyboardInterrupt on Ctrl-C, and raises bake.Error for what it refuses.
"""
from ._bake import (Mesh, bump_table, flip, irradiance, normal_map, prefilter, read_image, read_mesh, read_sky, sample_sky,
                    surface, write_image, write_mesh)

__all__ = ["Mesh", "bump_table", "flip", "irradiance", "normal_map", "prefilter", "read_image", "read_mesh", "read_sky",
           "sample_sky", "surface", "write_image", "write_mesh"]
