"""A session of Figure 4B without the paper's load, and its log."""

import numpy as np

import svsa
from svsa.actuators.signals import CHANNELS
from svsa.runs.session.simulated import SimulatedSession
from svsa.simulation.plant.effects import EVERY

PULSE = svsa.PulseLoad(torque_nm=(1.0, 0.0, 0.0), duration_s=0.02, start_s=0.03)
ALL = list(range(len(CHANNELS)))
EVERY_EFFECT = EVERY
SHOWN_IN_BATCHES = ("ndobc", "fl")
"""The laws that `make test` runs in batches with the effects of the rig and on the loop of the
bench: one with a memory and one without.
"""


def build_configuration(*loads, **changes):
    figure = svsa.paper.get_figure("4b")
    return figure.build_configuration(load=False).changed(loads=loads, **changes)


def build_session(*loads, **changes):
    return SimulatedSession("test", build_configuration(*loads, **changes))


def read_samples(session, lane=0):
    """Read the complete history of a lane: (ticks, channels)."""
    return session.journal.history.read(session.journal.history.first_tick, 1, ALL, [lane])[:, 0]


def advance(run, ticks):
    """Return the samples (lanes, ticks, channels) of this many ticks, fewer after a fault."""
    samples = np.empty((len(run.lanes), ticks, len(CHANNELS)))
    return samples[:, : run.advance(samples)]


def list_events(session):
    return [(event.tick, event.kind) for event in session.journal.events]


def list_lanes(run):
    """Return the complete state of every lane, including the memory of its law, as comparable
    values.
    """
    return [(*lane._replace(memory=()), *lane.memory.tolist()) for lane in run.lanes]
