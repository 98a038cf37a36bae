"""Summary of a recorded run's settings: columns of the list of runs, and a name.

The summary covers the recorded samples only: a law before the first sample, or a load planned for
after the last, is not included.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.actuators.parameters import SVSA
from svsa.runs.definition.design_file import load_prototype
from svsa.runs.definition.paper import LOAD_TIME_S, get_figure
from svsa.runs.definition.shorthand import read_mechanism
from svsa.runs.records.acting import Acting, read_acting
from svsa.runs.records.header import RecordHeader
from svsa.runs.records.parquet import Commands
from svsa.runs.records.wording import (
    MAX_STEPS,
    UNKNOWN,
    VERSUS,
    describe_effects,
    describe_lanes,
    describe_law,
    describe_reference,
    follow,
)
from svsa.simulation.reference.paper import ON_BENCH, References, find_figure

NO_LOAD = "no load"
IDEAL_NAME = "ideal"
_DOT = " · "
_PLANTS = {"bench": "bench", "emulated": "emulated bench"}
_OWN = {
    "gains": "gains",
    "parameters": "parameters of laws",
    "observer": "observer",
    "actuator": "plant",
    "nominal": "model",
    "limits": "limits",
    "sampling": "sampling",
}


@dataclass(frozen=True)
class RunSettings:
    """Settings of a run while it was recorded, as text; "" if unknown.

    Values that followed one another are separated by an arrow.

    Attributes:
        name: The settings joined, for a run without a name.
        figure: Key of the paper's figure with the references at the first sample.
        figure_name: "Fig. 4A" if settings and load are those of the figure; "Fig. 4A motion" with
            the references only; "from Fig. 4A" if they were changed.
        laws: Laws of each lane.
        law_kinds: Every law that controlled a lane at some time.
        stiffness: σ_d, N·m/rad.
        stiffness_nm_per_rad: Mean of σ_d at the first sample, N·m/rad.
        load: Loads that were active.
        load_kinds: Their kinds, or "none".
        effects: Non-ideal effects of the simulation, or the bench.
        own: Parts of the design that differ from the default one of the actuator.
    """

    name: str
    figure: str
    figure_name: str
    motion: str
    laws: str
    law_kinds: tuple[str, ...]
    stiffness: str
    stiffness_nm_per_rad: float | None
    load: str
    load_kinds: tuple[str, ...]
    effects: str
    own: str


def describe_settings(
    header: RecordHeader, commands: Commands, first_tick: int, ticks: int
) -> RunSettings:
    """Summarize the settings of the record of `ticks` samples from `first_tick` on.

    Never raises: settings that this version cannot read are left out, and changes to such settings
    are shown as "?".
    """
    acting = read_acting(header, commands, first_tick, ticks)
    on_bench = header.plant != "simulated"
    is_arm = header.is_arm
    figure, is_held = ("", False) if is_arm else _find_figure(acting, on_bench)
    mechanism = _find_mechanism(header)
    own = "" if on_bench or is_arm else ", ".join(_find_own(acting, mechanism))
    effects = _PLANTS.get(header.plant, "") or follow(
        map(describe_effects, acting.get_values("effects"))
    )
    is_plain = mechanism == SVSA and not own and (on_bench or effects == IDEAL_NAME)
    is_whole = is_held and is_plain and _has_load_of(figure, acting, header.period_s)
    first = acting.get_values("stiffness")[0]
    settings = RunSettings(
        name="",
        figure=figure,
        figure_name=_name_figure(figure, is_held, is_whole),
        motion=_describe_motion(acting, header),
        laws=_describe_laws(acting, header),
        law_kinds=_list_laws(acting),
        stiffness=follow(map(describe_reference, acting.get_values("stiffness"))),
        stiffness_nm_per_rad=None if first is None else first.get_mean(),
        load=_describe_loads(acting),
        load_kinds=_list_load_kinds(acting),
        effects=effects,
        own=own,
    )
    return replace(settings, name=_build_name(settings, _name_mechanism(mechanism)))


def _describe_motion(acting: Acting, header: RecordHeader) -> str:
    """Describe the position reference over time, of an arm that of joint 1 or of the tip."""
    motion = follow(map(describe_reference, acting.get_values("position")))
    if not header.is_arm:
        return motion
    tip = header.configuration["arm"].get("tip")
    return f"arm, tip {tip.get('kind', UNKNOWN)}" if isinstance(tip, dict) else f"arm, {motion}"


def _name_figure(figure: str, is_held: bool, is_whole: bool) -> str:
    if not figure:
        return ""
    name = f"Fig. {figure.upper()}"
    return name if is_whole else f"{name} motion" if is_held else f"from {name}"


def _has_load_of(figure: str, acting: Acting, period_s: float) -> bool:
    """Whether the only load is the figure's, or a mass on a bench, from its time to the end."""
    if acting.loads is None or len(acting.loads) != 1:
        return False
    [(_, load, start, end, _)] = acting.loads
    hung = get_figure(figure).hung
    is_same = load.changed(start_s=hung.start_s) == hung
    is_mass = figure in ON_BENCH.values() and load.kind == "mass"
    return (is_same or is_mass) and start == round(LOAD_TIME_S / period_s) and end == math.inf


