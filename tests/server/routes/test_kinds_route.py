"""Kinds of effects, loads and references for the page, with the fields of their forms."""

import pytest

import svsa
from svsa.simulation.plant.effects import EFFECTS, PRESETS
from svsa.simulation.plant.loads import LOADS
from svsa.simulation.reference.kinds import POSITIONS, STIFFNESSES
from tests.lab import Lab

CLASSES = {"loads": LOADS, "position": POSITIONS, "stiffness": STIFFNESSES}


def test_every_installed_kind_is_described(lab: Lab) -> None:
    kinds = lab.client.get("/api/v1/kinds").raise_for_status().json()
    assert [one["name"] for one in kinds["effects"]] == [one.name for one in EFFECTS]
    for one in kinds["effects"]:
        assert (one["value"] is None) == bool(one["parameters"])
    assert {one["name"]: svsa.Effects(**one["effects"]) for one in kinds["presets"]} == PRESETS
    for name, classes in CLASSES.items():
        described = {one["kind"]: one["form"] for one in kinds[name]}
        assert list(described) == [one.model_fields["kind"].default for one in classes]
        for kind in classes:
            form = described[kind.model_fields["kind"].default]
            assert (form is None) == (kind.first is None)
    lag = next(one for one in kinds["effects"] if one["name"] == "current_lag")["parameters"]
    assert lag[0] | {"high": 0.05, "low": 1e-5, "unit": "s", "kind": "number"} == lag[0]


@pytest.mark.parametrize(
    ("name", "phrase"),
    [("rig", "Angles in counts, velocities"), ("full", "Also friction, the lag")],
)
def test_preset_has_the_values_of_its_effects(lab: Lab, name: str, phrase: str) -> None:
    presets = lab.client.get("/api/v1/kinds").json()["presets"]
    assert next(one for one in presets if one["name"] == name)["summary"].startswith(phrase)
