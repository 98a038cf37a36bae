"""The falsifier on another actuator than the SVSA."""

import numpy as np
import pytest

from svsa.control.installed import PAPERS_LAW
from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.falsification import falsify
from svsa.evaluation.falsifier.measure import REFUSAL, run_scenario

QBMOVE = Adversary(
    title="A pulse on qbmove, and other springs",
    law="fl",
    cost="peak",
    duration_s=1.5,
    base={
        "figure": "4a",
        "actuator": "qbmove",
        "stiffness": {"kind": "constant", "stiffness_nm_per_rad": 4.0},
        "position": {"kind": "constant"},
        "loads": [],
    },
    terms=[{"kind": "pulse", "torque_nm": 0.1, "start_s": [0.2, 0.8], "duration_s": [0.02, 1.0]}],
    vary=[
        {
            "path": "actuator.spring_torque_nm",
            "kind": "uniform",
            "relative": True,
            "low": 0.9,
            "high": 1.1,
        }
    ],
)


@pytest.mark.exhaustive
def test_search_on_qbmove_returns_a_pulse_and_a_scenario_of_qbmove():
    """A pulse of more than half of the greatest torque; the error of NDOBC under it is smaller."""
    found = falsify(QBMOVE, runs=48)
    assert found.run is not None
    (load,) = found.scenario.loads
    assert 0.05 < abs(load.torque_nm[0]) <= 0.1
    configuration = found.scenario.build_configuration("fl")
    names = [configuration.actuator.mechanism, configuration.nominal.mechanism]
    assert names == ["qbmove", "qbmove"]
    plain, compensated = run_scenario(found.scenario, ("fl", PAPERS_LAW))
    assert plain.fault is None
    assert compensated.fault is None
    peak = "peak_position_error_rad"
    assert compensated.metrics[peak] < plain.metrics[peak]


@pytest.mark.exhaustive
def test_sample_without_the_required_stiffness_range_is_rejected_and_the_search_continues():
    """With a tenth less of its rate, qbmove reaches 10 of the 15 N·m/rad of its limits."""
    rate = {"path": "actuator.rate_per_rad", "kind": "uniform", "relative": True}
    given = QBMOVE.changed(vary=[rate | {"low": 0.9, "high": 1.1}])
    found = falsify(given, runs=64, is_shrunk=False)
    assert found.is_complete
    assert 0 < np.sum(found.severities == REFUSAL) < 64
    assert np.isfinite(found.severity)
    settings = found.scenario.build_configuration("fl")
    assert settings.actuator.rate_per_rad > 0.9 * settings.nominal.rate_per_rad
