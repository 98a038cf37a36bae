"""Laws put through a scenario beside the server: what came of each, and its errors over time."""

from typing import Any

import numpy as np

from svsa.evaluation.falsifier.measure import run_scenario
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.evaluation.falsifier.trace import trace_scenario
from svsa.evaluation.falsifier.wording import list_attack
from svsa.evaluation.studies.tables import make_plain
from svsa.runs.records.decimation import decimate

POINTS = 1200
DIGITS = 8
"""After the point, of rad and N·m/rad: what a picture shows of them."""
_TORQUES, _ERRORS = 3, 2


def run_laws(scenario: LoadScenario, laws: tuple[str, ...]) -> dict[str, Any]:
    """Of each law what came of it and its curves, as JSON."""
    outcomes, trace = run_scenario(scenario, laws), trace_scenario(scenario, laws)
    ticks = len(trace.time_s)
    curves = np.full((ticks, _TORQUES + _ERRORS * len(laws)), np.nan)
    curves[:, :_TORQUES] = trace.torque_nm
    for number, one in enumerate(trace.laws):
        at = _TORQUES + _ERRORS * number
        curves[: len(one.errors), at : at + _ERRORS] = one.errors[:ticks]
    thinned = decimate(curves.round(DIGITS), POINTS)
    columns = thinned.values.T.tolist()
    reported = [
        {
            **outcome._asdict(),
            "position_error_rad": columns[_TORQUES + _ERRORS * number],
            "stiffness_error_nm_per_rad": columns[_TORQUES + _ERRORS * number + 1],
        }
        for number, outcome in enumerate(outcomes)
    ]
    return make_plain(
        {
            "description": list_attack(scenario.attack),
            "time_s": trace.time_s[thinned.rows].tolist(),
            "torque_nm": thinned.values[:, :_TORQUES].tolist(),
            "laws": reported,
        }
    )
