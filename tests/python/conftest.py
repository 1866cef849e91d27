"""Shared by the tests of the Python module, which CTest runs with PYTHONPATH, BAKE and BAKE_SOURCE set."""
import os
from pathlib import Path

import pytest

SOURCE = Path(os.environ.get("BAKE_SOURCE", Path(__file__).resolve().parents[2]))


@pytest.fixture
def meshes():
    """The project's own meshes/."""
    return SOURCE / "meshes"


@pytest.fixture
def command():
    """The program bake."""
    program = os.environ.get("BAKE")
    if not program:
        pytest.skip("BAKE does not name the program")
    return program
