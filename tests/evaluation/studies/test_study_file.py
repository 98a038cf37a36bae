"""An invalid study is rejected with file, line, name, value and bound before anything runs."""

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


@pytest.mark.parametrize(
    ("old", "new", "reported"),
    [
        ("runs = 10", "runs = 0", r"line 2: runs is 0: it must be at least 1"),
        (
            '"ndobc"',
            '"missing"',
            r"line 3: laws\[0\] is 'missing': it must be a law that is installed here",
        ),
        ('"4a"', '"9"', r"line 6: base\.figure is '9'"),
        (
            "[base]",
            'metrics = ["effort_n2m2_s", "energy"]\n[base]',
            r"line 5: metrics\[1\] is 'energy': it must be one of rms_position_.*limit_share",
        ),
        ("[base]", "metrics = []\n[base]", r"line 5: metrics is .*at least 1"),
        (
            "[base]",
            'metrics = ["limit_share", "limit_share"]\n[base]',
            r"line 5: metrics is .*names, each once",
        ),
        (
            "[base]",
            "[success]\nlimit_share = 2\n[base]",
            r"line 6: success.limit_share is 2.*most 1",
        ),
        ("[base]", "[base]\nseed = 3", r"base is 'seed': it must be another setting"),
        ("link_inertia", "mass", r"line 9: vary\[0\]\.path is 'actuator\.mass.*link_inertia"),
        ("low = 0.01", "low = -1.0", r"line 11: vary\[0\]\.low: with -1\.0 there, link_inertia.*"),
        ("low = 0.01", "low = 0.5", r"line 11: vary\[0\]\.low is 0\.5: it must be less than high"),
        ("[0, 1]", "[0, 9]", r"line 17: vary\[1\]\.values\[1\]: with 9 there.*at most 5 samples"),
        ('"grid"', '"dice"', r"line 15: vary\[1\]\.kind is 'dice': it must be one of 'uniform'"),
        ("effects.delay_samples", "seed", r"line 16: vary\[1\]\.path is 'seed'.*study's own"),
        ("runs = 10", "runs =", r"it must be a readable TOML file .*line 2"),
    ],
)
def test_invalid_value_is_reported_with_its_line(tmp_path, old, new, reported):
    path = tmp_path / "wrong.toml"
    path.write_text(GOOD.replace(old, new, 1))
    with pytest.raises(ParameterError, match=r"(?s)wrong\.toml.*" + reported):
        read_study(path)


def test_setting_varies_once_and_not_within_another(tmp_path):
    path = tmp_path / "wrong.toml"
    for other, reported in (
        ("actuator.link_inertia_kg_m2", "varied once"),
        ("actuator", "a varied path already contains it"),
    ):
        path.write_text(GOOD.replace("effects.delay_samples", other))
        with pytest.raises(ParameterError, match=reported):
            read_study(path)


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
