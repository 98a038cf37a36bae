"""Studies in files, in Python, and in the package."""

import pytest

from svsa.errors import ParameterError
from svsa.evaluation.studies.file import list_built_in, read_study

GOOD = """\
title = "A study"
runs = 10
laws = ["ndobc"]

[base]
figure = "4a"

[[vary]]
path = "actuator.link_inertia_kg_m2"
kind = "uniform"
low = 0.01
high = 0.02

[[vary]]
kind = "grid"
path = "effects.delay_samples"
values = [0, 1]
"""


def test_study_in_python_equals_that_in_toml(tmp_path):
    (tmp_path / "a.toml").write_text(GOOD)
    (tmp_path / "b.py").write_text(
        "import tomllib, pathlib\nfrom svsa.evaluation.studies.study import Study\n"
        "text = pathlib.Path(__file__).with_name('a.toml').read_text()\n"
        "STUDY = Study(**tomllib.loads(text))\n"
    )
    assert read_study(tmp_path / "a.toml")[1] == read_study(tmp_path / "b.py")[1]
    (tmp_path / "b.py").write_text(
        "from svsa.evaluation.studies.study import Study\n\nSTUDY = Study(runs=-1)\n"
    )
    with pytest.raises(ParameterError, match=r"b\.py, line 3: .*runs is -1"):
        read_study(tmp_path / "b.py")
    (tmp_path / "b.py").write_text("1 / 0\n")
    with pytest.raises(ParameterError, match=r"b\.py, line 1: .*ZeroDivisionError"):
        read_study(tmp_path / "b.py")
    (tmp_path / "b.py").write_text("import sys\nsys.exit(3)\n")
    with pytest.raises(ParameterError, match=r"b\.py, line 2: .*SystemExit: 3"):
        read_study(tmp_path / "b.py")


def test_error_of_an_argument_does_not_mention_the_file(tmp_path):
    path = tmp_path / "good.toml"
    path.write_text(GOOD)
    with pytest.raises(ParameterError, match=r"^runs is 0: it must be at least 1"):
        read_study(path, runs=0)
    path.write_text(GOOD.replace('"ndobc"', '"missing"'))
    with pytest.raises(ParameterError, match=r"good\.toml, line 3: laws\[0\] .*runs is 0"):
        read_study(path, runs=0)


def test_packaged_studies_are_readable_and_found_by_name():
    for name, title in list_built_in().items():
        assert read_study(name, runs=2)[1].title == title
    with pytest.raises(ParameterError, match=r"one of actuators, .*perturbation"):
        read_study("nothing")
