"""Studies over actuators: each with its own plant, model, limits, references and loads."""

import pytest

from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.errors import ParameterError
from svsa.evaluation.studies.execution import run_study
from svsa.evaluation.studies.file import read_study
from svsa.evaluation.studies.replay import replay_row
from svsa.evaluation.studies.rows import read_rows
from svsa.evaluation.studies.samples import build_configurations, draw
from svsa.evaluation.studies.store import keep_study
from svsa.evaluation.studies.study import Study
from svsa.evaluation.studies.summary import summarize_actuators, summarize_laws
from svsa.evaluation.studies.tables import build_summary_tables

INERTIA = {
    "kind": "uniform",
    "path": "actuator.link_inertia_kg_m2",
    "low": 0.8,
    "high": 1.2,
    "relative": True,
}
GIVEN = {
    "title": "Two actuators",
    "base": {"figure": "4a", "position": {"kind": "constant"}, "loads": []},
    "laws": ("ndobc", "fl"),
    "vary": ({"kind": "grid", "path": "actuator", "values": ["svsa", "qbmove"]}, INERTIA),
    "actuators": {
        "qbmove": {
            "stiffness.stiffness_nm_per_rad": 4.0,
            "loads": [{"kind": "constant", "torque_nm": [-0.1, 0, 0], "start_s": 0.1}],
        }
    },
    "runs": 3,
    "duration_s": 0.4,
}


def test_row_has_the_plant_model_limits_and_settings_of_its_actuator():
    samples = draw(Study(**GIVEN), 0, 4)
    built = build_configurations(Study(**GIVEN), "fl", samples)
    for name, factor, one in zip(*samples.values, built, strict=True):
        found = get_mechanism(name)
        inertia = found.prototype.link_inertia_kg_m2 * factor
        if name == "svsa":  # The plant of the figure is the prototype, too.
            assert one.stiffness.stiffness_nm_per_rad == 15.0
        else:
            assert one.stiffness.stiffness_nm_per_rad == 4.0
            assert one.loads[0].torque_nm[0] == -0.1
        assert one.actuator == found.prototype.changed(link_inertia_kg_m2=inertia)
        assert (one.nominal, one.limits) == (found.nominal, found.limits)


@pytest.mark.exhaustive
def test_rows_equal_single_runs_and_are_summarized_by_actuator(tmp_path):
    stored = keep_study("two", Study(**GIVEN), tmp_path)
    assert run_study(stored, 0)
    rows = read_rows(stored)
    for row in (2, 3):
        replay = replay_row(stored, row)
        assert replay.kept["actuator"] == replay.configuration.actuator.mechanism == "qbmove"
        assert not replay.differing
    found = summarize_actuators(stored.study, rows)
    assert [*found] == ["svsa", "qbmove"]
    for laws in found.values():
        assert [one.runs for one in laws] == [3, 3]
    assert [one.runs for one in summarize_laws(stored.study, rows)] == [6, 6]
    success, _ = build_summary_tables(stored.study, found["qbmove"], "qbmove")
    assert str(success.title).startswith("qbmove: ")


def test_unsuitable_setting_for_an_actuator_is_rejected_with_reason():
    for changes, reason in (
        ({"actuators": {"awas2": {}}}, "an actuator that is varied: svsa, qbmove"),
        ({"actuators": {"qbmove": {"stiffness.stiffness_nm_per_rad": 60.0}}}, "to 15 N·m/rad"),
        (
            {"vary": ({**GIVEN["vary"][0], "values": ["qbmove", "none"]},)},
            "must be an installed actuator",
        ),
        ({"vary": (GIVEN["vary"][0], {**INERTIA, "path": "actuator.radius_m"})}, "a setting"),
    ):
        with pytest.raises(ParameterError, match=reason):
            Study(**(GIVEN | changes))


def test_built_in_study_covers_each_actuator_of_the_package():
    study = read_study("actuators")[1]
    assert {*study.varied_actuators} == {*list_mechanism_names()}
