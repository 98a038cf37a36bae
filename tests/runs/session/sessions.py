"""A session of Figure 4B without the paper's load, and what it has logged."""

import numpy as np

import svsa
from svsa.actuators.signals import CHANNELS
from svsa.runs.session.simulated import SimulatedSession
from svsa.simulation.plant.effects import EVERY

PULSE = svsa.PulseLoad(torque_nm=(1.0, 0.0, 0.0), duration_s=0.02, start_s=0.03)
ALL = list(range(len(CHANNELS)))
EVERY_EFFECT = EVERY
SHOWN_IN_BATCHES = ("ndobc", "fl", "ndobc_w", "ilc")
"""The laws that `make test` runs in batches on a rig's effects and on the bench's own loop:
without a memory, with one of numbers and of records, and one called for a run after the other."""


def build_configuration(*loads, **changes):
    figure = svsa.paper.get_figure("4b")
    return figure.build_configuration(load=False).changed(loads=loads, **changes)


def build_session(*loads, **changes):
    return SimulatedSession("test", build_configuration(*loads, **changes))


def read_samples(session, lane=0):
    """All that the history holds of a lane: (ticks, channels)."""
    return session.journal.history.read(session.journal.history.first_tick, 1, ALL, [lane])[:, 0]


def advance(run, ticks):
    """The samples (lanes, ticks, channels) of so many ticks, fewer after a fault."""
    samples = np.empty((len(run.lanes), ticks, len(CHANNELS)))
    return samples[:, : run.advance(samples)]


def list_events(session):
    return [(event.tick, event.kind) for event in session.journal.events]


def list_lanes(run):
    """The state of every lane, memory of the law and all, as values that compare."""
    return [(*lane._replace(memory=()), *lane.memory.tolist()) for lane in run.lanes]
