"""A session of Figure 4B without the paper's load, and what it has logged."""

import svsa
from svsa.runtime.session import Session
from svsa.signals import CHANNELS

PULSE = svsa.PulseLoad(torque_nm=(1.0, 0.0, 0.0), duration_s=0.02, start_s=0.03)
ALL = list(range(len(CHANNELS)))


def read_samples(session, lane=0):
    """All that the history holds of a lane: (ticks, channels)."""
    return session.history.read(session.history.first_tick, 1, ALL, [lane])[:, 0]


def build_session(*loads):
    figure = svsa.paper.get_figure("4b")
    return Session("test", figure.build_configuration(load=False).changed(loads=loads))


def list_events(session):
    return [(event.tick, event.kind) for event in session.events]
