"""Functions on arrays, against closed forms and against the command."""
import subprocess

import numpy as np
import pytest

import bake
from bake import arrays


def waves(n, amplitude=0.02):
    """An egg box over [0, 1]^2, and its slopes along u and v at the centres of texels; v points up."""
    u = (np.arange(n) + 0.5) / n
    v = 1 - u
    k = 2 * np.pi
    height = amplitude * np.cos(k * u)[None, :] * np.cos(k * v)[:, None]
    b_u = -amplitude * k * np.sin(k * u)[None, :] * np.cos(k * v)[:, None]
    b_v = -amplitude * k * np.cos(k * u)[None, :] * np.sin(k * v)[:, None]
    return height.astype(np.float32), b_u, b_v


def angles(a, b):
    cosine = np.sum(a * b, axis=-1) / np.linalg.norm(a, axis=-1) / np.linalg.norm(b, axis=-1)
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def test_bump_table_has_the_slopes_of_the_closed_form():
    height, b_u, b_v = waves(256)
    table = arrays.bump_table(height)
    assert table.shape == (256, 256, 2) and table.dtype == np.float32
    assert np.abs(table[..., 0] - b_u).max() < 1e-4
    assert np.abs(table[..., 1] - b_v).max() < 1e-4


def test_normal_map_of_a_plane_is_that_of_the_closed_form():
    height, b_u, b_v = waves(256)
    map_ = arrays.normal_map(height, extent=(2, 1))
    expected = np.stack([-b_u / 2, -b_v, np.ones_like(b_u)], axis=-1)
    assert angles(2 * map_.astype(float) - 1, expected).max() < 0.01
    flipped = arrays.normal_map(height, extent=(2, 1), directx=True)
    assert np.allclose(flipped[..., 1], 1 - map_[..., 1], atol=1e-6)


def test_normal_map_is_that_of_the_command(command, meshes, tmp_path):
    height = arrays.read_image(meshes / "bricks.png")
    mesh = arrays.read_mesh(meshes / "torus.obj")
    ours = arrays.normal_map(height[..., 0] if height.ndim == 3 else height, 0.1, mesh, midlevel=0.5, filter="sobel",
                             size=(64, 64))
    out = tmp_path / "map.tif"
    subprocess.run([command, "normal-map", meshes / "torus.obj", "--height", meshes / "bricks.png", "--amplitude", "0.1",
                    "--size", "64", "--filter", "sobel", "--depth", "float", "-o", out, "--quiet"],
                   check=True)
    assert np.array_equal(ours, arrays.read_image(out))


def test_normal_map_does_not_depend_on_threads():
    height, _, _ = waves(128)
    assert np.array_equal(arrays.normal_map(height, threads=1), arrays.normal_map(height, threads=2))


def test_results_own_the_memory_of_the_library_and_inputs_are_copied():
    height, _, _ = waves(64)
    before = height.copy()
    table = arrays.bump_table(height)
    assert not table.flags.owndata and type(table.base).__name__ == "PyCapsule"
    expected = table.copy()
    table[0, 0] = 7  # it is the caller's
    assert np.array_equal(height, before)
    height[:] = 0
    assert np.array_equal(table[1:], expected[1:]) and table[0, 0].tolist() == [7, 7]


def test_other_arrays_are_converted():
    height, _, _ = waves(64)
    assert np.array_equal(arrays.bump_table(height), arrays.bump_table(height.astype(float)))
    turned = np.asfortranarray(height)
    assert np.array_equal(arrays.bump_table(height), arrays.bump_table(turned))


def test_meshes_come_back_as_they_went_in(tmp_path):
    positions = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float32)
    mesh = arrays.Mesh(positions, [[0, 1, 2, 3]], uvs=positions[:, :2])
    arrays.write_mesh(tmp_path / "quad.obj", mesh)
    again = arrays.read_mesh(tmp_path / "quad.obj")
    assert np.array_equal(again.positions, positions)
    assert again.face_begin.tolist() == [0, 4]
    assert np.array_equal(again.uvs[again.corner_uv], positions[:, :2])
    view = again.positions
    del again  # the view keeps the mesh
    assert view[2].tolist() == [1, 1, 0]
    with pytest.raises(ValueError):
        view[0, 0] = 1


