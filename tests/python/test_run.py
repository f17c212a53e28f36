"""Run directories."""

import json

import numpy as np
import pytest

import voussoir as vs

CASE = {"bridge": {"generator": "column"}, "stage": [{"kind": "gravity"}, {"kind": "free", "duration": 0.05}],
        "output": {"history_every": 0.01, "fields_every": 0.0, "checkpoint_every": 0.01}}


def test_a_run_is_that_of_the_program(tmp_path, program):
    from voussoir._toml import dumps
    (tmp_path / "column.toml").write_text(dumps(CASE))
    program("run", tmp_path / "column.toml", "-o", tmp_path / "theirs", "--no-pictures", "--quiet")
    run = vs.Case(CASE).run(tmp_path / "ours", pictures=False, progress=False)
    theirs = vs.Run(tmp_path / "theirs")
    assert run.summary["state_hash"] == theirs.summary["state_hash"]
    np.testing.assert_array_equal(run.history["energy/kinetic"], theirs.history["energy/kinetic"])
    assert run.history.units["energy/kinetic"] == "J"
    with pytest.raises(KeyError, match="energy/kinetic"):
        run.history["energy/kinetics"]


def test_pausing_and_resuming_give_the_same_bits(tmp_path):
    whole = vs.Case(CASE).run(tmp_path / "whole", pictures=False, progress=False)
    parts = vs.Case(CASE).run(tmp_path / "parts", pictures=False, progress=False, until=0.02)
    assert 0.0 < parts.state().time < 0.04
    parts.resume(pictures=False, progress=False)
    assert parts.summary["state_hash"] == whole.summary["state_hash"]
    np.testing.assert_array_equal(parts.state().displacement, whole.state().displacement)


def test_an_earlier_run_is_not_overwritten_unasked(tmp_path):
    vs.Case(CASE).run(tmp_path / "run", pictures=False, progress=False)
    with pytest.raises(vs.InputError, match="run"):
        vs.Case(CASE).run(tmp_path / "run", pictures=False, progress=False)
    vs.Case(CASE).run(tmp_path / "run", overwrite=True, pictures=False, progress=False)


def test_pictures_are_shown_in_a_notebook(tmp_path):
    run = vs.Case(CASE).run(tmp_path / "run", progress=False)
    assert any(name.endswith(".png") for name in run.images())
    assert "<img" in run._repr_html_() and "base64" in run._repr_html_()
    assert (tmp_path / "run" / "report.html").exists()


def test_a_folder_that_is_no_run():
    with pytest.raises(vs.InputError):
        vs.Run("nowhere").state()
    with pytest.raises(FileNotFoundError):
        vs.Run("nowhere").summary


def test_history_as_a_frame(tmp_path):
    pandas = pytest.importorskip("pandas")
    run = vs.Case(CASE).run(tmp_path / "run", pictures=False, progress=False)
    assert isinstance(run.history.frame(), pandas.DataFrame)
    assert list(run.history.frame()["time"]) == list(run.history["time"])
