"""Laws over REST: their descriptions and parameters, and lanes with any law."""

import pytest

from svsa.control.installed import list_law_names
from tests.lab import Lab

FASTER = {"fl_integral": {"position_pole_rad_per_s": 70.0}}


def test_every_installed_law_describes_itself(lab: Lab) -> None:
    laws = {law["name"]: law for law in lab.client.get("/api/v1/laws").raise_for_status().json()}
    assert list(laws) == list(list_law_names())
    assert [law["line_style"] for law in laws.values()] == list(range(len(laws)))
    assert {name for name, law in laws.items() if law["takes_gains"]} == {"ndobc", "fl"}
    integral = laws["fl_integral"]
    assert integral["problem"] is None
    assert "int" in integral["equation"]
    assert integral["parameters"][0] == {
        "name": "position_pole_rad_per_s",
        "symbol": "a",
        "meaning": "a of (s + a)⁵ of the position",
        "unit": "rad/s",
        "kind": "number",
        "default": 54.6,
        "low": 5.0,
        "high": 150.0,
    }


def test_parameters_are_set_by_law_and_omitted_ones_are_kept(lab: Lab) -> None:
    lab.client.put(lab.session + "/law", json={"law": "fl_integral"}).raise_for_status()
    held = lab.read()["configuration"]["parameters"]["fl_integral"]
    assert held == {"position_pole_rad_per_s": 54.6, "stiffness_pole_rad_per_s": 32.9}
    state = lab.client.put(lab.session + "/parameters", json=FASTER).raise_for_status().json()
    changed = held | FASTER["fl_integral"]
    assert state["configuration"]["parameters"]["fl_integral"] == changed
    other = {"fl_integral": {"stiffness_pole_rad_per_s": 30.0}}
    state = lab.client.put(lab.session + "/parameters", json=other).raise_for_status().json()
    assert state["configuration"]["parameters"]["fl_integral"] == changed | other["fl_integral"]


@pytest.mark.parametrize(
    ("path", "body", "words"),
    [
        ("law", {"law": "no_law"}, "installed here: ndobc, "),
        ("lanes", {"comparisons": [{"law": "no_law"}]}, "installed here: ndobc, "),
        (
            "lanes",
            {"comparisons": [{"law": "ndobc", "parameters": {"a": 1}}]},
            "takes the run's gains",
        ),
        ("lanes/2", {"law": "fl"}, "none: one lane runs"),
        ("lanes/1", {"law": "fl"}, "at least 2"),
        ("parameters", {"no_law": {}}, "installed here"),
        ("parameters", {"ndobc": {}}, "takes the run's gains"),
        (
            "parameters",
            {"fl_integral": {"position_pole_rad_per_s": 200.0}},
            "fl_integral.position_pole_rad_per_s is 200.0 rad/s: it must be at most 150 rad/s",
        ),
        ("parameters", {"fl_integral": {"color": 1.0}}, "fl_integral.color"),
    ],
)
def test_invalid_value_is_rejected_by_name_and_changes_nothing(
    lab: Lab, path: str, body: dict, words: str
) -> None:
    before = lab.read()["configuration"]
    answer = lab.client.put(f"{lab.session}/{path}", json=body)
    assert answer.status_code == 422
    assert words in answer.json()["detail"]
    assert lab.read()["configuration"] == before


def test_same_law_with_other_parameters_runs_in_a_second_lane(lab: Lab) -> None:
    lab.client.put(lab.session + "/law", json={"law": "fl_integral"}).raise_for_status()
    comparisons = [{"law": "fl_integral", "parameters": FASTER["fl_integral"]}, {"law": "fl"}]
    body = {"comparisons": comparisons}
    state = lab.client.put(lab.session + "/lanes", json=body).raise_for_status().json()
    names = [lane["name"] for lane in state["lanes"]]
    assert names[1:] == ["FL + I a 70", "FL"]
    assert names[0].startswith("FL + I a ")
    assert (
        state["configuration"]["comparisons"][0]["parameters"]["stiffness_pole_rad_per_s"] == 32.9
    )


def test_one_lane_is_set_by_its_number_and_others_are_unchanged(lab: Lab) -> None:
    comparisons = [{"law": "fl"}, {"law": "fl_integral"}]
    lab.client.put(lab.session + "/lanes", json={"comparisons": comparisons}).raise_for_status()
    ids = [lane["id"] for lane in lab.read()["lanes"]]
    slow = {"law": "fl_integral", "parameters": {"position_pole_rad_per_s": 40.0}}
    state = lab.client.put(lab.session + "/lanes/2", json=slow).raise_for_status().json()
    names = [lane["name"] for lane in state["lanes"]]
    assert names == ["NDOBC", "FL + I a 40", "FL + I a 54.6"]
    assert [lane["id"] for lane in state["lanes"]] == ids
    bad = slow | {"parameters": {"position_pole_rad_per_s": 200.0}}
    answer = lab.client.put(lab.session + "/lanes/2", json=bad)
    assert answer.status_code == 422
    assert "position_pole_rad_per_s is 200.0 rad/s" in answer.json()["detail"]
