"""Cases of dictionaries and files."""

import numpy as np
import pytest

import voussoir as vs
from voussoir._toml import dumps

ARCH = {"bridge": {"generator": "arch"}, "stage": [{"kind": "gravity"}]}


def test_a_dictionary_is_the_case_that_its_file_would_be(tmp_path):
    file = tmp_path / "arch.toml"
    file.write_text('[bridge]\ngenerator = "arch"\n[[stage]]\nkind = "gravity"\n')
    assert vs.Case(ARCH).resolved() == vs.Case.read(file).resolved()
    assert vs.Case(ARCH).assembly().hash == vs.Case.read(file).assembly().hash


def test_numpy_values_are_numbers_and_lists():
    case = vs.Case({"bridge": {"generator": "arch", "voussoirs": np.int64(9), "thickness_ratio": np.float64(0.15)},
                    "sensor": [{"id": "crown", "position": np.array([10.543, 0.0, 8.0]), "direction": "x"}],
                    "damping": {"ratio": None}, "stage": [{"kind": "gravity"}]}, geometry=True)
    assert case.resolved()["bridge"]["voussoirs"] == 9
    assert case.resolved()["damping"]["ratio"] == 0.02


def test_every_digit_of_a_number_is_kept():
    import tomllib
    table = {"a": 0.1 + 0.2, "b": [1e-300, 1.7976931348623157e308, -0.0], "c": 'a "quoted"\\\n\x01 text',
             "odd key": {"d": True, "e": [{"f": 1}, {"f": 2}]}, "g": []}
    read = tomllib.loads(dumps(table))
    assert read == table
    assert str(read["b"][2]) == "-0.0"


@pytest.mark.parametrize("case, words", [
    ({"bridge": {"generator": "arhc"}, "stage": [{"kind": "gravity"}]}, "arch"),
    ({"bridge": {"generator": "arch", "voussoir": 7}, "stage": [{"kind": "gravity"}]}, "voussoirs"),
    ({"bridge": {"generator": "arch"}}, "stage"),
    ({"stage": [{"kind": "gravity"}]}, "bridge"),
])
def test_errors_name_the_key_and_the_remedy(case, words):
    with pytest.raises(vs.InputError, match=words) as error:
        vs.Case(case)
    assert isinstance(error.value, ValueError)


def test_what_is_no_value_of_a_case_is_named():
    with pytest.raises(TypeError, match="bridge.generator is a object"):
        vs.Case({"bridge": {"generator": object()}})


def test_a_file_that_is_not_there():
    with pytest.raises(vs.InputError, match="nowhere.toml"):
        vs.Case("nowhere.toml")


def test_write_gives_a_case_of_its_own(tmp_path):
    vs.Case(ARCH).write(tmp_path / "copy")
    assert vs.Case(tmp_path / "copy" / "case.toml").resolved() == vs.Case(ARCH).resolved()


def test_a_case_about_an_assembly(stone_on_base):
    case = vs.Case({"stage": [{"kind": "gravity"}]}, assembly=stone_on_base)
    assert case.assembly().hash == stone_on_base.hash
    with pytest.raises(TypeError, match="leave one out"):
        vs.Case(ARCH, assembly=stone_on_base)
