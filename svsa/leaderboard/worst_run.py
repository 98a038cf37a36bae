"""The worst run of an entry, seen again beside NDOBC: nothing that was submitted runs for it.

A law of the lab is simulated again. Of a submitted one its torques are kept, and the simulated
plant gives the same samples for the same torques, bit for bit. The scenario is one of those that
everybody knows, with no chance of the season in it.
"""

from typing import NamedTuple

import numpy as np

from svsa.arena.find import find_scenario
from svsa.arena.scenarios import Scenario
from svsa.control.installed import PAPERS_LAW, get_title
from svsa.leaderboard.board import Board, Entry
from svsa.result.result import Result
from svsa.result.simulate import simulate
from svsa.run.configuration import Lane
from svsa.signals import Disturbance, Reference, State


class WorstReplay(NamedTuple):
    """An entry's worst run. lanes: what controlled each; the first is the entry's law."""

    scenario: Scenario
    lanes: tuple[str, ...]
    result: Result


class KeptTorques:
    """A `Controller` that gives what was given, one a tick; torque: N·m, (ticks, 2)."""

    def __init__(self, torque: np.ndarray) -> None:
        self._left = iter(torque.tolist())

    def __call__(
        self, time_s: float, reference: Reference, x: State, w: Disturbance
    ) -> tuple[float, float]:
        """The next torque."""
        u1, u2 = next(self._left)
        return u1, u2


def replay_worst(board: Board, entry: Entry) -> WorstReplay:
    """The worst run of an entry beside NDOBC, NDOBC's beside FL, until one of the two ends.

    Raises `StateError` where nothing is kept of a submitted law's.
    """
    scenario = find_scenario(entry.standing.worst.scenario)
    if entry.is_installed:
        configuration = scenario.build_compared(entry.key)
        lanes = tuple(get_title(lane.law) for lane in configuration.lanes)
        return WorstReplay(scenario, lanes, simulate(configuration, duration_s=scenario.duration_s))
    configuration = scenario.build_configuration(PAPERS_LAW)
    configuration = configuration.changed(rivals=(Lane(law=PAPERS_LAW),))
    torque = board.read_torques(entry)
    duration_s = len(torque) * configuration.sampling.period_s
    result = simulate(configuration, KeptTorques(torque), duration_s=duration_s)
    return WorstReplay(scenario, (entry.name, get_title(PAPERS_LAW)), result)
