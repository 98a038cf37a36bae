"""Random commands for a session: every kind, valid and rejected, at any tick."""

import json

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st

import svsa
from svsa.runs.definition.command import COMMANDS, OF_ARM, build_command, read_command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import LaneSetting
from svsa.runs.execution.replay import simulate_again
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.effects.gravity import LinkGravity
from svsa.simulation.plant.effects.noise import SensorNoise

from .sessions import EVERY_EFFECT, PULSE, build_session

DESIGN = svsa.load_prototype()
CRASH = svsa.ConstantLoad(torque_nm=(30.0, 0.0, 0.0))
torques = st.tuples(*[st.floats(-0.5, 0.5)] * 3)
onsets = st.none() | st.floats(0.0, 0.6)
fades = st.floats(0.05, 0.5)
laws = st.sampled_from(["fl", "ndobc", "fl_integral"])
integral_poles = st.fixed_dictionaries({"position_pole_rad_per_s": st.floats(30.0, 70.0)})
gains = st.builds(
    lambda p, s: svsa.Gains.from_poles([-p] * 4, [-s] * 2), st.floats(20, 80), st.floats(20, 60)
)
observers = st.builds(
    lambda b: svsa.ObserverBandwidth(bandwidth_rad_per_s=b),
    st.tuples(*[st.floats(5.0, 90.0)] * 3),
)
actuators = st.builds(
    lambda share: DESIGN.actuator.changed(
        link_inertia_kg_m2=share * DESIGN.actuator.link_inertia_kg_m2,
        link_damping_nms_per_rad=share * DESIGN.actuator.link_damping_nms_per_rad,
    ),
    st.floats(0.8, 1.2),
)
positions = st.builds(
    svsa.ConstantPosition, position_rad=st.floats(-0.5, 0.5), transition_s=fades
) | st.builds(
    svsa.SinePosition,
    amplitude_rad=st.floats(0.0, 0.5),
    frequency_hz=st.floats(0.0, 1.0),
    transition_s=fades,
)
stiffnesses = st.builds(
    svsa.ConstantStiffness, stiffness_nm_per_rad=st.floats(20.0, 90.0), transition_s=fades
)
loads = st.one_of(
    st.just(CRASH),
    st.builds(svsa.ConstantLoad, torque_nm=torques, start_s=onsets),
    st.builds(svsa.PushLoad, torque_nm=torques, hold_s=st.floats(1e-3, 0.3)),
    st.builds(svsa.PulseLoad, torque_nm=torques, duration_s=st.floats(1e-4, 0.3), start_s=onsets),
    st.builds(svsa.SineLoad, torque_nm=torques, frequency_hz=st.floats(0.1, 20), start_s=onsets),
    st.builds(svsa.MassLoad, mass_kg=st.floats(0.1, 1.0), start_s=onsets),
    st.builds(
        svsa.SeriesLoad,
        time_s=st.just((0.0, 0.05, 0.2)),
        torque_nm=st.tuples(torques, torques, torques),
        start_s=onsets,
    ),
)
effects = st.sampled_from([svsa.IDEAL, svsa.RIG, EVERY_EFFECT]) | st.builds(
    svsa.Effects,
    delay_samples=st.integers(0, 2),
    torque_limits=st.booleans(),
    friction=st.none() | st.builds(Friction, coulomb1_nm=st.floats(0.0, 0.3)),
    current_lag=st.none() | st.builds(CurrentLag, time_constant_s=st.floats(1e-5, 1e-3)),
    noise=st.none() | st.builds(SensorNoise, motor_std_rad=st.floats(0.0, 1e-4)),
    gravity=st.none() | st.builds(LinkGravity, moment_nm=st.floats(0.0, 1.0)),
)
springs = st.builds(
    svsa.SpringEstimation, is_on=st.booleans(), filter_rad_per_s=st.floats(20.0, 100.0)
)
lanes = st.builds(
    svsa.Lane, law=laws, gains=st.none() | gains, observer=st.none() | observers
) | st.builds(svsa.Lane, law=st.just("fl_integral"), parameters=integral_poles)
comparisons = st.lists(lanes, max_size=3).map(tuple)