def _find_mechanism(header: RecordHeader) -> str:
    """The name of the recorded actuator, installed or not."""
    written = header.configuration.get("actuator")
    return str(written.get("mechanism", SVSA)) if isinstance(written, dict) else SVSA


def _name_mechanism(name: str) -> str:
    """The title of an actuator; none for the SVSA, which the settings are those of."""
    if name == SVSA:
        return ""
    return get_mechanism(name).title if name in list_mechanism_names() else name


def _build_name(settings: RunSettings, mechanism: str) -> str:
    parts = [
        settings.figure_name or settings.motion,
        settings.laws,
        f"σ {settings.stiffness}" if settings.stiffness else "",
        settings.load,
        "" if settings.effects == IDEAL_NAME else settings.effects,
        f"own {settings.own}" if settings.own else "",
    ]
    name = _DOT.join(part for part in parts if part)
    return f"{mechanism}{_DOT}{name}" if mechanism else name[:1].upper() + name[1:]


def _find_figure(acting: Acting, on_bench: bool) -> tuple[str, bool]:
    positions, stiffnesses = acting.get_values("position"), acting.get_values("stiffness")
    if positions[0] is None or stiffnesses[0] is None:
        return "", False
    figure = find_figure(References(positions[0], stiffnesses[0]), on_bench)
    if figure is None:
        return "", False
    asked = [(positions[0], stiffness) for stiffness in stiffnesses[1:]]
    asked += [(position, stiffnesses[0]) for position in positions[1:]]
    is_held = all(
        None not in pair and find_figure(References(*pair), on_bench) == figure for pair in asked
    )
    return figure, is_held


def _describe_laws(acting: Acting, header: RecordHeader) -> str:
    """Describe each lane with its laws over time; a bench's second lane is its twin."""
    every = [lanes or () for lanes in acting.get_values("comparisons")]
    arm = header.configuration.get("arm")
    width = 1 + len(arm.get("other_joints", ())) if arm else 1
    if any(width * (1 + len(lanes)) != len(header.lanes) for lanes in every):
        every = [()]
    first = follow(
        UNKNOWN if law is None else describe_law(law) for law in acting.get_values("law")
    )
    is_twin = header.plant != "simulated" and bool(every[0])
    comparisons = follow(describe_lanes(lanes[1:] if is_twin else lanes) for lanes in every)
    others = ["twin", comparisons] if is_twin else [comparisons]
    return VERSUS.join(part for part in (first, *others) if part)


def _list_laws(acting: Acting) -> tuple[str, ...]:
    laws = [law for law in acting.get_values("law") if law is not None]
    laws += [lane.law for lanes in acting.get_values("comparisons") for lane in lanes or ()]
    return tuple(dict.fromkeys(laws))


def _describe_loads(acting: Acting) -> str:
    if acting.loads is None:
        return ""
    texts = [scheduled.load.describe() for scheduled in acting.loads]
    kinds = list(dict.fromkeys(texts))
    counted = [_count(text, texts) for text in kinds]
    if len(counted) > MAX_STEPS:
        rest = len(kinds) - MAX_STEPS + 1
        counted = [*counted[: MAX_STEPS - 1], f"{rest} other loads"]
    return " + ".join(counted) or NO_LOAD


def _count(text: str, texts: Sequence[str]) -> str:
    """Count equal loads: "pulse (2×)", so that two in turn do not read as a sum."""
    return f"{text} ({texts.count(text)}×)" if texts.count(text) > 1 else text


def _list_load_kinds(acting: Acting) -> tuple[str, ...]:
    if acting.loads is None:
        return ()
    kinds = dict.fromkeys(scheduled.load.kind for scheduled in acting.loads)
    return tuple(kinds) or ("none",)


def _find_own(acting: Acting, mechanism: str) -> list[str]:
    prototype = load_prototype()
    plain = {name: getattr(prototype, name, {}) for name in _OWN}
    if mechanism != SVSA and mechanism in list_mechanism_names():
        plain |= read_mechanism(mechanism)
    return [
        title
        for name, title in _OWN.items()
        if any(value not in (None, plain[name]) for value in acting.get_values(name))
    ]
