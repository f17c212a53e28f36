"""Assemblies of arrays."""

import numpy as np
import pytest

import voussoir as vs
from conftest import MU, box


def test_a_block_has_the_mass_and_the_joint_of_its_shape(stone_on_base):
    assert len(stone_on_base) == 2
    np.testing.assert_allclose(stone_on_base.masses[1], 2000.0 * 0.125, rtol=1e-12)
    np.testing.assert_allclose(stone_on_base.centroids[1], [0.0, 0.0, 0.25], atol=1e-12)
    assert stone_on_base.fixed.tolist() == [True, False]
    assert stone_on_base.components == ["base", "block"]
    assert stone_on_base.materials == ["stone", "stone"]
    assert stone_on_base.groups == {"stone": [1]}
    joints = stone_on_base.joints
    assert (joints["a"].tolist(), joints["b"].tolist()) == ([0], [1])
    np.testing.assert_allclose(joints["area"], 0.25, rtol=1e-12)
    np.testing.assert_allclose(joints["normal"], [[0, 0, 1]], atol=1e-12)
    np.testing.assert_allclose([joints["kn"][0], joints["ks"][0]], [1e9, 4e8])
    assert stone_on_base.joint_polygon(0).shape == (4, 3)


def test_shapes_come_back_as_they_were_given(stone_on_base):
    (vertices, faces), = stone_on_base.block(1)
    assert sorted(map(tuple, vertices)) == sorted(map(tuple, box((-0.25, -0.25, 0), (0.25, 0.25, 0.5))[0]))
    assert sorted(len(f) for f in faces) == [4] * 6
    with pytest.raises(IndexError, match="blocks 0 to 1"):
        stone_on_base.block(2)


def test_a_block_of_two_cells_is_one_stone():
    ell = [box((0, 0, 0), (2, 1, 1)), box((0, 0, 1), (1, 1, 2))]
    with pytest.warns(UserWarning, match="several cells"):
        assembly = vs.assembly_from_blocks([box((-1, -1, -1), (3, 2, 0)), ell], materials=[MU], fixed=[True, False])
    assert len(assembly) == 2
    assert len(assembly.block(1)) == 2
    np.testing.assert_allclose(assembly.masses[1], 3 * 2000.0, rtol=1e-12)


def test_materials_and_parts_of_blocks():
    soft = {**MU, "name": "soft", "density": 1000.0, "youngs_modulus": 1e9}
    assembly = vs.assembly_from_blocks(
        [box((0, 0, -1), (1, 1, 0)), box((0, 0, 0), (1, 1, 1)), box((0, 0, 1), (1, 1, 2))], materials=[MU, soft],
        block_materials=["stone", "stone", "soft"], components=["base", "pier", "pier"], parts=[0, 0, 3])
    assert assembly.materials == ["stone", "stone", "soft"]
    assert assembly.parts.tolist() == [0, 0, 3]
    np.testing.assert_allclose(assembly.masses[2], 1000.0)
    assert assembly.fixed.tolist() == [True, False, False]


def test_files_and_round_trip(stone_on_base, tmp_path, program):
    stone_on_base.write(tmp_path / "stone.h5")
    assert vs.Assembly.read(tmp_path / "stone.h5").hash == stone_on_base.hash
    assert "2 blocks" in program("info", tmp_path / "stone.h5")
    stone_on_base.export(tmp_path / "stone.obj")
    again = vs.import_blocks(tmp_path / "stone.obj", material=MU, kn=1e9, ks=4e8)
    np.testing.assert_allclose(again.centroids, stone_on_base.centroids, atol=1e-12)
    with pytest.raises(vs.InputError, match=".obj or .json"):
        stone_on_base.export(tmp_path / "stone.stl")


@pytest.mark.parametrize("blocks, words, more", [
    ([], "no blocks", {}),
    ([box((0, 0, 0), (1, 1, 1))[:1] + ([[0, 1, 2]],)], "closed", {}),
    ([box((0, 0, 0), (1, 1, 1)), box((0, 0, 0.5), (1, 1, 1.5))], "overlap", {}),
    ([(np.zeros((4, 2)), [[0, 1, 2]])], r"shape \(n, 3\)", {}),
    ([(np.zeros((4, 3)), [[0, 1, 7]])], "vertex 7", {}),
    ([box((0, 0, 0), (1, 1, 1))], "not a component", {"components": ["archh"]}),
    ([box((0, 0, 0), (1, 1, 1))], "1 block", {"components": ["arch", "arch"]}),
    ([box((0, 0, 0), (1, 1, 1))], "block 3", {"fixed": [3]}),
    ([box((0, 0, 0), (1, 1, 1))], "block 5", {"groups": {"g": [5]}}),
    ([box((0, 0, 0), (1, 1, 1))], "densty", {"materials": [{"densty": 1.0}]}),
])
def test_errors_say_which_block(blocks, words, more):
    with pytest.raises(vs.InputError, match=words):
        vs.assembly_from_blocks(blocks, **more)


def test_what_may_surprise_is_a_warning():
    with pytest.warns(UserWarning, match="no stone is fixed"):
        vs.assembly_from_blocks([box((0, 0, 0), (1, 1, 1))], fixed=[False])