ARGUMENTS = {
    "position": positions,
    "stiffness": stiffnesses,
    "law": laws,
    "laws": st.lists(laws, min_size=1, max_size=4).map(tuple),
    "gains": gains,
    "parameters": st.fixed_dictionaries({"fl_integral": integral_poles}),
    "observer": observers,
    "spring": springs,
    "actuator": actuators,
    "nominal": actuators,
    "effects": effects,
    "comparisons": comparisons,
    "lane": st.builds(LaneSetting, lane=st.integers(2, 4), setting=lanes),
    "load": loads,
    "unload": st.sampled_from([1, 2, 3]),
    "stop": st.none(),
}
REFUSED = [
    ("stiffness", svsa.ConstantStiffness(stiffness_nm_per_rad=500.0)),
    ("law", "no_law"),
    ("gains", {"position_coefficients": (1.0, 1.0, 1.0, 1.0)}),
    ("comparisons", (svsa.Lane(law="fl"),) * 4),
    ("lane", {"lane": 1, "setting": {"law": "fl"}}),
    ("unload", 99),
    ("unload", 0),
]
assert set(ARGUMENTS) == set(COMMANDS) - set(OF_ARM)

commands = st.sampled_from([*ARGUMENTS, "load", "unload", "unload", "refused"]).flatmap(
    lambda kind: (
        st.sampled_from(REFUSED) if kind == "refused" else st.tuples(st.just(kind), ARGUMENTS[kind])
    )
)
gaps = st.sampled_from([0, 1, 2, 7, 30]) | st.integers(0, 80)
wake_sizes = st.lists(st.integers(1, 50), min_size=1, max_size=5)
seeds = st.sampled_from([0, 1, 2**63 - 1])
scripted = settings(max_examples=25)
scripts = st.lists(st.tuples(gaps, commands), min_size=6, max_size=16)


BUSY = [
    (0, ("effects", EVERY_EFFECT)),
    (30, ("load", svsa.ConstantLoad(torque_nm=(0.4, 0.1, -0.05)))),
    (17, ("law", "fl")),
    (0, ("position", svsa.ConstantPosition(position_rad=0.3, transition_s=0.2))),
    (40, ("unload", 2)),
    (11, ("gains", svsa.Gains.from_poles([-50.0] * 4, [-30.0] * 2))),
    (5, ("law", "ndobc")),
    (25, ("comparisons", (svsa.Lane(law="fl"),))),
    (9, ("lane", LaneSetting(lane=2, setting=svsa.Lane(law="fl_integral")))),
]


def summarize(session):
    """Return all of a session that a rejected command must not change."""
    run = session.run
    return (
        run.configuration,
        list(run.lanes),
        run.loads,
        run.tick,
        run.fault,
        list(session.journal.commands),
        list(session.journal.events),
        session.version,
        session.journal.timeline.window,
        session.journal.timeline.list_segments(),
        len(session.journal.metrics.since_start),
        session.journal.metrics.since_load is None,
    )


def play(session, script, wakes):
    """Run a script in a session: a time in ms in wake-ups of some ms, then the command.

    A rejected command must not change anything. Returns the number of rejected commands.
    """
    refused, turn, now = 0, 0, 0
    session.start()
    session.wake(0.0)
    for gap, (kind, argument) in [*script, (40, (None, None))]:
        while gap > 0:
            late = min(wakes[turn % len(wakes)], gap)
            gap, turn, now = gap - late, turn + 1, now + late
            session.wake(now / 1000.0)
        if kind is None:
            continue
        before = summarize(session)
        try:
            session.change(build_command(0, kind, argument))
        except svsa.SvsaError:
            refused += 1
            assert summarize(session) == before, (kind, argument)
    return refused


def write(session):
    """Write the recorded parts of a session as JSON text."""
    written = {
        "configuration": session.journal.initial.model_dump(mode="json"),
        "commands": [command.to_json() for command in session.journal.commands],
    }
    return json.dumps(written, allow_nan=False)


def read(text):
    """Read (configuration, commands) from the text of `write`."""
    written = json.loads(text)
    configuration = Configuration(**written["configuration"])
    return configuration, [read_command(command) for command in written["commands"]]


def play_busy_session(seed=3):
    session = build_session(PULSE, seed=seed)
    play(session, BUSY, [7, 1, 20])
    return session


def collect(configuration, commands, first, ticks):
    """`simulate_again` in one array: (lanes, ticks, channels)."""
    return np.concatenate(list(simulate_again(configuration, commands, first, ticks)), axis=1)
