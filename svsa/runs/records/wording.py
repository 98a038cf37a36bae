"""References, loads and effects of a run in a few words, as they stand in a list of runs."""

import math
from collections.abc import Iterable, Sequence

from svsa.control.installed import get_law, is_usable
from svsa.runs.configuration import Lane
from svsa.simulation.plant.effects import PRESETS, Effects, find_preset
from svsa.simulation.reference.trajectories import (
    ConstantPosition,
    ConstantStiffness,
    PositionReference,
    SinePosition,
    SineStiffness,
    StiffnessReference,
)

UNKNOWN = "?"
MAX_STEPS = 3
VERSUS = " vs "
_ARROW = " → "
_EFFECTS = {
    "encoders": "encoders",
    "estimation": "estimated velocities",
    "friction": "friction",
    "current_lag": "current lag",
    "noise": "noise",
    "gravity": "link weight",
}


def follow(texts: Iterable[str]) -> str:
    """Texts that followed one another; of many the first and the last."""
    steps: list[str] = []
    for text in texts:
        if not steps or steps[-1] != text:
            steps.append(text)
    if len(steps) > MAX_STEPS:
        steps = [steps[0], "…", steps[-1]]
    return "" if steps == [UNKNOWN] else _ARROW.join(steps)


def describe_motion(reference: PositionReference | None) -> str:
    """q_d: "60° 0.2 Hz", "held at 20°"."""
    match reference:
        case None:
            return UNKNOWN
        case ConstantPosition():
            return f"held at {_format_degrees(reference.position_rad)}"
        case SinePosition():
            mean = f"{_format_degrees(reference.offset_rad)} ± " if reference.offset_rad else ""
            return f"{mean}{_format_degrees(reference.amplitude_rad)} {reference.frequency_hz:g} Hz"
    return str(reference.kind).replace("_", " ")


def describe_stiffness(reference: StiffnessReference | None) -> str:
    """σ_d in N·m/rad: "60", "35 ± 1"."""
    match reference:
        case None:
            return UNKNOWN
        case ConstantStiffness():
            return f"{reference.stiffness_nm_per_rad:g}"
        case SineStiffness():
            return f"{reference.offset_nm_per_rad:g} ± {reference.amplitude_nm_per_rad:g}"
    return str(reference.kind).replace("_", " ")


def describe_lanes(lanes: Sequence[Lane]) -> str:
    """Controllers side by side: "FL", "FL vs NDOBC (own gains)"."""
    return VERSUS.join(f"{describe_law(lane.law)}{_describe_own(lane)}" for lane in lanes)


def describe_law(name: str) -> str:
    """The title of a law, or the name of one that cannot be used here."""
    return get_law(name).title if is_usable(name) else name


def _describe_own(lane: Lane) -> str:
    return " (own gains)" if lane.gains or lane.observer or lane.parameters else ""


def compute_mean(reference: StiffnessReference | None) -> float | None:
    """The mean of σ_d, N·m/rad; None where it has none of its own."""
    match reference:
        case ConstantStiffness():
            return reference.stiffness_nm_per_rad
        case SineStiffness():
            return reference.offset_nm_per_rad
    return None


def _format_degrees(angle_rad: float) -> str:
    return f"{math.degrees(angle_rad):.4g}°"


def describe_effects(effects: Effects | None) -> str:
    """ideal, rig or full as on the page; else what is switched on."""
    if effects is None:
        return UNKNOWN
    preset = find_preset(effects)
    if preset is not None:
        return preset if effects == PRESETS[preset] else f"{preset}, own values"
    on = {name for name in _EFFECTS if getattr(effects, name) is not None}
    parts = [_EFFECTS[name] for name in _EFFECTS if name in on]
    if effects.delay_samples:
        parts.append(f"delay {effects.delay_samples}")
    if not effects.torque_limits:
        parts.append("no torque limits")
    return ", ".join(parts)
