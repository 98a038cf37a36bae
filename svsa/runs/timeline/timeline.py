"""The timeline of a run: controllers of its lanes, and windows between changes.

A session updates it during its run; for a recorded run it is computed from configuration and
commands.
"""

import itertools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

from svsa.control.installed import list_law_line_styles
from svsa.errors import StateError
from svsa.runs.definition.command import ApplyLoad, Command, RemoveLoad, Stop, fold
from svsa.runs.definition.configuration import Configuration
from svsa.runs.timeline.controllers import (
    Controller,
    is_shown_together,
    list_controllers,
    name_controllers,
)
from svsa.runs.timeline.events import describe_change, describe_end, list_laws
from svsa.runs.timeline.lane_origins import find_lane_origins
from svsa.runs.timeline.loads import list_loads
from svsa.simulation.plant.loads import Load

MAX_WINDOWS = 1000
MAX_STRETCHES = 1000
LONGEST_LABEL = 200
_MORE = " …"
# The color of a line style is its number modulo this.
LINE_COLORS = 5

WindowKind = Literal["start", "load", "unload", "change", "stop"]


@dataclass(frozen=True)
class Window:
    """A part of a run without changes; ticks first … end − 1, end None: until now.

    Attributes:
        kind: What began it: the run, the onset or removal of a load, a change of reference, law,
            gains, observer, effects, plant, model or lanes, or the ramp of a bench to zero torque,
            which no law commands.
        label: The same in words.
    """

    kind: WindowKind
    label: str
    first_tick: int
    end_tick: int | None = None


class Segment(NamedTuple):
    """A controller on a lane, ticks first … end − 1; end None: until now.

    Attributes:
        controller: The controller.
        number: Number of the controller in the order of appearance, from 1.
        line_style: Number of the style of its curves, from 0; no two stored controllers share one,
            except those of different joints, which are not in one plot.
    """

    controller: Controller
    number: int
    line_style: int
    first_tick: int
    end_tick: int | None = None


class Timeline:
    """The segments of every lane and the windows of a run, command by command.

    `load_window` is that of the newest load; it ends with the next change, when a load is removed,
    or with another load; a load that ends by time ends no window, so that the response to a push is
    visible after it. `load_numbers` are the controllers of the lanes at the onset of that load,
    None for a lane that began later. `lane_ids` are identities of the lanes, which they keep when
    other lanes are removed, and which no other lane of the run has.

    Args:
        kept_ticks: Number of ticks for which an ended segment is kept.
    """

    def __init__(
        self, configuration: Configuration, is_bench: bool = False, kept_ticks: float = math.inf
    ) -> None:
        self._configuration, self._is_bench = configuration, is_bench
        self.kept_ticks = kept_ticks
        self._numbers: dict[Controller, int] = {}
        self._names: dict[int, str] = {}
        self.lanes: list[list[Segment]] = [[] for _ in configuration.lanes]
        self._new_lane_ids = itertools.count(1)
        self.lane_ids = [next(self._new_lane_ids) for _ in self.lanes]
        self.windows: list[Window] = [Window("start", "", 0)]
        self.load_window: Window | None = None
        self.load_numbers: list[int | None] = []
        self._follow_controllers(0)

    @property
    def window(self) -> Window:
        """The current window."""
        return self.windows[-1]

    def take(self, command: Command) -> list[int | None] | None:
        """Apply a command; for one that changed lanes, with the lane that each continues (None:
        new).
        """
        before, origins = self._configuration, None
        self._configuration = fold(before, command, self._is_bench)
        if command.kind == "comparisons":
            origins = find_lane_origins(before, self._configuration)
            self.lanes = [[] if lane is None else self.lanes[lane] for lane in origins]
            self.lane_ids = [
                next(self._new_lane_ids) if lane is None else self.lane_ids[lane]
                for lane in origins
            ]
            if self.load_numbers:
                kept = self.load_numbers
                self.load_numbers = [None if lane is None else kept[lane] for lane in origins]
        self._follow_controllers(command.tick)
        if isinstance(command, Stop):
            self._begin("stop", command.label, command.tick)
        elif not isinstance(command, ApplyLoad | RemoveLoad) and (
            origins is None or None in origins
        ):
            self._begin("change", describe_change(command, list_laws(before)), command.tick)
        return origins

    def begin_load(self, load: Load, tick: int) -> None:
        """Note the onset of a load at this tick."""
        self._begin("load", load.name(), tick)
        self.load_window = self.window
        self.load_numbers = [lane[-1].number for lane in self.lanes]

    def remove_load(self, load: Load, tick: int) -> None:
        """Note the removal of an active load."""
        self._begin("unload", describe_end(load), tick)

    def list_segments(
        self, first_tick: float = 0, most: int = MAX_STRETCHES
    ) -> list[list[Segment]]:
        """List each lane's segments that reach beyond a tick, at most the newest ones."""
        return [
            [
                segment
                for segment in lane
                if segment.end_tick is None or segment.end_tick > first_tick
            ][-most:]
            for lane in self.lanes
        ]

    def name_segments(self, lanes: Sequence[Sequence[Segment]]) -> dict[int, str]:
        """Name each controller, by number, that controlled these lanes in these segments.

        They are named together, in the order of appearance; the result is cached until other lanes
        are requested.
        """
        controllers = {segment.number: segment.controller for lane in lanes for segment in lane}
        if controllers.keys() != self._names.keys():
            numbers = sorted(controllers)
            names = name_controllers(controllers[number] for number in numbers)
            self._names = dict(zip(numbers, names.values(), strict=True))
        return self._names

    def list_windows(self, first_tick: int, end_tick: int) -> list[Window]:
        """List the windows that overlap the ticks first … end − 1."""
        return [
            window
            for window in self.windows
            if window.first_tick < end_tick
            and (window.end_tick is None or window.end_tick > first_tick)
        ]

    def _begin(self, kind: WindowKind, label: str, tick: int) -> None:
        last = self.window
        if last.kind == "start" and tick == 0 and kind == "change":
            return
        if last.first_tick == tick and last.kind != "start":
            self.windows.pop()
            if last.kind == kind:
                label = _join(last.label, label)
        else:
            self.windows[-1] = replace(last, end_tick=tick)
            if last.kind == "load":
                self.load_window = self.windows[-1]
        self.windows.append(Window(kind, label, tick))
        del self.windows[:-MAX_WINDOWS]

    def _follow_controllers(self, tick: int) -> None:
        held = [lane[-1].controller if lane else None for lane in self.lanes]
        present = list_controllers(self._configuration, self._is_bench, held)
        for lane, controller in zip(self.lanes, present, strict=True):
            if lane and lane[-1].controller != controller:
                _end(lane, tick)
            if lane and lane[-1].controller == controller:
                lane[-1] = lane[-1]._replace(end_tick=None)
        self.lanes = [
            [s for s in lane if s.end_tick is None or s.end_tick > tick - self.kept_ticks]
            for lane in self.lanes
        ]
        for lane, controller in zip(self.lanes, present, strict=True):
            if not lane or lane[-1].end_tick is not None:
                number = self._numbers.setdefault(controller, len(self._numbers) + 1)
                lane.append(
                    Segment(controller, number, self._find_line_style(controller, present), tick)
                )

    def _find_line_style(self, controller: Controller, present: Sequence[Controller]) -> int:
        """Return a controller's line style, or the first free one of its law's color.

        If another law uses that color, or the law is not installed, the color is one that no other
        stored law uses, otherwise one that no current controller uses.
        """
        used = {
            segment.controller: segment.line_style
            for lane in self.lanes
            for segment in lane
            if is_shown_together(segment.controller, controller)
        }
        if controller in used:
            return used[controller]
        customary = list_law_line_styles()
        own = customary.get(controller.law)
        of_others = {other: style for other, style in used.items() if other.law != controller.law}
        others = [other for other in present if is_shown_together(other, controller)]
        owed = {customary.get(other.law, 0) for other in others if other.law != controller.law}
        kept = {style % LINE_COLORS for style in of_others.values()}
        now = {style % LINE_COLORS for other, style in of_others.items() if other in present}
        free = [
            color for color in range(LINE_COLORS) if color not in {o % LINE_COLORS for o in owed}
        ]
        wishes = free if own is None else [own, *free]
        first = next(
            (
                wish
                for avoided in (kept, now)
                for wish in wishes
                if wish % LINE_COLORS not in avoided
            ),
            0,
        )
        return next(
            style for style in itertools.count(first, LINE_COLORS) if style not in used.values()
        )