def test_surface_of_a_torus_has_the_curvatures_of_the_closed_form():
    torus = arrays.surface("torus:R=2,r=0.5", cells=(64, 64))
    p = torus.positions[torus.corner_position].astype(float)
    n = torus.normals[torus.corner_normal].astype(float)
    ring = np.hypot(p[:, 0], p[:, 2])
    expected = np.stack([p[:, 0] * (1 - 2 / ring), p[:, 1], p[:, 2] * (1 - 2 / ring)], axis=-1)
    assert angles(n, expected).max() < 0.01
    gauss = (ring - 2) / 0.5 / (ring * 0.5)
    assert np.abs(torus.attributes["gauss_curvature"] - gauss).max() < 1e-3


def white_sky(n=16, value=1.0):
    return [np.full((n, n, 3), value, dtype=np.float32) for _ in range(6)]


def test_a_white_sky_has_irradiance_pi_and_stays_white():
    for face in arrays.irradiance(white_sky(), size=4):
        assert face.shape == (4, 4, 3)
        assert np.abs(face - np.pi).max() < 1e-3
    levels = arrays.prefilter(white_sky(), [0, 0.5, 1], size=8)
    assert [level[0].shape[0] for level in levels] == [8, 4, 2]
    for level in levels:
        for face in level:
            assert np.abs(face - 1).max() < 1e-5


def test_samples_of_a_sky_are_its_texels():
    sky = white_sky()
    sky[4][:] = (1, 2, 3)  # pz, ahead
    values = arrays.sample_sky(sky, [[0, 0, 1], [1, 0, 0]])
    assert values.tolist() == [[1, 2, 3], [1, 1, 1]]


def test_skies_are_read(meshes):
    sky = arrays.read_sky([str(meshes / "sky_%s.png")])
    assert len(sky) == 6 and sky[0].shape[0] == sky[0].shape[1]
    assert np.array_equal(sky[0], arrays.read_sky([str(meshes / f"sky_{face}.png")
                                                   for face in ("px", "nx", "py", "ny", "pz", "nz")])[0])


def test_bright_values_survive_a_file(tmp_path):
    light = np.full((4, 4, 3), 2e6, "f")
    bake.arrays.write_image(tmp_path / "sun.exr", light)
    assert (bake.arrays.read_image(tmp_path / "sun.exr") == light).all()


def test_flip_of_equal_pictures_is_0():
    picture = np.random.default_rng(1).random((16, 16, 3), dtype=np.float32)
    assert arrays.flip(picture, picture).max() == 0
    assert arrays.flip(picture, 1 - picture).mean() > 0.1


@pytest.mark.parametrize("call", [
    lambda: arrays.normal_map(np.zeros((2, 2, 2, 2))),
    lambda: arrays.normal_map(np.zeros((0, 2))),
    lambda: arrays.normal_map(np.zeros((2, 2, 3))),
    lambda: arrays.normal_map(np.zeros((2, 2)), size=(0, 2)),
    lambda: arrays.irradiance(white_sky()[:5]),
    lambda: arrays.irradiance([np.zeros((2, 3, 3))] * 6),
    lambda: arrays.Mesh(np.zeros((3, 3)), [[0, 1, 3]]),
    lambda: arrays.Mesh(np.full((3, 3), np.nan), [[0, 1, 2]]),
])
def test_arrays_of_a_wrong_shape_are_refused(call):
    with pytest.raises(ValueError):
        call()


def test_refusals_of_the_library_are_errors_with_an_exit_code(tmp_path):
    height = np.zeros((4, 4), dtype=np.float32)
    height[1, 1] = np.nan
    with pytest.raises(bake.Error) as caught:
        arrays.normal_map(height)
    assert caught.value.exit_code == 4
    with pytest.raises(bake.Error) as caught:
        arrays.read_image(tmp_path / "none.png")
    assert caught.value.exit_code == 3 and caught.value.file == str(tmp_path / "none.png")
    with pytest.raises(bake.Error) as caught:
        arrays.bump_table(np.zeros((4, 4)), units="miles")
    assert caught.value.exit_code == 2
