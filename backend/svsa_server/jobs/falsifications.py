"""The falsifier as a job: worst case so far, scenario found, and runs of laws in a scenario."""

import json
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from svsa.evaluation.campaign.journal import Journal, define_search
from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.description import list_attack
from svsa.evaluation.falsifier.falsification import falsify
from svsa.evaluation.falsifier.file import format_scenario, read_scenario
from svsa.evaluation.falsifier.measure import list_baselines, run_scenario
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.evaluation.falsifier.trace import trace_scenario
from svsa.evaluation.studies.tables import make_plain
from svsa.inputs.stored_file import read_json
from svsa.runs.records.decimation import decimate
from svsa.runs.records.header import replace_file
from svsa_server.jobs.progress import JobFolder

_WORST, _OUTCOMES, _SCENARIO = "worst.toml", "outcomes.json", "scenario.toml"
_STEPS, _SEVERITIES = "steps.json", "severities.jsonl"


class Task(NamedTuple):
    """The settings of a search."""

    adversary: Adversary
    runs: int
    seed: int


def search(folder: JobFolder, task: Task) -> bool:
    """Search in a worker, then run laws in the scenario found; return whether the search was
    complete.
    """

    def keep_worst(scenario: LoadScenario) -> None:
        replace_file(folder.path / _WORST, format_scenario(scenario).encode())

    result = falsify(
        task.adversary,
        runs=task.runs,
        seed=task.seed,
        on_generation=lambda done, worst: folder.report(done, task.runs),
        on_worse=keep_worst,
        is_cancelled=folder.is_cancelled,
        journal=Journal(folder.path / _SEVERITIES, define_search(task.adversary.law)),
    )
    folder.report(len(result.severities), task.runs)
    keep_worst(result.as_found)
    steps = [] if result.shrunk is None else [*result.shrunk.steps]
    (folder.path / _STEPS).write_text(json.dumps(steps), encoding="utf-8")
    compared = run_scenario(result.scenario, list_baselines(task.adversary.law))
    outcomes = make_plain([outcome._asdict() for outcome in compared])
    (folder.path / _OUTCOMES).write_text(json.dumps(outcomes), encoding="utf-8")
    # Complete from its first moment on: the server reads the result as soon as this file exists.
    replace_file(folder.path / _SCENARIO, format_scenario(result.scenario).encode())
    return result.is_complete


def read_worst(folder: Path) -> LoadScenario | None:
    """Read the worst case so far, before simplification."""
    path = folder / _WORST
    return read_scenario(path) if path.exists() else None


def find_file(folder: Path) -> Path | None:
    """Find the file of the scenario once the search has ended with one."""
    path = folder / _SCENARIO
    return path if path.exists() else None


class Found(NamedTuple):
    """The simplest scenario, the steps of its simplification, and each law's outcome in it."""

    scenario: LoadScenario
    steps: list[str]
    outcomes: list[dict[str, Any]]


def read_found(folder: Path) -> Found | None:
    """Read the result of a finished search."""
    path = find_file(folder)
    if path is None:
        return None
    steps, outcomes = (read_json(folder / name) for name in (_STEPS, _OUTCOMES))
    return Found(read_scenario(path), steps, outcomes)


POINTS = 1200
DIGITS = 8
"""Decimals of rad and N·m/rad that a picture needs."""
_TORQUES, _ERRORS = 3, 2


def run_laws(scenario: LoadScenario, laws: tuple[str, ...]) -> dict[str, Any]:
    """Return each law's outcome and curves, as JSON."""
    outcomes, trace = run_scenario(scenario, laws), trace_scenario(scenario, laws)
    ticks = len(trace.time_s)
    curves = np.full((ticks, _TORQUES + _ERRORS * len(laws)), np.nan)
    curves[:, :_TORQUES] = trace.torque_nm
    for number, law_trace in enumerate(trace.laws):
        at = _TORQUES + _ERRORS * number
        curves[: len(law_trace.errors), at : at + _ERRORS] = law_trace.errors[:ticks]
    thinned = decimate(curves.round(DIGITS), POINTS)
    columns = thinned.values.T.tolist()
    results = [
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
            "neighborhood": scenario.found and scenario.found.neighborhood,
            "time_s": trace.time_s[thinned.rows].tolist(),
            "torque_nm": thinned.values[:, :_TORQUES].tolist(),
            "laws": results,
        }
    )
