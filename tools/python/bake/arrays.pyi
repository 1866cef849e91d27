import os
from typing import Callable, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float32]
Indices = npt.NDArray[np.uint32]
Progress = Callable[[str, int, int], object]
Path = Union[str, "os.PathLike[str]"]

class Mesh:
    def __init__(
        self,
        positions: npt.ArrayLike,
        faces: npt.ArrayLike,
        *,
        uvs: Optional[npt.ArrayLike] = ...,
        corner_uv: Optional[npt.ArrayLike] = ...,
        normals: Optional[npt.ArrayLike] = ...,
        corner_normal: Optional[npt.ArrayLike] = ...,
    ) -> None: ...
    @property
    def positions(self) -> Floats: ...
    @property
    def normals(self) -> Floats: ...
    @property
    def uvs(self) -> Floats: ...
    @property
    def tangents(self) -> Floats: ...
    @property
    def face_begin(self) -> Indices: ...
    @property
    def corner_position(self) -> Indices: ...
    @property
    def corner_normal(self) -> Indices: ...
    @property
    def corner_uv(self) -> Indices: ...
    @property
    def origin(self) -> tuple[float, float, float]: ...
    @property
    def attributes(self) -> dict[str, Floats]: ...

def read_image(path: Path, *, threads: int = ...) -> Floats: ...
def write_image(path: Path, image: npt.ArrayLike, *, depth: str = ..., threads: int = ...) -> None: ...
def normal_map(
    height: npt.ArrayLike,
    amplitude: float = ...,
    mesh: Optional[Mesh] = ...,
    *,
    midlevel: float = ...,
    extent: Optional[tuple[float, float]] = ...,
    wrap: str = ...,
    filter: str = ...,
    method: str = ...,
    space: str = ...,
    directx: bool = ...,
    size: Optional[tuple[int, int]] = ...,
    padding: int = ...,
    threads: int = ...,
    progress: Optional[Progress] = ...,
) -> Floats: ...
def bump_table(
    height: npt.ArrayLike,
    amplitude: float = ...,
    *,
    units: str = ...,
    extent: Optional[tuple[float, float]] = ...,
    wrap: str = ...,
    filter: str = ...,
    threads: int = ...,
    progress: Optional[Progress] = ...,
) -> Floats: ...
def flip(
    reference: npt.ArrayLike, test: npt.ArrayLike, *, pixels_per_degree: float = ..., threads: int = ...
) -> Floats: ...
def read_mesh(path: Path, *, threads: int = ...) -> Mesh: ...
def write_mesh(path: Path, mesh: Mesh, *, threads: int = ...) -> None: ...
def surface(
    surface: Union[Mesh, str],
    *,
    subdivide: Optional[str] = ...,
    cells: tuple[int, int] = ...,
    rate: int = ...,
    threads: int = ...,
    progress: Optional[Progress] = ...,
) -> Mesh: ...
def read_sky(
    files: Sequence[str], *, size: int = ..., threads: int = ..., progress: Optional[Progress] = ...
) -> list[Floats]: ...
def irradiance(
    sky: Sequence[npt.ArrayLike],
    *,
    size: int = ...,
    method: str = ...,
    bands: int = ...,
    threads: int = ...,
    progress: Optional[Progress] = ...,
) -> list[Floats]: ...
def prefilter(
    sky: Sequence[npt.ArrayLike],
    roughness: Sequence[float],
    *,
    size: int = ...,
    lobe: str = ...,
    threads: int = ...,
    progress: Optional[Progress] = ...,
) -> list[list[Floats]]: ...
def sample_sky(sky: Sequence[npt.ArrayLike], directions: npt.ArrayLike, *, threads: int = ...) -> Floats: ...
