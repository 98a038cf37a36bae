"""Short texts for references, loads and effects of a run, for lists of runs."""

from collections.abc import Iterable, Sequence

from svsa.control.installed import get_law, is_usable
from svsa.runs.definition.design import Lane
from svsa.simulation.plant.effects import EFFECTS, PRESETS, Effects, find_preset
from svsa.simulation.reference.kinds.reference import AnyReference

UNKNOWN = "?"
MAX_STEPS = 3
VERSUS = " vs "
_ARROW = " → "


def follow(texts: Iterable[str]) -> str:
    """Join successive texts; of many the first and the last."""
    steps: list[str] = []
    for text in texts:
        if not steps or steps[-1] != text:
            steps.append(text)
    if len(steps) > MAX_STEPS:
        steps = [steps[0], "…", steps[-1]]
    return "" if steps == [UNKNOWN] else _ARROW.join(steps)


def describe_reference(reference: AnyReference | None) -> str:
    """Describe q_d: "60° 0.2 Hz", "held at 20°"; or σ_d in N·m/rad: "60", "35 ± 1"."""
    return UNKNOWN if reference is None else reference.describe()


def describe_lanes(lanes: Sequence[Lane]) -> str:
    """Describe parallel controllers: "FL", "FL vs NDOBC (own gains)"."""
    return VERSUS.join(f"{describe_law(lane.law)}{_describe_own(lane)}" for lane in lanes)


def describe_law(name: str) -> str:
    """Return the title of a law, or the name of one that is unavailable."""
    return get_law(name).title if is_usable(name) else name


def _describe_own(lane: Lane) -> str:
    return " (own gains)" if lane.gains or lane.observer or lane.parameters else ""


def describe_effects(effects: Effects | None) -> str:
    """Describe effects: ideal, rig or full as on the page; otherwise those that are on."""
    if effects is None:
        return UNKNOWN
    preset = find_preset(effects)
    if preset is not None:
        return preset if effects == PRESETS[preset] else f"{preset}, own values"
    described = (effect.describe(getattr(effects, effect.name)) for effect in EFFECTS)
    return ", ".join(filter(None, described))
