"""Short forms of settings in scripts, and the errors of other values."""

import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import get_args

import pytest

import svsa
from svsa.control.law_names import KnownLaw
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.shorthand import Settings, change_configuration

PROJECT = Path(__file__).parents[3] / "pyproject.toml"
BASE = svsa.paper.get_figure("4a").build_configuration()


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ({"stiffness": 40}, {"stiffness": svsa.ConstantStiffness(stiffness_nm_per_rad=40.0)}),
        ({"position": 0.3}, {"position": svsa.ConstantPosition(position_rad=0.3)}),
        ({"effects": "rig"}, {"effects": svsa.RIG}),
        ({"loads": svsa.PaperLoad(start_s=1.0)}, {"loads": (svsa.PaperLoad(start_s=1.0),)}),
        ({"loads": {"kind": "paper"}}, {"loads": (svsa.PaperLoad(),)}),
        ({"loads": ()}, {"loads": ()}),
        ({"comparisons": "fl"}, {"comparisons": (svsa.Lane(law="fl"),)}),
        (
            {"comparisons": ["fl", "pd"]},
            {"comparisons": (svsa.Lane(law="fl"), svsa.Lane(law="pd"))},
        ),
        (
            {"actuator": {"link_inertia_kg_m2": 0.05}},
            {"actuator": BASE.actuator.changed(link_inertia_kg_m2=0.05)},
        ),
        ({"limits": {"torque1_nm": 3.0}}, {"limits": BASE.limits.changed(torque1_nm=3.0)}),
        (
            {"observer": 60},
            {"observer": svsa.ObserverBandwidth(bandwidth_rad_per_s=(60.0, 60.0, 60.0))},
        ),
    ],
)
def test_unambiguous_values_are_accepted(written, meant):
    assert change_configuration(BASE, written) == BASE.changed(**meant)


def test_figure_names_ignore_case_and_a_constant_accepts_its_plain_value():
    assert svsa.simulate("4A", duration_s=0.01).configuration == BASE
    stiffness = svsa.ConstantStiffness(stiffness_nm_per_rad=5.0)
    assert svsa.ConstantStiffness(5) == stiffness
    assert svsa.ConstantPosition(0.1).position_rad == 0.1


@pytest.mark.parametrize(
    ("written", "reported"),
    [
        ({"gains": 60}, r"gains is 60: it must be svsa\.Gains, such as svsa\.Gains\.from_poles"),
        ({"stiffness": 1000}, r"stiffness is 1000\.0 N·m/rad: it must be from 1\.7 to 150"),
        ({"position": 90}, r"position\.position_rad is 90 rad: it must be at most"),
        ({"stiffness": "soft"}, "stiffness is 'soft': it must be a reference, such as"),
        ({"effects": "rigg"}, "effects is 'rigg': it must be .*one of ideal, rig, full"),
        ({"loads": 3}, r"loads\[0\] is 3: it must be a load, such as svsa\.PaperLoad"),
        ({"nominal": 3}, "nominal is 3: it must be .*svsa.ActuatorParameters, or a dict"),
        ({"actuator": {"link_inertia": 1}}, "actuator.link_inertia: .*did you mean 'link_inertia_"),
        ({"position": svsa.ConstantStiffness(20)}, "position is .*it must be a reference"),
        ({"observr": 3}, "observr: there is no such keyword; the nearest is observer"),
        ({"duration": 3}, "duration: there is no such keyword; the nearest is duration_s"),
    ],
)
def test_other_values_are_named_with_the_accepted_form(written, reported):
    with pytest.raises(svsa.ParameterError, match=reported):
        svsa.simulate("4a", **({"duration_s": 0.01} | written))


def test_value_without_a_name_is_rejected_with_the_names():
    with pytest.raises(TypeError, match=r"SinePosition\(.*amplitude_rad=…"):
        svsa.SinePosition(0.5)


def test_type_checkers_know_every_setting_and_packaged_law():
    assert {*Settings.__annotations__} == {*Configuration.model_fields} - {
        "law",
        "parameters",
        "arm",
    }
    project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
    assert [*get_args(KnownLaw)] == sorted(project["entry-points"]["svsa.laws"])


WRONG_LINES = (
    'svsa.simulate("4a", "fll")',
    'svsa.simulate("4a", observr=3)',
    'svsa.simulate("4a", effects="rigg")',
    'svsa.simulate("4a", gains=60)',
    'svsa.sweep("4a", {}, seeed=1)',
    'svsa.Stepper("4a", stifness=40)',
    'session.law = "fll"',
    "session.gains = 60",
)
RIGHT = """
import svsa

svsa.simulate("4A", "fl", stiffness=40, effects="rig", loads=svsa.PaperLoad())
svsa.simulate("4a", svsa.AnyLaw("mine"), observer=60, actuator={"link_inertia_kg_m2": 0.05})
svsa.simulate("4a", lambda time_s, reference, x, w: (0.0, 0.0), comparisons="fl")
with svsa.connect() as lab:
    session = lab.session
    session.law = "fl"
    session.stiffness = 30
    session.effects = "rig"
    session.law = session.law
"""


@pytest.mark.exhaustive
def test_type_checker_finds_exactly_the_errors_of_a_script(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(RIGHT + "".join(f"    {line}\n" for line in WRONG_LINES), encoding="utf-8")
    settings = {"typeCheckingMode": "standard", "include": [str(script)]}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(settings), encoding="utf-8")
    checked = subprocess.run(
        ["basedpyright", "--outputjson", "--pythonpath", sys.executable, "-p", str(tmp_path)],
        capture_output=True,
        env=os.environ | {"PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"},
        check=False,
    )
    found = json.loads(checked.stdout)["generalDiagnostics"]
    lines = {one["range"]["start"]["line"] for one in found if one["severity"] == "error"}
    first = RIGHT.count("\n")
    assert lines == set(range(first, first + len(WRONG_LINES))), found
