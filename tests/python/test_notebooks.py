"""The notebooks of the documentation run from their first cell to their last, and none of them fails."""

import pathlib

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")
pytest.importorskip("matplotlib")

NOTEBOOKS = sorted((pathlib.Path(__file__).parents[2] / "docs" / "notebooks").glob("*.ipynb"))


def texts(notebook):
    """What each cell prints. The kernel sends it in one piece or several, as its clock has it."""
    return ["".join("".join(out.get("text", "")) for out in cell.outputs
                    if out.get("output_type") == "stream" and out.get("name") == "stdout")
            for cell in notebook.cells if cell.cell_type == "code"]


def pictures(notebook):
    return sum("image/png" in out.get("data", {}) for cell in notebook.cells if cell.cell_type == "code"
               for out in cell.outputs)


def test_there_are_three():
    assert [path.stem for path in NOTEBOOKS] == ["arch", "diagnosis", "shaken-bridge"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path):
    stored = nbformat.read(path, as_version=4)
    nbformat.validate(stored)
    again = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(again, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert [bool(text) for text in texts(again)] == [bool(text) for text in texts(stored)]
    assert pictures(again) == pictures(stored) > 0