def read_timeline(
    configuration: Configuration,
    commands: Iterable[Command],
    ticks: tuple[int, int],
    is_bench: bool = False,
) -> Timeline:
    """Build the timeline of a run with these commands.

    `ticks` is the first tick from which on segments are kept, and the length of the run.

    Raises:
        ParameterError: If the commands are invalid for this run.
        StateError: If the state of the run does not permit them.
    """
    first_tick, end_tick = ticks
    timeline = Timeline(configuration, is_bench, kept_ticks=0)
    commands = list(commands)
    loads = {load.number: load for load in list_loads(configuration, commands)}
    coming = sorted(
        (load for load in loads.values() if load.start_tick < load.end_tick),
        key=lambda load: load.start_tick,
    )
    for command in commands:
        if command.tick > first_tick:
            timeline.kept_ticks = math.inf
        while coming and coming[0].start_tick < command.tick:
            begun = coming.pop(0)
            timeline.begin_load(begun.load, begun.start_tick)
        timeline.take(command)
        if isinstance(command, RemoveLoad):
            taken = loads.get(command.argument)
            if taken is None:
                raise StateError(f"There is no load {command.argument} in this run.")
            if taken.start_tick < command.tick == taken.end_tick:
                timeline.remove_load(taken.load, command.tick)
    for load in coming:
        if load.start_tick < end_tick:
            timeline.begin_load(load.load, load.start_tick)
    return timeline


def _join(before: str, label: str) -> str:
    """Join the labels of one tick without repetition, shortened to the maximum length."""
    if label in before or before.endswith(_MORE):
        return before
    if len(before) + len(label) > LONGEST_LABEL:
        return before + _MORE
    return f"{before}, {label}"


def _end(lane: list[Segment], tick: int) -> None:
    """End the current segment; one without ticks is dropped."""
    if lane[-1].first_tick == tick:
        lane.pop()
    elif lane[-1].end_tick is None:
        lane[-1] = lane[-1]._replace(end_tick=tick)
