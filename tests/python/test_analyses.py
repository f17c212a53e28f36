"""Modes, diagnosis, rating, tables of campaigns, COMPAS."""

import json
import pathlib

import numpy as np
import pytest

import voussoir as vs
from conftest import MU, box

SOURCE = pathlib.Path(__file__).parents[2]


def test_a_block_on_springs_has_the_modes_of_a_block_on_springs(stone_on_base):
    modes = vs.modal(vs.Case({"stage": [{"kind": "gravity"}]}, assembly=stone_on_base), 6)
    vertical = np.sqrt(1e9 * 0.25 / 250.0) / (2 * np.pi)
    mode, = np.flatnonzero(np.isclose(modes.frequency, vertical, rtol=1e-6))
    np.testing.assert_allclose(np.abs(modes.shapes[mode, 1]), [0, 0, 1, 0, 0, 0], atol=1e-6)
    assert modes.shapes.shape == (6, 2, 6)
    np.testing.assert_allclose(modes.effective_mass.sum(axis=0)[2], 250.0, rtol=1e-6)
    assert "Hz" in repr(modes) and len(modes) == 6


def test_modes_of_a_run_are_those_of_its_state(tmp_path):
    case = {"bridge": {"generator": "column"}, "stage": [{"kind": "gravity"}]}
    run = vs.Case(case).run(tmp_path / "run", pictures=False, progress=False)
    of_run, of_case = vs.modal(run, 3, as_stored=True), vs.modal(case, 3, state="gravity")
    np.testing.assert_allclose(of_run.frequency, of_case.frequency, rtol=1e-6)
    with pytest.raises(ValueError, match="run has its own"):
        vs.modal(run.directory, 3, state="gravity")
    with pytest.raises(ValueError, match="'intact' or 'gravity'"):
        vs.modal(case, 3, state="rest")


def test_a_diagnosis_names_what_is_missing(tmp_path, program):
    """The abutments of a small bridge are held by the ground, and the model does not know."""
    case = {"bridge": {"generator": "cs2", "abutments": "free", "block_scale": 4.0}}
    from voussoir._toml import dumps
    (tmp_path / "bridge.toml").write_text(dumps(case))
    program("hide", tmp_path / "bridge.toml", "--effect", "abutment_restraint both stiffness_share=0.5", "--seed", "3",
            "--sensors", "rich", "-o", tmp_path / "field", "--quiet")
    lines = []
    found = vs.diagnose(case, tmp_path / "field" / "measured", directory=tmp_path / "found", effects=1,
                        least_amounts=False, run_seconds=0.0, progress=lines.append)
    assert lines
    assert found.verdict == "found"
    assert found.data == json.loads((tmp_path / "found" / "diagnosis.json").read_text())
    assert vs.Case(tmp_path / "found" / "corrected.toml", geometry=True).path
    assert "abutment_restraint" in found.corrected
    # The corrected case of an assembly has a copy of it in its folder; that of the dictionary is a temporary file.
    of_assembly = vs.Case({}, assembly=vs.Case(case, geometry=True).assembly(), geometry=True)
    vs.diagnose(of_assembly, tmp_path / "field" / "measured", directory=tmp_path / "again", effects=1,
                least_amounts=False, run_seconds=0.0, progress=False)
    del of_assembly
    again = vs.Case(tmp_path / "again" / "corrected.toml", geometry=True)
    assert len(again.assembly()) > 100
    assert (tmp_path / "again" / "vtk" / "modes_after.pvd").exists()


def test_a_rating_is_that_of_the_verb(tmp_path, program):
    case = SOURCE / "cases" / "bridges" / "prestwood.toml"
    rating = vs.rate(case, "cs454-normal-single", strip=0.3, step=3.0, refinements=0, tolerance=0.5, most=10.0,
                     both_ways=False, progress=False)
    program("rate", case, "--vehicle", "cs454-normal-single", "--strip", "0.3", "--step", "3", "--refine", "0",
            "--tolerance", "0.5", "--most", "10", "--one-way", "--no-runs", "--quiet", "-o", tmp_path / "rated")
    verb = json.loads((tmp_path / "rated" / "rate.json").read_text())
    without_times = lambda data: json.loads(json.dumps(data), object_hook=lambda d: {k: v for k, v in d.items() if k != "seconds"})
    assert without_times(rating.data) == without_times(verb)
    with pytest.raises(vs.InputError, match="at least one vehicle"):
        vs.rate(case, [])


def test_vehicles_are_listed():
    assert "lm71" in vs.vehicles()


def test_the_table_of_a_campaign(tmp_path):
    (tmp_path / "table.csv").write_text("run,case,record,status,im.pga,edp.keystone_x\nr1,c,a,done,0.2,0.01\n"
                                        "r2,c,b,failed,0.3,\n")
    table = vs.campaign_table(tmp_path)
    assert list(table["run"]) == ["r1", "r2"]
    assert list(table["status"]) == ["done", "failed"]
    np.testing.assert_allclose(table["im.pga"], [0.2, 0.3])
    assert np.isnan(table["edp.keystone_x"][1])
    (tmp_path / "table.csv").write_text("run,case\n")
    with pytest.raises(vs.InputError, match="record|status|rows"):
        vs.campaign_table(tmp_path)


def test_compas_in_and_out(stone_on_base, tmp_path):
    stone_on_base.export(tmp_path / "model.json")
    for model in (tmp_path / "model.json", (tmp_path / "model.json").read_text()):
        assembly = vs.compas.assembly_of(model, material=MU, kn=1e9, ks=4e8)
        np.testing.assert_allclose(sorted(assembly.masses), sorted(stone_on_base.masses), rtol=1e-9)
    run = vs.Simulation({"stage": [{"kind": "gravity"}]}, assembly=stone_on_base, threads=1)
    run.run()
    results = json.loads(json.dumps(vs.compas.results(stone_on_base, run.snapshot())))
    assert [b["index"] for b in results["blocks"]] == [0, 1]
    joint, = results["interfaces"]
    np.testing.assert_allclose(joint["compression"], 250.0 * 9.81, rtol=1e-4)
    corners = np.c_[stone_on_base.block(1)[0][0], np.ones(8)]
    moved = (np.array(results["blocks"][1]["transformation"]) @ corners.T).T[:, :3]
    np.testing.assert_allclose(moved, run.snapshot().vertices(stone_on_base, 1)[0], atol=1e-12)


class Model:
    """As an object of COMPAS: it only knows how to write itself."""

    def __init__(self, text):
        self._text = text

    def to_jsonstring(self):
        return self._text


def test_an_object_of_compas_is_taken(stone_on_base, tmp_path):
    stone_on_base.export(tmp_path / "model.json")
    assert len(vs.compas.assembly_of(Model((tmp_path / "model.json").read_text()), material=MU)) == 2


def test_build_info_names_the_kernels(program):
    assert vs.build_info()["kernels"] in program("--version")
    assert vs.__version__ == vs.build_info()["version"]
