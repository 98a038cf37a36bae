"""The identification excitation on a simulated rig, and its record."""

import numpy as np

import svsa
from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.analysis.identification.excitation import EXCITATION_DURATION_S, build_commands
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.replay import replay
from svsa.runs.records.reader import build_record
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.encoders import Encoders
from svsa.simulation.plant.effects.estimation import StateEstimation
from svsa.simulation.plant.effects.friction import Friction
from tests.runs.records.records import build_header

DESIGN = svsa.load_prototype()
BENCH = svsa.Effects(
    encoders=Encoders(),
    estimation=StateEstimation(),
    delay_samples=1,
    friction=Friction(),
    current_lag=CurrentLag(),
)


def build_configuration(**changes):
    """At rest at 30 N·m/rad, with the non-ideal effects of the emulator."""
    return Configuration(
        **dict(DESIGN),
        position=svsa.ConstantPosition(),
        stiffness=svsa.ConstantStiffness(stiffness_nm_per_rad=30.0),
        effects=BENCH,
    ).changed(**changes)


def play(configuration, commands=None, duration_s=EXCITATION_DURATION_S):
    """Return samples (ticks, channels) and fault of a run under the excitation or `commands`."""
    period = configuration.sampling.period_s
    commands = build_commands(period) if commands is None else commands
    parts, fault = [], None
    for run, samples in replay(configuration, commands, round(duration_s / period)):
        parts.append(samples[0].copy())
        fault = run.fault
    return np.concatenate(parts), fault


def build_run(configuration, samples, commands=()):
    """Build a record of these samples (ticks, channels)."""
    written = [(command.tick, command.to_json()) for command in commands]
    header = build_header(
        lanes=("ndobc",), configuration=configuration.model_dump(mode="json"), channels=CHANNELS
    )
    return build_record(header, written, 0, samples[:, None, :])


def get(samples, channel):
    return samples[:, CHANNEL_INDEX[channel]]
