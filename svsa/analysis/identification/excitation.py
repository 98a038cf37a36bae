"""A motion that makes all parameters identifiable: slow, fast, soft and stiff.

Slow sines cross the Stribeck velocity, where friction is visible; long fast strokes show the
dampings; fast sines show the inertias and the delay of the torque, which at a single frequency
could not be distinguished from damping; large accelerations of the link show the spring. The
stiffness varies while the link moves fast, and no two frequencies are multiples: otherwise every
period would have the same encoder counts, and their error would not average out.
"""

from typing import Literal, NamedTuple

from svsa.runs.definition.command import Command, build_command
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness
from svsa.simulation.reference.kinds.sine import SinePosition, SineStiffness

EXCITATION_DURATION_S = 32.0


class Cue(NamedTuple):
    """A reference to fade over to, at a time in seconds after the start."""

    time_s: float
    kind: Literal["position", "stiffness"]
    reference: PositionReference | StiffnessReference


def _move(time_s: float, amplitude_rad: float, frequency_hz: float) -> Cue:
    reference = SinePosition(amplitude_rad=amplitude_rad, frequency_hz=frequency_hz)
    return Cue(time_s, "position", reference)


def _stiffen(time_s: float, mean: float, amplitude: float = 0.0, frequency_hz: float = 0.0) -> Cue:
    if not amplitude:
        return Cue(time_s, "stiffness", ConstantStiffness(stiffness_nm_per_rad=mean))
    reference = SineStiffness(
        offset_nm_per_rad=mean, amplitude_nm_per_rad=amplitude, frequency_hz=frequency_hz
    )
    return Cue(time_s, "stiffness", reference)


EXCITATION = (
    _move(0.0, 1.0, 0.1),
    _stiffen(0.0, 30.0),
    _move(4.0, 0.8, 1.0),
    _stiffen(6.0, 50.0, 30.0, 0.23),
    _move(9.0, 0.2, 5.0),
    _stiffen(9.0, 60.0, 15.0, 0.31),
    _move(12.0, 0.3, 3.1),
    _stiffen(12.0, 25.0, 5.0, 0.37),
    _move(16.0, 0.4, 1.9),
    _stiffen(16.0, 60.0, 35.0, 1.03),
    _stiffen(19.0, 50.0, 28.0, 2.0),
    _move(22.0, 0.6, 0.7),
    _stiffen(22.0, 45.0, 6.0, 5.0),
    _move(25.0, 0.15, 4.3),
    _stiffen(25.0, 100.0, 20.0, 0.41),
    _move(28.0, 0.4, 2.3),
    _stiffen(28.0, 18.0, 3.0, 0.53),
    Cue(30.5, "position", ConstantPosition()),
    _stiffen(30.5, 30.0),
)


def build_commands(period_s: float, first_tick: int = 0) -> list[Command]:
    """Build the excitation as commands for a run at `first_tick`."""
    return [
        build_command(first_tick + round(cue.time_s / period_s), cue.kind, cue.reference)
        for cue in EXCITATION
    ]
