import os
import subprocess

import numpy as np
import pytest

import voussoir as vs

MU = {"name": "stone", "density": 2000.0, "youngs_modulus": 4e9, "shear_modulus": 1.6e9, "friction_angle": 30.0}


def box(low, high):
    """(vertices, faces) of a box, faces counter-clockwise from outside."""
    (a, b, c), (d, e, f) = low, high
    vertices = np.array([(x, y, z) for z in (c, f) for x, y in ((a, b), (d, b), (d, e), (a, e))], dtype=float)
    faces = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    return vertices, faces


@pytest.fixture
def stone_on_base():
    """A block of half a metre on a base; joints of 1e9 and 4e8 Pa/m."""
    return vs.assembly_from_blocks(
        [box((-1, -1, -0.5), (1, 1, 0)), box((-0.25, -0.25, 0), (0.25, 0.25, 0.5))], materials=[MU],
        components=["base", "block"], fixed=[0], groups={"stone": [1]}, kn=1e9, ks=4e8)


@pytest.fixture
def program():
    """Runs the program voussoir and returns what it prints."""
    def run(*words, folder=None):
        done = subprocess.run([os.environ["VOUSSOIR_PROGRAM"], *map(str, words)], cwd=folder, capture_output=True,
                              text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout
    return run
