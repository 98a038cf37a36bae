"""Replay of an entry's worst run next to NDOBC, without executing submitted code.

An installed law is simulated again. A submitted law is replaced by its saved torques: the simulated
plant returns bit-identical samples for the same torques. The scenario is public, so that nothing
about the hidden trials is disclosed.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.signals import Disturbance, Reference, State
from svsa.control.installed import PAPERS_LAW
from svsa.evaluation.ranking.entry import DECLARED, get_entry_title
from svsa.evaluation.ranking.scenarios import find_scenario
from svsa.evaluation.ranking.single_run import build_shown_run, explain_alone
from svsa.evaluation.scenario import Scenario
from svsa.runs.definition.design import Lane
from svsa.runs.result.result import Result
from svsa.runs.result.simulate import simulate
from svsa.teaching.leaderboard.board import Board, Entry


class WorstReplay(NamedTuple):
    """The worst run of an entry.

    Attributes:
        scenario: The scenario.
        lanes: Controller of each lane; the first is the entry's law.
        result: The run.
        alone: Reason for a single lane; "" if there are two.
    """

    scenario: Scenario
    lanes: tuple[str, ...]
    result: Result
    alone: str


class SavedTorques:
    """A `Controller` that returns recorded torques, one per tick; torque: N·m, (ticks, 2)."""

    def __init__(self, torque: np.ndarray) -> None:
        self._left = iter(torque.tolist())

    def __call__(
        self, time_s: float, reference: Reference, x: State, w: Disturbance
    ) -> tuple[float, float]:
        """Return the next recorded torque."""
        u1, u2 = next(self._left)
        return u1, u2


def replay_worst(board: Board, entry: Entry) -> WorstReplay:
    """Simulate an entry's worst run next to NDOBC (NDOBC next to FL), or alone if that ends first.

    Raises:
        StateError: If the torques of a submitted law are not saved.
    """
    scenario = find_scenario(entry.standing.worst.scenario)
    if entry.is_installed:
        configuration, lanes, alone = build_shown_run(scenario, entry.key)
        result = simulate(configuration, duration_s=scenario.duration_s)
        return WorstReplay(scenario, lanes, result, alone)
    configuration, lanes = scenario.build_configuration(PAPERS_LAW), (entry.name,)
    torque = board.read_torques(entry)
    alone = explain_alone(scenario, entry.name, DECLARED, len(torque))
    if not alone:
        configuration = configuration.changed(comparisons=(Lane(law=PAPERS_LAW),))
        lanes += (get_entry_title(DECLARED),)
    duration_s = len(torque) * configuration.sampling.period_s
    result = simulate(configuration, SavedTorques(torque), duration_s=duration_s)
    return WorstReplay(scenario, lanes, result, alone)
